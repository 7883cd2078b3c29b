// SPDX-License-Identifier: MIT
//
// The SIMD scans carry each lane's best product and where it was; two strands hide the latency. That was the fastest of
// those tried: to store the products and look for the maximum afterwards ends in a branch that no predictor knows.

#include "support_peers.h"

#include <talus/halfedge.h>

#include <stdlib.h>
#include <string.h>

#if defined(__x86_64__) && defined(__GNUC__)
#define PEER_X86 1
#include <immintrin.h>
#else
#define PEER_X86 0
#endif

// The widest scan reads up to 31 entries beyond the last vertex.
enum { ROW_LANES = 32, FIRST_VECTOR = 16 };

uint32_t peer_scan_scalar(peer_hull *peer, tl_vec3 d)
{
    const tl_vec3 *v = peer->vertices;
    uint32_t best = 0;
    float best_dot = tl_dot(d, v[0]);
    for (uint32_t i = 1; i < peer->count; i++) {
        float dot = tl_dot(d, v[i]);
        if (dot > best_dot) {
            best_dot = dot;
            best = i;
        }
    }
    return best;
}

#if PEER_X86

static uint32_t scan_sse2(peer_hull *peer, tl_vec3 d)
{
    const float *x = peer->rows, *y = x + peer->padded, *z = y + peer->padded;
    __m128 dx = _mm_set1_ps(d.x), dy = _mm_set1_ps(d.y), dz = _mm_set1_ps(d.z);
    __m128 best[2] = { _mm_set1_ps(-INFINITY), _mm_set1_ps(-INFINITY) };
    __m128i at[2] = { _mm_setzero_si128(), _mm_setzero_si128() }, index[2];
    index[0] = _mm_setr_epi32(0, 1, 2, 3);
    index[1] = _mm_setr_epi32(4, 5, 6, 7);
    for (uint32_t i = 0; i < peer->count; i += 8) {
        for (uint32_t k = 0; k < 2; k++) {
            uint32_t j = i + 4 * k;
            __m128 dot = _mm_add_ps(_mm_add_ps(_mm_mul_ps(dx, _mm_load_ps(x + j)), _mm_mul_ps(dy, _mm_load_ps(y + j))),
                                    _mm_mul_ps(dz, _mm_load_ps(z + j)));
            __m128i more = _mm_castps_si128(_mm_cmpgt_ps(dot, best[k]));
            best[k] = _mm_max_ps(dot, best[k]);
            at[k] = _mm_or_si128(_mm_and_si128(more, index[k]), _mm_andnot_si128(more, at[k]));
            index[k] = _mm_add_epi32(index[k], _mm_set1_epi32(8));
        }
    }
    __m128i more = _mm_castps_si128(_mm_cmpgt_ps(best[1], best[0]));
    __m128 m = _mm_max_ps(best[0], best[1]);
    at[0] = _mm_or_si128(_mm_and_si128(more, at[1]), _mm_andnot_si128(more, at[0]));
    __m128 all = _mm_max_ps(m, _mm_shuffle_ps(m, m, _MM_SHUFFLE(1, 0, 3, 2)));
    all = _mm_max_ps(all, _mm_shuffle_ps(all, all, _MM_SHUFFLE(2, 3, 0, 1)));
    uint32_t lanes[4];
    _mm_storeu_si128((__m128i *)(void *)lanes, at[0]);
    return lanes[__builtin_ctz((unsigned)_mm_movemask_ps(_mm_cmpeq_ps(m, all)))];
}

__attribute__((target("avx2,fma"))) static uint32_t scan_avx2(peer_hull *peer, tl_vec3 d)
{
    const float *x = peer->rows, *y = x + peer->padded, *z = y + peer->padded;
    __m256 dx = _mm256_set1_ps(d.x), dy = _mm256_set1_ps(d.y), dz = _mm256_set1_ps(d.z);
    __m256i index = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7), at0 = index, at1 = index;
    __m256 best0 = _mm256_mul_ps(dx, _mm256_load_ps(x));
    best0 = _mm256_fmadd_ps(dz, _mm256_load_ps(z), _mm256_fmadd_ps(dy, _mm256_load_ps(y), best0));
    __m256 best1 = best0;
    for (uint32_t i = 8; i < peer->count; i += 16) {
        __m256 a = _mm256_mul_ps(dx, _mm256_load_ps(x + i)), b = _mm256_mul_ps(dx, _mm256_load_ps(x + i + 8));
        a = _mm256_fmadd_ps(dz, _mm256_load_ps(z + i), _mm256_fmadd_ps(dy, _mm256_load_ps(y + i), a));
        b = _mm256_fmadd_ps(dz, _mm256_load_ps(z + i + 8), _mm256_fmadd_ps(dy, _mm256_load_ps(y + i + 8), b));
        __m256i next = _mm256_add_epi32(index, _mm256_set1_epi32(8));
        index = _mm256_add_epi32(index, _mm256_set1_epi32(16));
        at0 = _mm256_blendv_epi8(at0, next, _mm256_castps_si256(_mm256_cmp_ps(a, best0, _CMP_GT_OQ)));
        at1 = _mm256_blendv_epi8(at1, index, _mm256_castps_si256(_mm256_cmp_ps(b, best1, _CMP_GT_OQ)));
        best0 = _mm256_max_ps(a, best0);
        best1 = _mm256_max_ps(b, best1);
    }
    at0 = _mm256_blendv_epi8(at0, at1, _mm256_castps_si256(_mm256_cmp_ps(best1, best0, _CMP_GT_OQ)));
    __m256 m = _mm256_max_ps(best0, best1);
    __m256 all = _mm256_max_ps(m, _mm256_permute2f128_ps(m, m, 1));
    all = _mm256_max_ps(all, _mm256_permute_ps(all, _MM_SHUFFLE(1, 0, 3, 2)));
    all = _mm256_max_ps(all, _mm256_permute_ps(all, _MM_SHUFFLE(2, 3, 0, 1)));
    uint32_t lane = (uint32_t)__builtin_ctz((unsigned)_mm256_movemask_ps(_mm256_cmp_ps(m, all, _CMP_EQ_OQ)));
    __m256i first = _mm256_permutevar8x32_epi32(at0, _mm256_castsi128_si256(_mm_cvtsi32_si128((int)lane)));
    return (uint32_t)_mm256_cvtsi256_si32(first);
}

__attribute__((target("avx512f"))) static uint32_t scan_avx512(peer_hull *peer, tl_vec3 d)
{
    const float *x = peer->rows, *y = x + peer->padded, *z = y + peer->padded;
    __m512 dx = _mm512_set1_ps(d.x), dy = _mm512_set1_ps(d.y), dz = _mm512_set1_ps(d.z);
    __m512i index = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15), at0 = index, at1 = index;
    __m512 best0 = _mm512_mul_ps(dx, _mm512_load_ps(x));
    best0 = _mm512_fmadd_ps(dz, _mm512_load_ps(z), _mm512_fmadd_ps(dy, _mm512_load_ps(y), best0));
    __m512 best1 = best0;
    for (uint32_t i = 16; i < peer->count; i += 32) {
        __m512 a = _mm512_mul_ps(dx, _mm512_load_ps(x + i)), b = _mm512_mul_ps(dx, _mm512_load_ps(x + i + 16));
        a = _mm512_fmadd_ps(dz, _mm512_load_ps(z + i), _mm512_fmadd_ps(dy, _mm512_load_ps(y + i), a));
        b = _mm512_fmadd_ps(dz, _mm512_load_ps(z + i + 16), _mm512_fmadd_ps(dy, _mm512_load_ps(y + i + 16), b));
        __m512i next = _mm512_add_epi32(index, _mm512_set1_epi32(16));
        index = _mm512_add_epi32(index, _mm512_set1_epi32(32));
        at0 = _mm512_mask_mov_epi32(at0, _mm512_cmp_ps_mask(a, best0, _CMP_GT_OQ), next);
        at1 = _mm512_mask_mov_epi32(at1, _mm512_cmp_ps_mask(b, best1, _CMP_GT_OQ), index);
        best0 = _mm512_max_ps(a, best0);
        best1 = _mm512_max_ps(b, best1);
    }
    at0 = _mm512_mask_mov_epi32(at0, _mm512_cmp_ps_mask(best1, best0, _CMP_GT_OQ), at1);
    __m512 m = _mm512_max_ps(best0, best1);
    __m512 all = _mm512_max_ps(m, _mm512_shuffle_f32x4(m, m, _MM_SHUFFLE(1, 0, 3, 2)));
    all = _mm512_max_ps(all, _mm512_shuffle_f32x4(all, all, _MM_SHUFFLE(2, 3, 0, 1)));
    all = _mm512_max_ps(all, _mm512_permute_ps(all, _MM_SHUFFLE(1, 0, 3, 2)));
    all = _mm512_max_ps(all, _mm512_permute_ps(all, _MM_SHUFFLE(2, 3, 0, 1)));
    __m512i first = _mm512_maskz_compress_epi32(_mm512_cmp_ps_mask(m, all, _CMP_EQ_OQ), at0);
    return (uint32_t)_mm_cvtsi128_si32(_mm512_castsi512_si128(first));
}

peer_support_fn *peer_scan_sse2(void)
{
    return scan_sse2;
}

peer_support_fn *peer_scan_avx2(void)
{
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? scan_avx2 : NULL;
}

peer_support_fn *peer_scan_avx512(void)
{
    return __builtin_cpu_supports("avx512f") ? scan_avx512 : NULL;
}

#else

peer_support_fn *peer_scan_sse2(void)
{
    return NULL;
}

peer_support_fn *peer_scan_avx2(void)
{
    return NULL;
}

peer_support_fn *peer_scan_avx512(void)
{
    return NULL;
}

#endif

// What a reader would take for the article's EPSILON.
static const float CHOU_EPSILON = 1e-6f;

static int chou_climb_from(const peer_hull *peer, tl_vec3 d, int first)
{
    const chou_vert *verts = peer->chou_verts;
    const chou_edge *edges = peer->chou_edges;
    int best_index = first;
    const chou_vert *best = &verts[first];
    float best_dot = tl_dot(d, best->position);
    bool end = false;
    while (!end) {
        int e = best->edge;
        const int start = e;
        const float old_dot = best_dot;
        do {
            const chou_edge *edge = &edges[e];
            const chou_vert *vert = &verts[edge->vert];
            const float dot = tl_dot(d, vert->position);
            if (dot >= best_dot + CHOU_EPSILON) {
                best_index = edge->vert;
                best = vert;
                best_dot = dot;
            }
            e = edges[edge->twin].next;
        } while (start != e);
        end = best_dot == old_dot;
    }
    return best_index;
}

uint32_t peer_chou_climb(peer_hull *peer, tl_vec3 d)
{
    return (uint32_t)chou_climb_from(peer, d, 0);
}

uint32_t peer_chou_climb_warm(peer_hull *peer, tl_vec3 d)
{
    return peer->last = (uint32_t)chou_climb_from(peer, d, (int)peer->last);
}

// Chou's mesh has triangles only: a fan for each polygon. Half-edges are numbered as its AddFace would.
static bool make_chou_mesh(peer_hull *peer, const tl_hull *hull)
{
    tl_halfedge_mesh mesh;
    tl_halfedge_mesh_init(&mesh, NULL);
    bool made = true;
    for (uint32_t v = 0; v < hull->vertex_count; v++) {
        uint32_t unused;
        made = made && tl_halfedge_mesh_add_vertex(&mesh, tl_hull_vertices(hull)[v], &unused) == TL_OK;
    }
    for (uint32_t f = 0; f < hull->face_count; f++) {
        tl_hull_face face = tl_hull_face_at(hull, f);
        for (uint32_t k = 1; k + 1 < face.count; k++) {
            made = made && tl_halfedge_mesh_add_triangle(&mesh, tl_hull_edge_origin(hull, face.first),
                                                         tl_hull_edge_origin(hull, face.first + k),
                                                         tl_hull_edge_origin(hull, face.first + k + 1), NULL) == TL_OK;
        }
    }
    peer->chou_verts = malloc(mesh.vertex_end * sizeof *peer->chou_verts);
    peer->chou_edges = malloc(mesh.edge_end * sizeof *peer->chou_edges);
    made = made && peer->chou_verts != NULL && peer->chou_edges != NULL;
    for (uint32_t v = 0; made && v < mesh.vertex_end; v++) {
        chou_vert vert = { mesh.vertices[v].position, -1, -1, true };
        peer->chou_verts[v] = vert;
    }
    for (uint32_t e = 0; made && e < mesh.edge_end; e++) {
        const tl_halfedge_edge *from = &mesh.edges[e];
        chou_edge edge = {
            (int)from->vertex, (int)from->face, (int)from->next, (int)from->prev, (int)(e ^ 1u), -1, true
        };
        peer->chou_edges[e] = edge;
        chou_vert *origin = &peer->chou_verts[mesh.edges[e ^ 1u].vertex];
        origin->edge = origin->edge < 0 ? (int)e : origin->edge;
    }
    tl_halfedge_mesh_destroy(&mesh);
    return made;
}

bool peer_hull_make(peer_hull *peer, const tl_hull *hull)
{
    memset(peer, 0, sizeof *peer);
    peer->hull = hull;
    peer->vertices = tl_hull_vertices(hull);
    peer->count = hull->vertex_count;
    peer->padded = (hull->vertex_count + 2 * (ROW_LANES - 1)) / ROW_LANES * ROW_LANES;
    peer->rows = aligned_alloc(64, 3 * (size_t)peer->padded * sizeof(float));
    if (peer->rows == NULL || !make_chou_mesh(peer, hull)) {
        peer_hull_free(peer);
        return false;
    }
    // In the first vector the last vertex is repeated, in higher lanes than its own; later on a NaN never is the best.
    for (uint32_t i = 0; i < peer->padded; i++) {
        tl_vec3 none = { NAN, NAN, NAN };
        tl_vec3 p = i < peer->count ? peer->vertices[i] : i < FIRST_VECTOR ? peer->vertices[peer->count - 1] : none;
        peer->rows[i] = p.x;
        peer->rows[peer->padded + i] = p.y;
        peer->rows[2 * peer->padded + i] = p.z;
    }
    return true;
}

void peer_hull_free(peer_hull *peer)
{
    free(peer->rows);
    free(peer->chou_verts);
    free(peer->chou_edges);
    memset(peer, 0, sizeof *peer);
}
