// SPDX-License-Identifier: MIT
//! Loops of the library on threads of the standard library.

use std::ffi::c_void;
use std::sync::atomic::{AtomicU32, Ordering};

use talus_sys as sys;

/// What C calls a loop's items with, handed to threads as it is.
#[derive(Clone, Copy)]
struct Loop {
    task: unsafe extern "C" fn(u32, u32, *mut c_void),
    user: *mut c_void,
    count: u32,
}

// SAFETY: the library promises that items may run on any threads.
unsafe impl Send for Loop {}
unsafe impl Sync for Loop {}

impl Loop {
    fn work(&self, next: &AtomicU32, worker: u32) {
        // Stops below the count plus the number of threads, so the counter does not wrap around.
        loop {
            let item = next.fetch_add(1, Ordering::Relaxed);
            if item >= self.count {
                return;
            }
            // SAFETY: each item runs once, each worker on one thread.
            unsafe { (self.task)(item, worker, self.user) }
        }
    }
}

/// Threads are started for each loop, some 20 us each. Where the system has none left, fewer do the work.
unsafe extern "C" fn run(task: Option<sys::tl_task_fn>, count: u32, task_user: *mut c_void, user: *mut c_void) {
    let Some(task) = task else { return };
    // SAFETY: `user` is the tl_tasks of `tasks`, which outlives the loop.
    let workers = unsafe { (*user.cast::<sys::tl_tasks>()).worker_count };
    let (items, next) = (Loop { task, user: task_user, count }, AtomicU32::new(0));
    std::thread::scope(|scope| {
        for worker in 1..workers.min(count) {
            let (items, next) = (&items, &next);
            if std::thread::Builder::new().spawn_scoped(scope, move || items.work(next, worker)).is_err() {
                break;
            }
        }
        items.work(&next, 0);
    });
}

/// Tasks for a host, on the heap, since they point to themselves; whoever has them given to C keeps them.
pub(crate) struct Tasks {
    at: *mut sys::tl_tasks,
}

impl Tasks {
    pub(crate) fn new(threads: u32) -> Tasks {
        let tasks = sys::tl_tasks { run: Some(run), worker_count: threads.max(1), user: std::ptr::null_mut() };
        let at = Box::into_raw(Box::new(tasks));
        // SAFETY: just made.
        unsafe { (*at).user = at.cast() };
        Tasks { at }
    }

    pub(crate) fn raw(&self) -> *const sys::tl_tasks {
        self.at
    }
}

impl Drop for Tasks {
    fn drop(&mut self) {
        // SAFETY: made by `new`, freed once; C's objects that know it are gone.
        drop(unsafe { Box::from_raw(self.at) });
    }
}
