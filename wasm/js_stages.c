// SPDX-License-Identifier: MIT
//
// The stages of one tile's bake, handed to JavaScript as addresses of their arrays, which it copies.

#include "js_mesh.h"

#include <string.h>

static tl_nav_config stage_config;
static tl_nav_stages stages;

static tl_result begin_config(uint32_t tile_x, uint32_t tile_z)
{
    const tl_nav_def def = tl_js_nav_def(0);
    return tl_nav_config_from_def(&def, tl_js_input_bounds(), tile_x, tile_z, &stage_config, &tl_js_report);
}

static uint32_t put_grid(uint32_t width, uint32_t height, tl_aabb bounds)
{
    uint32_t at = tl_js_put(tl_js_put(0, width), height);
    at = tl_js_put_aabb(at, bounds);
    at = tl_js_put(tl_js_put(at, (double)stage_config.cell_size), (double)stage_config.cell_height);
    return tl_js_put(at, stage_config.border_size);
}

/// Slot: a def. The stages stand until js_stages_end.
tl_result TL_JS_FULL_EXPORT(js_stages_bake)(uint32_t tile_x, uint32_t tile_z)
{
    tl_result result = begin_config(tile_x, tile_z);
    if (result != TL_OK) {
        return result;
    }
    tl_nav_tile *tile = NULL;
    tl_nav_bake_report report;
    memset(&report, 0, sizeof report);
    result = tl_nav_tile_bake(&stage_config, &tl_js_input, tl_js_host(), &stages, &tile, &report);
    tl_js_report = report.base;
    tl_blob_free(tile);
    return result;
}

void TL_JS_FULL_EXPORT(js_stages_end)(void)
{
    tl_nav_stages_free(&stages);
}

/// Slot: the grid, then the number of spans, where their columns begin, spans.
void TL_JS_FULL_EXPORT(js_stages_heightfield)(void)
{
    const tl_nav_heightfield *h = &stages.heightfield;
    const uint32_t at = tl_js_put(put_grid(h->width, h->height, h->bounds), h->span_count);
    tl_js_put_pointer(tl_js_put_pointer(at, h->first_span), h->spans);
}

/// Slot: the grid, then counts and arrays.
void TL_JS_FULL_EXPORT(js_stages_compact)(void)
{
    const tl_nav_compact *c = &stages.compact;
    uint32_t at = put_grid(c->width, c->height, c->bounds);
    at = tl_js_put(tl_js_put(tl_js_put(at, c->span_count), c->max_distance), c->region_count);
    at = tl_js_put_pointer(tl_js_put_pointer(at, c->first_span), c->floor);
    at = tl_js_put_pointer(tl_js_put_pointer(at, c->clearance), c->area);
    at = tl_js_put_pointer(tl_js_put_pointer(at, c->distance), c->region);
    tl_js_put_pointer(tl_js_put_pointer(at, c->step), c->neighbour);
}

/// Slot: the origin, cell size and height; counts and arrays of contours and of their vertices.
void TL_JS_FULL_EXPORT(js_stages_contours)(int32_t raw)
{
    const tl_contour_set *s = raw ? &stages.contours.raw : &stages.contours.set;
    uint32_t at = tl_js_put_vec3(0, s->bounds.min);
    at = tl_js_put(tl_js_put(at, (double)s->cell_size), (double)s->cell_height);
    at = tl_js_put(tl_js_put(at, s->contour_count), s->vertex_count);
    tl_js_put_pointer(tl_js_put_pointer(at, s->contours), s->vertices);
}

/// Slot: the origin, cell size and height; counts and arrays.
void TL_JS_FULL_EXPORT(js_stages_polygons)(void)
{
    const tl_polygon_mesh *m = &stages.polygons;
    uint32_t at = tl_js_put_vec3(0, m->bounds.min);
    at = tl_js_put(tl_js_put(at, (double)m->cell_size), (double)m->cell_height);
    at = tl_js_put(tl_js_put(tl_js_put(at, m->polygon_count), m->vertex_count), m->index_count);
    at = tl_js_put_pointer(tl_js_put_pointer(at, m->vertices), m->first);
    at = tl_js_put_pointer(tl_js_put_pointer(at, m->indices), m->neighbours);
    tl_js_put_pointer(tl_js_put_pointer(at, m->regions), m->areas);
}

/// Slot: counts and arrays, the largest error.
void TL_JS_FULL_EXPORT(js_stages_detail)(void)
{
    const tl_nav_detail *d = &stages.detail;
    uint32_t at = tl_js_put(tl_js_put(tl_js_put(0, d->patch_count), d->vertex_count), d->triangle_count);
    at = tl_js_put_pointer(tl_js_put_pointer(at, d->patches), d->vertices);
    tl_js_put(tl_js_put_pointer(at, d->triangles), (double)d->max_error);
}

// ---------------------------------------------------------------------------------------------------------
// Steps of dividing contours. Each is a header of five numbers (kind, contour, counts), then its points, all int32.

static void record_step(const tl_polygon_step *step, void *user)
{
    tl_js_buffer *buffer = user;
    const uint32_t header[] = { step->kind, step->contour, step->partition_count, step->outline_count,
                                step->corner_count };
    tl_js_buffer_add(buffer, header, sizeof header);
    tl_js_buffer_add(buffer, step->partitions, 4 * sizeof(int32_t) * step->partition_count);
    tl_js_buffer_add(buffer, step->outline, 2 * sizeof(int32_t) * step->outline_count);
    tl_js_buffer_add(buffer, step->corners, 2 * sizeof(int32_t) * step->corner_count);
}

/// Divides the contours of js_stages_bake again, all of them or one. Slot: how many numbers there are, and where.
tl_result TL_JS_FULL_EXPORT(js_stages_steps)(int32_t contour)
{
    tl_contour_set set = stages.contours.set;
    if (contour >= 0) {
        if ((uint32_t)contour >= set.contour_count) {
            return TL_NOT_FOUND;
        }
        set.contours += contour;
        set.contour_count = 1;
    }
    tl_js_buffer *buffer = tl_js_buffer_begin();
    const tl_polygon_trace trace = { record_step, buffer };
    tl_polygon_def def = tl_default_polygon_def();
    def.max_verts_per_poly = stage_config.max_verts_per_poly;
    def.method = stage_config.polygon_method;
    def.keep_border_vertices = true;
    def.trace = &trace;
    def.host = *tl_js_host();
    tl_polygon_mesh mesh;
    tl_polygon_report report;
    const tl_result result = tl_polygon_mesh_bake(&set, &def, &mesh, &report);
    tl_js_report = report.base;
    tl_polygon_mesh_free(&mesh);
    tl_js_put_pointer(tl_js_put(0, (double)(buffer->used / sizeof(int32_t))), buffer->bytes);
    return result == TL_OK && buffer->failed ? TL_ERR_MEMORY : result;
}
