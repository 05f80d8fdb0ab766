/* Reads derivations letter by letter. */
#include "runtime/plan/ways/rests.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/plan/ways/rests_data.h"

/* ---- numbers of things */

tn_status tn_rests_number(tn_rests *r, tn_interner *interner, const uint32_t *words, size_t count, uint32_t *number,
                          tn_error *error)
{
    *number = tn_intern(interner, words, count);
    if (*number == UINT32_MAX)
        return tn_fail_memory(error);
    if (interner->count <= TN_RESTS_MAX)
        return TN_OK;
    tn_fail(error, TN_LIMIT, E_TOO_MANY_STATES,
            "the derivations of plans of up to %u trays have more than the limit of %u rests", r->longest,
            TN_RESTS_MAX);
    tn_error_help(error, "give fewer trays with --trays");
    return TN_LIMIT;
}

tn_status tn_rests_symbol(tn_rests *r, symbol made, uint32_t *number, tn_error *error)
{
    const uint32_t words[SYMBOL_WORDS] = {(uint32_t)made.kind, made.of, made.side, made.k, made.start};
    return tn_rests_number(r, &r->symbols, words, SYMBOL_WORDS, number, error);
}

symbol tn_rests_symbol_of(const tn_rests *r, uint32_t number)
{
    size_t size;
    const uint32_t *words = tn_interned(&r->symbols, number, &size);
    return (symbol){(symbol_kind)words[0], words[1], words[2], words[3], words[4]};
}

/* ---- stacks */

static uint32_t add(uint32_t a, uint32_t b)
{
    return a + b < NEVER ? a + b : NEVER;
}

static uint32_t least_of_parts(const tn_rests *r, const symbol *more)
{
    uint32_t all = 0, one = NEVER;
    for (uint32_t k = more->k; k < r->derivation->nodes[more->of].count; k++) {
        uint32_t part = tn_rests_part(r, more->of, more->side, k), least = r->least[part];
        one = least < one ? least : one;
        all = r->derivation->nodes[part].optional ? all : add(all, least);
    }
    return all > 0 ? all : one;
}

static uint32_t least_of(const tn_rests *r, const symbol *s)
{
    const tn_derived *node = &r->derivation->nodes[s->of];
    uint32_t left = 0, first, second;
    switch (s->kind) {
    case SYMBOL_NODE:
        return r->least[s->of];
    case SYMBOL_MORE:
        return least_of_parts(r, s);
    case SYMBOL_TIMES:
        for (uint32_t n = s->k; n < node->least && left < NEVER; n++)
            left = add(left, r->least[node->first]);
        return left > 0 ? left : r->least[node->first];
    case SYMBOL_FACT:
        return r->facts[s->of].least[s->side];
    case SYMBOL_PAIR:
        first = r->stack_least[s->of];
        second = r->stack_least[s->side];
        return first > second ? first : second;
    case SYMBOL_TIED:
        return 0;
    default:
        return 1;
    }
}

tn_status tn_rests_push(tn_rests *r, uint32_t number, uint32_t stack, uint32_t *out, tn_error *error)
{
    const uint32_t words[] = {number, stack};
    tn_status status = tn_rests_number(r, &r->stacks, words, 2, out, error);
    if (status != TN_OK || *out + 1 < r->stacks.count)
        return status;
    if (!tn_array_reserve(&r->stack_least, &r->stack_least_room, *out, 1, sizeof *r->stack_least))
        return tn_fail_memory(error);
    symbol s = tn_rests_symbol_of(r, number);
    r->stack_least[*out] = add(least_of(r, &s), r->stack_least[stack]);
    return TN_OK;
}

static symbol top_of(const tn_rests *r, uint32_t stack, uint32_t *below)
{
    size_t size;
    const uint32_t *words = tn_interned(&r->stacks, stack, &size);
    *below = words[1];
    return tn_rests_symbol_of(r, words[0]);
}

/* ---- lists */

tn_status tn_rest_list_add(tn_rest_list *list, uint32_t rest, const mpz_t ways, tn_error *error)
{
    uint32_t low = 0, high = list->count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (list->rests[middle] < rest)
            low = middle + 1;
        else
            high = middle;
    }
    if (low < list->count && list->rests[low] == rest) {
        mpz_add(list->ways[low], list->ways[low], ways);
        return TN_OK;
    }
    if (!tn_array_reserve(&list->rests, &list->rest_room, list->count, 1, sizeof *list->rests) ||
        !tn_array_reserve(&list->ways, &list->ways_room, list->count, 1, sizeof *list->ways))
        return tn_fail_memory(error);
    memmove(list->rests + low + 1, list->rests + low, (list->count - low) * sizeof *list->rests);
    memmove(list->ways + low + 1, list->ways + low, (list->count - low) * sizeof *list->ways);
    list->rests[low] = rest;
    mpz_init_set(list->ways[low], ways);
    list->count++;
    return TN_OK;
}

void tn_rest_list_clear(tn_rest_list *list)
{
    for (uint32_t i = 0; i < list->count; i++)
        mpz_clear(list->ways[i]);
    free(list->rests);
    free(list->ways);
    *list = (tn_rest_list){0};
}

static tn_status add_config(configs *to, uint32_t stack, uint32_t duty, const mpz_t ways, tn_error *error)
{
    if (!tn_array_reserve(&to->items, &to->room, to->count, 1, sizeof *to->items))
        return tn_fail_memory(error);
    config *made = &to->items[to->count++];
    made->stack = stack;
    made->duty = duty;
    mpz_init_set(made->ways, ways);
    return TN_OK;
}

static void clear_configs(configs *list)
{
    for (size_t i = 0; i < list->count; i++)
        mpz_clear(list->items[i].ways);
    free(list->items);
}

/* ---- duties: states that have to accept what is to come, in pairs of a fact and a state; TIED: nothing is to come */

enum { DUTY_WORDS = 2, DUTY_TIED = TN_RESTS_MAX };

static int compare_duties(const void *left, const void *right)
{
    return memcmp(left, right, DUTY_WORDS * sizeof(uint32_t));
}

/* Sorts the pairs, each once. */
static tn_status number_duty(tn_rests *r, tn_key *duty, uint32_t *number, tn_error *error)
{
    size_t kept = 0;
    if (duty->size > DUTY_WORDS)
        qsort(duty->data, duty->size / DUTY_WORDS, DUTY_WORDS * sizeof *duty->data, compare_duties);
    for (size_t i = 0; i < duty->size; i += DUTY_WORDS) {
        if (kept > 0 && compare_duties(duty->data + i, duty->data + kept - DUTY_WORDS) == 0)
            continue;
        memmove(duty->data + kept, duty->data + i, DUTY_WORDS * sizeof *duty->data);
        kept += DUTY_WORDS;
    }
    return tn_rests_number(r, &r->duties, duty->data, kept, number, error);
}

/* Both. */
static tn_status join_duties(tn_rests *r, uint32_t a, uint32_t b, uint32_t *both, tn_error *error)
{
    tn_key key = {0};
    size_t size;
    *both = a == 0 || a == b ? b : a;
    if (a == 0 || b == 0 || a == b)
        return TN_OK;
    const uint32_t *words = tn_interned(&r->duties, a, &size);
    bool ok = tn_key_copy(&key, words, size);
    words = tn_interned(&r->duties, b, &size);
    for (size_t i = 0; ok && i < size; i++)
        ok = tn_key_push(&key, words[i]);
    tn_status status = ok ? number_duty(r, &key, both, error) : tn_fail_memory(error);
    free(key.data);
    return status;
}

static tn_status add_duty(tn_rests *r, uint32_t duty, uint32_t of, uint32_t state, uint32_t *both, tn_error *error)
{
    const uint32_t words[DUTY_WORDS] = {of, state};
    uint32_t one;
    tn_status status = tn_rests_number(r, &r->duties, words, DUTY_WORDS, &one, error);
    return status == TN_OK ? join_duties(r, duty, one, both, error) : status;
}

/* What is left of a duty behind a letter; *dead: nothing that goes on with it does it. */
static tn_status read_duty(tn_rests *r, uint32_t duty, uint32_t letter, uint32_t *next, bool *dead, tn_error *error)
{
    size_t size;
    const uint32_t *words = tn_interned(&r->duties, duty, &size);
    tn_key key = {0};
    bool ok = true;
    *dead = false;
    *next = 0;
    for (size_t i = 0; ok && !*dead && i < size; i += DUTY_WORDS) {
        if (words[i] == DUTY_TIED) {
            *dead = true;
            break;
        }
        const tn_operand *of = &r->facts[words[i]].of;
        uint32_t state = tn_dfa_read(of->dfa, words[i + 1], letter);
        *dead = state == of->dead;
        if (!*dead && state != of->everything)
            ok = tn_key_push(&key, words[i]) && tn_key_push(&key, state);
    }
    tn_status status = !ok ? tn_fail_memory(error) : *dead ? TN_OK : number_duty(r, &key, next, error);
    free(key.data);
    return status;
}

static bool duty_done(const tn_rests *r, uint32_t duty)
{
    size_t size;
    const uint32_t *words = tn_interned(&r->duties, duty, &size);
    bool done = true;
    for (size_t i = 0; done && i < size; i += DUTY_WORDS)
        done = words[i] == DUTY_TIED || r->facts[words[i]].dfa->accept[words[i + 1]];
    return done;
}

/* ---- what a stack begins with */

/* Puts a prefix on a stack. */
static tn_status push_prefix(tn_rests *r, uint32_t prefix, uint32_t stack, uint32_t *out, tn_error *error)
{
    size_t size;
    tn_interned(&r->prefixes, prefix, &size);
    tn_status status = TN_OK;
    *out = stack;
    for (size_t i = size; status == TN_OK && i-- > 0;)
        status = tn_rests_push(r, tn_interned(&r->prefixes, prefix, &size)[i], *out, out, error);
    return status;
}

/* Opens the symbol on top, if it is not a fact or a pair that begins already, as a whole stack. */
static tn_status open_stack(tn_rests *r, uint32_t stack, uint32_t duty, uint32_t ahead, bool start, const mpz_t ways,
                            configs *to, tn_error *error)
{
    uint32_t below = 0;
    tn_status status = TN_OK;
    symbol top = {0};
    while (status == TN_OK && stack != 0 && (top = top_of(r, stack, &below)).kind == SYMBOL_TIED) {
        status = add_duty(r, duty, DUTY_TIED, 0, &duty, error);
        stack = below;
    }
    if (status != TN_OK || stack == 0)
        return status == TN_OK ? add_config(to, stack, duty, ways, error) : status;
    const tn_rest_list *list = NULL;
    status = tn_rests_open(r, top, ahead, start, &list, error);
    mpz_t all;
    mpz_init(all);
    for (uint32_t i = 0; status == TN_OK && i < list->count; i++) {
        uint32_t whole;
        status = push_prefix(r, list->rests[i], below, &whole, error);
        if (status != TN_OK || r->stack_least[whole] > r->longest)
            continue;
        mpz_mul(all, ways, list->ways[i]);
        status = add_config(to, whole, duty, all, error);
    }
    mpz_clear(all);
    return status;
}

/* ---- letters */

static tn_status read_stack(tn_rests *r, uint32_t stack, uint32_t letter, uint32_t ahead, configs *to, tn_error *error);

static tn_status read_fact(tn_rests *r, const symbol *top, uint32_t below, uint32_t letter, uint32_t ahead, configs *to,
                           tn_error *error)
{
    const tn_operand *of = &r->facts[top->of].of;
    uint32_t state = tn_dfa_read(of->dfa, top->side, letter), stack, number, duty = 0;
    tn_status status = TN_OK;
    mpz_t one;
    if (state == of->dead)
        return TN_OK;
    mpz_init_set_ui(one, 1);
    if (r->facts[top->of].least[state] < NEVER) {
        status = tn_rests_symbol(r, (symbol){SYMBOL_FACT, top->of, state, 0, 0}, &number, error);
        if (status == TN_OK)
            status = tn_rests_push(r, number, below, &stack, error);
        if (status == TN_OK)
            status = add_config(to, stack, 0, one, error);
    }
    uint32_t ended = tn_operand_mark(of, state);
    if (status == TN_OK && ended != of->dead && ended != of->everything)
        status = add_duty(r, 0, top->of, ended, &duty, error);
    if (status == TN_OK && ended != of->dead)
        status = open_stack(r, below, duty, ahead, false, one, to, error);
    mpz_clear(one);
    return status;
}

/* Both stacks of a pair, which end together. */
static tn_status join_pair(tn_rests *r, const config *a, const config *b, uint32_t below, uint32_t ahead, configs *to,
                           tn_error *error)
{
    uint32_t duty, number, stack;
    if ((a->stack == 0) != (b->stack == 0))
        return TN_OK;
    mpz_t ways;
    mpz_init(ways);
    mpz_mul(ways, a->ways, b->ways);
    tn_status status = join_duties(r, a->duty, b->duty, &duty, error);
    if (status == TN_OK && a->stack == 0) {
        status = open_stack(r, below, duty, ahead, false, ways, to, error);
    } else if (status == TN_OK) {
        status = tn_rests_symbol(r, (symbol){SYMBOL_PAIR, a->stack, b->stack, 0, 0}, &number, error);
        if (status == TN_OK)
            status = tn_rests_push(r, number, below, &stack, error);
        if (status == TN_OK)
            status = add_config(to, stack, duty, ways, error);
    }
    mpz_clear(ways);
    return status;
}

static tn_status read_pair(tn_rests *r, const symbol *top, uint32_t below, uint32_t letter, uint32_t ahead, configs *to,
                           tn_error *error)
{
    configs first = {0}, second = {0};
    tn_status status = read_stack(r, top->of, letter, ahead, &first, error);
    if (status == TN_OK)
        status = read_stack(r, top->side, letter, ahead, &second, error);
    for (size_t i = 0; status == TN_OK && i < first.count; i++)
        for (size_t k = 0; status == TN_OK && k < second.count; k++)
            status = join_pair(r, &first.items[i], &second.items[k], below, ahead, to, error);
    clear_configs(&first);
    clear_configs(&second);
    return status;
}

static tn_status read_stack(tn_rests *r, uint32_t stack, uint32_t letter, uint32_t ahead, configs *to, tn_error *error)
{
    uint32_t below;
    if (stack == 0) /* nothing is to be derived any more */
        return TN_OK;
    symbol top = top_of(r, stack, &below);
    return (top.kind == SYMBOL_PAIR ? read_pair : read_fact)(r, &top, below, letter, ahead, to, error);
}

/* Rests of what was found, with what was to come already. */
static tn_status make_list(tn_rests *r, const configs *found, uint32_t duty, tn_rest_list *list, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < found->count; i++) {
        uint32_t words[2] = {found->items[i].stack, 0}, rest;
        status = join_duties(r, duty, found->items[i].duty, &words[1], error);
        if (status == TN_OK && r->stack_least[words[0]] <= r->longest)
            status = tn_rests_number(r, &r->rests, words, 2, &rest, error);
        else
            continue;
        if (status == TN_OK)
            status = tn_rest_list_add(list, rest, found->items[i].ways, error);
    }
    return status;
}

/* As many ways as newer trays lead from state to state. */
static tn_status read_projected(const tn_rests *r, uint32_t rest, uint32_t letter, tn_rest_list *list, tn_error *error)
{
    const tn_sparse *plans = r->projected->plans;
    size_t size;
    const uint32_t *pairs = tn_interned(&r->projected->above, r->projected->above_of[letter], &size);
    tn_status status = TN_OK;
    mpz_t ways;
    mpz_init(ways);
    for (size_t e = plans->first[rest]; status == TN_OK && e < plans->first[rest + 1]; e++) {
        size_t i = 0;
        while (i < size && pairs[i] != plans->label[e])
            i += 2;
        mpz_set_ui(ways, i < size ? pairs[i + 1] : 0);
        if (i < size)
            status = tn_rest_list_add(list, plans->target[e], ways, error);
    }
    mpz_clear(ways);
    return status;
}

static tn_status read_rest(tn_rests *r, uint32_t rest, uint32_t letter, uint32_t ahead, tn_rest_list *list,
                           tn_error *error)
{
    size_t size;
    if (r->projected)
        return read_projected(r, rest, letter, list, error);
    const uint32_t *words = tn_interned(&r->rests, rest, &size);
    uint32_t stack = words[0], duty = words[1], left;
    bool dead;
    configs found = {0};
    tn_status status = read_duty(r, duty, letter, &left, &dead, error);
    if (status == TN_OK && !dead)
        status = read_stack(r, stack, letter, ahead, &found, error);
    if (status == TN_OK)
        status = make_list(r, &found, left, list, error);
    clear_configs(&found);
    return status;
}

tn_status tn_rests_read(tn_rests *r, uint32_t rest, uint32_t letter, uint32_t ahead, const tn_rest_list **list,
                        tn_error *error)
{
    const uint32_t words[] = {rest, letter, ahead};
    uint32_t step;
    tn_status status = tn_rests_number(r, &r->steps, words, 3, &step, error);
    if (status != TN_OK)
        return status;
    if (step == r->read_count) {
        if (!tn_array_reserve(&r->read, &r->read_room, step, 1, sizeof *r->read))
            return tn_fail_memory(error);
        r->read[step] = calloc(1, sizeof(tn_rest_list));
        r->read_count++;
        status = r->read[step] ? read_rest(r, rest, letter, ahead, r->read[step], error) : tn_fail_memory(error);
    }
    *list = r->read[step];
    return status;
}

static tn_status begin_projected(tn_rests *r, const tn_rest_list **list, tn_error *error)
{
    mpz_t one;
    mpz_init_set_ui(one, 1);
    tn_rest_list_clear(&r->begin);
    tn_status status = r->projected->plans->states > 0 ? tn_rest_list_add(&r->begin, 0, one, error) : TN_OK;
    mpz_clear(one);
    *list = &r->begin;
    return status;
}

tn_status tn_rests_begin(tn_rests *r, const tn_rest_list **list, tn_error *error)
{
    if (r->projected)
        return begin_projected(r, list, error);
    uint32_t root = r->derivation->rules[r->derivation->root].first, number, stack;
    configs found = {0};
    mpz_t one;
    mpz_init_set_ui(one, 1);
    tn_rest_list_clear(&r->begin);
    tn_status status = tn_rests_symbol(r, (symbol){SYMBOL_NODE, root, TN_SIDE_WRITTEN, 0, 0}, &number, error);
    if (status == TN_OK)
        status = tn_rests_push(r, number, 0, &stack, error);
    if (status == TN_OK)
        status = open_stack(r, stack, 0, TN_AHEAD_START, true, one, &found, error);
    if (status == TN_OK)
        status = make_list(r, &found, 0, &r->begin, error);
    clear_configs(&found);
    mpz_clear(one);
    *list = &r->begin;
    return status;
}

tn_status tn_rests_ahead(tn_rests *r, uint32_t ahead, uint32_t letter, uint32_t *next, tn_error *error)
{
    tn_key key = {0};
    size_t size;
    bool ok = true;
    *next = TN_AHEAD_START;
    if (r->projected)
        return TN_OK;
    for (uint32_t f = 0; ok && f < r->fact_count; f++)
        if (r->facts[f].ahead != UINT32_MAX)
            ok = tn_key_push(
                &key, tn_dfa_read(r->facts[f].dfa, tn_interned(&r->aheads, ahead, &size)[r->facts[f].ahead], letter));
    tn_status status = ok ? tn_rests_number(r, &r->aheads, key.data, key.size, next, error) : tn_fail_memory(error);
    free(key.data);
    return status;
}

uint32_t tn_rests_least(const tn_rests *r, uint32_t rest)
{
    size_t size;
    if (r->projected)
        return 0;
    return r->stack_least[tn_interned(&r->rests, rest, &size)[0]];
}

bool tn_rests_end(const tn_rests *r, uint32_t rest)
{
    size_t size;
    if (r->projected)
        return r->projected->plans->accept[rest];
    const uint32_t *words = tn_interned(&r->rests, rest, &size);
    return words[0] == 0 && duty_done(r, words[1]);
}

/* ---- made and freed */

/* The empty stack, no duty, and the plan's beginning have the number 0. */
static tn_status make_zeros(tn_rests *r, tn_error *error)
{
    uint32_t number;
    tn_key key = {0};
    bool ok = true;
    for (uint32_t f = 0; ok && f < r->ahead_count; f++)
        ok = tn_key_push(&key, 0);
    tn_status status = ok ? tn_rests_number(r, &r->aheads, key.data, key.size, &number, error) : tn_fail_memory(error);
    free(key.data);
    if (status == TN_OK)
        status = tn_rests_number(r, &r->stacks, NULL, 0, &number, error);
    if (status == TN_OK)
        status = tn_rests_number(r, &r->duties, NULL, 0, &number, error);
    if (status == TN_OK && !tn_array_reserve(&r->stack_least, &r->stack_least_room, 0, 1, sizeof *r->stack_least))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        r->stack_least[0] = 0;
    return status;
}

tn_status tn_rests_new(const tn_derivation *derivation, tn_lowering *lowering, uint32_t longest, tn_rests **out,
                       tn_error *error)
{
    tn_rests *r = calloc(1, sizeof *r);
    if (!r)
        return tn_fail_memory(error);
    r->derivation = derivation;
    r->longest = longest;
    for (uint32_t n = 0; n < derivation->node_count; n++)
        r->tied |= derivation->nodes[n].beginning || derivation->nodes[n].end;
    tn_status status = tn_rests_facts(r, lowering, error);
    if (status == TN_OK)
        status = tn_rests_corners(r, error);
    if (status == TN_OK)
        status = make_zeros(r, error);
    if (status != TN_OK) {
        tn_rests_free(r);
        return status;
    }
    *out = r;
    return TN_OK;
}

tn_status tn_rests_projected(const tn_projected *projected, uint32_t longest, tn_rests **out, tn_error *error)
{
    tn_rests *r = calloc(1, sizeof *r);
    if (!r)
        return tn_fail_memory(error);
    r->projected = projected;
    r->longest = longest;
    *out = r;
    return TN_OK;
}

static void free_lists(tn_rests *r)
{
    for (uint32_t i = 0; i < r->opened_count; i++)
        if (r->opened[i]) {
            tn_rest_list_clear(&r->opened[i]->list);
            free(r->opened[i]);
        }
    for (uint32_t i = 0; i < r->read_count; i++)
        if (r->read[i]) {
            tn_rest_list_clear(r->read[i]);
            free(r->read[i]);
        }
    tn_rest_list_clear(&r->begin);
    free(r->opened);
    free(r->read);
}

void tn_rests_free(tn_rests *r)
{
    if (!r)
        return;
    for (uint32_t f = 0; f < r->fact_count; f++) {
        tn_operand_clear(&r->facts[f].of);
        tn_dfa_free(r->facts[f].dfa);
        free(r->facts[f].least);
    }
    for (uint32_t i = 0; r->rules && i < r->derivation->rule_count * TN_SIDES; i++)
        free(r->rules[i].corners);
    free_lists(r);
    tn_interner_clear(&r->symbols);
    tn_interner_clear(&r->prefixes);
    tn_interner_clear(&r->stacks);
    tn_interner_clear(&r->duties);
    tn_interner_clear(&r->aheads);
    tn_interner_clear(&r->rests);
    tn_interner_clear(&r->asked);
    tn_interner_clear(&r->steps);
    free(r->stack_least);
    free(r->fact_of);
    free(r->facts);
    free(r->least);
    free(r->rules);
    free(r->behind);
    free(r);
}
