//! Coverage against the rule as it is usually written, texel by texel.

use glam::vec2;

use super::*;

/// Numbers all over, the same in every run.
fn numbers() -> impl Iterator<Item = u32> {
    let mut state = 0x9e37_79b9_u32;
    std::iter::repeat_with(move || {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        state
    })
}

/// How often each texel of a map is covered.
fn counts(triangles: &[Corners], size: [u32; 2]) -> Vec<u32> {
    let mut counts = vec![0; (size[0] * size[1]) as usize];
    for triangle in triangles {
        spans(*triangle, Window::whole(size), |row, columns| {
            columns.for_each(|column| counts[(row * size[0] + column) as usize] += 1);
        });
    }
    counts
}

/// The rule as it is usually written: on the inner side of each side, or on a left or top one.
fn covers([a, b, c]: Corners, [x, y]: [i64; 2]) -> bool {
    let corners = if doubled_area([a, b, c]) > 0 { [a, b, c] } else { [a, c, b] };
    (0..3).all(|i| {
        let (p, q) = (corners[i], corners[(i + 1) % 3]);
        let cross = (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);
        let (top, left) = (q[1] == p[1] && q[0] > p[0], q[1] < p[1]);
        cross > 0 || (cross == 0 && (top || left))
    })
}

#[test]
fn spans_are_what_the_rule_says() {
    let size = [13, 11];
    let mut numbers = numbers();
    for round in 0..3000 {
        // Every other triangle has corners on half texels, so that centres lie on its sides.
        let grain = if round % 2 == 0 { PARTS / 2 } else { 1 };
        let mut number = || i64::from(numbers.next().unwrap() % 5120) / grain * grain - 3 * PARTS;
        let triangle: Corners = [0; 3].map(|_| [number(), number()]);
        if doubled_area(triangle) == 0 {
            continue;
        }
        let found = counts(&[triangle], size);
        for (k, count) in (0i64..).zip(found) {
            let centre = [k % 13, k / 13].map(|v| v * PARTS + PARTS / 2);
            assert_eq!(count == 1, covers(triangle, centre), "{triangle:?} at {centre:?}");
        }
    }
}

#[test]
fn faces_that_share_sides_cover_every_texel_once() {
    let (cells, step) = (8, 5 * PARTS);
    for jitter in [0, PARTS / 2, 2 * PARTS] {
        let mut numbers = numbers();
        let mut nudge = |k: i64| match k {
            1..8 if jitter > 0 => i64::from(numbers.next().unwrap()) % (2 * jitter) - jitter,
            _ => 0,
        };
        let nodes: Vec<[i64; 2]> = (0..81)
            .map(|k| {
                let (i, j) = (k % 9, k / 9);
                let edge = i % 8 == 0 || j % 8 == 0;
                let by = if edge { [0, 0] } else { [nudge(i), nudge(j)] };
                // From half a texel on, so that the grid's own lines go through centres.
                [i * step + by[0] + PARTS / 2, j * step + by[1] + PARTS / 2]
            })
            .collect();
        let quads = (0..cells * cells).map(|k| k / cells * 9 + k % cells);
        let triangles: Vec<Corners> = quads
            .flat_map(|k| [[k, k + 1, k + 10], [k, k + 10, k + 9]])
            .map(|face| face.map(|n| nodes[n as usize]))
            .collect();
        let size = [40, 40];
        assert!(counts(&triangles, size).iter().all(|count| *count == 1), "jitter {jitter}");
    }
}

#[test]
fn coordinates_are_rounded_to_a_256th_of_a_texel() {
    assert_eq!(
        [0.0, 1.0, -1.0, 0.5 / 256.0, -0.5 / 256.0, -0.51 / 256.0].map(round),
        [0, 256, -256, 1, 0, -1]
    );
    let uv = [vec2(0.25, 1.0), vec2(0.5, 0.75), vec2(0.25, 0.0)];
    assert_eq!(place(uv, [64, 32]), Some([[16 * 256, 0], [32 * 256, 8 * 256], [16 * 256, 32 * 256]]));
}

#[test]
fn maps_repeat() {
    let uv = [vec2(0.9, 0.4), vec2(1.2, 0.1), vec2(0.95, -0.3)];
    let size = [40, 20];
    let all = |uv: [Vec2; 3]| {
        let mut triangles = Vec::new();
        each_copy(place(uv, size).expect("a face"), size, |copy| triangles.push(copy));
        counts(&triangles, size)
    };
    let found = all(uv);
    assert_eq!(found, all(uv.map(|c| c + vec2(-3.0, 17.0))), "elsewhere, the same");
    // Texel by texel: the centre, and wherever it repeats.
    let exact = uv.map(|c| [round(f64::from(c.x) * 40.0), round((1.0 - f64::from(c.y)) * 20.0)]);
    for (k, count) in (0i64..).zip(found) {
        let places = (-1..=2).flat_map(|i| (-1..=2).map(move |j| [k % 40 + 40 * i, k / 40 + 20 * j]));
        let times = places.filter(|at| covers(exact, at.map(|v| v * PARTS + PARTS / 2))).count();
        assert_eq!(count as usize, times);
    }
}

#[test]
fn what_is_out_of_bounds_is_left_out() {
    let face = |to: f32| [vec2(0.0, 0.0), vec2(to, 0.0), vec2(0.0, 0.5)];
    assert!(place(face(3.0), [64, 64]).is_some());
    for to in [3.1, f32::NAN, f32::INFINITY, 5000.0, 0.0] {
        assert_eq!(place(face(to), [64, 64]), None, "{to}");
    }
    assert_eq!(place(face(1.0), [LARGEST_SIDE + 1, 64]), None);
    let far = face(1.0).map(|c| c + FARTHEST - 2.0);
    assert!(
        place(far, [LARGEST_SIDE; 2]).is_some_and(|c| c.iter().flatten().all(|v| (0..1 << 24).contains(v)))
    );
}
