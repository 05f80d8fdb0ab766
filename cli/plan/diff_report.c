/* Writes the differences of two libraries as text and as JSON. */
#include "cli/plan/diff_report.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

#include "driver/open/digits.h"
#include "runtime/plan/text/text.h"

const char *const tn_diff_part_names[TN_DIFF_PARTS] = {"removed", "added", "kept"};

static const char *const change_names[] = {
    [TN_CLAUSE_CHANGED] = "changed", [TN_CLAUSE_ADDED] = "added", [TN_CLAUSE_REMOVED] = "removed"};

/* ---- which plans to show */

static tn_status take(const tn_library *library, size_t wanted, uint64_t seed, tn_diff_sample *sample, tn_error *error)
{
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(library, TN_ALL_LENGTHS, kept);
    size_t most = mpz_cmp_ui(kept, wanted) < 0 ? (size_t)mpz_get_ui(kept) : wanted, found = 0;
    bool any = mpz_sgn(kept) > 0;
    mpz_clear(kept);
    sample->ranks = malloc((most + 2) * sizeof *sample->ranks);
    if (!sample->ranks)
        return tn_fail_memory(error);
    for (; sample->room <= most; sample->room++)
        mpz_init(sample->ranks[sample->room]);
    if (!any)
        return TN_OK;
    tn_status status = tn_library_sample(library, seed, TN_ALL_LENGTHS, most, sample->ranks + 1, &found, error);
    if (status != TN_OK)
        return status;
    sample->count = found + 1;
    if (found > 0 && mpz_sgn(sample->ranks[1]) == 0) { /* the first was drawn, too */
        for (size_t i = 1; i < found; i++)
            mpz_set(sample->ranks[i], sample->ranks[i + 1]);
        sample->count--;
    }
    return TN_OK;
}

tn_status tn_diff_samples_take(tn_diff_report *report, size_t count, uint64_t seed, tn_error *error)
{
    tn_status status = TN_OK;
    for (int part = 0; status == TN_OK && part < TN_DIFF_PARTS; part++)
        status =
            take(tn_library_diff_part(report->diff, (tn_diff_part)part), count, seed, &report->samples[part], error);
    return status;
}

void tn_diff_samples_clear(tn_diff_report *report)
{
    for (int part = 0; part < TN_DIFF_PARTS; part++) {
        for (size_t i = 0; i < report->samples[part].room; i++)
            mpz_clear(report->samples[part].ranks[i]);
        free(report->samples[part].ranks);
        report->samples[part] = (tn_diff_sample){0};
    }
}

tn_status tn_diff_plan(const tn_diff_report *report, tn_diff_part part, const mpz_t rank, tn_tray *trays,
                       uint32_t *length, mpz_t own, tn_error *error)
{
    if (!tn_library_unrank(tn_library_diff_part(report->diff, part), rank, trays, length))
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a rank is not in the difference");
    return tn_library_diff_rank(report->diff, part, trays, *length, own, error);
}

/* The plan of a rank as a line, which the caller frees, and its rank in its own library. */
static tn_status plan_line(const tn_diff_report *report, tn_diff_part part, const mpz_t rank, tn_buffer *line,
                           mpz_t own, tn_error *error)
{
    const tn_library *library = tn_library_diff_part(report->diff, part);
    tn_tray *trays = malloc(((size_t)tn_library_max(library) + 1) * sizeof *trays);
    uint32_t length = 0;
    *line = (tn_buffer){0};
    tn_status status = trays ? tn_diff_plan(report, part, rank, trays, &length, own, error) : tn_fail_memory(error);
    if (status == TN_OK &&
        !(tn_plan_write_line(tn_library_schema(library), trays, length, line) && tn_buffer_append(line, "", 0)))
        status = tn_fail_memory(error);
    free(trays);
    return status;
}

/* ---- clauses */

static const char *clause_name(const tn_diff_report *report, const tn_changed_clause *clause)
{
    if (clause->lengths)
        return "trays";
    int side = clause->after != UINT32_MAX;
    const tn_module *module = report->modules[side];
    return tn_text(module, module->CLAUSE_records[side ? clause->after : clause->before].name);
}

/* ---- text */

static tn_status write_number(const mpz_t number, int width, FILE *out, tn_error *error)
{
    char *text = tn_digits(number, true);
    if (!text)
        return tn_fail_memory(error);
    fprintf(out, "  %*s", width, text);
    free(text);
    return TN_OK;
}

/* The line of one length, or of all. */
static tn_status write_length(const tn_diff_report *report, uint32_t length, const int *widths, FILE *out,
                              tn_error *error)
{
    tn_status status = TN_OK;
    mpz_t count;
    mpz_init(count);
    if (length == TN_ALL_LENGTHS)
        fprintf(out, "%8s", "total");
    else
        fprintf(out, "%8u", length);
    for (int part = 0; status == TN_OK && part < TN_DIFF_PARTS; part++) {
        tn_library_kept(tn_library_diff_part(report->diff, (tn_diff_part)part), length, count);
        status = write_number(count, widths[part], out, error);
    }
    fputc('\n', out);
    mpz_clear(count);
    return status;
}

static tn_status write_counts(const tn_diff_report *report, FILE *out, tn_error *error)
{
    const tn_library *any = tn_library_diff_part(report->diff, TN_DIFF_KEPT);
    int widths[TN_DIFF_PARTS];
    mpz_t count;
    mpz_init(count);
    fprintf(out, "%8s", "trays");
    for (int part = 0; part < TN_DIFF_PARTS; part++) {
        tn_library_kept(tn_library_diff_part(report->diff, (tn_diff_part)part), TN_ALL_LENGTHS, count);
        widths[part] = tn_digits_width(count, tn_diff_part_names[part]);
        fprintf(out, "  %*s", widths[part], tn_diff_part_names[part]);
    }
    mpz_clear(count);
    fputc('\n', out);
    tn_status status = TN_OK;
    for (uint32_t n = tn_library_min(any); status == TN_OK && n <= tn_library_max(any); n++)
        status = write_length(report, n, widths, out, error);
    return status == TN_OK ? write_length(report, TN_ALL_LENGTHS, widths, out, error) : status;
}

static tn_status write_clauses(const tn_diff_report *report, FILE *out, tn_error *error)
{
    size_t count = tn_library_diff_clauses(report->diff);
    int names = (int)strlen("clause"), removes = (int)strlen("removes"), adds = (int)strlen("adds");
    tn_status status = TN_OK;
    if (count == 0)
        return TN_OK;
    for (size_t i = 0; i < count; i++) {
        const tn_changed_clause *clause = tn_library_diff_clause(report->diff, i);
        int name = (int)strlen(clause_name(report, clause)), wide_removes = tn_digits_width(clause->removes, "removes"),
            wide_adds = tn_digits_width(clause->adds, "adds");
        names = name > names ? name : names;
        removes = wide_removes > removes ? wide_removes : removes;
        adds = wide_adds > adds ? wide_adds : adds;
    }
    fprintf(out, "\n%-*s  %-7s  %*s  %*s\n", names, "clause", "is", removes, "removes", adds, "adds");
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        const tn_changed_clause *clause = tn_library_diff_clause(report->diff, i);
        fprintf(out, "%-*s  %-7s", names, clause_name(report, clause), change_names[clause->change]);
        status = write_number(clause->removes, removes, out, error);
        if (status == TN_OK)
            status = write_number(clause->adds, adds, out, error);
        fputc('\n', out);
    }
    return status;
}

static tn_status write_plans(const tn_diff_report *report, tn_diff_part part, FILE *out, tn_error *error)
{
    const tn_diff_sample *sample = &report->samples[part];
    if (sample->count == 0)
        return TN_OK;
    fprintf(out, "\n%s, the first%s:\n", tn_diff_part_names[part], sample->count == 1 ? "" : " and some at random");
    tn_status status = TN_OK;
    mpz_t own;
    mpz_init(own);
    for (size_t i = 0; status == TN_OK && i < sample->count; i++) {
        tn_buffer line;
        status = plan_line(report, part, sample->ranks[i], &line, own, error);
        if (status == TN_OK)
            fprintf(out, "%s\n", line.data ? line.data : "");
        free(line.data);
    }
    mpz_clear(own);
    return status;
}

static bool is_same(const tn_diff_report *report)
{
    return report->samples[TN_DIFF_REMOVED].count == 0 && report->samples[TN_DIFF_ADDED].count == 0;
}

tn_status tn_diff_write_text(const tn_diff_report *report, FILE *out, tn_error *error)
{
    const char *names[2];
    for (int side = 0; side < 2; side++)
        names[side] = tn_text(report->modules[side], report->records[side]->name);
    fprintf(out, "%s of %s, ", names[0], report->paths[0]);
    if (strcmp(names[0], names[1]) != 0)
        fprintf(out, "%s of ", names[1]);
    fprintf(out, "%s: %s\n\n", report->paths[1], is_same(report) ? "the same plans" : "what changes");
    tn_status status = write_counts(report, out, error);
    if (status == TN_OK)
        status = write_clauses(report, out, error);
    if (status == TN_OK && report->measures && !tn_measure_changes_write(report->measures, out))
        status = tn_fail_memory(error);
    for (int part = 0; status == TN_OK && part < TN_DIFF_PARTS; part++)
        status = write_plans(report, (tn_diff_part)part, out, error);
    return status;
}

/* ---- JSON */

static void set_number(json_t *object, const char *key, const mpz_t number)
{
    char *text = tn_digits(number, false);
    json_object_set_new(object, key, text ? json_string(text) : NULL);
    free(text);
}

static json_t *counts_json(const tn_diff_report *report, uint32_t length)
{
    json_t *item = json_object();
    mpz_t count;
    mpz_init(count);
    if (length != TN_ALL_LENGTHS)
        json_object_set_new(item, "length", json_integer(length));
    for (int part = 0; part < TN_DIFF_PARTS; part++) {
        tn_library_kept(tn_library_diff_part(report->diff, (tn_diff_part)part), length, count);
        set_number(item, tn_diff_part_names[part], count);
    }
    mpz_clear(count);
    return item;
}

static json_t *clauses_json(const tn_diff_report *report)
{
    json_t *list = json_array();
    for (size_t i = 0; i < tn_library_diff_clauses(report->diff); i++) {
        const tn_changed_clause *clause = tn_library_diff_clause(report->diff, i);
        json_t *item = json_object();
        json_object_set_new(item, "name", json_string(clause_name(report, clause)));
        json_object_set_new(item, "change", json_string(change_names[clause->change]));
        set_number(item, "removes", clause->removes);
        set_number(item, "adds", clause->adds);
        json_array_append_new(list, item);
    }
    return list;
}

static tn_status plans_json(const tn_diff_report *report, tn_diff_part part, json_t *plans, tn_error *error)
{
    json_t *list = json_array();
    tn_status status = TN_OK;
    mpz_t own;
    mpz_init(own);
    for (size_t i = 0; status == TN_OK && i < report->samples[part].count; i++) {
        json_t *item = json_object();
        tn_buffer line;
        status = plan_line(report, part, report->samples[part].ranks[i], &line, own, error);
        set_number(item, "rank", own);
        json_object_set_new(item, "plan", json_string(line.data ? line.data : ""));
        json_array_append_new(list, item);
        free(line.data);
    }
    mpz_clear(own);
    json_object_set_new(plans, tn_diff_part_names[part], list);
    return status;
}

tn_status tn_diff_write_json(const tn_diff_report *report, FILE *out, tn_error *error)
{
    static const char *const keys[2] = {"before", "after"};
    const tn_library *any = tn_library_diff_part(report->diff, TN_DIFF_KEPT);
    json_t *root = json_object(), *lengths = json_array(), *plans = json_object();
    tn_status status = TN_OK;
    for (int side = 0; side < 2; side++) {
        json_t *item = json_object();
        json_object_set_new(item, "file", json_string(report->paths[side]));
        json_object_set_new(item, "library", json_string(tn_text(report->modules[side], report->records[side]->name)));
        json_object_set_new(root, keys[side], item);
    }
    for (uint32_t n = tn_library_min(any); n <= tn_library_max(any); n++)
        json_array_append_new(lengths, counts_json(report, n));
    for (int part = 0; status == TN_OK && part < TN_DIFF_PARTS; part++)
        status = plans_json(report, (tn_diff_part)part, plans, error);
    json_object_set_new(root, "total", counts_json(report, TN_ALL_LENGTHS));
    json_object_set_new(root, "by_length", lengths);
    json_object_set_new(root, "clauses", clauses_json(report));
    json_object_set_new(root, "measures", tn_measure_changes_json(report->measures));
    json_object_set_new(root, "plans", plans);
    if (status == TN_OK && json_dumpf(root, out, JSON_INDENT(2)) != 0)
        status = ferror(out) ? TN_OK : tn_fail_memory(error); /* a failed stream is found when it is closed */
    if (status == TN_OK)
        fputc('\n', out);
    json_decref(root);
    return status;
}
