/* Counts as tables for people. */
#include "cli/plan/count_text.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "driver/house/judge.h"
#include "driver/measure/spread.h"
#include "driver/open/digits.h"
#include "runtime/base/utf8.h"

/* ---- plans */

/* A number that is not known is a dash. */
static void write_number(bool known, const mpz_t number, int width, FILE *out)
{
    char *text = known ? tn_digits(number, true) : NULL;
    fprintf(out, "  %*s", width, !known ? "-" : text ? text : "?");
    free(text);
}

static void write_lengths(const tn_counted_plans *c, FILE *out)
{
    int generated = tn_digits_width(c->generated, "generated"), kept = tn_digits_width(c->kept, "kept"),
        mirror = tn_digits_width(c->mirror, "up to mirror");
    fprintf(out, "%8s  %*s  %*s", "trays", generated, "generated", kept, "kept");
    if (c->has_mirror)
        fprintf(out, "  %*s", mirror, "up to mirror");
    fputc('\n', out);
    for (size_t i = 0; i < c->by_length.count && !tn_interrupted(); i++) {
        const tn_plans_of_length *length = &c->by_length.items[i];
        fprintf(out, "%8" PRIu64, length->length);
        write_number(length->has_generated, length->generated, generated, out);
        write_number(length->has_kept, length->kept, kept, out);
        if (c->has_mirror)
            write_number(true, length->mirror, mirror, out);
        fputc('\n', out);
    }
    fprintf(out, "%8s", "total");
    write_number(c->has_generated, c->generated, generated, out);
    write_number(c->has_kept, c->kept, kept, out);
    if (c->has_mirror)
        write_number(true, c->mirror, mirror, out);
    fputc('\n', out);
}

void tn_count_plans_text(const tn_counted_plans *c, FILE *out)
{
    char *pruned = tn_digits(c->pruned, true);
    fprintf(out, "%s%s", c->library, *c->doc ? ": " : "");
    tn_write_clean(out, c->doc, strlen(c->doc));
    fprintf(out, "\npruned: %s\nstates: %" PRIu64 "%s\n\n", pruned ? pruned : "?", c->states,
            c->has_states ? "" : " within these lengths");
    free(pruned);
    write_lengths(c, out);
}

/* What a clause of either kind does. */
typedef struct clause_row {
    const char *name;
    bool has_out, has_only;
    mpz_srcptr out, only;
    uint64_t states;
} clause_row;

static clause_row rule_row(const tn_counted_plans *c, size_t i)
{
    const tn_rule_effect *r = &c->rules.items[i];
    return (clause_row){r->name, r->has_prunes, r->has_only, r->prunes, r->only, r->states};
}

static clause_row requirement_row(const tn_counted_plans *c, size_t i)
{
    const tn_requirement_effect *r = &c->requirements.items[i];
    return (clause_row){r->name, r->has_keeps_out, r->has_only, r->keeps_out, r->only, r->states};
}

static int wider(int width, int other)
{
    return width > other ? width : other;
}

static void write_clauses(const tn_counted_plans *c, size_t count, clause_row (*row)(const tn_counted_plans *, size_t),
                          const char *what, const char *heading, FILE *out)
{
    int names = (int)strlen(what), outs = (int)strlen(heading), onlys = (int)strlen("only by it");
    for (size_t i = 0; i < count; i++) {
        const clause_row r = row(c, i);
        names = wider(names, (int)strlen(r.name));
        outs = wider(outs, tn_digits_width(r.out, heading));
        onlys = wider(onlys, tn_digits_width(r.only, "only by it"));
    }
    if (count > 0)
        fprintf(out, "\n%-*s  %*s  %*s  %6s\n", names, what, outs, heading, onlys, "only by it", "states");
    for (size_t i = 0; i < count && !tn_interrupted(); i++) {
        const clause_row r = row(c, i);
        fprintf(out, "%-*s", names, r.name);
        write_number(r.has_out, r.out, outs, out);
        write_number(r.has_only, r.only, onlys, out);
        fprintf(out, "  %6" PRIu64 "\n", r.states);
    }
}

void tn_count_clauses_text(const tn_counted_plans *c, FILE *out)
{
    write_clauses(c, c->requirements.count, requirement_row, "requirement", "keeps out", out);
    write_clauses(c, c->rules.count, rule_row, "rule", "prunes", out);
}

/* ---- how plans or houses are spread over the values of a measure */

static const char *things(const tn_spread *p)
{
    return strcmp(p->of, "plan") == 0 ? "plans" : "houses";
}

static void write_statistics(const tn_spread *p, FILE *out)
{
    for (unsigned i = 0; i < TN_SPREAD_FACTS; i++)
        fprintf(out, "%-20s  %s\n", p->names[i], p->facts[i]);
    fputc('\n', out);
}

static void put_bound(const tn_spread *p, const mpq_t value, tn_buffer *text)
{
    tn_amount_unit plain = {p->bins.unit.feet, 0};
    tn_amount_write(plain, value, text);
}

/* The row of the plans that have no value. */
static void write_without(const tn_spread *p, FILE *out)
{
    char *plans = mpz_sgn(p->d.without) > 0 ? tn_digits(p->d.without, true) : NULL;
    if (plans)
        fprintf(out, "%24s  %24s\n", "none", plans);
    free(plans);
}

static void write_rows(const tn_spread *p, FILE *out)
{
    mpz_t running;
    tn_bin_row r;
    mpz_init(running);
    tn_bin_row_init(&p->bins, &r);
    tn_buffer heading = {0};
    if (p->bins.binned) {
        put_bound(p, p->bins.step, &heading);
        const char *unit = tn_amount_unit_name(p->bins.unit);
        fprintf(out, "%zu values, in bins of %s%s%s\n", p->d.count, heading.data ? heading.data : "", *unit ? " " : "",
                unit);
    }
    free(heading.data);
    fprintf(out, "%24s  %24s  %7s  %7s\n", p->bins.binned ? "from, to below" : "value", things(p), "share", "so far");
    while (tn_bin_row_next(&p->bins, &r)) {
        tn_buffer text = {0};
        put_bound(p, r.from, &text);
        if (p->bins.binned) {
            tn_buffer_printf(&text, " .. ");
            put_bound(p, r.to, &text);
        }
        char *plans = tn_digits(r.plans, true);
        mpz_add(running, running, r.plans);
        fprintf(out, "%24s  %24s  %6.2f%%  %6.2f%%\n", text.data ? text.data : "", plans ? plans : "",
                100 * tn_bins_share(r.plans, p->d.all), 100 * tn_bins_share(running, p->d.all));
        free(plans);
        free(text.data);
    }
    tn_bin_row_clear(&r);
    mpz_clear(running);
    write_without(p, out);
}

static void write_spread(const tn_spread *p, FILE *out)
{
    const char *doc = p->doc, *unit = tn_amount_unit_name(p->bins.unit);
    char *all = tn_digits(p->d.all, true);
    fprintf(out, "%s%s%s%s%s%s of %s %s of %s\n\n", p->name, *doc ? " " : "", doc, *unit ? " (" : "", unit,
            *unit ? ")" : "", all ? all : "", mpz_cmp_ui(p->d.all, 1) == 0 ? p->of : things(p), p->library);
    free(all);
    if (p->d.count == 0) {
        write_without(p, out);
        return;
    }
    write_statistics(p, out);
    write_rows(p, out);
}

void tn_count_spread_text(const tn_counted_values *values, FILE *out)
{
    write_spread(values->spread.value, out);
}

/* ---- houses */

enum { LABEL_WIDTH = 24, COUNT_WIDTH = 24 };

/* Indented by two, and a blank after it. */
static int widest(int width, const char *name)
{
    return wider(width, (int)strlen(name) + 3);
}

/* Of the labels of the text: of the values and the library's clauses, or more. */
static int label_width(const tn_counted_houses *c, const tn_module *module)
{
    const tn_house_library_record *library = &module->HOUSE_LIBRARY_records[tn_house_library_find(module, c->library)];
    int width = LABEL_WIDTH;
    for (size_t i = 0; i < c->by_section.count; i++)
        for (size_t k = 0; k < c->by_section.items[i].values.count && c->by_section.items[i].values.count > 1; k++)
            width = widest(width, c->by_section.items[i].values.items[k].name);
    for (uint32_t i = 0; i < library->clause_count; i++)
        width = widest(width, tn_text(module, module->HOUSE_CLAUSE_records[library->clause_first + i].name));
    return width;
}

/* At least `width` characters, with blanks behind it. */
static void write_digits(const mpz_t number, int width, FILE *out)
{
    int written = (int)mpz_out_str(out, 10, number);
    fprintf(out, "%*s", written < width ? width - written : 0, "");
}

static void write_label(const char *label, const mpz_t number, int labels, FILE *out)
{
    fprintf(out, "%-*s", labels, label);
    write_digits(number, 0, out);
    fputc('\n', out);
}

static void write_house_lengths(const tn_counted_houses *c, int labels, FILE *out)
{
    for (size_t i = 0; i < c->by_length.count; i++) {
        const tn_named_big *length = &c->by_length.items[i];
        char label[40];
        snprintf(label, sizeof label, "  of %.16s tray%s", length->name, strcmp(length->name, "1") == 0 ? "" : "s");
        write_label(label, length->value, labels, out);
    }
}

static void write_named(const tn_named_big *named, int labels, FILE *out)
{
    fprintf(out, "  %-*s ", labels - 3, named->name);
    write_digits(named->value, 0, out);
    fputc('\n', out);
}

/* Choices that leave nothing to choose are left out. */
static void write_sections(const tn_counted_houses *c, int labels, FILE *out)
{
    for (size_t i = 0; i < c->by_section.count; i++) {
        const tn_named_bigs *choice = &c->by_section.items[i];
        if (choice->values.count <= 1)
            continue;
        fprintf(out, "%s\n", choice->name);
        for (size_t k = 0; k < choice->values.count; k++)
            write_named(&choice->values.items[k], labels, out);
    }
}

static void write_house_states(const tn_counted_houses *c, int labels, FILE *out)
{
    fprintf(out, "%-*s%s\n  %-*s%" PRIu64 "\n", labels, "clause by itself", "states", labels - 2, "none",
            c->states_of_none);
    for (size_t i = 0; i < c->states_of.count; i++)
        fprintf(out, "  %-*s %" PRIu64 "\n", labels - 3, c->states_of.items[i].name, c->states_of.items[i].value);
    fprintf(out, "  %-*s%" PRIu64 "\n", labels - 2, "all of them", c->states);
}

static void write_house_clauses(const tn_counted_houses *c, int labels, FILE *out)
{
    write_label("without clauses", c->without_clauses, labels, out);
    fprintf(out, "%-*s%-*s%s\n", labels, "clause", COUNT_WIDTH, "keeps out", "only by it");
    for (size_t i = 0; i < c->kept_out.count; i++) {
        fprintf(out, "  %-*s ", labels - 3, c->kept_out.items[i].name);
        write_digits(c->kept_out.items[i].value, COUNT_WIDTH - 1, out);
        fputc(' ', out);
        write_digits(c->only.items[i].value, 0, out);
        fputc('\n', out);
    }
    if (c->has_states_of)
        write_house_states(c, labels, out);
}

void tn_count_houses_text(const tn_counted_houses *c, const tn_module *module, FILE *out)
{
    int labels = label_width(c, module);
    write_label("plans", c->plans, labels, out);
    if (c->has_zoned) {
        write_label("with a house", c->plans_with_houses, labels, out);
        write_label("with sections", c->with_sections, labels, out);
        write_label("with functions", c->zoned, labels, out);
    }
    if (c->has_faced)
        write_label("with openings", c->faced, labels, out);
    write_label("houses", c->houses, labels, out);
    write_house_lengths(c, labels, out);
    write_sections(c, labels, out);
    if (c->has_kept_out)
        write_house_clauses(c, labels, out);
}

/* ---- buildings */

void tn_count_buildings_text(const tn_counted_buildings *c, FILE *out)
{
    fprintf(out, "%" PRIu64 "\n", c->has_inside ? c->inside : c->has_buildings ? c->buildings : c->fixed);
}
