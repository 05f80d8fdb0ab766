/* count: how many plans, houses or buildings there are; of plans by length, and what clauses keep out. */
#include <stdlib.h>
#include <string.h>

#include "ask/house/numbered_count.h"
#include "ask/place/kit.h"
#include "ask/plan/searched.h"
#include "ask/plan/ways.h"
#include "ask/session/made.h"
#include "ask/session/questions.h"
#include "ask/session/requests.h"
#include "driver/measure/spread.h"
#include "runtime/number/rational.h"
#include "runtime/plan/library/plan_rows.h"

/* ---- how plans, or houses, are spread over the values of a measure */

static tn_status refuse_step(tn_session *session, const char *step, const tn_bins *bins)
{
    const char *unit = tn_amount_unit_name(bins->unit);
    char help[120];
    snprintf(help, sizeof help, "write it in %s, without the unit: --step 50", *unit ? unit : "the measure's numbers");
    return tn_session_refuse(session, help, "the step is a number above 0, not `%.60s`", step);
}

/* As it is asked for, or by how many values there are. */
static tn_status choose_bins(tn_session *session, const tn_count_request *request, tn_bins *bins)
{
    const char *step = request->step;
    if (step && !(tn_decimal_read(step, strlen(step), bins->step) && mpq_sgn(bins->step) > 0))
        return refuse_step(session, step, bins);
    bins->binned =
        bins->d->count > 0 && (step || request->has_bins || (bins->d->count > TN_VALUES_LISTED && !request->values));
    if (!bins->binned)
        return TN_OK;
    if (!step)
        tn_bins_few(bins, request->has_bins ? request->bins : TN_BINS_DEFAULT);
    return tn_bins_at_most(bins, TN_BINS_MAX)
               ? TN_OK
               : tn_session_refuse(session, "give a greater one", "the step makes more than %u bins", TN_BINS_MAX);
}

static size_t count_rows(const tn_bins *bins)
{
    tn_bin_row row;
    size_t count = 0;
    tn_bin_row_init(bins, &row);
    while (tn_bin_row_next(bins, &row))
        count++;
    tn_bin_row_clear(&row);
    return count;
}

static tn_status give_rows(const tn_spread *spread, bool of_houses, tn_counted_values *counted, tn_error *error)
{
    const tn_bins *bins = &spread->bins;
    tn_status status =
        tn_message_list(&tn_message_spread_row, count_rows(bins), (tn_list *)&counted->distribution, error);
    tn_bin_row row;
    tn_bin_row_init(bins, &row);
    for (size_t i = 0; status == TN_OK && tn_bin_row_next(bins, &row); i++) {
        tn_spread_row *given = &counted->distribution.items[i];
        given->has_from = given->has_to = bins->binned;
        given->has_value = !bins->binned;
        given->has_houses = of_houses;
        given->has_plans = !of_houses;
        mpq_set(bins->binned ? given->from : given->value, row.from);
        mpq_set(given->to, row.to);
        mpz_set(of_houses ? given->houses : given->plans, row.plans);
    }
    tn_bin_row_clear(&row);
    return status;
}

static tn_status give_quartiles(const tn_bins *bins, tn_exacts *quartiles, tn_error *error)
{
    tn_status status = tn_exacts_room(quartiles, 3, error);
    for (unsigned i = 0; status == TN_OK && i < 3; i++)
        tn_bins_value(bins, tn_distribution_quartile(bins->d, i + 1), quartiles->items[i]);
    return status;
}

static tn_status give_statistics(const tn_bins *bins, tn_counted_values *counted, tn_error *error)
{
    tn_buffer deviation = {0};
    counted->has_least = counted->has_most = counted->has_mean = counted->has_variance = true;
    counted->has_deviation = counted->has_quartiles = true;
    tn_bins_value(bins, 0, counted->least);
    tn_bins_value(bins, bins->d->count - 1, counted->most);
    tn_distribution_moments(bins->d, counted->mean, counted->variance);
    tn_amount_write_root(bins->unit, counted->variance, &deviation);
    tn_amount_convert(bins->unit, counted->mean);
    tn_amount_convert(bins->unit, counted->variance);
    tn_amount_convert(bins->unit, counted->variance);
    counted->deviation = deviation.data;
    return deviation.data ? give_quartiles(bins, &counted->quartiles, error) : tn_fail_memory(error);
}

static tn_status give(const tn_spread *spread, tn_counted_values *counted, tn_error *error)
{
    bool of_houses = strcmp(spread->of, "house") == 0;
    counted->measure = spread->name;
    counted->dimension = spread->bins.unit.power;
    counted->unit = tn_amount_unit_name(spread->bins.unit);
    counted->has_houses = of_houses;
    counted->has_plans = !of_houses;
    mpz_set(of_houses ? counted->houses : counted->plans, spread->d.all);
    counted->has_none = mpz_sgn(spread->d.without) > 0;
    mpz_set(counted->none, spread->d.without);
    tn_status status = give_rows(spread, of_houses, counted, error);
    return status == TN_OK && spread->d.count > 0 ? give_statistics(&spread->bins, counted, error) : status;
}

static void free_spread(void *spread)
{
    tn_spread_clear(spread);
    free(spread);
}

/* An empty spread (malloc); NULL: out of memory, which is said. */
static tn_spread *spread_room(tn_session *session)
{
    tn_error error;
    tn_spread *spread = calloc(1, sizeof *spread);
    if (!spread) {
        tn_fail_memory(&error);
        tn_session_fail(session, &error);
    }
    return spread;
}

/* The distribution as the answer, which takes over the spread (malloc) in any case; `step` and `bins` of the request
 * say how its values are put together. */
static tn_status reply_spread(tn_session *session, const tn_count_request *request, tn_spread *spread, tn_reply *answer)
{
    tn_error error;
    tn_status status = choose_bins(session, request, &spread->bins);
    if (status != TN_OK) {
        free_spread(spread);
        return status;
    }
    status = tn_reply_new(&tn_message_counted_values, answer, &error);
    if (status != TN_OK) {
        free_spread(spread);
        return tn_session_fail(session, &error);
    }
    tn_counted_values *counted = answer->value;
    counted->spread = (tn_boxed){spread, free_spread};
    status = give(spread, counted, &error);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

/* After counting by a measure, which came to that status: the answer, which takes the spread over, or what is wrong. */
static tn_status end_spread(tn_session *session, const tn_count_request *request, tn_spread *spread, tn_status status,
                            const tn_error *error, tn_reply *answer)
{
    tn_session_ends(session);
    if (status == TN_OK)
        return reply_spread(session, request, spread, answer);
    free_spread(spread);
    return tn_session_fail(session, error);
}

/* How the plans of a library are spread over the values of a measure. */
static tn_status count_plans_by(tn_session *session, const tn_count_request *request, tn_reply *answer)
{
    const tn_ready_library *ready;
    uint32_t index;
    tn_error error;
    tn_status status = tn_session_library(session, &request->subject, &ready);
    if (status == TN_OK)
        status = tn_measure_choose(session->opened, request->by, ready->record, &index);
    if (status != TN_OK)
        return status;
    tn_spread *spread = spread_room(session);
    if (!spread)
        return TN_MEMORY;
    tn_session_begins(session, "counting by the measure");
    status = tn_spread_make(spread, ready, index, &error);
    return end_spread(session, request, spread, status, &error, answer);
}

/* ---- counts the houses of a library, or those on one plan */

static tn_status count_by(tn_numbered *n, const tn_count_request *request, const tn_plan *plan, tn_reply *answer)
{
    tn_session *session = n->session;
    tn_error error;
    uint32_t measure;
    tn_status status = tn_house_measure_choose(session->opened, request->by, n->record->form, &measure);
    if (status != TN_OK)
        return status;
    tn_spread *spread = spread_room(session);
    if (!spread)
        return TN_MEMORY;
    tn_session_begins(session, "counting by the measure");
    status = tn_numbered_spread(n, plan, measure, spread, &error);
    return end_spread(session, request, spread, status, &error, answer);
}

static tn_status count_all_houses(tn_numbered *n, const tn_count_request *request, const tn_plan *plan,
                                  tn_reply *answer)
{
    tn_error error;
    tn_status status = tn_reply_new(&tn_message_counted_houses, answer, &error);
    if (status == TN_OK)
        status = tn_numbered_count(n, plan, request->clauses, answer->value, &error);
    if (status != TN_OK)
        return tn_session_fail(n->session, &error);
    const tn_counted_houses *counted = answer->value;
    if (mpz_sgn(counted->houses) == 0 && !request->clauses)
        tn_numbered_say_few(n, plan != NULL, 0, 1);
    return TN_OK;
}

/* The houses of a library, all of them or by a measure. */
static tn_status count_houses(tn_session *session, const tn_count_request *request, tn_reply *answer)
{
    tn_numbered n;
    tn_plan on;
    tn_status status = tn_numbered_open_on(&n, session, &request->subject, request->plan, &on);
    if (status == TN_OK)
        status = (request->by ? count_by : count_all_houses)(&n, request, request->plan ? &on : NULL, answer);
    free(on.trays);
    tn_numbered_close(&n);
    return status;
}

/* ---- plans */

typedef struct counting {
    tn_session *session;
    const tn_ready_library *ready;
    tn_counted_plans *counted;
    tn_plan_rows *rows; /* if its trays stand for plans */
    bool mirror;
} counting;

static const tn_clause_record *clause_record(const counting *c, uint32_t i)
{
    return &c->ready->schema->module->CLAUSE_records[c->ready->record->clause_first + i];
}

/* Of all lengths, or of one. What is below 0 is not known. */
static tn_status count_length(const counting *c, uint32_t length, tn_plans_of_length *count, tn_error *error)
{
    const tn_library *library = c->ready->library;
    tn_status status = tn_watch_check(c->session->opened->module->watch, error);
    count->length = length;
    tn_library_kept(library, length, count->kept);
    if (status == TN_OK)
        status = tn_library_generated(library, length, count->generated, error);
    if (status == TN_OK && c->mirror)
        status = tn_library_kept_mirror(library, length, count->mirror, error);
    count->has_generated = mpz_sgn(count->generated) >= 0;
    count->has_kept = mpz_sgn(count->kept) >= 0;
    count->has_mirror = c->mirror;
    count->has_rows_of_plans = c->rows != NULL;
    if (c->rows)
        tn_plan_rows_count(c->rows, length, count->rows_of_plans);
    return status;
}

static tn_status count_all(const counting *c, tn_error *error)
{
    tn_counted_plans *counted = c->counted;
    tn_plans_of_length all;
    tn_message_init(&tn_message_plans_of_length, &all);
    tn_status status = count_length(c, TN_ALL_LENGTHS, &all, error);
    counted->has_generated = all.has_generated;
    counted->has_kept = all.has_kept;
    counted->has_mirror = all.has_mirror;
    counted->has_rows_of_plans = all.has_rows_of_plans;
    mpz_set(counted->rows_of_plans, all.rows_of_plans);
    mpz_set(counted->generated, all.generated);
    mpz_set(counted->kept, all.kept);
    mpz_set(counted->mirror, all.mirror);
    mpz_sub(counted->pruned, all.generated, all.kept);
    counted->has_pruned = mpz_sgn(counted->pruned) >= 0;
    tn_message_clear(&tn_message_plans_of_length, &all);
    return status;
}

static tn_status count_lengths(const counting *c, tn_error *error)
{
    uint32_t low = tn_library_min(c->ready->library), high = tn_library_max(c->ready->library);
    size_t count = (size_t)high - low + 1;
    tn_status status = TN_NEW_LIST(plans_of_length, c->counted->by_length, count, error);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        status = count_length(c, low + (uint32_t)i, &c->counted->by_length.items[i], error);
    return status == TN_OK ? count_all(c, error) : status;
}

static tn_status describe(const counting *c, tn_error *error)
{
    const tn_module *module = c->ready->schema->module;
    const tn_library *library = c->ready->library;
    tn_counted_plans *counted = c->counted;
    size_t apart = tn_library_apart(library);
    char hash[33];
    counted->library = tn_text(module, c->ready->record->name);
    counted->doc = tn_text(module, c->ready->record->doc);
    counted->states = tn_library_states(library);
    counted->has_states = !tn_library_within(library);
    counted->has_apart = apart != SIZE_MAX;
    counted->has_hash = !counted->has_apart;
    if (counted->has_apart) {
        counted->apart = tn_text(module, clause_record(c, (uint32_t)apart)->name);
        return TN_OK;
    }
    tn_library_hash(library, hash);
    counted->hash = strdup(hash);
    return counted->hash ? TN_OK : tn_fail_memory(error);
}

/* ---- clauses */

/* If a clause is counted apart, it is not known what only each of the others keeps out: says so, once. */
static void note_apart(const counting *c)
{
    const tn_module *module = c->ready->schema->module;
    size_t apart = tn_library_apart(c->ready->library);
    tn_error note;
    if (apart == SIZE_MAX)
        return;
    const tn_clause_record *clause = clause_record(c, (uint32_t)apart);
    tn_fail(&note, TN_LIMIT, E_TOO_MANY_STATES,
            "what only one clause keeps out is counted for `%.80s` alone: with it the automaton of this library passes "
            "a limit",
            tn_text(module, clause->name));
    tn_error_help(&note, "give fewer trays with --trays, or raise the limit with --max-states");
    note.code_offset = module->FUNCTION_records[clause->holds].code_begin;
    tn_finding_limit(c->session->opened, &note, NULL);
}

/* A clause past a limit leaves the other counts as they are: a note says which it is. */
static tn_status count_clause(const counting *c, uint32_t i, mpz_t out, mpz_t only, uint64_t *states, tn_error *error)
{
    uint32_t taken = 0;
    tn_status status = tn_library_effect(c->ready->library, i, out, only, &taken, error);
    *states = taken;
    if (status != TN_LIMIT)
        return status;
    if (tn_library_apart(c->ready->library) != SIZE_MAX && mpz_sgn(out) >= 0)
        return TN_OK;
    tn_finding_uncounted(c->session->opened, tn_text(c->ready->schema->module, clause_record(c, i)->name), error);
    return TN_OK;
}

static tn_status count_requirement(const counting *c, uint32_t i, tn_requirement_effect *r, tn_error *error)
{
    tn_status status = count_clause(c, i, r->keeps_out, r->only, &r->states, error);
    r->name = tn_text(c->ready->schema->module, clause_record(c, i)->name);
    r->has_keeps_out = mpz_sgn(r->keeps_out) >= 0;
    r->has_only = mpz_sgn(r->only) >= 0;
    return status;
}

static tn_status count_rule(const counting *c, uint32_t i, tn_rule_effect *r, tn_error *error)
{
    tn_status status = count_clause(c, i, r->prunes, r->only, &r->states, error);
    r->name = tn_text(c->ready->schema->module, clause_record(c, i)->name);
    r->has_prunes = mpz_sgn(r->prunes) >= 0;
    r->has_only = mpz_sgn(r->only) >= 0;
    return status;
}

static bool is_rule(const counting *c, uint32_t i)
{
    return clause_record(c, i)->kind == TN_CLAUSE_PRUNE;
}

static tn_status count_clauses(const counting *c, tn_error *error)
{
    tn_counted_plans *counted = c->counted;
    uint32_t count = c->ready->record->clause_count, rules = 0, rule = 0, requirement = 0;
    for (uint32_t i = 0; i < count; i++)
        rules += is_rule(c, i);
    tn_status status = TN_NEW_LIST(rule_effect, counted->rules, rules, error);
    if (status == TN_OK)
        status = TN_NEW_LIST(requirement_effect, counted->requirements, count - rules, error);
    tn_session_begins(c->session, "clauses counted");
    for (uint32_t i = 0; status == TN_OK && i < count; i++)
        status = is_rule(c, i) ? count_rule(c, i, &counted->rules.items[rule++], error)
                               : count_requirement(c, i, &counted->requirements.items[requirement++], error);
    tn_session_ends(c->session);
    if (status == TN_OK)
        note_apart(c);
    counted->has_rules = counted->has_requirements = true;
    return status;
}

static tn_status count_plans(tn_session *session, const tn_count_request *request, tn_reply *answer)
{
    counting c = {.session = session, .mirror = request->mirror};
    tn_error error;
    tn_status status = (c.mirror ? tn_session_library : tn_session_counted)(session, &request->subject, &c.ready);
    if (status == TN_OK && tn_schema_of_plans(c.ready->schema)) /* rows of plans are counted state by state */
        status = tn_session_library(session, &request->subject, &c.ready);
    if (status != TN_OK)
        return tn_searched_instead(
            session, status,
            "how many plans there are is not known past this limit. `enumerate`, `sample`, `best`, "
            "`pareto`, `complete` and `diff` find plans of such a library by search, or that there "
            "is none");
    status = tn_reply_new(&tn_message_counted_plans, answer, &error);
    c.counted = answer->value;
    if (status == TN_OK)
        status = describe(&c, &error);
    if (status == TN_OK && tn_schema_of_plans(c.ready->schema))
        status = tn_plan_rows_new(c.ready->library, &c.rows, &error);
    if (status == TN_OK)
        status = count_lengths(&c, &error);
    tn_plan_rows_free(c.rows);
    c.rows = NULL;
    if (status == TN_OK && session->so_far)
        session->so_far(session->so_far_context, answer);
    if (status == TN_OK && !request->no_effects)
        status = count_clauses(&c, &error);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

/* ---- asked */

/* What only libraries of plans and houses are asked, or NULL. */
static const char *asks_library(const tn_count_request *r)
{
    return r->subject.library       ? "library"
           : r->subject.where.count ? "where"
           : r->subject.has_trays   ? "trays"
           : r->by                  ? "by"
           : r->drawn.picture       ? "picture"
           : r->step                ? "step"
           : r->has_bins            ? "bins"
           : r->plan                ? "plan"
           : r->clauses             ? "clauses"
           : r->mirror              ? "mirror"
           : r->ways                ? "ways"
           : r->no_effects          ? "no-effects"
                                    : NULL;
}

/* With a plan or clauses, or if the library named is one of houses. */
static bool counts_houses(const tn_session *session, const tn_count_request *r)
{
    return r->plan || r->clauses || tn_session_of_houses(session, &r->subject);
}

/* The histogram of a distribution. */
static tn_status draw(tn_session *session, const tn_answer_picture *asked, tn_counted_values *values)
{
    tn_picture to = tn_answer_picture_begin(asked);
    tn_error error;
    tn_status status = tn_spread_draw(values->spread.value, &to, &error);
    return tn_answer_picture_give(session, asked, &to, status, &error, (tn_list *)&values->files, &values->has_files);
}

/* What counting ways is not asked with, or NULL. */
static const char *asks_besides(const tn_count_request *r)
{
    return r->by ? "by" : r->mirror ? "mirror" : r->no_effects ? "no-effects" : NULL;
}

static tn_status count_ways(tn_session *session, const tn_count_request *request, tn_reply *answer)
{
    const char *besides = asks_besides(request);
    if (counts_houses(session, request))
        return tn_ways_refuse_houses(session);
    return besides ? tn_session_refuse(session, "ask for one after the other", "--ways and --%s exclude each other",
                                       besides)
                   : tn_count_ways(session, request, answer);
}

static tn_status count(tn_session *session, const tn_count_request *request, tn_reply *answer)
{
    if (request->ways)
        return count_ways(session, request, answer);
    if (counts_houses(session, request))
        return count_houses(session, request, answer);
    return request->by ? count_plans_by(session, request, answer) : count_plans(session, request, answer);
}

tn_status tn_ask_count(tn_session *session, const tn_count_request *request, tn_reply *answer)
{
    *answer = (tn_reply){0};
    if (session->opened->module->KIT_count > 0) {
        const char *option = asks_library(request);
        return option ? tn_session_refuse(session, NULL, "--%s is about a library of plans, and %.200s is a kit",
                                          option, session->opened->path)
                      : tn_count_kit(session, request, answer);
    }
    tn_status status = tn_kit_none_asked(session, &request->kit);
    if (status != TN_OK)
        return status;
    if (tn_answer_has_picture(&request->drawn) && !request->by)
        return tn_session_refuse(session, "give `by`, a measure", "only how plans are spread over a measure is drawn");
    status = count(session, request, answer);
    tn_counted_values *values = TN_REPLY(counted_values, answer);
    return status == TN_OK && tn_answer_has_picture(&request->drawn) && values ? draw(session, &request->drawn, values)
                                                                               : status;
}
