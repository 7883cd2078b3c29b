// SPDX-License-Identifier: MIT
//
// Making a mover: what its def says, checked, and the scratch of its moves.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "character/mover.h"
#include "math/cos_degrees.h"

#include <string.h>

#define MIN_ITEMS      16u
#define MAX_ITEMS      0x0fffffffu
#define MAX_WALK_ANGLE 85.0f

tl_character_def tl_default_character_def(void)
{
    tl_character_def def;
    memset(&def, 0, sizeof def);
    def.radius = 0.3f;
    def.height = 1.8f;
    def.step_height = 0.4f;
    def.max_slope = 45.0f;
    def.gap = 0.002f;
    def.max_triangles = 1024;
    def.cookie = TL_DEF_COOKIE;
    return def;
}

static tl_result refuse(tl_report *report, const char *field, const char *advice)
{
    return tl_report_field(report, TL_ERR_ARGUMENT, field, advice);
}

static tl_result check_character_def(const tl_character_def *def, tl_report *report)
{
    TL_TRY(tl_def_check(def->cookie, "begin with tl_default_character_def()", report));
    if (!(def->radius > 0.0f && def->radius <= TL_MAX_CHARACTER_MOTION)) {
        return refuse(report, "radius", "make it > 0 and at most TL_MAX_CHARACTER_MOTION");
    }
    if (!(def->height >= 2.0f * def->radius && def->height <= TL_MAX_CHARACTER_MOTION)) {
        return refuse(report, "height", "make it twice the radius at least, and at most TL_MAX_CHARACTER_MOTION");
    }
    if (!(def->step_height >= 0.0f && def->step_height <= def->height)) {
        return refuse(report, "step_height", "make it >= 0 and at most the height");
    }
    if (!(def->max_slope >= 0.0f && def->max_slope <= MAX_WALK_ANGLE)) {
        return refuse(report, "max_slope", "make it 0 to 85 degrees");
    }
    if (!(def->gap > 0.0f && def->gap <= 0.25f * def->radius)) {
        return refuse(report, "gap", "make it > 0 and at most a quarter of the radius");
    }
    if (def->max_triangles < MIN_ITEMS || def->max_triangles > MAX_ITEMS) {
        return refuse(report, "max_triangles", "make it 16 to 2^28 - 1");
    }
    return TL_OK;
}

tl_result tl_character_mover_create(const tl_character_def *def, tl_character_mover **mover_out, tl_report *report)
{
    const tl_character_def used = def != NULL ? *def : tl_default_character_def();
    tl_report_begin(report, "character");
    TL_REFUSE_NULL(mover_out, report);
    *mover_out = NULL;
    TL_TRY(check_character_def(&used, report));
    tl_allocator allocator = tl_allocator_or_default(used.allocator);
    tl_character_mover *m = (tl_character_mover *)tl_allocate_array(&allocator, 1, sizeof *m);
    if (m == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(m, 0, sizeof *m);
    m->def = used;
    m->allocator = allocator;
    m->radius = (double)used.radius;
    m->core_length = (double)used.height - 2.0 * (double)used.radius;
    m->step_height = (double)used.step_height;
    m->cos_slope = (double)tl_cos_degrees(used.max_slope);
    m->tan_slope = sqrt(1.0 - m->cos_slope * m->cos_slope) / m->cos_slope;
    m->items = (tl_mover_item *)tl_allocate_array(&allocator, used.max_triangles, sizeof *m->items);
    m->contacts = (tl_mover_contact *)tl_allocate_array(&allocator, used.max_triangles, sizeof *m->contacts);
    const uint64_t box_numbers = TL_MOVER_BOX_ARRAYS * tl_mover_box_room(used.max_triangles);
    m->box_numbers = (float *)tl_allocate_array(&allocator, box_numbers, sizeof *m->box_numbers);
    if (m->items == NULL || m->contacts == NULL || m->box_numbers == NULL) {
        tl_character_mover_destroy(m);
        return TL_ERR_MEMORY;
    }
    memset(m->box_numbers, 0, (size_t)box_numbers * sizeof *m->box_numbers);
    float **arrays[TL_MOVER_BOX_ARRAYS] = { &m->boxes.low_x,  &m->boxes.low_y,  &m->boxes.low_z,  &m->boxes.high_x,
                                            &m->boxes.high_y, &m->boxes.high_z, &m->boxes.away_sq };
    for (size_t i = 0; i < TL_MOVER_BOX_ARRAYS; i++) {
        *arrays[i] = m->box_numbers + i * (size_t)tl_mover_box_room(used.max_triangles);
    }
    *mover_out = m;
    return TL_OK;
}

void tl_character_mover_destroy(tl_character_mover *mover)
{
    if (mover != NULL) {
        const tl_allocator allocator = mover->allocator;
        tl_release_array(&allocator, mover->items, mover->def.max_triangles, sizeof *mover->items);
        tl_release_array(&allocator, mover->box_numbers,
                         TL_MOVER_BOX_ARRAYS * tl_mover_box_room(mover->def.max_triangles), sizeof *mover->box_numbers);
        tl_release_array(&allocator, mover->contacts, mover->def.max_triangles, sizeof *mover->contacts);
        tl_release_array(&allocator, mover, 1, sizeof *mover);
    }
}
