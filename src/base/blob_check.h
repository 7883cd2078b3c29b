// SPDX-License-Identifier: MIT
//
// What the checks of all blobs begin with.

#ifndef TALUS_SRC_BASE_BLOB_CHECK_H
#define TALUS_SRC_BASE_BLOB_CHECK_H

#include <talus/base.h>

/// Whether untrusted bytes begin with the head of a blob of the expected magic and version, and hold the blob to its
/// end, at least `expected.size` bytes; more may follow. Fills a report, which may be NULL, from its beginning.
/// TL_ERR_ARGUMENT (NULL, or not at a multiple of `alignment`), TL_ERR_TRUNCATED, TL_ERR_MAGIC, TL_ERR_VERSION.
tl_result tl_blob_check_head(const void *bytes, uint64_t size, tl_blob expected, uint32_t alignment, tl_report *report);

#endif
