/* Answers `tartan match` about houses. */
#include "cli/house/judged.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/file.h"
#include "runtime/base/utf8.h"

/* Shows what is wrong with a line. */
static void bad_line(tn_job *job, tn_error *error, const char *name, const char *line, uint64_t number)
{
    if (error->status != TN_INVALID) {
        tn_job_fail(job, error);
        return;
    }
    tn_error_place(error, error->column ? number : 0, error->column, error->column_end);
    tn_report_error(tn_job_diagnostics(job), error, name, line, strlen(line));
    tn_job_status(job, error->status);
}

static void write_matches_json(const tn_house_matching *m, const bool *holds, const char *line, FILE *out)
{
    tn_json json = tn_json_file(out, TN_JSON_TIGHT);
    tn_json_object(&json, NULL);
    tn_json_string(&json, "house", line);
    tn_json_list(&json, "rules");
    for (size_t i = 0; i < m->count; i++)
        if (holds[i])
            tn_json_string(&json, NULL, m->rules[i].name);
    tn_json_list_end(&json);
    tn_json_object_end(&json);
    tn_json_end_line(&json);
}

static void write_matches(const tn_house_matching *m, const bool *holds, tn_house_answer answer, FILE *out)
{
    bool any = false;
    for (size_t i = 0; i < m->count; i++) {
        if (answer == TN_HOUSE_BITS)
            fputc(holds[i] ? '1' : '0', out);
        else if (holds[i] && answer != TN_HOUSE_ANY)
            fprintf(out, "%s%s", any ? " " : "", m->rules[i].name);
        any |= holds[i];
    }
    if (answer == TN_HOUSE_ANY)
        fputc(any ? '1' : '0', out);
    fputs(answer == TN_HOUSE_NAMES && !any ? "-\n" : "\n", out);
}

static void match_stream(tn_job *job, tn_house_matching *m, FILE *in, const char *path, tn_house_answer answer,
                         FILE *out)
{
    char *line = NULL;
    tn_error error = {0};
    size_t room = 0;
    uint64_t number = 0;
    bool *holds = malloc(m->count + 1), good = holds != NULL;
    for (ssize_t size; good && (size = getline(&line, &room, in)) >= 0;) {
        while (size > 0 && (line[size - 1] == '\n' || line[size - 1] == '\r'))
            line[--size] = '\0';
        number++;
        if (line[strspn(line, " \t")] == '\0' || line[0] == '#')
            continue;
        good = tn_house_match(m, line, holds, &error) == TN_OK;
        if (!good)
            bad_line(job, &error, path, line, number);
        if (good && answer == TN_HOUSE_JSON)
            write_matches_json(m, holds, line, out);
        else if (good)
            write_matches(m, holds, answer, out);
    }
    free(line);
    free(holds);
}

static void match_file(tn_job *job, tn_house_matching *m, const char *path, tn_house_answer answer, const char *output)
{
    tn_output out;
    tn_error error;
    bool standard = strcmp(path, "-") == 0;
    FILE *in = standard ? stdin : tn_file_stream(path);
    if (!in) {
        tn_cannot_read(path, errno, &error);
        tn_job_fail(job, &error);
        return;
    }
    if (tn_job_output(job, output, &out)) {
        match_stream(job, m, in, path, answer, out.stream);
        tn_job_close(job, &out, job->exit_code == TN_EXIT_DONE);
    }
    if (!standard)
        fclose(in);
}

void tn_job_match_houses(tn_job *job, const tn_texts *rules, const char *path, tn_house_answer answer,
                         const char *output, size_t max_length)
{
    tn_house_matching m;
    if (tn_job_answered(job, tn_house_matching_open(&job->session, rules, max_length, &m)))
        match_file(job, &m, path, answer, output);
    tn_house_matching_close(&m);
}
