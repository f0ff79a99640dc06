//! GP and PP: how a patch lies on sheets that a reader can unroll by hand, and what becomes of it in a run.

use glam::{DVec2, DVec3, Vec2};

use super::kit::{
    applied, carved, cut, cut_work, mode, painted, plate, run, sheet, sphere, state, state_with,
};
use crate::canvas::job::PaintFace;
use crate::canvas::look::{Distance, Look};
use crate::engine::wound::paint::Corner;
use crate::engine::wound::{Cut, Mode, Pick, State, Value, Work, Wound, WoundEvent};
use crate::engine::{Engine, Part, Start};
use crate::mesh::{FaceId, IndexedMesh, Mesh, NodeId, Surface};
use crate::report::Outcome;

/// The lower half of the square at column i and row j of a sheet of n x n squares.
fn lower(n: u32, i: u32, j: u32) -> FaceId {
    FaceId(2 * (j * n + i))
}

/// Every corner that was painted: where it is, and the (s, d) that it got.
fn corners(mesh: &Mesh, cut: &Cut) -> Vec<(DVec3, DVec2)> {
    let painted = cut.painted.as_ref().unwrap();
    let position = |corner| match corner {
        Corner::Node(node) => mesh.position(node),
        Corner::Point(i) => cut.formed.chain.points[i as usize].position,
    };
    let parts = painted.painting.paint.faces.iter().zip(&painted.corners);
    let of_part = |(face, corners): (&PaintFace, &[Corner; 3])| {
        [0, 1, 2].map(|i| (position(corners[i]), face.at[i].as_dvec2()))
    };
    parts.flat_map(of_part).collect()
}

/// How far the coordinates are from those on an unrolled sheet, given where its points lie when it is flat.
fn error(state: &State, cut: &Cut, unrolled: impl Fn(DVec3) -> DVec2) -> f64 {
    let points = &cut.formed.chain.points;
    let [from, to] = [points[0], points[points.len() - 1]].map(|p| unrolled(p.position));
    let along = (to - from).normalize();
    let expected = |p| DVec2::new(along.dot(unrolled(p) - from), along.perp_dot(unrolled(p) - from));
    corners(&state.mesh, cut).into_iter().map(|(p, at)| at.distance(expected(p))).fold(0.0, f64::max)
}

fn flat(i: u32, j: u32) -> DVec3 {
    DVec3::new(f64::from(i) - 8.0, f64::from(j) - 8.0, 0.0)
}

/// Rows of the texture that grow farther and farther apart, columns that lean.
fn stretched(i: u32, j: u32) -> Vec2 {
    let (x, y) = (i as f32 / 16.0, j as f32 / 16.0);
    Vec2::new(0.1 + 0.3 * x + 0.2 * y * y, 0.05 + 0.8 * y * y)
}

fn even(i: u32, j: u32) -> Vec2 {
    Vec2::new(i as f32, j as f32) / 16.0
}

/// From the left to the right and a little up, across the middle of a sheet of 16 x 16 squares.
fn across() -> (Pick, Pick) {
    (Pick::Face(lower(16, 3, 6), 0.31, 0.42), Pick::Face(lower(16, 11, 9), 0.27, 0.38))
}

#[test]
fn on_a_flat_sheet_the_coordinates_are_the_plane_whatever_the_texture() {
    let mut state = state(&sheet(16, flat, stretched));
    let (from, to) = across();
    let cut = painted(&mut state, from, to);
    assert!(error(&state, &cut, |p| p.truncate()) < 1e-5);
    // The sheet goes on beyond the line's ends, and the coordinates with it.
    let (job, all) = (&cut.painted.as_ref().unwrap().painting.paint, corners(&state.mesh, &cut));
    assert!(
        all.iter().any(|(_, at)| at.x < -1.0) && all.iter().any(|(_, at)| at.x > f64::from(job.length) + 1.0)
    );
    assert!(job.inner > 20 && job.faces.len() > job.inner + 40, "{} of {}", job.inner, job.faces.len());
}

#[test]
fn on_a_bent_sheet_the_coordinates_are_those_of_the_sheet_unrolled() {
    // Round an upright cylinder: each column turns by a tenth of a radian, so each square is as wide as its chord.
    let (radius, turn) = (9.0, 0.1f64);
    let bent = |i: u32, j: u32| {
        let angle = (f64::from(i) - 8.0) * turn;
        DVec3::new(radius * libm::sin(angle), f64::from(j) - 8.0, radius * libm::cos(angle))
    };
    let chord = 2.0 * radius * libm::sin(0.5 * turn);
    let unrolled = |p: DVec3| {
        // Which column's plane the point is in, and how far along its chord.
        let angle = libm::atan2(p.x, p.z) / turn + 8.0;
        let column = angle.floor().clamp(0.0, 15.0) as u32;
        let [a, b] = [bent(column, 0), bent(column + 1, 0)].map(|q| DVec2::new(q.x, q.z));
        let part = (DVec2::new(p.x, p.z) - a).dot(b - a) / (b - a).length();
        DVec2::new(f64::from(column) * chord + part, p.y)
    };
    let mut state = state(&sheet(16, bent, even));
    let (middle, high, low) = (Pick::Face(lower(16, 8, 3), 0.2, 0.5), [318.0, 60.0], [318.0, 290.0]);
    for (from, to) in [
        // Round the cylinder at the height of the eye, and along it.
        (Pick::Pixel([250.0, 180.0]), Pick::Pixel([400.0, 180.0])),
        (Pick::Pixel(low), Pick::Pixel(high)),
    ] {
        let cut = painted(&mut state, from, to);
        let error = error(&state, &cut, unrolled);
        assert!(error < 1e-4, "{from:?}: {error}");
    }
    // A line that is bent when unrolled is still at d = 0, and as long as it is.
    painted(&mut state, middle, Pick::Face(lower(16, 14, 12), 0.3, 0.3));
}

#[test]
fn over_a_seam_the_coordinates_go_on_and_its_sides_are_open() {
    // The right half of the sheet is a chart of its own, turned and elsewhere.
    let mut mesh = sheet(16, flat, |i, j| even(i, j) * 0.4);
    let count = mesh.uvs.len() as u32;
    mesh.uvs.extend(
        (0..=16).flat_map(|j| (0..=16).map(move |i| Vec2::new(0.9 - j as f32 / 60.0, 0.5 + i as f32 / 50.0))),
    );
    let right = |face: &[u32; 3]| face.iter().all(|&n| n % 17 >= 8);
    mesh.face_uvs.iter_mut().filter(|f| right(f)).for_each(|f| *f = f.map(|n| n + count));
    let mut state = state(&mesh);
    let (from, to) = across();
    let cut = painted(&mut state, from, to);
    assert!(error(&state, &cut, |p| p.truncate()) < 1e-5);
    let painted = cut.painted.as_ref().unwrap();
    // The seam, and the left end of the sheet.
    let on_border = |corner: &Corner, x: f64| match *corner {
        Corner::Node(node) => state.mesh.position(node).x == x,
        Corner::Point(i) => cut.formed.chain.points[i as usize].position.x == x,
    };
    let mut open = 0;
    for (face, corners) in painted.painting.paint.faces.iter().zip(&painted.corners) {
        for i in 0..3 {
            let is_open = face.open & 1 << i != 0;
            let lies_on = |x| [i, (i + 1) % 3].into_iter().all(|k| on_border(&corners[k], x));
            assert_eq!(is_open, lies_on(0.0) || lies_on(-8.0), "f{} side {i}", face.face);
            open += usize::from(lies_on(0.0));
        }
    }
    // A divided face on either side, and squares above and below.
    assert!(open >= 8 && open % 2 == 0, "{open}");
}

#[test]
fn a_sheets_boundary_is_open_and_ends_the_painting() {
    let mut state = state(&sheet(16, flat, even));
    let cut =
        painted(&mut state, Pick::Face(lower(16, 2, 15), 0.3, 0.2), Pick::Face(lower(16, 13, 15), 0.3, 0.2));
    let job = &cut.painted.as_ref().unwrap().painting.paint;
    let at_top = |f: &&PaintFace| (0..3).any(|i| f.open & 1 << i != 0);
    let top: Vec<&PaintFace> = job.faces.iter().filter(at_top).collect();
    assert!(top.len() >= 12, "{}", top.len());
    assert!(error(&state, &cut, |p| p.truncate()) < 1e-5);
}

#[test]
fn round_a_thin_finger_each_side_keeps_its_own_side() {
    // A box a unit wide and deep, 24 long, so that the discoloration would reach all round it, twice.
    let n = 24;
    let ring = [(0.0, 0.0), (1.0, 0.0), (1.0, -1.0), (0.0, -1.0)];
    let mut mesh = IndexedMesh::default();
    for j in 0..=n {
        mesh.positions.extend(ring.map(|(x, z)| DVec3::new(x - 0.5, f64::from(j) - 12.0, z)));
    }
    for j in 0..n {
        for k in 0..4 {
            let (a, b) = (4 * j + k, 4 * j + (k + 1) % 4);
            mesh.faces.extend([[a, b, b + 4], [a, b + 4, a + 4]]);
        }
    }
    let top = 4 * n;
    mesh.faces.extend([[0, 3, 2], [0, 2, 1], [top, top + 1, top + 2], [top, top + 2, top + 3]]);
    mesh.uvs = mesh
        .positions
        .iter()
        .map(|p| Vec2::new((p.x * 0.02 + 0.3) as f32, (p.y * 0.02 + 0.5) as f32))
        .collect();
    mesh.face_uvs = mesh.faces.clone();
    let mut state = state(&mesh);
    let cut = painted(&mut state, Pick::Face(FaceId(8 * 5), 0.3, 0.2), Pick::Face(FaceId(8 * 18), 0.3, 0.2));
    let (painted, points) = (cut.painted.as_ref().unwrap(), &cut.formed.chain.points);
    assert!(painted.painting.paint.height > 2.0 && !painted.torn.is_empty());
    assert!(points.iter().all(|p| p.position.z == 0.0), "the line is on the front");
    for (face, corners) in painted.painting.paint.faces.iter().zip(&painted.corners) {
        let d = face.at.map(|at| f64::from(at.y));
        let (least, most) =
            (d.iter().copied().fold(f64::MAX, f64::min), d.iter().copied().fold(f64::MIN, f64::max));
        assert!(least > -0.8 || most < 0.8, "f{} goes from d = {least} to {most}", face.face);
        // The line goes up: its left is where x is small.
        let along_a_wall =
            corners.iter().all(|c| matches!(c, Corner::Node(n) if state.mesh.position(*n).x == -0.5));
        assert!(!along_a_wall || least > 0.0, "f{}: {least}", face.face);
    }
}

#[test]
fn a_patch_is_as_large_as_the_line_has_texels() {
    // A square is a sixteenth of a map of 1024 texels, so a unit is 64 texels.
    let mut state = state(&sheet(16, flat, even));
    let cut = painted(&mut state, Pick::Node(NodeId(17 * 8 + 3)), Pick::Node(NodeId(17 * 8 + 8)));
    let patch = cut.patch.as_ref().unwrap();
    assert_eq!((patch.job.size, patch.length), ([320, 90], 5.0));
    assert!((patch.density - 64.0).abs() < 1e-6 && (patch.height - 5.0 * 90.0 / 320.0).abs() < 1e-12);
    let job = &cut.painted.as_ref().unwrap().painting.paint;
    assert!((job.noise_scale - 1.0 / 16.0).abs() < 1e-7, "{}", job.noise_scale);
    for (factor, range) in job.factor.iter().zip(Look::default().wound.discolor) {
        assert!((range[0]..=range[1]).contains(factor));
    }
}

#[test]
fn the_event_alone_says_what_chance_does() {
    let digest = |seed| {
        let mut state = state(&sheet(16, flat, even));
        let (from, to) = across();
        let event = WoundEvent::Cut { from, to };
        let Start::Run(mut work) = Wound::start(&mut state, &event, seed) else { panic!("a cut starts") };
        applied(&mut state, &mut work, &event);
        Wound::commit(&mut state, &mut work);
        state.paintings[0].digest()
    };
    assert_eq!(digest(5), digest(5));
    assert_ne!(digest(5), digest(6));
}

#[test]
fn undo_redo_and_rejection_leave_the_list_of_paintings_as_it_was() {
    let mut state = state(&sphere(3));
    let [a, b, c] = [[290.0, 170.0], [350.0, 190.0], [320.0, 120.0]].map(Pick::Pixel);
    assert_eq!(cut(&mut state, a, b).0, Outcome::Applied);
    let first = state.paintings.clone();
    let buffers = |state: &State| Wound::buffers(state).iter().map(|b| b.digest()).collect::<Vec<_>>();
    let before = buffers(&state);
    // Painted, and then rejected by CI: too short to open.
    let node = state.mesh.face(FaceId(7)).nodes[0];
    let close = Pick::Face(FaceId(7), 1e-13, 1e-13);
    assert_eq!(cut(&mut state, Pick::Node(node), close).0, Outcome::Rejected);
    assert_eq!((buffers(&state), Wound::paintings(&state)), (before.clone(), &first[..]));
    let event = WoundEvent::Cut { from: b, to: c };
    let Start::Run(mut work) = Wound::start(&mut state, &event, 3) else { panic!("a cut starts") };
    applied(&mut state, &mut work, &event);
    let edit = Wound::commit(&mut state, &mut work);
    let (second, after) = (state.paintings.clone(), buffers(&state));
    assert!(second.len() == 2 && Wound::patch_bytes(&edit) > second[1].bytes());
    Wound::revert(&mut state, &edit);
    assert_eq!((buffers(&state), &state.paintings), (before, &first));
    Wound::apply(&mut state, &edit);
    assert_eq!((buffers(&state), &state.paintings), (after, &second));
}

/// Which stages of a cut take part: their names, and why the others do not.
fn parts(state: &mut State, from: Pick, to: Pick) -> String {
    let event = WoundEvent::Cut { from, to };
    let Start::Run(mut work) = Wound::start(state, &event, 0) else { panic!("a cut starts") };
    let mut parts = Vec::new();
    for stage in Wound::STAGES {
        match (stage.part)(&work) {
            Part::Run => {
                (stage.run)(state, &mut work).unwrap();
                parts.push(stage.id.to_owned());
            }
            Part::Skip(reason) => parts.push(format!("{}: {reason}", stage.id)),
            Part::Absent => {}
        }
    }
    Wound::rollback(state, &mut work);
    parts.join(", ")
}

#[test]
fn every_mode_paints_what_has_texture_coordinates() {
    let mut textured = state(&sphere(3));
    let [a, b] = [[290.0, 170.0], [350.0, 190.0]].map(Pick::Pixel);
    for (m, rest) in
        [(Mode::Patch, "MC: mode, CI: mode"), (Mode::Merge, "MC, CI: mode"), (Mode::Carve, "MC, CI")]
    {
        mode(&mut textured, m);
        assert_eq!(parts(&mut textured, a, b), format!("FC, GP, PP, {rest}"));
    }
    let mut bare = state(&plate(8));
    let why = "FC, GP: no texture coordinates, PP: no texture coordinates, MC, CI";
    assert_eq!(parts(&mut bare, a, b), why);
    assert!(bare.paintings.is_empty());
}

#[test]
fn in_a_gutter_nothing_is_painted_and_beside_it_the_skin_is() {
    let mut state = state(&sphere(3));
    let gutter = carved(&mut state, Pick::Pixel([280.0, 180.0]), Pick::Pixel([360.0, 184.0])).gutter;
    let is_gutter = |mesh: &Mesh, f: FaceId| mesh.face(f).surface == Surface::Gutter;
    let mesh = &state.mesh;
    let bottom = gutter
        .iter()
        .flat_map(|&f| mesh.face(f).edges.map(|e| mesh.edge(e)))
        .find(|e| e.faces.iter().all(|&f| is_gutter(mesh, f)));
    let [a, b] = bottom.unwrap().nodes.map(Pick::Node);
    mode(&mut state, Mode::Patch);
    let why = "FC, GP: no skin along the line, PP: no skin along the line, MC: mode, CI: mode";
    assert_eq!(parts(&mut state, a, b), why);
    // Across the gutter from skin to skin: it counts in the length, and only skin is painted on either side.
    let over = cut_work(&mut state, Pick::Pixel([318.0, 150.0]), Pick::Pixel([322.0, 210.0]));
    assert!(over.formed.chain.links.iter().any(|l| is_gutter(&state.mesh, l.face)));
    let job = &over.painted.as_ref().unwrap().painting.paint;
    assert!(f64::from(job.length) > over.links.iter().map(|l| l.length).sum());
    assert!(job.faces.iter().all(|f| !is_gutter(&state.mesh, FaceId(f.face))));
    let has = |s: f32| job.faces.iter().any(|f| f.at.contains(&Vec2::new(s, 0.0)));
    assert!(has(0.0) && has(job.length));
}

#[test]
fn in_the_texture_the_patch_lies_as_the_texture_does() {
    let look = Look {
        wound: crate::canvas::look::Wound { distance: Distance::Texture, ..Default::default() },
        ..Look::default()
    };
    let (from, to) = across();
    let error_with = |uv: fn(u32, u32) -> Vec2| {
        let mut state = state_with(&sheet(16, flat, uv), look.clone());
        let cut = painted(&mut state, from, to);
        error(&state, &cut, |p| p.truncate())
    };
    assert!(error_with(even) < 1e-4, "{}", error_with(even));
    assert!(error_with(stretched) > 0.5, "{}", error_with(stretched));
}

#[test]
fn a_frame_shows_what_the_settings_say_and_undo_of_cuts_does_not_change_it() {
    let mut state = state(&sphere(2));
    let lit = Wound::frame(&state, 7, false).unwrap().lights[0].color;
    let values = [
        ("shadows", Value::Switch(false)),
        ("light-intensity", Value::Number(2.0)),
        ("ambient", Value::Number(0.25)),
    ];
    run(&mut state, &WoundEvent::Set(values.map(|(k, v)| (k.to_owned(), v)).into()));
    let control = Wound::control(&state);
    let frame = Wound::frame(&state, 7, true).unwrap();
    assert_eq!(frame.lights[0].color, lit.map(|c| 2.0 * c));
    assert!(!frame.switches.shadows && frame.switches.specular && frame.everything && frame.version == 7);
    assert_eq!((frame.look.ambient.intensity, frame.view.size), (0.25, [640, 360]));
    assert!(frame.view.near > 0.0 && frame.view.far > frame.view.near);
    assert_eq!(frame.origin, DVec3::ZERO);
    Wound::set_control(&mut state, control);
    assert!(!Wound::frame(&state, 7, false).unwrap().switches.shadows);
}

#[test]
fn what_is_shown_counts_the_patch_and_names_the_faces() {
    let mut state = state(&sheet(16, flat, even));
    let (from, to) = across();
    let event = WoundEvent::Cut { from, to };
    let Start::Run(mut work) = Wound::start(&mut state, &event, 0) else { panic!("a cut starts") };
    applied(&mut state, &mut work, &event);
    let shown = Wound::show(&state, &work);
    let Work::Cut(cut) = &work else { panic!("a cut is no subdivision") };
    let size = cut.patch.as_ref().unwrap().job.size;
    let count = |name: &str| serde_json::to_value(&shown.counters[name]).unwrap().as_u64().unwrap();
    assert_eq!([count("patch_width"), count("patch_height")], size.map(u64::from));
    assert!(count("patch_faces") > 0 && count("painted_faces") > count("patch_faces"));
    let overlay = serde_json::to_string(&shown.overlays).unwrap();
    assert!(overlay.contains("\"painted\""), "{overlay}");
}
