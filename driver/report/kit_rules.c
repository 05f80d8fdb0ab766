/* The rules of a kit's report: which parts each places, in which order, and how they are drawn. */
#include "driver/report/kit_data.h"
#include "runtime/place/model/rules.h"

typedef struct ruling {
    const tn_kit_reporting *r;
    const tn_place_rules *rules;
} ruling;

static const tn_place_alternative *alternative_of(const ruling *g, uint32_t symbol, uint32_t i)
{
    return &g->rules->alternatives[g->rules->symbols[symbol].first + i];
}

/* ---- what an alternative places */

static bool has_part(const ruling *g, const tn_place_alternative *a)
{
    for (uint32_t s = 0; s < a->count; s++)
        if (g->rules->steps[a->first + s].kind == TN_STEP_PART)
            return true;
    return false;
}

/* A connector's alternatives turn and move a symbol that places parts: that, or UINT32_MAX. */
static uint32_t placing_symbol(const ruling *g, const tn_place_alternative *a)
{
    for (uint32_t s = 0; s < a->count; s++) {
        const tn_step *step = &g->rules->steps[a->first + s];
        if (step->kind == TN_STEP_EXPAND && has_part(g, alternative_of(g, step->index, 0)))
            return step->index;
    }
    return UINT32_MAX;
}

/* Is it a symbol of what may come at a connector? */
static bool is_choice(const ruling *g, uint32_t symbol)
{
    for (uint32_t i = 0; i < g->rules->symbols[symbol].count; i++)
        if (placing_symbol(g, alternative_of(g, symbol, i)) != UINT32_MAX)
            return true;
    return false;
}

/* ---- rows */

/* "3010 in colour 71, 3004" */
static bool put_parts(const ruling *g, uint32_t symbol)
{
    const tn_place_alternative *a = alternative_of(g, symbol, 0);
    const tn_page *page = &g->r->page;
    int32_t colour = 0;
    bool good = true, any = false, coloured = false;
    for (uint32_t s = 0; good && s < a->count; s++) {
        const tn_step *step = &g->rules->steps[a->first + s];
        if (step->kind == TN_STEP_COLOUR) {
            colour = step->a[0];
            coloured = true;
        }
        if (step->kind != TN_STEP_PART)
            continue;
        good = tn_page_html(page, any ? ", " : "") && tn_page_text(page, step->text) &&
               (!coloured || tn_buffer_printf(page->text, " in colour %d", (int)colour));
        any = true;
    }
    return good;
}

/* Do two alternatives place the same, with the same weight in the same draw? They differ by how it is turned then. */
static bool is_same(const ruling *g, const tn_place_alternative *a, const tn_place_alternative *b)
{
    return placing_symbol(g, a) == placing_symbol(g, b) && a->member == b->member && a->weight == b->weight &&
           (a->count == 0) == (b->count == 0);
}

static bool put_row(const ruling *g, uint32_t symbol, uint32_t i, uint32_t ways, bool first)
{
    const tn_place_alternative *a = alternative_of(g, symbol, i);
    const tn_page *page = &g->r->page;
    uint32_t placed = placing_symbol(g, a);
    bool good = tn_page_html(page, first ? "<tr class=\"first\"><td>" : "<tr><td>") &&
                (!first || tn_page_text(page, g->rules->symbols[symbol].name)) && tn_page_html(page, "</td><td>");
    good = good && (placed == UINT32_MAX ? tn_page_html(page, "nothing") : put_parts(g, placed)) &&
           tn_buffer_printf(page->text, "</td><td>%u</td><td>", (unsigned)ways);
    if (good && a->member)
        good = tn_buffer_printf(page->text, "%.10g", a->weight);
    return good && tn_page_html(page, "</td></tr>\n");
}

/* The last alternative leaves the connector open: that goes without saying. */
static bool put_symbol(const ruling *g, uint32_t symbol)
{
    const uint32_t count = g->rules->symbols[symbol].count;
    bool good = true;
    for (uint32_t i = 0, next; good && i < count; i = next) {
        const tn_place_alternative *a = alternative_of(g, symbol, i);
        for (next = i + 1; next < count && is_same(g, a, alternative_of(g, symbol, next)); next++)
            ;
        if (next < count || a->count > 0)
            good = put_row(g, symbol, i, next - i, i == 0);
    }
    return good;
}

static bool put_rules(const ruling *g)
{
    const tn_page *page = &g->r->page;
    bool any = false, good = true;
    for (uint32_t s = 0; good && s < g->rules->symbol_count; s++) {
        if (!is_choice(g, s))
            continue;
        if (!any)
            good = tn_page_html(page, "<p class=\"quiet\">At an open connector the rows of its rule are tried in their "
                                      "order; rows with weights that follow one another are drawn from. Where nothing "
                                      "fits, the connector stays open. Ways are turns, and connectors of the part that "
                                      "can join.</p>\n<table class=\"words\"><tr><th>rule</th><th>places</th><th>ways"
                                      "</th><th>weight</th></tr>\n");
        any = true;
        good = good && put_symbol(g, s);
    }
    return good && tn_page_html(page, any ? "</table>\n" : "<p class=\"quiet\">No rule places a part.</p>\n");
}

tn_status tn_kit_report_rules(tn_kit_reporting *r)
{
    tn_place_rules rules;
    tn_status status = tn_page_written(&r->page, tn_page_html(&r->page, "<h2 id=\"rules\">Rules</h2>\n"));
    if (status != TN_OK)
        return status;
    if (r->module->KIT_MODEL_count == 0)
        return tn_page_written(&r->page, tn_page_html(&r->page, "<p class=\"quiet\">Rules are those of models, and the "
                                                                "kit has none.</p>\n"));
    status = tn_place_rules_of_model(r->module, 0, &rules, r->page.error);
    if (status == TN_OK)
        status = tn_page_written(&r->page, put_rules(&(ruling){r, &rules}));
    tn_place_rules_clear(&rules);
    return status;
}
