// SPDX-License-Identifier: MIT
use std::ffi::c_void;
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::ptr::{null, null_mut};
use std::sync::Arc;

use talus_sys as sys;

use crate::memory::{Blob, FileBytes};
use crate::{Error, Hull, Navmesh, Soup};

/// All that one file holds: what `talus bake` writes, and what it reads.
///
/// ```
/// use talus::{Level, Soup};
///
/// let soup = Soup::bake(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[[0, 1, 2]])?;
/// let bytes = Level { soup: Some(soup), ..Level::default() }.to_bytes()?;
/// let level = Level::from_bytes(&bytes)?;
/// assert!(level.soup.is_some() && level.navmesh.is_none());
/// # Ok::<(), talus::Error>(())
/// ```
#[derive(Default)]
pub struct Level {
    /// Triangles for rays.
    pub soup: Option<Soup>,
    /// The convex hull.
    pub hull: Option<Hull>,
    /// Where agents walk.
    pub navmesh: Option<Navmesh>,
}

const SOUP: u32 = sys::pack_type(b"SOUP");
const HULL: u32 = sys::pack_type(b"HULL");
const NAVM: u32 = sys::pack_type(b"NAVM");
const NAVT: u32 = sys::pack_type(b"NAVT");
const OFFM: u32 = sys::pack_type(b"OFFM");

unsafe extern "C" fn append(bytes: *const c_void, size: usize, user: *mut c_void) -> sys::tl_result {
    // SAFETY: `user` is the vector of the to_bytes that writes, and `bytes` has `size` bytes.
    let (out, bytes) = unsafe { (&mut *user.cast::<Vec<u8>>(), std::slice::from_raw_parts(bytes.cast::<u8>(), size)) };
    match catch_unwind(AssertUnwindSafe(|| out.extend_from_slice(bytes))) {
        Ok(()) => sys::TL_OK,
        Err(_) => sys::TL_ERR_MEMORY,
    }
}

fn item<T>(kind: u32, id: u32, blob: *const T) -> sys::tl_pack_item {
    // SAFETY: every blob begins with its head, which has its size.
    let size = unsafe { (*blob.cast::<sys::tl_blob>()).size };
    sys::tl_pack_item { r#type: kind, id, bytes: blob.cast(), size }
}

type Check = unsafe extern "C" fn(*const c_void, u64, *mut sys::tl_report) -> sys::tl_result;

// A chunk that is there, checked.
fn find(pack: &sys::tl_pack, kind: u32, check: Check) -> Result<Option<*const c_void>, Error> {
    // SAFETY: the pack is open; the check is safe on any bytes.
    unsafe {
        let mut chunk: sys::tl_pack_chunk = std::mem::zeroed();
        let result = sys::tl_pack_find(pack, kind, 0, &mut chunk);
        if result == sys::TL_NOT_FOUND {
            return Ok(None);
        }
        Error::check(result, None)?;
        let mut report = std::mem::zeroed();
        Error::check(check(chunk.bytes, chunk.size, &mut report), Some(&report))?;
        Ok(Some(chunk.bytes))
    }
}

impl Level {
    /// Reads a file's bytes, checking all of them; what it holds is then used in place, in a copy.
    ///
    /// # Errors
    /// [`ErrorKind::Format`](crate::ErrorKind) for bytes that are no such file, or not whole; `Memory`.
    pub fn from_bytes(bytes: &[u8]) -> Result<Level, Error> {
        let file = Arc::new(FileBytes::copy(bytes)?);
        // SAFETY: the copy is aligned and outlives all that is made here by its Arc; every blob is checked first.
        unsafe {
            let mut pack = std::mem::zeroed();
            let mut report = std::mem::zeroed();
            let result = sys::tl_pack_open(file.pointer(), file.len(), &mut pack, &mut report);
            Error::check(result, Some(&report))?;
            let soup = find(&pack, SOUP, sys::tl_soup_check)?.map(|at| Soup { blob: Blob::shared(at.cast(), &file) });
            let hull = find(&pack, HULL, sys::tl_hull_check)?.map(|at| Hull { blob: Blob::shared(at.cast(), &file) });
            let mut navmesh = None;
            if let Some(at) = find(&pack, NAVM, sys::tl_pack_navmesh_check)? {
                let head = at.cast::<sys::tl_pack_navmesh>();
                let mut loaded = null_mut();
                let result = sys::tl_pack_load_navmesh(&pack, null(), &mut loaded, &mut report);
                Error::check(result, Some(&report))?;
                let def = sys::tl_pack_navmesh_def(head);
                navmesh = Some(Navmesh::in_file(loaded, def, [(*head).tiles_x, (*head).tiles_z], &file));
            }
            Ok(Level { soup, hull, navmesh })
        }
    }

    /// The bytes of a file: the same on every machine.
    ///
    /// # Errors
    /// [`ErrorKind::Memory`](crate::ErrorKind).
    pub fn to_bytes(&self) -> Result<Vec<u8>, Error> {
        let mut items = Vec::new();
        items.extend(self.soup.as_ref().map(|soup| item(SOUP, 0, soup.blob.get())));
        items.extend(self.hull.as_ref().map(|hull| item(HULL, 0, hull.blob.get())));
        let mut heads = Vec::new(); // until they were written
        if let Some(navmesh) = &self.navmesh {
            let tiles = navmesh.tiles();
            let mut encoded = null_mut();
            // SAFETY: the def is that of the bake; outputs are valid.
            unsafe {
                let mut report = std::mem::zeroed();
                let (def, [x, z]) = navmesh.head();
                let result =
                    sys::tl_pack_navmesh_encode(def, x, z, tiles.len() as u32, null(), &mut encoded, &mut report);
                Error::check(result, Some(&report))?;
            }
            items.push(item(NAVM, 0, encoded));
            items.extend((0..).zip(&tiles).map(|(id, &tile)| item(NAVT, id, tile)));
            heads.push(Blob::<c_void>::owned(encoded.cast()));
            let links = navmesh.links();
            if !links.is_empty() {
                let mut encoded = null_mut();
                // SAFETY: the links are those of a navmesh; outputs are valid.
                unsafe {
                    let (count, mut report) = (links.len() as u32, std::mem::zeroed());
                    let result = sys::tl_pack_offmesh_encode(links.as_ptr(), count, null(), &mut encoded, &mut report);
                    Error::check(result, Some(&report))?;
                }
                items.push(item(OFFM, 0, encoded));
                heads.push(Blob::owned(encoded.cast()));
            }
        }
        // SAFETY: the items' blobs are held by self and `heads`; the vector outlives the call.
        unsafe {
            let mut out: Vec<u8> = Vec::with_capacity(sys::tl_pack_size(items.as_ptr(), items.len() as u32) as usize);
            let mut report = std::mem::zeroed();
            let user = (&mut out as *mut Vec<u8>).cast();
            let result =
                sys::tl_pack_write(items.as_ptr(), items.len() as u32, null(), Some(append), user, &mut report);
            drop(heads);
            Error::check(result, Some(&report))?;
            Ok(out)
        }
    }
}
