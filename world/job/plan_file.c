// SPDX-License-Identifier: MIT

#include "world/job/plan_file.h"

#include "io/files/atomic_write.h"
#include "io/files/file_map.h"
#include "world/bytes/little_endian.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PLAN_HEAD = 24, PLAN_TILE = 32, PLAN_INPUT = 44, PLAN_FIXED = PLAN_HEAD + TL_WORLD_GRID_BYTES + 48 };

static const char plan_again[] = "run 'talus world plan' again";

// ---- The grid ----------------------------------------------------------------------------------------------

enum { GRID_FLOATS = 12 };

static void list_floats(tl_nav_def *def, float *fields[GRID_FLOATS])
{
    float *const all[GRID_FLOATS] = { &def->cell_size,       &def->cell_height,        &def->agent_height,
                                      &def->agent_radius,    &def->agent_max_climb,    &def->agent_max_slope,
                                      &def->region_min_size, &def->region_merge_size,  &def->edge_max_len,
                                      &def->edge_max_error,  &def->detail_sample_dist, &def->detail_sample_max_error };
    memcpy(fields, all, sizeof all);
}

static void encode_grid(const tl_world_grid *grid, unsigned char bytes_out[TL_WORLD_GRID_BYTES])
{
    tl_nav_def def = grid->def;
    float *fields[GRID_FLOATS];
    list_floats(&def, fields);
    memset(bytes_out, 0, TL_WORLD_GRID_BYTES);
    for (int i = 0; i < 3; i++) {
        tl_put_double(bytes_out + 8 * i, grid->origin[i]);
    }
    tl_put_double(bytes_out + 24, grid->cell_size);
    for (int i = 0; i < GRID_FLOATS; i++) {
        tl_put_float(bytes_out + 32 + 4 * i, *fields[i]);
    }
    tl_put_float(bytes_out + 80, def.tile_height);
    const tl_vec3 corners[2] = { def.bounds.min, def.bounds.max };
    for (int i = 0; i < 2; i++) {
        tl_put_float(bytes_out + 84 + 12 * i, corners[i].x);
        tl_put_float(bytes_out + 88 + 12 * i, corners[i].y);
        tl_put_float(bytes_out + 92 + 12 * i, corners[i].z);
    }
    tl_put_u32(bytes_out + 108, def.max_verts_per_poly);
    tl_put_u32(bytes_out + 112, (uint32_t)def.partition);
    tl_put_u32(bytes_out + 116, (uint32_t)def.polygon_method);
    tl_put_u32(bytes_out + 120, def.tile_size);
    tl_put_u32(bytes_out + 124, (def.filter_low_hanging_obstacles ? 1u : 0u) | (def.filter_ledge_spans ? 2u : 0u) |
                                    (def.filter_walkable_low_height_spans ? 4u : 0u));
}

tl_content_hash tl_world_grid_hash(const tl_world_grid *grid)
{
    unsigned char bytes[TL_WORLD_GRID_BYTES + 64];
    memset(bytes, 0, sizeof bytes);
    encode_grid(grid, bytes);
    tl_put_u32(bytes + TL_WORLD_GRID_BYTES, TL_WORLD_STORE_VERSION);
    tl_put_u32(bytes + TL_WORLD_GRID_BYTES + 4, TL_WORLD_PLAN_VERSION);
    tl_put_u32(bytes + TL_WORLD_GRID_BYTES + 8, TL_NAV_TILE_VERSION);
    const char *version = tl_version();
    const size_t length = strlen(version);
    memcpy(bytes + TL_WORLD_GRID_BYTES + 12, version, length < 48 ? length : 48);
    return tl_content_hash_of(bytes, sizeof bytes);
}

static tl_result decode_grid(const unsigned char *bytes, tl_world_grid *grid, tl_report *report)
{
    double origin[3];
    tl_nav_def def = tl_default_nav_def();
    float *fields[GRID_FLOATS];
    list_floats(&def, fields);
    for (int i = 0; i < 3; i++) {
        origin[i] = tl_get_double(bytes + 8 * i);
    }
    for (int i = 0; i < GRID_FLOATS; i++) {
        *fields[i] = tl_get_float(bytes + 32 + 4 * i);
    }
    def.tile_height = tl_get_float(bytes + 80);
    def.bounds.min = tl_vec3_make(tl_get_float(bytes + 84), tl_get_float(bytes + 88), tl_get_float(bytes + 92));
    def.bounds.max = tl_vec3_make(tl_get_float(bytes + 96), tl_get_float(bytes + 100), tl_get_float(bytes + 104));
    def.max_verts_per_poly = tl_get_u32(bytes + 108);
    def.partition = (tl_nav_partition)tl_get_u32(bytes + 112);
    def.polygon_method = (tl_partition_method)tl_get_u32(bytes + 116);
    def.tile_size = tl_get_u32(bytes + 120);
    const uint32_t filters = tl_get_u32(bytes + 124);
    def.filter_low_hanging_obstacles = (filters & 1u) != 0;
    def.filter_ledge_spans = (filters & 2u) != 0;
    def.filter_walkable_low_height_spans = (filters & 4u) != 0;
    if (def.tile_size == 0) {
        return TL_ERR_CORRUPT;
    }
    return tl_world_grid_make(&def, origin, tl_get_double(bytes + 24), grid, report);
}

// ---- Writing -----------------------------------------------------------------------------------------------

static size_t plan_size(const tl_world_plan *plan)
{
    size_t size = PLAN_FIXED + 4 + strlen(plan->name) + 4 + 8 + (size_t)plan->tile_count * PLAN_TILE + 8;
    for (uint32_t i = 0; i < plan->input_count; i++) {
        size += 4 + strlen(plan->inputs[i].path) + PLAN_INPUT;
    }
    return size;
}

static unsigned char *put_plan_text(unsigned char *at, const char *text)
{
    const size_t length = strlen(text);
    tl_put_u32(at, (uint32_t)length);
    memcpy(at + 4, text, length);
    return at + 4 + length;
}

static unsigned char *put_inputs(const tl_world_plan *plan, unsigned char *at)
{
    tl_put_u32(at, plan->input_count);
    at += 4;
    for (uint32_t i = 0; i < plan->input_count; i++) {
        const tl_world_stored *input = &plan->inputs[i];
        at = put_plan_text(at, input->path);
        tl_put_u64(at, input->facts.size);
        tl_put_u64(at + 8, input->facts.changed);
        tl_put_u64(at + 16, input->name.low);
        tl_put_u64(at + 24, input->name.high);
        tl_put_u32(at + 32, input->segments);
        tl_put_u64(at + 36, input->triangles);
        at += PLAN_INPUT;
    }
    return at;
}

static void encode_plan(const tl_world_plan *plan, unsigned char *bytes, size_t size)
{
    memset(bytes, 0, size);
    memcpy(bytes, TL_WORLD_PLAN_MAGIC, 8);
    tl_put_u32(bytes + 8, TL_WORLD_PLAN_VERSION);
    tl_put_u64(bytes + 16, size);
    encode_grid(&plan->grid, bytes + PLAN_HEAD);
    unsigned char *at = bytes + PLAN_HEAD + TL_WORLD_GRID_BYTES;
    tl_put_u64(at, plan->vertices);
    tl_put_u64(at + 8, plan->triangles);
    tl_put_u64(at + 16, plan->degenerate);
    const float bounds[6] = { plan->bounds.min.x, plan->bounds.min.y, plan->bounds.min.z,
                              plan->bounds.max.x, plan->bounds.max.y, plan->bounds.max.z };
    for (int i = 0; i < 6; i++) {
        tl_put_float(at + 24 + 4 * i, bounds[i]);
    }
    at = put_inputs(plan, put_plan_text(at + 48, plan->name));
    tl_put_u64(at, plan->tile_count);
    at += 8;
    for (uint64_t i = 0; i < plan->tile_count; i++, at += PLAN_TILE) {
        const tl_world_tile *tile = &plan->tiles[i];
        tl_put_u32(at, tile->x);
        tl_put_u32(at + 4, tile->z);
        tl_put_u32(at + 8, tile->triangles);
        tl_put_u32(at + 12, tile->cost);
        tl_put_u64(at + 16, tile->key.low);
        tl_put_u64(at + 24, tile->key.high);
    }
    tl_put_u64(at, tl_content_checksum(bytes, size - 8));
}

tl_result tl_world_plan_write(const tl_world_plan *plan, const char *path, tl_io_error *error_out)
{
    const size_t size = plan_size(plan);
    unsigned char *bytes = malloc(size);
    if (bytes == NULL) {
        return tl_io_fail(error_out, TL_ERR_MEMORY, path, 0, "", "out of memory");
    }
    encode_plan(plan, bytes, size);
    const tl_result result = tl_atomic_write(path, bytes, size, error_out);
    free(bytes);
    return result;
}

// ---- Reading -----------------------------------------------------------------------------------------------

typedef struct plan_cursor {
    const unsigned char *at, *end;
} plan_cursor;

static bool has_bytes(const plan_cursor *cursor, uint64_t size)
{
    return size <= (uint64_t)(cursor->end - cursor->at);
}

// A copy with a zero behind it; NULL: it is not there, or memory is out.
static char *take_plan_text(plan_cursor *cursor)
{
    if (!has_bytes(cursor, 4) || !has_bytes(cursor, 4 + (uint64_t)tl_get_u32(cursor->at))) {
        return NULL;
    }
    const size_t length = tl_get_u32(cursor->at);
    char *text = malloc(length + 1);
    if (text != NULL) {
        memcpy(text, cursor->at + 4, length);
        text[length] = '\0';
        cursor->at += 4 + length;
    }
    return text;
}

static bool take_inputs_of_plan(plan_cursor *cursor, tl_world_plan *plan)
{
    const uint32_t count = has_bytes(cursor, 4) ? tl_get_u32(cursor->at) : UINT32_MAX;
    if (!has_bytes(cursor, 4 + (uint64_t)count * (4 + PLAN_INPUT))) {
        return false;
    }
    cursor->at += 4;
    plan->inputs = calloc((size_t)count + 1, sizeof *plan->inputs);
    for (uint32_t i = 0; i < count && plan->inputs != NULL; i++) {
        tl_world_stored *input = &plan->inputs[i];
        input->path = take_plan_text(cursor);
        plan->input_count = i + 1;
        if (input->path == NULL || !has_bytes(cursor, PLAN_INPUT)) {
            return false;
        }
        input->facts.size = tl_get_u64(cursor->at);
        input->facts.changed = tl_get_u64(cursor->at + 8);
        input->name.low = tl_get_u64(cursor->at + 16);
        input->name.high = tl_get_u64(cursor->at + 24);
        input->segments = tl_get_u32(cursor->at + 32);
        input->triangles = tl_get_u64(cursor->at + 36);
        cursor->at += PLAN_INPUT;
    }
    return plan->inputs != NULL;
}

static bool take_tiles(plan_cursor *cursor, tl_world_plan *plan)
{
    const uint64_t count = has_bytes(cursor, 8) ? tl_get_u64(cursor->at) : UINT64_MAX;
    if (count > SIZE_MAX / 64 || count * PLAN_TILE + 8 != (uint64_t)(cursor->end - cursor->at)) {
        return false;
    }
    cursor->at += 8;
    plan->tiles = malloc((size_t)count * sizeof *plan->tiles + 1);
    const tl_world_tile *before = NULL;
    for (uint64_t i = 0; i < count && plan->tiles != NULL; i++, cursor->at += PLAN_TILE) {
        tl_world_tile *tile = &plan->tiles[i];
        tile->x = tl_get_u32(cursor->at);
        tile->z = tl_get_u32(cursor->at + 4);
        tile->triangles = tl_get_u32(cursor->at + 8);
        tile->cost = tl_get_u32(cursor->at + 12);
        tile->key.low = tl_get_u64(cursor->at + 16);
        tile->key.high = tl_get_u64(cursor->at + 24);
        if (tile->x >= plan->grid.tiles_x || tile->z >= plan->grid.tiles_z ||
            (before != NULL && (tile->z < before->z || (tile->z == before->z && tile->x <= before->x)))) {
            return false;
        }
        before = tile;
    }
    plan->tile_count = count;
    return plan->tiles != NULL;
}

tl_result tl_world_plan_decode(const unsigned char *bytes, size_t size, const char *path, tl_world_plan *plan_out,
                               tl_io_error *error_out)
{
    memset(plan_out, 0, sizeof *plan_out);
    if (size < 12 || memcmp(bytes, TL_WORLD_PLAN_MAGIC, 8) != 0) {
        return tl_io_fail(error_out, TL_ERR_MAGIC, path, 0, plan_again, "is no plan of a world");
    }
    if (tl_get_u32(bytes + 8) != TL_WORLD_PLAN_VERSION) {
        return tl_io_fail(error_out, TL_ERR_VERSION, path, 0, plan_again, "was written by another version");
    }
    if (size < PLAN_FIXED + 8 || size < tl_get_u64(bytes + 16)) {
        return tl_io_fail(error_out, TL_ERR_TRUNCATED, path, 0, plan_again, "is shorter than it says");
    }
    if (tl_content_checksum(bytes, size - 8) != tl_get_u64(bytes + size - 8)) {
        return tl_io_fail(error_out, TL_ERR_HASH, path, 0, plan_again, "was altered");
    }
    plan_cursor cursor = { bytes + PLAN_FIXED, bytes + size - 8 };
    const unsigned char *at = bytes + PLAN_HEAD + TL_WORLD_GRID_BYTES;
    plan_out->vertices = tl_get_u64(at);
    plan_out->triangles = tl_get_u64(at + 8);
    plan_out->degenerate = tl_get_u64(at + 16);
    plan_out->bounds.min = tl_vec3_make(tl_get_float(at + 24), tl_get_float(at + 28), tl_get_float(at + 32));
    plan_out->bounds.max = tl_vec3_make(tl_get_float(at + 36), tl_get_float(at + 40), tl_get_float(at + 44));
    if (decode_grid(bytes + PLAN_HEAD, &plan_out->grid, NULL) != TL_OK ||
        (plan_out->name = take_plan_text(&cursor)) == NULL || !take_inputs_of_plan(&cursor, plan_out) ||
        !take_tiles(&cursor, plan_out)) {
        return tl_io_fail(error_out, TL_ERR_CORRUPT, path, 0, plan_again, "contradicts itself");
    }
    return TL_OK;
}

tl_result tl_world_plan_read(const char *path, tl_world_plan *plan_out, tl_io_error *error_out)
{
    tl_file_map map;
    memset(plan_out, 0, sizeof *plan_out);
    tl_result result = tl_file_read(path, 0, &map, error_out);
    if (result == TL_OK) {
        result = tl_world_plan_decode(map.bytes, map.size, path, plan_out, error_out);
        tl_file_map_close(&map);
    }
    return result;
}

void tl_world_plan_free(tl_world_plan *plan)
{
    for (uint32_t i = 0; i < plan->input_count; i++) {
        free(plan->inputs[i].path);
    }
    free(plan->inputs);
    free(plan->tiles);
    free(plan->name);
    memset(plan, 0, sizeof *plan);
}

tl_content_hash tl_world_tile_key(tl_content_hash settings, const tl_world_tile *tile, tl_content_hash sum)
{
    unsigned char bytes[48];
    memset(bytes, 0, sizeof bytes);
    tl_put_u64(bytes, settings.low);
    tl_put_u64(bytes + 8, settings.high);
    tl_put_u64(bytes + 16, sum.low);
    tl_put_u64(bytes + 24, sum.high);
    tl_put_u32(bytes + 32, tile->x);
    tl_put_u32(bytes + 36, tile->z);
    tl_put_u32(bytes + 40, tile->triangles);
    return tl_content_hash_of(bytes, sizeof bytes);
}

uint64_t tl_world_plan_find(const tl_world_plan *plan, uint32_t x, uint32_t z)
{
    uint64_t low = 0, high = plan->tile_count;
    while (low < high) {
        const uint64_t middle = low + (high - low) / 2;
        const tl_world_tile *tile = &plan->tiles[middle];
        if (tile->z < z || (tile->z == z && tile->x < x)) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

char *tl_world_job_path(const char *job, const char *part)
{
    const size_t size = strlen(job) + strlen(part) + 2;
    char *path = malloc(size);
    if (path != NULL) {
        snprintf(path, size, "%s/%s", job, part);
    }
    return path;
}

char *tl_world_tile_path(const char *job, tl_content_hash key)
{
    char text[TL_CONTENT_TEXT_BYTES];
    tl_content_hash_text(key, text);
    const size_t size = strlen(job) + sizeof text + 20;
    char *path = malloc(size);
    if (path != NULL) {
        snprintf(path, size, "%s/tiles/%.2s/%s.tile", job, text, text);
    }
    return path;
}
