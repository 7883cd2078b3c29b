// SPDX-License-Identifier: MIT
//
// Written by tools/bindings from include/talus: changes belong there.

using System;
using System.Runtime.InteropServices;

namespace Talus.Interop
{
    public enum tl_result
    {
        TL_OK = 0,
        TL_NOT_FOUND = 1,
        TL_INCOMPLETE = 2,
        TL_NOT_LOADED = 3,
        TL_ERR_MEMORY = 4,
        TL_ERR_CANCELLED = 5,
        TL_ERR_IO = 6,
        TL_ERR_ARGUMENT = 7,
        TL_ERR_UNSUPPORTED = 8,
        TL_ERR_LIMIT = 9,
        TL_ERR_STALE = 10,
        TL_ERR_EMPTY = 11,
        TL_ERR_NOT_FINITE = 12,
        TL_ERR_RANGE = 13,
        TL_ERR_INDEX = 14,
        TL_ERR_DEGENERATE = 15,
        TL_ERR_COINCIDENT = 16,
        TL_ERR_COLLINEAR = 17,
        TL_ERR_COPLANAR = 18,
        TL_ERR_NON_MANIFOLD = 19,
        TL_ERR_WINDING = 20,
        TL_ERR_NOT_CLOSED = 21,
        TL_ERR_SELF_INTERSECTION = 22,
        TL_ERR_FORMAT = 23,
        TL_ERR_MAGIC = 24,
        TL_ERR_VERSION = 25,
        TL_ERR_TRUNCATED = 26,
        TL_ERR_HASH = 27,
        TL_ERR_CORRUPT = 28,
        TL_ERR_ITERATIONS = 29,
        TL_ERR_NODES = 30,
        TL_RESULT_COUNT = 31,
    }

    public enum tl_convex_kind
    {
        TL_CONVEX_HULL = 0,
        TL_CONVEX_POINTS = 1,
        TL_CONVEX_INLINE = 2,
        TL_CONVEX_BOX = 3,
        TL_CONVEX_CYLINDER = 4,
        TL_CONVEX_CONE = 5,
        TL_CONVEX_CUSTOM = 6,
    }

    public enum tl_convex_status
    {
        TL_CONVEX_CONVERGED = 0,
        TL_CONVEX_ITERATIONS = 1,
        TL_CONVEX_DEGENERATE = 2,
        TL_CONVEX_NOT_FINITE = 3,
    }

    public enum tl_soup_partition
    {
        TL_SOUP_BVH = 0,
        TL_SOUP_KD_TREE = 1,
    }

    public enum tl_soup_layout
    {
        TL_SOUP_FAST = 0,
        TL_SOUP_COMPACT = 1,
    }

    public enum tl_soup_quality
    {
        TL_SOUP_QUALITY_DEFAULT = 0,
        TL_SOUP_QUALITY_FAST = 1,
        TL_SOUP_QUALITY_HIGH = 2,
    }

    public enum tl_ray_cull
    {
        TL_RAY_CULL_NONE = 0,
        TL_RAY_CULL_BACK = 1,
        TL_RAY_CULL_FRONT = 2,
    }

    public enum tl_hit_rule
    {
        TL_HITS_TOUCHED = 0,
        TL_HITS_CROSSED = 1,
    }

    public enum tl_triangle_feature
    {
        TL_TRIANGLE_FACE = 0,
        TL_TRIANGLE_EDGE_0 = 1,
        TL_TRIANGLE_EDGE_1 = 2,
        TL_TRIANGLE_EDGE_2 = 3,
        TL_TRIANGLE_CORNER_0 = 4,
        TL_TRIANGLE_CORNER_1 = 5,
        TL_TRIANGLE_CORNER_2 = 6,
    }

    public enum tl_soup_side
    {
        TL_SOUP_OUTSIDE = 0,
        TL_SOUP_INSIDE = 1,
        TL_SOUP_ON_SURFACE = 2,
    }

    public enum tl_character_surface
    {
        TL_CHARACTER_GROUND = 0,
        TL_CHARACTER_SLOPE = 1,
        TL_CHARACTER_WALL = 2,
        TL_CHARACTER_CEILING = 3,
    }

    public enum tl_solid_rule
    {
        TL_SOLID_ENCLOSED = 0,
        TL_SOLID_SURFACE = 1,
    }

    public enum tl_partition_method
    {
        TL_PARTITION_CLASSIC = 0,
        TL_PARTITION_OPTIMAL = 1,
        TL_PARTITION_DELAUNAY = 2,
    }

    public enum tl_polygon_step_kind
    {
        TL_POLYGON_STEP_CUT = 0,
        TL_POLYGON_STEP_MERGE = 1,
    }

    public enum tl_polygon_fault
    {
        TL_POLYGON_FAULT_RANGE = 0,
        TL_POLYGON_FAULT_CORNERS = 1,
        TL_POLYGON_FAULT_REPEATED = 2,
        TL_POLYGON_FAULT_INVERTED = 3,
        TL_POLYGON_FAULT_NOT_CONVEX = 4,
        TL_POLYGON_FAULT_OVERLAP = 5,
        TL_POLYGON_FAULT_T_JUNCTION = 6,
        TL_POLYGON_FAULT_LINK = 7,
        TL_POLYGON_FAULT_PORTAL = 8,
        TL_POLYGON_FAULT_AREA = 9,
        TL_POLYGON_FAULT_OUTLINE = 10,
        TL_POLYGON_FAULT_COUNT = 11,
    }

    public enum tl_nav_tile_ownership
    {
        TL_NAV_TILE_BORROWED = 0,
        TL_NAV_TILE_OWNED = 1,
    }

    public enum tl_nav_path_status
    {
        TL_NAV_PATH_NONE = 0,
        TL_NAV_PATH_COMPLETE = 1,
        TL_NAV_PATH_UNREACHABLE = 2,
        TL_NAV_PATH_OUT_OF_NODES = 3,
        TL_NAV_PATH_UNFINISHED = 4,
        TL_NAV_PATH_STALE = 5,
    }

    public enum tl_nav_partition
    {
        TL_NAV_WATERSHED = 0,
        TL_NAV_MONOTONE = 1,
        TL_NAV_LAYERS = 2,
    }

    public enum tl_nav_volume_kind
    {
        TL_NAV_VOLUME_BOX = 0,
        TL_NAV_VOLUME_POLYGON = 1,
        TL_NAV_VOLUME_CYLINDER = 2,
    }

    public enum tl_nav_finding_kind
    {
        TL_NAV_FINDING_BLOCKED = 0,
        TL_NAV_FINDING_STEP = 1,
        TL_NAV_FINDING_NO_FLOOR = 2,
        TL_NAV_FINDING_MISSING = 3,
    }

    public enum tl_nav_cause
    {
        TL_NAV_CAUSE_NONE = 0,
        TL_NAV_CAUSE_OUTSIDE = 1,
        TL_NAV_CAUSE_NO_FLOOR = 2,
        TL_NAV_CAUSE_SLOPE = 3,
        TL_NAV_CAUSE_AREA_INPUT = 4,
        TL_NAV_CAUSE_LEDGE = 5,
        TL_NAV_CAUSE_CEILING = 6,
        TL_NAV_CAUSE_RADIUS = 7,
        TL_NAV_CAUSE_VOLUME = 8,
        TL_NAV_CAUSE_ISLAND = 9,
        TL_NAV_CAUSE_OUTLINE = 10,
        TL_NAV_CAUSE_CHANGED = 11,
        TL_NAV_CAUSE_PRUNED = 12,
        TL_NAV_CAUSE_WALL = 13,
    }

    public enum tl_nav_agent_status
    {
        TL_NAV_AGENT_IDLE = 0,
        TL_NAV_AGENT_WAITING = 1,
        TL_NAV_AGENT_WALKING = 2,
        TL_NAV_AGENT_ARRIVED = 3,
        TL_NAV_AGENT_UNREACHABLE = 4,
        TL_NAV_AGENT_QUEUED = 5,
        TL_NAV_AGENT_ON_LINK = 6,
        TL_NAV_AGENT_OFF_MESH = 7,
        TL_NAV_AGENT_GAVE_UP = 8,
        TL_NAV_AGENT_FIXED = 9,
    }

    public enum tl_nav_formation
    {
        TL_NAV_FORMATION_LOOSE = 0,
        TL_NAV_FORMATION_LINE = 1,
        TL_NAV_FORMATION_COLUMN = 2,
        TL_NAV_FORMATION_WEDGE = 3,
        TL_NAV_FORMATION_RING = 4,
        TL_NAV_FORMATION_SLOTS = 5,
    }

    public enum tl_detour_refs
    {
        TL_DETOUR_REFS_32 = 0,
        TL_DETOUR_REFS_64 = 1,
    }

    public enum tl_nav_link_kind
    {
        TL_NAV_LINK_DROP = 0,
        TL_NAV_LINK_JUMP = 1,
        TL_NAV_LINK_CLIMB = 2,
        TL_NAV_LINK_KINDS = 3,
    }

    public enum tl_nav_obstacle_shape
    {
        TL_NAV_OBSTACLE_CYLINDER = 0,
        TL_NAV_OBSTACLE_BOX = 1,
        TL_NAV_OBSTACLE_PRISM = 2,
        TL_NAV_OBSTACLE_CONVEX = 3,
    }

    public enum tl_nav_prepared_kind
    {
        TL_NAV_PREPARED_NONE = 0,
        TL_NAV_PREPARED_GRAPH = 1,
        TL_NAV_PREPARED_TABLE = 2,
    }

    public enum tl_pack_axes
    {
        TL_PACK_AXES_Y_UP = 0,
        TL_PACK_AXES_Z_UP = 1,
        TL_PACK_AXES_Y_UP_LEFT = 2,
        TL_PACK_AXES_Z_UP_LEFT = 3,
    }

    public enum tl_nav_wide_status
    {
        TL_NAV_WIDE_NONE = 0,
        TL_NAV_WIDE_COMPLETE = 1,
        TL_NAV_WIDE_UNREACHABLE = 2,
        TL_NAV_WIDE_OUT_OF_NODES = 3,
        TL_NAV_WIDE_START_BLOCKED = 4,
        TL_NAV_WIDE_GOAL_BLOCKED = 5,
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_allocator
    {
        public IntPtr allocate;
        public IntPtr release;
        public void* user;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_tasks
    {
        public IntPtr run;
        public uint worker_count;
        public void* user;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_progress
    {
        public IntPtr update;
        public void* user;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_host
    {
        public tl_allocator* allocator;
        public tl_tasks* tasks;
        public tl_progress* progress;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_report
    {
        public byte* stage;
        public byte* field;
        public byte* element;
        public ulong element_index;
        public byte* advice;
        public ulong peak_bytes;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_blob
    {
        public uint magic;
        public uint version;
        public ulong size;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_vec3
    {
        public float x;
        public float y;
        public float z;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_quat
    {
        public float x;
        public float y;
        public float z;
        public float w;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_transform
    {
        public tl_quat rotation;
        public tl_vec3 position;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_aabb
    {
        public tl_vec3 min;
        public tl_vec3 max;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_halfedge_vertex
    {
        public tl_vec3 position;
        public uint edge;
        public uint link;
        public uint mark;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_halfedge_edge
    {
        public uint vertex;
        public uint face;
        public uint next;
        public uint prev;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_halfedge_face
    {
        public uint edge;
        public uint link;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_halfedge_mesh
    {
        public tl_halfedge_vertex* vertices;
        public tl_halfedge_edge* edges;
        public tl_halfedge_face* faces;
        public uint vertex_end;
        public uint edge_end;
        public uint face_end;
        public uint vertex_count;
        public uint half_edge_count;
        public uint face_count;
        public uint boundary_count;
        public uint vertex_capacity;
        public uint edge_capacity;
        public uint face_capacity;
        public uint free_vertex;
        public uint free_edge;
        public uint free_face;
        public uint stamp;
        public tl_allocator allocator;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_hull_def
    {
        public uint max_vertices;
        public float tolerance;
        public float thickness;
        public float flatness;
        public float weld_distance;
        public float merge_distance;
        public tl_host host;
        public uint cookie;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_hull_report
    {
        public tl_report @base;
        public uint triangle_count;
        public byte thickened;
        public uint points_left_out;
        public double max_outside;
        public uint corners_left_out;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_hull_half_edge
    {
        public uint origin;
        public uint twin;
        public uint next;
        public uint face;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_hull_face
    {
        public uint first;
        public uint count;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_hull_plane
    {
        public fixed double normal[3];
        public double offset;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_hull_mass
    {
        public double volume;
        public double area;
        public fixed double center[3];
        public fixed double inertia[6];
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_hull
    {
        public tl_blob blob;
        public uint vertex_count;
        public uint face_count;
        public uint half_edge_count;
        public float scan_error;
        public byte index_bytes;
        public byte flags;
        public ushort vertices;
        public float merge_distance;
        public tl_aabb bounds;
        public tl_hull_mass mass;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_hull_climb
    {
        public uint table_side;
        public tl_vec3 table_scale;
        public uint planes;
        public uint blocks;
        public uint table;
        public uint rings;
        public uint cell_bytes;
        public uint block_count;
        public uint ring_count;
        public uint ring_cells;
        public uint cap_count;
        public fixed uint unused[3];
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_hull_validation
    {
        public tl_report @base;
        public byte euler;
        public byte flat_faces;
        public byte convex;
        public byte contains;
        public double max_outside;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_hull_hit
    {
        public float t;
        public uint face;
        public tl_vec3 normal;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_convex
    {
        public tl_convex_kind kind;
        public float radius;
        public tl_hull* hull;
        public tl_vec3* points;
        public uint point_count;
        public tl_vec3 corners_0;
        public tl_vec3 corners_1;
        public tl_vec3 corners_2;
        public IntPtr support;
        public void* user;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_simplex_cache
    {
        public uint count;
        public fixed uint vertex_a[4];
        public fixed uint vertex_b[4];
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_separation
    {
        public float distance;
        public float lower_bound;
        public byte overlap;
        public tl_vec3 point_a;
        public tl_vec3 point_b;
        public tl_vec3 normal;
        public tl_convex_status status;
        public uint iterations;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_penetration
    {
        public byte overlap;
        public float depth;
        public float lower_bound;
        public float upper_bound;
        public tl_vec3 normal;
        public tl_vec3 point_a;
        public tl_vec3 point_b;
        public tl_convex_status status;
        public uint iterations;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_convex_hit
    {
        public byte hit;
        public byte initial_overlap;
        public float t;
        public float gap;
        public tl_vec3 point;
        public tl_vec3 normal;
        public tl_convex_status status;
        public uint iterations;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_contact_limits
    {
        public float margin;
        public float tolerance;
        public uint max_steps;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_contact
    {
        public tl_vec3 point_a;
        public tl_vec3 point_b;
        public float separation;
        public uint feature_a;
        public uint feature_b;
        public uint previous;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_contact_manifold
    {
        public uint count;
        public tl_contact contacts_0;
        public tl_contact contacts_1;
        public tl_contact contacts_2;
        public tl_contact contacts_3;
        public tl_contact contacts_4;
        public tl_vec3 normal;
        public float separation;
        public tl_convex_status status;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_polytope_cache
    {
        public ushort point_count;
        public ushort face_count;
        public fixed ushort vertices[48];
        public fixed byte corners[132];
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_contact_cache
    {
        public tl_simplex_cache simplex;
        public uint count;
        public uint has_axis;
        public fixed uint features[10];
        public tl_vec3 points_0;
        public tl_vec3 points_1;
        public tl_vec3 points_2;
        public tl_vec3 points_3;
        public tl_vec3 points_4;
        public tl_vec3 points_b_0;
        public tl_vec3 points_b_1;
        public tl_vec3 points_b_2;
        public tl_vec3 points_b_3;
        public tl_vec3 points_b_4;
        public tl_vec3 axis_a;
        public tl_vec3 axis_b;
        public fixed float b_to_a[12];
        public float proven_depth;
        public tl_polytope_cache polytope;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_scaled_convex
    {
        public tl_convex shape;
        public tl_convex* of;
        public tl_vec3 scale;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_mesh_view
    {
        public tl_vec3* vertices;
        public uint vertex_count;
        public uint* indices;
        public uint triangle_count;
        public ushort* materials;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_mesh_def
    {
        public float weld_tolerance;
        public byte keep_duplicates;
        public tl_host host;
        public uint cookie;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_mesh
    {
        public tl_vec3* vertices;
        public uint vertex_count;
        public uint* indices;
        public uint triangle_count;
        public ushort* materials;
        public uint* source_triangles;
        public tl_aabb bounds;
        public void* block;
        public UIntPtr block_size;
        public tl_allocator allocator;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_mesh_report
    {
        public tl_report @base;
        public uint welded_vertices;
        public uint unused_vertices;
        public uint degenerate_triangles;
        public uint duplicate_triangles;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_adjacency
    {
        public uint* across;
        public uint triangle_count;
        public uint border_edges;
        public uint paired_edges;
        public uint non_manifold_edges;
        public tl_allocator allocator;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_closed_parts
    {
        public uint* part_of;
        public double* volumes;
        public uint part_count;
        public uint open_part_count;
        public uint triangle_count;
        public tl_allocator allocator;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_soup
    {
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_soup_def
    {
        public byte pair_triangles;
        public tl_soup_partition partition;
        public tl_soup_layout layout;
        public tl_soup_quality quality;
        public float split_budget;
        public tl_host host;
        public uint cookie;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_soup_report
    {
        public tl_report @base;
        public uint triangle_count;
        public uint degenerate_triangles;
        public uint pair_count;
        public uint single_count;
        public uint coincident_count;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_soup_stats
    {
        public ulong size;
        public uint source_triangle_count;
        public uint triangle_count;
        public uint pair_count;
        public uint single_count;
        public uint coincident_count;
        public uint reference_count;
        public uint leaf_count;
        public uint node_count;
        public tl_soup_layout layout;
        public uint depth;
        public ulong node_bytes;
        public ulong leaf_bytes;
        public ulong vertex_bytes;
        public ulong material_bytes;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_ray
    {
        public tl_vec3 origin;
        public tl_vec3 direction;
        public float tmax;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_ray_filter
    {
        public tl_ray_cull cull;
        public ulong ignored_materials;
        public IntPtr accept;
        public void* accept_user;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_ray_hit
    {
        public float t;
        public uint triangle;
        public float u;
        public float v;
        public tl_vec3 normal;
        public ushort material;
        public byte back;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_segment
    {
        public tl_vec3 a;
        public tl_vec3 b;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_soup_point
    {
        public tl_vec3 point;
        public float distance;
        public tl_vec3 normal;
        public uint triangle;
        public ushort material;
        public byte back;
        public tl_triangle_feature feature;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_shape_hit
    {
        public float t;
        public byte initial_overlap;
        public byte back;
        public ushort material;
        public uint triangle;
        public float depth;
        public tl_vec3 point;
        public tl_vec3 normal;
        public tl_vec3 face_normal;
        public tl_convex_status status;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_soup_contact_query
    {
        public tl_convex* shape;
        public tl_transform pose;
        public tl_contact_limits limits;
        public tl_ray_filter* filter;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_soup_contact
    {
        public uint triangle;
        public ushort material;
        public byte is_face;
        public tl_contact_manifold manifold;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_soup_location
    {
        public tl_soup_side side;
        public int winding;
        public uint triangle;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_soup_triangle
    {
        public tl_vec3 corners_0;
        public tl_vec3 corners_1;
        public tl_vec3 corners_2;
        public uint triangle;
        public ushort material;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_soup_pair
    {
        public tl_vec3 corners_0;
        public tl_vec3 corners_1;
        public tl_vec3 corners_2;
        public tl_vec3 corners_3;
        public fixed uint triangles[2];
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_scaled_soup
    {
        public tl_soup* soup;
        public tl_vec3 scale;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_scene
    {
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_scene_instance
    {
        public tl_soup* soup;
        public tl_convex* shape;
        public tl_transform pose;
        public uint mask;
        public tl_vec3 scale;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_scene_stats
    {
        public ulong size;
        public uint instance_count;
        public uint node_count;
        public uint depth;
        public double cost;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_scene_filter
    {
        public uint ignored_mask;
        public uint first_ignored;
        public uint ignored_count;
        public IntPtr accept;
        public void* accept_user;
        public tl_ray_filter* triangles;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_scene_hit
    {
        public tl_ray_hit hit;
        public uint instance;
        public byte inside;
        public tl_convex_status status;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_scene_shape_hit
    {
        public tl_shape_hit hit;
        public uint instance;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_scene_overlap_query
    {
        public tl_convex* shape;
        public tl_transform pose;
        public tl_scene_filter* filter;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_scene_overlap
    {
        public uint instance;
        public uint triangle;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_scene_point
    {
        public tl_soup_point point;
        public uint instance;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_character_def
    {
        public float radius;
        public float height;
        public float step_height;
        public float max_slope;
        public float gap;
        public uint max_triangles;
        public tl_allocator* allocator;
        public uint cookie;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_character_mover
    {
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_character
    {
        public tl_vec3 position;
        public tl_vec3 velocity;
        public tl_vec3 ground_normal;
        public tl_vec3 ground_point;
        public uint grounded;
        public uint ground_triangle;
        public uint ground_instance;
        public tl_transform ground_pose;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_character_level
    {
        public tl_soup* soup;
        public tl_ray_filter* soup_filter;
        public tl_scene* scene;
        public tl_scene_instance* instances;
        public tl_scene_filter* scene_filter;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_character_step
    {
        public tl_vec3 velocity;
        public float seconds;
        public byte leave_ground;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_character_hit
    {
        public tl_vec3 point;
        public tl_vec3 normal;
        public uint instance;
        public uint triangle;
        public ushort material;
        public tl_character_surface surface;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_character_report
    {
        public tl_report @base;
        public byte landed;
        public byte left_ground;
        public byte blocked;
        public byte hit_ceiling;
        public byte stuck;
        public float stepped_up;
        public float pushed;
        public tl_vec3 carried;
        public tl_quat turned;
        public tl_vec3 ground_velocity;
        public uint sweeps;
        public uint hit_count;
        public tl_character_hit hits_0;
        public tl_character_hit hits_1;
        public tl_character_hit hits_2;
        public tl_character_hit hits_3;
        public tl_character_hit hits_4;
        public tl_character_hit hits_5;
        public tl_character_hit hits_6;
        public tl_character_hit hits_7;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_decompose_def
    {
        public float tolerance;
        public float relative_tolerance;
        public uint max_parts;
        public uint max_vertices;
        public float thickness;
        public tl_solid_rule solid;
        public uint max_cells;
        public tl_host host;
        public uint cookie;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_convex_part
    {
        public tl_hull* hull;
        public double concavity;
        public double max_outside;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_decomposition
    {
        public tl_convex_part* parts;
        public uint part_count;
        public double concavity;
        public double max_outside;
        public double hull_volume;
        public tl_allocator allocator;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_decompose_report
    {
        public tl_report @base;
        public float tolerance;
        public float cell;
        public uint degenerate_triangles;
        public uint cut_count;
        public uint parts_before_merging;
        public uint parts_over_tolerance;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_contour_vertex
    {
        public int x;
        public int y;
        public int z;
        public uint flags;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_contour
    {
        public uint first_vertex;
        public uint vertex_count;
        public uint region;
        public uint area;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_contour_set
    {
        public tl_contour_vertex* vertices;
        public uint vertex_count;
        public tl_contour* contours;
        public uint contour_count;
        public tl_aabb bounds;
        public float cell_size;
        public float cell_height;
        public int width;
        public int height;
        public int border_size;
        public float max_error;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_contour_note
    {
        public uint contour;
        public uint faults;
        public uint vertex;
        public uint reserved;
        public long contour_area2;
        public long covered_area2;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_polygon_mesh
    {
        public uint vertex_count;
        public uint polygon_count;
        public uint index_count;
        public int* vertices;
        public uint* first;
        public uint* indices;
        public uint* neighbours;
        public uint* regions;
        public uint* areas;
        public uint* contours;
        public tl_aabb bounds;
        public float cell_size;
        public float cell_height;
        public uint max_verts_per_poly;
        public uint note_count;
        public tl_contour_note* notes;
        public tl_allocator allocator;
        public void* block;
        public UIntPtr block_size;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_polygon_step
    {
        public tl_polygon_step_kind kind;
        public uint contour;
        public uint partition_count;
        public int* partitions;
        public uint outline_count;
        public int* outline;
        public uint corner_count;
        public int* corners;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_polygon_trace
    {
        public IntPtr step;
        public void* user;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_polygon_def
    {
        public uint max_verts_per_poly;
        public tl_partition_method method;
        public uint merge_height;
        public byte keep_border_vertices;
        public byte drop_straight_vertices;
        public byte merge_contours;
        public tl_polygon_trace* trace;
        public tl_host host;
        public uint cookie;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_polygon_report
    {
        public tl_report @base;
        public uint contour_count;
        public uint empty_contours;
        public uint repaired_contours;
        public uint refused_contours;
        public uint triangle_count;
        public uint lower_bound;
        public uint polygon_count;
        public uint vertex_count;
        public uint removed_straight_vertices;
        public uint contour_merges;
        public uint removed_border_vertices;
        public uint kept_border_vertices;
        public uint link_count;
        public uint portal_count;
        public uint non_manifold_edges;
        public long uncovered_area2;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_polygon_quality
    {
        public uint polygon_count;
        public uint max_corners;
        public double mean_corners;
        public double smallest_angle_cosine;
        public double mean_sharpest_cosine;
        public double mean_aspect;
        public double worst_aspect;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_polygon_check_report
    {
        public tl_report @base;
        public tl_polygon_fault first_fault;
        public fixed ulong counts[11];
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_detail_patch
    {
        public uint first_vertex;
        public uint vertex_count;
        public uint first_triangle;
        public uint triangle_count;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_detail_triangle
    {
        public fixed ushort corner[3];
        public ushort edge_flags;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_detail
    {
        public uint patch_count;
        public uint vertex_count;
        public uint triangle_count;
        public tl_nav_detail_patch* patches;
        public tl_vec3* vertices;
        public tl_nav_detail_triangle* triangles;
        public float max_error;
        public uint limited_patches;
        public tl_allocator allocator;
        public void* block;
        public UIntPtr block_size;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_portal
    {
        public uint polygon;
        public uint corner;
        public int low;
        public int high;
        public uint first_profile;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_profile_point
    {
        public float along;
        public float height;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_tile_node
    {
        public fixed ushort min[3];
        public fixed ushort max[3];
        public uint link;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_tile
    {
        public tl_blob blob;
        public int tile_x;
        public int tile_z;
        public uint tile_size;
        public uint polygon_count;
        public uint vertex_count;
        public uint corner_count;
        public uint detail_vertex_count;
        public uint detail_triangle_count;
        public uint node_count;
        public uint portal_count;
        public uint profile_count;
        public uint layer;
        public fixed uint side_end[4];
        public double area;
        public tl_vec3 origin;
        public float cell_size;
        public float cell_height;
        public float agent_height;
        public float agent_radius;
        public float agent_max_climb;
        public tl_aabb bounds;
        public uint wide;
        public uint node_steps;
        public uint nodes;
        public uint first_corner;
        public uint links;
        public uint corner_vertices;
        public uint vertices;
        public uint flags;
        public uint areas;
        public uint detail_first_vertex;
        public uint detail_first_triangle;
        public uint detail_vertices;
        public uint detail_triangles;
        public uint portals;
        public uint profile;
        public uint zero;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_cut
    {
        public uint corner;
        public uint layer;
        public uint ordinal;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_tile_source
    {
        public tl_polygon_mesh* polygons;
        public tl_nav_detail* detail;
        public int tile_x;
        public int tile_z;
        public uint tile_size;
        public tl_vec3 origin;
        public float agent_height;
        public float agent_radius;
        public float agent_max_climb;
        public ulong* flags;
        public uint layer;
        public tl_nav_cut* cuts;
        public uint cut_count;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_tile_stack
    {
        public tl_nav_tile** tiles;
        public uint count;
        public tl_allocator allocator;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_tile_part
    {
        public uint begin;
        public uint end;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_surface
    {
        public tl_vec3* vertices;
        public uint vertex_count;
        public uint triangle_count;
        public void* triangles;
        public byte is_wide;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_lattice_point
    {
        public fixed int at[3];
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_navmesh
    {
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_link
    {
        public ulong to;
        public uint edge;
        public tl_vec3 left;
        public tl_vec3 right;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_offmesh
    {
        public tl_vec3 start;
        public tl_vec3 end;
        public float radius;
        public float cost_factor;
        public float fixed_cost;
        public ulong flags;
        public ulong user;
        public byte area;
        public byte both_ways;
        public uint cookie;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_location
    {
        public ulong polygon;
        public tl_vec3 point;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_offmesh_state
    {
        public tl_nav_offmesh offmesh;
        public tl_nav_location ends_0;
        public tl_nav_location ends_1;
        public byte anchored;
        public float length;
        public float cost;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_filter
    {
        public ulong include_flags;
        public ulong exclude_flags;
        public fixed float area_cost[256];
        public IntPtr pass;
        public IntPtr cost;
        public void* user;
        public float slack;
        public uint cookie;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_query
    {
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_query_def
    {
        public uint max_nodes;
        public tl_allocator* allocator;
        public uint cookie;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_corner
    {
        public tl_vec3 point;
        public ulong polygon;
        public uint flags;
        public ulong link;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_path_request
    {
        public tl_nav_filter* filter;
        public tl_nav_location start;
        public tl_nav_location goal;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_path_buffers
    {
        public ulong* polygons;
        public uint polygon_capacity;
        public tl_nav_corner* corners;
        public uint corner_capacity;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_path
    {
        public tl_nav_path_status status;
        public uint polygon_count;
        public tl_nav_location end;
        public float cost;
        public uint node_count;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_path_progress
    {
        public tl_nav_path_status status;
        public uint node_count;
        public int tile_x;
        public int tile_z;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_polygon_path
    {
        public ulong* polygons;
        public uint polygon_count;
        public tl_vec3 start;
        public tl_vec3 end;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_trace_point
    {
        public tl_vec3 point;
        public ulong polygon;
        public uint flags;
        public float cost;
        public float length;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_trace_request
    {
        public tl_nav_filter* filter;
        public ulong* polygons;
        public uint polygon_count;
        public tl_nav_corner* corners;
        public uint corner_count;
        public uint keep;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_shortest_path
    {
        public tl_nav_path_status status;
        public uint corner_count;
        public uint polygon_count;
        public double length;
        public double lower_bound;
        public double surface_length;
        public uint node_count;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_ray_hit
    {
        public byte hit;
        public float t;
        public tl_vec3 point;
        public tl_vec3 normal;
        public ulong polygon;
        public uint edge;
        public uint polygon_count;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_move_request
    {
        public tl_nav_filter* filter;
        public tl_nav_location start;
        public tl_vec3 target;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_move
    {
        public tl_nav_location end;
        public uint polygon_count;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_around_request
    {
        public tl_nav_filter* filter;
        public tl_nav_location center;
        public float radius;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_wall
    {
        public byte hit;
        public float distance;
        public tl_vec3 point;
        public tl_vec3 normal;
        public ulong polygon;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_route_request
    {
        public tl_nav_filter* filter;
        public tl_vec3 start;
        public tl_vec3 goal;
        public tl_vec3 half_extents;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_route
    {
        public tl_nav_location start;
        public tl_nav_location goal;
        public tl_nav_path path;
        public uint corner_count;
        public float length;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_zone
    {
        public tl_vec3 center;
        public float radius;
        public tl_vec3* points;
        public uint point_count;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_height_range
    {
        public float min;
        public float max;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_field_entry
    {
        public ulong polygon;
        public ulong link;
        public uint parent;
        public float cost;
        public tl_vec3 point;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_field_def
    {
        public tl_nav_filter* filter;
        public tl_nav_zone* zone;
        public float max_cost;
        public byte by_reference;
        public uint cookie;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_goal_entry
    {
        public ulong polygon;
        public ulong link;
        public uint parent;
        public float min_cost;
        public float cost;
        public tl_vec3 corner;
        public fixed float left[2];
        public fixed float right[2];
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_goal_tree
    {
        public tl_nav_goal_entry* entries;
        public uint capacity;
        public uint count;
        public tl_nav_location goal;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_goal_path_request
    {
        public tl_nav_filter* filter;
        public tl_nav_location start;
        public uint max_polygons;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_wall_segment
    {
        public tl_vec3 start;
        public tl_vec3 end;
        public ulong polygon;
        public ulong across;
        public float distance;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_def
    {
        public float cell_size;
        public float cell_height;
        public float agent_height;
        public float agent_radius;
        public float agent_max_climb;
        public float agent_max_slope;
        public float region_min_size;
        public float region_merge_size;
        public float edge_max_len;
        public float edge_max_error;
        public uint max_verts_per_poly;
        public float detail_sample_dist;
        public float detail_sample_max_error;
        public tl_nav_partition partition;
        public tl_partition_method polygon_method;
        public byte filter_low_hanging_obstacles;
        public byte filter_ledge_spans;
        public byte filter_walkable_low_height_spans;
        public uint tile_size;
        public float tile_height;
        public tl_aabb bounds;
        public tl_host host;
        public uint cookie;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_lattice
    {
        public tl_vec3 origin;
        public int first_x;
        public int first_z;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_config
    {
        public tl_nav_lattice lattice;
        public tl_aabb bounds;
        public float cell_size;
        public float cell_height;
        public uint width;
        public uint height;
        public uint height_voxels;
        public uint border_size;
        public uint walkable_height;
        public uint walkable_climb;
        public uint walkable_radius;
        public float walkable_slope_cos;
        public uint min_region_area;
        public uint merge_region_area;
        public uint max_edge_len;
        public float max_simplification_error;
        public uint max_verts_per_poly;
        public float detail_sample_dist;
        public float detail_sample_max_error;
        public tl_nav_partition partition;
        public tl_partition_method polygon_method;
        public byte filter_low_hanging_obstacles;
        public byte filter_ledge_spans;
        public byte filter_walkable_low_height_spans;
        public uint tile_x;
        public uint tile_z;
        public uint layer_height;
        public float agent_height;
        public float agent_radius;
        public float agent_max_climb;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_span
    {
        public ushort min;
        public ushort max;
        public ushort area;
        public ushort reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_heightfield
    {
        public uint width;
        public uint height;
        public tl_nav_lattice lattice;
        public tl_aabb bounds;
        public float cell_size;
        public float cell_height;
        public uint* first_span;
        public tl_nav_span* spans;
        public uint span_count;
        public tl_allocator allocator;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_region_stats
    {
        public uint split;
        public uint merged;
        public uint filtered_regions;
        public uint filtered_spans;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_compact
    {
        public uint width;
        public uint height;
        public uint border_size;
        public uint walkable_height;
        public uint walkable_climb;
        public tl_nav_lattice lattice;
        public tl_aabb bounds;
        public float cell_size;
        public float cell_height;
        public uint span_count;
        public uint* first_span;
        public ushort* floor;
        public ushort* clearance;
        public byte* area;
        public short* step;
        public uint* neighbour;
        public ushort* distance;
        public ushort max_distance;
        public uint* region;
        public uint region_count;
        public tl_nav_region_stats region_stats;
        public byte* taken;
        public tl_allocator allocator;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_contours
    {
        public tl_contour_set set;
        public tl_contour_set raw;
        public uint hole_count;
        public uint unbridged_count;
        public uint slit_count;
        public uint repaired_count;
        public tl_allocator allocator;
        public void* block;
        public UIntPtr block_size;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_volume
    {
        public tl_nav_volume_kind kind;
        public byte area;
        public tl_aabb box;
        public tl_vec3* points;
        public uint point_count;
        public tl_vec3 @base;
        public float radius;
        public float height;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_input
    {
        public tl_mesh_view mesh;
        public byte* areas;
        public tl_nav_volume* volumes;
        public uint volume_count;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_stages
    {
        public tl_nav_heightfield heightfield;
        public tl_nav_compact compact;
        public tl_nav_contours contours;
        public tl_polygon_mesh polygons;
        public tl_nav_detail detail;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_bake_report
    {
        public tl_report @base;
        public ulong span_count;
        public ulong compact_span_count;
        public uint region_count;
        public uint filtered_regions;
        public ulong filtered_spans;
        public double filtered_area;
        public uint contour_count;
        public uint unbridged_holes;
        public uint slit_outlines;
        public uint repaired_contours;
        public uint polygon_count;
        public uint vertex_count;
        public uint detail_triangle_count;
        public uint limited_patches;
        public uint tile_count;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_tile_memo
    {
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_tiles
    {
        public tl_nav_tile** tiles;
        public uint tile_count;
        public uint tiles_x;
        public uint tiles_z;
        public tl_allocator allocator;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_tile_range
    {
        public uint x;
        public uint z;
        public uint count_x;
        public uint count_z;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_stage_sink
    {
        public IntPtr take;
        public void* user;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_tile_block
    {
        public tl_nav_tile_range range;
        public tl_nav_tile_stack* stacks;
        public tl_allocator allocator;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_triangles
    {
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_near_triangles
    {
        public tl_nav_input input;
        public uint* sources;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_prune_def
    {
        public tl_vec3* seeds;
        public uint seed_count;
        public tl_vec3 seed_extents;
        public tl_mesh_view* solids;
        public double min_area;
        public tl_host host;
        public uint cookie;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_pruned
    {
        public uint islands;
        public ulong polygons;
        public double area;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_prune_report
    {
        public tl_report @base;
        public tl_nav_pruned inside;
        public tl_nav_pruned unreachable;
        public tl_nav_pruned small;
        public uint island_count;
        public uint solid_count;
        public uint removed_tiles;
        public uint changed_tiles;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_probe
    {
        public float radius;
        public float step;
        public float height;
        public float surface;
        public float gap;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_audit_def
    {
        public tl_nav_def nav;
        public uint path_count;
        public ulong seed;
        public float probe_radius;
        public byte* areas;
        public tl_nav_volume* volumes;
        public uint volume_count;
        public tl_navmesh* pruned;
        public float min_missing_area;
        public ulong max_steps;
        public tl_host host;
        public uint cookie;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_finding
    {
        public tl_nav_finding_kind kind;
        public uint triangle;
        public ulong polygon;
        public tl_vec3 point;
        public tl_vec3 contact;
        public float depth;
        public uint count;
        public tl_aabb bounds;
        public float area;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_audit
    {
        public tl_nav_finding* findings;
        public uint finding_count;
        public tl_nav_probe probe;
        public ulong path_count;
        public double path_metres;
        public ulong polygon_count;
        public ulong portal_count;
        public ulong step_count;
        public ulong tolerated_count;
        public ulong contradictions;
        public ulong floor_samples;
        public float sample_spacing;
        public double missing_area;
        public tl_allocator allocator;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_reason
    {
        public tl_nav_cause cause;
        public byte* stage;
        public byte* parameter;
        public float value;
        public float needed;
        public float measured;
        public uint triangle;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_why_answer
    {
        public byte walkable;
        public tl_vec3 floor;
        public tl_nav_reason reasons_0;
        public tl_nav_reason reasons_1;
        public tl_nav_reason reasons_2;
        public tl_nav_reason reasons_3;
        public tl_nav_reason reasons_4;
        public tl_nav_reason reasons_5;
        public uint reason_count;
        public byte proven;
        public tl_nav_def needed;
        public uint tile_x;
        public uint tile_z;
        public uint bake_count;
        public byte apart;
        public float island_area;
        public float largest_island_area;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_pruning
    {
        public tl_navmesh* removed;
        public double min_area;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_corridor
    {
        public ulong* path;
        public uint capacity;
        public uint count;
        public tl_vec3 position;
        public tl_vec3 target;
        public tl_vec3 goal;
        public byte reaches;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_crowd
    {
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_crowd_def
    {
        public uint max_agents;
        public uint max_path;
        public uint max_neighbors;
        public uint paths_per_step;
        public uint max_nodes;
        public float neighbor_distance;
        public float agent_horizon;
        public float wall_horizon;
        public tl_host host;
        public uint max_shared_goals;
        public uint max_groups;
        public uint max_members;
        public uint cookie;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_agent_def
    {
        public tl_vec3 position;
        public float reach;
        public float radius;
        public float height;
        public float max_speed;
        public float max_acceleration;
        public float arrive_distance;
        public float priority;
        public uint filter;
        public byte is_fixed;
        public uint cookie;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_agent_state
    {
        public tl_nav_agent_status status;
        public tl_vec3 position;
        public tl_vec3 velocity;
        public tl_vec3 wanted;
        public ulong polygon;
        public ulong link;
        public tl_vec3 goal;
        public float radius;
        public float height;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_formation_slot
    {
        public float forward;
        public float left;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_group_def
    {
        public tl_nav_formation formation;
        public float spacing;
        public float wait_distance;
        public float lost_distance;
        public tl_nav_formation_slot* slots;
        public byte keep_order;
        public uint cookie;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_group_state
    {
        public tl_nav_formation formation;
        public uint count;
        public uint in_place;
        public uint on_trail;
        public float lag;
        public float speed;
        public tl_vec3 heading;
        public ulong leader;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_crowd_step_report
    {
        public uint searched;
        public uint waiting;
        public uint walking;
        public uint arrived;
        public uint unreachable;
        public uint on_link;
        public uint off_mesh;
        public uint shared;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_detour_report
    {
        public tl_report @base;
        public uint tile_count;
        public uint polygon_count;
        public uint plain_patches;
        public uint dropped_polygons;
        public uint one_way_links;
        public uint off_mesh_links;
        public uint off_mesh_outside;
        public uint off_mesh_far;
        public uint area_zeros;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_detour_tiles
    {
        public tl_nav_tile** tiles;
        public uint tile_count;
        public tl_allocator allocator;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_detour_read_def
    {
        public float cell_height;
        public tl_allocator* allocator;
        public uint cookie;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_detour_off_mesh
    {
        public tl_vec3 start;
        public tl_vec3 end;
        public float radius;
        public uint user_id;
        public ushort flags;
        public byte area;
        public byte both_ways;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_detour_set
    {
        public tl_nav_tile** tiles;
        public uint tile_count;
        public tl_detour_off_mesh* off_mesh;
        public uint off_mesh_count;
        public tl_detour_refs refs;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_jump_link
    {
        public tl_vec3 start;
        public tl_vec3 end;
        public float apex;
        public byte kind;
        public byte both_ways;
        public ushort reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_links
    {
        public tl_blob blob;
        public uint link_count;
        public fixed uint kind_counts[3];
        public float agent_radius;
        public float agent_height;
        public float agent_max_climb;
        public float margin;
        public ulong links;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_links_def
    {
        public float spacing;
        public float max_drop;
        public float max_jump;
        public float jump_height;
        public float max_speed;
        public float gravity;
        public float max_climb;
        public float min_gain;
        public uint max_nodes;
        public tl_host host;
        public uint cookie;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_links_count
    {
        public uint tried;
        public uint blocked;
        public uint useless;
        public uint kept;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_links_report
    {
        public tl_report @base;
        public uint ledge_count;
        public uint sample_count;
        public uint no_landing;
        public uint too_fast;
        public tl_nav_links_count kinds_0;
        public tl_nav_links_count kinds_1;
        public tl_nav_links_count kinds_2;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_obstacle
    {
        public tl_nav_obstacle_shape shape;
        public byte area;
        public tl_vec3 @base;
        public float height;
        public float radius;
        public float half_x;
        public float half_z;
        public float cosine;
        public float sine;
        public tl_vec3 points_0;
        public tl_vec3 points_1;
        public tl_vec3 points_2;
        public tl_vec3 points_3;
        public tl_vec3 points_4;
        public tl_vec3 points_5;
        public tl_vec3 points_6;
        public tl_vec3 points_7;
        public tl_vec3 points_8;
        public tl_vec3 points_9;
        public tl_vec3 points_10;
        public tl_vec3 points_11;
        public tl_vec3 points_12;
        public tl_vec3 points_13;
        public tl_vec3 points_14;
        public tl_vec3 points_15;
        public uint point_count;
        public tl_convex convex;
        public tl_transform pose;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_obstacles
    {
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_rebaked_tile
    {
        public int tile_x;
        public int tile_z;
        public tl_nav_tile_stack stack;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_prepare_def
    {
        public ulong table_bytes;
        public tl_tasks* tasks;
        public tl_progress* progress;
        public uint cookie;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_prepared
    {
        public tl_report @base;
        public tl_nav_prepared_kind kind;
        public uint corner_vertex_count;
        public uint edge_count;
        public uint renewed_count;
        public ulong bytes;
        public ulong table_bytes;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_pack_item
    {
        public uint type;
        public uint id;
        public void* bytes;
        public ulong size;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_pack_chunk
    {
        public uint type;
        public uint id;
        public void* bytes;
        public ulong size;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_pack
    {
        public void* bytes;
        public ulong size;
        public uint chunk_count;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_pack_entry
    {
        public uint type;
        public uint id;
        public ulong offset;
        public ulong size;
        public ulong hash;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_pack_index
    {
        public tl_pack_entry* entries;
        public uint count;
        public ulong file_size;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_pack_meta
    {
        public tl_blob blob;
        public ulong source_vertices;
        public ulong source_triangles;
        public tl_aabb bounds;
        public uint name_size;
        public uint source_up;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_pack_frame
    {
        public tl_blob blob;
        public fixed double origin[3];
        public uint axes;
        public fixed uint reserved[5];
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_pack_navmesh
    {
        public tl_blob blob;
        public float cell_size;
        public float cell_height;
        public float agent_height;
        public float agent_radius;
        public float agent_max_climb;
        public float agent_max_slope;
        public float region_min_size;
        public float region_merge_size;
        public float edge_max_len;
        public float edge_max_error;
        public uint max_verts_per_poly;
        public float detail_sample_dist;
        public float detail_sample_max_error;
        public uint partition;
        public uint filters;
        public uint tile_size;
        public uint tiles_x;
        public uint tiles_z;
        public uint tile_count;
        public tl_aabb bounds;
        public uint polygon_method;
        public float tile_height;
        public fixed uint reserved[5];
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_pack_volume
    {
        public uint kind;
        public uint area;
        public tl_aabb box;
        public tl_vec3 @base;
        public float radius;
        public float height;
        public uint first_point;
        public uint point_count;
        public uint reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_pack_volumes
    {
        public tl_blob blob;
        public uint count;
        public uint point_count;
        public fixed uint reserved[10];
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_pack_pruning
    {
        public tl_blob blob;
        public double min_area;
        public tl_vec3 seed_extents;
        public uint seed_count;
        public uint drop_inside_solids;
        public fixed uint reserved[5];
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_pack_offmesh_link
    {
        public tl_vec3 start;
        public tl_vec3 end;
        public float radius;
        public float cost_factor;
        public float fixed_cost;
        public uint area;
        public uint both_ways;
        public uint reserved;
        public ulong flags;
        public ulong user;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_pack_offmesh
    {
        public tl_blob blob;
        public uint count;
        public fixed uint reserved[11];
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_pack_areas
    {
        public tl_blob blob;
        public uint count;
        public fixed uint reserved[11];
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_world
    {
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_world_def
    {
        public IntPtr read;
        public void* user;
        public ulong budget;
        public double frame_reach;
        public tl_allocator* allocator;
        public uint cookie;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_world_interest
    {
        public fixed double point[3];
        public double radius;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_world_load
    {
        public tl_nav_world* world;
        public uint place;
        public int tile_x;
        public int tile_z;
        public tl_result result;
        public byte* advice;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_world_state
    {
        public uint places;
        public uint loaded;
        public uint loading;
        public uint ready;
        public uint missing;
        public uint failed;
        public uint frames;
        public ulong bytes;
        public ulong peak_bytes;
        public ulong index_bytes;
        public ulong read_bytes;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_routes
    {
        public tl_blob blob;
        public fixed uint tiles_hash[2];
        public uint gate_count;
        public uint length_count;
        public uint block;
        public fixed uint reserved[7];
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_routes_def
    {
        public IntPtr read;
        public void* user;
        public uint block;
        public tl_host host;
        public uint cookie;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_router
    {
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_world_route_request
    {
        public tl_nav_location start;
        public tl_nav_location goal;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_world_route_point
    {
        public fixed double point[3];
        public double length;
        public int tile_x;
        public int tile_z;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_world_route
    {
        public tl_nav_path_status status;
        public uint point_count;
        public double length;
        public double lower_bound;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_pvs_def
    {
        public float eye_height;
        public float max_distance;
        public tl_ray_filter* filter;
        public tl_host host;
        public uint cookie;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_pvs
    {
        public tl_blob blob;
        public uint slot_count;
        public uint polygon_count;
        public uint words;
        public float eye_height;
        public ulong first;
        public ulong rows;
        public ulong pair_count;
        public ulong reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_cover_request
    {
        public tl_navmesh* navmesh;
        public tl_soup* soup;
        public tl_nav_filter* filter;
        public tl_nav_location agent;
        public tl_vec3 threat;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_cover_def
    {
        public fixed float heights[8];
        public uint height_count;
        public float spacing;
        public float max_length;
        public tl_ray_filter* sight_filter;
        public uint cookie;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_cover
    {
        public tl_nav_location location;
        public float length;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_polygon_state
    {
        public ulong flags;
        public byte area;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_versions
    {
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_versions_state
    {
        public uint version_count;
        public ulong newest;
        public ulong oldest;
        public ulong waiting_bytes;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_wide_path
    {
        public tl_nav_wide_status status;
        public uint corner_count;
        public double wall_distance;
        public double length;
        public double surface_length;
        public uint node_count;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_wide_def
    {
        public float max_radius;
        public uint cookie;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_nav_wide_report
    {
        public tl_report @base;
        public ulong bytes;
        public ulong wall_count;
        public uint tile_count;
        public uint made_tile_count;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_scene_placement
    {
        public uint group;
        public tl_transform pose;
        public float scale;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_scene_group
    {
        public tl_scene_instance* instances;
        public uint instance_count;
        public tl_scene_placement* placements;
        public uint placement_count;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_scene_copy
    {
        public tl_transform pose;
        public float scale;
        public uint group;
        public uint parent;
        public uint placement;
        public uint first_instance;
        public uint instance_count;
        public uint copy_count;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_scene_expansion
    {
        public tl_scene_instance* instances;
        public uint instance_count;
        public tl_scene_copy* copies;
        public uint copy_count;
        public tl_allocator allocator;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_scene_versions
    {
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_scene_version
    {
        public tl_scene* scene;
        public tl_scene_instance* instances;
        public uint count;
        public ulong number;
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tl_scene_versions_state
    {
        public uint version_count;
        public ulong newest;
        public ulong oldest;
    }

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate void tl_task_fn(uint a0, uint a1, void* a2);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate tl_vec3 tl_convex_support_fn(tl_vec3 a0, void* a1);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate byte tl_triangle_filter_fn(uint a0, ushort a1, void* a2);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate byte tl_soup_triangle_fn(tl_soup_triangle* a0, void* a1);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate byte tl_soup_bvh_box_fn(tl_aabb a0, uint a1, byte a2, void* a3);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate byte tl_instance_filter_fn(uint a0, void* a1);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate byte tl_scene_instance_fn(uint a0, void* a1);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate byte tl_nav_pass_fn(tl_nav_tile* a0, uint a1, void* a2);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate float tl_nav_cost_fn(tl_nav_tile* a0, uint a1, tl_vec3 a2, tl_vec3 a3, float a4, void* a5);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate tl_result tl_write_fn(void* a0, UIntPtr a1, void* a2);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate tl_result tl_pack_fetch_fn(uint a0, void** a1, void* a2);

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public unsafe delegate tl_result tl_nav_world_read_fn(ulong a0, void* a1, UIntPtr a2, void* a3);

    public static unsafe partial class Api
    {
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte* tl_result_name(tl_result result);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte* tl_result_text(tl_result result);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte* tl_version();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_blob_free(void* blob);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_halfedge_mesh_init(tl_halfedge_mesh* mesh, tl_allocator* allocator);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_halfedge_mesh_destroy(tl_halfedge_mesh* mesh);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_halfedge_mesh_clear(tl_halfedge_mesh* mesh);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_halfedge_mesh_add_vertex(tl_halfedge_mesh* mesh, tl_vec3 position, uint* vertex_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_halfedge_mesh_remove_vertex(tl_halfedge_mesh* mesh, uint vertex);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_halfedge_mesh_add_face(tl_halfedge_mesh* mesh, uint* vertices, uint count, uint* face_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_halfedge_mesh_add_triangle(tl_halfedge_mesh* mesh, uint a, uint b, uint c, uint* face_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_halfedge_mesh_remove_face(tl_halfedge_mesh* mesh, uint face);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint tl_halfedge_mesh_find_edge(tl_halfedge_mesh* mesh, uint from, uint to);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint tl_halfedge_mesh_vertex_edges(tl_halfedge_mesh* mesh, uint vertex, uint* edges_out, uint capacity);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint tl_halfedge_mesh_vertex_neighbours(tl_halfedge_mesh* mesh, uint vertex, uint* vertices_out, uint capacity);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint tl_halfedge_mesh_vertex_faces(tl_halfedge_mesh* mesh, uint vertex, uint* faces_out, uint capacity);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint tl_halfedge_mesh_face_vertices(tl_halfedge_mesh* mesh, uint face, uint* vertices_out, uint capacity);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint tl_halfedge_mesh_next_boundary_loop(tl_halfedge_mesh* mesh, uint from);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_halfedge_mesh_check(tl_halfedge_mesh* mesh, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint tl_halfedge_mesh_support(tl_halfedge_mesh* mesh, tl_vec3 direction, uint hint);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_hull_def tl_default_hull_def();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_hull_bake(tl_vec3* points, uint count, tl_hull_def* def, tl_hull** hull_out, tl_hull_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_hull_transform(tl_hull* hull, tl_vec3 scale, tl_transform pose, tl_host* host, tl_hull** hull_out, tl_hull_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_hull_to_halfedge(tl_hull* hull, tl_halfedge_mesh* mesh);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_hull_check(void* bytes, ulong size, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_hull_validate(tl_hull* hull, tl_vec3* points, uint count, tl_hull_validation* validation_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint tl_hull_support(tl_hull* hull, tl_vec3 direction, uint hint);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_hull_cast_ray(tl_hull* hull, tl_vec3 origin, tl_vec3 direction, float max_t, tl_hull_hit* hit_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_hull_clip_ray(tl_hull* hull, double* origin, double* direction, double max_t, double* t_out, uint* face_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_hull_contains(tl_hull* hull, tl_vec3 point);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_convex tl_convex_from_hull(tl_hull* hull, float radius);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_convex tl_convex_from_points(tl_vec3* points, uint count, float radius);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_convex tl_convex_box(tl_vec3 center, tl_vec3 half_extents, float radius);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_convex tl_convex_sphere(tl_vec3 center, float radius);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_convex tl_convex_capsule(tl_vec3 a, tl_vec3 b, float radius);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_convex tl_convex_triangle(tl_vec3 a, tl_vec3 b, tl_vec3 c, float radius);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_convex tl_convex_cylinder(tl_vec3 a, tl_vec3 b, float disc_radius, float radius);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_convex tl_convex_cone(tl_vec3 @base, tl_vec3 apex, float disc_radius, float radius);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_convex tl_convex_custom(IntPtr support, void* user, float radius);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_aabb tl_convex_bounds(tl_convex* shape, tl_transform pose);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_convex_distance(tl_convex* a, tl_transform pose_a, tl_convex* b, tl_transform pose_b, tl_simplex_cache* cache, tl_separation* separation_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_convex_overlap(tl_convex* a, tl_transform pose_a, tl_convex* b, tl_transform pose_b, tl_simplex_cache* cache);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_convex_penetration(tl_convex* a, tl_transform pose_a, tl_convex* b, tl_transform pose_b, tl_simplex_cache* cache, tl_penetration* penetration_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_convex_penetration_within(tl_convex* a, tl_transform pose_a, tl_convex* b, tl_transform pose_b, tl_simplex_cache* cache, uint max_steps, tl_penetration* penetration_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_convex_cast(tl_convex* a, tl_transform pose_a, tl_convex* b, tl_transform pose_b, tl_vec3 motion, tl_convex_hit* hit_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_convex_cast_turning(tl_convex* a, tl_transform pose_a, tl_convex* b, tl_transform from, tl_transform to, float gap, tl_convex_hit* hit_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_convex_cast_ray(tl_convex* shape, tl_transform pose, tl_vec3 origin, tl_vec3 direction, float t_max, tl_convex_hit* hit_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint tl_convex_contacts(tl_convex* a, tl_transform pose_a, tl_convex* b, tl_transform pose_b, tl_contact_limits* limits, tl_contact_cache* cache, tl_contact_manifold* manifold_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint tl_convex_contacts_along(tl_convex* a, tl_transform pose_a, tl_convex* b, tl_transform pose_b, tl_vec3 normal, tl_contact_limits* limits, tl_contact_manifold* manifold_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_scaled_convex_make(tl_convex* shape, tl_vec3 scale, tl_scaled_convex* scaled_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_mesh_def tl_default_mesh_def();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_mesh_bake(tl_mesh_view* view, tl_mesh_def* def, tl_mesh* mesh_out, tl_mesh_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_mesh_free(tl_mesh* mesh);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_mesh_view tl_mesh_as_view(tl_mesh* mesh);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_adjacency_bake(tl_mesh_view* view, tl_host* host, tl_adjacency* adjacency_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_adjacency_free(tl_adjacency* adjacency);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_closed_parts_find(tl_mesh_view* view, tl_host* host, tl_closed_parts* parts_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_closed_parts_free(tl_closed_parts* parts);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_soup_def tl_default_soup_def();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_soup_bake(tl_mesh_view* view, tl_soup_def* def, tl_soup** soup_out, tl_soup_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_soup_refit(tl_soup* soup, tl_mesh_view* moved, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_soup_check(void* bytes, ulong size, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern ulong tl_soup_size(tl_soup* soup);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_aabb tl_soup_bounds(tl_soup* soup);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_soup_stats tl_soup_get_stats(tl_soup* soup);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_soup_cast_ray(tl_soup* soup, tl_ray* ray, tl_ray_filter* filter, tl_ray_hit* hit_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_soup_occluded(tl_soup* soup, tl_ray* ray, tl_ray_filter* filter);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_soup_cast_segment(tl_soup* soup, tl_vec3 a, tl_vec3 b, tl_ray_filter* filter, tl_ray_hit* hit_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_soup_line_of_sight(tl_soup* soup, tl_vec3 a, tl_vec3 b, tl_ray_filter* filter);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_soup_cast_rays(tl_soup* soup, tl_ray* rays, uint count, tl_ray_filter* filter, tl_host* host, tl_ray_hit* hits_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_soup_cast_segments(tl_soup* soup, tl_segment* segments, uint count, tl_ray_filter* filter, tl_host* host, tl_ray_hit* hits_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_soup_occluded_rays(tl_soup* soup, tl_ray* rays, uint count, tl_ray_filter* filter, tl_host* host, byte* occluded_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_soup_lines_of_sight(tl_soup* soup, tl_segment* segments, uint count, tl_ray_filter* filter, tl_host* host, byte* clear_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_soup_cast_ray_all(tl_soup* soup, tl_ray* ray, tl_hit_rule rule, tl_ray_filter* filter, tl_ray_hit* hits_out, uint capacity, uint* count_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_soup_nearest(tl_soup* soup, tl_vec3 point, float max_distance, tl_ray_filter* filter, tl_soup_point* nearest_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_soup_overlaps(tl_soup* soup, tl_convex* shape, tl_transform pose, tl_ray_filter* filter, byte* overlaps_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_soup_find_overlaps(tl_soup* soup, tl_convex* shape, tl_transform pose, tl_ray_filter* filter, uint* triangles_out, uint capacity, uint* count_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_soup_cast_shape(tl_soup* soup, tl_convex* shape, tl_transform pose, tl_vec3 motion, tl_ray_filter* filter, tl_shape_hit* hit_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_soup_find_contacts(tl_soup* soup, tl_soup_contact_query* query, tl_soup_contact* contacts_out, uint capacity, uint* count_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_soup_locate(tl_soup* soup, tl_vec3 point, tl_soup_location* location_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_soup_check_closed(tl_soup* soup, tl_host* host, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_soup_next_triangle(tl_soup* soup, ulong* cursor, tl_soup_triangle* triangle_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_soup_next_pair(tl_soup* soup, ulong* cursor, tl_soup_pair* pair_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_soup_triangles_in_box(tl_soup* soup, tl_aabb box, IntPtr found, void* user);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_soup_bvh_boxes(tl_soup* soup, uint max_depth, IntPtr visit, void* user);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_scaled_soup_nearest(tl_scaled_soup* scaled, tl_vec3 point, float max_distance, tl_ray_filter* filter, tl_soup_point* nearest_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_scaled_soup_overlaps(tl_scaled_soup* scaled, tl_convex* shape, tl_transform pose, tl_ray_filter* filter, byte* overlaps_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_scaled_soup_find_overlaps(tl_scaled_soup* scaled, tl_convex* shape, tl_transform pose, tl_ray_filter* filter, uint* triangles_out, uint capacity, uint* count_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_scaled_soup_cast_shape(tl_scaled_soup* scaled, tl_convex* shape, tl_transform pose, tl_vec3 motion, tl_ray_filter* filter, tl_shape_hit* hit_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_scene_bake(tl_scene_instance* instances, uint count, tl_host* host, tl_scene** scene_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_scene_refit(tl_scene* scene, tl_scene_instance* instances, uint count, float* growth_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_aabb tl_scene_bounds(tl_scene* scene);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_scene_stats tl_scene_get_stats(tl_scene* scene);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_scene_cast_ray(tl_scene* scene, tl_scene_instance* instances, tl_ray* ray, tl_scene_filter* filter, tl_scene_hit* hit_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_scene_occluded(tl_scene* scene, tl_scene_instance* instances, tl_ray* ray, tl_scene_filter* filter);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_scene_line_of_sight(tl_scene* scene, tl_scene_instance* instances, tl_vec3 a, tl_vec3 b, tl_scene_filter* filter);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_scene_cast_shape(tl_scene* scene, tl_scene_instance* instances, tl_convex* shape, tl_transform pose, tl_vec3 motion, tl_scene_filter* filter, tl_scene_shape_hit* hit_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_scene_overlaps(tl_scene* scene, tl_scene_instance* instances, tl_scene_overlap_query* query, byte* overlaps_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_scene_find_overlaps(tl_scene* scene, tl_scene_instance* instances, tl_scene_overlap_query* query, tl_scene_overlap* overlaps_out, uint capacity, uint* count_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_scene_nearest(tl_scene* scene, tl_scene_instance* instances, tl_vec3 point, float max_distance, tl_scene_filter* filter, tl_scene_point* nearest_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_scene_instances_in_box(tl_scene* scene, tl_aabb box, tl_scene_filter* filter, IntPtr found, void* user);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_character_def tl_default_character_def();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_character_mover_create(tl_character_def* def, tl_character_mover** mover_out, tl_report* report);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_character_mover_destroy(tl_character_mover* mover);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_character_move(tl_character_mover* mover, tl_character_level* level, tl_character_step* step, tl_character* character, tl_character_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_decompose_def tl_default_decompose_def();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_decomposition_bake(tl_mesh_view* view, tl_decompose_def* def, tl_decomposition* decomposition_out, tl_decompose_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_decomposition_free(tl_decomposition* decomposition);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_polygon_def tl_default_polygon_def();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_polygon_mesh_bake(tl_contour_set* contours, tl_polygon_def* def, tl_polygon_mesh* mesh_out, tl_polygon_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_polygon_mesh_free(tl_polygon_mesh* mesh);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_polygon_quality tl_polygon_mesh_measure(tl_polygon_mesh* mesh);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte* tl_polygon_fault_text(tl_polygon_fault fault);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_polygon_mesh_check(tl_polygon_mesh* mesh, tl_contour_set* contours, tl_allocator* allocator, tl_polygon_check_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_detail_free(tl_nav_detail* detail);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_tile_encode(tl_nav_tile_source* source, tl_allocator* allocator, tl_nav_tile** tile_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_tile_subset(tl_nav_tile* tile, byte* keep, tl_allocator* allocator, tl_nav_tile** tile_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_tile_stack_free(tl_nav_tile_stack* stack);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_tile_divide(tl_nav_tile* tile, uint* layers, tl_allocator* allocator, tl_nav_tile_stack* stack_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_tile_check(void* bytes, ulong size, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint tl_nav_tile_neighbour(tl_nav_tile* tile, uint polygon, uint edge);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_tile_fit_boxes(tl_nav_tile* tile);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_tile_copy(tl_nav_tile* tile, byte has_wide_flags, tl_allocator* allocator, tl_nav_tile** copy_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern double tl_nav_tile_polygon_area(tl_nav_tile* tile, uint polygon);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_create(tl_allocator* allocator, tl_navmesh** navmesh_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_reserve_tiles(tl_navmesh* navmesh, uint count);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_navmesh_destroy(tl_navmesh* navmesh);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_add_tile(tl_navmesh* navmesh, tl_nav_tile* tile, tl_nav_tile_ownership ownership);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_add_tiles(tl_navmesh* navmesh, tl_nav_tile** tiles, uint count, tl_nav_tile_ownership ownership, tl_report* report);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_remove_tile(tl_navmesh* navmesh, int tile_x, int tile_z);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_remove_layer(tl_navmesh* navmesh, int tile_x, uint layer, int tile_z);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_replace_tiles(tl_navmesh* navmesh, int tile_x, int tile_z, tl_nav_tile_stack* stack);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_tile* tl_navmesh_find_tile(tl_navmesh* navmesh, int tile_x, int tile_z);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_tile* tl_navmesh_find_layer(tl_navmesh* navmesh, int tile_x, uint layer, int tile_z);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint tl_navmesh_tile_count(tl_navmesh* navmesh);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint tl_navmesh_slot_count(tl_navmesh* navmesh);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_tile* tl_navmesh_slot_tile(tl_navmesh* navmesh, uint slot);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern ulong tl_navmesh_link_count(tl_navmesh* navmesh);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern ulong tl_navmesh_edit_count(tl_navmesh* navmesh);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern ulong tl_navmesh_polygon_ref(tl_navmesh* navmesh, uint slot, uint polygon);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_resolve(tl_navmesh* navmesh, ulong @ref, tl_nav_tile** tile_out, uint* polygon_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_links(tl_navmesh* navmesh, ulong @ref, tl_nav_link* links_out, uint capacity, uint* count_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_island(tl_navmesh* navmesh, ulong @ref, uint* island_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_offmesh tl_default_nav_offmesh();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_add_offmesh(tl_navmesh* navmesh, tl_nav_offmesh* offmesh, ulong* link_out, tl_report* report);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_reserve_offmesh(tl_navmesh* navmesh, uint count);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_remove_offmesh(tl_navmesh* navmesh, ulong link);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_offmesh_state(tl_navmesh* navmesh, ulong link, tl_nav_offmesh_state* state_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint tl_navmesh_offmesh_count(tl_navmesh* navmesh);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_navmesh_next_offmesh(tl_navmesh* navmesh, uint* cursor, ulong* link_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_offmesh_from(tl_navmesh* navmesh, ulong polygon, ulong* links_out, uint capacity, uint* count_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_filter tl_default_nav_filter();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_nav_filter_passes(tl_nav_filter* filter, tl_nav_tile* tile, uint polygon);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_find_nearest(tl_navmesh* navmesh, tl_nav_filter* filter, tl_vec3 center, tl_vec3 half_extents, tl_nav_location* location_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_find_nearest_reachable(tl_navmesh* navmesh, tl_nav_filter* filter, ulong from, tl_vec3 point, tl_nav_location* location_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_closest_point(tl_navmesh* navmesh, ulong @ref, tl_vec3 point, tl_vec3* closest_out, byte* inside_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_height(tl_navmesh* navmesh, ulong @ref, float x, float z, float* height_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_query_def tl_default_nav_query_def();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_query_create(tl_nav_query_def* def, tl_nav_query** query_out, tl_report* report);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_query_destroy(tl_nav_query* query);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_query_reserve(tl_nav_query* query, uint nodes);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte* tl_nav_path_status_name(tl_nav_path_status status);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_query_find_path(tl_nav_query* query, tl_navmesh* navmesh, tl_nav_path_request* request, ulong* polygons_out, uint capacity, tl_nav_path* path_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_query_begin_path(tl_nav_query* query, tl_navmesh* navmesh, tl_nav_path_request* request);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_query_step_path(tl_nav_query* query, uint max_steps, tl_nav_path_progress* progress_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_query_write_path(tl_nav_query* query, ulong* polygons_out, uint capacity, tl_nav_path* path_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_straight_path(tl_navmesh* navmesh, tl_nav_polygon_path* path, tl_nav_corner* corners_out, uint capacity, uint* count_out, float* length_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_trace_path(tl_navmesh* navmesh, tl_nav_trace_request* request, tl_nav_trace_point* points_out, uint capacity, uint* count_out, float* cost_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_query_find_shortest_path(tl_nav_query* query, tl_navmesh* navmesh, tl_nav_path_request* request, tl_nav_path_buffers* buffers, tl_nav_shortest_path* path_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_cast_ray(tl_navmesh* navmesh, tl_nav_filter* filter, tl_nav_location* start, tl_vec3 end, ulong* polygons_out, uint capacity, tl_nav_ray_hit* hit_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_query_move_along_surface(tl_nav_query* query, tl_navmesh* navmesh, tl_nav_move_request* request, ulong* polygons_out, uint capacity, tl_nav_move* move_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_query_find_wall(tl_nav_query* query, tl_navmesh* navmesh, tl_nav_around_request* request, tl_nav_wall* wall_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_query_find_route(tl_nav_query* query, tl_navmesh* navmesh, tl_nav_route_request* request, tl_nav_path_buffers* buffers, tl_nav_route* route_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_zone tl_nav_zone_circle(tl_vec3 center, float radius);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_zone tl_nav_zone_polygon(tl_vec3* points, uint point_count);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_find_polygons(tl_navmesh* navmesh, tl_nav_filter* filter, tl_nav_zone* zone, tl_nav_height_range* heights, ulong* polygons_out, uint capacity, uint* count_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_field_def tl_default_nav_field_def();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_query_flood(tl_nav_query* query, tl_navmesh* navmesh, tl_nav_location* start, tl_nav_field_def* def, tl_nav_field_entry* entries_out, uint capacity, uint* count_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint tl_nav_field_find(tl_nav_field_entry* entries, uint count, ulong polygon);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_field_path(tl_nav_field_entry* entries, uint count, uint entry, ulong* polygons_out, uint capacity, uint* count_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_query_find_goal_tree(tl_nav_query* query, tl_navmesh* navmesh, tl_nav_filter* filter, tl_nav_goal_tree* tree);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_goal_tree_path(tl_nav_goal_tree* tree, tl_navmesh* navmesh, tl_nav_goal_path_request* request, ulong* polygons_out, uint capacity, tl_nav_path* path_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_polygon_walls(tl_navmesh* navmesh, tl_nav_filter* filter, ulong polygon, tl_nav_wall_segment* segments_out, uint capacity, uint* count_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_query_find_walls(tl_nav_query* query, tl_navmesh* navmesh, tl_nav_around_request* request, tl_nav_wall_segment* segments_out, uint capacity, uint* count_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_random_point(tl_navmesh* navmesh, tl_nav_filter* filter, ulong* random, tl_nav_location* location_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_query_random_reachable(tl_nav_query* query, tl_navmesh* navmesh, tl_nav_around_request* request, ulong* random, tl_nav_location* location_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_query_random_reachable_points(tl_nav_query* query, tl_navmesh* navmesh, tl_nav_around_request* request, ulong* random, uint count, tl_nav_location* locations_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_def tl_default_nav_def();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_tile_grid(tl_nav_def* def, tl_aabb level_bounds, uint* tiles_x_out, uint* tiles_z_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_config_from_def(tl_nav_def* def, tl_aabb level_bounds, uint tile_x, uint tile_z, tl_nav_config* config_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_rasterize(tl_nav_config* config, tl_mesh_view* mesh, byte* areas, tl_host* host, tl_nav_heightfield* heightfield_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_heightfield_free(tl_nav_heightfield* heightfield);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_filter_low_hanging_obstacles(tl_nav_config* config, tl_nav_heightfield* heightfield);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_filter_ledge_spans(tl_nav_config* config, tl_nav_heightfield* heightfield);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_filter_walkable_low_height_spans(tl_nav_config* config, tl_nav_heightfield* heightfield);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_bake_compact(tl_nav_config* config, tl_nav_heightfield* heightfield, tl_host* host, tl_nav_compact* compact_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_filter_and_compact(tl_nav_config* config, tl_nav_heightfield* heightfield, tl_host* host, tl_nav_compact* compact_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_compact_free(tl_nav_compact* compact);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_erode(tl_nav_config* config, tl_host* host, tl_nav_compact* compact, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_mark_box_area(tl_nav_compact* compact, tl_aabb box, byte area);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_mark_polygon_area(tl_nav_compact* compact, tl_vec3* points, uint count, float min_y, float max_y, byte area);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_mark_cylinder_area(tl_nav_compact* compact, tl_vec3 @base, float radius, float height, byte area);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_distance_field(tl_host* host, tl_nav_compact* compact, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_bake_regions(tl_nav_config* config, tl_host* host, tl_nav_compact* compact, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_bake_contours(tl_nav_config* config, tl_nav_compact* compact, tl_host* host, tl_nav_contours* contours_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_contours_free(tl_nav_contours* contours);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_bake_detail(tl_nav_config* config, tl_nav_compact* compact, tl_polygon_mesh* polygons, tl_host* host, tl_nav_detail* detail_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_mark_volume_area(tl_nav_compact* compact, tl_nav_volume* volume);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_areas_from_materials(tl_mesh_view* mesh, byte* material_areas, uint material_count, byte* areas_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_stages_free(tl_nav_stages* stages);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_assign_layers(tl_nav_config* config, tl_polygon_mesh* polygons, tl_allocator* allocator, uint* layers_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_tile_bake(tl_nav_config* config, tl_nav_input* input, tl_host* host, tl_nav_stages* stages_out, tl_nav_tile** tile_out, tl_nav_bake_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_tile_bake_from_compact(tl_nav_config* config, tl_nav_compact* compact, tl_host* host, tl_nav_tile_stack* stack_out, tl_nav_bake_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_tile_rebake(tl_nav_config* config, tl_nav_compact* compact, byte* base_area, tl_nav_tile_memo** memo, tl_host* host, tl_nav_tile_stack* stack_out, tl_nav_bake_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_nav_tile_keeps_bytes(tl_nav_config* config, tl_nav_compact* compact, byte* area_before);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_tile_memo_free(tl_nav_tile_memo* memo);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern ulong tl_nav_tile_memo_bytes(tl_nav_tile_memo* memo);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_bake(tl_nav_def* def, tl_nav_input* input, tl_nav_tiles* tiles_out, tl_nav_bake_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_tiles_free(tl_nav_tiles* tiles);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_tiles_in_box(tl_nav_def* def, tl_aabb level_bounds, tl_aabb box, tl_nav_tile_range* range_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_bake_range(tl_nav_def* def, tl_nav_input* input, tl_nav_tile_range range, tl_nav_stage_sink* sink, tl_nav_tile_block* block_out, tl_nav_bake_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_rebake(tl_nav_def* def, tl_nav_input* input, tl_aabb changed, tl_nav_tile_block* block_out, tl_nav_bake_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_tile_block_free(tl_nav_tile_block* block);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_triangles_create(tl_nav_def* def, tl_mesh_view* mesh, tl_nav_triangles** triangles_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_triangles_destroy(tl_nav_triangles* triangles);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_triangles_change(tl_nav_triangles* triangles, tl_mesh_view* mesh, uint* changed, uint changed_count, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_triangles_near(tl_nav_triangles* triangles, tl_nav_input* input, tl_aabb changed, tl_nav_near_triangles* near_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern ulong tl_nav_triangles_bytes(tl_nav_triangles* triangles);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_prune_def tl_default_nav_prune_def();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_prune(tl_nav_prune_def* def, tl_nav_tiles* tiles, tl_nav_tiles* removed_out, tl_nav_prune_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_probe tl_nav_probe_from_config(tl_nav_config* config);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_audit_def tl_default_nav_audit_def();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte* tl_nav_finding_name(tl_nav_finding_kind kind);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_audit_run(tl_nav_audit_def* def, tl_navmesh* navmesh, tl_soup* soup, tl_nav_audit* audit_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_audit_free(tl_nav_audit* audit);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte* tl_nav_cause_name(tl_nav_cause cause);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte* tl_nav_cause_text(tl_nav_cause cause);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_why(tl_nav_def* def, tl_nav_input* input, tl_navmesh* navmesh, tl_nav_pruning* pruning, tl_vec3 point, tl_nav_why_answer* answer_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_corridor tl_nav_corridor_init(ulong* path, uint capacity);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_corridor_reset(tl_nav_corridor* corridor, tl_nav_location* at);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_corridor_find(tl_nav_corridor* corridor, tl_nav_query* query, tl_navmesh* navmesh, tl_nav_filter* filter, tl_nav_location* goal, tl_nav_path* path_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_corridor_set_path(tl_nav_corridor* corridor, tl_navmesh* navmesh, ulong* path, uint count, tl_vec3 target);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_corridor_corners(tl_nav_corridor* corridor, tl_navmesh* navmesh, tl_nav_corner* corners_out, uint capacity, uint* count_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_corridor_move(tl_nav_corridor* corridor, tl_nav_query* query, tl_navmesh* navmesh, tl_nav_filter* filter, tl_vec3 to);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_corridor_move_target(tl_nav_corridor* corridor, tl_nav_query* query, tl_navmesh* navmesh, tl_nav_filter* filter, tl_vec3 to);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_corridor_pass_link(tl_nav_corridor* corridor, tl_navmesh* navmesh, tl_nav_location* ends_out, ulong* link_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_corridor_shorten(tl_nav_corridor* corridor, tl_navmesh* navmesh, tl_nav_filter* filter, float range, byte* changed_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_corridor_improve(tl_nav_corridor* corridor, tl_nav_query* query, tl_navmesh* navmesh, tl_nav_filter* filter, uint ahead, uint max_steps, byte* changed_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint tl_nav_corridor_check(tl_nav_corridor* corridor, tl_navmesh* navmesh, tl_nav_filter* filter, uint max_count);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_corridor_repair(tl_nav_corridor* corridor, tl_nav_query* query, tl_navmesh* navmesh, tl_nav_filter* filter, tl_vec3 half_extents, tl_nav_path* path_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_crowd_def tl_default_nav_crowd_def();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_crowd_create(tl_nav_crowd_def* def, tl_nav_crowd** crowd_out, tl_report* report);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_crowd_destroy(tl_nav_crowd* crowd);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_crowd_set_filter(tl_nav_crowd* crowd, uint place, tl_nav_filter* filter);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_agent_def tl_default_nav_agent_def();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte* tl_nav_agent_status_name(tl_nav_agent_status status);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_crowd_add(tl_nav_crowd* crowd, tl_navmesh* navmesh, tl_nav_agent_def* def, ulong* agent_out, tl_report* report);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_crowd_remove(tl_nav_crowd* crowd, ulong agent);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_crowd_set_goal(tl_nav_crowd* crowd, ulong agent, tl_nav_location* goal);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_crowd_set_motion(tl_nav_crowd* crowd, ulong agent, tl_vec3 position, tl_vec3 velocity);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_crowd_agent(tl_nav_crowd* crowd, ulong agent, tl_nav_agent_state* state_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_crowd_corners(tl_nav_crowd* crowd, tl_navmesh* navmesh, ulong agent, tl_nav_corner* corners_out, uint capacity, uint* count_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint tl_nav_crowd_count(tl_nav_crowd* crowd);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_nav_crowd_next(tl_nav_crowd* crowd, uint* cursor, ulong* agent_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte* tl_nav_formation_name(tl_nav_formation formation);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_group_def tl_default_nav_group_def();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_crowd_add_group(tl_nav_crowd* crowd, tl_nav_group_def* def, ulong* agents, uint count, ulong* group_out, tl_report* report);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_crowd_remove_group(tl_nav_crowd* crowd, ulong group);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_crowd_set_formation(tl_nav_crowd* crowd, ulong group, tl_nav_group_def* def, tl_report* report);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_crowd_group(tl_nav_crowd* crowd, ulong group, tl_nav_group_state* state_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_crowd_members(tl_nav_crowd* crowd, ulong group, ulong* agents_out, uint capacity, uint* count_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern ulong tl_nav_crowd_group_of(tl_nav_crowd* crowd, ulong agent);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_crowd_step(tl_nav_crowd* crowd, tl_navmesh* navmesh, float dt, tl_nav_crowd_step_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern UIntPtr tl_nav_crowd_state_size(tl_nav_crowd* crowd);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_crowd_save(tl_nav_crowd* crowd, void* bytes_out, UIntPtr capacity);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_crowd_restore(tl_nav_crowd* crowd, void* bytes, UIntPtr size, tl_report* report);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern ulong tl_nav_crowd_hash(tl_nav_crowd* crowd);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern ulong tl_detour_tile_size(tl_nav_tile* tile, tl_detour_refs refs);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern ulong tl_detour_set_size(tl_nav_tile** tiles, uint tile_count, tl_detour_refs refs);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_detour_tile_write(tl_nav_tile* tile, tl_detour_refs refs, void* bytes, ulong capacity, tl_detour_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_detour_set_write(tl_nav_tile** tiles, uint tile_count, tl_detour_refs refs, void* bytes, ulong capacity, tl_detour_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_detour_read_def tl_default_detour_read_def();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_detour_read(void* bytes, ulong size, tl_detour_read_def* def, tl_detour_tiles* tiles_out, tl_detour_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_detour_tiles_free(tl_detour_tiles* tiles);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_detour_read_off_mesh(void* bytes, ulong size, tl_detour_off_mesh* links_out, uint capacity, uint* count_out, tl_detour_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern ulong tl_detour_linked_set_size(tl_detour_set* set);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_detour_linked_set_write(tl_detour_set* set, void* bytes, ulong capacity, tl_detour_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte* tl_nav_link_kind_name(tl_nav_link_kind kind);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_links_def tl_default_nav_links_def();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_links_find(tl_nav_links_def* def, tl_navmesh* navmesh, tl_soup* soup, tl_nav_links** links_out, tl_nav_links_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_links_check(void* bytes, ulong size, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_links_add(tl_nav_links* links, tl_nav_offmesh* prototype, tl_navmesh* navmesh);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_vec3 tl_nav_jump_link_point(tl_nav_jump_link* link, float t);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_obstacles_bake(tl_nav_def* def, tl_nav_input* input, tl_nav_obstacles** obstacles_out, tl_nav_tile_block* block_out, tl_nav_bake_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_obstacles_destroy(tl_nav_obstacles* obstacles);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_obstacles_set_tasks(tl_nav_obstacles* obstacles, tl_tasks* tasks);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_obstacles_add(tl_nav_obstacles* obstacles, tl_nav_obstacle* obstacle, ulong* id_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_obstacles_move(tl_nav_obstacles* obstacles, ulong id, tl_nav_obstacle* obstacle, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_obstacles_remove(tl_nav_obstacles* obstacles, ulong id);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint tl_nav_obstacles_count(tl_nav_obstacles* obstacles);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint tl_nav_obstacles_waiting(tl_nav_obstacles* obstacles);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern ulong tl_nav_obstacles_bytes(tl_nav_obstacles* obstacles);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_obstacles_rebake(tl_nav_obstacles* obstacles, tl_nav_input* input, tl_aabb changed, tl_nav_bake_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_obstacles_bake_next(tl_nav_obstacles* obstacles, tl_nav_rebaked_tile* rebaked_out, tl_nav_bake_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_obstacles_update(tl_nav_obstacles* obstacles, tl_navmesh* navmesh, uint max_tiles, uint* waiting_out, tl_nav_bake_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_prepare_def tl_default_nav_prepare_def();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte* tl_nav_prepared_kind_name(tl_nav_prepared_kind kind);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_prepare(tl_navmesh* navmesh, tl_nav_prepare_def* def, tl_nav_prepared* prepared_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_navmesh_is_prepared(tl_navmesh* navmesh);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_pack_write(tl_pack_item* items, uint count, tl_allocator* allocator, IntPtr write, void* user, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern ulong tl_pack_size(tl_pack_item* items, uint count);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_pack_open(void* bytes, ulong size, tl_pack* pack_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_pack_to_host_order(void* bytes, ulong size, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_blob_to_file_order(void* bytes, ulong size, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_blob_to_host_order(void* bytes, ulong size, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_pack_chunk tl_pack_chunk_at(tl_pack* pack, uint index);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_pack_find(tl_pack* pack, uint type, uint id, tl_pack_chunk* chunk_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint tl_pack_count(tl_pack* pack, uint type);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_pack_index_size(void* head, ulong* size_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_pack_index_open(void* bytes, ulong size, tl_pack_index* index_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_pack_entry_open(tl_pack_entry* entry, void* bytes, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_pack_entry_make(uint type, uint id, void* bytes, ulong size, tl_pack_entry* entry_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_pack_write_fetched(tl_pack_entry* entries, uint count, tl_allocator* allocator, IntPtr fetch, IntPtr write, void* user, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_pack_meta_encode(byte* source_name, ulong source_vertices, ulong source_triangles, tl_aabb bounds, tl_allocator* allocator, tl_pack_meta** meta_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_pack_meta_check(void* bytes, ulong size, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte* tl_pack_meta_name(tl_pack_meta* meta);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_pack_frame_encode(tl_pack_axes axes, double* origin, tl_allocator* allocator, tl_pack_frame** frame_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_pack_frame_check(void* bytes, ulong size, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_vec3 tl_pack_place_in(tl_pack_frame* frame, double* point);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_pack_place_out(tl_pack_frame* frame, tl_vec3 point, double* @out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_vec3 tl_pack_turn_in(tl_pack_axes axes, tl_vec3 v);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_vec3 tl_pack_turn_out(tl_pack_axes axes, tl_vec3 v);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_pack_navmesh_encode(tl_nav_def* def, uint tiles_x, uint tiles_z, uint tile_count, tl_allocator* allocator, tl_pack_navmesh** navmesh_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_pack_navmesh_check(void* bytes, ulong size, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_def tl_pack_navmesh_def(tl_pack_navmesh* navmesh);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_pack_volumes_encode(tl_nav_volume* volumes, uint count, tl_allocator* allocator, tl_pack_volumes** volumes_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_pack_volumes_check(void* bytes, ulong size, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_volume tl_pack_volumes_at(tl_pack_volumes* volumes, uint index);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_pack_pruning_encode(tl_nav_prune_def* def, tl_allocator* allocator, tl_pack_pruning** pruning_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_pack_pruning_check(void* bytes, ulong size, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_vec3* tl_pack_pruning_seeds(tl_pack_pruning* pruning);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_pack_offmesh_encode(tl_nav_offmesh* links, uint count, tl_allocator* allocator, tl_pack_offmesh** offmesh_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_pack_offmesh_check(void* bytes, ulong size, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_offmesh tl_pack_offmesh_at(tl_pack_offmesh* offmesh, uint index);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_pack_areas_encode(byte* areas, uint count, tl_allocator* allocator, tl_pack_areas** areas_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_pack_areas_check(void* bytes, ulong size, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte* tl_pack_areas_array(tl_pack_areas* areas);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_pack_load_navmesh(tl_pack* pack, tl_allocator* allocator, tl_navmesh** navmesh_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_pack_load_pruned(tl_pack* pack, tl_allocator* allocator, tl_navmesh** navmesh_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_world_def tl_default_nav_world_def();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_world_create(tl_nav_world_def* def, tl_nav_world** world_out, tl_report* report);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_pack_index* tl_nav_world_index(tl_nav_world* world);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_world_destroy(tl_nav_world* world);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_world_update(tl_nav_world* world, tl_nav_world_interest* interests, uint count, uint max_changes);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_world_begin_load(tl_nav_world* world, tl_nav_world_load* load_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_world_run_load(tl_nav_world_load* load);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_world_end_load(tl_nav_world_load* load);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_world_get_state(tl_nav_world* world, tl_nav_world_state* state_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_vec3 tl_nav_world_place_in(tl_nav_world* world, double* point);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_world_place_out(tl_nav_world* world, tl_vec3 point, double* @out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_navmesh* tl_nav_world_navmesh(tl_nav_world* world);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_world_covers(tl_nav_world* world, double* center, double radius);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_world_find_nearest(tl_nav_world* world, tl_nav_filter* filter, double* point, tl_vec3 half_extents, tl_nav_location* location_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_world_find_path(tl_nav_world* world, tl_nav_query* query, tl_nav_path_request* request, tl_nav_path_buffers* buffers, tl_nav_shortest_path* path_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_world_cast_ray(tl_nav_world* world, tl_nav_filter* filter, tl_nav_location* start, double* end, tl_nav_ray_hit* hit_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_routes_def tl_default_nav_routes_def();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_routes_bake(tl_nav_routes_def* def, tl_nav_routes** routes_out, tl_report* report);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_routes_check(void* bytes, ulong size, tl_report* report);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_routes_check_tiles(tl_nav_routes* routes, tl_pack_index* index, tl_report* report);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_router_create(tl_nav_world* world, tl_allocator* allocator, tl_nav_router** router_out, tl_report* report);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_router_destroy(tl_nav_router* router);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_world_find_route(tl_nav_world* world, tl_nav_router* router, tl_nav_world_route_request* request, tl_nav_world_route_point* points_out, uint capacity, tl_nav_world_route* route_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_pvs_def tl_default_nav_pvs_def();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_pvs_bake(tl_nav_pvs_def* def, tl_navmesh* navmesh, tl_soup* soup, tl_nav_pvs** pvs_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_pvs_check(void* bytes, ulong size, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_pvs_sees(tl_nav_pvs* pvs, tl_navmesh* navmesh, ulong a, ulong b, byte* seen_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_pvs_seen_from(tl_nav_pvs* pvs, tl_navmesh* navmesh, ulong from, ulong* polygons_out, uint capacity, uint* count_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_cover_def tl_default_nav_cover_def();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_query_find_cover(tl_nav_query* query, tl_nav_cover_request* request, tl_nav_cover_def* def, tl_nav_cover* covers_out, uint capacity, uint* count_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_polygon_flags(tl_navmesh* navmesh, ulong polygon, ulong* flags_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_polygon_area(tl_navmesh* navmesh, ulong polygon, byte* area_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_set_polygon_flags(tl_navmesh* navmesh, ulong polygon, ulong flags);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_set_polygon_area(tl_navmesh* navmesh, ulong polygon, byte area);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_store_state(tl_navmesh* navmesh, int tile_x, uint layer, int tile_z, tl_nav_polygon_state* states_out, uint capacity, uint* count_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_restore_state(tl_navmesh* navmesh, int tile_x, uint layer, int tile_z, tl_nav_polygon_state* states, uint count, tl_report* report);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_reset_state(tl_navmesh* navmesh, int tile_x, uint layer, int tile_z);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte tl_navmesh_is_state_changed(tl_navmesh* navmesh, int tile_x, uint layer, int tile_z);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_versions_create(tl_allocator* allocator, tl_nav_versions** versions_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_versions_destroy(tl_nav_versions* versions);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_navmesh* tl_nav_versions_acquire(tl_nav_versions* versions);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_nav_versions_release(tl_nav_versions* versions, tl_navmesh* navmesh);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_versions_edit(tl_nav_versions* versions, tl_navmesh** draft_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_versions_publish(tl_nav_versions* versions);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_versions_reclaim(tl_nav_versions* versions, tl_nav_versions_state* state_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern byte* tl_nav_wide_status_name(tl_nav_wide_status status);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_query_find_wide_path(tl_nav_query* query, tl_navmesh* navmesh, tl_nav_path_request* request, float agent_radius, tl_nav_corner* corners_out, uint capacity, tl_nav_wide_path* path_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_query_is_wide_reachable(tl_nav_query* query, tl_navmesh* navmesh, tl_nav_path_request* request, float agent_radius, tl_nav_wide_status* status_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_nav_wide_def tl_default_nav_wide_def();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_navmesh_prepare_wide(tl_navmesh* navmesh, tl_nav_wide_def* def, tl_nav_wide_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_query_find_wide_place(tl_nav_query* query, tl_navmesh* navmesh, tl_nav_around_request* request, float agent_radius, tl_nav_location* place_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_nav_query_path_clearance(tl_nav_query* query, tl_navmesh* navmesh, tl_nav_filter* filter, tl_nav_corner* corners, uint count, float max_distance, float* clearance_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_scene_groups_expand(tl_scene_group* groups, uint group_count, uint root, tl_host* host, tl_scene_expansion* expansion_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_scene_groups_place(tl_scene_group* groups, uint group_count, tl_scene_expansion* expansion, uint copy, tl_scene_placement* at, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern uint tl_scene_copy_of(tl_scene_expansion* expansion, uint instance);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_scene_expansion_free(tl_scene_expansion* expansion);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_scene_versions_create(tl_scene_instance* instances, uint count, tl_allocator* allocator, tl_scene_versions** versions_out, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_scene_versions_destroy(tl_scene_versions* versions);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_scene_version* tl_scene_versions_acquire(tl_scene_versions* versions);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern void tl_scene_versions_release(tl_scene_versions* versions, tl_scene_version* version);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_scene_versions_publish(tl_scene_versions* versions, tl_scene_instance* instances, uint count, tl_report* report_out);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        public static extern tl_result tl_scene_versions_reclaim(tl_scene_versions* versions, tl_scene_versions_state* state_out);
    }
}
