// SPDX-License-Identifier: MIT
//
// Written by tools/bindings from include/talus: changes belong there.

pub type tl_result = c_int;
pub const TL_OK: tl_result = 0;
pub const TL_NOT_FOUND: tl_result = 1;
pub const TL_INCOMPLETE: tl_result = 2;
pub const TL_NOT_LOADED: tl_result = 3;
pub const TL_ERR_MEMORY: tl_result = 4;
pub const TL_ERR_CANCELLED: tl_result = 5;
pub const TL_ERR_IO: tl_result = 6;
pub const TL_ERR_ARGUMENT: tl_result = 7;
pub const TL_ERR_UNSUPPORTED: tl_result = 8;
pub const TL_ERR_LIMIT: tl_result = 9;
pub const TL_ERR_STALE: tl_result = 10;
pub const TL_ERR_EMPTY: tl_result = 11;
pub const TL_ERR_NOT_FINITE: tl_result = 12;
pub const TL_ERR_RANGE: tl_result = 13;
pub const TL_ERR_INDEX: tl_result = 14;
pub const TL_ERR_DEGENERATE: tl_result = 15;
pub const TL_ERR_COINCIDENT: tl_result = 16;
pub const TL_ERR_COLLINEAR: tl_result = 17;
pub const TL_ERR_COPLANAR: tl_result = 18;
pub const TL_ERR_NON_MANIFOLD: tl_result = 19;
pub const TL_ERR_WINDING: tl_result = 20;
pub const TL_ERR_NOT_CLOSED: tl_result = 21;
pub const TL_ERR_SELF_INTERSECTION: tl_result = 22;
pub const TL_ERR_FORMAT: tl_result = 23;
pub const TL_ERR_MAGIC: tl_result = 24;
pub const TL_ERR_VERSION: tl_result = 25;
pub const TL_ERR_TRUNCATED: tl_result = 26;
pub const TL_ERR_HASH: tl_result = 27;
pub const TL_ERR_CORRUPT: tl_result = 28;
pub const TL_ERR_ITERATIONS: tl_result = 29;
pub const TL_ERR_NODES: tl_result = 30;
pub const TL_RESULT_COUNT: tl_result = 31;
pub type tl_convex_kind = c_int;
pub const TL_CONVEX_HULL: tl_convex_kind = 0;
pub const TL_CONVEX_POINTS: tl_convex_kind = 1;
pub const TL_CONVEX_INLINE: tl_convex_kind = 2;
pub const TL_CONVEX_BOX: tl_convex_kind = 3;
pub const TL_CONVEX_CYLINDER: tl_convex_kind = 4;
pub const TL_CONVEX_CONE: tl_convex_kind = 5;
pub const TL_CONVEX_CUSTOM: tl_convex_kind = 6;
pub type tl_convex_status = c_int;
pub const TL_CONVEX_CONVERGED: tl_convex_status = 0;
pub const TL_CONVEX_ITERATIONS: tl_convex_status = 1;
pub const TL_CONVEX_DEGENERATE: tl_convex_status = 2;
pub const TL_CONVEX_NOT_FINITE: tl_convex_status = 3;
pub type tl_soup_partition = c_int;
pub const TL_SOUP_BVH: tl_soup_partition = 0;
pub const TL_SOUP_KD_TREE: tl_soup_partition = 1;
pub type tl_soup_layout = c_int;
pub const TL_SOUP_FAST: tl_soup_layout = 0;
pub const TL_SOUP_COMPACT: tl_soup_layout = 1;
pub type tl_soup_quality = c_int;
pub const TL_SOUP_QUALITY_DEFAULT: tl_soup_quality = 0;
pub const TL_SOUP_QUALITY_FAST: tl_soup_quality = 1;
pub const TL_SOUP_QUALITY_HIGH: tl_soup_quality = 2;
pub type tl_ray_cull = c_int;
pub const TL_RAY_CULL_NONE: tl_ray_cull = 0;
pub const TL_RAY_CULL_BACK: tl_ray_cull = 1;
pub const TL_RAY_CULL_FRONT: tl_ray_cull = 2;
pub type tl_hit_rule = c_int;
pub const TL_HITS_TOUCHED: tl_hit_rule = 0;
pub const TL_HITS_CROSSED: tl_hit_rule = 1;
pub type tl_triangle_feature = c_int;
pub const TL_TRIANGLE_FACE: tl_triangle_feature = 0;
pub const TL_TRIANGLE_EDGE_0: tl_triangle_feature = 1;
pub const TL_TRIANGLE_EDGE_1: tl_triangle_feature = 2;
pub const TL_TRIANGLE_EDGE_2: tl_triangle_feature = 3;
pub const TL_TRIANGLE_CORNER_0: tl_triangle_feature = 4;
pub const TL_TRIANGLE_CORNER_1: tl_triangle_feature = 5;
pub const TL_TRIANGLE_CORNER_2: tl_triangle_feature = 6;
pub type tl_soup_side = c_int;
pub const TL_SOUP_OUTSIDE: tl_soup_side = 0;
pub const TL_SOUP_INSIDE: tl_soup_side = 1;
pub const TL_SOUP_ON_SURFACE: tl_soup_side = 2;
pub type tl_character_surface = c_int;
pub const TL_CHARACTER_GROUND: tl_character_surface = 0;
pub const TL_CHARACTER_SLOPE: tl_character_surface = 1;
pub const TL_CHARACTER_WALL: tl_character_surface = 2;
pub const TL_CHARACTER_CEILING: tl_character_surface = 3;
pub type tl_solid_rule = c_int;
pub const TL_SOLID_ENCLOSED: tl_solid_rule = 0;
pub const TL_SOLID_SURFACE: tl_solid_rule = 1;
pub type tl_partition_method = c_int;
pub const TL_PARTITION_CLASSIC: tl_partition_method = 0;
pub const TL_PARTITION_OPTIMAL: tl_partition_method = 1;
pub const TL_PARTITION_DELAUNAY: tl_partition_method = 2;
pub type tl_polygon_step_kind = c_int;
pub const TL_POLYGON_STEP_CUT: tl_polygon_step_kind = 0;
pub const TL_POLYGON_STEP_MERGE: tl_polygon_step_kind = 1;
pub type tl_polygon_fault = c_int;
pub const TL_POLYGON_FAULT_RANGE: tl_polygon_fault = 0;
pub const TL_POLYGON_FAULT_CORNERS: tl_polygon_fault = 1;
pub const TL_POLYGON_FAULT_REPEATED: tl_polygon_fault = 2;
pub const TL_POLYGON_FAULT_INVERTED: tl_polygon_fault = 3;
pub const TL_POLYGON_FAULT_NOT_CONVEX: tl_polygon_fault = 4;
pub const TL_POLYGON_FAULT_OVERLAP: tl_polygon_fault = 5;
pub const TL_POLYGON_FAULT_T_JUNCTION: tl_polygon_fault = 6;
pub const TL_POLYGON_FAULT_LINK: tl_polygon_fault = 7;
pub const TL_POLYGON_FAULT_PORTAL: tl_polygon_fault = 8;
pub const TL_POLYGON_FAULT_AREA: tl_polygon_fault = 9;
pub const TL_POLYGON_FAULT_OUTLINE: tl_polygon_fault = 10;
pub const TL_POLYGON_FAULT_COUNT: tl_polygon_fault = 11;
pub type tl_nav_tile_ownership = c_int;
pub const TL_NAV_TILE_BORROWED: tl_nav_tile_ownership = 0;
pub const TL_NAV_TILE_OWNED: tl_nav_tile_ownership = 1;
pub type tl_nav_path_status = c_int;
pub const TL_NAV_PATH_NONE: tl_nav_path_status = 0;
pub const TL_NAV_PATH_COMPLETE: tl_nav_path_status = 1;
pub const TL_NAV_PATH_UNREACHABLE: tl_nav_path_status = 2;
pub const TL_NAV_PATH_OUT_OF_NODES: tl_nav_path_status = 3;
pub const TL_NAV_PATH_UNFINISHED: tl_nav_path_status = 4;
pub const TL_NAV_PATH_STALE: tl_nav_path_status = 5;
pub type tl_nav_partition = c_int;
pub const TL_NAV_WATERSHED: tl_nav_partition = 0;
pub const TL_NAV_MONOTONE: tl_nav_partition = 1;
pub const TL_NAV_LAYERS: tl_nav_partition = 2;
pub type tl_nav_volume_kind = c_int;
pub const TL_NAV_VOLUME_BOX: tl_nav_volume_kind = 0;
pub const TL_NAV_VOLUME_POLYGON: tl_nav_volume_kind = 1;
pub const TL_NAV_VOLUME_CYLINDER: tl_nav_volume_kind = 2;
pub type tl_nav_finding_kind = c_int;
pub const TL_NAV_FINDING_BLOCKED: tl_nav_finding_kind = 0;
pub const TL_NAV_FINDING_STEP: tl_nav_finding_kind = 1;
pub const TL_NAV_FINDING_NO_FLOOR: tl_nav_finding_kind = 2;
pub const TL_NAV_FINDING_MISSING: tl_nav_finding_kind = 3;
pub type tl_nav_cause = c_int;
pub const TL_NAV_CAUSE_NONE: tl_nav_cause = 0;
pub const TL_NAV_CAUSE_OUTSIDE: tl_nav_cause = 1;
pub const TL_NAV_CAUSE_NO_FLOOR: tl_nav_cause = 2;
pub const TL_NAV_CAUSE_SLOPE: tl_nav_cause = 3;
pub const TL_NAV_CAUSE_AREA_INPUT: tl_nav_cause = 4;
pub const TL_NAV_CAUSE_LEDGE: tl_nav_cause = 5;
pub const TL_NAV_CAUSE_CEILING: tl_nav_cause = 6;
pub const TL_NAV_CAUSE_RADIUS: tl_nav_cause = 7;
pub const TL_NAV_CAUSE_VOLUME: tl_nav_cause = 8;
pub const TL_NAV_CAUSE_ISLAND: tl_nav_cause = 9;
pub const TL_NAV_CAUSE_OUTLINE: tl_nav_cause = 10;
pub const TL_NAV_CAUSE_CHANGED: tl_nav_cause = 11;
pub const TL_NAV_CAUSE_PRUNED: tl_nav_cause = 12;
pub const TL_NAV_CAUSE_WALL: tl_nav_cause = 13;
pub type tl_nav_agent_status = c_int;
pub const TL_NAV_AGENT_IDLE: tl_nav_agent_status = 0;
pub const TL_NAV_AGENT_WAITING: tl_nav_agent_status = 1;
pub const TL_NAV_AGENT_WALKING: tl_nav_agent_status = 2;
pub const TL_NAV_AGENT_ARRIVED: tl_nav_agent_status = 3;
pub const TL_NAV_AGENT_UNREACHABLE: tl_nav_agent_status = 4;
pub const TL_NAV_AGENT_QUEUED: tl_nav_agent_status = 5;
pub const TL_NAV_AGENT_ON_LINK: tl_nav_agent_status = 6;
pub const TL_NAV_AGENT_OFF_MESH: tl_nav_agent_status = 7;
pub const TL_NAV_AGENT_GAVE_UP: tl_nav_agent_status = 8;
pub const TL_NAV_AGENT_FIXED: tl_nav_agent_status = 9;
pub type tl_nav_formation = c_int;
pub const TL_NAV_FORMATION_LOOSE: tl_nav_formation = 0;
pub const TL_NAV_FORMATION_LINE: tl_nav_formation = 1;
pub const TL_NAV_FORMATION_COLUMN: tl_nav_formation = 2;
pub const TL_NAV_FORMATION_WEDGE: tl_nav_formation = 3;
pub const TL_NAV_FORMATION_RING: tl_nav_formation = 4;
pub const TL_NAV_FORMATION_SLOTS: tl_nav_formation = 5;
pub type tl_detour_refs = c_int;
pub const TL_DETOUR_REFS_32: tl_detour_refs = 0;
pub const TL_DETOUR_REFS_64: tl_detour_refs = 1;
pub type tl_nav_link_kind = c_int;
pub const TL_NAV_LINK_DROP: tl_nav_link_kind = 0;
pub const TL_NAV_LINK_JUMP: tl_nav_link_kind = 1;
pub const TL_NAV_LINK_CLIMB: tl_nav_link_kind = 2;
pub const TL_NAV_LINK_KINDS: tl_nav_link_kind = 3;
pub type tl_nav_obstacle_shape = c_int;
pub const TL_NAV_OBSTACLE_CYLINDER: tl_nav_obstacle_shape = 0;
pub const TL_NAV_OBSTACLE_BOX: tl_nav_obstacle_shape = 1;
pub const TL_NAV_OBSTACLE_PRISM: tl_nav_obstacle_shape = 2;
pub const TL_NAV_OBSTACLE_CONVEX: tl_nav_obstacle_shape = 3;
pub type tl_nav_prepared_kind = c_int;
pub const TL_NAV_PREPARED_NONE: tl_nav_prepared_kind = 0;
pub const TL_NAV_PREPARED_GRAPH: tl_nav_prepared_kind = 1;
pub const TL_NAV_PREPARED_TABLE: tl_nav_prepared_kind = 2;
pub type tl_pack_axes = c_int;
pub const TL_PACK_AXES_Y_UP: tl_pack_axes = 0;
pub const TL_PACK_AXES_Z_UP: tl_pack_axes = 1;
pub const TL_PACK_AXES_Y_UP_LEFT: tl_pack_axes = 2;
pub const TL_PACK_AXES_Z_UP_LEFT: tl_pack_axes = 3;
pub type tl_nav_wide_status = c_int;
pub const TL_NAV_WIDE_NONE: tl_nav_wide_status = 0;
pub const TL_NAV_WIDE_COMPLETE: tl_nav_wide_status = 1;
pub const TL_NAV_WIDE_UNREACHABLE: tl_nav_wide_status = 2;
pub const TL_NAV_WIDE_OUT_OF_NODES: tl_nav_wide_status = 3;
pub const TL_NAV_WIDE_START_BLOCKED: tl_nav_wide_status = 4;
pub const TL_NAV_WIDE_GOAL_BLOCKED: tl_nav_wide_status = 5;
pub type tl_task_fn = unsafe extern "C" fn(u32, u32, *mut c_void);
pub type tl_convex_support_fn = unsafe extern "C" fn(tl_vec3, *mut c_void) -> tl_vec3;
pub type tl_triangle_filter_fn = unsafe extern "C" fn(u32, u16, *mut c_void) -> bool;
pub type tl_soup_triangle_fn = unsafe extern "C" fn(*const tl_soup_triangle, *mut c_void) -> bool;
pub type tl_soup_bvh_box_fn = unsafe extern "C" fn(tl_aabb, u32, bool, *mut c_void) -> bool;
pub type tl_instance_filter_fn = unsafe extern "C" fn(u32, *mut c_void) -> bool;
pub type tl_scene_instance_fn = unsafe extern "C" fn(u32, *mut c_void) -> bool;
pub type tl_nav_ref = u64;
pub type tl_nav_pass_fn = unsafe extern "C" fn(*const tl_nav_tile, u32, *mut c_void) -> bool;
pub type tl_nav_cost_fn =
    unsafe extern "C" fn(*const tl_nav_tile, u32, tl_vec3, tl_vec3, f32, *mut c_void) -> f32;
pub type tl_nav_agent = u64;
pub type tl_nav_group = u64;
pub type tl_nav_obstacle_id = u64;
pub type tl_write_fn = unsafe extern "C" fn(*const c_void, usize, *mut c_void) -> tl_result;
pub type tl_pack_fetch_fn = unsafe extern "C" fn(u32, *mut *const c_void, *mut c_void) -> tl_result;
pub type tl_nav_world_read_fn =
    unsafe extern "C" fn(u64, *mut c_void, usize, *mut c_void) -> tl_result;
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_allocator {
    pub allocate: Option<unsafe extern "C" fn(usize, usize, *mut c_void) -> *mut c_void>,
    pub release: Option<unsafe extern "C" fn(*mut c_void, usize, *mut c_void)>,
    pub user: *mut c_void,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_tasks {
    pub run: Option<unsafe extern "C" fn(Option<tl_task_fn>, u32, *mut c_void, *mut c_void)>,
    pub worker_count: u32,
    pub user: *mut c_void,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_progress {
    pub update: Option<unsafe extern "C" fn(*const c_char, u64, u64, *mut c_void) -> bool>,
    pub user: *mut c_void,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_host {
    pub allocator: *const tl_allocator,
    pub tasks: *const tl_tasks,
    pub progress: *const tl_progress,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_report {
    pub stage: *const c_char,
    pub field: *const c_char,
    pub element: *const c_char,
    pub element_index: u64,
    pub advice: *const c_char,
    pub peak_bytes: u64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_blob {
    pub magic: u32,
    pub version: u32,
    pub size: u64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_vec3 {
    pub x: f32,
    pub y: f32,
    pub z: f32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_quat {
    pub x: f32,
    pub y: f32,
    pub z: f32,
    pub w: f32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_transform {
    pub rotation: tl_quat,
    pub position: tl_vec3,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_aabb {
    pub min: tl_vec3,
    pub max: tl_vec3,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_halfedge_vertex {
    pub position: tl_vec3,
    pub edge: u32,
    pub link: u32,
    pub mark: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_halfedge_edge {
    pub vertex: u32,
    pub face: u32,
    pub next: u32,
    pub prev: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_halfedge_face {
    pub edge: u32,
    pub link: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_halfedge_mesh {
    pub vertices: *mut tl_halfedge_vertex,
    pub edges: *mut tl_halfedge_edge,
    pub faces: *mut tl_halfedge_face,
    pub vertex_end: u32,
    pub edge_end: u32,
    pub face_end: u32,
    pub vertex_count: u32,
    pub half_edge_count: u32,
    pub face_count: u32,
    pub boundary_count: u32,
    pub vertex_capacity: u32,
    pub edge_capacity: u32,
    pub face_capacity: u32,
    pub free_vertex: u32,
    pub free_edge: u32,
    pub free_face: u32,
    pub stamp: u32,
    pub allocator: tl_allocator,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_hull_def {
    pub max_vertices: u32,
    pub tolerance: f32,
    pub thickness: f32,
    pub flatness: f32,
    pub weld_distance: f32,
    pub merge_distance: f32,
    pub host: tl_host,
    pub cookie: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_hull_report {
    pub base: tl_report,
    pub triangle_count: u32,
    pub thickened: bool,
    pub points_left_out: u32,
    pub max_outside: f64,
    pub corners_left_out: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_hull_half_edge {
    pub origin: u32,
    pub twin: u32,
    pub next: u32,
    pub face: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_hull_face {
    pub first: u32,
    pub count: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_hull_plane {
    pub normal: [f64; 3],
    pub offset: f64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_hull_mass {
    pub volume: f64,
    pub area: f64,
    pub center: [f64; 3],
    pub inertia: [f64; 6],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_hull {
    pub blob: tl_blob,
    pub vertex_count: u32,
    pub face_count: u32,
    pub half_edge_count: u32,
    pub scan_error: f32,
    pub index_bytes: u8,
    pub flags: u8,
    pub vertices: u16,
    pub merge_distance: f32,
    pub bounds: tl_aabb,
    pub mass: tl_hull_mass,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_hull_climb {
    pub table_side: u32,
    pub table_scale: tl_vec3,
    pub planes: u32,
    pub blocks: u32,
    pub table: u32,
    pub rings: u32,
    pub cell_bytes: u32,
    pub block_count: u32,
    pub ring_count: u32,
    pub ring_cells: u32,
    pub cap_count: u32,
    pub unused: [u32; 3],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_hull_validation {
    pub base: tl_report,
    pub euler: bool,
    pub flat_faces: bool,
    pub convex: bool,
    pub contains: bool,
    pub max_outside: f64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_hull_hit {
    pub t: f32,
    pub face: u32,
    pub normal: tl_vec3,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_convex {
    pub kind: tl_convex_kind,
    pub radius: f32,
    pub hull: *const tl_hull,
    pub points: *const tl_vec3,
    pub point_count: u32,
    pub corners: [tl_vec3; 3],
    pub support: Option<tl_convex_support_fn>,
    pub user: *mut c_void,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_simplex_cache {
    pub count: u32,
    pub vertex_a: [u32; 4],
    pub vertex_b: [u32; 4],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_separation {
    pub distance: f32,
    pub lower_bound: f32,
    pub overlap: bool,
    pub point_a: tl_vec3,
    pub point_b: tl_vec3,
    pub normal: tl_vec3,
    pub status: tl_convex_status,
    pub iterations: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_penetration {
    pub overlap: bool,
    pub depth: f32,
    pub lower_bound: f32,
    pub upper_bound: f32,
    pub normal: tl_vec3,
    pub point_a: tl_vec3,
    pub point_b: tl_vec3,
    pub status: tl_convex_status,
    pub iterations: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_convex_hit {
    pub hit: bool,
    pub initial_overlap: bool,
    pub t: f32,
    pub gap: f32,
    pub point: tl_vec3,
    pub normal: tl_vec3,
    pub status: tl_convex_status,
    pub iterations: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_contact_limits {
    pub margin: f32,
    pub tolerance: f32,
    pub max_steps: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_contact {
    pub point_a: tl_vec3,
    pub point_b: tl_vec3,
    pub separation: f32,
    pub feature_a: u32,
    pub feature_b: u32,
    pub previous: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_contact_manifold {
    pub count: u32,
    pub contacts: [tl_contact; 5],
    pub normal: tl_vec3,
    pub separation: f32,
    pub status: tl_convex_status,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_polytope_cache {
    pub point_count: u16,
    pub face_count: u16,
    pub vertices: [[u16; 2]; 24],
    pub corners: [[u8; 3]; 44],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_contact_cache {
    pub simplex: tl_simplex_cache,
    pub count: u32,
    pub has_axis: u32,
    pub features: [[u32; 2]; 5],
    pub points: [tl_vec3; 5],
    pub points_b: [tl_vec3; 5],
    pub axis_a: tl_vec3,
    pub axis_b: tl_vec3,
    pub b_to_a: [f32; 12],
    pub proven_depth: f32,
    pub polytope: tl_polytope_cache,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_scaled_convex {
    pub shape: tl_convex,
    pub of: *const tl_convex,
    pub scale: tl_vec3,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_mesh_view {
    pub vertices: *const tl_vec3,
    pub vertex_count: u32,
    pub indices: *const u32,
    pub triangle_count: u32,
    pub materials: *const u16,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_mesh_def {
    pub weld_tolerance: f32,
    pub keep_duplicates: bool,
    pub host: tl_host,
    pub cookie: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_mesh {
    pub vertices: *mut tl_vec3,
    pub vertex_count: u32,
    pub indices: *mut u32,
    pub triangle_count: u32,
    pub materials: *mut u16,
    pub source_triangles: *mut u32,
    pub bounds: tl_aabb,
    pub block: *mut c_void,
    pub block_size: usize,
    pub allocator: tl_allocator,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_mesh_report {
    pub base: tl_report,
    pub welded_vertices: u32,
    pub unused_vertices: u32,
    pub degenerate_triangles: u32,
    pub duplicate_triangles: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_adjacency {
    pub across: *mut u32,
    pub triangle_count: u32,
    pub border_edges: u32,
    pub paired_edges: u32,
    pub non_manifold_edges: u32,
    pub allocator: tl_allocator,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_closed_parts {
    pub part_of: *mut u32,
    pub volumes: *mut f64,
    pub part_count: u32,
    pub open_part_count: u32,
    pub triangle_count: u32,
    pub allocator: tl_allocator,
}
#[repr(C)]
pub struct tl_soup {
    _private: [u8; 0],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_soup_def {
    pub pair_triangles: bool,
    pub partition: tl_soup_partition,
    pub layout: tl_soup_layout,
    pub quality: tl_soup_quality,
    pub split_budget: f32,
    pub host: tl_host,
    pub cookie: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_soup_report {
    pub base: tl_report,
    pub triangle_count: u32,
    pub degenerate_triangles: u32,
    pub pair_count: u32,
    pub single_count: u32,
    pub coincident_count: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_soup_stats {
    pub size: u64,
    pub source_triangle_count: u32,
    pub triangle_count: u32,
    pub pair_count: u32,
    pub single_count: u32,
    pub coincident_count: u32,
    pub reference_count: u32,
    pub leaf_count: u32,
    pub node_count: u32,
    pub layout: tl_soup_layout,
    pub depth: u32,
    pub node_bytes: u64,
    pub leaf_bytes: u64,
    pub vertex_bytes: u64,
    pub material_bytes: u64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_ray {
    pub origin: tl_vec3,
    pub direction: tl_vec3,
    pub tmax: f32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_ray_filter {
    pub cull: tl_ray_cull,
    pub ignored_materials: u64,
    pub accept: Option<tl_triangle_filter_fn>,
    pub accept_user: *mut c_void,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_ray_hit {
    pub t: f32,
    pub triangle: u32,
    pub u: f32,
    pub v: f32,
    pub normal: tl_vec3,
    pub material: u16,
    pub back: bool,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_segment {
    pub a: tl_vec3,
    pub b: tl_vec3,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_soup_point {
    pub point: tl_vec3,
    pub distance: f32,
    pub normal: tl_vec3,
    pub triangle: u32,
    pub material: u16,
    pub back: bool,
    pub feature: tl_triangle_feature,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_shape_hit {
    pub t: f32,
    pub initial_overlap: bool,
    pub back: bool,
    pub material: u16,
    pub triangle: u32,
    pub depth: f32,
    pub point: tl_vec3,
    pub normal: tl_vec3,
    pub face_normal: tl_vec3,
    pub status: tl_convex_status,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_soup_contact_query {
    pub shape: *const tl_convex,
    pub pose: tl_transform,
    pub limits: tl_contact_limits,
    pub filter: *const tl_ray_filter,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_soup_contact {
    pub triangle: u32,
    pub material: u16,
    pub is_face: bool,
    pub manifold: tl_contact_manifold,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_soup_location {
    pub side: tl_soup_side,
    pub winding: i32,
    pub triangle: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_soup_triangle {
    pub corners: [tl_vec3; 3],
    pub triangle: u32,
    pub material: u16,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_soup_pair {
    pub corners: [tl_vec3; 4],
    pub triangles: [u32; 2],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_scaled_soup {
    pub soup: *const tl_soup,
    pub scale: tl_vec3,
}
#[repr(C)]
pub struct tl_scene {
    _private: [u8; 0],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_scene_instance {
    pub soup: *const tl_soup,
    pub shape: *const tl_convex,
    pub pose: tl_transform,
    pub mask: u32,
    pub scale: tl_vec3,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_scene_stats {
    pub size: u64,
    pub instance_count: u32,
    pub node_count: u32,
    pub depth: u32,
    pub cost: f64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_scene_filter {
    pub ignored_mask: u32,
    pub first_ignored: u32,
    pub ignored_count: u32,
    pub accept: Option<tl_instance_filter_fn>,
    pub accept_user: *mut c_void,
    pub triangles: *const tl_ray_filter,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_scene_hit {
    pub hit: tl_ray_hit,
    pub instance: u32,
    pub inside: bool,
    pub status: tl_convex_status,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_scene_shape_hit {
    pub hit: tl_shape_hit,
    pub instance: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_scene_overlap_query {
    pub shape: *const tl_convex,
    pub pose: tl_transform,
    pub filter: *const tl_scene_filter,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_scene_overlap {
    pub instance: u32,
    pub triangle: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_scene_point {
    pub point: tl_soup_point,
    pub instance: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_character_def {
    pub radius: f32,
    pub height: f32,
    pub step_height: f32,
    pub max_slope: f32,
    pub gap: f32,
    pub max_triangles: u32,
    pub allocator: *const tl_allocator,
    pub cookie: u32,
}
#[repr(C)]
pub struct tl_character_mover {
    _private: [u8; 0],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_character {
    pub position: tl_vec3,
    pub velocity: tl_vec3,
    pub ground_normal: tl_vec3,
    pub ground_point: tl_vec3,
    pub grounded: u32,
    pub ground_triangle: u32,
    pub ground_instance: u32,
    pub ground_pose: tl_transform,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_character_level {
    pub soup: *const tl_soup,
    pub soup_filter: *const tl_ray_filter,
    pub scene: *const tl_scene,
    pub instances: *const tl_scene_instance,
    pub scene_filter: *const tl_scene_filter,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_character_step {
    pub velocity: tl_vec3,
    pub seconds: f32,
    pub leave_ground: bool,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_character_hit {
    pub point: tl_vec3,
    pub normal: tl_vec3,
    pub instance: u32,
    pub triangle: u32,
    pub material: u16,
    pub surface: tl_character_surface,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_character_report {
    pub base: tl_report,
    pub landed: bool,
    pub left_ground: bool,
    pub blocked: bool,
    pub hit_ceiling: bool,
    pub stuck: bool,
    pub stepped_up: f32,
    pub pushed: f32,
    pub carried: tl_vec3,
    pub turned: tl_quat,
    pub ground_velocity: tl_vec3,
    pub sweeps: u32,
    pub hit_count: u32,
    pub hits: [tl_character_hit; 8],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_decompose_def {
    pub tolerance: f32,
    pub relative_tolerance: f32,
    pub max_parts: u32,
    pub max_vertices: u32,
    pub thickness: f32,
    pub solid: tl_solid_rule,
    pub max_cells: u32,
    pub host: tl_host,
    pub cookie: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_convex_part {
    pub hull: *mut tl_hull,
    pub concavity: f64,
    pub max_outside: f64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_decomposition {
    pub parts: *mut tl_convex_part,
    pub part_count: u32,
    pub concavity: f64,
    pub max_outside: f64,
    pub hull_volume: f64,
    pub allocator: tl_allocator,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_decompose_report {
    pub base: tl_report,
    pub tolerance: f32,
    pub cell: f32,
    pub degenerate_triangles: u32,
    pub cut_count: u32,
    pub parts_before_merging: u32,
    pub parts_over_tolerance: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_contour_vertex {
    pub x: i32,
    pub y: i32,
    pub z: i32,
    pub flags: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_contour {
    pub first_vertex: u32,
    pub vertex_count: u32,
    pub region: u32,
    pub area: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_contour_set {
    pub vertices: *const tl_contour_vertex,
    pub vertex_count: u32,
    pub contours: *const tl_contour,
    pub contour_count: u32,
    pub bounds: tl_aabb,
    pub cell_size: f32,
    pub cell_height: f32,
    pub width: i32,
    pub height: i32,
    pub border_size: i32,
    pub max_error: f32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_contour_note {
    pub contour: u32,
    pub faults: u32,
    pub vertex: u32,
    pub reserved: u32,
    pub contour_area2: i64,
    pub covered_area2: i64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_polygon_mesh {
    pub vertex_count: u32,
    pub polygon_count: u32,
    pub index_count: u32,
    pub vertices: *mut i32,
    pub first: *mut u32,
    pub indices: *mut u32,
    pub neighbours: *mut u32,
    pub regions: *mut u32,
    pub areas: *mut u32,
    pub contours: *mut u32,
    pub bounds: tl_aabb,
    pub cell_size: f32,
    pub cell_height: f32,
    pub max_verts_per_poly: u32,
    pub note_count: u32,
    pub notes: *mut tl_contour_note,
    pub allocator: tl_allocator,
    pub block: *mut c_void,
    pub block_size: usize,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_polygon_step {
    pub kind: tl_polygon_step_kind,
    pub contour: u32,
    pub partition_count: u32,
    pub partitions: *const i32,
    pub outline_count: u32,
    pub outline: *const i32,
    pub corner_count: u32,
    pub corners: *const i32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_polygon_trace {
    pub step: Option<unsafe extern "C" fn(*const tl_polygon_step, *mut c_void)>,
    pub user: *mut c_void,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_polygon_def {
    pub max_verts_per_poly: u32,
    pub method: tl_partition_method,
    pub merge_height: u32,
    pub keep_border_vertices: bool,
    pub drop_straight_vertices: bool,
    pub merge_contours: bool,
    pub trace: *const tl_polygon_trace,
    pub host: tl_host,
    pub cookie: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_polygon_report {
    pub base: tl_report,
    pub contour_count: u32,
    pub empty_contours: u32,
    pub repaired_contours: u32,
    pub refused_contours: u32,
    pub triangle_count: u32,
    pub lower_bound: u32,
    pub polygon_count: u32,
    pub vertex_count: u32,
    pub removed_straight_vertices: u32,
    pub contour_merges: u32,
    pub removed_border_vertices: u32,
    pub kept_border_vertices: u32,
    pub link_count: u32,
    pub portal_count: u32,
    pub non_manifold_edges: u32,
    pub uncovered_area2: i64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_polygon_quality {
    pub polygon_count: u32,
    pub max_corners: u32,
    pub mean_corners: f64,
    pub smallest_angle_cosine: f64,
    pub mean_sharpest_cosine: f64,
    pub mean_aspect: f64,
    pub worst_aspect: f64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_polygon_check_report {
    pub base: tl_report,
    pub first_fault: tl_polygon_fault,
    pub counts: [u64; 11],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_detail_patch {
    pub first_vertex: u32,
    pub vertex_count: u32,
    pub first_triangle: u32,
    pub triangle_count: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_detail_triangle {
    pub corner: [u16; 3],
    pub edge_flags: u16,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_detail {
    pub patch_count: u32,
    pub vertex_count: u32,
    pub triangle_count: u32,
    pub patches: *mut tl_nav_detail_patch,
    pub vertices: *mut tl_vec3,
    pub triangles: *mut tl_nav_detail_triangle,
    pub max_error: f32,
    pub limited_patches: u32,
    pub allocator: tl_allocator,
    pub block: *mut c_void,
    pub block_size: usize,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_portal {
    pub polygon: u32,
    pub corner: u32,
    pub low: i32,
    pub high: i32,
    pub first_profile: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_profile_point {
    pub along: f32,
    pub height: f32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_tile_node {
    pub min: [u16; 3],
    pub max: [u16; 3],
    pub link: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_tile {
    pub blob: tl_blob,
    pub tile_x: i32,
    pub tile_z: i32,
    pub tile_size: u32,
    pub polygon_count: u32,
    pub vertex_count: u32,
    pub corner_count: u32,
    pub detail_vertex_count: u32,
    pub detail_triangle_count: u32,
    pub node_count: u32,
    pub portal_count: u32,
    pub profile_count: u32,
    pub layer: u32,
    pub side_end: [u32; 4],
    pub area: f64,
    pub origin: tl_vec3,
    pub cell_size: f32,
    pub cell_height: f32,
    pub agent_height: f32,
    pub agent_radius: f32,
    pub agent_max_climb: f32,
    pub bounds: tl_aabb,
    pub wide: u32,
    pub node_steps: u32,
    pub nodes: u32,
    pub first_corner: u32,
    pub links: u32,
    pub corner_vertices: u32,
    pub vertices: u32,
    pub flags: u32,
    pub areas: u32,
    pub detail_first_vertex: u32,
    pub detail_first_triangle: u32,
    pub detail_vertices: u32,
    pub detail_triangles: u32,
    pub portals: u32,
    pub profile: u32,
    pub zero: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_cut {
    pub corner: u32,
    pub layer: u32,
    pub ordinal: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_tile_source {
    pub polygons: *const tl_polygon_mesh,
    pub detail: *const tl_nav_detail,
    pub tile_x: i32,
    pub tile_z: i32,
    pub tile_size: u32,
    pub origin: tl_vec3,
    pub agent_height: f32,
    pub agent_radius: f32,
    pub agent_max_climb: f32,
    pub flags: *const u64,
    pub layer: u32,
    pub cuts: *const tl_nav_cut,
    pub cut_count: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_tile_stack {
    pub tiles: *mut *mut tl_nav_tile,
    pub count: u32,
    pub allocator: tl_allocator,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_tile_part {
    pub begin: u32,
    pub end: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_surface {
    pub vertices: *const tl_vec3,
    pub vertex_count: u32,
    pub triangle_count: u32,
    pub triangles: *const c_void,
    pub is_wide: bool,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_lattice_point {
    pub at: [i32; 3],
}
#[repr(C)]
pub struct tl_navmesh {
    _private: [u8; 0],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_link {
    pub to: tl_nav_ref,
    pub edge: u32,
    pub left: tl_vec3,
    pub right: tl_vec3,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_offmesh {
    pub start: tl_vec3,
    pub end: tl_vec3,
    pub radius: f32,
    pub cost_factor: f32,
    pub fixed_cost: f32,
    pub flags: u64,
    pub user: u64,
    pub area: u8,
    pub both_ways: bool,
    pub cookie: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_location {
    pub polygon: tl_nav_ref,
    pub point: tl_vec3,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_offmesh_state {
    pub offmesh: tl_nav_offmesh,
    pub ends: [tl_nav_location; 2],
    pub anchored: bool,
    pub length: f32,
    pub cost: f32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_filter {
    pub include_flags: u64,
    pub exclude_flags: u64,
    pub area_cost: [f32; 256],
    pub pass: Option<tl_nav_pass_fn>,
    pub cost: Option<tl_nav_cost_fn>,
    pub user: *mut c_void,
    pub slack: f32,
    pub cookie: u32,
}
#[repr(C)]
pub struct tl_nav_query {
    _private: [u8; 0],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_query_def {
    pub max_nodes: u32,
    pub allocator: *const tl_allocator,
    pub cookie: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_corner {
    pub point: tl_vec3,
    pub polygon: tl_nav_ref,
    pub flags: u32,
    pub link: tl_nav_ref,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_path_request {
    pub filter: *const tl_nav_filter,
    pub start: tl_nav_location,
    pub goal: tl_nav_location,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_path_buffers {
    pub polygons: *mut tl_nav_ref,
    pub polygon_capacity: u32,
    pub corners: *mut tl_nav_corner,
    pub corner_capacity: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_path {
    pub status: tl_nav_path_status,
    pub polygon_count: u32,
    pub end: tl_nav_location,
    pub cost: f32,
    pub node_count: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_path_progress {
    pub status: tl_nav_path_status,
    pub node_count: u32,
    pub tile_x: i32,
    pub tile_z: i32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_polygon_path {
    pub polygons: *const tl_nav_ref,
    pub polygon_count: u32,
    pub start: tl_vec3,
    pub end: tl_vec3,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_trace_point {
    pub point: tl_vec3,
    pub polygon: tl_nav_ref,
    pub flags: u32,
    pub cost: f32,
    pub length: f32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_trace_request {
    pub filter: *const tl_nav_filter,
    pub polygons: *const tl_nav_ref,
    pub polygon_count: u32,
    pub corners: *const tl_nav_corner,
    pub corner_count: u32,
    pub keep: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_shortest_path {
    pub status: tl_nav_path_status,
    pub corner_count: u32,
    pub polygon_count: u32,
    pub length: f64,
    pub lower_bound: f64,
    pub surface_length: f64,
    pub node_count: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_ray_hit {
    pub hit: bool,
    pub t: f32,
    pub point: tl_vec3,
    pub normal: tl_vec3,
    pub polygon: tl_nav_ref,
    pub edge: u32,
    pub polygon_count: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_move_request {
    pub filter: *const tl_nav_filter,
    pub start: tl_nav_location,
    pub target: tl_vec3,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_move {
    pub end: tl_nav_location,
    pub polygon_count: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_around_request {
    pub filter: *const tl_nav_filter,
    pub center: tl_nav_location,
    pub radius: f32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_wall {
    pub hit: bool,
    pub distance: f32,
    pub point: tl_vec3,
    pub normal: tl_vec3,
    pub polygon: tl_nav_ref,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_route_request {
    pub filter: *const tl_nav_filter,
    pub start: tl_vec3,
    pub goal: tl_vec3,
    pub half_extents: tl_vec3,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_route {
    pub start: tl_nav_location,
    pub goal: tl_nav_location,
    pub path: tl_nav_path,
    pub corner_count: u32,
    pub length: f32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_zone {
    pub center: tl_vec3,
    pub radius: f32,
    pub points: *const tl_vec3,
    pub point_count: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_height_range {
    pub min: f32,
    pub max: f32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_field_entry {
    pub polygon: tl_nav_ref,
    pub link: tl_nav_ref,
    pub parent: u32,
    pub cost: f32,
    pub point: tl_vec3,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_field_def {
    pub filter: *const tl_nav_filter,
    pub zone: *const tl_nav_zone,
    pub max_cost: f32,
    pub by_reference: bool,
    pub cookie: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_goal_entry {
    pub polygon: tl_nav_ref,
    pub link: tl_nav_ref,
    pub parent: u32,
    pub min_cost: f32,
    pub cost: f32,
    pub corner: tl_vec3,
    pub left: [f32; 2],
    pub right: [f32; 2],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_goal_tree {
    pub entries: *mut tl_nav_goal_entry,
    pub capacity: u32,
    pub count: u32,
    pub goal: tl_nav_location,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_goal_path_request {
    pub filter: *const tl_nav_filter,
    pub start: tl_nav_location,
    pub max_polygons: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_wall_segment {
    pub start: tl_vec3,
    pub end: tl_vec3,
    pub polygon: tl_nav_ref,
    pub across: tl_nav_ref,
    pub distance: f32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_def {
    pub cell_size: f32,
    pub cell_height: f32,
    pub agent_height: f32,
    pub agent_radius: f32,
    pub agent_max_climb: f32,
    pub agent_max_slope: f32,
    pub region_min_size: f32,
    pub region_merge_size: f32,
    pub edge_max_len: f32,
    pub edge_max_error: f32,
    pub max_verts_per_poly: u32,
    pub detail_sample_dist: f32,
    pub detail_sample_max_error: f32,
    pub partition: tl_nav_partition,
    pub polygon_method: tl_partition_method,
    pub filter_low_hanging_obstacles: bool,
    pub filter_ledge_spans: bool,
    pub filter_walkable_low_height_spans: bool,
    pub tile_size: u32,
    pub tile_height: f32,
    pub bounds: tl_aabb,
    pub host: tl_host,
    pub cookie: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_lattice {
    pub origin: tl_vec3,
    pub first_x: i32,
    pub first_z: i32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_config {
    pub lattice: tl_nav_lattice,
    pub bounds: tl_aabb,
    pub cell_size: f32,
    pub cell_height: f32,
    pub width: u32,
    pub height: u32,
    pub height_voxels: u32,
    pub border_size: u32,
    pub walkable_height: u32,
    pub walkable_climb: u32,
    pub walkable_radius: u32,
    pub walkable_slope_cos: f32,
    pub min_region_area: u32,
    pub merge_region_area: u32,
    pub max_edge_len: u32,
    pub max_simplification_error: f32,
    pub max_verts_per_poly: u32,
    pub detail_sample_dist: f32,
    pub detail_sample_max_error: f32,
    pub partition: tl_nav_partition,
    pub polygon_method: tl_partition_method,
    pub filter_low_hanging_obstacles: bool,
    pub filter_ledge_spans: bool,
    pub filter_walkable_low_height_spans: bool,
    pub tile_x: u32,
    pub tile_z: u32,
    pub layer_height: u32,
    pub agent_height: f32,
    pub agent_radius: f32,
    pub agent_max_climb: f32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_span {
    pub min: u16,
    pub max: u16,
    pub area: u16,
    pub reserved: u16,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_heightfield {
    pub width: u32,
    pub height: u32,
    pub lattice: tl_nav_lattice,
    pub bounds: tl_aabb,
    pub cell_size: f32,
    pub cell_height: f32,
    pub first_span: *mut u32,
    pub spans: *mut tl_nav_span,
    pub span_count: u32,
    pub allocator: tl_allocator,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_region_stats {
    pub split: u32,
    pub merged: u32,
    pub filtered_regions: u32,
    pub filtered_spans: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_compact {
    pub width: u32,
    pub height: u32,
    pub border_size: u32,
    pub walkable_height: u32,
    pub walkable_climb: u32,
    pub lattice: tl_nav_lattice,
    pub bounds: tl_aabb,
    pub cell_size: f32,
    pub cell_height: f32,
    pub span_count: u32,
    pub first_span: *mut u32,
    pub floor: *mut u16,
    pub clearance: *mut u16,
    pub area: *mut u8,
    pub step: *mut i16,
    pub neighbour: *mut u32,
    pub distance: *mut u16,
    pub max_distance: u16,
    pub region: *mut u32,
    pub region_count: u32,
    pub region_stats: tl_nav_region_stats,
    pub taken: *const u8,
    pub allocator: tl_allocator,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_contours {
    pub set: tl_contour_set,
    pub raw: tl_contour_set,
    pub hole_count: u32,
    pub unbridged_count: u32,
    pub slit_count: u32,
    pub repaired_count: u32,
    pub allocator: tl_allocator,
    pub block: *mut c_void,
    pub block_size: usize,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_volume {
    pub kind: tl_nav_volume_kind,
    pub area: u8,
    pub r#box: tl_aabb,
    pub points: *const tl_vec3,
    pub point_count: u32,
    pub base: tl_vec3,
    pub radius: f32,
    pub height: f32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_input {
    pub mesh: tl_mesh_view,
    pub areas: *const u8,
    pub volumes: *const tl_nav_volume,
    pub volume_count: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_stages {
    pub heightfield: tl_nav_heightfield,
    pub compact: tl_nav_compact,
    pub contours: tl_nav_contours,
    pub polygons: tl_polygon_mesh,
    pub detail: tl_nav_detail,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_bake_report {
    pub base: tl_report,
    pub span_count: u64,
    pub compact_span_count: u64,
    pub region_count: u32,
    pub filtered_regions: u32,
    pub filtered_spans: u64,
    pub filtered_area: f64,
    pub contour_count: u32,
    pub unbridged_holes: u32,
    pub slit_outlines: u32,
    pub repaired_contours: u32,
    pub polygon_count: u32,
    pub vertex_count: u32,
    pub detail_triangle_count: u32,
    pub limited_patches: u32,
    pub tile_count: u32,
}
#[repr(C)]
pub struct tl_nav_tile_memo {
    _private: [u8; 0],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_tiles {
    pub tiles: *mut *mut tl_nav_tile,
    pub tile_count: u32,
    pub tiles_x: u32,
    pub tiles_z: u32,
    pub allocator: tl_allocator,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_tile_range {
    pub x: u32,
    pub z: u32,
    pub count_x: u32,
    pub count_z: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_stage_sink {
    pub take: Option<unsafe extern "C" fn(*const tl_nav_config, *mut tl_nav_stages, *mut c_void)>,
    pub user: *mut c_void,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_tile_block {
    pub range: tl_nav_tile_range,
    pub stacks: *mut tl_nav_tile_stack,
    pub allocator: tl_allocator,
}
#[repr(C)]
pub struct tl_nav_triangles {
    _private: [u8; 0],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_near_triangles {
    pub input: tl_nav_input,
    pub sources: *const u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_prune_def {
    pub seeds: *const tl_vec3,
    pub seed_count: u32,
    pub seed_extents: tl_vec3,
    pub solids: *const tl_mesh_view,
    pub min_area: f64,
    pub host: tl_host,
    pub cookie: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_pruned {
    pub islands: u32,
    pub polygons: u64,
    pub area: f64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_prune_report {
    pub base: tl_report,
    pub inside: tl_nav_pruned,
    pub unreachable: tl_nav_pruned,
    pub small: tl_nav_pruned,
    pub island_count: u32,
    pub solid_count: u32,
    pub removed_tiles: u32,
    pub changed_tiles: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_probe {
    pub radius: f32,
    pub step: f32,
    pub height: f32,
    pub surface: f32,
    pub gap: f32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_audit_def {
    pub nav: tl_nav_def,
    pub path_count: u32,
    pub seed: u64,
    pub probe_radius: f32,
    pub areas: *const u8,
    pub volumes: *const tl_nav_volume,
    pub volume_count: u32,
    pub pruned: *const tl_navmesh,
    pub min_missing_area: f32,
    pub max_steps: u64,
    pub host: tl_host,
    pub cookie: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_finding {
    pub kind: tl_nav_finding_kind,
    pub triangle: u32,
    pub polygon: tl_nav_ref,
    pub point: tl_vec3,
    pub contact: tl_vec3,
    pub depth: f32,
    pub count: u32,
    pub bounds: tl_aabb,
    pub area: f32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_audit {
    pub findings: *mut tl_nav_finding,
    pub finding_count: u32,
    pub probe: tl_nav_probe,
    pub path_count: u64,
    pub path_metres: f64,
    pub polygon_count: u64,
    pub portal_count: u64,
    pub step_count: u64,
    pub tolerated_count: u64,
    pub contradictions: u64,
    pub floor_samples: u64,
    pub sample_spacing: f32,
    pub missing_area: f64,
    pub allocator: tl_allocator,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_reason {
    pub cause: tl_nav_cause,
    pub stage: *const c_char,
    pub parameter: *const c_char,
    pub value: f32,
    pub needed: f32,
    pub measured: f32,
    pub triangle: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_why_answer {
    pub walkable: bool,
    pub floor: tl_vec3,
    pub reasons: [tl_nav_reason; 6],
    pub reason_count: u32,
    pub proven: bool,
    pub needed: tl_nav_def,
    pub tile_x: u32,
    pub tile_z: u32,
    pub bake_count: u32,
    pub apart: bool,
    pub island_area: f32,
    pub largest_island_area: f32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_pruning {
    pub removed: *const tl_navmesh,
    pub min_area: f64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_corridor {
    pub path: *mut tl_nav_ref,
    pub capacity: u32,
    pub count: u32,
    pub position: tl_vec3,
    pub target: tl_vec3,
    pub goal: tl_vec3,
    pub reaches: bool,
}
#[repr(C)]
pub struct tl_nav_crowd {
    _private: [u8; 0],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_crowd_def {
    pub max_agents: u32,
    pub max_path: u32,
    pub max_neighbors: u32,
    pub paths_per_step: u32,
    pub max_nodes: u32,
    pub neighbor_distance: f32,
    pub agent_horizon: f32,
    pub wall_horizon: f32,
    pub host: tl_host,
    pub max_shared_goals: u32,
    pub max_groups: u32,
    pub max_members: u32,
    pub cookie: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_agent_def {
    pub position: tl_vec3,
    pub reach: f32,
    pub radius: f32,
    pub height: f32,
    pub max_speed: f32,
    pub max_acceleration: f32,
    pub arrive_distance: f32,
    pub priority: f32,
    pub filter: u32,
    pub is_fixed: bool,
    pub cookie: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_agent_state {
    pub status: tl_nav_agent_status,
    pub position: tl_vec3,
    pub velocity: tl_vec3,
    pub wanted: tl_vec3,
    pub polygon: tl_nav_ref,
    pub link: tl_nav_ref,
    pub goal: tl_vec3,
    pub radius: f32,
    pub height: f32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_formation_slot {
    pub forward: f32,
    pub left: f32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_group_def {
    pub formation: tl_nav_formation,
    pub spacing: f32,
    pub wait_distance: f32,
    pub lost_distance: f32,
    pub slots: *const tl_nav_formation_slot,
    pub keep_order: bool,
    pub cookie: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_group_state {
    pub formation: tl_nav_formation,
    pub count: u32,
    pub in_place: u32,
    pub on_trail: u32,
    pub lag: f32,
    pub speed: f32,
    pub heading: tl_vec3,
    pub leader: tl_nav_agent,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_crowd_step_report {
    pub searched: u32,
    pub waiting: u32,
    pub walking: u32,
    pub arrived: u32,
    pub unreachable: u32,
    pub on_link: u32,
    pub off_mesh: u32,
    pub shared: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_detour_report {
    pub base: tl_report,
    pub tile_count: u32,
    pub polygon_count: u32,
    pub plain_patches: u32,
    pub dropped_polygons: u32,
    pub one_way_links: u32,
    pub off_mesh_links: u32,
    pub off_mesh_outside: u32,
    pub off_mesh_far: u32,
    pub area_zeros: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_detour_tiles {
    pub tiles: *mut *mut tl_nav_tile,
    pub tile_count: u32,
    pub allocator: tl_allocator,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_detour_read_def {
    pub cell_height: f32,
    pub allocator: *const tl_allocator,
    pub cookie: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_detour_off_mesh {
    pub start: tl_vec3,
    pub end: tl_vec3,
    pub radius: f32,
    pub user_id: u32,
    pub flags: u16,
    pub area: u8,
    pub both_ways: bool,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_detour_set {
    pub tiles: *const *mut tl_nav_tile,
    pub tile_count: u32,
    pub off_mesh: *const tl_detour_off_mesh,
    pub off_mesh_count: u32,
    pub refs: tl_detour_refs,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_jump_link {
    pub start: tl_vec3,
    pub end: tl_vec3,
    pub apex: f32,
    pub kind: u8,
    pub both_ways: u8,
    pub reserved: u16,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_links {
    pub blob: tl_blob,
    pub link_count: u32,
    pub kind_counts: [u32; 3],
    pub agent_radius: f32,
    pub agent_height: f32,
    pub agent_max_climb: f32,
    pub margin: f32,
    pub links: u64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_links_def {
    pub spacing: f32,
    pub max_drop: f32,
    pub max_jump: f32,
    pub jump_height: f32,
    pub max_speed: f32,
    pub gravity: f32,
    pub max_climb: f32,
    pub min_gain: f32,
    pub max_nodes: u32,
    pub host: tl_host,
    pub cookie: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_links_count {
    pub tried: u32,
    pub blocked: u32,
    pub useless: u32,
    pub kept: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_links_report {
    pub base: tl_report,
    pub ledge_count: u32,
    pub sample_count: u32,
    pub no_landing: u32,
    pub too_fast: u32,
    pub kinds: [tl_nav_links_count; 3],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_obstacle {
    pub shape: tl_nav_obstacle_shape,
    pub area: u8,
    pub base: tl_vec3,
    pub height: f32,
    pub radius: f32,
    pub half_x: f32,
    pub half_z: f32,
    pub cosine: f32,
    pub sine: f32,
    pub points: [tl_vec3; 16],
    pub point_count: u32,
    pub convex: tl_convex,
    pub pose: tl_transform,
}
#[repr(C)]
pub struct tl_nav_obstacles {
    _private: [u8; 0],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_rebaked_tile {
    pub tile_x: i32,
    pub tile_z: i32,
    pub stack: tl_nav_tile_stack,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_prepare_def {
    pub table_bytes: u64,
    pub tasks: *const tl_tasks,
    pub progress: *const tl_progress,
    pub cookie: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_prepared {
    pub base: tl_report,
    pub kind: tl_nav_prepared_kind,
    pub corner_vertex_count: u32,
    pub edge_count: u32,
    pub renewed_count: u32,
    pub bytes: u64,
    pub table_bytes: u64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_pack_item {
    pub r#type: u32,
    pub id: u32,
    pub bytes: *const c_void,
    pub size: u64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_pack_chunk {
    pub r#type: u32,
    pub id: u32,
    pub bytes: *const c_void,
    pub size: u64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_pack {
    pub bytes: *const c_void,
    pub size: u64,
    pub chunk_count: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_pack_entry {
    pub r#type: u32,
    pub id: u32,
    pub offset: u64,
    pub size: u64,
    pub hash: u64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_pack_index {
    pub entries: *const tl_pack_entry,
    pub count: u32,
    pub file_size: u64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_pack_meta {
    pub blob: tl_blob,
    pub source_vertices: u64,
    pub source_triangles: u64,
    pub bounds: tl_aabb,
    pub name_size: u32,
    pub source_up: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_pack_frame {
    pub blob: tl_blob,
    pub origin: [f64; 3],
    pub axes: u32,
    pub reserved: [u32; 5],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_pack_navmesh {
    pub blob: tl_blob,
    pub cell_size: f32,
    pub cell_height: f32,
    pub agent_height: f32,
    pub agent_radius: f32,
    pub agent_max_climb: f32,
    pub agent_max_slope: f32,
    pub region_min_size: f32,
    pub region_merge_size: f32,
    pub edge_max_len: f32,
    pub edge_max_error: f32,
    pub max_verts_per_poly: u32,
    pub detail_sample_dist: f32,
    pub detail_sample_max_error: f32,
    pub partition: u32,
    pub filters: u32,
    pub tile_size: u32,
    pub tiles_x: u32,
    pub tiles_z: u32,
    pub tile_count: u32,
    pub bounds: tl_aabb,
    pub polygon_method: u32,
    pub tile_height: f32,
    pub reserved: [u32; 5],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_pack_volume {
    pub kind: u32,
    pub area: u32,
    pub r#box: tl_aabb,
    pub base: tl_vec3,
    pub radius: f32,
    pub height: f32,
    pub first_point: u32,
    pub point_count: u32,
    pub reserved: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_pack_volumes {
    pub blob: tl_blob,
    pub count: u32,
    pub point_count: u32,
    pub reserved: [u32; 10],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_pack_pruning {
    pub blob: tl_blob,
    pub min_area: f64,
    pub seed_extents: tl_vec3,
    pub seed_count: u32,
    pub drop_inside_solids: u32,
    pub reserved: [u32; 5],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_pack_offmesh_link {
    pub start: tl_vec3,
    pub end: tl_vec3,
    pub radius: f32,
    pub cost_factor: f32,
    pub fixed_cost: f32,
    pub area: u32,
    pub both_ways: u32,
    pub reserved: u32,
    pub flags: u64,
    pub user: u64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_pack_offmesh {
    pub blob: tl_blob,
    pub count: u32,
    pub reserved: [u32; 11],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_pack_areas {
    pub blob: tl_blob,
    pub count: u32,
    pub reserved: [u32; 11],
}
#[repr(C)]
pub struct tl_nav_world {
    _private: [u8; 0],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_world_def {
    pub read: Option<tl_nav_world_read_fn>,
    pub user: *mut c_void,
    pub budget: u64,
    pub frame_reach: f64,
    pub allocator: *const tl_allocator,
    pub cookie: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_world_interest {
    pub point: [f64; 3],
    pub radius: f64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_world_load {
    pub world: *mut tl_nav_world,
    pub place: u32,
    pub tile_x: i32,
    pub tile_z: i32,
    pub result: tl_result,
    pub advice: *const c_char,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_world_state {
    pub places: u32,
    pub loaded: u32,
    pub loading: u32,
    pub ready: u32,
    pub missing: u32,
    pub failed: u32,
    pub frames: u32,
    pub bytes: u64,
    pub peak_bytes: u64,
    pub index_bytes: u64,
    pub read_bytes: u64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_routes {
    pub blob: tl_blob,
    pub tiles_hash: [u32; 2],
    pub gate_count: u32,
    pub length_count: u32,
    pub block: u32,
    pub reserved: [u32; 7],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_routes_def {
    pub read: Option<tl_nav_world_read_fn>,
    pub user: *mut c_void,
    pub block: u32,
    pub host: tl_host,
    pub cookie: u32,
}
#[repr(C)]
pub struct tl_nav_router {
    _private: [u8; 0],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_world_route_request {
    pub start: tl_nav_location,
    pub goal: tl_nav_location,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_world_route_point {
    pub point: [f64; 3],
    pub length: f64,
    pub tile_x: i32,
    pub tile_z: i32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_world_route {
    pub status: tl_nav_path_status,
    pub point_count: u32,
    pub length: f64,
    pub lower_bound: f64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_pvs_def {
    pub eye_height: f32,
    pub max_distance: f32,
    pub filter: *const tl_ray_filter,
    pub host: tl_host,
    pub cookie: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_pvs {
    pub blob: tl_blob,
    pub slot_count: u32,
    pub polygon_count: u32,
    pub words: u32,
    pub eye_height: f32,
    pub first: u64,
    pub rows: u64,
    pub pair_count: u64,
    pub reserved: u64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_cover_request {
    pub navmesh: *const tl_navmesh,
    pub soup: *const tl_soup,
    pub filter: *const tl_nav_filter,
    pub agent: tl_nav_location,
    pub threat: tl_vec3,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_cover_def {
    pub heights: [f32; 8],
    pub height_count: u32,
    pub spacing: f32,
    pub max_length: f32,
    pub sight_filter: *const tl_ray_filter,
    pub cookie: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_cover {
    pub location: tl_nav_location,
    pub length: f32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_polygon_state {
    pub flags: u64,
    pub area: u8,
}
#[repr(C)]
pub struct tl_nav_versions {
    _private: [u8; 0],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_versions_state {
    pub version_count: u32,
    pub newest: u64,
    pub oldest: u64,
    pub waiting_bytes: u64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_wide_path {
    pub status: tl_nav_wide_status,
    pub corner_count: u32,
    pub wall_distance: f64,
    pub length: f64,
    pub surface_length: f64,
    pub node_count: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_wide_def {
    pub max_radius: f32,
    pub cookie: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_nav_wide_report {
    pub base: tl_report,
    pub bytes: u64,
    pub wall_count: u64,
    pub tile_count: u32,
    pub made_tile_count: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_scene_placement {
    pub group: u32,
    pub pose: tl_transform,
    pub scale: f32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_scene_group {
    pub instances: *const tl_scene_instance,
    pub instance_count: u32,
    pub placements: *const tl_scene_placement,
    pub placement_count: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_scene_copy {
    pub pose: tl_transform,
    pub scale: f32,
    pub group: u32,
    pub parent: u32,
    pub placement: u32,
    pub first_instance: u32,
    pub instance_count: u32,
    pub copy_count: u32,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_scene_expansion {
    pub instances: *mut tl_scene_instance,
    pub instance_count: u32,
    pub copies: *mut tl_scene_copy,
    pub copy_count: u32,
    pub allocator: tl_allocator,
}
#[repr(C)]
pub struct tl_scene_versions {
    _private: [u8; 0],
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_scene_version {
    pub scene: *const tl_scene,
    pub instances: *const tl_scene_instance,
    pub count: u32,
    pub number: u64,
}
#[repr(C)]
#[derive(Clone, Copy)]
pub struct tl_scene_versions_state {
    pub version_count: u32,
    pub newest: u64,
    pub oldest: u64,
}
extern "C" {
    pub fn tl_result_name(result: tl_result) -> *const c_char;
    pub fn tl_result_text(result: tl_result) -> *const c_char;
    pub fn tl_version() -> *const c_char;
    pub fn tl_blob_free(blob: *mut c_void);
    pub fn tl_halfedge_mesh_init(mesh: *mut tl_halfedge_mesh, allocator: *const tl_allocator);
    pub fn tl_halfedge_mesh_destroy(mesh: *mut tl_halfedge_mesh);
    pub fn tl_halfedge_mesh_clear(mesh: *mut tl_halfedge_mesh);
    pub fn tl_halfedge_mesh_add_vertex(
        mesh: *mut tl_halfedge_mesh,
        position: tl_vec3,
        vertex_out: *mut u32,
    ) -> tl_result;
    pub fn tl_halfedge_mesh_remove_vertex(mesh: *mut tl_halfedge_mesh, vertex: u32) -> tl_result;
    pub fn tl_halfedge_mesh_add_face(
        mesh: *mut tl_halfedge_mesh,
        vertices: *const u32,
        count: u32,
        face_out: *mut u32,
    ) -> tl_result;
    pub fn tl_halfedge_mesh_add_triangle(
        mesh: *mut tl_halfedge_mesh,
        a: u32,
        b: u32,
        c: u32,
        face_out: *mut u32,
    ) -> tl_result;
    pub fn tl_halfedge_mesh_remove_face(mesh: *mut tl_halfedge_mesh, face: u32) -> tl_result;
    pub fn tl_halfedge_mesh_find_edge(mesh: *const tl_halfedge_mesh, from: u32, to: u32) -> u32;
    pub fn tl_halfedge_mesh_vertex_edges(
        mesh: *const tl_halfedge_mesh,
        vertex: u32,
        edges_out: *mut u32,
        capacity: u32,
    ) -> u32;
    pub fn tl_halfedge_mesh_vertex_neighbours(
        mesh: *const tl_halfedge_mesh,
        vertex: u32,
        vertices_out: *mut u32,
        capacity: u32,
    ) -> u32;
    pub fn tl_halfedge_mesh_vertex_faces(
        mesh: *const tl_halfedge_mesh,
        vertex: u32,
        faces_out: *mut u32,
        capacity: u32,
    ) -> u32;
    pub fn tl_halfedge_mesh_face_vertices(
        mesh: *const tl_halfedge_mesh,
        face: u32,
        vertices_out: *mut u32,
        capacity: u32,
    ) -> u32;
    pub fn tl_halfedge_mesh_next_boundary_loop(mesh: *const tl_halfedge_mesh, from: u32) -> u32;
    pub fn tl_halfedge_mesh_check(
        mesh: *const tl_halfedge_mesh,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_halfedge_mesh_support(
        mesh: *const tl_halfedge_mesh,
        direction: tl_vec3,
        hint: u32,
    ) -> u32;
    pub fn tl_default_hull_def() -> tl_hull_def;
    pub fn tl_hull_bake(
        points: *const tl_vec3,
        count: u32,
        def: *const tl_hull_def,
        hull_out: *mut *mut tl_hull,
        report_out: *mut tl_hull_report,
    ) -> tl_result;
    pub fn tl_hull_transform(
        hull: *const tl_hull,
        scale: tl_vec3,
        pose: tl_transform,
        host: *const tl_host,
        hull_out: *mut *mut tl_hull,
        report_out: *mut tl_hull_report,
    ) -> tl_result;
    pub fn tl_hull_to_halfedge(hull: *const tl_hull, mesh: *mut tl_halfedge_mesh) -> tl_result;
    pub fn tl_hull_check(bytes: *const c_void, size: u64, report_out: *mut tl_report) -> tl_result;
    pub fn tl_hull_validate(
        hull: *const tl_hull,
        points: *const tl_vec3,
        count: u32,
        validation_out: *mut tl_hull_validation,
    ) -> tl_result;
    pub fn tl_hull_support(hull: *const tl_hull, direction: tl_vec3, hint: u32) -> u32;
    pub fn tl_hull_cast_ray(
        hull: *const tl_hull,
        origin: tl_vec3,
        direction: tl_vec3,
        max_t: f32,
        hit_out: *mut tl_hull_hit,
    ) -> bool;
    pub fn tl_hull_clip_ray(
        hull: *const tl_hull,
        origin: *const f64,
        direction: *const f64,
        max_t: f64,
        t_out: *mut f64,
        face_out: *mut u32,
    ) -> bool;
    pub fn tl_hull_contains(hull: *const tl_hull, point: tl_vec3) -> bool;
    pub fn tl_convex_from_hull(hull: *const tl_hull, radius: f32) -> tl_convex;
    pub fn tl_convex_from_points(points: *const tl_vec3, count: u32, radius: f32) -> tl_convex;
    pub fn tl_convex_box(center: tl_vec3, half_extents: tl_vec3, radius: f32) -> tl_convex;
    pub fn tl_convex_sphere(center: tl_vec3, radius: f32) -> tl_convex;
    pub fn tl_convex_capsule(a: tl_vec3, b: tl_vec3, radius: f32) -> tl_convex;
    pub fn tl_convex_triangle(a: tl_vec3, b: tl_vec3, c: tl_vec3, radius: f32) -> tl_convex;
    pub fn tl_convex_cylinder(a: tl_vec3, b: tl_vec3, disc_radius: f32, radius: f32) -> tl_convex;
    pub fn tl_convex_cone(base: tl_vec3, apex: tl_vec3, disc_radius: f32, radius: f32)
        -> tl_convex;
    pub fn tl_convex_custom(
        support: Option<tl_convex_support_fn>,
        user: *mut c_void,
        radius: f32,
    ) -> tl_convex;
    pub fn tl_convex_bounds(shape: *const tl_convex, pose: tl_transform) -> tl_aabb;
    pub fn tl_convex_distance(
        a: *const tl_convex,
        pose_a: tl_transform,
        b: *const tl_convex,
        pose_b: tl_transform,
        cache: *mut tl_simplex_cache,
        separation_out: *mut tl_separation,
    );
    pub fn tl_convex_overlap(
        a: *const tl_convex,
        pose_a: tl_transform,
        b: *const tl_convex,
        pose_b: tl_transform,
        cache: *mut tl_simplex_cache,
    ) -> bool;
    pub fn tl_convex_penetration(
        a: *const tl_convex,
        pose_a: tl_transform,
        b: *const tl_convex,
        pose_b: tl_transform,
        cache: *mut tl_simplex_cache,
        penetration_out: *mut tl_penetration,
    ) -> bool;
    pub fn tl_convex_penetration_within(
        a: *const tl_convex,
        pose_a: tl_transform,
        b: *const tl_convex,
        pose_b: tl_transform,
        cache: *mut tl_simplex_cache,
        max_steps: u32,
        penetration_out: *mut tl_penetration,
    ) -> bool;
    pub fn tl_convex_cast(
        a: *const tl_convex,
        pose_a: tl_transform,
        b: *const tl_convex,
        pose_b: tl_transform,
        motion: tl_vec3,
        hit_out: *mut tl_convex_hit,
    ) -> bool;
    pub fn tl_convex_cast_turning(
        a: *const tl_convex,
        pose_a: tl_transform,
        b: *const tl_convex,
        from: tl_transform,
        to: tl_transform,
        gap: f32,
        hit_out: *mut tl_convex_hit,
    ) -> bool;
    pub fn tl_convex_cast_ray(
        shape: *const tl_convex,
        pose: tl_transform,
        origin: tl_vec3,
        direction: tl_vec3,
        t_max: f32,
        hit_out: *mut tl_convex_hit,
    ) -> bool;
    pub fn tl_convex_contacts(
        a: *const tl_convex,
        pose_a: tl_transform,
        b: *const tl_convex,
        pose_b: tl_transform,
        limits: *const tl_contact_limits,
        cache: *mut tl_contact_cache,
        manifold_out: *mut tl_contact_manifold,
    ) -> u32;
    pub fn tl_convex_contacts_along(
        a: *const tl_convex,
        pose_a: tl_transform,
        b: *const tl_convex,
        pose_b: tl_transform,
        normal: tl_vec3,
        limits: *const tl_contact_limits,
        manifold_out: *mut tl_contact_manifold,
    ) -> u32;
    pub fn tl_scaled_convex_make(
        shape: *const tl_convex,
        scale: tl_vec3,
        scaled_out: *mut tl_scaled_convex,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_default_mesh_def() -> tl_mesh_def;
    pub fn tl_mesh_bake(
        view: *const tl_mesh_view,
        def: *const tl_mesh_def,
        mesh_out: *mut tl_mesh,
        report_out: *mut tl_mesh_report,
    ) -> tl_result;
    pub fn tl_mesh_free(mesh: *mut tl_mesh);
    pub fn tl_mesh_as_view(mesh: *const tl_mesh) -> tl_mesh_view;
    pub fn tl_adjacency_bake(
        view: *const tl_mesh_view,
        host: *const tl_host,
        adjacency_out: *mut tl_adjacency,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_adjacency_free(adjacency: *mut tl_adjacency);
    pub fn tl_closed_parts_find(
        view: *const tl_mesh_view,
        host: *const tl_host,
        parts_out: *mut tl_closed_parts,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_closed_parts_free(parts: *mut tl_closed_parts);
    pub fn tl_default_soup_def() -> tl_soup_def;
    pub fn tl_soup_bake(
        view: *const tl_mesh_view,
        def: *const tl_soup_def,
        soup_out: *mut *mut tl_soup,
        report_out: *mut tl_soup_report,
    ) -> tl_result;
    pub fn tl_soup_refit(
        soup: *mut tl_soup,
        moved: *const tl_mesh_view,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_soup_check(bytes: *const c_void, size: u64, report_out: *mut tl_report) -> tl_result;
    pub fn tl_soup_size(soup: *const tl_soup) -> u64;
    pub fn tl_soup_bounds(soup: *const tl_soup) -> tl_aabb;
    pub fn tl_soup_get_stats(soup: *const tl_soup) -> tl_soup_stats;
    pub fn tl_soup_cast_ray(
        soup: *const tl_soup,
        ray: *const tl_ray,
        filter: *const tl_ray_filter,
        hit_out: *mut tl_ray_hit,
    ) -> bool;
    pub fn tl_soup_occluded(
        soup: *const tl_soup,
        ray: *const tl_ray,
        filter: *const tl_ray_filter,
    ) -> bool;
    pub fn tl_soup_cast_segment(
        soup: *const tl_soup,
        a: tl_vec3,
        b: tl_vec3,
        filter: *const tl_ray_filter,
        hit_out: *mut tl_ray_hit,
    ) -> bool;
    pub fn tl_soup_line_of_sight(
        soup: *const tl_soup,
        a: tl_vec3,
        b: tl_vec3,
        filter: *const tl_ray_filter,
    ) -> bool;
    pub fn tl_soup_cast_rays(
        soup: *const tl_soup,
        rays: *const tl_ray,
        count: u32,
        filter: *const tl_ray_filter,
        host: *const tl_host,
        hits_out: *mut tl_ray_hit,
    );
    pub fn tl_soup_cast_segments(
        soup: *const tl_soup,
        segments: *const tl_segment,
        count: u32,
        filter: *const tl_ray_filter,
        host: *const tl_host,
        hits_out: *mut tl_ray_hit,
    );
    pub fn tl_soup_occluded_rays(
        soup: *const tl_soup,
        rays: *const tl_ray,
        count: u32,
        filter: *const tl_ray_filter,
        host: *const tl_host,
        occluded_out: *mut bool,
    );
    pub fn tl_soup_lines_of_sight(
        soup: *const tl_soup,
        segments: *const tl_segment,
        count: u32,
        filter: *const tl_ray_filter,
        host: *const tl_host,
        clear_out: *mut bool,
    );
    pub fn tl_soup_cast_ray_all(
        soup: *const tl_soup,
        ray: *const tl_ray,
        rule: tl_hit_rule,
        filter: *const tl_ray_filter,
        hits_out: *mut tl_ray_hit,
        capacity: u32,
        count_out: *mut u32,
    ) -> tl_result;
    pub fn tl_soup_nearest(
        soup: *const tl_soup,
        point: tl_vec3,
        max_distance: f32,
        filter: *const tl_ray_filter,
        nearest_out: *mut tl_soup_point,
    ) -> tl_result;
    pub fn tl_soup_overlaps(
        soup: *const tl_soup,
        shape: *const tl_convex,
        pose: tl_transform,
        filter: *const tl_ray_filter,
        overlaps_out: *mut bool,
    ) -> tl_result;
    pub fn tl_soup_find_overlaps(
        soup: *const tl_soup,
        shape: *const tl_convex,
        pose: tl_transform,
        filter: *const tl_ray_filter,
        triangles_out: *mut u32,
        capacity: u32,
        count_out: *mut u32,
    ) -> tl_result;
    pub fn tl_soup_cast_shape(
        soup: *const tl_soup,
        shape: *const tl_convex,
        pose: tl_transform,
        motion: tl_vec3,
        filter: *const tl_ray_filter,
        hit_out: *mut tl_shape_hit,
    ) -> tl_result;
    pub fn tl_soup_find_contacts(
        soup: *const tl_soup,
        query: *const tl_soup_contact_query,
        contacts_out: *mut tl_soup_contact,
        capacity: u32,
        count_out: *mut u32,
    ) -> tl_result;
    pub fn tl_soup_locate(
        soup: *const tl_soup,
        point: tl_vec3,
        location_out: *mut tl_soup_location,
    ) -> tl_result;
    pub fn tl_soup_check_closed(
        soup: *const tl_soup,
        host: *const tl_host,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_soup_next_triangle(
        soup: *const tl_soup,
        cursor: *mut u64,
        triangle_out: *mut tl_soup_triangle,
    ) -> bool;
    pub fn tl_soup_next_pair(
        soup: *const tl_soup,
        cursor: *mut u64,
        pair_out: *mut tl_soup_pair,
    ) -> bool;
    pub fn tl_soup_triangles_in_box(
        soup: *const tl_soup,
        r#box: tl_aabb,
        found: Option<tl_soup_triangle_fn>,
        user: *mut c_void,
    ) -> bool;
    pub fn tl_soup_bvh_boxes(
        soup: *const tl_soup,
        max_depth: u32,
        visit: Option<tl_soup_bvh_box_fn>,
        user: *mut c_void,
    ) -> bool;
    pub fn tl_scaled_soup_nearest(
        scaled: *const tl_scaled_soup,
        point: tl_vec3,
        max_distance: f32,
        filter: *const tl_ray_filter,
        nearest_out: *mut tl_soup_point,
    ) -> tl_result;
    pub fn tl_scaled_soup_overlaps(
        scaled: *const tl_scaled_soup,
        shape: *const tl_convex,
        pose: tl_transform,
        filter: *const tl_ray_filter,
        overlaps_out: *mut bool,
    ) -> tl_result;
    pub fn tl_scaled_soup_find_overlaps(
        scaled: *const tl_scaled_soup,
        shape: *const tl_convex,
        pose: tl_transform,
        filter: *const tl_ray_filter,
        triangles_out: *mut u32,
        capacity: u32,
        count_out: *mut u32,
    ) -> tl_result;
    pub fn tl_scaled_soup_cast_shape(
        scaled: *const tl_scaled_soup,
        shape: *const tl_convex,
        pose: tl_transform,
        motion: tl_vec3,
        filter: *const tl_ray_filter,
        hit_out: *mut tl_shape_hit,
    ) -> tl_result;
    pub fn tl_scene_bake(
        instances: *const tl_scene_instance,
        count: u32,
        host: *const tl_host,
        scene_out: *mut *mut tl_scene,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_scene_refit(
        scene: *mut tl_scene,
        instances: *const tl_scene_instance,
        count: u32,
        growth_out: *mut f32,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_scene_bounds(scene: *const tl_scene) -> tl_aabb;
    pub fn tl_scene_get_stats(scene: *const tl_scene) -> tl_scene_stats;
    pub fn tl_scene_cast_ray(
        scene: *const tl_scene,
        instances: *const tl_scene_instance,
        ray: *const tl_ray,
        filter: *const tl_scene_filter,
        hit_out: *mut tl_scene_hit,
    ) -> bool;
    pub fn tl_scene_occluded(
        scene: *const tl_scene,
        instances: *const tl_scene_instance,
        ray: *const tl_ray,
        filter: *const tl_scene_filter,
    ) -> bool;
    pub fn tl_scene_line_of_sight(
        scene: *const tl_scene,
        instances: *const tl_scene_instance,
        a: tl_vec3,
        b: tl_vec3,
        filter: *const tl_scene_filter,
    ) -> bool;
    pub fn tl_scene_cast_shape(
        scene: *const tl_scene,
        instances: *const tl_scene_instance,
        shape: *const tl_convex,
        pose: tl_transform,
        motion: tl_vec3,
        filter: *const tl_scene_filter,
        hit_out: *mut tl_scene_shape_hit,
    ) -> tl_result;
    pub fn tl_scene_overlaps(
        scene: *const tl_scene,
        instances: *const tl_scene_instance,
        query: *const tl_scene_overlap_query,
        overlaps_out: *mut bool,
    ) -> tl_result;
    pub fn tl_scene_find_overlaps(
        scene: *const tl_scene,
        instances: *const tl_scene_instance,
        query: *const tl_scene_overlap_query,
        overlaps_out: *mut tl_scene_overlap,
        capacity: u32,
        count_out: *mut u32,
    ) -> tl_result;
    pub fn tl_scene_nearest(
        scene: *const tl_scene,
        instances: *const tl_scene_instance,
        point: tl_vec3,
        max_distance: f32,
        filter: *const tl_scene_filter,
        nearest_out: *mut tl_scene_point,
    ) -> tl_result;
    pub fn tl_scene_instances_in_box(
        scene: *const tl_scene,
        r#box: tl_aabb,
        filter: *const tl_scene_filter,
        found: Option<tl_scene_instance_fn>,
        user: *mut c_void,
    ) -> bool;
    pub fn tl_default_character_def() -> tl_character_def;
    pub fn tl_character_mover_create(
        def: *const tl_character_def,
        mover_out: *mut *mut tl_character_mover,
        report: *mut tl_report,
    ) -> tl_result;
    pub fn tl_character_mover_destroy(mover: *mut tl_character_mover);
    pub fn tl_character_move(
        mover: *mut tl_character_mover,
        level: *const tl_character_level,
        step: *const tl_character_step,
        character: *mut tl_character,
        report_out: *mut tl_character_report,
    ) -> tl_result;
    pub fn tl_default_decompose_def() -> tl_decompose_def;
    pub fn tl_decomposition_bake(
        view: *const tl_mesh_view,
        def: *const tl_decompose_def,
        decomposition_out: *mut tl_decomposition,
        report_out: *mut tl_decompose_report,
    ) -> tl_result;
    pub fn tl_decomposition_free(decomposition: *mut tl_decomposition);
    pub fn tl_default_polygon_def() -> tl_polygon_def;
    pub fn tl_polygon_mesh_bake(
        contours: *const tl_contour_set,
        def: *const tl_polygon_def,
        mesh_out: *mut tl_polygon_mesh,
        report_out: *mut tl_polygon_report,
    ) -> tl_result;
    pub fn tl_polygon_mesh_free(mesh: *mut tl_polygon_mesh);
    pub fn tl_polygon_mesh_measure(mesh: *const tl_polygon_mesh) -> tl_polygon_quality;
    pub fn tl_polygon_fault_text(fault: tl_polygon_fault) -> *const c_char;
    pub fn tl_polygon_mesh_check(
        mesh: *const tl_polygon_mesh,
        contours: *const tl_contour_set,
        allocator: *const tl_allocator,
        report_out: *mut tl_polygon_check_report,
    ) -> tl_result;
    pub fn tl_nav_detail_free(detail: *mut tl_nav_detail);
    pub fn tl_nav_tile_encode(
        source: *const tl_nav_tile_source,
        allocator: *const tl_allocator,
        tile_out: *mut *mut tl_nav_tile,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_tile_subset(
        tile: *const tl_nav_tile,
        keep: *const u8,
        allocator: *const tl_allocator,
        tile_out: *mut *mut tl_nav_tile,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_tile_stack_free(stack: *mut tl_nav_tile_stack);
    pub fn tl_nav_tile_divide(
        tile: *const tl_nav_tile,
        layers: *const u32,
        allocator: *const tl_allocator,
        stack_out: *mut tl_nav_tile_stack,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_tile_check(
        bytes: *const c_void,
        size: u64,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_tile_neighbour(tile: *const tl_nav_tile, polygon: u32, edge: u32) -> u32;
    pub fn tl_nav_tile_fit_boxes(tile: *mut tl_nav_tile);
    pub fn tl_nav_tile_copy(
        tile: *const tl_nav_tile,
        has_wide_flags: bool,
        allocator: *const tl_allocator,
        copy_out: *mut *mut tl_nav_tile,
    ) -> tl_result;
    pub fn tl_nav_tile_polygon_area(tile: *const tl_nav_tile, polygon: u32) -> f64;
    pub fn tl_navmesh_create(
        allocator: *const tl_allocator,
        navmesh_out: *mut *mut tl_navmesh,
    ) -> tl_result;
    pub fn tl_navmesh_reserve_tiles(navmesh: *mut tl_navmesh, count: u32) -> tl_result;
    pub fn tl_navmesh_destroy(navmesh: *mut tl_navmesh);
    pub fn tl_navmesh_add_tile(
        navmesh: *mut tl_navmesh,
        tile: *const tl_nav_tile,
        ownership: tl_nav_tile_ownership,
    ) -> tl_result;
    pub fn tl_navmesh_add_tiles(
        navmesh: *mut tl_navmesh,
        tiles: *const *mut tl_nav_tile,
        count: u32,
        ownership: tl_nav_tile_ownership,
        report: *mut tl_report,
    ) -> tl_result;
    pub fn tl_navmesh_remove_tile(navmesh: *mut tl_navmesh, tile_x: i32, tile_z: i32) -> tl_result;
    pub fn tl_navmesh_remove_layer(
        navmesh: *mut tl_navmesh,
        tile_x: i32,
        layer: u32,
        tile_z: i32,
    ) -> tl_result;
    pub fn tl_navmesh_replace_tiles(
        navmesh: *mut tl_navmesh,
        tile_x: i32,
        tile_z: i32,
        stack: *mut tl_nav_tile_stack,
    ) -> tl_result;
    pub fn tl_navmesh_find_tile(
        navmesh: *const tl_navmesh,
        tile_x: i32,
        tile_z: i32,
    ) -> *const tl_nav_tile;
    pub fn tl_navmesh_find_layer(
        navmesh: *const tl_navmesh,
        tile_x: i32,
        layer: u32,
        tile_z: i32,
    ) -> *const tl_nav_tile;
    pub fn tl_navmesh_tile_count(navmesh: *const tl_navmesh) -> u32;
    pub fn tl_navmesh_slot_count(navmesh: *const tl_navmesh) -> u32;
    pub fn tl_navmesh_slot_tile(navmesh: *const tl_navmesh, slot: u32) -> *const tl_nav_tile;
    pub fn tl_navmesh_link_count(navmesh: *const tl_navmesh) -> u64;
    pub fn tl_navmesh_edit_count(navmesh: *const tl_navmesh) -> u64;
    pub fn tl_navmesh_polygon_ref(
        navmesh: *const tl_navmesh,
        slot: u32,
        polygon: u32,
    ) -> tl_nav_ref;
    pub fn tl_navmesh_resolve(
        navmesh: *const tl_navmesh,
        r#ref: tl_nav_ref,
        tile_out: *mut *const tl_nav_tile,
        polygon_out: *mut u32,
    ) -> tl_result;
    pub fn tl_navmesh_links(
        navmesh: *const tl_navmesh,
        r#ref: tl_nav_ref,
        links_out: *mut tl_nav_link,
        capacity: u32,
        count_out: *mut u32,
    ) -> tl_result;
    pub fn tl_navmesh_island(
        navmesh: *const tl_navmesh,
        r#ref: tl_nav_ref,
        island_out: *mut u32,
    ) -> tl_result;
    pub fn tl_default_nav_offmesh() -> tl_nav_offmesh;
    pub fn tl_navmesh_add_offmesh(
        navmesh: *mut tl_navmesh,
        offmesh: *const tl_nav_offmesh,
        link_out: *mut tl_nav_ref,
        report: *mut tl_report,
    ) -> tl_result;
    pub fn tl_navmesh_reserve_offmesh(navmesh: *mut tl_navmesh, count: u32) -> tl_result;
    pub fn tl_navmesh_remove_offmesh(navmesh: *mut tl_navmesh, link: tl_nav_ref) -> tl_result;
    pub fn tl_navmesh_offmesh_state(
        navmesh: *const tl_navmesh,
        link: tl_nav_ref,
        state_out: *mut tl_nav_offmesh_state,
    ) -> tl_result;
    pub fn tl_navmesh_offmesh_count(navmesh: *const tl_navmesh) -> u32;
    pub fn tl_navmesh_next_offmesh(
        navmesh: *const tl_navmesh,
        cursor: *mut u32,
        link_out: *mut tl_nav_ref,
    ) -> bool;
    pub fn tl_navmesh_offmesh_from(
        navmesh: *const tl_navmesh,
        polygon: tl_nav_ref,
        links_out: *mut tl_nav_ref,
        capacity: u32,
        count_out: *mut u32,
    ) -> tl_result;
    pub fn tl_default_nav_filter() -> tl_nav_filter;
    pub fn tl_nav_filter_passes(
        filter: *const tl_nav_filter,
        tile: *const tl_nav_tile,
        polygon: u32,
    ) -> bool;
    pub fn tl_navmesh_find_nearest(
        navmesh: *const tl_navmesh,
        filter: *const tl_nav_filter,
        center: tl_vec3,
        half_extents: tl_vec3,
        location_out: *mut tl_nav_location,
    ) -> tl_result;
    pub fn tl_navmesh_find_nearest_reachable(
        navmesh: *const tl_navmesh,
        filter: *const tl_nav_filter,
        from: tl_nav_ref,
        point: tl_vec3,
        location_out: *mut tl_nav_location,
    ) -> tl_result;
    pub fn tl_navmesh_closest_point(
        navmesh: *const tl_navmesh,
        r#ref: tl_nav_ref,
        point: tl_vec3,
        closest_out: *mut tl_vec3,
        inside_out: *mut bool,
    ) -> tl_result;
    pub fn tl_navmesh_height(
        navmesh: *const tl_navmesh,
        r#ref: tl_nav_ref,
        x: f32,
        z: f32,
        height_out: *mut f32,
    ) -> tl_result;
    pub fn tl_default_nav_query_def() -> tl_nav_query_def;
    pub fn tl_nav_query_create(
        def: *const tl_nav_query_def,
        query_out: *mut *mut tl_nav_query,
        report: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_query_destroy(query: *mut tl_nav_query);
    pub fn tl_nav_query_reserve(query: *mut tl_nav_query, nodes: u32) -> tl_result;
    pub fn tl_nav_path_status_name(status: tl_nav_path_status) -> *const c_char;
    pub fn tl_nav_query_find_path(
        query: *mut tl_nav_query,
        navmesh: *const tl_navmesh,
        request: *const tl_nav_path_request,
        polygons_out: *mut tl_nav_ref,
        capacity: u32,
        path_out: *mut tl_nav_path,
    ) -> tl_result;
    pub fn tl_nav_query_begin_path(
        query: *mut tl_nav_query,
        navmesh: *const tl_navmesh,
        request: *const tl_nav_path_request,
    ) -> tl_result;
    pub fn tl_nav_query_step_path(
        query: *mut tl_nav_query,
        max_steps: u32,
        progress_out: *mut tl_nav_path_progress,
    ) -> tl_result;
    pub fn tl_nav_query_write_path(
        query: *mut tl_nav_query,
        polygons_out: *mut tl_nav_ref,
        capacity: u32,
        path_out: *mut tl_nav_path,
    ) -> tl_result;
    pub fn tl_navmesh_straight_path(
        navmesh: *const tl_navmesh,
        path: *const tl_nav_polygon_path,
        corners_out: *mut tl_nav_corner,
        capacity: u32,
        count_out: *mut u32,
        length_out: *mut f32,
    ) -> tl_result;
    pub fn tl_navmesh_trace_path(
        navmesh: *const tl_navmesh,
        request: *const tl_nav_trace_request,
        points_out: *mut tl_nav_trace_point,
        capacity: u32,
        count_out: *mut u32,
        cost_out: *mut f32,
    ) -> tl_result;
    pub fn tl_nav_query_find_shortest_path(
        query: *mut tl_nav_query,
        navmesh: *const tl_navmesh,
        request: *const tl_nav_path_request,
        buffers: *const tl_nav_path_buffers,
        path_out: *mut tl_nav_shortest_path,
    ) -> tl_result;
    pub fn tl_navmesh_cast_ray(
        navmesh: *const tl_navmesh,
        filter: *const tl_nav_filter,
        start: *const tl_nav_location,
        end: tl_vec3,
        polygons_out: *mut tl_nav_ref,
        capacity: u32,
        hit_out: *mut tl_nav_ray_hit,
    ) -> tl_result;
    pub fn tl_nav_query_move_along_surface(
        query: *mut tl_nav_query,
        navmesh: *const tl_navmesh,
        request: *const tl_nav_move_request,
        polygons_out: *mut tl_nav_ref,
        capacity: u32,
        move_out: *mut tl_nav_move,
    ) -> tl_result;
    pub fn tl_nav_query_find_wall(
        query: *mut tl_nav_query,
        navmesh: *const tl_navmesh,
        request: *const tl_nav_around_request,
        wall_out: *mut tl_nav_wall,
    ) -> tl_result;
    pub fn tl_nav_query_find_route(
        query: *mut tl_nav_query,
        navmesh: *const tl_navmesh,
        request: *const tl_nav_route_request,
        buffers: *const tl_nav_path_buffers,
        route_out: *mut tl_nav_route,
    ) -> tl_result;
    pub fn tl_nav_zone_circle(center: tl_vec3, radius: f32) -> tl_nav_zone;
    pub fn tl_nav_zone_polygon(points: *const tl_vec3, point_count: u32) -> tl_nav_zone;
    pub fn tl_navmesh_find_polygons(
        navmesh: *const tl_navmesh,
        filter: *const tl_nav_filter,
        zone: *const tl_nav_zone,
        heights: *const tl_nav_height_range,
        polygons_out: *mut tl_nav_ref,
        capacity: u32,
        count_out: *mut u32,
    ) -> tl_result;
    pub fn tl_default_nav_field_def() -> tl_nav_field_def;
    pub fn tl_nav_query_flood(
        query: *mut tl_nav_query,
        navmesh: *const tl_navmesh,
        start: *const tl_nav_location,
        def: *const tl_nav_field_def,
        entries_out: *mut tl_nav_field_entry,
        capacity: u32,
        count_out: *mut u32,
    ) -> tl_result;
    pub fn tl_nav_field_find(
        entries: *const tl_nav_field_entry,
        count: u32,
        polygon: tl_nav_ref,
    ) -> u32;
    pub fn tl_nav_field_path(
        entries: *const tl_nav_field_entry,
        count: u32,
        entry: u32,
        polygons_out: *mut tl_nav_ref,
        capacity: u32,
        count_out: *mut u32,
    ) -> tl_result;
    pub fn tl_nav_query_find_goal_tree(
        query: *mut tl_nav_query,
        navmesh: *const tl_navmesh,
        filter: *const tl_nav_filter,
        tree: *mut tl_nav_goal_tree,
    ) -> tl_result;
    pub fn tl_nav_goal_tree_path(
        tree: *const tl_nav_goal_tree,
        navmesh: *const tl_navmesh,
        request: *const tl_nav_goal_path_request,
        polygons_out: *mut tl_nav_ref,
        capacity: u32,
        path_out: *mut tl_nav_path,
    ) -> tl_result;
    pub fn tl_navmesh_polygon_walls(
        navmesh: *const tl_navmesh,
        filter: *const tl_nav_filter,
        polygon: tl_nav_ref,
        segments_out: *mut tl_nav_wall_segment,
        capacity: u32,
        count_out: *mut u32,
    ) -> tl_result;
    pub fn tl_nav_query_find_walls(
        query: *mut tl_nav_query,
        navmesh: *const tl_navmesh,
        request: *const tl_nav_around_request,
        segments_out: *mut tl_nav_wall_segment,
        capacity: u32,
        count_out: *mut u32,
    ) -> tl_result;
    pub fn tl_navmesh_random_point(
        navmesh: *const tl_navmesh,
        filter: *const tl_nav_filter,
        random: *const u64,
        location_out: *mut tl_nav_location,
    ) -> tl_result;
    pub fn tl_nav_query_random_reachable(
        query: *mut tl_nav_query,
        navmesh: *const tl_navmesh,
        request: *const tl_nav_around_request,
        random: *const u64,
        location_out: *mut tl_nav_location,
    ) -> tl_result;
    pub fn tl_nav_query_random_reachable_points(
        query: *mut tl_nav_query,
        navmesh: *const tl_navmesh,
        request: *const tl_nav_around_request,
        random: *const u64,
        count: u32,
        locations_out: *mut tl_nav_location,
    ) -> tl_result;
    pub fn tl_default_nav_def() -> tl_nav_def;
    pub fn tl_nav_tile_grid(
        def: *const tl_nav_def,
        level_bounds: tl_aabb,
        tiles_x_out: *mut u32,
        tiles_z_out: *mut u32,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_config_from_def(
        def: *const tl_nav_def,
        level_bounds: tl_aabb,
        tile_x: u32,
        tile_z: u32,
        config_out: *mut tl_nav_config,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_rasterize(
        config: *const tl_nav_config,
        mesh: *const tl_mesh_view,
        areas: *const u8,
        host: *const tl_host,
        heightfield_out: *mut tl_nav_heightfield,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_heightfield_free(heightfield: *mut tl_nav_heightfield);
    pub fn tl_nav_filter_low_hanging_obstacles(
        config: *const tl_nav_config,
        heightfield: *mut tl_nav_heightfield,
    );
    pub fn tl_nav_filter_ledge_spans(
        config: *const tl_nav_config,
        heightfield: *mut tl_nav_heightfield,
    );
    pub fn tl_nav_filter_walkable_low_height_spans(
        config: *const tl_nav_config,
        heightfield: *mut tl_nav_heightfield,
    );
    pub fn tl_nav_bake_compact(
        config: *const tl_nav_config,
        heightfield: *const tl_nav_heightfield,
        host: *const tl_host,
        compact_out: *mut tl_nav_compact,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_filter_and_compact(
        config: *const tl_nav_config,
        heightfield: *const tl_nav_heightfield,
        host: *const tl_host,
        compact_out: *mut tl_nav_compact,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_compact_free(compact: *mut tl_nav_compact);
    pub fn tl_nav_erode(
        config: *const tl_nav_config,
        host: *const tl_host,
        compact: *mut tl_nav_compact,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_mark_box_area(compact: *mut tl_nav_compact, r#box: tl_aabb, area: u8);
    pub fn tl_nav_mark_polygon_area(
        compact: *mut tl_nav_compact,
        points: *const tl_vec3,
        count: u32,
        min_y: f32,
        max_y: f32,
        area: u8,
    );
    pub fn tl_nav_mark_cylinder_area(
        compact: *mut tl_nav_compact,
        base: tl_vec3,
        radius: f32,
        height: f32,
        area: u8,
    );
    pub fn tl_nav_distance_field(
        host: *const tl_host,
        compact: *mut tl_nav_compact,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_bake_regions(
        config: *const tl_nav_config,
        host: *const tl_host,
        compact: *mut tl_nav_compact,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_bake_contours(
        config: *const tl_nav_config,
        compact: *const tl_nav_compact,
        host: *const tl_host,
        contours_out: *mut tl_nav_contours,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_contours_free(contours: *mut tl_nav_contours);
    pub fn tl_nav_bake_detail(
        config: *const tl_nav_config,
        compact: *const tl_nav_compact,
        polygons: *const tl_polygon_mesh,
        host: *const tl_host,
        detail_out: *mut tl_nav_detail,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_mark_volume_area(compact: *mut tl_nav_compact, volume: *const tl_nav_volume);
    pub fn tl_nav_areas_from_materials(
        mesh: *const tl_mesh_view,
        material_areas: *const u8,
        material_count: u32,
        areas_out: *mut u8,
    );
    pub fn tl_nav_stages_free(stages: *mut tl_nav_stages);
    pub fn tl_nav_assign_layers(
        config: *const tl_nav_config,
        polygons: *const tl_polygon_mesh,
        allocator: *const tl_allocator,
        layers_out: *mut u32,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_tile_bake(
        config: *const tl_nav_config,
        input: *const tl_nav_input,
        host: *const tl_host,
        stages_out: *mut tl_nav_stages,
        tile_out: *mut *mut tl_nav_tile,
        report_out: *mut tl_nav_bake_report,
    ) -> tl_result;
    pub fn tl_nav_tile_bake_from_compact(
        config: *const tl_nav_config,
        compact: *mut tl_nav_compact,
        host: *const tl_host,
        stack_out: *mut tl_nav_tile_stack,
        report_out: *mut tl_nav_bake_report,
    ) -> tl_result;
    pub fn tl_nav_tile_rebake(
        config: *const tl_nav_config,
        compact: *mut tl_nav_compact,
        base_area: *const u8,
        memo: *mut *mut tl_nav_tile_memo,
        host: *const tl_host,
        stack_out: *mut tl_nav_tile_stack,
        report_out: *mut tl_nav_bake_report,
    ) -> tl_result;
    pub fn tl_nav_tile_keeps_bytes(
        config: *const tl_nav_config,
        compact: *const tl_nav_compact,
        area_before: *const u8,
    ) -> bool;
    pub fn tl_nav_tile_memo_free(memo: *mut tl_nav_tile_memo);
    pub fn tl_nav_tile_memo_bytes(memo: *const tl_nav_tile_memo) -> u64;
    pub fn tl_nav_bake(
        def: *const tl_nav_def,
        input: *const tl_nav_input,
        tiles_out: *mut tl_nav_tiles,
        report_out: *mut tl_nav_bake_report,
    ) -> tl_result;
    pub fn tl_nav_tiles_free(tiles: *mut tl_nav_tiles);
    pub fn tl_nav_tiles_in_box(
        def: *const tl_nav_def,
        level_bounds: tl_aabb,
        r#box: tl_aabb,
        range_out: *mut tl_nav_tile_range,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_bake_range(
        def: *const tl_nav_def,
        input: *const tl_nav_input,
        range: tl_nav_tile_range,
        sink: *const tl_nav_stage_sink,
        block_out: *mut tl_nav_tile_block,
        report_out: *mut tl_nav_bake_report,
    ) -> tl_result;
    pub fn tl_nav_rebake(
        def: *const tl_nav_def,
        input: *const tl_nav_input,
        changed: tl_aabb,
        block_out: *mut tl_nav_tile_block,
        report_out: *mut tl_nav_bake_report,
    ) -> tl_result;
    pub fn tl_nav_tile_block_free(block: *mut tl_nav_tile_block);
    pub fn tl_nav_triangles_create(
        def: *const tl_nav_def,
        mesh: *const tl_mesh_view,
        triangles_out: *mut *mut tl_nav_triangles,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_triangles_destroy(triangles: *mut tl_nav_triangles);
    pub fn tl_nav_triangles_change(
        triangles: *mut tl_nav_triangles,
        mesh: *const tl_mesh_view,
        changed: *const u32,
        changed_count: u32,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_triangles_near(
        triangles: *mut tl_nav_triangles,
        input: *const tl_nav_input,
        changed: tl_aabb,
        near_out: *mut tl_nav_near_triangles,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_triangles_bytes(triangles: *const tl_nav_triangles) -> u64;
    pub fn tl_default_nav_prune_def() -> tl_nav_prune_def;
    pub fn tl_nav_prune(
        def: *const tl_nav_prune_def,
        tiles: *mut tl_nav_tiles,
        removed_out: *mut tl_nav_tiles,
        report_out: *mut tl_nav_prune_report,
    ) -> tl_result;
    pub fn tl_nav_probe_from_config(config: *const tl_nav_config) -> tl_nav_probe;
    pub fn tl_default_nav_audit_def() -> tl_nav_audit_def;
    pub fn tl_nav_finding_name(kind: tl_nav_finding_kind) -> *const c_char;
    pub fn tl_nav_audit_run(
        def: *const tl_nav_audit_def,
        navmesh: *const tl_navmesh,
        soup: *const tl_soup,
        audit_out: *mut tl_nav_audit,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_audit_free(audit: *mut tl_nav_audit);
    pub fn tl_nav_cause_name(cause: tl_nav_cause) -> *const c_char;
    pub fn tl_nav_cause_text(cause: tl_nav_cause) -> *const c_char;
    pub fn tl_nav_why(
        def: *const tl_nav_def,
        input: *const tl_nav_input,
        navmesh: *const tl_navmesh,
        pruning: *const tl_nav_pruning,
        point: tl_vec3,
        answer_out: *mut tl_nav_why_answer,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_corridor_init(path: *mut tl_nav_ref, capacity: u32) -> tl_nav_corridor;
    pub fn tl_nav_corridor_reset(corridor: *mut tl_nav_corridor, at: *const tl_nav_location);
    pub fn tl_nav_corridor_find(
        corridor: *mut tl_nav_corridor,
        query: *mut tl_nav_query,
        navmesh: *const tl_navmesh,
        filter: *const tl_nav_filter,
        goal: *const tl_nav_location,
        path_out: *mut tl_nav_path,
    ) -> tl_result;
    pub fn tl_nav_corridor_set_path(
        corridor: *mut tl_nav_corridor,
        navmesh: *const tl_navmesh,
        path: *const tl_nav_ref,
        count: u32,
        target: tl_vec3,
    ) -> tl_result;
    pub fn tl_nav_corridor_corners(
        corridor: *const tl_nav_corridor,
        navmesh: *const tl_navmesh,
        corners_out: *mut tl_nav_corner,
        capacity: u32,
        count_out: *mut u32,
    ) -> tl_result;
    pub fn tl_nav_corridor_move(
        corridor: *mut tl_nav_corridor,
        query: *mut tl_nav_query,
        navmesh: *const tl_navmesh,
        filter: *const tl_nav_filter,
        to: tl_vec3,
    ) -> tl_result;
    pub fn tl_nav_corridor_move_target(
        corridor: *mut tl_nav_corridor,
        query: *mut tl_nav_query,
        navmesh: *const tl_navmesh,
        filter: *const tl_nav_filter,
        to: tl_vec3,
    ) -> tl_result;
    pub fn tl_nav_corridor_pass_link(
        corridor: *mut tl_nav_corridor,
        navmesh: *const tl_navmesh,
        ends_out: *mut tl_nav_location,
        link_out: *mut tl_nav_ref,
    ) -> tl_result;
    pub fn tl_nav_corridor_shorten(
        corridor: *mut tl_nav_corridor,
        navmesh: *const tl_navmesh,
        filter: *const tl_nav_filter,
        range: f32,
        changed_out: *mut bool,
    ) -> tl_result;
    pub fn tl_nav_corridor_improve(
        corridor: *mut tl_nav_corridor,
        query: *mut tl_nav_query,
        navmesh: *const tl_navmesh,
        filter: *const tl_nav_filter,
        ahead: u32,
        max_steps: u32,
        changed_out: *mut bool,
    ) -> tl_result;
    pub fn tl_nav_corridor_check(
        corridor: *const tl_nav_corridor,
        navmesh: *const tl_navmesh,
        filter: *const tl_nav_filter,
        max_count: u32,
    ) -> u32;
    pub fn tl_nav_corridor_repair(
        corridor: *mut tl_nav_corridor,
        query: *mut tl_nav_query,
        navmesh: *const tl_navmesh,
        filter: *const tl_nav_filter,
        half_extents: tl_vec3,
        path_out: *mut tl_nav_path,
    ) -> tl_result;
    pub fn tl_default_nav_crowd_def() -> tl_nav_crowd_def;
    pub fn tl_nav_crowd_create(
        def: *const tl_nav_crowd_def,
        crowd_out: *mut *mut tl_nav_crowd,
        report: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_crowd_destroy(crowd: *mut tl_nav_crowd);
    pub fn tl_nav_crowd_set_filter(
        crowd: *mut tl_nav_crowd,
        place: u32,
        filter: *const tl_nav_filter,
    ) -> tl_result;
    pub fn tl_default_nav_agent_def() -> tl_nav_agent_def;
    pub fn tl_nav_agent_status_name(status: tl_nav_agent_status) -> *const c_char;
    pub fn tl_nav_crowd_add(
        crowd: *mut tl_nav_crowd,
        navmesh: *const tl_navmesh,
        def: *const tl_nav_agent_def,
        agent_out: *mut tl_nav_agent,
        report: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_crowd_remove(crowd: *mut tl_nav_crowd, agent: tl_nav_agent) -> tl_result;
    pub fn tl_nav_crowd_set_goal(
        crowd: *mut tl_nav_crowd,
        agent: tl_nav_agent,
        goal: *const tl_nav_location,
    ) -> tl_result;
    pub fn tl_nav_crowd_set_motion(
        crowd: *mut tl_nav_crowd,
        agent: tl_nav_agent,
        position: tl_vec3,
        velocity: tl_vec3,
    ) -> tl_result;
    pub fn tl_nav_crowd_agent(
        crowd: *const tl_nav_crowd,
        agent: tl_nav_agent,
        state_out: *mut tl_nav_agent_state,
    ) -> tl_result;
    pub fn tl_nav_crowd_corners(
        crowd: *const tl_nav_crowd,
        navmesh: *const tl_navmesh,
        agent: tl_nav_agent,
        corners_out: *mut tl_nav_corner,
        capacity: u32,
        count_out: *mut u32,
    ) -> tl_result;
    pub fn tl_nav_crowd_count(crowd: *const tl_nav_crowd) -> u32;
    pub fn tl_nav_crowd_next(
        crowd: *const tl_nav_crowd,
        cursor: *mut u32,
        agent_out: *mut tl_nav_agent,
    ) -> bool;
    pub fn tl_nav_formation_name(formation: tl_nav_formation) -> *const c_char;
    pub fn tl_default_nav_group_def() -> tl_nav_group_def;
    pub fn tl_nav_crowd_add_group(
        crowd: *mut tl_nav_crowd,
        def: *const tl_nav_group_def,
        agents: *const tl_nav_agent,
        count: u32,
        group_out: *mut tl_nav_group,
        report: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_crowd_remove_group(crowd: *mut tl_nav_crowd, group: tl_nav_group) -> tl_result;
    pub fn tl_nav_crowd_set_formation(
        crowd: *mut tl_nav_crowd,
        group: tl_nav_group,
        def: *const tl_nav_group_def,
        report: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_crowd_group(
        crowd: *const tl_nav_crowd,
        group: tl_nav_group,
        state_out: *mut tl_nav_group_state,
    ) -> tl_result;
    pub fn tl_nav_crowd_members(
        crowd: *const tl_nav_crowd,
        group: tl_nav_group,
        agents_out: *mut tl_nav_agent,
        capacity: u32,
        count_out: *mut u32,
    ) -> tl_result;
    pub fn tl_nav_crowd_group_of(crowd: *const tl_nav_crowd, agent: tl_nav_agent) -> tl_nav_group;
    pub fn tl_nav_crowd_step(
        crowd: *mut tl_nav_crowd,
        navmesh: *const tl_navmesh,
        dt: f32,
        report_out: *mut tl_nav_crowd_step_report,
    ) -> tl_result;
    pub fn tl_nav_crowd_state_size(crowd: *const tl_nav_crowd) -> usize;
    pub fn tl_nav_crowd_save(
        crowd: *const tl_nav_crowd,
        bytes_out: *mut c_void,
        capacity: usize,
    ) -> tl_result;
    pub fn tl_nav_crowd_restore(
        crowd: *mut tl_nav_crowd,
        bytes: *const c_void,
        size: usize,
        report: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_crowd_hash(crowd: *const tl_nav_crowd) -> u64;
    pub fn tl_detour_tile_size(tile: *const tl_nav_tile, refs: tl_detour_refs) -> u64;
    pub fn tl_detour_set_size(
        tiles: *const *mut tl_nav_tile,
        tile_count: u32,
        refs: tl_detour_refs,
    ) -> u64;
    pub fn tl_detour_tile_write(
        tile: *const tl_nav_tile,
        refs: tl_detour_refs,
        bytes: *mut c_void,
        capacity: u64,
        report_out: *mut tl_detour_report,
    ) -> tl_result;
    pub fn tl_detour_set_write(
        tiles: *const *mut tl_nav_tile,
        tile_count: u32,
        refs: tl_detour_refs,
        bytes: *mut c_void,
        capacity: u64,
        report_out: *mut tl_detour_report,
    ) -> tl_result;
    pub fn tl_default_detour_read_def() -> tl_detour_read_def;
    pub fn tl_detour_read(
        bytes: *const c_void,
        size: u64,
        def: *const tl_detour_read_def,
        tiles_out: *mut tl_detour_tiles,
        report_out: *mut tl_detour_report,
    ) -> tl_result;
    pub fn tl_detour_tiles_free(tiles: *mut tl_detour_tiles);
    pub fn tl_detour_read_off_mesh(
        bytes: *const c_void,
        size: u64,
        links_out: *mut tl_detour_off_mesh,
        capacity: u32,
        count_out: *mut u32,
        report_out: *mut tl_detour_report,
    ) -> tl_result;
    pub fn tl_detour_linked_set_size(set: *const tl_detour_set) -> u64;
    pub fn tl_detour_linked_set_write(
        set: *const tl_detour_set,
        bytes: *mut c_void,
        capacity: u64,
        report_out: *mut tl_detour_report,
    ) -> tl_result;
    pub fn tl_nav_link_kind_name(kind: tl_nav_link_kind) -> *const c_char;
    pub fn tl_default_nav_links_def() -> tl_nav_links_def;
    pub fn tl_nav_links_find(
        def: *const tl_nav_links_def,
        navmesh: *const tl_navmesh,
        soup: *const tl_soup,
        links_out: *mut *mut tl_nav_links,
        report_out: *mut tl_nav_links_report,
    ) -> tl_result;
    pub fn tl_nav_links_check(
        bytes: *const c_void,
        size: u64,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_links_add(
        links: *const tl_nav_links,
        prototype: *const tl_nav_offmesh,
        navmesh: *mut tl_navmesh,
    ) -> tl_result;
    pub fn tl_nav_jump_link_point(link: *const tl_nav_jump_link, t: f32) -> tl_vec3;
    pub fn tl_nav_obstacles_bake(
        def: *const tl_nav_def,
        input: *const tl_nav_input,
        obstacles_out: *mut *mut tl_nav_obstacles,
        block_out: *mut tl_nav_tile_block,
        report_out: *mut tl_nav_bake_report,
    ) -> tl_result;
    pub fn tl_nav_obstacles_destroy(obstacles: *mut tl_nav_obstacles);
    pub fn tl_nav_obstacles_set_tasks(
        obstacles: *mut tl_nav_obstacles,
        tasks: *const tl_tasks,
    ) -> tl_result;
    pub fn tl_nav_obstacles_add(
        obstacles: *mut tl_nav_obstacles,
        obstacle: *const tl_nav_obstacle,
        id_out: *mut tl_nav_obstacle_id,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_obstacles_move(
        obstacles: *mut tl_nav_obstacles,
        id: tl_nav_obstacle_id,
        obstacle: *const tl_nav_obstacle,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_obstacles_remove(
        obstacles: *mut tl_nav_obstacles,
        id: tl_nav_obstacle_id,
    ) -> tl_result;
    pub fn tl_nav_obstacles_count(obstacles: *const tl_nav_obstacles) -> u32;
    pub fn tl_nav_obstacles_waiting(obstacles: *const tl_nav_obstacles) -> u32;
    pub fn tl_nav_obstacles_bytes(obstacles: *const tl_nav_obstacles) -> u64;
    pub fn tl_nav_obstacles_rebake(
        obstacles: *mut tl_nav_obstacles,
        input: *const tl_nav_input,
        changed: tl_aabb,
        report_out: *mut tl_nav_bake_report,
    ) -> tl_result;
    pub fn tl_nav_obstacles_bake_next(
        obstacles: *mut tl_nav_obstacles,
        rebaked_out: *mut tl_nav_rebaked_tile,
        report_out: *mut tl_nav_bake_report,
    ) -> tl_result;
    pub fn tl_nav_obstacles_update(
        obstacles: *mut tl_nav_obstacles,
        navmesh: *mut tl_navmesh,
        max_tiles: u32,
        waiting_out: *mut u32,
        report_out: *mut tl_nav_bake_report,
    ) -> tl_result;
    pub fn tl_default_nav_prepare_def() -> tl_nav_prepare_def;
    pub fn tl_nav_prepared_kind_name(kind: tl_nav_prepared_kind) -> *const c_char;
    pub fn tl_navmesh_prepare(
        navmesh: *mut tl_navmesh,
        def: *const tl_nav_prepare_def,
        prepared_out: *mut tl_nav_prepared,
    ) -> tl_result;
    pub fn tl_navmesh_is_prepared(navmesh: *const tl_navmesh) -> bool;
    pub fn tl_pack_write(
        items: *const tl_pack_item,
        count: u32,
        allocator: *const tl_allocator,
        write: Option<tl_write_fn>,
        user: *mut c_void,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_pack_size(items: *const tl_pack_item, count: u32) -> u64;
    pub fn tl_pack_open(
        bytes: *const c_void,
        size: u64,
        pack_out: *mut tl_pack,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_pack_to_host_order(
        bytes: *mut c_void,
        size: u64,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_blob_to_file_order(
        bytes: *mut c_void,
        size: u64,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_blob_to_host_order(
        bytes: *mut c_void,
        size: u64,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_pack_chunk_at(pack: *const tl_pack, index: u32) -> tl_pack_chunk;
    pub fn tl_pack_find(
        pack: *const tl_pack,
        r#type: u32,
        id: u32,
        chunk_out: *mut tl_pack_chunk,
    ) -> tl_result;
    pub fn tl_pack_count(pack: *const tl_pack, r#type: u32) -> u32;
    pub fn tl_pack_index_size(
        head: *const c_void,
        size_out: *mut u64,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_pack_index_open(
        bytes: *mut c_void,
        size: u64,
        index_out: *mut tl_pack_index,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_pack_entry_open(
        entry: *const tl_pack_entry,
        bytes: *mut c_void,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_pack_entry_make(
        r#type: u32,
        id: u32,
        bytes: *const c_void,
        size: u64,
        entry_out: *mut tl_pack_entry,
    ) -> tl_result;
    pub fn tl_pack_write_fetched(
        entries: *const tl_pack_entry,
        count: u32,
        allocator: *const tl_allocator,
        fetch: Option<tl_pack_fetch_fn>,
        write: Option<tl_write_fn>,
        user: *mut c_void,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_pack_meta_encode(
        source_name: *const c_char,
        source_vertices: u64,
        source_triangles: u64,
        bounds: tl_aabb,
        allocator: *const tl_allocator,
        meta_out: *mut *mut tl_pack_meta,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_pack_meta_check(
        bytes: *const c_void,
        size: u64,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_pack_meta_name(meta: *const tl_pack_meta) -> *const c_char;
    pub fn tl_pack_frame_encode(
        axes: tl_pack_axes,
        origin: *const f64,
        allocator: *const tl_allocator,
        frame_out: *mut *mut tl_pack_frame,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_pack_frame_check(
        bytes: *const c_void,
        size: u64,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_pack_place_in(frame: *const tl_pack_frame, point: *const f64) -> tl_vec3;
    pub fn tl_pack_place_out(frame: *const tl_pack_frame, point: tl_vec3, out: *mut f64);
    pub fn tl_pack_turn_in(axes: tl_pack_axes, v: tl_vec3) -> tl_vec3;
    pub fn tl_pack_turn_out(axes: tl_pack_axes, v: tl_vec3) -> tl_vec3;
    pub fn tl_pack_navmesh_encode(
        def: *const tl_nav_def,
        tiles_x: u32,
        tiles_z: u32,
        tile_count: u32,
        allocator: *const tl_allocator,
        navmesh_out: *mut *mut tl_pack_navmesh,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_pack_navmesh_check(
        bytes: *const c_void,
        size: u64,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_pack_navmesh_def(navmesh: *const tl_pack_navmesh) -> tl_nav_def;
    pub fn tl_pack_volumes_encode(
        volumes: *const tl_nav_volume,
        count: u32,
        allocator: *const tl_allocator,
        volumes_out: *mut *mut tl_pack_volumes,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_pack_volumes_check(
        bytes: *const c_void,
        size: u64,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_pack_volumes_at(volumes: *const tl_pack_volumes, index: u32) -> tl_nav_volume;
    pub fn tl_pack_pruning_encode(
        def: *const tl_nav_prune_def,
        allocator: *const tl_allocator,
        pruning_out: *mut *mut tl_pack_pruning,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_pack_pruning_check(
        bytes: *const c_void,
        size: u64,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_pack_pruning_seeds(pruning: *const tl_pack_pruning) -> *const tl_vec3;
    pub fn tl_pack_offmesh_encode(
        links: *const tl_nav_offmesh,
        count: u32,
        allocator: *const tl_allocator,
        offmesh_out: *mut *mut tl_pack_offmesh,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_pack_offmesh_check(
        bytes: *const c_void,
        size: u64,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_pack_offmesh_at(offmesh: *const tl_pack_offmesh, index: u32) -> tl_nav_offmesh;
    pub fn tl_pack_areas_encode(
        areas: *const u8,
        count: u32,
        allocator: *const tl_allocator,
        areas_out: *mut *mut tl_pack_areas,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_pack_areas_check(
        bytes: *const c_void,
        size: u64,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_pack_areas_array(areas: *const tl_pack_areas) -> *const u8;
    pub fn tl_pack_load_navmesh(
        pack: *const tl_pack,
        allocator: *const tl_allocator,
        navmesh_out: *mut *mut tl_navmesh,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_pack_load_pruned(
        pack: *const tl_pack,
        allocator: *const tl_allocator,
        navmesh_out: *mut *mut tl_navmesh,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_default_nav_world_def() -> tl_nav_world_def;
    pub fn tl_nav_world_create(
        def: *const tl_nav_world_def,
        world_out: *mut *mut tl_nav_world,
        report: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_world_index(world: *const tl_nav_world) -> *const tl_pack_index;
    pub fn tl_nav_world_destroy(world: *mut tl_nav_world);
    pub fn tl_nav_world_update(
        world: *mut tl_nav_world,
        interests: *const tl_nav_world_interest,
        count: u32,
        max_changes: u32,
    ) -> tl_result;
    pub fn tl_nav_world_begin_load(
        world: *mut tl_nav_world,
        load_out: *mut tl_nav_world_load,
    ) -> tl_result;
    pub fn tl_nav_world_run_load(load: *mut tl_nav_world_load) -> tl_result;
    pub fn tl_nav_world_end_load(load: *mut tl_nav_world_load) -> tl_result;
    pub fn tl_nav_world_get_state(
        world: *const tl_nav_world,
        state_out: *mut tl_nav_world_state,
    ) -> tl_result;
    pub fn tl_nav_world_place_in(world: *const tl_nav_world, point: *const f64) -> tl_vec3;
    pub fn tl_nav_world_place_out(world: *const tl_nav_world, point: tl_vec3, out: *mut f64);
    pub fn tl_nav_world_navmesh(world: *const tl_nav_world) -> *const tl_navmesh;
    pub fn tl_nav_world_covers(
        world: *const tl_nav_world,
        center: *const f64,
        radius: f64,
    ) -> tl_result;
    pub fn tl_nav_world_find_nearest(
        world: *const tl_nav_world,
        filter: *const tl_nav_filter,
        point: *const f64,
        half_extents: tl_vec3,
        location_out: *mut tl_nav_location,
    ) -> tl_result;
    pub fn tl_nav_world_find_path(
        world: *const tl_nav_world,
        query: *mut tl_nav_query,
        request: *const tl_nav_path_request,
        buffers: *const tl_nav_path_buffers,
        path_out: *mut tl_nav_shortest_path,
    ) -> tl_result;
    pub fn tl_nav_world_cast_ray(
        world: *const tl_nav_world,
        filter: *const tl_nav_filter,
        start: *const tl_nav_location,
        end: *const f64,
        hit_out: *mut tl_nav_ray_hit,
    ) -> tl_result;
    pub fn tl_default_nav_routes_def() -> tl_nav_routes_def;
    pub fn tl_nav_routes_bake(
        def: *const tl_nav_routes_def,
        routes_out: *mut *mut tl_nav_routes,
        report: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_routes_check(
        bytes: *const c_void,
        size: u64,
        report: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_routes_check_tiles(
        routes: *const tl_nav_routes,
        index: *const tl_pack_index,
        report: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_router_create(
        world: *const tl_nav_world,
        allocator: *const tl_allocator,
        router_out: *mut *mut tl_nav_router,
        report: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_router_destroy(router: *mut tl_nav_router);
    pub fn tl_nav_world_find_route(
        world: *const tl_nav_world,
        router: *mut tl_nav_router,
        request: *const tl_nav_world_route_request,
        points_out: *mut tl_nav_world_route_point,
        capacity: u32,
        route_out: *mut tl_nav_world_route,
    ) -> tl_result;
    pub fn tl_default_nav_pvs_def() -> tl_nav_pvs_def;
    pub fn tl_nav_pvs_bake(
        def: *const tl_nav_pvs_def,
        navmesh: *const tl_navmesh,
        soup: *const tl_soup,
        pvs_out: *mut *mut tl_nav_pvs,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_pvs_check(
        bytes: *const c_void,
        size: u64,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_nav_pvs_sees(
        pvs: *const tl_nav_pvs,
        navmesh: *const tl_navmesh,
        a: tl_nav_ref,
        b: tl_nav_ref,
        seen_out: *mut bool,
    ) -> tl_result;
    pub fn tl_nav_pvs_seen_from(
        pvs: *const tl_nav_pvs,
        navmesh: *const tl_navmesh,
        from: tl_nav_ref,
        polygons_out: *mut tl_nav_ref,
        capacity: u32,
        count_out: *mut u32,
    ) -> tl_result;
    pub fn tl_default_nav_cover_def() -> tl_nav_cover_def;
    pub fn tl_nav_query_find_cover(
        query: *mut tl_nav_query,
        request: *const tl_nav_cover_request,
        def: *const tl_nav_cover_def,
        covers_out: *mut tl_nav_cover,
        capacity: u32,
        count_out: *mut u32,
    ) -> tl_result;
    pub fn tl_navmesh_polygon_flags(
        navmesh: *const tl_navmesh,
        polygon: tl_nav_ref,
        flags_out: *mut u64,
    ) -> tl_result;
    pub fn tl_navmesh_polygon_area(
        navmesh: *const tl_navmesh,
        polygon: tl_nav_ref,
        area_out: *mut u8,
    ) -> tl_result;
    pub fn tl_navmesh_set_polygon_flags(
        navmesh: *mut tl_navmesh,
        polygon: tl_nav_ref,
        flags: u64,
    ) -> tl_result;
    pub fn tl_navmesh_set_polygon_area(
        navmesh: *mut tl_navmesh,
        polygon: tl_nav_ref,
        area: u8,
    ) -> tl_result;
    pub fn tl_navmesh_store_state(
        navmesh: *const tl_navmesh,
        tile_x: i32,
        layer: u32,
        tile_z: i32,
        states_out: *mut tl_nav_polygon_state,
        capacity: u32,
        count_out: *mut u32,
    ) -> tl_result;
    pub fn tl_navmesh_restore_state(
        navmesh: *mut tl_navmesh,
        tile_x: i32,
        layer: u32,
        tile_z: i32,
        states: *const tl_nav_polygon_state,
        count: u32,
        report: *mut tl_report,
    ) -> tl_result;
    pub fn tl_navmesh_reset_state(
        navmesh: *mut tl_navmesh,
        tile_x: i32,
        layer: u32,
        tile_z: i32,
    ) -> tl_result;
    pub fn tl_navmesh_is_state_changed(
        navmesh: *const tl_navmesh,
        tile_x: i32,
        layer: u32,
        tile_z: i32,
    ) -> bool;
    pub fn tl_nav_versions_create(
        allocator: *const tl_allocator,
        versions_out: *mut *mut tl_nav_versions,
    ) -> tl_result;
    pub fn tl_nav_versions_destroy(versions: *mut tl_nav_versions);
    pub fn tl_nav_versions_acquire(versions: *mut tl_nav_versions) -> *const tl_navmesh;
    pub fn tl_nav_versions_release(versions: *mut tl_nav_versions, navmesh: *const tl_navmesh);
    pub fn tl_nav_versions_edit(
        versions: *mut tl_nav_versions,
        draft_out: *mut *mut tl_navmesh,
    ) -> tl_result;
    pub fn tl_nav_versions_publish(versions: *mut tl_nav_versions) -> tl_result;
    pub fn tl_nav_versions_reclaim(
        versions: *mut tl_nav_versions,
        state_out: *mut tl_nav_versions_state,
    ) -> tl_result;
    pub fn tl_nav_wide_status_name(status: tl_nav_wide_status) -> *const c_char;
    pub fn tl_nav_query_find_wide_path(
        query: *mut tl_nav_query,
        navmesh: *const tl_navmesh,
        request: *const tl_nav_path_request,
        agent_radius: f32,
        corners_out: *mut tl_nav_corner,
        capacity: u32,
        path_out: *mut tl_nav_wide_path,
    ) -> tl_result;
    pub fn tl_nav_query_is_wide_reachable(
        query: *mut tl_nav_query,
        navmesh: *const tl_navmesh,
        request: *const tl_nav_path_request,
        agent_radius: f32,
        status_out: *mut tl_nav_wide_status,
    ) -> tl_result;
    pub fn tl_default_nav_wide_def() -> tl_nav_wide_def;
    pub fn tl_navmesh_prepare_wide(
        navmesh: *mut tl_navmesh,
        def: *const tl_nav_wide_def,
        report_out: *mut tl_nav_wide_report,
    ) -> tl_result;
    pub fn tl_nav_query_find_wide_place(
        query: *mut tl_nav_query,
        navmesh: *const tl_navmesh,
        request: *const tl_nav_around_request,
        agent_radius: f32,
        place_out: *mut tl_nav_location,
    ) -> tl_result;
    pub fn tl_nav_query_path_clearance(
        query: *mut tl_nav_query,
        navmesh: *const tl_navmesh,
        filter: *const tl_nav_filter,
        corners: *const tl_nav_corner,
        count: u32,
        max_distance: f32,
        clearance_out: *mut f32,
    ) -> tl_result;
    pub fn tl_scene_groups_expand(
        groups: *const tl_scene_group,
        group_count: u32,
        root: u32,
        host: *const tl_host,
        expansion_out: *mut tl_scene_expansion,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_scene_groups_place(
        groups: *const tl_scene_group,
        group_count: u32,
        expansion: *mut tl_scene_expansion,
        copy: u32,
        at: *const tl_scene_placement,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_scene_copy_of(expansion: *const tl_scene_expansion, instance: u32) -> u32;
    pub fn tl_scene_expansion_free(expansion: *mut tl_scene_expansion);
    pub fn tl_scene_versions_create(
        instances: *const tl_scene_instance,
        count: u32,
        allocator: *const tl_allocator,
        versions_out: *mut *mut tl_scene_versions,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_scene_versions_destroy(versions: *mut tl_scene_versions);
    pub fn tl_scene_versions_acquire(versions: *mut tl_scene_versions) -> *const tl_scene_version;
    pub fn tl_scene_versions_release(
        versions: *mut tl_scene_versions,
        version: *const tl_scene_version,
    );
    pub fn tl_scene_versions_publish(
        versions: *mut tl_scene_versions,
        instances: *const tl_scene_instance,
        count: u32,
        report_out: *mut tl_report,
    ) -> tl_result;
    pub fn tl_scene_versions_reclaim(
        versions: *mut tl_scene_versions,
        state_out: *mut tl_scene_versions_state,
    ) -> tl_result;
}

#[cfg(all(test, target_pointer_width = "64"))]
mod layout {
    use super::*;
    #[test]
    fn is_that_of_c() {
        assert_eq!(core::mem::size_of::<tl_allocator>(), 24);
        assert_eq!(core::mem::offset_of!(tl_allocator, allocate), 0);
        assert_eq!(core::mem::offset_of!(tl_allocator, release), 8);
        assert_eq!(core::mem::offset_of!(tl_allocator, user), 16);
        assert_eq!(core::mem::size_of::<tl_tasks>(), 24);
        assert_eq!(core::mem::offset_of!(tl_tasks, run), 0);
        assert_eq!(core::mem::offset_of!(tl_tasks, worker_count), 8);
        assert_eq!(core::mem::offset_of!(tl_tasks, user), 16);
        assert_eq!(core::mem::size_of::<tl_progress>(), 16);
        assert_eq!(core::mem::offset_of!(tl_progress, update), 0);
        assert_eq!(core::mem::offset_of!(tl_progress, user), 8);
        assert_eq!(core::mem::size_of::<tl_host>(), 24);
        assert_eq!(core::mem::offset_of!(tl_host, allocator), 0);
        assert_eq!(core::mem::offset_of!(tl_host, tasks), 8);
        assert_eq!(core::mem::offset_of!(tl_host, progress), 16);
        assert_eq!(core::mem::size_of::<tl_report>(), 48);
        assert_eq!(core::mem::offset_of!(tl_report, stage), 0);
        assert_eq!(core::mem::offset_of!(tl_report, field), 8);
        assert_eq!(core::mem::offset_of!(tl_report, element), 16);
        assert_eq!(core::mem::offset_of!(tl_report, element_index), 24);
        assert_eq!(core::mem::offset_of!(tl_report, advice), 32);
        assert_eq!(core::mem::offset_of!(tl_report, peak_bytes), 40);
        assert_eq!(core::mem::size_of::<tl_blob>(), 16);
        assert_eq!(core::mem::offset_of!(tl_blob, magic), 0);
        assert_eq!(core::mem::offset_of!(tl_blob, version), 4);
        assert_eq!(core::mem::offset_of!(tl_blob, size), 8);
        assert_eq!(core::mem::size_of::<tl_vec3>(), 12);
        assert_eq!(core::mem::offset_of!(tl_vec3, x), 0);
        assert_eq!(core::mem::offset_of!(tl_vec3, y), 4);
        assert_eq!(core::mem::offset_of!(tl_vec3, z), 8);
        assert_eq!(core::mem::size_of::<tl_quat>(), 16);
        assert_eq!(core::mem::offset_of!(tl_quat, x), 0);
        assert_eq!(core::mem::offset_of!(tl_quat, y), 4);
        assert_eq!(core::mem::offset_of!(tl_quat, z), 8);
        assert_eq!(core::mem::offset_of!(tl_quat, w), 12);
        assert_eq!(core::mem::size_of::<tl_transform>(), 28);
        assert_eq!(core::mem::offset_of!(tl_transform, rotation), 0);
        assert_eq!(core::mem::offset_of!(tl_transform, position), 16);
        assert_eq!(core::mem::size_of::<tl_aabb>(), 24);
        assert_eq!(core::mem::offset_of!(tl_aabb, min), 0);
        assert_eq!(core::mem::offset_of!(tl_aabb, max), 12);
        assert_eq!(core::mem::size_of::<tl_halfedge_vertex>(), 24);
        assert_eq!(core::mem::offset_of!(tl_halfedge_vertex, position), 0);
        assert_eq!(core::mem::offset_of!(tl_halfedge_vertex, edge), 12);
        assert_eq!(core::mem::offset_of!(tl_halfedge_vertex, link), 16);
        assert_eq!(core::mem::offset_of!(tl_halfedge_vertex, mark), 20);
        assert_eq!(core::mem::size_of::<tl_halfedge_edge>(), 16);
        assert_eq!(core::mem::offset_of!(tl_halfedge_edge, vertex), 0);
        assert_eq!(core::mem::offset_of!(tl_halfedge_edge, face), 4);
        assert_eq!(core::mem::offset_of!(tl_halfedge_edge, next), 8);
        assert_eq!(core::mem::offset_of!(tl_halfedge_edge, prev), 12);
        assert_eq!(core::mem::size_of::<tl_halfedge_face>(), 8);
        assert_eq!(core::mem::offset_of!(tl_halfedge_face, edge), 0);
        assert_eq!(core::mem::offset_of!(tl_halfedge_face, link), 4);
        assert_eq!(core::mem::size_of::<tl_halfedge_mesh>(), 104);
        assert_eq!(core::mem::offset_of!(tl_halfedge_mesh, vertices), 0);
        assert_eq!(core::mem::offset_of!(tl_halfedge_mesh, edges), 8);
        assert_eq!(core::mem::offset_of!(tl_halfedge_mesh, faces), 16);
        assert_eq!(core::mem::offset_of!(tl_halfedge_mesh, vertex_end), 24);
        assert_eq!(core::mem::offset_of!(tl_halfedge_mesh, edge_end), 28);
        assert_eq!(core::mem::offset_of!(tl_halfedge_mesh, face_end), 32);
        assert_eq!(core::mem::offset_of!(tl_halfedge_mesh, vertex_count), 36);
        assert_eq!(core::mem::offset_of!(tl_halfedge_mesh, half_edge_count), 40);
        assert_eq!(core::mem::offset_of!(tl_halfedge_mesh, face_count), 44);
        assert_eq!(core::mem::offset_of!(tl_halfedge_mesh, boundary_count), 48);
        assert_eq!(core::mem::offset_of!(tl_halfedge_mesh, vertex_capacity), 52);
        assert_eq!(core::mem::offset_of!(tl_halfedge_mesh, edge_capacity), 56);
        assert_eq!(core::mem::offset_of!(tl_halfedge_mesh, face_capacity), 60);
        assert_eq!(core::mem::offset_of!(tl_halfedge_mesh, free_vertex), 64);
        assert_eq!(core::mem::offset_of!(tl_halfedge_mesh, free_edge), 68);
        assert_eq!(core::mem::offset_of!(tl_halfedge_mesh, free_face), 72);
        assert_eq!(core::mem::offset_of!(tl_halfedge_mesh, stamp), 76);
        assert_eq!(core::mem::offset_of!(tl_halfedge_mesh, allocator), 80);
        assert_eq!(core::mem::size_of::<tl_hull_def>(), 56);
        assert_eq!(core::mem::offset_of!(tl_hull_def, max_vertices), 0);
        assert_eq!(core::mem::offset_of!(tl_hull_def, tolerance), 4);
        assert_eq!(core::mem::offset_of!(tl_hull_def, thickness), 8);
        assert_eq!(core::mem::offset_of!(tl_hull_def, flatness), 12);
        assert_eq!(core::mem::offset_of!(tl_hull_def, weld_distance), 16);
        assert_eq!(core::mem::offset_of!(tl_hull_def, merge_distance), 20);
        assert_eq!(core::mem::offset_of!(tl_hull_def, host), 24);
        assert_eq!(core::mem::offset_of!(tl_hull_def, cookie), 48);
        assert_eq!(core::mem::size_of::<tl_hull_report>(), 80);
        assert_eq!(core::mem::offset_of!(tl_hull_report, base), 0);
        assert_eq!(core::mem::offset_of!(tl_hull_report, triangle_count), 48);
        assert_eq!(core::mem::offset_of!(tl_hull_report, thickened), 52);
        assert_eq!(core::mem::offset_of!(tl_hull_report, points_left_out), 56);
        assert_eq!(core::mem::offset_of!(tl_hull_report, max_outside), 64);
        assert_eq!(core::mem::offset_of!(tl_hull_report, corners_left_out), 72);
        assert_eq!(core::mem::size_of::<tl_hull_half_edge>(), 16);
        assert_eq!(core::mem::offset_of!(tl_hull_half_edge, origin), 0);
        assert_eq!(core::mem::offset_of!(tl_hull_half_edge, twin), 4);
        assert_eq!(core::mem::offset_of!(tl_hull_half_edge, next), 8);
        assert_eq!(core::mem::offset_of!(tl_hull_half_edge, face), 12);
        assert_eq!(core::mem::size_of::<tl_hull_face>(), 8);
        assert_eq!(core::mem::offset_of!(tl_hull_face, first), 0);
        assert_eq!(core::mem::offset_of!(tl_hull_face, count), 4);
        assert_eq!(core::mem::size_of::<tl_hull_plane>(), 32);
        assert_eq!(core::mem::offset_of!(tl_hull_plane, normal), 0);
        assert_eq!(core::mem::offset_of!(tl_hull_plane, offset), 24);
        assert_eq!(core::mem::size_of::<tl_hull_mass>(), 88);
        assert_eq!(core::mem::offset_of!(tl_hull_mass, volume), 0);
        assert_eq!(core::mem::offset_of!(tl_hull_mass, area), 8);
        assert_eq!(core::mem::offset_of!(tl_hull_mass, center), 16);
        assert_eq!(core::mem::offset_of!(tl_hull_mass, inertia), 40);
        assert_eq!(core::mem::size_of::<tl_hull>(), 152);
        assert_eq!(core::mem::offset_of!(tl_hull, blob), 0);
        assert_eq!(core::mem::offset_of!(tl_hull, vertex_count), 16);
        assert_eq!(core::mem::offset_of!(tl_hull, face_count), 20);
        assert_eq!(core::mem::offset_of!(tl_hull, half_edge_count), 24);
        assert_eq!(core::mem::offset_of!(tl_hull, scan_error), 28);
        assert_eq!(core::mem::offset_of!(tl_hull, index_bytes), 32);
        assert_eq!(core::mem::offset_of!(tl_hull, flags), 33);
        assert_eq!(core::mem::offset_of!(tl_hull, vertices), 34);
        assert_eq!(core::mem::offset_of!(tl_hull, merge_distance), 36);
        assert_eq!(core::mem::offset_of!(tl_hull, bounds), 40);
        assert_eq!(core::mem::offset_of!(tl_hull, mass), 64);
        assert_eq!(core::mem::size_of::<tl_hull_climb>(), 64);
        assert_eq!(core::mem::offset_of!(tl_hull_climb, table_side), 0);
        assert_eq!(core::mem::offset_of!(tl_hull_climb, table_scale), 4);
        assert_eq!(core::mem::offset_of!(tl_hull_climb, planes), 16);
        assert_eq!(core::mem::offset_of!(tl_hull_climb, blocks), 20);
        assert_eq!(core::mem::offset_of!(tl_hull_climb, table), 24);
        assert_eq!(core::mem::offset_of!(tl_hull_climb, rings), 28);
        assert_eq!(core::mem::offset_of!(tl_hull_climb, cell_bytes), 32);
        assert_eq!(core::mem::offset_of!(tl_hull_climb, block_count), 36);
        assert_eq!(core::mem::offset_of!(tl_hull_climb, ring_count), 40);
        assert_eq!(core::mem::offset_of!(tl_hull_climb, ring_cells), 44);
        assert_eq!(core::mem::offset_of!(tl_hull_climb, cap_count), 48);
        assert_eq!(core::mem::offset_of!(tl_hull_climb, unused), 52);
        assert_eq!(core::mem::size_of::<tl_hull_validation>(), 64);
        assert_eq!(core::mem::offset_of!(tl_hull_validation, base), 0);
        assert_eq!(core::mem::offset_of!(tl_hull_validation, euler), 48);
        assert_eq!(core::mem::offset_of!(tl_hull_validation, flat_faces), 49);
        assert_eq!(core::mem::offset_of!(tl_hull_validation, convex), 50);
        assert_eq!(core::mem::offset_of!(tl_hull_validation, contains), 51);
        assert_eq!(core::mem::offset_of!(tl_hull_validation, max_outside), 56);
        assert_eq!(core::mem::size_of::<tl_hull_hit>(), 20);
        assert_eq!(core::mem::offset_of!(tl_hull_hit, t), 0);
        assert_eq!(core::mem::offset_of!(tl_hull_hit, face), 4);
        assert_eq!(core::mem::offset_of!(tl_hull_hit, normal), 8);
        assert_eq!(core::mem::size_of::<tl_convex>(), 80);
        assert_eq!(core::mem::offset_of!(tl_convex, kind), 0);
        assert_eq!(core::mem::offset_of!(tl_convex, radius), 4);
        assert_eq!(core::mem::offset_of!(tl_convex, hull), 8);
        assert_eq!(core::mem::offset_of!(tl_convex, points), 16);
        assert_eq!(core::mem::offset_of!(tl_convex, point_count), 24);
        assert_eq!(core::mem::offset_of!(tl_convex, corners), 28);
        assert_eq!(core::mem::offset_of!(tl_convex, support), 64);
        assert_eq!(core::mem::offset_of!(tl_convex, user), 72);
        assert_eq!(core::mem::size_of::<tl_simplex_cache>(), 36);
        assert_eq!(core::mem::offset_of!(tl_simplex_cache, count), 0);
        assert_eq!(core::mem::offset_of!(tl_simplex_cache, vertex_a), 4);
        assert_eq!(core::mem::offset_of!(tl_simplex_cache, vertex_b), 20);
        assert_eq!(core::mem::size_of::<tl_separation>(), 56);
        assert_eq!(core::mem::offset_of!(tl_separation, distance), 0);
        assert_eq!(core::mem::offset_of!(tl_separation, lower_bound), 4);
        assert_eq!(core::mem::offset_of!(tl_separation, overlap), 8);
        assert_eq!(core::mem::offset_of!(tl_separation, point_a), 12);
        assert_eq!(core::mem::offset_of!(tl_separation, point_b), 24);
        assert_eq!(core::mem::offset_of!(tl_separation, normal), 36);
        assert_eq!(core::mem::offset_of!(tl_separation, status), 48);
        assert_eq!(core::mem::offset_of!(tl_separation, iterations), 52);
        assert_eq!(core::mem::size_of::<tl_penetration>(), 60);
        assert_eq!(core::mem::offset_of!(tl_penetration, overlap), 0);
        assert_eq!(core::mem::offset_of!(tl_penetration, depth), 4);
        assert_eq!(core::mem::offset_of!(tl_penetration, lower_bound), 8);
        assert_eq!(core::mem::offset_of!(tl_penetration, upper_bound), 12);
        assert_eq!(core::mem::offset_of!(tl_penetration, normal), 16);
        assert_eq!(core::mem::offset_of!(tl_penetration, point_a), 28);
        assert_eq!(core::mem::offset_of!(tl_penetration, point_b), 40);
        assert_eq!(core::mem::offset_of!(tl_penetration, status), 52);
        assert_eq!(core::mem::offset_of!(tl_penetration, iterations), 56);
        assert_eq!(core::mem::size_of::<tl_convex_hit>(), 44);
        assert_eq!(core::mem::offset_of!(tl_convex_hit, hit), 0);
        assert_eq!(core::mem::offset_of!(tl_convex_hit, initial_overlap), 1);
        assert_eq!(core::mem::offset_of!(tl_convex_hit, t), 4);
        assert_eq!(core::mem::offset_of!(tl_convex_hit, gap), 8);
        assert_eq!(core::mem::offset_of!(tl_convex_hit, point), 12);
        assert_eq!(core::mem::offset_of!(tl_convex_hit, normal), 24);
        assert_eq!(core::mem::offset_of!(tl_convex_hit, status), 36);
        assert_eq!(core::mem::offset_of!(tl_convex_hit, iterations), 40);
        assert_eq!(core::mem::size_of::<tl_contact_limits>(), 12);
        assert_eq!(core::mem::offset_of!(tl_contact_limits, margin), 0);
        assert_eq!(core::mem::offset_of!(tl_contact_limits, tolerance), 4);
        assert_eq!(core::mem::offset_of!(tl_contact_limits, max_steps), 8);
        assert_eq!(core::mem::size_of::<tl_contact>(), 40);
        assert_eq!(core::mem::offset_of!(tl_contact, point_a), 0);
        assert_eq!(core::mem::offset_of!(tl_contact, point_b), 12);
        assert_eq!(core::mem::offset_of!(tl_contact, separation), 24);
        assert_eq!(core::mem::offset_of!(tl_contact, feature_a), 28);
        assert_eq!(core::mem::offset_of!(tl_contact, feature_b), 32);
        assert_eq!(core::mem::offset_of!(tl_contact, previous), 36);
        assert_eq!(core::mem::size_of::<tl_contact_manifold>(), 224);
        assert_eq!(core::mem::offset_of!(tl_contact_manifold, count), 0);
        assert_eq!(core::mem::offset_of!(tl_contact_manifold, contacts), 4);
        assert_eq!(core::mem::offset_of!(tl_contact_manifold, normal), 204);
        assert_eq!(core::mem::offset_of!(tl_contact_manifold, separation), 216);
        assert_eq!(core::mem::offset_of!(tl_contact_manifold, status), 220);
        assert_eq!(core::mem::size_of::<tl_polytope_cache>(), 232);
        assert_eq!(core::mem::offset_of!(tl_polytope_cache, point_count), 0);
        assert_eq!(core::mem::offset_of!(tl_polytope_cache, face_count), 2);
        assert_eq!(core::mem::offset_of!(tl_polytope_cache, vertices), 4);
        assert_eq!(core::mem::offset_of!(tl_polytope_cache, corners), 100);
        assert_eq!(core::mem::size_of::<tl_contact_cache>(), 512);
        assert_eq!(core::mem::offset_of!(tl_contact_cache, simplex), 0);
        assert_eq!(core::mem::offset_of!(tl_contact_cache, count), 36);
        assert_eq!(core::mem::offset_of!(tl_contact_cache, has_axis), 40);
        assert_eq!(core::mem::offset_of!(tl_contact_cache, features), 44);
        assert_eq!(core::mem::offset_of!(tl_contact_cache, points), 84);
        assert_eq!(core::mem::offset_of!(tl_contact_cache, points_b), 144);
        assert_eq!(core::mem::offset_of!(tl_contact_cache, axis_a), 204);
        assert_eq!(core::mem::offset_of!(tl_contact_cache, axis_b), 216);
        assert_eq!(core::mem::offset_of!(tl_contact_cache, b_to_a), 228);
        assert_eq!(core::mem::offset_of!(tl_contact_cache, proven_depth), 276);
        assert_eq!(core::mem::offset_of!(tl_contact_cache, polytope), 280);
        assert_eq!(core::mem::size_of::<tl_scaled_convex>(), 104);
        assert_eq!(core::mem::offset_of!(tl_scaled_convex, shape), 0);
        assert_eq!(core::mem::offset_of!(tl_scaled_convex, of), 80);
        assert_eq!(core::mem::offset_of!(tl_scaled_convex, scale), 88);
        assert_eq!(core::mem::size_of::<tl_mesh_view>(), 40);
        assert_eq!(core::mem::offset_of!(tl_mesh_view, vertices), 0);
        assert_eq!(core::mem::offset_of!(tl_mesh_view, vertex_count), 8);
        assert_eq!(core::mem::offset_of!(tl_mesh_view, indices), 16);
        assert_eq!(core::mem::offset_of!(tl_mesh_view, triangle_count), 24);
        assert_eq!(core::mem::offset_of!(tl_mesh_view, materials), 32);
        assert_eq!(core::mem::size_of::<tl_mesh_def>(), 40);
        assert_eq!(core::mem::offset_of!(tl_mesh_def, weld_tolerance), 0);
        assert_eq!(core::mem::offset_of!(tl_mesh_def, keep_duplicates), 4);
        assert_eq!(core::mem::offset_of!(tl_mesh_def, host), 8);
        assert_eq!(core::mem::offset_of!(tl_mesh_def, cookie), 32);
        assert_eq!(core::mem::size_of::<tl_mesh>(), 112);
        assert_eq!(core::mem::offset_of!(tl_mesh, vertices), 0);
        assert_eq!(core::mem::offset_of!(tl_mesh, vertex_count), 8);
        assert_eq!(core::mem::offset_of!(tl_mesh, indices), 16);
        assert_eq!(core::mem::offset_of!(tl_mesh, triangle_count), 24);
        assert_eq!(core::mem::offset_of!(tl_mesh, materials), 32);
        assert_eq!(core::mem::offset_of!(tl_mesh, source_triangles), 40);
        assert_eq!(core::mem::offset_of!(tl_mesh, bounds), 48);
        assert_eq!(core::mem::offset_of!(tl_mesh, block), 72);
        assert_eq!(core::mem::offset_of!(tl_mesh, block_size), 80);
        assert_eq!(core::mem::offset_of!(tl_mesh, allocator), 88);
        assert_eq!(core::mem::size_of::<tl_mesh_report>(), 64);
        assert_eq!(core::mem::offset_of!(tl_mesh_report, base), 0);
        assert_eq!(core::mem::offset_of!(tl_mesh_report, welded_vertices), 48);
        assert_eq!(core::mem::offset_of!(tl_mesh_report, unused_vertices), 52);
        assert_eq!(
            core::mem::offset_of!(tl_mesh_report, degenerate_triangles),
            56
        );
        assert_eq!(
            core::mem::offset_of!(tl_mesh_report, duplicate_triangles),
            60
        );
        assert_eq!(core::mem::size_of::<tl_adjacency>(), 48);
        assert_eq!(core::mem::offset_of!(tl_adjacency, across), 0);
        assert_eq!(core::mem::offset_of!(tl_adjacency, triangle_count), 8);
        assert_eq!(core::mem::offset_of!(tl_adjacency, border_edges), 12);
        assert_eq!(core::mem::offset_of!(tl_adjacency, paired_edges), 16);
        assert_eq!(core::mem::offset_of!(tl_adjacency, non_manifold_edges), 20);
        assert_eq!(core::mem::offset_of!(tl_adjacency, allocator), 24);
        assert_eq!(core::mem::size_of::<tl_closed_parts>(), 56);
        assert_eq!(core::mem::offset_of!(tl_closed_parts, part_of), 0);
        assert_eq!(core::mem::offset_of!(tl_closed_parts, volumes), 8);
        assert_eq!(core::mem::offset_of!(tl_closed_parts, part_count), 16);
        assert_eq!(core::mem::offset_of!(tl_closed_parts, open_part_count), 20);
        assert_eq!(core::mem::offset_of!(tl_closed_parts, triangle_count), 24);
        assert_eq!(core::mem::offset_of!(tl_closed_parts, allocator), 32);
        assert_eq!(core::mem::size_of::<tl_soup_def>(), 56);
        assert_eq!(core::mem::offset_of!(tl_soup_def, pair_triangles), 0);
        assert_eq!(core::mem::offset_of!(tl_soup_def, partition), 4);
        assert_eq!(core::mem::offset_of!(tl_soup_def, layout), 8);
        assert_eq!(core::mem::offset_of!(tl_soup_def, quality), 12);
        assert_eq!(core::mem::offset_of!(tl_soup_def, split_budget), 16);
        assert_eq!(core::mem::offset_of!(tl_soup_def, host), 24);
        assert_eq!(core::mem::offset_of!(tl_soup_def, cookie), 48);
        assert_eq!(core::mem::size_of::<tl_soup_report>(), 72);
        assert_eq!(core::mem::offset_of!(tl_soup_report, base), 0);
        assert_eq!(core::mem::offset_of!(tl_soup_report, triangle_count), 48);
        assert_eq!(
            core::mem::offset_of!(tl_soup_report, degenerate_triangles),
            52
        );
        assert_eq!(core::mem::offset_of!(tl_soup_report, pair_count), 56);
        assert_eq!(core::mem::offset_of!(tl_soup_report, single_count), 60);
        assert_eq!(core::mem::offset_of!(tl_soup_report, coincident_count), 64);
        assert_eq!(core::mem::size_of::<tl_soup_stats>(), 80);
        assert_eq!(core::mem::offset_of!(tl_soup_stats, size), 0);
        assert_eq!(
            core::mem::offset_of!(tl_soup_stats, source_triangle_count),
            8
        );
        assert_eq!(core::mem::offset_of!(tl_soup_stats, triangle_count), 12);
        assert_eq!(core::mem::offset_of!(tl_soup_stats, pair_count), 16);
        assert_eq!(core::mem::offset_of!(tl_soup_stats, single_count), 20);
        assert_eq!(core::mem::offset_of!(tl_soup_stats, coincident_count), 24);
        assert_eq!(core::mem::offset_of!(tl_soup_stats, reference_count), 28);
        assert_eq!(core::mem::offset_of!(tl_soup_stats, leaf_count), 32);
        assert_eq!(core::mem::offset_of!(tl_soup_stats, node_count), 36);
        assert_eq!(core::mem::offset_of!(tl_soup_stats, layout), 40);
        assert_eq!(core::mem::offset_of!(tl_soup_stats, depth), 44);
        assert_eq!(core::mem::offset_of!(tl_soup_stats, node_bytes), 48);
        assert_eq!(core::mem::offset_of!(tl_soup_stats, leaf_bytes), 56);
        assert_eq!(core::mem::offset_of!(tl_soup_stats, vertex_bytes), 64);
        assert_eq!(core::mem::offset_of!(tl_soup_stats, material_bytes), 72);
        assert_eq!(core::mem::size_of::<tl_ray>(), 28);
        assert_eq!(core::mem::offset_of!(tl_ray, origin), 0);
        assert_eq!(core::mem::offset_of!(tl_ray, direction), 12);
        assert_eq!(core::mem::offset_of!(tl_ray, tmax), 24);
        assert_eq!(core::mem::size_of::<tl_ray_filter>(), 32);
        assert_eq!(core::mem::offset_of!(tl_ray_filter, cull), 0);
        assert_eq!(core::mem::offset_of!(tl_ray_filter, ignored_materials), 8);
        assert_eq!(core::mem::offset_of!(tl_ray_filter, accept), 16);
        assert_eq!(core::mem::offset_of!(tl_ray_filter, accept_user), 24);
        assert_eq!(core::mem::size_of::<tl_ray_hit>(), 32);
        assert_eq!(core::mem::offset_of!(tl_ray_hit, t), 0);
        assert_eq!(core::mem::offset_of!(tl_ray_hit, triangle), 4);
        assert_eq!(core::mem::offset_of!(tl_ray_hit, u), 8);
        assert_eq!(core::mem::offset_of!(tl_ray_hit, v), 12);
        assert_eq!(core::mem::offset_of!(tl_ray_hit, normal), 16);
        assert_eq!(core::mem::offset_of!(tl_ray_hit, material), 28);
        assert_eq!(core::mem::offset_of!(tl_ray_hit, back), 30);
        assert_eq!(core::mem::size_of::<tl_segment>(), 24);
        assert_eq!(core::mem::offset_of!(tl_segment, a), 0);
        assert_eq!(core::mem::offset_of!(tl_segment, b), 12);
        assert_eq!(core::mem::size_of::<tl_soup_point>(), 40);
        assert_eq!(core::mem::offset_of!(tl_soup_point, point), 0);
        assert_eq!(core::mem::offset_of!(tl_soup_point, distance), 12);
        assert_eq!(core::mem::offset_of!(tl_soup_point, normal), 16);
        assert_eq!(core::mem::offset_of!(tl_soup_point, triangle), 28);
        assert_eq!(core::mem::offset_of!(tl_soup_point, material), 32);
        assert_eq!(core::mem::offset_of!(tl_soup_point, back), 34);
        assert_eq!(core::mem::offset_of!(tl_soup_point, feature), 36);
        assert_eq!(core::mem::size_of::<tl_shape_hit>(), 56);
        assert_eq!(core::mem::offset_of!(tl_shape_hit, t), 0);
        assert_eq!(core::mem::offset_of!(tl_shape_hit, initial_overlap), 4);
        assert_eq!(core::mem::offset_of!(tl_shape_hit, back), 5);
        assert_eq!(core::mem::offset_of!(tl_shape_hit, material), 6);
        assert_eq!(core::mem::offset_of!(tl_shape_hit, triangle), 8);
        assert_eq!(core::mem::offset_of!(tl_shape_hit, depth), 12);
        assert_eq!(core::mem::offset_of!(tl_shape_hit, point), 16);
        assert_eq!(core::mem::offset_of!(tl_shape_hit, normal), 28);
        assert_eq!(core::mem::offset_of!(tl_shape_hit, face_normal), 40);
        assert_eq!(core::mem::offset_of!(tl_shape_hit, status), 52);
        assert_eq!(core::mem::size_of::<tl_soup_contact_query>(), 56);
        assert_eq!(core::mem::offset_of!(tl_soup_contact_query, shape), 0);
        assert_eq!(core::mem::offset_of!(tl_soup_contact_query, pose), 8);
        assert_eq!(core::mem::offset_of!(tl_soup_contact_query, limits), 36);
        assert_eq!(core::mem::offset_of!(tl_soup_contact_query, filter), 48);
        assert_eq!(core::mem::size_of::<tl_soup_contact>(), 232);
        assert_eq!(core::mem::offset_of!(tl_soup_contact, triangle), 0);
        assert_eq!(core::mem::offset_of!(tl_soup_contact, material), 4);
        assert_eq!(core::mem::offset_of!(tl_soup_contact, is_face), 6);
        assert_eq!(core::mem::offset_of!(tl_soup_contact, manifold), 8);
        assert_eq!(core::mem::size_of::<tl_soup_location>(), 12);
        assert_eq!(core::mem::offset_of!(tl_soup_location, side), 0);
        assert_eq!(core::mem::offset_of!(tl_soup_location, winding), 4);
        assert_eq!(core::mem::offset_of!(tl_soup_location, triangle), 8);
        assert_eq!(core::mem::size_of::<tl_soup_triangle>(), 44);
        assert_eq!(core::mem::offset_of!(tl_soup_triangle, corners), 0);
        assert_eq!(core::mem::offset_of!(tl_soup_triangle, triangle), 36);
        assert_eq!(core::mem::offset_of!(tl_soup_triangle, material), 40);
        assert_eq!(core::mem::size_of::<tl_soup_pair>(), 56);
        assert_eq!(core::mem::offset_of!(tl_soup_pair, corners), 0);
        assert_eq!(core::mem::offset_of!(tl_soup_pair, triangles), 48);
        assert_eq!(core::mem::size_of::<tl_scaled_soup>(), 24);
        assert_eq!(core::mem::offset_of!(tl_scaled_soup, soup), 0);
        assert_eq!(core::mem::offset_of!(tl_scaled_soup, scale), 8);
        assert_eq!(core::mem::size_of::<tl_scene_instance>(), 64);
        assert_eq!(core::mem::offset_of!(tl_scene_instance, soup), 0);
        assert_eq!(core::mem::offset_of!(tl_scene_instance, shape), 8);
        assert_eq!(core::mem::offset_of!(tl_scene_instance, pose), 16);
        assert_eq!(core::mem::offset_of!(tl_scene_instance, mask), 44);
        assert_eq!(core::mem::offset_of!(tl_scene_instance, scale), 48);
        assert_eq!(core::mem::size_of::<tl_scene_stats>(), 32);
        assert_eq!(core::mem::offset_of!(tl_scene_stats, size), 0);
        assert_eq!(core::mem::offset_of!(tl_scene_stats, instance_count), 8);
        assert_eq!(core::mem::offset_of!(tl_scene_stats, node_count), 12);
        assert_eq!(core::mem::offset_of!(tl_scene_stats, depth), 16);
        assert_eq!(core::mem::offset_of!(tl_scene_stats, cost), 24);
        assert_eq!(core::mem::size_of::<tl_scene_filter>(), 40);
        assert_eq!(core::mem::offset_of!(tl_scene_filter, ignored_mask), 0);
        assert_eq!(core::mem::offset_of!(tl_scene_filter, first_ignored), 4);
        assert_eq!(core::mem::offset_of!(tl_scene_filter, ignored_count), 8);
        assert_eq!(core::mem::offset_of!(tl_scene_filter, accept), 16);
        assert_eq!(core::mem::offset_of!(tl_scene_filter, accept_user), 24);
        assert_eq!(core::mem::offset_of!(tl_scene_filter, triangles), 32);
        assert_eq!(core::mem::size_of::<tl_scene_hit>(), 44);
        assert_eq!(core::mem::offset_of!(tl_scene_hit, hit), 0);
        assert_eq!(core::mem::offset_of!(tl_scene_hit, instance), 32);
        assert_eq!(core::mem::offset_of!(tl_scene_hit, inside), 36);
        assert_eq!(core::mem::offset_of!(tl_scene_hit, status), 40);
        assert_eq!(core::mem::size_of::<tl_scene_shape_hit>(), 60);
        assert_eq!(core::mem::offset_of!(tl_scene_shape_hit, hit), 0);
        assert_eq!(core::mem::offset_of!(tl_scene_shape_hit, instance), 56);
        assert_eq!(core::mem::size_of::<tl_scene_overlap_query>(), 48);
        assert_eq!(core::mem::offset_of!(tl_scene_overlap_query, shape), 0);
        assert_eq!(core::mem::offset_of!(tl_scene_overlap_query, pose), 8);
        assert_eq!(core::mem::offset_of!(tl_scene_overlap_query, filter), 40);
        assert_eq!(core::mem::size_of::<tl_scene_overlap>(), 8);
        assert_eq!(core::mem::offset_of!(tl_scene_overlap, instance), 0);
        assert_eq!(core::mem::offset_of!(tl_scene_overlap, triangle), 4);
        assert_eq!(core::mem::size_of::<tl_scene_point>(), 44);
        assert_eq!(core::mem::offset_of!(tl_scene_point, point), 0);
        assert_eq!(core::mem::offset_of!(tl_scene_point, instance), 40);
        assert_eq!(core::mem::size_of::<tl_character_def>(), 40);
        assert_eq!(core::mem::offset_of!(tl_character_def, radius), 0);
        assert_eq!(core::mem::offset_of!(tl_character_def, height), 4);
        assert_eq!(core::mem::offset_of!(tl_character_def, step_height), 8);
        assert_eq!(core::mem::offset_of!(tl_character_def, max_slope), 12);
        assert_eq!(core::mem::offset_of!(tl_character_def, gap), 16);
        assert_eq!(core::mem::offset_of!(tl_character_def, max_triangles), 20);
        assert_eq!(core::mem::offset_of!(tl_character_def, allocator), 24);
        assert_eq!(core::mem::offset_of!(tl_character_def, cookie), 32);
        assert_eq!(core::mem::size_of::<tl_character>(), 88);
        assert_eq!(core::mem::offset_of!(tl_character, position), 0);
        assert_eq!(core::mem::offset_of!(tl_character, velocity), 12);
        assert_eq!(core::mem::offset_of!(tl_character, ground_normal), 24);
        assert_eq!(core::mem::offset_of!(tl_character, ground_point), 36);
        assert_eq!(core::mem::offset_of!(tl_character, grounded), 48);
        assert_eq!(core::mem::offset_of!(tl_character, ground_triangle), 52);
        assert_eq!(core::mem::offset_of!(tl_character, ground_instance), 56);
        assert_eq!(core::mem::offset_of!(tl_character, ground_pose), 60);
        assert_eq!(core::mem::size_of::<tl_character_level>(), 40);
        assert_eq!(core::mem::offset_of!(tl_character_level, soup), 0);
        assert_eq!(core::mem::offset_of!(tl_character_level, soup_filter), 8);
        assert_eq!(core::mem::offset_of!(tl_character_level, scene), 16);
        assert_eq!(core::mem::offset_of!(tl_character_level, instances), 24);
        assert_eq!(core::mem::offset_of!(tl_character_level, scene_filter), 32);
        assert_eq!(core::mem::size_of::<tl_character_step>(), 20);
        assert_eq!(core::mem::offset_of!(tl_character_step, velocity), 0);
        assert_eq!(core::mem::offset_of!(tl_character_step, seconds), 12);
        assert_eq!(core::mem::offset_of!(tl_character_step, leave_ground), 16);
        assert_eq!(core::mem::size_of::<tl_character_hit>(), 40);
        assert_eq!(core::mem::offset_of!(tl_character_hit, point), 0);
        assert_eq!(core::mem::offset_of!(tl_character_hit, normal), 12);
        assert_eq!(core::mem::offset_of!(tl_character_hit, instance), 24);
        assert_eq!(core::mem::offset_of!(tl_character_hit, triangle), 28);
        assert_eq!(core::mem::offset_of!(tl_character_hit, material), 32);
        assert_eq!(core::mem::offset_of!(tl_character_hit, surface), 36);
        assert_eq!(core::mem::size_of::<tl_character_report>(), 432);
        assert_eq!(core::mem::offset_of!(tl_character_report, base), 0);
        assert_eq!(core::mem::offset_of!(tl_character_report, landed), 48);
        assert_eq!(core::mem::offset_of!(tl_character_report, left_ground), 49);
        assert_eq!(core::mem::offset_of!(tl_character_report, blocked), 50);
        assert_eq!(core::mem::offset_of!(tl_character_report, hit_ceiling), 51);
        assert_eq!(core::mem::offset_of!(tl_character_report, stuck), 52);
        assert_eq!(core::mem::offset_of!(tl_character_report, stepped_up), 56);
        assert_eq!(core::mem::offset_of!(tl_character_report, pushed), 60);
        assert_eq!(core::mem::offset_of!(tl_character_report, carried), 64);
        assert_eq!(core::mem::offset_of!(tl_character_report, turned), 76);
        assert_eq!(
            core::mem::offset_of!(tl_character_report, ground_velocity),
            92
        );
        assert_eq!(core::mem::offset_of!(tl_character_report, sweeps), 104);
        assert_eq!(core::mem::offset_of!(tl_character_report, hit_count), 108);
        assert_eq!(core::mem::offset_of!(tl_character_report, hits), 112);
        assert_eq!(core::mem::size_of::<tl_decompose_def>(), 64);
        assert_eq!(core::mem::offset_of!(tl_decompose_def, tolerance), 0);
        assert_eq!(
            core::mem::offset_of!(tl_decompose_def, relative_tolerance),
            4
        );
        assert_eq!(core::mem::offset_of!(tl_decompose_def, max_parts), 8);
        assert_eq!(core::mem::offset_of!(tl_decompose_def, max_vertices), 12);
        assert_eq!(core::mem::offset_of!(tl_decompose_def, thickness), 16);
        assert_eq!(core::mem::offset_of!(tl_decompose_def, solid), 20);
        assert_eq!(core::mem::offset_of!(tl_decompose_def, max_cells), 24);
        assert_eq!(core::mem::offset_of!(tl_decompose_def, host), 32);
        assert_eq!(core::mem::offset_of!(tl_decompose_def, cookie), 56);
        assert_eq!(core::mem::size_of::<tl_convex_part>(), 24);
        assert_eq!(core::mem::offset_of!(tl_convex_part, hull), 0);
        assert_eq!(core::mem::offset_of!(tl_convex_part, concavity), 8);
        assert_eq!(core::mem::offset_of!(tl_convex_part, max_outside), 16);
        assert_eq!(core::mem::size_of::<tl_decomposition>(), 64);
        assert_eq!(core::mem::offset_of!(tl_decomposition, parts), 0);
        assert_eq!(core::mem::offset_of!(tl_decomposition, part_count), 8);
        assert_eq!(core::mem::offset_of!(tl_decomposition, concavity), 16);
        assert_eq!(core::mem::offset_of!(tl_decomposition, max_outside), 24);
        assert_eq!(core::mem::offset_of!(tl_decomposition, hull_volume), 32);
        assert_eq!(core::mem::offset_of!(tl_decomposition, allocator), 40);
        assert_eq!(core::mem::size_of::<tl_decompose_report>(), 72);
        assert_eq!(core::mem::offset_of!(tl_decompose_report, base), 0);
        assert_eq!(core::mem::offset_of!(tl_decompose_report, tolerance), 48);
        assert_eq!(core::mem::offset_of!(tl_decompose_report, cell), 52);
        assert_eq!(
            core::mem::offset_of!(tl_decompose_report, degenerate_triangles),
            56
        );
        assert_eq!(core::mem::offset_of!(tl_decompose_report, cut_count), 60);
        assert_eq!(
            core::mem::offset_of!(tl_decompose_report, parts_before_merging),
            64
        );
        assert_eq!(
            core::mem::offset_of!(tl_decompose_report, parts_over_tolerance),
            68
        );
        assert_eq!(core::mem::size_of::<tl_contour_vertex>(), 16);
        assert_eq!(core::mem::offset_of!(tl_contour_vertex, x), 0);
        assert_eq!(core::mem::offset_of!(tl_contour_vertex, y), 4);
        assert_eq!(core::mem::offset_of!(tl_contour_vertex, z), 8);
        assert_eq!(core::mem::offset_of!(tl_contour_vertex, flags), 12);
        assert_eq!(core::mem::size_of::<tl_contour>(), 16);
        assert_eq!(core::mem::offset_of!(tl_contour, first_vertex), 0);
        assert_eq!(core::mem::offset_of!(tl_contour, vertex_count), 4);
        assert_eq!(core::mem::offset_of!(tl_contour, region), 8);
        assert_eq!(core::mem::offset_of!(tl_contour, area), 12);
        assert_eq!(core::mem::size_of::<tl_contour_set>(), 80);
        assert_eq!(core::mem::offset_of!(tl_contour_set, vertices), 0);
        assert_eq!(core::mem::offset_of!(tl_contour_set, vertex_count), 8);
        assert_eq!(core::mem::offset_of!(tl_contour_set, contours), 16);
        assert_eq!(core::mem::offset_of!(tl_contour_set, contour_count), 24);
        assert_eq!(core::mem::offset_of!(tl_contour_set, bounds), 28);
        assert_eq!(core::mem::offset_of!(tl_contour_set, cell_size), 52);
        assert_eq!(core::mem::offset_of!(tl_contour_set, cell_height), 56);
        assert_eq!(core::mem::offset_of!(tl_contour_set, width), 60);
        assert_eq!(core::mem::offset_of!(tl_contour_set, height), 64);
        assert_eq!(core::mem::offset_of!(tl_contour_set, border_size), 68);
        assert_eq!(core::mem::offset_of!(tl_contour_set, max_error), 72);
        assert_eq!(core::mem::size_of::<tl_contour_note>(), 32);
        assert_eq!(core::mem::offset_of!(tl_contour_note, contour), 0);
        assert_eq!(core::mem::offset_of!(tl_contour_note, faults), 4);
        assert_eq!(core::mem::offset_of!(tl_contour_note, vertex), 8);
        assert_eq!(core::mem::offset_of!(tl_contour_note, reserved), 12);
        assert_eq!(core::mem::offset_of!(tl_contour_note, contour_area2), 16);
        assert_eq!(core::mem::offset_of!(tl_contour_note, covered_area2), 24);
        assert_eq!(core::mem::size_of::<tl_polygon_mesh>(), 160);
        assert_eq!(core::mem::offset_of!(tl_polygon_mesh, vertex_count), 0);
        assert_eq!(core::mem::offset_of!(tl_polygon_mesh, polygon_count), 4);
        assert_eq!(core::mem::offset_of!(tl_polygon_mesh, index_count), 8);
        assert_eq!(core::mem::offset_of!(tl_polygon_mesh, vertices), 16);
        assert_eq!(core::mem::offset_of!(tl_polygon_mesh, first), 24);
        assert_eq!(core::mem::offset_of!(tl_polygon_mesh, indices), 32);
        assert_eq!(core::mem::offset_of!(tl_polygon_mesh, neighbours), 40);
        assert_eq!(core::mem::offset_of!(tl_polygon_mesh, regions), 48);
        assert_eq!(core::mem::offset_of!(tl_polygon_mesh, areas), 56);
        assert_eq!(core::mem::offset_of!(tl_polygon_mesh, contours), 64);
        assert_eq!(core::mem::offset_of!(tl_polygon_mesh, bounds), 72);
        assert_eq!(core::mem::offset_of!(tl_polygon_mesh, cell_size), 96);
        assert_eq!(core::mem::offset_of!(tl_polygon_mesh, cell_height), 100);
        assert_eq!(
            core::mem::offset_of!(tl_polygon_mesh, max_verts_per_poly),
            104
        );
        assert_eq!(core::mem::offset_of!(tl_polygon_mesh, note_count), 108);
        assert_eq!(core::mem::offset_of!(tl_polygon_mesh, notes), 112);
        assert_eq!(core::mem::offset_of!(tl_polygon_mesh, allocator), 120);
        assert_eq!(core::mem::offset_of!(tl_polygon_mesh, block), 144);
        assert_eq!(core::mem::offset_of!(tl_polygon_mesh, block_size), 152);
        assert_eq!(core::mem::size_of::<tl_polygon_step>(), 56);
        assert_eq!(core::mem::offset_of!(tl_polygon_step, kind), 0);
        assert_eq!(core::mem::offset_of!(tl_polygon_step, contour), 4);
        assert_eq!(core::mem::offset_of!(tl_polygon_step, partition_count), 8);
        assert_eq!(core::mem::offset_of!(tl_polygon_step, partitions), 16);
        assert_eq!(core::mem::offset_of!(tl_polygon_step, outline_count), 24);
        assert_eq!(core::mem::offset_of!(tl_polygon_step, outline), 32);
        assert_eq!(core::mem::offset_of!(tl_polygon_step, corner_count), 40);
        assert_eq!(core::mem::offset_of!(tl_polygon_step, corners), 48);
        assert_eq!(core::mem::size_of::<tl_polygon_trace>(), 16);
        assert_eq!(core::mem::offset_of!(tl_polygon_trace, step), 0);
        assert_eq!(core::mem::offset_of!(tl_polygon_trace, user), 8);
        assert_eq!(core::mem::size_of::<tl_polygon_def>(), 56);
        assert_eq!(core::mem::offset_of!(tl_polygon_def, max_verts_per_poly), 0);
        assert_eq!(core::mem::offset_of!(tl_polygon_def, method), 4);
        assert_eq!(core::mem::offset_of!(tl_polygon_def, merge_height), 8);
        assert_eq!(
            core::mem::offset_of!(tl_polygon_def, keep_border_vertices),
            12
        );
        assert_eq!(
            core::mem::offset_of!(tl_polygon_def, drop_straight_vertices),
            13
        );
        assert_eq!(core::mem::offset_of!(tl_polygon_def, merge_contours), 14);
        assert_eq!(core::mem::offset_of!(tl_polygon_def, trace), 16);
        assert_eq!(core::mem::offset_of!(tl_polygon_def, host), 24);
        assert_eq!(core::mem::offset_of!(tl_polygon_def, cookie), 48);
        assert_eq!(core::mem::size_of::<tl_polygon_report>(), 120);
        assert_eq!(core::mem::offset_of!(tl_polygon_report, base), 0);
        assert_eq!(core::mem::offset_of!(tl_polygon_report, contour_count), 48);
        assert_eq!(core::mem::offset_of!(tl_polygon_report, empty_contours), 52);
        assert_eq!(
            core::mem::offset_of!(tl_polygon_report, repaired_contours),
            56
        );
        assert_eq!(
            core::mem::offset_of!(tl_polygon_report, refused_contours),
            60
        );
        assert_eq!(core::mem::offset_of!(tl_polygon_report, triangle_count), 64);
        assert_eq!(core::mem::offset_of!(tl_polygon_report, lower_bound), 68);
        assert_eq!(core::mem::offset_of!(tl_polygon_report, polygon_count), 72);
        assert_eq!(core::mem::offset_of!(tl_polygon_report, vertex_count), 76);
        assert_eq!(
            core::mem::offset_of!(tl_polygon_report, removed_straight_vertices),
            80
        );
        assert_eq!(core::mem::offset_of!(tl_polygon_report, contour_merges), 84);
        assert_eq!(
            core::mem::offset_of!(tl_polygon_report, removed_border_vertices),
            88
        );
        assert_eq!(
            core::mem::offset_of!(tl_polygon_report, kept_border_vertices),
            92
        );
        assert_eq!(core::mem::offset_of!(tl_polygon_report, link_count), 96);
        assert_eq!(core::mem::offset_of!(tl_polygon_report, portal_count), 100);
        assert_eq!(
            core::mem::offset_of!(tl_polygon_report, non_manifold_edges),
            104
        );
        assert_eq!(
            core::mem::offset_of!(tl_polygon_report, uncovered_area2),
            112
        );
        assert_eq!(core::mem::size_of::<tl_polygon_quality>(), 48);
        assert_eq!(core::mem::offset_of!(tl_polygon_quality, polygon_count), 0);
        assert_eq!(core::mem::offset_of!(tl_polygon_quality, max_corners), 4);
        assert_eq!(core::mem::offset_of!(tl_polygon_quality, mean_corners), 8);
        assert_eq!(
            core::mem::offset_of!(tl_polygon_quality, smallest_angle_cosine),
            16
        );
        assert_eq!(
            core::mem::offset_of!(tl_polygon_quality, mean_sharpest_cosine),
            24
        );
        assert_eq!(core::mem::offset_of!(tl_polygon_quality, mean_aspect), 32);
        assert_eq!(core::mem::offset_of!(tl_polygon_quality, worst_aspect), 40);
        assert_eq!(core::mem::size_of::<tl_polygon_check_report>(), 144);
        assert_eq!(core::mem::offset_of!(tl_polygon_check_report, base), 0);
        assert_eq!(
            core::mem::offset_of!(tl_polygon_check_report, first_fault),
            48
        );
        assert_eq!(core::mem::offset_of!(tl_polygon_check_report, counts), 56);
        assert_eq!(core::mem::size_of::<tl_nav_detail_patch>(), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_detail_patch, first_vertex), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_detail_patch, vertex_count), 4);
        assert_eq!(
            core::mem::offset_of!(tl_nav_detail_patch, first_triangle),
            8
        );
        assert_eq!(
            core::mem::offset_of!(tl_nav_detail_patch, triangle_count),
            12
        );
        assert_eq!(core::mem::size_of::<tl_nav_detail_triangle>(), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_detail_triangle, corner), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_detail_triangle, edge_flags), 6);
        assert_eq!(core::mem::size_of::<tl_nav_detail>(), 88);
        assert_eq!(core::mem::offset_of!(tl_nav_detail, patch_count), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_detail, vertex_count), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_detail, triangle_count), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_detail, patches), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_detail, vertices), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_detail, triangles), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_detail, max_error), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_detail, limited_patches), 44);
        assert_eq!(core::mem::offset_of!(tl_nav_detail, allocator), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_detail, block), 72);
        assert_eq!(core::mem::offset_of!(tl_nav_detail, block_size), 80);
        assert_eq!(core::mem::size_of::<tl_nav_portal>(), 20);
        assert_eq!(core::mem::offset_of!(tl_nav_portal, polygon), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_portal, corner), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_portal, low), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_portal, high), 12);
        assert_eq!(core::mem::offset_of!(tl_nav_portal, first_profile), 16);
        assert_eq!(core::mem::size_of::<tl_nav_profile_point>(), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_profile_point, along), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_profile_point, height), 4);
        assert_eq!(core::mem::size_of::<tl_nav_tile_node>(), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_tile_node, min), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_tile_node, max), 6);
        assert_eq!(core::mem::offset_of!(tl_nav_tile_node, link), 12);
        assert_eq!(core::mem::size_of::<tl_nav_tile>(), 208);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, blob), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, tile_x), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, tile_z), 20);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, tile_size), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, polygon_count), 28);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, vertex_count), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, corner_count), 36);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, detail_vertex_count), 40);
        assert_eq!(
            core::mem::offset_of!(tl_nav_tile, detail_triangle_count),
            44
        );
        assert_eq!(core::mem::offset_of!(tl_nav_tile, node_count), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, portal_count), 52);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, profile_count), 56);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, layer), 60);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, side_end), 64);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, area), 80);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, origin), 88);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, cell_size), 100);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, cell_height), 104);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, agent_height), 108);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, agent_radius), 112);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, agent_max_climb), 116);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, bounds), 120);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, wide), 144);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, node_steps), 148);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, nodes), 152);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, first_corner), 156);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, links), 160);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, corner_vertices), 164);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, vertices), 168);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, flags), 172);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, areas), 176);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, detail_first_vertex), 180);
        assert_eq!(
            core::mem::offset_of!(tl_nav_tile, detail_first_triangle),
            184
        );
        assert_eq!(core::mem::offset_of!(tl_nav_tile, detail_vertices), 188);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, detail_triangles), 192);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, portals), 196);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, profile), 200);
        assert_eq!(core::mem::offset_of!(tl_nav_tile, zero), 204);
        assert_eq!(core::mem::size_of::<tl_nav_cut>(), 12);
        assert_eq!(core::mem::offset_of!(tl_nav_cut, corner), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_cut, layer), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_cut, ordinal), 8);
        assert_eq!(core::mem::size_of::<tl_nav_tile_source>(), 88);
        assert_eq!(core::mem::offset_of!(tl_nav_tile_source, polygons), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_tile_source, detail), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_tile_source, tile_x), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_tile_source, tile_z), 20);
        assert_eq!(core::mem::offset_of!(tl_nav_tile_source, tile_size), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_tile_source, origin), 28);
        assert_eq!(core::mem::offset_of!(tl_nav_tile_source, agent_height), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_tile_source, agent_radius), 44);
        assert_eq!(
            core::mem::offset_of!(tl_nav_tile_source, agent_max_climb),
            48
        );
        assert_eq!(core::mem::offset_of!(tl_nav_tile_source, flags), 56);
        assert_eq!(core::mem::offset_of!(tl_nav_tile_source, layer), 64);
        assert_eq!(core::mem::offset_of!(tl_nav_tile_source, cuts), 72);
        assert_eq!(core::mem::offset_of!(tl_nav_tile_source, cut_count), 80);
        assert_eq!(core::mem::size_of::<tl_nav_tile_stack>(), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_tile_stack, tiles), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_tile_stack, count), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_tile_stack, allocator), 16);
        assert_eq!(core::mem::size_of::<tl_nav_tile_part>(), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_tile_part, begin), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_tile_part, end), 4);
        assert_eq!(core::mem::size_of::<tl_nav_surface>(), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_surface, vertices), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_surface, vertex_count), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_surface, triangle_count), 12);
        assert_eq!(core::mem::offset_of!(tl_nav_surface, triangles), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_surface, is_wide), 24);
        assert_eq!(core::mem::size_of::<tl_nav_lattice_point>(), 12);
        assert_eq!(core::mem::offset_of!(tl_nav_lattice_point, at), 0);
        assert_eq!(core::mem::size_of::<tl_nav_link>(), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_link, to), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_link, edge), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_link, left), 12);
        assert_eq!(core::mem::offset_of!(tl_nav_link, right), 24);
        assert_eq!(core::mem::size_of::<tl_nav_offmesh>(), 64);
        assert_eq!(core::mem::offset_of!(tl_nav_offmesh, start), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_offmesh, end), 12);
        assert_eq!(core::mem::offset_of!(tl_nav_offmesh, radius), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_offmesh, cost_factor), 28);
        assert_eq!(core::mem::offset_of!(tl_nav_offmesh, fixed_cost), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_offmesh, flags), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_offmesh, user), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_offmesh, area), 56);
        assert_eq!(core::mem::offset_of!(tl_nav_offmesh, both_ways), 57);
        assert_eq!(core::mem::offset_of!(tl_nav_offmesh, cookie), 60);
        assert_eq!(core::mem::size_of::<tl_nav_location>(), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_location, polygon), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_location, point), 8);
        assert_eq!(core::mem::size_of::<tl_nav_offmesh_state>(), 128);
        assert_eq!(core::mem::offset_of!(tl_nav_offmesh_state, offmesh), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_offmesh_state, ends), 64);
        assert_eq!(core::mem::offset_of!(tl_nav_offmesh_state, anchored), 112);
        assert_eq!(core::mem::offset_of!(tl_nav_offmesh_state, length), 116);
        assert_eq!(core::mem::offset_of!(tl_nav_offmesh_state, cost), 120);
        assert_eq!(core::mem::size_of::<tl_nav_filter>(), 1072);
        assert_eq!(core::mem::offset_of!(tl_nav_filter, include_flags), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_filter, exclude_flags), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_filter, area_cost), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_filter, pass), 1040);
        assert_eq!(core::mem::offset_of!(tl_nav_filter, cost), 1048);
        assert_eq!(core::mem::offset_of!(tl_nav_filter, user), 1056);
        assert_eq!(core::mem::offset_of!(tl_nav_filter, slack), 1064);
        assert_eq!(core::mem::offset_of!(tl_nav_filter, cookie), 1068);
        assert_eq!(core::mem::size_of::<tl_nav_query_def>(), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_query_def, max_nodes), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_query_def, allocator), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_query_def, cookie), 16);
        assert_eq!(core::mem::size_of::<tl_nav_corner>(), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_corner, point), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_corner, polygon), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_corner, flags), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_corner, link), 32);
        assert_eq!(core::mem::size_of::<tl_nav_path_request>(), 56);
        assert_eq!(core::mem::offset_of!(tl_nav_path_request, filter), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_path_request, start), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_path_request, goal), 32);
        assert_eq!(core::mem::size_of::<tl_nav_path_buffers>(), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_path_buffers, polygons), 0);
        assert_eq!(
            core::mem::offset_of!(tl_nav_path_buffers, polygon_capacity),
            8
        );
        assert_eq!(core::mem::offset_of!(tl_nav_path_buffers, corners), 16);
        assert_eq!(
            core::mem::offset_of!(tl_nav_path_buffers, corner_capacity),
            24
        );
        assert_eq!(core::mem::size_of::<tl_nav_path>(), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_path, status), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_path, polygon_count), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_path, end), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_path, cost), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_path, node_count), 36);
        assert_eq!(core::mem::size_of::<tl_nav_path_progress>(), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_path_progress, status), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_path_progress, node_count), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_path_progress, tile_x), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_path_progress, tile_z), 12);
        assert_eq!(core::mem::size_of::<tl_nav_polygon_path>(), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_polygon_path, polygons), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_polygon_path, polygon_count), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_polygon_path, start), 12);
        assert_eq!(core::mem::offset_of!(tl_nav_polygon_path, end), 24);
        assert_eq!(core::mem::size_of::<tl_nav_trace_point>(), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_trace_point, point), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_trace_point, polygon), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_trace_point, flags), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_trace_point, cost), 28);
        assert_eq!(core::mem::offset_of!(tl_nav_trace_point, length), 32);
        assert_eq!(core::mem::size_of::<tl_nav_trace_request>(), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_trace_request, filter), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_trace_request, polygons), 8);
        assert_eq!(
            core::mem::offset_of!(tl_nav_trace_request, polygon_count),
            16
        );
        assert_eq!(core::mem::offset_of!(tl_nav_trace_request, corners), 24);
        assert_eq!(
            core::mem::offset_of!(tl_nav_trace_request, corner_count),
            32
        );
        assert_eq!(core::mem::offset_of!(tl_nav_trace_request, keep), 36);
        assert_eq!(core::mem::size_of::<tl_nav_shortest_path>(), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_shortest_path, status), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_shortest_path, corner_count), 4);
        assert_eq!(
            core::mem::offset_of!(tl_nav_shortest_path, polygon_count),
            8
        );
        assert_eq!(core::mem::offset_of!(tl_nav_shortest_path, length), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_shortest_path, lower_bound), 24);
        assert_eq!(
            core::mem::offset_of!(tl_nav_shortest_path, surface_length),
            32
        );
        assert_eq!(core::mem::offset_of!(tl_nav_shortest_path, node_count), 40);
        assert_eq!(core::mem::size_of::<tl_nav_ray_hit>(), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_ray_hit, hit), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_ray_hit, t), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_ray_hit, point), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_ray_hit, normal), 20);
        assert_eq!(core::mem::offset_of!(tl_nav_ray_hit, polygon), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_ray_hit, edge), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_ray_hit, polygon_count), 44);
        assert_eq!(core::mem::size_of::<tl_nav_move_request>(), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_move_request, filter), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_move_request, start), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_move_request, target), 32);
        assert_eq!(core::mem::size_of::<tl_nav_move>(), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_move, end), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_move, polygon_count), 24);
        assert_eq!(core::mem::size_of::<tl_nav_around_request>(), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_around_request, filter), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_around_request, center), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_around_request, radius), 32);
        assert_eq!(core::mem::size_of::<tl_nav_wall>(), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_wall, hit), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_wall, distance), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_wall, point), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_wall, normal), 20);
        assert_eq!(core::mem::offset_of!(tl_nav_wall, polygon), 32);
        assert_eq!(core::mem::size_of::<tl_nav_route_request>(), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_route_request, filter), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_route_request, start), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_route_request, goal), 20);
        assert_eq!(
            core::mem::offset_of!(tl_nav_route_request, half_extents),
            32
        );
        assert_eq!(core::mem::size_of::<tl_nav_route>(), 96);
        assert_eq!(core::mem::offset_of!(tl_nav_route, start), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_route, goal), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_route, path), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_route, corner_count), 88);
        assert_eq!(core::mem::offset_of!(tl_nav_route, length), 92);
        assert_eq!(core::mem::size_of::<tl_nav_zone>(), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_zone, center), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_zone, radius), 12);
        assert_eq!(core::mem::offset_of!(tl_nav_zone, points), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_zone, point_count), 24);
        assert_eq!(core::mem::size_of::<tl_nav_height_range>(), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_height_range, min), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_height_range, max), 4);
        assert_eq!(core::mem::size_of::<tl_nav_field_entry>(), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_field_entry, polygon), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_field_entry, link), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_field_entry, parent), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_field_entry, cost), 20);
        assert_eq!(core::mem::offset_of!(tl_nav_field_entry, point), 24);
        assert_eq!(core::mem::size_of::<tl_nav_field_def>(), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_field_def, filter), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_field_def, zone), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_field_def, max_cost), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_field_def, by_reference), 20);
        assert_eq!(core::mem::offset_of!(tl_nav_field_def, cookie), 24);
        assert_eq!(core::mem::size_of::<tl_nav_goal_entry>(), 56);
        assert_eq!(core::mem::offset_of!(tl_nav_goal_entry, polygon), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_goal_entry, link), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_goal_entry, parent), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_goal_entry, min_cost), 20);
        assert_eq!(core::mem::offset_of!(tl_nav_goal_entry, cost), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_goal_entry, corner), 28);
        assert_eq!(core::mem::offset_of!(tl_nav_goal_entry, left), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_goal_entry, right), 48);
        assert_eq!(core::mem::size_of::<tl_nav_goal_tree>(), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_goal_tree, entries), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_goal_tree, capacity), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_goal_tree, count), 12);
        assert_eq!(core::mem::offset_of!(tl_nav_goal_tree, goal), 16);
        assert_eq!(core::mem::size_of::<tl_nav_goal_path_request>(), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_goal_path_request, filter), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_goal_path_request, start), 8);
        assert_eq!(
            core::mem::offset_of!(tl_nav_goal_path_request, max_polygons),
            32
        );
        assert_eq!(core::mem::size_of::<tl_nav_wall_segment>(), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_wall_segment, start), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_wall_segment, end), 12);
        assert_eq!(core::mem::offset_of!(tl_nav_wall_segment, polygon), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_wall_segment, across), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_wall_segment, distance), 40);
        assert_eq!(core::mem::size_of::<tl_nav_def>(), 128);
        assert_eq!(core::mem::offset_of!(tl_nav_def, cell_size), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_def, cell_height), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_def, agent_height), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_def, agent_radius), 12);
        assert_eq!(core::mem::offset_of!(tl_nav_def, agent_max_climb), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_def, agent_max_slope), 20);
        assert_eq!(core::mem::offset_of!(tl_nav_def, region_min_size), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_def, region_merge_size), 28);
        assert_eq!(core::mem::offset_of!(tl_nav_def, edge_max_len), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_def, edge_max_error), 36);
        assert_eq!(core::mem::offset_of!(tl_nav_def, max_verts_per_poly), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_def, detail_sample_dist), 44);
        assert_eq!(
            core::mem::offset_of!(tl_nav_def, detail_sample_max_error),
            48
        );
        assert_eq!(core::mem::offset_of!(tl_nav_def, partition), 52);
        assert_eq!(core::mem::offset_of!(tl_nav_def, polygon_method), 56);
        assert_eq!(
            core::mem::offset_of!(tl_nav_def, filter_low_hanging_obstacles),
            60
        );
        assert_eq!(core::mem::offset_of!(tl_nav_def, filter_ledge_spans), 61);
        assert_eq!(
            core::mem::offset_of!(tl_nav_def, filter_walkable_low_height_spans),
            62
        );
        assert_eq!(core::mem::offset_of!(tl_nav_def, tile_size), 64);
        assert_eq!(core::mem::offset_of!(tl_nav_def, tile_height), 68);
        assert_eq!(core::mem::offset_of!(tl_nav_def, bounds), 72);
        assert_eq!(core::mem::offset_of!(tl_nav_def, host), 96);
        assert_eq!(core::mem::offset_of!(tl_nav_def, cookie), 120);
        assert_eq!(core::mem::size_of::<tl_nav_lattice>(), 20);
        assert_eq!(core::mem::offset_of!(tl_nav_lattice, origin), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_lattice, first_x), 12);
        assert_eq!(core::mem::offset_of!(tl_nav_lattice, first_z), 16);
        assert_eq!(core::mem::size_of::<tl_nav_config>(), 148);
        assert_eq!(core::mem::offset_of!(tl_nav_config, lattice), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_config, bounds), 20);
        assert_eq!(core::mem::offset_of!(tl_nav_config, cell_size), 44);
        assert_eq!(core::mem::offset_of!(tl_nav_config, cell_height), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_config, width), 52);
        assert_eq!(core::mem::offset_of!(tl_nav_config, height), 56);
        assert_eq!(core::mem::offset_of!(tl_nav_config, height_voxels), 60);
        assert_eq!(core::mem::offset_of!(tl_nav_config, border_size), 64);
        assert_eq!(core::mem::offset_of!(tl_nav_config, walkable_height), 68);
        assert_eq!(core::mem::offset_of!(tl_nav_config, walkable_climb), 72);
        assert_eq!(core::mem::offset_of!(tl_nav_config, walkable_radius), 76);
        assert_eq!(core::mem::offset_of!(tl_nav_config, walkable_slope_cos), 80);
        assert_eq!(core::mem::offset_of!(tl_nav_config, min_region_area), 84);
        assert_eq!(core::mem::offset_of!(tl_nav_config, merge_region_area), 88);
        assert_eq!(core::mem::offset_of!(tl_nav_config, max_edge_len), 92);
        assert_eq!(
            core::mem::offset_of!(tl_nav_config, max_simplification_error),
            96
        );
        assert_eq!(
            core::mem::offset_of!(tl_nav_config, max_verts_per_poly),
            100
        );
        assert_eq!(
            core::mem::offset_of!(tl_nav_config, detail_sample_dist),
            104
        );
        assert_eq!(
            core::mem::offset_of!(tl_nav_config, detail_sample_max_error),
            108
        );
        assert_eq!(core::mem::offset_of!(tl_nav_config, partition), 112);
        assert_eq!(core::mem::offset_of!(tl_nav_config, polygon_method), 116);
        assert_eq!(
            core::mem::offset_of!(tl_nav_config, filter_low_hanging_obstacles),
            120
        );
        assert_eq!(
            core::mem::offset_of!(tl_nav_config, filter_ledge_spans),
            121
        );
        assert_eq!(
            core::mem::offset_of!(tl_nav_config, filter_walkable_low_height_spans),
            122
        );
        assert_eq!(core::mem::offset_of!(tl_nav_config, tile_x), 124);
        assert_eq!(core::mem::offset_of!(tl_nav_config, tile_z), 128);
        assert_eq!(core::mem::offset_of!(tl_nav_config, layer_height), 132);
        assert_eq!(core::mem::offset_of!(tl_nav_config, agent_height), 136);
        assert_eq!(core::mem::offset_of!(tl_nav_config, agent_radius), 140);
        assert_eq!(core::mem::offset_of!(tl_nav_config, agent_max_climb), 144);
        assert_eq!(core::mem::size_of::<tl_nav_span>(), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_span, min), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_span, max), 2);
        assert_eq!(core::mem::offset_of!(tl_nav_span, area), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_span, reserved), 6);
        assert_eq!(core::mem::size_of::<tl_nav_heightfield>(), 112);
        assert_eq!(core::mem::offset_of!(tl_nav_heightfield, width), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_heightfield, height), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_heightfield, lattice), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_heightfield, bounds), 28);
        assert_eq!(core::mem::offset_of!(tl_nav_heightfield, cell_size), 52);
        assert_eq!(core::mem::offset_of!(tl_nav_heightfield, cell_height), 56);
        assert_eq!(core::mem::offset_of!(tl_nav_heightfield, first_span), 64);
        assert_eq!(core::mem::offset_of!(tl_nav_heightfield, spans), 72);
        assert_eq!(core::mem::offset_of!(tl_nav_heightfield, span_count), 80);
        assert_eq!(core::mem::offset_of!(tl_nav_heightfield, allocator), 88);
        assert_eq!(core::mem::size_of::<tl_nav_region_stats>(), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_region_stats, split), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_region_stats, merged), 4);
        assert_eq!(
            core::mem::offset_of!(tl_nav_region_stats, filtered_regions),
            8
        );
        assert_eq!(
            core::mem::offset_of!(tl_nav_region_stats, filtered_spans),
            12
        );
        assert_eq!(core::mem::size_of::<tl_nav_compact>(), 208);
        assert_eq!(core::mem::offset_of!(tl_nav_compact, width), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_compact, height), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_compact, border_size), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_compact, walkable_height), 12);
        assert_eq!(core::mem::offset_of!(tl_nav_compact, walkable_climb), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_compact, lattice), 20);
        assert_eq!(core::mem::offset_of!(tl_nav_compact, bounds), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_compact, cell_size), 64);
        assert_eq!(core::mem::offset_of!(tl_nav_compact, cell_height), 68);
        assert_eq!(core::mem::offset_of!(tl_nav_compact, span_count), 72);
        assert_eq!(core::mem::offset_of!(tl_nav_compact, first_span), 80);
        assert_eq!(core::mem::offset_of!(tl_nav_compact, floor), 88);
        assert_eq!(core::mem::offset_of!(tl_nav_compact, clearance), 96);
        assert_eq!(core::mem::offset_of!(tl_nav_compact, area), 104);
        assert_eq!(core::mem::offset_of!(tl_nav_compact, step), 112);
        assert_eq!(core::mem::offset_of!(tl_nav_compact, neighbour), 120);
        assert_eq!(core::mem::offset_of!(tl_nav_compact, distance), 128);
        assert_eq!(core::mem::offset_of!(tl_nav_compact, max_distance), 136);
        assert_eq!(core::mem::offset_of!(tl_nav_compact, region), 144);
        assert_eq!(core::mem::offset_of!(tl_nav_compact, region_count), 152);
        assert_eq!(core::mem::offset_of!(tl_nav_compact, region_stats), 156);
        assert_eq!(core::mem::offset_of!(tl_nav_compact, taken), 176);
        assert_eq!(core::mem::offset_of!(tl_nav_compact, allocator), 184);
        assert_eq!(core::mem::size_of::<tl_nav_contours>(), 216);
        assert_eq!(core::mem::offset_of!(tl_nav_contours, set), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_contours, raw), 80);
        assert_eq!(core::mem::offset_of!(tl_nav_contours, hole_count), 160);
        assert_eq!(core::mem::offset_of!(tl_nav_contours, unbridged_count), 164);
        assert_eq!(core::mem::offset_of!(tl_nav_contours, slit_count), 168);
        assert_eq!(core::mem::offset_of!(tl_nav_contours, repaired_count), 172);
        assert_eq!(core::mem::offset_of!(tl_nav_contours, allocator), 176);
        assert_eq!(core::mem::offset_of!(tl_nav_contours, block), 200);
        assert_eq!(core::mem::offset_of!(tl_nav_contours, block_size), 208);
        assert_eq!(core::mem::size_of::<tl_nav_volume>(), 64);
        assert_eq!(core::mem::offset_of!(tl_nav_volume, kind), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_volume, area), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_volume, r#box), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_volume, points), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_volume, point_count), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_volume, base), 44);
        assert_eq!(core::mem::offset_of!(tl_nav_volume, radius), 56);
        assert_eq!(core::mem::offset_of!(tl_nav_volume, height), 60);
        assert_eq!(core::mem::size_of::<tl_nav_input>(), 64);
        assert_eq!(core::mem::offset_of!(tl_nav_input, mesh), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_input, areas), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_input, volumes), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_input, volume_count), 56);
        assert_eq!(core::mem::size_of::<tl_nav_stages>(), 784);
        assert_eq!(core::mem::offset_of!(tl_nav_stages, heightfield), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_stages, compact), 112);
        assert_eq!(core::mem::offset_of!(tl_nav_stages, contours), 320);
        assert_eq!(core::mem::offset_of!(tl_nav_stages, polygons), 536);
        assert_eq!(core::mem::offset_of!(tl_nav_stages, detail), 696);
        assert_eq!(core::mem::size_of::<tl_nav_bake_report>(), 128);
        assert_eq!(core::mem::offset_of!(tl_nav_bake_report, base), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_bake_report, span_count), 48);
        assert_eq!(
            core::mem::offset_of!(tl_nav_bake_report, compact_span_count),
            56
        );
        assert_eq!(core::mem::offset_of!(tl_nav_bake_report, region_count), 64);
        assert_eq!(
            core::mem::offset_of!(tl_nav_bake_report, filtered_regions),
            68
        );
        assert_eq!(
            core::mem::offset_of!(tl_nav_bake_report, filtered_spans),
            72
        );
        assert_eq!(core::mem::offset_of!(tl_nav_bake_report, filtered_area), 80);
        assert_eq!(core::mem::offset_of!(tl_nav_bake_report, contour_count), 88);
        assert_eq!(
            core::mem::offset_of!(tl_nav_bake_report, unbridged_holes),
            92
        );
        assert_eq!(core::mem::offset_of!(tl_nav_bake_report, slit_outlines), 96);
        assert_eq!(
            core::mem::offset_of!(tl_nav_bake_report, repaired_contours),
            100
        );
        assert_eq!(
            core::mem::offset_of!(tl_nav_bake_report, polygon_count),
            104
        );
        assert_eq!(core::mem::offset_of!(tl_nav_bake_report, vertex_count), 108);
        assert_eq!(
            core::mem::offset_of!(tl_nav_bake_report, detail_triangle_count),
            112
        );
        assert_eq!(
            core::mem::offset_of!(tl_nav_bake_report, limited_patches),
            116
        );
        assert_eq!(core::mem::offset_of!(tl_nav_bake_report, tile_count), 120);
        assert_eq!(core::mem::size_of::<tl_nav_tiles>(), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_tiles, tiles), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_tiles, tile_count), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_tiles, tiles_x), 12);
        assert_eq!(core::mem::offset_of!(tl_nav_tiles, tiles_z), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_tiles, allocator), 24);
        assert_eq!(core::mem::size_of::<tl_nav_tile_range>(), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_tile_range, x), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_tile_range, z), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_tile_range, count_x), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_tile_range, count_z), 12);
        assert_eq!(core::mem::size_of::<tl_nav_stage_sink>(), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_stage_sink, take), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_stage_sink, user), 8);
        assert_eq!(core::mem::size_of::<tl_nav_tile_block>(), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_tile_block, range), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_tile_block, stacks), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_tile_block, allocator), 24);
        assert_eq!(core::mem::size_of::<tl_nav_near_triangles>(), 72);
        assert_eq!(core::mem::offset_of!(tl_nav_near_triangles, input), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_near_triangles, sources), 64);
        assert_eq!(core::mem::size_of::<tl_nav_prune_def>(), 72);
        assert_eq!(core::mem::offset_of!(tl_nav_prune_def, seeds), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_prune_def, seed_count), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_prune_def, seed_extents), 12);
        assert_eq!(core::mem::offset_of!(tl_nav_prune_def, solids), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_prune_def, min_area), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_prune_def, host), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_prune_def, cookie), 64);
        assert_eq!(core::mem::size_of::<tl_nav_pruned>(), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_pruned, islands), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_pruned, polygons), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_pruned, area), 16);
        assert_eq!(core::mem::size_of::<tl_nav_prune_report>(), 136);
        assert_eq!(core::mem::offset_of!(tl_nav_prune_report, base), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_prune_report, inside), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_prune_report, unreachable), 72);
        assert_eq!(core::mem::offset_of!(tl_nav_prune_report, small), 96);
        assert_eq!(
            core::mem::offset_of!(tl_nav_prune_report, island_count),
            120
        );
        assert_eq!(core::mem::offset_of!(tl_nav_prune_report, solid_count), 124);
        assert_eq!(
            core::mem::offset_of!(tl_nav_prune_report, removed_tiles),
            128
        );
        assert_eq!(
            core::mem::offset_of!(tl_nav_prune_report, changed_tiles),
            132
        );
        assert_eq!(core::mem::size_of::<tl_nav_probe>(), 20);
        assert_eq!(core::mem::offset_of!(tl_nav_probe, radius), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_probe, step), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_probe, height), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_probe, surface), 12);
        assert_eq!(core::mem::offset_of!(tl_nav_probe, gap), 16);
        assert_eq!(core::mem::size_of::<tl_nav_audit_def>(), 232);
        assert_eq!(core::mem::offset_of!(tl_nav_audit_def, nav), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_audit_def, path_count), 128);
        assert_eq!(core::mem::offset_of!(tl_nav_audit_def, seed), 136);
        assert_eq!(core::mem::offset_of!(tl_nav_audit_def, probe_radius), 144);
        assert_eq!(core::mem::offset_of!(tl_nav_audit_def, areas), 152);
        assert_eq!(core::mem::offset_of!(tl_nav_audit_def, volumes), 160);
        assert_eq!(core::mem::offset_of!(tl_nav_audit_def, volume_count), 168);
        assert_eq!(core::mem::offset_of!(tl_nav_audit_def, pruned), 176);
        assert_eq!(
            core::mem::offset_of!(tl_nav_audit_def, min_missing_area),
            184
        );
        assert_eq!(core::mem::offset_of!(tl_nav_audit_def, max_steps), 192);
        assert_eq!(core::mem::offset_of!(tl_nav_audit_def, host), 200);
        assert_eq!(core::mem::offset_of!(tl_nav_audit_def, cookie), 224);
        assert_eq!(core::mem::size_of::<tl_nav_finding>(), 80);
        assert_eq!(core::mem::offset_of!(tl_nav_finding, kind), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_finding, triangle), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_finding, polygon), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_finding, point), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_finding, contact), 28);
        assert_eq!(core::mem::offset_of!(tl_nav_finding, depth), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_finding, count), 44);
        assert_eq!(core::mem::offset_of!(tl_nav_finding, bounds), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_finding, area), 72);
        assert_eq!(core::mem::size_of::<tl_nav_audit>(), 136);
        assert_eq!(core::mem::offset_of!(tl_nav_audit, findings), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_audit, finding_count), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_audit, probe), 12);
        assert_eq!(core::mem::offset_of!(tl_nav_audit, path_count), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_audit, path_metres), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_audit, polygon_count), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_audit, portal_count), 56);
        assert_eq!(core::mem::offset_of!(tl_nav_audit, step_count), 64);
        assert_eq!(core::mem::offset_of!(tl_nav_audit, tolerated_count), 72);
        assert_eq!(core::mem::offset_of!(tl_nav_audit, contradictions), 80);
        assert_eq!(core::mem::offset_of!(tl_nav_audit, floor_samples), 88);
        assert_eq!(core::mem::offset_of!(tl_nav_audit, sample_spacing), 96);
        assert_eq!(core::mem::offset_of!(tl_nav_audit, missing_area), 104);
        assert_eq!(core::mem::offset_of!(tl_nav_audit, allocator), 112);
        assert_eq!(core::mem::size_of::<tl_nav_reason>(), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_reason, cause), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_reason, stage), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_reason, parameter), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_reason, value), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_reason, needed), 28);
        assert_eq!(core::mem::offset_of!(tl_nav_reason, measured), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_reason, triangle), 36);
        assert_eq!(core::mem::size_of::<tl_nav_why_answer>(), 416);
        assert_eq!(core::mem::offset_of!(tl_nav_why_answer, walkable), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_why_answer, floor), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_why_answer, reasons), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_why_answer, reason_count), 256);
        assert_eq!(core::mem::offset_of!(tl_nav_why_answer, proven), 260);
        assert_eq!(core::mem::offset_of!(tl_nav_why_answer, needed), 264);
        assert_eq!(core::mem::offset_of!(tl_nav_why_answer, tile_x), 392);
        assert_eq!(core::mem::offset_of!(tl_nav_why_answer, tile_z), 396);
        assert_eq!(core::mem::offset_of!(tl_nav_why_answer, bake_count), 400);
        assert_eq!(core::mem::offset_of!(tl_nav_why_answer, apart), 404);
        assert_eq!(core::mem::offset_of!(tl_nav_why_answer, island_area), 408);
        assert_eq!(
            core::mem::offset_of!(tl_nav_why_answer, largest_island_area),
            412
        );
        assert_eq!(core::mem::size_of::<tl_nav_pruning>(), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_pruning, removed), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_pruning, min_area), 8);
        assert_eq!(core::mem::size_of::<tl_nav_corridor>(), 56);
        assert_eq!(core::mem::offset_of!(tl_nav_corridor, path), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_corridor, capacity), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_corridor, count), 12);
        assert_eq!(core::mem::offset_of!(tl_nav_corridor, position), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_corridor, target), 28);
        assert_eq!(core::mem::offset_of!(tl_nav_corridor, goal), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_corridor, reaches), 52);
        assert_eq!(core::mem::size_of::<tl_nav_crowd_def>(), 72);
        assert_eq!(core::mem::offset_of!(tl_nav_crowd_def, max_agents), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_crowd_def, max_path), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_crowd_def, max_neighbors), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_crowd_def, paths_per_step), 12);
        assert_eq!(core::mem::offset_of!(tl_nav_crowd_def, max_nodes), 16);
        assert_eq!(
            core::mem::offset_of!(tl_nav_crowd_def, neighbor_distance),
            20
        );
        assert_eq!(core::mem::offset_of!(tl_nav_crowd_def, agent_horizon), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_crowd_def, wall_horizon), 28);
        assert_eq!(core::mem::offset_of!(tl_nav_crowd_def, host), 32);
        assert_eq!(
            core::mem::offset_of!(tl_nav_crowd_def, max_shared_goals),
            56
        );
        assert_eq!(core::mem::offset_of!(tl_nav_crowd_def, max_groups), 60);
        assert_eq!(core::mem::offset_of!(tl_nav_crowd_def, max_members), 64);
        assert_eq!(core::mem::offset_of!(tl_nav_crowd_def, cookie), 68);
        assert_eq!(core::mem::size_of::<tl_nav_agent_def>(), 52);
        assert_eq!(core::mem::offset_of!(tl_nav_agent_def, position), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_agent_def, reach), 12);
        assert_eq!(core::mem::offset_of!(tl_nav_agent_def, radius), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_agent_def, height), 20);
        assert_eq!(core::mem::offset_of!(tl_nav_agent_def, max_speed), 24);
        assert_eq!(
            core::mem::offset_of!(tl_nav_agent_def, max_acceleration),
            28
        );
        assert_eq!(core::mem::offset_of!(tl_nav_agent_def, arrive_distance), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_agent_def, priority), 36);
        assert_eq!(core::mem::offset_of!(tl_nav_agent_def, filter), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_agent_def, is_fixed), 44);
        assert_eq!(core::mem::offset_of!(tl_nav_agent_def, cookie), 48);
        assert_eq!(core::mem::size_of::<tl_nav_agent_state>(), 80);
        assert_eq!(core::mem::offset_of!(tl_nav_agent_state, status), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_agent_state, position), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_agent_state, velocity), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_agent_state, wanted), 28);
        assert_eq!(core::mem::offset_of!(tl_nav_agent_state, polygon), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_agent_state, link), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_agent_state, goal), 56);
        assert_eq!(core::mem::offset_of!(tl_nav_agent_state, radius), 68);
        assert_eq!(core::mem::offset_of!(tl_nav_agent_state, height), 72);
        assert_eq!(core::mem::size_of::<tl_nav_formation_slot>(), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_formation_slot, forward), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_formation_slot, left), 4);
        assert_eq!(core::mem::size_of::<tl_nav_group_def>(), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_group_def, formation), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_group_def, spacing), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_group_def, wait_distance), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_group_def, lost_distance), 12);
        assert_eq!(core::mem::offset_of!(tl_nav_group_def, slots), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_group_def, keep_order), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_group_def, cookie), 28);
        assert_eq!(core::mem::size_of::<tl_nav_group_state>(), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_group_state, formation), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_group_state, count), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_group_state, in_place), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_group_state, on_trail), 12);
        assert_eq!(core::mem::offset_of!(tl_nav_group_state, lag), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_group_state, speed), 20);
        assert_eq!(core::mem::offset_of!(tl_nav_group_state, heading), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_group_state, leader), 40);
        assert_eq!(core::mem::size_of::<tl_nav_crowd_step_report>(), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_crowd_step_report, searched), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_crowd_step_report, waiting), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_crowd_step_report, walking), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_crowd_step_report, arrived), 12);
        assert_eq!(
            core::mem::offset_of!(tl_nav_crowd_step_report, unreachable),
            16
        );
        assert_eq!(core::mem::offset_of!(tl_nav_crowd_step_report, on_link), 20);
        assert_eq!(
            core::mem::offset_of!(tl_nav_crowd_step_report, off_mesh),
            24
        );
        assert_eq!(core::mem::offset_of!(tl_nav_crowd_step_report, shared), 28);
        assert_eq!(core::mem::size_of::<tl_detour_report>(), 88);
        assert_eq!(core::mem::offset_of!(tl_detour_report, base), 0);
        assert_eq!(core::mem::offset_of!(tl_detour_report, tile_count), 48);
        assert_eq!(core::mem::offset_of!(tl_detour_report, polygon_count), 52);
        assert_eq!(core::mem::offset_of!(tl_detour_report, plain_patches), 56);
        assert_eq!(
            core::mem::offset_of!(tl_detour_report, dropped_polygons),
            60
        );
        assert_eq!(core::mem::offset_of!(tl_detour_report, one_way_links), 64);
        assert_eq!(core::mem::offset_of!(tl_detour_report, off_mesh_links), 68);
        assert_eq!(
            core::mem::offset_of!(tl_detour_report, off_mesh_outside),
            72
        );
        assert_eq!(core::mem::offset_of!(tl_detour_report, off_mesh_far), 76);
        assert_eq!(core::mem::offset_of!(tl_detour_report, area_zeros), 80);
        assert_eq!(core::mem::size_of::<tl_detour_tiles>(), 40);
        assert_eq!(core::mem::offset_of!(tl_detour_tiles, tiles), 0);
        assert_eq!(core::mem::offset_of!(tl_detour_tiles, tile_count), 8);
        assert_eq!(core::mem::offset_of!(tl_detour_tiles, allocator), 16);
        assert_eq!(core::mem::size_of::<tl_detour_read_def>(), 24);
        assert_eq!(core::mem::offset_of!(tl_detour_read_def, cell_height), 0);
        assert_eq!(core::mem::offset_of!(tl_detour_read_def, allocator), 8);
        assert_eq!(core::mem::offset_of!(tl_detour_read_def, cookie), 16);
        assert_eq!(core::mem::size_of::<tl_detour_off_mesh>(), 36);
        assert_eq!(core::mem::offset_of!(tl_detour_off_mesh, start), 0);
        assert_eq!(core::mem::offset_of!(tl_detour_off_mesh, end), 12);
        assert_eq!(core::mem::offset_of!(tl_detour_off_mesh, radius), 24);
        assert_eq!(core::mem::offset_of!(tl_detour_off_mesh, user_id), 28);
        assert_eq!(core::mem::offset_of!(tl_detour_off_mesh, flags), 32);
        assert_eq!(core::mem::offset_of!(tl_detour_off_mesh, area), 34);
        assert_eq!(core::mem::offset_of!(tl_detour_off_mesh, both_ways), 35);
        assert_eq!(core::mem::size_of::<tl_detour_set>(), 32);
        assert_eq!(core::mem::offset_of!(tl_detour_set, tiles), 0);
        assert_eq!(core::mem::offset_of!(tl_detour_set, tile_count), 8);
        assert_eq!(core::mem::offset_of!(tl_detour_set, off_mesh), 16);
        assert_eq!(core::mem::offset_of!(tl_detour_set, off_mesh_count), 24);
        assert_eq!(core::mem::offset_of!(tl_detour_set, refs), 28);
        assert_eq!(core::mem::size_of::<tl_nav_jump_link>(), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_jump_link, start), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_jump_link, end), 12);
        assert_eq!(core::mem::offset_of!(tl_nav_jump_link, apex), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_jump_link, kind), 28);
        assert_eq!(core::mem::offset_of!(tl_nav_jump_link, both_ways), 29);
        assert_eq!(core::mem::offset_of!(tl_nav_jump_link, reserved), 30);
        assert_eq!(core::mem::size_of::<tl_nav_links>(), 56);
        assert_eq!(core::mem::offset_of!(tl_nav_links, blob), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_links, link_count), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_links, kind_counts), 20);
        assert_eq!(core::mem::offset_of!(tl_nav_links, agent_radius), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_links, agent_height), 36);
        assert_eq!(core::mem::offset_of!(tl_nav_links, agent_max_climb), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_links, margin), 44);
        assert_eq!(core::mem::offset_of!(tl_nav_links, links), 48);
        assert_eq!(core::mem::size_of::<tl_nav_links_def>(), 72);
        assert_eq!(core::mem::offset_of!(tl_nav_links_def, spacing), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_links_def, max_drop), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_links_def, max_jump), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_links_def, jump_height), 12);
        assert_eq!(core::mem::offset_of!(tl_nav_links_def, max_speed), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_links_def, gravity), 20);
        assert_eq!(core::mem::offset_of!(tl_nav_links_def, max_climb), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_links_def, min_gain), 28);
        assert_eq!(core::mem::offset_of!(tl_nav_links_def, max_nodes), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_links_def, host), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_links_def, cookie), 64);
        assert_eq!(core::mem::size_of::<tl_nav_links_count>(), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_links_count, tried), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_links_count, blocked), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_links_count, useless), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_links_count, kept), 12);
        assert_eq!(core::mem::size_of::<tl_nav_links_report>(), 112);
        assert_eq!(core::mem::offset_of!(tl_nav_links_report, base), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_links_report, ledge_count), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_links_report, sample_count), 52);
        assert_eq!(core::mem::offset_of!(tl_nav_links_report, no_landing), 56);
        assert_eq!(core::mem::offset_of!(tl_nav_links_report, too_fast), 60);
        assert_eq!(core::mem::offset_of!(tl_nav_links_report, kinds), 64);
        assert_eq!(core::mem::size_of::<tl_nav_obstacle>(), 352);
        assert_eq!(core::mem::offset_of!(tl_nav_obstacle, shape), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_obstacle, area), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_obstacle, base), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_obstacle, height), 20);
        assert_eq!(core::mem::offset_of!(tl_nav_obstacle, radius), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_obstacle, half_x), 28);
        assert_eq!(core::mem::offset_of!(tl_nav_obstacle, half_z), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_obstacle, cosine), 36);
        assert_eq!(core::mem::offset_of!(tl_nav_obstacle, sine), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_obstacle, points), 44);
        assert_eq!(core::mem::offset_of!(tl_nav_obstacle, point_count), 236);
        assert_eq!(core::mem::offset_of!(tl_nav_obstacle, convex), 240);
        assert_eq!(core::mem::offset_of!(tl_nav_obstacle, pose), 320);
        assert_eq!(core::mem::size_of::<tl_nav_rebaked_tile>(), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_rebaked_tile, tile_x), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_rebaked_tile, tile_z), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_rebaked_tile, stack), 8);
        assert_eq!(core::mem::size_of::<tl_nav_prepare_def>(), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_prepare_def, table_bytes), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_prepare_def, tasks), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_prepare_def, progress), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_prepare_def, cookie), 24);
        assert_eq!(core::mem::size_of::<tl_nav_prepared>(), 80);
        assert_eq!(core::mem::offset_of!(tl_nav_prepared, base), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_prepared, kind), 48);
        assert_eq!(
            core::mem::offset_of!(tl_nav_prepared, corner_vertex_count),
            52
        );
        assert_eq!(core::mem::offset_of!(tl_nav_prepared, edge_count), 56);
        assert_eq!(core::mem::offset_of!(tl_nav_prepared, renewed_count), 60);
        assert_eq!(core::mem::offset_of!(tl_nav_prepared, bytes), 64);
        assert_eq!(core::mem::offset_of!(tl_nav_prepared, table_bytes), 72);
        assert_eq!(core::mem::size_of::<tl_pack_item>(), 24);
        assert_eq!(core::mem::offset_of!(tl_pack_item, r#type), 0);
        assert_eq!(core::mem::offset_of!(tl_pack_item, id), 4);
        assert_eq!(core::mem::offset_of!(tl_pack_item, bytes), 8);
        assert_eq!(core::mem::offset_of!(tl_pack_item, size), 16);
        assert_eq!(core::mem::size_of::<tl_pack_chunk>(), 24);
        assert_eq!(core::mem::offset_of!(tl_pack_chunk, r#type), 0);
        assert_eq!(core::mem::offset_of!(tl_pack_chunk, id), 4);
        assert_eq!(core::mem::offset_of!(tl_pack_chunk, bytes), 8);
        assert_eq!(core::mem::offset_of!(tl_pack_chunk, size), 16);
        assert_eq!(core::mem::size_of::<tl_pack>(), 24);
        assert_eq!(core::mem::offset_of!(tl_pack, bytes), 0);
        assert_eq!(core::mem::offset_of!(tl_pack, size), 8);
        assert_eq!(core::mem::offset_of!(tl_pack, chunk_count), 16);
        assert_eq!(core::mem::size_of::<tl_pack_entry>(), 32);
        assert_eq!(core::mem::offset_of!(tl_pack_entry, r#type), 0);
        assert_eq!(core::mem::offset_of!(tl_pack_entry, id), 4);
        assert_eq!(core::mem::offset_of!(tl_pack_entry, offset), 8);
        assert_eq!(core::mem::offset_of!(tl_pack_entry, size), 16);
        assert_eq!(core::mem::offset_of!(tl_pack_entry, hash), 24);
        assert_eq!(core::mem::size_of::<tl_pack_index>(), 24);
        assert_eq!(core::mem::offset_of!(tl_pack_index, entries), 0);
        assert_eq!(core::mem::offset_of!(tl_pack_index, count), 8);
        assert_eq!(core::mem::offset_of!(tl_pack_index, file_size), 16);
        assert_eq!(core::mem::size_of::<tl_pack_meta>(), 64);
        assert_eq!(core::mem::offset_of!(tl_pack_meta, blob), 0);
        assert_eq!(core::mem::offset_of!(tl_pack_meta, source_vertices), 16);
        assert_eq!(core::mem::offset_of!(tl_pack_meta, source_triangles), 24);
        assert_eq!(core::mem::offset_of!(tl_pack_meta, bounds), 32);
        assert_eq!(core::mem::offset_of!(tl_pack_meta, name_size), 56);
        assert_eq!(core::mem::offset_of!(tl_pack_meta, source_up), 60);
        assert_eq!(core::mem::size_of::<tl_pack_frame>(), 64);
        assert_eq!(core::mem::offset_of!(tl_pack_frame, blob), 0);
        assert_eq!(core::mem::offset_of!(tl_pack_frame, origin), 16);
        assert_eq!(core::mem::offset_of!(tl_pack_frame, axes), 40);
        assert_eq!(core::mem::offset_of!(tl_pack_frame, reserved), 44);
        assert_eq!(core::mem::size_of::<tl_pack_navmesh>(), 144);
        assert_eq!(core::mem::offset_of!(tl_pack_navmesh, blob), 0);
        assert_eq!(core::mem::offset_of!(tl_pack_navmesh, cell_size), 16);
        assert_eq!(core::mem::offset_of!(tl_pack_navmesh, cell_height), 20);
        assert_eq!(core::mem::offset_of!(tl_pack_navmesh, agent_height), 24);
        assert_eq!(core::mem::offset_of!(tl_pack_navmesh, agent_radius), 28);
        assert_eq!(core::mem::offset_of!(tl_pack_navmesh, agent_max_climb), 32);
        assert_eq!(core::mem::offset_of!(tl_pack_navmesh, agent_max_slope), 36);
        assert_eq!(core::mem::offset_of!(tl_pack_navmesh, region_min_size), 40);
        assert_eq!(
            core::mem::offset_of!(tl_pack_navmesh, region_merge_size),
            44
        );
        assert_eq!(core::mem::offset_of!(tl_pack_navmesh, edge_max_len), 48);
        assert_eq!(core::mem::offset_of!(tl_pack_navmesh, edge_max_error), 52);
        assert_eq!(
            core::mem::offset_of!(tl_pack_navmesh, max_verts_per_poly),
            56
        );
        assert_eq!(
            core::mem::offset_of!(tl_pack_navmesh, detail_sample_dist),
            60
        );
        assert_eq!(
            core::mem::offset_of!(tl_pack_navmesh, detail_sample_max_error),
            64
        );
        assert_eq!(core::mem::offset_of!(tl_pack_navmesh, partition), 68);
        assert_eq!(core::mem::offset_of!(tl_pack_navmesh, filters), 72);
        assert_eq!(core::mem::offset_of!(tl_pack_navmesh, tile_size), 76);
        assert_eq!(core::mem::offset_of!(tl_pack_navmesh, tiles_x), 80);
        assert_eq!(core::mem::offset_of!(tl_pack_navmesh, tiles_z), 84);
        assert_eq!(core::mem::offset_of!(tl_pack_navmesh, tile_count), 88);
        assert_eq!(core::mem::offset_of!(tl_pack_navmesh, bounds), 92);
        assert_eq!(core::mem::offset_of!(tl_pack_navmesh, polygon_method), 116);
        assert_eq!(core::mem::offset_of!(tl_pack_navmesh, tile_height), 120);
        assert_eq!(core::mem::offset_of!(tl_pack_navmesh, reserved), 124);
        assert_eq!(core::mem::size_of::<tl_pack_volume>(), 64);
        assert_eq!(core::mem::offset_of!(tl_pack_volume, kind), 0);
        assert_eq!(core::mem::offset_of!(tl_pack_volume, area), 4);
        assert_eq!(core::mem::offset_of!(tl_pack_volume, r#box), 8);
        assert_eq!(core::mem::offset_of!(tl_pack_volume, base), 32);
        assert_eq!(core::mem::offset_of!(tl_pack_volume, radius), 44);
        assert_eq!(core::mem::offset_of!(tl_pack_volume, height), 48);
        assert_eq!(core::mem::offset_of!(tl_pack_volume, first_point), 52);
        assert_eq!(core::mem::offset_of!(tl_pack_volume, point_count), 56);
        assert_eq!(core::mem::offset_of!(tl_pack_volume, reserved), 60);
        assert_eq!(core::mem::size_of::<tl_pack_volumes>(), 64);
        assert_eq!(core::mem::offset_of!(tl_pack_volumes, blob), 0);
        assert_eq!(core::mem::offset_of!(tl_pack_volumes, count), 16);
        assert_eq!(core::mem::offset_of!(tl_pack_volumes, point_count), 20);
        assert_eq!(core::mem::offset_of!(tl_pack_volumes, reserved), 24);
        assert_eq!(core::mem::size_of::<tl_pack_pruning>(), 64);
        assert_eq!(core::mem::offset_of!(tl_pack_pruning, blob), 0);
        assert_eq!(core::mem::offset_of!(tl_pack_pruning, min_area), 16);
        assert_eq!(core::mem::offset_of!(tl_pack_pruning, seed_extents), 24);
        assert_eq!(core::mem::offset_of!(tl_pack_pruning, seed_count), 36);
        assert_eq!(
            core::mem::offset_of!(tl_pack_pruning, drop_inside_solids),
            40
        );
        assert_eq!(core::mem::offset_of!(tl_pack_pruning, reserved), 44);
        assert_eq!(core::mem::size_of::<tl_pack_offmesh_link>(), 64);
        assert_eq!(core::mem::offset_of!(tl_pack_offmesh_link, start), 0);
        assert_eq!(core::mem::offset_of!(tl_pack_offmesh_link, end), 12);
        assert_eq!(core::mem::offset_of!(tl_pack_offmesh_link, radius), 24);
        assert_eq!(core::mem::offset_of!(tl_pack_offmesh_link, cost_factor), 28);
        assert_eq!(core::mem::offset_of!(tl_pack_offmesh_link, fixed_cost), 32);
        assert_eq!(core::mem::offset_of!(tl_pack_offmesh_link, area), 36);
        assert_eq!(core::mem::offset_of!(tl_pack_offmesh_link, both_ways), 40);
        assert_eq!(core::mem::offset_of!(tl_pack_offmesh_link, reserved), 44);
        assert_eq!(core::mem::offset_of!(tl_pack_offmesh_link, flags), 48);
        assert_eq!(core::mem::offset_of!(tl_pack_offmesh_link, user), 56);
        assert_eq!(core::mem::size_of::<tl_pack_offmesh>(), 64);
        assert_eq!(core::mem::offset_of!(tl_pack_offmesh, blob), 0);
        assert_eq!(core::mem::offset_of!(tl_pack_offmesh, count), 16);
        assert_eq!(core::mem::offset_of!(tl_pack_offmesh, reserved), 20);
        assert_eq!(core::mem::size_of::<tl_pack_areas>(), 64);
        assert_eq!(core::mem::offset_of!(tl_pack_areas, blob), 0);
        assert_eq!(core::mem::offset_of!(tl_pack_areas, count), 16);
        assert_eq!(core::mem::offset_of!(tl_pack_areas, reserved), 20);
        assert_eq!(core::mem::size_of::<tl_nav_world_def>(), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_world_def, read), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_world_def, user), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_world_def, budget), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_world_def, frame_reach), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_world_def, allocator), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_world_def, cookie), 40);
        assert_eq!(core::mem::size_of::<tl_nav_world_interest>(), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_world_interest, point), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_world_interest, radius), 24);
        assert_eq!(core::mem::size_of::<tl_nav_world_load>(), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_world_load, world), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_world_load, place), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_world_load, tile_x), 12);
        assert_eq!(core::mem::offset_of!(tl_nav_world_load, tile_z), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_world_load, result), 20);
        assert_eq!(core::mem::offset_of!(tl_nav_world_load, advice), 24);
        assert_eq!(core::mem::size_of::<tl_nav_world_state>(), 64);
        assert_eq!(core::mem::offset_of!(tl_nav_world_state, places), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_world_state, loaded), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_world_state, loading), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_world_state, ready), 12);
        assert_eq!(core::mem::offset_of!(tl_nav_world_state, missing), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_world_state, failed), 20);
        assert_eq!(core::mem::offset_of!(tl_nav_world_state, frames), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_world_state, bytes), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_world_state, peak_bytes), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_world_state, index_bytes), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_world_state, read_bytes), 56);
        assert_eq!(core::mem::size_of::<tl_nav_routes>(), 64);
        assert_eq!(core::mem::offset_of!(tl_nav_routes, blob), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_routes, tiles_hash), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_routes, gate_count), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_routes, length_count), 28);
        assert_eq!(core::mem::offset_of!(tl_nav_routes, block), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_routes, reserved), 36);
        assert_eq!(core::mem::size_of::<tl_nav_routes_def>(), 56);
        assert_eq!(core::mem::offset_of!(tl_nav_routes_def, read), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_routes_def, user), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_routes_def, block), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_routes_def, host), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_routes_def, cookie), 48);
        assert_eq!(core::mem::size_of::<tl_nav_world_route_request>(), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_world_route_request, start), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_world_route_request, goal), 24);
        assert_eq!(core::mem::size_of::<tl_nav_world_route_point>(), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_world_route_point, point), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_world_route_point, length), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_world_route_point, tile_x), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_world_route_point, tile_z), 36);
        assert_eq!(core::mem::size_of::<tl_nav_world_route>(), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_world_route, status), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_world_route, point_count), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_world_route, length), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_world_route, lower_bound), 16);
        assert_eq!(core::mem::size_of::<tl_nav_pvs_def>(), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_pvs_def, eye_height), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_pvs_def, max_distance), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_pvs_def, filter), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_pvs_def, host), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_pvs_def, cookie), 40);
        assert_eq!(core::mem::size_of::<tl_nav_pvs>(), 64);
        assert_eq!(core::mem::offset_of!(tl_nav_pvs, blob), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_pvs, slot_count), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_pvs, polygon_count), 20);
        assert_eq!(core::mem::offset_of!(tl_nav_pvs, words), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_pvs, eye_height), 28);
        assert_eq!(core::mem::offset_of!(tl_nav_pvs, first), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_pvs, rows), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_pvs, pair_count), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_pvs, reserved), 56);
        assert_eq!(core::mem::size_of::<tl_nav_cover_request>(), 64);
        assert_eq!(core::mem::offset_of!(tl_nav_cover_request, navmesh), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_cover_request, soup), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_cover_request, filter), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_cover_request, agent), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_cover_request, threat), 48);
        assert_eq!(core::mem::size_of::<tl_nav_cover_def>(), 64);
        assert_eq!(core::mem::offset_of!(tl_nav_cover_def, heights), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_cover_def, height_count), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_cover_def, spacing), 36);
        assert_eq!(core::mem::offset_of!(tl_nav_cover_def, max_length), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_cover_def, sight_filter), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_cover_def, cookie), 56);
        assert_eq!(core::mem::size_of::<tl_nav_cover>(), 32);
        assert_eq!(core::mem::offset_of!(tl_nav_cover, location), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_cover, length), 24);
        assert_eq!(core::mem::size_of::<tl_nav_polygon_state>(), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_polygon_state, flags), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_polygon_state, area), 8);
        assert_eq!(core::mem::size_of::<tl_nav_versions_state>(), 32);
        assert_eq!(
            core::mem::offset_of!(tl_nav_versions_state, version_count),
            0
        );
        assert_eq!(core::mem::offset_of!(tl_nav_versions_state, newest), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_versions_state, oldest), 16);
        assert_eq!(
            core::mem::offset_of!(tl_nav_versions_state, waiting_bytes),
            24
        );
        assert_eq!(core::mem::size_of::<tl_nav_wide_path>(), 40);
        assert_eq!(core::mem::offset_of!(tl_nav_wide_path, status), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_wide_path, corner_count), 4);
        assert_eq!(core::mem::offset_of!(tl_nav_wide_path, wall_distance), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_wide_path, length), 16);
        assert_eq!(core::mem::offset_of!(tl_nav_wide_path, surface_length), 24);
        assert_eq!(core::mem::offset_of!(tl_nav_wide_path, node_count), 32);
        assert_eq!(core::mem::size_of::<tl_nav_wide_def>(), 8);
        assert_eq!(core::mem::offset_of!(tl_nav_wide_def, max_radius), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_wide_def, cookie), 4);
        assert_eq!(core::mem::size_of::<tl_nav_wide_report>(), 72);
        assert_eq!(core::mem::offset_of!(tl_nav_wide_report, base), 0);
        assert_eq!(core::mem::offset_of!(tl_nav_wide_report, bytes), 48);
        assert_eq!(core::mem::offset_of!(tl_nav_wide_report, wall_count), 56);
        assert_eq!(core::mem::offset_of!(tl_nav_wide_report, tile_count), 64);
        assert_eq!(
            core::mem::offset_of!(tl_nav_wide_report, made_tile_count),
            68
        );
        assert_eq!(core::mem::size_of::<tl_scene_placement>(), 36);
        assert_eq!(core::mem::offset_of!(tl_scene_placement, group), 0);
        assert_eq!(core::mem::offset_of!(tl_scene_placement, pose), 4);
        assert_eq!(core::mem::offset_of!(tl_scene_placement, scale), 32);
        assert_eq!(core::mem::size_of::<tl_scene_group>(), 32);
        assert_eq!(core::mem::offset_of!(tl_scene_group, instances), 0);
        assert_eq!(core::mem::offset_of!(tl_scene_group, instance_count), 8);
        assert_eq!(core::mem::offset_of!(tl_scene_group, placements), 16);
        assert_eq!(core::mem::offset_of!(tl_scene_group, placement_count), 24);
        assert_eq!(core::mem::size_of::<tl_scene_copy>(), 56);
        assert_eq!(core::mem::offset_of!(tl_scene_copy, pose), 0);
        assert_eq!(core::mem::offset_of!(tl_scene_copy, scale), 28);
        assert_eq!(core::mem::offset_of!(tl_scene_copy, group), 32);
        assert_eq!(core::mem::offset_of!(tl_scene_copy, parent), 36);
        assert_eq!(core::mem::offset_of!(tl_scene_copy, placement), 40);
        assert_eq!(core::mem::offset_of!(tl_scene_copy, first_instance), 44);
        assert_eq!(core::mem::offset_of!(tl_scene_copy, instance_count), 48);
        assert_eq!(core::mem::offset_of!(tl_scene_copy, copy_count), 52);
        assert_eq!(core::mem::size_of::<tl_scene_expansion>(), 56);
        assert_eq!(core::mem::offset_of!(tl_scene_expansion, instances), 0);
        assert_eq!(core::mem::offset_of!(tl_scene_expansion, instance_count), 8);
        assert_eq!(core::mem::offset_of!(tl_scene_expansion, copies), 16);
        assert_eq!(core::mem::offset_of!(tl_scene_expansion, copy_count), 24);
        assert_eq!(core::mem::offset_of!(tl_scene_expansion, allocator), 32);
        assert_eq!(core::mem::size_of::<tl_scene_version>(), 32);
        assert_eq!(core::mem::offset_of!(tl_scene_version, scene), 0);
        assert_eq!(core::mem::offset_of!(tl_scene_version, instances), 8);
        assert_eq!(core::mem::offset_of!(tl_scene_version, count), 16);
        assert_eq!(core::mem::offset_of!(tl_scene_version, number), 24);
        assert_eq!(core::mem::size_of::<tl_scene_versions_state>(), 24);
        assert_eq!(
            core::mem::offset_of!(tl_scene_versions_state, version_count),
            0
        );
        assert_eq!(core::mem::offset_of!(tl_scene_versions_state, newest), 8);
        assert_eq!(core::mem::offset_of!(tl_scene_versions_state, oldest), 16);
    }
}
