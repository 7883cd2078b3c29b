// SPDX-License-Identifier: MIT
//
// The triangles whose own boxes touch a box.

#include "base/assert.h"
#include "soup/query/region_walk.h"

typedef struct box_search {
    const tl_soup *soup;
    tl_aabb box;
    tl_soup_triangle_fn *found;
    void *user;
} box_search;

static bool belongs_to_box(const tl_walk_triangle *triangle, void *user)
{
    const box_search *search = user;
    return tl_aabb_overlaps(tl_walk_triangle_box(triangle), search->box);
}

static bool report_triangle(const tl_walk_triangle *triangle, void *user)
{
    const box_search *search = user;
    tl_soup_triangle found = { { triangle->corners[0], triangle->corners[1], triangle->corners[2] },
                               triangle->triangle,
                               tl_soup_material(search->soup, triangle->triangle) };
    return search->found(&found, search->user);
}

bool tl_soup_triangles_in_box(const tl_soup *soup, tl_aabb box, tl_soup_triangle_fn *found, void *user)
{
    TL_ASSERT(soup != NULL && found != NULL);
    box_search search = { soup, box, found, user };
    tl_region region = { tl_region_enter_box, &search.box, belongs_to_box, report_triangle, &search };
    return tl_region_walk(soup, &region);
}
