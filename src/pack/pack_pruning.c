// SPDX-License-Identifier: MIT
//
// The PRUN chunk: the rules by which islands were left out of a navmesh, so that an audit does not miss them and "why"
// can name the rule.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "pack/pack_format.h"

#include <math.h>
#include <string.h>

_Static_assert(sizeof(tl_pack_pruning) == 64, "no hidden padding");

static bool is_sound_pruning(const tl_pack_pruning *pruning)
{
    const tl_vec3 e = pruning->seed_extents;
    return pruning->min_area >= 0.0 && isfinite(pruning->min_area) && pruning->drop_inside_solids <= 1 &&
           tl_is_finite(e) && e.x >= 0.0f && e.y >= 0.0f && e.z >= 0.0f;
}

tl_result tl_pack_pruning_encode(const tl_nav_prune_def *def, const tl_allocator *allocator,
                                 tl_pack_pruning **pruning_out, tl_report *report_out)
{
    const tl_nav_prune_def default_def = tl_default_nav_prune_def();
    tl_report_begin(report_out, "encode pruning");
    if (pruning_out == NULL) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "pruning_out", "it may not be NULL");
    }
    *pruning_out = NULL;
    def = def != NULL ? def : &default_def;
    TL_TRY(tl_def_check(def->cookie, "begin with tl_default_nav_prune_def()", report_out));
    if (def->seeds == NULL && def->seed_count > 0) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "seeds", "give points, or a seed_count of 0");
    }
    for (uint32_t i = 0; i < def->seed_count; i++) {
        if (!tl_is_finite(def->seeds[i])) {
            return tl_report_fail(report_out, TL_ERR_NOT_FINITE, "seed", i, "give finite points");
        }
    }
    const uint64_t size = sizeof(tl_pack_pruning) + def->seed_count * (uint64_t)sizeof(tl_vec3);
    tl_pack_pruning *pruning = tl_blob_allocate(allocator, TL_PACK_PRUNING_MAGIC, TL_PACK_PRUNING_VERSION, size);
    if (pruning == NULL) {
        return TL_ERR_MEMORY;
    }
    pruning->min_area = def->min_area;
    pruning->seed_extents = def->seed_extents;
    pruning->seed_count = def->seed_count;
    pruning->drop_inside_solids = def->solids != NULL;
    if (!is_sound_pruning(pruning)) {
        tl_blob_free(pruning);
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "min_area", "make it and seed_extents finite and >= 0");
    }
    if (def->seed_count > 0) {
        memcpy(pruning + 1, def->seeds, def->seed_count * sizeof *def->seeds);
    }
    *pruning_out = pruning;
    return TL_OK;
}

const tl_vec3 *tl_pack_pruning_seeds(const tl_pack_pruning *pruning)
{
    return (const tl_vec3 *)(pruning + 1);
}

tl_result tl_pack_pruning_check(const void *bytes, uint64_t size, tl_report *report_out)
{
    const tl_blob expected = { TL_PACK_PRUNING_MAGIC, TL_PACK_PRUNING_VERSION, sizeof(tl_pack_pruning) };
    const char *again = "bake the file again";
    TL_TRY(tl_pack_check_head(bytes, size, expected, report_out));
    const tl_pack_pruning *pruning = bytes;
    const uint64_t used = sizeof *pruning + pruning->seed_count * (uint64_t)sizeof(tl_vec3);
    uint32_t any = 0;
    for (size_t i = 0; i < TL_COUNT_OF(pruning->reserved); i++) {
        any |= pruning->reserved[i];
    }
    for (uint64_t i = used; i < size; i++) {
        any |= ((const uint8_t *)bytes)[i];
    }
    if (size < used || any != 0 || !is_sound_pruning(pruning)) {
        return tl_report_fail(report_out, TL_ERR_CORRUPT, "pruning", TL_NO_ELEMENT, again);
    }
    for (uint32_t i = 0; i < pruning->seed_count; i++) {
        if (!tl_is_finite(tl_pack_pruning_seeds(pruning)[i])) {
            return tl_report_fail(report_out, TL_ERR_CORRUPT, "seed", i, again);
        }
    }
    return TL_OK;
}
