// SPDX-License-Identifier: MIT
//
// Meshes: the input of a call, welding, the built-in levels, and the options of a navmesh.

#include "js_mesh.h"

#include "cli/sample/sample_level.h"

#include <stdlib.h>
#include <string.h>

tl_nav_input tl_js_input;

static tl_nav_volume *input_volumes;

// Doubles of a volume before its points: kind, area, box, base, radius, height, number of points.
enum { VOLUME_NUMBERS = 14 };

tl_nav_volume *tl_js_volumes(const double *numbers, uint32_t count, tl_result *result_out)
{
    *result_out = TL_OK;
    if (count == 0) {
        return NULL;
    }
    size_t points = 0;
    const double *next = numbers;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t own = (uint32_t)next[VOLUME_NUMBERS - 1];
        points += own;
        next += VOLUME_NUMBERS + 3 * (size_t)own;
    }
    tl_nav_volume *volumes = calloc(1, count * sizeof *volumes + points * sizeof(tl_vec3));
    if (volumes == NULL) {
        *result_out = TL_ERR_MEMORY;
        return NULL;
    }
    tl_vec3 *point = (tl_vec3 *)(void *)(volumes + count);
    next = numbers;
    for (uint32_t i = 0; i < count; i++) {
        float f[VOLUME_NUMBERS];
        for (uint32_t k = 0; k < VOLUME_NUMBERS; k++) {
            f[k] = (float)next[k];
        }
        tl_nav_volume *v = &volumes[i];
        v->kind = (tl_nav_volume_kind)next[0];
        v->area = (uint8_t)next[1];
        v->box.min = tl_vec3_make(f[2], f[3], f[4]);
        v->box.max = tl_vec3_make(f[5], f[6], f[7]);
        v->base = tl_vec3_make(f[8], f[9], f[10]);
        v->radius = f[11];
        v->height = f[12];
        v->point_count = (uint32_t)next[VOLUME_NUMBERS - 1];
        v->points = v->point_count > 0 ? point : NULL;
        next += VOLUME_NUMBERS;
        for (uint32_t k = 0; k < v->point_count; k++, next += 3) {
            *point++ = tl_vec3_make((float)next[0], (float)next[1], (float)next[2]);
        }
    }
    return volumes;
}

/// What the next calls are about; the arrays stay JavaScript's. Areas may be NULL.
tl_result TL_JS_EXPORT(js_set_input)(const tl_vec3 *vertices, uint32_t vertex_count, const uint32_t *indices,
                                     uint32_t triangle_count, const uint16_t *materials, const uint8_t *areas,
                                     const double *volumes, uint32_t volume_count)
{
    const tl_mesh_view mesh = { vertices, vertex_count, indices, triangle_count, materials };
    memset(&tl_js_input, 0, sizeof tl_js_input);
    free(input_volumes);
    tl_result result;
    input_volumes = tl_js_volumes(volumes, volume_count, &result);
    tl_js_input.mesh = mesh;
    tl_js_input.areas = areas;
    tl_js_input.volumes = input_volumes;
    tl_js_input.volume_count = input_volumes != NULL ? volume_count : 0;
    return result;
}

/// Areas alone, by the triangles of a soup.
void TL_JS_EXPORT(js_set_areas)(const uint8_t *areas)
{
    tl_js_input.areas = areas;
}

void TL_JS_EXPORT(js_clear_input)(void)
{
    free(input_volumes);
    input_volumes = NULL;
    memset(&tl_js_input, 0, sizeof tl_js_input);
}

// One comparison an axis and side: this is seen beside the bake of a small level with many triangles.
tl_aabb tl_js_input_bounds(void)
{
    const tl_mesh_view *mesh = &tl_js_input.mesh;
    tl_aabb box = tl_aabb_empty();
    for (size_t i = 0; i < 3 * (size_t)mesh->triangle_count; i++) {
        if (mesh->indices[i] >= mesh->vertex_count) {
            continue; // the bake refuses it by name
        }
        const tl_vec3 *p = &mesh->vertices[mesh->indices[i]];
        box.min.x = p->x < box.min.x ? p->x : box.min.x;
        box.min.y = p->y < box.min.y ? p->y : box.min.y;
        box.min.z = p->z < box.min.z ? p->z : box.min.z;
        box.max.x = p->x > box.max.x ? p->x : box.max.x;
        box.max.y = p->y > box.max.y ? p->y : box.max.y;
        box.max.z = p->z > box.max.z ? p->z : box.max.z;
    }
    return box;
}

// ---------------------------------------------------------------------------------------------------------
// Options of a navmesh.

tl_nav_def tl_js_nav_def(uint32_t at)
{
    tl_nav_def def = tl_default_nav_def();
    float *const floats[] = { &def.cell_size,       &def.cell_height,        &def.agent_height,
                              &def.agent_radius,    &def.agent_max_climb,    &def.agent_max_slope,
                              &def.region_min_size, &def.region_merge_size,  &def.edge_max_len,
                              &def.edge_max_error,  &def.detail_sample_dist, &def.detail_sample_max_error,
                              &def.tile_height };
    for (size_t i = 0; i < sizeof floats / sizeof floats[0]; i++) {
        *floats[i] = tl_js_f32(at++);
    }
    def.max_verts_per_poly = tl_js_u32(at);
    def.tile_size = tl_js_u32(at + 1);
    def.partition = (tl_nav_partition)tl_js_u32(at + 2);
    def.polygon_method = (tl_partition_method)tl_js_u32(at + 3);
    def.filter_low_hanging_obstacles = tl_js_slot[at + 4] != 0.0;
    def.filter_ledge_spans = tl_js_slot[at + 5] != 0.0;
    def.filter_walkable_low_height_spans = tl_js_slot[at + 6] != 0.0;
    def.bounds = tl_js_aabb(at + 7);
    return def;
}

uint32_t tl_js_put_nav_def(uint32_t at, const tl_nav_def *def)
{
    const float floats[] = { def->cell_size,       def->cell_height,        def->agent_height,
                             def->agent_radius,    def->agent_max_climb,    def->agent_max_slope,
                             def->region_min_size, def->region_merge_size,  def->edge_max_len,
                             def->edge_max_error,  def->detail_sample_dist, def->detail_sample_max_error,
                             def->tile_height };
    for (size_t i = 0; i < sizeof floats / sizeof floats[0]; i++) {
        at = tl_js_put(at, (double)floats[i]);
    }
    at = tl_js_put(at, def->max_verts_per_poly);
    at = tl_js_put(at, def->tile_size);
    at = tl_js_put(at, def->partition);
    at = tl_js_put(at, def->polygon_method);
    at = tl_js_put(at, def->filter_low_hanging_obstacles);
    at = tl_js_put(at, def->filter_ledge_spans);
    at = tl_js_put(at, def->filter_walkable_low_height_spans);
    return tl_js_put_aabb(at, def->bounds);
}

void TL_JS_EXPORT(js_default_nav_def)(void)
{
    const tl_nav_def def = tl_default_nav_def();
    tl_js_put_nav_def(0, &def);
}

/// Slot: a def and the level's bounds behind it; then tiles along x and z.
tl_result TL_JS_FULL_EXPORT(js_tile_grid)(uint32_t bounds_at)
{
    const tl_nav_def def = tl_js_nav_def(0);
    uint32_t x, z;
    const tl_result result = tl_nav_tile_grid(&def, tl_js_aabb(bounds_at), &x, &z, &tl_js_report);
    tl_js_put(tl_js_put(0, x), z);
    return result;
}

// ---------------------------------------------------------------------------------------------------------
// Welding, and the built-in levels.

static tl_mesh welded;

/// Of the input. Slot: counts and arrays of the welded mesh, which stand until js_weld_end, and the report.
tl_result TL_JS_FULL_EXPORT(js_weld)(float tolerance, int32_t keep_duplicates)
{
    tl_mesh_def def = tl_default_mesh_def();
    def.weld_tolerance = tolerance;
    def.keep_duplicates = keep_duplicates != 0;
    def.host = *tl_js_host();
    tl_mesh_report report;
    const tl_result result = tl_mesh_bake(&tl_js_input.mesh, &def, &welded, &report);
    tl_js_report = report.base;
    uint32_t at = tl_js_put(tl_js_put(0, welded.vertex_count), welded.triangle_count);
    at = tl_js_put_pointer(at, welded.vertices);
    at = tl_js_put_pointer(at, welded.indices);
    at = tl_js_put_pointer(at, welded.materials);
    at = tl_js_put_pointer(at, welded.source_triangles);
    at = tl_js_put(tl_js_put(at, report.welded_vertices), report.unused_vertices);
    tl_js_put(tl_js_put(at, report.degenerate_triangles), report.duplicate_triangles);
    return result;
}

void TL_JS_FULL_EXPORT(js_weld_end)(void)
{
    tl_mesh_free(&welded);
}

static tl_sample_mesh sample;

/// Slot: name, description, default triangles of level `index`. False: there is none.
int32_t TL_JS_FULL_EXPORT(js_sample_info)(uint32_t index)
{
    uint32_t count;
    const tl_sample_level *levels = tl_sample_levels(&count);
    if (index >= count) {
        return 0;
    }
    uint32_t at = tl_js_put_pointer(0, levels[index].name);
    at = tl_js_put_pointer(at, levels[index].description);
    tl_js_put(at, levels[index].default_triangles);
    return 1;
}

/// Slot: the seed, 64 bits; then counts and arrays, which stand until js_sample_end.
tl_result TL_JS_FULL_EXPORT(js_sample_build)(uint32_t index, uint32_t triangles)
{
    uint32_t count;
    const tl_sample_level *levels = tl_sample_levels(&count);
    if (index >= count) {
        return TL_NOT_FOUND;
    }
    const tl_result result = tl_sample_build_level(&levels[index], triangles, tl_js_u64(0), &sample);
    uint32_t at = tl_js_put(tl_js_put(0, sample.vertex_count), sample.triangle_count);
    tl_js_put_pointer(tl_js_put_pointer(at, sample.vertices), sample.indices);
    return result;
}

void TL_JS_FULL_EXPORT(js_sample_end)(void)
{
    tl_sample_mesh_free(&sample);
}
