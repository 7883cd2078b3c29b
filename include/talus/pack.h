// SPDX-License-Identifier: MIT
//
// The baked file: a container of typed chunks that is written once, mapped, checked whole, and queried in place.
//
// The core does no file I/O: bytes come from the caller's memory and go to the caller's callback.
// docs/guide/file-format.md describes the layout. Little-endian; chunks begin at multiples of 64 bytes.

#ifndef TALUS_PACK_H
#define TALUS_PACK_H

#include <talus/base.h>
#include <talus/nav_bake.h>
#include <talus/nav_links.h>
#include <talus/nav_prune.h>
#include <talus/nav_query.h>

#ifdef __cplusplus
extern "C" {
#endif

#define TL_PACK_VERSION 1u

/// A chunk type of four characters, the first in the lowest byte.
#define TL_PACK_TYPE(a, b, c, d) ((uint32_t)(a) | (uint32_t)(b) << 8 | (uint32_t)(c) << 16 | (uint32_t)(d) << 24)

#define TL_PACK_META             TL_PACK_TYPE('M', 'E', 'T', 'A') ///< tl_pack_meta: where the geometry came from
#define TL_PACK_SOUP             TL_PACK_TYPE('S', 'O', 'U', 'P') ///< tl_soup
#define TL_PACK_HULL             TL_PACK_TYPE('H', 'U', 'L', 'L') ///< tl_hull
#define TL_PACK_NAVM             TL_PACK_TYPE('N', 'A', 'V', 'M') ///< tl_pack_navmesh: what the tiles were baked with
#define TL_PACK_NAVT             TL_PACK_TYPE('N', 'A', 'V', 'T') ///< tl_nav_tile; the id numbers the tiles
#define TL_PACK_LINK             TL_PACK_TYPE('L', 'I', 'N', 'K') ///< tl_nav_links: drops, jumps and climbs
#define TL_PACK_OFFM             TL_PACK_TYPE('O', 'F', 'F', 'M') ///< tl_pack_offmesh: off-mesh links set by hand
#define TL_PACK_AREA             TL_PACK_TYPE('A', 'R', 'E', 'A') ///< tl_pack_areas: areas of the source's triangles
#define TL_PACK_FRAM             TL_PACK_TYPE('F', 'R', 'A', 'M') ///< tl_pack_frame: the level's own coordinates
#define TL_PACK_MARK             TL_PACK_TYPE('M', 'A', 'R', 'K') ///< tl_pack_volumes: volumes the tiles were baked with
#define TL_PACK_PRUN             TL_PACK_TYPE('P', 'R', 'U', 'N') ///< tl_pack_pruning: rules that islands were left out by
#define TL_PACK_PRUT             TL_PACK_TYPE('P', 'R', 'U', 'T') ///< tl_nav_tile: what was left out; the id numbers them
#define TL_PACK_ROUT             TL_PACK_TYPE('R', 'O', 'U', 'T') ///< tl_nav_routes: lengths over a whole world (nav_routes.h)

/// One chunk to be written. The pair (type, id) is its name and must be unique in the file.
typedef struct tl_pack_item {
    uint32_t type; ///< TL_PACK_META ..., or one of the user's own; not 0
    uint32_t id;
    const void *bytes;
    uint64_t size; ///< bytes
} tl_pack_item;

/// Takes the next bytes of the file. Any result but TL_OK ends the writing and is returned by tl_pack_write.
typedef tl_result tl_write_fn(const void *bytes, size_t size, void *user);

/// Writes a whole container, front to back, chunks in the order given. The same items give the same bytes.
/// `allocator` (NULL: malloc) lends memory for the table. `report_out` may be NULL. TL_ERR_ARGUMENT (a type of 0, or a
/// name twice: element "chunk"), TL_ERR_MEMORY, and what `write` returns.
TL_API tl_result tl_pack_write(const tl_pack_item *items, uint32_t count, const tl_allocator *allocator,
                               tl_write_fn *write, void *user, tl_report *report_out);

/// Bytes that tl_pack_write will write.
TL_API uint64_t tl_pack_size(const tl_pack_item *items, uint32_t count);

/// A chunk of an open container, in place.
typedef struct tl_pack_chunk {
    uint32_t type;
    uint32_t id;
    const void *bytes; ///< 64-byte aligned
    uint64_t size;     ///< bytes
} tl_pack_chunk;

/// An open container: a view of the caller's bytes, which must outlive it. Nothing to free.
typedef struct tl_pack {
    const void *bytes;
    uint64_t size; ///< bytes
    uint32_t chunk_count;
} tl_pack;

/// Opens a container after checking it whole: every truncated prefix and every altered byte is refused.
///
/// `bytes` must be 64-byte aligned, as a mapped file is (TL_ERR_ARGUMENT), and in the machine's byte order
/// (tl_pack_to_host_order). TL_ERR_MAGIC (not a talus file), TL_ERR_VERSION, TL_ERR_TRUNCATED (shorter than it says),
/// TL_ERR_HASH (altered; the report names "header", "table" or "chunk" and its index), TL_ERR_CORRUPT (bytes behind the
/// end, padding that is not zero, or a table that contradicts itself); `*pack_out` is zeroed then. What chunks contain
/// is checked by their own check functions. `report_out` may be NULL. O(size).
TL_API tl_result tl_pack_open(const void *bytes, uint64_t size, tl_pack *pack_out, tl_report *report_out);

// ---------------------------------------------------------------------------------------------------------
// Byte order. Files are little-endian, and so are blobs in the memory of nearly every machine: there these functions
// change nothing, and a portable program calls them all the same. On big-endian machines (s390x) a blob in memory has
// the machine's own order. tl_pack_write turns the blobs of its chunks by itself; chunks of the user's own types are
// bytes.

/// Turns the bytes of a file round in place, before tl_pack_open. Bytes that were turned before stay as they are.
/// TL_ERR_ARGUMENT (NULL); on big-endian machines also the errors of tl_pack_open, after which the bytes are of no use.
/// `report_out` may be NULL. O(size).
TL_API tl_result tl_pack_to_host_order(void *bytes, uint64_t size, tl_report *report_out);

/// Turns a single blob of any kind round in place, for those who store blobs in files of their own: to_file before it
/// is written (its copy: a blob in the file's order answers no queries), to_host before its check. `size`: the blob's,
/// bytes. TL_ERR_ARGUMENT (NULL), TL_ERR_TRUNCATED, TL_ERR_MAGIC (no blob of this library), TL_ERR_CORRUPT (big-endian
/// machines: counts that do not fit the size; the bytes are of no use then). `report_out` may be NULL. O(size).
TL_API tl_result tl_blob_to_file_order(void *bytes, uint64_t size, tl_report *report_out);
TL_API tl_result tl_blob_to_host_order(void *bytes, uint64_t size, tl_report *report_out);

/// Chunk number `index` < chunk_count (the caller's duty), in file order.
TL_API tl_pack_chunk tl_pack_chunk_at(const tl_pack *pack, uint32_t index);

/// The chunk of that name. TL_NOT_FOUND: there is none; `*chunk_out` is zeroed then. TL_ERR_ARGUMENT: NULL. O(chunks).
TL_API tl_result tl_pack_find(const tl_pack *pack, uint32_t type, uint32_t id, tl_pack_chunk *chunk_out);

/// How many chunks have that type. O(chunks).
TL_API uint32_t tl_pack_count(const tl_pack *pack, uint32_t type);

// ---------------------------------------------------------------------------------------------------------
// The index alone: what lies where, for files that are not read whole (nav_world.h). First tl_pack_index_size with the
// file's first TL_PACK_HEAD_SIZE bytes, then tl_pack_index_open with as many as it says; then single chunks are read,
// each with tl_pack_entry_open. All three take bytes as they stand in the file.

#define TL_PACK_HEAD_SIZE 64 ///< bytes

/// Where a chunk lies in its file.
typedef struct tl_pack_entry {
    uint32_t type;
    uint32_t id;
    uint64_t offset; ///< bytes from the start of the file; a multiple of 64
    uint64_t size;   ///< bytes
    uint64_t hash;   ///< XXH64 of the chunk, as it stands in the file
} tl_pack_entry;

/// An index that was checked: a view of the caller's bytes, which must outlive it.
typedef struct tl_pack_index {
    const tl_pack_entry *entries; ///< [count], in file order
    uint32_t count;
    uint64_t file_size; ///< bytes
} tl_pack_index;

/// Bytes of the index of the file that begins with these TL_PACK_HEAD_SIZE bytes. `head` must be 8-byte aligned.
/// TL_ERR_ARGUMENT, and of tl_pack_open TL_ERR_MAGIC, TL_ERR_VERSION, TL_ERR_HASH and TL_ERR_CORRUPT; `*size_out` is 0
/// then. `report_out` may be NULL.
TL_API tl_result tl_pack_index_size(const void *head, uint64_t *size_out, tl_report *report_out);
/// Checks an index of `size` bytes, those that tl_pack_index_size says, and turns it to the machine's byte order in
/// place. `bytes` must be 8-byte aligned. Chunks and padding are not looked at. TL_ERR_ARGUMENT, TL_ERR_TRUNCATED, and
/// those of tl_pack_open; `*index_out` is zeroed then. `report_out` may be NULL. O(size).
TL_API tl_result tl_pack_index_open(void *bytes, uint64_t size, tl_pack_index *index_out, tl_report *report_out);
/// Verifies the hash of a chunk that was read to `bytes`, entry->size of them, and turns it to the machine's byte
/// order. What it contains is checked by its own check function. `bytes` must be 8-byte aligned. TL_ERR_ARGUMENT,
/// TL_ERR_HASH, TL_ERR_CORRUPT; the bytes are of no use then. `report_out` may be NULL. O(size).
TL_API tl_result tl_pack_entry_open(const tl_pack_entry *entry, void *bytes, tl_report *report_out);

// ---------------------------------------------------------------------------------------------------------
// Writing a file that is larger than memory: first what each chunk is called, its size and its hash; then the chunks,
// one at a time, fetched when their turn has come. The file has the bytes that tl_pack_write would write.

/// The entry of a chunk whose bytes stand as the file is to have them: blobs by tl_blob_to_file_order. Its offset is 0
/// until it is written. `type` is not 0; `bytes` may be NULL when size is 0. TL_ERR_ARGUMENT: `*entry_out`, if it is
/// there, is zeroed. O(size).
TL_API tl_result tl_pack_entry_make(uint32_t type, uint32_t id, const void *bytes, uint64_t size,
                                    tl_pack_entry *entry_out);

/// Gives the bytes of chunk `index`, which stay the callee's and stand there until the next call. Called once for each
/// chunk, in order. Any result but TL_OK ends the writing and is returned by tl_pack_write_fetched.
typedef tl_result tl_pack_fetch_fn(uint32_t index, const void **bytes_out, void *user);

/// Writes a whole container of `count` entries, those of tl_pack_entry_make, in the order given; `user` is for both
/// callbacks. `allocator` (NULL: malloc) lends about 64 bytes a chunk. `report_out` may be NULL. TL_ERR_ARGUMENT (as of
/// tl_pack_write), TL_ERR_HASH (what was fetched is not what its entry says: element "chunk"), TL_ERR_MEMORY, and what
/// `fetch` and `write` return.
TL_API tl_result tl_pack_write_fetched(const tl_pack_entry *entries, uint32_t count, const tl_allocator *allocator,
                                       tl_pack_fetch_fn *fetch, tl_write_fn *write, void *user, tl_report *report_out);

// ---------------------------------------------------------------------------------------------------------
// The chunks that belong to the file itself.

#define TL_PACK_META_MAGIC      TL_PACK_META
#define TL_PACK_META_VERSION    1u
#define TL_PACK_NAVMESH_MAGIC   TL_PACK_NAVM
#define TL_PACK_NAVMESH_VERSION 1u
#define TL_PACK_FRAME_MAGIC     TL_PACK_FRAM
#define TL_PACK_FRAME_VERSION   1u
#define TL_PACK_VOLUMES_MAGIC   TL_PACK_MARK
#define TL_PACK_VOLUMES_VERSION 1u
#define TL_PACK_PRUNING_MAGIC   TL_PACK_PRUN
#define TL_PACK_PRUNING_VERSION 1u
#define TL_PACK_OFFMESH_MAGIC   TL_PACK_OFFM
#define TL_PACK_OFFMESH_VERSION 1u
#define TL_PACK_AREAS_MAGIC     TL_PACK_AREA
#define TL_PACK_AREAS_VERSION   1u
#define TL_PACK_ROUTES_MAGIC    TL_PACK_ROUT
#define TL_PACK_ROUTES_VERSION  1u

/// Where the geometry came from. A blob; the name follows it.
typedef struct tl_pack_meta {
    tl_blob blob;
    uint64_t source_vertices;  ///< as read, before welding
    uint64_t source_triangles; ///< as read
    tl_aabb bounds;            ///< metres, of the cleaned mesh
    uint32_t name_size;        ///< bytes, without the closing zero
    uint32_t source_up;        ///< TL_PACK_UP_Y, set by the encoder, or TL_PACK_UP_Z: set it before the file is written
} tl_pack_meta;

/// The source's up axis. What is baked is y-up: of a z-up source a point (x, y, z) was turned to (x, z, -y). A FRAM
/// chunk says the same of other axes; a file without one has no origin, and the axes that stand here.
enum { TL_PACK_UP_Y, TL_PACK_UP_Z };

/// Encodes a META blob, freed with tl_blob_free. `source_name` is a zero-terminated string of at most 2^16 bytes
/// (TL_ERR_LIMIT), or NULL. `allocator` NULL: malloc. TL_ERR_ARGUMENT, TL_ERR_MEMORY; `*meta_out` is NULL then.
/// `report_out` may be NULL.
TL_API tl_result tl_pack_meta_encode(const char *source_name, uint64_t source_vertices, uint64_t source_triangles,
                                     tl_aabb bounds, const tl_allocator *allocator, tl_pack_meta **meta_out,
                                     tl_report *report_out);
/// Whether untrusted bytes are a META blob. TL_ERR_ARGUMENT (NULL, or not 8-byte aligned), TL_ERR_TRUNCATED,
/// TL_ERR_MAGIC, TL_ERR_VERSION, TL_ERR_CORRUPT; `report_out` may be NULL. O(size).
TL_API tl_result tl_pack_meta_check(const void *bytes, uint64_t size, tl_report *report_out);
/// The source's name, zero-terminated, in the blob.
TL_API const char *tl_pack_meta_name(const tl_pack_meta *meta);

/// The axes of a level. What is baked is TL_PACK_AXES_Y_UP; the others are turned to it, and mirrored where they are
/// left-handed, where triangles are also wound the other way, so that (b - a) x (c - a), computed in either
/// coordinates, points to the same side.
typedef enum tl_pack_axes {
    TL_PACK_AXES_Y_UP,      ///< right-handed, y up: glTF, OpenGL, talus
    TL_PACK_AXES_Z_UP,      ///< right-handed, z up, (x, y, z) becomes (x, z, -y): Blender, robots, surveys
    TL_PACK_AXES_Y_UP_LEFT, ///< left-handed, y up, (x, y, z) becomes (x, y, -z): Unity, Direct3D
    TL_PACK_AXES_Z_UP_LEFT, ///< left-handed, z up, (x, y, z) becomes (x, z, y): Unreal
} tl_pack_axes;

/// The level's own coordinates: a point of the level less `origin`, turned from `axes`, is a point of what was baked. A
/// blob. Files have none where the two are the same.
typedef struct tl_pack_frame {
    tl_blob blob;
    double origin[3]; ///< metres, in the level's axes
    uint32_t axes;    ///< a tl_pack_axes
    uint32_t reserved[5];
} tl_pack_frame;

/// Encodes a FRAM blob, freed with tl_blob_free. `allocator` NULL: malloc. TL_ERR_ARGUMENT ("axes" is none of them,
/// "origin" is NULL or not finite), TL_ERR_MEMORY; `*frame_out` is NULL then. `report_out` may be NULL.
TL_API tl_result tl_pack_frame_encode(tl_pack_axes axes, const double origin[3], const tl_allocator *allocator,
                                      tl_pack_frame **frame_out, tl_report *report_out);
/// As tl_pack_meta_check.
TL_API tl_result tl_pack_frame_check(const void *bytes, uint64_t size, tl_report *report_out);

/// A point of the level to a point of what was baked, and back. `frame`, checked, may be NULL: then both are the same.
/// The difference is taken in double, so that a float's rounding is that of the small numbers.
TL_API tl_vec3 tl_pack_place_in(const tl_pack_frame *frame, const double point[3]);
TL_API void tl_pack_place_out(const tl_pack_frame *frame, tl_vec3 point, double out[3]);
/// The same of a direction, exactly.
TL_API tl_vec3 tl_pack_turn_in(tl_pack_axes axes, tl_vec3 v);
TL_API tl_vec3 tl_pack_turn_out(tl_pack_axes axes, tl_vec3 v);

/// What a navmesh was baked with: tl_nav_def in metres, and the grid of its tiles. A blob.
typedef struct tl_pack_navmesh {
    tl_blob blob;
    float cell_size, cell_height;
    float agent_height, agent_radius, agent_max_climb, agent_max_slope;
    float region_min_size, region_merge_size;
    float edge_max_len, edge_max_error;
    uint32_t max_verts_per_poly;
    float detail_sample_dist, detail_sample_max_error;
    uint32_t partition; ///< a tl_nav_partition
    uint32_t filters;   ///< bit 0 low hanging obstacles, 1 ledge spans, 2 low height spans
    uint32_t tile_size; ///< cells, 0: one tile
    uint32_t tiles_x, tiles_z;
    uint32_t tile_count;     ///< NAVT chunks
    tl_aabb bounds;          ///< metres, that were baked; bounds.min is the origin of the lattice
    uint32_t polygon_method; ///< a tl_partition_method
    float tile_height;       ///< metres, 0: tiles are not divided into layers
    uint32_t reserved[5];
} tl_pack_navmesh;

/// Encodes a NAVM blob, freed with tl_blob_free. `def->bounds`: what was baked (NULL def: the default one); the grid
/// has tiles_x by tiles_z places and `tile_count` tiles. `allocator` NULL: malloc. TL_ERR_ARGUMENT, TL_ERR_MEMORY;
/// `*navmesh_out` is NULL then. `report_out` may be NULL.
TL_API tl_result tl_pack_navmesh_encode(const tl_nav_def *def, uint32_t tiles_x, uint32_t tiles_z, uint32_t tile_count,
                                        const tl_allocator *allocator, tl_pack_navmesh **navmesh_out,
                                        tl_report *report_out);
/// As tl_pack_meta_check.
TL_API tl_result tl_pack_navmesh_check(const void *bytes, uint64_t size, tl_report *report_out);

/// The def that a navmesh was baked with; its host is empty, its bounds are those that were baked.
TL_API tl_nav_def tl_pack_navmesh_def(const tl_pack_navmesh *navmesh);

/// A volume that gives floors an area (tl_nav_volume). What its kind does not use is zero.
typedef struct tl_pack_volume {
    uint32_t kind;                     ///< a tl_nav_volume_kind
    uint32_t area;                     ///< [0, TL_NAV_MAX_AREA]; 0: floors are cut away
    tl_aabb box;                       ///< metres: of a box; its y range is that of a polygon
    tl_vec3 base;                      ///< metres: of a cylinder
    float radius, height;              ///< metres: of a cylinder
    uint32_t first_point, point_count; ///< of a polygon; the volumes' points follow one another
    uint32_t reserved;
} tl_pack_volume;

/// The volumes with which a navmesh was baked. A blob; `count` tl_pack_volume follow it, then `point_count` points of
/// three floats, whose y is zero.
typedef struct tl_pack_volumes {
    tl_blob blob;
    uint32_t count, point_count;
    uint32_t reserved[10];
} tl_pack_volumes;

/// Encodes a MARK blob, freed with tl_blob_free. `volumes` may be NULL when count is 0. `allocator` NULL: malloc. The
/// report, which may be NULL, names the volume. TL_ERR_ARGUMENT (no such kind, or points are missing),
/// TL_ERR_NOT_FINITE, TL_ERR_LIMIT (2^32 points), TL_ERR_MEMORY; `*volumes_out` is NULL then.
TL_API tl_result tl_pack_volumes_encode(const tl_nav_volume *volumes, uint32_t count, const tl_allocator *allocator,
                                        tl_pack_volumes **volumes_out, tl_report *report_out);
/// As tl_pack_meta_check; the report names the volume. O(size).
TL_API tl_result tl_pack_volumes_check(const void *bytes, uint64_t size, tl_report *report_out);
/// Volume number `index` < volumes->count (the caller's duty) of checked volumes; its points lie in the blob.
TL_API tl_nav_volume tl_pack_volumes_at(const tl_pack_volumes *volumes, uint32_t index);

/// The rules by which a navmesh was pruned (tl_nav_prune_def). A blob; `seed_count` points of three floats follow it.
typedef struct tl_pack_pruning {
    tl_blob blob;
    double min_area;             ///< square metres
    tl_vec3 seed_extents;        ///< metres
    uint32_t seed_count;         ///< 0: islands need no seed
    uint32_t drop_inside_solids; ///< 1: islands inside closed parts of the level were left out
    uint32_t reserved[5];
} tl_pack_pruning;

/// Encodes a PRUN blob, freed with tl_blob_free. `def` NULL: the default one. `allocator` NULL: malloc. TL_ERR_ARGUMENT
/// (a field), TL_ERR_NOT_FINITE (a seed), TL_ERR_MEMORY; `*pruning_out` is NULL then. `report_out` may be NULL.
TL_API tl_result tl_pack_pruning_encode(const tl_nav_prune_def *def, const tl_allocator *allocator,
                                        tl_pack_pruning **pruning_out, tl_report *report_out);
/// As tl_pack_meta_check. O(size).
TL_API tl_result tl_pack_pruning_check(const void *bytes, uint64_t size, tl_report *report_out);
/// The seeds of checked rules, in the blob.
TL_API const tl_vec3 *tl_pack_pruning_seeds(const tl_pack_pruning *pruning);

/// An off-mesh link (tl_nav_offmesh).
typedef struct tl_pack_offmesh_link {
    tl_vec3 start, end;                    ///< metres
    float radius, cost_factor, fixed_cost; ///< >= 0
    uint32_t area;                         ///< [0, TL_NAV_MAX_AREA]
    uint32_t both_ways;                    ///< 0 or 1
    uint32_t reserved;
    uint64_t flags; ///< not 0
    uint64_t user;
} tl_pack_offmesh_link;

/// Off-mesh links that were set by hand. A blob; `count` tl_pack_offmesh_link follow it.
typedef struct tl_pack_offmesh {
    tl_blob blob;
    uint32_t count;
    uint32_t reserved[11];
} tl_pack_offmesh;

/// Encodes an OFFM blob, freed with tl_blob_free. `links` may be NULL when count is 0. `allocator` NULL: malloc. The
/// report, which may be NULL, names the "link". TL_ERR_ARGUMENT (what tl_navmesh_add_offmesh refuses), TL_ERR_LIMIT
/// (more than TL_NAV_MAX_OFFMESH), TL_ERR_MEMORY; `*offmesh_out` is NULL then.
TL_API tl_result tl_pack_offmesh_encode(const tl_nav_offmesh *links, uint32_t count, const tl_allocator *allocator,
                                        tl_pack_offmesh **offmesh_out, tl_report *report_out);
/// As tl_pack_meta_check; the report names the link. O(size).
TL_API tl_result tl_pack_offmesh_check(const void *bytes, uint64_t size, tl_report *report_out);
/// Link number `index` < offmesh->count (the caller's duty) of checked links.
TL_API tl_nav_offmesh tl_pack_offmesh_at(const tl_pack_offmesh *offmesh, uint32_t index);

/// The areas that materials gave the triangles, by a triangle's index in the source, as the soup numbers them. A blob;
/// `count` bytes follow it. Files have none where all triangles have TL_NAV_WALKABLE_AREA.
typedef struct tl_pack_areas {
    tl_blob blob;
    uint32_t count; ///< triangles of the source
    uint32_t reserved[11];
} tl_pack_areas;

/// Encodes an AREA blob, freed with tl_blob_free. `areas` may be NULL when count is 0. `allocator` NULL: malloc.
/// TL_ERR_ARGUMENT, TL_ERR_MEMORY; `*areas_out` is NULL then. `report_out` may be NULL.
TL_API tl_result tl_pack_areas_encode(const uint8_t *areas, uint32_t count, const tl_allocator *allocator,
                                      tl_pack_areas **areas_out, tl_report *report_out);
/// As tl_pack_meta_check. O(padding).
TL_API tl_result tl_pack_areas_check(const void *bytes, uint64_t size, tl_report *report_out);
/// The areas of checked ones, [areas->count], in the blob.
TL_API const uint8_t *tl_pack_areas_array(const tl_pack_areas *areas);

/// Checks every NAVT chunk and adds the tiles, borrowed, to a new navmesh: the pack's bytes must outlive it. The links
/// of LINK chunks (tl_nav_links_add) and of OFFM chunks (tl_navmesh_add_offmesh) are added to it. Ended with
/// tl_navmesh_destroy. TL_NOT_FOUND: the file holds no navmesh. TL_ERR_ARGUMENT, and what the checks of these chunks
/// and tl_navmesh_add_tile, tl_nav_links_add and tl_navmesh_add_offmesh return, with the chunk's index in the report,
/// which may be NULL. `*navmesh_out` is NULL then.
TL_API tl_result tl_pack_load_navmesh(const tl_pack *pack, const tl_allocator *allocator, tl_navmesh **navmesh_out,
                                      tl_report *report_out);

/// The same for the PRUT chunks: a navmesh of what was left out. TL_NOT_FOUND: nothing was. Else as
/// tl_pack_load_navmesh.
TL_API tl_result tl_pack_load_pruned(const tl_pack *pack, const tl_allocator *allocator, tl_navmesh **navmesh_out,
                                     tl_report *report_out);

#ifdef __cplusplus
}
#endif

#endif
