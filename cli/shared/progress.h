// SPDX-License-Identifier: MIT
//
// What the user sees of a running build, and the clock that the core does not have: how long each stage took.

#ifndef TALUS_CLI_PROGRESS_H
#define TALUS_CLI_PROGRESS_H

#include <talus/base.h>

typedef enum tl_progress_style {
    TL_PROGRESS_AUTO, ///< a line when standard error is a terminal, else nothing
    TL_PROGRESS_NONE,
    TL_PROGRESS_LINE, ///< one line that is written over, and erased at the end
    TL_PROGRESS_JSON  ///< one JSON object a line on standard error
} tl_progress_style;

enum { TL_MAX_STAGES = 48 };

typedef struct tl_stage_time {
    const char *stage; ///< as the build called it; static
    double seconds;    ///< summed over its runs
} tl_stage_time;

/// One hook for all that a command runs. Zero, then tl_progress_begin.
typedef struct tl_progress_display {
    tl_progress hook;
    tl_progress_style style;
    const char *command;
    const char *stage; ///< the running one, or NULL
    double stage_began;
    double last_shown;
    bool line_shown;
    tl_stage_time times[TL_MAX_STAGES]; ///< by first appearance
    uint32_t time_count;
} tl_progress_display;

/// Seconds on a clock that never goes back.
double tl_clock_seconds(void);

void tl_progress_begin(tl_progress_display *display, tl_progress_style style, const char *command);
/// Ends the running stage and erases the line. May be called more than once.
void tl_progress_end(tl_progress_display *display);

/// Summed time of a stage, 0 when it never ran.
double tl_progress_seconds(const tl_progress_display *display, const char *stage);

#endif
