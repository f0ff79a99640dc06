//! Tests of the stages on small meshes that a reader can picture.

mod kit;
mod stress;
