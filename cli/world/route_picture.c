// SPDX-License-Identifier: MIT

#include "cli/world/route_picture.h"

#include "cli/draw/draw_paper.h"
#include "cli/world/ground_map.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Pixels between dots.
#define LEAST_GATE  10.0

#define ROUTE_WAY   0xd1345bu
#define ROUTE_START 0x2a6fdbu

typedef struct route_sheet {
    const tl_route_picture *picture;
    tl_ground_map map;
    double (*way)[2]; // [point_count], x and z in the file
} route_sheet;

// The box of the route, and a tenth more all around, or a tile.
static tl_result lay_out_route(route_sheet *sheet, tl_io_error *error_out)
{
    const tl_route_picture *picture = sheet->picture;
    tl_ground_map *map = &sheet->map;
    const uint32_t count = picture->route->point_count;
    sheet->way = malloc(count * sizeof *sheet->way + 1);
    if (sheet->way == NULL) {
        return tl_io_fail(error_out, TL_ERR_MEMORY, picture->reader->path, 0, "", "out of memory for the picture");
    }
    for (uint32_t i = 0; i < count; i++) {
        const double *p = picture->points[i].point;
        const tl_vec3 at =
            map->frame != NULL ? tl_pack_place_in(map->frame, p) : tl_vec3_make((float)p[0], (float)p[1], (float)p[2]);
        sheet->way[i][0] = (double)at.x;
        sheet->way[i][1] = (double)at.z;
        for (int k = 0; k < 2; k++) {
            map->low[k] = i == 0 || sheet->way[i][k] < map->low[k] ? sheet->way[i][k] : map->low[k];
            map->high[k] = i == 0 || sheet->way[i][k] > map->high[k] ? sheet->way[i][k] : map->high[k];
        }
    }
    const double longest = fmax(map->high[0] - map->low[0], map->high[1] - map->low[1]);
    const double tile = (double)map->settings->tile_size * (double)map->settings->cell_size;
    const double more = fmax(0.1 * longest, tile > 0.0 ? tile : 10.0);
    for (int k = 0; k < 2; k++) {
        map->low[k] -= more;
        map->high[k] += more;
    }
    return TL_OK;
}

static void trace_way(cairo_t *cairo, const route_sheet *sheet)
{
    for (uint32_t i = 0; i < sheet->picture->route->point_count; i++) {
        cairo_line_to(cairo, tl_ground_map_pixel(&sheet->map, 0, sheet->way[i][0]),
                      tl_ground_map_pixel(&sheet->map, 1, sheet->way[i][1]));
    }
}

static void paint_dot(cairo_t *cairo, const route_sheet *sheet, uint32_t point, double radius, draw_colour colour)
{
    cairo_arc(cairo, tl_ground_map_pixel(&sheet->map, 0, sheet->way[point][0]),
              tl_ground_map_pixel(&sheet->map, 1, sheet->way[point][1]), radius, 0.0, 6.2831853);
    draw_set_colour(cairo, colour, 1.0);
    cairo_fill_preserve(cairo);
    draw_set_colour(cairo, TL_GROUND_PAPER, 1.0);
    cairo_set_line_width(cairo, 1.5);
    cairo_stroke(cairo);
}

static void paint_way(cairo_t *cairo, const void *user)
{
    const route_sheet *sheet = user;
    const uint32_t last = sheet->picture->route->point_count - 1;
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    trace_way(cairo, sheet);
    draw_set_colour(cairo, TL_GROUND_PAPER, 0.9);
    cairo_set_line_width(cairo, 5.5);
    cairo_stroke_preserve(cairo);
    draw_set_colour(cairo, ROUTE_WAY, 1.0);
    cairo_set_line_width(cairo, 2.5);
    cairo_stroke(cairo);
    double shown = -1e9; // metres along the route
    for (uint32_t i = 1; i < last; i++) {
        if ((sheet->picture->points[i].length - shown) * sheet->map.pixels_per_metre >= LEAST_GATE) {
            paint_dot(cairo, sheet, i, 2.5, ROUTE_WAY);
            shown = sheet->picture->points[i].length;
        }
    }
    paint_dot(cairo, sheet, 0, 6.0, ROUTE_START);
    paint_dot(cairo, sheet, last, 6.0, ROUTE_WAY);
}

static void paint_route_sheet(cairo_t *cairo, const void *user)
{
    const route_sheet *sheet = user;
    const tl_nav_world_route *route = sheet->picture->route;
    char words[160];
    snprintf(words, sizeof words, "a route of %.1f m, and no path is shorter than %.1f m; dots are gates",
             route->length, route->lower_bound);
    tl_ground_map_show(cairo, &sheet->map, words, paint_way, sheet);
}

tl_result tl_draw_world_route(const tl_route_picture *picture, tl_io_error *error_out)
{
    route_sheet sheet;
    memset(&sheet, 0, sizeof sheet);
    memset(error_out, 0, sizeof *error_out);
    sheet.picture = picture;
    tl_result result = tl_ground_map_open(picture->reader, picture->index, &sheet.map, error_out);
    if (result == TL_OK) {
        result = lay_out_route(&sheet, error_out);
    }
    if (result == TL_OK) {
        result = tl_ground_map_paint(&sheet.map, picture->size, NULL, error_out);
    }
    if (result == TL_OK) {
        result =
            draw_paper_write(picture->output, sheet.map.width + 2 * TL_GROUND_MARGIN,
                             sheet.map.height + TL_GROUND_HEAD + TL_GROUND_FOOT, paint_route_sheet, &sheet, error_out);
    }
    free(sheet.way);
    tl_ground_map_close(&sheet.map);
    return result;
}
