// SPDX-License-Identifier: MIT
//
// The walkable ground of a baked file from above, by its height. Tiles come one at a time from the file and are painted
// at once, so a world of any size takes the memory of the picture, the file's index and a tile. The heads of tiles say
// where they lie: those beside the map are not read.

#ifndef TALUS_CLI_GROUND_MAP_H
#define TALUS_CLI_GROUND_MAP_H

#include "cli/level/area_sums.h"
#include "world/job/world_reader.h"

#include <cairo.h>

typedef struct tl_ground_map {
    tl_world_reader *reader;
    const tl_pack_index *index; ///< of its file
    tl_pack_navmesh *settings;
    tl_pack_frame *frame;    ///< NULL: the file's coordinates are the level's
    double low[2], high[2];  ///< what the map shows: metres in the file, x and z
    double pixels_per_metre; ///< after tl_ground_map_paint, as all that follows
    uint32_t width, height;  ///< pixels
    cairo_surface_t *surface;
    cairo_t *cairo;
    uint64_t tiles;    ///< that were painted
    tl_area_sums sums; ///< of them
} tl_ground_map;

/// Reads the settings. `index` is that of the reader's file; both must outlive the map. TL_ERR_CORRUPT (there are none,
/// or they are not sound), TL_ERR_MEMORY, and what reading returns. Close it in any case.
tl_result tl_ground_map_open(tl_world_reader *reader, const tl_pack_index *index, tl_ground_map *map_out,
                             tl_io_error *error_out);
/// Paints what lies between `low` and `high`, `size` pixels along the longer side. TL_ERR_EMPTY (nothing does),
/// TL_ERR_CORRUPT (a tile that is not sound), TL_ERR_CANCELLED, TL_ERR_MEMORY, and what reading returns. `progress` may
/// be NULL.
tl_result tl_ground_map_paint(tl_ground_map *map, uint32_t size, const tl_progress *progress, tl_io_error *error_out);
void tl_ground_map_close(tl_ground_map *map);

/// Where a coordinate of the file stands on the map: pixels along an axis, 0 x, 1 z.
static inline double tl_ground_map_pixel(const tl_ground_map *map, int axis, double at)
{
    return (at - map->low[axis]) * map->pixels_per_metre;
}

/// Room around a map on its sheet, pixels.
enum { TL_GROUND_MARGIN = 20, TL_GROUND_HEAD = 64, TL_GROUND_FOOT = 48 };

#define TL_GROUND_PAPER 0xfafaf7u

/// The sheet that a map lies on: title, `words` under it, the map, clipped, with `over` painted upon it (NULL:
/// nothing), and a scale bar.
void tl_ground_map_show(cairo_t *cairo, const tl_ground_map *map, const char *words,
                        void (*over)(cairo_t *cairo, const void *user), const void *user);

#endif
