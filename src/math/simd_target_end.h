// SPDX-License-Identifier: MIT
//
// Ends what simd_target.h began.

#if defined(__clang__)
#pragma clang attribute pop
#elif defined(__GNUC__)
#pragma GCC pop_options
#endif
#undef TL_SIMD_LEVEL
