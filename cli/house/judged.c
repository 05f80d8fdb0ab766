/* Answers `tartan match` and `tartan explain` about houses. */
#include "cli/house/judged.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/file.h"
#include "runtime/base/file_error.h"
#include "runtime/base/utf8.h"

/* ---- rules */

/* A rule that is asked about: of houses, or of their plans. */
typedef struct asked_rule {
    const char *name;
    uint32_t holds;
} asked_rule;

typedef struct asked_rules {
    asked_rule *items;
    size_t count;
    uint32_t form;
} asked_rules;

bool tn_job_matches_houses(const tn_job *job, const tn_option_list *rules)
{
    const tn_module *module = job->opened.module;
    for (size_t i = 0; i < rules->count; i++)
        if (tn_house_rule_find(module, rules->items[i]) != TN_NO_RECORD)
            return true;
    for (uint32_t i = 0; rules->count == 0 && i < module->HOUSE_RULE_count; i++)
        if (!(module->HOUSE_RULE_records[i].flags & TN_IMPORTED))
            return true;
    return false;
}

static bool add_rule(tn_job *job, asked_rules *asked, const char *name, uint32_t holds, uint32_t form)
{
    if (asked->form != TN_NO_RECORD && form != TN_NO_RECORD && form != asked->form) {
        tn_diagnostic *d = tn_job_usage(job, "`%.80s` is about houses of another form than the rules before", name);
        tn_help(tn_job_diagnostics(job), d, "choose rules about one form with --rule");
        return false;
    }
    asked->form = form == TN_NO_RECORD ? asked->form : form;
    asked->items[asked->count++] = (asked_rule){name, holds};
    return true;
}

static bool add_named(tn_job *job, asked_rules *asked, const char *name)
{
    const tn_module *module = job->opened.module;
    uint32_t found = tn_house_rule_find(module, name);
    if (found != TN_NO_RECORD)
        return add_rule(job, asked, name, module->HOUSE_RULE_records[found].holds,
                        module->HOUSE_RULE_records[found].form);
    for (uint32_t i = 0; i < module->RULE_count; i++)
        if (strcmp(tn_text(module, module->RULE_records[i].name), name) == 0)
            return add_rule(job, asked, name, module->RULE_records[i].holds, TN_NO_RECORD);
    tn_diagnostic *d = tn_job_usage(job, "the file has no rule `%.80s`", name);
    tn_help(tn_job_diagnostics(job), d, "name a rule of the file, or of one that it uses");
    return false;
}

static bool add_own(tn_job *job, asked_rules *asked)
{
    const tn_module *module = job->opened.module;
    bool good = true;
    for (uint32_t i = 0; good && i < module->HOUSE_RULE_count; i++) {
        const tn_house_rule_record *rule = &module->HOUSE_RULE_records[i];
        if (!(rule->flags & TN_IMPORTED))
            good = add_rule(job, asked, tn_text(module, rule->name), rule->holds, rule->form);
    }
    return good;
}

/* Those of --rule, or all about houses that the file itself has. The caller frees asked->items. */
static bool choose_rules(tn_job *job, const tn_option_list *rules, asked_rules *asked)
{
    const tn_module *module = job->opened.module;
    *asked = (asked_rules){.form = TN_NO_RECORD};
    asked->items = malloc((rules->count + module->HOUSE_RULE_count + 1) * sizeof *asked->items);
    if (!asked->items) {
        tn_error error;
        tn_fail_memory(&error);
        tn_job_fail(job, &error);
        return false;
    }
    bool good = rules->count > 0 || add_own(job, asked);
    for (size_t i = 0; good && i < rules->count; i++)
        good = add_named(job, asked, rules->items[i]);
    return good;
}

/* ---- houses */

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

/* What each rule says of the house of a line. False: reported. */
static bool judge_line(tn_job *job, tn_house_judge *judge, const asked_rules *asked, const char *name, const char *line,
                       uint64_t number, size_t max_length, bool *holds)
{
    tn_house house;
    tn_error error = {0};
    tn_status status = tn_house_read_open(&judge->form, line, strlen(line), max_length, &house, &error);
    if (status == TN_OK)
        status = tn_house_rules_start(judge->rules, &house, &error);
    for (size_t i = 0; status == TN_OK && i < asked->count; i++)
        status = tn_house_rules_hold(judge->rules, asked->items[i].holds, &holds[i], &error);
    if (status != TN_OK)
        bad_line(job, &error, name, line, number);
    tn_house_clear(&house);
    return status == TN_OK;
}

static void write_matches_json(const asked_rules *asked, const bool *holds, const char *line, FILE *out)
{
    tn_json json = tn_json_file(out, TN_JSON_TIGHT);
    tn_json_object(&json, NULL);
    tn_json_string(&json, "house", line);
    tn_json_list(&json, "rules");
    for (size_t i = 0; i < asked->count; i++)
        if (holds[i])
            tn_json_string(&json, NULL, asked->items[i].name);
    tn_json_list_end(&json);
    tn_json_object_end(&json);
    tn_json_end_line(&json);
}

static void write_matches(const asked_rules *asked, const bool *holds, tn_house_answer answer, FILE *out)
{
    bool any = false;
    for (size_t i = 0; i < asked->count; i++) {
        if (answer == TN_HOUSE_BITS)
            fputc(holds[i] ? '1' : '0', out);
        else if (holds[i] && answer != TN_HOUSE_ANY)
            fprintf(out, "%s%s", any ? " " : "", asked->items[i].name);
        any |= holds[i];
    }
    if (answer == TN_HOUSE_ANY)
        fputc(any ? '1' : '0', out);
    fputs(answer == TN_HOUSE_NAMES && !any ? "-\n" : "\n", out);
}

static void match_stream(tn_job *job, tn_house_judge *judge, const asked_rules *asked, FILE *in, const char *path,
                         tn_house_answer answer, FILE *out, size_t max_length)
{
    char *line = NULL;
    size_t room = 0;
    uint64_t number = 0;
    bool *holds = malloc(asked->count + 1), good = holds != NULL;
    for (ssize_t size; good && (size = getline(&line, &room, in)) >= 0;) {
        while (size > 0 && (line[size - 1] == '\n' || line[size - 1] == '\r'))
            line[--size] = '\0';
        number++;
        if (line[strspn(line, " \t")] == '\0' || line[0] == '#')
            continue;
        good = judge_line(job, judge, asked, path, line, number, max_length, holds);
        if (good && answer == TN_HOUSE_JSON)
            write_matches_json(asked, holds, line, out);
        else if (good)
            write_matches(asked, holds, answer, out);
    }
    free(line);
    free(holds);
}

static void match_file(tn_job *job, tn_house_judge *judge, const asked_rules *asked, const char *path,
                       tn_house_answer answer, const char *output, size_t max_length)
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
        match_stream(job, judge, asked, in, path, answer, out.stream, max_length);
        tn_job_close(job, &out, job->exit_code == TN_EXIT_DONE);
    }
    if (!standard)
        fclose(in);
}

void tn_job_match_houses(tn_job *job, const tn_option_list *rules, const char *path, tn_house_answer answer,
                         const char *output, size_t max_length)
{
    asked_rules asked;
    tn_house_judge judge = {0};
    tn_error error;
    if (choose_rules(job, rules, &asked)) {
        if (tn_house_judge_open(job->opened.module, asked.form, max_length, &judge, &error) == TN_OK)
            match_file(job, &judge, &asked, path, answer, output, max_length);
        else
            tn_job_fail(job, &error);
    }
    tn_house_judge_close(&judge);
    free(asked.items);
}
