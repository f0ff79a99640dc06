//! Frames: the passes one after the other, and what each of them may leave out.
//!
//! | pass | what it does | left out |
//! | --- | --- | --- |
//! | `visible` | the nearest surface at each pixel | never |
//! | `shadow 0` … | a light's shadow map | the light and the mesh are as they were; its cone misses the model; nothing reads it; nothing is in view |
//! | `skin` | the light that leaves the surface | tiles without surface |
//! | `scatter` | both passes of the scattering | switched off; tiles without skin |
//! | `discolor` | the local discoloration, in `scatter`'s time | switched off; tiles without any |
//! | `compose` | the picture | never |

use std::sync::Arc;
use std::time::Instant;

use super::compose::compose;
use super::layers::{Layers, Tile};
use super::lens::Lens;
use super::lighting::{Lamp, Lighting, With};
use super::raster::Drawing;
use super::scatter::Scatter;
use super::shadow::{Key, ShadowMap};
use super::skin::{Shading, visible};
use super::surface::Materials;
use crate::canvas::RenderError;
use crate::canvas::frame::{Frame, FrameJob, Pass};
use crate::canvas::image::{Image, Maps};

/// The longest side of a picture, pixels: well within what clipping leaves.
const LONGEST: u64 = 16_384;

/// The most pixels of a picture: 8192², whose layers take 5 GB.
const MOST_PIXELS: u64 = 1 << 26;

/// The most texels of all shadow maps of a frame: 1 GB.
const MOST_TEXELS: u64 = 1 << 28;

/// Renders the frames of a scene.
#[derive(Debug)]
pub struct Frames {
    maps: Arc<Maps>,
    /// By light; `None` before one is needed.
    shadows: Vec<Option<ShadowMap>>,
    pub(super) layers: Layers,
}

impl Frames {
    /// Of a scene with these maps, but for the colour map, which comes with every frame.
    pub fn new(maps: Arc<Maps>) -> Self {
        Self { maps, shadows: Vec::new(), layers: Layers::default() }
    }

    /// Renders a frame, with the colour and the discolour map as they are now.
    pub fn frame(
        &mut self,
        job: &FrameJob<'_>,
        color: &Image,
        discolor: &Image,
    ) -> Result<Frame, RenderError> {
        bounded(job)?;
        let mut passes = Vec::new();
        self.layers.resize(job.view.size);
        let lens = Lens::of_view(&job.view);
        let drawing = self.see(job, &lens, &mut passes);
        self.shadows(job, drawing.is_empty(), &mut passes);
        self.shade(job, &drawing, [color, discolor], &mut passes);
        self.scatter(job, &lens, &mut passes);
        let image = timed(&mut passes, Pass { id: "compose".into(), ..Pass::default() }, || {
            compose(&self.layers, job.look.background)
        });
        Ok(Frame { image, passes })
    }

    fn see(&mut self, job: &FrameJob<'_>, lens: &Lens, passes: &mut Vec<Pass>) -> Drawing {
        timed(passes, Pass { id: "visible".into(), ..Pass::default() }, || {
            let drawing = Drawing::new(job.mesh, lens);
            visible(&mut self.layers, &drawing, lens.far);
            drawing
        })
    }

    /// Draws the shadow maps that are needed and not there.
    fn shadows(&mut self, job: &FrameJob<'_>, nothing_in_view: bool, passes: &mut Vec<Pass>) {
        self.shadows.resize(job.lights.len(), None);
        for (i, (light, map)) in job.lights.iter().zip(&mut self.shadows).enumerate() {
            let key = Key::new(light, job.version, shadow_size(job));
            let pass = Pass { id: format!("shadow {i}"), ..Pass::default() };
            let there = map.as_ref().is_some_and(|map| map.is(&key));
            let skipped = match () {
                () if !reads_shadows(job) => Some("shadows and transmitted light are switched off"),
                () if job.everything => None,
                () if !light.reaches => Some("its cone misses the model"),
                () if nothing_in_view => Some("nothing is in view"),
                () => there.then_some("neither the light nor the mesh has changed"),
            };
            match skipped {
                Some(why) => passes.push(Pass { skipped: Some(why.into()), ..pass }),
                None => *map = Some(timed(passes, pass, || ShadowMap::new(job.mesh, key))),
            }
        }
    }

    fn shade(&mut self, job: &FrameJob<'_>, drawing: &Drawing, painted: [&Image; 2], passes: &mut Vec<Pass>) {
        let lights =
            job.lights.iter().zip(&self.shadows).filter(|(light, _)| light.reaches || job.everything);
        let read = reads_shadows(job);
        let lamps = lights
            .map(|(light, map)| Lamp::new(light, map.as_ref().filter(|_| read), job.view.eye))
            .collect();
        let shading = Shading {
            mesh: job.mesh,
            drawing,
            materials: &Materials::new(job.look, job.switches, &self.maps, painted),
            lighting: &Lighting::new(job, lamps),
            everything: job.everything,
        };
        let layers = &mut self.layers;
        timed(passes, Pass { id: "skin".into(), ..Pass::default() }, || {
            match (job.switches.specular, job.switches.transmittance) {
                (false, false) => shading.run::<With<false, false>>(layers),
                (false, true) => shading.run::<With<false, true>>(layers),
                (true, false) => shading.run::<With<true, false>>(layers),
                (true, true) => shading.run::<With<true, true>>(layers),
            }
        });
        let skipped = (!job.everything && self.tiles(|t| t.surface) == 0).then_some("nothing is in view");
        self.count(passes, job, skipped, |tile| tile.surface);
    }

    fn scatter(&mut self, job: &FrameJob<'_>, lens: &Lens, passes: &mut Vec<Pass>) {
        let (switches, skin) = (job.switches, self.tiles(|tile| tile.scatters) > 0);
        let discolored = self.tiles(|tile| tile.discolored) > 0;
        let skipped = match () {
            () if !switches.scattering => Some("switched off"),
            () => (!skin && !job.everything).then_some("no skin is in view"),
        };
        timed(passes, Pass { id: "scatter".into(), ..Pass::default() }, || {
            if skipped.is_none() {
                Scatter::new(&job.look.scattering, job.unit_cm, lens, job.everything).run(&mut self.layers);
            }
        });
        self.count(passes, job, skipped, |tile| tile.scatters);
        passes.push(Pass { id: "discolor".into(), ..Pass::default() });
        let skipped = match () {
            () if !switches.discoloration => Some("switched off"),
            () if !switches.scattering => Some("scattering is switched off"),
            () => (!discolored && !job.everything).then_some("no discoloured skin is in view"),
        };
        self.count(passes, job, skipped, |tile| tile.discolored);
    }

    fn tiles(&self, of: impl Fn(&Tile) -> bool) -> usize {
        self.layers.tiles.iter().filter(|tile| of(tile)).count()
    }

    /// Says of the last pass what it worked through.
    fn count(
        &self,
        passes: &mut [Pass],
        job: &FrameJob<'_>,
        skipped: Option<&str>,
        of: impl Fn(&Tile) -> bool,
    ) {
        let Some(pass) = passes.last_mut() else { return };
        pass.of = self.layers.tiles.len() as u32;
        match skipped {
            Some(why) => (pass.skipped, pass.us) = (Some(why.into()), 0.0),
            None if job.everything => pass.tiles = pass.of,
            None => pass.tiles = self.tiles(of) as u32,
        }
    }
}

/// Runs a pass and notes its time.
fn timed<T>(passes: &mut Vec<Pass>, pass: Pass, run: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let result = run();
    passes.push(Pass { us: start.elapsed().as_secs_f64() * 1e6, ..pass });
    result
}

fn shadow_size(job: &FrameJob<'_>) -> u32 {
    job.look.shadows.size.clamp(16, 8192)
}

/// Whether anything looks at a shadow map.
fn reads_shadows(job: &FrameJob<'_>) -> bool {
    job.switches.shadows || job.switches.transmittance
}

/// Refuses what would take gigabytes.
fn bounded(job: &FrameJob<'_>) -> Result<(), RenderError> {
    let [width, height] = job.view.size.map(u64::from);
    let texels = u64::from(shadow_size(job)).pow(2) * job.lights.len() as u64;
    let too_large = |what: String| Err(RenderError::TooLarge(what));
    match () {
        () if width * height == 0 => too_large(format!("a picture of {width} x {height} has no pixel")),
        () if width.max(height) > LONGEST || width * height > MOST_PIXELS => {
            too_large(format!("a picture of {width} x {height} pixels"))
        }
        () if texels > MOST_TEXELS => too_large(format!("{texels} texels of shadow maps")),
        () => Ok(()),
    }
}
