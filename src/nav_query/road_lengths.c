// SPDX-License-Identifier: MIT
//
// Lengths along roads to all bends: Dijkstra with a binary heap, in which a bend stands once for each time its length
// fell. Equal lengths go to the lower bend, so that the same ways are found everywhere.
// Source: Dijkstra, A note on two problems in connexion with graphs, 1959.

#include "nav_query/road_lengths.h"

#include "base/arena.h"

#include <math.h>
#include <string.h>

static bool is_before(tl_nav_open_bend a, tl_nav_open_bend b)
{
    return a.length < b.length || (a.length == b.length && a.bend < b.bend);
}

static void push(tl_nav_road_lengths *s, double length, uint32_t bend)
{
    tl_nav_open_bend entry = { length, bend };
    uint32_t at = s->heap_count++;
    for (; at > 0 && is_before(entry, s->heap[(at - 1) / 2]); at = (at - 1) / 2) {
        s->heap[at] = s->heap[(at - 1) / 2];
    }
    s->heap[at] = entry;
}

static tl_nav_open_bend pop(tl_nav_road_lengths *s)
{
    tl_nav_open_bend top = s->heap[0];
    tl_nav_open_bend last = s->heap[--s->heap_count];
    uint32_t at = 0;
    for (;;) {
        uint32_t child = 2 * at + 1;
        if (child >= s->heap_count) {
            break;
        }
        child += child + 1 < s->heap_count && is_before(s->heap[child + 1], s->heap[child]) ? 1 : 0;
        if (!is_before(s->heap[child], last)) {
            break;
        }
        s->heap[at] = s->heap[child];
        at = child;
    }
    s->heap[at] = last;
    return top;
}

tl_result tl_nav_road_lengths_make(const tl_allocator *allocator, const tl_nav_roads *roads,
                                   tl_nav_road_lengths *lengths_out)
{
    memset(lengths_out, 0, sizeof *lengths_out);
    lengths_out->roads = roads;
    lengths_out->length = tl_allocate_array(allocator, roads->bend_count, sizeof *lengths_out->length);
    lengths_out->before = tl_allocate_array(allocator, roads->bend_count, sizeof *lengths_out->before);
    lengths_out->heap =
        tl_allocate_array(allocator, (uint64_t)roads->bend_count + roads->road_count, sizeof *lengths_out->heap);
    if (lengths_out->length == NULL || lengths_out->before == NULL || lengths_out->heap == NULL) {
        tl_nav_road_lengths_free(allocator, lengths_out);
        return TL_ERR_MEMORY;
    }
    return TL_OK;
}

void tl_nav_road_lengths_free(const tl_allocator *allocator, tl_nav_road_lengths *lengths)
{
    const tl_nav_roads *roads = lengths->roads;
    tl_release_array(allocator, lengths->length, roads->bend_count, sizeof *lengths->length);
    tl_release_array(allocator, lengths->before, roads->bend_count, sizeof *lengths->before);
    tl_release_array(allocator, lengths->heap, (uint64_t)roads->bend_count + roads->road_count, sizeof *lengths->heap);
}

void tl_nav_measure_roads(tl_nav_road_lengths *lengths, const uint32_t *sources, uint32_t source_count)
{
    const tl_nav_roads *roads = lengths->roads;
    for (uint32_t i = 0; i < roads->bend_count; i++) {
        lengths->length[i] = (double)INFINITY;
    }
    for (uint32_t i = 0; i < source_count; i++) {
        lengths->length[sources[i]] = 0.0;
        lengths->before[sources[i]] = sources[i];
        push(lengths, 0.0, sources[i]);
    }
    while (lengths->heap_count > 0) {
        tl_nav_open_bend next = pop(lengths);
        if (next.length > lengths->length[next.bend]) {
            continue;
        }
        const tl_nav_bend *bend = &roads->bends[next.bend];
        for (uint32_t k = bend[0].first_road; k < bend[1].first_road; k++) {
            const tl_nav_road *road = &roads->roads[k];
            double x = (double)road->x - (double)bend->x;
            double z = (double)road->z - (double)bend->z;
            double length = next.length + sqrt(x * x + z * z);
            if (length < lengths->length[road->to]) {
                lengths->length[road->to] = length;
                lengths->before[road->to] = next.bend;
                push(lengths, length, road->to);
            }
        }
    }
}
