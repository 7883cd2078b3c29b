// SPDX-License-Identifier: MIT
use std::ffi::{c_char, c_void, CStr};
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::ptr::{null, null_mut};
use std::sync::Arc;

use talus_sys as sys;

use crate::memory::FileBytes;
use crate::point::{point_of, vec3};
use crate::soup::view;
use crate::versions::HeldVersions;
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
    /// For a bake of a mesh, whose bounds are in it: a file keeps them, and what is baked later too.
    pub(crate) fn def(&self, vertices: &[Point], triangles: &[[u32; 3]]) -> sys::tl_nav_def {
        // SAFETY: gives a plain struct.
        let mut def = unsafe { sys::tl_default_nav_def() };
        def.bounds = bounds(vertices, triangles);
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

// Of the vertices that triangles use, as a bake finds them. What is not finite or too large is the bake's to refuse.
fn bounds(vertices: &[Point], triangles: &[[u32; 3]]) -> sys::tl_aabb {
    // SAFETY: gives a plain struct.
    let empty = unsafe { sys::tl_default_nav_def() }.bounds;
    let used = triangles.iter().flatten().filter_map(|&index| vertices.get(index as usize));
    let (mut min, mut max) = (point_of(empty.min), point_of(empty.max));
    for vertex in used.filter(|vertex| vertex.iter().all(|coordinate| coordinate.is_finite())) {
        for axis in 0..3 {
            min[axis] = min[axis].min(vertex[axis]);
            max[axis] = max[axis].max(vertex[axis]);
        }
    }
    sys::tl_aabb { min: vec3(min), max: vec3(max) }
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
    owner: Owner,
}

/// Who ends a navmesh.
enum Owner {
    Itself,
    /// Itself; its tiles lie in the file.
    InFile(#[allow(dead_code)] Arc<FileBytes>),
    /// The versions that it is one of.
    Versions(Arc<HeldVersions>),
}

// SAFETY: nothing here changes a navmesh after it was made, and its const functions may run on any number of threads.
unsafe impl Send for Held {}
unsafe impl Sync for Held {}

impl Drop for Held {
    fn drop(&mut self) {
        match &self.owner {
            Owner::Versions(versions) => versions.release(self.at),
            // SAFETY: made by tl_navmesh_create or tl_pack_load_navmesh, destroyed once.
            Owner::Itself | Owner::InFile(_) => unsafe { sys::tl_navmesh_destroy(self.at) },
        }
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
        let mut def = settings.def(vertices, triangles);
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

    /// A new navmesh, filled by a function that has it alone.
    pub(crate) fn filled(
        def: sys::tl_nav_def,
        grid: [u32; 2],
        fill: impl FnOnce(*mut sys::tl_navmesh) -> Result<(), Error>,
    ) -> Result<Navmesh, Error> {
        let mut at = null_mut();
        // SAFETY: a NULL allocator means the default one; the output is valid.
        Error::check(unsafe { sys::tl_navmesh_create(null(), &mut at) }, None)?;
        let navmesh = Navmesh::new(at, def, grid, Owner::Itself); // it is destroyed whatever happens
        fill(at)?;
        Ok(navmesh)
    }

    // SAFETY: the tiles are those of a bake. Those that the navmesh took are no longer among them afterwards.
    unsafe fn from_tiles(tiles: &mut sys::tl_nav_tiles, def: sys::tl_nav_def) -> Result<Navmesh, Error> {
        let (count, owned) = (tiles.tile_count, sys::TL_NAV_TILE_OWNED);
        // SAFETY: the navmesh is whole; so many tiles are there.
        Navmesh::filled(def, [tiles.tiles_x, tiles.tiles_z], |at| unsafe {
            let mut report = std::mem::zeroed();
            Error::check(sys::tl_navmesh_add_tiles(at, tiles.tiles, count, owned, &mut report), Some(&report))?;
            for i in 0..count as usize {
                *tiles.tiles.add(i) = null_mut();
            }
            Ok(())
        })
    }

    // SAFETY: `at` is a navmesh whose tiles lie in `file`.
    pub(crate) unsafe fn in_file(
        at: *mut sys::tl_navmesh,
        def: sys::tl_nav_def,
        grid: [u32; 2],
        file: &Arc<FileBytes>,
    ) -> Navmesh {
        Navmesh::new(at, def, grid, Owner::InFile(Arc::clone(file)))
    }

    // SAFETY: `at` is a version that was acquired from `versions`, and is released with the navmesh.
    pub(crate) unsafe fn in_versions(
        at: *const sys::tl_navmesh,
        source: &Navmesh,
        versions: &Arc<HeldVersions>,
    ) -> Navmesh {
        Navmesh::new(at.cast_mut(), source.held.def, source.held.grid, Owner::Versions(Arc::clone(versions)))
    }

    fn new(at: *mut sys::tl_navmesh, def: sys::tl_nav_def, grid: [u32; 2], owner: Owner) -> Navmesh {
        Navmesh { held: Arc::new(Held { at, def, grid, owner }) }
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

    /// The off-mesh links.
    pub(crate) fn links(&self) -> Vec<sys::tl_nav_offmesh> {
        let (mut cursor, mut link) = (0, 0);
        let mut links = Vec::new();
        // SAFETY: the navmesh is whole, and does not change; a link that is iterated over is there.
        unsafe {
            while sys::tl_navmesh_next_offmesh(self.raw(), &mut cursor, &mut link) {
                let mut state: sys::tl_nav_offmesh_state = std::mem::zeroed();
                sys::tl_navmesh_offmesh_state(self.raw(), link, &mut state);
                links.push(state.offmesh);
            }
        }
        links
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
        Ok(Query { search: Search::new()?, navmesh: self.clone(), search_extents: [1.0, 2.0, 1.0] })
    }
}

/// The memory of searches, over any navmesh.
pub(crate) struct Search {
    at: *mut sys::tl_nav_query,
}

// SAFETY: its memory is its own; it may move to another thread, and is not shared (`&mut self`).
unsafe impl Send for Search {}

impl Drop for Search {
    fn drop(&mut self) {
        // SAFETY: made by tl_nav_query_create, destroyed once.
        unsafe { sys::tl_nav_query_destroy(self.at) }
    }
}

impl Search {
    pub(crate) fn new() -> Result<Search, Error> {
        let mut at = null_mut();
        // SAFETY: the def is a plain struct; the outputs are valid.
        unsafe {
            let mut def = sys::tl_default_nav_query_def();
            def.max_nodes = 1 << 30; // memory grows with need: no search is too large
            let mut report = std::mem::zeroed();
            Error::check(sys::tl_nav_query_create(&def, &mut at, &mut report), Some(&report))?;
        }
        Ok(Search { at })
    }

    /// Searches by `find`, again with a larger buffer where the corners do not fit. The result is an outcome.
    pub(crate) fn corners(
        &mut self,
        find: impl Fn(*mut sys::tl_nav_query, &sys::tl_nav_path_buffers, &mut sys::tl_nav_shortest_path) -> sys::tl_result,
    ) -> Result<(sys::tl_result, sys::tl_nav_shortest_path, Vec<sys::tl_nav_corner>), Error> {
        let mut corners: Vec<sys::tl_nav_corner> = Vec::with_capacity(64);
        loop {
            // SAFETY: a plain struct.
            let mut path: sys::tl_nav_shortest_path = unsafe { std::mem::zeroed() };
            let buffers = sys::tl_nav_path_buffers {
                polygons: null_mut(),
                polygon_capacity: 0,
                corners: corners.as_mut_ptr(),
                corner_capacity: corners.capacity() as u32,
            };
            let result = find(self.at, &buffers, &mut path);
            if !matches!(result, sys::TL_OK | sys::TL_NOT_FOUND | sys::TL_INCOMPLETE | sys::TL_NOT_LOADED) {
                return Err(Error::new(result, None));
            }
            if path.corner_count as usize <= corners.capacity() {
                // SAFETY: so many were written.
                unsafe { corners.set_len(path.corner_count as usize) };
                return Ok((result, path, corners));
            }
            corners.reserve(path.corner_count as usize);
        }
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
    search: Search,
    navmesh: Navmesh,
    /// Half extents of the box in which start and goal look for a polygon, metres.
    pub search_extents: Point,
}

impl Query {
    /// The navmesh that is searched.
    pub fn navmesh(&self) -> &Navmesh {
        &self.navmesh
    }

    /// Goes on to another navmesh, such as a newer version ([`NavVersions`](crate::NavVersions)), with the same memory.
    pub fn set_navmesh(&mut self, navmesh: Navmesh) {
        self.navmesh = navmesh;
    }

    pub(crate) fn locate(&self, point: Point) -> Result<Option<sys::tl_nav_location>, Error> {
        self.navmesh.locate(point, self.search_extents)
    }

    /// What the C interface's searches take: both are whole for as long as the query is.
    pub(crate) fn parts(&mut self) -> (*mut sys::tl_nav_query, *const sys::tl_navmesh) {
        (self.search.at, self.navmesh.raw())
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
        let navmesh = self.navmesh.raw();
        let (_, path, corners) = self.search.corners(|query, buffers, path| {
            // SAFETY: query, navmesh and buffers are whole, and the output is valid.
            unsafe { sys::tl_nav_query_find_shortest_path(query, navmesh, &request, buffers, path) }
        })?;
        match path.status {
            sys::TL_NAV_PATH_COMPLETE => Ok(Some(Path {
                points: corners.iter().map(|corner| point_of(corner.point)).collect(),
                length: path.length,
                lower_bound: path.lower_bound,
            })),
            sys::TL_NAV_PATH_OUT_OF_NODES => Err(Error::new(sys::TL_ERR_NODES, None)),
            _ => Ok(None),
        }
    }
}
