//! Half turns about the axes and powers of two change no digit of any sum or product. So a cut turned and scaled with its mesh and its eye, in units that
//! are as many times smaller, must be the same cut through all stages: the same elements in the same order, at positions that
//! are the images of each other to the last bit.

use glam::DVec3;

use super::map::Map;
use super::{Verdict, Witness, require};
use crate::attack::Hits;
use crate::attack::drive::{self, Ran};
use crate::engine::wound::{Cut, Pick, State, WoundEvent};
use crate::mesh::Mesh;

/// The half turns; the first is none at all.
const TURNS: [[f64; 3]; 4] = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
/// Powers of two.
const SCALES: [f64; 5] = [1.0, 0.5, 8.0, 1024.0, 1.0 / 65_536.0];

pub(super) fn look(witness: &Witness<'_>, hits: &mut Hits) -> Verdict {
    let Some(cut) = witness.ran.cut() else { return Ok(()) };
    // Another eye sees other things under a pixel's ray: its rounded point does not follow.
    if !is_by_ids(witness.event) {
        return Ok(());
    }
    hits.note("oracle exact");
    let map = choose(witness.seed);
    let mut image = map.state(witness.ground, witness.before);
    let ran = drive::run(&mut image, witness.event, witness.seed, Some(map.point(cut.eye)));
    compare(&map, witness, &image, &ran)
}

pub(super) fn is_by_ids(event: &WoundEvent) -> bool {
    let by_id = |pick: &Pick| !matches!(pick, Pick::Pixel(_));
    matches!(event, WoundEvent::Cut { from, to } if by_id(from) && by_id(to))
}

/// Any turn with any scale, by the event's seed, which is a hash of the recording's and of its key.
fn choose(seed: u64) -> Map {
    let turn = TURNS[(seed % TURNS.len() as u64) as usize];
    let scale = SCALES[(seed / TURNS.len() as u64 % SCALES.len() as u64) as usize];
    Map { factors: DVec3::from(turn) * scale, ..Map::IDENTITY }
}

fn compare(map: &Map, witness: &Witness<'_>, image: &State, ran: &Ran) -> Verdict {
    let fail = |what: String| format!("under {:?}: {what}", map.factors.to_array());
    let words = [witness.ran.word(), ran.word()];
    require(words[0] == words[1], "exact-outcome", || fail(format!("{} became {}", words[0], words[1])))?;
    let (mine, theirs) = (&witness.after.mesh, &image.mesh);
    require(mine.faces() == theirs.faces(), "exact-faces", || fail("the faces differ".into()))?;
    require(mine.edges() == theirs.edges(), "exact-edges", || fail("the edges differ".into()))?;
    if let Some(n) = apart(map, mine, theirs) {
        let at = [map.point(mine.positions()[n]), theirs.positions()[n]];
        return require(false, "exact-positions", || {
            fail(format!("n{n} lies at {}, not at {}", at[1], at[0]))
        });
    }
    match (witness.ran.cut(), ran.cut()) {
        (Some(a), Some(b)) => {
            require(same_paint(a, b), "exact-paint", || fail("other faces are painted".into()))
        }
        _ => Ok(()),
    }
}

/// The first node that is not where its image is.
fn apart(map: &Map, mine: &Mesh, theirs: &Mesh) -> Option<usize> {
    let bits = |p: DVec3| (p + DVec3::ZERO).to_array().map(f64::to_bits);
    let pairs = mine.positions().iter().zip(theirs.positions());
    pairs.into_iter().position(|(p, q)| bits(map.point(*p)) != bits(*q))
}

/// Lines that are too short or too long for a job are not painted, and which those are goes by their length in units.
fn same_paint(a: &Cut, b: &Cut) -> bool {
    let [mine, theirs] = [a, b].map(|cut| cut.painted.as_ref().map(|painted| &painted.painting.paint.faces));
    mine.zip(theirs).is_none_or(|(a, b)| a.iter().map(|f| f.face).eq(b.iter().map(|f| f.face)))
}
