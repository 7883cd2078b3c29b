// SPDX-License-Identifier: MIT
//! Who owns a blob: itself, from a bake, or a file's bytes, from which it is used in place.

use std::alloc::{alloc, dealloc, handle_alloc_error, Layout};
use std::ffi::c_void;
use std::sync::Arc;

use talus_sys as sys;

use crate::Error;

/// A file's bytes, aligned as blobs want it. Never written once it is shared.
pub(crate) struct FileBytes {
    bytes: *mut u8,
    size: usize,
}

// SAFETY: nothing but plain memory, read only after `copy`.
unsafe impl Send for FileBytes {}
unsafe impl Sync for FileBytes {}

impl FileBytes {
    fn layout(size: usize) -> Layout {
        Layout::from_size_align(size.max(1), sys::TL_BLOB_ALIGNMENT).expect("a slice is smaller than the address space")
    }

    /// A copy in the machine's byte order.
    pub(crate) fn copy(bytes: &[u8]) -> Result<FileBytes, Error> {
        let layout = FileBytes::layout(bytes.len());
        // SAFETY: the size is not 0; the copy is as long as the slice; the C function changes bytes of the copy only.
        unsafe {
            let at = alloc(layout);
            if at.is_null() {
                handle_alloc_error(layout);
            }
            std::ptr::copy_nonoverlapping(bytes.as_ptr(), at, bytes.len());
            let held = FileBytes { bytes: at, size: bytes.len() };
            let mut report = std::mem::zeroed();
            let result = sys::tl_pack_to_host_order(at.cast(), bytes.len() as u64, &mut report);
            Error::check(result, Some(&report))?;
            Ok(held)
        }
    }

    pub(crate) fn pointer(&self) -> *const c_void {
        self.bytes.cast()
    }

    pub(crate) fn len(&self) -> u64 {
        self.size as u64
    }
}

impl Drop for FileBytes {
    fn drop(&mut self) {
        // SAFETY: allocated by `copy` with the same layout.
        unsafe { dealloc(self.bytes, FileBytes::layout(self.size)) }
    }
}

/// A blob of type T, checked or fresh from its bake.
pub(crate) struct Blob<T> {
    at: *const T,
    file: Option<Arc<FileBytes>>,
}

// SAFETY: blobs do not change, and queries on them are const; they may run on any number of threads.
unsafe impl<T> Send for Blob<T> {}
unsafe impl<T> Sync for Blob<T> {}

impl<T> Blob<T> {
    /// Takes over what a bake gave.
    pub(crate) fn owned(at: *mut T) -> Blob<T> {
        Blob { at, file: None }
    }

    /// A blob within a file, which stays as long as it.
    pub(crate) fn shared(at: *const T, file: &Arc<FileBytes>) -> Blob<T> {
        Blob { at, file: Some(Arc::clone(file)) }
    }

    pub(crate) fn get(&self) -> *const T {
        self.at
    }
}

impl<T> Drop for Blob<T> {
    fn drop(&mut self) {
        if self.file.is_none() {
            // SAFETY: a bake's blob, freed once.
            unsafe { sys::tl_blob_free(self.at.cast_mut().cast()) }
        }
    }
}
