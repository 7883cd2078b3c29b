// SPDX-License-Identifier: MIT
use std::ptr::null_mut;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use talus_sys as sys;

use crate::point::vec3;
use crate::{Error, Navmesh, Point};

/// An off-mesh link: a connection that crosses no polygon. A jump, a drop, a ladder, a door, a lift.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// Metres: the agent's feet where it is taken.
    pub start: Point,
    /// Metres: and where it lands.
    pub end: Point,
    /// Metres: the nearest polygon within this is what an end is anchored to.
    pub radius: f32,
    /// > 0: times its length, a part of what it costs.
    pub cost_factor: f32,
    /// Metres, >= 0: the other part.
    pub fixed_cost: f32,
    /// Whether it can be taken from its end to its start too.
    pub both_ways: bool,
}

impl Link {
    /// A link from start to end, one way, which costs its length.
    pub fn new(start: Point, end: Point) -> Link {
        // SAFETY: gives a plain struct.
        let link = unsafe { sys::tl_default_nav_offmesh() };
        Link {
            start,
            end,
            radius: link.radius,
            cost_factor: link.cost_factor,
            fixed_cost: link.fixed_cost,
            both_ways: link.both_ways,
        }
    }
}

/// The name of a link in the versions of a navmesh. It is not used again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct LinkId(sys::tl_nav_ref);

/// What there is of versions, and memory that waits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NavVersionsState {
    /// The newest, and older ones that are held.
    pub version_count: u32,
    /// The newest one's number, which each edit raises by 1.
    pub newest: u64,
    /// Number of the oldest that is held.
    pub oldest: u64,
    /// Of what older versions alone have: freed once nobody holds them.
    pub waiting_bytes: u64,
}

/// What versions and their navmeshes share.
pub(crate) struct HeldVersions {
    at: *mut sys::tl_nav_versions,
    source: Navmesh, // the first version's tiles lie in it
}

// SAFETY: acquiring and releasing may run on any threads; the writer's functions run under the lock of `NavVersions`.
unsafe impl Send for HeldVersions {}
unsafe impl Sync for HeldVersions {}

impl HeldVersions {
    pub(crate) fn release(&self, version: *const sys::tl_navmesh) {
        // SAFETY: the version was acquired, and is released once.
        unsafe { sys::tl_nav_versions_release(self.at, version) }
    }
}

impl Drop for HeldVersions {
    fn drop(&mut self) {
        // SAFETY: made by tl_nav_versions_create, destroyed once; whoever has a version has a handle of this.
        unsafe { sys::tl_nav_versions_destroy(self.at) }
    }
}

/// A navmesh in versions: any number of threads read it while one changes it.
///
/// [`NavVersions::acquire`] gives the newest version, a [`Navmesh`] like any other, which never changes and is given
/// back when its last handle is dropped. It never waits. [`NavVersions::edit`] gives the draft of the next one. Versions
/// share all that an edit leaves alone, so an edit costs about what it costs on a navmesh that is alone.
///
/// ```
/// use talus::{Link, NavVersions, Navmesh, NavmeshSettings};
///
/// // Two floors, 4 m apart.
/// let mut vertices = Vec::new();
/// for x in [0.0, 14.0] {
///     vertices.extend([[x, 0.0, 0.0], [x, 0.0, 10.0], [x + 10.0, 0.0, 10.0], [x + 10.0, 0.0, 0.0]]);
/// }
/// let triangles = [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]];
/// let versions = NavVersions::new(&Navmesh::bake(&vertices, &triangles, &NavmeshSettings::default())?)?;
///
/// let old = versions.acquire();
/// let mut draft = versions.edit()?;
/// draft.add_link(&Link::new([9.0, 0.0, 5.0], [15.0, 0.0, 5.0]))?;
/// let new = draft.publish();
///
/// let (start, goal) = ([2.0, 0.0, 5.0], [20.0, 0.0, 5.0]);
/// assert!(old.query()?.shortest_path(start, goal)?.is_none()); // who holds it sees nothing of the edit
/// assert!(new.query()?.shortest_path(start, goal)?.is_some());
/// # Ok::<(), talus::Error>(())
/// ```
pub struct NavVersions {
    held: Arc<HeldVersions>,
    writer: Mutex<()>,
}

// Tiles and off-mesh links of a navmesh, for the first version. SAFETY: the tiles of `from` outlive `to`.
unsafe fn copy(from: &Navmesh, to: *mut sys::tl_navmesh) -> Result<(), Error> {
    let tiles: Vec<*mut sys::tl_nav_tile> = from.tiles().iter().map(|tile| tile.cast_mut()).collect();
    // SAFETY: borrowed tiles are not written; outputs are valid.
    unsafe {
        let mut report = std::mem::zeroed();
        let (count, borrowed) = (tiles.len() as u32, sys::TL_NAV_TILE_BORROWED);
        Error::check(sys::tl_navmesh_add_tiles(to, tiles.as_ptr(), count, borrowed, &mut report), Some(&report))?;
    }
    from.links().iter().try_for_each(|link| add_link(to, link).map(|_| ()))
}

fn add_link(to: *mut sys::tl_navmesh, link: &sys::tl_nav_offmesh) -> Result<LinkId, Error> {
    let mut added = 0;
    // SAFETY: the callers' navmesh is a draft; outputs are valid.
    unsafe {
        let mut report = std::mem::zeroed();
        Error::check(sys::tl_navmesh_add_offmesh(to, link, &mut added, &mut report), Some(&report))?;
    }
    Ok(LinkId(added))
}

impl NavVersions {
    /// The first version has the navmesh's tiles, which it shares, and its links.
    ///
    /// # Errors
    /// [`ErrorKind::Memory`](crate::ErrorKind).
    pub fn new(navmesh: &Navmesh) -> Result<NavVersions, Error> {
        let mut at = null_mut();
        // SAFETY: a NULL allocator means the default one; the output is valid.
        Error::check(unsafe { sys::tl_nav_versions_create(std::ptr::null(), &mut at) }, None)?;
        let held = Arc::new(HeldVersions { at, source: navmesh.clone() });
        let versions = NavVersions { held, writer: Mutex::new(()) };
        let draft = versions.edit()?;
        // SAFETY: the versions have a handle of the navmesh, so its tiles stay.
        unsafe { copy(navmesh, draft.at)? };
        draft.publish();
        Ok(versions)
    }

    /// The newest version. Any thread; it never waits. Whoever has it keeps it, whatever is published meanwhile.
    pub fn acquire(&self) -> Navmesh {
        // SAFETY: the versions are whole; the handle releases what was acquired.
        unsafe {
            let version = sys::tl_nav_versions_acquire(self.held.at);
            Navmesh::in_versions(version, &self.held.source, &self.held)
        }
    }

    /// The draft of the next version: what the newest one has, or what a draft that was dropped has. Another thread's
    /// edit waits until this one is published or dropped.
    ///
    /// # Errors
    /// [`ErrorKind::Limit`](crate::ErrorKind): readers hold 1,024 versions; `Memory`. A later call may succeed.
    pub fn edit(&self) -> Result<Draft<'_>, Error> {
        let writer = self.lock();
        let mut at = null_mut();
        // SAFETY: under the writer's lock; the output is valid.
        Error::check(unsafe { sys::tl_nav_versions_edit(self.held.at, &mut at) }, None)?;
        Ok(Draft { at, versions: self, _writer: writer })
    }

    /// What there is, after what nobody holds any more was freed. Waits for an edit that is under way.
    pub fn state(&self) -> NavVersionsState {
        let _writer = self.lock();
        // SAFETY: under the writer's lock; the output is valid.
        unsafe {
            let mut state: sys::tl_nav_versions_state = std::mem::zeroed();
            let result = sys::tl_nav_versions_reclaim(self.held.at, &mut state);
            assert_eq!(result, sys::TL_OK, "the versions are whole");
            NavVersionsState {
                version_count: state.version_count,
                newest: state.newest,
                oldest: state.oldest,
                waiting_bytes: state.waiting_bytes,
            }
        }
    }

    // A draft is whole wherever a panic left it.
    fn lock(&self) -> MutexGuard<'_, ()> {
        self.writer.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The next version of a navmesh, to be changed. Nobody sees it before it is published; a draft that is dropped stays as
/// it is, and the next [`NavVersions::edit`] goes on with it.
pub struct Draft<'a> {
    at: *mut sys::tl_navmesh,
    versions: &'a NavVersions,
    _writer: MutexGuard<'a, ()>,
}

impl Draft<'_> {
    /// For functions that change a navmesh.
    pub(crate) fn raw(&mut self) -> *mut sys::tl_navmesh {
        self.at
    }

    /// Adds a link. One of which an end has no polygon near it is kept, and no path uses it until there is one.
    ///
    /// # Errors
    /// [`ErrorKind::NotFinite`](crate::ErrorKind) and `Argument` name a field; `Limit`: 2^24 links; `Memory`.
    pub fn add_link(&mut self, link: &Link) -> Result<LinkId, Error> {
        // SAFETY: gives a plain struct.
        let mut raw = unsafe { sys::tl_default_nav_offmesh() };
        raw.start = vec3(link.start);
        raw.end = vec3(link.end);
        raw.radius = link.radius;
        raw.cost_factor = link.cost_factor;
        raw.fixed_cost = link.fixed_cost;
        raw.both_ways = link.both_ways;
        add_link(self.at, &raw)
    }

    /// Removes a link.
    ///
    /// # Errors
    /// [`ErrorKind::Stale`](crate::ErrorKind): there is no such link.
    pub fn remove_link(&mut self, link: LinkId) -> Result<(), Error> {
        // SAFETY: the draft is whole, and this has it alone.
        Error::check(unsafe { sys::tl_navmesh_remove_offmesh(self.at, link.0) }, None)
    }

    /// Makes the draft the newest version, which is returned: who acquires from now on gets it.
    pub fn publish(self) -> Navmesh {
        // SAFETY: under the writer's lock.
        let result = unsafe { sys::tl_nav_versions_publish(self.versions.held.at) };
        assert_eq!(result, sys::TL_OK, "the versions are whole");
        self.versions.acquire()
    }
}
