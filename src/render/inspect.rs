//! GP's and PP's invariants of pixels, as functions over images and texels: whoever painted.
