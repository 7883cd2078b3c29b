// SPDX-License-Identifier: MIT
//
// The steps of one contour, recorded: in full those that a picture shows, of all others what they cut or merged away.

#ifndef TALUS_CLI_DRAW_STEPS_RECORD_H
#define TALUS_CLI_DRAW_STEPS_RECORD_H

#include <talus/polygon.h>

typedef struct steps_entry {
    uint64_t first;           // in numbers: partitions, then the outline, then corners
    uint32_t partition_count; // of a step that isn't shown: at most the chosen one
    uint32_t outline_count;   // of a step that isn't shown: 0
    uint32_t corner_count;
    uint32_t candidates; // how many partitions there were
} steps_entry;

typedef struct steps_of_kind {
    steps_entry *entries;
    uint64_t count, capacity;
    uint32_t *shown; // indices of entries, rising
    uint32_t shown_count;
} steps_of_kind;

typedef struct steps_record {
    steps_of_kind kinds[2]; // by tl_polygon_step_kind
    int32_t *numbers;       // pairs of x and z
    uint64_t number_count, number_capacity;
    tl_polygon_mesh mesh; // what came out
    bool out_of_memory;
    bool counting; // the first of two runs
} steps_record;

/// Divides the contour twice: to count the steps, then to record the at most `max_shown` of `kind` that are shown.
/// Free with steps_record_free in any case.
tl_result steps_record_make(const tl_contour_set *set, uint32_t contour, uint32_t max_verts_per_poly,
                            tl_polygon_step_kind kind, uint32_t max_shown, const tl_host *host,
                            steps_record *record_out);
void steps_record_free(steps_record *record);

#endif
