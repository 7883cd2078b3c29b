// SPDX-License-Identifier: MIT
//
// Voxel stages: solid spans as blocks, open floors as squares coloured by area, distance or region.

#include "cli/draw/draw_stage.h"

#include <stdio.h>

static const draw_colour CLOSED = 0xb9a89c;
static const draw_colour SOLID = 0xcfc8bb;

typedef struct column_lattice {
    tl_vec3 origin;
    float cell_size, cell_height;
} column_lattice;

static tl_vec3 lattice_point(const column_lattice *grid, uint32_t x, float y, uint32_t z)
{
    return tl_vec3_make(grid->origin.x + (float)x * grid->cell_size, grid->origin.y + y * grid->cell_height,
                        grid->origin.z + (float)z * grid->cell_size);
}

static void add_square(draw_scene *scene, const column_lattice *grid, uint32_t x, float y, uint32_t z,
                       draw_colour colour)
{
    draw_add_quad(scene, lattice_point(grid, x, y, z), lattice_point(grid, x, y, z + 1),
                  lattice_point(grid, x + 1, y, z + 1), lattice_point(grid, x + 1, y, z), colour);
}

// The side of a block towards direction d, from height `low` to `high`.
static void add_side(draw_scene *scene, const column_lattice *grid, uint32_t x, uint32_t z, uint32_t d, float low,
                     float high)
{
    // The edge of the cell on that side, as offsets of its two ends.
    static const uint8_t ends[4][4] = { { 0, 0, 0, 1 }, { 0, 1, 1, 1 }, { 1, 1, 1, 0 }, { 1, 0, 0, 0 } };
    const uint8_t *end = ends[d];
    draw_add_quad(scene, lattice_point(grid, x + end[0], low, z + end[1]),
                  lattice_point(grid, x + end[2], low, z + end[3]), lattice_point(grid, x + end[2], high, z + end[3]),
                  lattice_point(grid, x + end[0], high, z + end[1]), SOLID);
}

// Sides are drawn only where the neighbour column is open: its spans are cut out of [min, max].
static void add_open_sides(draw_scene *scene, const tl_nav_heightfield *field, const column_lattice *grid, uint32_t x,
                           uint32_t z, const tl_nav_span *span)
{
    static const int step[4][2] = { { -1, 0 }, { 0, 1 }, { 1, 0 }, { 0, -1 } };
    for (uint32_t d = 0; d < 4; d++) {
        int64_t nx = (int64_t)x + step[d][0];
        int64_t nz = (int64_t)z + step[d][1];
        uint32_t low = span->min;
        if (nx >= 0 && nz >= 0 && nx < field->width && nz < field->height) {
            size_t column = (size_t)nz * field->width + (size_t)nx;
            for (uint32_t i = field->first_span[column]; i < field->first_span[column + 1]; i++) {
                const tl_nav_span *beside = &field->spans[i];
                if (beside->max <= low || beside->min >= span->max) {
                    continue;
                }
                if (beside->min > low) {
                    add_side(scene, grid, x, z, d, (float)low, (float)beside->min);
                }
                low = beside->max;
            }
        }
        if (low < span->max) {
            add_side(scene, grid, x, z, d, (float)low, (float)span->max);
        }
    }
}

void draw_stage_spans(draw_scene *scene, const tl_nav_heightfield *field)
{
    const column_lattice grid = { field->bounds.min, field->cell_size, field->cell_height };
    scene->overlay_alpha = 1.0f;
    uint32_t walkable = 0;
    bool used[TL_NAV_MAX_AREA + 1] = { false };
    for (uint32_t z = 0; z < field->height; z++) {
        for (uint32_t x = 0; x < field->width; x++) {
            size_t column = (size_t)z * field->width + x;
            for (uint32_t i = field->first_span[column]; i < field->first_span[column + 1]; i++) {
                const tl_nav_span *span = &field->spans[i];
                bool floor = span->area != TL_NAV_NULL_AREA;
                walkable += floor;
                add_square(scene, &grid, x, (float)span->max, z,
                           floor ? draw_colour_of_area((uint8_t)span->area, 0) : SOLID);
                used[span->area] = true;
                add_open_sides(scene, field, &grid, x, z, span);
            }
        }
    }
    snprintf(scene->subtitle, sizeof scene->subtitle,
             "%u x %u columns of %g m, %u solid spans, %u of them walkable on top", field->width, field->height,
             (double)field->cell_size, field->span_count, walkable);
    draw_add_legend(scene, SOLID, "solid");
    draw_add_area_legends(scene, used);
}

static draw_colour floor_colour(const tl_nav_compact *compact, uint32_t span, draw_floor_colour kind)
{
    uint8_t area = compact->area[span];
    if (area == TL_NAV_NULL_AREA) {
        return CLOSED;
    }
    if (kind == DRAW_FLOOR_DISTANCE && compact->distance != NULL) {
        float t = compact->max_distance > 0 ? (float)compact->distance[span] / (float)compact->max_distance : 0.0f;
        return t < 0.5f ? draw_colour_mix(0x27346b, 0x3aa6a0, 2.0f * t)
                        : draw_colour_mix(0x3aa6a0, 0xf6e27a, 2.0f * t - 1.0f);
    }
    if (kind == DRAW_FLOOR_REGION && compact->region != NULL) {
        return (compact->region[span] & TL_NAV_BORDER_REGION) != 0 ? 0x606060
                                                                   : draw_colour_of_id(compact->region[span]);
    }
    return draw_colour_of_area(area, 0);
}

static void name_floors(draw_scene *scene, const tl_nav_compact *compact, draw_floor_colour kind)
{
    char *text = scene->subtitle;
    size_t size = sizeof scene->subtitle;
    if (kind == DRAW_FLOOR_AREA) {
        bool used[TL_NAV_MAX_AREA + 1] = { false };
        uint32_t walkable = 0;
        for (uint32_t i = 0; i < compact->span_count; i++) {
            used[compact->area[i]] = true;
            walkable += compact->area[i] != TL_NAV_NULL_AREA;
        }
        snprintf(text, size, "%u open floors, %u of them walkable after erosion by the agent's radius",
                 compact->span_count, walkable);
        draw_add_legend(scene, CLOSED, "not walkable: steep, too low, at a ledge, or too near a wall");
        draw_add_area_legends(scene, used);
    } else if (kind == DRAW_FLOOR_DISTANCE) {
        snprintf(text, size, "distance of each floor to the nearest wall or ledge, at most %.1f m",
                 0.5 * (double)compact->max_distance * (double)compact->cell_size);
        draw_add_legend(scene, 0x27346b, "at the border");
        draw_add_legend(scene, 0x3aa6a0, "half way");
        draw_add_legend(scene, 0xf6e27a, "farthest");
    } else {
        snprintf(text, size, "%u regions, each simple and without overlap",
                 compact->region_count > 0 ? compact->region_count - 1 : 0);
        draw_add_legend(scene, draw_colour_of_id(1), "a region each colour");
        draw_add_legend(scene, 0x9a9a9a, "no region: too small");
        draw_add_legend(scene, CLOSED, "not walkable");
    }
}

void draw_stage_floors(draw_scene *scene, const tl_nav_compact *compact, draw_floor_colour kind)
{
    const column_lattice grid = { compact->bounds.min, compact->cell_size, compact->cell_height };
    for (uint32_t z = 0; z < compact->height; z++) {
        for (uint32_t x = 0; x < compact->width; x++) {
            size_t column = (size_t)z * compact->width + x;
            for (uint32_t i = compact->first_span[column]; i < compact->first_span[column + 1]; i++) {
                add_square(scene, &grid, x, (float)compact->floor[i], z, floor_colour(compact, i, kind));
            }
        }
    }
    name_floors(scene, compact, kind);
}
