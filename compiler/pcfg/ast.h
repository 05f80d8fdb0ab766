/* What the parser of .pcfg files builds: rules of alternatives of symbols and terminals, each with its byte range.
 *
 * Everything lives in the compilation's arena. The constructors are called by the grammar's actions, one each; where
 * memory runs out they return NULL (or what they were given), which the arena remembers. */
#ifndef TARTAN_COMPILER_PCFG_AST_H
#define TARTAN_COMPILER_PCFG_AST_H

#include "compiler/common/arena.h"
#include "compiler/common/diagnostic.h"
#include "compiler/common/lexical.h"
#include "compiler/common/names.h"
#include "compiler/common/token.h"
#include "runtime/module/builder.h"
#include "runtime/place/model/rules.h"

/* A token's text, in the source. */
typedef struct tn_pcfg_text {
    const char *text;
    size_t length;
} tn_pcfg_text;

typedef enum tn_pcfg_kind { TN_PCFG_NAME, TN_PCFG_TERMINAL } tn_pcfg_kind;

typedef struct tn_pcfg_item {
    tn_pcfg_kind kind;
    tn_span span;
    tn_pcfg_text text; /* of a terminal: without its quotes */
    tn_step step;      /* what it does; of a name, EXPAND, once its rule is found */
    bool unknown;      /* a name without a rule, or a terminal that is none: reported */
    struct tn_pcfg_item *next;
} tn_pcfg_item;

/* Why a probability does not count. */
typedef enum tn_pcfg_lost {
    TN_PCFG_COUNTS,
    TN_PCFG_LATER,  /* its alternative has a later one */
    TN_PCFG_INSIDE, /* in its line's last alternative, and something follows it */
    TN_PCFG_BLANK,  /* the same, and that is a blank */
} tn_pcfg_lost;

/* One [.5]. */
typedef struct tn_pcfg_probability {
    double value;
    tn_span span;
    tn_pcfg_lost lost;
    struct tn_pcfg_probability *next;
} tn_pcfg_probability;

typedef struct tn_pcfg_alternative {
    tn_span span;
    tn_pcfg_item *first, *last;
    tn_pcfg_probability *first_probability, *last_probability;
    double probability; /* the one that counts, or 0 */
    uint32_t step_count;
    struct tn_pcfg_alternative *next;
} tn_pcfg_alternative;

typedef struct tn_pcfg_alternatives {
    tn_pcfg_alternative *first, *last;
} tn_pcfg_alternatives;

/* One line. */
typedef struct tn_pcfg_rule {
    tn_pcfg_text name;
    tn_span name_span;
    tn_pcfg_alternatives alternatives;
    struct tn_pcfg_rule *next;
} tn_pcfg_rule;

typedef struct tn_pcfg_file {
    tn_pcfg_rule *first, *last;
} tn_pcfg_file;

/* What lexer and parser share. */
typedef struct tn_pcfg_reader {
    tn_arena *arena;
    tn_diagnostics *diagnostics;
    const char *text;
    uint32_t file;
    uint32_t at;       /* where the next token starts */
    uint32_t line_end; /* of the line that was read last, without its line end */
    bool inside;       /* something other than a comment is on this line */
    bool damaged;      /* lines are missing: reported */
    bool failed;       /* out of memory */
    tn_tokens *tokens; /* where the lexer leaves what it read, or NULL */
    tn_pcfg_file ast;
    tn_lexer_pool pool;
} tn_pcfg_reader;

/* Parses a text, `size` bytes followed by two zero bytes, which the lexer writes to while it works but leaves as they
 * were. Its rules come after those that the reader has. What is wrong is in the diagnostics. */
void tn_pcfg_read(tn_pcfg_reader *reader, char *text, size_t size);

/* ---- for the grammar */

tn_pcfg_alternative *tn_pcfg_alternative_new(tn_pcfg_reader *reader, tn_span span);
tn_pcfg_alternative *tn_pcfg_add(tn_pcfg_reader *reader, tn_pcfg_alternative *alternative, tn_pcfg_kind kind,
                                 tn_span span, tn_pcfg_text text);
tn_pcfg_alternative *tn_pcfg_add_probability(tn_pcfg_reader *reader, tn_pcfg_alternative *alternative, tn_span span,
                                             tn_pcfg_text text);
tn_pcfg_alternatives tn_pcfg_first(tn_pcfg_alternative *alternative);
tn_pcfg_alternatives tn_pcfg_next(tn_pcfg_alternatives list, tn_pcfg_alternative *alternative);
void tn_pcfg_rule_new(tn_pcfg_reader *reader, tn_span name_span, tn_pcfg_text name, tn_span span,
                      tn_pcfg_alternatives list);

/* arrow: a `->` could have stood there. */
void tn_pcfg_unexpected(tn_pcfg_reader *reader, tn_span span, const char *token, bool arrow);

/* Reads what a terminal of a connection grammar says: 'Move(0,3,0)'. */

/* From the rules of one or several .pcfg files to symbols that can be emitted: lines of one symbol are put together,
 * names found, terminals and probabilities read; and warnings about what is probably wrong. */

typedef struct tn_pcfg_symbol {
    const char *name;
    tn_span span; /* of its first rule's name */
    tn_pcfg_alternatives alternatives;
    uint32_t count;   /* of these */
    uint32_t index;   /* among all symbols */
    uint32_t emitted; /* among those that are reached */
    bool drawn;       /* by probability */
    bool reached;     /* from the start symbol */
    bool nullable;    /* may come to nothing */
    bool visited;     /* a mark of the search at hand */
} tn_pcfg_symbol;

typedef struct tn_pcfg_grammar {
    tn_arena *arena;
    tn_diagnostics *diagnostics;
    tn_pcfg_symbol **symbols; /* in the order of their first rules; the first is the start symbol */
    uint32_t count;
    tn_names names;
    bool partial; /* other files may have the rules that this one lacks */
} tn_pcfg_grammar;

/* Puts the rules together and checks them. Out of memory is the arena's to remember. */
void tn_pcfg_check(tn_pcfg_grammar *grammar, const tn_pcfg_file *file);

/* Warns about what is allowed but probably wrong, in a grammar without errors. */
void tn_pcfg_warn(const tn_pcfg_grammar *grammar);

/* The symbol that an item names. */
static inline tn_pcfg_symbol *tn_pcfg_symbol_of(const tn_pcfg_grammar *grammar, const tn_pcfg_item *item)
{
    return grammar->symbols[item->step.index];
}

#endif
