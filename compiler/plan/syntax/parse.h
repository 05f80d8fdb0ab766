/* One run of a parser over one source: what the lexer, the grammar's actions and the constructors of the AST share.
 * Lives on the caller's stack; everything made goes into the arena. */
#ifndef TARTAN_COMPILER_PLAN_SYNTAX_PARSE_H
#define TARTAN_COMPILER_PLAN_SYNTAX_PARSE_H

#include "compiler/common/arena.h"
#include "compiler/common/diagnostic.h"
#include "compiler/common/lexical.h"
#include "compiler/common/token.h"

struct tn_ast_file;

/* What the words mean depends on where they stand: inside a schema, a tray specifier or a plan, the author's own names
 * count and the language keeps only a few words. */
typedef enum tn_lex_mode {
    TN_LEX_TOP,
    TN_LEX_SCHEMA,
    TN_LEX_TRAY,
    TN_LEX_LITERAL,
    TN_LEX_PATTERN,
    TN_LEX_TRAY_SUM,
    TN_LEX_FORM
} tn_lex_mode;

typedef struct tn_parse {
    tn_arena *arena;
    tn_diagnostics *diagnostics;
    const char *text; /* of the source */
    size_t size;
    uint32_t file;
    struct tn_ast_file *result;
    tn_tokens *tokens; /* where the lexer leaves what it read, or NULL */

    /* the lexer's */
    uint32_t offset;      /* of the next byte */
    uint32_t token_start; /* of a token that is read in pieces */
    int last_token, token_before;
    tn_span last_span, span_before; /* of those two */
    tn_lex_mode mode, outer_mode;   /* outer_mode: what the tray specifier or plan stands in */
    uint32_t parens;                /* open inside the tray specifier */
    bool schema_head;               /* a `schema` was read, and its { not yet */
    bool form_head;                 /* the same of `form` */
    bool of_library;                /* the schema whose head was read last is one `of` a library */
    bool test_head;                 /* of `test`: neither its `with` nor its { */
    bool library_head;              /* of `library` */
    bool in_form, in_tile;          /* inside the braces of one */
    bool in_symbol;                 /* and inside those of an item's symbol */
    bool in_braces;
    tn_span brace, tile_brace; /* the { that is open; that of the tile inside it */
    int held_token;            /* to be given out next; 0: none */
    tn_span held_span;
    bool virtual_brace; /* the last } was not written: it closes what the author forgot to */
    uint32_t stray_end; /* where the last stray character ended: a run of them is reported once */
    int quiet;          /* tokens to come whose being out of place follows from what was reported */
    bool quiet_now;     /* is the token at hand one of them? */

    int clause; /* the word that began the clause of a library at hand: `weight`, `prefer`; 0: another one, or none */
    bool apart; /* `at least` was read, and not its `from` */
    bool in_number;  /* inside a `number` of a schema: min and max are functions */
    bool in_limit;   /* inside an `only` or `forbid` of a schema: `any`, `and`, `or`, `not`, `implies` are words */
    bool in_tray;    /* inside `tray(...)`, not what is written likewise of cells */
    bool in_extreme; /* the sum over a tray that is read is one of `max(...)` or `min(...)` */
    uint32_t groups; /* in parentheses, in specifiers */
    bool too_deep;   /* nesting was reported */

    tn_lexer_pool pool;
} tn_parse;

/* Parses the source as one expression, one open plan, one plan in brackets, or the value of one param: see tn_ast_file.
 */
typedef enum tn_parse_what {
    TN_PARSE_FILE,
    TN_PARSE_EXPRESSION,
    TN_PARSE_PATTERN,
    TN_PARSE_LITERAL,
    TN_PARSE_SETTING
} tn_parse_what;
struct tn_ast_file *tn_parse_plan_part(tn_arena *arena, tn_diagnostics *diagnostics, uint32_t file, tn_parse_what what);

/* Parses the source as a .plan file. NULL where out of memory; errors are in the diagnostics. Its tokens go to `tokens`
 * where that is not NULL. */
struct tn_ast_file *tn_parse_plan(tn_arena *arena, tn_diagnostics *diagnostics, uint32_t file, tn_tokens *tokens);

#endif
