/* Houses by their ranks and by the numbers on their plans, and the other way round. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "ask/house/numbered.h"
#include "ask/house/typed.h"
#include "runtime/house/house.h"

/* ---- all houses */

tn_status tn_numbered_of(tn_numbered *n, const tn_houses_what *what, tn_houses **houses, tn_error *error)
{
    tn_session_begins(n->session, "counting houses");
    tn_status status = tn_houses_of(&n->form, n->record, n->plans, what, n->max_states, houses, error);
    tn_session_ends(n->session);
    return status;
}

tn_status tn_numbered_all(tn_numbered *n, tn_error *error)
{
    const tn_houses_what all = {0};
    return n->all ? TN_OK : tn_numbered_of(n, &all, &n->all, error);
}

/* rest: the rank, of which the houses before its plan are taken. */
static tn_status locate(tn_numbered *n, mpz_t rest, mpz_t plan, tn_error *error)
{
    uint32_t length = 0;
    tn_tray *trays = tn_numbered_tray_room(n, error);
    if (!trays)
        return TN_MEMORY;
    tn_status status = tn_numbered_find(n, n->all, rest, trays, &length, error);
    if (status == TN_OK && !tn_library_rank(n->plans, trays, length, plan))
        status = tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a house stands on a plan that is not in the library");
    free(trays);
    return status;
}

tn_status tn_numbered_locate(tn_numbered *n, const mpz_t rank, mpz_t plan, mpz_t before, tn_error *error)
{
    tn_status status = TN_OK;
    tn_houses_count(n->all, TN_ALL_LENGTHS, before);
    tn_library_kept(n->plans, TN_ALL_LENGTHS, plan);
    if (mpz_cmp(rank, before) < 0) {
        mpz_t rest;
        mpz_init_set(rest, rank);
        status = locate(n, rest, plan, error);
        mpz_sub(before, rank, rest);
        mpz_clear(rest);
    }
    return status;
}

/* ---- stretches of ranks */

/* next: the rank of the next house that is used. before: houses on the plans before. */
typedef struct stretch {
    tn_house_of_rank *use;
    void *context;
    mpz_t next, before;
    mpz_srcptr to;
} stretch;

static tn_status use_house(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    stretch *s = context;
    tn_status status = s->use(s->context, house, s->next, error);
    mpz_add_ui(s->next, s->next, 1);
    *stop = mpz_cmp(s->next, s->to) >= 0;
    return status;
}

static tn_status use_plan(tn_numbered *n, void *context, const tn_tray *trays, uint32_t length, bool *stop,
                          tn_error *error)
{
    stretch *s = context;
    tn_status status = tn_numbered_each_from(n, trays, length, s->next, s->before, use_house, s, error);
    *stop = mpz_cmp(s->next, s->to) >= 0;
    return status;
}

tn_status tn_numbered_between(tn_numbered *n, const mpz_t from, const mpz_t to, tn_house_of_rank *use, void *context,
                              tn_error *error)
{
    stretch s = {.use = use, .context = context, .to = to};
    mpz_t plan;
    if (mpz_cmp(from, to) >= 0)
        return TN_OK;
    mpz_init(plan);
    mpz_init_set(s.next, from);
    mpz_init(s.before);
    tn_status status = tn_numbered_locate(n, from, plan, s.before, error);
    if (status == TN_OK)
        status = tn_numbered_plans_from(n, plan, use_plan, &s, error);
    mpz_clears(plan, s.next, s.before, NULL);
    return status;
}

static bool at_most(const tn_numbered *n, uint64_t plans)
{
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(n->plans, TN_ALL_LENGTHS, kept);
    bool few = mpz_cmp_ui(kept, plans) <= 0;
    mpz_clear(kept);
    return few;
}

bool tn_numbered_few(const tn_numbered *n)
{
    return at_most(n, TN_HOUSE_PLANS_FEW);
}

bool tn_numbered_walks(const tn_numbered *n)
{
    const tn_house_clause_record *clauses = n->form.module->HOUSE_CLAUSE_records + n->record->clause_first;
    bool walks = false;
    for (uint32_t i = 0; i < n->record->clause_count; i++)
        walks = walks || n->walking[clauses[i].holds];
    return walks;
}

bool tn_numbered_countable(const tn_numbered *n)
{
    return tn_numbered_walks(n) ? n->by_plan && tn_numbered_few(n) : at_most(n, TN_HOUSE_PLANS_MAX);
}

/* ---- names */

static tn_status rank_plan(const tn_numbered *n, const tn_house *house, mpz_t plan, tn_error *error)
{
    if (tn_library_rank(n->plans, house->trays, house->length, plan))
        return TN_OK;
    tn_fail(error, TN_INVALID, E_NO_VARIANT, "the library does not hold the plan of this house");
    tn_error_help(error, "`tartan explain` says which clauses drop it");
    return TN_INVALID;
}

tn_status tn_numbered_name(tn_numbered *n, const tn_house *house, mpz_t plan, mpz_t variant, tn_error *error)
{
    tn_status status = rank_plan(n, house, plan, error);
    return status == TN_OK ? tn_numbered_number(n, house, variant, error) : status;
}

tn_status tn_numbered_rank(tn_numbered *n, const tn_house *house, mpz_t rank, tn_error *error)
{
    mpz_t before;
    mpz_init(before);
    tn_status status = rank_plan(n, house, before, error);
    if (status == TN_OK)
        status = tn_numbered_all(n, error);
    if (status == TN_OK)
        status = tn_numbered_number(n, house, rank, error);
    if (status == TN_OK)
        status = tn_houses_before(n->all, house->trays, (uint32_t)house->length, before, error);
    mpz_add(rank, rank, before);
    mpz_clear(before);
    return status;
}

tn_status tn_numbered_typed(tn_numbered *n, const char *text, size_t max_length, tn_house *house)
{
    const tn_typed_among among = {.form = &n->form,
                                  .form_number = n->record->form,
                                  .library = n->record,
                                  .plans = n->plans,
                                  .options = {.max_states = n->max_states, .max_length = (uint32_t)max_length},
                                  .max_length = max_length,
                                  .kept = true};
    bool completed;
    return tn_typed_house(n->session, &among, text, house, &completed);
}

bool tn_is_house_number(const char *text)
{
    size_t digits = strspn(text, "0123456789");
    return text[0] == '#' || (digits > 0 && text[digits] == ':');
}

bool tn_is_rank(const char *text)
{
    return *text && strspn(text, "0123456789") == strlen(text);
}

bool tn_is_house_line(const char *text)
{
    return strchr(text, ';') != NULL;
}

typedef struct tn_house_search {
    mpz_t left; /* houses before the wanted one, on the plans to come */
    tn_house *house;
    bool found;
} tn_house_search;

static tn_status search_plan(tn_numbered *n, void *context, const tn_tray *trays, uint32_t length, bool *stop,
                             tn_error *error)
{
    tn_house_search *s = context;
    mpz_t houses;
    mpz_init(houses);
    tn_status status = tn_numbered_houses_on(n, trays, length, houses, error);
    *stop = s->found = status == TN_OK && mpz_cmp(s->left, houses) < 0;
    if (s->found)
        status = tn_numbered_at(n, trays, length, s->left, s->house, error);
    else
        mpz_sub(s->left, s->left, houses);
    mpz_clear(houses);
    return status;
}

/* Plan by plan, the houses before it are counted. */
static tn_status search_plans(tn_numbered *n, const mpz_t rank, tn_house *house, tn_error *error)
{
    tn_house_search s = {.house = house};
    mpz_init_set(s.left, rank);
    tn_status status = tn_numbered_plans(n, search_plan, &s, error);
    if (status == TN_OK && !s.found) {
        status = tn_fail(error, TN_INVALID, E_NO_VARIANT, "the library has fewer houses than that");
        tn_error_help(error, "`tartan count` says how many; ranks count from 0");
    }
    mpz_clear(s.left);
    return status;
}

static tn_status find_house(tn_numbered *n, const mpz_t rank, tn_house *house, tn_error *error)
{
    uint32_t length = 0;
    mpz_t rest;
    tn_tray *trays = tn_numbered_tray_room(n, error);
    if (!trays)
        return TN_MEMORY;
    mpz_init_set(rest, rank);
    tn_status status = tn_numbered_find(n, n->all, rest, trays, &length, error);
    if (status == TN_OK)
        status = tn_numbered_at(n, trays, length, rest, house, error);
    mpz_clear(rest);
    free(trays);
    return status;
}

/* The house that `rank` others come before. */
static tn_status house_of_rank(tn_numbered *n, const mpz_t rank, tn_house *house, tn_error *error)
{
    tn_status status = tn_numbered_all(n, error);
    if (status == TN_OK)
        return find_house(n, rank, house, error);
    return status == TN_LIMIT && tn_numbered_countable(n) ? search_plans(n, rank, house, error) : status;
}

static tn_status house_of_digits(tn_numbered *n, const char *digits, tn_house *house, tn_error *error)
{
    mpz_t rank;
    if (!*digits || digits[strspn(digits, "0123456789")]) {
        tn_status status = tn_fail(error, TN_INVALID, E_NO_VARIANT, "`#%.60s` names no house", digits);
        tn_error_help(error, "a house is #P:V, the plan's rank and its place among the houses on that plan, or #R, its "
                             "rank among all houses");
        return status;
    }
    mpz_init_set_str(rank, digits, 10);
    tn_status status = house_of_rank(n, rank, house, error);
    mpz_clear(rank);
    return status;
}

tn_status tn_numbered_house(tn_numbered *n, const char *number, tn_house *house, tn_error *error)
{
    number += number[0] == '#';
    const char *colon = strchr(number, ':');
    mpz_t variant;
    uint32_t length = 0;
    *house = (tn_house){0};
    if (!colon)
        return house_of_digits(n, number, house, error);
    tn_tray *trays = tn_numbered_tray_room(n, error);
    if (!trays)
        return TN_MEMORY;
    mpz_init(variant);
    tn_status status = tn_numbered_plan_of_rank(n, number, (size_t)(colon - number), trays, &length, error);
    if (status == TN_OK && (!colon[1] || strspn(colon + 1, "0123456789") != strlen(colon + 1) ||
                            mpz_set_str(variant, colon + 1, 10) != 0)) {
        status = tn_fail(error, TN_INVALID, E_NO_VARIANT, "a variant is a whole number from 0, not `%.60s`", colon + 1);
        tn_error_help(error, "a house is #P:V: the plan's rank, and its place among the houses on that plan");
    }
    if (status == TN_OK)
        status = tn_numbered_at(n, trays, length, variant, house, error);
    mpz_clear(variant);
    free(trays);
    return status;
}

tn_status tn_session_house(tn_session *session, const tn_house_settings *settings, const char *number,
                           tn_house_use *use, void *context)
{
    tn_numbered n;
    tn_house house = {0};
    tn_error error = {0};
    tn_status status = tn_numbered_open(&n, session, settings);
    if (status == TN_OK) {
        status = tn_numbered_house(&n, number, &house, &error);
        if (status == TN_OK)
            status = use(context, &house, &error);
        if (status != TN_OK)
            tn_session_fail(session, &error);
    }
    tn_house_clear(&house);
    tn_numbered_close(&n);
    return status;
}
