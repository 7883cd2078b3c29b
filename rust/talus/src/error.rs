// SPDX-License-Identifier: MIT
use std::ffi::{c_char, CStr};
use std::fmt;

use talus_sys as sys;

/// What went wrong; one name for each failure of the C interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ErrorKind {
    /// Memory is out.
    Memory,
    /// A progress callback asked to stop.
    Cancelled,
    /// A setting or argument is wrong: [`Error::field`] names it.
    Argument,
    /// A documented limit would be exceeded.
    Limit,
    /// A reference names nothing any more.
    Stale,
    /// There is nothing to work on, such as no walkable floor.
    Empty,
    /// A coordinate is NaN or infinite: [`Error::element`] says where.
    NotFinite,
    /// A coordinate is out of range.
    Range,
    /// An index is too large.
    Index,
    /// Points do not span a volume, or a triangle has no area.
    Degenerate,
    /// A mesh is not closed, not manifold, or wound the wrong way.
    Topology,
    /// Bytes are no baked file, of another version, cut off or altered.
    Format,
    /// Bytes could not be read or written.
    Io,
    /// It is a kind of data that this function does not take; the advice says which one does.
    Unsupported,
    /// A search ran out of nodes, or an iteration ended before its answer was proven.
    GaveUp,
    /// Any other failure; its text says which.
    Other,
}

/// A failure: its kind, and what the report of the C interface says: stage, field or element, and advice.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    kind: ErrorKind,
    text: &'static str,
    stage: Option<&'static str>,
    field: Option<&'static str>,
    element: Option<(&'static str, Option<u64>)>,
    advice: Option<&'static str>,
}

// The C interface's strings are static.
fn static_text(text: *const c_char) -> Option<&'static str> {
    // SAFETY: a report holds NULL or static strings that end with 0.
    (!text.is_null()).then(|| unsafe { CStr::from_ptr(text) }.to_str().unwrap_or("(no UTF-8)"))
}

impl Error {
    /// The kind, to match on.
    pub fn kind(&self) -> ErrorKind {
        self.kind
    }
    /// The stage of a bake that failed.
    pub fn stage(&self) -> Option<&'static str> {
        self.stage
    }
    /// The setting or argument that is wrong.
    pub fn field(&self) -> Option<&'static str> {
        self.field
    }
    /// What is wrong in the data, such as `("vertex", Some(7))`.
    pub fn element(&self) -> Option<(&'static str, Option<u64>)> {
        self.element
    }
    /// What to do about it.
    pub fn advice(&self) -> Option<&'static str> {
        self.advice
    }

    pub(crate) fn new(result: sys::tl_result, report: Option<&sys::tl_report>) -> Error {
        let kind = match result {
            sys::TL_ERR_MEMORY => ErrorKind::Memory,
            sys::TL_ERR_CANCELLED => ErrorKind::Cancelled,
            sys::TL_ERR_ARGUMENT => ErrorKind::Argument,
            sys::TL_ERR_LIMIT => ErrorKind::Limit,
            sys::TL_ERR_STALE => ErrorKind::Stale,
            sys::TL_ERR_EMPTY => ErrorKind::Empty,
            sys::TL_ERR_NOT_FINITE => ErrorKind::NotFinite,
            sys::TL_ERR_RANGE => ErrorKind::Range,
            sys::TL_ERR_INDEX => ErrorKind::Index,
            sys::TL_ERR_DEGENERATE..=sys::TL_ERR_COPLANAR => ErrorKind::Degenerate,
            sys::TL_ERR_NON_MANIFOLD..=sys::TL_ERR_SELF_INTERSECTION => ErrorKind::Topology,
            sys::TL_ERR_FORMAT..=sys::TL_ERR_CORRUPT => ErrorKind::Format,
            sys::TL_ERR_IO => ErrorKind::Io,
            sys::TL_ERR_UNSUPPORTED => ErrorKind::Unsupported,
            sys::TL_ERR_ITERATIONS | sys::TL_ERR_NODES => ErrorKind::GaveUp,
            _ => ErrorKind::Other,
        };
        // SAFETY: any value is allowed, and the sentence is static.
        let text = static_text(unsafe { sys::tl_result_text(result) }).unwrap_or("unknown failure");
        let report = report.copied();
        Error {
            kind,
            text,
            stage: report.and_then(|r| static_text(r.stage)),
            field: report.and_then(|r| static_text(r.field)),
            element: report.and_then(|r| {
                let index = (r.element_index != sys::TL_NO_ELEMENT).then_some(r.element_index);
                static_text(r.element).map(|name| (name, index))
            }),
            advice: report.and_then(|r| static_text(r.advice)),
        }
    }

    /// An argument that the C interface would not see to be wrong.
    pub(crate) fn argument(field: &'static str) -> Error {
        Error::named(sys::TL_ERR_ARGUMENT, field)
    }

    /// A caller's slice is longer than 32-bit counts reach.
    pub(crate) fn too_many(field: &'static str) -> Error {
        Error::named(sys::TL_ERR_LIMIT, field)
    }

    fn named(result: sys::tl_result, field: &'static str) -> Error {
        Error { field: Some(field), ..Error::new(result, None) }
    }

    pub(crate) fn check(result: sys::tl_result, report: Option<&sys::tl_report>) -> Result<(), Error> {
        if result == sys::TL_OK {
            Ok(())
        } else {
            Err(Error::new(result, report))
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(stage) = self.stage {
            write!(f, "{stage}: ")?;
        }
        match (self.field, self.element) {
            (Some(field), _) => write!(f, "{field}: ")?,
            (None, Some((name, Some(index)))) => write!(f, "{name} {index}: ")?,
            (None, Some((name, None))) => write!(f, "{name}: ")?,
            (None, None) => {}
        }
        f.write_str(self.text)?;
        match self.advice {
            Some(advice) => write!(f, "; {advice}"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for Error {}
