// SPDX-License-Identifier: MIT
//
// The triangles whose own boxes touch a box.

#include "base/assert.h"
#include "soup/query/region_walk.h"

typedef struct box_search {
    const tl_soup *soup;
    tl_soup_triangle_fn *found;
    void *user;
} box_search;

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
    box_search search = { soup, found, user };
    tl_region region = { .box = &box, .found = report_triangle, .user = &search };
    return tl_region_walk(soup, &region);
}
