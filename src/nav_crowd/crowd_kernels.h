// SPDX-License-Identifier: MIT
//
// What most of a step is spent in, four agents at a time: which of a run of agents are near, the order of those, and
// the half-planes by which they are avoided. Compiled once per instruction set (crowd_kernels.inl); every one gives the
// same bits.

#ifndef TALUS_SRC_NAV_CROWD_CROWD_KERNELS_H
#define TALUS_SRC_NAV_CROWD_CROWD_KERNELS_H

#include "base/cpu.h"
#include "nav_crowd/crowd.h"
#include "nav_crowd/half_plane_program.h"

enum {
    CROWD_LANES = 4,
    CROWD_MAX_SPANS = 16,
    CROWD_MORE_FOUND = 16, ///< beyond the neighbours that are wanted: then the nearest are chosen
    CROWD_MAX_FOUND = CROWD_MAX_NEIGHBORS + CROWD_MORE_FOUND + CROWD_LANES
};

/// Agents [begin, end) of the snapshot.
typedef struct crowd_span {
    uint32_t begin, end;
} crowd_span;

/// One who looks for others, and those found so far.
typedef struct crowd_scan {
    const crowd_snapshot *seen;
    uint32_t self;
    float reach; ///< metres, rim to rim: who is nearer is found
    crowd_span spans[CROWD_MAX_SPANS];
    uint32_t next_span, span_count;
    uint32_t full;  ///< the scan stops when it has found more
    uint32_t count; ///< found
    float gap[CROWD_MAX_FOUND];
    uint32_t at[CROWD_MAX_FOUND]; ///< of the snapshot
} crowd_scan;

/// Discs that an agent avoids, seen from it: middles, how much faster the agent is, both radii together, and which
/// shares it takes of evading and of the room that is left.
typedef struct crowd_discs {
    float x[CROWD_MAX_NEIGHBORS], z[CROWD_MAX_NEIGHBORS];
    float vx[CROWD_MAX_NEIGHBORS], vz[CROWD_MAX_NEIGHBORS];
    float radius[CROWD_MAX_NEIGHBORS];
    float evade[CROWD_MAX_NEIGHBORS], room[CROWD_MAX_NEIGHBORS];
    uint32_t count;
    float own_vx, own_vz;     ///< of the agent
    float rate, overlap_rate; ///< 1 / seconds: within which they are avoided, and left where they overlap
} crowd_discs;

/// What else an agent sees of its neighbours, an array for each number. All arrays are filled up to the next multiple
/// of CROWD_LANES, with the agent itself.
typedef struct crowd_view {
    // Metres a second that they want; and where they travel, of any length. Fixed ones as they move.
    float wanted_x[CROWD_MAX_NEIGHBORS], wanted_z[CROWD_MAX_NEIGHBORS];
    float way_x[CROWD_MAX_NEIGHBORS], way_z[CROWD_MAX_NEIGHBORS];
    float priority[CROWD_MAX_NEIGHBORS];
    uint32_t fixed, still, yields; ///< CROWD_SEEN_..., a bit for each
    crowd_discs discs;             ///< but for their shares and rates
} crowd_view;

/// What an agent looks at traffic with.
typedef struct crowd_outlook {
    float ahead[2];  ///< unit: where it heads now
    float travel[2]; ///< unit: where it goes past its corner
    bool held;       ///< for so long that it may go back: else it only keeps to the right
    bool late;       ///< others are taken by what they want at present, not by where they travel
} crowd_outlook;

/// Neighbours, a bit each.
typedef struct crowd_traffic_bits {
    uint32_t ahead;
    uint32_t against; ///< their ways and the agent's make an obtuse angle
    uint32_t quick;   ///< want to walk no slower than CROWD_STANDING_SPEED
} crowd_traffic_bits;

#define CROWD_STANDING_SPEED 0.2f ///< metres a second: who wants less does not claim a door

/// The end of the lanes that `count` neighbours fill.
static inline uint32_t tl_crowd_lanes_end(uint32_t count)
{
    return (count + CROWD_LANES - 1) / CROWD_LANES * CROWD_LANES;
}

/// The bits of `count` <= CROWD_MAX_NEIGHBORS neighbours.
static inline uint32_t tl_crowd_neighbor_bits(uint32_t count)
{
    return (uint32_t)(((uint64_t)1 << count) - 1);
}

typedef struct crowd_kernels {
    /// Scans the spans from the next one on; at the end there are none. False: it is full, and there may be more.
    bool (*scan)(crowd_scan *scan);
    /// How many of `count` <= CROWD_MAX_FOUND gaps are smaller than each. May write behind them, in both arrays, up to
    /// the next multiple of CROWD_LANES. False: two are equal.
    bool (*rank)(float *gaps, uint32_t count, uint32_t *ranks_out);
    /// Fills a view of neighbours, seen from the agent at `self` of the snapshot. `radius_share`: of both radii.
    void (*view)(const crowd_snapshot *seen, uint32_t self, const crowd_neighbor *neighbors, uint32_t count,
                 float radius_share, crowd_view *view_out);
    /// Looks at the neighbours of a view.
    crowd_traffic_bits (*traffic)(const crowd_view *view, const crowd_outlook *look);
    /// The half-plane of each disc. Writes up to the next multiple of CROWD_LANES.
    void (*avoid)(const crowd_discs *discs, tl_half_plane *planes_out);
} crowd_kernels;

extern const crowd_kernels tl_crowd_kernels_scalar;
#if TL_CPU_LEVELS >= 1
extern const crowd_kernels tl_crowd_kernels_vec128;
#endif

/// Those of this machine.
static inline const crowd_kernels *tl_crowd_best_kernels(void)
{
#if TL_CPU_LEVELS > 1
    return tl_cpu_has_vec128() ? &tl_crowd_kernels_vec128 : &tl_crowd_kernels_scalar;
#elif TL_CPU_LEVELS == 1
    return &tl_crowd_kernels_vec128;
#else
    return &tl_crowd_kernels_scalar;
#endif
}

#endif
