//! What several tests need.

/// A small generator of pseudorandom numbers (splitmix64), the same everywhere.
pub(crate) struct Random(u64);

impl Random {
    /// A generator whose numbers depend on a name alone.
    pub(crate) fn named(name: &str) -> Self {
        let mut first = [0; 8];
        blake3::Hasher::new().update(name.as_bytes()).finalize_xof().fill(&mut first);
        Self(u64::from_le_bytes(first))
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// From 0 to below `n`.
    pub(crate) fn below(&mut self, n: u32) -> u32 {
        (self.next() % u64::from(n)) as u32
    }

    /// In [0, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }
}
