// SPDX-License-Identifier: MIT
//! Declarations of talus's C interface, and the library itself, compiled from source.
//!
//! Every function, struct and constant has the name, and keeps the contract, that the C headers give it. The crate
//! `talus` wraps the common parts so that no `unsafe` is needed.
#![no_std]
#![allow(non_camel_case_types, missing_docs)]

use core::ffi::{c_char, c_int, c_void};

include!("bindings.rs");

/// A report's `element_index` where no element is to blame.
pub const TL_NO_ELEMENT: u64 = u64::MAX;
/// The triangle of a ray in a batch that hits nothing.
pub const TL_NO_TRIANGLE: u32 = u32::MAX;
/// Blobs and baked files begin at multiples of this, bytes.
pub const TL_BLOB_ALIGNMENT: usize = 64;
/// The first so many hits of a character's move are kept.
pub const TL_MAX_CHARACTER_HITS: usize = 8;
/// Bits of a corner's flags: where the path begins and ends, to which side it turns there, and that it takes an off-mesh
/// link from there to the next corner.
pub const TL_NAV_CORNER_START: u32 = 1;
pub const TL_NAV_CORNER_END: u32 = 2;
pub const TL_NAV_CORNER_LEFT: u32 = 4;
pub const TL_NAV_CORNER_RIGHT: u32 = 8;
pub const TL_NAV_CORNER_LINK: u32 = 16;

/// A chunk's type out of its four letters.
pub const fn pack_type(letters: &[u8; 4]) -> u32 {
    u32::from_le_bytes(*letters)
}
