//! Tests of the stages on small meshes that a reader can picture.

mod configurations;
mod incision;
mod kit;
mod line;
mod painting;
mod plants;
mod stress;
