/* The grammar of HEMLS files: a seed, rewrite rules and settings, a line each ("Genr8", Fig. 4, as docs/growth.md reads it).
 *
 * Permissive on purpose: a line is a row of symbols, and compiler/hemls/check.c says what is wrong with it. After an
 * error the parser goes on with the next line.
 */
%require "3.8"
%define api.pure full
%define api.prefix {tn_hemls_}
%define api.token.prefix {TN_HEMLS_T_}
%define api.location.type {tn_span}
%define parse.error custom
%define parse.lac full
%locations
%expect 0

%code requires {
#include "compiler/hemls/hemls.h"
}

%parse-param {tn_parsing *parse} {void *scanner}
%lex-param {void *scanner}

%code {
#include "hemls_lexer.h"

#define YYLLOC_DEFAULT(CURRENT, RHS, N)                                                                                \
    ((CURRENT) = (N) ? tn_span_join(YYRHSLOC(RHS, 1), YYRHSLOC(RHS, N))                                                \
                     : (tn_span){YYRHSLOC(RHS, 0).file, YYRHSLOC(RHS, 0).end, YYRHSLOC(RHS, 0).end})

int tn_hemls_lex(TN_HEMLS_STYPE *value, tn_span *span, void *scanner);
static void tn_hemls_error(const tn_span *span, tn_parsing *parse, void *scanner, const char *message);
static tn_hemls_choice weight(tn_span span, tn_decimal number);
static tn_hemls_choice condition(tn_span span, tn_comparison comparison, double bound);
static void add_symbols(tn_parsing *parse, tn_span span, tn_hemls_symbols symbols, tn_hemls_alternatives alternatives);
static void add_setting(tn_parsing *parse, tn_hemls_line_kind kind, tn_span span, double number);
}

%union {
    tn_hemls_symbol *symbol;
    tn_hemls_symbols symbols;
    tn_hemls_alternative *alternative;
    tn_hemls_alternatives alternatives;
    tn_hemls_choice choice;
    tn_comparison comparison;
    tn_decimal number;
    double value;
}

%token END_OF_FILE 0 "the end of the file"
%token <symbol> EDGE "an edge" PLUS "`+`" MINUS "`-`" OTHER_TURN "a turn" TILDE "`~`" OPEN "`[`" CLOSE "`]`"
%token <symbol> LESS "`<`" GREATER "`>`"
%token <number> NUMBER "a number"
%token ARROW "`->`" END_OF_LINE "the end of the line" EQUAL "`=`"
%token ANGLE "`Angle`" BRANCH_ANGLE "`BranchAngle`" SYNC "`Sync`" EVEN "`Even`" WEIGHT "`Weight`" IF "`If`" AGE "`i`"

%type <symbol> symbol
%type <symbols> symbols
%type <alternative> alternative
%type <alternatives> alternatives
%type <choice> choice
%type <comparison> comparison
%type <value> bound

%%

file
    : lines
    | lines line
    | lines error                           { parse->damaged = true; }
    ;

lines
    : %empty
    | lines END_OF_LINE
    | lines line END_OF_LINE
    | lines error END_OF_LINE               { parse->damaged = true; yyerrok; }
    ;

line
    : symbols                               { add_symbols(parse, @$, $1, (tn_hemls_alternatives){0}); }
    | symbols alternatives                  { add_symbols(parse, @$, $1, $2); }
    | ANGLE NUMBER                          { add_setting(parse, TN_HEMLS_ANGLE, @$, $2.value); }
    | BRANCH_ANGLE NUMBER                   { add_setting(parse, TN_HEMLS_BRANCH_ANGLE, @$, $2.value); }
    | SYNC                                  { add_setting(parse, TN_HEMLS_SYNC, @$, 0); }
    | EVEN                                  { add_setting(parse, TN_HEMLS_EVEN, @$, 0); }
    ;

alternatives
    : alternative                           { $$ = tn_hemls_alternatives_add((tn_hemls_alternatives){0}, $1); }
    | alternatives alternative              { $$ = tn_hemls_alternatives_add($1, $2); }
    ;

alternative
    : ARROW symbols choice                  { $$ = tn_hemls_alternative_new(parse, @$, $2, $3); }
    ;

choice
    : %empty                                { $$ = (tn_hemls_choice){.value = 1, .span = @$}; }
    | WEIGHT NUMBER                         { $$ = weight(@$, $2); }
    | IF AGE comparison bound               { $$ = condition(@$, $3, $4); }
    ;

comparison
    : LESS                                  { $$ = TN_AGE_BELOW; }
    | GREATER                               { $$ = TN_AGE_ABOVE; }
    | EQUAL                                 { $$ = TN_AGE_EQUALS; }
    ;

bound
    : NUMBER                                { $$ = $1.value; }
    | MINUS NUMBER                          { $$ = -$2.value; }
    ;

symbols
    : symbol                                { $$ = tn_hemls_symbols_add((tn_hemls_symbols){0}, $1); }
    | symbols symbol                        { $$ = tn_hemls_symbols_add($1, $2); }
    ;

symbol: EDGE | PLUS | MINUS | OTHER_TURN | TILDE | OPEN | CLOSE | LESS | GREATER;

%%

static tn_hemls_choice weight(tn_span span, tn_decimal number)
{
    return (tn_hemls_choice){.weighted = true, .value = number.value, .span = span};
}

static tn_hemls_choice condition(tn_span span, tn_comparison comparison, double bound)
{
    return (tn_hemls_choice){.comparison = comparison, .value = bound, .span = span};
}

static void add_symbols(tn_parsing *parse, tn_span span, tn_hemls_symbols symbols, tn_hemls_alternatives alternatives)
{
    tn_hemls_line *line = tn_hemls_line_new(parse, alternatives.first ? TN_HEMLS_RULE : TN_HEMLS_AXIOM, span);
    if (!line)
        return;
    line->symbols = symbols;
    line->alternatives = alternatives;
    tn_hemls_add_line(parse, line);
}

static void add_setting(tn_parsing *parse, tn_hemls_line_kind kind, tn_span span, double number)
{
    tn_hemls_line *line = tn_hemls_line_new(parse, kind, span);
    if (!line)
        return;
    line->number = number;
    tn_hemls_add_line(parse, line);
}

static const char *likely_fix(yysymbol_kind_t found, yysymbol_kind_t before)
{
    if (before == YYSYMBOL_ARROW)
        return "a rule is written `A -> A [ + B ] A`: a successor draws at least one edge";
    if (before == YYSYMBOL_WEIGHT)
        return "a weight is a number: `-> A A Weight 3`";
    if (before == YYSYMBOL_IF || before == YYSYMBOL_AGE)
        return "a condition compares the age: `If i < 3`";
    if (found == YYSYMBOL_EQUAL && before == YYSYMBOL_EDGE)
        return "what replaces an edge stands after `->`: `A -> A A`";
    if (found == YYSYMBOL_EQUAL)
        return "a condition compares the age with `<`, `>` or `=`: `If i < 3`";
    if (before == YYSYMBOL_ANGLE || before == YYSYMBOL_BRANCH_ANGLE)
        return "an angle is a number of degrees: `Angle 90`";
    if (found == YYSYMBOL_NUMBER && (before == YYSYMBOL_PLUS || before == YYSYMBOL_MINUS))
        return "an age changes by one at most: `_i`, `_i+1` and `_i-1`";
    if (found == YYSYMBOL_NUMBER)
        return "numbers stand after Angle, BranchAngle, Weight and `If i <`";
    if (found == YYSYMBOL_ANGLE || found == YYSYMBOL_BRANCH_ANGLE || found == YYSYMBOL_SYNC)
        return "write it on a line of its own";
    if (found == YYSYMBOL_ARROW)
        return "before `->` stands the edge that is replaced: `A -> A A`";
    return "a line is a seed (`A + B + A`), a rule (`A -> A A`), or one of Angle, BranchAngle, Sync and Even";
}

static int yyreport_syntax_error(const yypcontext_t *context, tn_parsing *parse, void *scanner)
{
    (void)scanner;
    enum { MOST = 32 };
    yysymbol_kind_t expected[MOST], token = yypcontext_token(context);
    const char *names[MOST];
    int count = yypcontext_expected_tokens(context, expected, MOST), used = 0;
    for (int i = 0; i < count; i++)
        if (expected[i] != YYSYMBOL_END_OF_LINE)
            names[used++] = yysymbol_name(expected[i]);
    const char *found = token == YYSYMBOL_YYEMPTY ? "this" : yysymbol_name(token);
    tn_parsing_syntax_error(parse, *yypcontext_location(context), found, names, (size_t)used,
                           likely_fix(token, YYTRANSLATE(parse->token_before)));
    return 0;
}

static void tn_hemls_error(const tn_span *span, tn_parsing *parse, void *scanner, const char *message)
{
    (void)scanner;
    tn_report(parse->diagnostics, E_TOO_DEEP, *span, "the file cannot be read further: %s", message);
}

tn_hemls_file *tn_parse_hemls(tn_arena *arena, tn_diagnostics *diagnostics, uint32_t file, tn_tokens *tokens)
{
    tn_hemls_file *result = TN_NEW(arena, tn_hemls_file);
    const tn_source *source = &diagnostics->sources->files[file];
    tn_parsing parse = {.arena = arena, .diagnostics = diagnostics, .text = source->text, .size = source->size, .file = file, .result = result, .tokens = tokens};
    if (!result)
        return NULL;
    if (!tn_parsing_is_text(&parse)) {
        result->damaged = true;
        return result;
    }
    void *scanner = tn_hemls_lexer_new(&parse);
    if (!scanner)
        return NULL;
    int outcome = tn_hemls_parse(&parse, scanner);
    tn_hemls_lexer_free(scanner);
    result->damaged = parse.damaged || outcome != 0;
    return outcome == 2 || tn_arena_failed(arena) ? NULL : result;
}
