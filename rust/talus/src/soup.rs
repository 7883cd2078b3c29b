// SPDX-License-Identifier: MIT
use std::ptr::null;

use talus_sys as sys;

use crate::memory::Blob;
use crate::point::{point_of, vec3};
use crate::{Error, Point, Pose, Shape};

/// Which sides of triangles a ray ignores.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Cull {
    /// Both sides are hit.
    #[default]
    None,
    /// Back sides are ignored.
    Back,
    /// Front sides are ignored.
    Front,
}

/// A ray: an origin, a direction of any length, and how far it reaches in lengths of its direction.
#[repr(C)] // as tl_ray
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Metres.
    pub origin: Point,
    /// Of any length but 0.
    pub direction: Point,
    /// In lengths of the direction; infinity is allowed.
    pub max_t: f32,
}

// Rays of a batch are handed to C as they lie, and their hits fit the first cache.
const RAYS_AT_ONCE: usize = 512;
const _: () = {
    use std::mem::{align_of, offset_of, size_of};
    assert!(size_of::<Ray>() == size_of::<sys::tl_ray>() && align_of::<Ray>() == align_of::<sys::tl_ray>());
    assert!(offset_of!(Ray, direction) == offset_of!(sys::tl_ray, direction));
    assert!(offset_of!(Ray, max_t) == offset_of!(sys::tl_ray, tmax));
};

impl Ray {
    /// A ray without an end.
    pub fn new(origin: Point, direction: Point) -> Ray {
        Ray { origin, direction, max_t: f32::INFINITY }
    }

    /// The point at `t` lengths of the direction.
    pub fn at(&self, t: f32) -> Point {
        std::array::from_fn(|axis| self.origin[axis] + t * self.direction[axis])
    }

    fn raw(&self) -> sys::tl_ray {
        sys::tl_ray { origin: vec3(self.origin), direction: vec3(self.direction), tmax: self.max_t }
    }
}

/// Where a ray hits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayHit {
    /// The point is origin + t * direction.
    pub t: f32,
    /// Index of the triangle in the source.
    pub triangle: u32,
    /// Weights of the triangle's second and third corner.
    pub barycentric: [f32; 2],
    /// The front side's normal, of length 1.
    pub normal: Point,
    /// The triangle's material, or 0.
    pub material: u16,
    /// Whether the back side was hit.
    pub back: bool,
}

/// The point of a soup nearest to a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// On the surface.
    pub point: Point,
    /// Metres.
    pub distance: f32,
    /// The triangle's front normal, of length 1.
    pub normal: Point,
    /// Index of the triangle in the source.
    pub triangle: u32,
}

/// Where a moving shape meets a soup.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShapeHit {
    /// Fraction of the motion, 0 to 1; not later than the true one.
    pub t: f32,
    /// Index of the triangle in the source.
    pub triangle: u32,
    /// On the triangle.
    pub point: Point,
    /// From the triangle to the shape, of length 1: the face's, or an edge's or corner's own.
    pub normal: Point,
    /// It overlapped at the start: `t` is 0.
    pub initial_overlap: bool,
    /// Metres, of an initial overlap: moving this far along the normal separates them.
    pub depth: f32,
    /// It came from behind.
    pub back: bool,
    /// The triangle's material, or 0.
    pub material: u16,
    /// False: the motion is free until `t`, and what is beyond could not be decided. It counts as a hit.
    pub converged: bool,
}

/// Where a point is, in a closed soup.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Not enclosed.
    Outside,
    /// Enclosed.
    Inside,
    /// On a triangle.
    OnSurface,
}

/// A level's triangles in a BVH, for rays and shapes. Immutable: threads may share it.
///
/// No ray slips through an edge or a corner that triangles share.
pub struct Soup {
    pub(crate) blob: Blob<sys::tl_soup>,
}

/// A view of the caller's slices, for the C interface; it lives as long as they.
pub(crate) fn view(vertices: &[Point], triangles: &[[u32; 3]]) -> Result<sys::tl_mesh_view, Error> {
    Ok(sys::tl_mesh_view {
        vertices: vertices.as_ptr().cast(),
        vertex_count: u32::try_from(vertices.len()).map_err(|_| Error::too_many("vertices"))?,
        indices: triangles.as_ptr().cast(),
        triangle_count: u32::try_from(triangles.len()).map_err(|_| Error::too_many("triangles"))?,
        materials: null(),
    })
}

impl Soup {
    /// Bakes triangles, given as indices into `vertices`. Triangles without area are left out.
    ///
    /// # Errors
    /// [`ErrorKind::NotFinite`](crate::ErrorKind), `Range`, `Index` name the vertex or triangle; `Empty`, `Memory`.
    pub fn bake(vertices: &[Point], triangles: &[[u32; 3]]) -> Result<Soup, Error> {
        let view = view(vertices, triangles)?;
        let mut soup = std::ptr::null_mut();
        // SAFETY: the view's slices outlive the call; a NULL def means the defaults; outputs are valid.
        unsafe {
            let mut report: sys::tl_soup_report = std::mem::zeroed();
            let result = sys::tl_soup_bake(&view, null(), &mut soup, &mut report);
            Error::check(result, Some(&report.base))?;
        }
        Ok(Soup { blob: Blob::owned(soup) })
    }

    /// The first triangle that the ray hits.
    pub fn cast_ray(&self, ray: &Ray) -> Option<RayHit> {
        self.cast_ray_culled(ray, Cull::None)
    }

    /// The first triangle that the ray hits on a side that is not ignored.
    pub fn cast_ray_culled(&self, ray: &Ray, cull: Cull) -> Option<RayHit> {
        // SAFETY: the soup is whole, the structs are plain data; a zeroed filter ignores nothing.
        unsafe {
            let mut filter: sys::tl_ray_filter = std::mem::zeroed();
            filter.cull = cull as sys::tl_ray_cull;
            let filter = if cull == Cull::None { null() } else { &filter as *const _ };
            let mut hit = std::mem::zeroed();
            sys::tl_soup_cast_ray(self.blob.get(), &ray.raw(), filter, &mut hit).then(|| ray_hit(&hit))
        }
    }

    /// Many rays at once: the same answers. Rays that follow one another and run nearly alike, as those of a camera, are
    /// traced sixteen at once; others faster in soups larger than the processor's caches.
    ///
    /// # Errors
    /// [`ErrorKind::Limit`](crate::ErrorKind) for more than 2^32 - 1 rays.
    pub fn cast_rays(&self, rays: &[Ray]) -> Result<Vec<Option<RayHit>>, Error> {
        let mut answers = Vec::new();
        self.cast_rays_into(rays, &mut answers)?;
        Ok(answers)
    }

    /// The same into a vector that is used again: what it held is dropped, and its memory stays.
    ///
    /// # Errors
    /// [`ErrorKind::Limit`](crate::ErrorKind) for more than 2^32 - 1 rays; then it is unchanged.
    pub fn cast_rays_into(&self, rays: &[Ray], answers: &mut Vec<Option<RayHit>>) -> Result<(), Error> {
        u32::try_from(rays.len()).map_err(|_| Error::too_many("rays"))?;
        answers.clear();
        answers.reserve(rays.len());
        // SAFETY: zero is a valid value of every field. Ray has the layout of tl_ray (asserted below), and both arrays
        // have as many entries as the chunk.
        unsafe {
            let mut hits: [sys::tl_ray_hit; RAYS_AT_ONCE] = std::mem::zeroed();
            for some in rays.chunks(RAYS_AT_ONCE) {
                let first = some.as_ptr().cast::<sys::tl_ray>();
                sys::tl_soup_cast_rays(self.blob.get(), first, some.len() as u32, null(), null(), hits.as_mut_ptr());
                let found = |hit: &sys::tl_ray_hit| (hit.triangle != sys::TL_NO_TRIANGLE).then(|| ray_hit(hit));
                answers.extend(hits[..some.len()].iter().map(found));
            }
        }
        Ok(())
    }

    /// Whether the ray hits anything: faster than where.
    pub fn is_occluded(&self, ray: &Ray) -> bool {
        // SAFETY: the soup is whole, the ray plain data.
        unsafe { sys::tl_soup_occluded(self.blob.get(), &ray.raw(), null()) }
    }

    /// Whether no triangle meets the segment from a to b.
    pub fn line_of_sight(&self, a: Point, b: Point) -> bool {
        // SAFETY: as in is_occluded.
        unsafe { sys::tl_soup_line_of_sight(self.blob.get(), vec3(a), vec3(b), null()) }
    }

    /// The nearest point of the surface within `max_distance` metres; `None`: nothing is that near.
    ///
    /// # Errors
    /// [`ErrorKind::Argument`](crate::ErrorKind) and `NotFinite` for such arguments.
    pub fn nearest(&self, point: Point, max_distance: f32) -> Result<Option<Nearest>, Error> {
        // SAFETY: the soup is whole, the output valid.
        unsafe {
            let mut found: sys::tl_soup_point = std::mem::zeroed();
            match sys::tl_soup_nearest(self.blob.get(), vec3(point), max_distance, null(), &mut found) {
                sys::TL_NOT_FOUND => Ok(None),
                result => Error::check(result, None).map(|()| {
                    Some(Nearest {
                        point: point_of(found.point),
                        distance: found.distance,
                        normal: point_of(found.normal),
                        triangle: found.triangle,
                    })
                }),
            }
        }
    }

    /// Whether a shape at a pose overlaps a triangle.
    ///
    /// # Errors
    /// [`ErrorKind::Argument`](crate::ErrorKind) and `NotFinite` for such a shape or pose.
    pub fn overlaps(&self, shape: &Shape<'_>, pose: &Pose) -> Result<bool, Error> {
        let mut overlap = false;
        // SAFETY: the shape borrows its hull; the rest is plain data, and the output valid.
        let result = unsafe { sys::tl_soup_overlaps(self.blob.get(), shape.raw(), pose.raw(), null(), &mut overlap) };
        Error::check(result, None).map(|()| overlap)
    }

    /// The triangle that a shape meets first when it moves from `pose` by `motion`, metres, without turning; `None`: the
    /// way is free. A triangle that it merely touches does not stop it: it slides along the floor that it stands on.
    ///
    /// # Errors
    /// [`ErrorKind::Argument`](crate::ErrorKind) and `NotFinite` for such a shape, pose or motion.
    pub fn cast_shape(&self, shape: &Shape<'_>, pose: &Pose, motion: Point) -> Result<Option<ShapeHit>, Error> {
        // SAFETY: the shape borrows its hull; the rest is plain data, and the output valid.
        unsafe {
            let mut hit: sys::tl_shape_hit = std::mem::zeroed();
            let soup = self.blob.get();
            match sys::tl_soup_cast_shape(soup, shape.raw(), pose.raw(), vec3(motion), null(), &mut hit) {
                sys::TL_NOT_FOUND => Ok(None),
                result => Error::check(result, None).map(|()| {
                    Some(ShapeHit {
                        t: hit.t,
                        triangle: hit.triangle,
                        point: point_of(hit.point),
                        normal: point_of(hit.normal),
                        initial_overlap: hit.initial_overlap,
                        depth: hit.depth,
                        back: hit.back,
                        material: hit.material,
                        converged: hit.status == sys::TL_CONVEX_CONVERGED,
                    })
                }),
            }
        }
    }

    /// On which side of a closed surface a point is.
    ///
    /// # Errors
    /// [`ErrorKind::NotFinite`](crate::ErrorKind) for such a point.
    pub fn locate(&self, point: Point) -> Result<Side, Error> {
        // SAFETY: the soup is whole, the output valid.
        unsafe {
            let mut location: sys::tl_soup_location = std::mem::zeroed();
            Error::check(sys::tl_soup_locate(self.blob.get(), vec3(point), &mut location), None)?;
            Ok(match location.side {
                sys::TL_SOUP_INSIDE => Side::Inside,
                sys::TL_SOUP_ON_SURFACE => Side::OnSurface,
                _ => Side::Outside,
            })
        }
    }

    /// Bytes of memory, and in a file.
    pub fn size(&self) -> u64 {
        // SAFETY: the soup is whole.
        unsafe { sys::tl_soup_size(self.blob.get()) }
    }
}

fn ray_hit(hit: &sys::tl_ray_hit) -> RayHit {
    RayHit {
        t: hit.t,
        triangle: hit.triangle,
        barycentric: [hit.u, hit.v],
        normal: point_of(hit.normal),
        material: hit.material,
        back: hit.back,
    }
}
