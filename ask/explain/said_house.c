/* Why houses are kept or dropped, in words: a line each. */
#include <string.h>

#include "ask/explain/explain.h"

static const char *said(const tn_explained_house_clause *clause)
{
    if (strcmp(clause->kind, "trays") == 0)
        return clause->drops ? "no plan of its has so many trays" : "the number of trays is one of its";
    if (strcmp(clause->kind, "prune") == 0)
        return clause->drops ? "matches, and is pruned" : "does not match";
    return clause->drops ? "does not hold, and is required" : "holds, as required";
}

void tn_explained_clause_said(const tn_explained_house_clause *clause, tn_buffer *out)
{
    bool of_plans = strcmp(clause->of, "plan") == 0;
    tn_buffer_printf(out, "%s: %s%s%s%s", clause->name, said(clause), of_plans ? ", by the plan alone" : "",
                     *clause->doc ? "; " : "", clause->doc);
}

void tn_explained_rule_said(const tn_explained_house_rule *rule, tn_buffer *out)
{
    tn_buffer_printf(out, "`%s` %s this house", rule->name, rule->matches ? "matches" : "does not match");
}

void tn_explained_question_said(const tn_asked_of_house *question, tn_buffer *out)
{
    const tn_owneds *found = &question->found;
    tn_buffer_printf(out, "%s:%s", question->question, found->count == 0 ? " nothing" : "");
    for (size_t k = 0; k < found->count; k++)
        tn_buffer_printf(out, "%s %s", k ? ";" : "", found->items[k]);
}

void tn_explained_covered_said(const tn_covered_opening *covered, tn_buffer *out)
{
    tn_buffer_printf(out, "%s: `%s` does not fit, as %s", covered->face, covered->opening, covered->why);
}

void tn_explained_bare_said(const tn_bare_cell *cell, bool of_house, tn_buffer *out)
{
    if (cell->has_why && !of_house)
        tn_buffer_printf(out, "%s: people cannot go about there, whatever is in its walls: %s", cell->cell, cell->why);
    else if (cell->has_why)
        tn_buffer_printf(out, "people cannot go about in %s, so this is no house of any library: %s", cell->cell,
                         cell->why);
    else if (of_house)
        tn_buffer_printf(out, "no tile stands in %s, so this is no house of any library", cell->cell);
    else
        tn_buffer_printf(out, "%s: %s", cell->cell,
                         cell->usable ? "no tile stands there, whatever is in its walls" : "no function may be there");
}

void tn_explained_tile_said(const tn_failing_tile *tile, tn_buffer *out)
{
    tn_buffer_printf(out, "%s%s%s: %s", tile->tile, tile->has_function ? ", as " : "",
                     tile->has_function ? tile->function : "", tile->why);
}

void tn_explained_cells_said(const tn_explained_cells *explained, tn_buffer *out)
{
    if (explained->sectionless)
        tn_buffer_printf(out, "form `%s` has no house: its `forbid` lines forbid all combinations of options", explained->form);
    else if (explained->bare.count > 0)
        tn_buffer_printf(out, "form `%s` has no house on this plan", explained->form);
    else if (explained->houseless)
        tn_buffer_printf(out,
                         "form `%s` has no house on this plan, though each cell could be in one by itself: what is in "
                         "the walls between cells and in the floors leaves no place for all of their tiles, flights of "
                         "stairs and ways",
                         explained->form);
    else
        tn_buffer_printf(out, "each cell of this plan can have a function, and a tile where that wants one");
}
