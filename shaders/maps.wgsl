// Maps, sampled as `canvas::image` says: bilinear in f32 between four texels that are decoded first. No hardware filter, since
// no two of them round alike.

// What an sRGB byte is as linear light.
@group(1) @binding(0) var<storage, read> decoded: array<f32, 256>;

fn byte_of(value: f32) -> u32 {
    return u32(value * 255.0 + 0.5);
}

fn decode_srgb(texel: vec4f) -> vec4f {
    return vec4f(decoded[byte_of(texel.r)], decoded[byte_of(texel.g)], decoded[byte_of(texel.b)], texel.a);
}

// 8 bits have no middle: 128 counts as it.
fn decode_signed(texel: vec4f) -> vec4f {
    let middle = abs(texel - 128.0 / 255.0) < vec4f(0.25 / 255.0);
    return select(2.0 * texel - 1.0, vec4f(0.0), middle);
}

// The four texels around a place, and how far it is from the first to the others.
struct Around {
    first: vec2i,
    second: vec2i,
    part: vec2f,
}

fn around(uv: vec2f, size: vec2u) -> Around {
    let turned = vec2f(uv.x, 1.0 - uv.y);
    // Maps repeat: what is left is from 0 to 1, and a size more is enough to keep it positive.
    let place = (turned - floor(turned)) * vec2f(size) - 0.5;
    let low = floor(place);
    let sides = vec2i(size);
    let first = vec2i(low) + select(vec2i(0), sides, low < vec2f(0.0));
    let next = first + 1;
    return Around(first, select(next, vec2i(0), next >= sides), place - low);
}

fn between(a: vec4f, b: vec4f, c: vec4f, d: vec4f, part: vec2f) -> vec4f {
    let upper = a + part.x * (b - a);
    let lower = c + part.x * (d - c);
    return upper + part.y * (lower - upper);
}

fn sample_plain(map: texture_2d<f32>, uv: vec2f) -> vec4f {
    let at = around(uv, textureDimensions(map));
    return between(
        textureLoad(map, at.first, 0),
        textureLoad(map, vec2i(at.second.x, at.first.y), 0),
        textureLoad(map, vec2i(at.first.x, at.second.y), 0),
        textureLoad(map, at.second, 0),
        at.part,
    );
}

fn sample_srgb(map: texture_2d<f32>, uv: vec2f) -> vec4f {
    let at = around(uv, textureDimensions(map));
    return between(
        decode_srgb(textureLoad(map, at.first, 0)),
        decode_srgb(textureLoad(map, vec2i(at.second.x, at.first.y), 0)),
        decode_srgb(textureLoad(map, vec2i(at.first.x, at.second.y), 0)),
        decode_srgb(textureLoad(map, at.second, 0)),
        at.part,
    );
}

fn sample_signed(map: texture_2d<f32>, uv: vec2f) -> vec4f {
    let at = around(uv, textureDimensions(map));
    return between(
        decode_signed(textureLoad(map, at.first, 0)),
        decode_signed(textureLoad(map, vec2i(at.second.x, at.first.y), 0)),
        decode_signed(textureLoad(map, vec2i(at.first.x, at.second.y), 0)),
        decode_signed(textureLoad(map, at.second, 0)),
        at.part,
    );
}
