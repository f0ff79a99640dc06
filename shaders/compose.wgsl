// The picture: diffuse and specular light together, as sRGB bytes, before the background.

struct Backdrop {
    // sRGB, a whole number of 255ths.
    color: vec4f,
    // Width and height of the frame.
    size: vec2u,
    // Tiles from left to right.
    across: u32,
    unused: u32,
}

@group(0) @binding(0) var<uniform> backdrop: Backdrop;
@group(0) @binding(1) var diffuse: texture_2d<f32>;
@group(0) @binding(2) var specular: texture_2d<f32>;
@group(0) @binding(3) var depths: texture_2d<f32>;

// The tiles that hold any surface; the others were cleared to the background.
@group(1) @binding(0) var<storage, read> tiles: array<u32>;

override SPECULAR: bool;

// Nothing is farther.
const NOTHING = 1e30;

@vertex
fn cover(@builtin(vertex_index) corner: u32, @builtin(instance_index) instance: u32) -> @builtin(position) vec4f {
    return tile_corner(tiles[instance], corner, backdrop.across, backdrop.size);
}

// Rounded here, since devices differ in how they do it.
fn byte(light: f32) -> f32 {
    return floor(srgb_encode(light) * 255.0 + 0.5) / 255.0;
}

@fragment
fn compose(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(position.xy);
    if textureLoad(depths, pixel, 0).r >= NOTHING {
        return backdrop.color;
    }
    var light = textureLoad(diffuse, pixel, 0).rgb;
    if SPECULAR {
        light += textureLoad(specular, pixel, 0).rgb;
    }
    return vec4f(byte(light.r), byte(light.g), byte(light.b), 1.0);
}
