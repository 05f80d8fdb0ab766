/* Writes the differences of two libraries as text and as JSON. */
#include "cli/plan/diff_report.h"

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

static void put_counts(const tn_diff_report *report, uint32_t length, tn_json *json)
{
    mpz_t count;
    mpz_init(count);
    for (int part = 0; part < TN_DIFF_PARTS; part++) {
        tn_library_kept(tn_library_diff_part(report->diff, (tn_diff_part)part), length, count);
        tn_json_digits(json, tn_diff_part_names[part], count);
    }
    mpz_clear(count);
}

static void counts_json(const tn_diff_report *report, tn_json *json)
{
    const tn_library *any = tn_library_diff_part(report->diff, TN_DIFF_KEPT);
    tn_json_object(json, "total");
    put_counts(report, TN_ALL_LENGTHS, json);
    tn_json_object_end(json);
    tn_json_list(json, "by_length");
    for (uint32_t n = tn_library_min(any); n <= tn_library_max(any); n++) {
        tn_json_object(json, NULL);
        tn_json_count(json, "length", n);
        put_counts(report, n, json);
        tn_json_object_end(json);
    }
    tn_json_list_end(json);
}

static void clauses_json(const tn_diff_report *report, tn_json *json)
{
    tn_json_list(json, "clauses");
    for (size_t i = 0; i < tn_library_diff_clauses(report->diff); i++) {
        const tn_changed_clause *clause = tn_library_diff_clause(report->diff, i);
        tn_json_object(json, NULL);
        tn_json_string(json, "name", clause_name(report, clause));
        tn_json_string(json, "change", change_names[clause->change]);
        tn_json_digits(json, "removes", clause->removes);
        tn_json_digits(json, "adds", clause->adds);
        tn_json_object_end(json);
    }
    tn_json_list_end(json);
}

static tn_status plans_json(const tn_diff_report *report, tn_diff_part part, tn_json *json, tn_error *error)
{
    tn_status status = TN_OK;
    mpz_t own;
    mpz_init(own);
    tn_json_list(json, tn_diff_part_names[part]);
    for (size_t i = 0; status == TN_OK && i < report->samples[part].count; i++) {
        tn_buffer line;
        status = plan_line(report, part, report->samples[part].ranks[i], &line, own, error);
        tn_json_object(json, NULL);
        tn_json_digits(json, "rank", own);
        tn_json_string(json, "plan", line.data ? line.data : "");
        tn_json_object_end(json);
        free(line.data);
    }
    tn_json_list_end(json);
    mpz_clear(own);
    return status;
}

static tn_status report_json(const tn_diff_report *report, tn_json *json, tn_error *error)
{
    static const char *const keys[2] = {"before", "after"};
    tn_status status = TN_OK;
    tn_json_object(json, NULL);
    for (int side = 0; side < 2; side++) {
        tn_json_object(json, keys[side]);
        tn_json_string(json, "file", report->paths[side]);
        tn_json_string(json, "library", tn_text(report->modules[side], report->records[side]->name));
        tn_json_object_end(json);
    }
    counts_json(report, json);
    clauses_json(report, json);
    tn_measure_changes_json(report->measures, json);
    tn_json_object(json, "plans");
    for (int part = 0; status == TN_OK && part < TN_DIFF_PARTS; part++)
        status = plans_json(report, (tn_diff_part)part, json, error);
    tn_json_object_end(json);
    tn_json_object_end(json);
    tn_json_end_line(json);
    return status;
}

/* All of it, or nothing where it fails. */
tn_status tn_diff_write_json(const tn_diff_report *report, FILE *out, tn_error *error)
{
    tn_buffer text = {0};
    tn_json json = tn_json_text(&text, TN_JSON_LINES);
    tn_status status = report_json(report, &json, error);
    if (status == TN_OK && text.failed)
        status = tn_fail_memory(error);
    if (status == TN_OK)
        fwrite(text.data, 1, text.size, out);
    free(text.data);
    return status;
}
