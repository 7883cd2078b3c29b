// SPDX-License-Identifier: MIT
//
// The off-mesh links of a navmesh as chunks of its file: those that were found and are still there, as LINK, so that
// their kinds are kept; all others as OFFM.

#include "binding.h"

#include <stdlib.h>
#include <string.h>

// Whether a link is the one that was found whose number it carries.
static bool is_found(const tl_nav_links *links, const tl_nav_offmesh *link)
{
    if (links == NULL || link->user >= links->link_count) {
        return false;
    }
    const tl_nav_jump_link *found = &tl_nav_links_array(links)[link->user];
    return memcmp(&found->start, &link->start, sizeof(tl_vec3)) == 0 &&
           memcmp(&found->end, &link->end, sizeof(tl_vec3)) == 0;
}

// The links that were found, without those that are not in `is_there`. NULL: no memory.
static tl_nav_links *copy_found(const tl_nav_links *links, const bool *is_there)
{
    tl_nav_links *copy = calloc(1, (size_t)links->blob.size);
    if (copy == NULL) {
        return NULL;
    }
    *copy = *links;
    copy->link_count = 0;
    memset(copy->kind_counts, 0, sizeof(copy->kind_counts));
    tl_nav_jump_link *to = (tl_nav_jump_link *)(void *)((char *)copy + copy->links);
    for (uint32_t i = 0; i < links->link_count; i++) {
        if (is_there[i]) {
            to[copy->link_count] = tl_nav_links_array(links)[i];
            copy->kind_counts[to[copy->link_count++].kind]++;
        }
    }
    size_t end = (size_t)copy->links + copy->link_count * sizeof(*to);
    copy->blob.size = (end + TL_BLOB_ALIGNMENT - 1) / TL_BLOB_ALIGNMENT * TL_BLOB_ALIGNMENT;
    return copy;
}

// Sorts the navmesh's links; `by_hand` has room for all.
static tl_result sort_links(const binding_navmesh *held, bool *is_there, uint32_t *found, tl_nav_offmesh *by_hand,
                            uint32_t *by_hand_count)
{
    tl_result result = TL_OK;
    uint32_t cursor = 0;
    for (tl_nav_ref ref; result == TL_OK && tl_navmesh_next_offmesh(held->navmesh, &cursor, &ref);) {
        tl_nav_offmesh_state state;
        result = tl_navmesh_offmesh_state(held->navmesh, ref, &state);
        if (result == TL_OK && is_found(held->links, &state.offmesh)) {
            is_there[state.offmesh.user] = true;
            (*found)++;
        } else if (result == TL_OK) {
            by_hand[(*by_hand_count)++] = state.offmesh;
        }
    }
    return result;
}

tl_result binding_links_to_save(const binding_navmesh *held, binding_saved_links *saved, tl_report *report)
{
    const uint32_t links = held->links != NULL ? held->links->link_count : 0;
    uint32_t found = 0;
    uint32_t count = 0;
    bool *is_there = calloc((size_t)links + 1, sizeof(*is_there));
    tl_nav_offmesh *by_hand = calloc((size_t)tl_navmesh_offmesh_count(held->navmesh) + 1, sizeof(*by_hand));
    tl_result result =
        is_there != NULL && by_hand != NULL ? sort_links(held, is_there, &found, by_hand, &count) : TL_ERR_MEMORY;
    if (result == TL_OK && count > 0) {
        result = tl_pack_offmesh_encode(by_hand, count, NULL, &saved->by_hand, report);
    }
    if (result == TL_OK && found == links) {
        saved->found = held->links;
    } else if (result == TL_OK && found > 0) {
        saved->found = saved->own_found = copy_found(held->links, is_there);
        result = saved->found != NULL ? TL_OK : TL_ERR_MEMORY;
    }
    free(is_there);
    free(by_hand);
    return result;
}

void binding_saved_links_free(binding_saved_links *saved)
{
    free(saved->own_found);
    tl_blob_free(saved->by_hand);
}
