// Separable scattering of diffuse light, across or down (Jimenez et al. 2012; Lam 2016, B.2.1.2 and §5.4), tile by tile.

struct Reach {
    // Width and height of the frame.
    size: vec2i,
    // Tiles from left to right.
    across: u32,
    // How many taps.
    count: u32,
    // Pixels in the look's width at depth 1.
    pixels: f32,
    // The same on the surface, model units.
    width: f32,
    unused: vec2u,
}

@group(0) @binding(0) var<uniform> reach: Reach;
@group(0) @binding(1) var light: texture_2d<f32>;
@group(0) @binding(2) var depths: texture_2d<f32>;
@group(0) @binding(3) var discolor: texture_2d<f32>;
// The kernel: weights, and beside them the offset as a part of the width.
@group(0) @binding(4) var<uniform> taps: array<vec4f, 41>;
@group(1) @binding(0) var<storage, read> tiles: array<u32>;

// The second pass.
override DOWN: bool;
// Mind the discoloration.
override LOCALIZED: bool;

@vertex
fn cover(@builtin(vertex_index) corner: u32, @builtin(instance_index) instance: u32) -> @builtin(position) vec4f {
    return tile_corner(tiles[instance], corner, reach.across, vec2u(reach.size));
}

// A place along the pass, at the pixel's own place across it.
fn along(pixel: vec2i, place: i32) -> vec2i {
    if DOWN {
        return vec2i(pixel.x, place);
    }
    return vec2i(place, pixel.y);
}

@fragment
fn scatter(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(position.xy);
    let own = textureLoad(light, pixel, 0);
    if own.a == 0.0 {
        return own;
    }
    let depth = textureLoad(depths, pixel, 0).r;
    var start = pixel.x;
    var last = reach.size.x - 1;
    if DOWN {
        start = pixel.y;
        last = reach.size.y - 1;
    }
    // Bounded, so that its product with any offset is a number.
    let step = min(own.a * reach.pixels / depth, 1e9);
    let middle = reach.count / 2;
    var sum = vec3f(0.0);
    for (var i = 0u; i < reach.count; i++) {
        let tap = taps[i];
        if i == middle {
            sum += tap.rgb * (own.rgb * kept(pixel));
            continue;
        }
        let place = clamp(f32(start) + tap.a * step, 0.0, f32(last));
        let first = i32(place);
        let a = textureLoad(light, along(pixel, first), 0).rgb;
        let b = textureLoad(light, along(pixel, min(first + 1, last)), 0).rgb;
        let there = textureLoad(depths, along(pixel, i32(place + 0.5)), 0).r;
        let apart = saturate(abs(depth - there) / reach.width);
        let color = a + (place - f32(first)) * (b - a);
        sum += tap.rgb * (color + apart * (own.rgb - color));
    }
    return vec4f(held(sum), own.a);
}

// What the discoloration leaves of the centre's weight: 1 + α(2 c − 1).
fn kept(pixel: vec2i) -> vec3f {
    if !LOCALIZED {
        return vec3f(1.0);
    }
    let there = textureLoad(discolor, pixel, 0);
    return 1.0 + there.a * (2.0 * there.rgb - 1.0);
}
