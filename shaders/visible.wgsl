// Which face is nearest at each pixel. Depth is 1 near and 0 far.

struct Viewer {
    // From positions to clip space.
    clip: mat4x4f,
}

@group(0) @binding(0) var<uniform> viewer: Viewer;
// 15 words a vertex, of which the position is the first three.
@group(0) @binding(1) var<storage, read> vertices: array<f32>;
@group(0) @binding(2) var<storage, read> corners: array<u32>;

struct Corner {
    @builtin(position) clip: vec4f,
    @location(0) @interpolate(flat) face: u32,
}

@vertex
fn project(@builtin(vertex_index) corner: u32) -> Corner {
    let at = 15u * corners[corner];
    let position = vec3f(vertices[at], vertices[at + 1], vertices[at + 2]);
    return Corner(viewer.clip * vec4f(position, 1.0), corner / 3u);
}

@fragment
fn name(corner: Corner) -> @location(0) u32 {
    return corner.face;
}
