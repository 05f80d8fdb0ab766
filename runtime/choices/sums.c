/* Goes through the fields of a sum in their order, as deep as there are fields. */
#include "runtime/choices/sums.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/automata/numbering.h"
#include "runtime/base/array.h"

enum { LIMB_HALVES = (GMP_NUMB_BITS + 31) / 32 };

typedef struct both_sets {
    tn_choice_set yes, no;
} both_sets;

static const both_sets all_yes = {TN_CHOICE_ALL, TN_CHOICE_NONE}, all_no = {TN_CHOICE_NONE, TN_CHOICE_ALL},
                       neither = {TN_CHOICE_NONE, TN_CHOICE_NONE}, lost = {TN_CHOICE_LOST, TN_CHOICE_LOST};

/* A field of the sum, when those before it have their values. */
typedef struct sum_level {
    uint32_t field;
    mpz_t sum;       /* of the terms whose fields have all come */
    mpz_t low, high; /* what the others may add to it */
    bool risky;      /* one of the others may have no number */
} sum_level;

typedef struct sum_walk {
    tn_choice_diagram *choices;
    const tn_choice_term *terms;
    size_t term_count;
    unsigned signs;
    size_t steps;      /* that may still be taken */
    sum_level *levels; /* [level_count + 1] */
    uint32_t level_count;
    uint32_t *values; /* by field */
    tn_interner met;  /* a level, what terms still need, the sum */
    both_sets *found; /* of each */
    size_t capacity;
    tn_key key;
    mpz_t end;
    bool longer;
} sum_walk;

static uint32_t last_field(const tn_choice_term *term)
{
    return term->fields[term->field_count - 1];
}

/* Is the term's last field this one or a later one? */
static bool is_open(const tn_choice_term *term, uint32_t field)
{
    return term->field_count > 0 && last_field(term) >= field;
}

/* Where the number of the term is, for the values that its fields have. */
static size_t place_of(const sum_walk *walk, const tn_choice_term *term)
{
    size_t place = 0;
    for (uint32_t i = 0; i < term->field_count; i++)
        place = place * tn_choices_values(walk->choices, term->fields[i]) + walk->values[term->fields[i]];
    return place;
}

/* Does a term that ends with the field `from` or a later one depend on the field? */
static bool is_needed(const sum_walk *walk, uint32_t field, uint32_t from)
{
    for (size_t t = 0; t < walk->term_count; t++) {
        const tn_choice_term *term = &walk->terms[t];
        for (uint32_t i = 0; is_open(term, from) && i < term->field_count; i++)
            if (term->fields[i] == field)
                return true;
    }
    return false;
}

static bool push_sum(tn_key *key, const mpz_t sum)
{
    bool good = tn_key_push(key, (uint32_t)(mpz_sgn(sum) + 1));
    for (size_t i = 0; good && i < mpz_size(sum); i++) {
        mp_limb_t limb = mpz_getlimbn(sum, (mp_size_t)i);
        for (int half = 0; good && half < LIMB_HALVES; half++)
            good = tn_key_push(key, (uint32_t)((uint64_t)limb >> 32 * half));
    }
    return good;
}

/* The number of where the walk is; UINT32_MAX: out of memory. */
static uint32_t number_of(sum_walk *walk, uint32_t level)
{
    uint32_t field = walk->levels[level].field;
    walk->key.size = 0;
    bool good = tn_key_push(&walk->key, level);
    for (uint32_t l = 0; good && l < level; l++)
        if (is_needed(walk, walk->levels[l].field, field))
            good = tn_key_push(&walk->key, walk->values[walk->levels[l].field]);
    good = good && push_sum(&walk->key, walk->levels[level].sum);
    return good ? tn_intern(&walk->met, walk->key.data, walk->key.size) : UINT32_MAX;
}

static unsigned sign_bit(int sign)
{
    return sign < 0 ? TN_CHOICE_BELOW : sign > 0 ? TN_CHOICE_ABOVE : TN_CHOICE_ZERO;
}

/* Is it decided whatever comes? */
static bool is_decided(sum_walk *walk, uint32_t l, both_sets *sets)
{
    sum_level *level = &walk->levels[l];
    if (level->risky)
        return false;
    mpz_add(walk->end, level->sum, level->low);
    int least = mpz_sgn(walk->end);
    mpz_add(walk->end, level->sum, level->high);
    int most = mpz_sgn(walk->end);
    unsigned may = sign_bit(least) | sign_bit(most) | (least < 0 && most > 0 ? TN_CHOICE_ZERO : 0u);
    *sets = may & walk->signs ? all_yes : all_no;
    return !(may & walk->signs) || !(may & ~walk->signs);
}

static both_sets follow(sum_walk *walk, uint32_t level);

/* The field of the level has its value: adds the terms that are complete by that. */
static both_sets follow_value(sum_walk *walk, uint32_t l)
{
    sum_level *level = &walk->levels[l];
    mpz_set(level[1].sum, level->sum);
    tn_choice_outcome worst = TN_CHOICE_SAYS;
    for (size_t t = 0; t < walk->term_count; t++) {
        const tn_choice_term *term = &walk->terms[t];
        if (term->field_count == 0 || last_field(term) != level->field)
            continue;
        size_t place = place_of(walk, term);
        worst = term->outcomes[place] > worst ? term->outcomes[place] : worst;
        mpz_add(level[1].sum, level[1].sum, term->values[place]);
    }
    if (worst != TN_CHOICE_SAYS)
        return worst == TN_CHOICE_SILENT ? all_no : neither;
    return follow(walk, l + 1);
}

static both_sets follow_values(sum_walk *walk, uint32_t l)
{
    tn_choice_set yes[TN_CHOICE_VALUES_MAX], no[TN_CHOICE_VALUES_MAX];
    uint32_t field = walk->levels[l].field, count = tn_choices_values(walk->choices, field);
    if (walk->steps < count)
        walk->longer = true;
    if (walk->longer)
        return lost;
    walk->steps -= count;
    for (uint32_t v = 0; v < count; v++) {
        walk->values[field] = v;
        both_sets next = follow_value(walk, l);
        yes[v] = next.yes;
        no[v] = next.no;
        if (next.yes == TN_CHOICE_LOST || next.no == TN_CHOICE_LOST)
            return lost;
    }
    return (both_sets){tn_choices_node(walk->choices, field, yes), tn_choices_node(walk->choices, field, no)};
}

static both_sets follow(sum_walk *walk, uint32_t level)
{
    both_sets sets;
    if (is_decided(walk, level, &sets))
        return sets;
    uint32_t before = walk->met.count, number = number_of(walk, level);
    if (number == UINT32_MAX)
        return lost;
    if (number < before)
        return walk->found[number];
    if (!tn_array_reserve(&walk->found, &walk->capacity, number, 1, sizeof *walk->found))
        return lost;
    sets = follow_values(walk, level);
    walk->found[number] = sets;
    return sets;
}

/* ---- before the walk */

/* The least and the greatest number of a term. */
static void add_range(sum_level *level, const tn_choice_term *term)
{
    size_t least = term->count, most = term->count;
    for (size_t i = 0; i < term->count; i++) {
        level->risky |= term->outcomes[i] != TN_CHOICE_SAYS;
        if (least == term->count || mpz_cmp(term->values[i], term->values[least]) < 0)
            least = i;
        if (most == term->count || mpz_cmp(term->values[i], term->values[most]) > 0)
            most = i;
    }
    if (term->count == 0)
        return;
    mpz_add(level->low, level->low, term->values[least]);
    mpz_add(level->high, level->high, term->values[most]);
}

static bool begin(sum_walk *walk, uint32_t fields)
{
    walk->levels = calloc(fields + 1u, sizeof *walk->levels);
    walk->values = calloc(fields + 1u, sizeof *walk->values);
    if (!walk->levels || !walk->values) {
        free(walk->levels);
        walk->levels = NULL;
        return false;
    }
    for (uint32_t f = 0; f < fields; f++)
        if (is_needed(walk, f, 0))
            walk->levels[walk->level_count++].field = f;
    walk->levels[walk->level_count].field = fields;
    for (uint32_t l = 0; l <= walk->level_count; l++) {
        sum_level *level = &walk->levels[l];
        mpz_inits(level->sum, level->low, level->high, NULL);
        for (size_t t = 0; t < walk->term_count; t++)
            if (is_open(&walk->terms[t], level->field))
                add_range(level, &walk->terms[t]);
    }
    for (size_t t = 0; t < walk->term_count; t++)
        if (walk->terms[t].field_count == 0)
            mpz_add(walk->levels[0].sum, walk->levels[0].sum, walk->terms[t].values[0]);
    return true;
}

static void clear(sum_walk *walk)
{
    for (uint32_t l = 0; walk->levels && l <= walk->level_count; l++)
        mpz_clears(walk->levels[l].sum, walk->levels[l].low, walk->levels[l].high, NULL);
    free(walk->levels);
    free(walk->values);
    free(walk->found);
    free(walk->key.data);
    tn_interner_clear(&walk->met);
    mpz_clear(walk->end);
}

void tn_choices_by_sum(tn_choice_diagram *choices, const tn_choice_term *terms, size_t term_count, unsigned signs,
                       size_t steps, tn_choice_set *yes, tn_choice_set *no, bool *longer)
{
    sum_walk walk = {.choices = choices, .terms = terms, .term_count = term_count, .signs = signs, .steps = steps};
    tn_choice_outcome constant = TN_CHOICE_SAYS;
    for (size_t t = 0; t < term_count; t++)
        if (terms[t].field_count == 0 && terms[t].outcomes[0] > constant)
            constant = terms[t].outcomes[0];
    mpz_init(walk.end);
    both_sets sets = constant == TN_CHOICE_SILENT ? all_no : neither;
    if (constant == TN_CHOICE_SAYS)
        sets = begin(&walk, tn_choices_fields(choices)) ? follow(&walk, 0) : lost;
    *yes = sets.yes;
    *no = sets.no;
    *longer = walk.longer;
    clear(&walk);
}
