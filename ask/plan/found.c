/* Gives what a question finds to its taker, or puts it into the answer. */
#include "ask/plan/found.h"

#include <stdlib.h>
#include <string.h>

#include "ask/house/numbered.h"
#include "runtime/house/house.h"

tn_status tn_finds_begin(tn_finds *finds, tn_error *error)
{
    const tn_taker *taker = finds->session->taker;
    const tn_found_of *of = finds->of;
    const tn_module *module = finds->session->opened->module;
    const tn_message *message = !of->houses  ? &tn_message_found_plans
                                : of->wishes ? &tn_message_best_houses
                                             : &tn_message_found_houses;
    tn_status status = tn_reply_new(message, finds->answer, error);
    tn_found_plans *plans = TN_REPLY(found_plans, finds->answer);
    tn_found_houses *houses = TN_REPLY(found_houses, finds->answer);
    tn_best_houses *best = TN_REPLY(best_houses, finds->answer);
    if (plans)
        plans->library = tn_text(module, of->plans->record->name);
    if (plans && of->weight) {
        plans->has_total_weight = true;
        mpq_set(plans->total_weight, of->weight);
    }
    if (houses)
        houses->library = tn_text(module, of->houses->record->name);
    if (best)
        best->library = tn_text(module, of->houses->record->name);
    if (status == TN_OK && of->ways) {
        status = tn_ways_open(&finds->ways, of->plans, error);
        finds->has_ways = true;
    }
    finds->ended = status == TN_OK && taker && taker->begins && !taker->begins(taker->context, finds->of);
    return status;
}

/* ---- as texts */

tn_status tn_found_plan_texts(const tn_schema *schema, const tn_tray *trays, uint32_t length, char **line,
                              char **members, tn_error *error)
{
    tn_buffer text = {0}, written = {0};
    tn_json json = tn_json_text(&written, TN_JSON_TIGHT);
    bool ok = !line || (tn_plan_write_line(schema, trays, length, &text) && tn_buffer_append(&text, "", 1));
    if (members)
        tn_plan_write_trays(schema, trays, length, &json);
    if (line)
        *line = text.data;
    if (members)
        *members = written.data;
    return ok && !written.failed ? TN_OK : tn_fail_memory(error);
}

tn_status tn_found_house_texts(const tn_house *house, char **line, char **members, tn_error *error)
{
    tn_buffer text = {0}, written = {0};
    tn_json json = tn_json_text(&written, TN_JSON_TIGHT);
    tn_status status = tn_house_write(house, &text, error);
    if (status == TN_OK && members) {
        tn_json_string(&json, "house", text.data);
        tn_plan_write_trays(house->form->schema, house->trays, house->length, &json);
        status = tn_house_write_members(house, &json, error);
    }
    if (line)
        *line = text.data;
    else
        free(text.data);
    if (members)
        *members = written.data;
    return status == TN_OK && written.failed ? tn_fail_memory(error) : status;
}

/* ---- into the answer */

/* The values of measures, in their units. */
static tn_status set_values(const tn_wishes *wishes, mpq_t *from, tn_exacts *values, tn_error *error)
{
    tn_status status = tn_exacts_room(values, wishes->count, error);
    for (uint32_t k = 0; status == TN_OK && k < wishes->count; k++) {
        mpq_set(values->items[k], from[k]);
        tn_amount_convert(wishes->units[k], values->items[k]);
    }
    return status;
}

/* One value, or several. Either is initialised. */
static tn_status set_value(const tn_wishes *wishes, mpq_t *from, mpq_t value, tn_exacts *values, tn_error *error)
{
    if (wishes->count > 1)
        return set_values(wishes, from, values, error);
    mpq_set(value, from[0]);
    tn_amount_convert(wishes->units[0], value);
    return TN_OK;
}

/* A row of plans. */
static tn_status add_row(const tn_schema *schema, const tn_found_one *found, char **line, char **members,
                         tn_error *error)
{
    tn_buffer written = {0};
    tn_json json = tn_json_text(&written, TN_JSON_TIGHT);
    tn_plan_write_trays(schema, found->trays, found->length, &json);
    tn_json_written(&json, found->plans, strlen(found->plans));
    *members = written.data;
    bool good = !line || (*line = strdup(found->row));
    return good && !written.failed ? TN_OK : tn_fail_memory(error);
}

static tn_status add_plan(const tn_finds *finds, const tn_found_one *found, tn_error *error)
{
    tn_found_plans *to = finds->answer->value;
    tn_found_plan *plan = TN_ADD(found_plan, to->plans, error);
    if (!plan)
        return TN_MEMORY;
    const tn_wishes *wishes = finds->of->wishes;
    plan->has_rank = found->rank != NULL;
    if (found->rank)
        mpz_set(plan->rank, found->rank);
    plan->has_plan = finds->lines;
    plan->has_ways = found->ways != NULL;
    if (found->ways)
        mpz_set(plan->ways, found->ways);
    plan->has_value = wishes && wishes->count == 1;
    plan->has_values = wishes && wishes->count > 1;
    if (wishes && set_value(wishes, found->values, plan->value, &plan->values, error) != TN_OK)
        return TN_MEMORY;
    const tn_schema *schema = finds->of->plans->schema;
    char **line = finds->lines ? &plan->plan : NULL;
    if (found->row)
        return add_row(schema, found, line, &plan->members, error);
    return tn_found_plan_texts(schema, found->trays, found->length, line, &plan->members, error);
}

static tn_status add_house(const tn_finds *finds, const tn_found_one *found, tn_error *error)
{
    tn_found_houses *to = finds->answer->value;
    tn_found_house *house = TN_ADD(found_house, to->houses, error);
    if (!house)
        return TN_MEMORY;
    house->has_rank = found->rank != NULL;
    if (found->rank)
        mpz_set(house->rank, found->rank);
    house->has_variant = found->variant != NULL;
    if (found->variant)
        mpz_set(house->variant, found->variant);
    if (!tn_library_rank(finds->of->houses->plans, found->trays, found->length, house->plan_rank))
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a house stands on a plan that is not in the library");
    return tn_found_house_texts(found->house, NULL, &house->members, error);
}

static tn_status add_best_house(const tn_finds *finds, const tn_found_one *found, tn_error *error)
{
    const tn_wishes *wishes = finds->of->wishes;
    tn_best_houses *to = finds->answer->value;
    tn_best_house *house = TN_ADD(best_house, to->houses, error);
    if (!house)
        return TN_MEMORY;
    house->has_value = wishes->count == 1;
    house->has_values = wishes->count > 1;
    if (set_value(wishes, found->values, house->value, &house->values, error) != TN_OK)
        return TN_MEMORY;
    return tn_found_house_texts(found->house, &house->house, NULL, error);
}

static tn_status add(const tn_finds *finds, const tn_found_one *found, tn_error *error)
{
    if (!found->house)
        return add_plan(finds, found, error);
    return (finds->of->wishes ? add_best_house : add_house)(finds, found, error);
}

tn_status tn_finds_give(tn_finds *finds, const tn_found_one *found, tn_error *error)
{
    const tn_taker *taker = finds->session->taker;
    tn_found_one all = *found;
    tn_status status = TN_OK;
    if (finds->has_ways) {
        status = tn_ways_find(&finds->ways, found->trays, found->length, error);
        all.ways = finds->ways.ways;
    }
    if (status != TN_OK)
        return status;
    if (!taker)
        return add(finds, &all, error);
    finds->ended = !taker->takes(taker->context, &all);
    return finds->ended ? tn_fail(error, TN_STOPPED, TN_CODE_NONE, "enough was found") : TN_OK;
}

bool tn_finds_lists(const tn_finds *finds)
{
    return finds->session->taker && finds->session->taker->lists && !finds->has_ways;
}

tn_status tn_finds_list(tn_finds *finds, mpz_srcptr from, mpz_srcptr to, unsigned threads, tn_error *error)
{
    const tn_taker *taker = finds->session->taker;
    return taker->lists(taker->context, finds->of->plans->library, from, to, threads, &finds->ended, error);
}

tn_status tn_finds_end(tn_finds *finds, tn_status status, const tn_error *error)
{
    if (finds->has_ways)
        tn_ways_close(&finds->ways);
    finds->has_ways = false;
    if (status == TN_OK || (status == TN_STOPPED && finds->ended))
        return TN_OK;
    return tn_session_fail(finds->session, error);
}
