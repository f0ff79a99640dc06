// The skin pass: what is seen at each pixel, what it is made of, and what light leaves it. See `canvas::frame`.

struct Scene {
    eye: vec3f,
    light_count: u32,
    // Through the centre of the first pixel; and what a pixel to the right or down adds.
    ray: vec3f,
    // Tiles from left to right.
    across: u32,
    ray_across: vec3f,
    unused: f32,
    ray_down: vec3f,
    padding: f32,
    // Width and height of the frame.
    size: vec2u,
    spare: vec2u,
    // Depth along the view's axis: dot(forward.xyz, position) + forward.w.
    forward: vec4f,
    // Linear, where there is no colour map.
    albedo: vec3f,
    bumpiness: f32,
    // Where there is no specular map.
    intensity: f32,
    roughness: f32,
    // k_spec.
    specular: f32,
    // R₀.
    reflectance: f32,
    // E times L_A: nine harmonics.
    irradiance: array<vec4f, 9>,
    // The inside of a cut, sRGB: rim, middle, bottom.
    tissue: array<vec4f, 3>,
}

@group(0) @binding(0) var<uniform> scene: Scene;
@group(1) @binding(2) var color_map: texture_2d<f32>;
@group(1) @binding(3) var normal_map: texture_2d<f32>;
@group(1) @binding(4) var occlusion_map: texture_2d<f32>;
@group(1) @binding(5) var specular_map: texture_2d<f32>;
@group(1) @binding(6) var discolor_map: texture_2d<f32>;

@group(2) @binding(0) var faces: texture_2d<u32>;
// 15 words a vertex.
@group(2) @binding(1) var<storage, read> vertices: array<f32>;
@group(2) @binding(2) var<storage, read> corners: array<u32>;
// The tiles that hold any surface.
@group(2) @binding(3) var<storage, read> tiles: array<u32>;

// What is switched off is not compiled.
override SHADOWS: bool;
override TRANSMITTANCE: bool;
override SPECULAR: bool;
override COLOR_MAP: bool;
override NORMAL_MAP: bool;
override OCCLUSION_MAP: bool;
override SPECULAR_MAP: bool;
override DISCOLORATION: bool;

// `Surface::Gutter`.
const GUTTER = 1u;

// A vertex, as the words of its floats; the last one is a whole number.
struct Vertex {
    position: vec3f,
    uv: vec2f,
    normal: vec3f,
    tangent: vec3f,
    bitangent: vec3f,
    surface: u32,
}

struct Point {
    position: vec3f,
    uv: vec2f,
    normal: vec3f,
    tangent: vec3f,
    bitangent: vec3f,
    surface: u32,
    // Whether it is seen from outside.
    front: bool,
}

@vertex
fn cover(@builtin(vertex_index) corner: u32, @builtin(instance_index) instance: u32) -> @builtin(position) vec4f {
    return tile_corner(tiles[instance], corner, scene.across, scene.size);
}

fn vector(at: u32) -> vec3f {
    return vec3f(vertices[at], vertices[at + 1], vertices[at + 2]);
}

fn vertex(id: u32) -> Vertex {
    let at = 15u * id;
    let uv = vec2f(vertices[at + 3], vertices[at + 4]);
    let surface = bitcast<u32>(vertices[at + 14]);
    return Vertex(vector(at), uv, vector(at + 5), vector(at + 8), vector(at + 11), surface);
}

// What the ray through a pixel's centre meets of a face (Möller and Trumbore 1997). Work is done from the face's own corner, which f32 is
// enough for.
fn meet(face: u32, pixel: vec2u) -> Point {
    let a = vertex(corners[3 * face]);
    let b = vertex(corners[3 * face + 1]);
    let c = vertex(corners[3 * face + 2]);
    let ray = scene.ray + f32(pixel.x) * scene.ray_across + f32(pixel.y) * scene.ray_down;
    let ab = b.position - a.position;
    let ac = c.position - a.position;
    let away = scene.eye - a.position;
    let p = cross(ray, ac);
    let q = cross(away, ab);
    let area = dot(ab, p);
    let w = weights(dot(away, p) / area, dot(ray, q) / area);
    return Point(
        w.x * a.position + w.y * b.position + w.z * c.position,
        w.x * a.uv + w.y * b.uv + w.z * c.uv,
        w.x * a.normal + w.y * b.normal + w.z * c.normal,
        w.x * a.tangent + w.y * b.tangent + w.z * c.tangent,
        w.x * a.bitangent + w.y * b.bitangent + w.z * c.bitangent,
        a.surface,
        dot(cross(ab, ac), away) > 0.0,
    );
}

// Kept within the face, which its corners' rounding to 1/256 of a pixel may reach beyond.
fn weights(v: f32, w: f32) -> vec3f {
    let inside = saturate(vec3f(1.0 - v - w, v, w));
    let sum = inside.x + inside.y + inside.z;
    // A face that is seen as a line: anywhere on it will do.
    return select(vec3f(1.0 / 3.0), inside / sum, sum > 0.5 && sum < 4.0);
}

// What the surface is made of at a point.
struct Material {
    albedo: vec3f,
    // a.
    scattering: f32,
    // k_A.
    occlusion: f32,
    intensity: f32,
    roughness: f32,
    // n.
    normal: vec3f,
    // c and α.
    discolor: vec4f,
}

fn unit(v: vec3f, otherwise: vec3f) -> vec3f {
    let square = dot(v, v);
    return select(otherwise, v * inverseSqrt(square), square > 1e-30);
}

fn skin_at(point: Point, normal: vec3f) -> Material {
    var skin = Material(scene.albedo, 1.0, 1.0, scene.intensity, scene.roughness, normal, vec4f(0.0));
    if COLOR_MAP {
        let color = sample_srgb(color_map, point.uv);
        skin.albedo = color.rgb;
        skin.scattering = color.a;
    }
    if OCCLUSION_MAP {
        skin.occlusion = sample_plain(occlusion_map, point.uv).r;
    }
    if SPECULAR_MAP {
        let specular = sample_plain(specular_map, point.uv);
        skin.intensity = specular.r;
        skin.roughness = specular.g;
    }
    if NORMAL_MAP {
        let aside = sample_signed(normal_map, point.uv).xy;
        let height = sqrt(max(0.0, 1.0 - dot(aside, aside)));
        let bump = (aside.x * point.tangent + aside.y * point.bitangent) * scene.bumpiness;
        skin.normal = unit(bump + height * normal, normal);
    }
    if DISCOLORATION {
        skin.discolor = sample_plain(discolor_map, point.uv);
    }
    return skin;
}

// The inside of a cut, from its rim, v = 1, to its bottom.
fn tissue_at(point: Point, normal: vec3f) -> Material {
    let v = saturate(point.uv.y);
    let upper = mix(scene.tissue[1].rgb, scene.tissue[0].rgb, 2.0 * v - 1.0);
    let lower = mix(scene.tissue[2].rgb, scene.tissue[1].rgb, 2.0 * v);
    let color = select(lower, upper, v > 0.5);
    let albedo = vec3f(srgb_decode(color.r), srgb_decode(color.g), srgb_decode(color.b));
    return Material(albedo, 0.0, 0.25 + 0.75 * v, scene.intensity, scene.roughness, normal, vec4f(0.0));
}

// E(n), times L_A.
fn irradiated(n: vec3f) -> vec3f {
    let e = scene.irradiance;
    let sum = e[0] + e[1] * n.y + e[2] * n.z + e[3] * n.x + e[4] * (n.x * n.y) + e[5] * (n.y * n.z)
        + e[6] * (3.0 * n.z * n.z - 1.0) + e[7] * (n.x * n.z) + e[8] * (n.x * n.x - n.y * n.y);
    return max(sum.rgb, vec3f(0.0));
}

struct Leaving {
    diffuse: vec3f,
    specular: vec3f,
}

fn lit(light: Lamp, position: vec3f, normal: vec3f, view: vec3f, material: Material) -> Leaving {
    var leaving = Leaving(vec3f(0.0), vec3f(0.0));
    let to = light.position - position;
    let distance = length(to);
    let direction = to / distance;
    let arrives = light.color * arriving(light, distance, direction);
    if all(arrives == vec3f(0.0)) {
        return leaving;
    }
    let facing = dot(material.normal, direction);
    if facing > 0.0 {
        var light_there = arrives * facing;
        if SHADOWS {
            light_there *= shadowed(light, position, normal);
        }
        leaving.diffuse = material.albedo * light_there;
        if SPECULAR {
            let part = reflected(material.normal, view, direction, material.roughness, scene.reflectance);
            leaving.specular = light_there * (scene.specular * material.intensity * part);
        }
    }
    if TRANSMITTANCE {
        let wrapped = saturate(0.3 - dot(normal, direction));
        if wrapped > 0.0 {
            leaving.diffuse += material.albedo * arrives * transmitted(light, position, normal) * wrapped;
        }
    }
    return leaving;
}

struct Pixel {
    // a beside it.
    @location(0) diffuse: vec4f,
    @location(1) depth: f32,
    @location(2) specular: vec4f,
    @location(3) discolor: vec4f,
}

// No face, and farther than any.
const NOTHING = 0xffffffffu;
const FAR = 1e30;

@fragment
fn shade(@builtin(position) place: vec4f) -> Pixel {
    let pixel = vec2u(place.xy);
    let face = textureLoad(faces, pixel, 0).r;
    if face == NOTHING {
        return Pixel(vec4f(0.0), FAR, vec4f(0.0), vec4f(0.0));
    }
    let point = meet(face, pixel);
    let outward = unit(point.normal, vec3f(0.0, 1.0, 0.0));
    let normal = select(-outward, outward, point.front);
    let view = unit(scene.eye - point.position, vec3f(0.0));
    var material: Material;
    if point.surface == GUTTER {
        material = tissue_at(point, normal);
    } else {
        material = skin_at(point, normal);
    }
    var diffuse = material.albedo * (material.occlusion * irradiated(material.normal));
    var specular = vec3f(0.0);
    for (var i = 0u; i < scene.light_count; i++) {
        let leaving = lit(lights[i], point.position, normal, view, material);
        diffuse += leaving.diffuse;
        specular += leaving.specular;
    }
    let depth = dot(scene.forward.xyz, point.position) + scene.forward.w;
    return Pixel(
        vec4f(held(diffuse), material.scattering),
        depth,
        vec4f(held(specular), 0.0),
        material.discolor,
    );
}
