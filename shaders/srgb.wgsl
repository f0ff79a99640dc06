// sRGB (IEC 61966-2-1), one channel.

fn srgb_decode(value: f32) -> f32 {
    let v = saturate(value);
    return select(pow((v + 0.055) / 1.055, 2.4), v / 12.92, v <= 0.04045);
}

fn srgb_encode(light: f32) -> f32 {
    let l = saturate(light);
    return select(1.055 * pow(l, 1.0 / 2.4) - 0.055, 12.92 * l, l <= 0.0031308);
}
