// SPDX-License-Identifier: MIT
//
// The one priority queue: an implicit d-ary heap over an array of the caller's. What comes first is on top.
//
// A template. Before each inclusion define
//
//   TL_HEAP(name)                  what its functions are called: #define TL_HEAP(name) open_nodes_##name
//   TL_HEAP_ITEM                   the type of an item, copied by value
//   TL_HEAP_BEFORE(context, a, b)  whether item a comes before item b. Break all ties: then the order in which items
//                                  leave depends on the items alone, not on the heap's shape.
//   TL_HEAP_MOVED(context, a, at)  optional: item a stands at `at` now, for heaps whose items are improved or removed
//   TL_HEAP_FETCHES                optional, 1 for a heap too large for the cache: while the children of a node are
//                                  compared, theirs are fetched
//   TL_HEAP_ARITY                  optional: children of a node, 2 by default. 4 is faster where items are small:
//                                  a heap half as high, whose four children lie in one cache line.
//
// and the inclusion gives, for `TL_HEAP_CONTEXT context` (const void * by default), static functions
//
//   sift_up(heap, at, item, context)            puts item at `at` or as far above as it belongs
//   sift_down(heap, count, at, item, context)   puts item at `at` or as far below as it belongs
//   push(heap, &count, item, context)           the array holds one more
//   pop(heap, &count, context)                  takes the top; count > 0
//
// and forgets the macros again. Source: Williams, Algorithm 232: Heapsort, 1964; Johnson 1975 for d children.

#include "base/compiler.h"

#ifndef TL_HEAP_ARITY
#define TL_HEAP_ARITY 2u
#endif
#ifndef TL_HEAP_FETCHES
#define TL_HEAP_FETCHES 0
#endif
#ifndef TL_HEAP_CONTEXT
#define TL_HEAP_CONTEXT const void *
#endif
#ifndef TL_HEAP_MOVED
#define TL_HEAP_MOVED(context, a, at) ((void)0)
#endif

static inline void TL_HEAP(sift_up)(TL_HEAP_ITEM *heap, uint32_t at, TL_HEAP_ITEM item, TL_HEAP_CONTEXT context)
{
    (void)context;
    while (at > 0) {
        uint32_t parent = (at - 1) / TL_HEAP_ARITY;
        if (!TL_HEAP_BEFORE(context, item, heap[parent])) {
            break;
        }
        heap[at] = heap[parent];
        TL_HEAP_MOVED(context, heap[at], at);
        at = parent;
    }
    heap[at] = item;
    TL_HEAP_MOVED(context, item, at);
}

// Which of the children from `first` on comes first; first < count.
static inline uint32_t TL_HEAP(first_child)(const TL_HEAP_ITEM *heap, uint32_t first, uint32_t count,
                                            TL_HEAP_CONTEXT context)
{
    (void)context;
    if (TL_HEAP_ARITY == 2) {
        return first + (first + 1 < count && TL_HEAP_BEFORE(context, heap[first + 1], heap[first]) ? 1u : 0u);
    }
    if (TL_HEAP_ARITY == 4 &&
        count - first >= 4) { // two pairs, then their winners: no branch depends on the one before
        uint32_t low = first + (TL_HEAP_BEFORE(context, heap[first + 1], heap[first]) ? 1u : 0u);
        uint32_t high = first + 2 + (TL_HEAP_BEFORE(context, heap[first + 3], heap[first + 2]) ? 1u : 0u);
        return TL_HEAP_BEFORE(context, heap[high], heap[low]) ? high : low;
    }
    uint32_t end = count - first < TL_HEAP_ARITY ? count : first + TL_HEAP_ARITY;
    uint32_t best = first;
    for (uint32_t child = first + 1; child < end; child++) {
        best = TL_HEAP_BEFORE(context, heap[child], heap[best]) ? child : best;
    }
    return best;
}

static inline void TL_HEAP(sift_down)(TL_HEAP_ITEM *heap, uint32_t count, uint32_t at, TL_HEAP_ITEM item,
                                      TL_HEAP_CONTEXT context)
{
    for (;;) {
        uint32_t first = at * TL_HEAP_ARITY + 1;
        if (first >= count) {
            break;
        }
        const uint64_t second = (uint64_t)first * TL_HEAP_ARITY + 1; // grandchild
        for (uint32_t k = 0; TL_HEAP_FETCHES && k < TL_HEAP_ARITY && second + k * TL_HEAP_ARITY < count; k++) {
            tl_prefetch(&heap[second + k * TL_HEAP_ARITY]);
        }
        uint32_t best = TL_HEAP(first_child)(heap, first, count, context);
        if (!TL_HEAP_BEFORE(context, heap[best], item)) {
            break;
        }
        heap[at] = heap[best];
        TL_HEAP_MOVED(context, heap[at], at);
        at = best;
    }
    heap[at] = item;
    TL_HEAP_MOVED(context, item, at);
}

static inline void TL_HEAP(push)(TL_HEAP_ITEM *heap, uint32_t *count, TL_HEAP_ITEM item, TL_HEAP_CONTEXT context)
{
    TL_HEAP(sift_up)(heap, (*count)++, item, context);
}

static inline TL_HEAP_ITEM TL_HEAP(pop)(TL_HEAP_ITEM *heap, uint32_t *count, TL_HEAP_CONTEXT context)
{
    TL_HEAP_ITEM top = heap[0];
    TL_HEAP_ITEM last = heap[--*count];
    if (*count > 0) {
        TL_HEAP(sift_down)(heap, *count, 0, last, context);
    }
    return top;
}

#undef TL_HEAP
#undef TL_HEAP_ITEM
#undef TL_HEAP_BEFORE
#undef TL_HEAP_MOVED
#undef TL_HEAP_ARITY
#undef TL_HEAP_FETCHES
#undef TL_HEAP_CONTEXT
