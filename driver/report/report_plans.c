/* The sheet of plans of a report, kept and dropped, which can be filtered. */
#include <stdlib.h>

#include "driver/report/report_data.h"

static bool put_reasons(const tn_reporting *r, const tn_explained *explained)
{
    bool good = !explained->length_drops || tn_page_html(&r->page, "trays ");
    for (size_t i = 0; good && i < explained->count; i++)
        if (explained->rules[i].drops)
            good = tn_page_text(&r->page, explained->rules[i].name) && tn_page_html(&r->page, " ");
    return good;
}

/* The clauses that drop a plan, as they are to be read. */
static bool put_by(const tn_reporting *r, const tn_explained *explained)
{
    bool good = tn_page_html(&r->page, " by "), first = true;
    for (size_t i = 0; good && i < explained->count; i++) {
        if (!explained->rules[i].drops)
            continue;
        good = (first || tn_page_html(&r->page, ", ")) && tn_page_html(&r->page, "<a href=\"#rule-") &&
               tn_page_text(&r->page, explained->rules[i].name) && tn_page_html(&r->page, "\">") &&
               tn_page_text(&r->page, explained->rules[i].name) && tn_page_html(&r->page, "</a>");
        first = false;
    }
    return good;
}

static tn_status put_plan(tn_reporting *r, const tn_explained *explained, const mpz_t rank)
{
    tn_buffer why = {0};
    const char *state = explained->kept ? "kept" : "dropped";
    bool good =
        tn_explained_text(explained, false, &why) &&
        tn_buffer_printf(r->page.text, "<div class=\"plan %s\" data-by=\"", state) && put_reasons(r, explained) &&
        tn_buffer_printf(r->page.text, "\"><p><b>%s</b>", state) &&
        (explained->kept ? tn_page_html(&r->page, ", rank ") && tn_report_number(r, rank) : put_by(r, explained)) &&
        tn_page_html(&r->page, "</p>\n");
    tn_status status = tn_page_written(&r->page, good);
    if (status == TN_OK && explained->kept)
        status = tn_report_put_plan(r, explained->trays, explained->length, "a plan that is kept");
    else if (status == TN_OK)
        status = tn_report_put_explained(r, explained, "a plan that is dropped, with the reasons");
    if (status == TN_OK)
        status = tn_page_written(
            &r->page,
            tn_page_html(&r->page, "<p class=\"line\">") && tn_report_plan(r, explained->trays, explained->length) &&
                tn_page_html(&r->page, explained->kept ? "</p>\n<details><summary>in words</summary><pre>"
                                                       : "</p>\n<details><summary>why pruned</summary><pre>") &&
                tn_page_text_part(&r->page, why.data, why.size) && tn_page_html(&r->page, "</pre></details></div>\n"));
    free(why.data);
    return status;
}

/* Plans sampled from a library; of what is generated only those that the library drops. */
static tn_status put_sample(tn_reporting *r, const tn_library *library, bool dropped)
{
    size_t count = r->options->samples, found = 0;
    mpz_t *ranks = malloc(sizeof *ranks * (count + 1));
    tn_tray *trays = malloc(sizeof *trays * ((size_t)tn_library_max(library) + 1));
    for (size_t i = 0; ranks && i < count; i++)
        mpz_init(ranks[i]);
    tn_status status = ranks && trays ? tn_library_sample(library, r->options->seed, TN_ALL_LENGTHS, count, ranks,
                                                          &found, r->page.error)
                                      : tn_fail_memory(r->page.error);
    for (size_t i = 0; status == TN_OK && i < found; i++) {
        uint32_t length = 0;
        tn_explained explained;
        tn_library_unrank(library, ranks[i], trays, &length);
        if (dropped && tn_library_has(r->ready->library, trays, length))
            continue;
        status = tn_explained_make(&explained, r->opened, r->ready->schema, r->ready->record, NULL, 0, trays, length,
                                   (size_t)length + 1, r->page.error);
        if (status == TN_OK)
            status = put_plan(r, &explained, ranks[i]);
        tn_explained_clear(&explained);
    }
    for (size_t i = 0; ranks && i < count; i++)
        mpz_clear(ranks[i]);
    free(ranks);
    free(trays);
    return status;
}

static bool put_controls(const tn_reporting *r)
{
    const tn_library_record *record = r->ready->record;
    bool good = tn_page_html(
        &r->page,
        "<h2 id=\"plans\">Plans</h2>\n<p class=\"controls\"><input id=\"words\" aria-label=\"words\" "
        "placeholder=\"words in the plan or the reasons\" size=\"30\"> <select id=\"which\" aria-label=\"kept or "
        "dropped\"><option value=\"all\">kept and dropped</option><option "
        "value=\"kept\">kept</option><option value=\"dropped\">dropped</option></select> <select "
        "id=\"by\" aria-label=\"dropped by\"><option value=\"\">by any clause</option>");
    for (uint32_t i = 0; good && i < record->clause_count; i++)
        good = tn_page_html(&r->page, "<option>") &&
               tn_page_text(&r->page, tn_text(r->module, r->module->CLAUSE_records[record->clause_first + i].name)) &&
               tn_page_html(&r->page, "</option>");
    return good && tn_page_html(&r->page, "</select> <span id=\"shown\"></span></p>\n<div id=\"sheet\">\n");
}

tn_status tn_report_plans(tn_reporting *r)
{
    tn_library_options options = {.max_states = r->options->max_states, .all_generated = true};
    tn_library *generated = NULL;
    tn_status status = tn_page_written(&r->page, put_controls(r));
    if (status == TN_OK)
        status = put_sample(r, r->ready->library, false);
    if (status == TN_OK)
        status = tn_library_new(r->ready->schema, r->ready->index, &options, &generated, r->page.error);
    if (status == TN_OK)
        status = put_sample(r, generated, true);
    tn_library_free(generated);
    return status == TN_OK ? tn_page_written(&r->page, tn_page_html(&r->page, "</div>\n")) : status;
}
