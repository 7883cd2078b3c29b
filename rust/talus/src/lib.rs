// SPDX-License-Identifier: MIT
#![doc = include_str!("../README.md")]

mod character;
mod corridor;
mod crowd;
mod decompose;
mod error;
mod groups;
mod level;
mod memory;
mod navmesh;
mod obstacles;
mod point;
mod shapes;
mod soup;
mod tasks;
mod versions;
mod world;
mod world_queries;

pub use character::{
    Character, CharacterHit, CharacterMover, CharacterReport, CharacterSettings, CharacterStep, Surface,
};
pub use corridor::{Corner, Corridor, Way};
pub use crowd::{Agent, AgentSettings, AgentState, AgentStatus, Crowd, CrowdReport, CrowdSettings};
pub use decompose::{decompose, ConvexPart, DecomposeSettings, Solid};
pub use error::{Error, ErrorKind};
pub use groups::{Formation, Group, GroupSettings, GroupState};
pub use level::Level;
pub use navmesh::{Navmesh, NavmeshSettings, Path, Query};
pub use obstacles::{Obstacle, ObstacleId, Obstacles};
pub use shapes::{cast, distance, penetration, CastHit, Hull, HullSettings, Penetration, Pose, Separation, Shape};
pub use soup::{Cull, Nearest, Ray, RayHit, ShapeHit, Side, Soup};
pub use versions::{Draft, Link, LinkId, NavVersions, NavVersionsState};
pub use world::{Interest, World, WorldLoad, WorldSettings, WorldState};
pub use world_queries::{Route, RoutePoint, Router, WorldPath, WorldPlace, WorldQuery, WorldRay, WorldStatus};

/// A point or direction: x, y up, z; metres.
pub type Point = [f32; 3];

/// A point of a world, in the level's own coordinates; metres.
pub type WorldPoint = [f64; 3];
