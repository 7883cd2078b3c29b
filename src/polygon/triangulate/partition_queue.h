// SPDX-License-Identifier: MIT
//
// Partitions by rising length: those of the outline as it came, sorted once, and a heap of those that cuts made. Half
// of all are there at first, and to walk along a sorted list misses no cache, as sinking through a large heap does.

#ifndef TALUS_SRC_POLYGON_PARTITION_QUEUE_H
#define TALUS_SRC_POLYGON_PARTITION_QUEUE_H

#include "base/arena.h"
#include "base/radix_sort.h"

#include <stdbool.h>

/// A partition from point a to point c: key is its squared length, value is a, extra is c. Ties go to the lower a.
typedef tl_sort_item tl_partition;

typedef struct tl_partition_queue {
    tl_partition *sorted; // what is left of it
    uint32_t sorted_count;
    tl_partition *heap;
    uint32_t heap_count;
} tl_partition_queue;

/// Room for `count` partitions at first, and two more for each cut. False: out of memory.
static inline bool tl_partition_queue_init(tl_partition_queue *queue, tl_arena *arena, uint32_t count)
{
    queue->sorted = TL_PUSH(arena, tl_partition, count);
    queue->heap = TL_PUSH(arena, tl_partition, 2 * (uint64_t)count);
    queue->sorted_count = queue->heap_count = 0;
    return queue->sorted != NULL && queue->heap != NULL;
}

/// Ends the filling of `sorted`, where partitions stand by rising a. The heap is empty yet, and large enough as
/// scratch.
static inline void tl_partition_queue_sort(tl_partition_queue *queue)
{
    tl_radix_sort(queue->sorted, queue->heap, queue->sorted_count);
}

static inline bool tl_partition_comes_first(const tl_partition *a, const tl_partition *b)
{
    return a->key != b->key ? a->key < b->key : a->value < b->value;
}

static inline void tl_partition_queue_push(tl_partition_queue *queue, tl_partition item)
{
    tl_partition *heap = queue->heap;
    uint32_t i = queue->heap_count++;
    while (i > 0 && tl_partition_comes_first(&item, &heap[(i - 1) / 2])) {
        heap[i] = heap[(i - 1) / 2];
        i = (i - 1) / 2;
    }
    heap[i] = item;
}

static inline tl_partition tl_partition_heap_pop(tl_partition_queue *queue)
{
    tl_partition *heap = queue->heap;
    const tl_partition top = heap[0];
    const tl_partition last = heap[--queue->heap_count];
    uint32_t i = 0;
    for (uint32_t child = 1; child < queue->heap_count; child = 2 * i + 1) {
        if (child + 1 < queue->heap_count && tl_partition_comes_first(&heap[child + 1], &heap[child])) {
            child++;
        }
        if (!tl_partition_comes_first(&heap[child], &last)) {
            break;
        }
        heap[i] = heap[child];
        i = child;
    }
    heap[i] = last;
    return top;
}

/// Takes the shortest out. False: there are none.
static inline bool tl_partition_queue_pop(tl_partition_queue *queue, tl_partition *shortest)
{
    if (queue->heap_count > 0 &&
        (queue->sorted_count == 0 || tl_partition_comes_first(&queue->heap[0], queue->sorted))) {
        *shortest = tl_partition_heap_pop(queue);
        return true;
    }
    if (queue->sorted_count == 0) {
        return false;
    }
    *shortest = *queue->sorted++;
    queue->sorted_count--;
    return true;
}

#endif
