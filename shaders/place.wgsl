// PP: which triangle has each texel. Of those that cover it the last drawn; a skirt only where no face of the mesh lies.

struct Triangle {
    // Corners, in texels from the map's top left.
    a: vec2f,
    b: vec2f,
    c: vec2f,
    // (s, d) at the first corner, and how it grows per texel to the right and down.
    value: vec2f,
    across: vec2f,
    down: vec2f,
    // 1 of a skirt.
    skirt: u32,
    unused: u32,
}

// Of a run of tiles: where its first texel lies on the target and on the map.
struct Shift {
    map_origin: vec2u,
    target_origin: vec2u,
}

@group(0) @binding(0) var<storage, read> triangles: array<Triangle>;
@group(0) @binding(1) var covered: texture_2d<u32>;
@group(0) @binding(2) var<storage, read> shifts: array<Shift>;

struct Corner {
    @builtin(position) clip: vec4f,
    @location(0) @interpolate(flat) triangle: u32,
    @location(1) @interpolate(flat) run: u32,
}

// Vertices are corners, three to a triangle; instances are runs. The viewport is the whole map, so that nothing on it is clipped.
@vertex
fn vertex(@builtin(vertex_index) corner: u32, @builtin(instance_index) run: u32) -> Corner {
    let number = corner / 3u;
    let triangle = triangles[number];
    var corners = array(triangle.a, triangle.b, triangle.c);
    let at = corners[corner % 3u] / vec2f(textureDimensions(covered)) * 2.0 - 1.0;
    return Corner(vec4f(at.x, -at.y, 0.0, 1.0), number, run);
}

// The triangle's number, counted from 1.
@fragment
fn fragment(in: Corner) -> @location(0) u32 {
    if triangles[in.triangle].skirt == 1u {
        let at = vec2u(in.clip.xy) - shifts[in.run].target_origin + shifts[in.run].map_origin;
        if textureLoad(covered, at, 0).r != 0u {
            discard;
        }
    }
    return in.triangle + 1u;
}
