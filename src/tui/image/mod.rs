//! Pictures in a terminal: from an image to cells, and from a cell back to a pixel.
//!
//! | module | what it does |
//! | --- | --- |
//! | [`protocol`] | how pictures reach this terminal, and how many pixels a pane has |
//! | [`window`] | pan and zoom: what part of a picture is seen, and what lies under the pointer |
//! | [`compare`] | two pictures in one, with a slider |
//! | [`encoder`] | makes a picture ready to be drawn, on a thread of its own |
//! | [`marks`] | what is marked in the pixels of a pane |
//! | [`blocks`] | pictures of half blocks, for every terminal, in as many colours as it has |
//!
//! A **pane's pixels** are what its cells can show: the font's own for a protocol of graphics, 1 x 2 a cell for half blocks.

pub mod blocks;
pub mod compare;
pub mod encoder;
pub mod marks;
pub mod protocol;
pub mod window;
