// SPDX-License-Identifier: MIT
use std::collections::HashMap;
use std::ptr::null_mut;
use std::sync::Arc;

use talus_sys as sys;

use crate::point::vec3;
use crate::shapes::{Hull, Pose, Shape};
use crate::soup::view;
use crate::{Draft, Error, Navmesh, NavmeshSettings, Point};

/// A solid body that comes, moves and goes: a crate, a car, a closed door. Agents keep their radius from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Obstacle {
    /// An upright cylinder.
    Cylinder {
        /// Centre of its base, metres.
        base: Point,
        /// Metres, > 0.
        radius: f32,
        /// Metres, >= 0.
        height: f32,
    },
    /// A box, turned about y.
    Box {
        /// Centre of its base, metres.
        base: Point,
        /// Half its extents along its own x and z, metres, >= 0.
        half_extents: [f32; 2],
        /// Metres, >= 0.
        height: f32,
        /// Radians: its own x points to (cos, -sin) in the plane of x and z.
        turned: f32,
    },
    /// A box at any pose, about its middle.
    Cuboid {
        /// Half its extents along its own axes, metres, >= 0.
        half_extents: Point,
        /// Where its middle is, and how it is turned.
        pose: Pose,
    },
    /// All that is as near to a segment as the radius.
    Capsule {
        /// Ends of the segment, metres.
        ends: [Point; 2],
        /// Metres, >= 0.
        radius: f32,
    },
}

impl Obstacle {
    fn raw(&self) -> sys::tl_nav_obstacle {
        // SAFETY: a plain struct, of which all bits may be 0: area 0 is a solid body.
        let mut raw: sys::tl_nav_obstacle = unsafe { std::mem::zeroed() };
        match *self {
            Obstacle::Cylinder { base, radius, height } => {
                raw.shape = sys::TL_NAV_OBSTACLE_CYLINDER;
                (raw.base, raw.radius, raw.height) = (vec3(base), radius, height);
            }
            Obstacle::Box { base, half_extents: [x, z], height, turned } => {
                raw.shape = sys::TL_NAV_OBSTACLE_BOX;
                (raw.base, raw.half_x, raw.half_z, raw.height) = (vec3(base), x, z, height);
                (raw.sine, raw.cosine) = turned.sin_cos();
            }
            Obstacle::Cuboid { half_extents, pose } => {
                return raw_convex(&Shape::cuboid([0.0; 3], half_extents, 0.0), &pose);
            }
            Obstacle::Capsule { ends: [a, b], radius } => {
                // Its place is the middle: far away the ends would lose their digits.
                let middle = [0, 1, 2].map(|axis| 0.5 * (a[axis] + b[axis]));
                let from_middle = |end: Point| [0, 1, 2].map(|axis| end[axis] - middle[axis]);
                let shape = Shape::capsule(from_middle(a), from_middle(b), radius);
                return raw_convex(&shape, &Pose::at(middle));
            }
        }
        raw
    }
}

fn raw_convex(shape: &Shape<'_>, pose: &Pose) -> sys::tl_nav_obstacle {
    // SAFETY: a plain struct, of which all bits may be 0; the shape's pointer is valid.
    let mut raw: sys::tl_nav_obstacle = unsafe { std::mem::zeroed() };
    raw.shape = sys::TL_NAV_OBSTACLE_CONVEX;
    raw.convex = unsafe { *shape.raw() };
    raw.pose = pose.raw();
    raw
}

/// The name of an obstacle, until it is removed. It is not used again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ObstacleId(sys::tl_nav_obstacle_id);

/// The obstacles of a navmesh, and what its tiles are baked from again where they touch one.
///
/// ```
/// use talus::{NavVersions, NavmeshSettings, Obstacle, Obstacles};
///
/// let vertices = [[0.0, 0.0, 0.0], [0.0, 0.0, 20.0], [20.0, 0.0, 20.0], [20.0, 0.0, 0.0]];
/// let settings = NavmeshSettings { tile_size: 32, ..NavmeshSettings::default() };
/// let (mut obstacles, navmesh) = Obstacles::bake(&vertices, &[[0, 1, 2], [0, 2, 3]], &settings)?;
/// let versions = NavVersions::new(&navmesh)?;
///
/// let wall = Obstacle::Box { base: [10.0, 0.0, 8.0], half_extents: [0.5, 8.0], height: 2.0, turned: 0.0 };
/// let wall = obstacles.add(&wall)?;
/// let mut draft = versions.edit()?;
/// while obstacles.update(&mut draft, 4)? > 0 {} // or a few tiles each frame
/// let around = draft.publish();
///
/// let (start, goal) = ([5.0, 0.0, 5.0], [15.0, 0.0, 5.0]);
/// assert!(around.query()?.shortest_path(start, goal)?.unwrap().length > 20.0);
/// obstacles.remove(wall)?;
/// assert!(obstacles.waiting() > 0);
/// # Ok::<(), talus::Error>(())
/// ```
pub struct Obstacles {
    at: *mut sys::tl_nav_obstacles,
    /// What obstacles borrow.
    hulls: HashMap<ObstacleId, Arc<Hull>>,
}

// SAFETY: its memory is its own; it may move to another thread, and is not shared, since the pointer is not Sync.
unsafe impl Send for Obstacles {}

impl Drop for Obstacles {
    fn drop(&mut self) {
        // SAFETY: made by tl_nav_obstacles_bake, destroyed once.
        unsafe { sys::tl_nav_obstacles_destroy(self.at) }
    }
}

impl Obstacles {
    /// Bakes a navmesh in tiles (`tile_size` > 0) and keeps what they are baked from. The navmesh is as that of
    /// [`Navmesh::bake`]; put it into [`NavVersions`](crate::NavVersions), whose drafts [`Obstacles::update`] changes.
    ///
    /// # Errors
    /// As of [`Navmesh::bake`]; [`ErrorKind::Argument`](crate::ErrorKind) "tile_size" where that is 0.
    pub fn bake(
        vertices: &[Point],
        triangles: &[[u32; 3]],
        settings: &NavmeshSettings,
    ) -> Result<(Obstacles, Navmesh), Error> {
        let input = sys::tl_nav_input {
            mesh: view(vertices, triangles)?,
            areas: std::ptr::null(),
            volumes: std::ptr::null(),
            volume_count: 0,
        };
        let def = settings.def(vertices, triangles);
        let (mut at, mut grid) = (null_mut(), [0, 0]);
        // SAFETY: slices and def outlive the bake; outputs are valid.
        let obstacles = unsafe {
            let mut report: sys::tl_nav_bake_report = std::mem::zeroed();
            let result = sys::tl_nav_obstacles_bake(&def, &input, &mut at, null_mut(), &mut report);
            Error::check(result, Some(&report.base))?;
            let obstacles = Obstacles { at, hulls: HashMap::new() };
            let [x, z] = &mut grid;
            let result = sys::tl_nav_tile_grid(&def, def.bounds, x, z, &mut report.base);
            Error::check(result, Some(&report.base))?;
            obstacles
        };
        let navmesh = Navmesh::filled(def, grid, |navmesh| obstacles.fill(navmesh, u32::MAX).map(|_| ()))?;
        Ok((obstacles, navmesh))
    }

    /// Adds an obstacle; the tiles that it touches wait to be baked again.
    ///
    /// # Errors
    /// [`ErrorKind::Argument`](crate::ErrorKind) and `NotFinite` name a field; `Memory`.
    pub fn add(&mut self, obstacle: &Obstacle) -> Result<ObstacleId, Error> {
        self.add_raw(&obstacle.raw())
    }

    /// Adds a hull at a pose.
    ///
    /// # Errors
    /// As of [`Obstacles::add`].
    pub fn add_hull(&mut self, hull: &Arc<Hull>, pose: &Pose) -> Result<ObstacleId, Error> {
        let id = self.add_raw(&raw_convex(&Shape::hull(hull, 0.0), pose))?;
        self.hulls.insert(id, Arc::clone(hull));
        Ok(id)
    }

    fn add_raw(&mut self, raw: &sys::tl_nav_obstacle) -> Result<ObstacleId, Error> {
        let mut id = 0;
        // SAFETY: the obstacles are whole, outputs are valid.
        unsafe {
            let mut report = std::mem::zeroed();
            Error::check(sys::tl_nav_obstacles_add(self.at, raw, &mut id, &mut report), Some(&report))?;
        }
        Ok(ObstacleId(id))
    }

    /// Moves an obstacle, or changes its shape: the tiles of its old and its new place wait.
    ///
    /// # Errors
    /// As of [`Obstacles::add`]; [`ErrorKind::Stale`](crate::ErrorKind): there is no such obstacle.
    pub fn change(&mut self, id: ObstacleId, obstacle: &Obstacle) -> Result<(), Error> {
        self.change_raw(id, &obstacle.raw())?;
        self.hulls.remove(&id);
        Ok(())
    }

    /// Moves a hull, or makes an obstacle a hull.
    ///
    /// # Errors
    /// As of [`Obstacles::change`].
    pub fn change_hull(&mut self, id: ObstacleId, hull: &Arc<Hull>, pose: &Pose) -> Result<(), Error> {
        self.change_raw(id, &raw_convex(&Shape::hull(hull, 0.0), pose))?;
        self.hulls.insert(id, Arc::clone(hull));
        Ok(())
    }

    fn change_raw(&mut self, id: ObstacleId, raw: &sys::tl_nav_obstacle) -> Result<(), Error> {
        // SAFETY: the obstacles are whole, the output is valid.
        unsafe {
            let mut report = std::mem::zeroed();
            Error::check(sys::tl_nav_obstacles_move(self.at, id.0, raw, &mut report), Some(&report))
        }
    }

    /// Removes an obstacle; the tiles that it touched wait.
    ///
    /// # Errors
    /// [`ErrorKind::Stale`](crate::ErrorKind): there is no such obstacle.
    pub fn remove(&mut self, id: ObstacleId) -> Result<(), Error> {
        // SAFETY: the obstacles are whole.
        Error::check(unsafe { sys::tl_nav_obstacles_remove(self.at, id.0) }, None)?;
        self.hulls.remove(&id);
        Ok(())
    }

    /// Tiles that wait to be baked again.
    pub fn waiting(&self) -> u32 {
        // SAFETY: the obstacles are whole.
        unsafe { sys::tl_nav_obstacles_waiting(self.at) }
    }

    /// Bakes up to so many waiting tiles again and puts them into a draft; returns how many wait still. The draft is one
    /// of the versions made of this navmesh.
    ///
    /// # Errors
    /// [`ErrorKind::Memory`](crate::ErrorKind): the tile in work keeps waiting. `Argument`: a draft of another navmesh.
    pub fn update(&mut self, draft: &mut Draft<'_>, max_tiles: u32) -> Result<u32, Error> {
        self.fill(draft.raw(), max_tiles)
    }

    fn fill(&self, navmesh: *mut sys::tl_navmesh, max_tiles: u32) -> Result<u32, Error> {
        let mut waiting = 0;
        // SAFETY: obstacles and navmesh are whole, and the callers have them alone; outputs are valid.
        unsafe {
            let mut report: sys::tl_nav_bake_report = std::mem::zeroed();
            let result = sys::tl_nav_obstacles_update(self.at, navmesh, max_tiles, &mut waiting, &mut report);
            Error::check(result, Some(&report.base))?;
        }
        Ok(waiting)
    }
}
