//! The shaders' text, by name. `shaders/NAME.wgsl` is what `NAME.rs` runs; what several share stands in front of it.

/// A shader: its name, and the texts that it is made of, in order.
#[derive(Debug)]
pub(crate) struct Shader {
    pub(crate) name: &'static str,
    parts: &'static [&'static str],
}

impl Shader {
    /// The whole text.
    pub(crate) fn text(&self) -> String {
        self.parts.concat()
    }
}

macro_rules! wgsl {
    ($($name:literal),*) => {
        &[$(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/shaders/", $name, ".wgsl"))),*]
    };
}

/// All of them. The adapter's digest is over their texts.
pub(crate) const SHADERS: &[Shader] = &[
    Shader { name: "shadow", parts: wgsl!("shadow") },
    Shader { name: "visible", parts: wgsl!("visible") },
    Shader { name: "skin", parts: wgsl!("screen", "srgb", "maps", "light", "skin") },
    Shader { name: "tiles", parts: wgsl!("screen", "tiles") },
    Shader { name: "scatter", parts: wgsl!("screen", "scatter") },
    Shader { name: "compose", parts: wgsl!("screen", "srgb", "compose") },
    Shader { name: "patch", parts: wgsl!("noise", "patch") },
    Shader { name: "place", parts: wgsl!("place") },
    Shader { name: "paint", parts: wgsl!("noise", "place", "paint") },
];

/// A shader by its name.
pub(crate) fn named(name: &str) -> Option<&'static Shader> {
    SHADERS.iter().find(|shader| shader.name == name)
}

/// blake3 of all texts, 32 hexadecimal digits.
pub(crate) fn digest() -> String {
    let mut hasher = blake3::Hasher::new();
    SHADERS.iter().for_each(|shader| {
        hasher.update(shader.text().as_bytes());
    });
    hasher.finalize().to_hex()[..32].into()
}
