// SPDX-License-Identifier: MIT

#include "cli/level/bake_settings.h"

#include "cli/level/polygonize_compare.h"
#include "cli/options/parse_value.h"

#include <string.h>

tl_bake_settings tl_default_bake_settings(void)
{
    tl_bake_settings settings;
    memset(&settings, 0, sizeof(settings));
    settings.level = tl_default_level_settings();
    settings.soup = true;
    settings.nav = true;
    settings.nav_def = tl_default_nav_def();
    settings.links_def = tl_default_nav_links_def();
    settings.partition = (int)settings.nav_def.partition;
    settings.polygon_method = (int)settings.nav_def.polygon_method;
    return settings;
}

tl_nav_def tl_bake_nav_def(const tl_bake_settings *settings)
{
    tl_nav_def def = settings->nav_def;
    def.partition = (tl_nav_partition)settings->partition;
    def.polygon_method = (tl_partition_method)settings->polygon_method;
    return def;
}

void tl_nav_options(tl_bake_settings *settings, tl_option table[TL_NAV_OPTIONS])
{
    static const char *const partitions[] = { "watershed", "monotone", "layers", NULL };
    tl_nav_def *d = &settings->nav_def;
    const float huge = 1e6f;
    const tl_option options[TL_NAV_OPTIONS] = {
        { "cell-size", 0, TL_OPTION_FLOAT, &d->cell_size, "M", "metres: size of a voxel along x and z", NULL, 1e-6f,
          huge, 0, 0 },
        { "cell-height", 0, TL_OPTION_FLOAT, &d->cell_height, "M", "metres: height of a voxel", NULL, 1e-6f, huge, 0,
          0 },
        { "agent-height", 0, TL_OPTION_FLOAT, &d->agent_height, "M", "metres: clear height that an agent needs", NULL,
          1e-6f, huge, 0, 0 },
        { "agent-radius", 0, TL_OPTION_FLOAT, &d->agent_radius, "M", "metres: distance that an agent keeps from walls",
          NULL, 0, huge, 0, 0 },
        { "agent-max-climb", 0, TL_OPTION_FLOAT, &d->agent_max_climb, "M", "metres: highest step that an agent climbs",
          NULL, 0, huge, 0, 0 },
        { "agent-max-slope", 0, TL_OPTION_FLOAT, &d->agent_max_slope, "DEG", "degrees: steepest walkable slope", NULL,
          0, 89.9f, 0, 0 },
        { "partition", 0, TL_OPTION_CHOICE, &settings->partition, NULL, "how floors are divided into regions",
          partitions, 0, 0, 0, 0 },
        { "polygons", 0, TL_OPTION_CHOICE, &settings->polygon_method, NULL, "how contours are divided into polygons",
          tl_partition_method_names, 0, 0, 0, 0 },
        { "tile-size", 0, TL_OPTION_COUNT, &d->tile_size, "CELLS",
          "bake in square tiles of this many cells, on all threads; 0: one tile", NULL, 0, 0, 0, 1u << 20 },
        { "tile-height", 0, TL_OPTION_FLOAT, &d->tile_height, "M",
          "metres: divide floors over one another into layers of this height, each a tile of its own; 0: no layers",
          NULL, 0, huge, 0, 0 },
        { "region-min-size", 0, TL_OPTION_FLOAT, &d->region_min_size, "CELLS",
          "leave out connected components (islands) of fewer cells than its square", NULL, 0, 1e4f, 0, 0 },
        { "region-merge-size", 0, TL_OPTION_FLOAT, &d->region_merge_size, "CELLS",
          "merge regions of fewer cells than its square into neighbours", NULL, 0, 1e4f, 0, 0 },
        { "edge-max-len", 0, TL_OPTION_FLOAT, &d->edge_max_len, "M", "metres: longest edge along a wall; 0: no limit",
          NULL, 0, huge, 0, 0 },
        { "edge-max-error", 0, TL_OPTION_FLOAT, &d->edge_max_error, "CELLS",
          "how far a contour may be simplified (Douglas-Peucker)", NULL, 0, 1e3f, 0, 0 },
        { "max-verts-per-poly", 0, TL_OPTION_COUNT, &d->max_verts_per_poly, "N", "most corners of a polygon", NULL, 0,
          0, 3, 64 },
        { "detail-sample-dist", 0, TL_OPTION_FLOAT, &d->detail_sample_dist, "CELLS",
          "distance between height samples; below 0.9: none", NULL, 0, 1e4f, 0, 0 },
        { "detail-sample-max-error", 0, TL_OPTION_FLOAT, &d->detail_sample_max_error, "VOXELS",
          "largest error of heights, in cell heights", NULL, 0, 1e4f, 0, 0 },
        { "bounds", 0, TL_OPTION_TEXT, &settings->bounds, "X,Y,Z,X,Y,Z",
          "metres: lowest and highest corner of the navmesh (the level's own)", NULL, 0, 0, 0, 0 },
        { "area", 0, TL_OPTION_TEXTS, &settings->areas.words, "NAME=ID",
          "triangles of the material NAME (* and ? are wildcards) get area ID, 0 to 255; 0 is not walkable, 63 is the "
          "default; may be given again",
          NULL, 0, 0, 0, 0 },
        { "areas", 0, TL_OPTION_INPUT, &settings->areas.path, "FILE",
          "lines 'material ID NAME', 'box ID x y z x y z', 'cylinder ID x y z radius height', 'prism ID low high x z x "
          "z x z ...'",
          NULL, 0, 0, 0, 0 },
        { "reachable-from", 0, TL_OPTION_TEXTS, &settings->seeds, "X,Y,Z",
          "a point where agents start: leave out islands without one; may be given again", NULL, 0, 0, 0, 0 },
        { "drop-inside-solids", 0, TL_OPTION_FLAG, &settings->drop_inside, NULL,
          "leave out islands inside closed parts of the level", NULL, 0, 0, 0, 0 },
        { "island-min-area", 0, TL_OPTION_FLOAT, &settings->min_island_area, "M2",
          "square metres: leave out smaller islands, measured over all tiles", NULL, 0, huge, 0, 0 },
        { "link", 0, TL_OPTION_TEXTS, &settings->hand_links.words, "X,Y,Z,X,Y,Z",
          "an off-mesh link from a point to a point, one way (a ladder, a lift, a teleporter); may be given again",
          NULL, 0, 0, 0, 0 },
        { "link-file", 0, TL_OPTION_INPUT, &settings->hand_links.path, "FILE",
          "the same from JSON: {\"links\": [{\"start\": [x,y,z], \"end\": [x,y,z], \"both_ways\": true, "
          "\"radius\": 0.5, \"cost_factor\": 1, \"fixed_cost\": 0, \"area\": 63, \"flags\": 1, \"user\": 0}]}",
          NULL, 0, 0, 0, 0 },
        { "no-filter-low-hanging-obstacles", 0, TL_OPTION_UNFLAG, &d->filter_low_hanging_obstacles, NULL,
          "low obstacles, kerbs and steps, stay obstacles", NULL, 0, 0, 0, 0 },
        { "no-filter-ledge-spans", 0, TL_OPTION_UNFLAG, &d->filter_ledge_spans, NULL, "ledges stay walkable", NULL, 0,
          0, 0, 0 },
        { "no-filter-walkable-low-height-spans", 0, TL_OPTION_UNFLAG, &d->filter_walkable_low_height_spans, NULL,
          "places with too low a ceiling stay walkable", NULL, 0, 0, 0, 0 },
        TL_OPTION_TABLE_END,
    };
    memcpy(table, options, sizeof(options));
}

void tl_part_options(tl_bake_settings *settings, tl_option table[TL_PART_OPTIONS])
{
    static const char *const layouts[] = { "fast", "compact", NULL };
    const tl_option options[TL_PART_OPTIONS] = {
        { "soup-layout", 0, TL_OPTION_CHOICE, &settings->soup_layout, NULL,
          "BVH of the triangles: fast, or compact in half of the memory; the answers are the same", layouts, 0, 0, 0,
          0 },
        { "no-soup", 0, TL_OPTION_UNFLAG, &settings->soup, NULL, "leave out the triangles and their BVH", NULL, 0, 0, 0,
          0 },
        { "no-nav", 0, TL_OPTION_UNFLAG, &settings->nav, NULL, "leave out the navmesh", NULL, 0, 0, 0, 0 },
        { "hull", 0, TL_OPTION_FLAG, &settings->hull, NULL, "add the convex hull of all vertices", NULL, 0, 0, 0, 0 },
        { "links", 0, TL_OPTION_FLAG, &settings->links, NULL, "add drops, jumps and climbs to the navmesh", NULL, 0, 0,
          0, 0 },
        TL_OPTION_TABLE_END,
    };
    memcpy(table, options, sizeof(options));
}

bool tl_bake_take_bounds(tl_cli *cli, tl_bake_settings *settings, tl_exit *exit_out)
{
    if (settings->bounds == NULL) {
        return true;
    }
    float v[6];
    const char *reason = tl_parse_float_list(settings->bounds, v, 6, 6, NULL);
    if (reason == NULL && !(v[0] < v[3] && v[1] < v[4] && v[2] < v[5])) {
        reason = "is empty: give the lowest corner first";
    }
    if (reason != NULL) {
        *exit_out = tl_cli_fail(cli, TL_EXIT_USAGE, "--bounds: '%s' %s", settings->bounds, reason);
        return false;
    }
    settings->nav_def.bounds.min = tl_vec3_make(v[0], v[1], v[2]);
    settings->nav_def.bounds.max = tl_vec3_make(v[3], v[4], v[5]);
    return true;
}
