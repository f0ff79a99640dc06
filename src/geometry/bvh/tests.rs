//! Whatever is edited, a query finds what a look at everything finds.

use super::*;

/// Small boxes scattered by a fixed rule.
fn scattered(i: u32) -> Aabb {
    let h =
        |k: u32| ((i.wrapping_mul(2_654_435_761).wrapping_add(k.wrapping_mul(40_503))) >> 8) as f64 % 1000.0;
    let p = DVec3::new(h(1), h(2) / 3.0, h(3) / 7.0);
    Aabb::around(&[p, p + DVec3::splat(2.0)])
}

fn found(tree: &Bvh, query: &Aabb, bounds: impl Fn(u32) -> Aabb) -> Vec<u32> {
    let mut hits = Vec::new();
    tree.overlapping(query, |i| {
        if bounds(i).overlaps(query) {
            hits.push(i);
        }
        true
    });
    hits.sort_unstable();
    hits
}

fn expected(count: u32, query: &Aabb, bounds: impl Fn(u32) -> Aabb) -> Vec<u32> {
    (0..count).filter(|&i| bounds(i).overlaps(query)).collect()
}

fn queries() -> Vec<Aabb> {
    (0..40)
        .map(|i| scattered(i * 97 + 5))
        .chain([Aabb::around(&[DVec3::ZERO, DVec3::splat(500.0)])])
        .collect()
}

#[test]
fn a_query_finds_what_a_look_at_everything_finds_after_every_kind_of_edit() {
    let moved = |i: u32| if i.is_multiple_of(5) { scattered(i + 100_000) } else { scattered(i) };
    let mut tree = Bvh::build(1000, &scattered);
    let agree = |tree: &Bvh, count: u32, bounds: &dyn Fn(u32) -> Aabb| {
        for query in queries() {
            assert_eq!(found(tree, &query, bounds), expected(count, &query, bounds));
        }
    };
    agree(&tree, 1000, &scattered);
    tree.update(0..1000, &moved);
    agree(&tree, 1000, &moved);
    (1000..1600).for_each(|i| tree.insert(i % 37, &moved));
    agree(&tree, 1600, &moved);
    tree.truncate(900, &moved);
    agree(&tree, 900, &moved);
    (900..950).for_each(|i| tree.insert(i % 3, &moved));
    agree(&tree, 950, &moved);
}

#[test]
fn adding_and_taking_away_again_does_not_wear_the_tree_out() {
    let mut tree = Bvh::build(500, &scattered);
    let (nodes, bytes) = (tree.nodes.len(), tree.bytes());
    for _ in 0..100 {
        (500..700).for_each(|i| tree.insert(i % 50, &scattered));
        tree.truncate(500, &scattered);
        assert_eq!(tree.nodes.len(), nodes);
    }
    assert!(tree.bytes() <= 2 * bytes);
    for query in queries() {
        assert_eq!(found(&tree, &query, scattered), expected(500, &query, scattered));
    }
}

#[test]
fn a_ray_visits_every_box_that_it_enters() {
    let tree = Bvh::build(1000, &scattered);
    for k in 0..50u32 {
        let target = scattered(k * 13).min.map(|v| v as f64 + 1.0);
        let origin = DVec3::new(-50.0, 400.0 - k as f64 * 9.0, 77.0);
        let ray = Ray { origin, direction: DVec3::from(target) - origin };
        let mut seen = Vec::new();
        tree.along(ray, f64::INFINITY, |i| {
            seen.push(i);
            f64::INFINITY
        });
        let entered = (0..1000).filter(|&i| ray.enters(&scattered(i), f64::INFINITY).is_some());
        assert!(entered.into_iter().all(|i| seen.contains(&i)), "ray {k}");
    }
}

#[test]
fn a_ray_along_an_axis_through_a_face_of_a_box_enters_it() {
    let tree = Bvh::build(1, &|_| Aabb::around(&[DVec3::ZERO, DVec3::ONE]));
    let mut seen = 0;
    tree.along(Ray { origin: DVec3::new(1.0, 0.5, -3.0), direction: DVec3::Z }, f64::INFINITY, |_| {
        seen += 1;
        f64::INFINITY
    });
    assert_eq!(seen, 1);
}

#[test]
fn a_ray_that_hardly_moves_along_an_axis_misses_no_box_on_its_way() {
    // The box's lower side lies where the ray begins, and 0 times the reciprocal of the smallest float is no number.
    let bounds = |_: u32| Aabb::around(&[DVec3::new(1.0, -1.0, 5e-324), DVec3::new(2.0, 1.0, 5e-324)]);
    let tree = Bvh::build(1, &bounds);
    let mut met = Vec::new();
    let ray = Ray { origin: DVec3::ZERO, direction: DVec3::new(1.5, 0.0, 5e-324) };
    tree.along(ray, f64::INFINITY, |item| {
        met.push(item);
        f64::INFINITY
    });
    assert_eq!(met, [0]);
}
