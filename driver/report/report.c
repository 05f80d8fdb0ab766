/* Writes the report of a library: the page, its counts and its warnings. */
#include "driver/report/report.h"

#include <inttypes.h>
#include <stdlib.h>

#include "driver/open/digits.h"
#include "driver/report/reporting.h"
#include "runtime/base/array.h"
#include "runtime/base/integers.h"
#include "runtime/plan/picture/draw.h"
#include "runtime/plan/picture/draw_explain.h"

/* ---- what is HTML and nothing else */

/* The filter is kept in the address, so that a filtered sheet can be linked to. */
static const char report_foot[] =
    "<script>\n"
    "'use strict';\n"
    "const words = document.getElementById('words'), which = document.getElementById('which');\n"
    "const by = document.getElementById('by'), shown = document.getElementById('shown');\n"
    "const plans = [...document.querySelectorAll('.plan')];\n"
    "function filter() {\n"
    "  const wanted = words.value.toLowerCase().split(/\\s+/).filter(Boolean);\n"
    "  let count = 0;\n"
    "  for (const plan of plans) {\n"
    "    const text = plan.textContent.toLowerCase();\n"
    "    const clauses = plan.dataset.by.split(' ');\n"
    "    const fits = wanted.every((word) => text.includes(word)) &&\n"
    "      (which.value === 'all' || plan.classList.contains(which.value)) &&\n"
    "      (by.value === '' || clauses.includes(by.value));\n"
    "    plan.hidden = !fits;\n"
    "    count += fits;\n"
    "  }\n"
    "  shown.textContent = `${count} of ${plans.length} plans`;\n"
    "}\n"
    "function change() {\n"
    "  filter();\n"
    "  history.replaceState(null, '', '#' + new URLSearchParams({words: words.value, which: which.value, by: "
    "by.value}));\n"
    "}\n"
    "const asked = new URLSearchParams(location.hash.slice(1));\n"
    "words.value = asked.get('words') || '';\n"
    "which.value = asked.get('which') || 'all';\n"
    "by.value = asked.get('by') || '';\n"
    "for (const control of [words, which, by]) control.addEventListener('input', change);\n"
    "filter();\n"
    "</script>\n";

/* ---- numbers and plans */

bool tn_report_number(const tn_reporting *r, const mpz_t number)
{
    char *digits = tn_digits(number, true);
    bool written = digits && tn_page_html(&r->page, digits);
    free(digits);
    return written;
}

/* In thousandths of a per cent, rounded down; then as many of its digits as count. */
bool tn_report_share(const tn_reporting *r, const mpz_t part, const mpz_t whole)
{
    if (mpz_sgn(part) == 0 || mpz_sgn(whole) == 0)
        return tn_page_html(&r->page, "0 %");
    if (mpz_cmp(part, whole) == 0)
        return tn_page_html(&r->page, "100 %");
    mpz_t share;
    mpz_init(share);
    mpz_mul_ui(share, part, 100000);
    mpz_fdiv_q(share, share, whole);
    unsigned thousandths = (unsigned)mpz_get_ui(share);
    mpz_clear(share);
    if (thousandths == 0)
        return tn_page_html(&r->page, "less than 0.001 %");
    if (thousandths < 1000)
        return tn_buffer_printf(r->page.text, "0.%03u %%", thousandths);
    return tn_buffer_printf(r->page.text, "%u.%u %%", thousandths / 1000, thousandths % 1000 / 100);
}

bool tn_report_plan(const tn_reporting *r, const tn_tray *trays, size_t length)
{
    tn_buffer line = {0};
    bool written = tn_plan_write_line(r->ready->schema, trays, length, &line) &&
                   tn_page_text_part(&r->page, line.data ? line.data : "", line.size);
    free(line.data);
    return written;
}

/* ---- pictures */

tn_status tn_report_put_explained(tn_reporting *r, const tn_explained *explained, const char *description)
{
    tn_picture picture = tn_page_next_picture(&r->page);
    tn_status status = tn_explained_draw(explained, false, &picture, r->page.error);
    return tn_page_put_picture(&r->page, &picture, description, status);
}

tn_status tn_report_put_plan(tn_reporting *r, const tn_tray *trays, size_t length, const char *description)
{
    tn_picture picture = tn_page_next_picture(&r->page);
    const tn_drawn_reasons drawn = {.plan = {.trays = trays, .length = length}};
    tn_status status = tn_reasons_draw(r->ready->schema, &drawn, &picture, r->page.error);
    return tn_page_put_picture(&r->page, &picture, description, status);
}

/* ---- the chart */

enum { BAR_HEIGHT = 12, BAR_ROW = 34, BAR_LEFT = 70, BAR_WIDTH = 560, DIGIT_WIDTH = 8 };

/* The logarithm of a count in thousandths of its base ten, straight between powers of ten: exact on every machine. */
static size_t magnitude(const mpz_t count)
{
    char *digits = mpz_get_str(NULL, 10, count);
    size_t result = 0;
    if (digits && mpz_sgn(count) > 0) {
        char lead[5] = "0000";
        size_t size = strlen(digits);
        memcpy(lead, digits, size < 4 ? size : 4);
        result = 1000 * (size - 1) + (strtoul(lead, NULL, 10) - 1000) / 9;
    }
    free(digits);
    return result;
}

static bool write_bar(const tn_reporting *r, const mpz_t count, size_t most, size_t y, const char *colour)
{
    size_t width = mpz_sgn(count) > 0 ? 2 + magnitude(count) * BAR_WIDTH / (most ? most : 1) : 0;
    return tn_buffer_printf(r->page.text, "<rect x=\"%d\" y=\"%zu\" width=\"%zu\" height=\"%d\" fill=\"%s\"/>",
                            BAR_LEFT, y, width, BAR_HEIGHT, colour) &&
           tn_buffer_printf(r->page.text, "<text x=\"%zu\" y=\"%zu\">", BAR_LEFT + width + 6, y + BAR_HEIGHT - 2) &&
           tn_report_number(r, count) && tn_buffer_printf(r->page.text, "</text>\n");
}

/* The chart of plans by length: `generated` and `kept` of lengths low, low + 1, ... */
static bool draw_chart(const tn_reporting *r, uint32_t low, const mpz_t *generated, const mpz_t *kept, size_t count)
{
    size_t most = 0;
    for (size_t i = 0; i < count; i++)
        most = magnitude(generated[i]) > most ? magnitude(generated[i]) : most;
    size_t digits = most / 1000 + 1, width = BAR_LEFT + BAR_WIDTH + DIGIT_WIDTH * (digits + digits / 3 + 1);
    bool written =
        tn_buffer_printf(r->page.text,
                         "<figure class=\"chart\"><svg width=\"%zu\" viewBox=\"0 0 %zu %zu\" font-size=\"12\" "
                         "font-family=\"sans-serif\" role=\"img\" "
                         "aria-label=\"plans by length\">\n",
                         width, width, count * BAR_ROW + 10);
    for (size_t i = 0; written && i < count; i++) {
        size_t y = i * BAR_ROW + 4;
        written =
            tn_buffer_printf(r->page.text, "<text x=\"0\" y=\"%zu\">%zu trays</text>", y + BAR_HEIGHT + 4, low + i) &&
            write_bar(r, generated[i], most, y, "#c9c4b8") &&
            write_bar(r, kept[i], most, y + BAR_HEIGHT + 1, "#5a7d4f");
    }
    return written && tn_buffer_printf(r->page.text,
                                       "</svg></figure>\n<p class=\"quiet\">grey: generated; green: kept. The scale is "
                                       "logarithmic.</p>\n");
}

/* ---- the sheet of plans of a report, kept and dropped, which can be filtered */

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

static tn_status put_kept_plan(tn_reporting *r, const tn_explained *explained, const mpz_t rank)
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

/* The ranks of a sample of a library; an array of `wanted`, initialised. */
static tn_status sample(const tn_reporting *r, const tn_library *library, size_t wanted, mpz_t **ranks, size_t *found)
{
    *found = 0;
    *ranks = tn_integers_new(wanted);
    return *ranks ? tn_library_sample(library, r->options->seed, TN_ALL_LENGTHS, wanted, *ranks, found, r->page.error)
                  : tn_fail_memory(r->page.error);
}

static tn_status put_sampled(tn_reporting *r, const tn_library *library, const mpz_t rank, tn_tray *trays, bool dropped)
{
    uint32_t length = 0;
    tn_explained explained;
    tn_library_unrank(library, rank, trays, &length);
    if (dropped && tn_library_has(r->ready->library, trays, length))
        return TN_OK;
    tn_status status = tn_explained_make(&explained, r->opened, r->ready->schema, r->ready->record, NULL, 0, trays,
                                         length, (size_t)length + 1, r->page.error);
    if (status == TN_OK)
        status = put_kept_plan(r, &explained, rank);
    tn_explained_clear(&explained);
    return status;
}

/* Plans sampled from a library; of what is generated only those that the library drops. */
static tn_status put_sample(tn_reporting *r, const tn_library *library, bool dropped)
{
    size_t found;
    mpz_t *ranks;
    tn_tray *trays = malloc(sizeof *trays * ((size_t)tn_library_max(library) + 1));
    tn_status status = sample(r, library, r->options->samples, &ranks, &found);
    if (status == TN_OK && !trays)
        status = tn_fail_memory(r->page.error);
    for (size_t i = 0; status == TN_OK && i < found; i++)
        status = put_sampled(r, library, ranks[i], trays, dropped);
    tn_integers_free(ranks, r->options->samples);
    free(trays);
    return status;
}

static bool put_controls(const tn_reporting *r)
{
    const tn_library_record *record = r->ready->record;
    bool good = tn_page_html(
        &r->page,
        "<h2 id=\"each\">Plans one by one</h2>\n<p class=\"controls\"><input id=\"words\" aria-label=\"words\" "
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

static tn_status put_one_by_one(tn_reporting *r)
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

/* ---- the sheet */

enum { ON_SHEET = 6, NOTES = 2, NOTE_SIZE = 160 };

/* Some plans that are kept, with their ranks: all that holding and drawing them takes. */
typedef struct sheet {
    mpz_t *ranks;
    size_t wanted, count;
    tn_tray *trays; /* [count][longest] */
    char *numbers[ON_SHEET];
    tn_drawn_plan plans[ON_SHEET];
} sheet;

static tn_status fill_sheet(const tn_reporting *r, sheet *s)
{
    const tn_library *library = r->ready->library;
    size_t longest = (size_t)tn_library_max(library) + 1;
    tn_status status = sample(r, library, s->wanted, &s->ranks, &s->count);
    s->trays = malloc(tn_size_of(s->count + 1, longest * sizeof *s->trays));
    if (status == TN_OK && !s->trays)
        status = tn_fail_memory(r->page.error);
    for (size_t i = 0; status == TN_OK && i < s->count; i++) {
        uint32_t length = 0;
        tn_library_unrank(library, s->ranks[i], s->trays + i * longest, &length);
        s->numbers[i] = mpz_get_str(NULL, 10, s->ranks[i]);
        s->plans[i] = (tn_drawn_plan){.trays = s->trays + i * longest, .length = length, .number = s->numbers[i]};
        if (!s->numbers[i])
            status = tn_fail_memory(r->page.error);
    }
    return status;
}

static void clear_sheet(sheet *s)
{
    for (size_t i = 0; i < s->count; i++)
        free(s->numbers[i]);
    tn_integers_free(s->ranks, s->wanted);
    free(s->trays);
}

/* As `tartan draw --sample` draws it, on a paper that is read on a screen; on a larger one if the plans are too long.
 */
static tn_status draw_sheet(tn_reporting *r, const sheet *s)
{
    char drawn[NOTE_SIZE], hash[33], made[NOTE_SIZE];
    tn_library_hash(r->ready->library, hash);
    snprintf(drawn, sizeof drawn, "drawn at random, seed %" PRIu64, r->options->seed);
    snprintf(made, sizeof made, "library %s", hash);
    const char *notes[NOTES] = {drawn, made};
    tn_draw_options options = {.title = tn_text(r->module, r->ready->record->name),
                               .doc = tn_text(r->module, r->ready->record->doc),
                               .number_name = "rank",
                               .notes = notes,
                               .note_count = NOTES,
                               .paper = "a4"};
    tn_picture picture = tn_page_next_picture(&r->page);
    tn_status status = tn_plans_draw(r->ready->schema, s->plans, s->count, &options, &picture, r->page.error);
    options.paper = NULL;
    if (status == TN_LIMIT)
        status = tn_plans_draw(r->ready->schema, s->plans, s->count, &options, &picture, r->page.error);
    if (status == TN_LIMIT)
        return tn_page_written(&r->page, tn_page_html(&r->page, "<p class=\"quiet\">not drawn: ") &&
                                             tn_page_prose(&r->page, r->page.error->message) &&
                                             tn_page_html(&r->page, "</p>\n"));
    return tn_page_put_picture(&r->page, &picture, "some plans of the library", status);
}

static tn_status put_sheet(tn_reporting *r)
{
    sheet s = {.wanted = r->options->samples < ON_SHEET ? r->options->samples : ON_SHEET};
    tn_status status = tn_page_written(&r->page, tn_page_html(&r->page, "<h2 id=\"plans\">Plans</h2>\n"));
    if (status == TN_OK)
        status = fill_sheet(r, &s);
    if (status == TN_OK && s.count > 0)
        status = draw_sheet(r, &s);
    else if (status == TN_OK)
        status = tn_page_written(&r->page, tn_page_html(&r->page, "<p class=\"quiet\">no plan is kept</p>\n"));
    clear_sheet(&s);
    return status;
}

/* ---- the brief's figures: how many plans there are, what they are held to in figures, and what they come to */

/* A clause that is not a rule by its name: a total, or a condition that the library itself says. */
static bool put_asked(const tn_reporting *r, const tn_clause_record *clause)
{
    const char *text = tn_text(r->module, r->module->SOURCE_records[clause->file].text);
    return tn_page_html(&r->page, "<tr><td>") &&
           tn_page_html(&r->page, clause->kind == TN_CLAUSE_PRUNE ? "none with" : "asked for") &&
           tn_page_html(&r->page, "</td><td><code>") &&
           tn_page_text_part(&r->page, text + clause->begin, clause->end - clause->begin) &&
           tn_page_html(&r->page, "</code> ") && tn_page_text(&r->page, tn_text(r->module, clause->doc)) &&
           tn_page_html(&r->page, "</td></tr>\n");
}

static bool is_figure(const tn_reporting *r, const tn_clause_record *clause)
{
    bool named = tn_function_rule(r->module, clause->holds) != UINT32_MAX;
    return !named && clause->kind != TN_CLAUSE_GENERATE && clause->kind != TN_CLAUSE_ONTO;
}

/* "4 to 8 trays" */
static bool put_trays(const tn_reporting *r)
{
    uint32_t low = tn_library_min(r->ready->library), high = tn_library_max(r->ready->library);
    if (low > high)
        return true;
    return tn_page_html(&r->page, "<tr><td>trays</td><td>") &&
           (low == high ? tn_buffer_printf(r->page.text, "%u", low)
                        : tn_buffer_printf(r->page.text, "%u to %u", low, high)) &&
           tn_page_html(&r->page, "</td></tr>\n");
}

static bool put_figures(const tn_reporting *r, const tn_reported_measures *measures)
{
    const tn_library_record *record = r->ready->record;
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(r->ready->library, TN_ALL_LENGTHS, kept);
    bool good = tn_page_html(&r->page, "<h2 id=\"figures\">Figures</h2>\n<table class=\"words figures\">\n"
                                       "<tr><td>plans</td><td><b>") &&
                tn_report_number(r, kept) && tn_page_html(&r->page, "</b></td></tr>\n") && put_trays(r);
    mpz_clear(kept);
    for (uint32_t i = 0; good && i < record->clause_count; i++) {
        const tn_clause_record *clause = &r->module->CLAUSE_records[record->clause_first + i];
        good = !is_figure(r, clause) || put_asked(r, clause);
    }
    return good && tn_page_html(&r->page, "</table>\n") && tn_report_figures(r, measures);
}

/* ---- counts */

static tn_status put_chart(const tn_reporting *r)
{
    const tn_library *library = r->ready->library;
    uint32_t low = tn_library_min(library), high = tn_library_max(library);
    if (low > high)
        return TN_OK;
    size_t count = (size_t)high - low + 1;
    mpz_t *generated = malloc(sizeof *generated * count), *kept = malloc(sizeof *kept * count);
    if (!generated || !kept) {
        free(generated);
        free(kept);
        return tn_fail_memory(r->page.error);
    }
    tn_status status = TN_OK;
    for (size_t i = 0; i < count; i++)
        mpz_inits(generated[i], kept[i], NULL);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        tn_library_kept(library, low + (uint32_t)i, kept[i]);
        status = tn_library_generated(library, low + (uint32_t)i, generated[i], r->page.error);
    }
    if (status == TN_OK)
        status = tn_page_written(&r->page, draw_chart(r, low, (const mpz_t *)generated, (const mpz_t *)kept, count));
    for (size_t i = 0; i < count; i++)
        mpz_clears(generated[i], kept[i], NULL);
    free(generated);
    free(kept);
    return status;
}

/* "12 plans generated, 5 kept" */
static tn_status put_totals(const tn_reporting *r)
{
    mpz_t generated, kept;
    mpz_inits(generated, kept, NULL);
    tn_status status = tn_library_generated(r->ready->library, TN_ALL_LENGTHS, generated, r->page.error);
    tn_library_kept(r->ready->library, TN_ALL_LENGTHS, kept);
    if (status == TN_OK)
        status = tn_page_written(
            &r->page, tn_page_html(&r->page, "<h2 id=\"rules\">Rules</h2>\n<p>") && tn_report_number(r, generated) &&
                          tn_page_html(&r->page, " plans generated, <b>") && tn_report_number(r, kept) &&
                          tn_page_html(&r->page, "</b> kept (") && tn_report_share(r, kept, generated) &&
                          tn_page_html(&r->page, ").</p>\n"));
    mpz_clears(generated, kept, NULL);
    return status;
}

/* ---- the page */

static bool put_head(const tn_reporting *r, const tn_reported_measures *measures)
{
    return tn_page_begin(&r->page, tn_text(r->module, r->ready->record->name),
                         tn_text(r->module, r->ready->record->doc)) &&
           tn_page_params(&r->page, r->opened) &&
           tn_page_html(&r->page, "<nav><a href=\"#plans\">Plans</a> <a href=\"#figures\">Figures</a> ") &&
           (measures->count == 0 || tn_page_html(&r->page, "<a href=\"#measures\">Measures</a> ")) &&
           tn_page_html(&r->page, "<a href=\"#rules\">Rules</a> <a href=\"#each\">Plans one by one</a> <a "
                                  "href=\"#findings\">Warnings</a></nav>\n");
}

static bool put_foot(const tn_reporting *r)
{
    const tn_module *module = r->module;
    char hash[33];
    tn_library_hash(r->ready->library, hash);
    return tn_buffer_printf(r->page.text, "<p class=\"quiet\">library %s, seed %llu, ", hash,
                            (unsigned long long)r->options->seed) &&
           tn_page_version(&r->page, module) && tn_page_html(&r->page, "</p>\n") &&
           tn_page_html(&r->page, report_foot) && tn_page_html(&r->page, "</html>\n");
}

/* Limits that cards of rules have met, each once: "12 of 45 pairs of rules are not compared: past the limit of states"
 */
static tn_status put_limits(tn_reporting *r)
{
    tn_buffer more[2] = {{0}};
    bool good = true;
    if (r->pairs_unknown)
        good = tn_buffer_printf(&more[0], "%zu of %zu pairs of rules are not compared: past the limit of states",
                                r->pairs_unknown, r->pairs);
    if (good && r->clauses_unknown)
        good = tn_buffer_printf(&more[1],
                                "of %zu clause%s it is not known whether a plan is kept out by that alone: past the "
                                "limit of states",
                                r->clauses_unknown, r->clauses_unknown == 1 ? "" : "s");
    good = good && tn_page_limits(&r->page, r->opened, more, 2);
    free(more[0].data);
    free(more[1].data);
    return tn_page_written(&r->page, good);
}

/* What a client asks comes first; then the rules, and what is wrong or not known. */
static tn_status put_page(tn_reporting *r, const tn_reported_measures *measures)
{
    tn_status status = tn_page_written(&r->page, put_head(r, measures));
    if (status == TN_OK)
        status = put_sheet(r);
    if (status == TN_OK)
        status = tn_page_written(&r->page, put_figures(r, measures));
    if (status == TN_OK)
        status = tn_report_measures(r, measures);
    if (status == TN_OK)
        status = put_totals(r);
    if (status == TN_OK)
        status = put_chart(r);
    if (status == TN_OK)
        status = tn_report_rules(r);
    if (status == TN_OK)
        status = put_one_by_one(r);
    if (status == TN_OK)
        status = tn_page_written(&r->page, tn_page_findings(&r->page, r->opened));
    if (status == TN_OK)
        status = put_limits(r);
    return status == TN_OK ? tn_page_written(&r->page, put_foot(r)) : status;
}

tn_status tn_report_page(tn_opened *opened, const tn_ready_library *ready, const tn_plan_analyses *analyses,
                         const tn_covered *covered, const tn_report_options *options, tn_buffer *page, tn_error *error)
{
    tn_reporting r = {.opened = opened,
                      .ready = ready,
                      .module = opened->module,
                      .analyses = analyses,
                      .covered = covered,
                      .options = options,
                      .page = {.text = page, .error = error}};
    tn_reported_measures measures = {0};
    tn_status status = tn_reported_measures_make(&r, &measures);
    if (status == TN_OK)
        status = put_page(&r, &measures);
    tn_reported_measures_clear(&measures);
    return status;
}
