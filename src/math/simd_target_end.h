// SPDX-License-Identifier: MIT
//
// Ends what simd_target.h began.

#if TL_CPU_LEVELS > TL_CPU_BASE_LEVEL
#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif
#undef TL_SIMD_LEVEL
