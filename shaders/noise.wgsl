// Perlin's and simplex noise in two dimensions without tables (Gustavson and McEwan 2012), and fractional Brownian motion over the latter.
// Operation by operation that of the CPU.

struct Fbm {
    octaves: u32,
    frequency: f32,
    amplitude: f32,
    lacunarity: f32,
    persistence: f32,
}

fn modulo_289(x: f32) -> f32 {
    return x - floor(x * (1.0 / 289.0)) * 289.0;
}

// The lattice's hash of an integer below 289.
fn permuted(x: f32) -> f32 {
    return modulo_289((x * 34.0 + 1.0) * x);
}

// A gradient, at one of 41 places of a diamond.
fn gradient(hash: f32) -> vec2f {
    let x = fract(hash * (1.0 / 41.0)) * 2.0 - 1.0;
    return vec2f(x - floor(x + 0.5), abs(x) - 0.5);
}

// About 1/√r², near what gradients measure.
fn inverse_root(r2: f32) -> f32 {
    return 1.79284291400159 - 0.85373472095314 * r2;
}

fn dot2(a: vec2f, b: vec2f) -> f32 {
    return a.x * b.x + a.y * b.y;
}

// What the lattice's corner contributes to Perlin's noise at a place this far from it.
fn slope(corner: vec2f, away: vec2f) -> f32 {
    let g = gradient(permuted(permuted(modulo_289(corner.x)) + modulo_289(corner.y)));
    return inverse_root(dot2(g, g)) * dot2(g, away);
}

fn perlin(p: vec2f) -> f32 {
    let cell = floor(p);
    let at = p - cell;
    let n00 = slope(cell, at);
    let n10 = slope(cell + vec2f(1.0, 0.0), at - vec2f(1.0, 0.0));
    let n01 = slope(cell + vec2f(0.0, 1.0), at - vec2f(0.0, 1.0));
    let n11 = slope(cell + vec2f(1.0, 1.0), at - vec2f(1.0, 1.0));
    let fade = at * at * at * (at * (at * 6.0 - 15.0) + 10.0);
    let near = n00 + (n10 - n00) * fade.x;
    let far = n01 + (n11 - n01) * fade.x;
    return 2.3 * (near + (far - near) * fade.y);
}

// What a simplex's corner contributes at a place this far from it.
fn kernel(corner: vec2f, away: vec2f) -> f32 {
    let g = gradient(permuted(permuted(corner.y) + corner.x));
    let m = max(0.5 - dot2(away, away), 0.0);
    return m * m * m * m * inverse_root(dot2(g, g)) * dot2(g, away);
}

fn simplex(p: vec2f) -> f32 {
    const SKEW = 0.366025403784439; // (√3 − 1)/2
    const UNSKEW = 0.211324865405187; // (3 − √3)/6
    let cell = floor(p + (p.x + p.y) * SKEW);
    let first = p - cell + (cell.x + cell.y) * UNSKEW;
    let middle = select(vec2f(0.0, 1.0), vec2f(1.0, 0.0), first.x > first.y);
    let second = first + UNSKEW - middle;
    let third = first + (2.0 * UNSKEW - 1.0);
    let corner = vec2f(modulo_289(cell.x), modulo_289(cell.y));
    return 130.0 * (kernel(corner, first) + kernel(corner + middle, second) + kernel(corner + 1.0, third));
}

fn fbm(p: vec2f, noise: Fbm) -> f32 {
    var sum = 0.0;
    var frequency = noise.frequency;
    var amplitude = noise.amplitude;
    for (var octave = 0u; octave < noise.octaves; octave++) {
        sum += simplex(p * frequency) * amplitude;
        frequency *= noise.lacunarity;
        amplitude *= noise.persistence;
    }
    return sum;
}

// 0 … 1 as 0 … 255, to the nearest.
fn byte(value: f32) -> u32 {
    return u32(clamp(value, 0.0, 1.0) * 255.0 + 0.5);
}
