// PP: the patch and the discoloration, texel by texel over the tiles that may change (Lam 2016, §5.3.2 and §5.4).

struct Paint {
    // c_l and c_h.
    length: f32,
    height: f32,
    // m, and o.
    noise_scale: f32,
    unused: u32,
    offset: vec2f,
    patch_size: vec2u,
    // What the discoloration leaves of each channel.
    factor: vec4f,
    noise: Fbm,
}

// A tile: where its first texel lies on the map and on the target of `place`, its width and height, and where its texels
// are saved, words: the first of each map, and from row to row.
struct Tile {
    map_origin: vec2u,
    target_origin: vec2u,
    size: vec2u,
    saved_color: u32,
    saved_discolor: u32,
    stride: u32,
    unused: u32,
}

// The triangles stand in `place`.
@group(0) @binding(3) var<uniform> job: Paint;
@group(0) @binding(4) var<storage, read> tiles: array<Tile>;
@group(0) @binding(5) var<storage, read> wound: array<u32>;
@group(0) @binding(6) var<storage, read> saved: array<u32>;
@group(0) @binding(7) var placed: texture_2d<u32>;
@group(0) @binding(8) var color_map: texture_storage_2d<rgba8unorm, write>;
@group(0) @binding(9) var discolor_map: texture_storage_2d<rgba8unorm, write>;

fn unpacked(texel: u32) -> vec4f {
    return vec4f(vec4u(texel, texel >> 8u, texel >> 16u, texel >> 24u) & vec4u(255u)) * (1.0 / 255.0);
}

fn wound_texel(x: u32, y: u32) -> vec4f {
    return unpacked(wound[y * job.patch_size.x + x]);
}

// The patch at a place of the unit square, bilinear.
fn sampled(at: vec2f) -> vec4f {
    let place = at * vec2f(job.patch_size - 1u);
    let low = min(vec2u(place), job.patch_size - 2u);
    let part = place - vec2f(low);
    let top = mix2(wound_texel(low.x, low.y), wound_texel(low.x + 1u, low.y), part.x);
    let bottom = mix2(wound_texel(low.x, low.y + 1u), wound_texel(low.x + 1u, low.y + 1u), part.x);
    return mix2(top, bottom, part.y);
}

fn mix2(a: vec4f, b: vec4f, t: f32) -> vec4f {
    return a + (b - a) * t;
}

// The colour map's texel with the patch over it.
fn colored(below: vec4f, s: f32, d: f32) -> vec4f {
    let at = vec2f(0.025 + 0.95 * s / job.length, 0.5 - d / job.height);
    if any(at < vec2f(0.0)) || any(at > vec2f(1.0)) {
        return below;
    }
    let over = sampled(at);
    return vec4f(over.rgb + (1.0 - over.a) * below.rgb, below.a);
}

// How much is discoloured.
fn discolored(s: f32, d: f32) -> f32 {
    let t = 2.0 * clamp(s / job.length, 0.0, 1.0) - 1.0;
    let range = 0.5 * job.height * (1.0 - 0.5 * t * t);
    let aside = s - clamp(s, 0.0, job.length);
    let distance = sqrt(aside * aside + d * d);
    let rest = 1.0 - distance / (2.0 * range);
    if !(rest > 0.0) {
        return 0.0;
    }
    let noise = fbm(vec2f(s, d) * job.noise_scale + job.offset, job.noise);
    return clamp(noise, 0.0, rest) + max(0.0, 1.1 - distance / range);
}

// To the nearest of 0 … 255, so that storing rounds nothing.
fn rounded(texel: vec4f) -> vec4f {
    return floor(clamp(texel, vec4f(0.0), vec4f(1.0)) * 255.0 + 0.5) * (1.0 / 255.0);
}

// (s, d) at the centre of a texel.
fn surface(triangle: Triangle, texel: vec2u) -> vec2f {
    let away = vec2f(texel) + 0.5 - triangle.a;
    return triangle.value + (triangle.across * away.x + triangle.down * away.y);
}

@compute @workgroup_size(16, 16)
fn compute(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_id) local: vec3u) {
    let tile = tiles[group.z];
    let at = group.xy * 16u + local.xy;
    if any(at >= tile.size) {
        return;
    }
    let number = textureLoad(placed, tile.target_origin + at, 0).r;
    if number == 0u {
        return;
    }
    let texel = tile.map_origin + at;
    let place = surface(triangles[number - 1u], texel);
    let word = at.y * tile.stride + at.x;
    let color = colored(unpacked(saved[tile.saved_color + word]), place.x, place.y);
    textureStore(color_map, texel, rounded(color));
    let strength = byte(discolored(place.x, place.y));
    if strength > saved[tile.saved_discolor + word] >> 24u {
        textureStore(discolor_map, texel, rounded(vec4f(0.5 * job.factor.rgb, f32(strength) * (1.0 / 255.0))));
    }
}
