/* The rules of a report: a card for each clause of the library. */
#include <stdlib.h>

#include "driver/findings.h"
#include "driver/report_data.h"
#include "runtime/plan/draw_rule.h"

/* A clause and what is known of it. */
typedef struct card {
    const tn_clause_record *clause;
    uint32_t index; /* in the library */
    uint32_t rule;  /* RULE record whose name the clause is, or UINT32_MAX */
    const char *name, *doc;
    bool prunes;
} card;

static card card_of(const tn_reporting *r, uint32_t index)
{
    const tn_clause_record *clause = &r->module->CLAUSE_records[r->ready->record->clause_first + index];
    card c = {.clause = clause,
              .index = index,
              .rule = tn_function_rule(r->module, clause->holds),
              .name = tn_text(r->module, clause->name),
              .doc = tn_text(r->module, clause->doc),
              .prunes = clause->kind == TN_CLAUSE_PRUNE};
    if (!*c.doc && c.rule != UINT32_MAX)
        c.doc = tn_text(r->module, r->module->RULE_records[c.rule].doc);
    return c;
}

/* A name that clauses share (a total of a library and one of the library that it is from) is told apart by a number. */
static bool put_id(const tn_reporting *r, const card *c)
{
    uint32_t before = 0;
    for (uint32_t i = 0; i < c->index; i++)
        before += strcmp(card_of(r, i).name, c->name) == 0;
    return tn_report_text(r, c->name) && (!before || tn_buffer_printf(r->page, ".%u", before + 1));
}

static bool put_title(const tn_reporting *r, const card *c)
{
    static const char *const kinds[] = {"required", "required", "prunes"};
    return tn_report_html(r, "<section class=\"card\" id=\"rule-") && put_id(r, c) && tn_report_html(r, "\"><h3>") &&
           tn_report_text(r, c->name) && tn_report_html(r, " <small>") && tn_report_html(r, kinds[c->clause->kind]) &&
           tn_report_html(r, "</small></h3>\n<p>") && tn_report_text(r, c->doc) && tn_report_html(r, "</p>\n");
}

/* A count, and what share of `whole` it is; or that there is none. */
static bool put_count(const tn_reporting *r, const char *what, const mpz_t count, const mpz_t whole, const char *of)
{
    if (mpz_sgn(count) < 0)
        return tn_report_html(r, what) && tn_report_html(r, " <b>not counted</b>: past the limit of states");
    return tn_report_html(r, what) && tn_report_html(r, " <b>") && tn_report_number(r, count) &&
           tn_report_html(r, "</b>") &&
           (!of || (tn_report_html(r, " (") && tn_report_share(r, count, whole) && tn_report_html(r, of)));
}

/* How many plans there are of the library's lengths, whatever the clauses say. */
static void count_all(const tn_reporting *r, mpz_t all)
{
    const tn_library *library = r->ready->library;
    mpz_t plans;
    mpz_init(plans);
    mpz_set_ui(all, 0);
    for (uint32_t length = tn_library_min(library); length <= tn_library_max(library); length++) {
        mpz_ui_pow_ui(plans, r->ready->schema->tray_count, length);
        mpz_add(all, all, plans);
    }
    mpz_clear(plans);
}

/* How much a clause keeps out, and how much only it does. */
static tn_status put_counts(const tn_reporting *r, const card *c)
{
    uint32_t states;
    mpz_t out, only, whole;
    mpz_inits(out, only, whole, NULL);
    tn_status status = tn_library_effect(r->ready->library, c->index, out, only, &states, r->error);
    if (status == TN_LIMIT) {
        tn_finding_uncounted(r->opened, c->name, r->error);
        status = TN_OK;
    }
    if (!c->prunes)
        count_all(r, whole);
    else if (status == TN_OK)
        status = tn_library_generated(r->ready->library, TN_ALL_LENGTHS, whole, r->error);
    if (status == TN_OK)
        status = tn_report_written(
            r, tn_report_html(r, "<p class=\"counts\">") &&
                   put_count(r, c->prunes ? "prunes" : "keeps out", out, whole,
                             c->prunes ? " of what is generated)" : " of all plans of these lengths)") &&
                   tn_report_html(r, "<br>") && put_count(r, "only it", only, whole, NULL) &&
                   tn_report_html(r, "</p>\n"));
    mpz_clears(out, only, whole, NULL);
    return status;
}

static tn_status put_picture(tn_reporting *r, const card *c)
{
    tn_drawn_rule drawn = {"", "", c->clause->holds};
    tn_picture picture = tn_report_next_picture(r);
    if (c->rule != UINT32_MAX)
        drawn.function = r->module->RULE_records[c->rule].whole;
    tn_status status = tn_rules_draw(r->ready->schema, &drawn, 1, &picture, r->error);
    return tn_report_put_picture(r, &picture, c->name, status);
}

static bool put_source(const tn_reporting *r, const card *c)
{
    const tn_rule_record *rule = c->rule != UINT32_MAX ? &r->module->RULE_records[c->rule] : NULL;
    uint32_t file = rule ? rule->file : c->clause->file;
    const char *text = tn_text(r->module, r->module->SOURCE_records[file].text);
    uint32_t begin = rule ? rule->begin : c->clause->begin, end = rule ? rule->end : c->clause->end;
    return tn_report_html(r, "<pre>") && tn_report_text_part(r, text + begin, end - begin) &&
           tn_report_html(r, "</pre>\n");
}

/* ---- relations */

static const char *rule_name(const tn_reporting *r, uint32_t rule)
{
    return tn_text(r->module, r->module->RULE_records[rule].name);
}

/* A plan that shows a relation: "only x: ..." */
static bool put_witness(const tn_reporting *r, const char *who, const char *name, const tn_shown_plan *plan)
{
    return !plan->shown || (tn_report_html(r, "<br>") && tn_report_html(r, who) && tn_report_text(r, name) &&
                            tn_report_html(r, ": <span class=\"line\">") &&
                            tn_report_plan(r, plan->trays, plan->length) && tn_report_html(r, "</span>"));
}

static tn_status put_relation(const tn_reporting *r, const tn_plan_analysis *analysis, size_t i, size_t j,
                              const char *word)
{
    tn_shown_plan examples[3];
    const char *own = rule_name(r, tn_plan_analysis_rule(analysis, i));
    const char *other = rule_name(r, tn_plan_analysis_rule(analysis, j));
    tn_status status = tn_plan_analysis_examples(analysis, i, j, examples, r->error);
    if (status == TN_OK)
        status = tn_report_written(r, tn_report_html(r, "<p class=\"quiet\">") && tn_report_html(r, word) &&
                                          tn_report_html(r, " <b>") && tn_report_text(r, other) &&
                                          tn_report_html(r, "</b>") && put_witness(r, "both", "", &examples[0]) &&
                                          put_witness(r, "only ", own, &examples[1]) &&
                                          put_witness(r, "only ", other, &examples[2]) && tn_report_html(r, "</p>\n"));
    for (int e = 0; e < 3; e++)
        tn_shown_plan_clear(&examples[e]);
    return status == TN_LIMIT ? TN_OK : status;
}

/* What rule i of an analysis shares with the others; those that merely overlap are counted. */
static tn_status put_relations_of(const tn_reporting *r, const tn_plan_analysis *analysis, size_t i)
{
    static const char *const words[] = {[TN_RULES_EQUAL] = "matches the same plans as",
                                        [TN_RULES_APART] = "has no plan in common with",
                                        [TN_RULES_INSIDE] = "all that it matches is matched by",
                                        [TN_RULES_CONTAINS] = "matches all that is matched by",
                                        [TN_RULES_UNKNOWN] = NULL,
                                        [TN_RULES_OVERLAP] = NULL};
    size_t overlaps = 0, unknown = 0, count = tn_plan_analysis_rule_count(analysis);
    tn_status status = TN_OK;
    for (size_t j = 0; status == TN_OK && j < count; j++) {
        if (j == i)
            continue;
        tn_rule_relation relation = tn_plan_analysis_relation(analysis, i, j);
        overlaps += relation == TN_RULES_OVERLAP;
        unknown += relation == TN_RULES_UNKNOWN;
        if (words[relation])
            status = put_relation(r, analysis, i, j, words[relation]);
    }
    bool good = status == TN_OK && (!overlaps || tn_buffer_printf(r->page,
                                                                  "<p class=\"quiet\">overlaps with %zu of the %zu "
                                                                  "other rules</p>\n",
                                                                  overlaps, count - 1));
    good = good && (!unknown || tn_buffer_printf(r->page,
                                                 "<p class=\"quiet\">not compared with %zu rules: past the limit of "
                                                 "states</p>\n",
                                                 unknown));
    return status == TN_OK ? tn_report_written(r, good) : status;
}

static tn_status put_relations(const tn_reporting *r, const card *c)
{
    tn_status status = TN_OK;
    for (size_t a = 0; a < r->analyses->count; a++) {
        const tn_plan_analysis *analysis = r->analyses->items[a];
        for (size_t i = 0; status == TN_OK && i < tn_plan_analysis_rule_count(analysis); i++)
            if (c->rule != UINT32_MAX && tn_plan_analysis_rule(analysis, i) == c->rule)
                status = put_relations_of(r, analysis, i);
    }
    return status;
}

/* ---- the shortest plan that only this clause keeps out */

static tn_status put_alone(tn_reporting *r, const card *c, const tn_shown_plan *plan)
{
    tn_explained explained;
    tn_status status = tn_explained_make(&explained, r->opened, r->ready->schema, r->ready->record, NULL, 0,
                                         plan->trays, plan->length, plan->length + 1, r->error);
    if (status == TN_OK)
        status = tn_report_written(
            r, tn_report_html(r, "<details><summary>the shortest plan that only this keeps out</summary>\n"));
    if (status == TN_OK)
        status = tn_report_put_explained(r, &explained, c->name);
    if (status == TN_OK)
        status = tn_report_written(r, tn_report_html(r, "<p class=\"line\">") &&
                                          tn_report_plan(r, plan->trays, plan->length) &&
                                          tn_report_html(r, "</p></details>\n"));
    tn_explained_clear(&explained);
    return status;
}

static tn_status put_witness_alone(tn_reporting *r, const card *c)
{
    tn_status status = TN_OK;
    for (size_t a = 0; status == TN_OK && a < r->analyses->count; a++) {
        tn_shown_plan plan;
        if (r->analyses->schemas[a]->record != r->ready->schema->record || (r->ready->record->flags & TN_IMPORTED))
            continue;
        status = tn_plan_analysis_alone(r->analyses->items[a], r->ready->index, c->index, &plan, r->error);
        if (status == TN_OK && plan.shown)
            status = put_alone(r, c, &plan);
        else if (status == TN_LIMIT)
            status = tn_report_written(
                r, tn_report_html(r, "<p class=\"quiet\">Whether it alone keeps a plan out is not analysed: past the "
                                     "limit of states.</p>\n"));
        tn_shown_plan_clear(&plan);
    }
    return status;
}

/* ---- coverage */

static bool put_part(const tn_reporting *r, const tn_covered_part *part)
{
    return tn_buffer_printf(r->page, "<tr><td style=\"padding-left:%uem\">", part->depth < 12 ? part->depth : 12) &&
           tn_report_text(r, part->text) && tn_report_html(r, "</td><td>") && tn_report_number(r, part->flips) &&
           tn_buffer_printf(r->page, "</td><td>%s</td></tr>\n", part->noticed ? "yes" : "<b>no</b>");
}

static bool put_coverage(const tn_reporting *r, const card *c)
{
    size_t parts = 0, noticed = 0;
    for (size_t i = 0; i < r->covered->count; i++)
        if (r->covered->parts[i].function == c->clause->holds) {
            parts++;
            noticed += r->covered->parts[i].noticed;
        }
    if (parts == 0)
        return true;
    bool good = tn_buffer_printf(r->page,
                                 "<details><summary>coverage: tests notice %zu of %zu parts</summary>\n<table "
                                 "class=\"parts\"><tr><th>if this part never matched</th><th>plans decided "
                                 "otherwise</th><th>a test notices</th></tr>\n",
                                 noticed, parts);
    for (size_t i = 0; good && i < r->covered->count; i++)
        if (r->covered->parts[i].function == c->clause->holds)
            good = put_part(r, &r->covered->parts[i]);
    return good && tn_report_html(r, "</table></details>\n");
}

/* ---- all */

static tn_status put_card(tn_reporting *r, const card *c)
{
    tn_status status = tn_report_written(r, put_title(r, c));
    if (status == TN_OK)
        status = put_counts(r, c);
    if (status == TN_OK)
        status = put_picture(r, c);
    if (status == TN_OK)
        status = tn_report_written(r, put_source(r, c));
    if (status == TN_OK)
        status = put_relations(r, c);
    if (status == TN_OK)
        status = put_witness_alone(r, c);
    return status == TN_OK ? tn_report_written(r, put_coverage(r, c) && tn_report_html(r, "</section>\n")) : status;
}

tn_status tn_report_rules(tn_reporting *r)
{
    tn_status status = tn_report_written(r, tn_report_html(r, "<h2 id=\"rules\">Rules</h2>\n"));
    for (uint32_t i = 0; status == TN_OK && i < r->ready->record->clause_count; i++) {
        card c = card_of(r, i);
        status = put_card(r, &c);
    }
    return status;
}
