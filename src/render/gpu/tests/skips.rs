//! What is skipped, that it is said, and that no pixel depends on it.

use std::ops::Range;

use glam::DVec3;

use super::kit::{OnDevice, Scene, device};
use crate::canvas::frame::{Frame, Pass};
use crate::canvas::look::Switches;
use crate::mesh::{NodeId, VertexId};

fn pass<'a>(frame: &'a Frame, id: &str) -> &'a Pass {
    frame.passes.iter().find(|pass| pass.id == id).unwrap_or_else(|| panic!("{id} in {:?}", frame.passes))
}

fn why<'a>(frame: &'a Frame, id: &str) -> Option<&'a str> {
    pass(frame, id).skipped.as_deref()
}

#[test]
fn everything_gives_the_same_bytes() {
    let Some(device) = device() else { return };
    let mut scene = Scene::bust([150, 90]);
    let off = Switches { shadows: false, discoloration: false, ..Switches::default() };
    for switches in [Switches::default(), off, Switches { scattering: false, ..Switches::default() }] {
        scene.switches = switches;
        let mut ours = OnDevice::new(&device, &scene);
        let skipping = [ours.frame(&scene), ours.frame(&scene)];
        scene.everything = true;
        let whole = ours.frame(&scene);
        scene.everything = false;
        assert!(skipping.iter().all(|frame| frame.image == whole.image), "{switches:?}");
        let skipped = whole.passes.iter().filter_map(|pass| pass.skipped.as_deref());
        let reasons: Vec<_> = skipped.filter(|why| !why.contains("switched off")).collect();
        assert_eq!(reasons, ["the mesh has not changed"], "{switches:?}");
    }
}

/// A device without a clock is waited for after each pass; the picture is the same.
#[test]
fn passes_are_timed_with_the_device_s_clock_or_without() {
    let Some(device) = device() else { return };
    let scene = Scene::bust([96, 64]);
    let mut ours = [OnDevice::new(&device, &scene), OnDevice::new(&device, &scene)];
    ours[1].frames.clock = None;
    let frames = ours.each_mut().map(|ours| ours.frame(&scene));
    assert_eq!(frames[0].image, frames[1].image);
    for frame in &frames {
        for id in ["visible", "shadow 0", "skin", "scatter", "compose"] {
            let us = pass(frame, id).us;
            assert!(us > 0.0 && us < 60e6, "{id}: {us}");
        }
    }
}

#[test]
fn passes_say_why_they_were_not_done() {
    let Some(device) = device() else { return };
    let mut scene = Scene::bust([150, 90]);
    let mut ours = OnDevice::new(&device, &scene);
    let first = ours.frame(&scene);
    let ids: Vec<_> = first.passes.iter().map(|pass| pass.id.as_str()).collect();
    let order = [
        "upload", "visible", "shadow 0", "shadow 1", "shadow 2", "shadow 3", "skin", "scatter", "discolor",
        "compose",
    ];
    assert_eq!(ids, order);
    assert_eq!(why(&first, "shadow 0"), None);
    assert_eq!(why(&first, "shadow 1"), Some("its cone misses the model"));
    let (scatter, discolor) = (pass(&first, "scatter"), pass(&first, "discolor"));
    assert_eq!((scatter.of, discolor.of), (60, 60));
    assert!(0 < discolor.tiles && discolor.tiles < scatter.tiles && scatter.tiles < 60, "{first:?}");
    let second = ours.frame(&scene);
    assert_eq!(why(&second, "upload"), Some("the mesh has not changed"));
    assert_eq!(why(&second, "shadow 0"), Some("neither the light nor the mesh has changed"));
    scene.lights[0].position.x += 0.5;
    let third = ours.frame(&scene);
    assert_eq!(why(&third, "shadow 0"), None);
    assert_eq!(why(&third, "shadow 2"), Some("neither the light nor the mesh has changed"));
    assert_ne!(third.image, second.image);
    scene.switches = Switches { shadows: false, transmittance: false, scattering: false, ..scene.switches };
    let fourth = ours.frame(&scene);
    assert_eq!(why(&fourth, "shadow 0"), Some("shadows and transmitted light are switched off"));
    assert_eq!(why(&fourth, "scatter"), Some("switched off"));
    assert_eq!(why(&fourth, "discolor"), Some("scattering is switched off"));
}

/// The maps of the lights that were kept are still theirs.
#[test]
fn a_light_that_moves_leaves_the_others_shadows() {
    let Some(device) = device() else { return };
    let mut scene = Scene::bust([96, 64]);
    let mut ours = OnDevice::new(&device, &scene);
    ours.frame(&scene);
    scene.lights[2].position *= 1.1;
    scene.lights[0].reaches = false;
    assert_eq!(ours.frame(&scene).image, OnDevice::new(&device, &scene).frame(&scene).image);
}

#[test]
fn nothing_in_view_is_the_background() {
    let Some(device) = device() else { return };
    let mut scene = Scene::bust([33, 17]);
    scene.view.basis = scene.view.basis.map(|axis| DVec3::new(-axis.x, axis.y, -axis.z));
    scene.version = 7;
    let mut ours = OnDevice::new(&device, &scene);
    let frame = ours.frame(&scene);
    assert!(frame.passes.iter().skip(1).all(|pass| pass.skipped.is_some()), "{:?}", frame.passes);
    assert_eq!(frame.image, scene.reference().image);
    scene.everything = true;
    assert_eq!(ours.frame(&scene).image, frame.image);
}

#[test]
fn only_what_changed_of_the_mesh_is_uploaded() {
    let Some(device) = device() else { return };
    let mut scene = Scene::bust([64, 64]);
    let mut ours = OnDevice::new(&device, &scene);
    let before = ours.frame(&scene).image;
    assert_eq!(ours.frames.uploaded.vertices, one(0..scene.mesh.vertex_count()));
    assert_eq!(ours.frames.uploaded.faces, one(0..scene.mesh.face_count()));
    // The same again, by version and by content.
    ours.frame(&scene);
    assert!(ours.frames.uploaded.is_empty());
    scene.version += 1;
    assert_eq!(why(&ours.frame(&scene), "shadow 0"), Some("neither the light nor the mesh has changed"));
    assert!(ours.frames.uploaded.is_empty());
    // A node near the eye, that lies in one chart.
    let (vertex, node) = nearest(&scene);
    scene.mesh.set_position(node, scene.mesh.position(node) + DVec3::new(0.4, 0.9, 0.3));
    scene.version += 1;
    let moved = ours.frame(&scene);
    let at = vertex.0 as usize;
    assert_eq!(ours.frames.uploaded.vertices, one(at..at + 1));
    assert!(ours.frames.uploaded.faces.is_empty());
    assert_eq!(why(&moved, "shadow 0"), None);
    assert_ne!(moved.image, before);
    assert_eq!(moved.image, OnDevice::new(&device, &scene).frame(&scene).image);
}

/// A list of one range.
fn one(range: Range<usize>) -> Vec<Range<usize>> {
    std::iter::once(range).collect()
}

/// The vertex and the node nearest to the eye, of those that lie in one chart.
fn nearest(scene: &Scene) -> (VertexId, NodeId) {
    let mesh = &scene.mesh;
    let corners = mesh.faces().iter().flat_map(|face| face.nodes.iter().zip(face.vertices));
    let vertices = |node: NodeId| {
        let of = mesh.faces().iter().flat_map(|face| face.nodes.iter().zip(face.vertices));
        let mut all: Vec<_> = of.filter(|(n, _)| **n == node).map(|(_, v)| v.0).collect();
        all.sort_unstable();
        all.dedup();
        all.len()
    };
    let away = |node: NodeId| mesh.position(node).distance(scene.view.eye);
    let mut sorted: Vec<_> = corners.map(|(node, vertex)| (vertex, *node)).collect();
    sorted.sort_by(|a, b| away(a.1).total_cmp(&away(b.1)));
    sorted.into_iter().find(|(_, node)| vertices(*node) == 1).expect("a node in one chart")
}

/// What grows needs a new buffer, and what shrinks leaves nothing behind.
#[test]
fn a_mesh_may_grow_and_shrink() {
    let Some(device) = device() else { return };
    let small = Scene::of(crate::mesh::Mesh::build(&sphere(20)).expect("a mesh"), [48, 48]);
    let mut scene = Scene::of(crate::mesh::Mesh::build(&sphere(2000)).expect("a mesh"), [48, 48]);
    let mut ours = OnDevice::new(&device, &small);
    let first = ours.frame(&small).image;
    scene.version = 2;
    assert_eq!(ours.frame(&scene).image, OnDevice::new(&device, &scene).frame(&scene).image);
    let back = Scene { version: 3, ..small };
    assert_eq!(ours.frame(&back).image, first);
}

fn sphere(faces: usize) -> crate::mesh::IndexedMesh {
    crate::assets::builtin::builtin(&format!("sphere:{faces}")).expect("a sphere").mesh
}
