//! GP's and PP's invariants of pixels on the device: what they ask of is read back, and looked at where the CPU's are.
//!
//! `within` compares what the journal saved before the last painting with the same tiles now. `finite` is told by the shader, which notes
//! what it could not place: those are the coordinates that were used, not others worked out again.

use super::Painter;
use super::journal::{Run, Saved};
use super::paint::Faults;
use crate::canvas::RenderError;
use crate::canvas::job::PatchJob;
use crate::render::inspect;
use crate::report::Check;

impl Painter {
    /// Looks at the texels of the patch that was made last.
    pub fn check_patch(&self, job: &PatchJob) -> Result<Vec<Check>, RenderError> {
        let Some(made) = &self.made else { return Ok(Vec::new()) };
        Ok(inspect::patch(job, &made.read(&self.device)?))
    }

    /// Looks at the texels that the last painting changed.
    pub fn check_paint(&self) -> Result<Vec<Check>, RenderError> {
        let (Some((painting, trace)), Some(mask)) = (self.journal.last(), &self.mask) else {
            return Ok(Vec::new());
        };
        let mut changed = Vec::new();
        for saved in &trace.saved {
            changed.extend(self.changed(saved)?);
        }
        let within = inspect::within(&painting.paint, self.maps.size(), &mask.covered, &changed);
        let faults = Faults::read(&self.device, &trace.faults)?;
        Ok(vec![within, inspect::finite(faults.iter().map(|fault| (fault.texel, fault.place)))])
    }

    /// The texels of a block that are no longer what was saved.
    fn changed(&self, saved: &Saved) -> Result<Vec<[u32; 2]>, RenderError> {
        let now = Saved::new(&self.device, saved.block.clone())?;
        self.device.submit("tiles as they are", |encoder| now.save(encoder, &self.maps))?;
        let read = |saved: &Saved| self.device.read_buffer(&saved.texels, 0..saved.block.bytes());
        let (before, after) = (read(saved)?, read(&now)?);
        Ok(saved.block.runs.iter().flat_map(|run| differing(run, &before, &after)).collect())
    }
}

/// The texels of a run that differ in one of the maps.
fn differing<'a>(run: &'a Run, before: &'a [u8], after: &'a [u8]) -> impl Iterator<Item = [u32; 2]> + 'a {
    let stride = u64::from(run.region().stride());
    let differs = move |x: u32, y: u32| {
        [run.at, run.discolor_at()].into_iter().any(|at| {
            let at = (at + stride * u64::from(y)) as usize + 4 * x as usize;
            before.get(at..at + 4) != after.get(at..at + 4)
        })
    };
    let [width, height] = run.size;
    let texels = (0..height).flat_map(move |y| (0..width).map(move |x| [x, y]));
    texels.filter(move |[x, y]| differs(*x, *y)).map(|[x, y]| [run.origin[0] + x, run.origin[1] + y])
}
