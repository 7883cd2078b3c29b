// SPDX-License-Identifier: MIT
use std::ffi::{c_char, c_void, CStr};
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::ptr::{null, null_mut};
use std::sync::Arc;

use talus_sys as sys;

use crate::memory::FileBytes;
use crate::shapes::vec3;
use crate::soup::{point_of, view};
use crate::{Error, Point};

/// What a navmesh is baked with. Lengths are metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NavmeshSettings {
    /// Width of a voxel, > 0.
    pub cell_size: f32,
    /// Height of a voxel, > 0.
    pub cell_height: f32,
    /// The agent fits where so much room is above the floor.
    pub agent_height: f32,
    /// The agent keeps so far from walls.
    pub agent_radius: f32,
    /// Steps up to this height are climbed.
    pub agent_max_climb: f32,
    /// Degrees: steeper triangles are no floor.
    pub agent_max_slope: f32,
    /// Voxels along a tile's side; 0: one tile.
    pub tile_size: u32,
}

impl Default for NavmeshSettings {
    fn default() -> NavmeshSettings {
        // SAFETY: gives a plain struct.
        let def = unsafe { sys::tl_default_nav_def() };
        NavmeshSettings {
            cell_size: def.cell_size,
            cell_height: def.cell_height,
            agent_height: def.agent_height,
            agent_radius: def.agent_radius,
            agent_max_climb: def.agent_max_climb,
            agent_max_slope: def.agent_max_slope,
            tile_size: def.tile_size,
        }
    }
}

impl NavmeshSettings {
    fn def(&self) -> sys::tl_nav_def {
        // SAFETY: gives a plain struct.
        let mut def = unsafe { sys::tl_default_nav_def() };
        def.cell_size = self.cell_size;
        def.cell_height = self.cell_height;
        def.agent_height = self.agent_height;
        def.agent_radius = self.agent_radius;
        def.agent_max_climb = self.agent_max_climb;
        def.agent_max_slope = self.agent_max_slope;
        def.tile_size = self.tile_size;
        def
    }
}

/// Where an agent can walk. Immutable here: threads may share it, each with a [`Query`] of its own.
///
/// It is a handle: a clone is the same navmesh, and costs what a clone of an [`Arc`] does. Queries and crowds hold one,
/// so they may be kept beside it, in one struct.
#[derive(Clone)]
pub struct Navmesh {
    held: Arc<Held>,
}

struct Held {
    at: *mut sys::tl_navmesh,
    def: sys::tl_nav_def,
    grid: [u32; 2],
    _file: Option<Arc<FileBytes>>, // borrowed tiles lie in it
}

// SAFETY: nothing here changes a navmesh after it was made, and its const functions may run on any number of threads.
unsafe impl Send for Held {}
unsafe impl Sync for Held {}

impl Drop for Held {
    fn drop(&mut self) {
        // SAFETY: made by tl_navmesh_create or tl_pack_load_navmesh, destroyed once.
        unsafe { sys::tl_navmesh_destroy(self.at) }
    }
}

struct Progress<'a> {
    update: &'a mut dyn FnMut(&str, u64, u64) -> bool,
    panic: Option<Box<dyn std::any::Any + Send>>,
}

// Unwinding through C is undefined: a panic cancels the bake, and goes on when that has returned.
unsafe extern "C" fn call_update(stage: *const c_char, done: u64, total: u64, user: *mut c_void) -> bool {
    // SAFETY: `user` is the Progress of the bake that calls, and `stage` a static string.
    let (progress, stage) = unsafe { (&mut *user.cast::<Progress<'_>>(), CStr::from_ptr(stage)) };
    let stage = stage.to_str().unwrap_or("");
    match catch_unwind(AssertUnwindSafe(|| (progress.update)(stage, done, total))) {
        Ok(goes_on) => goes_on,
        Err(payload) => {
            progress.panic = Some(payload);
            false
        }
    }
}

impl Navmesh {
    /// Bakes a navmesh over triangles, given as indices into `vertices`.
    ///
    /// # Errors
    /// [`ErrorKind::Argument`](crate::ErrorKind) names a setting, `NotFinite`, `Range` and `Index` a vertex or
    /// triangle; `Limit`, `Memory`. A level without floor gives a navmesh without polygons.
    pub fn bake(vertices: &[Point], triangles: &[[u32; 3]], settings: &NavmeshSettings) -> Result<Navmesh, Error> {
        Navmesh::bake_with_progress(vertices, triangles, settings, |_, _, _| true)
    }

    /// The same; `progress` gets a stage's name, what is done and the total, and returns false to cancel.
    ///
    /// # Errors
    /// Also [`ErrorKind::Cancelled`](crate::ErrorKind).
    pub fn bake_with_progress(
        vertices: &[Point],
        triangles: &[[u32; 3]],
        settings: &NavmeshSettings,
        mut progress: impl FnMut(&str, u64, u64) -> bool,
    ) -> Result<Navmesh, Error> {
        let input =
            sys::tl_nav_input { mesh: view(vertices, triangles)?, areas: null(), volumes: null(), volume_count: 0 };
        let mut held = Progress { update: &mut progress, panic: None };
        let hook = sys::tl_progress { update: Some(call_update), user: (&mut held as *mut Progress<'_>).cast() };
        let mut def = settings.def();
        def.host.progress = &hook;
        // SAFETY: slices, hook and def outlive the bake; outputs are valid; tiles are freed, or given to the navmesh.
        unsafe {
            let mut tiles: sys::tl_nav_tiles = std::mem::zeroed();
            let mut report: sys::tl_nav_bake_report = std::mem::zeroed();
            let result = sys::tl_nav_bake(&def, &input, &mut tiles, &mut report);
            if let Some(panic) = held.panic.take() {
                sys::tl_nav_tiles_free(&mut tiles);
                std::panic::resume_unwind(panic);
            }
            Error::check(result, Some(&report.base))?;
            def.host = std::mem::zeroed();
            let navmesh = Navmesh::from_tiles(&mut tiles, def);
            sys::tl_nav_tiles_free(&mut tiles);
            navmesh
        }
    }

    // SAFETY: the tiles are those of a bake. Those that the navmesh took are no longer among them afterwards.
    unsafe fn from_tiles(tiles: &mut sys::tl_nav_tiles, def: sys::tl_nav_def) -> Result<Navmesh, Error> {
        let mut at = null_mut();
        // SAFETY: outputs are valid, and the navmesh is destroyed with `navmesh` whatever happens.
        unsafe {
            Error::check(sys::tl_navmesh_create(null(), &mut at), None)?;
            let navmesh = Navmesh::new(at, def, [tiles.tiles_x, tiles.tiles_z], None);
            let mut report = std::mem::zeroed();
            let result =
                sys::tl_navmesh_add_tiles(at, tiles.tiles, tiles.tile_count, sys::TL_NAV_TILE_OWNED, &mut report);
            Error::check(result, Some(&report))?;
            for i in 0..tiles.tile_count as usize {
                *tiles.tiles.add(i) = null_mut();
            }
            Ok(navmesh)
        }
    }

    // SAFETY: `at` is a navmesh whose tiles lie in `file`.
    pub(crate) unsafe fn in_file(
        at: *mut sys::tl_navmesh,
        def: sys::tl_nav_def,
        grid: [u32; 2],
        file: &Arc<FileBytes>,
    ) -> Navmesh {
        Navmesh::new(at, def, grid, Some(Arc::clone(file)))
    }

    fn new(at: *mut sys::tl_navmesh, def: sys::tl_nav_def, grid: [u32; 2], file: Option<Arc<FileBytes>>) -> Navmesh {
        Navmesh { held: Arc::new(Held { at, def, grid, _file: file }) }
    }

    /// For const functions: it is whole, and does not change.
    pub(crate) fn raw(&self) -> *const sys::tl_navmesh {
        self.held.at
    }

    /// What it was baked with, and how many tiles lie along x and z.
    pub(crate) fn head(&self) -> (&sys::tl_nav_def, [u32; 2]) {
        (&self.held.def, self.held.grid)
    }

    /// The floor's point nearest to `point` in the box of these half extents.
    pub(crate) fn locate(&self, point: Point, extents: Point) -> Result<Option<sys::tl_nav_location>, Error> {
        // SAFETY: the navmesh is whole; a NULL filter passes all; the output is valid.
        unsafe {
            let mut location = std::mem::zeroed();
            match sys::tl_navmesh_find_nearest(self.raw(), null(), vec3(point), vec3(extents), &mut location) {
                sys::TL_NOT_FOUND => Ok(None),
                result => Error::check(result, None).map(|()| Some(location)),
            }
        }
    }

    /// The tiles, in the order of their places.
    pub(crate) fn tiles(&self) -> Vec<*const sys::tl_nav_tile> {
        // SAFETY: the navmesh is whole; slots below the count may be asked for.
        unsafe {
            let mut tiles: Vec<_> = (0..sys::tl_navmesh_slot_count(self.raw()))
                .map(|slot| sys::tl_navmesh_slot_tile(self.raw(), slot))
                .filter(|tile| !tile.is_null())
                .collect();
            tiles.sort_by_key(|&tile| ((*tile).tile_z, (*tile).tile_x, (*tile).layer));
            tiles
        }
    }

    /// How many polygons all tiles have.
    pub fn polygon_count(&self) -> u64 {
        // SAFETY: the tiles are those of this navmesh.
        self.tiles().iter().map(|&tile| u64::from(unsafe { (*tile).polygon_count })).sum()
    }

    /// A search over this navmesh, with memory of its own; make one a thread, and keep it.
    ///
    /// # Errors
    /// [`ErrorKind::Memory`](crate::ErrorKind).
    pub fn query(&self) -> Result<Query, Error> {
        let mut at = null_mut();
        // SAFETY: the def is a plain struct; the outputs are valid.
        unsafe {
            let mut def = sys::tl_default_nav_query_def();
            def.max_nodes = 1 << 30; // memory grows with need: no search is too large
            let mut report = std::mem::zeroed();
            Error::check(sys::tl_nav_query_create(&def, &mut at, &mut report), Some(&report))?;
        }
        Ok(Query { at, navmesh: self.clone(), search_extents: [1.0, 2.0, 1.0] })
    }
}

/// A path, with the proof that none is shorter.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Start, the corners where the path turns, goal.
    pub points: Vec<Point>,
    /// Metres in the plane.
    pub length: f64,
    /// Metres in the plane: no path is shorter than this.
    pub lower_bound: f64,
}

/// The state of searches over a navmesh.
pub struct Query {
    at: *mut sys::tl_nav_query,
    navmesh: Navmesh,
    /// Half extents of the box in which start and goal look for a polygon, metres.
    pub search_extents: Point,
}

// SAFETY: its memory is its own; it may move to another thread, and is not shared (`&mut self`).
unsafe impl Send for Query {}

impl Drop for Query {
    fn drop(&mut self) {
        // SAFETY: made by tl_nav_query_create, destroyed once.
        unsafe { sys::tl_nav_query_destroy(self.at) }
    }
}

impl Query {
    /// The navmesh that is searched.
    pub fn navmesh(&self) -> &Navmesh {
        &self.navmesh
    }

    fn locate(&self, point: Point) -> Result<Option<sys::tl_nav_location>, Error> {
        self.navmesh.locate(point, self.search_extents)
    }

    /// The nearest point of the floor; `None`: there is none within `search_extents`.
    ///
    /// # Errors
    /// [`ErrorKind::NotFinite`](crate::ErrorKind), `Argument`.
    pub fn nearest_point(&self, point: Point) -> Result<Option<Point>, Error> {
        Ok(self.locate(point)?.map(|location| point_of(location.point)))
    }

    /// The shortest path from start to goal; `None`: there is none, which is proven, or no floor near one of them.
    ///
    /// # Errors
    /// [`ErrorKind::GaveUp`](crate::ErrorKind) where the search ran out of memory; `NotFinite`, `Argument`.
    pub fn shortest_path(&mut self, start: Point, goal: Point) -> Result<Option<Path>, Error> {
        let (Some(start), Some(goal)) = (self.locate(start)?, self.locate(goal)?) else {
            return Ok(None);
        };
        let request = sys::tl_nav_path_request { filter: null(), start, goal };
        let mut corners: Vec<sys::tl_nav_corner> = Vec::with_capacity(64);
        loop {
            // SAFETY: the buffer has room for its capacity; so many of its entries are filled as the count says.
            let (result, path) = unsafe {
                let buffers = sys::tl_nav_path_buffers {
                    polygons: null_mut(),
                    polygon_capacity: 0,
                    corners: corners.as_mut_ptr(),
                    corner_capacity: corners.capacity() as u32,
                };
                let mut path: sys::tl_nav_shortest_path = std::mem::zeroed();
                let result =
                    sys::tl_nav_query_find_shortest_path(self.at, self.navmesh.raw(), &request, &buffers, &mut path);
                if result == sys::TL_OK {
                    corners.set_len(path.corner_count as usize);
                }
                (result, path)
            };
            match result {
                sys::TL_INCOMPLETE => corners.reserve(path.corner_count as usize),
                sys::TL_OK if path.status == sys::TL_NAV_PATH_COMPLETE => {
                    return Ok(Some(Path {
                        points: corners.iter().map(|corner| point_of(corner.point)).collect(),
                        length: path.length,
                        lower_bound: path.lower_bound,
                    }));
                }
                sys::TL_OK if path.status == sys::TL_NAV_PATH_OUT_OF_NODES => {
                    return Err(Error::new(sys::TL_ERR_NODES, None))
                }
                sys::TL_OK | sys::TL_NOT_FOUND => return Ok(None),
                _ => return Err(Error::new(result, None)),
            }
        }
    }
}
