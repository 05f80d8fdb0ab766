/* A grammar as the mapper runs it: the productions' bytecode of a module, decoded once into 32-bit words.
 *
 * A grammar is immutable and may be shared between threads. It owns everything reached through it but borrows nothing:
 * the module may be freed first.
 */
#ifndef TARTAN_GRAMMAR_GRAMMAR_H
#define TARTAN_GRAMMAR_GRAMMAR_H

#include "runtime/module/module.h"

/* A word is its operation in the low three bits and an argument above them. */
typedef enum tn_word_op {
    TN_WORD_TERMINAL, /* argument: index of the terminal */
    TN_WORD_RULE,     /* index of the rule */
    TN_WORD_EDGE,     /* none */
    TN_WORD_SAME,     /* letter, 0 to 2 */
    TN_WORD_REPEAT,   /* number of words of the body and its AGAIN */
    TN_WORD_AGAIN,    /* none: ends the body of a REPEAT */
    TN_WORD_MAYBE,    /* number of words of the body */
    TN_WORD_DONE,     /* none: ends the production */
} tn_word_op;

#define TN_WORD_BITS 3u
#define TN_WORD_MAX (UINT32_MAX >> TN_WORD_BITS)
#define TN_WORD_OP(word) ((tn_word_op)((word) & ((1u << TN_WORD_BITS) - 1u)))
#define TN_WORD_ARGUMENT(word) ((word) >> TN_WORD_BITS)

typedef enum tn_terminal_kind { TN_TERMINAL_PLAIN, TN_TERMINAL_LESS, TN_TERMINAL_GREATER } tn_terminal_kind;

typedef struct tn_terminal {
    uint32_t offset; /* in the texts */
    uint32_t length;
    uint32_t kind; /* tn_terminal_kind: `<` and `>` part a predecessor's contexts */
} tn_terminal;

typedef struct tn_production {
    uint32_t words;    /* index of its first word */
    uint32_t rule;     /* that it is an alternative of */
    uint32_t children; /* its non-terminals, loops and options counted once */
    uint32_t symbols;  /* its words but the DONE */
    uint32_t begin, end, file;
} tn_production;

typedef struct tn_rule {
    uint32_t first;        /* production */
    uint32_t count;        /* of its productions, at least 1 */
    uint32_t closed_first; /* in the grammar's `closed`: the productions without non-terminals */
    uint32_t closed_count;
    uint64_t reciprocal; /* of `count`, for tn_codon_modulo */
    uint32_t mark;       /* tn_rule_mark */
    uint32_t name;       /* offset in the texts */
    uint32_t begin, end, file;
} tn_rule;

typedef enum tn_rule_mark { TN_MARK_NONE, TN_MARK_REWRITE_RULE, TN_MARK_PREDECESSOR } tn_rule_mark;

typedef struct tn_grammar {
    tn_dialect dialect;
    tn_repair repair;
    bool skip_single;
    bool position_independent; /* codons say which non-terminal is replaced next */
    uint32_t max_depth;        /* 0: no limit */
    uint32_t wraps;
    uint32_t rewrite_rule, predecessor, successor; /* rules, or TN_NO_RECORD */
    tn_rule *rules;                                /* the first is the start symbol */
    size_t rule_count;
    tn_production *productions;
    size_t production_count;
    uint32_t *closed; /* productions without non-terminals, by rule */
    uint32_t *words;
    size_t word_count;
    tn_terminal *terminals;
    size_t terminal_count;
    char *texts; /* readable for 16 bytes past any terminal */
    size_t texts_size;
    const char *name; /* in texts */
    uint64_t hash;    /* of the module */
} tn_grammar;

/* Decodes grammar `index` of a verified module. On success the caller owns *grammar. TN_INVALID if the module has
 * none; TN_LIMIT if it has more than TN_WORD_MAX words, rules or terminals. */
tn_status tn_grammar_new(const tn_module *module, size_t index, tn_grammar **grammar, tn_error *error);
void tn_grammar_free(tn_grammar *grammar);

/* Can its genomes be mapped independently of position? Groups and edge variables read codons within a production, and
 * a rule that reads none has no pair of them. */
static inline bool tn_grammar_takes_places(const tn_grammar *grammar)
{
    return grammar->dialect == TN_DIALECT_GE && !grammar->skip_single;
}

static inline const char *tn_rule_name(const tn_grammar *grammar, uint32_t rule)
{
    return grammar->texts + grammar->rules[rule].name;
}

/* codon mod divisor. Codons under 2^32, which nearly all are, need no division: Lemire, Kaser and Kurz, "Faster
 * remainder by direct computation" (2019), with reciprocal = ceil(2^64 / divisor), exact for 32-bit operands. */
static inline uint32_t tn_codon_modulo(uint64_t codon, uint32_t divisor, uint64_t reciprocal)
{
    if (codon >> 32)
        return (uint32_t)(codon % divisor);
    uint64_t fraction = reciprocal * codon;
    return (uint32_t)(((__extension__(unsigned __int128) fraction) * divisor) >> 64);
}

static inline uint64_t tn_reciprocal(uint32_t divisor)
{
    return UINT64_MAX / divisor + 1; /* 0 for a divisor of 1, whose remainder is always 0 */
}

#endif
