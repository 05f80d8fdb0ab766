/* Syntax of .pcfg files: lines that are rules, each of alternatives of symbols, terminals and probabilities. */
%require "3.8"
%define api.pure full
%define api.prefix {tn_pcfg_}
%define parse.error custom
%define lr.default-reduction accepting
%define api.location.type {tn_span}
%locations
%expect 0
%parse-param { struct tn_pcfg_reader *reader } { void *scanner }
%lex-param { void *scanner }

%code requires {
#include "compiler/pcfg/ast.h"
}
%code {
#include "pcfg_lexer.h"

int tn_pcfg_lex(TN_PCFG_STYPE *value, tn_span *span, void *scanner);

/* Only where bison has no memory. */
static void tn_pcfg_error(tn_span *span, struct tn_pcfg_reader *reader, void *scanner, const char *message)
{
    (void)span;
    (void)scanner;
    (void)message;
    reader->failed = true;
}

#define YYLLOC_DEFAULT(CURRENT, RHS, COUNT)                                                                            \
    ((CURRENT) = (COUNT) ? tn_span_join(YYRHSLOC(RHS, 1), YYRHSLOC(RHS, COUNT))                                        \
                         : (tn_span){YYRHSLOC(RHS, 0).file, YYRHSLOC(RHS, 0).end, YYRHSLOC(RHS, 0).end})
}
%initial-action { @$ = (tn_span){reader->file, 0, 0}; }

%union {
    tn_pcfg_text text;
    tn_pcfg_alternative *alternative;
    tn_pcfg_alternatives alternatives;
}

%token <text> NAME "a symbol" TERMINAL "a terminal" PROBABILITY "a probability" STRAY "a stray character"
%token ARROW "->" BAR "|" LINE "the line's end"
%token END 0 "the end of the file"
%type <alternative> alternative
%type <alternatives> alternatives

%%

lines: line
    | lines LINE line
    ;

line: %empty
    | NAME ARROW alternatives           { tn_pcfg_rule_new(reader, @1, $1, @3, $3); }
    | error                             { yyerrok; reader->damaged = true; }
    ;

alternatives: alternative               { $$ = tn_pcfg_first($1); }
    | alternatives BAR alternative      { $$ = tn_pcfg_next($1, $3); }
    ;

alternative: %empty                     { $$ = tn_pcfg_alternative_new(reader, @$); }
    | alternative NAME                  { $$ = tn_pcfg_add(reader, $1, TN_PCFG_NAME, @2, $2); }
    | alternative TERMINAL              { $$ = tn_pcfg_add(reader, $1, TN_PCFG_TERMINAL, @2, $2); }
    | alternative PROBABILITY           { $$ = tn_pcfg_add_probability(reader, $1, @2, $2); }
    ;

%%

static int yyreport_syntax_error(const yypcontext_t *context, struct tn_pcfg_reader *reader, void *scanner)
{
    enum { EXPECTED = 8 };
    yysymbol_kind_t expected[EXPECTED];
    int count = yypcontext_expected_tokens(context, expected, EXPECTED);
    bool arrow = false;
    (void)scanner;
    for (int i = 0; i < count; i++)
        arrow |= expected[i] == YYSYMBOL_ARROW;
    tn_pcfg_unexpected(reader, *yypcontext_location(context), yysymbol_name(yypcontext_token(context)), arrow);
    return 0;
}

void tn_pcfg_read(tn_pcfg_reader *reader, char *text, size_t size)
{
    void *scanner;
    if (tn_pcfg_lex_init_extra(reader, &scanner) != 0) {
        reader->failed = true;
        return;
    }
    reader->text = text;
    if (!tn_pcfg__scan_buffer(text, size + 2, scanner))
        reader->failed = true;
    else if (tn_pcfg_parse(reader, scanner) != 0)
        reader->failed = true;
    tn_pcfg_lex_destroy(scanner);
}
