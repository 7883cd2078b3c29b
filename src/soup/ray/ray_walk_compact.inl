// SPDX-License-Identifier: MIT
//
// BVH traversal of a compact soup: the same steps and the same leaf code, on quantized boxes and on leaves that are
// expanded first. Part of ray_walk.inl.
//
// A leaf is expanded to four pairs for the test, a shorter one by repeating its first: so vectors of four are stored
// where they are read, whole. Its ids follow when a triangle of it may be hit.

// A byte for each float of a plain node.
static inline const uint8_t *byte_row(const tl_compact_node *node, uint32_t row)
{
    return (const uint8_t *)(const void *)node->plane + row / sizeof(float);
}

// A product with a power of two is exact, so a plane is the very float that the encoder had, and the bounds of
// ray_prepare.h hold. (Folding scale and origin into the slab constants saves twelve instructions and no time.)
static TL_ALWAYS_INLINE uint32_t enter_compact_children(const tl_ray_job *job, const walk_ray *ray,
                                                        const tl_compact_node *node, float limit, uint32_t *t_bits)
{
    walk_slab slabs[3];
    for (uint32_t i = 0; i < 3; i++) {
        tl_f32x16 origin = tl_f32x16_all(node->origin[i]), step = tl_f32x16_all(node->scale[i]);
        tl_f32x16 near_plane = tl_f32x16_mul_add(tl_f32x16_from_bytes(byte_row(node, ray->near_rows[i])), step, origin);
        tl_f32x16 far_plane = tl_f32x16_mul_add(tl_f32x16_from_bytes(byte_row(node, ray->far_rows[i])), step, origin);
        tl_f32x16 scale = tl_f32x16_all(job->plane_scale[i]);
        slabs[i].enter = tl_f32x16_mul_add(near_plane, scale, tl_f32x16_all(job->near_base[i]));
        slabs[i].leave = tl_f32x16_mul_add(far_plane, scale, tl_f32x16_all(job->far_base[i]));
    }
    return enter_boxes(slabs, limit, t_bits) & node->mask;
}

// Two corners of four pairs, an axis in each vector: the one in its low half, the other in its high half.
static TL_ALWAYS_INLINE void gather_corners(const float *const *bases, const tl_compact_pair *const *pairs,
                                            uint32_t low, uint32_t high, tl_f32x8 v[4])
{
    for (uint32_t i = 0; i < 4; i++) {
        v[i] = tl_f32x8_load_halves(bases[i] + 3 * (size_t)pairs[i]->corner[low],
                                    bases[i] + 3 * (size_t)pairs[i]->corner[high]);
    }
    tl_f32x8_transpose(v);
}

static TL_ALWAYS_INLINE const tl_soup_leaf *expand_leaf(const tl_soup *soup, uint32_t child, tl_leaf_buffer *buffer)
{
    uint32_t n = tl_child_pair_count(child);
    uint32_t first = (uint32_t)(tl_child_leaf_offset(child) / sizeof(tl_compact_pair));
    const tl_compact_pair *leaf = &tl_compact_pairs(soup)[first], *pairs[4];
    const float *base = tl_compact_base(soup, first), *bases[4];
    for (uint32_t i = 0; i < 4; i++) {
        pairs[i] = leaf + (i < n ? i : 0);
        bases[i] = base;
    }
    if (first % TL_COMPACT_GROUP + n > TL_COMPACT_GROUP) { // the leaf lies in two groups
        for (uint32_t i = 1; i < n; i++) {
            bases[i] = tl_compact_base(soup, first + i);
        }
    }
    tl_f32x8 ac[4], bd[4];
    gather_corners(bases, pairs, 0, 1, ac);
    gather_corners(bases, pairs, 2, 3, bd);
    float *floats = (float *)(void *)(buffer->words + 8);
    // The widest pair along an axis: at least as wide as the widest triangle, which the error bounds need.
    tl_f32x8 extent = tl_f32x8_all(0.0f);
    for (uint32_t axis = 0; axis < 3; axis++) {
        tl_f32x8_store(floats + (size_t)axis * 16, ac[axis]);
        tl_f32x8_store(floats + (size_t)axis * 16 + 8, bd[axis]);
        tl_f32x8 high = tl_f32x8_max(ac[axis], bd[axis]), low = tl_f32x8_min(ac[axis], bd[axis]);
        high = tl_f32x8_max(high, tl_f32x8_swap_halves(high));
        low = tl_f32x8_min(low, tl_f32x8_swap_halves(low));
        extent = tl_f32x8_max(extent, tl_f32x8_sub(high, low));
    }
    buffer->head.extent = tl_f32x8_first(tl_f32x8_largest(extent));
    buffer->head.tagged_count = TL_LEAF_TAG | 4;
    return &buffer->head;
}

static TL_ALWAYS_INLINE void expand_ids(const tl_soup *soup, uint32_t child, tl_leaf_buffer *buffer)
{
    const tl_compact_pair *pairs = &tl_compact_pairs(soup)[tl_child_leaf_offset(child) / sizeof(tl_compact_pair)];
    for (uint32_t i = 0; i < tl_child_pair_count(child); i++) {
        buffer->words[i] = pairs[i].ids[0];
        buffer->words[TL_SOUP_LEAF_PAIRS + i] = pairs[i].ids[1];
    }
}

// Tests and settles a leaf. True: any hit will do, and there is one.
static TL_ALWAYS_INLINE bool visit_compact_leaf(tl_ray_job *job, uint32_t child, bool any, walk_best *best)
{
    tl_leaf_buffer buffer;
    const tl_soup_leaf *leaf = expand_leaf(job->soup, child, &buffer);
    leaf_lanes lanes;
    test_leaf(job, leaf, TL_SOUP_LEAF_PAIRS, &lanes);
    lanes.maybe &= ((1u << tl_child_pair_count(child)) - 1u) * 0x11u;
    if (lanes.maybe == 0) {
        return false;
    }
    expand_ids(job->soup, child, &buffer);
    return settle_lanes(job, leaf, TL_SOUP_LEAF_PAIRS, &lanes, any, best);
}

static bool walk_compact(tl_ray_job *job, tl_ray_hit *hit)
{
    const bool any = hit == NULL;
    walk_ray ray;
    walk_best best;
    begin_walk(job, sizeof(tl_compact_node), &ray, &best);
    walk_entry stack[WALK_STACK_SIZE];
    uint32_t stack_count = 0, child = 0;
    for (;;) {
        if ((child & TL_CHILD_LEAF) == 0) {
            const tl_compact_node *node =
                (const tl_compact_node *)(const void *)(ray.nodes + child * sizeof(tl_compact_node));
            _Alignas(64) uint32_t t_bits[TL_SOUP_WIDTH];
            uint32_t mask = enter_compact_children(job, &ray, node, best.limit, t_bits);
            if (mask != 0) {
                child = push_children(&ray, t_bits, node->child, mask, any, stack, &stack_count);
                continue;
            }
        } else if (visit_compact_leaf(job, child, any, &best)) {
            return true;
        }
        if (!pop_child(stack, &stack_count, best.limit, &child)) {
            return report_hit(job, hit);
        }
    }
}
