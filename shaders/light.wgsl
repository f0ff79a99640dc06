// Light at a point of the surface: what arrives, and what of it is shadowed, reflected and let through (Lam 2016, B.1 and B.2.2).

struct Lamp {
    position: vec3f,
    // D₀.
    distance: f32,
    // Its axes: right, up and forward.
    right: vec3f,
    cos_outer: f32,
    up: vec3f,
    cos_inner: f32,
    axis: vec3f,
    tan_half: f32,
    color: vec3f,
    near: f32,
    far: f32,
    // Which shadow map.
    layer: u32,
    unused: vec2u,
}

// What stands beside the skin of a scene.
struct Transport {
    // Table B.1: weights, and beside them what the square of s (mm²) is multiplied by in the exponent.
    profile: array<vec4f, 6>,
    // A millimetre in model units.
    millimetre: f32,
    // s of a model unit's thickness: (1 − translucency) in millimetres.
    thickness: f32,
    // Looks along a side of the shadow's filter.
    filter_size: u32,
    unused: u32,
}

@group(1) @binding(1) var<storage, read> beckmann: array<f32>;
@group(0) @binding(1) var<storage, read> lights: array<Lamp>;
@group(0) @binding(2) var<uniform> transport: Transport;
@group(0) @binding(3) var shadow_maps: texture_depth_2d_array;

const BECKMANN_WIDTH = 256u;
const BECKMANN_HEIGHT = 64u;
const LEAST_ROUGHNESS = 0.05;

// A point as a light sees it.
struct Seen {
    // Texels from the upper left of its shadow map.
    place: vec2f,
    // Depth along its axis.
    depth: f32,
}

fn see(light: Lamp, point: vec3f, size: f32) -> Seen {
    let to = point - light.position;
    let depth = dot(to, light.axis);
    let across = vec2f(dot(to, light.right), -dot(to, light.up)) / (depth * light.tan_half);
    return Seen((across * 0.5 + 0.5) * size, depth);
}

// The nearest depth at a texel of a shadow map.
fn stored(light: Lamp, texel: vec2i) -> f32 {
    let depth = textureLoad(shadow_maps, texel, light.layer, 0);
    return light.near * light.far / (light.near + depth * (light.far - light.near));
}

fn compared(light: Lamp, texel: vec2i, side: i32, depth: f32) -> f32 {
    // Outside of the map all is lit.
    if any(texel < vec2i(0)) || any(texel >= vec2i(side)) {
        return 1.0;
    }
    return select(0.0, 1.0, depth <= stored(light, texel));
}

// k: percentage-closer filtering. The looks overlap, so that all of them together are (filter + 1)² comparisons, of which the outermost
// count in part.
fn shadowed(light: Lamp, position: vec3f, normal: vec3f) -> f32 {
    let side = i32(textureDimensions(shadow_maps).x);
    let texel = 2.0 * dot(position - light.position, light.axis) * light.tan_half / f32(side);
    let looks = i32(transport.filter_size);
    let seen = see(light, position + normal * (1.5 * texel), f32(side));
    // Also where it is not a number.
    if !(seen.depth > 0.0 && all(abs(seen.place) < vec2f(2.0 * f32(side)))) {
        return 1.0;
    }
    let first = seen.place - 0.5 - 0.5 * f32(looks - 1);
    let corner = vec2i(floor(first));
    let part = first - floor(first);
    // A wider filter looks further along a surface that slopes, which is not to shadow itself.
    let cosine = clamp(-dot(normal, light.axis), 0.2, 1.0);
    let further = 0.5 * (f32(max(looks, 3)) - 3.0);
    let depth = seen.depth - texel * (0.5 + further * sqrt(1.0 - cosine * cosine) / cosine);
    var sum = 0.0;
    for (var j = 0; j <= looks; j++) {
        var row = 0.0;
        for (var i = 0; i <= looks; i++) {
            row += share(i, looks, part.x) * compared(light, corner + vec2i(i, j), side, depth);
        }
        sum += share(j, looks, part.y) * row;
    }
    return sum / f32(looks * looks);
}

fn share(i: i32, last: i32, part: f32) -> f32 {
    if i == 0 {
        return 1.0 - part;
    }
    return select(1.0, part, i == last);
}

// T(s), from the point moved a millimetre inwards.
fn transmitted(light: Lamp, position: vec3f, normal: vec3f) -> vec3f {
    let side = i32(textureDimensions(shadow_maps).x);
    let seen = see(light, position - normal * transport.millimetre, f32(side));
    // Nothing comes through outside of the map.
    if !(seen.depth > 0.0 && all(seen.place >= vec2f(0.0)) && all(seen.place < vec2f(f32(side)))) {
        return vec3f(0.0);
    }
    let s = transport.thickness * abs(seen.depth - stored_between(light, seen.place - 0.5, side));
    var sum = vec3f(0.0);
    for (var i = 0; i < 6; i++) {
        let gaussian = transport.profile[i];
        sum += gaussian.rgb * exp(s * s * gaussian.a);
    }
    return sum;
}

// The depth between four texels of a shadow map; at the border the outermost go on.
fn stored_between(light: Lamp, place: vec2f, side: i32) -> f32 {
    let low = floor(place);
    let part = place - low;
    let a = clamp(vec2i(low), vec2i(0), vec2i(side - 1));
    let b = clamp(vec2i(low) + 1, vec2i(0), vec2i(side - 1));
    let upper = mixed(stored(light, a), stored(light, vec2i(b.x, a.y)), part.x);
    let lower = mixed(stored(light, vec2i(a.x, b.y)), stored(light, b), part.x);
    return mixed(upper, lower, part.y);
}

fn mixed(a: f32, b: f32, part: f32) -> f32 {
    return a + part * (b - a);
}

// I without its colour: (D₀/D)² and the cone's fade.
fn arriving(light: Lamp, distance: f32, direction: vec3f) -> f32 {
    let inside = -dot(direction, light.axis);
    if !(inside > light.cos_outer) {
        return 0.0;
    }
    let part = (inside - light.cos_outer) / (light.cos_inner - light.cos_outer);
    let fade = select(part * part * (3.0 - 2.0 * part), 1.0, !(part < 1.0));
    let near = min(light.distance / distance, 1e6);
    return near * near * fade;
}

// Beckmann's distribution, looked up between u = 1/(1 + tan²α/m²) and m²; the table holds m² D.
fn beckmann_at(cos_half: f32, roughness: f32) -> f32 {
    let m = clamp(roughness, LEAST_ROUGHNESS, 1.0);
    let c = saturate(cos_half);
    let m2 = m * m;
    let c2 = c * c;
    let x = c2 * m2 / (c2 * m2 + 1.0 - c2) * f32(BECKMANN_WIDTH - 1);
    let y = m2 * f32(BECKMANN_HEIGHT - 1);
    let i = min(u32(x), BECKMANN_WIDTH - 2);
    let j = min(u32(y), BECKMANN_HEIGHT - 2);
    let at = j * BECKMANN_WIDTH + i;
    let low = mixed(beckmann[at], beckmann[at + 1], x - f32(i));
    let high = mixed(beckmann[at + BECKMANN_WIDTH], beckmann[at + BECKMANN_WIDTH + 1], x - f32(i));
    return mixed(low, high, y - f32(j)) / m2;
}

// Kelemen and Szirmay-Kalos' reflectance, with Schlick's Fresnel term.
fn reflected(normal: vec3f, view: vec3f, direction: vec3f, roughness: f32, r0: f32) -> f32 {
    let between = direction + view;
    let square = dot(between, between);
    let half = between * inverseSqrt(square);
    let cos_half = dot(normal, half);
    // Also where the light comes from right behind, and there is no half-way direction.
    if !(cos_half > 0.0) {
        return 0.0;
    }
    let away = 1.0 - saturate(dot(view, half));
    let fresnel = r0 + (1.0 - r0) * (away * away * away * away * away);
    return beckmann_at(cos_half, roughness) * fresnel / square;
}
