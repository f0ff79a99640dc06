//! What users of the GPU renderer rely on. Without an adapter they say so and pass, unless LANCET_GPU=require.

mod bounds;
mod frames;
pub(crate) mod kit;
pub(crate) mod shaders;
mod skips;

use super::Gpu;
use crate::canvas::image::MapId;
use crate::canvas::{Kind, Renderer, Studio};
use crate::render::reference::Reference;
use kit::{Scene, device, gap};

#[test]
fn a_scene_is_opened_painted_and_shown_through_the_traits() {
    let Some(device) = device() else { return };
    let ours = Gpu::on(device).expect("a studio");
    assert_eq!((ours.adapter().kind, ours.adapter().shaders.len()), (Kind::Gpu, 32));
    let scene = Scene::bust([64, 48]);
    let open = |studio: &dyn Studio| studio.open(scene.maps.clone(), &scene.mesh).expect("a renderer");
    let mut renderers: [Box<dyn Renderer>; 2] = [open(&ours), open(&Reference::new())];
    let frames = renderers.each_mut().map(|renderer| {
        renderer.follow(&[]).expect("no painting");
        renderer.frame(&scene.job()).expect("a frame")
    });
    assert!(gap(&frames[0].image, &frames[1].image).mean < 0.02);
    for id in [MapId::Color, MapId::Normal, MapId::Occlusion, MapId::Specular, MapId::Discolor] {
        let [ours, theirs] = renderers.each_mut().map(|renderer| renderer.map(id).expect("a map"));
        assert_eq!(ours, theirs, "{id:?}");
    }
}
