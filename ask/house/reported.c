/* The page of a library of houses: counts, draws a sample, and hands both to it. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ask/house/numbered.h"
#include "ask/house/reported.h"
#include "driver/report/house_report.h"
#include "runtime/base/integers.h"

/* What is counted and drawn for the page. */
typedef struct tn_reported_houses {
    tn_house_report page;
    tn_reported_house *houses;
    size_t room;
    tn_error limit;
} tn_reported_houses;

static size_t length_count(const tn_house_report *page)
{
    return (size_t)page->high - page->low + 1;
}

/* A count that takes too much is left out, and the page says why. */
static tn_status count(tn_numbered *n, tn_reported_houses *r, tn_error *error)
{
    tn_house_report *page = &r->page;
    uint32_t clauses = n->record->clause_count;
    page->low = tn_library_min(n->plans);
    page->high = tn_library_max(n->plans) < page->low ? page->low : tn_library_max(n->plans);
    page->lengths = tn_integers_new(length_count(page));
    page->kept_out = tn_integers_new(clauses);
    page->alone = tn_integers_new(clauses);
    if (!page->lengths || !page->kept_out || !page->alone)
        return tn_fail_memory(error);
    tn_status status = tn_numbered_lengths(n, page->low, page->high, page->lengths, error);
    bool counted = status == TN_OK;
    if (counted)
        status = tn_numbered_clauses(n, page->kept_out, page->alone, error);
    if (status != TN_LIMIT)
        return status;
    r->limit = *error;
    page->limit = r->limit.message;
    tn_integers_free(page->kept_out, clauses);
    tn_integers_free(page->alone, clauses);
    page->kept_out = page->alone = NULL;
    if (!counted) {
        tn_integers_free(page->lengths, length_count(page));
        page->lengths = NULL;
    }
    return TN_OK;
}

static tn_status collect(void *context, tn_house *house, const mpz_t rank, const mpz_t variant, tn_error *error)
{
    tn_reported_houses *r = context;
    tn_reported_house *reported = &r->houses[r->page.house_count++];
    (void)variant;
    reported->house = *house;
    *house = (tn_house){0};
    tn_buffer name = {0};
    tn_buffer_append(&name, "#", 1);
    tn_buffer_integer(&name, rank);
    reported->name = name.data;
    if (name.failed)
        return tn_fail_memory(error);
    return tn_house_solids(&reported->house, &reported->solids, error);
}

/* Where all houses cannot be numbered, none is drawn. */
static tn_status sample(tn_numbered *n, tn_reported_houses *r, size_t wanted, tn_error *error)
{
    r->houses = calloc(wanted + 1, sizeof *r->houses);
    r->page.houses = r->houses;
    if (!r->houses)
        return tn_fail_memory(error);
    return r->page.lengths ? tn_numbered_sample(n, NULL, wanted, r->page.seed, false, collect, r, error) : TN_OK;
}

static void clear_houses(tn_reported_house *houses, size_t count)
{
    for (size_t i = 0; houses && i < count; i++) {
        tn_solids_clear(&houses[i].solids);
        tn_house_clear(&houses[i].house);
        free(houses[i].name);
    }
    free(houses);
}

static void clear(const tn_numbered *n, tn_reported_houses *r)
{
    clear_houses(r->houses, r->page.house_count);
    tn_integers_free(r->page.lengths, length_count(&r->page));
    tn_integers_free(r->page.kept_out, n->record ? n->record->clause_count : 0);
    tn_integers_free(r->page.alone, n->record ? n->record->clause_count : 0);
}

tn_status tn_report_houses(tn_session *session, const tn_library_asked *asked, const tn_reported *wanted,
                           tn_buffer *page)
{
    tn_numbered n = {0};
    tn_plan none;
    tn_error error;
    tn_reported_houses r = {.page = {.opened = session->opened, .seed = wanted->seed}};
    tn_status status = tn_numbered_open_on(&n, session, asked, NULL, &none);
    if (status == TN_OK) {
        r.page.form = &n.form;
        r.page.library = n.record;
        status = count(&n, &r, &error);
        if (status == TN_OK)
            status = sample(&n, &r, (size_t)wanted->sample, &error);
        if (status == TN_OK)
            status = tn_house_report_page(&r.page, page, &error);
        if (status != TN_OK)
            status = tn_session_fail(session, &error);
    }
    clear(&n, &r);
    tn_numbered_close(&n);
    return status;
}

/* ---- houses that are given */

/* By its number as it was typed, or, of a line, its place among those given. */
static tn_status name_given(const char *text, size_t number, char **name, tn_error *error)
{
    char made[40];
    snprintf(made, sizeof made, "house %zu", number);
    *name = strdup(tn_is_house_number(text) ? text : made);
    return *name ? TN_OK : tn_fail_memory(error);
}

/* What is wrong is said. */
static tn_status read_given(tn_numbered *n, const tn_library_asked *asked, const char *text, size_t number,
                            tn_reported_house *given)
{
    tn_error error;
    if (!tn_is_house_number(text)) {
        tn_status status = tn_numbered_typed(n, text, tn_asked_length(asked), &given->house);
        if (status != TN_OK)
            return status;
    } else if (tn_numbered_house(n, text, &given->house, &error) != TN_OK) {
        return tn_session_fail(n->session, &error);
    }
    tn_status status = name_given(text, number, &given->name, &error);
    if (status == TN_OK)
        status = tn_house_solids(&given->house, &given->solids, &error);
    return status == TN_OK ? TN_OK : tn_session_fail(n->session, &error);
}

tn_status tn_report_given_houses(tn_session *session, const tn_library_asked *asked, const char *const *texts,
                                 size_t count, tn_buffer *page)
{
    tn_numbered n = {0};
    tn_plan none;
    tn_error error;
    tn_reported_house *houses = calloc(count + 1, sizeof *houses);
    if (!houses) {
        tn_fail_memory(&error);
        return tn_session_fail(session, &error);
    }
    tn_status status = tn_numbered_open_on(&n, session, asked, NULL, &none);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        status = read_given(&n, asked, texts[i], i + 1, &houses[i]);
    if (status == TN_OK && tn_houses_page(session->opened, &n.form, houses, count, page, &error) != TN_OK)
        status = tn_session_fail(session, &error);
    clear_houses(houses, count);
    tn_numbered_close(&n);
    return status;
}
