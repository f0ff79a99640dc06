// Perlin's and simplex noise in two dimensions without tables (Gustavson and McEwan 2012), and fractional Brownian motion over the latter.
// Operation by operation that of the CPU.

// How many noises are added. A constant of the pipeline, so that the loop is unrolled.
override OCTAVES: u32;

struct Fbm {
    frequency: f32,
    amplitude: f32,
    lacunarity: f32,
    persistence: f32,
}

// An integer's remainder by 289. Half a step off the integers, so that no rounding makes 289 of 0.
fn remainder(x: f32) -> f32 {
    return x - floor((x + 0.5) * (1.0 / 289.0)) * 289.0;
}

// The lattice's hash of an integer below 289.
fn permuted(x: f32) -> f32 {
    return remainder((34.0 * x + 1.0) * x);
}

// The gradient of a hash, one of 41 on a diamond made about unit length, times the way from its lattice point.
fn slope(hash: f32, away: vec2f) -> f32 {
    let place = 2.0 * fract(hash / 41.0) - 1.0;
    let x = place - floor(place + 0.5);
    let y = abs(place) - 0.5;
    let unit = 1.79284291400159 - 0.85373472095314 * (x * x + y * y);
    return unit * (x * away.x + y * away.y);
}

// What a corner of a cell, by its coordinates, contributes to Perlin's noise this far from it.
fn perlin_corner(corner: vec2f, away: vec2f) -> f32 {
    return slope(permuted(permuted(remainder(corner.x)) + remainder(corner.y)), away);
}

fn linear(a: f32, b: f32, t: f32) -> f32 {
    return a + (b - a) * t;
}

fn perlin(p: vec2f) -> f32 {
    let cell = floor(p);
    let at = p - cell;
    let n00 = perlin_corner(cell, at);
    let n10 = perlin_corner(cell + vec2f(1.0, 0.0), at - vec2f(1.0, 0.0));
    let n01 = perlin_corner(cell + vec2f(0.0, 1.0), at - vec2f(0.0, 1.0));
    let n11 = perlin_corner(cell + vec2f(1.0, 1.0), at - vec2f(1.0, 1.0));
    let fade = at * at * at * (at * (at * 6.0 - 15.0) + 10.0);
    return 2.3 * linear(linear(n00, n10, fade.x), linear(n01, n11, fade.x), fade.y);
}

// What a corner of a simplex, by its remainders, contributes this far from it.
fn simplex_corner(corner: vec2f, away: vec2f) -> f32 {
    let weight = max(0.5 - (away.x * away.x + away.y * away.y), 0.0);
    let square = weight * weight;
    return square * square * slope(permuted(permuted(corner.y) + corner.x), away);
}

fn simplex(p: vec2f) -> f32 {
    const SKEW = 0.366025403784439; // (√3 − 1)/2
    const UNSKEW = 0.211324865405187; // (3 − √3)/6
    let cell = floor(p + (p.x + p.y) * SKEW);
    let first = p - cell + (cell.x + cell.y) * UNSKEW;
    let middle = select(vec2f(0.0, 1.0), vec2f(1.0, 0.0), first.x > first.y);
    let second = first - middle + UNSKEW;
    let third = first - 1.0 + 2.0 * UNSKEW;
    let corner = vec2f(remainder(cell.x), remainder(cell.y));
    let sum = simplex_corner(corner, first) + simplex_corner(corner + middle, second);
    return 130.0 * (sum + simplex_corner(corner + 1.0, third));
}

fn fbm(p: vec2f, noise: Fbm) -> f32 {
    var sum = 0.0;
    var frequency = noise.frequency;
    var amplitude = noise.amplitude;
    for (var octave = 0u; octave < OCTAVES; octave++) {
        sum += amplitude * simplex(p * frequency);
        frequency *= noise.lacunarity;
        amplitude *= noise.persistence;
    }
    return sum;
}

// 0 … 1 as 0 … 255, to the nearest.
fn byte(value: f32) -> u32 {
    return u32(clamp(value, 0.0, 1.0) * 255.0 + 0.5);
}
