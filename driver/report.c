#include "driver/report.h"

#include <stdlib.h>
#include <string.h>

#include "driver/explain.h"
#include "runtime/plan/draw_rule.h"

typedef struct reporting {
    tn_opened *opened;
    const tn_ready_library *ready;
    const tn_module *module;
    const tn_plan_analyses *analyses;
    const tn_report_options *options;
    tn_buffer *page;
    tn_error *error;
} reporting;

static tn_status written(const reporting *r, bool good)
{
    return good ? TN_OK : tn_fail_memory(r->error);
}

static bool put(const reporting *r, const char *text)
{
    return tn_report_text(r->page, text, strlen(text));
}

/* ---- counts */

static tn_status put_counts(const reporting *r)
{
    const tn_library *library = r->ready->library;
    uint32_t low = tn_library_min(library), high = tn_library_max(library);
    size_t count = (size_t)high - low + 1;
    mpz_t *generated = malloc(sizeof *generated * count), *kept = malloc(sizeof *kept * count);
    if (!generated || !kept) {
        free(generated);
        free(kept);
        return tn_fail_memory(r->error);
    }
    tn_status status = TN_OK;
    for (size_t i = 0; i < count; i++)
        mpz_inits(generated[i], kept[i], NULL);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        tn_library_kept(library, low + (uint32_t)i, kept[i]);
        status = tn_library_generated(library, low + (uint32_t)i, generated[i], r->error);
    }
    if (status == TN_OK)
        status = written(r, tn_report_chart(r->page, low, (const mpz_t *)generated, (const mpz_t *)kept, count));
    for (size_t i = 0; i < count; i++)
        mpz_clears(generated[i], kept[i], NULL);
    free(generated);
    free(kept);
    return status;
}

/* "12 plans generated, 5 kept" */
static tn_status put_totals(const reporting *r)
{
    mpz_t generated, kept;
    mpz_inits(generated, kept, NULL);
    tn_status status = tn_library_generated(r->ready->library, TN_ALL_LENGTHS, generated, r->error);
    tn_library_kept(r->ready->library, TN_ALL_LENGTHS, kept);
    if (status == TN_OK)
        status = written(r, tn_buffer_printf(r->page, "<p>") && tn_report_number(r->page, generated) &&
                                tn_buffer_printf(r->page, " plans generated, <b>") && tn_report_number(r->page, kept) &&
                                tn_buffer_printf(r->page, " kept</b>.</p>\n"));
    mpz_clears(generated, kept, NULL);
    return status;
}

/* ---- rules */

/* The RULE record whose name a clause has, or UINT32_MAX. */
static uint32_t clause_rule(const reporting *r, const tn_clause_record *clause)
{
    for (uint32_t i = 0; i < r->module->RULE_count; i++)
        if (r->module->RULE_records[i].name == clause->name ||
            strcmp(tn_text(r->module, r->module->RULE_records[i].name), tn_text(r->module, clause->name)) == 0)
            return i;
    return UINT32_MAX;
}

static bool put_source(const reporting *r, uint32_t file, uint32_t begin, uint32_t end)
{
    const char *text = tn_text(r->module, r->module->SOURCE_records[file].text);
    return tn_buffer_printf(r->page, "<pre>") && tn_report_text(r->page, text + begin, end - begin) &&
           tn_buffer_printf(r->page, "</pre>\n");
}

/* What a rule shares with the others, but for mere overlaps. */
static bool put_relations(const reporting *r, uint32_t rule)
{
    static const char *const words[] = {[TN_RULES_EQUAL] = "matches the same plans as",
                                        [TN_RULES_APART] = "has no plan in common with",
                                        [TN_RULES_INSIDE] = "all that it matches is matched by",
                                        [TN_RULES_CONTAINS] = "matches all that is matched by",
                                        [TN_RULES_UNKNOWN] = NULL,
                                        [TN_RULES_OVERLAP] = NULL};
    bool good = true;
    for (size_t a = 0; a < r->analyses->count; a++) {
        const tn_plan_analysis *analysis = r->analyses->items[a];
        size_t count = tn_plan_analysis_rule_count(analysis);
        for (size_t i = 0; i < count; i++)
            for (size_t j = 0; tn_plan_analysis_rule(analysis, i) == rule && good && j < count; j++) {
                const char *word = i != j ? words[tn_plan_analysis_relation(analysis, i, j)] : NULL;
                uint32_t other = tn_plan_analysis_rule(analysis, j);
                good = !word || (tn_buffer_printf(r->page, "<p class=\"quiet\">%s <b>", word) &&
                                 put(r, tn_text(r->module, r->module->RULE_records[other].name)) &&
                                 tn_buffer_printf(r->page, "</b></p>\n"));
            }
    }
    return good;
}

static tn_status put_rule_picture(const reporting *r, uint32_t rule)
{
    const char *name = tn_text(r->module, r->module->RULE_records[rule].name);
    tn_status status = tn_rules_draw(r->ready->schema, &rule, 1, r->options->scratch, 0, r->error);
    return status == TN_OK ? tn_report_picture(r->page, r->options->scratch, name, r->error) : status;
}

static tn_status put_clause(const reporting *r, const tn_clause_record *clause, const mpz_t prunes, const mpz_t only)
{
    uint32_t rule = clause_rule(r, clause);
    bool good = tn_buffer_printf(r->page, "<div class=\"rule\"><h3>") && put(r, tn_text(r->module, clause->name)) &&
                tn_buffer_printf(r->page, "</h3>\n<p>") && put(r, tn_text(r->module, clause->doc)) &&
                tn_buffer_printf(r->page, "</p>\n");
    if (good && clause->kind == TN_CLAUSE_PRUNE)
        good = tn_buffer_printf(r->page, "<p>prunes <b>") && tn_report_number(r->page, prunes) &&
               tn_buffer_printf(r->page, "</b>, only it <b>") && tn_report_number(r->page, only) &&
               tn_buffer_printf(r->page, "</b></p>\n");
    else if (good)
        good = tn_buffer_printf(r->page, "<p class=\"quiet\">required</p>\n");
    tn_status status = written(r, good);
    if (status == TN_OK && rule != UINT32_MAX)
        status = put_rule_picture(r, rule);
    if (status != TN_OK)
        return status;
    if (rule != UINT32_MAX) {
        const tn_rule_record *record = &r->module->RULE_records[rule];
        good = put_source(r, record->file, record->begin, record->end) && put_relations(r, rule);
    } else {
        good = put_source(r, clause->file, clause->begin, clause->end);
    }
    return written(r, good && tn_buffer_printf(r->page, "</div>\n"));
}

static tn_status put_rules(const reporting *r)
{
    const tn_library_record *record = r->ready->record;
    size_t prune = 0;
    tn_status status = TN_OK;
    mpz_t prunes, only;
    mpz_inits(prunes, only, NULL);
    for (uint32_t i = 0; status == TN_OK && i < record->clause_count; i++) {
        const tn_clause_record *clause = &r->module->CLAUSE_records[record->clause_first + i];
        uint32_t index, states;
        if (clause->kind == TN_CLAUSE_PRUNE)
            status = tn_library_prune(r->ready->library, prune++, &index, prunes, only, &states, r->error);
        if (status == TN_OK)
            status = put_clause(r, clause, prunes, only);
    }
    mpz_clears(prunes, only, NULL);
    return status;
}

/* What checking found to say about the rules, with the plans that show it. */
static bool put_findings(const reporting *r)
{
    tn_diagnostics *found = &r->opened->compilation.diagnostics;
    bool good = true, headed = false;
    tn_diagnostics_sort(found);
    for (size_t i = 0; good && i < found->count; i++) {
        const tn_diagnostic *item = &found->items[i];
        char code[8];
        if (item->severity != TN_WARNING || !item->message)
            continue;
        tn_code_name(item->code, code);
        good = (headed || tn_buffer_printf(r->page, "<h2>What is hardly meant</h2>\n")) &&
               tn_buffer_printf(r->page, "<div class=\"rule\"><p>%s: ", code) && put(r, item->message) &&
               tn_buffer_printf(r->page, "</p>\n");
        for (size_t n = 0; good && n < item->note_count; n++)
            good = tn_buffer_printf(r->page, "<p class=\"quiet\">") &&
                   put(r, item->notes[n].text ? item->notes[n].text : "") && tn_buffer_printf(r->page, "</p>\n");
        good = good &&
               (!item->help ||
                (tn_buffer_printf(r->page, "<p>") && put(r, item->help) && tn_buffer_printf(r->page, "</p>\n"))) &&
               tn_buffer_printf(r->page, "</div>\n");
        headed = true;
    }
    return good;
}

/* ---- plans */

static bool put_reasons(const reporting *r, const tn_explained *explained)
{
    bool good = true;
    for (size_t i = 0; good && i < explained->count; i++)
        if (explained->rules[i].drops)
            good = put(r, explained->rules[i].name) && tn_buffer_append(r->page, " ", 1);
    return good;
}

static tn_status put_explained(const reporting *r, const tn_explained *explained, const mpz_t rank)
{
    tn_buffer line = {0}, why = {0};
    const char *state = explained->kept ? "kept" : "dropped";
    bool good = tn_plan_write_line(r->ready->schema, explained->trays, explained->length, &line) &&
                tn_explained_text(explained, false, &why) &&
                tn_buffer_printf(r->page, "<div class=\"plan %s\" data-by=\"", state) && put_reasons(r, explained) &&
                tn_buffer_printf(r->page, "\"><b>%s</b>", state);
    if (good && explained->kept)
        good = tn_buffer_printf(r->page, ", rank ") && tn_report_number(r->page, rank);
    tn_status status = written(r, good && tn_buffer_append(r->page, "\n", 1));
    if (status == TN_OK)
        status = tn_explained_draw(explained, false, r->options->scratch, 0, r->error);
    if (status == TN_OK)
        status = tn_report_picture(r->page, r->options->scratch, state, r->error);
    if (status == TN_OK)
        status = written(r, tn_buffer_printf(r->page, "<p class=\"quiet\">") &&
                                tn_report_text(r->page, line.data, line.size) &&
                                tn_buffer_printf(r->page, "</p>\n<details><summary>why</summary><pre>") &&
                                tn_report_text(r->page, why.data, why.size) &&
                                tn_buffer_printf(r->page, "</pre></details></div>\n"));
    free(line.data);
    free(why.data);
    return status;
}

/* Plans sampled from a library; of what is generated only those that the library drops. */
static tn_status put_sample(const reporting *r, const tn_library *library, bool dropped)
{
    size_t count = r->options->samples, found = 0;
    mpz_t *ranks = malloc(sizeof *ranks * (count + 1));
    tn_tray *trays = malloc(sizeof *trays * ((size_t)tn_library_max(library) + 1));
    for (size_t i = 0; ranks && i < count; i++)
        mpz_init(ranks[i]);
    tn_status status =
        ranks && trays ? tn_library_sample(library, r->options->seed, TN_ALL_LENGTHS, count, ranks, &found, r->error)
                       : tn_fail_memory(r->error);
    for (size_t i = 0; status == TN_OK && i < found; i++) {
        uint32_t length = 0;
        tn_explained explained;
        tn_library_unrank(library, ranks[i], trays, &length);
        if (dropped && tn_library_has(r->ready->library, trays, length))
            continue;
        status = tn_explained_make(&explained, r->opened, r->ready->schema, r->ready->record, NULL, 0, trays, length,
                                   (size_t)length + 1, r->error);
        if (status == TN_OK)
            status = put_explained(r, &explained, ranks[i]);
        tn_explained_clear(&explained);
    }
    for (size_t i = 0; ranks && i < count; i++)
        mpz_clear(ranks[i]);
    free(ranks);
    free(trays);
    return status;
}

static bool put_controls(const reporting *r)
{
    const tn_library_record *record = r->ready->record;
    bool good = tn_buffer_printf(
        r->page, "<h2>Plans</h2>\n<p class=\"controls\"><input id=\"words\" placeholder=\"words in the plan or the "
                 "reasons\" size=\"34\"> <select id=\"which\"><option value=\"all\">kept and dropped</option><option "
                 "value=\"kept\">kept</option><option value=\"dropped\">dropped</option></select> <select "
                 "id=\"by\"><option value=\"\">by any clause</option>");
    for (uint32_t i = 0; good && i < record->clause_count; i++) {
        const char *name = tn_text(r->module, r->module->CLAUSE_records[record->clause_first + i].name);
        good = tn_buffer_printf(r->page, "<option>") && put(r, name) && tn_buffer_printf(r->page, "</option>");
    }
    return good && tn_buffer_printf(r->page, "</select> <span id=\"shown\"></span></p>\n<div id=\"sheet\">\n");
}

static tn_status put_plans(const reporting *r)
{
    tn_library_options options = {.max_states = r->options->max_states, .all_generated = true};
    tn_library *generated = NULL;
    tn_status status = written(r, put_controls(r));
    if (status == TN_OK)
        status = put_sample(r, r->ready->library, false);
    if (status == TN_OK)
        status = tn_library_new(r->ready->schema, r->ready->index, &options, &generated, r->error);
    if (status == TN_OK)
        status = put_sample(r, generated, true);
    tn_library_free(generated);
    return status == TN_OK ? written(r, tn_buffer_printf(r->page, "</div>\n")) : status;
}

/* ---- the page */

static bool put_head(const reporting *r)
{
    const char *name = tn_text(r->module, r->ready->record->name), *doc = tn_text(r->module, r->ready->record->doc);
    return tn_buffer_printf(r->page, "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>") &&
           put(r, name) && tn_buffer_printf(r->page, "</title>\n") &&
           tn_buffer_append(r->page, tn_report_head, strlen(tn_report_head)) && tn_buffer_printf(r->page, "<h1>") &&
           put(r, name) && tn_buffer_printf(r->page, "</h1>\n<p>") && put(r, doc) &&
           tn_buffer_printf(r->page, "</p>\n");
}

static bool put_foot(const reporting *r)
{
    const tn_module *module = r->module;
    char hash[33];
    tn_library_hash(r->ready->library, hash);
    return tn_buffer_printf(r->page, "<p class=\"quiet\">library %s, seed %llu, ", hash,
                            (unsigned long long)r->options->seed) &&
           put(r, module->PRODUCER_count ? tn_text(module, module->PRODUCER_records[0].version) : "") &&
           tn_buffer_printf(r->page, "</p>\n") && tn_buffer_append(r->page, tn_report_foot, strlen(tn_report_foot)) &&
           tn_buffer_printf(r->page, "</html>\n");
}

tn_status tn_report_page(tn_opened *opened, const tn_ready_library *ready, const tn_plan_analyses *analyses,
                         const tn_report_options *options, tn_buffer *page, tn_error *error)
{
    reporting r = {opened, ready, opened->module, analyses, options, page, error};
    tn_status status = written(&r, put_head(&r));
    if (status == TN_OK)
        status = put_totals(&r);
    if (status == TN_OK)
        status = put_counts(&r);
    if (status == TN_OK)
        status = written(&r, put_findings(&r) && tn_buffer_printf(page, "<h2>Rules</h2>\n"));
    if (status == TN_OK)
        status = put_rules(&r);
    if (status == TN_OK)
        status = put_plans(&r);
    return status == TN_OK ? written(&r, put_foot(&r)) : status;
}
