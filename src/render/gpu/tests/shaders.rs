//! The shaders' text as naga reads it: valid, and its structs laid out as they are written here. Needs no adapter.

use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{AddressSpace, Module, TypeInner};

use crate::render::gpu::shaders::{SHADERS, named};
use crate::render::gpu::{compose, scatter, shadow, tiles, uniforms, visible};

/// A shader, parsed.
fn parsed(name: &str) -> Module {
    let text = named(name).unwrap_or_else(|| panic!("no shader {name}")).text();
    naga::front::wgsl::parse_str(&text)
        .unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(&text)))
}

#[test]
fn every_shader_is_valid() {
    // What every Vulkan device has: half floats as words.
    let needed = Capabilities::SHADER_FLOAT16_IN_FLOAT32;
    for shader in SHADERS {
        let module = parsed(shader.name);
        let mut validator = Validator::new(ValidationFlags::all(), needed);
        if let Err(error) = validator.validate(&module) {
            panic!("{}: {}", shader.name, error.emit_to_string(&shader.text()));
        }
    }
}

/// Every file in `shaders/` is a part of some shader.
#[test]
fn no_shader_is_left_over() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/shaders");
    for entry in std::fs::read_dir(folder).expect("the folder") {
        let path = entry.expect("a file").path();
        let text = std::fs::read_to_string(&path).expect("its text");
        let used = SHADERS.iter().any(|shader| shader.text().contains(&text));
        assert!(used, "{} is in no shader", path.display());
    }
}

/// A struct's fields with their offsets, and its size; all in words.
type Table = (Vec<(String, u32)>, u32);

fn of_naga(module: &Module, name: &str) -> Option<Table> {
    let (_, kind) = module.types.iter().find(|(_, kind)| kind.name.as_deref() == Some(name))?;
    let TypeInner::Struct { members, span } = &kind.inner else { return None };
    let field = |member: &naga::StructMember| (member.name.clone().unwrap_or_default(), member.offset / 4);
    Some((members.iter().map(field).collect(), span / 4))
}

fn of_rust(fields: &[(&'static str, usize)]) -> Table {
    let mut end = 0;
    let place = |(name, words): &(&'static str, usize)| {
        let at = end;
        end += *words as u32;
        ((*name).to_owned(), at)
    };
    (fields.iter().map(place).collect(), end)
}

#[test]
fn every_struct_lies_as_the_shader_reads_it() {
    let tables = [
        ("visible", visible::Viewer::table()),
        ("shadow", shadow::Caster::table()),
        ("skin", uniforms::Scene::table()),
        ("skin", uniforms::Lamp::table()),
        ("skin", uniforms::Transport::table()),
        ("tiles", tiles::Screen::table()),
        ("tiles", tiles::Draw::table()),
        ("scatter", scatter::Reach::table()),
        ("compose", compose::Backdrop::table()),
    ];
    assert_laid_out(&tables, &["visible", "shadow", "skin", "tiles", "scatter", "compose"]);
}

/// A shader, and a record's name and fields.
pub(crate) type Told = (&'static str, (&'static str, Vec<(&'static str, usize)>));

/// Every one of these structs lies as its shader reads it, and no other struct comes into these shaders from outside.
pub(crate) fn assert_laid_out(tables: &[Told], shaders: &[&str]) {
    for (shader, (name, fields)) in tables {
        let wanted = of_naga(&parsed(shader), name).unwrap_or_else(|| panic!("no struct {name} in {shader}"));
        assert_eq!(of_rust(fields), wanted, "{name} in {shader}");
    }
    for shader in shaders {
        let known = |name: &str| tables.iter().any(|(_, (known, _))| *known == name);
        let bound = bound_structs(&parsed(shader));
        // Two draws: a struct of nothing but others.
        let missing: Vec<_> = bound.iter().filter(|name| !known(name) && *name != "Draws").collect();
        assert!(missing.is_empty(), "{shader}: nobody compares {missing:?}");
    }
}

/// The names of the structs that come from outside.
fn bound_structs(module: &Module) -> Vec<String> {
    let outside = |space| matches!(space, AddressSpace::Uniform | AddressSpace::Storage { .. });
    let bound = module.global_variables.iter().filter(|(_, variable)| outside(variable.space));
    let names = bound.filter_map(|(_, variable)| {
        let kind = match module.types[variable.ty].inner {
            TypeInner::Array { base, .. } => base,
            _ => variable.ty,
        };
        module.types[kind].name.clone()
    });
    names.collect()
}
