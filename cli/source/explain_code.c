/* tartan explain-code: what the code of an error or warning means. */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/job.h"
#include "cli/common/options.h"

static const struct {
    uint32_t code;
    const char *summary;
} codes[] = {
#define ERROR(NUMBER, NAME, SUMMARY) {NUMBER, SUMMARY},
#define WARNING(NUMBER, NAME, SUMMARY) {10000 + NUMBER, SUMMARY},
#include "runtime/base/codes.def"
#undef ERROR
#undef WARNING
};

enum { CODES = sizeof codes / sizeof *codes };

static const struct {
    uint32_t code;
    const char *text;
} examples[] = {
#define EXAMPLE(CODE, TEXT) {CODE, TEXT},
#include "code_examples.def"
#undef EXAMPLE
};

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

/* Its place among the codes; CODES where it is none. */
static size_t find(const char *name)
{
    size_t i = 0;
    char other[8];
    for (; i < CODES; i++) {
        tn_code_name(codes[i].code, other);
        if (strcmp(other, name) == 0)
            break;
    }
    return i;
}

static void report_unknown(tn_job *job, const char *word, const char *name)
{
    static const char *const list = "docs/errors.md";
    char(*names)[8] = calloc(CODES, sizeof *names);
    const char **pointers = calloc(CODES, sizeof *pointers);
    for (size_t i = 0; names && pointers && i < CODES; i++) {
        tn_code_name(codes[i].code, names[i]);
        pointers[i] = names[i];
    }
    const char *near = names && pointers ? tn_nearest(name, pointers, CODES) : NULL;
    tn_diagnostic *d = tn_job_usage(job, "there is no error or warning `%.60s`", word);
    if (near)
        tn_help(tn_job_diagnostics(job), d, "did you mean `%s`?", near);
    else
        tn_help(tn_job_diagnostics(job), d,
                "codes stand in brackets after `error` and `warning`: E0304, W012; %s lists them", list);
    free(pointers);
    free(names);
}

static void explain(size_t index, FILE *out)
{
    char name[8];
    bool warning = codes[index].code >= 10000;
    tn_code_name(codes[index].code, name);
    fprintf(out, "%s: %s\n", name, codes[index].summary);
    for (size_t i = 0; i < sizeof examples / sizeof *examples; i++)
        if (examples[i].code == codes[index].code)
            fprintf(out, "\nFor example:\n\n%s", examples[i].text);
    if (warning)
        fprintf(out, "\nWhere it is meant, write `allow %s` before a rule's `=`, or as a line of a library.\n", name);
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
            size_t index = find(name);
            if (index == CODES) {
                report_unknown(&job, common->operands.items[i], name);
                continue;
            }
            fputs(shown++ ? "\n" : "", output.stream);
            explain(index, output.stream);
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
