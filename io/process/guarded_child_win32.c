// SPDX-License-Identifier: MIT
//
// Windows: the calling program is started anew. Its task and the pipe for the answer come in shared memory, whose
// handle stands on the command line.
//
// The child is in a job of its own, which limits its memory, refuses it further processes, and ends it with its parent.
// It inherits two handles and no more. Its time is watched by the parent.

#define _WIN32_WINNT 0x0602 // jobs within jobs: Windows 8

#include "io/process/guarded_child.h"

#include "io/files/windows_path.h"

#include <errno.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <windows.h>

enum {
    WAIT_MILLISECONDS = 250,
    PIPE_BYTES = 1 << 20,
    LONGEST_PATH = 32768,
    TICKS_A_SECOND = 10000000,
    PART_ALIGNMENT = 16
};

static const wchar_t child_option[] = L" --talus-child ";

struct tl_child_pipe {
    HANDLE end;
};

// Programs that have not called tl_child_main would run their own main in the child.
static atomic_bool can_start_child;

// The head of the shared memory; the task's parts come behind it, each at a multiple of PART_ALIGNMENT.
typedef struct errand {
    uint64_t code[2]; // work and function, from where the program is in memory
    HANDLE pipe;
    uint64_t part_sizes[TL_CHILD_MAX_PARTS];
    bool has_part[TL_CHILD_MAX_PARTS];
} errand;

static const char *image_base(void)
{
    HMODULE module = NULL;
    GetModuleHandleExW(GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS | GET_MODULE_HANDLE_EX_FLAG_UNCHANGED_REFCOUNT,
                       (const wchar_t *)(const void *)child_option, &module);
    return (const char *)module;
}

// --- the child ------------------------------------------------------------------------------------------------------

bool tl_child_send(tl_child_pipe *answer, const void *bytes, size_t size)
{
    const char *at = bytes;
    while (size > 0) {
        DWORD put;
        if (!WriteFile(answer->end, at, size < PIPE_BYTES ? (DWORD)size : PIPE_BYTES, &put, NULL)) {
            return false;
        }
        at += put;
        size -= put;
    }
    return true;
}

static void end_without_dialog(int number)
{
    (void)number;
    TerminateProcess(GetCurrentProcess(), 3); // abort's own code
}

static size_t round_up(size_t size)
{
    return (size + PART_ALIGNMENT - 1) / PART_ALIGNMENT * PART_ALIGNMENT;
}

static void do_errand(const errand *given)
{
    tl_child_task task;
    memset(&task, 0, sizeof task);
    const char *code[2] = { image_base() + given->code[0], image_base() + given->code[1] };
    memcpy(&task.work, &code[0], sizeof code[0]);
    memcpy(&task.function, &code[1], sizeof code[1]);
    const char *at = (const char *)given + round_up(sizeof *given);
    for (int i = 0; i < TL_CHILD_MAX_PARTS; i++) {
        task.parts[i] = given->has_part[i] ? at : NULL;
        task.part_sizes[i] = (size_t)given->part_sizes[i];
        at += round_up(task.part_sizes[i]);
    }
    tl_child_pipe answer = { given->pipe };
    task.work(&task, false, &answer);
}

bool tl_child_is_possible(void)
{
    return atomic_load(&can_start_child);
}

void tl_child_main(void)
{
    atomic_store(&can_start_child, true);
    const wchar_t *option = wcsstr(GetCommandLineW(), child_option);
    if (option == NULL) {
        return;
    }
    wchar_t *end;
    const HANDLE section = (HANDLE)(uintptr_t)wcstoul(option + wcslen(child_option), &end, 16); // handles have 32 bits
    const errand *given = *end == 0 ? MapViewOfFile(section, FILE_MAP_READ, 0, 0, 0) : NULL;
    if (given == NULL) {
        return; // the option is somebody else's
    }
    // Nobody is asked whether to debug it.
    SetErrorMode(SEM_FAILCRITICALERRORS | SEM_NOGPFAULTERRORBOX | SEM_NOOPENFILEERRORBOX);
    signal(SIGABRT, end_without_dialog);
    do_errand(given);
    TerminateProcess(GetCurrentProcess(), 0);
}

// --- the parent -----------------------------------------------------------------------------------------------------

// All that must be closed in the end; NULL where there is none.
struct tl_child {
    HANDLE section;
    HANDLE pipe;     // the parent's end
    HANDLE arrived;  // an event
    HANDLE far_pipe; // the child's end, until it has it
    HANDLE job;
    HANDLE process;
    bool has_ended; // has closed its end of the pipe
    tl_child_limits limits;
    ULONGLONG start;
};

static uint64_t processor_seconds(HANDLE process)
{
    FILETIME born, ended, system, user;
    if (!GetProcessTimes(process, &born, &ended, &system, &user)) {
        return 0;
    }
    const uint64_t in_system = (uint64_t)system.dwHighDateTime << 32 | system.dwLowDateTime;
    const uint64_t in_user = (uint64_t)user.dwHighDateTime << 32 | user.dwLowDateTime;
    return (in_system + in_user) / TICKS_A_SECOND;
}

ptrdiff_t tl_child_receive(tl_child *c, void *bytes, size_t size)
{
    OVERLAPPED read;
    memset(&read, 0, sizeof read);
    read.hEvent = c->arrived;
    DWORD got = 0;
    const DWORD wanted = size < PIPE_BYTES ? (DWORD)size : PIPE_BYTES;
    bool is_late = false, came = false;
    if (ReadFile(c->pipe, bytes, wanted, NULL, &read) || GetLastError() == ERROR_IO_PENDING) {
        is_late = WaitForSingleObject(c->arrived, WAIT_MILLISECONDS) != WAIT_OBJECT_0;
        if (is_late) {
            CancelIo(c->pipe); // it may still have come in between
        }
        came = GetOverlappedResult(c->pipe, &read, &got, TRUE) && got > 0;
    }
    c->has_ended = !came && !is_late;
    if (GetTickCount64() - c->start >= c->limits.wall_seconds * 1000 ||
        processor_seconds(c->process) >= c->limits.processor_seconds) {
        return TL_CHILD_OUT_OF_TIME;
    }
    return came ? (ptrdiff_t)got : c->has_ended ? TL_CHILD_ENDED : TL_CHILD_NOTHING_YET;
}

// A pipe whose near end can be waited at, which those of CreatePipe cannot.
static bool open_pipe(tl_child *c, SECURITY_ATTRIBUTES *inherited)
{
    static atomic_uint count;
    wchar_t name[64];
    swprintf(name, sizeof name / sizeof name[0], L"\\\\.\\pipe\\talus-%lu-%u", GetCurrentProcessId(),
             atomic_fetch_add(&count, 1));
    HANDLE near_end = CreateNamedPipeW(name, PIPE_ACCESS_INBOUND | FILE_FLAG_OVERLAPPED | FILE_FLAG_FIRST_PIPE_INSTANCE,
                                       PIPE_TYPE_BYTE | PIPE_REJECT_REMOTE_CLIENTS, 1, PIPE_BYTES, PIPE_BYTES, 0, NULL);
    if (near_end == INVALID_HANDLE_VALUE) {
        return false;
    }
    c->pipe = near_end;
    HANDLE far_end = CreateFileW(name, GENERIC_WRITE, 0, inherited, OPEN_EXISTING, 0, NULL);
    if (far_end == INVALID_HANDLE_VALUE) {
        return false;
    }
    c->far_pipe = far_end;
    c->arrived = CreateEventW(NULL, TRUE, FALSE, NULL);
    return c->arrived != NULL;
}

static bool write_errand(tl_child *c, const tl_child_task *task, SECURITY_ATTRIBUTES *inherited)
{
    size_t total = round_up(sizeof(errand));
    for (int i = 0; i < TL_CHILD_MAX_PARTS; i++) {
        total += round_up(task->part_sizes[i]);
    }
    c->section = CreateFileMappingW(INVALID_HANDLE_VALUE, inherited, PAGE_READWRITE, (DWORD)((uint64_t)total >> 32),
                                    (DWORD)total, NULL);
    errand *written = c->section != NULL ? MapViewOfFile(c->section, FILE_MAP_WRITE, 0, 0, total) : NULL;
    if (written == NULL) {
        return false;
    }
    const char *code[2];
    memcpy(&code[0], &task->work, sizeof code[0]);
    memcpy(&code[1], &task->function, sizeof code[1]);
    written->code[0] = (uint64_t)(code[0] - image_base());
    written->code[1] = (uint64_t)(code[1] - image_base());
    written->pipe = c->far_pipe;
    char *at = (char *)written + round_up(sizeof *written);
    for (int i = 0; i < TL_CHILD_MAX_PARTS; i++) {
        written->has_part[i] = task->parts[i] != NULL;
        written->part_sizes[i] = task->part_sizes[i];
        if (task->part_sizes[i] > 0) {
            memcpy(at, task->parts[i], task->part_sizes[i]);
        }
        at += round_up(task->part_sizes[i]);
    }
    UnmapViewOfFile(written);
    return true;
}

static bool make_job(tl_child *c)
{
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits;
    memset(&limits, 0, sizeof limits);
    limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_ACTIVE_PROCESS | JOB_OBJECT_LIMIT_PROCESS_MEMORY |
                                              JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE |
                                              JOB_OBJECT_LIMIT_DIE_ON_UNHANDLED_EXCEPTION;
    limits.BasicLimitInformation.ActiveProcessLimit = 1;
    limits.ProcessMemoryLimit = c->limits.memory_bytes < SIZE_MAX ? (SIZE_T)c->limits.memory_bytes : SIZE_MAX;
    c->job = CreateJobObjectW(NULL, NULL);
    return c->job != NULL &&
           SetInformationJobObject(c->job, JobObjectExtendedLimitInformation, &limits, sizeof limits) != 0;
}

// This program's path and the option, in quotes as a command line has them. False: it does not fit.
static bool write_command_line(const tl_child *c, wchar_t *path, wchar_t *line)
{
    const DWORD length = GetModuleFileNameW(NULL, path, LONGEST_PATH);
    return length > 0 && length < LONGEST_PATH &&
           swprintf(line, LONGEST_PATH, L"\"%ls\"%ls%lx", path, child_option, (unsigned long)(uintptr_t)c->section) > 0;
}

// Starts it with no more than the two handles, and lets it run when it is in its job.
static bool start_process(tl_child *c, const wchar_t *path, wchar_t *line, LPPROC_THREAD_ATTRIBUTE_LIST attributes)
{
    HANDLE handles[2] = { c->section, c->far_pipe };
    STARTUPINFOEXW startup;
    PROCESS_INFORMATION started;
    memset(&startup, 0, sizeof startup);
    startup.StartupInfo.cb = sizeof startup;
    startup.StartupInfo.dwFlags = STARTF_USESTDHANDLES; // its last words are not for the user
    startup.lpAttributeList = attributes;
    if (!UpdateProcThreadAttribute(attributes, 0, PROC_THREAD_ATTRIBUTE_HANDLE_LIST, handles, sizeof handles, NULL,
                                   NULL) ||
        !CreateProcessW(path, line, NULL, NULL, TRUE,
                        CREATE_SUSPENDED | CREATE_NO_WINDOW | EXTENDED_STARTUPINFO_PRESENT, NULL, NULL,
                        &startup.StartupInfo, &started)) {
        return false;
    }
    c->process = started.hProcess;
    const bool runs = AssignProcessToJobObject(c->job, c->process) && ResumeThread(started.hThread) != (DWORD)-1;
    CloseHandle(started.hThread);
    return runs;
}

static bool start_in_job(tl_child *c)
{
    SIZE_T size = 0;
    InitializeProcThreadAttributeList(NULL, 1, 0, &size);
    LPPROC_THREAD_ATTRIBUTE_LIST attributes = malloc(size);
    wchar_t *path = malloc(2 * LONGEST_PATH * sizeof *path);
    bool started = attributes != NULL && path != NULL && InitializeProcThreadAttributeList(attributes, 1, 0, &size);
    if (started) {
        wchar_t *line = path + LONGEST_PATH;
        started = make_job(c) && write_command_line(c, path, line) && start_process(c, path, line, attributes);
        DeleteProcThreadAttributeList(attributes);
    }
    free(attributes);
    free(path);
    return started;
}

static void close_handle(HANDLE handle)
{
    if (handle != NULL) {
        CloseHandle(handle);
    }
}

static void end_process(tl_child *c)
{
    if (c->process != NULL) {
        TerminateProcess(c->process, 1); // it has nothing more to say; how it ended, if it has, stands already
        WaitForSingleObject(c->process, INFINITE);
    }
}

static void free_child(tl_child *c)
{
    close_handle(c->process);
    close_handle(c->job);
    close_handle(c->far_pipe);
    close_handle(c->pipe);
    close_handle(c->arrived);
    close_handle(c->section);
    free(c);
}

int tl_child_start(const tl_child_task *task, const tl_child_limits *limits, tl_child **child_out)
{
    SECURITY_ATTRIBUTES inherited = { sizeof inherited, NULL, TRUE };
    tl_child *c = calloc(1, sizeof *c);
    if (c == NULL) {
        return ENOMEM;
    }
    c->limits = *limits;
    c->start = GetTickCount64();
    if (!open_pipe(c, &inherited) || !write_errand(c, task, &inherited) || !start_in_job(c)) {
        const int refused = tl_windows_errno();
        end_process(c);
        free_child(c);
        return refused;
    }
    CloseHandle(c->far_pipe); // so that the pipe ends with the child
    c->far_pipe = NULL;
    *child_out = c;
    return 0;
}

void tl_child_close(tl_child *c, tl_child_end *end_out)
{
    DWORD code = 0;
    if (c->has_ended) {
        WaitForSingleObject(c->process, WAIT_MILLISECONDS); // the pipe is closed a moment before it has its code
    }
    end_process(c);
    GetExitCodeProcess(c->process, &code);
    end_out->by_limit = code == 0xc0000017 /* STATUS_NO_MEMORY */ || code == 0xc000012d /* STATUS_COMMITMENT_LIMIT */;
    // Codes of exceptions, such as an access violation, are best known by their number.
    snprintf(end_out->how, sizeof end_out->how, "exit code %#lx", code);
    free_child(c);
}
