// SPDX-License-Identifier: MIT

using System;
using System.Collections.Generic;
using System.Linq;
using Talus.Interop;

namespace Talus
{
    /// <summary>What a navmesh is baked with. Lengths are metres; the defaults are those of Recast.</summary>
    public sealed class NavmeshSettings
    {
        /// <summary>All settings, by their names in C, for those that have no property here. Its host is not used.</summary>
        public tl_nav_def Raw = Api.tl_default_nav_def();

        /// <summary>Width of a voxel, > 0.</summary>
        public float CellSize { get { return Raw.cell_size; } set { Raw.cell_size = value; } }
        /// <summary>Height of a voxel, > 0.</summary>
        public float CellHeight { get { return Raw.cell_height; } set { Raw.cell_height = value; } }
        /// <summary>Free height that an agent needs.</summary>
        public float AgentHeight { get { return Raw.agent_height; } set { Raw.agent_height = value; } }
        /// <summary>How far an agent keeps from walls.</summary>
        public float AgentRadius { get { return Raw.agent_radius; } set { Raw.agent_radius = value; } }
        /// <summary>The highest step.</summary>
        public float AgentMaxClimb { get { return Raw.agent_max_climb; } set { Raw.agent_max_climb = value; } }
        /// <summary>Degrees: steeper triangles are no floor.</summary>
        public float AgentMaxSlope { get { return Raw.agent_max_slope; } set { Raw.agent_max_slope = value; } }
        /// <summary>Cells along a tile's side; 0: the whole level is one tile.</summary>
        public uint TileSize { get { return Raw.tile_size; } set { Raw.tile_size = value; } }
        /// <summary>1: the calling thread alone; 0: all cores. The navmesh is the same.</summary>
        public int Threads { get; set; }
    }

    /// <summary>Where an agent can walk. It never changes: threads may share it, each with a NavQuery of its own.</summary>
    public sealed unsafe class Navmesh : IDisposable
    {
        internal readonly NavmeshHandle Handle;
        internal readonly tl_nav_def Def;
        internal readonly uint TilesX, TilesZ;

        internal Navmesh(NavmeshHandle handle, tl_nav_def def, uint tilesX, uint tilesZ)
        {
            Handle = handle;
            Def = def;
            TilesX = tilesX;
            TilesZ = tilesZ;
        }

        /// <summary>Bakes a navmesh over triangles, three indices each, as Soup.Bake takes them. A level without floor gives
        /// one without polygons. TalusException names the setting, vertex or triangle that is wrong.</summary>
        /// <param name="vertices">Metres, y up.</param>
        /// <param name="triangles">Indices, three a triangle.</param>
        /// <param name="settings">null: the defaults.</param>
        /// <param name="progress">Called now and then on this thread; may be null.</param>
        public static Navmesh Bake(Vec3[] vertices, int[] triangles, NavmeshSettings settings = null, BakeProgress progress = null)
        {
            Arrays.CheckMesh(vertices, triangles, null);
            settings = settings ?? new NavmeshSettings();
            using (var host = new Host(settings.Threads, progress))
            fixed (Vec3* points = vertices)
            fixed (int* indices = triangles)
            {
                tl_nav_def def = settings.Raw;
                def.host = host.Raw;
                var input = new tl_nav_input
                {
                    mesh = Arrays.View((tl_vec3*)points, vertices.Length, indices, triangles.Length, null),
                };
                var tiles = new tl_nav_tiles();
                tl_nav_bake_report report;
                try
                {
                    tl_result result = Api.tl_nav_bake(&def, &input, &tiles, &report);
                    host.Check(result, &report.@base);
                    def.host = new tl_host();
                    return FromTiles(&tiles, def);
                }
                finally
                {
                    Api.tl_nav_tiles_free(&tiles);
                }
            }
        }

        private static Navmesh FromTiles(tl_nav_tiles* tiles, tl_nav_def def)
        {
            tl_navmesh* at = null;
            TalusException.Check(Api.tl_navmesh_create(null, &at));
            var navmesh = new Navmesh(new NavmeshHandle(at), def, tiles->tiles_x, tiles->tiles_z);
            tl_report report;
            tl_result result = Api.tl_navmesh_add_tiles(at, tiles->tiles, tiles->tile_count, tl_nav_tile_ownership.TL_NAV_TILE_OWNED, &report);
            if (result != tl_result.TL_OK)
            {
                navmesh.Dispose();
                throw TalusException.Of(result, &report);
            }
            for (uint i = 0; i < tiles->tile_count; i++)
            {
                tiles->tiles[i] = null; // they are the navmesh's now
            }
            return navmesh;
        }

        /// <summary>The tiles, in the order of their places.</summary>
        internal static List<IntPtr> TilesOf(tl_navmesh* navmesh)
        {
            var tiles = new List<IntPtr>();
            for (uint slot = 0; slot < Api.tl_navmesh_slot_count(navmesh); slot++)
            {
                tl_nav_tile* tile = Api.tl_navmesh_slot_tile(navmesh, slot);
                if (tile != null)
                {
                    tiles.Add((IntPtr)tile);
                }
            }
            return tiles.OrderBy(tile => ((tl_nav_tile*)tile)->tile_z)
                .ThenBy(tile => ((tl_nav_tile*)tile)->tile_x)
                .ThenBy(tile => ((tl_nav_tile*)tile)->layer)
                .ToList();
        }

        /// <summary>How many polygons all tiles have.</summary>
        public long PolygonCount
        {
            get
            {
                using (Lease navmesh = Handle.Hold())
                {
                    return TilesOf((tl_navmesh*)navmesh.At).Sum(tile => (long)((tl_nav_tile*)tile)->polygon_count);
                }
            }
        }

        public void Dispose()
        {
            Handle.Dispose();
        }
    }

    /// <summary>A path, with the proof that none is shorter.</summary>
    public sealed class NavPath
    {
        /// <summary>Start, the corners where the path turns, goal.</summary>
        public Vec3[] Points { get; internal set; }
        /// <summary>Metres in the plane.</summary>
        public double Length { get; internal set; }
        /// <summary>Metres in the plane: no path is shorter than this.</summary>
        public double LowerBound { get; internal set; }
    }

    /// <summary>Where a walk straight ahead ends.</summary>
    public struct NavRayHit
    {
        /// <summary>False: the end was reached.</summary>
        public bool Hit;
        /// <summary>The fraction of the way, in the plane.</summary>
        public float T;
        public Vec3 Point;
        /// <summary>Of the wall, in the plane, towards the walkable side.</summary>
        public Vec3 Normal;
    }

    /// <summary>Searches over a navmesh, with memory of their own; make one a thread, and keep it.</summary>
    public sealed unsafe class NavQuery : IDisposable
    {
        private readonly QueryHandle handle;
        private readonly Navmesh navmesh;
        private tl_nav_corner[] corners = new tl_nav_corner[64];

        /// <summary>Half extents of the box in which the places of a call look for a polygon, metres.</summary>
        public Vec3 SearchExtents = new Vec3(1, 2, 1);

        public NavQuery(Navmesh navmesh)
        {
            if (navmesh == null)
            {
                throw new ArgumentNullException("navmesh");
            }
            this.navmesh = navmesh;
            tl_nav_query* query = null;
            tl_report report;
            tl_nav_query_def def = Api.tl_default_nav_query_def();
            def.max_nodes = 1u << 30; // memory grows with need: no search is too large
            TalusException.Check(Api.tl_nav_query_create(&def, &query, &report), &report);
            handle = new QueryHandle(query);
        }

        private bool Locate(tl_navmesh* mesh, Vec3 point, tl_nav_location* location)
        {
            tl_result result = Api.tl_navmesh_find_nearest(mesh, null, point, SearchExtents, location);
            if (result == tl_result.TL_NOT_FOUND)
            {
                return false;
            }
            TalusException.Check(result);
            return true;
        }

        /// <summary>The nearest point of the floor; null: there is none within SearchExtents.</summary>
        public Vec3? NearestPoint(Vec3 point)
        {
            using (Lease mesh = navmesh.Handle.Hold())
            {
                tl_nav_location location;
                return Locate((tl_navmesh*)mesh.At, point, &location) ? location.point : (Vec3?)null;
            }
        }

        /// <summary>The shortest path; null: there is none, which is proven, or no floor near one of the two places.
        /// TalusException TL_ERR_NODES: the search gave up.</summary>
        public NavPath ShortestPath(Vec3 start, Vec3 goal)
        {
            using (Lease query = handle.Hold())
            using (Lease mesh = navmesh.Handle.Hold())
            {
                var request = new tl_nav_path_request();
                if (!Locate((tl_navmesh*)mesh.At, start, &request.start) || !Locate((tl_navmesh*)mesh.At, goal, &request.goal))
                {
                    return null;
                }
                tl_nav_shortest_path path;
                tl_result result = Search((tl_nav_query*)query.At, (tl_navmesh*)mesh.At, &request, &path);
                if (result == tl_result.TL_INCOMPLETE)
                {
                    corners = new tl_nav_corner[path.corner_count];
                    result = Search((tl_nav_query*)query.At, (tl_navmesh*)mesh.At, &request, &path);
                }
                if (result == tl_result.TL_OK && path.status == tl_nav_path_status.TL_NAV_PATH_OUT_OF_NODES)
                {
                    result = tl_result.TL_ERR_NODES;
                }
                TalusException.Check(result);
                if (path.status != tl_nav_path_status.TL_NAV_PATH_COMPLETE)
                {
                    return null;
                }
                var points = new Vec3[path.corner_count];
                for (int i = 0; i < points.Length; i++)
                {
                    points[i] = corners[i].point;
                }
                return new NavPath { Points = points, Length = path.length, LowerBound = path.lower_bound };
            }
        }

        private tl_result Search(tl_nav_query* query, tl_navmesh* mesh, tl_nav_path_request* request, tl_nav_shortest_path* path)
        {
            fixed (tl_nav_corner* at = corners)
            {
                var buffers = new tl_nav_path_buffers { corners = at, corner_capacity = (uint)corners.Length };
                return Api.tl_nav_query_find_shortest_path(query, mesh, request, &buffers, path);
            }
        }

        /// <summary>Walks straight from start towards end until a wall; null: no floor is near the start.</summary>
        public NavRayHit? CastRay(Vec3 start, Vec3 end)
        {
            using (Lease mesh = navmesh.Handle.Hold())
            {
                tl_nav_location from;
                if (!Locate((tl_navmesh*)mesh.At, start, &from))
                {
                    return null;
                }
                tl_nav_ray_hit hit;
                TalusException.Check(Api.tl_navmesh_cast_ray((tl_navmesh*)mesh.At, null, &from, end, null, 0, &hit));
                return new NavRayHit { Hit = hit.hit != 0, T = hit.t, Point = hit.point, Normal = hit.normal };
            }
        }

        /// <summary>Moves towards a target, sliding along walls; null: no floor is near the start.</summary>
        public Vec3? MoveAlongSurface(Vec3 start, Vec3 target)
        {
            using (Lease query = handle.Hold())
            using (Lease mesh = navmesh.Handle.Hold())
            {
                var request = new tl_nav_move_request { target = target };
                if (!Locate((tl_navmesh*)mesh.At, start, &request.start))
                {
                    return null;
                }
                tl_nav_move move;
                TalusException.Check(Api.tl_nav_query_move_along_surface((tl_nav_query*)query.At, (tl_navmesh*)mesh.At, &request, null, 0, &move));
                float height;
                TalusException.Check(Api.tl_navmesh_height((tl_navmesh*)mesh.At, move.end.polygon, move.end.point.x, move.end.point.z, &height));
                return new Vec3(move.end.point.x, height, move.end.point.z);
            }
        }

        public void Dispose()
        {
            handle.Dispose();
        }
    }
}
