// SPDX-License-Identifier: MIT
//
// Many rays on one thread, several of them in flight at once. A single ray waits for memory, for chains of arithmetic,
// and for mispredicted branches; here each ray prefetches what it visits next and lets others continue until it has
// come.
//
// Rays that stand at nodes and rays that stand at leaves wait in a ring each. A round takes a group from one ring and
// tests it without a branch in between, so that the processor overlaps the tests; only then does each ray find its own
// way on. Where a single walk branches, up to three children, sorting is branchless. The bookkeeping takes a third more
// instructions a ray; missed branches that no longer stall the others, and memory that is waited for together, save
// more.
//
// A ray in flight has a short stack; one that would overflow it is traced alone. Answers are those of the single walk,
// as both decide by the same functions. Included after ray_walk.inl.

#ifndef TALUS_SRC_SOUP_RAY_WALK_INTERLEAVED_INL
#define TALUS_SRC_SOUP_RAY_WALK_INTERLEAVED_INL

// With twice as many lanes, or half, and groups of 4 to 8, times differed by less than they did from run to run. All
// lanes and a single walk's stack together take less than 32 KB.
enum { RAY_LANES = 12, LANE_GROUP = 6, LANE_RING = 16 };

#ifndef TL_LANE_STACK_SIZE // a test has a shorter one
#define TL_LANE_STACK_SIZE 96
#endif

static_assert(RAY_LANES <= LANE_RING, "a ring holds all lanes");

// A ray in flight.
typedef struct walk_lane {
    uint32_t child; // what it visits next
    uint32_t stack_count;
    uint32_t index; // of the ray
    walk_ray ray;
    walk_best best;
    tl_ray_job job;
    walk_entry stack[TL_LANE_STACK_SIZE];
} walk_lane;

typedef struct lane_ring {
    uint32_t lanes[LANE_RING], first, end;
} lane_ring;

typedef struct lane_walk {
    const tl_ray_batch *batch;
    uint32_t next; // ray
    lane_ring nodes, leaves;
    walk_lane lanes[RAY_LANES];
} lane_walk;

// Starts the next ray that meets the soup's box. False: there is none.
static TL_ALWAYS_INLINE bool begin_lane(lane_walk *w, walk_lane *lane)
{
    const tl_ray_batch *batch = w->batch;
    while (w->next < batch->count) {
        lane->index = w->next++;
        const tl_vec3 *origin, *target;
        tl_ray_job *job = &lane->job;
        tl_ray_of_batch(batch, lane->index, &origin, &target, &job->t);
        job->soup = batch->soup;
        job->filter = batch->filter;
        job->is_segment = batch->rays == NULL;
        if (tl_ray_prepare_inline(job, origin, target) && (job->outside == 0 || tl_ray_meets_bounds(job))) {
            begin_walk(job, sizeof(tl_soup_node), &lane->ray, &lane->best);
            lane->child = 0;
            lane->stack_count = 0;
            return true;
        }
        tl_ray_report(batch, lane->index, false);
    }
    return false;
}

typedef enum lane_end {
    LANE_DONE,     // nothing is left on its stack
    LANE_MET,      // any hit will do, and there is one
    LANE_OVERFLOWS // its stack is too short: it is traced alone
} lane_end;

// Ends a ray and begins the next one; false when there is none. Not inline: that would repeat the code that begins and
// ends a ray.
static TL_NOINLINE bool change_ray(lane_walk *w, walk_lane *lane, lane_end end)
{
    const tl_ray_batch *batch = w->batch;
    tl_ray_hit *hit = batch->hits != NULL ? &batch->hits[lane->index] : NULL;
    bool met = end == LANE_MET;
    if (end == LANE_DONE) {
        met = report_hit(&lane->job, hit);
    } else if (end == LANE_OVERFLOWS) {
        const tl_vec3 *origin, *target;
        float tmax;
        tl_ray_of_batch(batch, lane->index, &origin, &target, &tmax);
        met = TL_RAY_WALK(batch->soup, origin, target, tmax, batch->rays == NULL, batch->filter, hit);
    }
    tl_ray_report(batch, lane->index, met);
    return begin_lane(w, lane);
}

// Advances a lane to its nearest waiting child, or to its next ray.
static TL_ALWAYS_INLINE void advance_lane(lane_walk *w, uint32_t index, bool met)
{
    walk_lane *lane = &w->lanes[index];
    bool overflows = lane->stack_count > TL_LANE_STACK_SIZE - TL_SOUP_WIDTH - 3;
    if (!met && !overflows && pop_child(lane->stack, &lane->stack_count, lane->best.limit, &lane->child)) {
        prefetch_child(&lane->ray, lane->child);
    } else if (!change_ray(w, lane, met ? LANE_MET : overflows ? LANE_OVERFLOWS : LANE_DONE)) {
        return;
    }
    uint32_t leaf = (uint32_t)((lane->child & TL_CHILD_LEAF) != 0);
    w->nodes.lanes[w->nodes.end % LANE_RING] = index;
    w->leaves.lanes[w->leaves.end % LANE_RING] = index;
    w->nodes.end += 1 - leaf;
    w->leaves.end += leaf;
}

// A child's entry, or zero when `mask` is empty.
static inline walk_entry entry_of_lowest(const uint32_t *t_bits, const uint32_t *children, uint32_t mask)
{
    uint64_t any = 0 - (uint64_t)(mask != 0);
    return any & make_entry(t_bits, children, tl_lowest_bit(mask | 1u << (TL_SOUP_WIDTH - 1)));
}

// Puts all children on the stack, the nearest on top. Of up to three, missing ones are zero and sort to the top, where
// they are not counted. When any hit will do, the lowest lane comes on top, as in push_children.
static TL_ALWAYS_INLINE void push_all(walk_lane *lane, const uint32_t *children, const uint32_t *t_bits, uint32_t mask,
                                      bool any)
{
    if (any) {
        uint32_t rest = mask & (mask - 1u), count = tl_bit_count(rest);
        walk_entry *base = lane->stack + lane->stack_count;
        tl_u32x16_compress_pairs(base, rest, t_bits, children);
        base[count] = entry_of_lowest(t_bits, children, mask);
        lane->stack_count += count + (uint32_t)(mask != 0);
        return;
    }
    uint32_t second = mask & (mask - 1u), third = second & (second - 1u);
    if ((third & (third - 1u)) != 0) {
        (void)push_sorted(t_bits, children, mask, lane->stack, &lane->stack_count);
        lane->stack_count++;
        return;
    }
    walk_entry a = entry_of_lowest(t_bits, children, mask), b = entry_of_lowest(t_bits, children, second);
    walk_entry c = entry_of_lowest(t_bits, children, third);
    walk_entry *top = lane->stack + lane->stack_count;
    walk_entry low = nearer_entry(a, b), high = farther_entry(a, b);
    top[0] = farther_entry(high, c);
    high = nearer_entry(high, c);
    top[1] = farther_entry(low, high);
    top[2] = nearer_entry(low, high);
    lane->stack_count += (uint32_t)(mask != 0) + (uint32_t)(second != 0) + (uint32_t)(third != 0);
}

static TL_ALWAYS_INLINE const tl_soup_node *lane_node(const walk_lane *lane)
{
    return (const tl_soup_node *)(const void *)(lane->ray.nodes + lane->child * sizeof(tl_soup_node));
}

static TL_ALWAYS_INLINE const tl_soup_leaf *lane_leaf(const walk_lane *lane)
{
    return (const tl_soup_leaf *)(const void *)(lane->ray.leaves + tl_child_leaf_offset(lane->child));
}

static TL_ALWAYS_INLINE void visit_nodes(lane_walk *w, uint32_t count, bool any)
{
    _Alignas(64) uint32_t t_bits[LANE_GROUP][TL_SOUP_WIDTH];
    uint32_t masks[LANE_GROUP], at[LANE_GROUP];
    for (uint32_t i = 0; i < count; i++) {
        at[i] = w->nodes.lanes[w->nodes.first++ % LANE_RING];
        const walk_lane *lane = &w->lanes[at[i]];
        masks[i] = enter_children(&lane->job, &lane->ray, lane_node(lane), lane->best.limit, t_bits[i]);
    }
    for (uint32_t i = 0; i < count; i++) {
        push_all(&w->lanes[at[i]], lane_node(&w->lanes[at[i]])->child, t_bits[i], masks[i], any);
        advance_lane(w, at[i], false);
    }
}

static TL_ALWAYS_INLINE void visit_leaves(lane_walk *w, uint32_t count, bool any)
{
    leaf_lanes tested[LANE_GROUP];
    uint32_t at[LANE_GROUP];
    for (uint32_t i = 0; i < count; i++) {
        at[i] = w->leaves.lanes[w->leaves.first++ % LANE_RING];
        const walk_lane *lane = &w->lanes[at[i]];
        test_leaf(&lane->job, lane_leaf(lane), tl_child_pair_count(lane->child), &tested[i]);
    }
    for (uint32_t i = 0; i < count; i++) {
        walk_lane *lane = &w->lanes[at[i]];
        bool met = tested[i].maybe != 0 && settle_lanes(&lane->job, lane_leaf(lane), tl_child_pair_count(lane->child),
                                                        &tested[i], any, &lane->best);
        advance_lane(w, at[i], met);
    }
}

static TL_ALWAYS_INLINE void walk_lanes_to_end(lane_walk *w, bool any)
{
    for (;;) {
        uint32_t at_nodes = w->nodes.end - w->nodes.first, at_leaves = w->leaves.end - w->leaves.first;
        if (at_nodes >= LANE_GROUP) {
            visit_nodes(w, LANE_GROUP, any);
        } else if (at_leaves >= LANE_GROUP) {
            visit_leaves(w, LANE_GROUP, any);
        } else if (at_nodes > 0) {
            visit_nodes(w, at_nodes, any);
        } else if (at_leaves > 0) {
            visit_leaves(w, at_leaves, any);
        } else {
            return;
        }
    }
}

void TL_RAY_WALK_MANY(const tl_ray_batch *batch)
{
    lane_walk w;
    w.batch = batch;
    w.next = 0;
    w.nodes.first = w.nodes.end = 0;
    w.leaves.first = w.leaves.end = 0;
    for (uint32_t i = 0; i < RAY_LANES && begin_lane(&w, &w.lanes[i]); i++) {
        w.nodes.lanes[w.nodes.end++] = i;
    }
    if (batch->hits == NULL) {
        walk_lanes_to_end(&w, true);
    } else {
        walk_lanes_to_end(&w, false);
    }
}

#endif
