// SPDX-License-Identifier: MIT
//
// Windows calls the handler on a thread of its own: there is no read to break off, and nothing is unsafe to call. The
// second Ctrl-C is left to the system, which ends the program.

#include "cli/shared/interrupt.h"

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <io.h>
#include <stdatomic.h>
#include <stdio.h>

enum { CANCELLED = 130 }; // TL_EXIT_CANCELLED

static atomic_bool interrupted;
static atomic_bool ends;

static BOOL WINAPI on_console_event(DWORD event)
{
    if (event != CTRL_C_EVENT && event != CTRL_BREAK_EVENT && event != CTRL_CLOSE_EVENT) {
        return FALSE;
    }
    if (atomic_load(&ends)) {
        static const char text[] = "talus: cancelled\n";
        _write(_fileno(stderr), text, sizeof text - 1);
        ExitProcess(CANCELLED);
    }
    return !atomic_exchange(&interrupted, true);
}

void tl_interrupt_catch(void)
{
    SetConsoleCtrlHandler(on_console_event, TRUE);
}

bool tl_interrupted(void)
{
    return atomic_load(&interrupted);
}

void tl_interrupt_ends(void)
{
    atomic_store(&ends, true);
    if (tl_interrupted()) {
        ExitProcess(CANCELLED);
    }
}
