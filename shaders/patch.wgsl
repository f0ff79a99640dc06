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

// The outer layer's colour.
fn outer(x: f32, y: f32) -> vec4f {
    let lightness = clamp(0.5 + fbm(vec2f(x, y) + job.offset, job.noise), 0.0, 1.0);
    return job.dark + (job.light - job.dark) * lightness;
}

fn inner_range(x: f32, X2: f32) -> f32 {
    let wave = job.edge.y * perlin(vec2f((x + job.offset.x) * job.edge.x, 0.5));
    return max(wave, FADE) * (0.45 - 0.5 * X2);
}

// The colour at a place of the patch, not rounded.
fn color(x: f32, y: f32) -> vec4f {
    let X = 2.0 * x - 1.0;
    let X2 = X * X;
    let D = abs(y - 0.5);
    let side = select(-1.0, 1.0, y > 0.5);
    if abs(x - 0.5) < 0.475 {
        let solid = inner_range(x, X2);
        if D < solid {
            return job.inner;
        }
        let faded = (solid + FADE) * (1.0 - X2);
        if D < faded {
            let beyond = outer(x, 0.5 + side * faded);
            return job.inner + (beyond - job.inner) * ((D - solid) / (faded - solid));
        }
    }
    let solid = 0.25 - 0.3 * (X2 * X2);
    if D < solid {
        return outer(x, y);
    }
    if D < solid + FADE {
        return outer(x, 0.5 + side * solid) * (1.0 - (D - solid) / FADE);
    }
    return vec4f(0.0);
}

@compute @workgroup_size(8, 8)
fn compute(@builtin(global_invocation_id) at: vec3u) {
    if any(at.xy >= job.size) {
        return;
    }
    let c = color(f32(at.x) / f32(job.size.x - 1u), f32(at.y) / f32(job.size.y - 1u));
    texels[at.y * job.size.x + at.x] = byte(c.r) | byte(c.g) << 8u | byte(c.b) << 16u | byte(c.a) << 24u;
}
