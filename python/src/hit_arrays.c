// SPDX-License-Identifier: MIT
//
// Hits as the library writes them, records of 32 bytes, to an array for each of their parts.
//
// A miss is zero but for t and triangle, which the library's batches have written, so no branch is needed. Four hits at
// a time are transposed in registers: 9 stores instead of 32, for the stores bound this loop.

#include "binding.h"

#include <stddef.h>
#include <string.h>

#ifdef BINDING_SSE2
#include <emmintrin.h>

_Static_assert(sizeof(tl_ray_hit) == 32 && offsetof(tl_ray_hit, u) == 8 && offsetof(tl_ray_hit, normal) == 16 &&
                   offsetof(tl_ray_hit, material) == 28 && offsetof(tl_ray_hit, back) == 30,
               "the shuffles know where the parts of a hit lie");

static void scatter_four(const tl_ray_hit *hits, const binding_hit_arrays *out, size_t at)
{
    __m128 front[4], back[4]; // t, triangle, u, v; normal, material and back
    for (int i = 0; i < 4; i++) {
        front[i] = _mm_loadu_ps(&hits[i].t);
        back[i] = _mm_loadu_ps(&hits[i].normal.x);
    }
    __m128 low = _mm_unpacklo_ps(front[0], front[1]), high = _mm_unpacklo_ps(front[2], front[3]);
    _mm_storeu_ps(out->t + at, _mm_movelh_ps(low, high));
    _mm_storeu_si128((__m128i *)(void *)(out->triangles + at), _mm_castps_si128(_mm_movehl_ps(high, low)));
    _mm_storeu_ps(out->barycentrics + 2 * at, _mm_shuffle_ps(front[0], front[1], _MM_SHUFFLE(3, 2, 3, 2)));
    _mm_storeu_ps(out->barycentrics + 2 * at + 4, _mm_shuffle_ps(front[2], front[3], _MM_SHUFFLE(3, 2, 3, 2)));

    float *normals = &out->normals[at].x;
    __m128 zx01 = _mm_shuffle_ps(back[0], back[1], _MM_SHUFFLE(0, 0, 2, 2));
    __m128 zx23 = _mm_shuffle_ps(back[2], back[3], _MM_SHUFFLE(0, 0, 2, 2));
    _mm_storeu_ps(normals, _mm_shuffle_ps(back[0], zx01, _MM_SHUFFLE(2, 0, 1, 0)));
    _mm_storeu_ps(normals + 4, _mm_shuffle_ps(back[1], back[2], _MM_SHUFFLE(1, 0, 2, 1)));
    _mm_storeu_ps(normals + 8, _mm_shuffle_ps(zx23, back[3], _MM_SHUFFLE(2, 1, 2, 0)));

    __m128 tails = _mm_movehl_ps(_mm_unpackhi_ps(back[2], back[3]), _mm_unpackhi_ps(back[0], back[1]));
    __m128i bits = _mm_castps_si128(tails); // material in the low half, back in the byte above it
    // Saturation keeps a sign-extended half as it is.
    __m128i materials = _mm_srai_epi32(_mm_slli_epi32(bits, 16), 16);
    _mm_storel_epi64((__m128i *)(void *)(out->materials + at), _mm_packs_epi32(materials, materials));
    __m128i backs = _mm_and_si128(_mm_srli_epi32(bits, 16), _mm_set1_epi32(0xFF));
    backs = _mm_packs_epi32(backs, backs);
    int four = _mm_cvtsi128_si32(_mm_packus_epi16(backs, backs));
    memcpy(out->backs + at, &four, sizeof(four));
}

#endif

void binding_scatter_hits(const tl_ray_hit *hits, uint32_t count, const binding_hit_arrays *out, uint32_t first)
{
    uint32_t i = 0;
#ifdef BINDING_SSE2
    for (; i + 4 <= count; i += 4) {
        scatter_four(hits + i, out, (size_t)first + i);
    }
#endif
    for (; i < count; i++) {
        size_t at = (size_t)first + i;
        out->t[at] = hits[i].t;
        out->triangles[at] = (int32_t)hits[i].triangle; // TL_NO_TRIANGLE becomes -1
        out->barycentrics[2 * at] = hits[i].u;
        out->barycentrics[2 * at + 1] = hits[i].v;
        out->normals[at] = hits[i].normal;
        out->materials[at] = hits[i].material;
        out->backs[at] = hits[i].back;
    }
}
