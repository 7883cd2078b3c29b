// SPDX-License-Identifier: MIT
use std::ptr::{null, null_mut};
use std::sync::Arc;

use talus_sys as sys;

use crate::navmesh::Search;
use crate::point::vec3;
use crate::world::HeldWorld;
use crate::{Error, World, WorldPoint};

/// The floor's point nearest to another one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorldPlace {
    /// Metres; `None`: there is none among the tiles in memory.
    pub point: Option<WorldPoint>,
    /// Whether that is the answer of the whole world; else a tile that is not in memory may have a nearer one.
    pub loaded: bool,
}

/// How a path or a route ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum WorldStatus {
    /// It leads to the goal.
    Complete,
    /// Proven: none leads to the goal, in the whole world.
    Unreachable,
    /// None leads there over the tiles in memory, or those of an end are not there.
    NotLoaded,
    /// There is no floor near the start.
    NoStart,
    /// There is no floor near the goal.
    NoGoal,
}

/// A path over the tiles in memory.
#[derive(Clone, Debug, PartialEq)]
pub struct WorldPath {
    /// How it ended.
    pub status: WorldStatus,
    /// Whether that is the answer of the whole world. A path that is not proven can be walked, but tiles that are not in
    /// memory may hold a shorter one.
    pub proven: bool,
    /// Start, the corners where the path turns, goal. Empty unless complete.
    pub points: Vec<WorldPoint>,
    /// Metres in the plane; infinite unless complete.
    pub length: f64,
    /// Metres in the plane: no path of the whole world is shorter.
    pub lower_bound: f64,
}

/// Where a straight line along the floor ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorldRay {
    /// Whether a wall stopped it.
    pub hit: bool,
    /// False: it ended at the rim of what is in memory, and may go on there.
    pub loaded: bool,
    /// Share of the way in the plane, 0 to 1.
    pub t: f32,
    /// Metres, on the floor.
    pub point: WorldPoint,
}

/// A point of a route: its start, the middle of a gate between tiles that it goes through, or its goal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoutePoint {
    /// Metres.
    pub point: WorldPoint,
    /// Metres in the plane, of the route up to here.
    pub length: f64,
    /// Place in the file's grid that the route goes on in: what to load next.
    pub place: [i32; 2],
}

/// A way over the whole world, in memory or not.
#[derive(Clone, Debug, PartialEq)]
pub struct Route {
    /// How it ended; `NotLoaded`: the tiles of an end.
    pub status: WorldStatus,
    /// Metres in the plane: the route's, so that no shortest path is longer; infinite unless complete.
    pub length: f64,
    /// Metres in the plane: no path is shorter.
    pub lower_bound: f64,
    /// From start to goal; empty unless complete.
    pub points: Vec<RoutePoint>,
}

/// The memory of one thread's searches, for any world; keep it.
pub struct WorldQuery {
    search: Search,
}

/// The memory of one thread's routes over one world.
pub struct Router {
    at: *mut sys::tl_nav_router,
    world: Arc<HeldWorld>, // it outlives the router
}

// SAFETY: its memory is its own; it may move to another thread, and is not shared (`&mut Router`).
unsafe impl Send for Router {}

impl Drop for Router {
    fn drop(&mut self) {
        // SAFETY: made by tl_nav_router_create, destroyed once, before its world.
        unsafe { sys::tl_nav_router_destroy(self.at) }
    }
}

/// What the ends of a path stand on, or why they do not.
enum Ends {
    Found(sys::tl_nav_location, sys::tl_nav_location),
    Not(WorldStatus),
}

impl World {
    /// The memory that [`World::shortest_path`] takes.
    ///
    /// # Errors
    /// [`ErrorKind::Memory`](crate::ErrorKind).
    pub fn query(&self) -> Result<WorldQuery, Error> {
        Ok(WorldQuery { search: Search::new()? })
    }

    /// The memory that [`World::route`] takes; `None`: the file has no routes, which `talus world routes` puts in.
    ///
    /// # Errors
    /// [`ErrorKind::Memory`](crate::ErrorKind).
    pub fn router(&self) -> Result<Option<Router>, Error> {
        let mut at = null_mut();
        // SAFETY: the world is whole; outputs are valid.
        unsafe {
            let mut report = std::mem::zeroed();
            match sys::tl_nav_router_create(self.held.at, null(), &mut at, &mut report) {
                sys::TL_NOT_FOUND => return Ok(None),
                result => Error::check(result, Some(&report))?,
            }
        }
        Ok(Some(Router { at, world: Arc::clone(&self.held) }))
    }

    /// Whether all tiles that a circle in the plane touches are in memory. Metres.
    ///
    /// # Errors
    /// [`ErrorKind::NotFinite`](crate::ErrorKind); `Argument`: a negative radius.
    pub fn covers(&self, center: WorldPoint, radius: f64) -> Result<bool, Error> {
        // SAFETY: the world is whole.
        match unsafe { sys::tl_nav_world_covers(self.held.at, center.as_ptr(), radius) } {
            sys::TL_NOT_LOADED => Ok(false),
            result => Error::check(result, None).map(|()| true),
        }
    }

    // The location, and the outcome: TL_OK, TL_NOT_FOUND or TL_NOT_LOADED.
    fn locate(&self, point: WorldPoint) -> Result<(sys::tl_nav_location, sys::tl_result), Error> {
        // SAFETY: the world is whole; a NULL filter passes all; the output is valid.
        unsafe {
            let mut location = std::mem::zeroed();
            let extents = vec3(self.search_extents);
            let result = sys::tl_nav_world_find_nearest(self.held.at, null(), point.as_ptr(), extents, &mut location);
            match result {
                sys::TL_OK | sys::TL_NOT_FOUND | sys::TL_NOT_LOADED => Ok((location, result)),
                _ => Err(Error::new(result, None)),
            }
        }
    }

    fn locate_ends(&self, start: WorldPoint, goal: WorldPoint) -> Result<Ends, Error> {
        let not = |result, none| Ends::Not(if result == sys::TL_NOT_LOADED { WorldStatus::NotLoaded } else { none });
        let (start, result) = self.locate(start)?;
        if result != sys::TL_OK {
            return Ok(not(result, WorldStatus::NoStart));
        }
        let (goal, result) = self.locate(goal)?;
        Ok(if result != sys::TL_OK { not(result, WorldStatus::NoGoal) } else { Ends::Found(start, goal) })
    }

    // A point of the local frame in the level's coordinates.
    fn place_out(&self, point: sys::tl_vec3) -> WorldPoint {
        let mut out = [0.0; 3];
        // SAFETY: the world is whole, the output has three numbers.
        unsafe { sys::tl_nav_world_place_out(self.held.at, point, out.as_mut_ptr()) };
        out
    }

    /// The floor's point nearest to `point`, within `search_extents`.
    ///
    /// # Errors
    /// [`ErrorKind::NotFinite`](crate::ErrorKind), `Argument`.
    pub fn nearest_point(&self, point: WorldPoint) -> Result<WorldPlace, Error> {
        let (location, result) = self.locate(point)?;
        let found = location.polygon != 0;
        Ok(WorldPlace { point: found.then(|| self.place_out(location.point)), loaded: result != sys::TL_NOT_LOADED })
    }

    /// The shortest path over the tiles in memory, and whether it is that of the whole world.
    ///
    /// # Errors
    /// [`ErrorKind::GaveUp`](crate::ErrorKind) where the search ran out of memory; `NotFinite`, `Argument`.
    pub fn shortest_path(
        &self,
        query: &mut WorldQuery,
        start: WorldPoint,
        goal: WorldPoint,
    ) -> Result<WorldPath, Error> {
        let none = |status, proven, lower_bound| {
            Ok(WorldPath { status, proven, points: Vec::new(), length: f64::INFINITY, lower_bound })
        };
        let (start, goal) = match self.locate_ends(start, goal)? {
            Ends::Found(start, goal) => (start, goal),
            Ends::Not(WorldStatus::NotLoaded) => return none(WorldStatus::NotLoaded, false, 0.0),
            Ends::Not(status) => return none(status, true, f64::INFINITY),
        };
        let request = sys::tl_nav_path_request { filter: null(), start, goal };
        let (result, path, corners) = query.search.corners(|query, buffers, path| {
            // SAFETY: world, query and buffers are whole, and the output is valid.
            unsafe { sys::tl_nav_world_find_path(self.held.at, query, &request, buffers, path) }
        })?;
        let proven = result != sys::TL_NOT_LOADED;
        match path.status {
            sys::TL_NAV_PATH_COMPLETE => Ok(WorldPath {
                status: WorldStatus::Complete,
                proven,
                points: corners.iter().map(|corner| self.place_out(corner.point)).collect(),
                length: path.length,
                lower_bound: path.lower_bound,
            }),
            sys::TL_NAV_PATH_OUT_OF_NODES => Err(Error::new(sys::TL_ERR_NODES, None)),
            sys::TL_NAV_PATH_UNREACHABLE => none(WorldStatus::Unreachable, proven, f64::INFINITY),
            _ => none(WorldStatus::NotLoaded, false, path.lower_bound),
        }
    }

    /// A straight line along the floor from start towards end, until a wall stops it, or the rim of what is in memory.
    /// `None`: there is no floor near the start in memory.
    ///
    /// # Errors
    /// [`ErrorKind::NotFinite`](crate::ErrorKind), `Argument`.
    pub fn cast_ray(&self, start: WorldPoint, end: WorldPoint) -> Result<Option<WorldRay>, Error> {
        let (start, result) = self.locate(start)?;
        if result != sys::TL_OK {
            return Ok(None);
        }
        // SAFETY: the world is whole; a NULL filter passes all; outputs are valid.
        unsafe {
            let mut hit: sys::tl_nav_ray_hit = std::mem::zeroed();
            let result = sys::tl_nav_world_cast_ray(self.held.at, null(), &start, end.as_ptr(), &mut hit);
            if result != sys::TL_NOT_LOADED {
                Error::check(result, None)?;
            }
            let navmesh = sys::tl_nav_world_navmesh(self.held.at);
            sys::tl_navmesh_height(navmesh, hit.polygon, hit.point.x, hit.point.z, &mut hit.point.y);
            let loaded = result != sys::TL_NOT_LOADED;
            Ok(Some(WorldRay { hit: hit.hit && loaded, loaded, t: hit.t, point: self.place_out(hit.point) }))
        }
    }

    /// A route over the whole world, of which the tiles of both ends alone need to be in memory. It is there at once,
    /// over any distance, and bounds the shortest path's length from both sides.
    ///
    /// # Errors
    /// [`ErrorKind::Argument`](crate::ErrorKind): the router is of another world; `NotFinite`; `GaveUp`.
    pub fn route(&self, router: &mut Router, start: WorldPoint, goal: WorldPoint) -> Result<Route, Error> {
        if !Arc::ptr_eq(&self.held, &router.world) {
            return Err(Error::argument("router"));
        }
        let none = |status, lower_bound| Ok(Route { status, length: f64::INFINITY, lower_bound, points: Vec::new() });
        let (start, goal) = match self.locate_ends(start, goal)? {
            Ends::Found(start, goal) => (start, goal),
            Ends::Not(WorldStatus::NotLoaded) => return none(WorldStatus::NotLoaded, 0.0),
            Ends::Not(status) => return none(status, f64::INFINITY),
        };
        let request = sys::tl_nav_world_route_request { start, goal };
        let mut rows: Vec<sys::tl_nav_world_route_point> = Vec::with_capacity(256);
        loop {
            // SAFETY: world and router are whole, the buffer has room for its capacity; outputs are valid.
            let (result, route) = unsafe {
                let mut route: sys::tl_nav_world_route = std::mem::zeroed();
                let (at, room) = (rows.as_mut_ptr(), rows.capacity() as u32);
                (sys::tl_nav_world_find_route(self.held.at, router.at, &request, at, room, &mut route), route)
            };
            if result == sys::TL_INCOMPLETE {
                rows.reserve(route.point_count as usize);
                continue;
            }
            Error::check(result, None)?;
            if route.status != sys::TL_NAV_PATH_COMPLETE {
                return none(WorldStatus::Unreachable, f64::INFINITY);
            }
            // SAFETY: TL_OK: all of them were written.
            unsafe { rows.set_len(route.point_count as usize) };
            let point = |row: &sys::tl_nav_world_route_point| RoutePoint {
                point: row.point,
                length: row.length,
                place: [row.tile_x, row.tile_z],
            };
            return Ok(Route {
                status: WorldStatus::Complete,
                length: route.length,
                lower_bound: route.lower_bound,
                points: rows.iter().map(point).collect(),
            });
        }
    }
}
