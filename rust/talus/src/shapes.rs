// SPDX-License-Identifier: MIT
use std::marker::PhantomData;
use std::ptr::null_mut;

use talus_sys as sys;

use crate::memory::Blob;
use crate::point::{point_of, vec3};
use crate::{Error, Point};

/// How a hull is baked. The default is the exact hull of all points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HullSettings {
    /// 0: no limit; else 4 or more. The farthest points come first, so those that matter are kept.
    pub max_vertices: u32,
    /// Metres: points may lie this far outside, for fewer corners. 0: none does.
    pub tolerance: f32,
    /// Metres: points without volume are made this thick instead of being refused.
    pub thickness: f32,
    /// Points count as flat when they are thinner than this many roundings of their largest coordinate.
    pub flatness: f32,
    /// Metres: corners this close to an earlier one are left out. 0: only equal points are one.
    pub weld_distance: f32,
    /// Metres: nearly coplanar faces, whose corners lie this close behind one plane, are one. 0: exactly flat ones.
    pub merge_distance: f32,
}

impl Default for HullSettings {
    fn default() -> HullSettings {
        // SAFETY: gives a plain struct.
        let def = unsafe { sys::tl_default_hull_def() };
        HullSettings {
            max_vertices: def.max_vertices,
            tolerance: def.tolerance,
            thickness: def.thickness,
            flatness: def.flatness,
            weld_distance: def.weld_distance,
            merge_distance: def.merge_distance,
        }
    }
}

/// The convex hull of points. Immutable: threads may share it.
pub struct Hull {
    pub(crate) blob: Blob<sys::tl_hull>,
}

impl Hull {
    /// Bakes the hull of points, exactly: every point lies in it.
    ///
    /// # Errors
    /// [`ErrorKind::Degenerate`](crate::ErrorKind) for points in a plane, `NotFinite`, `Range`, `Memory`.
    pub fn bake(points: &[Point]) -> Result<Hull, Error> {
        Ok(Hull::bake_with(points, &HullSettings::default())?.0)
    }

    /// Bakes a hull with fewer corners and faces, and tells how many metres a point may lie outside of it.
    ///
    /// # Errors
    /// As [`Hull::bake`]; `Argument` names a setting.
    pub fn bake_with(points: &[Point], settings: &HullSettings) -> Result<(Hull, f64), Error> {
        let count = u32::try_from(points.len()).map_err(|_| Error::too_many("points"))?;
        let mut hull = null_mut();
        // SAFETY: the slice outlives the call; the def is a plain struct; outputs are valid.
        let report = unsafe {
            let mut def = sys::tl_default_hull_def();
            def.max_vertices = settings.max_vertices;
            def.tolerance = settings.tolerance;
            def.thickness = settings.thickness;
            def.flatness = settings.flatness;
            def.weld_distance = settings.weld_distance;
            def.merge_distance = settings.merge_distance;
            let mut report: sys::tl_hull_report = std::mem::zeroed();
            let result = sys::tl_hull_bake(points.as_ptr().cast(), count, &def, &mut hull, &mut report);
            Error::check(result, Some(&report.base))?;
            report
        };
        Ok((Hull { blob: Blob::owned(hull) }, report.max_outside))
    }

    /// How many of the points are corners.
    pub fn vertex_count(&self) -> u32 {
        // SAFETY: the hull is whole.
        unsafe { (*self.blob.get()).vertex_count }
    }

    /// The corners, in the order of the points that they are.
    pub fn vertices(&self) -> &[Point] {
        // SAFETY: the hull is whole; its vertices are three floats each, behind its head by the bytes that it says.
        unsafe {
            let hull = self.blob.get();
            let first = hull.cast::<u8>().add((*hull).vertices as usize).cast::<Point>();
            std::slice::from_raw_parts(first, (*hull).vertex_count as usize)
        }
    }

    /// The faces as fans of triangles, counter-clockwise seen from outside: for drawing.
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        // SAFETY: the hull is whole.
        let hull = unsafe { &*self.blob.get() };
        let (edges, faces) = (hull.half_edge_count as usize, hull.face_count as usize);
        let mut triangles = Vec::with_capacity(edges - 2 * faces);
        for face in 0..faces {
            let [first, end] = [0, 1].map(|next| self.word(3 * edges + face + next) as usize);
            let corner = |half_edge: usize| self.word(3 * half_edge);
            triangles.extend((first + 2..end).map(|k| [corner(first), corner(k - 1), corner(k)]));
        }
        triangles
    }

    // Word of the topology behind the vertices, as tl_hull_word in talus/hull.h.
    fn word(&self, at: usize) -> u32 {
        let end = self.vertices().as_ptr_range().end;
        // SAFETY: the hull is whole, and callers ask for words that it has, of the width that it says.
        unsafe {
            match (*self.blob.get()).index_bytes {
                1 => u32::from(*end.cast::<u8>().add(at)),
                2 => u32::from(*end.cast::<u16>().add(at)),
                _ => *end.cast::<u32>().add(at),
            }
        }
    }

    /// Cubic metres.
    pub fn volume(&self) -> f64 {
        // SAFETY: the hull is whole.
        unsafe { (*self.blob.get()).mass.volume }
    }

    /// Whether a point lies in the hull or on it.
    pub fn contains(&self, point: Point) -> bool {
        // SAFETY: the hull is whole.
        unsafe { sys::tl_hull_contains(self.blob.get(), vec3(point)) }
    }
}

/// A convex shape in a frame of its own, with a rounding `radius` around it.
#[derive(Clone, Copy)]
pub struct Shape<'a> {
    raw: sys::tl_convex,
    hull: PhantomData<&'a Hull>,
}

// SAFETY: plain data, and a borrowed hull, which threads may share.
unsafe impl Send for Shape<'_> {}
unsafe impl Sync for Shape<'_> {}

impl<'a> Shape<'a> {
    fn new(raw: sys::tl_convex) -> Shape<'a> {
        Shape { raw, hull: PhantomData }
    }

    pub(crate) fn raw(&self) -> *const sys::tl_convex {
        &self.raw
    }

    /// A sphere.
    pub fn sphere(center: Point, radius: f32) -> Shape<'static> {
        // SAFETY: makes a plain struct; so do those below.
        Shape::new(unsafe { sys::tl_convex_sphere(vec3(center), radius) })
    }

    /// A box along the axes, by its half extents in metres.
    pub fn cuboid(center: Point, half_extents: Point, radius: f32) -> Shape<'static> {
        // SAFETY: see sphere.
        Shape::new(unsafe { sys::tl_convex_box(vec3(center), vec3(half_extents), radius) })
    }

    /// The segment from a to b, with a radius.
    pub fn capsule(a: Point, b: Point, radius: f32) -> Shape<'static> {
        // SAFETY: see sphere.
        Shape::new(unsafe { sys::tl_convex_capsule(vec3(a), vec3(b), radius) })
    }

    /// A cylinder by the middles of its two discs.
    pub fn cylinder(a: Point, b: Point, disc_radius: f32, radius: f32) -> Shape<'static> {
        // SAFETY: see sphere.
        Shape::new(unsafe { sys::tl_convex_cylinder(vec3(a), vec3(b), disc_radius, radius) })
    }

    /// A hull, which is borrowed.
    pub fn hull(hull: &'a Hull, radius: f32) -> Shape<'a> {
        // SAFETY: the hull is whole, and outlives the shape by its lifetime.
        Shape::new(unsafe { sys::tl_convex_from_hull(hull.blob.get(), radius) })
    }
}

/// Where a shape stands: turned first, then moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// A unit quaternion: x, y, z, w.
    pub rotation: [f32; 4],
    /// Metres.
    pub position: Point,
}

impl Default for Pose {
    fn default() -> Pose {
        Pose { rotation: [0.0, 0.0, 0.0, 1.0], position: [0.0; 3] }
    }
}

impl Pose {
    /// Moved, and not turned.
    pub fn at(position: Point) -> Pose {
        Pose { position, ..Pose::default() }
    }

    pub(crate) fn raw(&self) -> sys::tl_transform {
        let [x, y, z, w] = self.rotation;
        sys::tl_transform { rotation: sys::tl_quat { x, y, z, w }, position: vec3(self.position) }
    }
}

/// How far two shapes are apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Separation {
    /// Metres; 0 where they overlap.
    pub distance: f32,
    /// Metres: the true distance is not less.
    pub lower_bound: f32,
    /// Whether they overlap.
    pub overlap: bool,
    /// The nearest point of the first shape.
    pub point_a: Point,
    /// The nearest point of the second shape.
    pub point_b: Point,
    /// The direction between them, of length 1.
    pub normal: Point,
}

/// How deep two shapes are in one another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Penetration {
    /// Metres: the shortest translation that separates them.
    pub depth: f32,
    /// The true depth lies between these two.
    pub bounds: [f32; 2],
    /// The direction of that translation, of length 1.
    pub normal: Point,
    /// The first shape's point deepest in the second.
    pub point_a: Point,
    /// The second shape's point deepest in the first.
    pub point_b: Point,
}

/// The distance of two shapes, with the points nearest to one another.
///
/// ```
/// use talus::{distance, Pose, Shape};
///
/// let ball = Shape::sphere([0.0; 3], 1.0);
/// let crate_ = Shape::cuboid([0.0; 3], [1.0; 3], 0.0);
/// let apart = distance(&ball, &Pose::at([4.0, 0.0, 0.0]), &crate_, &Pose::default())?;
/// assert!((apart.distance - 2.0).abs() < 1e-6);
/// # Ok::<(), talus::Error>(())
/// ```
///
/// # Errors
/// [`ErrorKind::NotFinite`](crate::ErrorKind) for such a shape or pose.
pub fn distance(a: &Shape<'_>, pose_a: &Pose, b: &Shape<'_>, pose_b: &Pose) -> Result<Separation, Error> {
    // SAFETY: shapes borrow their hulls; the rest is plain data; without a cache the search begins anew.
    unsafe {
        let mut found: sys::tl_separation = std::mem::zeroed();
        sys::tl_convex_distance(a.raw(), pose_a.raw(), b.raw(), pose_b.raw(), null_mut(), &mut found);
        check_finite(found.status)?;
        Ok(Separation {
            distance: found.distance,
            lower_bound: found.lower_bound,
            overlap: found.overlap,
            point_a: point_of(found.point_a),
            point_b: point_of(found.point_b),
            normal: point_of(found.normal),
        })
    }
}

/// How deep two shapes are in one another; `None`: they do not overlap.
///
/// # Errors
/// [`ErrorKind::NotFinite`](crate::ErrorKind) for such a shape or pose.
pub fn penetration(a: &Shape<'_>, pose_a: &Pose, b: &Shape<'_>, pose_b: &Pose) -> Result<Option<Penetration>, Error> {
    // SAFETY: as in distance.
    unsafe {
        let mut found: sys::tl_penetration = std::mem::zeroed();
        let overlap = sys::tl_convex_penetration(a.raw(), pose_a.raw(), b.raw(), pose_b.raw(), null_mut(), &mut found);
        check_finite(found.status)?;
        Ok(overlap.then(|| Penetration {
            depth: found.depth,
            bounds: [found.lower_bound, found.upper_bound],
            normal: point_of(found.normal),
            point_a: point_of(found.point_a),
            point_b: point_of(found.point_b),
        }))
    }
}

// An answer about what is not finite is zero, which must not pass for one.
fn check_finite(status: sys::tl_convex_status) -> Result<(), Error> {
    if status == sys::TL_CONVEX_NOT_FINITE {
        return Err(Error::new(sys::TL_ERR_NOT_FINITE, None));
    }
    Ok(())
}

/// When a moving shape touches another one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CastHit {
    /// Fraction of the motion, 0 to 1; never later than the true one.
    pub t: f32,
    /// They overlap at the start: `t` is 0, the normal zero, and [`penetration`] has the depth.
    pub initial_overlap: bool,
    /// On the first shape.
    pub point: Point,
    /// From the first shape to the second, of length 1.
    pub normal: Point,
    /// False: the motion is free until `t`, and what is beyond could not be decided. It counts as a hit.
    pub converged: bool,
}

/// Moves the second shape by `motion`, metres, without turning it: when does it first touch the first shape? `None`:
/// never. Shapes that touch at the start and part, or slide along one another, do not hit.
///
/// ```
/// use talus::{cast, Pose, Shape};
///
/// let wall = Shape::cuboid([0.0; 3], [0.5, 4.0, 4.0], 0.0);
/// let ball = Shape::sphere([0.0; 3], 0.5);
/// let hit = cast(&wall, &Pose::default(), &ball, &Pose::at([9.0, 0.0, 0.0]), [-16.0, 0.0, 0.0])?.unwrap();
/// assert!((hit.t - 0.5).abs() < 1e-6 && hit.normal == [1.0, 0.0, 0.0]);
/// # Ok::<(), talus::Error>(())
/// ```
///
/// # Errors
/// [`ErrorKind::NotFinite`](crate::ErrorKind) for such a shape, pose or motion.
pub fn cast(
    a: &Shape<'_>,
    pose_a: &Pose,
    b: &Shape<'_>,
    pose_b: &Pose,
    motion: Point,
) -> Result<Option<CastHit>, Error> {
    // SAFETY: as in distance.
    unsafe {
        let mut hit: sys::tl_convex_hit = std::mem::zeroed();
        sys::tl_convex_cast(a.raw(), pose_a.raw(), b.raw(), pose_b.raw(), vec3(motion), &mut hit);
        check_finite(hit.status)?;
        Ok(hit.hit.then(|| CastHit {
            t: hit.t,
            initial_overlap: hit.initial_overlap,
            point: point_of(hit.point),
            normal: point_of(hit.normal),
            converged: hit.status == sys::TL_CONVEX_CONVERGED,
        }))
    }
}
