/* Explanations of houses as text. */
#include "cli/plan/explain_text.h"

#include <inttypes.h>
#include <string.h>

/* A question a line, with what it finds. */
static void write_why(const tn_asked_of_house *questions, size_t count, tn_buffer *out)
{
    for (size_t i = 0; i < count; i++) {
        const tn_owneds *found = &questions[i].found;
        tn_buffer_printf(out, "    %s:%s", questions[i].question, found->count == 0 ? " nothing" : "");
        for (size_t k = 0; k < found->count; k++)
            tn_buffer_printf(out, "%s %s", k ? ";" : "", found->items[k]);
        tn_buffer_printf(out, "\n");
    }
}

static const char *said(const tn_explained_house_clause *clause)
{
    if (strcmp(clause->kind, "trays") == 0)
        return clause->drops ? "no plan of its has so many trays" : "the number of trays is one of its";
    if (strcmp(clause->kind, "prune") == 0)
        return clause->drops ? "matches, and is pruned" : "does not match";
    return clause->drops ? "does not hold, and is required" : "holds, as required";
}

static void write_clause(const tn_explained_house_clause *clause, tn_buffer *out)
{
    bool of_plans = strcmp(clause->of, "plan") == 0;
    tn_buffer_printf(out, "%s %s: %s%s%s%s\n", clause->drops ? "-" : "+", clause->name, said(clause),
                     of_plans ? ", by the plan alone" : "", *clause->doc ? "; " : "", clause->doc);
    write_why(clause->why.items, clause->why.count, out);
}

static void write_bare(const tn_bare_cell *bare, tn_buffer *out)
{
    tn_buffer_printf(out, "- no tile stands in %s, so this is no house of any library\n", bare->cell);
    for (size_t i = 0; i < bare->tiles.count; i++)
        tn_buffer_printf(out, "    %s: %s\n", bare->tiles.items[i].tile, bare->tiles.items[i].why);
}

static void write_covered(const tn_explained_house *explained, tn_buffer *out)
{
    for (size_t i = 0; i < explained->behind_roofs.count; i++) {
        const tn_covered_opening *covered = &explained->behind_roofs.items[i];
        tn_buffer_printf(out, "%s    %s: `%s` does not fit, as %s\n", i ? "" : "behind lower roofs:\n", covered->face,
                         covered->opening, covered->why);
    }
}

static void write_steps(const tn_nearest_house *near, tn_buffer *out)
{
    tn_buffer_printf(out, "kept with these changes together:\n");
    for (size_t i = 0; i < near->changes.count; i++) {
        const tn_house_step *step = &near->changes.items[i];
        tn_buffer_printf(out, "    %s: %s for %s\n", step->where, step->to, step->from);
    }
}

static void write_nearest(const tn_explained_house *explained, tn_buffer *out)
{
    if (explained->nearest.count == 0)
        tn_buffer_printf(out, "no house that differs by a few choices was found to be kept\n");
    for (size_t i = 0; i < explained->nearest.count; i++) {
        const tn_nearest_house *near = &explained->nearest.items[i];
        if (near->has_changes)
            write_steps(near, out);
        else
            tn_buffer_printf(out, "%s    %s: %s for %s\n", i ? "" : "kept with one change:\n", near->where, near->to,
                             near->from);
    }
    if (explained->more > 0)
        tn_buffer_printf(out, "    and %" PRIu64 " more\n", explained->more);
}

void tn_explain_house_text(const tn_explained_house *explained, bool full, tn_buffer *out)
{
    tn_buffer_printf(out, "`%s` %s this house\n", explained->library, explained->kept ? "keeps" : "drops");
    for (size_t i = 0; i < explained->clauses.count; i++)
        if (full || explained->clauses.items[i].drops)
            write_clause(&explained->clauses.items[i], out);
    for (size_t i = 0; i < explained->bare.count; i++)
        write_bare(&explained->bare.items[i], out);
    if (full)
        write_covered(explained, out);
    if (explained->has_nearest)
        write_nearest(explained, out);
}

void tn_explain_house_rules_text(const tn_explained_house_by_rules *explained, tn_buffer *out)
{
    for (size_t i = 0; i < explained->rules.count; i++) {
        const tn_explained_house_rule *rule = &explained->rules.items[i];
        tn_buffer_printf(out, "%s `%s` %s this house\n", rule->matches ? "+" : "-", rule->name,
                         rule->matches ? "matches" : "does not match");
        write_why(rule->why.items, rule->why.count, out);
    }
}

static void write_cell(const tn_bare_cell *cell, tn_buffer *out)
{
    tn_buffer_printf(out, "- %s: %s\n", cell->cell,
                     cell->usable ? "no tile stands there, whatever is in its walls" : "no function may be there");
    for (size_t i = 0; i < cell->tiles.count; i++) {
        const tn_failing_tile *tile = &cell->tiles.items[i];
        tn_buffer_printf(out, "    %s, as %s: %s\n", tile->tile, tile->function, tile->why);
    }
}

void tn_explain_cells_text(const tn_explained_cells *explained, tn_buffer *out)
{
    if (explained->sectionless)
        tn_buffer_printf(out, "form `%s` has no house: its `forbid` lines forbid every section\n", explained->form);
    else if (explained->bare.count > 0)
        tn_buffer_printf(out, "form `%s` has no house on this plan\n", explained->form);
    else
        tn_buffer_printf(out,
                         "each cell of this plan can have a function, and a tile where that wants one\n"
                         "`tartan count` with --library %s --plan PLAN --clauses says how many houses it has, and what "
                         "each clause keeps out\n",
                         explained->library);
    for (size_t i = 0; i < explained->bare.count; i++)
        write_cell(&explained->bare.items[i], out);
}
