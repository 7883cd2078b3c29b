// SPDX-License-Identifier: MIT
//
// A priority queue of partitions by length: a sorted list of the outline's own and a heap of those that cuts add. Half
// of all are known at first, and a sorted list is read in order, while sifting through a large heap misses the cache.

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
    queue->heap = TL_PUSH(arena, tl_partition, 2 * (uint64_t)count + 3);
    queue->sorted_count = queue->heap_count = 0;
    if (queue->sorted == NULL || queue->heap == NULL) {
        return false;
    }
    queue->heap += 3; // the four children of a node lie in one cache line
    return true;
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

#define TL_HEAP(name)                 tl_partition_heap_##name
#define TL_HEAP_ITEM                  tl_partition
#define TL_HEAP_BEFORE(context, a, b) tl_partition_comes_first(&(a), &(b))
#define TL_HEAP_ARITY                 4u
#define TL_HEAP_FETCHES               1
#include "base/heap.inl"

static inline void tl_partition_queue_push(tl_partition_queue *queue, tl_partition item)
{
    tl_partition_heap_push(queue->heap, &queue->heap_count, item, NULL);
}

/// Takes the shortest out. False: there are none.
static inline bool tl_partition_queue_pop(tl_partition_queue *queue, tl_partition *shortest)
{
    if (queue->heap_count > 0 &&
        (queue->sorted_count == 0 || tl_partition_comes_first(&queue->heap[0], queue->sorted))) {
        *shortest = tl_partition_heap_pop(queue->heap, &queue->heap_count, NULL);
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
