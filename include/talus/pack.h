// SPDX-License-Identifier: MIT
//
// One file: a container of typed chunks that is written once, mapped, checked whole, and queried in place.
//
// The core does no file I/O: bytes come from the caller's memory and go to the caller's sink. The layout is described
// in docs/file-format.md. Little-endian; chunks begin at multiples of 64 bytes.

#ifndef TALUS_PACK_H
#define TALUS_PACK_H

#include <talus/base.h>
#include <talus/nav_bake.h>
#include <talus/nav_links.h>
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
#define TL_PACK_NAVM             TL_PACK_TYPE('N', 'A', 'V', 'M') ///< tl_pack_navmesh: what the tiles were built with
#define TL_PACK_NAVT             TL_PACK_TYPE('N', 'A', 'V', 'T') ///< tl_nav_tile; the id numbers the tiles
#define TL_PACK_LINK             TL_PACK_TYPE('L', 'I', 'N', 'K') ///< tl_nav_links: drops, jumps and climbs
#define TL_PACK_MARK             TL_PACK_TYPE('M', 'A', 'R', 'K') ///< tl_pack_volumes: volumes that the tiles were built with

/// One chunk to be written. The pair (type, id) is its name and must be unique in the file.
typedef struct tl_pack_item {
    uint32_t type;
    uint32_t id;
    const void *bytes;
    uint64_t size;
} tl_pack_item;

/// Takes the next bytes of the file. Anything but TL_OK ends the writing and is handed on.
typedef tl_result tl_write_fn(const void *bytes, size_t size, void *user);

/// Writes a whole container, front to back, chunks in the order given. The same items give the same bytes.
/// `allocator` lends room for the table. TL_ERR_ARGUMENT: a name that occurs twice, a type of 0; what `write` returns.
TL_API tl_result tl_pack_write(const tl_pack_item *items, uint32_t count, const tl_allocator *allocator,
                               tl_write_fn *write, void *user, tl_report *report_out);

/// Bytes that tl_pack_write will write.
TL_API uint64_t tl_pack_size(const tl_pack_item *items, uint32_t count);

/// A chunk of an open container, in place.
typedef struct tl_pack_chunk {
    uint32_t type;
    uint32_t id;
    const void *bytes; ///< 64-byte aligned
    uint64_t size;
} tl_pack_chunk;

/// An open container: a view of the caller's bytes, which must outlive it. Nothing to free.
typedef struct tl_pack {
    const void *bytes;
    uint64_t size;
    uint32_t chunk_count;
} tl_pack;

/// Checks a container whole, before anything of it is used: every truncated prefix and every altered byte is refused.
///
/// `bytes` must be 64-byte aligned, as a mapped file is (TL_ERR_ARGUMENT). Errors by name: TL_ERR_MAGIC (not a talus
/// file), TL_ERR_VERSION, TL_ERR_TRUNCATED (shorter than it says), TL_ERR_HASH (altered; the report names "header",
/// "table" or "chunk" and its index), TL_ERR_CORRUPT (bytes behind the end, non-zero padding, or a table that
/// contradicts itself). The chunks' own content is checked by their own check functions. O(size).
TL_API tl_result tl_pack_open(const void *bytes, uint64_t size, tl_pack *pack_out, tl_report *report_out);

/// Chunk number `index` < chunk_count, in file order.
TL_API tl_pack_chunk tl_pack_chunk_at(const tl_pack *pack, uint32_t index);

/// The chunk of that name. TL_NOT_FOUND.
TL_API tl_result tl_pack_find(const tl_pack *pack, uint32_t type, uint32_t id, tl_pack_chunk *chunk_out);

/// How many chunks have that type.
TL_API uint32_t tl_pack_count(const tl_pack *pack, uint32_t type);

// ---------------------------------------------------------------------------------------------------------
// The chunks that belong to the file itself.

#define TL_PACK_META_MAGIC      TL_PACK_META
#define TL_PACK_META_VERSION    1u
#define TL_PACK_NAVMESH_MAGIC   TL_PACK_NAVM
#define TL_PACK_NAVMESH_VERSION 1u
#define TL_PACK_MARKS_MAGIC     TL_PACK_MARK
#define TL_PACK_MARKS_VERSION   1u

/// Where the geometry came from. A blob; the name follows it.
typedef struct tl_pack_meta {
    tl_blob blob;
    uint64_t source_vertices;  ///< as read, before welding
    uint64_t source_triangles; ///< as read
    tl_aabb bounds;            ///< metres, of the cleaned mesh
    uint32_t name_size;        ///< bytes, without the closing zero
    uint32_t reserved;
} tl_pack_meta;

/// Makes a META blob; `source_name` is a zero-terminated string of at most 2^16 bytes (TL_ERR_LIMIT), or NULL.
TL_API tl_result tl_pack_meta_encode(const char *source_name, uint64_t source_vertices, uint64_t source_triangles,
                                     tl_aabb bounds, const tl_allocator *allocator, tl_pack_meta **meta_out);
/// Whether untrusted bytes are a META blob. TL_ERR_ARGUMENT (NULL, or not 8-byte aligned), TL_ERR_TRUNCATED,
/// TL_ERR_MAGIC, TL_ERR_VERSION, TL_ERR_CORRUPT; `report_out` may be NULL. O(size).
TL_API tl_result tl_pack_meta_check(const void *bytes, uint64_t size, tl_report *report_out);
/// The source's name, zero-terminated.
TL_API const char *tl_pack_meta_name(const tl_pack_meta *meta);

/// What a navmesh was built with: tl_nav_def in metres, and the grid of its tiles. A blob.
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
    tl_aabb bounds;          ///< metres; bounds.min is the origin of the lattice
    uint32_t polygon_method; ///< a tl_partition_method
    float tile_height;       ///< metres, 0: places are not divided into layers
    uint32_t reserved[5];
} tl_pack_navmesh;

TL_API tl_result tl_pack_navmesh_encode(const tl_nav_def *def, tl_aabb bounds, uint32_t tiles_x, uint32_t tiles_z,
                                        uint32_t tile_count, const tl_allocator *allocator,
                                        tl_pack_navmesh **navmesh_out);
/// As tl_pack_meta_check.
TL_API tl_result tl_pack_navmesh_check(const void *bytes, uint64_t size, tl_report *report_out);

/// The def that a navmesh was built with, host empty; its bounds are those it was built over.
TL_API tl_nav_def tl_pack_navmesh_def(const tl_pack_navmesh *navmesh);

/// A volume that gives floors an area. What its kind does not use is zero.
typedef struct tl_pack_mark {
    uint32_t kind; ///< a tl_nav_volume_kind
    uint32_t area; ///< 0: floors are cut away
    tl_aabb box;   ///< metres: of a box; the heights of a polygon
    tl_vec3 base;  ///< metres: of a cylinder
    float radius, height;
    uint32_t first_point, point_count; ///< of a polygon; marks' points follow one another
    uint32_t reserved;
} tl_pack_mark;

/// The volumes with which a navmesh was built. A blob; `count` marks follow it, then `point_count` points of three
/// floats, whose y is zero.
typedef struct tl_pack_volumes {
    tl_blob blob;
    uint32_t count, point_count;
    uint32_t reserved[10];
} tl_pack_volumes;

/// TL_ERR_NOT_FINITE: a coordinate that is not, or a kind that there is not. TL_ERR_LIMIT: 2^32 points. TL_ERR_MEMORY.
TL_API tl_result tl_pack_volumes_encode(const tl_nav_volume *volumes, uint32_t count, const tl_allocator *allocator,
                                        tl_pack_volumes **marks_out);
/// As tl_pack_meta_check; the report names the volume. O(size).
TL_API tl_result tl_pack_volumes_check(const void *bytes, uint64_t size, tl_report *report_out);
/// Volume `index` < count of checked marks; its points lie in them.
TL_API tl_nav_volume tl_pack_volumes_at(const tl_pack_volumes *marks, uint32_t index);

/// Checks every NAVT chunk and puts the tiles, borrowed, into a fresh navmesh: the pack's bytes must outlive it. Links
/// of LINK chunks are added to it, as tl_nav_links_add does.
/// TL_NOT_FOUND: there is no navmesh in the file. Else what tl_nav_tile_check, tl_navmesh_add_tile,
/// tl_nav_links_check and tl_nav_links_add return, with the chunk's index in the report (which may be NULL).
TL_API tl_result tl_pack_load_navmesh(const tl_pack *pack, const tl_allocator *allocator, tl_navmesh **navmesh_out,
                                      tl_report *report_out);

#ifdef __cplusplus
}
#endif

#endif
