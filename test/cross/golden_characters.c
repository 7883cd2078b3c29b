// SPDX-License-Identifier: MIT
//
// Characters that walk, jump and fall over the level: where each step ends, and what it met.

#include "golden.h"

#include <string.h>

enum { WALKERS = 48, STEPS = 150 };

static void digest_character(digest *d, const tl_character *c, const tl_character_report *report)
{
    digest_vec3(d, c->position);
    digest_vec3(d, c->velocity);
    digest_vec3(d, c->ground_normal);
    digest_u32(d, c->grounded);
    digest_u32(d, c->ground_triangle);
    digest_u32(d, report->sweeps);
    digest_u32(d, report->hit_count);
    digest_f32(d, report->stepped_up);
}

void golden_characters(const tl_soup *soup)
{
    const tl_aabb box = tl_soup_bounds(soup);
    const tl_character_level place = { .soup = soup };
    const float seconds = 0.015625f;
    dice random = { 11 };
    digest d = digest_begin();
    tl_character_mover *mover;
    MUST(tl_character_mover_create(NULL, &mover, NULL));
    for (uint32_t i = 0; i < WALKERS; i++) {
        tl_character c;
        tl_character_step step;
        memset(&c, 0, sizeof c);
        memset(&step, 0, sizeof step);
        c.position = roll_in_box(&random, box);
        step.seconds = seconds;
        for (uint32_t k = 0; k < STEPS; k++) {
            if (k % 25 == 0) {
                step.velocity.x = roll_between(&random, -6, 6);
                step.velocity.z = roll_between(&random, -6, 6);
            }
            step.leave_ground = k % 40 == 39 && c.grounded != 0;
            step.velocity.y = step.leave_ground ? 5.0f : c.grounded != 0 ? 0.0f : c.velocity.y - 9.8125f * seconds;
            tl_character_report report;
            MUST(tl_character_move(mover, &place, &step, &c, &report));
            digest_character(&d, &c, &report);
        }
        d.found += c.grounded;
    }
    digest_print(&d, "character", "answers");
    tl_character_mover_destroy(mover);
}
