// SPDX-License-Identifier: MIT
//
// The instances whose boxes touch a box: no arithmetic, so no rounding.

#include "base/assert.h"
#include "scene/scene_layout.h"

static uint32_t touched(const tl_scene_node *node, const tl_aabb *box)
{
    uint32_t mask = 0;
    for (uint32_t i = 0; i < TL_SCENE_WIDTH; i++) {
        bool x = (node->plane[0][i] <= box->max.x) & (node->plane[1][i] >= box->min.x);
        bool y = (node->plane[2][i] <= box->max.y) & (node->plane[3][i] >= box->min.y);
        bool z = (node->plane[4][i] <= box->max.z) & (node->plane[5][i] >= box->min.z);
        // The lane's box is not empty.
        mask |= (uint32_t)(x & y & z & (node->plane[0][i] <= node->plane[1][i])) << i;
    }
    return mask;
}

bool tl_scene_instances_in_box(const tl_scene *scene, tl_aabb box, const tl_scene_filter *filter,
                               tl_scene_instance_fn *found, void *user)
{
    TL_ASSERT(scene != NULL && found != NULL);
    uint32_t counted = tl_scene_mask(filter);
    uint32_t stack[TL_SCENE_STACK_SIZE];
    uint32_t count = 1;
    stack[0] = 0;
    while (count > 0) {
        uint32_t child = stack[--count];
        if ((child & TL_CHILD_INSTANCE) != 0) {
            uint32_t instance = child & ~TL_CHILD_INSTANCE;
            if (tl_scene_accepts(filter, instance) && !found(instance, user)) {
                return false;
            }
            continue;
        }
        const tl_scene_node *node = &tl_scene_nodes(scene)[child];
        uint32_t mask = touched(node, &box);
        for (uint32_t i = TL_SCENE_WIDTH; i-- > 0;) {
            if ((mask >> i & 1u) != 0 && (node->mask[i] & counted) != 0) {
                stack[count++] = node->child[i];
            }
        }
    }
    return true;
}
