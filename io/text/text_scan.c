// SPDX-License-Identifier: MIT
//
// Cutting a text into the part that can be read in place and the rest.

#include "io/text/text_scan.h"

size_t tl_text_first_section(const char *text, size_t size)
{
    size_t at = size > TL_PARSE_PADDING ? size - TL_PARSE_PADDING : 0;
    for (; at > 0; at--) {
        // Not between CR and LF: the LF would count as a line of its own.
        if (text[at - 1] != '\n' && !(text[at - 1] == '\r' && text[at] != '\n')) {
            continue;
        }
        size_t line_end = at - 1;
        line_end -= line_end > 0 && text[line_end] == '\n' && text[line_end - 1] == '\r';
        if (line_end == 0 || text[line_end - 1] != '\\') {
            break;
        }
    }
    return at;
}

size_t tl_text_copy_last_section(const char *text, size_t size, char *block)
{
    memcpy(block, text, size);
    memset(block + size, '\n', TL_TEXT_LINE_ENDS);
    memset(block + size + TL_TEXT_LINE_ENDS, 0, TL_PARSE_PADDING);
    return size + TL_TEXT_LINE_ENDS;
}
