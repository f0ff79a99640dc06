mod charts;
mod follow;
mod kit;
mod pixels;
