//! From the device back: buffers, and regions of textures, whose rows lie padded on the way.

use std::ops::Range;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::Duration;

use wgpu::{BufferUsages, COPY_BYTES_PER_ROW_ALIGNMENT};

use super::device::Device;
use crate::canvas::RenderError;

/// What becomes of a mapping.
type Mapped = Result<(), wgpu::BufferAsyncError>;

/// Seconds that an answer may take after the device is done.
const PATIENCE: u32 = 10;

/// Where and how large a region of a texture is, and how it lies in a buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Region {
    /// Its first texel.
    pub origin: [u32; 2],
    /// Its width and height, not 0.
    pub size: [u32; 2],
    /// Bytes of a texel.
    pub texel: u32,
}

impl Region {
    /// Bytes from one row to the next in a buffer.
    #[must_use]
    pub fn stride(&self) -> u32 {
        (self.size[0] * self.texel).next_multiple_of(COPY_BYTES_PER_ROW_ALIGNMENT)
    }

    /// Bytes of all rows, padded.
    #[must_use]
    pub fn padded(&self) -> u64 {
        u64::from(self.stride()) * u64::from(self.size[1])
    }

    /// Asks for the copy from a texture into a buffer, from a place in it that is a multiple of 256.
    pub fn copy(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        from: &wgpu::Texture,
        into: &wgpu::Buffer,
        offset: u64,
    ) {
        let [x, y] = self.origin;
        let from =
            wgpu::TexelCopyTextureInfo { origin: wgpu::Origin3d { x, y, z: 0 }, ..from.as_image_copy() };
        let layout =
            wgpu::TexelCopyBufferLayout { offset, bytes_per_row: Some(self.stride()), rows_per_image: None };
        let [width, height] = self.size;
        encoder.copy_texture_to_buffer(
            from,
            wgpu::TexelCopyBufferInfo { buffer: into, layout },
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
    }

    /// The rows without their padding.
    #[must_use]
    pub fn packed(&self, bytes: &[u8]) -> Vec<u8> {
        let row = (self.size[0] * self.texel) as usize;
        let rows = bytes.chunks(self.stride() as usize).take(self.size[1] as usize);
        rows.flat_map(|padded| &padded[..row.min(padded.len())]).copied().collect()
    }
}

impl Device {
    /// A region of a texture, row by row. The texture can be copied from.
    pub fn read_texture(&self, texture: &wgpu::Texture, region: Region) -> Result<Vec<u8>, RenderError> {
        let staging = self.staging("read a texture", region.padded())?;
        self.submit("read a texture", |encoder| region.copy(encoder, texture, &staging, 0))?;
        Ok(region.packed(&self.mapped(&staging)?))
    }

    /// A part of a buffer, its ends multiples of four. The buffer can be copied from.
    pub fn read_buffer(&self, buffer: &wgpu::Buffer, part: Range<u64>) -> Result<Vec<u8>, RenderError> {
        let bytes = part.end.saturating_sub(part.start);
        let staging = self.staging("read a buffer", bytes)?;
        self.submit("read a buffer", |encoder| {
            encoder.copy_buffer_to_buffer(buffer, part.start, &staging, 0, bytes);
        })?;
        let mut read = self.mapped(&staging)?;
        read.truncate(bytes as usize);
        Ok(read)
    }

    /// A buffer that is copied into on the device and read here.
    pub fn staging(&self, label: &str, bytes: u64) -> Result<wgpu::Buffer, RenderError> {
        self.buffer(label, bytes, BufferUsages::COPY_DST | BufferUsages::MAP_READ)
    }

    /// Records commands and submits them at once.
    pub fn submit(
        &self,
        what: &str,
        record: impl FnOnce(&mut wgpu::CommandEncoder),
    ) -> Result<(), RenderError> {
        self.guarded(what, || {
            let mut encoder =
                self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some(what) });
            record(&mut encoder);
            self.queue.submit([encoder.finish()]);
        })
    }

    /// The bytes of a staging buffer, once what was submitted is done.
    pub fn mapped(&self, staging: &wgpu::Buffer) -> Result<Vec<u8>, RenderError> {
        let (say, told) = mpsc::channel();
        self.guarded("mapping a buffer", || {
            staging.map_async(wgpu::MapMode::Read, .., move |result| drop(say.send(result)));
        })?;
        let failed = |why: &str| RenderError::Lost(format!("a buffer cannot be read: {why}"));
        self.await_mapping(&told)?.map_err(|error| failed(&error.to_string()))?;
        let bytes = staging.get_mapped_range(..).map_err(|error| failed(&error.to_string()))?.to_vec();
        staging.unmap();
        Ok(bytes)
    }

    /// Waits until a mapping is answered. It may be another thread's waiting that the answer comes with, a little later than ours ends.
    fn await_mapping(&self, told: &Receiver<Mapped>) -> Result<Mapped, RenderError> {
        for _ in 0..PATIENCE {
            self.wait()?;
            match told.recv_timeout(Duration::from_secs(1)) {
                Ok(answer) => return Ok(answer),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => break,
            }
        }
        Err(RenderError::Lost("a mapping was never answered".into()))
    }
}
