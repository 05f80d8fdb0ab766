/* Ranks plans among those of the same values: by trays to come, state and what the measures still come to. */
#include "runtime/plan/measure/standing_plans.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/integers.h"
#include "runtime/number/rational.h"
#include "runtime/plan/library/library_data.h"
#include "runtime/plan/measure/bundle.h"

/* Plans of one length whose measures come to the same sums: their place among those to come from the start. */
typedef struct ending {
    uint32_t record; /* of the trays that stand for them: the schema's first is 0 */
    uint32_t length;
    uint32_t place;
} ending;

/* By letter, of a state with so many trays to come: how many of the wanted plans go on so. */
typedef struct ways_on {
    bool *known;
    uint32_t *target; /* UINT32_MAX: none goes on */
    int64_t *gains;   /* [letters][sums] */
    mpz_t *plans;
} ways_on;

struct tn_standing_plans {
    const tn_library *library;
    const tn_schema *rows;
    tn_bundle *bundle;
    uint32_t columns, sums;
    uint32_t field[TN_BUNDLE_MEASURES_MAX]; /* [columns]: of the schema */
    uint32_t *depth;                        /* [states]: the fewest trays that lead there */
    size_t depth_room;
    tn_crowd *ahead;   /* [max + 1]: by trays to come, the plans of each state by what they add to each sum */
    uint32_t **first;  /* [max + 1][states + 1]: a state's first in that */
    size_t held;       /* of all these */
    tn_interner kinds; /* a value of each column: one a record */
    size_t records;
    ending *endings; /* by record, then length */
    size_t ending_count, ending_room;
    size_t *first_ending; /* [records + 1] */
    int64_t *wanted;      /* [endings of a record and length][sums]: what is to come */
    ways_on on;
    tn_key key;
};

static const tn_module *module_of(const tn_standing_plans *p)
{
    return p->rows->module;
}

/* ---- what fields say */

/* Which measure says a field; NULL: none does. */
static const tn_said_record *said_of(const tn_module *module, uint32_t field)
{
    for (size_t i = 0; i < module->SAID_count; i++)
        if (module->SAID_records[i].field == field)
            return &module->SAID_records[i];
    return NULL;
}

static tn_status says_nothing(const tn_standing_plans *p, const char *field, tn_error *error)
{
    tn_fail(error, TN_INVALID, E_REFUSED_MODULE,
            "the module does not hold how plans are measured for field `%.100s` of schema %.100s", field,
            tn_text(module_of(p), p->rows->record->name));
    tn_error_help(error, "it was built by an older tartan, or damaged: build it again with `tartan build`");
    return TN_INVALID;
}

static tn_status join(tn_standing_plans *p, tn_error *error)
{
    const tn_module *module = module_of(p);
    tn_bundle_measure measures[TN_BUNDLE_MEASURES_MAX];
    for (uint32_t f = 0; f < p->rows->field_count; f++) {
        uint32_t record = p->rows->record->field_first + f;
        const tn_said_record *said = said_of(module, record);
        if (!*tn_text(module, module->FIELD_records[record].said_by))
            continue;
        if (!said || module->SUM_records[said->sum].schema != p->library->record->schema ||
            p->columns == TN_BUNDLE_MEASURES_MAX)
            return says_nothing(p, tn_text(module, module->FIELD_records[record].name), error);
        measures[p->columns] =
            (tn_bundle_measure){tn_text(module, module->FIELD_records[record].said_by), said->sum, said->over};
        p->field[p->columns++] = f;
    }
    tn_status status = tn_bundle_new(p->library, measures, p->columns, &p->bundle, error);
    p->sums = status == TN_OK ? tn_bundle_sums(p->bundle) : 0;
    return status;
}

/* ---- plans by trays to come */

static tn_status find_states(tn_standing_plans *p, tn_error *error)
{
    uint32_t known = 0;
    for (uint32_t s = 0; s < tn_bundle_states(p->bundle); s++) {
        size_t count;
        const tn_bundle_edge *edges;
        uint32_t depth = s == 0 ? 0 : p->depth[s];
        tn_status status = TN_OK;
        if (depth < p->library->max)
            status = tn_bundle_edges(p->bundle, s, &edges, &count, error);
        if (status == TN_OK && s % 256 == 0)
            status = tn_watch_check(module_of(p)->watch, error);
        if (status != TN_OK)
            return status;
        uint32_t states = tn_bundle_states(p->bundle);
        if (!tn_array_reserve_from(&p->depth, &p->depth_room, 64, known, states - known, sizeof *p->depth))
            return tn_fail_memory(error);
        for (; known < states; known++)
            p->depth[known] = known == 0 ? 0 : depth + 1;
    }
    return TN_OK;
}

static tn_status too_many(const tn_standing_plans *p, tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_TOO_MANY_VALUES,
            "the plans of library %s come to more than %u different values tray by tray",
            tn_text(module_of(p), p->library->record->name), TN_STANDING_VALUES_MAX);
    tn_error_help(error, "ask measures of fewer different values, or a library of shorter plans");
    return TN_LIMIT;
}

/* The plan that ends in the state, if one does that has a value of each measure. */
static tn_status end_state(tn_standing_plans *p, uint32_t state, tn_error *error)
{
    bool ends = tn_bundle_ends(p->bundle, state);
    for (uint32_t k = 0; k < p->columns && ends; k++)
        ends = tn_bundle_valued(p->bundle, state, k);
    if (!ends)
        return TN_OK;
    p->key.size = 0;
    bool good = tn_key_push(&p->key, state);
    for (uint32_t s = 0; s < p->sums && good; s++)
        good = tn_key_push_sum(&p->key, tn_bundle_rest(p->bundle, state, s));
    mpz_ptr plans = good ? tn_crowd_at(&p->ahead[0], &p->key) : NULL;
    if (!plans)
        return tn_fail_memory(error);
    mpz_set_ui(plans, 1);
    return TN_OK;
}

/* Adds the plans that go on by an edge, with so many trays to come before it. */
static tn_status follow(tn_standing_plans *p, uint32_t state, uint32_t left, const tn_bundle_edge *edge,
                        tn_error *error)
{
    const tn_crowd *behind = &p->ahead[left - 1];
    const int64_t *gains = tn_bundle_gains(p->bundle, edge);
    for (uint32_t i = p->first[left - 1][edge->target]; i < p->first[left - 1][edge->target + 1]; i++) {
        size_t size;
        const uint32_t *key = tn_interned(&behind->keys, i, &size);
        p->key.size = 0;
        bool good = tn_key_push(&p->key, state);
        for (uint32_t s = 0; s < p->sums && good; s++)
            good = tn_key_push_sum(&p->key, tn_key_sum(key + 1, s) + gains[s]);
        mpz_ptr plans = good ? tn_crowd_at(&p->ahead[left], &p->key) : NULL;
        if (!plans)
            return tn_fail_memory(error);
        mpz_addmul_ui(plans, behind->plans[i], edge->trays);
    }
    return p->held + p->ahead[left].count > TN_STANDING_VALUES_MAX ? too_many(p, error) : TN_OK;
}

static tn_status count_state(tn_standing_plans *p, uint32_t state, uint32_t left, tn_error *error)
{
    size_t count;
    const tn_bundle_edge *edges;
    if (p->depth[state] + left > p->library->max)
        return TN_OK;
    if (left == 0)
        return end_state(p, state, error);
    tn_status status = tn_bundle_edges(p->bundle, state, &edges, &count, error);
    for (size_t e = 0; status == TN_OK && e < count; e++)
        status = follow(p, state, left, &edges[e], error);
    return status;
}

static tn_status count_ahead(tn_standing_plans *p, tn_error *error)
{
    uint32_t states = tn_bundle_states(p->bundle), layers = p->library->max + 1;
    p->ahead = calloc(layers, sizeof *p->ahead);
    p->first = calloc(layers, sizeof *p->first);
    if (!p->ahead || !p->first)
        return tn_fail_memory(error);
    for (uint32_t left = 0; left < layers; left++) {
        p->first[left] = calloc((size_t)states + 1, sizeof **p->first);
        tn_status status = p->first[left] ? TN_OK : tn_fail_memory(error);
        for (uint32_t s = 0; status == TN_OK && s < states; s++) {
            status = count_state(p, s, left, error);
            p->first[left][s + 1] = (uint32_t)p->ahead[left].count;
            if (status == TN_OK && s % 256 == 0)
                status = tn_watch_check(module_of(p)->watch, error);
        }
        if (status != TN_OK)
            return status;
        p->held += p->ahead[left].count;
    }
    return TN_OK;
}

/* ---- which trays stand for them */

static const tn_tray_plans_record *record_of(const tn_standing_plans *p, size_t record)
{
    return &module_of(p)->TRAY_PLANS_records[p->rows->record->tray_plans_first + record];
}

static tn_status says_otherwise(const tn_standing_plans *p, tn_error *error)
{
    return tn_fail(error, TN_INVALID, E_REFUSED_MODULE,
                   "the trays of schema %s do not stand for as many plans of library %s as its module says",
                   tn_text(module_of(p), p->rows->record->name), tn_text(module_of(p), p->library->record->name));
}

/* The value that a record's trays have in a field. */
static uint32_t value_in(const tn_standing_plans *p, const tn_tray_plans_record *record, uint32_t field)
{
    const tn_schema *rows = p->rows;
    const tn_mask_record *mask = &module_of(p)->MASK_records[module_of(p)->SPEC_records[record->spec].mask_first];
    uint32_t first = rows->value_start[field], last = rows->value_start[field + 1];
    for (uint32_t v = first; v < last; v++)
        if ((uint64_t)mask[v / 64].bits >> v % 64 & 1)
            return v - first;
    return last - first;
}

static tn_status find_kinds(tn_standing_plans *p, tn_error *error)
{
    p->records = p->rows->record->tray_plans_count;
    for (size_t r = 0; r < p->records; r++) {
        p->key.size = 0;
        bool good = true;
        for (uint32_t k = 0; k < p->columns && good; k++)
            good = tn_key_push(&p->key, value_in(p, record_of(p, r), p->field[k]));
        uint32_t kind = good ? tn_intern(&p->kinds, p->key.data, p->key.size) : UINT32_MAX;
        if (kind == UINT32_MAX)
            return tn_fail_memory(error);
        if (kind != r)
            return says_otherwise(p, error);
    }
    return TN_OK;
}

/* The value of the field, of plans that a measure says this of; as many as there are: none is it. */
static uint32_t value_for(const tn_standing_plans *p, uint32_t field, const mpq_t said)
{
    const tn_schema *rows = p->rows;
    uint32_t first = rows->value_start[field], count = rows->value_start[field + 1] - first, v = 0;
    if (module_of(p)->FIELD_records[rows->record->field_first + field].kind == TN_FIELD_FLAG)
        return mpq_sgn(said) != 0;
    mpq_t value;
    mpq_init(value);
    for (bool found = false; v < count && !found; v += !found) {
        const char *number = tn_text(module_of(p), rows->values[first + v].number);
        mpq_set_si(value, rows->values[first + v].length, 1);
        found = (!*number || tn_rational_read(number, value)) && mpq_equal(value, said);
    }
    mpq_clear(value);
    return v;
}

/* Which record's trays stand for the plans that come to these sums; UINT32_MAX: none. */
static tn_status find_record(tn_standing_plans *p, const int64_t *sums, uint32_t *record, tn_error *error)
{
    mpq_t value;
    mpq_init(value);
    bool good = true;
    p->key.size = 0;
    for (uint32_t k = 0; k < p->columns && good; k++) {
        tn_bundle_value(p->bundle, k, sums, value);
        good = tn_key_push(&p->key, value_for(p, p->field[k], value));
    }
    mpq_clear(value);
    *record = tn_interner_find(&p->kinds, p->key.data, p->key.size);
    return good ? TN_OK : tn_fail_memory(error);
}

static int compare_endings(const void *left, const void *right)
{
    const ending *a = left, *b = right;
    if (a->record != b->record)
        return a->record < b->record ? -1 : 1;
    if (a->length != b->length)
        return a->length < b->length ? -1 : 1;
    return (a->place > b->place) - (a->place < b->place);
}

/* The plans of one length, from the start, by what they come to. */
static tn_status add_endings(tn_standing_plans *p, uint32_t length, tn_error *error)
{
    for (uint32_t i = p->first[length][0]; i < p->first[length][1]; i++) {
        size_t size;
        int64_t sums[TN_BUNDLE_SUMS_MAX];
        uint32_t record;
        const uint32_t *key = tn_interned(&p->ahead[length].keys, i, &size);
        for (uint32_t s = 0; s < p->sums; s++)
            sums[s] = tn_key_sum(key + 1, s) + tn_bundle_start(p->bundle, s);
        tn_status status = find_record(p, sums, &record, error);
        if (status != TN_OK)
            return status;
        if (record == UINT32_MAX)
            return says_otherwise(p, error);
        if (!tn_array_reserve(&p->endings, &p->ending_room, p->ending_count, 1, sizeof *p->endings))
            return tn_fail_memory(error);
        p->endings[p->ending_count++] = (ending){record, length, i};
    }
    return TN_OK;
}

static mpz_srcptr plans_of(const tn_standing_plans *p, const ending *e)
{
    return p->ahead[e->length].plans[e->place];
}

/* Each record says as many as there are. */
static tn_status check_records(const tn_standing_plans *p, tn_error *error)
{
    mpz_t found, said;
    mpz_inits(found, said, NULL);
    bool same = true;
    for (size_t r = 0; r < p->records && same; r++) {
        mpz_set_ui(found, 0);
        mpz_set_str(said, tn_text(module_of(p), record_of(p, r)->plans), 10);
        for (size_t e = p->first_ending[r]; e < p->first_ending[r + 1]; e++)
            mpz_add(found, found, plans_of(p, &p->endings[e]));
        same = mpz_cmp(found, said) == 0;
    }
    mpz_clears(found, said, NULL);
    return same ? TN_OK : says_otherwise(p, error);
}

static tn_status find_endings(tn_standing_plans *p, tn_error *error)
{
    tn_status status = find_kinds(p, error);
    for (uint32_t n = p->library->min; status == TN_OK && n <= p->library->max; n++)
        status = add_endings(p, n, error);
    p->first_ending = calloc(p->records + 2, sizeof *p->first_ending);
    p->wanted = tn_array_new((uint64_t)tn_size_of(p->ending_count, p->sums) + 1, sizeof *p->wanted);
    if (status == TN_OK && (!p->first_ending || !p->wanted))
        status = tn_fail_memory(error);
    if (status != TN_OK)
        return status;
    if (p->ending_count > 0)
        qsort(p->endings, p->ending_count, sizeof *p->endings, compare_endings);
    for (size_t e = 0; e < p->ending_count; e++)
        p->first_ending[p->endings[e].record + 1]++;
    for (size_t r = 0; r < p->records; r++)
        p->first_ending[r + 1] += p->first_ending[r];
    return check_records(p, error);
}

static tn_status make_room(tn_standing_plans *p, tn_error *error)
{
    uint32_t letters = tn_bundle_letters(p->bundle);
    p->on = (ways_on){.known = calloc((size_t)letters + 1, sizeof *p->on.known),
                      .target = calloc((size_t)letters + 1, sizeof *p->on.target),
                      .gains = tn_array_new((uint64_t)tn_size_of(letters, p->sums) + 1, sizeof *p->on.gains),
                      .plans = tn_integers_new(letters)};
    return p->on.known && p->on.target && p->on.gains && p->on.plans ? TN_OK : tn_fail_memory(error);
}

tn_status tn_standing_plans_new(const tn_library *library, const tn_schema *rows, tn_standing_plans **out,
                                tn_error *error)
{
    tn_standing_plans *p = calloc(1, sizeof *p);
    *out = NULL;
    if (!p)
        return tn_fail_memory(error);
    p->library = library;
    p->rows = rows;
    tn_status status = join(p, error);
    if (status == TN_OK)
        status = make_room(p, error);
    if (status == TN_OK)
        status = find_states(p, error);
    if (status == TN_OK)
        status = count_ahead(p, error);
    if (status == TN_OK)
        status = find_endings(p, error);
    if (status == TN_OK)
        *out = p;
    else
        tn_standing_plans_free(p);
    return status;
}

void tn_standing_plans_free(tn_standing_plans *p)
{
    if (!p)
        return;
    if (p->bundle)
        tn_integers_free(p->on.plans, tn_bundle_letters(p->bundle));
    free(p->on.known);
    free(p->on.target);
    free(p->on.gains);
    for (uint32_t left = 0; p->ahead && left <= p->library->max; left++)
        tn_crowd_clear(&p->ahead[left]);
    for (uint32_t left = 0; p->first && left <= p->library->max; left++)
        free(p->first[left]);
    free(p->ahead);
    free(p->first);
    free(p->depth);
    free(p->endings);
    free(p->first_ending);
    free(p->wanted);
    free(p->key.data);
    tn_interner_clear(&p->kinds);
    tn_bundle_free(p->bundle);
    free(p);
}

/* ---- going from tray to tray */

/* The plans that are wanted: of a record and a length. */
typedef struct group {
    const ending *first;
    size_t count;
} group;

/* The next group of a record, from ending *at on; false: there are no more. */
static bool next_group(const tn_standing_plans *p, size_t record, size_t *at, group *g)
{
    size_t end = p->first_ending[record + 1];
    if (*at >= end)
        return false;
    *g = (group){&p->endings[*at], 0};
    for (; *at < end && p->endings[*at].length == g->first->length; ++*at)
        g->count++;
    return true;
}

static void count_group(const tn_standing_plans *p, const group *g, mpz_t plans)
{
    mpz_set_ui(plans, 0);
    for (size_t i = 0; i < g->count; i++)
        mpz_add(plans, plans, plans_of(p, &g->first[i]));
}

static void begin_group(tn_standing_plans *p, const group *g)
{
    for (size_t i = 0; i < g->count; i++) {
        size_t size;
        const uint32_t *key = tn_interned(&p->ahead[g->first->length].keys, g->first[i].place, &size);
        for (uint32_t s = 0; s < p->sums; s++)
            p->wanted[i * p->sums + s] = tn_key_sum(key + 1, s);
    }
}

static void begin_state(tn_standing_plans *p)
{
    memset(p->on.known, 0, tn_bundle_letters(p->bundle) * sizeof *p->on.known);
}

/* How many of the group go on from the state by the letter, with so many trays to come after it. */
static tn_status look(tn_standing_plans *p, const group *g, uint32_t state, uint32_t letter, uint32_t left,
                      tn_error *error)
{
    ways_on *on = &p->on;
    int64_t *gains = on->gains + (size_t)letter * p->sums;
    if (on->known[letter])
        return TN_OK;
    on->known[letter] = true;
    mpz_set_ui(on->plans[letter], 0);
    tn_status status = tn_bundle_step(p->bundle, state, letter, &on->target[letter], gains, error);
    for (size_t i = 0; status == TN_OK && on->target[letter] != UINT32_MAX && i < g->count; i++) {
        p->key.size = 0;
        bool good = tn_key_push(&p->key, on->target[letter]);
        for (uint32_t s = 0; s < p->sums && good; s++)
            good = tn_key_push_sum(&p->key, p->wanted[i * p->sums + s] - gains[s]);
        if (!good)
            return tn_fail_memory(error);
        mpz_srcptr plans = tn_crowd_find(&p->ahead[left], &p->key);
        if (plans)
            mpz_add(on->plans[letter], on->plans[letter], plans);
    }
    return status;
}

static uint32_t take(tn_standing_plans *p, const group *g, uint32_t letter)
{
    for (size_t i = 0; i < g->count; i++)
        for (uint32_t s = 0; s < p->sums; s++)
            p->wanted[i * p->sums + s] -= p->on.gains[(size_t)letter * p->sums + s];
    return p->on.target[letter];
}

/* Goes to the tray among whose plans the number is, which becomes that among them. */
static tn_status choose(tn_standing_plans *p, const group *g, uint32_t *state, uint32_t left, mpz_t number,
                        tn_tray *tray, tn_error *error)
{
    begin_state(p);
    for (*tray = 0; *tray < p->library->schema->tray_count; ++*tray) {
        uint32_t letter = tn_bundle_letter(p->bundle, *tray);
        tn_status status = look(p, g, *state, letter, left, error);
        if (status != TN_OK)
            return status;
        if (mpz_cmp(number, p->on.plans[letter]) < 0) {
            *state = take(p, g, letter);
            return TN_OK;
        }
        mpz_sub(number, number, p->on.plans[letter]);
    }
    return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a tray stands for fewer plans than were counted");
}

tn_status tn_standing_plans_unrank(tn_standing_plans *p, tn_tray tray, const mpz_t number, tn_tray *trays,
                                   uint32_t *length, tn_error *error)
{
    size_t record = p->rows->tray_plans[tray] - p->rows->record->tray_plans_first, at = p->first_ending[record];
    group g = {0};
    mpz_t rest, plans;
    mpz_init(plans);
    mpz_init_set(rest, number);
    bool found = false;
    while (!found && next_group(p, record, &at, &g)) {
        count_group(p, &g, plans);
        found = mpz_cmp(rest, plans) < 0;
        if (!found)
            mpz_sub(rest, rest, plans);
    }
    tn_status status =
        found ? TN_OK : tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a tray does not stand for so many plans");
    uint32_t state = 0;
    *length = found ? g.first->length : 0;
    if (found)
        begin_group(p, &g);
    for (uint32_t i = 0; status == TN_OK && i < *length; i++)
        status = choose(p, &g, &state, *length - i - 1, rest, &trays[i], error);
    mpz_clears(rest, plans, NULL);
    return status;
}

/* Adds the plans of the group that have a tray before this one here, and goes on by it. */
static tn_status pass(tn_standing_plans *p, const group *g, uint32_t *state, uint32_t left, tn_tray tray, mpz_t number,
                      bool *stands, tn_error *error)
{
    begin_state(p);
    for (tn_tray t = 0; t <= tray; t++) {
        uint32_t letter = tn_bundle_letter(p->bundle, t);
        tn_status status = look(p, g, *state, letter, left, error);
        if (status != TN_OK)
            return status;
        if (t < tray)
            mpz_add(number, number, p->on.plans[letter]);
    }
    uint32_t letter = tn_bundle_letter(p->bundle, tray);
    *stands = mpz_sgn(p->on.plans[letter]) > 0;
    if (*stands)
        *state = take(p, g, letter);
    return TN_OK;
}

tn_status tn_standing_plans_rank(tn_standing_plans *p, tn_tray tray, const tn_tray *trays, uint32_t length,
                                 mpz_t number, bool *stands, tn_error *error)
{
    size_t record = p->rows->tray_plans[tray] - p->rows->record->tray_plans_first, at = p->first_ending[record];
    group g = {0};
    mpz_t plans;
    mpz_init(plans);
    mpz_set_ui(number, 0);
    *stands = false;
    while (!*stands && next_group(p, record, &at, &g)) {
        *stands = g.first->length == length;
        count_group(p, &g, plans);
        if (!*stands)
            mpz_add(number, number, plans);
    }
    mpz_clear(plans);
    tn_status status = TN_OK;
    uint32_t state = 0;
    if (*stands)
        begin_group(p, &g);
    for (uint32_t i = 0; status == TN_OK && *stands && i < length; i++)
        status = pass(p, &g, &state, length - i - 1, trays[i], number, stands, error);
    return status;
}
