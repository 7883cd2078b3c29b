// SPDX-License-Identifier: MIT
use talus_sys as sys;

use crate::memory::Blob;
use crate::soup::view;
use crate::tasks::Tasks;
use crate::{Error, Hull, Point};

/// What of space belongs to the body that is decomposed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Solid {
    /// The surface, and all that cannot be reached from outside, whatever the winding.
    #[default]
    Enclosed,
    /// The surface alone: rooms of a level stay open, though their walls enclose them.
    Surface,
}

/// How a mesh is decomposed into convex parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DecomposeSettings {
    /// Metres: the concavity that a part may have. 0: as `relative_tolerance` says.
    pub tolerance: f32,
    /// Share of the longest side of the mesh's box, above 0 and up to 1.
    pub relative_tolerance: f32,
    /// 0: no limit; else parts are merged beyond the tolerance until there are no more.
    pub max_parts: u32,
    /// Of a part's hull, 0: no limit; else 4 or more. The mesh may then reach out of the hulls.
    pub max_vertices: u32,
    /// Metres, at most the tolerance, of the hull of a flat part. 0: a sixteenth of the tolerance.
    pub thickness: f32,
    /// What is solid.
    pub solid: Solid,
    /// 4,096 to 67,108,864 cells of the grid that guides the cuts. Fewer cost more parts, but no truth.
    pub max_cells: u32,
    /// Threads that it runs on, the caller's among them. The same parts with any number.
    pub threads: u32,
}

impl Default for DecomposeSettings {
    fn default() -> DecomposeSettings {
        // SAFETY: gives a plain struct.
        let def = unsafe { sys::tl_default_decompose_def() };
        DecomposeSettings {
            tolerance: def.tolerance,
            relative_tolerance: def.relative_tolerance,
            max_parts: def.max_parts,
            max_vertices: def.max_vertices,
            thickness: def.thickness,
            solid: Solid::Enclosed,
            max_cells: def.max_cells,
            threads: 1,
        }
    }
}

impl DecomposeSettings {
    fn def(&self) -> sys::tl_decompose_def {
        // SAFETY: gives a plain struct.
        let mut def = unsafe { sys::tl_default_decompose_def() };
        def.tolerance = self.tolerance;
        def.relative_tolerance = self.relative_tolerance;
        def.max_parts = self.max_parts;
        def.max_vertices = self.max_vertices;
        def.thickness = self.thickness;
        def.solid = match self.solid {
            Solid::Enclosed => sys::TL_SOLID_ENCLOSED,
            Solid::Surface => sys::TL_SOLID_SURFACE,
        };
        def.max_cells = self.max_cells;
        def
    }
}

/// One convex part of a mesh.
pub struct ConvexPart {
    /// It may reach into those of other parts.
    pub hull: Hull,
    /// Metres: no point of the hull is farther from the body. Proven, not sampled.
    pub concavity: f64,
    /// Metres: no point of the mesh that this part covers is farther outside of its hull.
    pub max_outside: f64,
}

/// Divides a mesh into few convex parts, those of largest volume first, none of which reaches farther from the body than
/// a tolerance. The mesh may be open, intersect itself, or be loose triangles.
///
/// ```
/// use talus::{decompose, DecomposeSettings};
///
/// let vertices = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// let parts = decompose(&vertices, &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]], &DecomposeSettings::default())?;
/// assert_eq!((parts.len(), parts[0].hull.vertex_count()), (1, 4));
/// # Ok::<(), talus::Error>(())
/// ```
///
/// # Errors
/// [`ErrorKind::Argument`](crate::ErrorKind) names a setting, `Index` or `NotFinite` a triangle or vertex; `Degenerate`
/// for no triangle with area; `Range` for a tolerance below the coordinates' rounding; `Limit` for more than 65,536
/// parts; `Memory`.
pub fn decompose(
    vertices: &[Point],
    triangles: &[[u32; 3]],
    settings: &DecomposeSettings,
) -> Result<Vec<ConvexPart>, Error> {
    let view = view(vertices, triangles)?;
    let tasks = Tasks::new(settings.threads);
    let mut def = settings.def();
    def.host.tasks = tasks.raw();
    // SAFETY: the view's slices and the tasks outlive the call; outputs are valid. A hull that is taken is no more the
    // decomposition's, which frees the rest.
    unsafe {
        let mut body: sys::tl_decomposition = std::mem::zeroed();
        let mut report: sys::tl_decompose_report = std::mem::zeroed();
        let result = sys::tl_decomposition_bake(&view, &def, &mut body, &mut report);
        Error::check(result, Some(&report.base))?;
        let parts = std::slice::from_raw_parts_mut(body.parts, body.part_count as usize);
        let taken = parts.iter_mut().map(|part| ConvexPart {
            hull: Hull { blob: Blob::owned(std::mem::replace(&mut part.hull, std::ptr::null_mut())) },
            concavity: part.concavity,
            max_outside: part.max_outside,
        });
        let taken = taken.collect();
        sys::tl_decomposition_free(&mut body);
        Ok(taken)
    }
}
