// SPDX-License-Identifier: MIT
#![doc = include_str!("../README.md")]

mod character;
mod crowd;
mod error;
mod level;
mod memory;
mod navmesh;
mod shapes;
mod soup;
mod tasks;

pub use character::{
    Character, CharacterHit, CharacterMover, CharacterReport, CharacterSettings, CharacterStep, Surface,
};
pub use crowd::{Agent, AgentSettings, AgentState, AgentStatus, Crowd, CrowdReport, CrowdSettings};
pub use error::{Error, ErrorKind};
pub use level::Level;
pub use navmesh::{Navmesh, NavmeshSettings, Path, Query};
pub use shapes::{cast, distance, penetration, CastHit, Hull, Penetration, Pose, Separation, Shape};
pub use soup::{Cull, Nearest, Ray, RayHit, ShapeHit, Side, Soup};

/// A point or direction: x, y up, z; metres.
pub type Point = [f32; 3];
