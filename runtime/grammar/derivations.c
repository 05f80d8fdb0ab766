/* How many derivations a grammar has: by depth where that is finite, else by codons. */
#include <stdlib.h>

#include "runtime/grammar/analysis.h"

/* Numbers by rule: with `width` 1 those of the derivations of one depth; else polynomials, a coefficient for each
 * number of codons from 0 to width - 1. */
typedef struct counter {
    const tn_grammar *grammar;
    size_t width;
    mpz_t *now, *next;      /* [rule][width] */
    mpz_t *product, *spare; /* [width] */
    bool too_large, failed;
} counter;

static mpz_t *numbers_new(size_t count)
{
    mpz_t *numbers = malloc((count ? count : 1) * sizeof *numbers);
    for (size_t i = 0; numbers && i < count; i++)
        mpz_init(numbers[i]);
    return numbers;
}

static void numbers_free(mpz_t *numbers, size_t count)
{
    for (size_t i = 0; numbers && i < count; i++)
        mpz_clear(numbers[i]);
    free(numbers);
}

static void set_one(const counter *c, mpz_t *numbers)
{
    for (size_t i = 0; i < c->width; i++)
        mpz_set_ui(numbers[i], i == 0);
}

/* product *= factor, cut at the width. */
static void multiply(counter *c, mpz_t *product, mpz_t *factor)
{
    for (size_t i = 0; i < c->width; i++)
        mpz_set_ui(c->spare[i], 0);
    for (size_t i = 0; i < c->width; i++)
        for (size_t j = 0; mpz_sgn(product[i]) && i + j < c->width; j++)
            if (mpz_sgn(factor[j]))
                mpz_addmul(c->spare[i + j], product[i], factor[j]);
    for (size_t i = 0; i < c->width; i++) {
        mpz_swap(product[i], c->spare[i]);
        c->too_large |= mpz_sizeinbase(product[i], 2) > TN_DERIVATION_BITS;
    }
}

/* numbers *= x: one codon is read. By depth, codons do not count. */
static void read_codon(const counter *c, mpz_t *numbers)
{
    for (size_t i = c->width; c->width > 1 && i-- > 0;)
        if (i == 0)
            mpz_set_ui(numbers[0], 0);
        else
            mpz_set(numbers[i], numbers[i - 1]);
}

/* body -> x / (1 - x body), by the recurrence r = x + x body r: the loop `{ body }`. */
static void close_loop(counter *c, mpz_t *body)
{
    mpz_t *loop = numbers_new(c->width);
    if (!loop) {
        c->failed = true;
        return;
    }
    for (size_t round = 0; round < c->width; round++) {
        multiply(c, loop, body);
        mpz_add_ui(loop[0], loop[0], 1);
        read_codon(c, loop);
    }
    for (size_t i = 0; i < c->width; i++)
        mpz_swap(body[i], loop[i]);
    numbers_free(loop, c->width);
}

/* The numbers of words [at, end), into `product`. Groups nest at most TN_GROUP_DEPTH deep. */
static void count_words(counter *c, uint32_t at, uint32_t end, uint32_t *letters, mpz_t *product)
{
    const tn_grammar *g = c->grammar;
    set_one(c, product);
    while (at < end && !c->too_large && !c->failed) {
        uint32_t word = g->words[at], argument = TN_WORD_ARGUMENT(word);
        tn_word_op op = TN_WORD_OP(word);
        if (op == TN_WORD_RULE) {
            multiply(c, product, &c->now[argument * c->width]);
        } else if (op == TN_WORD_EDGE || (op == TN_WORD_SAME && !(*letters >> argument & 1))) {
            read_codon(c, product);
            *letters |= op == TN_WORD_SAME ? 1u << argument : 0;
        } else if (op == TN_WORD_REPEAT || op == TN_WORD_MAYBE) {
            mpz_t *body = numbers_new(c->width);
            if (!body) {
                c->failed = true;
                return;
            }
            count_words(c, at + 1, at + 1 + argument - (op == TN_WORD_REPEAT), letters, body);
            if (op == TN_WORD_REPEAT) {
                close_loop(c, body);
            } else {
                mpz_add_ui(body[0], body[0], 1);
                read_codon(c, body);
            }
            multiply(c, product, body);
            numbers_free(body, c->width);
            at += argument;
        }
        at++;
    }
}

static void count_rule(counter *c, uint32_t index, bool leaf_counts)
{
    const tn_rule *rule = &c->grammar->rules[index];
    mpz_t *sum = &c->next[index * c->width];
    for (size_t i = 0; i < c->width; i++)
        mpz_set_ui(sum[i], 0);
    for (uint32_t p = rule->first; p < rule->first + rule->count && !c->too_large; p++) {
        const tn_production *production = &c->grammar->productions[p];
        uint32_t letters = 0;
        if (!leaf_counts && production->symbols)
            continue;
        count_words(c, production->words, production->words + production->symbols, &letters, c->product);
        read_codon(c, c->product);
        for (size_t i = 0; i < c->width; i++)
            mpz_add(sum[i], sum[i], c->product[i]);
    }
}

tn_status tn_count_derivations(const tn_grammar *grammar, uint32_t depth, bool *by_codons, mpz_t total, tn_error *error)
{
    *by_codons = tn_grammar_has_loops(grammar);
    counter c = {.grammar = grammar, .width = *by_codons ? (size_t)depth + 1 : 1};
    size_t numbers = grammar->rule_count * c.width;
    c.now = numbers_new(numbers);
    c.next = numbers_new(numbers);
    c.product = numbers_new(c.width);
    c.spare = numbers_new(c.width);
    tn_status status = c.now && c.next && c.product && c.spare ? TN_OK : tn_fail_memory(error);
    /* at depth 1, a ge rule has no room for its terminals */
    for (uint32_t level = 1; status == TN_OK && level <= depth && !c.too_large; level++) {
        for (uint32_t r = 0; r < grammar->rule_count; r++)
            count_rule(&c, r, level > 1 || grammar->dialect == TN_DIALECT_GENR8);
        mpz_t *swap = c.now;
        c.now = c.next;
        c.next = swap;
    }
    if (status == TN_OK && c.failed)
        status = tn_fail_memory(error);
    else if (status == TN_OK && c.too_large)
        status = tn_fail(error, TN_LIMIT, E_TOO_MANY_DERIVATIONS,
                         "the number of derivations passes %u binary digits, the limit", TN_DERIVATION_BITS);
    if (status == TN_OK)
        mpz_set(total, c.now[c.width - 1]);
    numbers_free(c.now, numbers);
    numbers_free(c.next, numbers);
    numbers_free(c.product, c.width);
    numbers_free(c.spare, c.width);
    return status;
}
