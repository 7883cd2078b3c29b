// SPDX-License-Identifier: MIT
//
// Blocks of lines: parsed in order, answered in chunks that each fill a text of their own, printed chunk by chunk.

#include "cli/shared/line_batch.h"

#include "cli/options/parse_value.h"
#include "cli/shared/interrupt.h"
#include "cli/shared/line_input.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CHUNK_LINES = 128, BLOCK_CHUNKS = 64, BLOCK_LINES = CHUNK_LINES * BLOCK_CHUNKS };

typedef struct question {
    float numbers[TL_MAX_LINE_NUMBERS];
    uint32_t count;
} question;

typedef struct line_block {
    const tl_batch *batch;
    const tl_pack_frame *frame;
    uint32_t count;
    question questions[BLOCK_LINES];
    tl_text answers[BLOCK_CHUNKS];
} line_block;

static void answer_chunk(uint32_t index, uint32_t worker, void *user)
{
    line_block *b = user;
    uint32_t end = (index + 1) * CHUNK_LINES < b->count ? (index + 1) * CHUNK_LINES : b->count;
    for (uint32_t i = index * CHUNK_LINES; i < end; ++i) {
        b->batch->answer(b->questions[i].numbers, b->questions[i].count, &b->answers[index], worker, b->batch->user);
    }
}

// Answers and prints what the block holds, and empties it.
static tl_exit answer_block(tl_cli *cli, line_block *b)
{
    uint32_t chunks = (b->count + CHUNK_LINES - 1) / CHUNK_LINES;
    cli->host.tasks->run(answer_chunk, chunks, b, cli->host.tasks->user);
    for (uint32_t i = 0; i < chunks; ++i) {
        if (b->answers[i].failed) {
            return tl_cli_fail(cli, TL_EXIT_MEMORY, "out of memory");
        }
        if (fwrite(b->answers[i].bytes, 1, b->answers[i].size, stdout) != b->answers[i].size) {
            return tl_cli_fail(cli, TL_EXIT_IO, "cannot write standard output: %s", strerror(errno));
        }
        b->answers[i].size = 0;
    }
    b->count = 0;
    return TL_EXIT_OK;
}

// Numbers of the level's own coordinates to those that were baked, three by three.
static void enter_frame(const tl_pack_frame *frame, const tl_batch *batch, const double *in, uint32_t count, float *out)
{
    for (uint32_t i = 0; i + 3 <= count; i += 3) {
        const tl_vec3 v = batch->directions >> (i / 3) & 1u
                              ? tl_pack_turn_in((tl_pack_axes)frame->axes,
                                                tl_vec3_make((float)in[i], (float)in[i + 1], (float)in[i + 2]))
                              : tl_pack_place_in(frame, in + i);
        out[i] = v.x;
        out[i + 1] = v.y;
        out[i + 2] = v.z;
    }
}

// Takes one line into the block. Comments and empty lines are none.
static tl_exit take_question(tl_cli *cli, line_block *b, const tl_line_input *input, const char *line)
{
    const char *text = line + strspn(line, " \t");
    if (*text == '\0' || *text == '#') {
        return TL_EXIT_OK;
    }
    question *q = &b->questions[b->count];
    const char *bad = NULL;
    const char *reason = tl_parse_float_words(text, q->numbers, TL_MAX_LINE_NUMBERS, &q->count, &bad);
    if (reason == NULL && (q->count == b->batch->min_numbers || q->count == b->batch->max_numbers)) {
        if (b->frame != NULL) {
            double exact[TL_MAX_LINE_NUMBERS];
            tl_parse_double_words(text, exact, q->count);
            enter_frame(b->frame, b->batch, exact, q->count, q->numbers);
        }
        b->count++;
        return TL_EXIT_OK;
    }
    tl_exit code = answer_block(cli, b);
    if (code != TL_EXIT_OK) {
        return code;
    }
    if (reason != NULL) {
        return tl_cli_fail(cli, TL_EXIT_DATA, "%s:%llu: '%.*s' %s; a line holds: %s", input->path,
                           (unsigned long long)input->line, (int)strcspn(bad, " \t,"), bad, reason, b->batch->wanted);
    }
    return tl_cli_fail(cli, TL_EXIT_DATA, "%s:%llu: %u numbers found; a line holds: %s", input->path,
                       (unsigned long long)input->line, q->count, b->batch->wanted);
}

static tl_exit run_lines(tl_cli *cli, line_block *b, tl_line_input *input)
{
    for (;;) {
        if (tl_interrupted()) {
            return tl_cli_fail(cli, TL_EXIT_CANCELLED, "cancelled");
        }
        tl_exit code = TL_EXIT_OK;
        if (b->count == BLOCK_LINES) {
            code = answer_block(cli, b);
        } else if (tl_line_input_would_wait(input)) {
            code = answer_block(cli, b);
            fflush(stdout);
        }
        if (code != TL_EXIT_OK) {
            return code;
        }
        char *line;
        tl_io_error error;
        memset(&error, 0, sizeof(error));
        tl_result result = tl_line_input_next(input, &line, &error);
        if (result == TL_NOT_FOUND) {
            return answer_block(cli, b);
        }
        if (result != TL_OK) {
            code = answer_block(cli, b);
            return code != TL_EXIT_OK ? code : tl_cli_fail_io(cli, &error);
        }
        code = take_question(cli, b, input, line);
        if (code != TL_EXIT_OK) {
            return code;
        }
    }
}

static tl_exit answer_one(tl_cli *cli, const tl_batch *batch, const float *numbers)
{
    tl_text text;
    memset(&text, 0, sizeof(text));
    float turned[6];
    if (cli->frame != NULL && numbers != NULL) {
        double exact[6];
        for (uint32_t i = 0; i < batch->min_numbers / 3; ++i) {
            tl_parse_double_triple(cli->arguments.words[1 + i], exact + i * 3);
        }
        enter_frame(cli->frame, batch, exact, batch->min_numbers / 3 * 3, turned);
        numbers = turned;
    }
    text.frame = cli->frame;
    const bool yes = batch->answer(numbers, batch->min_numbers, &text, 0, batch->user);
    const tl_exit code = text.failed ? tl_cli_fail(cli, TL_EXIT_MEMORY, "out of memory")
                         : yes       ? TL_EXIT_OK
                                     : TL_EXIT_NEGATIVE;
    fwrite(text.bytes, 1, text.size, stdout);
    tl_text_free(&text);
    return code;
}

static tl_exit answer_lines(tl_cli *cli, const tl_batch *batch)
{
    tl_io_error error;
    memset(&error, 0, sizeof(error));
    tl_line_input input;
    if (tl_line_input_open(batch->path, &input, &error) != TL_OK) {
        return tl_cli_fail_io(cli, &error);
    }
    tl_exit code = TL_EXIT_MEMORY;
    line_block *b = calloc(1, sizeof(*b));
    if (b != NULL) {
        b->batch = batch;
        b->frame = cli->frame;
        for (uint32_t i = 0; i < BLOCK_CHUNKS; ++i) {
            b->answers[i].frame = cli->frame;
        }
        tl_progress_end(&cli->progress);
        code = run_lines(cli, b, &input);
        for (uint32_t i = 0; i < BLOCK_CHUNKS; ++i) {
            tl_text_free(&b->answers[i]);
        }
        free(b);
    } else {
        tl_cli_fail(cli, TL_EXIT_MEMORY, "out of memory");
    }
    tl_line_input_close(&input);
    return code;
}

tl_exit tl_batch_run(tl_cli *cli, const tl_batch *batch, const float *numbers)
{
    return batch->path != NULL ? answer_lines(cli, batch) : answer_one(cli, batch, numbers);
}

bool tl_question_read(tl_cli *cli, const tl_question_words *words, const char *path, float *numbers_out,
                      tl_exit *exit_out)
{
    const uint32_t given = cli->arguments.count - 1, wanted = words->second != NULL ? 2 : 1;
    if (given != (path != NULL ? 0 : wanted)) {
        *exit_out =
            tl_cli_fail(cli, TL_EXIT_USAGE, "give the %s%s%s behind FILE, or a file of many with --%s", words->first,
                        wanted == 2 ? " and the " : "", wanted == 2 ? words->second : "", words->option);
        return false;
    }
    return path != NULL || (tl_cli_read_triple(cli, 1, words->first, numbers_out, exit_out) &&
                            (wanted == 1 || tl_cli_read_triple(cli, 2, words->second, numbers_out + 3, exit_out)));
}
