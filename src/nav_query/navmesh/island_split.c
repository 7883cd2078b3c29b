// SPDX-License-Identifier: MIT
//
// Splitting islands when a tile or a link is removed: searches from all nodes that lost a link take turns until they
// meet.
//
// Each component that is cut off holds a node that has lost a link: a seed. From the seeds breadth-first searches visit
// the nodes around in turns, one each. Two searches that meet form a group and go on as one. As soon as one group is
// left, as almost always after a few steps around the place, nothing was cut off. A group that ends before it has met
// the others is a component of its own and gets a new label; the last one, however large, is not visited to its end and
// keeps the old label. So the time depends on what lies between the seeds, or on the smaller components, not on the
// world. Seeds that had different labels before never meet and do not wait for one another.
//
// Components over seams alone are split first. Islands then need one seed of each of those components, and none where
// there is only one. Rejected: joining all tiles anew (the time of a swap grew with the world); the forests of Holm, de
// Lichtenberg and Thorup (2001), which bound the worst case, a long and narrow world cut in the middle over and over,
// by many times the code and memory; blocks of tiles joined in two levels, which cost a block each time, off-mesh links
// at the top.

#include "nav_query/navmesh/islands.h"

#include "base/assert.h"
#include "nav_query/navmesh/navmesh.h"
#include "nav_query/navmesh/offmesh_anchor.h"

typedef struct island_splitter {
    const tl_navmesh *navmesh;
    tl_nav_islands *islands;
    tl_nav_island_kind kind;
    tl_nav_island_label *labels;
} island_splitter;

static uint32_t group_of(tl_nav_island_piece *pieces, uint32_t piece)
{
    while (pieces[piece].parent != piece) {
        pieces[piece].parent = pieces[pieces[piece].parent].parent;
        piece = pieces[piece].parent;
    }
    return piece;
}

static void join_search_pieces(island_splitter *s, uint32_t piece_a, uint32_t piece_b)
{
    tl_nav_island_piece *pieces = s->islands->pieces;
    uint32_t a = group_of(pieces, piece_a);
    uint32_t b = group_of(pieces, piece_b);
    if (a == b) {
        return;
    }
    TL_ASSERT(pieces[a].first_piece == pieces[b].first_piece);
    uint32_t root = a < b ? a : b;
    uint32_t child = a < b ? b : a;
    tl_nav_island_piece *first = &pieces[pieces[root].first_piece];
    first->groups--;
    first->open_groups -= pieces[a].open > 0 && pieces[b].open > 0 ? 1 : 0;
    pieces[child].parent = root;
    pieces[root].open += pieces[child].open;
}

static void reach_node(island_splitter *s, uint32_t piece, uint32_t slot, uint32_t polygon)
{
    const tl_nav_rings *rings = &s->navmesh->slots[slot].rings;
    uint32_t index = tl_nav_ring_islands(rings)[tl_nav_component_of(rings, polygon)];
    tl_nav_island_node *node = &s->islands->nodes[index];
    if (node->piece != TL_NAV_NO_ISLAND) {
        join_search_pieces(s, piece, node->piece);
        return;
    }
    tl_nav_island_piece *finder = &s->islands->pieces[piece];
    node->piece = piece;
    node->next = TL_NAV_NO_ISLAND;
    s->islands->nodes[finder->last].next = index;
    finder->last = index;
}

static void reach_over_seams(island_splitter *s, uint32_t piece, const tl_nav_island_node *node)
{
    const tl_nav_slot *slot = &s->navmesh->slots[node->slot];
    uint32_t component = tl_nav_component_of(&slot->rings, node->polygon);
    for (uint32_t side = 0; side < TL_NAV_SIDE_COUNT; side++) {
        const tl_nav_side_links *links = &slot->sides[side];
        const tl_nav_portal *portals = tl_nav_tile_portals(slot->tile) + tl_nav_tile_side_first(slot->tile, side);
        for (uint32_t i = 0; links->first != NULL && i < links->portal_count; i++) {
            if (tl_nav_component_of(&slot->rings, portals[i].polygon) == component) {
                for (uint32_t k = links->first[i]; k < links->first[i + 1]; k++) {
                    const tl_nav_seam_link *link = &tl_nav_seam_links_of(links)[k];
                    reach_node(s, piece, tl_nav_seam_slot(link), tl_nav_seam_polygon(link));
                }
            }
        }
    }
}

static void reach_over_links(island_splitter *s, uint32_t piece, const tl_nav_island_node *node)
{
    const tl_nav_rings *rings = &s->navmesh->slots[node->slot].rings;
    uint32_t polygon = node->polygon;
    do {
        for (uint32_t end = tl_nav_first_anchor(s->navmesh, node->slot, polygon); end != TL_NAV_NO_END;) {
            const tl_nav_offmesh_entry *entry = &s->navmesh->offmesh.entries[end / 2];
            const tl_nav_anchor *own = &entry->ends[end % 2];
            const tl_nav_anchor *other = &entry->ends[1 - end % 2];
            if (own->slot == node->slot && own->polygon == polygon && other->slot != TL_NAV_NO_SLOT) {
                reach_node(s, piece, other->slot, other->polygon);
            }
            end = own->next;
        }
        polygon = tl_nav_next_member(rings, polygon);
    } while (polygon != node->polygon);
}

// Goes through one node of a piece.
static void step_piece(island_splitter *s, uint32_t index)
{
    tl_nav_island_piece *piece = &s->islands->pieces[index];
    const tl_nav_island_node *node = &s->islands->nodes[piece->head];
    reach_over_seams(s, index, node);
    if (s->kind == TL_NAV_ISLANDS && s->navmesh->slots[node->slot].anchor_count > 0) {
        reach_over_links(s, index, node);
    }
    piece->head = node->next;
    if (piece->head == TL_NAV_NO_ISLAND) {
        tl_nav_island_piece *group = &s->islands->pieces[group_of(s->islands->pieces, index)];
        group->open--;
        s->islands->pieces[piece->first_piece].open_groups -= group->open == 0 ? 1 : 0;
    }
}

static void start_pieces(island_splitter *s, const uint32_t *seeds, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        tl_nav_island_node *node = &s->islands->nodes[seeds[i]];
        uint32_t root = tl_nav_label_root(s->labels, node->labels[s->kind]);
        tl_nav_island_label *label = &s->labels[root];
        const uint32_t first = (label->size & TL_NAV_LABEL_SOUGHT) != 0 ? label->size & ~TL_NAV_LABEL_SOUGHT : i;
        tl_nav_island_piece piece = { i,    seeds[i], seeds[i],    seeds[i], 1, TL_NAV_NO_ISLAND,
                                      root, first,    label->size, 0,        0 };
        s->islands->pieces[i] = piece;
        s->islands->pieces[first].groups++;
        s->islands->pieces[first].open_groups++;
        label->size = TL_NAV_LABEL_SOUGHT | first;
        node->piece = i;
        node->next = TL_NAV_NO_ISLAND;
    }
}

// Names the groups that were cut off, and forgets the search.
static void finish_split(island_splitter *s, uint32_t count)
{
    tl_nav_island_piece *pieces = s->islands->pieces;
    tl_nav_island_node *nodes = s->islands->nodes;
    for (uint32_t i = 0; i < count; i++) {
        bool is_cut_off = pieces[i].parent == i && pieces[i].open == 0 && pieces[pieces[i].first_piece].groups > 1;
        pieces[i].new_label = is_cut_off ? tl_nav_new_label(s->islands, s->kind) : TL_NAV_NO_ISLAND;
    }
    for (uint32_t i = 0; i < count; i++) {
        uint32_t new_label = pieces[group_of(pieces, i)].new_label;
        for (uint32_t index = pieces[i].first; index != TL_NAV_NO_ISLAND; index = nodes[index].next) {
            nodes[index].piece = TL_NAV_NO_ISLAND;
            if (new_label != TL_NAV_NO_ISLAND) {
                nodes[index].labels[s->kind] = new_label;
                tl_nav_touch(s->islands->history, TL_NAV_PAGED_ISLAND_NODES, index);
            }
        }
        if (pieces[i].first_piece == i) {
            s->labels[pieces[i].label].size = pieces[i].label_size;
        }
    }
}

static void split_kind(tl_navmesh *navmesh, tl_nav_island_kind kind, const uint32_t *seeds, uint32_t count)
{
    tl_nav_islands *islands = &navmesh->islands;
    tl_nav_reserve_labels(islands, kind, count);
    island_splitter s = { navmesh, islands, kind, islands->labels[kind] };
    start_pieces(&s, seeds, count);
    for (bool goes_on = true; goes_on;) {
        goes_on = false;
        for (uint32_t i = 0; i < count; i++) {
            const tl_nav_island_piece *piece = &islands->pieces[i];
            if (piece->head != TL_NAV_NO_ISLAND && islands->pieces[piece->first_piece].open_groups > 1) {
                step_piece(&s, i);
                goes_on = true;
            }
        }
    }
    finish_split(&s, count);
}

// Leaves one seed of each component over seams.
static uint32_t thin_out(tl_nav_islands *islands, uint32_t *seeds, uint32_t count)
{
    tl_nav_island_label *components = islands->labels[TL_NAV_SEAM_ISLANDS];
    uint32_t left = 0;
    for (uint32_t i = 0; i < count; i++) {
        tl_nav_island_label *component =
            &components[tl_nav_label_root(components, islands->nodes[seeds[i]].labels[TL_NAV_SEAM_ISLANDS])];
        if ((component->size & TL_NAV_LABEL_SOUGHT) == 0) {
            component->size |= TL_NAV_LABEL_SOUGHT;
            seeds[left++] = seeds[i];
        }
    }
    for (uint32_t i = 0; i < left; i++) {
        components[tl_nav_label_root(components, islands->nodes[seeds[i]].labels[TL_NAV_SEAM_ISLANDS])].size &=
            ~TL_NAV_LABEL_SOUGHT;
    }
    return left;
}

void tl_nav_split_islands(tl_navmesh *navmesh)
{
    tl_nav_islands *islands = &navmesh->islands;
    for (uint32_t i = 0; i < islands->seed_count; i++) {
        islands->nodes[islands->seeds[i]].piece = TL_NAV_NO_ISLAND;
    }
    split_kind(navmesh, TL_NAV_SEAM_ISLANDS, islands->seeds, islands->seam_seed_count);
    split_kind(navmesh, TL_NAV_ISLANDS, islands->seeds, thin_out(islands, islands->seeds, islands->seed_count));
    islands->seed_count = 0;
    islands->seam_seed_count = 0;
}
