// SPDX-License-Identifier: MIT
//
// Magic and version are tested before the length, so bytes of another kind are named as such even when they are cut
// off.

#include "base/blob_check.h"

#include "base/host.h"

static tl_result check_blob_head(const tl_blob *blob, uint64_t size, tl_blob expected)
{
    if (size < sizeof *blob) {
        return TL_ERR_TRUNCATED;
    }
    if (blob->magic != expected.magic) {
        return TL_ERR_MAGIC;
    }
    if (blob->version != expected.version) {
        return TL_ERR_VERSION;
    }
    return size >= expected.size && size >= blob->size ? TL_OK : TL_ERR_TRUNCATED;
}

tl_result tl_blob_check_head(const void *bytes, uint64_t size, tl_blob expected, uint32_t alignment, tl_report *report)
{
    tl_report_begin(report, "check");
    if (bytes == NULL || (uintptr_t)bytes % alignment != 0) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "bytes", "give bytes as aligned as the check asks for");
    }
    const tl_result result = check_blob_head(bytes, size, expected);
    return result == TL_OK ? TL_OK
                           : tl_report_fail(report, result, "head", TL_NO_ELEMENT,
                                            result == TL_ERR_TRUNCATED ? "copy or bake the file again"
                                                                       : "bake it again with this version");
}
