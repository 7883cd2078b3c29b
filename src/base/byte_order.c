// SPDX-License-Identifier: MIT

#include "base/byte_order.h"

#include "base/assert.h"

#include <string.h>

static void reverse_bytes(uint8_t *bytes, uint32_t width)
{
    for (uint32_t low = 0, high = width - 1; low < high; low++, high--) {
        const uint8_t byte = bytes[low];
        bytes[low] = bytes[high];
        bytes[high] = byte;
    }
}

void tl_swap_words(tl_byte_swap *swap, uint64_t offset, uint64_t count, uint32_t width)
{
    TL_ASSERT(width == 1 || width == 2 || width == 4 || width == 8);
    if (!swap->fits || offset > swap->size || count > (swap->size - offset) / width) {
        swap->fits = false;
        return;
    }
    uint8_t *at = swap->bytes + offset;
    for (uint64_t i = 0; i < count && width > 1; i++) {
        reverse_bytes(at + i * width, width);
    }
}

static uint32_t element_size(const tl_word_run *runs, uint32_t run_count)
{
    uint32_t size = 0;
    for (uint32_t i = 0; i < run_count; i++) {
        size += runs[i].width * runs[i].count;
    }
    return size;
}

void tl_swap_elements(tl_byte_swap *swap, uint64_t offset, uint64_t count, const tl_word_run *runs, uint32_t run_count)
{
    const uint32_t size = element_size(runs, run_count);
    if (!swap->fits || offset > swap->size || count > (swap->size - offset) / size) {
        swap->fits = false;
        return;
    }
    for (uint64_t i = 0; i < count; i++) {
        for (uint32_t k = 0; k < run_count; k++) {
            tl_swap_words(swap, offset, runs[k].count, runs[k].width);
            offset += (uint64_t)runs[k].count * runs[k].width;
        }
    }
}

void tl_swap_head(tl_byte_swap *swap, const tl_word_run *runs, uint32_t run_count, void *head_out, size_t head_size)
{
    TL_ASSERT(element_size(runs, run_count) == head_size);
    memset(head_out, 0, head_size);
    if (!swap->fits || swap->size < head_size) {
        swap->fits = false;
        return;
    }
    if (!swap->to_host) {
        memcpy(head_out, swap->bytes, head_size);
    }
    tl_swap_elements(swap, 0, 1, runs, run_count);
    if (swap->to_host) {
        memcpy(head_out, swap->bytes, head_size);
    }
}
