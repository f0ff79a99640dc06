//! The device: one adapter, its queue, and the ways in which it may fail, each as a [`RenderError`].
//!
//! By default wgpu panics at an error that nobody awaited. Here every error ends as a value: what a block of calls is refused is caught around
//! it ([`Device::guarded`]), what comes later by a handler that notes it, and a lost device by its callback; both come
//! out at the next guarded block. What has a size is measured against the device's limits before it is asked for.
//!
//! A buffer that is read is waited for with the device's own `poll`, which panics when the device is lost within it; that is
//! caught, and is [`RenderError::Lost`] as well.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex, PoisonError};

use wgpu::{BufferUsages, ErrorFilter, TextureFormat, TextureUsages};

use super::shaders;
use crate::canvas::image::Image;
use crate::canvas::{Adapter, Kind, RenderError};

/// Part of a device's memory, in per cent, beyond which it is said to be full: beyond it drivers fail in less orderly ways.
const FULL_PERCENT: u8 = 95;

/// A device, and who it is.
#[derive(Debug)]
pub struct Device {
    /// What makes things.
    pub device: wgpu::Device,
    /// What runs commands.
    pub queue: wgpu::Queue,
    /// Who renders.
    pub adapter: Adapter,
    /// Nanoseconds in a tick of its clock, where passes can be timed.
    pub tick_ns: Option<f32>,
    limits: wgpu::Limits,
    trouble: Arc<Mutex<Option<RenderError>>>,
}

impl Device {
    /// Opens the best adapter that Vulkan offers: a discrete GPU before an integrated one, and that before a program that plays one.
    pub fn open() -> Result<Self, RenderError> {
        let plain = best(wgpu::InstanceFlags::empty());
        let adapter = plain.ok_or_else(|| RenderError::NoAdapter("no Vulkan driver offers one".into()))?;
        if adapter.get_info().device_type == wgpu::DeviceType::Cpu {
            // Mesa's lavapipe 22.3 crashes at a label in a command buffer; a frame debugger is for real GPUs.
            return Self::of(&adapter);
        }
        Self::of(&best(wgpu::InstanceFlags::DEBUG).unwrap_or(adapter))
    }

    fn of(adapter: &wgpu::Adapter) -> Result<Self, RenderError> {
        let (info, limits) = (adapter.get_info(), adapter.limits());
        let request = adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("lancet"),
            required_features: adapter.features() & wgpu::Features::TIMESTAMP_QUERY,
            required_limits: limits.clone(),
            ..wgpu::DeviceDescriptor::default()
        });
        let (device, queue) =
            pollster::block_on(request).map_err(|error| RenderError::NoAdapter(error.to_string()))?;
        let timed = device.features().contains(wgpu::Features::TIMESTAMP_QUERY);
        let tick_ns = timed.then(|| queue.get_timestamp_period());
        let trouble = watch(&device);
        Ok(Self { device, queue, adapter: described(&info), tick_ns, limits, trouble })
    }

    /// What the device can do at most.
    pub fn limits(&self) -> &wgpu::Limits {
        &self.limits
    }

    /// Runs commands of the device; what it refuses is an error that says what was being done.
    pub fn guarded<T>(&self, what: &str, run: impl FnOnce() -> T) -> Result<T, RenderError> {
        let scopes = [ErrorFilter::Internal, ErrorFilter::OutOfMemory, ErrorFilter::Validation]
            .map(|filter| self.device.push_error_scope(filter));
        let value = run();
        // Innermost first.
        let errors = scopes.into_iter().rev().map(|scope| pollster::block_on(scope.pop()));
        let first = errors.collect::<Vec<_>>().into_iter().flatten().next();
        match first.map(|error| typed(what, &error)).or_else(|| self.trouble()) {
            Some(error) => Err(error),
            None => Ok(value),
        }
    }

    /// What went wrong outside of any guarded block. A loss is for ever, the rest is told once.
    fn trouble(&self) -> Option<RenderError> {
        let mut trouble = self.trouble.lock().unwrap_or_else(PoisonError::into_inner);
        if matches!(*trouble, Some(RenderError::Lost(_))) { trouble.clone() } else { trouble.take() }
    }

    /// Waits until everything that was submitted is done.
    pub fn wait(&self) -> Result<(), RenderError> {
        let poll = || self.device.poll(wgpu::PollType::wait_indefinitely());
        let polled = self.guarded("waiting", || catch_unwind(AssertUnwindSafe(poll)))?;
        match polled {
            Ok(done) => done.map(drop).map_err(|error| RenderError::Lost(error.to_string())),
            Err(_) => Err(RenderError::Lost("it did not come back".into())),
        }
    }

    /// A shader by its name, the stem of its file.
    pub fn shader(&self, name: &str) -> Result<wgpu::ShaderModule, RenderError> {
        let shader = shaders::named(name).ok_or_else(|| RenderError::Refused(format!("no shader {name}")))?;
        self.guarded(name, || {
            self.device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(name),
                source: wgpu::ShaderSource::Wgsl(shader.text().into()),
            })
        })
    }

    /// A buffer of so many bytes, rounded up to whole words; none is empty.
    pub fn buffer(&self, label: &str, bytes: u64, usage: BufferUsages) -> Result<wgpu::Buffer, RenderError> {
        let bound = [
            (true, self.limits.max_buffer_size),
            (usage.contains(BufferUsages::STORAGE), self.limits.max_storage_buffer_binding_size),
            (usage.contains(BufferUsages::UNIFORM), self.limits.max_uniform_buffer_binding_size),
        ];
        let most = bound.iter().filter(|(holds, _)| *holds).map(|(_, most)| *most).min().unwrap_or(0);
        if bytes > most.saturating_sub(4) {
            return Err(RenderError::TooLarge(format!("{label}: {bytes} bytes, of {most} at most")));
        }
        let size = bytes.next_multiple_of(4).max(4);
        self.guarded(label, || {
            self.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage,
                mapped_at_creation: false,
            })
        })
    }

    /// A buffer with these bytes in it.
    pub fn filled(
        &self,
        label: &str,
        bytes: &[u8],
        usage: BufferUsages,
    ) -> Result<wgpu::Buffer, RenderError> {
        let buffer = self.buffer(label, bytes.len() as u64, usage | BufferUsages::COPY_DST)?;
        self.write(&buffer, 0, bytes)?;
        Ok(buffer)
    }

    /// Writes whole words into a buffer.
    pub fn write(&self, buffer: &wgpu::Buffer, at: u64, bytes: &[u8]) -> Result<(), RenderError> {
        self.guarded("writing a buffer", || self.queue.write_buffer(buffer, at, bytes))
    }

    /// A texture of two dimensions, or of layers of that.
    pub fn texture(
        &self,
        label: &str,
        size: [u32; 2],
        format: TextureFormat,
        usage: TextureUsages,
    ) -> Result<wgpu::Texture, RenderError> {
        self.layers(label, size, 1, format, usage)
    }

    /// The same with layers.
    pub fn layers(
        &self,
        label: &str,
        size: [u32; 2],
        layers: u32,
        format: TextureFormat,
        usage: TextureUsages,
    ) -> Result<wgpu::Texture, RenderError> {
        let most = self.limits.max_texture_dimension_2d;
        if size.iter().any(|&side| side == 0 || side > most) {
            let [w, h] = size;
            return Err(RenderError::TooLarge(format!("{label}: {w} x {h}, of {most} x {most} at most")));
        }
        if layers == 0 || layers > self.limits.max_texture_array_layers {
            let most = self.limits.max_texture_array_layers;
            return Err(RenderError::TooLarge(format!("{label}: {layers} layers, of {most} at most")));
        }
        self.guarded(label, || {
            self.device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: layers },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage,
                view_formats: &[],
            })
        })
    }

    /// An image as a texture of its size, `Rgba8Unorm`: the shaders decode it.
    pub fn upload(
        &self,
        label: &str,
        image: &Image,
        usage: TextureUsages,
    ) -> Result<wgpu::Texture, RenderError> {
        let usage = usage | TextureUsages::COPY_DST;
        let texture = self.texture(label, image.size, TextureFormat::Rgba8Unorm, usage)?;
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(4 * image.size[0]),
            rows_per_image: None,
        };
        self.guarded(label, || {
            self.queue.write_texture(texture.as_image_copy(), image.bytes(), layout, texture.size());
        })?;
        Ok(texture)
    }
}

/// The best adapter there is. With the default flags a debug build would look for layers that are not there, and say so.
fn best(flags: wgpu::InstanceFlags) -> Option<wgpu::Adapter> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends: wgpu::Backends::VULKAN,
        flags,
        memory_budget_thresholds: wgpu::MemoryBudgetThresholds {
            for_resource_creation: Some(FULL_PERCENT),
            for_device_loss: None,
        },
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::VULKAN));
    adapters.into_iter().min_by_key(|adapter| rank(adapter.get_info().device_type))
}

/// The most wanted first.
fn rank(kind: wgpu::DeviceType) -> u32 {
    match kind {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    }
}

fn described(info: &wgpu::AdapterInfo) -> Adapter {
    let driver = [info.driver.as_str(), info.driver_info.as_str()].join(" ");
    Adapter {
        kind: Kind::Gpu,
        name: info.name.clone(),
        driver: driver.trim().into(),
        backend: info.backend.to_string(),
        shaders: shaders::digest(),
    }
}

fn typed(what: &str, error: &wgpu::Error) -> RenderError {
    match error {
        wgpu::Error::OutOfMemory { .. } => RenderError::TooLarge(format!("{what}: out of memory")),
        wgpu::Error::Validation { description, .. } | wgpu::Error::Internal { description, .. } => {
            RenderError::Refused(format!("{what}: {description}"))
        }
    }
}

/// Notes what nobody awaited, the first of it.
fn watch(device: &wgpu::Device) -> Arc<Mutex<Option<RenderError>>> {
    let trouble = Arc::new(Mutex::new(None));
    let (uncaught, lost) = (trouble.clone(), trouble.clone());
    device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
        uncaught.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(typed("later", &error));
    }));
    device.set_device_lost_callback(move |reason, why| {
        let error = RenderError::Lost(format!("{reason:?} {why}").trim().into());
        *lost.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
    });
    trouble
}
