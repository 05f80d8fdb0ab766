/* tartan explain-code: what the code of an error or warning means. */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/job.h"
#include "cli/common/options.h"
#include "cli/source/codes.h"

/* "e304", "E0304", "[E0304]", "304" -> "E0304"; a text that has no such form is only made capital. */
static void spell(const char *word, char *name, size_t size)
{
    char letter = 'E', *end;
    if (*word == '[')
        word++;
    const char *digits = word;
    if (isalpha((unsigned char)*word)) {
        letter = (char)toupper((unsigned char)*word);
        digits++;
    }
    unsigned long number = strtoul(digits, &end, 10);
    bool good = isdigit((unsigned char)*digits) && (*end == '\0' || strcmp(end, "]") == 0) && number < 10000;
    if (good && (letter == 'E' || letter == 'W'))
        tn_code_name((uint32_t)number + (letter == 'W' ? 10000 : 0), name);
    else
        snprintf(name, size, "%.30s", word);
}

/* NULL if there is no such code. */
static const tn_code_row *find(const char *name)
{
    size_t count;
    const tn_code_row *rows = tn_code_rows(&count);
    for (size_t i = 0; i < count; i++) {
        char other[8];
        tn_code_name(rows[i].code, other);
        if (strcmp(other, name) == 0)
            return &rows[i];
    }
    return NULL;
}

static void report_unknown(tn_job *job, const char *word, const char *name)
{
    static const char *const list = "docs/errors.md";
    size_t count;
    const tn_code_row *rows = tn_code_rows(&count);
    char(*names)[8] = calloc(count, sizeof *names);
    const char **pointers = calloc(count, sizeof *pointers);
    for (size_t i = 0; names && pointers && i < count; i++) {
        tn_code_name(rows[i].code, names[i]);
        pointers[i] = names[i];
    }
    const char *near = names && pointers ? tn_nearest(name, pointers, count) : NULL;
    tn_diagnostic *d = tn_job_usage(job, "there is no error or warning `%.60s`", word);
    if (near)
        tn_help(tn_job_diagnostics(job), d, "did you mean `%s`?", near);
    else
        tn_help(tn_job_diagnostics(job), d,
                "codes stand in brackets after `error` and `warning`: E0304, W012; %s lists them", list);
    free(pointers);
    free(names);
}

static bool explain(const tn_code_row *row, FILE *out)
{
    tn_buffer text = {0};
    tn_code_explain(row, &text);
    bool good = !text.failed;
    if (good)
        fwrite(text.data, 1, text.size, out);
    free(text.data);
    return good;
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    tn_job job;
    tn_output output;
    tn_job_begin(&job, common);
    if (tn_job_output(&job, NULL, &output)) {
        for (size_t i = 0, shown = 0; i < common->operands.count; i++) {
            char name[32];
            spell(common->operands.items[i], name, sizeof name);
            const tn_code_row *row = find(name);
            if (!row) {
                report_unknown(&job, common->operands.items[i], name);
                continue;
            }
            fputs(shown++ ? "\n" : "", output.stream);
            tn_error error;
            if (!explain(row, output.stream) && tn_fail_memory(&error))
                tn_job_fail(&job, &error);
        }
        tn_job_commit(&job, &output);
    }
    return tn_job_end(&job);
}

const tn_command tn_command_explain_code = {
    .name = "explain-code",
    .summary = "say what the code of an error or warning means",
    .usage = "CODE...",
    .description =
        "Every error and warning has a code, such as E0304 or W012. This prints what it is about, and what "
        "is said of a wrong file, with the place, the reason and a likely fix. docs/errors.md has all codes.",
    .example = "$ tartan explain-code E0304",
    .settings_size = sizeof(tn_settings),
    .operands = "at least one CODE",
    .operands_min = 1,
    .operands_max = SIZE_MAX,
    .run = run,
};
