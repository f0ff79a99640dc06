//! Typed indices of mesh elements.
//!
//! An id names the same element for as long as the element lives. Edits append and overwrite, they never compact,
//! so an id that was valid before an edit is valid after it; undo takes away the newest ids first.

use std::fmt;

use serde::{Deserialize, Serialize};

macro_rules! id {
    ($(#[$doc:meta])* $name:ident, $letter:literal) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, schemars::JsonSchema)]
        #[serde(transparent)]
        pub struct $name(pub u32);

        impl $name {
            /// "No such element": across a boundary edge, before the first.
            pub const NONE: Self = Self(u32::MAX);

            /// The id as an index into its array.
            #[inline]
            pub fn at(self) -> usize {
                self.0 as usize
            }

            /// The id of the element at an index.
            #[inline]
            pub fn of(index: usize) -> Self {
                Self(index as u32)
            }

            /// `None` for [`Self::NONE`].
            #[inline]
            pub fn some(self) -> Option<Self> {
                (self != Self::NONE).then_some(self)
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                if *self == Self::NONE { write!(f, concat!($letter, "-")) } else { write!(f, concat!($letter, "{}"), self.0) }
            }
        }

        impl fmt::Debug for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                fmt::Display::fmt(self, f)
            }
        }
    };
}

id!(
    /// A node: a point of the surface, and what the topology is made of (Lam 2016, §3.2.3.2). Printed `n12`.
    NodeId,
    "n"
);
id!(
    /// A vertex: a node's attributes in one chart (Lam 2016, §3.2.3.1). Printed `v12`.
    VertexId,
    "v"
);
id!(
    /// An undirected edge (Lam 2016, §3.2.3.3). Printed `e40`.
    EdgeId,
    "e"
);
id!(
    /// A triangle (Lam 2016, §3.2.3.4). Printed `f7`.
    FaceId,
    "f"
);
