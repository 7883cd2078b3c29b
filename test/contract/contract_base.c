// SPDX-License-Identifier: MIT
//
// base.h.

#include "contract.h"

static tl_result blob_free(contract_run *run)
{
    (void)run;
    tl_blob_free(NULL);
    return TL_OK;
}

const contract_entry CONTRACT_TABLE_base[] = {
    { "tl_result_name", 0, 0, 0, NULL, NULL, "a constant text for every number: test_base.c" },
    { "tl_result_text", 0, 0, 0, NULL, NULL, "a constant text for every number: test_base.c" },
    { "tl_version", 0, 0, 0, NULL, NULL, "a constant text" },
    { "tl_blob_free", CONTRACT_BIT(NULL_FREE), 0, 0, NULL, blob_free, NULL },
    { 0 },
};
