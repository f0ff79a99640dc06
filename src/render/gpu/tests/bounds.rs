//! Sizes at their ends: what fits is drawn, and what does not is an error, never a panic.

use wgpu::{BufferUsages, TextureFormat, TextureUsages};

use super::kit::{OnDevice, Scene, device, gap, own_device};
use crate::canvas::RenderError;
use crate::render::gpu::readback::Region;

#[test]
fn a_frame_of_any_small_size_is_the_reference_s() {
    let Some(device) = device() else { return };
    let mut scene = Scene::bust([1, 1]);
    let mut ours = OnDevice::new(&device, &scene);
    for size in [[1, 1], [17, 1], [1, 33], [65, 63], [16, 16]] {
        scene.view.size = size;
        let (frame, reference) = (ours.frame(&scene), scene.reference());
        let gap = gap(&frame.image, &reference.image);
        assert!(gap.mean < 0.1 && frame.image.size == size, "{size:?}: {gap:?}");
    }
}

#[test]
fn what_is_too_large_is_said() {
    let Some(device) = device() else { return };
    let mut scene = Scene::bust([8, 8]);
    let mut ours = OnDevice::new(&device, &scene);
    let before = ours.frame(&scene).image;
    let most = device.limits().max_texture_dimension_2d;
    for size in [[0, 5], [5, 0], [u32::MAX, 1], [most + 1, 1], [1, most + 1], [most, most]] {
        scene.view.size = size;
        let refused = ours.try_frame(&scene);
        assert!(matches!(refused, Err(RenderError::TooLarge(_))), "{size:?}: {refused:?}");
    }
    scene.view.size = [8, 8];
    let light = scene.lights[0];
    scene.look.shadows.size = 8192;
    scene.lights = vec![light; 9];
    let refused = ours.try_frame(&scene);
    assert!(matches!(refused, Err(RenderError::TooLarge(_))), "{refused:?}");
    // What was refused leaves nothing behind.
    scene.look.shadows.size = 1024;
    scene.lights = Scene::bust([8, 8]).lights;
    assert_eq!(ours.frame(&scene).image, before);
}

#[test]
fn a_scene_may_have_no_light_and_many() {
    let Some(device) = device() else { return };
    let mut scene = Scene::bust([48, 32]);
    let mut ours = OnDevice::new(&device, &scene);
    let light = scene.lights[0];
    scene.look.shadows.size = 64;
    for count in [0, 40] {
        scene.lights = vec![light; count];
        scene.lights.iter_mut().for_each(|light| light.color = light.color.map(|c| c / 40.0));
        let gap = gap(&ours.frame(&scene).image, &scene.reference().image);
        assert!(gap.mean < 0.02 && gap.outliers < 0.001, "{count}: {gap:?}");
    }
}

/// Numbers that a scene or a mesh may hold, and that are of no use.
#[test]
fn no_number_is_too_wild() {
    let Some(device) = device() else { return };
    for wild in [f32::NAN, f32::INFINITY, -1.0, 0.0, 1e38] {
        let mut scene = Scene::bust([32, 32]);
        scene.look.skin.bumpiness = wild;
        scene.look.skin.specular = wild;
        scene.look.scattering.width_cm = wild;
        scene.look.scattering.strength = [wild; 3];
        scene.look.ambient.intensity = wild;
        scene.look.background.0 = [wild; 3];
        scene.lights[0].color = [wild; 3];
        scene.lights[0].cos_inner = scene.lights[0].cos_outer;
        for id in 0..50 {
            let mut vertex = scene.mesh.vertex(crate::mesh::VertexId(id));
            (vertex.uv.x, vertex.normal.y, vertex.tangent.z) = (wild, wild, wild);
            scene.mesh.set_vertex(crate::mesh::VertexId(id), vertex);
        }
        let frame = OnDevice::new(&device, &scene).frame(&scene);
        assert!(frame.image.texels.iter().all(|texel| texel[3] == 255), "{wild}");
    }
}

#[test]
fn any_region_of_a_texture_is_read_as_it_was_written() {
    let Some(device) = device() else { return };
    let size = [67, 5];
    let texels: Vec<[u8; 4]> = (0..67 * 5).map(|i| [i as u8, (i / 256) as u8, 7, 9]).collect();
    let image = crate::canvas::image::Image { size, texels };
    let texture = device.upload("it", &image, TextureUsages::COPY_SRC).expect("a texture");
    let read = |origin: [u32; 2], size| {
        device.read_texture(&texture, Region { origin, size, texel: 4 }).expect("its texels")
    };
    assert_eq!(read([0, 0], size), image.bytes());
    assert_eq!(read([66, 4], [1, 1]), image.at(66, 4));
    assert_eq!(
        read([3, 1], [2, 2]).as_chunks().0,
        [(3, 1), (4, 1), (3, 2), (4, 2)].map(|(x, y)| image.at(x, y))
    );
}

#[test]
fn a_buffer_is_read_as_it_was_written() {
    let Some(device) = device() else { return };
    let bytes: Vec<u8> = (0..64).collect();
    let buffer = device.filled("it", &bytes, BufferUsages::COPY_SRC).expect("a buffer");
    assert_eq!(device.read_buffer(&buffer, 8..20).expect("its bytes"), bytes[8..20]);
    let refused = device.read_buffer(&buffer, 8..900);
    assert!(matches!(refused, Err(RenderError::Refused(_))), "{refused:?}");
}

#[test]
fn what_the_device_refuses_is_an_error_and_the_next_command_is_none() {
    let Some(device) = device() else { return };
    let huge = device.buffer("huge", u64::MAX, BufferUsages::STORAGE);
    assert!(matches!(huge, Err(RenderError::TooLarge(_))), "{huge:?}");
    // It has no texel.
    let wrong = device.guarded("wrong", || {
        device.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width: 0, height: 4, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: TextureFormat::R8Unorm,
            usage: TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        })
    });
    assert!(matches!(wrong, Err(RenderError::Refused(_))), "{wrong:?}");
    assert_eq!(device.shader("nobody").map(drop), Err(RenderError::Refused("no shader nobody".into())));
    assert_eq!(device.wait(), Ok(()));
}

/// Outside of any guarded block an error is kept until the next one.
#[test]
fn an_error_that_nobody_awaited_is_told_later() {
    let Some(device) = own_device() else {
        eprintln!("skipped: no adapter");
        return;
    };
    let buffer = device.buffer("it", 4, BufferUsages::UNIFORM).expect("a buffer");
    device.queue.write_buffer(&buffer, 0, &[0; 4]);
    let told = device.wait();
    assert!(matches!(told, Err(RenderError::Refused(_))), "{told:?}");
    assert_eq!(device.wait(), Ok(()));
}

#[test]
fn a_lost_device_is_said_for_ever() {
    let Some(device) = own_device() else {
        eprintln!("skipped: no adapter");
        return;
    };
    device.device.destroy();
    let told = [device.wait(), device.buffer("it", 4, BufferUsages::UNIFORM).map(drop), device.wait()];
    assert!(told[1..].iter().all(|told| matches!(told, Err(RenderError::Lost(_)))), "{told:?}");
}
