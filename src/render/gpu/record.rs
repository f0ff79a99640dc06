//! Structs as WGSL lays them out: words of four bytes, in the order of the fields.
//!
//! [`record!`] makes such a struct, and with it the table of its fields that the tests compare with what naga makes of the WGSL struct
//! of the same name. What WGSL would pad has a field for the padding, so that it may be written without unsafe code.

/// What is made of whole words.
pub(crate) trait Words {
    /// How many words.
    const COUNT: usize;

    /// Adds them to the others.
    fn push(&self, words: &mut Vec<u32>);
}

impl Words for u32 {
    const COUNT: usize = 1;

    fn push(&self, words: &mut Vec<u32>) {
        words.push(*self);
    }
}

impl Words for f32 {
    const COUNT: usize = 1;

    fn push(&self, words: &mut Vec<u32>) {
        words.push(self.to_bits());
    }
}

impl<T: Words, const N: usize> Words for [T; N] {
    const COUNT: usize = N * T::COUNT;

    fn push(&self, words: &mut Vec<u32>) {
        self.iter().for_each(|part| part.push(words));
    }
}

/// Makes a struct of [`Words`], by the name of its WGSL twin.
macro_rules! record {
    ($(#[$doc:meta])* $name:ident { $($(#[$about:meta])* $field:ident: $kind:ty,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default)]
        pub(crate) struct $name {
            $($(#[$about])* pub(crate) $field: $kind,)*
        }

        impl $crate::render::gpu::record::Words for $name {
            const COUNT: usize = 0 $(+ <$kind as $crate::render::gpu::record::Words>::COUNT)*;

            fn push(&self, words: &mut Vec<u32>) {
                $(self.$field.push(words);)*
            }
        }

        #[cfg(test)]
        impl $name {
            /// Name of the struct, and its fields with how many words each has.
            pub(crate) fn table() -> (&'static str, Vec<(&'static str, usize)>) {
                let fields = vec![$((
                    stringify!($field),
                    <$kind as $crate::render::gpu::record::Words>::COUNT,
                )),*];
                (stringify!($name), fields)
            }
        }
    };
}

pub(crate) use record;

/// Records as bytes.
pub(crate) fn bytes<T: Words>(records: &[T]) -> Vec<u8> {
    let mut words = Vec::with_capacity(records.len() * T::COUNT);
    records.iter().for_each(|record| record.push(&mut words));
    bytemuck::cast_slice(&words).to_vec()
}
