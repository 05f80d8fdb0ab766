/* Finds the notation of a file, and compiles it. */
#include "compiler/compile.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "compiler/common/diagnostic.h"
#include "compiler/common/import.h"
#include "compiler/common/lexical.h"

/* ==== the table of notations, and finding the one that a text is written in */

#define NOTATION(ID, ...) extern const tn_front tn_front_##ID;
#include "compiler/notations.def"

const tn_notation tn_notations[] = {
#define NOTATION(ID, EXTENSION, WORD, WHAT, COMMANDS, PAGE, MANUAL, SUMMARY)                                           \
    {#ID, EXTENSION, WORD, WHAT, COMMANDS, MANUAL, &tn_front_##ID},
#include "compiler/notations.def"
};
const size_t tn_notation_count = sizeof tn_notations / sizeof *tn_notations;

/* ---- by what the text says */

static bool is_space(char c)
{
    return c != '\0' && strchr(" \t\r\n\f\v", c);
}

/* The bytes at `at` that are read as one: white space, a comment, a text in quotes, a sign or a word. */
static size_t piece_size(const char *text, size_t size, size_t at, bool *word)
{
    static const char ends[] = " \t\r\n\f\v#\"(),{}";
    size_t end = at + 1;
    *word = !memchr(ends, text[at], sizeof ends - 1);
    if (text[at] == '#')
        while (end < size && text[end] != '\r' && text[end] != '\n')
            end++;
    if (text[at] == '"') {
        while (end < size && !memchr("\"\r\n", text[end], 3))
            end++;
        end += end < size && text[end] == '"';
    }
    while (*word && end < size && !memchr(ends, text[end], sizeof ends - 1))
        end++;
    return end - at;
}

/* Does a block in the text start with the word? Comments and texts in quotes do not count. */
static bool has_block(const char *text, size_t size, const char *word)
{
    size_t length = strlen(word), piece;
    bool is_word;
    for (size_t at = tn_text_mark(text, size); at < size; at += piece) {
        piece = piece_size(text, size, at, &is_word);
        if (!is_word || piece != length || strncasecmp(text + at, word, length) != 0)
            continue;
        size_t next = at + piece;
        while (next < size && is_space(text[next]))
            next++;
        if (next < size && text[next] == '{')
            return true;
    }
    return false;
}

/* ---- by name */

static const tn_notation *find(const char *extension, const char *text, size_t size)
{
    const tn_notation *found = NULL;
    for (size_t i = 0; i < tn_notation_count; i++) {
        const tn_notation *row = &tn_notations[i];
        if (strcmp(row->extension, extension) != 0)
            continue;
        if (tn_notation_is_main(row))
            found = row;
        else if (has_block(text, size, row->word))
            return row;
    }
    return found;
}

const tn_notation *tn_notation_of(const char *path, const char *text, size_t size)
{
    return find(tn_path_extension(path), text, size);
}

const tn_notation *tn_notation_or_first(const char *path, const char *text, size_t size)
{
    const tn_notation *found = tn_notation_of(path, text, size);
    return found ? found : &tn_notations[0];
}

const tn_notation *tn_notation_of_language(const char *language, const char *text, size_t size)
{
    for (size_t i = 0; i < tn_notation_count; i++)
        if (strcmp(tn_notation_language(&tn_notations[i]), language) == 0)
            return find(tn_notations[i].extension, text, size);
    return NULL;
}

const tn_notation *tn_notation_of_module(const tn_module *module)
{
    for (size_t i = 0; i < tn_notation_count; i++)
        if (tn_notations[i].front->made(module))
            return &tn_notations[i];
    return NULL;
}

/* ---- what it is for */

bool tn_notation_takes(const tn_notation *notation, const char *command)
{
    size_t length = strlen(command);
    for (const char *at = notation->commands; *at; at += strspn(at, " ")) {
        size_t size = strcspn(at, " ");
        if (size == length && memcmp(at, command, length) == 0)
            return true;
        at += size;
    }
    return false;
}

void tn_notation_help(const tn_notation *notation, char *text, size_t size)
{
    size_t used = (size_t)snprintf(text, size, "%s:", notation->what), count = 0;
    for (const char *at = notation->commands; *at && used < size; count++) {
        size_t length = strcspn(at, " ");
        bool last = at[length] == '\0';
        used += (size_t)snprintf(text + used, size - used, "%s `tartan %.*s`",
                                 count == 0 ? ""
                                 : last     ? " and"
                                            : ",",
                                 (int)length, at);
        at += length + !last;
    }
    if (used < size)
        snprintf(text + used, size - used, count > 1 ? " take it" : " takes it");
}

/* ==== compiles a text: hands it to its notation's front end, and reports what fails without a place of its own */

/* Values are given to params of a text that can have none. */
static tn_status refuse_settings(tn_compilation *compilation, const tn_compile_options *options)
{
    tn_diagnostic *d =
        tn_report_bare(&compilation->diagnostics, TN_ERROR, E_USAGE, "--set %.200s: %.200s has no params",
                       options->params.items[0], compilation->input->name);
    tn_help(&compilation->diagnostics, d, "only .plan files have them: leave --set out");
    return TN_INVALID;
}

tn_status tn_compile_text(const tn_notation *notation, const tn_input *input, const tn_compile_options *options,
                          tn_compilation *compilation)
{
    tn_error error = {0};
    tn_status status = tn_compilation_start(compilation, notation, input, &error);
    if (status == TN_OK)
        status = tn_watch_check(options->watch, &error);
    if (status == TN_OK && options->params.count > 0 && !notation->front->settable)
        status = refuse_settings(compilation, options);
    else if (status == TN_OK)
        status = notation->front->compile(compilation, options, &error);
    if (status != TN_OK && status != TN_INVALID && tn_watch_stopped(options->watch))
        status = tn_fail_stopped(options->watch, &error); /* a front end takes that for want of memory */
    if (status != TN_OK && status != TN_INVALID)
        tn_report_error(&compilation->diagnostics, &error, input->name, NULL, 0);
    tn_diagnostics_sort(&compilation->diagnostics);
    compilation->input = NULL;
    return status;
}
