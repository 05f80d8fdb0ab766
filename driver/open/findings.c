/* Words what analyses find of rules and libraries. */
#include "driver/open/findings.h"

#include <stdio.h>
#include <string.h>

#include "compiler/plan/syntax/program.h"

static tn_diagnostics *list_of(const tn_finder *f)
{
    return &f->opened->compilation.diagnostics;
}

/* Is it otherwise with other values of params? */
static bool is_settable(const tn_finder *f, tn_span span)
{
    return tn_program_settable(f->opened->compilation.program, span);
}

bool tn_finding_allowed(const tn_finder *f, tn_code code, tn_span span)
{
    return tn_program_allows(f->opened->compilation.program, code, span) || is_settable(f, span);
}

tn_span tn_finding_name_span(const tn_finder *f, tn_span item, const char *word, const char *name)
{
    const tn_sources *sources = &f->opened->compilation.sources;
    if (item.file >= sources->count || item.end > sources->files[item.file].size)
        return item;
    const char *text = sources->files[item.file].text;
    size_t begin = item.begin + strlen(word), length = strlen(name);
    while (begin < item.end && strchr(" \t\r\n", text[begin]))
        begin++;
    if (begin + length > item.end || memcmp(text + begin, name, length) != 0)
        return item;
    return (tn_span){item.file, (uint32_t)begin, (uint32_t)(begin + length)};
}

bool tn_finding_explained(const tn_finder *f, tn_span rule)
{
    const tn_diagnostics *list = list_of(f);
    for (size_t i = 0; i < list->count; i++) {
        const tn_diagnostic *d = &list->items[i];
        bool inside =
            d->has_span && d->span.file == rule.file && d->span.begin >= rule.begin && d->span.end <= rule.end;
        if (inside && (d->code == W_ALWAYS_TRUE || d->code == W_NEVER_TRUE || d->code == W_REMAINDER_NEVER ||
                       d->code == W_CELL_NEVER))
            return true;
    }
    return false;
}

static void note_example(const tn_finder *f, tn_diagnostic *d, const tn_span *span, const char *what,
                         const char *example)
{
    if (example)
        tn_note(list_of(f), d, span, "%s: %s", what, example);
}

/* ---- rules */

void tn_report_extreme(const tn_finder *f, const tn_found_item *rule, bool never)
{
    tn_code code = never ? W_NEVER_MATCHES : W_ALWAYS_MATCHES;
    if (tn_finding_allowed(f, code, rule->span))
        return;
    tn_diagnostic *d = tn_report(list_of(f), code, rule->span, "`%s` matches %s %s%s", rule->name,
                                 never ? "no" : "every", f->one, f->among);
    if (never)
        tn_help(list_of(f), d, "parts of it exclude each other; if that is meant, write `allow W001` before its `=`");
    else
        tn_help(list_of(f), d, "if that is meant, write `allow W002` before its `=`");
}

/* A rule equal to one of a file that is used is no mistake: a note says that there is a name for it already. */
void tn_report_equivalent(const tn_finder *f, const tn_found_item *rule, const tn_found_item *other,
                          const char *example)
{
    if (tn_finding_allowed(f, W_EQUIVALENT, rule->span) || tn_finding_allowed(f, W_EQUIVALENT, other->span))
        return;
    tn_diagnostics *list = list_of(f);
    tn_diagnostic *d;
    if (other->imported) {
        d = tn_report_bare(list, TN_NOTE, TN_CODE_NONE, "`%s` matches the same %s as `%s`%s", rule->name, f->many,
                           other->name, f->among);
        d->has_span = true;
        d->span = rule->span;
    } else {
        d = tn_report(list, W_EQUIVALENT, rule->span, "`%s` matches the same %s as `%s`%s", rule->name, f->many,
                      other->name, f->among);
    }
    tn_note(list, d, &other->span, "`%s` is here", other->name);
    tn_help(list, d, "use `%s` instead; if both are meant, write `allow W004` before this one's `=`", other->name);
    note_example(f, d, NULL, "both match", example);
}

/* ---- clauses that change nothing */

/* "`a`, `b` and `c`", cut off where there is no room. */
static void join_names(const tn_found_item *items, size_t count, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (size_t i = 0; i < count && used < size; i++) {
        const char *between = i == 0 ? "" : i + 1 == count ? " and " : ", ";
        used += (size_t)snprintf(text + used, size - used, "%s`%s`", between, items[i].name);
    }
}

void tn_report_idle_prune(const tn_finder *f, const tn_found_item *library, const tn_found_item *clause,
                          const tn_found_item *reasons, size_t reason_count, const char *example)
{
    char names[300], what[400];
    bool settable = false;
    for (size_t i = 0; i < reason_count; i++)
        settable |= is_settable(f, reasons[i].span);
    if (tn_finding_allowed(f, W_REDUNDANT_PRUNE, clause->span) || settable)
        return;
    tn_diagnostic *d;
    if (reason_count == 0)
        d = tn_report(list_of(f), W_REDUNDANT_PRUNE, clause->span,
                      "`%s` prunes nothing: it matches no %s that `%s` generates", clause->name, f->one, library->name);
    else
        d = tn_report(list_of(f), W_REDUNDANT_PRUNE, clause->span,
                      "`%s` prunes nothing that the other clauses of `%s` do not keep out", clause->name,
                      library->name);
    join_names(reasons, reason_count, names, sizeof names);
    tn_help(list_of(f), d, "leave it out, or write `allow W005` in the library");
    snprintf(what, sizeof what, "for example, pruned by %s too", reason_count ? names : "none");
    note_example(f, d, NULL, what, example);
}

void tn_report_idle_requirement(const tn_finder *f, const tn_found_item *library, const tn_found_item *clause)
{
    if (tn_finding_allowed(f, W_NEEDLESS_REQUIREMENT, clause->span))
        return;
    tn_diagnostic *d =
        tn_report(list_of(f), W_NEEDLESS_REQUIREMENT, clause->span,
                  "every %s that `%s` would hold without `%s` meets it", f->one, library->name, clause->name);
    tn_help(list_of(f), d, "leave it out, or write `allow W008` in the library");
}

/* ---- libraries that hold nothing */

static void note_reasons(const tn_finder *f, tn_diagnostic *d, const tn_found_empty *empty)
{
    char what[TN_SPELLING_MAX + 80];
    for (size_t i = 0; i < empty->reason_count; i++) {
        const tn_found_item *reason = &empty->reasons[i];
        if (!empty->examples[i])
            tn_note(list_of(f), d, &reason->span, "`%s` is one of the clauses that do this", reason->name);
        if (empty->reason_count == 1)
            snprintf(what, sizeof what, "`%s` keeps out all %s, for example", reason->name, f->many);
        else
            snprintf(what, sizeof what, "without `%s` the others here would leave", reason->name);
        note_example(f, d, &reason->span, what, empty->examples[i]);
    }
}

void tn_report_empty(const tn_finder *f, const tn_found_item *library, const tn_found_empty *empty)
{
    bool alone = empty->reason_count == 1;
    if (tn_finding_allowed(f, W_EMPTY_LIBRARY, library->span))
        return;
    tn_diagnostic *d = tn_report(list_of(f), W_EMPTY_LIBRARY, library->span, "`%s` holds no %s", library->name, f->one);
    if (empty->why)
        tn_note(list_of(f), d, NULL, "perhaps not all of these are needed for that: %s", empty->why);
    note_reasons(f, d, empty);
    if (empty->with_lengths)
        tn_help(list_of(f), d, "%s no %s of %u to %u trays: change %s `trays`",
                alone ? "this clause leaves" : "together these leave", f->one, empty->trays_min, empty->trays_max,
                alone ? "it or" : "one of them, or");
    else
        tn_help(list_of(f), d, "%s no %s: change %s", alone ? "this clause leaves" : "together these leave", f->one,
                alone ? "it" : "one of them");
}
