/* What the parser of .bnf files builds: rules of alternatives of items, each with its byte range.
 *
 * Everything lives in the compilation's arena. The constructors are called by the grammar's actions, one each; where
 * memory runs out they return NULL (or what they were given), which the arena remembers.
 */
#ifndef TARTAN_COMPILER_BNF_AST_H
#define TARTAN_COMPILER_BNF_AST_H

#include "compiler/common/arena.h"
#include "compiler/common/diagnostic.h"
#include "compiler/common/layout.h"
#include "compiler/common/lexical.h"
#include "compiler/common/token.h"
#include "runtime/module/module.h"

/* A token's text, in the source. */
typedef struct tn_bnf_text {
    const char *text;
    size_t length;
} tn_bnf_text;

typedef enum tn_bnf_kind {
    TN_BNF_PLAIN,    /* text as written; ge: its escapes not yet read */
    TN_BNF_QUOTED,   /* without its quotes */
    TN_BNF_NEWLINE,  /* ge: a line end between two pieces, with the blanks around it */
    TN_BNF_TERMINAL, /* made of the three above: what is written to the sentence */
    TN_BNF_NAME,     /* with its angle brackets */
    TN_BNF_EDGE,
    TN_BNF_EDGE_SAME, /* letter: 0 to 2 */
    TN_BNF_REPEAT,    /* body */
    TN_BNF_MAYBE,     /* body */
} tn_bnf_kind;

typedef struct tn_bnf_items {
    struct tn_bnf_item *first, *last;
} tn_bnf_items;

typedef struct tn_bnf_item {
    tn_bnf_kind kind;
    uint32_t letter;
    uint32_t rule;   /* NAME: index of its rule, once found */
    uint32_t groups; /* REPEAT, MAYBE: how deep it nests, itself counted */
    tn_span span;
    tn_bnf_text text;
    tn_bnf_items body;
    struct tn_bnf_item *next;
} tn_bnf_item;

typedef struct tn_bnf_alternative {
    tn_span span;
    tn_bnf_items items;
    bool beside_comment; /* ge: a comment ends an alternative, so that an empty one beside it is no mistake */
    struct tn_bnf_alternative *next;
} tn_bnf_alternative;

typedef struct tn_bnf_alternatives {
    tn_bnf_alternative *first, *last;
    size_t count;
} tn_bnf_alternatives;

typedef struct tn_bnf_rule {
    tn_bnf_text name; /* with its angle brackets */
    tn_span name_span;
    tn_span span;
    tn_bnf_alternatives alternatives;
    bool broken; /* not readable: reported */
    struct tn_bnf_rule *next;
} tn_bnf_rule;

#define TN_BNF_DATA 3u /* numbers of a data set that GE_RANGE can name */

/* The directives that say them, in the same order. */
extern const char *const tn_bnf_data_directives[TN_BNF_DATA];

typedef struct tn_bnf_file {
    tn_dialect dialect;
    bool says_dialect;
    tn_repair repair;
    tn_span repair_span;
    bool says_repair;
    bool skip_single;
    bool position_independent;
    tn_span mapping_span; /* what says it */
    bool says_max_depth, says_wraps;
    uint32_t max_depth, wraps;
    uint32_t data[TN_BNF_DATA]; /* 0: not known */
    tn_bnf_rule *first, *last;
    size_t rule_count;
} tn_bnf_file;

/* What lexer and parser share. */
typedef struct tn_bnf_reader {
    tn_arena *arena;
    tn_diagnostics *diagnostics;
    uint32_t file;
    uint32_t at; /* where the next token starts */
    bool genr8;
    bool prelude_reported, failed;
    tn_tokens *tokens; /* where the lexer leaves what it read, or NULL: a rule's name is a NAME, its ::= a SIGN */
    tn_bnf_file ast;
    tn_lexer_pool pool;
} tn_bnf_reader;

/* Parses a text, `size` bytes followed by two zero bytes, which the lexer writes to while it works but leaves as they
 * were. What is wrong is in the diagnostics. */
void tn_bnf_read(tn_bnf_reader *reader, char *text, size_t size);

/* Where the text does not say its dialect but has braces or brackets that stand alone: takes the dialect that these are
 * probably of, and reports which. Before it is read. */
void tn_bnf_guess_dialect(tn_bnf_reader *reader, const char *text, size_t size);

/* Does the text start with the name of a directive? */
bool tn_bnf_names_directive(tn_bnf_text line);

/* ---- for the grammar */

bool tn_bnf_says_genr8(const char *line, size_t length);
void tn_bnf_note_head(tn_bnf_reader *reader, tn_span span, const char *text);
void tn_bnf_note_stray(tn_bnf_reader *reader, tn_span span, const char *text);
void tn_bnf_note_directive(tn_bnf_reader *reader, tn_span span, const char *text);
void tn_bnf_directive(tn_bnf_reader *reader, tn_span span, tn_bnf_text line);
void tn_bnf_stray(tn_bnf_reader *reader, tn_span span);
tn_bnf_item *tn_bnf_item_new(tn_bnf_reader *reader, tn_bnf_kind kind, tn_span span, tn_bnf_text text);
tn_bnf_item *tn_bnf_lone_quote(tn_bnf_reader *reader, tn_span span, tn_bnf_text text);

/* genr8: reports a token that begins with a quote and does not end with it, where it is read, so that laying out such a
 * file does not pair it with a quote of another line. */
void tn_bnf_open_quote(tn_bnf_reader *reader, tn_span span);
extern const char tn_bnf_token_help[];
tn_bnf_item *tn_bnf_group_new(tn_bnf_reader *reader, tn_bnf_kind kind, tn_span span, tn_bnf_items body);
tn_bnf_items tn_bnf_append(tn_bnf_items items, tn_bnf_item *item);
tn_bnf_alternative *tn_bnf_alternative_new(tn_bnf_reader *reader, tn_span span, tn_bnf_items items);
tn_bnf_alternatives tn_bnf_first(tn_bnf_alternative *alternative);
tn_bnf_alternatives tn_bnf_next(tn_bnf_alternatives list, tn_bnf_alternative *alternative, bool after_comment);
void tn_bnf_rule_new(tn_bnf_reader *reader, tn_span head_span, tn_bnf_text head, tn_span span,
                     tn_bnf_alternatives list);
void tn_bnf_rule_broken(tn_bnf_reader *reader, tn_span head_span, tn_bnf_text head);
void tn_bnf_unexpected(tn_bnf_reader *reader, tn_span span, const char *token);
void tn_bnf_memory_exhausted(tn_bnf_reader *reader, tn_span span, const char *message);

/* From the AST of a .bnf file to rules that can be emitted: terminals are made, names found, and what could not work is
 * reported. */

#define TN_BNF_PRODUCTIONS_MAX 1000000u /* alternatives of a grammar: what loading allows in one section */
#define TN_BNF_NONE UINT32_MAX

typedef struct tn_bnf_grammar {
    tn_bnf_reader *reader;
    tn_bnf_rule **rules; /* by index; the first is the start symbol */
    size_t rule_count;
    size_t production_count;
    uint32_t *names; /* hash table of rule indices */
    size_t names_size;
} tn_bnf_grammar;

/* Lists the rules that were read (compile.c). False if out of memory. */
bool tn_bnf_collect_rules(tn_bnf_grammar *grammar);

/* Makes every alternative's pieces into terminals and drops the empty ones (bnf_terminals.c). */
void tn_bnf_make_terminals(tn_bnf_grammar *grammar);

/* Finds the names; then which rules can end and which can be reached (bnf_check.c). */
void tn_bnf_check(tn_bnf_grammar *grammar);

/* Index of a rule by its name with brackets, or TN_BNF_NONE. */
uint32_t tn_bnf_find(const tn_bnf_grammar *grammar, tn_bnf_text name);

/* What formatting .bnf files needs besides laying them out. */

/* Lays out a .bnf file. */
void tn_format_bnf(tn_format *format);

/* Leaves out the white space around alternatives of the dialect ge; in genr8 there are no such texts. */
void tn_format_bnf_trim(const tn_source *source, tn_tokens *tokens);

/* A directive with one blank between its words. */
tn_format_spell tn_format_bnf_directive;

/* Do the two mean the same? Makes the terminals of both, so that they are of no use afterwards. False also where out of
 * memory, which the arena remembers. */
bool tn_format_bnf_same(tn_bnf_reader *one, tn_bnf_reader *other);

#endif
