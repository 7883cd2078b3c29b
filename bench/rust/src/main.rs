// SPDX-License-Identifier: MIT
//! The crate's rates beside parry3d, rerecast and polyanya: one table, on one core. Answers are compared before they are
//! timed, and each pair is timed in turn; `tools/rust-bench` runs it.
//!
//!     talus-bench [RUNS [rays|convex|navmesh]]

mod convex;
mod levels;
mod navmesh;
mod rays;
mod table;

fn main() -> std::process::ExitCode {
    let mut arguments = std::env::args().skip(1);
    let runs = arguments.next().map_or(Ok(7), |word| word.parse());
    let (Ok(runs @ 1..), only) = (runs, arguments.next()) else {
        eprintln!("usage: talus-bench [RUNS [rays|convex|navmesh]]");
        return std::process::ExitCode::from(2);
    };
    let wanted = |name: &str| only.as_deref().map_or(true, |only| only == name);
    table::heading();
    let mut good = true;
    for (name, part) in [("rays", rays::run as fn(usize) -> bool), ("convex", convex::run), ("navmesh", navmesh::run)] {
        good &= !wanted(name) || part(runs);
    }
    if good {
        std::process::ExitCode::SUCCESS
    } else {
        std::process::ExitCode::FAILURE
    }
}
