// SPDX-License-Identifier: MIT

using System;
using System.Runtime.InteropServices;
using Talus.Interop;

namespace Talus
{
    /// <summary>A ray of a batch: an origin in metres, a direction of any length but 0, and how far it reaches in lengths
    /// of its direction.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct SoupRay
    {
        public Vec3 Origin, Direction;
        public float MaxT;

        public SoupRay(Vec3 origin, Vec3 direction, float maxT = float.PositiveInfinity)
        {
            Origin = origin;
            Direction = direction;
            MaxT = maxT;
        }
    }

    /// <summary>Which sides of triangles a ray ignores.</summary>
    public enum Cull
    {
        None = tl_ray_cull.TL_RAY_CULL_NONE,
        Back = tl_ray_cull.TL_RAY_CULL_BACK,
        Front = tl_ray_cull.TL_RAY_CULL_FRONT,
    }

    /// <summary>Where a ray hits; the point is origin + T * direction.</summary>
    public struct SoupHit
    {
        public float T;
        /// <summary>Index in the source.</summary>
        public int Triangle;
        /// <summary>Weights of the triangle's second and third corner.</summary>
        public float U, V;
        /// <summary>The front side's, of length 1.</summary>
        public Vec3 Normal;
        public ushort Material;
        /// <summary>Whether the back side was hit.</summary>
        public bool Back;

        internal SoupHit(tl_ray_hit hit)
        {
            T = hit.t;
            Triangle = (int)hit.triangle;
            U = hit.u;
            V = hit.v;
            Normal = hit.normal;
            Material = hit.material;
            Back = hit.back != 0;
        }
    }

    /// <summary>The point of a soup nearest to a place.</summary>
    public struct SoupNearest
    {
        public Vec3 Point;
        /// <summary>Metres.</summary>
        public float Distance;
        /// <summary>The triangle's front normal, of length 1.</summary>
        public Vec3 Normal;
        public int Triangle;
    }

    /// <summary>Where a swept shape stops: after the fraction T of its motion.</summary>
    public struct SweepHit
    {
        public float T;
        public Vec3 Point;
        /// <summary>Towards the shape, of length 1.</summary>
        public Vec3 Normal;
        public int Triangle;
        /// <summary>Metres that it overlapped the soup at its start, else 0.</summary>
        public float Depth;
    }

    /// <summary>A level's triangles in a BVH, for rays and shapes. It never changes: threads may share it. No ray slips
    /// through an edge or a corner that triangles share.</summary>
    public sealed unsafe class Soup : IDisposable
    {
        internal readonly BlobHandle Blob;

        internal Soup(BlobHandle blob)
        {
            Blob = blob;
        }

        /// <summary>Bakes triangles. The normal of a front is (b - a) x (c - a) by components; so is Unity's, whose meshes
        /// go in as they are. Triangles without area are left out. TalusException names the vertex or triangle.</summary>
        /// <param name="vertices">Metres, y up.</param>
        /// <param name="triangles">Indices, three a triangle.</param>
        /// <param name="materials">One a triangle, or null.</param>
        /// <param name="threads">1: the calling one alone; 0: all cores. The soup is the same.</param>
        /// <param name="progress">Called now and then; may be null.</param>
        public static Soup Bake(Vec3[] vertices, int[] triangles, ushort[] materials = null, int threads = 0, BakeProgress progress = null)
        {
            Arrays.CheckMesh(vertices, triangles, materials);
            using (var host = new Host(threads, progress))
            fixed (Vec3* points = vertices)
            fixed (int* indices = triangles)
            fixed (ushort* kinds = materials)
            {
                tl_mesh_view view = Arrays.View((tl_vec3*)points, vertices.Length, indices, triangles.Length, kinds);
                tl_soup_def def = Api.tl_default_soup_def();
                def.host = host.Raw;
                tl_soup* soup = null;
                tl_soup_report report;
                tl_result result = Api.tl_soup_bake(&view, &def, &soup, &report);
                host.Check(result, &report.@base);
                return new Soup(new BlobHandle(soup));
            }
        }

        private static tl_ray_filter Filter(Cull cull)
        {
            return new tl_ray_filter { cull = (tl_ray_cull)cull };
        }

        /// <summary>The first triangle that a ray hits; null: none.</summary>
        public SoupHit? CastRay(Vec3 origin, Vec3 direction, float maxT = float.PositiveInfinity, Cull cull = Cull.None)
        {
            using (Lease soup = Blob.Hold())
            {
                var ray = new tl_ray { origin = origin, direction = direction, tmax = maxT };
                tl_ray_filter filter = Filter(cull);
                tl_ray_hit hit;
                bool found = Api.tl_soup_cast_ray((tl_soup*)soup.At, &ray, &filter, &hit) != 0;
                return found ? new SoupHit(hit) : (SoupHit?)null;
            }
        }

        /// <summary>The first hits of many rays, in their order: fastest for rays side by side.</summary>
        public SoupHit?[] CastRays(SoupRay[] rays, int threads = 0)
        {
            if (rays == null)
            {
                throw new ArgumentNullException("rays");
            }
            var found = new tl_ray_hit[rays.Length];
            using (var host = new Host(threads, null))
            using (Lease soup = Blob.Hold())
            fixed (SoupRay* from = rays)
            fixed (tl_ray_hit* to = found)
            {
                tl_host hooks = host.Raw;
                Api.tl_soup_cast_rays((tl_soup*)soup.At, (tl_ray*)from, (uint)rays.Length, null, &hooks, to);
            }
            return Array.ConvertAll(found, hit => hit.triangle != Api.TL_NO_TRIANGLE ? new SoupHit(hit) : (SoupHit?)null);
        }

        /// <summary>Whether a ray hits anything: faster than where.</summary>
        public bool IsOccluded(Vec3 origin, Vec3 direction, float maxT = float.PositiveInfinity)
        {
            using (Lease soup = Blob.Hold())
            {
                var ray = new tl_ray { origin = origin, direction = direction, tmax = maxT };
                return Api.tl_soup_occluded((tl_soup*)soup.At, &ray, null) != 0;
            }
        }

        /// <summary>Whether no triangle meets the segment from a to b.</summary>
        public bool LineOfSight(Vec3 a, Vec3 b)
        {
            using (Lease soup = Blob.Hold())
            {
                return Api.tl_soup_line_of_sight((tl_soup*)soup.At, a, b, null) != 0;
            }
        }

        /// <summary>The nearest point of the surface within so many metres; null: nothing is that near.</summary>
        public SoupNearest? Nearest(Vec3 point, float maxDistance = float.PositiveInfinity)
        {
            using (Lease soup = Blob.Hold())
            {
                tl_soup_point found;
                tl_result result = Api.tl_soup_nearest((tl_soup*)soup.At, point, maxDistance, null, &found);
                if (result == tl_result.TL_NOT_FOUND)
                {
                    return null;
                }
                TalusException.Check(result);
                return new SoupNearest
                {
                    Point = found.point, Distance = found.distance, Normal = found.normal, Triangle = (int)found.triangle,
                };
            }
        }

        /// <summary>Whether a shape touches a triangle.</summary>
        public bool Overlaps(ConvexShape shape, RigidPose pose)
        {
            using (Lease soup = Blob.Hold())
            using (Lease hull = shape.Hold())
            {
                tl_convex raw = shape.Raw;
                byte overlaps;
                TalusException.Check(Api.tl_soup_overlaps((tl_soup*)soup.At, &raw, pose.Raw, null, &overlaps));
                return overlaps != 0;
            }
        }

        /// <summary>Where a shape that moves from a pose along a motion in metres first hits; null: its way is free.</summary>
        public SweepHit? Sweep(ConvexShape shape, RigidPose pose, Vec3 motion)
        {
            using (Lease soup = Blob.Hold())
            using (Lease hull = shape.Hold())
            {
                tl_convex raw = shape.Raw;
                tl_shape_hit hit;
                tl_result result = Api.tl_soup_cast_shape((tl_soup*)soup.At, &raw, pose.Raw, motion, null, &hit);
                if (result == tl_result.TL_NOT_FOUND)
                {
                    return null;
                }
                TalusException.Check(result);
                return new SweepHit
                {
                    T = hit.t, Point = hit.point, Normal = hit.normal, Triangle = (int)hit.triangle, Depth = hit.depth,
                };
            }
        }

        /// <summary>Whether a point is enclosed by a closed soup, or on its surface: exact.</summary>
        public bool Contains(Vec3 point)
        {
            using (Lease soup = Blob.Hold())
            {
                tl_soup_location location;
                TalusException.Check(Api.tl_soup_locate((tl_soup*)soup.At, point, &location));
                return location.side != tl_soup_side.TL_SOUP_OUTSIDE;
            }
        }

        public void Dispose()
        {
            Blob.Dispose();
        }
    }
}
