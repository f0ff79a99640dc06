//! Frames: the passes one after the other, and what each of them may leave out.
//!
//! | pass | what it does | left out |
//! | --- | --- | --- |
//! | `upload` | what of the mesh has changed | it has not |
//! | `visible` | the nearest face at each pixel | nothing is in view |
//! | `shadow 0` … | a light's shadow map | the light and the mesh are as they were; its cone misses the model; nothing reads it; nothing is in view |
//! | `skin` | the light that leaves the surface | tiles without any |
//! | `scatter` | both passes of the scattering | switched off; tiles without skin |
//! | `discolor` | the local discoloration, in `scatter`'s time | switched off; tiles without any |
//! | `compose` | the picture | tiles without any surface |
//!
//! With nothing in view no pass is needed at all. Where the device has a clock a frame is one submission. Positions are kept relative to the job's origin, in f32.

use std::sync::Arc;
use std::time::Instant;

use wgpu::BufferUsages;

use super::compose::{ComposePass, background};
use super::device::Device;
use super::lens::Lens;
use super::mesh::{Surface, Uploaded};
use super::scatter::{ScatterPass, ScatterState};
use super::shadow::{ShadowMaps, ShadowPass};
use super::skin::{Shaded, SkinPass, SkinState};
use super::store::Store;
use super::targets::Targets;
use super::tiles::{Lists, TilesPass, TilesStep};
use super::timing::{Clock, Recorder};
use super::visible::VisiblePass;
use crate::canvas::RenderError;
use crate::canvas::frame::{Frame, FrameJob, Pass};
use crate::canvas::image::{Image, Maps};

/// The passes of a frame, compiled: one of each for all scenes of a device.
#[derive(Debug)]
pub struct Passes {
    visible: VisiblePass,
    shadow: ShadowPass,
    skin: SkinPass,
    tiles: TilesPass,
    scatter: ScatterPass,
    compose: ComposePass,
}

impl Passes {
    /// Compiles them.
    pub fn new(device: &Device) -> Result<Self, RenderError> {
        Ok(Self {
            visible: VisiblePass::new(device)?,
            shadow: ShadowPass::new(device)?,
            skin: SkinPass::new(device)?,
            tiles: TilesPass::new(device)?,
            scatter: ScatterPass::new(device)?,
            compose: ComposePass::new(device)?,
        })
    }
}

/// Renders the frames of a scene.
#[derive(Debug)]
pub struct Frames {
    device: Arc<Device>,
    passes: Arc<Passes>,
    /// None where passes are timed from outside.
    pub(crate) clock: Option<Clock>,
    surface: Surface,
    shadows: ShadowMaps,
    skin: SkinState,
    viewer: Store,
    screen: Store,
    scatter: ScatterState,
    backdrop: Store,
    targets: Option<Targets>,
    /// What the last frame took to the device.
    pub(crate) uploaded: Uploaded,
}

/// What a frame needs.
struct Plan {
    /// Why no pass is needed.
    empty: Option<&'static str>,
    /// Why no shadow map is.
    unread: Option<&'static str>,
    /// The lights that are looked at.
    lights: Vec<usize>,
}

impl Plan {
    fn new(job: &FrameJob<'_>, surface: &Surface) -> Self {
        let bounds = surface.bounds().map(|corner| corner - job.origin);
        let seen = !surface.is_empty() && Lens::of_view(&job.view, job.origin).may_see(bounds);
        let read = job.switches.shadows || job.switches.transmittance;
        let empty = (!seen && !job.everything).then_some("nothing is in view");
        let lights = job.lights.iter().enumerate().filter(|(_, light)| light.reaches || job.everything);
        Self {
            empty,
            unread: if read { empty } else { Some("shadows and transmitted light are switched off") },
            lights: lights.map(|(i, _)| i).collect(),
        }
    }
}

impl Frames {
    /// Of a scene with these maps, but for the colour map, which comes with every frame.
    pub fn new(device: Arc<Device>, passes: Arc<Passes>, maps: &Maps) -> Result<Self, RenderError> {
        Ok(Self {
            clock: Clock::new(&device)?,
            surface: Surface::new(),
            shadows: ShadowMaps::new(&device)?,
            skin: SkinState::new(&device, maps)?,
            viewer: Store::new("viewer", BufferUsages::UNIFORM),
            screen: Store::new("screen", BufferUsages::UNIFORM),
            scatter: ScatterState::new(),
            backdrop: Store::new("backdrop", BufferUsages::UNIFORM),
            targets: None,
            uploaded: Uploaded::default(),
            device,
            passes,
        })
    }

    /// Renders a frame, with the colour and the discolour map as they are now.
    pub fn frame(
        &mut self,
        job: &FrameJob<'_>,
        color: &wgpu::Texture,
        discolor: &wgpu::Texture,
    ) -> Result<Frame, RenderError> {
        let device = self.device.clone();
        let frame = device.guarded("frame", || self.render(job, [color, discolor])).flatten();
        if frame.is_err() {
            // What of it was done is not known.
            self.shadows.forget();
        }
        frame
    }

    fn render(&mut self, job: &FrameJob<'_>, painted: [&wgpu::Texture; 2]) -> Result<Frame, RenderError> {
        self.fit(job.view.size)?;
        let uploaded = self.upload(job)?;
        let plan = Plan::new(job, &self.surface);
        let Self { device, passes, clock, surface, shadows, targets, .. } = self;
        let Some(targets) = targets else { return Err(RenderError::Refused("no target".into())) };
        let mut recorder = Recorder::new(device, clock.as_ref(), uploaded);
        if let Some(why) = plan.empty {
            recorder.skip("visible", why);
            draw_shadows(&mut recorder, &passes.shadow, shadows, surface, (job, &plan))?;
            ["skin", "scatter", "discolor", "compose"].iter().for_each(|id| recorder.skip(*id, why));
            let image = Image::filled(job.view.size, background(job.look.background));
            return Ok(Frame { image, passes: recorder.passes() });
        }
        let tiles = passes.tiles.prepare(device, &mut self.screen, targets, job)?;
        passes.visible.draw(&mut recorder, &mut self.viewer, (targets, &tiles), surface, job)?;
        draw_shadows(&mut recorder, &passes.shadow, shadows, surface, (job, &plan))?;
        let with = Shaded { surface, lights: &plan.lights, shadows, painted };
        passes.skin.draw(&mut recorder, &mut self.skin, targets, &with, job)?;
        draw_scattering(&mut recorder, &passes.scatter, &mut self.scatter, (targets, &tiles), job)?;
        passes.compose.draw(&mut recorder, &mut self.backdrop, targets, job)?;
        read(recorder, targets, job)
    }

    /// Makes room for frames of a size.
    fn fit(&mut self, size: [u32; 2]) -> Result<(), RenderError> {
        if self.targets.as_ref().is_none_or(|targets| targets.size != size) {
            // The old ones go first: both together might be too much.
            self.targets = None;
            self.targets = Some(Targets::new(&self.device, size)?);
        }
        Ok(())
    }

    fn upload(&mut self, job: &FrameJob<'_>) -> Result<Pass, RenderError> {
        let start = Instant::now();
        self.uploaded = self.surface.follow(&self.device, job)?;
        let us = start.elapsed().as_secs_f64() * 1e6;
        let skipped = self.uploaded.is_empty().then(|| "the mesh has not changed".into());
        Ok(Pass { id: "upload".into(), us, skipped, ..Pass::default() })
    }
}

fn draw_shadows(
    recorder: &mut Recorder<'_>,
    pass: &ShadowPass,
    shadows: &mut ShadowMaps,
    surface: &Surface,
    (job, plan): (&FrameJob<'_>, &Plan),
) -> Result<(), RenderError> {
    if plan.unread.is_none() {
        shadows.fit(recorder.device(), job.look.shadows.size.clamp(16, 8192), plan.lights.len())?;
    }
    for (i, light) in job.lights.iter().enumerate() {
        let id = format!("shadow {i}");
        let layer = plan.lights.iter().position(|&used| used == i);
        match (plan.unread, layer) {
            (Some(why), _) => recorder.skip(id, why),
            (None, None) => recorder.skip(id, "its cone misses the model"),
            (None, Some(layer)) => shadows.draw(recorder, pass, (id, light, layer), surface, job)?,
        }
    }
    Ok(())
}

fn draw_scattering(
    recorder: &mut Recorder<'_>,
    pass: &ScatterPass,
    state: &mut ScatterState,
    (targets, tiles): (&Targets, &TilesStep<'_>),
    job: &FrameJob<'_>,
) -> Result<(), RenderError> {
    if !job.switches.scattering {
        recorder.skip("scatter", "switched off");
        return Ok(());
    }
    let scatter = pass.prepare(recorder.device(), state, targets, job)?;
    recorder.pass("scatter", |encoder, stamps| {
        tiles.list_skin(encoder, stamps);
        scatter.record(encoder, stamps);
    })
}

/// Has everything done, and reads the picture back.
fn read(recorder: Recorder<'_>, targets: &Targets, job: &FrameJob<'_>) -> Result<Frame, RenderError> {
    let (device, staging) = (recorder.device(), &targets.staging);
    let under_way = recorder.submit(staging, targets.times_at(), |encoder| {
        targets.region().copy(encoder, &targets.picture, staging, 0);
        encoder.copy_buffer_to_buffer(&targets.lists.draws, 0, staging, targets.draws_at(), Lists::DRAWS);
    });
    let read = device.mapped(staging)?;
    let (texels, _) = read.split_at(targets.draws_at() as usize);
    let texels = targets.region().packed(texels).as_chunks().0.to_vec();
    let lengths = Lists::lengths(&read[targets.draws_at() as usize..]);
    let mut passes = under_way.passes(&read[targets.times_at() as usize..]);
    count(&mut passes, job, targets.lists.count, lengths);
    Ok(Frame { image: Image { size: targets.size, texels }, passes })
}

/// Says how many tiles were worked through.
fn count(passes: &mut Vec<Pass>, job: &FrameJob<'_>, of: u32, [seen, plain, localized]: [u32; 3]) {
    let on = job.switches.scattering;
    let local = match () {
        () if !job.switches.discoloration => Some("switched off"),
        () if !on => Some("scattering is switched off"),
        () => (localized == 0).then_some("no discoloured skin is in view"),
    };
    let discolor = Pass {
        id: "discolor".into(),
        tiles: if local.is_some() { 0 } else { localized },
        of,
        skipped: local.map(Into::into),
        us: 0.0,
    };
    for pass in passes.iter_mut() {
        let (tiles, why) = match pass.id.as_str() {
            "skin" => (seen, "nothing is in view"),
            "scatter" => (if on { plain + localized } else { 0 }, "no skin is in view"),
            _ => continue,
        };
        (pass.tiles, pass.of) = (tiles, of);
        if tiles == 0 {
            pass.skipped.get_or_insert_with(|| why.into());
        }
    }
    let last = passes.len() - 1;
    passes.insert(last, discolor);
}
