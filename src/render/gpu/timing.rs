//! The passes of a frame, one after the other, and how long each takes: by the device's own clock where it has one. Then all are one
//! submission; else each is one of its own, waited for, and timed from outside.

use std::time::Instant;

use wgpu::{BufferUsages, QuerySet};

use super::device::Device;
use crate::canvas::RenderError;
use crate::canvas::frame::Pass;

/// Passes of a frame that are timed; of any more the time is not known.
const TIMED: u32 = 256;

/// What the device's clock is read into.
#[derive(Debug)]
pub(crate) struct Clock {
    set: QuerySet,
    /// Where the queries are resolved to, 16 bytes a pass.
    ticks: wgpu::Buffer,
    tick_ns: f64,
}

impl Clock {
    /// Bytes of all that it reads.
    pub(crate) const BYTES: u64 = TIMED as u64 * 16;

    /// The device's clock, if it has one.
    pub(crate) fn new(device: &Device) -> Result<Option<Self>, RenderError> {
        let Some(tick_ns) = device.tick_ns else { return Ok(None) };
        let set = device.guarded("queries", || {
            device.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("times of passes"),
                ty: wgpu::QueryType::Timestamp,
                count: 2 * TIMED,
            })
        })?;
        let usage = BufferUsages::QUERY_RESOLVE | BufferUsages::COPY_SRC;
        let ticks = device.buffer("times of passes", Self::BYTES, usage)?;
        Ok(Some(Self { set, ticks, tick_ns: tick_ns.into() }))
    }
}

/// When a pass begins and ends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stamps<'a>(Option<(&'a QuerySet, u32)>);

impl<'a> Stamps<'a> {
    /// Of a pass that is not timed.
    pub(crate) fn none() -> Self {
        Self(None)
    }

    /// For a render pass with which a pass begins, ends, or both.
    pub(crate) fn render(self, begins: bool, ends: bool) -> Option<wgpu::RenderPassTimestampWrites<'a>> {
        self.0.map(|(query_set, first)| wgpu::RenderPassTimestampWrites {
            query_set,
            beginning_of_pass_write_index: begins.then_some(first),
            end_of_pass_write_index: ends.then_some(first + 1),
        })
    }

    /// For a compute pass with which it begins, or ends.
    pub(crate) fn compute(self, begins: bool) -> Option<wgpu::ComputePassTimestampWrites<'a>> {
        self.0.map(|(query_set, first)| wgpu::ComputePassTimestampWrites {
            query_set,
            beginning_of_pass_write_index: begins.then_some(first),
            end_of_pass_write_index: (!begins).then_some(first + 1),
        })
    }
}

/// Records the passes of a frame.
#[derive(Debug)]
pub(crate) struct Recorder<'a> {
    device: &'a Device,
    clock: Option<&'a Clock>,
    encoder: wgpu::CommandEncoder,
    passes: Vec<Pass>,
    /// The passes that the clock was read for.
    stamped: Vec<usize>,
}

impl<'a> Recorder<'a> {
    /// After what was done before the device had anything to do.
    pub(crate) fn new(device: &'a Device, clock: Option<&'a Clock>, before: Pass) -> Self {
        Self { device, clock, encoder: encoder(device), passes: vec![before], stamped: Vec::new() }
    }

    /// What it records for.
    pub(crate) fn device(&self) -> &'a Device {
        self.device
    }

    /// Notes a pass that is not done.
    pub(crate) fn skip(&mut self, id: impl Into<String>, why: &str) {
        self.passes.push(Pass { id: id.into(), skipped: Some(why.into()), ..Pass::default() });
    }

    /// What was noted so far, if nothing of it is to be done.
    pub(crate) fn passes(self) -> Vec<Pass> {
        self.passes
    }

    /// Records a pass.
    pub(crate) fn pass(
        &mut self,
        id: impl Into<String>,
        record: impl FnOnce(&mut wgpu::CommandEncoder, Stamps<'_>),
    ) -> Result<(), RenderError> {
        let pass = Pass { id: id.into(), ..Pass::default() };
        let stamps = self.stamps();
        self.encoder.push_debug_group(&pass.id);
        record(&mut self.encoder, stamps);
        self.encoder.pop_debug_group();
        self.passes.push(pass);
        if self.clock.is_none() { self.run_alone() } else { Ok(()) }
    }

    fn stamps(&mut self) -> Stamps<'a> {
        let first = 2 * self.stamped.len() as u32;
        let Some(clock) = self.clock.filter(|_| first < 2 * TIMED) else { return Stamps(None) };
        self.stamped.push(self.passes.len());
        Stamps(Some((&clock.set, first)))
    }

    /// Submits the last pass, and waits for it.
    fn run_alone(&mut self) -> Result<(), RenderError> {
        let start = Instant::now();
        let recorded = std::mem::replace(&mut self.encoder, encoder(self.device));
        self.device.queue.submit([recorded.finish()]);
        self.device.wait()?;
        if let Some(pass) = self.passes.last_mut() {
            pass.us = start.elapsed().as_secs_f64() * 1e6;
        }
        Ok(())
    }

    /// Submits what was recorded and what else is to be done; the times are copied to this place in a buffer.
    pub(crate) fn submit(
        mut self,
        into: &wgpu::Buffer,
        at: u64,
        finish: impl FnOnce(&mut wgpu::CommandEncoder),
    ) -> Timed<'a> {
        finish(&mut self.encoder);
        if let Some(clock) = self.clock.filter(|_| !self.stamped.is_empty()) {
            let count = 2 * self.stamped.len() as u32;
            self.encoder.resolve_query_set(&clock.set, 0..count, &clock.ticks, 0);
            self.encoder.copy_buffer_to_buffer(&clock.ticks, 0, into, at, u64::from(count) * 8);
        }
        self.device.queue.submit([self.encoder.finish()]);
        Timed { clock: self.clock, passes: self.passes, stamped: self.stamped }
    }
}

/// The passes of a frame that is under way.
#[derive(Debug)]
pub(crate) struct Timed<'a> {
    clock: Option<&'a Clock>,
    passes: Vec<Pass>,
    stamped: Vec<usize>,
}

impl Timed<'_> {
    /// The passes with their times, read back.
    pub(crate) fn passes(self, read: &[u8]) -> Vec<Pass> {
        let mut passes = self.passes;
        let tick_us = self.clock.map_or(0.0, |clock| clock.tick_ns / 1000.0);
        for (pair, &pass) in read.chunks_exact(16).zip(&self.stamped) {
            let [start, end] = [&pair[..8], &pair[8..]].map(tick);
            passes[pass].us = end.saturating_sub(start) as f64 * tick_us;
        }
        passes
    }
}

fn tick(bytes: &[u8]) -> u64 {
    bytes.iter().rev().fold(0, |ticks, &byte| ticks << 8 | u64::from(byte))
}

fn encoder(device: &Device) -> wgpu::CommandEncoder {
    device.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("frame") })
}
