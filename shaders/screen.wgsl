// Tiles of the screen as quads, six corners each, and light as it is kept between the passes over them.

const TILE = 16u;

// Light as a target of half floats holds it: rounded here, since devices differ in how they do it.
fn held(light: vec3f) -> vec3f {
    return quantizeToF16(min(light, vec3f(65504.0)));
}

// A corner of a tile in clip space, the tiles being counted row by row.
fn tile_corner(tile: u32, corner: u32, across: u32, size: vec2u) -> vec4f {
    // Two triangles: 0 1 2, 3 2 1.
    let turned = select(corner, 6u - corner, corner > 2u);
    let at = vec2u(turned & 1u, turned >> 1u) + vec2u(tile % across, tile / across);
    let place = vec2f(at * TILE) / vec2f(size);
    return vec4f(2.0 * place.x - 1.0, 1.0 - 2.0 * place.y, 0.0, 1.0);
}
