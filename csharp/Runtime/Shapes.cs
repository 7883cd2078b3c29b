// SPDX-License-Identifier: MIT

using System;
using Talus.Interop;

namespace Talus
{
    /// <summary>How a hull is baked. A new one gives the exact hull of all points.</summary>
    public sealed unsafe class HullSettings
    {
        /// <summary>0: no limit; else 4 or more. The farthest points come first, so those that matter are kept.</summary>
        public int MaxVertices;
        /// <summary>Metres: points may lie this far outside, for fewer corners. 0: none does.</summary>
        public float Tolerance;
        /// <summary>Metres: points without volume are made this thick instead of being refused.</summary>
        public float Thickness;
        /// <summary>Points count as flat when they are thinner than this many roundings of their largest coordinate.</summary>
        public float Flatness;
        /// <summary>Metres: corners this close to an earlier one are left out. 0: only equal points are one.</summary>
        public float WeldDistance;
        /// <summary>Metres: nearly coplanar faces, whose corners lie this close behind one plane, are one. 0: exactly flat
        /// ones.</summary>
        public float MergeDistance;

        public HullSettings()
        {
            Flatness = Api.tl_default_hull_def().flatness;
        }

        internal tl_hull_def Raw
        {
            get
            {
                tl_hull_def def = Api.tl_default_hull_def();
                def.max_vertices = (uint)MaxVertices;
                def.tolerance = Tolerance;
                def.thickness = Thickness;
                def.flatness = Flatness;
                def.weld_distance = WeldDistance;
                def.merge_distance = MergeDistance;
                return def;
            }
        }
    }

    /// <summary>The convex hull of points. It never changes: threads may share it.</summary>
    public sealed unsafe class Hull : IDisposable
    {
        internal readonly BlobHandle Blob;

        internal Hull(BlobHandle blob)
        {
            Blob = blob;
        }

        /// <summary>Bakes the hull of points; without settings exactly: every point lies in it. TalusException: they lie in a
        /// plane, one is not finite, or a setting is wrong.</summary>
        public static Hull Bake(Vec3[] points, HullSettings settings = null)
        {
            if (points == null)
            {
                throw new ArgumentNullException("points");
            }
            tl_hull_def def = (settings ?? new HullSettings()).Raw;
            fixed (Vec3* at = points)
            {
                tl_hull* hull = null;
                tl_hull_report report;
                tl_result result = Api.tl_hull_bake((tl_vec3*)at, (uint)points.Length, &def, &hull, &report);
                TalusException.Check(result, &report.@base);
                return new Hull(new BlobHandle(hull));
            }
        }

        /// <summary>How many of the points are corners.</summary>
        public int VertexCount
        {
            get
            {
                using (Lease hull = Blob.Hold())
                {
                    return (int)((tl_hull*)hull.At)->vertex_count;
                }
            }
        }

        /// <summary>A copy of the corners, in the order of the points that they are.</summary>
        public Vec3[] Vertices()
        {
            using (Lease held = Blob.Hold())
            {
                var hull = (tl_hull*)held.At;
                var vertices = new Vec3[hull->vertex_count];
                for (int i = 0; i < vertices.Length; i++)
                {
                    vertices[i] = VerticesOf(hull)[i];
                }
                return vertices;
            }
        }

        /// <summary>The faces as fans of triangles, three indices each, counter-clockwise seen from outside: for drawing, or a
        /// MeshCollider.</summary>
        public int[] Triangles()
        {
            using (Lease held = Blob.Hold())
            {
                var hull = (tl_hull*)held.At;
                uint edges = hull->half_edge_count, faces = hull->face_count;
                var triangles = new int[3 * (edges - 2 * faces)];
                int at = 0;
                for (uint face = 0; face < faces; face++)
                {
                    uint first = Word(hull, 3 * edges + face), end = Word(hull, 3 * edges + face + 1);
                    for (uint k = first + 2; k < end; k++)
                    {
                        triangles[at++] = (int)Word(hull, 3 * first);
                        triangles[at++] = (int)Word(hull, 3 * (k - 1));
                        triangles[at++] = (int)Word(hull, 3 * k);
                    }
                }
                return triangles;
            }
        }

        private static tl_vec3* VerticesOf(tl_hull* hull)
        {
            return (tl_vec3*)((byte*)hull + hull->vertices);
        }

        // Word of the topology behind the vertices, as tl_hull_word in talus/hull.h.
        private static uint Word(tl_hull* hull, uint at)
        {
            void* words = VerticesOf(hull) + hull->vertex_count;
            return hull->index_bytes == 1 ? ((byte*)words)[at] : hull->index_bytes == 2 ? ((ushort*)words)[at] : ((uint*)words)[at];
        }

        /// <summary>Cubic metres.</summary>
        public double Volume
        {
            get
            {
                using (Lease hull = Blob.Hold())
                {
                    return ((tl_hull*)hull.At)->mass.volume;
                }
            }
        }

        /// <summary>Whether a point lies in the hull or on it, exactly decided.</summary>
        public bool Contains(Vec3 point)
        {
            using (Lease hull = Blob.Hold())
            {
                return Api.tl_hull_contains((tl_hull*)hull.At, point) != 0;
            }
        }

        public void Dispose()
        {
            Blob.Dispose();
        }
    }

    /// <summary>A convex shape in a frame of its own, with a rounding radius around it.</summary>
    public sealed unsafe class ConvexShape
    {
        private static readonly BlobHandle none = new BlobHandle((void*)1, new FileHandle(new byte[0]));

        internal readonly tl_convex Raw;
        private readonly Hull hull;

        private ConvexShape(tl_convex raw, Hull hull = null)
        {
            Raw = raw;
            this.hull = hull;
        }

        /// <summary>Holds the shape's hull, if it has one.</summary>
        internal Lease Hold()
        {
            return hull != null ? hull.Blob.Hold() : none.Hold();
        }

        public static ConvexShape Sphere(Vec3 center, float radius)
        {
            return new ConvexShape(Api.tl_convex_sphere(center, radius));
        }

        /// <summary>A box along the axes, by its half extents in metres.</summary>
        public static ConvexShape Box(Vec3 center, Vec3 halfExtents, float radius = 0)
        {
            return new ConvexShape(Api.tl_convex_box(center, halfExtents, radius));
        }

        /// <summary>The segment from a to b, with a radius.</summary>
        public static ConvexShape Capsule(Vec3 a, Vec3 b, float radius)
        {
            return new ConvexShape(Api.tl_convex_capsule(a, b, radius));
        }

        /// <summary>A cylinder by the middles of its two discs.</summary>
        public static ConvexShape Cylinder(Vec3 a, Vec3 b, float discRadius, float radius = 0)
        {
            return new ConvexShape(Api.tl_convex_cylinder(a, b, discRadius, radius));
        }

        /// <summary>A hull, which must not be disposed of while the shape is used.</summary>
        public static ConvexShape Of(Hull hull, float radius = 0)
        {
            using (Lease held = hull.Blob.Hold())
            {
                return new ConvexShape(Api.tl_convex_from_hull((tl_hull*)held.At, radius), hull);
            }
        }

        /// <summary>The distance of two shapes, with the points nearest to one another.</summary>
        public static Separation Distance(ConvexShape a, RigidPose poseA, ConvexShape b, RigidPose poseB)
        {
            using (a.Hold())
            using (b.Hold())
            {
                tl_convex rawA = a.Raw, rawB = b.Raw;
                tl_separation found;
                Api.tl_convex_distance(&rawA, poseA.Raw, &rawB, poseB.Raw, null, &found);
                RefuseNotFinite(found.status);
                return new Separation
                {
                    Distance = found.distance, LowerBound = found.lower_bound, Overlap = found.overlap != 0,
                    PointA = found.point_a, PointB = found.point_b, Normal = found.normal,
                };
            }
        }

        /// <summary>How deep two shapes are in one another; null: they are apart.</summary>
        public static Penetration? Penetrate(ConvexShape a, RigidPose poseA, ConvexShape b, RigidPose poseB)
        {
            using (a.Hold())
            using (b.Hold())
            {
                tl_convex rawA = a.Raw, rawB = b.Raw;
                tl_penetration found;
                bool overlap = Api.tl_convex_penetration(&rawA, poseA.Raw, &rawB, poseB.Raw, null, &found) != 0;
                RefuseNotFinite(found.status);
                if (!overlap)
                {
                    return null;
                }
                return new Penetration
                {
                    Depth = found.depth, LowerBound = found.lower_bound, UpperBound = found.upper_bound,
                    Normal = found.normal, PointA = found.point_a, PointB = found.point_b,
                };
            }
        }

        private static void RefuseNotFinite(tl_convex_status status)
        {
            if (status == tl_convex_status.TL_CONVEX_NOT_FINITE)
            {
                throw TalusException.Of(tl_result.TL_ERR_NOT_FINITE, null);
            }
        }
    }

    /// <summary>How far two shapes are apart.</summary>
    public struct Separation
    {
        /// <summary>Metres; 0 where they overlap.</summary>
        public float Distance;
        /// <summary>Metres: the true distance is not less.</summary>
        public float LowerBound;
        public bool Overlap;
        /// <summary>The point of each that is nearest to the other.</summary>
        public Vec3 PointA, PointB;
        /// <summary>From the first to the second, of length 1; zero where they overlap.</summary>
        public Vec3 Normal;
    }

    /// <summary>How deep two shapes are in one another.</summary>
    public struct Penetration
    {
        /// <summary>Metres: moving the second so far along the normal separates them.</summary>
        public float Depth;
        /// <summary>The true depth lies between these.</summary>
        public float LowerBound, UpperBound;
        /// <summary>From the first to the second, of length 1.</summary>
        public Vec3 Normal;
        /// <summary>The point of each that is deepest in the other.</summary>
        public Vec3 PointA, PointB;
    }
}
