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

// How many faults are told.
const FAULTS = 16u;

// A texel whose (s, d) are no numbers.
struct Fault {
    texel: vec2u,
    place: vec2f,
}

struct Faults {
    count: atomic<u32>,
    unused: u32,
    first: array<Fault, FAULTS>,
}

// The triangles stand in `place`.
@group(0) @binding(3) var<uniform> job: Paint;
@group(0) @binding(4) var<storage, read> tiles: array<Tile>;
@group(0) @binding(5) var<storage, read> wound: array<u32>;
@group(0) @binding(6) var<storage, read> saved: array<u32>;
@group(0) @binding(7) var placed: texture_2d<u32>;
@group(0) @binding(8) var color_map: texture_storage_2d<rgba8unorm, write>;
@group(0) @binding(9) var discolor_map: texture_storage_2d<rgba8unorm, write>;
@group(0) @binding(10) var<storage, read_write> faults: Faults;

fn unpacked(texel: u32) -> vec4f {
    return vec4f(vec4u(texel, texel >> 8u, texel >> 16u, texel >> 24u) & vec4u(255u));
}

fn wound_texel(x: u32, y: u32) -> vec4f {
    return unpacked(wound[y * job.patch_size.x + x]);
}

// The patch at a place of the unit square, bilinear, in 1/255.
fn bilinear(at: vec2f) -> vec4f {
    let last = job.patch_size - 1u;
    let place = at * vec2f(last);
    let first = min(vec2u(place), last);
    let next = min(first + 1u, last);
    let part = place - vec2f(first);
    let upper_left = wound_texel(first.x, first.y);
    let lower_left = wound_texel(first.x, next.y);
    let upper = upper_left + (wound_texel(next.x, first.y) - upper_left) * part.x;
    let lower = lower_left + (wound_texel(next.x, next.y) - lower_left) * part.x;
    return upper + (lower - upper) * part.y;
}

// The colour map's texel with the patch over it, in 1/255.
fn colored(under: vec4f, s: f32, d: f32) -> vec4f {
    let at = vec2f(0.025 + 0.95 * s / job.length, 0.5 - d / job.height);
    // A NaN is not within.
    if !(all(at >= vec2f(0.0)) && all(at <= vec2f(1.0))) {
        return under;
    }
    let over = bilinear(at);
    return vec4f(over.rgb + (1.0 - over.a / 255.0) * under.rgb, under.a);
}

// α of the discoloration.
fn strength(s: f32, d: f32) -> f32 {
    let t = 2.0 * clamp(s / job.length, 0.0, 1.0) - 1.0;
    let radius = 0.5 * job.height * (1.0 - 0.5 * t * t);
    let beyond = max(max(-s, s - job.length), 0.0);
    let distance = sqrt(beyond * beyond + d * d);
    let most = 1.0 - distance / (2.0 * radius);
    if !(most > 0.0) {
        return 0.0;
    }
    let core = max(1.1 - distance / radius, 0.0);
    if core >= 1.0 {
        // Whatever the noise adds.
        return 1.0;
    }
    let noise = fbm(job.noise_scale * vec2f(s, d) + job.offset, job.noise);
    return min(max(noise, 0.0), most) + core;
}

// 0 … 255 to the nearest as 0 … 1, so that storing rounds nothing.
fn rounded(texel: vec4f) -> vec4f {
    return min(floor(texel + 0.5), vec4f(255.0)) / 255.0;
}

// (s, d) at the centre of a texel.
fn surface(triangle: Triangle, texel: vec2u) -> vec2f {
    let away = vec2f(texel) + 0.5 - triangle.a;
    return triangle.value + (triangle.across * away.x + triangle.down * away.y);
}

// By its bits: compilers may take it that there are only numbers.
fn is_finite(p: vec2f) -> bool {
    return all((bitcast<vec2u>(p) & vec2u(0x7f800000u)) != vec2u(0x7f800000u));
}

fn note_fault(texel: vec2u, place: vec2f) {
    let number = atomicAdd(&faults.count, 1u);
    if number < FAULTS {
        faults.first[number] = Fault(texel, place);
    }
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
    if !is_finite(place) {
        note_fault(texel, place);
        return;
    }
    let word = at.y * tile.stride + at.x;
    let color = colored(unpacked(saved[tile.saved_color + word]), place.x, place.y);
    textureStore(color_map, texel, rounded(color));
    let alpha = byte(strength(place.x, place.y));
    if alpha > saved[tile.saved_discolor + word] >> 24u {
        let factor = vec3u(byte(0.5 * job.factor.r), byte(0.5 * job.factor.g), byte(0.5 * job.factor.b));
        textureStore(discolor_map, texel, vec4f(vec4u(factor, alpha)) / 255.0);
    }
}
