// SPDX-License-Identifier: MIT
//
// Where the rays of a packet meet their pending triangles: the arithmetic of ray_measure.h, operation by operation, a
// ray in each lane instead of an axis. Loops over lanes are plain C: compilers make vectors of them, and nothing is
// fused, so the bits are those of single rays. Part of ray_walk_packet.inl.

// Triangles, a lane each. Corners are in the order of the view.
typedef struct packet_triangles {
    _Alignas(64) float corner[3][3][PACKET_RAYS]; // by corner and axis
    float normal[3][PACKET_RAYS];
    float extent[PACKET_RAYS]; // of the leaf
    uint32_t triangle[PACKET_RAYS];
    uint32_t coincident; // lanes whose triangle is the lowest of several
} packet_triangles;

typedef struct packet_places {
    _Alignas(64) double along[PACKET_RAYS]; // n.d
    double across[PACKET_RAYS];             // n.c
    double margin[PACKET_RAYS];             // t is as exact as promised where this is not negative
    float t[PACKET_RAYS], u[PACKET_RAYS], v[PACKET_RAYS];
} packet_places;

// The corners of a leaf's triangle, as tl_ray_measure finds them; returns its id.
static TL_ALWAYS_INLINE uint32_t find_corners(const tl_soup_leaf *leaf, uint32_t n, uint32_t bit,
                                              const float *corners_out[3])
{
    uint32_t pair = bit & 3u, second = bit >> 2;
    const uint32_t *ids = (const uint32_t *)(const void *)(leaf + 1);
    const float *floats = (const float *)(const void *)(ids + 2 * (size_t)n);
    uint32_t id = ids[pair + n * second];
    uint32_t slots = pair * 0x10101u + n * (0x10200u + (second << 8));
    const uint8_t *shift = tl_ray_corner_shifts[tl_id_order(id)];
    for (uint32_t k = 0; k < 3; k++) {
        corners_out[k] = floats + (slots >> shift[k] & 0xffu);
    }
    return id;
}

static TL_ALWAYS_INLINE tl_vec3 corners_normal(const float *const corner[3], uint32_t stride)
{
    tl_f64x4 a = tl_f64x4_gather_three(corner[0], stride);
    tl_f64x4 p = tl_f64x4_sub(tl_f64x4_gather_three(corner[1], stride), a);
    tl_f64x4 q = tl_f64x4_sub(tl_f64x4_gather_three(corner[2], stride), a);
    double normal[4];
    tl_f64x4_store(normal, tl_f64x4_cross(p, q));
    return tl_ray_unit_normal(normal);
}

// The triangles `bit` of leaves `child` of some lanes; coherent rays have few different ones. Other lanes hold zeros.
static TL_ALWAYS_INLINE void gather_triangles(const tl_soup *soup, const uint32_t *child, const uint32_t *bit,
                                              uint32_t lanes, packet_triangles *all)
{
    tl_f32x16 corners[3][3], normals[3], extents = tl_f32x16_all(0.0f);
    memset(all->triangle, 0, sizeof all->triangle);
    all->coincident = 0;
    for (uint32_t i = 0; i < 3; i++) {
        corners[i][0] = corners[i][1] = corners[i][2] = normals[i] = tl_f32x16_all(0.0f);
    }
    while (lanes != 0) {
        uint32_t lane = tl_lowest_bit(lanes), n = tl_child_pair_count(child[lane]);
        uint32_t same = lanes & tl_u32x16_equal(child, child[lane]) & tl_u32x16_equal(bit, bit[lane]);
        const tl_soup_leaf *leaf = tl_soup_leaf_at(soup, tl_child_leaf_offset(child[lane]));
        const float *corner[3];
        const uint32_t id = find_corners(leaf, n, bit[lane], corner);
        tl_u32x16_store_where(all->triangle, same, tl_soup_lowest_triangle(soup, id));
        all->coincident |= (id & TL_ID_INDEX) >= soup->source_triangle_count ? same : 0;
        for (uint32_t k = 0; k < 3; k++) {
            for (uint32_t i = 0; i < 3; i++) {
                corners[k][i] = tl_f32x16_choose(same, tl_f32x16_all(corner[k][4 * (size_t)n * i]), corners[k][i]);
            }
        }
        tl_vec3 normal = corners_normal(corner, 4 * n);
        normals[0] = tl_f32x16_choose(same, tl_f32x16_all(normal.x), normals[0]);
        normals[1] = tl_f32x16_choose(same, tl_f32x16_all(normal.y), normals[1]);
        normals[2] = tl_f32x16_choose(same, tl_f32x16_all(normal.z), normals[2]);
        extents = tl_f32x16_choose(same, tl_f32x16_all(leaf->extent), extents);
        lanes &= ~same;
    }
    for (uint32_t i = 0; i < 3; i++) {
        tl_f32x16_store(all->corner[i][0], corners[i][0]);
        tl_f32x16_store(all->corner[i][1], corners[i][1]);
        tl_f32x16_store(all->corner[i][2], corners[i][2]);
        tl_f32x16_store(all->normal[i], normals[i]);
    }
    tl_f32x16_store(all->extent, extents);
}

// In the order of tl_f64x4_sums, its fourth lane 0.
static TL_ALWAYS_INLINE double sum_axes(double x, double y, double z)
{
    return (x + y) + (z + 0.0);
}

static TL_ALWAYS_INLINE void measure_lanes(const ray_packet *p, bool is_segment, const packet_triangles *all,
                                           packet_places *places)
{
    double from = is_segment ? 1.0 : 0.0, reach = (double)p->reach;
    for (uint32_t i = 0; i < PACKET_RAYS; i++) {
        double ox = (double)p->origin[0][i], oy = (double)p->origin[1][i], oz = (double)p->origin[2][i];
        double dx = (double)p->target[0][i] - from * ox, dy = (double)p->target[1][i] - from * oy;
        double dz = (double)p->target[2][i] - from * oz;
        double ax = (double)all->corner[0][0][i], ay = (double)all->corner[0][1][i];
        double az = (double)all->corner[0][2][i];
        double px = (double)all->corner[1][0][i] - ax, py = (double)all->corner[1][1][i] - ay;
        double pz = (double)all->corner[1][2][i] - az;
        double qx = (double)all->corner[2][0][i] - ax, qy = (double)all->corner[2][1][i] - ay;
        double qz = (double)all->corner[2][2][i] - az;
        double cx = ax - ox, cy = ay - oy, cz = az - oz;
        double nx = py * qz - pz * qy, ny = pz * qx - px * qz, nz = px * qy - py * qx;
        double mx = cy * dz - cz * dy, my = cz * dx - cx * dz, mz = cx * dy - cy * dx;
        double along = sum_axes(nx * dx, ny * dy, nz * dz), across = sum_axes(nx * cx, ny * cy, nz * cz);
        double inverse = 1.0 / along;
        double wide = (double)all->extent[i];
        places->margin[i] = fabs(across) - tl_ray_least_across(wide, reach);
        places->t[i] = (float)(across * inverse);
        places->u[i] = (float)(sum_axes(mx * qx, my * qy, mz * qz) * inverse);
        places->v[i] = -(float)(sum_axes(mx * px, my * py, mz * pz) * inverse);
        places->along[i] = along;
        places->across[i] = across;
    }
    // As tl_ray_keep_inside does; a choice in the loop would keep compilers from making vectors of it.
    tl_f32x16 zero = tl_f32x16_all(0.0f), one = tl_f32x16_all(1.0f);
    tl_f32x16 u = tl_f32x16_min(tl_f32x16_max(lanes_of(places->u), zero), one);
    tl_f32x16 v = tl_f32x16_min(tl_f32x16_max(lanes_of(places->v), zero), tl_f32x16_sub(one, u));
    tl_f32x16_store(places->u, u);
    tl_f32x16_store(places->v, v);
}

// Writes the hits of some lanes, in front of what is there already when `compare`: of equal t the lowest index wins.
// Returns the lanes that must be traced alone, for their t must be computed exactly, or as that of each of several
// coincident triangles.
static TL_ALWAYS_INLINE uint32_t measure_triangles(const tl_ray_batch *batch, const ray_packet *p,
                                                   const uint32_t *child, const uint32_t *bit, uint32_t lanes,
                                                   bool compare)
{
    packet_triangles all;
    packet_places places;
    gather_triangles(batch->soup, child, bit, lanes, &all);
    measure_lanes(p, batch->rays == NULL, &all, &places);
    uint32_t doubtful = 0;
    for (; lanes != 0; lanes &= lanes - 1) {
        uint32_t i = tl_lowest_bit(lanes);
        tl_ray_hit *hit = &batch->hits[p->index[i]];
        float t = places.t[i];
        const bool is_common = (all.coincident >> i & 1u) == 0 ||
                               tl_ray_t_is_common(places.along[i], places.across[i],
                                                  tl_ray_least_across((double)all.extent[i], (double)p->reach));
        if (!(places.margin[i] >= 0.0 && t < TL_RAY_T_MAX && is_common)) {
            doubtful |= 1u << i;
            continue;
        }
        if (compare && (hit->t < t || (hit->t == t && hit->triangle < all.triangle[i]))) {
            continue;
        }
        memset((char *)hit + offsetof(tl_ray_hit, material), 0, sizeof *hit - offsetof(tl_ray_hit, material));
        hit->t = t;
        hit->triangle = all.triangle[i];
        hit->u = places.u[i];
        hit->v = places.v[i];
        hit->normal = tl_vec3_make(all.normal[0][i], all.normal[1][i], all.normal[2][i]);
        hit->material = tl_soup_material(batch->soup, all.triangle[i]);
        hit->back = places.along[i] > 0.0;
    }
    return doubtful;
}

// Reports the closest hits of the lanes that have a pending triangle. Returns those to be traced alone.
static TL_ALWAYS_INLINE uint32_t measure_packet(const tl_ray_batch *batch, const ray_packet *p, uint32_t lanes)
{
    uint32_t doubtful = measure_triangles(batch, p, p->child, p->bit, lanes, false);
    uint32_t contested = lanes & p->contested & ~doubtful;
    if (contested != 0) {
        doubtful |= measure_triangles(batch, p, p->rival_child, p->rival_bit, contested, true);
    }
    return doubtful;
}
