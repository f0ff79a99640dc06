// A light's shadow map: depth alone. 1 at its near distance, 0 at the far one and where there is nothing.

struct Caster {
    // From positions to the light's clip space.
    clip: mat4x4f,
}

@group(0) @binding(0) var<uniform> caster: Caster;

@vertex
fn project(@location(0) position: vec3f) -> @builtin(position) vec4f {
    return caster.clip * vec4f(position, 1.0);
}
