//! Building the tree: top down, parted where the surface area heuristic over a few bins is cheapest.

use super::{Aabb, Bvh, LEAF, LEAF_CAPACITY, NO_PARENT, Node, leaf_of};

const BINS: usize = 12;

/// A range of items that waits to become a node.
struct Range {
    node: u32,
    start: usize,
    end: usize,
}

impl Bvh {
    /// Builds the tree over items `0..count` with the given boxes.
    pub fn build(count: usize, bounds: &impl Fn(u32) -> Aabb) -> Self {
        let mut items: Vec<(u32, Aabb)> = (0..count as u32).map(|i| (i, bounds(i))).collect();
        let room = count / (LEAF_CAPACITY / 2 - 1) + 64;
        let mut tree = Self {
            nodes: Vec::with_capacity(2 * room),
            parents: Vec::with_capacity(2 * room),
            leaves: Vec::with_capacity(room),
            homes: Vec::with_capacity(count + count / 32 + 64),
            built: 0,
        };
        tree.homes.resize(count, 0);
        tree.nodes.push(Node { bounds: Aabb::EMPTY, link: LEAF });
        tree.parents.push(NO_PARENT);
        let mut ranges = vec![Range { node: 0, start: 0, end: count }];
        while let Some(range) = ranges.pop() {
            tree.place(range, &mut items, &mut ranges);
        }
        tree.built = tree.nodes.len();
        tree
    }

    fn place(&mut self, range: Range, items: &mut [(u32, Aabb)], waiting: &mut Vec<Range>) {
        let Range { node, start, end } = range;
        let slice = &mut items[start..end];
        self.nodes[node as usize].bounds = slice.iter().fold(Aabb::EMPTY, |b, i| b.union(&i.1));
        if slice.len() <= LEAF_CAPACITY / 2 {
            slice.iter().for_each(|i| self.homes[i.0 as usize] = node);
            self.nodes[node as usize].link = self.leaves.len() as u32 | LEAF;
            self.leaves.push(leaf_of(slice.iter().map(|i| i.0)));
            return;
        }
        let middle = start + part(slice);
        let child = self.nodes.len() as u32;
        self.nodes[node as usize].link = child;
        for _ in 0..2 {
            self.nodes.push(Node { bounds: Aabb::EMPTY, link: LEAF });
            self.parents.push(node);
        }
        waiting.push(Range { node: child + 1, start: middle, end });
        waiting.push(Range { node: child, start, end: middle });
    }
}

/// Reorders the items so that the first `n` and the rest are the two children's; returns `n`.
fn part(items: &mut [(u32, Aabb)]) -> usize {
    let centers = items.iter().fold(Aabb::EMPTY, |b, (_, i)| {
        let c = [0, 1, 2].map(|k| i.center2(k));
        b.union(&Aabb { min: c, max: c })
    });
    let extent = |k: usize| centers.max[k] - centers.min[k];
    let axis = (0..3).fold(0, |best, k| if extent(k) > extent(best) { k } else { best });
    let scale = BINS as f32 / extent(axis);
    if !scale.is_finite() {
        return items.len() / 2;
    }
    let low = centers.min[axis];
    let bin = |b: &Aabb| (((b.center2(axis) - low) * scale) as usize).min(BINS - 1);
    let cut = cheapest(items, &bin);
    let mut n = 0;
    for i in 0..items.len() {
        if bin(&items[i].1) < cut {
            items.swap(i, n);
            n += 1;
        }
    }
    if n == 0 || n == items.len() { items.len() / 2 } else { n }
}

/// The bin before which to part, by the surface area heuristic.
fn cheapest(items: &[(u32, Aabb)], bin: &impl Fn(&Aabb) -> usize) -> usize {
    let mut bins = [(Aabb::EMPTY, 0u32); BINS];
    for (_, bounds) in items {
        let b = &mut bins[bin(bounds)];
        *b = (b.0.union(bounds), b.1 + 1);
    }
    let mut left = [0.0f32; BINS];
    let (mut bounds, mut count) = (Aabb::EMPTY, 0);
    for k in 0..BINS - 1 {
        (bounds, count) = (bounds.union(&bins[k].0), count + bins[k].1);
        left[k + 1] = bounds.half_area() * count as f32;
    }
    let (mut bounds, mut count) = (Aabb::EMPTY, 0);
    let mut best = (f32::INFINITY, BINS / 2);
    for k in (1..BINS).rev() {
        (bounds, count) = (bounds.union(&bins[k].0), count + bins[k].1);
        let cost = left[k] + bounds.half_area() * count as f32;
        if cost < best.0 {
            best = (cost, k);
        }
    }
    best.1
}
