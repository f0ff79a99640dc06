//! The cage that the bust is refined from: its nodes as rays, its faces, and its nine charts.
//!
//! The tube around the head has 24 columns and eleven rows of nodes. Column 0 looks along +z, columns grow towards +x. Rows 0 to
//! 6 are the head's, seen from inside it; rows 6 to 10 the neck's, seen from points further and further down its axis. A chart
//! lays a part of it out flat: the head's by azimuthal equidistant projection, the neck as a band, the ears as squares.
//! Diagonals mirror each other left and right.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3, dvec2, dvec3};

use super::atlas::Atlas;
use super::bisect::Start;
use super::bust::Site;

const COLUMNS: usize = 24;
const ROWS: usize = 10;
/// The last row of nodes that belongs to the head.
const JAW_ROW: usize = 6;
/// Azimuths of columns 0 to 12, degrees; the other half mirrors them.
const AZIMUTHS: [f64; 13] =
    [0.0, 15.0, 32.0, 50.0, 67.0, 83.5, 97.3, 111.0, 122.0, 134.0, 149.0, 164.5, 180.0];
/// Where the rays of each row start, y and z in cm, and their elevation in degrees: at the nape and the sides.
const RAYS: [[f64; 3]; ROWS + 1] = [
    [0.0, 0.0, 45.0],
    [0.0, 0.0, 31.0],
    [0.0, 0.0, 16.5],
    [0.0, 0.0, -4.0],
    [0.0, 0.0, -24.5],
    [-1.0, 0.0, -32.0],
    [-2.0, 0.0, -40.0],
    [-5.0, -0.6, -33.0],
    [-8.0, -1.8, -27.0],
    [-11.5, -2.4, -14.0],
    [-12.5, -2.4, -26.0],
];
/// The same in the middle of the face, from higher up, so that the undersides of nose, lips and chin are seen from inside.
const FACE_RAYS: [[f64; 3]; ROWS + 1] = [
    RAYS[0],
    [0.5, 1.0, 34.0],
    [1.0, 2.0, 15.0],
    [1.0, 2.0, -12.5],
    [-0.5, 2.0, -25.0],
    [-5.0, 2.0, -13.6],
    [-5.0, 2.0, -39.0],
    [-6.0, 0.5, -38.0],
    [-8.0, -1.5, -30.0],
    RAYS[9],
    RAYS[10],
];
/// How far down the neck's chart each of its rows lies, cm.
const NECK_CM: [f64; 5] = [0.0, 2.6, 4.8, 7.3, 10.2];
/// Radius at which the neck's chart is unrolled, cm.
const NECK_RADIUS_CM: f64 = 6.0;
/// Distance at which the head's charts are projected, cm; the face gets more texels than its share.
const HEAD_RADIUS_CM: f64 = 9.0;
const FACE_RADIUS_CM: f64 = 12.0;
/// Where the rays to the base are cut by the chart's plane, cm below their start.
const BASE_CM: f64 = 3.0;
/// Half the side of an ear's chart, cm.
const EAR_CM: f64 = 3.2;

/// The parts of the atlas.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Chart {
    Face,
    Left,
    Right,
    Back,
    Crown,
    Neck,
    Base,
    LeftEar,
    RightEar,
}

const CHARTS: usize = 9;

/// A corner of a quadrilateral: its node, and its place in the chart, cm.
type Corner = (u32, DVec2);

/// The whole cage.
pub(super) fn cage() -> Start<Site> {
    let mut cage = Cage { sites: tube_sites(), triangles: Vec::new() };
    cage.add_tube();
    cage.add_disc(Chart::Crown, 0);
    cage.add_disc(Chart::Base, ROWS);
    cage.into_start()
}

/// The cage while it is built; corners in the order that bisection wants.
struct Cage {
    sites: Vec<Site>,
    triangles: Vec<(Chart, [Corner; 3])>,
}

impl Cage {
    fn add_tube(&mut self) {
        for (row, column) in (0..ROWS).flat_map(|r| (0..COLUMNS).map(move |c| (r, c))) {
            let chart = tube_chart(column, row);
            let quad = [(0, 0), (0, 1), (1, 1), (1, 0)].map(|(c, r)| {
                let node = tube_node(column + c, row + r);
                let place = match chart {
                    Chart::Neck => neck_place((column + COLUMNS / 2) % COLUMNS + c, row + r),
                    _ => head_place(chart, &self.sites[node as usize]),
                };
                (node, place)
            });
            let falling = match chart {
                Chart::LeftEar | Chart::RightEar => (column % 2 == 1) == (row % 2 == 0),
                _ => column < COLUMNS / 2,
            };
            self.add_quad(chart, quad, falling);
        }
    }

    /// A disc of 6 by 6 quadrilaterals inside a row of the tube. Its grid runs along x and z.
    fn add_disc(&mut self, chart: Chart, row: usize) {
        let at = match chart {
            Chart::Crown => [(0, 0), (0, 1), (1, 1), (1, 0)],
            _ => [(0, 0), (1, 0), (1, 1), (0, 1)],
        };
        let nodes: Vec<u32> = (0..7)
            .flat_map(|b| (0..7).map(move |a| (a, b)))
            .map(|(a, b)| self.disc_node(row, a, b))
            .collect();
        for (b, a) in (0..6).flat_map(|b| (0..6).map(move |a| (b, a))) {
            let quad = at.map(|(i, k)| nodes[(b + k) * 7 + a + i]);
            let quad = quad.map(|n| (n, head_place(chart, &self.sites[n as usize])));
            self.add_quad(chart, quad, (a < 3) == (b < 3));
        }
    }

    fn disc_node(&mut self, row: usize, a: usize, b: usize) -> u32 {
        if let Some(column) = rim_column(a, b) {
            return tube_node(column, row);
        }
        let (q, [y, z, elevation]) = (disc_point(a, b), RAYS[row]);
        let (up, flat) = libm::sincos(elevation.to_radians());
        self.sites.push(Site::skin(dvec3(0.0, y, z), dvec3(q.x * flat, up, q.y * flat)));
        self.sites.len() as u32 - 1
    }

    /// Two triangles; `falling` if the diagonal joins the first and the third corner.
    fn add_quad(&mut self, chart: Chart, [p, q, r, s]: [Corner; 4], falling: bool) {
        let pair = if falling { [[r, p, q], [p, r, s]] } else { [[q, s, p], [s, q, r]] };
        self.triangles.extend(pair.map(|t| (chart, t)));
    }

    /// Packs the charts; a node gets one texture coordinate for each place that it has in a chart.
    fn into_start(self) -> Start<Site> {
        let bounds = self.bounds();
        let atlas = Atlas::pack(&bounds.map(|(low, high)| high - low));
        let mut known = BTreeMap::new();
        let mut start = Start { sites: self.sites, faces: Vec::new(), uvs: Vec::new(), face_uvs: Vec::new() };
        for (chart, corners) in self.triangles {
            let chart = chart as usize;
            start.faces.push(corners.map(|(node, _)| node));
            start.face_uvs.push(corners.map(|(node, place)| {
                *known.entry((chart, node, place.to_array().map(f64::to_bits))).or_insert_with(|| {
                    start.uvs.push(atlas.uv(chart, place - bounds[chart].0));
                    start.uvs.len() as u32 - 1
                })
            }));
        }
        start
    }

    fn bounds(&self) -> [(DVec2, DVec2); CHARTS] {
        let mut bounds = [(DVec2::INFINITY, DVec2::NEG_INFINITY); CHARTS];
        for (chart, corners) in &self.triangles {
            let (low, high) = &mut bounds[*chart as usize];
            for (_, place) in corners {
                (*low, *high) = (low.min(*place), high.max(*place));
            }
        }
        bounds
    }
}

fn tube_sites() -> Vec<Site> {
    (0..=ROWS).flat_map(|row| (0..COLUMNS).map(move |column| tube_site(column, row))).collect()
}

fn tube_node(column: usize, row: usize) -> u32 {
    (row * COLUMNS + column % COLUMNS) as u32
}

fn tube_site(column: usize, row: usize) -> Site {
    let s = match column {
        5..=7 => 6.0 - column as f64,
        17..=19 => column as f64 - 18.0,
        _ => 2.0,
    };
    if s < 2.0 && (2..=4).contains(&row) {
        let side = if column < COLUMNS / 2 { 1.0 } else { -1.0 };
        return Site::Ear { side, s, t: 3.0 - row as f64, reach: 0.0 };
    }
    let q = heading(column);
    let faceward = 0.25 * (1.0 + q.y) * (1.0 + q.y);
    let [y, z, elevation] = [0, 1, 2].map(|k| RAYS[row][k] + (FACE_RAYS[row][k] - RAYS[row][k]) * faceward);
    let (up, flat) = libm::sincos(elevation.to_radians());
    Site::skin(dvec3(0.0, y, z), dvec3(q.x * flat, up, q.y * flat))
}

fn tube_chart(column: usize, row: usize) -> Chart {
    match (column, row) {
        (_, JAW_ROW..) => Chart::Neck,
        (5 | 6, 2 | 3) => Chart::RightEar,
        (17 | 18, 2 | 3) => Chart::LeftEar,
        (3..=8, _) => Chart::Right,
        (9..=14, _) => Chart::Back,
        (15..=20, _) => Chart::Left,
        _ => Chart::Face,
    }
}

/// Azimuth of a column, radians, from −π to π.
fn azimuth(column: usize) -> f64 {
    if column <= COLUMNS / 2 {
        AZIMUTHS[column].to_radians()
    } else {
        -AZIMUTHS[COLUMNS - column].to_radians()
    }
}

/// A column's direction seen from above, as (x, z); exactly in the plane of symmetry where it should be.
fn heading(column: usize) -> DVec2 {
    let (sin, cos) = libm::sincos(azimuth(column));
    dvec2(if column.is_multiple_of(COLUMNS / 2) { 0.0 } else { sin }, cos)
}

/// The column of the tube at the border of a disc, where its grid's node (a, b) is on it.
fn rim_column(a: usize, b: usize) -> Option<usize> {
    match (a, b) {
        (_, 6) => Some((21 + a) % COLUMNS),
        (6, _) => Some(9 - b),
        (_, 0) => Some(15 - a),
        (0, _) => Some(15 + b),
        _ => None,
    }
}

/// An inner node of a disc's grid, as (x, z) in the unit disc: the border blended bilinearly (Coons), mirrored at x = 0.
fn disc_point(a: usize, b: usize) -> DVec2 {
    if a > 3 {
        return disc_point(6 - a, b) * dvec2(-1.0, 1.0);
    }
    let rim = |a: usize, b: usize| rim_column(a, b).map_or(DVec2::ZERO, heading);
    let (u, v) = (a as f64 / 6.0, b as f64 / 6.0);
    let sides = rim(a, 0).lerp(rim(a, 6), v) + rim(0, b).lerp(rim(6, b), u);
    let corners = rim(0, 0).lerp(rim(6, 0), u).lerp(rim(0, 6).lerp(rim(6, 6), u), v);
    let q = sides - corners;
    if a == 3 { dvec2(0.0, q.y) } else { q }
}

/// Where the neck's chart has a node, cm; columns counted from the seam at the nape, 0 to 24.
fn neck_place(from_seam: usize, row: usize) -> DVec2 {
    let half = COLUMNS / 2;
    let turn = if from_seam >= half { azimuth(from_seam - half) } else { -azimuth(half - from_seam) };
    dvec2(NECK_RADIUS_CM * turn, -NECK_CM[row - JAW_ROW])
}

/// Where another chart has a node, cm.
fn head_place(chart: Chart, site: &Site) -> DVec2 {
    let (_, d, _) = site.ray();
    let base = dvec2(d.x, d.z) / -d.y * BASE_CM;
    let d = site.on_head().normalize();
    let (middle, up) = match chart {
        Chart::Face => (DVec3::Z, DVec3::Y),
        Chart::Left => (DVec3::NEG_X, DVec3::Y),
        Chart::Right => (DVec3::X, DVec3::Y),
        Chart::Back => (DVec3::NEG_Z, DVec3::Y),
        Chart::Crown => (DVec3::Y, DVec3::NEG_Z),
        Chart::Neck | Chart::Base => return base,
        Chart::LeftEar | Chart::RightEar => return ear_place(site),
    };
    let off = dvec2(d.dot(up.cross(middle)), d.dot(up));
    let angle = libm::atan2(off.length(), d.dot(middle));
    let cm = if chart == Chart::Face { FACE_RADIUS_CM } else { HEAD_RADIUS_CM };
    off.normalize_or_zero() * (angle * cm)
}

fn ear_place(site: &Site) -> DVec2 {
    match *site {
        Site::Ear { side, s, t, .. } => dvec2(-s * side, t) * EAR_CM,
        Site::Skin { .. } => DVec2::ZERO,
    }
}
