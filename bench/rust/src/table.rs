// SPDX-License-Identifier: MIT
//! Timing and the table.

use std::hint::black_box;
use std::time::Instant;

/// Takes an answer, so that it is computed.
pub fn keep<T>(answer: T) {
    black_box(answer);
}

/// Seconds of `ours` and of `theirs`: medians of `runs` runs, taken in turn so that what disturbs one disturbs both.
pub fn race(runs: usize, mut ours: impl FnMut(), mut theirs: impl FnMut()) -> (f64, f64) {
    ours();
    theirs();
    let (mut a, mut b) = (Vec::new(), Vec::new());
    for _ in 0..runs {
        let begin = Instant::now();
        ours();
        a.push(begin.elapsed().as_secs_f64());
        let begin = Instant::now();
        theirs();
        b.push(begin.elapsed().as_secs_f64());
    }
    (median(a), median(b))
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

pub fn heading() {
    println!("| what | on | peer | talus | peer | times as fast | answers that agree |");
    println!("|---|---|---|---|---|---|---|");
}

/// A row: `count` answers in so many seconds, and the share of answers that agree. False: too few agree, so that no rate
/// counts.
pub fn row(what: &str, on: &str, peer: &str, count: usize, seconds: (f64, f64), agree: f64, least: f64) -> bool {
    let each = |seconds: f64| duration(seconds / count as f64);
    let (ours, theirs) = seconds;
    println!(
        "| {what} | {on} | {peer} | {} | {} | {:.2} | {:.3}% |",
        each(ours),
        each(theirs),
        theirs / ours,
        100.0 * agree
    );
    if agree < least {
        eprintln!("{what}, {on}: the answers of {peer} differ, so its rate does not count");
    }
    agree >= least
}

/// A row where the peer gave no answer.
pub fn refused(what: &str, on: &str, peer: &str, error: &str) {
    println!("| {what} | {on} | {peer} | | refused: {error} | | |");
}

fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 1e-6 => format!("{:.0} ns", s * 1e9),
        s if s < 1e-3 => format!("{:.2} us", s * 1e6),
        s => format!("{:.1} ms", s * 1e3),
    }
}
