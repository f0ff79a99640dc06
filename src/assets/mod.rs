//! assets

mod error;
mod files;

pub use error::{AssetError, Fault, FaultKind, Place};
pub use files::{is_file, is_folder, list_files, read_file, write_file};
