//! The shaders' text, as naga reads it.

use naga::valid::{Capabilities, ValidationFlags, Validator};

use crate::render::gpu::painter::{paint, patch, place};
use crate::render::gpu::shaders;

const OURS: [&str; 3] = ["patch", "place", "paint"];

fn parsed(name: &str) -> naga::Module {
    let text = shaders::named(name).unwrap_or_else(|| panic!("no shader {name}")).text();
    naga::front::wgsl::parse_str(&text).unwrap_or_else(|error| panic!("{}", error.emit_to_string(&text)))
}

#[test]
fn every_shader_is_valid() {
    for name in OURS {
        let module = parsed(name);
        let checked = Validator::new(ValidationFlags::all(), Capabilities::empty()).validate(&module);
        assert!(checked.is_ok(), "{name}: {checked:?}");
    }
}

/// Names of a struct's fields and where they begin, and its size, in words.
type Layout = (Vec<(String, u32)>, u32);

fn of_naga(module: &naga::Module, name: &str) -> Option<Layout> {
    let (_, kind) = module.types.iter().find(|(_, kind)| kind.name.as_deref() == Some(name))?;
    let naga::TypeInner::Struct { members, span } = &kind.inner else { return None };
    let field = |member: &naga::StructMember| (member.name.clone().unwrap_or_default(), member.offset / 4);
    Some((members.iter().map(field).collect(), span / 4))
}

/// The same of a table.
fn of_table(fields: &[(&'static str, usize)]) -> Layout {
    let mut end = 0;
    let mut begins = Vec::new();
    for (name, words) in fields {
        begins.push(((*name).to_owned(), end));
        end += *words as u32;
    }
    (begins, end)
}

#[test]
fn every_struct_lies_as_the_shader_reads_it() {
    let tables = [
        ("patch", patch::Fbm::table()),
        ("patch", patch::Patch::table()),
        ("place", place::Triangle::table()),
        ("place", place::Shift::table()),
        ("paint", paint::Paint::table()),
        ("paint", paint::Tile::table()),
        ("paint", paint::Fault::table()),
        ("paint", paint::Faults::table()),
    ];
    for (shader, (name, fields)) in tables {
        let wanted = of_naga(&parsed(shader), name).unwrap_or_else(|| panic!("no struct {name} in {shader}"));
        assert_eq!(of_table(&fields), wanted, "{name} in {shader}");
    }
}
