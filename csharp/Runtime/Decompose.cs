// SPDX-License-Identifier: MIT

using System;
using System.Collections.Generic;
using System.Collections.ObjectModel;
using Talus.Interop;

namespace Talus
{
    /// <summary>How a mesh is divided into convex parts. Lengths are metres.</summary>
    public sealed class DecomposeSettings
    {
        /// <summary>All settings, by their names in C. Its host is not used.</summary>
        public tl_decompose_def Raw = Api.tl_default_decompose_def();

        /// <summary>The concavity that a part may have; 0: as RelativeTolerance says.</summary>
        public float Tolerance { get { return Raw.tolerance; } set { Raw.tolerance = value; } }
        /// <summary>Share of the longest side of the mesh's box, above 0 and up to 1.</summary>
        public float RelativeTolerance { get { return Raw.relative_tolerance; } set { Raw.relative_tolerance = value; } }
        /// <summary>0: no limit; else parts are merged beyond the tolerance until there are no more.</summary>
        public uint MaxParts { get { return Raw.max_parts; } set { Raw.max_parts = value; } }
        /// <summary>Of a part's hull, 0: no limit; else 4 or more. The mesh may then reach out of the hulls.</summary>
        public uint MaxVertices { get { return Raw.max_vertices; } set { Raw.max_vertices = value; } }
        /// <summary>Of the hull of a flat part, at most the tolerance; 0: a sixteenth of the tolerance.</summary>
        public float Thickness { get { return Raw.thickness; } set { Raw.thickness = value; } }
        /// <summary>True: rooms of a level stay open, though walls enclose them. False: what cannot be reached from outside is solid.</summary>
        public bool SurfaceOnly
        {
            get { return Raw.solid == tl_solid_rule.TL_SOLID_SURFACE; }
            set { Raw.solid = value ? tl_solid_rule.TL_SOLID_SURFACE : tl_solid_rule.TL_SOLID_ENCLOSED; }
        }
        /// <summary>1: the calling thread alone; 0: all cores. The parts are the same.</summary>
        public int Threads { get; set; } = 1;
    }

    /// <summary>One convex part of a mesh.</summary>
    public sealed class ConvexPart
    {
        /// <summary>It may reach into those of other parts.</summary>
        public Hull Hull { get; internal set; }
        /// <summary>Metres: no point of the hull is farther from the body. Proven, not sampled.</summary>
        public double Concavity { get; internal set; }
        /// <summary>Metres: no point of the mesh that this part covers is farther outside of its hull.</summary>
        public double MaxOutside { get; internal set; }
    }

    /// <summary>Convex parts that stand for a mesh in collisions. Those of largest volume come first.</summary>
    public sealed unsafe class Decomposition : IDisposable
    {
        /// <summary>Of which there is at least one.</summary>
        public ReadOnlyCollection<ConvexPart> Parts { get; private set; }
        /// <summary>Metres: no point of the parts is farther from the body.</summary>
        public double Concavity { get; private set; }
        /// <summary>Metres: no point of the mesh is farther outside of all parts.</summary>
        public double MaxOutside { get; private set; }

        private Decomposition()
        {
        }

        /// <summary>Divides a mesh into convex parts, none of which reaches farther from the body than a tolerance. The mesh may
        /// be open, intersect itself, or be loose triangles. TalusException names the setting, vertex or triangle that is wrong.</summary>
        /// <param name="vertices">Metres.</param>
        /// <param name="triangles">Indices, three a triangle.</param>
        /// <param name="settings">null: the defaults.</param>
        /// <param name="progress">Called now and then on this thread; may be null.</param>
        public static Decomposition Bake(Vec3[] vertices, int[] triangles, DecomposeSettings settings = null, BakeProgress progress = null)
        {
            Arrays.CheckMesh(vertices, triangles, null);
            settings = settings ?? new DecomposeSettings();
            using (var host = new Host(settings.Threads, progress))
            fixed (Vec3* points = vertices)
            fixed (int* indices = triangles)
            {
                tl_decompose_def def = settings.Raw;
                def.host = host.Raw;
                tl_mesh_view view = Arrays.View((tl_vec3*)points, vertices.Length, indices, triangles.Length, null);
                var body = new tl_decomposition();
                tl_decompose_report report;
                host.Check(Api.tl_decomposition_bake(&view, &def, &body, &report), &report.@base);
                try
                {
                    return new Decomposition { Parts = TakeParts(&body), Concavity = body.concavity, MaxOutside = body.max_outside };
                }
                finally
                {
                    Api.tl_decomposition_free(&body);
                }
            }
        }

        // Hulls that are taken are no more the decomposition's, which frees the rest.
        private static ReadOnlyCollection<ConvexPart> TakeParts(tl_decomposition* body)
        {
            var parts = new List<ConvexPart>();
            for (uint i = 0; i < body->part_count; i++)
            {
                tl_convex_part* part = &body->parts[i];
                var hull = new Hull(new BlobHandle(part->hull));
                part->hull = null;
                parts.Add(new ConvexPart { Hull = hull, Concavity = part->concavity, MaxOutside = part->max_outside });
            }
            return parts.AsReadOnly();
        }

        /// <summary>Disposes of the parts' hulls.</summary>
        public void Dispose()
        {
            foreach (ConvexPart part in Parts)
            {
                part.Hull.Dispose();
            }
        }
    }
}
