/* The grammar of .field files (docs/field-language.md): a list of statements, each headed by a word, or one expression.
 * Line ends mean nothing. After an error the parser goes on at the next word that heads a statement. */
%require "3.8"
%define api.pure full
%define api.prefix {tn_field_}
%define api.token.prefix {TN_FIELD_T_}
%define api.location.type {tn_span}
%define parse.error custom
%define parse.lac full
%locations
%expect 0

%code requires {
#include "compiler/field/field.h"
}

%parse-param {tn_parsing *parse} {void *scanner}
%lex-param {void *scanner}

%code {
#include "field_lexer.h"

#define YYLLOC_DEFAULT(CURRENT, RHS, N)                                                                                \
    ((CURRENT) = (N) ? tn_span_join(YYRHSLOC(RHS, 1), YYRHSLOC(RHS, N))                                                \
                     : (tn_span){YYRHSLOC(RHS, 0).file, YYRHSLOC(RHS, 0).end, YYRHSLOC(RHS, 0).end})

int tn_field_lex(TN_FIELD_STYPE *value, tn_span *span, void *scanner);
static void tn_field_error(const tn_span *span, tn_parsing *parse, void *scanner, const char *message);
static tn_expression *of_two(tn_parsing *parse, tn_opcode op, tn_span span, tn_expression *a, tn_expression *b);
static tn_expression *mesh(tn_parsing *parse, tn_span span, tn_field_text name, tn_field_text path);
static tn_expression *call(tn_parsing *parse, tn_span span, const char *name, tn_span name_span, tn_expression *arguments);
}

%union {
    tn_decimal number;
    tn_field_text text;
    tn_field_parameters parameters;
    tn_expression *expression;
}

%token END_OF_FILE 0 "the end of the file"
%token <number> NUMBER "a number"
%token <text> STRING "a text in quotes" NAME "a name"
%token USE "`use`" LET "`let`" FN "`fn`" SURFACE "`surface`" BOX "`box`" GRID "`grid`" UNIT "`unit`" AT "`at`"
%token COMMA "`,`" OPEN "`(`" CLOSE "`)`" EQUALS "`=`" PLUS "`+`" MINUS "`-`" STAR "`*`" SLASH "`/`" PERCENT "`%`" CARET "`^`"
%token TO_DOTS "`..`"
%left PLUS MINUS
%left STAR SLASH PERCENT CARET
%precedence SIGN
%precedence AT

%type <text> doc
%type <parameters> parameters
%type <expression> expression arguments

%%

file
    : statements
    | expression                            { tn_field_add_bare(parse, $1); }
    ;

statements
    : %empty
    | statements statement
    | statements error                      { parse->damaged = true; }
    ;

statement
    : use STRING                            { tn_field_add_use(parse, $2); }
    | let NAME doc EQUALS expression        { tn_field_define(parse, TN_FIELD_LET, @$, $2, $3.text, (tn_field_parameters){0}, $5); }
    | fn NAME OPEN parameters CLOSE doc EQUALS expression
                                            { tn_field_define(parse, TN_FIELD_FUNCTION, @$, $2, $6.text, $4, $8); }
    | surface NAME doc EQUALS expression    { tn_field_define(parse, TN_FIELD_SURFACE, @$, $2, $3.text, (tn_field_parameters){0}, $5); }
    | box OPEN arguments CLOSE TO_DOTS OPEN arguments CLOSE
                                            { tn_field_set(parse, (tn_field_setting){.kind = TN_FIELD_BOX, .span = @$, .corners = of_two(parse, TN_OPCODE_COUNT, @$, $3, $7)}); }
    | grid NUMBER                           { tn_field_set(parse, (tn_field_setting){.kind = TN_FIELD_GRID, .span = @$, .number = $2}); }
    | unit NAME                             { tn_field_set(parse, (tn_field_setting){.kind = TN_FIELD_UNIT, .span = @$, .word = $2}); }
    ;

use: USE                                    { yyerrok; };
let: LET                                    { yyerrok; };
fn: FN                                      { yyerrok; };
surface: SURFACE                            { yyerrok; };
box: BOX                                    { yyerrok; };
grid: GRID                                  { yyerrok; };
unit: UNIT                                  { yyerrok; };

doc
    : %empty                                { $$ = (tn_field_text){0}; }
    | STRING
    ;

parameters
    : NAME                                  { $$ = tn_field_parameter_add(parse, (tn_field_parameters){0}, $1); }
    | parameters COMMA NAME                 { $$ = tn_field_parameter_add(parse, $1, $3); }
    ;

expression
    : NUMBER                                { $$ = tn_expression_number(parse->arena, @$, $1.value); }
    | NAME                                  { $$ = tn_expression_name(parse->arena, @$, $1.text); }
    | NAME OPEN arguments CLOSE             { $$ = call(parse, @$, $1.text, @1, $3); }
    | NAME OPEN STRING CLOSE                { $$ = mesh(parse, @$, $1, $3); }
    | OPEN expression CLOSE                 { $$ = $2; }
    | expression AT OPEN arguments CLOSE    { $$ = call(parse, @$, TN_FIELD_AT_NAME, @2, $4); tn_expression_add($$, $1); }
    | expression PLUS expression            { $$ = of_two(parse, TN_OP_ADD, @$, $1, $3); }
    | expression MINUS expression           { $$ = of_two(parse, TN_OP_SUBTRACT, @$, $1, $3); }
    | expression STAR expression            { $$ = of_two(parse, TN_OP_MULTIPLY, @$, $1, $3); }
    | expression SLASH expression           { $$ = of_two(parse, TN_OP_DIVIDE, @$, $1, $3); }
    | expression PERCENT expression         { $$ = of_two(parse, TN_OP_MODULO, @$, $1, $3); }
    | expression CARET expression           { $$ = of_two(parse, TN_OP_POWER, @$, $1, $3); }
    | MINUS expression %prec SIGN           { $$ = of_two(parse, TN_OP_NEGATE, @$, $2, NULL); }
    ;

arguments
    : expression                            { $$ = tn_expression_call(parse->arena, @$, NULL, $1); }
    | arguments COMMA expression            { $$ = $1; tn_expression_add($$, $3); }
    ;

%%

static tn_expression *of_two(tn_parsing *parse, tn_opcode op, tn_span span, tn_expression *a, tn_expression *b)
{
    return tn_expression_of(parse->arena, op, span, a, b, NULL);
}

/* `distance("hull.obj")`: what it is of is its name. */
static tn_expression *mesh(tn_parsing *parse, tn_span span, tn_field_text name, tn_field_text path)
{
    if (strcmp(name.text ? name.text : "", "distance") != 0) {
        tn_diagnostic *d = tn_report(parse->diagnostics, E_UNEXPECTED, path.span, "only `distance` takes a text");
        tn_help(parse->diagnostics, d, "write `distance(\"hull.obj\")`");
        parse->damaged = true;
    }
    tn_expression *e = tn_expression_name(parse->arena, span, path.text);
    if (e) {
        e->op = TN_OP_MESH_DISTANCE;
        e->name_span = path.span;
    }
    return e;
}

static tn_expression *call(tn_parsing *parse, tn_span span, const char *name, tn_span name_span, tn_expression *arguments)
{
    (void)parse;
    if (arguments) {
        arguments->name = name;
        arguments->name_span = name_span;
        arguments->span = span;
    }
    return arguments;
}

static bool one_of(const yysymbol_kind_t *kinds, int count, yysymbol_kind_t kind)
{
    for (int i = 0; i < count; i++)
        if (kinds[i] == kind)
            return true;
    return false;
}

static const char *likely_fix(yysymbol_kind_t found, yysymbol_kind_t before, const yysymbol_kind_t *expected, int count)
{
    if (one_of(expected, count, YYSYMBOL_EQUALS) && found == YYSYMBOL_OPEN)
        return "only a function has parameters: write `fn ring(a, b) = sqrt(a*a + b*b)`";
    switch (before) {
    case YYSYMBOL_USE: return "a path stands in double quotes, as in `use \"shapes\"`";
    case YYSYMBOL_LET: return "write `let radius = 2.5`";
    case YYSYMBOL_FN: return "write `fn ball(x, y, z, r) = sqrt(x*x + y*y + z*z) - r`";
    case YYSYMBOL_SURFACE: return "write `surface ball = x*x + y*y + z*z - 1`";
    case YYSYMBOL_BOX: return "write `box (-7, -7, -7)..(7, 7, 7)`";
    case YYSYMBOL_GRID: return "write how many samples the longest side of the box has: `grid 100`";
    case YYSYMBOL_UNIT: return "write `unit mm`; there are mm, cm, m, in and ft";
    case YYSYMBOL_AT: return "write the new coordinates: `ball at (x - 5, y, z)`";
    case YYSYMBOL_EQUALS:
    case YYSYMBOL_PLUS:
    case YYSYMBOL_MINUS:
    case YYSYMBOL_STAR:
    case YYSYMBOL_SLASH:
    case YYSYMBOL_PERCENT:
    case YYSYMBOL_COMMA:
    case YYSYMBOL_OPEN: return "the expression goes on here with a number, a name, `(` or `-`";
    default: break;
    }
    if (found == YYSYMBOL_EQUALS)
        return "a name is given a meaning by `let`, `fn` or `surface`";
    if (found == YYSYMBOL_YYEOF || found == YYSYMBOL_USE || found == YYSYMBOL_LET || found == YYSYMBOL_FN || found == YYSYMBOL_SURFACE ||
        found == YYSYMBOL_BOX || found == YYSYMBOL_GRID || found == YYSYMBOL_UNIT)
        return "the statement before this does not end here; see whether all its parentheses are closed";
    if (one_of(expected, count, YYSYMBOL_TO_DOTS))
        return "`..` stands between the two corners of a box: `box (-7, -7, -7)..(7, 7, 7)`";
    if ((found == YYSYMBOL_NUMBER || found == YYSYMBOL_NAME) && one_of(expected, count, YYSYMBOL_COMMA))
        return "between two arguments there is a comma, between two values an operator: `+`, `-`, `*`, `/` or `%`";
    if (found == YYSYMBOL_NUMBER || found == YYSYMBOL_NAME || found == YYSYMBOL_OPEN)
        return "between two values there is an operator: `+`, `-`, `*`, `/` or `%`";
    return "a statement starts with `use`, `let`, `fn`, `surface`, `box`, `grid` or `unit`";
}

static int yyreport_syntax_error(const yypcontext_t *context, tn_parsing *parse, void *scanner)
{
    (void)scanner;
    enum { MOST = 64 };
    yysymbol_kind_t kinds[MOST], found = yypcontext_token(context);
    const char *expected[MOST];
    int count = yypcontext_expected_tokens(context, kinds, MOST);
    if (count < 0)
        return count;
    for (int i = 0; i < count; i++)
        expected[i] = yysymbol_name(kinds[i]);
    tn_parsing_syntax_error(parse, *yypcontext_location(context), found == YYSYMBOL_YYEMPTY ? "this" : yysymbol_name(found), expected,
                           (size_t)count, likely_fix(found, YYTRANSLATE(parse->token_before), kinds, count));
    return 0;
}

static void tn_field_error(const tn_span *span, tn_parsing *parse, void *scanner, const char *message)
{
    (void)scanner;
    (void)message;
    tn_report(parse->diagnostics, E_TOO_DEEP, *span, "the file cannot be read further");
}

tn_field_file *tn_parse_field(tn_arena *arena, tn_diagnostics *diagnostics, uint32_t file, tn_tokens *tokens)
{
    tn_field_file *result = TN_NEW(arena, tn_field_file);
    const tn_source *source = &diagnostics->sources->files[file];
    tn_parsing parse = {.arena = arena, .diagnostics = diagnostics, .text = source->text, .size = source->size, .file = file, .result = result, .tokens = tokens};
    if (!result)
        return NULL;
    if (!tn_parsing_is_text(&parse)) {
        result->damaged = true;
        return result;
    }
    void *scanner = tn_field_lexer_new(&parse);
    if (!scanner)
        return NULL;
    int outcome = tn_field_parse(&parse, scanner);
    tn_field_lexer_free(scanner);
    result->damaged = parse.damaged || outcome != 0;
    return tn_arena_failed(arena) ? NULL : result; /* deeper than the parser goes: has been said */
}
