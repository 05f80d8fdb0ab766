/* The rules of a report: a card for each clause of the library, and for each rule of the file that is none. */
#include <stdlib.h>

#include "driver/open/open.h"
#include "driver/report/reporting.h"
#include "runtime/plan/picture/draw_rule.h"

/* A clause or rule and what is known of it. */
typedef struct card {
    uint32_t index; /* of the clause in the library; of a rule that is none, the number of clauses */
    uint32_t rule;  /* RULE record whose name the clause is, or UINT32_MAX */
    uint32_t function;
    const char *name, *doc, *kind;
    bool prunes;
    uint32_t file, begin, end; /* its text */
} card;

static uint32_t clause_count(const tn_reporting *r)
{
    return r->ready->record->clause_count;
}

static const tn_clause_record *clause_record(const tn_reporting *r, uint32_t index)
{
    return &r->module->CLAUSE_records[r->ready->record->clause_first + index];
}

static card card_of_rule(const tn_reporting *r, uint32_t index)
{
    const tn_rule_record *rule = &r->module->RULE_records[index];
    return (card){.index = clause_count(r),
                  .rule = index,
                  .function = rule->holds,
                  .name = tn_text(r->module, rule->name),
                  .doc = tn_text(r->module, rule->doc),
                  .kind = "neither pruned nor required",
                  .file = rule->file,
                  .begin = rule->begin,
                  .end = rule->end};
}

static card card_of(const tn_reporting *r, uint32_t index)
{
    static const char *const kinds[TN_CLAUSE_KIND_COUNT] = {[TN_CLAUSE_REQUIRE] = "required",
                                                            [TN_CLAUSE_TOTAL] = "required",
                                                            [TN_CLAUSE_PRUNE] = "prunes",
                                                            [TN_CLAUSE_GENERATE] = "generates",
                                                            [TN_CLAUSE_ONTO] = "projected"};
    const tn_clause_record *clause = clause_record(r, index);
    const char *doc = tn_text(r->module, clause->doc);
    uint32_t rule = tn_function_rule(r->module, clause->holds);
    card c = {.rule = rule, .file = clause->file, .begin = clause->begin, .end = clause->end};
    if (rule != UINT32_MAX)
        c = card_of_rule(r, rule);
    c.index = index;
    c.function = clause->holds;
    c.name = tn_text(r->module, clause->name);
    if (*doc || rule == UINT32_MAX)
        c.doc = doc;
    c.kind = kinds[clause->kind];
    c.prunes = clause->kind == TN_CLAUSE_PRUNE;
    return c;
}

/* A name that clauses share (a total of a library and one of the library that it is from) is told apart by a number. */
static bool put_id(const tn_reporting *r, const card *c)
{
    uint32_t before = 0;
    for (uint32_t i = 0; i < c->index; i++)
        before += strcmp(tn_text(r->module, clause_record(r, i)->name), c->name) == 0;
    return tn_page_text(&r->page, c->name) && (!before || tn_buffer_printf(r->page.text, ".%u", before + 1));
}

static bool put_title(const tn_reporting *r, const card *c)
{
    return tn_page_html(&r->page, "<section class=\"card\" id=\"rule-") && put_id(r, c) &&
           tn_page_html(&r->page, "\"><h3>") && tn_page_text(&r->page, c->name) && tn_page_html(&r->page, " <small>") &&
           tn_page_html(&r->page, c->kind) && tn_page_html(&r->page, "</small></h3>\n<p>") &&
           tn_page_text(&r->page, c->doc) && tn_page_html(&r->page, "</p>\n");
}

/* A count, and what share of `whole` it is; or that there is none. */
static bool put_count(const tn_reporting *r, const char *what, const mpz_t count, const mpz_t whole, const char *of)
{
    if (mpz_sgn(count) < 0)
        return tn_page_html(&r->page, what) && tn_page_html(&r->page, " <b>not counted</b>: past the limit of states");
    return tn_page_html(&r->page, what) && tn_page_html(&r->page, " <b>") && tn_report_number(r, count) &&
           tn_page_html(&r->page, "</b>") &&
           (!of || (tn_page_html(&r->page, " (") && tn_report_share(r, count, whole) && tn_page_html(&r->page, of)));
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
    tn_status status = tn_library_effect(r->ready->library, c->index, out, only, &states, r->page.error);
    if (status == TN_LIMIT) {
        tn_finding_uncounted(r->opened, c->name, r->page.error);
        status = TN_OK;
    }
    if (!c->prunes)
        count_all(r, whole);
    else if (status == TN_OK)
        status = tn_library_generated(r->ready->library, TN_ALL_LENGTHS, whole, r->page.error);
    if (status == TN_OK)
        status = tn_page_written(
            &r->page, tn_page_html(&r->page, "<p class=\"counts\">") &&
                          put_count(r, c->prunes ? "prunes" : "keeps out", out, whole,
                                    c->prunes ? " of what is generated)" : " of all plans of these lengths)") &&
                          tn_page_html(&r->page, "<br>") && put_count(r, "kept out by this alone", only, whole, NULL) &&
                          tn_page_html(&r->page, "</p>\n"));
    mpz_clears(out, only, whole, NULL);
    return status;
}

static tn_status put_picture(tn_reporting *r, const card *c)
{
    tn_drawn_rule drawn = {"", "", c->function};
    tn_picture picture = tn_page_next_picture(&r->page);
    if (c->rule != UINT32_MAX)
        drawn.function = r->module->RULE_records[c->rule].whole;
    tn_status status = tn_rules_draw(r->ready->schema, &drawn, 1, &picture, r->page.error);
    return tn_page_put_picture(&r->page, &picture, c->name, status);
}

static bool put_source(const tn_reporting *r, const card *c)
{
    const char *text = tn_text(r->module, r->module->SOURCE_records[c->file].text);
    return tn_page_html(&r->page, "<pre>") && tn_page_text_part(&r->page, text + c->begin, c->end - c->begin) &&
           tn_page_html(&r->page, "</pre>\n");
}

/* ---- relations */

static const char *rule_name(const tn_reporting *r, uint32_t rule)
{
    return tn_text(r->module, r->module->RULE_records[rule].name);
}

/* A plan that shows a relation: "only x: ..." */
static bool put_witness(const tn_reporting *r, const char *who, const char *name, const tn_shown_plan *plan)
{
    return !plan->shown || (tn_page_html(&r->page, "<br>") && tn_page_html(&r->page, who) &&
                            tn_page_text(&r->page, name) && tn_page_html(&r->page, ": <span class=\"line\">") &&
                            tn_report_plan(r, plan->trays, plan->length) && tn_page_html(&r->page, "</span>"));
}

static tn_status put_relation(const tn_reporting *r, const tn_plan_analysis *analysis, size_t i, size_t j,
                              const char *word)
{
    tn_shown_plan examples[3];
    const char *own = rule_name(r, tn_plan_analysis_rule(analysis, i));
    const char *other = rule_name(r, tn_plan_analysis_rule(analysis, j));
    tn_status status = tn_plan_analysis_examples(analysis, i, j, examples, r->page.error);
    if (status == TN_OK)
        status = tn_page_written(&r->page,
                                 tn_page_html(&r->page, "<p class=\"quiet\">") && tn_page_html(&r->page, word) &&
                                     tn_page_html(&r->page, " <b>") && tn_page_text(&r->page, other) &&
                                     tn_page_html(&r->page, "</b>") && put_witness(r, "both", "", &examples[0]) &&
                                     put_witness(r, "only ", own, &examples[1]) &&
                                     put_witness(r, "only ", other, &examples[2]) && tn_page_html(&r->page, "</p>\n"));
    for (int e = 0; e < 3; e++)
        tn_shown_plan_clear(&examples[e]);
    return status == TN_LIMIT ? TN_OK : status;
}

/* What rule i of an analysis shares with the others. That two rules merely overlap says nothing: most do; and what was
 * not found out is told once, with the limits. */
static tn_status put_relations_of(tn_reporting *r, const tn_plan_analysis *analysis, size_t i)
{
    static const char *const words[] = {[TN_RULES_EQUAL] = "matches the same plans as",
                                        [TN_RULES_APART] = "has no plan in common with",
                                        [TN_RULES_INSIDE] = "all that it matches is matched by",
                                        [TN_RULES_CONTAINS] = "matches all that is matched by",
                                        [TN_RULES_UNKNOWN] = NULL,
                                        [TN_RULES_OVERLAP] = NULL};
    size_t count = tn_plan_analysis_rule_count(analysis);
    tn_status status = TN_OK;
    for (size_t j = 0; status == TN_OK && j < count; j++) {
        tn_rule_relation relation = j == i ? TN_RULES_OVERLAP : tn_plan_analysis_relation(analysis, i, j);
        if (j > i) { /* each pair once: both rules have a card */
            r->pairs++;
            r->pairs_unknown += relation == TN_RULES_UNKNOWN;
        }
        if (words[relation])
            status = put_relation(r, analysis, i, j, words[relation]);
    }
    return status;
}

static tn_status put_relations(tn_reporting *r, const card *c)
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
                                         plan->trays, plan->length, plan->length + 1, r->page.error);
    if (status == TN_OK)
        status = tn_page_written(
            &r->page,
            tn_page_html(&r->page, "<details><summary>the shortest plan that only this keeps out</summary>\n"));
    if (status == TN_OK)
        status = tn_report_put_explained(r, &explained, c->name);
    if (status == TN_OK)
        status = tn_page_written(&r->page, tn_page_html(&r->page, "<p class=\"line\">") &&
                                               tn_report_plan(r, plan->trays, plan->length) &&
                                               tn_page_html(&r->page, "</p></details>\n"));
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
        status = tn_plan_analysis_alone(r->analyses->items[a], r->ready->library, c->index, &plan, r->page.error);
        if (status == TN_OK && plan.shown) {
            status = put_alone(r, c, &plan);
        } else if (status == TN_LIMIT) {
            r->clauses_unknown++;
            status = TN_OK;
        }
        tn_shown_plan_clear(&plan);
    }
    return status;
}

/* ---- coverage */

static bool put_change(const tn_reporting *r, const tn_covered_part *part)
{
    const char *to = part->change ? part->change->to : NULL;
    return tn_page_html(&r->page, "<tr><td>") && tn_page_text(&r->page, part->text) &&
           tn_page_html(&r->page, "</td><td>") && tn_page_html(&r->page, tn_covered_change_words(part)) &&
           (!to || (tn_page_html(&r->page, " <b>") && tn_page_text(&r->page, to) && tn_page_html(&r->page, "</b>"))) &&
           tn_page_html(&r->page, "</td><td>");
}

static bool put_part(const tn_reporting *r, const tn_covered_part *part)
{
    return put_change(r, part) &&
           (part->counted ? tn_report_number(r, part->flips) : tn_page_html(&r->page, "not counted")) &&
           tn_buffer_printf(r->page.text, "</td><td>%s</td></tr>\n",
                            part->noticed                 ? "yes"
                            : part->fate == TN_FATE_EQUAL ? "none can"
                                                          : "<b>no</b>");
}

static bool put_coverage(const tn_reporting *r, const card *c)
{
    size_t parts = 0, noticed = 0, equal = 0;
    for (size_t i = 0; i < r->covered->count; i++)
        if (r->covered->parts[i].function == c->function) {
            parts++;
            noticed += r->covered->parts[i].noticed;
            equal += r->covered->parts[i].fate == TN_FATE_EQUAL;
        }
    if (parts == 0)
        return true;
    bool good = tn_buffer_printf(r->page.text,
                                 "<details><summary>coverage: tests notice %zu of %zu changes that decide plans "
                                 "otherwise</summary>\n<table class=\"parts\"><tr><th>written</th><th>changed</th>"
                                 "<th>plans decided otherwise</th><th>a test notices</th></tr>\n",
                                 noticed, parts - equal);
    for (size_t i = 0; good && i < r->covered->count; i++)
        if (r->covered->parts[i].function == c->function)
            good = put_part(r, &r->covered->parts[i]);
    return good && tn_page_html(&r->page, "</table></details>\n");
}

/* ---- all */

/* What of a card there is for clauses and other rules alike, its title and counts having been put. */
static tn_status put_body(tn_reporting *r, const card *c)
{
    tn_status status = put_picture(r, c);
    if (status == TN_OK)
        status = tn_page_written(&r->page, put_source(r, c));
    if (status == TN_OK)
        status = put_relations(r, c);
    if (status == TN_OK && c->index < clause_count(r))
        status = put_witness_alone(r, c);
    return status == TN_OK ? tn_page_written(&r->page, put_coverage(r, c) && tn_page_html(&r->page, "</section>\n"))
                           : status;
}

static tn_status put_clauses(tn_reporting *r)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < clause_count(r); i++) {
        card c = card_of(r, i);
        status = tn_page_written(&r->page, put_title(r, &c));
        if (status == TN_OK)
            status = put_counts(r, &c);
        if (status == TN_OK)
            status = put_body(r, &c);
    }
    return status;
}

/* ---- rules that are no clauses */

static bool is_other(const tn_reporting *r, uint32_t rule)
{
    const tn_rule_record *record = &r->module->RULE_records[rule];
    for (uint32_t i = 0; i < clause_count(r); i++)
        if (clause_record(r, i)->holds == record->holds || clause_record(r, i)->holds == record->whole)
            return false;
    return !(record->flags & TN_IMPORTED) && record->schema == r->ready->record->schema;
}

static tn_status put_other(tn_reporting *r, uint32_t rule, const mpz_t *matched, const mpz_t generated,
                           const mpz_t kept)
{
    card c = card_of_rule(r, rule);
    tn_status status = tn_page_written(
        &r->page, put_title(r, &c) && tn_page_html(&r->page, "<p class=\"counts\">") &&
                      put_count(r, "matches", matched[0], generated, " of what is generated)") &&
                      tn_page_html(&r->page, "<br>") && put_count(r, "of the plans kept", matched[1], kept, ")") &&
                      tn_page_html(&r->page, "</p>\n"));
    return status == TN_OK ? put_body(r, &c) : status;
}

static tn_status put_others(tn_reporting *r, const uint32_t *rules, size_t count, mpz_t *matched, mpz_t generated,
                            mpz_t kept)
{
    uint32_t *functions = malloc((count + 1) * sizeof *functions);
    if (!functions)
        return tn_fail_memory(r->page.error);
    for (size_t i = 0; i < count; i++)
        functions[i] = r->module->RULE_records[rules[i]].holds;
    tn_status status = tn_library_matches(r->ready->library, functions, count, matched, r->page.error);
    free(functions);
    if (status == TN_OK)
        status = tn_library_generated(r->ready->library, TN_ALL_LENGTHS, generated, r->page.error);
    tn_library_kept(r->ready->library, TN_ALL_LENGTHS, kept);
    if (status == TN_OK)
        status = tn_page_written(&r->page, tn_page_html(&r->page, "<h2 id=\"others\">Other rules of the file</h2>\n"));
    for (size_t i = 0; status == TN_OK && i < count; i++)
        status = put_other(r, rules[i], (const mpz_t *)matched + 2 * i, generated, kept);
    return status;
}

static tn_status find_others(tn_reporting *r)
{
    uint32_t *rules = malloc((r->module->RULE_count + 1) * sizeof *rules);
    size_t count = 0;
    if (!rules)
        return tn_fail_memory(r->page.error);
    for (uint32_t i = 0; i < r->module->RULE_count; i++)
        if (is_other(r, i))
            rules[count++] = i;
    mpz_t *matched = malloc((2 * count + 2) * sizeof *matched);
    tn_status status = matched ? TN_OK : tn_fail_memory(r->page.error);
    for (size_t i = 0; matched && i < 2 * count + 2; i++)
        mpz_init(matched[i]);
    if (status == TN_OK && count)
        status = put_others(r, rules, count, matched, matched[2 * count], matched[2 * count + 1]);
    for (size_t i = 0; matched && i < 2 * count + 2; i++)
        mpz_clear(matched[i]);
    free(matched);
    free(rules);
    return status;
}

tn_status tn_report_rules(tn_reporting *r)
{
    tn_status status = put_clauses(r);
    return status == TN_OK ? find_others(r) : status;
}
