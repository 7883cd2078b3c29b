// SPDX-License-Identifier: MIT
//
// The intersection of two faces of few corners. Its corners are the corners of each face that are inside of the other,
// and the points where two edges cross.
//
// How far each corner is inside of each line of the other face tells all of these at once, as bits: no step waits for
// the one before, and no branch depends on the products but those that walk what was found. Cutting one face by each
// edge of the other (Sutherland and Hodgman, 1974) has fewer products, but how each cut turns out is as good as random
// for a pair that moves, and so were a dozen branches. What lies beyond the patch's limit is left out before it is
// computed: an edge whose ends do crosses nothing that counts.
//
// A corner within the gap of a line is inside of it, and an edge of A crosses a line where one end only is outside by
// more than the gap; so edges that coincide have no random crossings. Points that coincide are found once.

#include "convex/contact/face_patch.h"

#include "base/cpu.h"

#define TL_FACE_CLIP tl_face_clip_base
#include "convex/contact/face_clip.inl"

bool tl_face_clip(const tl_face *a, const tl_face *b, const tl_patch_heights heights[2], tl_patch *patch)
{
#if TL_CPU_LEVELS >= 2
    if (tl_cpu_has_avx2()) {
        return tl_face_clip_avx2(a, b, heights, patch);
    }
#endif
    return tl_face_clip_base(a, b, heights, patch);
}
