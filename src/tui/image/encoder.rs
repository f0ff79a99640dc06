//! Makes pictures ready to be drawn, on a thread of its own: a screen never waits for pixels.
//!
//! There is one place for what is asked for, and whoever comes later takes it over: a picture that was overtaken before its turn is never
//! made. What is being made is finished and handed on, so that something is seen while somebody keeps turning the model. Nothing is kept but the newest.
//!
//! Cutting to the window, comparing and encoding all happen here. The same without a thread is [`encode`].

use std::fmt;
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread;

use ::image::{DynamicImage, RgbaImage};
use ratatui::buffer::Buffer;
use ratatui::layout::{Rect, Size};
use ratatui::widgets::Widget;
use ratatui_image::protocol::Protocol;
use ratatui_image::protocol::iterm2::Iterm2;
use ratatui_image::protocol::kitty::Kitty;
use ratatui_image::protocol::sixel::Sixel;

use super::blocks::Blocks;
use super::compare::slider;
use super::marks::{self, Mark};
use super::protocol::{Kind, Medium};
use super::window::{Fit, Window};
use crate::canvas::image::Image;

/// The picture's name in a terminal that keeps pictures: a new one takes the old one's place.
const NAME: u32 = 0x6c_6e_63;

/// A picture to show.
#[derive(Clone, Debug)]
pub struct Request {
    /// Tells pictures apart: another picture has another number.
    pub number: u64,
    /// The picture.
    pub image: Arc<Image>,
    /// Another one, to be seen right of a line at a share of the pane's width.
    pub beside: Option<(Arc<Image>, f64)>,
    /// The part that is seen.
    pub window: Window,
    /// The pane, in cells.
    pub area: Size,
    /// How it reaches the terminal.
    pub medium: Medium,
    /// What is marked in it, where it goes by a protocol: half blocks can have characters over them.
    pub marks: Vec<Mark>,
}

impl Request {
    /// A whole picture.
    pub fn whole(number: u64, image: Arc<Image>, area: Size) -> Self {
        let (window, medium) = (Window::default(), Medium::BLOCKS);
        Self { number, image, beside: None, window, area, medium, marks: Vec::new() }
    }

    /// What makes it look as it does.
    fn key(&self) -> Key {
        Key {
            number: self.number,
            share: self.beside.as_ref().map(|(_, share)| *share),
            window: self.window,
            area: self.area,
            medium: self.medium,
            marks: self.marks.clone(),
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
struct Key {
    number: u64,
    share: Option<f64>,
    window: Window,
    area: Size,
    medium: Medium,
    marks: Vec<Mark>,
}

/// A picture that is ready to be drawn at the pane's place.
pub struct Encoded {
    key: Key,
    /// Where the picture lies in the pane: what a click means.
    pub fit: Fit,
    shape: Shape,
}

enum Shape {
    Blocks(Blocks),
    /// With half blocks of the same, to be shown while something lies over the picture.
    Graphics(Protocol, Blocks),
    Nothing,
}

impl fmt::Debug for Encoded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Encoded {} for {}", self.key.number, self.key.area)
    }
}

impl Encoded {
    /// The request's number.
    pub fn number(&self) -> u64 {
        self.key.number
    }

    /// The pane that it was made for.
    pub fn area(&self) -> Size {
        self.key.area
    }

    /// Whether it is what is asked for.
    pub fn answers(&self, request: &Request) -> bool {
        self.key == request.key()
    }

    /// Draws it at the pane's place. Graphics cannot lie under text: while something covers a part of them, half blocks stand for all of it. Graphics that
    /// do not fit, since the pane has become smaller, are left out until the new ones come.
    pub fn draw(&self, area: Rect, buffer: &mut Buffer, is_covered: bool) {
        let area = area.intersection(buffer.area);
        match &self.shape {
            Shape::Graphics(graphics, _) if !is_covered => {
                ratatui_image::Image::new(graphics).render(area, buffer);
            }
            Shape::Blocks(blocks) | Shape::Graphics(_, blocks) => blocks.render(area, buffer),
            Shape::Nothing => {}
        }
    }
}

/// Makes a picture ready. An error says why it cannot be shown this way.
pub fn encode(request: &Request) -> Result<Encoded, String> {
    let Request { image, window, area, medium, marks, .. } = request;
    let pane = medium.pixels(*area);
    let fit = window.fit(image.size, pane);
    let shape = match medium.kind {
        _ if area.area() == 0 => Shape::Nothing,
        Kind::None => Shape::Nothing,
        Kind::Halfblocks => Shape::Blocks(Blocks::new(&cut(request, pane))),
        kind => {
            let blocks = Blocks::new(&cut(request, Medium::BLOCKS.pixels(*area)));
            let mut picture = cut(request, pane);
            marks.iter().for_each(|mark| marks::draw(&mut picture, &fit, mark, medium.cell[1]));
            Shape::Graphics(graphics(kind, picture, *area)?, blocks)
        }
    };
    Ok(Encoded { key: request.key(), fit, shape })
}

/// What is seen in a pane of so many pixels.
fn cut(Request { image, beside, window, .. }: &Request, pane: [u32; 2]) -> Image {
    let left = window.fit(image.size, pane).crop(image);
    match beside {
        None => left,
        Some((image, share)) => slider(&left, &window.fit(image.size, pane).crop(image), *share),
    }
}

fn graphics(kind: Kind, picture: Image, area: Size) -> Result<Protocol, String> {
    let [width, height] = picture.size;
    let bytes = picture.texels.into_flattened();
    let image =
        RgbaImage::from_raw(width, height, bytes).ok_or("the picture has not the size that it says")?;
    let image = DynamicImage::from(image);
    let graphics = match kind {
        Kind::Kitty => Kitty::new(image, area, NAME, false, true).map(Protocol::Kitty),
        Kind::Sixel => Sixel::new(image, area, false).map(Protocol::Sixel),
        _ => Iterm2::new(image, area, false).map(Protocol::ITerm2),
    };
    graphics.map_err(|error| format!("the picture cannot be shown: {error}"))
}

/// Where a request waits.
#[derive(Default)]
struct Desk {
    slot: Mutex<Slot>,
    changed: Condvar,
}

#[derive(Default)]
struct Slot {
    next: Option<Request>,
    closed: bool,
}

impl Desk {
    /// Changes the slot. A thread that panicked while it held it left it whole: nothing in it is half done.
    fn change(&self, change: impl FnOnce(&mut Slot)) {
        change(&mut self.slot.lock().unwrap_or_else(PoisonError::into_inner));
        self.changed.notify_one();
    }

    /// Waits for a request. None when there will be no more.
    fn take(&self) -> Option<Request> {
        let mut slot = self.slot.lock().unwrap_or_else(PoisonError::into_inner);
        loop {
            if slot.closed {
                return None;
            }
            if let Some(request) = slot.next.take() {
                return Some(request);
            }
            slot = self.changed.wait(slot).unwrap_or_else(PoisonError::into_inner);
        }
    }
}

/// A thread that makes pictures ready.
pub struct Encoder {
    desk: Arc<Desk>,
    asked: Option<Key>,
}

impl fmt::Debug for Encoder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Encoder, last asked for {:?}", self.asked)
    }
}

impl Encoder {
    /// Starts the thread. It hands each picture to `done`. An error says that there can be no thread.
    pub fn start(mut done: impl FnMut(Result<Encoded, String>) + Send + 'static) -> std::io::Result<Self> {
        let desk = Arc::new(Desk::default());
        let theirs = Arc::clone(&desk);
        let work = move || {
            while let Some(request) = theirs.take() {
                done(encode(&request));
            }
        };
        thread::Builder::new().name("encoder".into()).spawn(work)?;
        Ok(Self { desk, asked: None })
    }

    /// Asks for a picture, unless it is the one that was asked for last. True if it is another.
    pub fn ask(&mut self, request: Request) -> bool {
        let key = request.key();
        let other = self.asked != Some(key.clone());
        if other {
            self.asked = Some(key);
            self.desk.change(|slot| slot.next = Some(request));
        }
        other
    }

    /// What was shown is gone, since the terminal was cleared or left: the same picture has to be made again.
    pub fn forget(&mut self) {
        self.asked = None;
    }
}

impl Drop for Encoder {
    fn drop(&mut self) {
        self.desk.change(|slot| *slot = Slot { next: None, closed: true });
    }
}

#[cfg(test)]
mod tests;
