// SPDX-License-Identifier: MIT
use std::ptr::{null, null_mut};

use talus_sys as sys;

use crate::point::{point_of, vec3};
use crate::{Error, Point, Query};

/// Where a corridor leads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// To the goal.
    Complete,
    /// As near to the goal as a path does: it cannot be reached.
    Nearest,
    /// Nowhere: no floor is near the goal, and the agent stays where it is.
    NoFloor,
}

/// A corner of the straight path through a corridor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Metres.
    pub point: Point,
    /// An off-mesh link begins here: see [`Corridor::pass_link`].
    pub takes_link: bool,
}

/// The polygons from an agent to its target, kept while both move: for agents whose motion is the caller's. (A
/// [`Crowd`](crate::Crowd) keeps one for each of its agents.) A path is searched once; each step then changes the ends only.
///
/// The functions search by the [`Query`] that they are given, over its navmesh. Where that is a newer version, or another
/// navmesh, call [`repair`](Corridor::repair) first; others fail with [`ErrorKind::Stale`](crate::ErrorKind) or `Argument`
/// where they need a polygon that is gone. After an error the corridor is as it was.
///
/// ```
/// # use talus::{Corridor, Navmesh, NavmeshSettings, Way};
/// # let vertices = [[-5.0, 0.0, -5.0], [-5.0, 0.0, 5.0], [5.0, 0.0, 5.0], [5.0, 0.0, -5.0]];
/// # let navmesh = Navmesh::bake(&vertices, &[[0, 1, 2], [0, 2, 3]], &NavmeshSettings::default())?;
/// let mut query = navmesh.query()?;
/// let mut corridor = Corridor::new(&query, [-4.0, 0.0, -4.0], 256)?.expect("a floor is there");
/// assert_eq!(corridor.find(&mut query, [4.0, 0.0, 4.0])?, Way::Complete);
/// for _ in 0..1000 {
///     let Some(next) = corridor.corners(&query, 2)?.get(1).copied() else { break };
///     let here = corridor.position();
///     let step: [f32; 3] = std::array::from_fn(|i| (next.point[i] - here[i]).clamp(-0.1, 0.1));
///     corridor.step(&mut query, std::array::from_fn(|i| here[i] + step[i]))?;
/// }
/// assert_eq!(corridor.position(), corridor.target());
/// # Ok::<(), talus::Error>(())
/// ```
pub struct Corridor {
    at: sys::tl_nav_corridor,
    // Where `at.path` points: its memory stays where it is when the corridor moves.
    #[allow(dead_code)]
    path: Box<[sys::tl_nav_ref]>,
}

// SAFETY: the memory that it points to is its own.
unsafe impl Send for Corridor {}
unsafe impl Sync for Corridor {}

impl Corridor {
    /// A corridor with agent and target at one point; `None`: no floor is near. It holds at most `capacity` polygons, of which
    /// one is needed; a longer path is cut off there, and searched on by the next [`find`](Corridor::find).
    ///
    /// # Errors
    /// [`ErrorKind::Argument`](crate::ErrorKind) (`capacity`), `NotFinite`.
    pub fn new(query: &Query, at: Point, capacity: usize) -> Result<Option<Corridor>, Error> {
        let count = u32::try_from(capacity).ok().filter(|&count| count > 0);
        let Some(count) = count else { return Err(Error::argument("capacity")) };
        let Some(location) = query.locate(at)? else { return Ok(None) };
        let mut path = vec![0; capacity].into_boxed_slice();
        // SAFETY: the buffer has so many entries and lives as long as the corridor.
        let corridor = unsafe {
            let mut corridor = sys::tl_nav_corridor_init(path.as_mut_ptr(), count);
            sys::tl_nav_corridor_reset(&mut corridor, &location);
            corridor
        };
        Ok(Some(Corridor { at: corridor, path }))
    }

    /// Of the agent.
    pub fn position(&self) -> Point {
        point_of(self.at.position)
    }

    /// The goal, or as near to it as the path leads.
    pub fn target(&self) -> Point {
        point_of(self.at.target)
    }

    /// The goal that was asked for.
    pub fn goal(&self) -> Point {
        point_of(self.at.goal)
    }

    /// Whether the target is the goal.
    pub fn reaches(&self) -> bool {
        self.at.reaches
    }

    /// Searches the path from the agent to a goal.
    ///
    /// # Errors
    /// [`ErrorKind::NotFinite`](crate::ErrorKind), `Stale`, `Memory`, `GaveUp`.
    pub fn find(&mut self, query: &mut Query, goal: Point) -> Result<Way, Error> {
        let Some(goal) = query.locate(goal)? else { return Ok(Way::NoFloor) };
        let (search, navmesh) = query.parts();
        // SAFETY: corridor, query and navmesh are whole; the output is valid.
        unsafe {
            let mut path = std::mem::zeroed();
            Error::check(sys::tl_nav_corridor_find(&mut self.at, search, navmesh, null(), &goal, &mut path), None)?;
            Corridor::way(path.status)
        }
    }

    fn way(status: sys::tl_nav_path_status) -> Result<Way, Error> {
        match status {
            sys::TL_NAV_PATH_COMPLETE => Ok(Way::Complete),
            sys::TL_NAV_PATH_UNREACHABLE => Ok(Way::Nearest),
            _ => Err(Error::new(sys::TL_ERR_NODES, None)),
        }
    }

    /// The next corners of the straight path, at most `count` of them: the first is where the agent stands, the second
    /// where it goes. No more of the path is looked at than that takes.
    ///
    /// # Errors
    /// [`ErrorKind::Stale`](crate::ErrorKind), `Argument` (no corner is asked for).
    pub fn corners(&self, query: &Query, count: usize) -> Result<Vec<Corner>, Error> {
        let room = count.min(self.at.count as usize + 2);
        let mut corners: Vec<sys::tl_nav_corner> = Vec::with_capacity(room);
        let mut found = 0;
        // SAFETY: corridor and navmesh are whole; there is room for so many corners, and as many as found are written.
        unsafe {
            let navmesh = query.navmesh().raw();
            let result = sys::tl_nav_corridor_corners(&self.at, navmesh, corners.as_mut_ptr(), room as u32, &mut found);
            if result != sys::TL_INCOMPLETE {
                Error::check(result, None)?;
            }
            corners.set_len((found as usize).min(room));
        }
        let takes_link = |corner: &sys::tl_nav_corner| corner.flags & sys::TL_NAV_CORNER_LINK != 0;
        Ok(corners.iter().map(|c| Corner { point: point_of(c.point), takes_link: takes_link(c) }).collect())
    }

    /// Moves the agent towards a point, along walls, and gives where it then stands.
    ///
    /// # Errors
    /// [`ErrorKind::NotFinite`](crate::ErrorKind), `Stale`, `Limit` (over more than 256 polygons).
    pub fn step(&mut self, query: &mut Query, to: Point) -> Result<Point, Error> {
        let (search, navmesh) = query.parts();
        // SAFETY: corridor, query and navmesh are whole.
        let result = unsafe { sys::tl_nav_corridor_move(&mut self.at, search, navmesh, null(), vec3(to)) };
        Error::check(result, None).map(|()| self.position())
    }

    /// Moves the target in the same way, to follow something that walks. For one that jumps, use [`find`](Corridor::find).
    ///
    /// # Errors
    /// As of [`step`](Corridor::step).
    pub fn step_target(&mut self, query: &mut Query, to: Point) -> Result<Point, Error> {
        let (search, navmesh) = query.parts();
        // SAFETY: corridor, query and navmesh are whole.
        let result = unsafe { sys::tl_nav_corridor_move_target(&mut self.at, search, navmesh, null(), vec3(to)) };
        Error::check(result, None).map(|()| self.target())
    }

    /// Takes the next off-mesh link, and gives where it begins and ends; the corridor then begins where it lands. For an
    /// agent at a corner that takes one. `None`: there is no link ahead.
    ///
    /// # Errors
    /// [`ErrorKind::Stale`](crate::ErrorKind): it was removed.
    pub fn pass_link(&mut self, query: &Query) -> Result<Option<[Point; 2]>, Error> {
        // SAFETY: corridor and navmesh are whole; the output is valid, and where no link is wanted NULL may stand.
        unsafe {
            let mut ends: [sys::tl_nav_location; 2] = std::mem::zeroed();
            let navmesh = query.navmesh().raw();
            match sys::tl_nav_corridor_pass_link(&mut self.at, navmesh, ends.as_mut_ptr(), null_mut()) {
                sys::TL_NOT_FOUND => Ok(None),
                result => Error::check(result, None).map(|()| Some([point_of(ends[0].point), point_of(ends[1].point)])),
            }
        }
    }

    /// Shortens the corridor by straight lines of at most `range` metres along the surface; true: it changed.
    ///
    /// # Errors
    /// As of [`corners`](Corridor::corners).
    pub fn shorten(&mut self, query: &Query, range: f32) -> Result<bool, Error> {
        let mut changed = false;
        // SAFETY: corridor and navmesh are whole; the output is valid.
        let result =
            unsafe { sys::tl_nav_corridor_shorten(&mut self.at, query.navmesh().raw(), null(), range, &mut changed) };
        Error::check(result, None).map(|()| changed)
    }

    /// Improves the corridor by a search of at most `max_steps` nodes, whose path replaces the first `ahead` polygons where
    /// it is shorter: for doors that have opened, and targets that have moved far. True: it changed.
    ///
    /// # Errors
    /// As of [`find`](Corridor::find).
    pub fn improve(&mut self, query: &mut Query, ahead: u32, max_steps: u32) -> Result<bool, Error> {
        let (search, navmesh) = query.parts();
        let mut changed = false;
        // SAFETY: corridor, query and navmesh are whole; the output is valid.
        let result = unsafe {
            sys::tl_nav_corridor_improve(&mut self.at, search, navmesh, null(), ahead, max_steps, &mut changed)
        };
        Error::check(result, None).map(|()| changed)
    }

    /// Repairs the corridor after the query went on to another version: one that is whole stays as it is; else agent and
    /// goal are moved to the floor near them, within the query's `search_extents`, and the path is searched anew. `None`: no
    /// floor is near the agent, and nothing changed.
    ///
    /// # Errors
    /// As of [`find`](Corridor::find); the corridor is then the agent's polygon alone.
    pub fn repair(&mut self, query: &mut Query) -> Result<Option<Way>, Error> {
        let extents = vec3(query.search_extents);
        let (search, navmesh) = query.parts();
        // SAFETY: corridor, query and navmesh are whole; the output is valid.
        unsafe {
            let mut path = std::mem::zeroed();
            match sys::tl_nav_corridor_repair(&mut self.at, search, navmesh, null(), extents, &mut path) {
                sys::TL_NOT_FOUND => Ok(None),
                result => {
                    Error::check(result, None)?;
                    Corridor::way(path.status).map(Some)
                }
            }
        }
    }
}
