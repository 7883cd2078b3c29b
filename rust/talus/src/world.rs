// SPDX-License-Identifier: MIT
use std::ffi::c_void;
use std::fs::File;
use std::io;
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::path::Path;
use std::ptr::{null, null_mut};
use std::sync::{Arc, Mutex, PoisonError};

use talus_sys as sys;

use crate::{Error, Point, WorldPoint};

/// How much of a world may be in memory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorldSettings {
    /// Bytes that tiles and their navmesh may take together, 65,536 or more.
    pub budget: u64,
    /// Metres, > 0: tiles are in metres from a local origin, which follows an interest that is farther away.
    pub frame_reach: f64,
}

impl Default for WorldSettings {
    fn default() -> WorldSettings {
        // SAFETY: gives a plain struct.
        let def = unsafe { sys::tl_default_nav_world_def() };
        WorldSettings { budget: def.budget, frame_reach: def.frame_reach }
    }
}

/// A point around which tiles are wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interest {
    /// Metres.
    pub point: WorldPoint,
    /// Metres in the plane, >= 0: tiles that come nearer than this are wanted, the nearest first.
    pub radius: f64,
}

/// Which tiles are in memory, and what they take. A place is a square of the grid, with the tiles of its layers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WorldState {
    /// Places of the file that have tiles.
    pub places: u32,
    /// In memory, as queries see them.
    pub loaded: u32,
    /// Begun; a load that was dropped is counted until the next update.
    pub loading: u32,
    /// Read; the next update takes them in.
    pub ready: u32,
    /// Wanted, neither loaded nor on their way: what the budget has no room for, too.
    pub missing: u32,
    /// Wanted, and could not be loaded.
    pub failed: u32,
    /// Local frames so far: 1 at the first update.
    pub frames: u32,
    /// Of the budget, now.
    pub bytes: u64,
    /// The most so far.
    pub peak_bytes: u64,
    /// Of the file's index, which the budget does not count.
    pub index_bytes: u64,
    /// Read of the file for tiles, so far.
    pub read_bytes: u64,
}

type Read = Box<dyn Fn(u64, &mut [u8]) -> io::Result<()> + Send + Sync>;

/// What a world, its loads and its routers share.
pub(crate) struct HeldWorld {
    pub(crate) at: *mut sys::tl_nav_world,
    ended: Mutex<Vec<sys::tl_nav_world_load>>, // loads that were dropped, to be handed back by the world
    _read: Box<Read>,
}

// SAFETY: const functions and loads may run on any threads, `Read` too; what changes the world takes a `&mut World`.
unsafe impl Send for HeldWorld {}
unsafe impl Sync for HeldWorld {}

impl Drop for HeldWorld {
    fn drop(&mut self) {
        // SAFETY: made by tl_nav_world_create, destroyed once. No load runs: each has a handle of this.
        unsafe { sys::tl_nav_world_destroy(self.at) }
    }
}

// Unwinding through C is undefined: a callback that panics has failed.
unsafe extern "C" fn call_read(offset: u64, bytes: *mut c_void, size: usize, user: *mut c_void) -> sys::tl_result {
    // SAFETY: `user` is the Read of the world that reads; `bytes` has room for `size`, and is cleared first.
    let (read, bytes) = unsafe {
        std::ptr::write_bytes(bytes.cast::<u8>(), 0, size);
        (&*user.cast::<Read>(), std::slice::from_raw_parts_mut(bytes.cast::<u8>(), size))
    };
    match catch_unwind(AssertUnwindSafe(|| read(offset, bytes))) {
        Ok(Ok(())) => sys::TL_OK,
        Ok(Err(error)) if error.kind() == io::ErrorKind::UnexpectedEof => sys::TL_ERR_TRUNCATED,
        _ => sys::TL_ERR_IO,
    }
}

#[cfg(unix)]
fn read_at(file: &File, offset: u64, bytes: &mut [u8]) -> io::Result<()> {
    std::os::unix::fs::FileExt::read_exact_at(file, bytes, offset)
}

#[cfg(windows)]
fn read_at(file: &File, mut offset: u64, mut bytes: &mut [u8]) -> io::Result<()> {
    while !bytes.is_empty() {
        match std::os::windows::fs::FileExt::seek_read(file, bytes, offset) {
            Ok(0) => return Err(io::ErrorKind::UnexpectedEof.into()),
            Ok(count) => (offset, bytes) = (offset + count as u64, &mut bytes[count..]),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(())
}

/// A world that is larger than memory: the navmesh tiles of a baked file come and go around points of interest.
///
/// Coordinates are double and the level's own, however far from its origin. An answer that depends on a tile that is not
/// in memory says so, and is never "nothing there". Queries take a `&World` and may run on any number of threads; what
/// exchanges tiles takes a `&mut World`, for a moment. Tiles are read by [`WorldLoad`]s, on any thread meanwhile.
///
/// ```no_run
/// use talus::{Interest, World, WorldSettings, WorldStatus};
///
/// let mut world = World::open("land.talus", &WorldSettings::default())?;
/// let mut query = world.query()?;
/// let player = [5_000_000.0, 12.0, 4_000.0];
/// world.stream(&[Interest { point: player, radius: 150.0 }])?; // waits for all tiles; a game does what is below
/// let path = world.shortest_path(&mut query, player, [5_000_080.0, 12.0, 4_020.0])?;
/// assert!(path.status != WorldStatus::Complete || path.proven || path.length > path.lower_bound);
///
/// // In a game, each frame: one tile in, one out, and reads on other threads.
/// world.update(&[Interest { point: player, radius: 150.0 }], 1)?;
/// while let Some(load) = world.begin_load()? {
///     std::thread::spawn(move || load.run());
/// }
/// # Ok::<(), talus::Error>(())
/// ```
pub struct World {
    pub(crate) held: Arc<HeldWorld>,
    /// Half extents of the box in which points look for a polygon, metres.
    pub search_extents: Point,
}

impl World {
    /// Opens a file that `talus world merge` wrote, or [`Level::to_bytes`](crate::Level::to_bytes) with a tiled navmesh.
    /// No tile is loaded yet. The file must not change while it is open.
    ///
    /// # Errors
    /// [`ErrorKind::Io`](crate::ErrorKind): it cannot be opened or read; else as of [`World::new`].
    pub fn open(path: impl AsRef<Path>, settings: &WorldSettings) -> Result<World, Error> {
        let file = File::open(path).map_err(|_| Error::new(sys::TL_ERR_IO, None))?;
        World::new(move |offset, bytes| read_at(&file, offset, bytes), settings)
    }

    /// The same over bytes that `read` fills from an offset on: an archive, a network, memory. It is called by loads, on
    /// their threads. Where it fails or panics, what is under way fails.
    ///
    /// # Errors
    /// [`ErrorKind::Argument`](crate::ErrorKind) names a setting; `Format`, `Io`, `Memory`; `Unsupported`: it holds
    /// links, which need all tiles at once; `Empty`: it holds no navmesh.
    pub fn new(
        read: impl Fn(u64, &mut [u8]) -> io::Result<()> + Send + Sync + 'static,
        settings: &WorldSettings,
    ) -> Result<World, Error> {
        let read: Box<Read> = Box::new(Box::new(read));
        let mut at = null_mut();
        // SAFETY: the def is a plain struct; `read` has its place until the world is destroyed; outputs are valid.
        unsafe {
            let mut def = sys::tl_default_nav_world_def();
            def.read = Some(call_read);
            def.user = std::ptr::from_ref::<Read>(&read).cast_mut().cast();
            def.budget = settings.budget;
            def.frame_reach = settings.frame_reach;
            let mut report = std::mem::zeroed();
            match sys::tl_nav_world_create(&def, &mut at, &mut report) {
                sys::TL_NOT_FOUND => return Err(Error::new(sys::TL_ERR_EMPTY, Some(&report))),
                result => Error::check(result, Some(&report))?,
            }
        }
        let held = HeldWorld { at, ended: Mutex::default(), _read: read };
        Ok(World { held: Arc::new(held), search_extents: [2.0, 4.0, 2.0] })
    }

    /// Loads all tiles that are wanted and fit the budget, the nearest first, here and now.
    ///
    /// # Errors
    /// As of [`World::update`] and [`WorldLoad::run`]; calling it again goes on with the others.
    pub fn stream(&mut self, interests: &[Interest]) -> Result<WorldState, Error> {
        loop {
            let mut changed = self.update(interests, u32::MAX)?;
            while let Some(load) = self.begin_load()? {
                load.run()?;
                changed = true;
            }
            if !changed {
                return Ok(self.state());
            }
        }
    }

    /// Says where tiles are wanted, takes in tiles that were read, and takes out the farthest where the budget needs
    /// room: at most `max_changes` of either. Returns whether a tile came or went. A game gives 1 or 2 for each frame,
    /// some 100 us each. Tiles that nobody wants stay until their room is needed.
    ///
    /// # Errors
    /// [`ErrorKind::NotFinite`](crate::ErrorKind), `Argument`: an interest; then nothing is changed. `Memory`.
    pub fn update(&mut self, interests: &[Interest], max_changes: u32) -> Result<bool, Error> {
        self.take_back();
        let rows: Vec<_> = interests
            .iter()
            .map(|interest| sys::tl_nav_world_interest { point: interest.point, radius: interest.radius })
            .collect();
        let count = u32::try_from(rows.len()).map_err(|_| Error::too_many("interests"))?;
        // SAFETY: the world is whole, and this has it alone.
        match unsafe { sys::tl_nav_world_update(self.held.at, rows.as_ptr(), count, max_changes) } {
            sys::TL_NOT_FOUND => Ok(false),
            result => Error::check(result, None).map(|()| true),
        }
    }

    /// The next place to be loaded, the nearest that is wanted and fits the budget; `None`: there is none now.
    ///
    /// # Errors
    /// [`ErrorKind::Memory`](crate::ErrorKind).
    pub fn begin_load(&mut self) -> Result<Option<WorldLoad>, Error> {
        self.take_back();
        // SAFETY: the world is whole, and this has it alone; the output is valid.
        unsafe {
            let mut load = std::mem::zeroed();
            match sys::tl_nav_world_begin_load(self.held.at, &mut load) {
                sys::TL_NOT_FOUND => Ok(None),
                result => {
                    Error::check(result, None)?;
                    Ok(Some(WorldLoad { load, world: Arc::clone(&self.held) }))
                }
            }
        }
    }

    // Loads that have ended go back.
    fn take_back(&mut self) {
        let ended = std::mem::take(&mut *self.held.ended.lock().unwrap_or_else(PoisonError::into_inner));
        for mut load in ended {
            // SAFETY: the world is whole, this has it alone, and the load is one of its own.
            unsafe { sys::tl_nav_world_end_load(&mut load) };
        }
    }

    /// Which tiles are in memory, and what they take.
    pub fn state(&self) -> WorldState {
        // SAFETY: the world is whole, the output valid.
        unsafe {
            let mut state: sys::tl_nav_world_state = std::mem::zeroed();
            sys::tl_nav_world_get_state(self.held.at, &mut state);
            WorldState {
                places: state.places,
                loaded: state.loaded,
                loading: state.loading,
                ready: state.ready,
                missing: state.missing,
                failed: state.failed,
                frames: state.frames,
                bytes: state.bytes,
                peak_bytes: state.peak_bytes,
                index_bytes: state.index_bytes,
                read_bytes: state.read_bytes,
            }
        }
    }
}

/// The tiles of one place, to be read on any thread. One that is dropped is wanted still.
pub struct WorldLoad {
    load: sys::tl_nav_world_load,
    world: Arc<HeldWorld>,
}

// SAFETY: a load runs on one thread at a time, whichever, beside all that its world does.
unsafe impl Send for WorldLoad {}

impl WorldLoad {
    /// Its place in the file's grid.
    pub fn place(&self) -> [i32; 2] {
        [self.load.tile_x, self.load.tile_z]
    }

    /// Reads the tiles and checks them. The world's next update takes them in.
    ///
    /// # Errors
    /// [`ErrorKind::Io`](crate::ErrorKind), `Format`; the place is tried again when the interests move.
    pub fn run(mut self) -> Result<(), Error> {
        // SAFETY: the load was begun, is run once, and its world stays.
        let result = unsafe { sys::tl_nav_world_run_load(&mut self.load) };
        let report = sys::tl_report {
            stage: null(),
            field: null(),
            element: null(),
            element_index: sys::TL_NO_ELEMENT,
            advice: self.load.advice,
            peak_bytes: 0,
        };
        Error::check(result, Some(&report))
    }
}

impl Drop for WorldLoad {
    fn drop(&mut self) {
        self.world.ended.lock().unwrap_or_else(PoisonError::into_inner).push(self.load);
    }
}
