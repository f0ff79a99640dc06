//! Maps as scenes ask for them: files, defaults, built-in ones; and everything that can be wrong with a file.

use std::fs;

use image_dds::ddsfile::{AlphaMode, D3D10ResourceDimension, Dds, DxgiFormat, NewDxgiParams};

use super::*;
use crate::assets::{CacheOptions, Loaded, open};
use crate::recording::SceneRef;

const SQUARE: &str =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";

/// A folder with a textured and a plain square, and these files beside.
fn folder(files: &[(&str, &[u8])]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let plain = SQUARE.replace("/1", "").replace("/2", "").replace("/3", "").replace("/4", "");
    let usual = [("square.obj", SQUARE.as_bytes()), ("plain.obj", plain.as_bytes())];
    for (name, bytes) in usual.iter().chain(files) {
        fs::write(folder.path().join(name), bytes).expect("written");
    }
    folder
}

fn open_scene(folder: &tempfile::TempDir, scene: &str) -> Result<Loaded, AssetError> {
    fs::write(folder.path().join("scene.json"), scene).expect("written");
    open(&SceneRef::File("scene.json".into()), folder.path(), &CacheOptions::off())
}

fn maps(folder: &tempfile::TempDir, scene: &str) -> Arc<Maps> {
    let loaded = open_scene(folder, scene).expect("a scene");
    let maps = loaded.maps.load().expect("maps");
    assert_eq!(maps.color.size, loaded.maps.color_size());
    maps
}

/// A picture in which every texel is another.
fn picture(size: [u32; 2], alpha: u8) -> Image {
    let texel = |i: u32| [(i * 7) as u8, (i * 29) as u8, (i * 3) as u8, alpha];
    Image { size, texels: (0..size[0] * size[1]).map(texel).collect() }
}

fn png(image: &Image) -> Vec<u8> {
    write_png(image).expect("a file")
}

fn encoded(image: image::DynamicImage, format: image::ImageFormat) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image.write_to(&mut bytes, format).expect("a file");
    bytes.into_inner()
}

fn jpeg(size: [u32; 2], texel: [u8; 3]) -> Vec<u8> {
    let image = image::RgbImage::from_pixel(size[0], size[1], image::Rgb(texel));
    encoded(image.into(), image::ImageFormat::Jpeg)
}

fn dds(size: [u32; 2], format: DxgiFormat, layers: u32, data: &[u8]) -> Vec<u8> {
    let mut dds = Dds::new_dxgi(NewDxgiParams {
        height: size[1],
        width: size[0],
        depth: None,
        format,
        mipmap_levels: None,
        array_layers: (layers > 1).then_some(layers),
        caps2: None,
        is_cubemap: false,
        resource_dimension: D3D10ResourceDimension::Texture2D,
        alpha_mode: AlphaMode::Straight,
    })
    .expect("a format");
    dds.data = data.to_vec();
    let mut bytes = Vec::new();
    dds.write(&mut bytes).expect("written");
    bytes
}

#[test]
fn what_a_scene_does_not_have_is_at_its_default() {
    let folder = folder(&[]);
    let look = r#""skin": {"albedo": [1, 0.5, 0], "intensity": 0.2, "roughness": 0.4}"#;
    let textured = maps(&folder, &format!(r#"{{"mesh": "square.obj", {look}}}"#));
    assert_eq!(textured.color, Image::filled([1024; 2], [255, 128, 0, 255]));
    assert_eq!(textured.normal, Image::filled([1; 2], [128, 128, 255, 255]));
    assert_eq!(textured.occlusion, Image::filled([1; 2], [255; 4]));
    assert_eq!(textured.specular, Image::filled([1; 2], [51, 102, 0, 255]));
    let plain = maps(&folder, r#"{"mesh": "plain.obj"}"#);
    assert_eq!(plain.color, Image::filled([1; 2], [204, 158, 135, 255]));
}

#[test]
fn files_are_read_from_beside_the_scene() {
    let [color, normal, occlusion, specular] =
        [[4, 2], [3, 3], [2, 2], [5, 1]].map(|size| picture(size, 255));
    let files = [("c.png", &color), ("n.png", &normal), ("o.png", &occlusion), ("s.png", &specular)]
        .map(|(name, image)| (name, png(image)));
    let folder = folder(&files.each_ref().map(|(name, bytes)| (*name, bytes.as_slice())));
    let named = r#""maps": {"color": "c.png", "normal": "n.png", "occlusion": "o.png", "specular": "s.png"}"#;
    let maps = maps(&folder, &format!(r#"{{"mesh": "square.obj", {named}}}"#));
    assert_eq!(*maps, Maps { color, normal, occlusion, specular });
}

#[test]
fn scattering_stands_in_for_the_colour_maps_alpha() {
    let (color, strength) = (picture([4, 2], 9), picture([4, 2], 255));
    let (color, strength) = (png(&color), png(&strength));
    let folder =
        folder(&[("c.png", &color), ("s.png", &strength), ("wide.png", &png(&picture([5, 2], 255)))]);
    let found = maps(&folder, r#"{"mesh": "square.obj", "maps": {"color": "c.png", "scattering": "s.png"}}"#);
    let (given, strength) = (picture([4, 2], 9), picture([4, 2], 255));
    for ((found, given), strength) in found.color.texels.iter().zip(given.texels).zip(strength.texels) {
        assert_eq!(*found, [given[0], given[1], given[2], strength[0]]);
    }
    let alone = maps(&folder, r#"{"mesh": "square.obj", "maps": {"scattering": "s.png"}}"#);
    assert_eq!(alone.color.size, [4, 2], "an even colour has the size of its scattering");
    let wide = r#"{"mesh": "square.obj", "maps": {"color": "c.png", "scattering": "wide.png"}}"#;
    let error = open_scene(&folder, wide).expect_err("another size");
    assert!(error.path.ends_with("wide.png") && error.fault.place == Place::Field("maps.scattering".into()));
    assert!(error.to_string().ends_with("is 5 x 2, but the colour map 4 x 2"), "{error}");
}

#[test]
fn grey_and_sixteen_bits_are_read_too() {
    use image::ImageFormat::Png;
    let grey = image::GrayImage::from_pixel(2, 1, image::Luma([77]));
    assert_eq!(decode::decode(&encoded(grey.into(), Png)), Ok(Image::filled([2, 1], [77, 77, 77, 255])));
    let half = image::GrayAlphaImage::from_pixel(1, 1, image::LumaA([77, 5]));
    assert_eq!(decode::decode(&encoded(half.into(), Png)), Ok(Image::filled([1; 2], [77, 77, 77, 5])));
    let deep = image::ImageBuffer::from_pixel(1, 2, image::Rgba([0xffff_u16, 0x8080, 0x0180, 0x0100]));
    let deep = encoded(image::DynamicImage::ImageRgba16(deep), Png);
    assert_eq!(decode::decode(&deep), Ok(Image::filled([1, 2], [255, 128, 1, 1])));
    let found = decode::decode(&jpeg([24, 16], [200, 120, 90])).expect("an image");
    assert_eq!((found.size, found.texels[0][3]), ([24, 16], 255));
    assert!(found.texels[0].iter().zip([200, 120, 90]).all(|(a, b)| a.abs_diff(b) <= 3));
}

#[test]
fn dds_is_read_with_and_without_blocks() {
    let given = picture([3, 2], 200);
    let plain = dds([3, 2], DxgiFormat::R8G8B8A8_UNorm, 1, given.bytes());
    assert_eq!(decode::size(&plain), Ok([3, 2]));
    assert_eq!(decode::decode(&plain), Ok(given.clone()));
    // A block of BC1: red and blue in 5:6:5, the first half of the texels the first.
    let block = [0x00, 0xf8, 0x1f, 0x00, 0x00, 0x00, 0x55, 0x55];
    let found = decode::decode(&dds([4, 4], DxgiFormat::BC1_UNorm, 1, &block)).expect("an image");
    assert_eq!((found.at(0, 0), found.at(3, 3)), ([255, 0, 0, 255], [0, 0, 255, 255]));
    let short = dds([3, 2], DxgiFormat::R8G8B8A8_UNorm, 1, &given.bytes()[..20]);
    assert!(decode::decode(&short).is_err());
    let array = dds([3, 1], DxgiFormat::R8G8B8A8_UNorm, 2, given.bytes());
    assert_eq!(decode::decode(&array).expect_err("two pictures").kind, FaultKind::Unsupported);
}

#[test]
fn a_jpeg_without_its_end_is_refused() {
    let whole = jpeg([64, 64], [200, 120, 90]);
    assert!(decode::decode(&whole).is_ok());
    let half = decode::decode(&whole[..whole.len() - 2]).expect_err("its end is missing");
    assert!(half.detail.contains("the end of the image"), "{half:?}");
}

/// Every byte of small files damaged, and every length: an image or an error, never a panic.
#[test]
fn damaged_files_are_errors_or_images() {
    let block = [0x00, 0xf8, 0x1f, 0x00, 0x00, 0x00, 0x55, 0x55];
    let files = [
        png(&picture([5, 4], 17)),
        jpeg([16, 8], [9, 99, 199]),
        dds([3, 2], DxgiFormat::R8G8B8A8_UNorm, 1, picture([3, 2], 9).bytes()),
        dds([4, 4], DxgiFormat::BC1_UNorm, 1, &block),
    ];
    for whole in files {
        assert!(decode::decode(&whole).is_ok());
        let header = whole.len().min(400);
        for at in 0..header {
            for flip in [0x01, 0x80, 0xff] {
                let mut bytes = whole.clone();
                bytes[at] ^= flip;
                assert_sound(decode::decode(&bytes));
            }
            assert_sound(decode::decode(&whole[..at]));
        }
        assert!(decode::decode(&whole[..20]).is_err(), "a header cut off");
    }
}

fn assert_sound(found: Result<Image, Fault>) {
    if let Ok(image) = found {
        assert_eq!(image.texels.len(), image.size[0] as usize * image.size[1] as usize);
        assert!(!image.texels.is_empty());
    }
}

#[test]
fn a_header_alone_allocates_nothing() {
    let giant = |width: u32, height: u32| {
        let mut bytes = dds([1, 1], DxgiFormat::R8G8B8A8_UNorm, 1, &[0; 4]);
        bytes[12..16].copy_from_slice(&height.to_le_bytes());
        bytes[16..20].copy_from_slice(&width.to_le_bytes());
        decode::size(&bytes).expect_err("too large").kind
    };
    assert_eq!(giant(16385, 1), FaultKind::TooLarge);
    assert_eq!(giant(1, u32::MAX), FaultKind::TooLarge);
    assert_eq!(giant(16384, 16384), FaultKind::Truncated);
    assert_eq!(giant(0, 4), FaultKind::Empty);
    let mut png = png(&picture([5, 4], 17));
    // Width, height and the checksum of the header.
    png[16..24].copy_from_slice(&[0, 0, 0x40, 0, 0, 0, 0x40, 0]);
    assert!(decode::size(&png).is_err());
}

#[test]
fn png_keeps_every_texel() {
    for image in [picture([5, 4], 255), picture([1, 1], 0), picture([300, 2], 128)] {
        let bytes = png(&image);
        assert_eq!(read_png(&bytes), Ok(image.clone()));
        assert_eq!(png(&image), bytes);
        let opaque = image.texels[0][3] == 255;
        // The colour type in the header: 2 without alpha, 6 with it.
        assert_eq!(bytes[25], if opaque { 2 } else { 6 });
    }
    assert!(write_png(&Image::default()).is_err());
    assert!(read_png(&jpeg([8, 8], [0; 3])).is_err(), "goldens are PNG files");
    let mut bytes = png(&picture([5, 4], 255));
    let middle = bytes.len() / 2;
    bytes[middle] ^= 0x10;
    assert!(read_png(&bytes).is_err(), "a golden with a wrong bit");
}

#[test]
fn errors_name_the_maps_file_and_its_cause() {
    let folder = folder(&[("text.png", b"no image"), ("cut.jpg", &jpeg([16, 16], [9; 3])[..30])]);
    let error = |map: &str| {
        let scene = format!(r#"{{"mesh": "square.obj", "maps": {{"normal": "{map}"}}}}"#);
        open_scene(&folder, &scene).expect_err("not a map").to_string()
    };
    assert!(error("text.png").ends_with("text.png: is no PNG, JPEG or DDS image"));
    assert!(error("cut.jpg").contains("cut.jpg: "));
    assert!(error("none.png").contains("none.png: "));
    assert!(error(".").ends_with("is not a file"));
}

#[test]
fn a_file_that_changes_behind_the_scene_is_refused() {
    let folder = folder(&[("n.png", &png(&picture([2, 2], 255)))]);
    let scene = r#"{"mesh": "square.obj", "maps": {"normal": "n.png"}}"#;
    let loaded = open_scene(&folder, scene).expect("a scene");
    fs::write(folder.path().join("n.png"), png(&picture([2, 3], 255))).expect("written");
    let error = loaded.maps.load().expect_err("another file").to_string();
    assert!(error.ends_with("n.png: has changed since the scene was opened"), "{error}");
    let again = open_scene(&folder, scene).expect("a scene");
    assert_ne!(again.scene_hash, loaded.scene_hash, "what is in a map's file belongs to the scene");
}

#[test]
fn a_picture_of_the_surroundings_becomes_the_looks_irradiance() {
    let folder = folder(&[("sky.png", &png(&Image::filled([8, 4], [255, 0, 188, 255])))]);
    let scene = r#"{"mesh": "square.obj", "maps": {"irradiance": "sky.png"}}"#;
    let loaded = open_scene(&folder, scene).expect("a scene");
    let [r, g, b] = loaded.settings.look.ambient.irradiance[0];
    assert!((r - 1.0).abs() < 1e-6 && g == 0.0 && (b - 0.503).abs() < 1e-3, "{r} {g} {b}");
    let plain = open_scene(&folder, r#"{"mesh": "square.obj"}"#).expect("a scene");
    assert_ne!(loaded.scene_hash, plain.scene_hash);
}

#[test]
fn built_in_maps_are_made_once_and_give_way_to_files() {
    let torus = MapSources::new(Some("torus"), true, &Skin::default()).with_side(32);
    let (once, again) = (torus.load().expect("maps"), torus.load().expect("maps"));
    assert!(Arc::ptr_eq(&once, &again));
    assert_eq!((torus.color_size(), once.color.size), ([32; 2], [32; 2]));
    let sphere = |name| MapSources::new(Some(name), true, &Skin::default()).with_side(32).load();
    assert!(Arc::ptr_eq(&sphere("sphere:80").expect("maps"), &sphere("sphere:2000").expect("maps")));
    let rough = Skin { roughness: 0.8, ..Skin::default() };
    let rough = MapSources::new(Some("torus"), true, &rough).with_side(32).load().expect("maps");
    assert_eq!((rough.specular.at(0, 0)[1], &rough.color), (204, &once.color));

    let folder = folder(&[("n.png", &png(&picture([2, 2], 255)))]);
    let named = MapFiles { normal: Some("n.png".into()), ..MapFiles::default() };
    let given = torus.with_files(&named, folder.path()).expect("a file").load().expect("maps");
    assert_eq!((&given.color, &given.normal), (&once.color, &picture([2, 2], 255)));
}

#[test]
fn a_built_in_scene_has_its_own_maps_however_it_is_named() {
    let folder = folder(&[]);
    let by_name =
        open(&SceneRef::Builtin("bust".into()), folder.path(), &CacheOptions::off()).expect("a scene");
    let by_file = open_scene(&folder, r#"{"mesh": "builtin:bust"}"#).expect("a scene");
    assert_eq!(by_name.maps, by_file.maps);
    assert_eq!(by_name.scene_hash, by_file.scene_hash);
    assert_eq!(by_name.maps.color_size(), [1024; 2]);
    let maps = by_name.maps.with_side(64).load().expect("maps");
    let sizes = [&maps.color, &maps.normal, &maps.occlusion, &maps.specular].map(|map| map.size);
    assert_eq!(sizes, [[64; 2]; 4]);
}
