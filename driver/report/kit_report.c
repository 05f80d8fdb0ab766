/* Writes the report of a kit: the page, and its kinds of connectors. */
#include "driver/report/kit_report.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "driver/place/kit.h"
#include "driver/place/shape.h"
#include "driver/report/page.h"
#include "runtime/geometry/mesh.h"
#include "runtime/module/code.h"
#include "runtime/number/run.h"
#include "runtime/place/model/rules.h"
#include "runtime/place/space.h"
#include "runtime/place/write.h"

typedef struct kit_reporting {
    tn_opened *opened;
    const tn_module *module;
    tn_kit_report_options options; /* none is 0 but the seed, and the watch NULL */
    tn_kit_report_tally *tally;
    double unit[3]; /* a cell's sides, in LDU */
    tn_page page;
} kit_reporting;

static bool kit_report_source(const kit_reporting *r, uint32_t file, uint32_t begin, uint32_t end);
static bool kit_report_type(const kit_reporting *r, uint32_t type);

/* ---- rules: which parts each places, in which order, and how they are drawn */

typedef struct ruling {
    const kit_reporting *r;
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

static bool put_rule_row(const ruling *g, uint32_t symbol, uint32_t i, uint32_t ways, bool first)
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
            good = put_rule_row(g, symbol, i, next - i, i == 0);
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

static tn_status kit_report_rules(kit_reporting *r)
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

/* ---- models: each is placed, drawn, measured, and held to what it requires */

#define SPACE_CELLS_MAX 100000000 /* around a space whose cells are counted */

typedef struct placed {
    uint32_t index;
    const tn_kit_model_record *record;
    tn_place_rules rules;
    tn_placed_model model;
    tn_placed_measures measures;
    tn_diagnostics found; /* while placing */
    tn_status status;     /* of placing */
    bool fill_known;      /* how many cells the space has, which is then: */
    uint64_t inside;
} placed;

/* A model that a search found until its limit is one like any other. */
static bool is_whole(const placed *p)
{
    return p->status == TN_OK || (p->status == TN_LIMIT && p->model.counts.looked_at > 0 && p->model.count > 0);
}

/* ---- what the file says */

static bool put_source(const kit_reporting *r, const char *what, uint32_t file, uint32_t begin, uint32_t end)
{
    return tn_page_html(&r->page, "<tr><td>") && tn_page_html(&r->page, what) &&
           tn_page_html(&r->page, "</td><td><code>") && kit_report_source(r, file, begin, end) &&
           tn_page_html(&r->page, "</code></td></tr>\n");
}

static bool put_space(const kit_reporting *r, const placed *p)
{
    const tn_kit_model_record *m = p->record;
    bool good = tn_page_html(&r->page, "<tr><td>space</td><td>");
    if (good && p->fill_known)
        good = tn_buffer_printf(r->page.text, "%" PRIu64 " cells, ", p->inside);
    return good && tn_buffer_printf(r->page.text, "within x %.10g..%.10g, y %.10g..%.10g, z %.10g..%.10g</td></tr>\n",
                                    r->unit[0] * (double)m->low_x, r->unit[0] * (double)m->high_x,
                                    0 - r->unit[1] * (double)m->high_y, 0 - r->unit[1] * (double)m->low_y,
                                    r->unit[2] * (double)m->low_z, r->unit[2] * (double)m->high_z);
}

/* What the model starts with, as its author wrote it: steps of the start symbol have these places. */
static bool put_start(const kit_reporting *r, const placed *p)
{
    const tn_place_alternative *start = &p->rules.alternatives[p->rules.symbols[p->rules.start].first];
    const tn_source_map_record *last = NULL;
    bool good = true;
    for (uint32_t s = 0; good && s < start->count; s++) {
        const tn_step *step = &p->rules.steps[start->first + s];
        const tn_source_map_record *at = step->kind == TN_STEP_PUSH ? tn_module_place(r->module, step->offset) : NULL;
        if (!at || (last && last->file == at->file && last->begin == at->begin))
            continue;
        good = put_source(r, last ? "" : "start", at->file, at->begin, at->end);
        last = at;
    }
    return good;
}

static bool put_objective(const kit_reporting *r, const placed *p)
{
    if (p->record->objective == TN_NO_RECORD)
        return true;
    const tn_function_record *f = &r->module->FUNCTION_records[p->record->objective];
    const tn_source_map_record *at = tn_module_place(r->module, f->code_begin);
    return !at || put_source(r, p->record->flags & TN_KIT_MAXIMIZE ? "is to be large" : "is to be small", at->file,
                             at->begin, at->end);
}

static bool put_search(const kit_reporting *r, const placed *p)
{
    static const char *const searches[TN_SEARCH_COUNT] = {[TN_SEARCH_GREEDY] = "none: what fits first is taken",
                                                          [TN_SEARCH_BEAM] = "beam",
                                                          [TN_SEARCH_ANNEAL] = "anneal",
                                                          [TN_SEARCH_EXACT] = "exact"};
    static const char *const symmetries[TN_SYMMETRY_COUNT] = {[TN_SYMMETRY_TURN_2] = "two images, turned by half",
                                                              [TN_SYMMETRY_TURN_4] = "four images, turned by a quarter",
                                                              [TN_SYMMETRY_MIRROR_X] = "mirrored in x",
                                                              [TN_SYMMETRY_MIRROR_Z] = "mirrored in z"};
    const tn_kit_model_record *m = p->record;
    bool good = tn_buffer_printf(r->page.text, "<tr><td>search</td><td>%s", searches[m->search]);
    if (good && m->search_amount)
        good = tn_buffer_printf(r->page.text, " %u", (unsigned)m->search_amount);
    good = good && tn_page_html(&r->page, "</td></tr>\n");
    if (good && symmetries[m->symmetry])
        good = tn_buffer_printf(r->page.text, "<tr><td>symmetry</td><td>%s</td></tr>\n", symmetries[m->symmetry]);
    return good;
}

static bool put_stock(const kit_reporting *r, const placed *p)
{
    bool good = true;
    for (uint32_t i = 0; good && i < p->record->stock_count; i++) {
        const tn_kit_stock_record *stock = &r->module->KIT_STOCK_records[p->record->stock_first + i];
        good = tn_buffer_printf(r->page.text, "%s%u x ", i ? ", " : "<tr><td>stock</td><td>", (unsigned)stock->most) &&
               tn_page_text(&r->page, tn_text(r->module, r->module->KIT_PART_records[stock->part].name));
    }
    return good && (!p->record->stock_count || tn_page_html(&r->page, "</td></tr>\n"));
}

static bool put_model_head(const kit_reporting *r, const placed *p)
{
    const tn_kit_model_record *m = p->record;
    return tn_buffer_printf(r->page.text, "<section class=\"card\" id=\"model-%u\"><h3>", (unsigned)p->index) &&
           tn_page_text(&r->page, tn_text(r->module, m->name)) && tn_page_html(&r->page, " <small>") &&
           tn_page_text(&r->page, tn_text(r->module, m->doc)) && tn_page_html(&r->page, "</small></h3>\n<pre>") &&
           kit_report_source(r, m->file, m->begin, m->end) &&
           tn_page_html(&r->page, "</pre>\n<table class=\"words\">\n") && put_space(r, p) && put_start(r, p) &&
           put_search(r, p) && put_objective(r, p) && put_stock(r, p) && tn_page_html(&r->page, "</table>\n");
}

/* ---- placing */

/* What placing finds is the model's, and not the file's. */
static void place(kit_reporting *r, placed *p)
{
    const tn_place_options options = {.seed = r->options.seed,
                                      .part_limit = r->options.part_limit,
                                      .step_limit = r->options.step_limit,
                                      .search_limit = r->options.search_limit,
                                      .threads = 1, /* where a limit ends a search does not depend on others then */
                                      .watch = r->options.watch};
    tn_diagnostics own = r->opened->compilation.diagnostics;
    tn_diagnostics_init(&r->opened->compilation.diagnostics, &r->opened->compilation.sources);
    p->status = tn_place_model(r->opened, &p->rules, &options, &p->model);
    p->found = r->opened->compilation.diagnostics;
    r->opened->compilation.diagnostics = own;
    tn_diagnostics_sort(&p->found);
    if (p->found.failed || p->status == TN_MEMORY)
        p->status = tn_fail_memory(r->page.error);
    if (p->found.stopped || p->status == TN_STOPPED)
        p->status = tn_fail_stopped(r->options.watch, r->page.error);
}

static bool is_small(const tn_kit_model_record *m)
{
    double cells = (double)(m->high_x - m->low_x) * (double)(m->high_y - m->low_y) * (double)(m->high_z - m->low_z);
    return cells <= SPACE_CELLS_MAX;
}

/* How many cells the space has, where they are few enough to be looked at. */
static tn_status count_inside(kit_reporting *r, placed *p)
{
    tn_space *space;
    p->fill_known = is_small(p->record);
    if (!p->fill_known)
        return TN_OK;
    tn_status status = tn_space_new(&p->rules, &space, r->page.error);
    if (status != TN_OK)
        return status;
    status = tn_space_count(space, r->options.watch, &p->inside, r->page.error);
    tn_space_free(space);
    return status;
}

/* ---- what was placed */

static bool put_outcome(const kit_reporting *r, const placed *p)
{
    const char *s = p->model.count == 1 ? "" : "s";
    bool good = true;
    if (is_whole(p))
        good = tn_buffer_printf(r->page.text, "<p><b>Placed with seed %u: %zu part%s</b>", (unsigned)r->options.seed,
                                p->model.count, s);
    else
        good = tn_buffer_printf(r->page.text, "<p><b>Not placed to its end.</b> %zu part%s %s placed before",
                                p->model.count, s, p->model.count == 1 ? "was" : "were");
    if (good && p->model.counts.looked_at)
        good = tn_buffer_printf(r->page.text, ", the best of %" PRIu64 " models that were looked at%s",
                                p->model.counts.looked_at,
                                p->model.counts.proved ? "; the rules allow no better one" : "");
    good = good && tn_page_html(&r->page, is_whole(p) ? ".</p>\n" : "; <code>tartan place</code> says more.</p>\n");
    for (size_t i = 0; good && i < p->found.count; i++)
        if (p->found.items[i].message)
            good = tn_page_finding(&r->page, r->opened, &p->found.items[i]);
    return good;
}

/* A picture that cannot be drawn is said, and the page goes on. */
static tn_status put_model_picture(kit_reporting *r, const placed *p)
{
    tn_picture picture = tn_page_next_picture(&r->page);
    picture.watch = r->options.watch;
    tn_status status = tn_placed_draw(r->module, &p->model, &p->measures, NULL, NULL, &picture, r->page.error);
    if (status != TN_INVALID && status != TN_LIMIT)
        return tn_page_put_picture(&r->page, &picture, tn_text(r->module, p->record->name), status);
    free(picture.element);
    return tn_page_written(&r->page, tn_page_html(&r->page, "<p class=\"quiet\">There is no picture: ") &&
                                         tn_page_text(&r->page, r->page.error->message) &&
                                         tn_page_html(&r->page, ".</p>\n"));
}

static bool put_value(const kit_reporting *r, const char *what, const char *of, double value)
{
    return tn_page_html(&r->page, "<tr><td>") && tn_page_html(&r->page, what) &&
           (!of || (tn_page_html(&r->page, "(") && tn_page_text(&r->page, of) && tn_page_html(&r->page, ")"))) &&
           tn_buffer_printf(r->page.text, "</td><td>%.10g</td></tr>\n", value);
}

static bool put_terms(const kit_reporting *r, const placed *p)
{
    bool good = tn_page_html(&r->page, "<table class=\"parts\"><tr><th>term</th><th>value</th></tr>\n");
    for (int t = 0; good && t < TN_PLACED_X; t++)
        if (t != TN_PLACED_FILL || p->fill_known)
            good = put_value(r, tn_placed_terms[t], NULL, p->measures.terms[t]);
    for (uint32_t c = 0; good && c < r->module->COUNTED_count && c < TN_KIT_COUNTED_MAX; c++)
        good = put_value(r, "count", tn_text(r->module, r->module->COUNTED_records[c].part),
                         p->measures.terms[TN_PLACED_COUNTED + c]);
    return good && tn_page_html(&r->page, "</table>\n") &&
           (p->fill_known || tn_buffer_printf(r->page.text,
                                              "<p class=\"quiet\">fill is not known: more than %d cells lie around the "
                                              "space, and are not counted here.</p>\n",
                                              SPACE_CELLS_MAX));
}

static tn_status put_counts(kit_reporting *r, const placed *p)
{
    tn_part_count *counts;
    size_t kinds;
    tn_status status = tn_place_count_parts(&p->model, &counts, &kinds, r->page.error);
    if (status != TN_OK)
        return status;
    bool good = tn_page_html(&r->page, "<table class=\"parts\"><tr><th>part</th><th>colour</th><th>number</th></tr>\n");
    for (size_t i = 0; good && i < kinds; i++)
        good = tn_page_html(&r->page, "<tr><td>") && tn_page_text(&r->page, counts[i].name) &&
               tn_buffer_printf(r->page.text, "</td><td>%d</td><td>%" PRIu64 "</td></tr>\n", (int)counts[i].colour,
                                counts[i].count);
    free(counts);
    return tn_page_written(&r->page, good && tn_page_html(&r->page, "</table>\n"));
}

/* ---- requirements */

/* Does it hang on how full the space is, which is not known? */
static bool is_unknown(const kit_reporting *r, const placed *p, uint32_t function)
{
    return !p->fill_known && tn_number_asked(r->module, function) >> TN_PLACED_FILL & 1;
}

static bool put_condition(const kit_reporting *r, const placed *p, const tn_kit_condition_record *c)
{
    const bool test = c->flags & TN_CONDITION_TEST;
    bool unknown = !is_whole(p) || is_unknown(r, p, c->holds);
    bool holds = !unknown && tn_kit_condition_holds(r->module, c->holds, &p->measures);
    r->tally->unmet += !unknown && !holds && !test;
    return tn_page_html(&r->page, "<tr><td><code>") && kit_report_source(r, c->file, c->begin, c->end) &&
           tn_buffer_printf(r->page.text, "</code></td><td>%s</td><td>%s</td></tr>\n",
                            test ? "a test expects it" : "required",
                            unknown ? "not known"
                            : holds ? "holds"
                                    : "<b>does not hold</b>");
}

static bool put_conditions(const kit_reporting *r, const placed *p)
{
    const uint32_t count = p->record->condition_count;
    if (count == 0)
        return tn_page_html(&r->page, "<p class=\"quiet\">The model requires nothing.</p>\n");
    bool good = tn_page_html(&r->page, "<table class=\"words\"><tr><th>condition</th><th></th><th></th></tr>\n");
    for (uint32_t i = 0; good && i < count; i++)
        good = put_condition(r, p, &r->module->KIT_CONDITION_records[p->record->condition_first + i]);
    return good && tn_page_html(&r->page, "</table>\n");
}

/* ---- cards */

static tn_status put_placed(kit_reporting *r, placed *p)
{
    if (p->model.count == 0)
        return tn_page_written(&r->page, put_conditions(r, p));
    tn_status status =
        tn_placed_measure_inside(r->module, p->inside, &p->model, r->options.watch, &p->measures, r->page.error);
    if (status == TN_OK)
        status = put_model_picture(r, p);
    if (status == TN_OK)
        status = tn_page_written(&r->page, put_conditions(r, p) && tn_page_html(&r->page, "<div class=\"side\">\n") &&
                                               put_terms(r, p));
    if (status == TN_OK)
        status = put_counts(r, p);
    return status == TN_OK ? tn_page_written(&r->page, tn_page_html(&r->page, "</div>\n")) : status;
}

static tn_status put_model(kit_reporting *r, uint32_t index)
{
    placed p = {.index = index, .record = &r->module->KIT_MODEL_records[index]};
    tn_status status = tn_place_rules_of_model(r->module, index, &p.rules, r->page.error);
    if (status == TN_OK)
        status = count_inside(r, &p);
    if (status == TN_OK)
        status = tn_page_written(&r->page, put_model_head(r, &p));
    if (status == TN_OK) {
        place(r, &p);
        r->tally->unplaced += !is_whole(&p);
        status = p.status == TN_INVALID || p.status == TN_LIMIT ? TN_OK : p.status;
    }
    if (status == TN_OK)
        status = tn_page_written(&r->page, put_outcome(r, &p));
    if (status == TN_OK)
        status = put_placed(r, &p);
    if (status == TN_OK)
        status = tn_page_written(&r->page, tn_page_html(&r->page, "</section>\n"));
    tn_placed_measures_clear(&p.measures);
    tn_placed_model_clear(&p.model);
    tn_place_rules_clear(&p.rules);
    tn_diagnostics_clear(&p.found);
    return status;
}

static tn_status kit_report_models(kit_reporting *r)
{
    tn_status status = tn_page_written(&r->page, tn_page_html(&r->page, "<h2 id=\"models\">Models</h2>\n"));
    if (status == TN_OK && r->module->KIT_MODEL_count == 0)
        status = tn_page_written(&r->page, tn_page_html(&r->page, "<p class=\"quiet\">The kit has no model.</p>\n"));
    for (uint32_t i = 0; status == TN_OK && i < r->module->KIT_MODEL_count; i++)
        status = put_model(r, i);
    return status;
}

/* ---- parts: a card for each, with its picture and its connectors */

static const char *const axes[TN_AXIS_COUNT] = {
    [TN_AXIS_UP] = "up",       [TN_AXIS_DOWN] = "down",   [TN_AXIS_LEFT] = "left",
    [TN_AXIS_RIGHT] = "right", [TN_AXIS_FRONT] = "front", [TN_AXIS_BACK] = "back"};

static const tn_part_connector_record *connector(const kit_reporting *r, const tn_kit_part_record *part, uint32_t i)
{
    return &r->module->PART_CONNECTOR_records[part->connector_first + i];
}

/* ---- size */

static bool put_size(const kit_reporting *r, const tn_kit_part_record *part)
{
    if (part->box_count == 0)
        return tn_page_html(&r->page, "<p>fills nothing");
    const tn_part_box_record *box = &r->module->PART_BOX_records[part->box_first];
    int64_t low[3] = {box->low_x, box->low_y, box->low_z}, high[3] = {box->high_x, box->high_y, box->high_z};
    for (uint32_t b = 1; b < part->box_count; b++) {
        const int64_t lows[3] = {box[b].low_x, box[b].low_y, box[b].low_z};
        const int64_t highs[3] = {box[b].high_x, box[b].high_y, box[b].high_z};
        for (int k = 0; k < 3; k++) {
            low[k] = lows[k] < low[k] ? lows[k] : low[k];
            high[k] = highs[k] > high[k] ? highs[k] : high[k];
        }
    }
    bool good = tn_buffer_printf(r->page.text, "<p>%lld x %lld x %lld cells (%.10g x %.10g x %.10g LDU)",
                                 (long long)(high[0] - low[0]), (long long)(high[1] - low[1]),
                                 (long long)(high[2] - low[2]), r->unit[0] * (double)(high[0] - low[0]),
                                 r->unit[1] * (double)(high[1] - low[1]), r->unit[2] * (double)(high[2] - low[2]));
    return good && (part->box_count == 1 ||
                    tn_buffer_printf(r->page.text, ", of which it fills %u boxes", (unsigned)part->box_count));
}

/* ---- connectors */

static bool is_alike(const tn_part_connector_record *a, const tn_part_connector_record *b)
{
    return a->type == b->type && a->axis == b->axis;
}

/* A length of so many cells: 0 is never -0. */
static double length(double unit, int64_t cells)
{
    return cells ? unit * (double)cells : 0;
}

/* A row for all connectors of a kind and direction, from the first of them. */
static bool put_connector_row(const kit_reporting *r, const tn_kit_part_record *part, uint32_t first)
{
    const tn_part_connector_record *one = connector(r, part, first);
    uint32_t count = 0;
    for (uint32_t i = first; i < part->connector_count; i++)
        count += is_alike(one, connector(r, part, i));
    bool good = tn_page_html(&r->page, "<tr><td>") && kit_report_type(r, one->type) &&
                tn_buffer_printf(r->page.text, "</td><td>%s</td><td>%u</td><td>", axes[one->axis], (unsigned)count);
    for (uint32_t i = first; good && i < part->connector_count; i++) {
        const tn_part_connector_record *at = connector(r, part, i);
        if (is_alike(one, at))
            good = tn_buffer_printf(r->page.text, "%s(%.10g, %.10g, %.10g)", i == first ? "" : " ",
                                    length(r->unit[0], at->x), length(r->unit[1], -at->y), length(r->unit[2], at->z));
    }
    return good && tn_page_html(&r->page, "</td></tr>\n");
}

static bool put_connectors(const kit_reporting *r, const tn_kit_part_record *part)
{
    if (part->connector_count == 0)
        return tn_page_html(&r->page, "<p class=\"quiet\">It has no connectors.</p>\n");
    bool good =
        tn_page_html(&r->page, "<table class=\"words\"><tr><th>connector</th><th>points</th><th></th><th>at</th>"
                               "</tr>\n");
    for (uint32_t i = 0; good && i < part->connector_count; i++) {
        uint32_t before = 0;
        while (before < i && !is_alike(connector(r, part, before), connector(r, part, i)))
            before++;
        good = before < i || put_connector_row(r, part, i);
    }
    return good && tn_page_html(&r->page, "</table>\n");
}

/* ---- cards */

static bool put_title(const kit_reporting *r, uint32_t index)
{
    const tn_kit_part_record *part = &r->module->KIT_PART_records[index];
    return tn_buffer_printf(r->page.text, "<section class=\"card\" id=\"part-%u\"><h3>", (unsigned)index) &&
           tn_page_text(&r->page, tn_text(r->module, part->name)) && tn_page_html(&r->page, " <small>") &&
           tn_page_text(&r->page, tn_text(r->module, part->title)) && tn_page_html(&r->page, "</small></h3>\n");
}

static bool put_figures(const kit_reporting *r, const tn_kit_part_record *part)
{
    return put_size(r, part) && (part->mass == 0 || tn_buffer_printf(r->page.text, "; mass %.10g", part->mass)) &&
           (part->price == 0 || tn_buffer_printf(r->page.text, "; price %.10g", part->price)) &&
           tn_page_html(&r->page, "</p>\n");
}

static tn_status put_part_picture(kit_reporting *r, uint32_t index)
{
    const tn_kit_part_record *part = &r->module->KIT_PART_records[index];
    if (part->box_count == 0 || index >= r->options.pictures)
        return TN_OK;
    tn_picture picture = tn_page_next_picture(&r->page);
    picture.watch = r->options.watch;
    tn_status status = tn_kit_part_draw(r->module, index, &picture, r->page.error);
    return tn_page_put_picture(&r->page, &picture, tn_text(r->module, part->name), status);
}

static tn_status put_part(kit_reporting *r, uint32_t index)
{
    const tn_kit_part_record *part = &r->module->KIT_PART_records[index];
    if (r->options.watch && tn_watch_check(r->options.watch, r->page.error) != TN_OK)
        return TN_STOPPED;
    tn_status status = tn_page_written(&r->page, put_title(r, index));
    if (status == TN_OK)
        status = put_part_picture(r, index);
    if (status == TN_OK)
        status = tn_page_written(&r->page, put_figures(r, part) && put_connectors(r, part) &&
                                               tn_page_html(&r->page, "</section>\n"));
    return status;
}

static bool put_intro(const kit_reporting *r)
{
    const uint32_t count = r->module->KIT_PART_count;
    bool good =
        tn_page_html(&r->page, "<h2 id=\"parts\">Parts</h2>\n<p class=\"quiet\">A stud stands for each connector, "
                               "in the colour of its kind and the direction in which it points.");
    if (good && count > r->options.pictures)
        good = tn_buffer_printf(r->page.text,
                                " The first %zu of %u parts have pictures; <code>--pictures %u</code> "
                                "draws them all.",
                                r->options.pictures, (unsigned)count, (unsigned)count);
    return good && tn_page_html(&r->page, "</p>\n<div class=\"best\">\n");
}

static tn_status kit_report_parts(kit_reporting *r)
{
    tn_status status = tn_page_written(&r->page, put_intro(r));
    for (uint32_t i = 0; status == TN_OK && i < r->module->KIT_PART_count; i++)
        status = put_part(r, i);
    return status == TN_OK ? tn_page_written(&r->page, tn_page_html(&r->page, "</div>\n")) : status;
}

/* ---- what the parts of the page share */

/* A kind of connectors with a square in its colour, as in the pictures of parts. */
static bool kit_report_type(const kit_reporting *r, uint32_t type)
{
    unsigned char rgb[3];
    tn_group_colour(type, rgb);
    return tn_buffer_printf(r->page.text, "<span class=\"swatch\" style=\"background:#%02x%02x%02x\"></span> ",
                            (unsigned)rgb[0], (unsigned)rgb[1], (unsigned)rgb[2]) &&
           tn_page_text(&r->page, tn_text(r->module, r->module->CONNECTOR_TYPE_records[type].name));
}

/* The text of a record's place in its source. */
static bool kit_report_source(const kit_reporting *r, uint32_t file, uint32_t begin, uint32_t end)
{
    const char *text = tn_text(r->module, r->module->SOURCE_records[file].text);
    return tn_page_text_part(&r->page, text + begin, end - begin);
}

/* ---- kinds of connectors */

static bool put_type(const kit_reporting *r, uint32_t type)
{
    static const char *const alike[] = {"", "none", "2 of 4", "", "all"};
    const tn_connector_type_record *record = &r->module->CONNECTOR_TYPE_records[type];
    uint32_t count = 0;
    for (uint32_t i = 0; i < r->module->PART_CONNECTOR_count; i++)
        count += r->module->PART_CONNECTOR_records[i].type == type;
    return tn_page_html(&r->page, "<tr><td>") && kit_report_type(r, type) && tn_page_html(&r->page, "</td><td>") &&
           kit_report_type(r, record->joins) &&
           tn_buffer_printf(r->page.text, "</td><td>%s</td><td>%u</td></tr>\n",
                            record->turns <= 4 ? alike[record->turns] : "", (unsigned)count);
}

static bool put_types(const kit_reporting *r)
{
    const uint32_t count = r->module->CONNECTOR_TYPE_count;
    bool good = tn_page_html(&r->page, "<h2 id=\"connectors\">Connectors</h2>\n");
    if (count == 0)
        return good && tn_page_html(&r->page, "<p class=\"quiet\">The kit has no connectors: its parts join "
                                              "nothing.</p>\n");
    good =
        good && tn_page_html(&r->page, "<table class=\"words\"><tr><th>kind</th><th>joins</th><th>quarter turns that "
                                       "are alike</th><th>connectors of all parts</th></tr>\n");
    for (uint32_t i = 0; good && i < count; i++)
        good = put_type(r, i);
    return good && tn_page_html(&r->page, "</table>\n");
}

/* ---- the page */

static const char *plural(uint32_t count)
{
    return count == 1 ? "" : "s";
}

static bool put_head(const kit_reporting *r)
{
    const tn_module *module = r->module;
    const tn_kit_record *kit = &module->KIT_records[0];
    const char *slash = strrchr(r->opened->path, '/');
    const uint32_t parts = module->KIT_PART_count, types = module->CONNECTOR_TYPE_count,
                   models = module->KIT_MODEL_count;
    char doc[200];
    snprintf(doc, sizeof doc, "A kit with %u part%s, %u kind%s of connectors and %u model%s.", (unsigned)parts,
             plural(parts), (unsigned)types, plural(types), (unsigned)models, plural(models));
    return tn_page_begin(&r->page, tn_text(module, kit->name), doc) && tn_page_html(&r->page, "<p class=\"quiet\">") &&
           tn_page_text(&r->page, slash ? slash + 1 : r->opened->path) &&
           tn_buffer_printf(r->page.text,
                            "; a cell is %.10g x %.10g x %.10g LDU (wide, high, deep); parts %s. Lengths are in LDU, "
                            "which is 0.4 mm, and y points up.</p>\n",
                            r->unit[0], r->unit[1], r->unit[2],
                            kit->turns == 24 ? "turn any of 24 ways" : "stay upright") &&
           tn_page_html(&r->page, "<nav><a href=\"#models\">Models</a> <a href=\"#connectors\">Connectors</a> <a "
                                  "href=\"#rules\">Rules</a> <a href=\"#parts\">Parts</a> <a "
                                  "href=\"#findings\">Warnings</a></nav>\n");
}

static bool put_foot(const kit_reporting *r)
{
    const tn_module *module = r->module;
    return tn_buffer_printf(r->page.text, "<p class=\"quiet\">rules %016" PRIx64 ", seed %u, ",
                            module->PRODUCER_count ? (uint64_t)module->PRODUCER_records[0].sources_hash : 0,
                            (unsigned)r->options.seed) &&
           tn_page_version(&r->page, module) && tn_page_html(&r->page, "</p>\n</html>\n");
}

static tn_kit_report_options with_defaults(const tn_kit_report_options *options)
{
    tn_kit_report_options o = *options;
    o.pictures = o.pictures ? o.pictures : TN_KIT_REPORT_PICTURES;
    o.part_limit = o.part_limit ? o.part_limit : TN_KIT_REPORT_PARTS;
    o.step_limit = o.step_limit ? o.step_limit : TN_KIT_REPORT_STEPS;
    o.search_limit = o.search_limit ? o.search_limit : TN_KIT_REPORT_SEARCH;
    return o;
}

tn_status tn_kit_report_page(tn_opened *opened, const tn_kit_report_options *options, tn_buffer *page,
                             tn_kit_report_tally *tally, tn_error *error)
{
    kit_reporting r = {.opened = opened,
                       .module = opened->module,
                       .options = with_defaults(options),
                       .tally = tally,
                       .page = {.text = page, .error = error}};
    *tally = (tn_kit_report_tally){.models = opened->module->KIT_MODEL_count};
    tn_place_unit(r.module, r.unit);
    tn_status status = tn_page_written(&r.page, put_head(&r));
    if (status == TN_OK)
        status = kit_report_models(&r);
    if (status == TN_OK)
        status = tn_page_written(&r.page, put_types(&r));
    if (status == TN_OK)
        status = kit_report_rules(&r);
    if (status == TN_OK)
        status = kit_report_parts(&r);
    return status == TN_OK ? tn_page_written(&r.page, tn_page_findings(&r.page, opened) && put_foot(&r)) : status;
}
