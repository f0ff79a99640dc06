// Lists the tiles of the screen: first those that hold any surface; then those that hold skin, with discoloration or without. A workgroup
// looks at a tile, each of its invocations at a row.

struct Screen {
    size: vec2u,
    // Tiles from left to right.
    across: u32,
    unused: u32,
}

// What draws a list: six corners for each of its tiles.
struct Draw {
    vertex_count: u32,
    instance_count: atomic<u32>,
    first_vertex: u32,
    first_instance: u32,
}

struct Draws {
    seen: Draw,
    plain: Draw,
    localized: Draw,
}

@group(0) @binding(0) var<uniform> screen: Screen;
@group(0) @binding(1) var diffuse: texture_2d<f32>;
@group(0) @binding(2) var discolor: texture_2d<f32>;
@group(0) @binding(3) var<storage, read_write> draws: Draws;
@group(0) @binding(4) var<storage, read_write> plain: array<u32>;
@group(0) @binding(5) var<storage, read_write> localized: array<u32>;
@group(0) @binding(6) var faces: texture_2d<u32>;
@group(0) @binding(7) var<storage, read_write> seen: array<u32>;

override DISCOLORATION: bool;
// Every tile counts as if it held all of that: nothing is skipped.
override EVERYTHING: bool;

// Bit 0: skin. Bit 1: discoloured skin.
var<workgroup> found: atomic<u32>;

fn holds(pixel: vec2u) -> u32 {
    if textureLoad(diffuse, pixel, 0).a == 0.0 {
        return 0u;
    }
    if DISCOLORATION {
        return select(1u, 3u, textureLoad(discolor, pixel, 0).a > 0.0);
    }
    return 1u;
}

// No face.
const NOTHING = 0xffffffffu;

@compute @workgroup_size(TILE)
fn list_seen(@builtin(workgroup_id) tile: vec3u, @builtin(local_invocation_index) row: u32) {
    let y = tile.y * TILE + row;
    if y < screen.size.y {
        for (var x = tile.x * TILE; x < min((tile.x + 1) * TILE, screen.size.x); x++) {
            if textureLoad(faces, vec2u(x, y), 0).r != NOTHING {
                atomicOr(&found, 1u);
                break;
            }
        }
    }
    workgroupBarrier();
    if row == 0 && (EVERYTHING || atomicLoad(&found) != 0) {
        seen[atomicAdd(&draws.seen.instance_count, 1u)] = tile.y * screen.across + tile.x;
    }
}

@compute @workgroup_size(TILE)
fn list_skin(@builtin(workgroup_id) tile: vec3u, @builtin(local_invocation_index) row: u32) {
    let y = tile.y * TILE + row;
    if y < screen.size.y {
        var here = 0u;
        for (var x = tile.x * TILE; x < min((tile.x + 1) * TILE, screen.size.x); x++) {
            here |= holds(vec2u(x, y));
        }
        atomicOr(&found, here);
    }
    workgroupBarrier();
    if row > 0 {
        return;
    }
    let index = tile.y * screen.across + tile.x;
    let all = atomicLoad(&found) | select(0u, select(1u, 3u, DISCOLORATION), EVERYTHING);
    if (all & 2u) != 0 {
        localized[atomicAdd(&draws.localized.instance_count, 1u)] = index;
    } else if all != 0 {
        plain[atomicAdd(&draws.plain.instance_count, 1u)] = index;
    }
}
