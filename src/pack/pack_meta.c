// SPDX-License-Identifier: MIT
//
// The chunks that describe the file itself: where the geometry came from, and what the navmesh was baked with.

#include "base/arena.h"
#include "base/assert.h"
#include "base/blob_check.h"
#include "base/host.h"
#include "pack/pack_format.h"

#include <math.h>
#include <string.h>

_Static_assert(sizeof(tl_pack_meta) == 64 && sizeof(tl_pack_navmesh) == 144, "no hidden padding");

enum { MAX_NAME_BYTES = 1 << 16, MAX_MAX_VERTS = 64 };

tl_result tl_pack_meta_encode(const char *source_name, uint64_t source_vertices, uint64_t source_triangles,
                              tl_aabb bounds, const tl_allocator *allocator, tl_pack_meta **meta_out,
                              tl_report *report_out)
{
    tl_report_begin(report_out, "encode meta");
    if (meta_out == NULL) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "meta_out", "it may not be NULL");
    }
    *meta_out = NULL;
    const char *name = source_name != NULL ? source_name : "";
    size_t name_size = strlen(name);
    if (name_size > MAX_NAME_BYTES) {
        return tl_report_field(report_out, TL_ERR_LIMIT, "source_name", "give a name of at most 65536 bytes");
    }
    tl_pack_meta *meta =
        tl_blob_allocate(allocator, TL_PACK_META_MAGIC, TL_PACK_META_VERSION, sizeof *meta + name_size + 1);
    if (meta == NULL) {
        return TL_ERR_MEMORY;
    }
    meta->source_vertices = source_vertices;
    meta->source_triangles = source_triangles;
    meta->bounds = bounds;
    meta->name_size = (uint32_t)name_size;
    memcpy(meta + 1, name, name_size);
    *meta_out = meta;
    return TL_OK;
}

tl_result tl_pack_check_head(const void *bytes, uint64_t size, tl_blob expected, tl_report *report)
{
    TL_TRY(tl_blob_check_head(bytes, size, expected, 8, report));
    return ((const tl_blob *)bytes)->size == size
               ? TL_OK
               : tl_report_fail(report, TL_ERR_CORRUPT, "head", TL_NO_ELEMENT, "there are bytes behind its end");
}

tl_result tl_pack_meta_check(const void *bytes, uint64_t size, tl_report *report_out)
{
    const tl_blob expected = { TL_PACK_META_MAGIC, TL_PACK_META_VERSION, sizeof(tl_pack_meta) };
    TL_TRY(tl_pack_check_head(bytes, size, expected, report_out));
    const tl_pack_meta *meta = bytes;
    uint64_t name_capacity = size - sizeof *meta;
    if (meta->name_size > MAX_NAME_BYTES || meta->name_size >= name_capacity || meta->source_up > TL_PACK_UP_Z) {
        return tl_report_fail(report_out, TL_ERR_CORRUPT, "name", TL_NO_ELEMENT, "bake the file again");
    }
    // One string without a zero inside, then zeros only.
    const char *name = tl_pack_meta_name(meta);
    for (uint64_t i = 0; i < name_capacity; i++) {
        if ((name[i] == 0) != (i >= meta->name_size)) {
            return tl_report_fail(report_out, TL_ERR_CORRUPT, "name", TL_NO_ELEMENT, "bake the file again");
        }
    }
    return TL_OK;
}

const char *tl_pack_meta_name(const tl_pack_meta *meta)
{
    return (const char *)(meta + 1);
}

tl_result tl_pack_navmesh_encode(const tl_nav_def *def, uint32_t tiles_x, uint32_t tiles_z, uint32_t tile_count,
                                 const tl_allocator *allocator, tl_pack_navmesh **navmesh_out, tl_report *report_out)
{
    tl_report_begin(report_out, "encode navmesh");
    if (navmesh_out == NULL) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "navmesh_out", "it may not be NULL");
    }
    *navmesh_out = NULL;
    const tl_nav_def default_def = tl_default_nav_def();
    def = def != NULL ? def : &default_def;
    TL_TRY(tl_def_check(def->cookie, "begin with tl_default_nav_def()", report_out));
    tl_pack_navmesh *navmesh =
        tl_blob_allocate(allocator, TL_PACK_NAVMESH_MAGIC, TL_PACK_NAVMESH_VERSION, sizeof *navmesh);
    if (navmesh == NULL) {
        return TL_ERR_MEMORY;
    }
    navmesh->cell_size = def->cell_size;
    navmesh->cell_height = def->cell_height;
    navmesh->agent_height = def->agent_height;
    navmesh->agent_radius = def->agent_radius;
    navmesh->agent_max_climb = def->agent_max_climb;
    navmesh->agent_max_slope = def->agent_max_slope;
    navmesh->region_min_size = def->region_min_size;
    navmesh->region_merge_size = def->region_merge_size;
    navmesh->edge_max_len = def->edge_max_len;
    navmesh->edge_max_error = def->edge_max_error;
    navmesh->max_verts_per_poly = def->max_verts_per_poly;
    navmesh->detail_sample_dist = def->detail_sample_dist;
    navmesh->detail_sample_max_error = def->detail_sample_max_error;
    navmesh->partition = (uint32_t)def->partition;
    navmesh->polygon_method = (uint32_t)def->polygon_method;
    navmesh->filters = (def->filter_low_hanging_obstacles ? 1u : 0u) | (def->filter_ledge_spans ? 2u : 0u) |
                       (def->filter_walkable_low_height_spans ? 4u : 0u);
    navmesh->tile_size = def->tile_size;
    navmesh->tile_height = def->tile_height;
    navmesh->tiles_x = tiles_x;
    navmesh->tiles_z = tiles_z;
    navmesh->tile_count = tile_count;
    navmesh->bounds = def->bounds;
    *navmesh_out = navmesh;
    return TL_OK;
}

tl_nav_def tl_pack_navmesh_def(const tl_pack_navmesh *navmesh)
{
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = navmesh->cell_size;
    def.cell_height = navmesh->cell_height;
    def.agent_height = navmesh->agent_height;
    def.agent_radius = navmesh->agent_radius;
    def.agent_max_climb = navmesh->agent_max_climb;
    def.agent_max_slope = navmesh->agent_max_slope;
    def.region_min_size = navmesh->region_min_size;
    def.region_merge_size = navmesh->region_merge_size;
    def.edge_max_len = navmesh->edge_max_len;
    def.edge_max_error = navmesh->edge_max_error;
    def.max_verts_per_poly = navmesh->max_verts_per_poly;
    def.detail_sample_dist = navmesh->detail_sample_dist;
    def.detail_sample_max_error = navmesh->detail_sample_max_error;
    def.partition = (tl_nav_partition)navmesh->partition;
    def.polygon_method = (tl_partition_method)navmesh->polygon_method;
    def.filter_low_hanging_obstacles = (navmesh->filters & 1u) != 0;
    def.filter_ledge_spans = (navmesh->filters & 2u) != 0;
    def.filter_walkable_low_height_spans = (navmesh->filters & 4u) != 0;
    def.tile_size = navmesh->tile_size;
    def.tile_height = navmesh->tile_height;
    def.bounds = navmesh->bounds;
    return def;
}

static bool are_sound_settings(const tl_pack_navmesh *navmesh)
{
    return navmesh->cell_size >= TL_NAV_MIN_CELL && isfinite(navmesh->cell_size) &&
           navmesh->cell_height >= TL_NAV_MIN_CELL && isfinite(navmesh->cell_height) &&
           navmesh->partition <= TL_NAV_LAYERS && navmesh->polygon_method <= TL_PARTITION_DELAUNAY &&
           navmesh->filters <= 7 && navmesh->max_verts_per_poly <= MAX_MAX_VERTS && navmesh->tile_height >= 0.0f &&
           isfinite(navmesh->tile_height) &&
           (navmesh->tile_height > 0.0f || navmesh->tile_count <= (uint64_t)navmesh->tiles_x * navmesh->tiles_z);
}

tl_result tl_pack_navmesh_check(const void *bytes, uint64_t size, tl_report *report_out)
{
    const tl_blob expected = { TL_PACK_NAVMESH_MAGIC, TL_PACK_NAVMESH_VERSION, sizeof(tl_pack_navmesh) };
    TL_TRY(tl_pack_check_head(bytes, size, expected, report_out));
    const tl_pack_navmesh *navmesh = bytes;
    uint32_t any = 0;
    for (uint64_t i = sizeof *navmesh; i < size; i++) {
        any |= ((const uint8_t *)bytes)[i];
    }
    for (size_t i = 0; i < TL_COUNT_OF(navmesh->reserved); i++) {
        any |= navmesh->reserved[i];
    }
    if (any != 0 || !are_sound_settings(navmesh)) {
        return tl_report_fail(report_out, TL_ERR_CORRUPT, any != 0 ? "padding" : "settings", TL_NO_ELEMENT,
                              "bake the file again");
    }
    return TL_OK;
}
