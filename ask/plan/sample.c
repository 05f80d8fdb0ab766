/* sample: plans, or houses, drawn at random. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "ask/house/numbered.h"
#include "ask/plan/plan_rows.h"
#include "ask/plan/searched.h"
#include "ask/plan/weights.h"
#include "ask/session/questions.h"
#include "driver/open/digits.h"
#include "runtime/base/array.h"
#include "runtime/house/house.h"
#include "runtime/plan/library/diverse.h"
#include "runtime/plan/measure/likelihood.h"

/* ---- ranks of plans */

typedef struct drawing {
    tn_session *session;
    const tn_library *library;
    const tn_sample_request *request;
    tn_rows_of_plans *rows;    /* rows of plans are drawn; or NULL */
    tn_likelihood *likelihood; /* NULL: each plan is as likely as each */
    mpq_t weight;              /* of all plans, if they are drawn by it */
    mpz_t *ranks;              /* of one length ascending */
    size_t count, room;
} drawing;

static tn_status make_room(drawing *d, size_t more, tn_error *error)
{
    if (d->room - d->count >= more && d->ranks)
        return TN_OK;
    size_t room = d->count + more;
    if (!tn_array_resize(&d->ranks, room + 1, sizeof *d->ranks))
        return tn_fail_memory(error);
    for (; d->room < room; d->room++)
        mpz_init(d->ranks[d->room]);
    return TN_OK;
}

static void clear(drawing *d)
{
    for (size_t i = 0; i < d->room; i++)
        mpz_clear(d->ranks[i]);
    free(d->ranks);
    tn_likelihood_free(d->likelihood);
    mpq_clear(d->weight);
}

/* How many there are to be drawn from. */
static void find_kept(const drawing *d, uint32_t length, mpz_t kept)
{
    if (d->rows)
        tn_plan_rows_count(d->rows->rows, length, kept);
    else
        tn_library_kept(d->library, length, kept);
}

/* What the library holds in a length, if that is fewer than wanted: no room is needed for more. */
static size_t at_most(const drawing *d, uint32_t length, size_t wanted)
{
    mpz_t kept;
    mpz_init(kept);
    find_kept(d, length, kept);
    if (mpz_cmp_ui(kept, wanted) < 0)
        wanted = (size_t)mpz_get_ui(kept);
    mpz_clear(kept);
    return wanted;
}

/* A rank is drawn in limbs, marked as drawn, and given as an integer: said beforehand, as it is all at once. */
static tn_status check_memory(const drawing *d, uint32_t length, size_t count, tn_error *error)
{
    mpz_t kept;
    char what[64];
    mpz_init(kept);
    find_kept(d, length, kept);
    uint64_t limbs = mpz_size(kept), bytes = sizeof(mpz_t) + 2 * sizeof(mp_limb_t) * limbs + 16 + 4 * sizeof(size_t);
    mpz_clear(kept);
    if (d->likelihood) /* where it lies among the masses, and its place in a tree */
        bytes += 4 * (sizeof(mpz_t) + 2 * sizeof(mp_limb_t) * (1 + mpz_size(mpq_numref(d->weight))));
    snprintf(what, sizeof what, "drawing %zu plans", count);
    tn_status status = tn_watch_room(d->session->opened->module->watch, bytes * count, what, error);
    if (status == TN_LIMIT)
        tn_error_help(error, "draw fewer plans, or raise the limit with --memory-limit");
    return status;
}

static void note_few(const drawing *d, uint32_t length, size_t found, size_t wanted)
{
    const char *what = d->rows ? (found == 1 ? "row of plans" : "rows of plans") : found == 1 ? "plan" : "plans";
    if (length == TN_ALL_LENGTHS)
        tn_session_note(d->session, "the library holds %zu %s, fewer than the %zu asked for: these are all", found,
                        what, wanted);
    else
        tn_session_note(d->session,
                        "the library holds %zu %s of length %u, fewer than the %zu asked for: these are all", found,
                        what, length, wanted);
}

/* Each row of plans of a length as likely as each. */
static tn_status choose_rows(const drawing *d, uint32_t length, size_t count, mpz_t *ranks, size_t *found,
                             tn_error *error)
{
    mpz_t number;
    mpz_init(number);
    find_kept(d, length, number);
    tn_status status = tn_ranks_sample(d->request->seed, length, number, count, ranks, found, error);
    tn_plan_rows_before(d->rows->rows, length, number);
    for (size_t i = 0; status == TN_OK && i < *found; i++)
        mpz_add(ranks[i], ranks[i], number);
    mpz_clear(number);
    return status;
}

static tn_status choose(const drawing *d, uint32_t length, size_t count, size_t *found, tn_error *error)
{
    const tn_sample_request *r = d->request;
    mpz_t *ranks = d->ranks + d->count;
    if (d->rows)
        return choose_rows(d, length, count, ranks, found, error);
    if (d->likelihood)
        return tn_likelihood_sample(d->likelihood, r->seed, length, count, ranks, found, error);
    return (r->diverse ? tn_library_diverse : tn_library_sample)(d->library, r->seed, length, count, ranks, found,
                                                                 error);
}

static tn_status draw_length(drawing *d, uint32_t length, size_t wanted, tn_error *error)
{
    size_t count = at_most(d, length, wanted), found = 0;
    tn_status status = check_memory(d, length, count, error);
    if (status == TN_OK)
        status = make_room(d, count, error);
    if (status == TN_OK)
        status = choose(d, length, count, &found, error);
    if (status != TN_OK)
        return status;
    d->count += found;
    if (found < wanted)
        note_few(d, length, found, wanted);
    return TN_OK;
}

static tn_status draw(drawing *d, tn_error *error)
{
    const tn_sample_request *r = d->request;
    if (!r->has_per_length)
        return draw_length(d, r->has_length ? (uint32_t)r->length : TN_ALL_LENGTHS, (size_t)r->count, error);
    tn_status status = TN_OK;
    for (uint32_t l = tn_library_min(d->library); status == TN_OK && l <= tn_library_max(d->library); l++)
        status = draw_length(d, l, (size_t)r->per_length, error);
    return status;
}

/* ---- weights */

static tn_status note_weights(const drawing *d, const tn_ready_library *ready, tn_error *error)
{
    tn_buffer weights = {0};
    char *total = tn_weight_text(d->weight);
    bool ok = total && tn_weights_say(ready, &weights) && tn_buffer_append(&weights, "", 1);
    if (ok)
        tn_session_note(d->session,
                        "plans are drawn by their weights: %s%s; those of all plans add up to %.200s; --uniform draws "
                        "each plan as likely as each",
                        weights.data,
                        tn_schema_of_plans(ready->schema) ? ", times the plans that their trays stand for" : "", total);
    free(weights.data);
    free(total);
    return ok ? TN_OK : tn_fail_memory(error);
}

/* Rows of trays that stand for plans, without weights: the sum is the number of rows of plans. */
static tn_status note_plans(const drawing *d, const tn_ready_library *ready, tn_error *error)
{
    const tn_module *module = ready->schema->module;
    char *rows = tn_digits(mpq_numref(d->weight), true);
    if (!rows)
        return tn_fail_memory(error);
    tn_session_note(d->session,
                    "rows are drawn by how many rows of plans of `%s` they stand for, %.400s in all; --uniform draws "
                    "each row of trays as likely as each",
                    tn_text(module, module->LIBRARY_records[ready->schema->record->of].name), rows);
    free(rows);
    return TN_OK;
}

/* Makes ready to draw by weights and by the plans that trays stand for, if there are any, and says so. */
static tn_status weigh(drawing *d, const tn_ready_library *ready, tn_error *error)
{
    bool of_plans = tn_schema_of_plans(ready->schema) && !d->request->diverse,
         weights = ready->record->weight_count > 0;
    if (d->request->uniform || !(of_plans || weights))
        return TN_OK;
    tn_session_begins(d->session, "adding up weights");
    tn_status status = tn_likelihood_new(d->library, &d->likelihood, error);
    tn_session_ends(d->session);
    if (status != TN_OK)
        return status;
    tn_likelihood_total(d->likelihood, TN_ALL_LENGTHS, d->weight);
    return weights ? note_weights(d, ready, error) : note_plans(d, ready, error);
}

static tn_status refuse_diverse(tn_session *session, const tn_ready_library *ready)
{
    return tn_session_refuse(session, "add --uniform, or leave out --diverse",
                             "--diverse looks for plans that differ, and the weights of `%s` for likely ones",
                             tn_text(session->opened->module, ready->record->name));
}

/* ---- plans */

static tn_status give_plans(const drawing *d, tn_finds *finds, tn_error *error)
{
    tn_tray *trays = malloc(sizeof *trays * ((size_t)tn_library_max(d->library) + 1));
    tn_status status = trays ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < d->count; i++) {
        tn_found_one found = {.rank = d->ranks[i], .trays = trays};
        status = tn_watch_check(d->session->opened->module->watch, error);
        if (status == TN_OK && !tn_library_unrank(d->library, d->ranks[i], trays, &found.length))
            status = tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a sampled rank is not in the library");
        if (status == TN_OK)
            status = tn_finds_give(finds, &found, error);
    }
    free(trays);
    return status;
}

/* ---- plans that are searched */

static tn_status search_plans(tn_plan_search *search, const tn_sample_request *r, tn_searched_plans *plans,
                              tn_error *error)
{
    uint32_t first = r->has_length ? (uint32_t)r->length : 0, last = r->has_length ? (uint32_t)r->length : UINT32_MAX;
    if (!r->has_per_length)
        return tn_plan_search_sample(search, r->seed, first, last, (size_t)r->count, plans, error);
    tn_status status = TN_OK;
    tn_plan_search_lengths(search, &first, &last);
    for (uint32_t l = first; status == TN_OK && l <= last; l++)
        status = tn_plan_search_sample(search, r->seed, l, l, (size_t)r->per_length, plans, error);
    return status;
}

static tn_status give_searched(const tn_searched_plans *plans, tn_finds *finds, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < plans->count; i++)
        status = tn_finds_give(finds, &(tn_found_one){.trays = plans->items[i].trays, .length = plans->items[i].length},
                               error);
    return status;
}

static void note_searched(tn_session *session, const tn_sample_request *r, const tn_ready_library *ready,
                          const tn_error *limit)
{
    tn_searched_note(session, limit);
    tn_session_note(session, "not each plan is as likely as each, and their ranks are not known");
    if (ready->record->weight_count > 0 && !r->uniform)
        tn_session_note(session, "the weights of `%s` are left out of account",
                        tn_text(session->opened->module, ready->record->name));
}

static tn_status sample_searched(tn_session *session, const tn_sample_request *request, const tn_ready_library *ready,
                                 const tn_error *limit, tn_reply *answer)
{
    tn_search_options options = tn_asked_search(&request->subject, &request->search);
    tn_found_of of = {.plans = ready, .unranked = true};
    tn_finds finds = {.session = session, .of = &of, .answer = answer, .lines = request->lines};
    tn_searched_plans plans = {0};
    tn_plan_search *search;
    tn_error error;
    options.all_generated = request->generated;
    note_searched(session, request, ready, limit);
    tn_status status = tn_plan_search_new(ready->schema, ready->index, &options, &search, &error);
    if (status != TN_OK)
        return tn_session_fail(session, &error);
    status = search_plans(search, request, &plans, &error);
    if (status == TN_OK && !request->has_per_length && plans.count < request->count)
        tn_session_note(session, "the library holds %zu plan%s%s, fewer than the %zu asked for: these are all",
                        plans.count, plans.count == 1 ? "" : "s", request->has_length ? " of this length" : "",
                        (size_t)request->count);
    if (status == TN_OK)
        status = tn_finds_begin(&finds, &error);
    if (status == TN_OK && !finds.ended)
        status = give_searched(&plans, &finds, &error);
    tn_searched_plans_clear(&plans);
    tn_plan_search_free(search);
    return tn_finds_end(&finds, status, &error);
}

/* What differs, and in how many ways plans are derived, is found by the library's automaton alone. */
static tn_status sample_plans(tn_session *session, const tn_sample_request *request, tn_reply *answer)
{
    const tn_ready_library *ready;
    tn_error error, limit;
    tn_status status =
        !request->diverse && !request->ways
            ? tn_session_searched(session, &request->subject, request->generated, &ready, &limit)
            : (request->generated ? tn_session_generated : tn_session_library)(session, &request->subject, &ready);
    if (status != TN_OK)
        return status;
    if (!ready->library)
        return sample_searched(session, request, ready, &limit, answer);
    if (request->diverse && !request->uniform && ready->record->weight_count > 0)
        return refuse_diverse(session, ready);
    tn_found_of of = {.plans = ready, .ways = request->ways};
    tn_finds finds = {.session = session, .of = &of, .answer = answer, .lines = request->lines};
    drawing d = {.session = session, .library = ready->library, .request = request};
    mpq_init(d.weight);
    status = weigh(&d, ready, &error);
    if (status == TN_OK)
        status = draw(&d, &error);
    of.weight = d.likelihood ? d.weight : NULL;
    if (status == TN_OK)
        status = tn_finds_begin(&finds, &error);
    if (status == TN_OK && !finds.ended)
        status = give_plans(&d, &finds, &error);
    clear(&d);
    return tn_finds_end(&finds, status, &error);
}

/* ---- rows of plans */

static tn_status give_rows(const drawing *d, tn_finds *finds, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < d->count; i++) {
        status = tn_watch_check(d->session->opened->module->watch, error);
        if (status == TN_OK)
            status = tn_rows_give(d->rows, d->ranks[i], finds, error);
    }
    return status;
}

static tn_status draw_rows(drawing *d, const tn_ready_library *ready, tn_reply *answer)
{
    tn_error error;
    mpz_t all;
    mpz_init(all);
    tn_plan_rows_count(d->rows->rows, TN_ALL_LENGTHS, all);
    tn_found_of of = {.plans = ready, .rows = all};
    tn_finds finds = {.session = d->session, .of = &of, .answer = answer, .lines = d->request->lines};
    tn_status status = draw(d, &error);
    if (status == TN_OK)
        status = tn_finds_begin(&finds, &error);
    if (status == TN_OK && !finds.ended)
        status = give_rows(d, &finds, &error);
    status = tn_finds_end(&finds, status, &error);
    mpz_clear(all);
    return status;
}

static tn_status refuse_weighted_rows(tn_session *session, const tn_ready_library *ready)
{
    return tn_session_refuse(session, "add --uniform, or leave out --plans",
                             "rows of plans are drawn each as likely as each, and `%s` has weights",
                             tn_text(session->opened->module, ready->record->name));
}

static tn_status sample_rows(tn_session *session, const tn_sample_request *request, tn_reply *answer)
{
    const tn_ready_library *ready;
    tn_rows_of_plans rows = {0};
    tn_status status =
        (request->generated ? tn_session_generated : tn_session_library)(session, &request->subject, &ready);
    if (status == TN_OK)
        status = tn_rows_open(&rows, session, ready, &request->subject);
    if (status == TN_OK && ready->record->weight_count > 0 && !request->uniform)
        status = refuse_weighted_rows(session, ready);
    if (status == TN_OK) {
        drawing d = {.session = session, .library = ready->library, .request = request, .rows = &rows};
        mpq_init(d.weight);
        status = draw_rows(&d, ready, answer);
        clear(&d);
    }
    tn_rows_close(&rows);
    return status;
}

/* ---- houses */

typedef struct giving {
    tn_finds *finds;
    uint64_t given;
} giving;

static tn_status give_house(void *context, tn_house *house, const mpz_t rank, const mpz_t variant, tn_error *error)
{
    giving *g = context;
    const tn_found_one found = {
        .rank = rank, .trays = house->trays, .length = (uint32_t)house->length, .house = house, .variant = variant};
    g->given++;
    return tn_finds_give(g->finds, &found, error);
}

static tn_status give_houses(tn_numbered *n, const tn_sample_request *request, const tn_plan *plan, tn_reply *answer)
{
    tn_error error;
    tn_found_of of = {.houses = n, .unranked = !plan && tn_numbered_walks(n)};
    tn_finds finds = {.session = n->session, .of = &of, .answer = answer};
    giving g = {.finds = &finds};
    tn_status status = tn_finds_begin(&finds, &error);
    if (status == TN_OK && !finds.ended)
        status = tn_numbered_sample(n, plan, (size_t)request->count, request->seed, request->diverse, give_house, &g,
                                    &error);
    if (status == TN_OK && !finds.ended)
        tn_numbered_say_few(n, plan != NULL, g.given, request->count);
    return tn_finds_end(&finds, status, &error);
}

/* Houses of several plans whose library has weights. */
static tn_status refuse_weighted(tn_session *session, const tn_numbered *n)
{
    const tn_module *module = session->opened->module;
    return tn_session_refuse(session, "add --uniform, or give one plan with --plan",
                             "houses are drawn each as likely as each, and the plans of `%s` have weights",
                             tn_text(module, module->LIBRARY_records[n->record->plans].name));
}

static tn_status sample_houses(tn_session *session, const tn_sample_request *request, tn_reply *answer)
{
    tn_numbered n;
    tn_plan on;
    tn_status status = tn_numbered_open_on(&n, session, &request->subject, request->plan, &on);
    bool weighted = status == TN_OK && session->opened->module->LIBRARY_records[n.record->plans].weight_count > 0;
    if (weighted && !request->uniform && !request->plan)
        status = refuse_weighted(session, &n);
    if (status == TN_OK)
        status = give_houses(&n, request, request->plan ? &on : NULL, answer);
    free(on.trays);
    tn_numbered_close(&n);
    return status;
}

/* ---- asked */

/* What is about the length of plans is for plans alone. */
static tn_status refuse_for_houses(tn_session *session, const tn_sample_request *request)
{
    return tn_session_refuse(
        session, "write it as a requirement, such as --where \"quantity(any, n = 3)\"; --plan takes one plan",
        "for a library of houses, `tartan sample` does not take %s", request->has_length ? "--length" : "--per-length");
}

static tn_status check(tn_session *session, const tn_sample_request *request, bool houses)
{
    if (request->has_count == request->has_per_length)
        return tn_session_refuse(session, NULL, "say how many plans: either N after the file, or --per-length N");
    if (request->has_per_length && request->has_length)
        return tn_session_refuse(session, NULL, "--length and --per-length exclude each other");
    if (request->diverse && request->has_per_length)
        return tn_session_refuse(
            session, NULL, "--diverse and --per-length exclude each other: give --length for plans of one length");
    if (request->diverse && !houses && request->count > TN_DIVERSE_MAX)
        return tn_session_refuse(session, NULL, "--diverse chooses at most %u plans, not %" PRIu64, TN_DIVERSE_MAX,
                                 request->count);
    return TN_OK;
}

tn_status tn_ask_sample(tn_session *session, const tn_sample_request *request, tn_reply *answer)
{
    const tn_sample_request *r = request;
    *answer = (tn_reply){0};
    bool houses = r->plan || tn_session_of_houses(session, &r->subject);
    if (houses && r->generated)
        return tn_session_refuse(session, NULL, "`generated` is asked of plans, and this is a library of houses");
    if (houses && r->ways)
        return tn_ways_refuse_houses(session);
    if (r->plans && (houses || r->ways || r->diverse))
        return tn_rows_refuse_with(session, houses ? "houses" : r->ways ? "--ways" : "--diverse");
    if (houses && (r->has_length || r->has_per_length))
        return refuse_for_houses(session, r);
    tn_status status = check(session, r, houses);
    if (status != TN_OK)
        return status;
    return (houses ? sample_houses : r->plans ? sample_rows : sample_plans)(session, r, answer);
}
