//! Maps of space that floating-point numbers follow exactly, or exactly as far as coordinates lie on a grid.

use glam::DVec3;

use crate::attack::trial::Ground;
use crate::engine::wound::State;
use crate::mesh::{Mesh, NodeId};

/// Permutes axes, flips signs, scales, then shifts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Map {
    /// Where each new coordinate comes from.
    pub(super) axes: [usize; 3],
    /// What it is multiplied by: plus or minus a power of two.
    pub(super) factors: DVec3,
    /// What is added.
    pub(super) shift: DVec3,
}

impl Map {
    pub(super) const IDENTITY: Self = Self { axes: [0, 1, 2], factors: DVec3::ONE, shift: DVec3::ZERO };

    pub(super) fn point(&self, p: DVec3) -> DVec3 {
        DVec3::from(self.axes.map(|axis| p[axis])) * self.factors + self.shift
    }

    /// How much larger everything gets.
    pub(super) fn scale(&self) -> f64 {
        self.factors.x.abs()
    }

    pub(super) fn mesh(&self, mesh: &Mesh) -> Mesh {
        let mut mapped = mesh.clone();
        for n in (0..mesh.node_count()).map(NodeId::of) {
            mapped.set_position(n, self.point(mesh.position(n)));
        }
        mapped
    }

    /// A state as it would be had everything been mapped from the beginning; numbered as it was. The camera stays behind.
    pub(super) fn state(&self, ground: &Ground, state: &State) -> State {
        let mut scene = ground.scene.clone();
        scene.unit_cm /= self.scale();
        let mut mapped = State::new(self.mesh(&ground.mesh), scene);
        mapped.mesh = self.mesh(&state.mesh);
        mapped.paintings = state.paintings.clone();
        mapped.control = state.control.clone();
        mapped
    }

    /// Whether a point comes back as it was: nothing was rounded.
    pub(super) fn is_exact_at(&self, p: DVec3) -> bool {
        let scaled = DVec3::from(self.axes.map(|axis| p[axis])) * self.factors;
        let shifted = scaled + self.shift;
        // Both ways: a coordinate that is swallowed whole would come back as zero.
        shifted - self.shift == scaled && shifted - scaled == self.shift
    }
}
