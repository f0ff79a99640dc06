//! What whoever samples the built-in maps relies on.

use glam::DVec3;

use super::texels::Site;
use super::*;
use crate::mesh::{EdgeId, FaceId};

const ALL: [MapKind; 6] =
    [MapKind::Bust, MapKind::Sphere, MapKind::Slab, MapKind::Torus, MapKind::TwoFingers, MapKind::Grid];

fn mesh(kind: MapKind) -> Mesh {
    Mesh::build(&kind.mesh()).expect("a mesh")
}

/// Everything that is painted, so that two can be compared.
fn images(painted: &Painted) -> Vec<&Image> {
    let Painted { color, normal, occlusion, specular } = painted;
    [Some(color), normal.as_ref(), occlusion.as_ref(), specular.as_ref()].into_iter().flatten().collect()
}

#[test]
fn names_lead_to_maps_at_any_number_of_faces() {
    for listing in crate::assets::builtin::list() {
        let name = listing.name.replace('N', "2000");
        assert!(MapKind::of(&name).is_some(), "{name}");
    }
    assert_eq!(MapKind::of("bust:4000"), Some(MapKind::Bust));
    assert_eq!(MapKind::of("busts"), None);
}

/// One set of maps fits every number of faces, since each place of the bust is at the same place of the atlas.
#[test]
fn the_atlas_does_not_depend_on_the_number_of_faces() {
    let coarse = Mesh::build(&bust::bust(2_000)).expect("a mesh");
    let fine = mesh(MapKind::Bust);
    let side = 64;
    let (coarse, fine) = (Texels::new(&coarse, side), Texels::new(&fine, side));
    let place = |texels: &Texels<'_>| {
        let [image] = texels.paint([[0; 4]], |site| {
            let [x, y, z] = (site.position * 4.0 + 128.0).to_array().map(|c| c.clamp(0.0, 255.0) as u8);
            let inside = site.weights.iter().all(|&w| w >= 0.0);
            [[x, y, z, if inside { 2 } else { 1 }]]
        });
        image.texels
    };
    for (a, b) in place(&coarse).into_iter().zip(place(&fine)) {
        assert_eq!(a[3], b[3], "the charts cover the same texels");
        // A coarse face may lie some millimetres below the skin; 4 is a centimetre.
        let near = a.iter().zip(b).all(|(a, b)| a.abs_diff(b) <= 4);
        assert!(a[3] < 2 || near, "{a:?} {b:?}");
    }
}

#[test]
fn charts_go_on_beyond_their_borders() {
    for (kind, side) in [(MapKind::Bust, 256), (MapKind::Sphere, 128), (MapKind::TwoFingers, 100)] {
        let mesh = mesh(kind);
        let [painted] = Texels::new(&mesh, side).paint([[0; 4]], |site| {
            let inside = site.weights.iter().all(|&w| w >= 0.0);
            [[u8::from(inside), 0, 0, 255]]
        });
        let at = |x: u32, y: u32| painted.at(x, y);
        let (mut inside, mut beyond) = (0, 0);
        for (x, y) in (0..side).flat_map(|y| (0..side).map(move |x| (x, y))) {
            if at(x, y)[0] == 0 {
                beyond += u32::from(at(x, y)[3] == 255);
                continue;
            }
            inside += 1;
            let near = |c: u32| c.saturating_sub(4)..=(c + 4).min(side - 1);
            let blank = near(y).flat_map(|y| near(x).map(move |x| (x, y))).find(|&(x, y)| at(x, y)[3] == 0);
            assert_eq!(blank, None, "{kind:?}: near texel {x}, {y} of a chart");
        }
        assert!(inside > side * side / 4 && beyond > side, "{kind:?}: {inside} {beyond}");
    }
}

#[test]
fn any_number_of_threads_paints_the_same() {
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| paint(MapKind::Bust, 96))
    };
    let (one, three) = (with(1), with(3));
    assert_eq!(images(&one), images(&three));
    assert_eq!(images(&one).len(), 4);
}

#[test]
fn every_built_in_mesh_has_a_colour_map_of_skin() {
    for kind in ALL {
        let painted = paint(kind, 64);
        assert_eq!(painted.color.size, [64; 2]);
        assert_eq!(images(&painted).len(), if kind == MapKind::Bust { 4 } else { 1 });
        let mean = mean(&painted.color);
        // Skin is redder than green and greener than blue; it varies.
        assert!(mean[0] > mean[1] + 0.1 && mean[1] > mean[2] + 0.02 && mean[0] < 0.9, "{kind:?}: {mean:?}");
        assert!(painted.color.texels.iter().any(|t| *t != painted.color.texels[0]));
    }
}

fn mean(image: &Image) -> [f64; 4] {
    std::array::from_fn(|c| {
        let sum: u64 = image.texels.iter().map(|t| u64::from(t[c])).sum();
        sum as f64 / (255 * image.texels.len()) as f64
    })
}

/// The bust's texel that shows the place of its skin nearest to a point.
fn nearest(image: &Image, texels: &Texels<'_>, point: DVec3) -> [u8; 4] {
    let best = std::sync::Mutex::new((f64::INFINITY, [0; 4]));
    let side = f64::from(image.size[0]);
    let mesh = mesh(MapKind::Bust);
    texels.paint([[0; 4]], |site| {
        let uv: glam::DVec2 = (mesh.face(site.face).vertices.iter().zip(site.weights))
            .map(|(v, w)| mesh.vertex(*v).uv.as_dvec2() * w)
            .sum();
        let distance = site.position.distance(point);
        let mut best = best.lock().expect("held by none that panicked");
        if distance < best.0 {
            let at = [uv.x * side, (1.0 - uv.y) * side].map(|c| (c as u32).min(image.size[0] - 1));
            *best = (distance, image.at(at[0], at[1]));
        }
        [[0; 4]]
    });
    best.into_inner().expect("held by none that panicked").1
}

#[test]
fn the_busts_features_are_where_its_shape_has_them() {
    let mesh = mesh(MapKind::Bust);
    let texels = Texels::new(&mesh, 256);
    let Painted { color, occlusion, specular, .. } = paint(MapKind::Bust, 256);
    let (occlusion, specular) = (occlusion.expect("there"), specular.expect("there"));
    let color = |x: f64, y: f64, z: f64| nearest(&color, &texels, DVec3::new(x, y, z)).map(i32::from);
    let temple = color(6.0, 3.0, 3.0);
    for side in [-1.0, 1.0] {
        let brow = color(2.6 * side, 2.9, 8.0);
        assert!(brow[0] < temple[0] - 60 && brow[3] == 0, "dark, and without scattering: {brow:?}");
        let cheek = color(4.2 * side, -2.0, 6.6);
        assert!(cheek[0] - cheek[1] > temple[0] - temple[1] + 4, "flushed: {cheek:?} {temple:?}");
        let lips = color(0.8 * side, -6.1, 8.9);
        assert!(lips[0] - lips[1] > 50 && lips[0] < temple[0], "red and dark: {lips:?}");
    }
    assert_eq!(temple[3], 255);
    let forehead = nearest(&specular, &texels, DVec3::new(0.0, 5.6, 8.0));
    let cheek = nearest(&specular, &texels, DVec3::new(4.2, -2.0, 6.6));
    let lips = nearest(&specular, &texels, DVec3::new(0.8, -6.1, 8.9));
    assert!(forehead[0] > cheek[0] && forehead[1] < cheek[1], "an oily forehead: {forehead:?} {cheek:?}");
    assert!(lips[0] > cheek[0] && lips[1] < cheek[1], "wet lips: {lips:?}");
    let open = |x: f64, y: f64, z: f64| nearest(&occlusion, &texels, DVec3::new(x, y, z))[0];
    assert!(open(0.0, 11.8, -1.0) > 250, "the crown");
    assert!(open(0.0, -3.6, 8.6) < 235, "below the nose");
}

#[test]
fn normals_are_unit_and_flat_on_average() {
    let normal = paint(MapKind::Bust, 256).normal.expect("there");
    let decode = |v: u8| f64::from(v) / 127.5 - 1.0;
    let mut sum = [0.0; 2];
    for texel in &normal.texels {
        let [x, y, z, _] = texel.map(decode);
        assert!(((x * x + y * y + z * z).sqrt() - 1.0).abs() < 0.02 && z > 0.6, "{texel:?}");
        (sum[0], sum[1]) = (sum[0] + x, sum[1] + y);
    }
    let count = normal.texels.len() as f64;
    // 128 stands for 0, and is half a step above it.
    assert!(sum.iter().all(|s| (s / count - 0.5 / 127.5).abs() < 0.005), "{sum:?}");
    assert!(normal.texels.iter().filter(|t| t[0].abs_diff(128) > 4).count() > normal.texels.len() / 50);
}

/// On both sides of a seam the renderer finds the same normal, though the frames there differ.
#[test]
fn the_relief_has_no_seams() {
    let mesh = mesh(MapKind::Bust);
    let relief = Relief::new(0.05);
    let mut seams = 0;
    for e in 0..mesh.edge_count() {
        let edge = mesh.edge(EdgeId::of(e));
        let [one, other] = edge.faces.map(|f| seen(&mesh, &relief, f, EdgeId::of(e)));
        let same_frame = one.1.distance(other.1) < 1e-6;
        // The roots of the ears fold back on themselves and are left flat.
        if same_frame || one.2.x.abs() > 6.0 && one.2.z.abs() < 3.0 {
            continue;
        }
        seams += 1;
        assert!(one.0.distance(other.0) < 0.02, "{} {} at {}", one.0, other.0, one.2);
    }
    assert!(seams > 100, "{seams}");
}

/// In the middle of a face's side: the normal that its texel gives there, its tangent, and where it is.
fn seen(mesh: &Mesh, relief: &Relief, face: FaceId, edge: EdgeId) -> (DVec3, DVec3, DVec3) {
    let side = mesh.face(face).side(edge).expect("a side of its own");
    let mut weights = [0.5; 3];
    weights[(side + 2) % 3] = 0.0;
    let site = Site::on(mesh, face, weights);
    let [x, y, z] = [0, 1, 2].map(|c| f64::from(relief.texel(&site)[c]) / 127.5 - 1.0);
    let normal = (site.tangents[0] * x + site.tangents[1] * y + site.normal * z).normalize();
    (normal, site.tangents[0], site.position)
}
