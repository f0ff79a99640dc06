//! A bounding volume hierarchy that follows every edit.
//!
//! A binary tree of boxes over items that are known by index alone; whoever asks knows the items' own geometry. Boxes are f32, rounded
//! outwards, so that nothing is missed. Leaves hold up to [`LEAF_CAPACITY`] items: an item that is added goes into the leaf of a
//! neighbour, and a leaf that overflows becomes two. An item that moves refits the boxes above it, as far as they change.
//!
//! The shape of the tree depends on the history of the edits; what a query finds does not.
//!
//! Costs: build O(n log n); an update, an insertion and a query O(log n) for the trees of surfaces.

mod build;

use glam::DVec3;

/// Items that a leaf can hold. The build fills leaves half, to leave room for splits.
pub const LEAF_CAPACITY: usize = 8;
const LEAF: u32 = 1 << 31;
const ROOT: u32 = 0;
const NO_PARENT: u32 = u32::MAX;

/// An axis-parallel box, rounded outwards to f32.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    min: [f32; 3],
    max: [f32; 3],
}

impl Aabb {
    /// A box that holds nothing.
    pub const EMPTY: Self = Self { min: [f32::INFINITY; 3], max: [f32::NEG_INFINITY; 3] };

    /// The smallest box around some points.
    #[inline]
    pub fn around(points: &[DVec3]) -> Self {
        let (mut lo, mut hi) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for &p in points {
            lo = lo.min(p);
            hi = hi.max(p);
        }
        Self { min: lo.to_array().map(round_down), max: hi.to_array().map(round_up) }
    }

    #[inline]
    fn union(&self, other: &Self) -> Self {
        let mut u = *self;
        for k in 0..3 {
            u.min[k] = u.min[k].min(other.min[k]);
            u.max[k] = u.max[k].max(other.max[k]);
        }
        u
    }

    /// Whether two boxes have a point in common.
    #[inline]
    pub fn overlaps(&self, other: &Self) -> bool {
        (0..3).all(|k| self.min[k] <= other.max[k] && other.min[k] <= self.max[k])
    }

    #[inline]
    fn half_area(&self) -> f32 {
        let d = |k: usize| (self.max[k] - self.min[k]).max(0.0);
        d(0) * d(1) + d(1) * d(2) + d(2) * d(0)
    }

    #[inline]
    fn center2(&self, axis: usize) -> f32 {
        self.min[axis] + self.max[axis]
    }
}

#[inline]
fn round_down(v: f64) -> f32 {
    let r = v as f32;
    if r as f64 > v { r.next_down() } else { r }
}

#[inline]
fn round_up(v: f64) -> f32 {
    let r = v as f32;
    if (r as f64) < v { r.next_up() } else { r }
}

/// A node: its box, and its two children (`link`, `link + 1`) or its leaf.
#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Aabb,
    link: u32,
}

/// The items of a leaf.
#[derive(Clone, Copy, Debug)]
struct Leaf {
    items: [u32; LEAF_CAPACITY],
    count: u32,
}

impl Leaf {
    fn items(&self) -> &[u32] {
        &self.items[..self.count as usize]
    }
}

/// The tree.
#[derive(Clone, Debug)]
pub struct Bvh {
    nodes: Vec<Node>,
    parents: Vec<u32>,
    leaves: Vec<Leaf>,
    /// The node of each item's leaf.
    homes: Vec<u32>,
    /// How many nodes the build made: those after them come from leaves that overflowed.
    built: usize,
}

/// A ray that a query walks along; `t` is measured in lengths of `direction`.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Where it begins.
    pub origin: DVec3,
    /// Where it goes.
    pub direction: DVec3,
}

impl Ray {
    /// Where it enters a box at or after 0 and before `limit`, if it does. Errs on the side of yes.
    pub fn enters(&self, bounds: &Aabb, limit: f64) -> Option<f64> {
        self.enters_by(self.direction.recip(), bounds, limit)
    }

    #[inline]
    fn enters_by(&self, inverse: DVec3, bounds: &Aabb, limit: f64) -> Option<f64> {
        let (mut near, mut far) = (0.0f64, limit);
        for k in 0..3 {
            let (lo, hi) = (bounds.min[k] as f64 - self.origin[k], bounds.max[k] as f64 - self.origin[k]);
            if self.direction[k] == 0.0 {
                if lo > 0.0 || hi < 0.0 {
                    return None;
                }
                continue;
            }
            // A component below 1/f64::MAX has no reciprocal: as slow as that it rules nothing out.
            if !inverse[k].is_finite() {
                continue;
            }
            let (a, b) = (lo * inverse[k], hi * inverse[k]);
            // A few roundings at most lie between these and the true parameters.
            near = near.max(a.min(b) * (1.0 - 1e-14));
            far = far.min(a.max(b) * (1.0 + 1e-14));
        }
        (near <= far).then_some(near)
    }
}

impl Bvh {
    /// Visits the items of every leaf whose box a ray enters before `limit`, nearest boxes first. The visitor returns the parameter
    /// beyond which it is no longer interested.
    pub fn along(&self, ray: Ray, mut limit: f64, mut visit: impl FnMut(u32) -> f64) {
        let inverse = ray.direction.recip();
        let mut stack: Vec<(u32, f64)> = Vec::with_capacity(64);
        if let Some(t) = ray.enters_by(inverse, &self.nodes[ROOT as usize].bounds, limit) {
            stack.push((ROOT, t));
        }
        while let Some((at, entry)) = stack.pop() {
            if entry > limit {
                continue;
            }
            let link = self.nodes[at as usize].link;
            if link & LEAF != 0 {
                for &item in self.leaves[(link & !LEAF) as usize].items() {
                    limit = limit.min(visit(item));
                }
                continue;
            }
            let child =
                |c: u32| ray.enters_by(inverse, &self.nodes[c as usize].bounds, limit).map(|t| (c, t));
            match (child(link), child(link + 1)) {
                (Some(a), Some(b)) => {
                    let (first, second) = if a.1 <= b.1 { (a, b) } else { (b, a) };
                    stack.push(second);
                    stack.push(first);
                }
                (a, b) => stack.extend(a.or(b)),
            }
        }
    }

    /// Visits the items of every leaf whose box overlaps a box. The visitor returns whether to go on.
    pub fn overlapping(&self, bounds: &Aabb, mut visit: impl FnMut(u32) -> bool) {
        let mut stack = vec![ROOT];
        while let Some(at) = stack.pop() {
            let node = &self.nodes[at as usize];
            if !node.bounds.overlaps(bounds) {
                continue;
            }
            if node.link & LEAF == 0 {
                stack.extend([node.link + 1, node.link]);
                continue;
            }
            for &item in self.leaves[(node.link & !LEAF) as usize].items() {
                if !visit(item) {
                    return;
                }
            }
        }
    }

    /// How many items there are.
    pub fn len(&self) -> usize {
        self.homes.len()
    }

    /// Whether there is no item.
    pub fn is_empty(&self) -> bool {
        self.homes.is_empty()
    }

    /// Bytes on the heap.
    pub fn bytes(&self) -> usize {
        self.nodes.capacity() * size_of::<Node>()
            + self.leaves.capacity() * size_of::<Leaf>()
            + (self.parents.capacity() + self.homes.capacity()) * size_of::<u32>()
    }

    /// Refits the boxes above items that moved, each leaf once.
    pub fn update(&mut self, items: impl IntoIterator<Item = u32>, bounds: &impl Fn(u32) -> Aabb) {
        let mut homes: Vec<u32> = items.into_iter().map(|i| self.homes[i as usize]).collect();
        homes.sort_unstable();
        homes.dedup();
        homes.into_iter().for_each(|home| self.refit(home, bounds));
    }

    /// Appends the item `len()` to the leaf of `near`, an item close to it.
    pub fn insert(&mut self, near: u32, bounds: &impl Fn(u32) -> Aabb) {
        let item = self.homes.len() as u32;
        let mut home = self.homes[near as usize];
        let leaf = (self.nodes[home as usize].link & !LEAF) as usize;
        if self.leaves[leaf].count as usize == LEAF_CAPACITY {
            self.split(home, bounds);
            home = self.homes[near as usize];
        }
        let leaf = &mut self.leaves[(self.nodes[home as usize].link & !LEAF) as usize];
        leaf.items[leaf.count as usize] = item;
        leaf.count += 1;
        self.homes.push(home);
        self.widen(home, bounds(item));
    }

    /// Makes the boxes from a node upwards large enough for one more.
    fn widen(&mut self, mut at: u32, by: Aabb) {
        while at != NO_PARENT {
            let wider = self.nodes[at as usize].bounds.union(&by);
            if wider == self.nodes[at as usize].bounds {
                return;
            }
            self.nodes[at as usize].bounds = wider;
            at = self.parents[at as usize];
        }
    }

    /// Takes the items from `len` on away.
    pub fn truncate(&mut self, len: usize, bounds: &impl Fn(u32) -> Aabb) {
        while self.homes.len() > len {
            let item = self.homes.len() as u32 - 1;
            let Some(home) = self.homes.pop() else { return };
            let leaf = &mut self.leaves[(self.nodes[home as usize].link & !LEAF) as usize];
            if let Some(at) = leaf.items().iter().position(|&i| i == item) {
                leaf.items.copy_within(at + 1..leaf.count as usize, at);
                leaf.count -= 1;
            }
            self.refit_below(home, len, bounds);
            self.join_latest();
        }
    }

    /// Takes splits of leaves back, newest first, as long as what is left in both halves fits into one: so undoing and redoing an edit
    /// does not wear the tree out.
    fn join_latest(&mut self) {
        while self.nodes.len() > self.built {
            let children = self.nodes.len() - 2;
            let [low, high] = [children, children + 1].map(|c| self.nodes[c].link);
            if low & LEAF == 0 || high & LEAF == 0 || (high & !LEAF) as usize != self.leaves.len() - 1 {
                return;
            }
            let [a, b] = [low, high].map(|l| self.leaves[(l & !LEAF) as usize]);
            if (a.count + b.count) as usize > LEAF_CAPACITY {
                return;
            }
            let joined = leaf_of(a.items().iter().chain(b.items()).copied());
            let parent = self.parents[children];
            joined.items().iter().for_each(|&i| self.homes[i as usize] = parent);
            self.leaves[(low & !LEAF) as usize] = joined;
            self.nodes[parent as usize].link = low;
            self.leaves.pop();
            self.nodes.truncate(children);
            self.parents.truncate(children);
        }
    }

    fn refit(&mut self, home: u32, bounds: &impl Fn(u32) -> Aabb) {
        self.refit_below(home, usize::MAX, bounds);
    }

    /// Refits a leaf, counting only items below `len` (the others are about to go), and the nodes above as far as they change.
    fn refit_below(&mut self, home: u32, len: usize, bounds: &impl Fn(u32) -> Aabb) {
        let leaf = &self.leaves[(self.nodes[home as usize].link & !LEAF) as usize];
        let items = leaf.items().iter().filter(|&&i| (i as usize) < len);
        let mut now = items.fold(Aabb::EMPTY, |b, &i| b.union(&bounds(i)));
        let mut at = home;
        loop {
            if self.nodes[at as usize].bounds == now {
                return;
            }
            self.nodes[at as usize].bounds = now;
            at = self.parents[at as usize];
            if at == NO_PARENT {
                return;
            }
            let child = self.nodes[at as usize].link as usize;
            now = self.nodes[child].bounds.union(&self.nodes[child + 1].bounds);
        }
    }

    /// Makes a full leaf an inner node over two halves, parted along the axis in which its items spread most.
    fn split(&mut self, home: u32, bounds: &impl Fn(u32) -> Aabb) {
        let at = (self.nodes[home as usize].link & !LEAF) as usize;
        let mut items = self.leaves[at].items.map(|i| (i, bounds(i)));
        let spread = |axis: usize| {
            let centers = items.iter().map(|i| i.1.center2(axis));
            let (lo, hi) = centers.fold((f32::INFINITY, f32::NEG_INFINITY), |(l, h), c| (l.min(c), h.max(c)));
            hi - lo
        };
        let axis = (0..3).fold(0, |best, k| if spread(k) > spread(best) { k } else { best });
        items.sort_unstable_by(|a, b| a.1.center2(axis).total_cmp(&b.1.center2(axis)).then(a.0.cmp(&b.0)));
        let (low, high) = items.split_at(LEAF_CAPACITY / 2);
        self.leaves[at] = leaf_of(low.iter().map(|i| i.0));
        self.leaves.push(leaf_of(high.iter().map(|i| i.0)));
        let children = self.nodes.len() as u32;
        for (side, (half, leaf)) in [(low, at), (high, self.leaves.len() - 1)].into_iter().enumerate() {
            let bounds = half.iter().fold(Aabb::EMPTY, |b, i| b.union(&i.1));
            self.nodes.push(Node { bounds, link: leaf as u32 | LEAF });
            self.parents.push(home);
            half.iter().for_each(|i| self.homes[i.0 as usize] = children + side as u32);
        }
        self.nodes[home as usize].link = children;
    }
}

/// A leaf of at most [`LEAF_CAPACITY`] items.
fn leaf_of(items: impl Iterator<Item = u32>) -> Leaf {
    let mut leaf = Leaf { items: [0; LEAF_CAPACITY], count: 0 };
    for (slot, item) in leaf.items.iter_mut().zip(items) {
        *slot = item;
        leaf.count += 1;
    }
    leaf
}

#[cfg(test)]
mod tests;
