/* The models of a kit's report: each is placed, drawn, measured, and held to what it requires. */
#include <inttypes.h>
#include <stdlib.h>

#include "driver/place/kit.h"
#include "driver/place/shape.h"
#include "driver/report/kit_data.h"
#include "runtime/module/code.h"
#include "runtime/number/run.h"
#include "runtime/place/space.h"
#include "runtime/place/write.h"

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

static bool put_source(const tn_kit_reporting *r, const char *what, uint32_t file, uint32_t begin, uint32_t end)
{
    return tn_page_html(&r->page, "<tr><td>") && tn_page_html(&r->page, what) &&
           tn_page_html(&r->page, "</td><td><code>") && tn_kit_report_source(r, file, begin, end) &&
           tn_page_html(&r->page, "</code></td></tr>\n");
}

static bool put_space(const tn_kit_reporting *r, const placed *p)
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
static bool put_start(const tn_kit_reporting *r, const placed *p)
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

static bool put_objective(const tn_kit_reporting *r, const placed *p)
{
    if (p->record->objective == TN_NO_RECORD)
        return true;
    const tn_function_record *f = &r->module->FUNCTION_records[p->record->objective];
    const tn_source_map_record *at = tn_module_place(r->module, f->code_begin);
    return !at || put_source(r, p->record->flags & TN_KIT_MAXIMIZE ? "is to be large" : "is to be small", at->file,
                             at->begin, at->end);
}

static bool put_search(const tn_kit_reporting *r, const placed *p)
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

static bool put_stock(const tn_kit_reporting *r, const placed *p)
{
    bool good = true;
    for (uint32_t i = 0; good && i < p->record->stock_count; i++) {
        const tn_kit_stock_record *stock = &r->module->KIT_STOCK_records[p->record->stock_first + i];
        good = tn_buffer_printf(r->page.text, "%s%u x ", i ? ", " : "<tr><td>stock</td><td>", (unsigned)stock->most) &&
               tn_page_text(&r->page, tn_text(r->module, r->module->KIT_PART_records[stock->part].name));
    }
    return good && (!p->record->stock_count || tn_page_html(&r->page, "</td></tr>\n"));
}

static bool put_head(const tn_kit_reporting *r, const placed *p)
{
    const tn_kit_model_record *m = p->record;
    return tn_buffer_printf(r->page.text, "<section class=\"card\" id=\"model-%u\"><h3>", (unsigned)p->index) &&
           tn_page_text(&r->page, tn_text(r->module, m->name)) && tn_page_html(&r->page, " <small>") &&
           tn_page_text(&r->page, tn_text(r->module, m->doc)) && tn_page_html(&r->page, "</small></h3>\n<pre>") &&
           tn_kit_report_source(r, m->file, m->begin, m->end) &&
           tn_page_html(&r->page, "</pre>\n<table class=\"words\">\n") && put_space(r, p) && put_start(r, p) &&
           put_search(r, p) && put_objective(r, p) && put_stock(r, p) && tn_page_html(&r->page, "</table>\n");
}

/* ---- placing */

/* What placing finds is the model's, and not the file's. */
static void place(tn_kit_reporting *r, placed *p)
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
static tn_status count_inside(tn_kit_reporting *r, placed *p)
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

static bool put_outcome(const tn_kit_reporting *r, const placed *p)
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
static tn_status put_picture(tn_kit_reporting *r, const placed *p)
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

static bool put_value(const tn_kit_reporting *r, const char *what, const char *of, double value)
{
    return tn_page_html(&r->page, "<tr><td>") && tn_page_html(&r->page, what) &&
           (!of || (tn_page_html(&r->page, "(") && tn_page_text(&r->page, of) && tn_page_html(&r->page, ")"))) &&
           tn_buffer_printf(r->page.text, "</td><td>%.10g</td></tr>\n", value);
}

static bool put_terms(const tn_kit_reporting *r, const placed *p)
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

static tn_status put_counts(tn_kit_reporting *r, const placed *p)
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
static bool is_unknown(const tn_kit_reporting *r, const placed *p, uint32_t function)
{
    return !p->fill_known && tn_number_asked(r->module, function) >> TN_PLACED_FILL & 1;
}

static bool put_condition(const tn_kit_reporting *r, const placed *p, const tn_kit_condition_record *c)
{
    const bool test = c->flags & TN_CONDITION_TEST;
    bool unknown = !is_whole(p) || is_unknown(r, p, c->holds);
    bool holds = !unknown && tn_kit_condition_holds(r->module, c->holds, &p->measures);
    r->tally->unmet += !unknown && !holds && !test;
    return tn_page_html(&r->page, "<tr><td><code>") && tn_kit_report_source(r, c->file, c->begin, c->end) &&
           tn_buffer_printf(r->page.text, "</code></td><td>%s</td><td>%s</td></tr>\n",
                            test ? "a test expects it" : "required",
                            unknown ? "not known"
                            : holds ? "holds"
                                    : "<b>does not hold</b>");
}

static bool put_conditions(const tn_kit_reporting *r, const placed *p)
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

static tn_status put_placed(tn_kit_reporting *r, placed *p)
{
    if (p->model.count == 0)
        return tn_page_written(&r->page, put_conditions(r, p));
    tn_status status =
        tn_placed_measure_inside(r->module, p->inside, &p->model, r->options.watch, &p->measures, r->page.error);
    if (status == TN_OK)
        status = put_picture(r, p);
    if (status == TN_OK)
        status = tn_page_written(&r->page, put_conditions(r, p) && tn_page_html(&r->page, "<div class=\"side\">\n") &&
                                               put_terms(r, p));
    if (status == TN_OK)
        status = put_counts(r, p);
    return status == TN_OK ? tn_page_written(&r->page, tn_page_html(&r->page, "</div>\n")) : status;
}

static tn_status put_model(tn_kit_reporting *r, uint32_t index)
{
    placed p = {.index = index, .record = &r->module->KIT_MODEL_records[index]};
    tn_status status = tn_place_rules_of_model(r->module, index, &p.rules, r->page.error);
    if (status == TN_OK)
        status = count_inside(r, &p);
    if (status == TN_OK)
        status = tn_page_written(&r->page, put_head(r, &p));
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

tn_status tn_kit_report_models(tn_kit_reporting *r)
{
    tn_status status = tn_page_written(&r->page, tn_page_html(&r->page, "<h2 id=\"models\">Models</h2>\n"));
    if (status == TN_OK && r->module->KIT_MODEL_count == 0)
        status = tn_page_written(&r->page, tn_page_html(&r->page, "<p class=\"quiet\">The kit has no model.</p>\n"));
    for (uint32_t i = 0; status == TN_OK && i < r->module->KIT_MODEL_count; i++)
        status = put_model(r, i);
    return status;
}
