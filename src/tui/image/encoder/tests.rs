//! Pictures in half blocks and in every graphics protocol.

use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::Duration;

use ratatui::style::Color;

use super::*;

const RED: [u8; 4] = [200, 0, 0, 255];
const BLUE: [u8; 4] = [0, 0, 200, 255];

fn image(colour: [u8; 4]) -> Arc<Image> {
    Arc::new(Image::filled([30, 20], colour))
}

fn request(number: u64, colour: [u8; 4]) -> Request {
    Request::whole(number, image(colour), Size::new(6, 2))
}

fn drawn(encoded: &Encoded, area: Rect) -> Buffer {
    let mut buffer = Buffer::empty(Rect::new(0, 0, 10, 5));
    encoded.draw(area, &mut buffer, false);
    buffer
}

#[test]
fn half_blocks_show_the_picture_in_its_pane() {
    let encoded = encode(&request(3, RED)).expect("a picture");
    assert_eq!((encoded.number(), encoded.area()), (3, Size::new(6, 2)));
    let buffer = drawn(&encoded, Rect::new(1, 1, 6, 2));
    let red = |x: u16, y: u16| buffer[(x, y)].bg == Color::Rgb(200, 0, 0);
    let painted = (0..5).flat_map(|y| (0..10).filter(move |x| red(*x, y))).count();
    assert_eq!((painted, red(1, 1), red(6, 2)), (12, true, true));
    assert_eq!(encoded.fit.to_picture(Medium::BLOCKS.middle([3, 1])), Some([17.5, 15.0]));
}

#[test]
fn two_pictures_meet_at_the_line() {
    let beside = Some((image(BLUE), 0.5));
    let encoded = encode(&Request { beside, ..request(0, RED) }).expect("a picture");
    let buffer = drawn(&encoded, Rect::new(0, 0, 6, 2));
    let [red, white, blue] = [(200, 0, 0), (255, 255, 255), (0, 0, 200)].map(|(r, g, b)| Color::Rgb(r, g, b));
    let row: Vec<Color> = (0..6).map(|x| buffer[(x, 1)].bg).collect();
    assert_eq!(row, [red, red, red, white, blue, blue]);
}

#[test]
fn graphics_are_made_for_every_protocol_and_left_out_where_they_do_not_fit() {
    for (kind, begins) in [(Kind::Kitty, "\u{1b}_G"), (Kind::Sixel, "\u{1b}["), (Kind::Iterm2, "\u{1b}[")] {
        let medium = Medium { kind, cell: [8, 16] };
        let make = || encode(&Request { medium, ..request(0, RED) }).expect("a picture");
        let buffer = drawn(&make(), Rect::new(2, 1, 6, 2));
        let symbol = buffer[(2, 1)].symbol();
        assert!(symbol.starts_with(begins), "{kind:?}: {symbol:?}");
        let mark = match kind {
            Kind::Kitty => "s=48,v=32",
            Kind::Sixel => "\u{1b}P",
            _ => "1337;File=inline=1",
        };
        assert!(symbol.contains(mark), "{kind:?}: {symbol:?}");
        assert_eq!(drawn(&make(), Rect::new(0, 0, 5, 2)), Buffer::empty(Rect::new(0, 0, 10, 5)));
    }
}

#[test]
fn without_pictures_or_without_room_nothing_is_drawn() {
    let none = Request { medium: Medium { kind: Kind::None, ..Medium::BLOCKS }, ..request(0, RED) };
    let blank = Buffer::empty(Rect::new(0, 0, 10, 5));
    assert_eq!(drawn(&encode(&none).expect("nothing"), Rect::new(0, 0, 6, 2)), blank);
    for (kind, area) in [Kind::Kitty, Kind::Sixel, Kind::Iterm2, Kind::Halfblocks]
        .into_iter()
        .flat_map(|kind| [(kind, Size::new(0, 3)), (kind, Size::new(3, 0)), (kind, Size::new(1, 1))])
    {
        let medium = Medium { kind, cell: [8, 16] };
        for picture in [image(RED), Arc::new(Image::default())] {
            let encoded = encode(&Request { medium, ..Request::whole(0, picture, area) });
            drawn(&encoded.expect("something"), Rect::new(9, 4, 40, 40));
        }
    }
}

/// An encoder, and what it made.
fn started() -> (Encoder, Receiver<Encoded>) {
    let (sender, receiver) = channel();
    let done =
        move |made: Result<Encoded, String>| sender.send(made.expect("a picture")).expect("a receiver");
    (Encoder::start(done).expect("a thread"), receiver)
}

#[test]
fn only_what_looks_different_is_made_again() {
    let (mut encoder, made) = started();
    let mut number = |request: Request| {
        let asked = encoder.ask(request);
        asked.then(|| made.recv().expect("a picture").number())
    };
    assert_eq!(number(request(1, RED)), Some(1));
    assert_eq!(number(request(1, RED)), None);
    assert_eq!(number(Request { area: Size::new(7, 2), ..request(1, RED) }), Some(1));
    let zoomed = Window { zoom: 2.0, ..Window::default() };
    assert_eq!(number(Request { window: zoomed, ..request(1, RED) }), Some(1));
    assert_eq!(number(request(2, RED)), Some(2));
    encoder.forget();
    assert!(encoder.ask(request(2, RED)));
}

#[test]
fn what_is_overtaken_is_dropped() {
    let (sender, made) = channel();
    let (open, gate) = channel::<()>();
    let done = move |encoded: Result<Encoded, String>| {
        sender.send(encoded.expect("a picture").number()).expect("a receiver");
        gate.recv().expect("a word to go on");
    };
    let mut encoder = Encoder::start(done).expect("a thread");
    encoder.ask(request(1, RED));
    assert_eq!(made.recv(), Ok(1));
    // The thread waits at the gate: of these only the last is left when it comes back.
    let picture = image(BLUE);
    for number in 2..=5 {
        encoder.ask(Request::whole(number, Arc::clone(&picture), Size::new(6, 2)));
    }
    assert_eq!(Arc::strong_count(&picture), 2, "ours, and the newest request's");
    (0..2).for_each(|_| open.send(()).expect("the thread"));
    assert_eq!(made.recv(), Ok(5));
    drop(encoder);
    let ended = made.recv_timeout(Duration::from_secs(20));
    assert_eq!(ended, Err(RecvTimeoutError::Disconnected), "the thread ends with its encoder");
}

#[test]
fn what_is_covered_is_shown_in_half_blocks() {
    let medium = Medium { kind: Kind::Sixel, cell: [8, 16] };
    let encoded = encode(&Request { medium, ..request(0, RED) }).expect("a picture");
    let mut buffer = Buffer::empty(Rect::new(0, 0, 10, 5));
    encoded.draw(Rect::new(0, 0, 6, 2), &mut buffer, true);
    assert_eq!(buffer, drawn(&encode(&request(0, RED)).expect("a picture"), Rect::new(0, 0, 6, 2)));
}
