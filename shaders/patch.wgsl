// GP: the wound patch of a cut, texel by texel (Lam 2016, §5.3.1). Texels are packed bytes, red lowest, alpha multiplied in.

struct Patch {
    size: vec2u,
    offset: vec2f,
    inner: vec4f,
    dark: vec4f,
    light: vec4f,
    edge: vec2f,
    unused: vec2u,
    noise: Fbm,
}

@group(0) @binding(0) var<uniform> job: Patch;
@group(0) @binding(1) var<storage, read_write> texels: array<u32>;

const FADE = 0.05;

// How far the inner layer reaches from the middle.
fn inner_range(x: f32, X2: f32) -> f32 {
    let noise = perlin(vec2f((x + job.offset.x) * job.edge.x, 0.5));
    return max(job.edge.y * noise, FADE) * (0.45 - 0.5 * X2);
}

// A texel, between the inner layer's colour and the outer one's at some y, times alpha.
struct Blend {
    y: f32,
    outer: f32,
    alpha: f32,
}

// What of it is there. The outer layer's colour is wanted at one place at most, so that its noise is worked out once.
fn blended(x: f32, y: f32) -> Blend {
    let X = 2.0 * x - 1.0;
    let X2 = X * X;
    let D = abs(y - 0.5);
    let side = select(-1.0, 1.0, y > 0.5);
    let solid = inner_range(x, X2);
    let faded = (solid + FADE) * (1.0 - X2);
    let ends = abs(x - 0.5) < 0.475;
    if ends && D < solid {
        return Blend(y, 0.0, 1.0);
    }
    if ends && D < faded {
        return Blend(0.5 + side * faded, (D - solid) / (faded - solid), 1.0);
    }
    let outer = 0.25 - 0.3 * (X2 * X2);
    if D < outer {
        return Blend(y, 1.0, 1.0);
    }
    if D < outer + FADE {
        return Blend(0.5 + side * outer, 1.0, 1.0 - (D - outer) / FADE);
    }
    return Blend(y, 0.0, 0.0);
}

// The colour at a place of the patch, alpha multiplied in.
fn color(x: f32, y: f32) -> vec4f {
    let blend = blended(x, y);
    if blend.alpha == 0.0 || blend.outer == 0.0 {
        return job.inner * blend.alpha;
    }
    let lightness = clamp(0.5 + fbm(vec2f(x, blend.y) + job.offset, job.noise), 0.0, 1.0);
    let outer = job.dark + (job.light - job.dark) * lightness;
    let mixed = job.inner + (outer - job.inner) * blend.outer;
    return select(mixed, outer, blend.outer == 1.0) * blend.alpha;
}

@compute @workgroup_size(8, 8)
fn compute(@builtin(global_invocation_id) at: vec3u) {
    if any(at.xy >= job.size) {
        return;
    }
    let c = color(f32(at.x) / f32(job.size.x - 1u), f32(at.y) / f32(job.size.y - 1u));
    texels[at.y * job.size.x + at.x] = byte(c.r) | byte(c.g) << 8u | byte(c.b) << 16u | byte(c.a) << 24u;
}
