/* The grammar of .study files (docs/growth.md): a list of statements, each headed by a word. Line ends mean nothing. After an
 * error the parser goes on at the next word that heads a statement. */
%require "3.8"
%define api.pure full
%define api.prefix {tn_study_}
%define api.token.prefix {TN_STUDY_T_}
%define api.location.type {tn_span}
%define parse.error custom
%define parse.lac full
%locations
%expect 0

%code requires {
#include "compiler/study/study.h"
}

%parse-param {tn_parsing *parse} {void *scanner}
%lex-param {void *scanner}

%code {
#include "study_lexer.h"

#define YYLLOC_DEFAULT(CURRENT, RHS, N)                                                                                \
    ((CURRENT) = (N) ? tn_span_join(YYRHSLOC(RHS, 1), YYRHSLOC(RHS, N))                                                \
                     : (tn_span){YYRHSLOC(RHS, 0).file, YYRHSLOC(RHS, 0).end, YYRHSLOC(RHS, 0).end})

int tn_study_lex(TN_STUDY_STYPE *value, tn_span *span, void *scanner);
static void tn_study_error(const tn_span *span, tn_parsing *parse, void *scanner, const char *message);
static tn_study_item *with_text(tn_parsing *parse, tn_study_kind kind, tn_span span, tn_study_text text);
static tn_study_item *with_number(tn_parsing *parse, tn_study_kind kind, tn_span span, tn_decimal number);
static tn_study_item *with_vectors(tn_parsing *parse, tn_study_kind kind, tn_span span, tn_study_vector a, tn_study_vector b);
static tn_study_item *with_which(tn_study_item *item, uint32_t which);
static tn_study_item *with_parts(tn_study_item *item, tn_study_part *parts, tn_span span);
static tn_study_item *with_expression(tn_study_item *item, tn_expression *expression);
static tn_expression *of_two(tn_parsing *parse, tn_opcode op, tn_span span, tn_expression *a, tn_expression *b);
static tn_study_vector vector(tn_span span, tn_decimal x, tn_decimal y, tn_decimal z);
static tn_study_vector same(tn_decimal n);
}

%union {
    tn_decimal number;
    tn_study_text text;
    tn_study_vector vector;
    tn_study_item *item;
    tn_study_part *part;
    tn_expression *expression;
    uint32_t which;
}

%token END_OF_FILE 0 "the end of the file"
%token <number> NUMBER "a number"
%token <text> STRING "a text in quotes" NAME "a name"
%token USE "`use`" TITLE "`title`" RULES "`rules`" STEPS "`steps`" SCALE "`scale`" START "`start`" START_LENGTH "`start-length`"
%token SEED "`seed`" BRANCH_ANGLE "`branch-angle`" BRANCH_LENGTH "`branch-length`" EDGE_LIMIT "`edge-limit`"
%token FIXED_CENTRE "`fixed-centre`" FIXED_PERIMETER "`fixed-perimeter`" FACING "`facing`" MIRROR "`mirror`"
%token GRAVITY "`gravity`" ATTRACTOR "`attractor`" REPELLER "`repeller`" BOUNDARY "`boundary`" FITNESS "`fitness`" REQUIRE "`require`" RAW "`raw`" SUN "`sun`" DISTANCE_TO "`distance-to`"
%token PLANE "`plane`" BOX "`box`" SPHERE "`sphere`" MESH "`mesh`"
%token AT "`at`" NORMAL "`normal`" FROM "`from`" TO "`to`" RADIUS "`radius`" STRENGTH "`strength`" EXPONENT "`exponent`"
%token INSIDE "`inside`" OUTSIDE "`outside`" SLIDE "`slide`" STOP "`stop`" SOFT "`soft`" TARGET "`target`" WEIGHT "`weight`"
%token COMMA "`,`" OPEN "`(`" CLOSE "`)`" EQUALS "`=`" PLUS "`+`" MINUS "`-`" STAR "`*`" SLASH "`/`"
%token BELOW "`<`" AT_MOST "`<=`" AT_LEAST "`>=`" ABOVE "`>`" UNEQUAL "`!=`" IN "`in`" TO_DOTS "`..`" AND "`and`" OR "`or`" NOT "`not`"
%left OR
%left AND
%precedence NOT
%nonassoc EQUALS BELOW AT_MOST AT_LEAST ABOVE UNEQUAL IN
%left PLUS MINUS
%left STAR SLASH
%precedence SIGN

%type <item> statement shape
%type <part> force_parts force_part boundary_parts boundary_part goal_parts goal_part
%type <vector> vector three
%type <expression> expression call
%type <which> force

%%

file
    : %empty
    | file statement                        { tn_study_add(parse, $2); }
    | file error                            { parse->damaged = true; }
    ;

statement
    : use STRING                            { $$ = with_text(parse, TN_STUDY_USE, @$, $2); }
    | title STRING                          { $$ = with_text(parse, TN_STUDY_TITLE, @$, $2); }
    | rules STRING                          { $$ = with_text(parse, TN_STUDY_RULES, @$, $2); }
    | steps NUMBER                          { $$ = with_number(parse, TN_STUDY_STEPS, @$, $2); }
    | scale NUMBER                          { $$ = with_vectors(parse, TN_STUDY_SCALE, @$, same($2), same($2)); }
    | scale vector                          { $$ = with_vectors(parse, TN_STUDY_SCALE, @$, $2, $2); }
    | start vector                          { $$ = with_vectors(parse, TN_STUDY_START, @$, $2, $2); }
    | start_length NUMBER                   { $$ = with_number(parse, TN_STUDY_START_LENGTH, @$, $2); }
    | seed NUMBER                           { $$ = with_number(parse, TN_STUDY_SEED, @$, $2); }
    | branch_angle NUMBER                   { $$ = with_number(parse, TN_STUDY_BRANCH_ANGLE, @$, $2); }
    | branch_length NUMBER                  { $$ = with_number(parse, TN_STUDY_BRANCH_LENGTH, @$, $2); }
    | edge_limit NUMBER                     { $$ = with_number(parse, TN_STUDY_EDGE_LIMIT, @$, $2); }
    | fixed_centre                          { $$ = tn_study_item_new(parse, TN_STUDY_SETS_FIXED_CENTRE, @$); }
    | fixed_perimeter                       { $$ = tn_study_item_new(parse, TN_STUDY_SETS_FIXED_PERIMETER, @$); }
    | facing                                { $$ = tn_study_item_new(parse, TN_STUDY_SETS_FACING, @$); }
    | mirror                                { $$ = tn_study_item_new(parse, TN_STUDY_SETS_MIRROR, @$); }
    | gravity vector                        { $$ = with_which(with_vectors(parse, TN_STUDY_FORCE, @$, $2, $2), TN_GRAVITY); }
    | force AT vector force_parts           { $$ = with_parts(with_which(with_vectors(parse, TN_STUDY_FORCE, @$, $3, $3), $1), $4, @$); }
    | boundary shape boundary_parts         { $$ = with_parts($2, $3, @$); }
    | fitness NAME goal_parts               { $$ = with_parts(with_text(parse, TN_STUDY_GOAL, @$, $2), $3, @$); }
    | fitness NAME EQUALS expression goal_parts
                                            { $$ = with_expression(with_parts(with_text(parse, TN_STUDY_GOAL, @$, $2), $5, @$), $4); }
    | require expression                    { $$ = with_expression(tn_study_item_new(parse, TN_STUDY_REQUIREMENT, @$), $2); }
    | sun vector                            { $$ = with_vectors(parse, TN_STUDY_SUN, @$, $2, $2); }
    | distance_to STRING                    { $$ = with_text(parse, TN_STUDY_DISTANCE_TO, @$, $2); }
    | fitness RAW                           { $$ = tn_study_item_new(parse, TN_STUDY_SETS_RAW, @$); }
    ;

use: USE                                    { yyerrok; };
title: TITLE                                { yyerrok; };
rules: RULES                                { yyerrok; };
steps: STEPS                                { yyerrok; };
scale: SCALE                                { yyerrok; };
start: START                                { yyerrok; };
start_length: START_LENGTH                  { yyerrok; };
seed: SEED                                  { yyerrok; };
branch_angle: BRANCH_ANGLE                  { yyerrok; };
branch_length: BRANCH_LENGTH                { yyerrok; };
edge_limit: EDGE_LIMIT                      { yyerrok; };
fixed_centre: FIXED_CENTRE                  { yyerrok; };
fixed_perimeter: FIXED_PERIMETER            { yyerrok; };
facing: FACING                              { yyerrok; };
mirror: MIRROR                              { yyerrok; };
gravity: GRAVITY                            { yyerrok; };
boundary: BOUNDARY                          { yyerrok; };
fitness: FITNESS                            { yyerrok; };
require: REQUIRE                            { yyerrok; };
sun: SUN                                    { yyerrok; };
distance_to: DISTANCE_TO                    { yyerrok; };
force
    : ATTRACTOR                             { yyerrok; $$ = TN_ATTRACTOR; }
    | REPELLER                              { yyerrok; $$ = TN_REPELLER; }
    ;

force_parts
    : %empty                                { $$ = NULL; }
    | force_parts force_part                { $2->next = $1; $$ = $2; }
    ;

force_part
    : STRENGTH NUMBER                       { $$ = tn_study_part_new(parse, TN_PART_STRENGTH, @$, $2.value, NULL); if (!$$) YYNOMEM; }
    | EXPONENT NUMBER                       { $$ = tn_study_part_new(parse, TN_PART_EXPONENT, @$, $2.value, NULL); if (!$$) YYNOMEM; }
    ;

shape
    : PLANE AT vector NORMAL vector         { $$ = with_which(with_vectors(parse, TN_STUDY_BOUNDARY, @$, $3, $5), TN_BOUNDARY_PLANE); }
    | BOX FROM vector TO vector             { $$ = with_which(with_vectors(parse, TN_STUDY_BOUNDARY, @$, $3, $5), TN_BOUNDARY_BOX); }
    | SPHERE AT vector RADIUS NUMBER        { $$ = with_which(with_vectors(parse, TN_STUDY_BOUNDARY, @$, $3, same($5)), TN_BOUNDARY_SPHERE); }
    | MESH STRING                           { $$ = with_which(with_text(parse, TN_STUDY_BOUNDARY, @$, $2), TN_BOUNDARY_MESH); }
    ;

boundary_parts
    : %empty                                { $$ = NULL; }
    | boundary_parts boundary_part          { $2->next = $1; $$ = $2; }
    ;

boundary_part
    : INSIDE                                { $$ = tn_study_part_new(parse, TN_PART_SIDE, @$, 1, NULL); if (!$$) YYNOMEM; }
    | OUTSIDE                               { $$ = tn_study_part_new(parse, TN_PART_SIDE, @$, 0, NULL); if (!$$) YYNOMEM; }
    | SLIDE                                 { $$ = tn_study_part_new(parse, TN_PART_MODE, @$, TN_SLIDE, NULL); if (!$$) YYNOMEM; }
    | STOP                                  { $$ = tn_study_part_new(parse, TN_PART_MODE, @$, TN_STOP, NULL); if (!$$) YYNOMEM; }
    | SOFT                                  { $$ = tn_study_part_new(parse, TN_PART_MODE, @$, TN_SOFT, NULL); if (!$$) YYNOMEM; }
    ;

goal_parts
    : %empty                                { $$ = NULL; }
    | goal_parts goal_part                  { $2->next = $1; $$ = $2; }
    ;

goal_part
    : TARGET NUMBER                         { $$ = tn_study_part_new(parse, TN_PART_TARGET, @$, $2.value, NULL); if (!$$) YYNOMEM; }
    | WEIGHT NUMBER                         { $$ = tn_study_part_new(parse, TN_PART_WEIGHT, @$, $2.value, NULL); if (!$$) YYNOMEM; }
    ;

expression
    : NUMBER                                { $$ = tn_expression_number(parse->arena, @$, $1.value); }
    | NAME                                  { $$ = tn_expression_name(parse->arena, @$, $1.text); }
    | call CLOSE                            { $$ = $1; if ($$) $$->span = @$; }
    | OPEN expression CLOSE                 { $$ = $2; }
    | expression PLUS expression            { $$ = of_two(parse, TN_OP_ADD, @$, $1, $3); }
    | expression MINUS expression           { $$ = of_two(parse, TN_OP_SUBTRACT, @$, $1, $3); }
    | expression STAR expression            { $$ = of_two(parse, TN_OP_MULTIPLY, @$, $1, $3); }
    | expression SLASH expression           { $$ = of_two(parse, TN_OP_DIVIDE, @$, $1, $3); }
    | MINUS expression %prec SIGN           { $$ = of_two(parse, TN_OP_NEGATE, @$, $2, NULL); }
    | expression BELOW expression           { $$ = of_two(parse, TN_OP_IS_BELOW, @$, $1, $3); }
    | expression AT_MOST expression         { $$ = of_two(parse, TN_OP_IS_AT_MOST, @$, $1, $3); }
    | expression EQUALS expression          { $$ = of_two(parse, TN_OP_IS_EQUAL, @$, $1, $3); }
    | expression UNEQUAL expression         { $$ = of_two(parse, TN_OP_IS_UNEQUAL, @$, $1, $3); }
    | expression AT_LEAST expression        { $$ = of_two(parse, TN_OP_IS_AT_LEAST, @$, $1, $3); }
    | expression ABOVE expression           { $$ = of_two(parse, TN_OP_IS_ABOVE, @$, $1, $3); }
    | expression IN expression TO_DOTS expression %prec IN
                                            { $$ = tn_expression_of(parse->arena, TN_OP_IS_BETWEEN, @$, $1, $3, $5); }
    | expression AND expression             { $$ = of_two(parse, TN_OP_IS_BOTH, @$, $1, $3); }
    | expression OR expression              { $$ = of_two(parse, TN_OP_IS_EITHER, @$, $1, $3); }
    | NOT expression                        { $$ = of_two(parse, TN_OP_IS_NOT, @$, $2, NULL); }
    ;

call
    : NAME OPEN expression                  { $$ = tn_expression_call(parse->arena, @1, $1.text, $3); }
    | call COMMA expression                 { $$ = $1; tn_expression_add($$, $3); }
    ;

vector
    : three
    | OPEN three CLOSE                      { $$ = $2; $$.span = @$; }
    ;

three
    : NUMBER NUMBER NUMBER                  { $$ = vector(@$, $1, $2, $3); }
    | NUMBER COMMA NUMBER COMMA NUMBER      { $$ = vector(@$, $1, $3, $5); }
    ;

%%

static tn_study_item *with_text(tn_parsing *parse, tn_study_kind kind, tn_span span, tn_study_text text)
{
    tn_study_item *item = tn_study_item_new(parse, kind, span);
    if (item) {
        item->text = text.text;
        item->text_span = text.span;
    }
    return item;
}

static tn_study_item *with_number(tn_parsing *parse, tn_study_kind kind, tn_span span, tn_decimal number)
{
    tn_study_item *item = tn_study_item_new(parse, kind, span);
    if (item)
        item->number = number;
    return item;
}

static tn_study_item *with_vectors(tn_parsing *parse, tn_study_kind kind, tn_span span, tn_study_vector a, tn_study_vector b)
{
    tn_study_item *item = tn_study_item_new(parse, kind, span);
    if (item) {
        item->a = a;
        item->b = b;
    }
    return item;
}

static tn_study_item *with_which(tn_study_item *item, uint32_t which)
{
    if (item)
        item->which = which;
    return item;
}

static tn_study_item *with_parts(tn_study_item *item, tn_study_part *parts, tn_span span)
{
    if (item) {
        item->parts = parts;
        item->span = span;
    }
    return item;
}

static tn_study_item *with_expression(tn_study_item *item, tn_expression *expression)
{
    if (item)
        item->expression = expression;
    return item;
}

static tn_expression *of_two(tn_parsing *parse, tn_opcode op, tn_span span, tn_expression *a, tn_expression *b)
{
    return tn_expression_of(parse->arena, op, span, a, b, NULL);
}

static tn_study_vector vector(tn_span span, tn_decimal x, tn_decimal y, tn_decimal z)
{
    return (tn_study_vector){x.value, y.value, z.value, span};
}

static tn_study_vector same(tn_decimal n)
{
    return (tn_study_vector){n.value, n.value, n.value, n.span};
}

static const char *likely_fix(const tn_parsing *parse, yysymbol_kind_t found, yysymbol_kind_t before,
                              yysymbol_kind_t first_expected)
{
    switch (before) {
    case YYSYMBOL_USE:
    case YYSYMBOL_RULES:
    case YYSYMBOL_MESH:
    case YYSYMBOL_TITLE: return "a text stands in double quotes, as in `rules \"square\"`";
    case YYSYMBOL_SUN: return "write the direction towards the sun: `sun 1 -1 2`";
    case YYSYMBOL_GRAVITY: return "gravity is a displacement in x, y and z: `gravity 0 0 -0.3`";
    case YYSYMBOL_ATTRACTOR:
    case YYSYMBOL_REPELLER: return "write `attractor at 4 4 3 strength 2`";
    case YYSYMBOL_BOUNDARY:
        return "a boundary is `plane at 0 0 0 normal 0 0 1`, `box from 0 0 0 to 1 1 1`, `sphere at 0 0 0 radius 2` or `mesh \"hull.stl\"`";
    case YYSYMBOL_FITNESS: return "write `fitness size target 10 weight 2`";
    case YYSYMBOL_REQUIRE: return "write a condition, as `require crossings = 0`";
    case YYSYMBOL_EQUALS: return "write an expression of terms, as `fitness slope = undulation / size target 0.5`";
    case YYSYMBOL_PLUS:
    case YYSYMBOL_MINUS:
    case YYSYMBOL_STAR:
    case YYSYMBOL_SLASH:
    case YYSYMBOL_BELOW:
    case YYSYMBOL_AT_MOST:
    case YYSYMBOL_AT_LEAST:
    case YYSYMBOL_ABOVE:
    case YYSYMBOL_UNEQUAL:
    case YYSYMBOL_IN:
    case YYSYMBOL_TO_DOTS:
    case YYSYMBOL_AND:
    case YYSYMBOL_OR:
    case YYSYMBOL_NOT: return "the expression goes on here with a number, a name, `(`, `-` or `not`";
    default: break;
    }
    if (found == YYSYMBOL_BELOW || found == YYSYMBOL_AT_MOST || found == YYSYMBOL_AT_LEAST || found == YYSYMBOL_ABOVE ||
        found == YYSYMBOL_UNEQUAL || found == YYSYMBOL_IN)
        return "two comparisons are joined by `and`; what lies between two bounds is `size in 2..3`";
    if (found == YYSYMBOL_TO_DOTS)
        return "a range stands behind `in`: `size in 2..3`";
    if (found == YYSYMBOL_EQUALS)
        return "an expression is of `fitness`: `fitness slope = undulation / size target 0.5`";
    if (first_expected == YYSYMBOL_RADIUS || (first_expected == YYSYMBOL_NUMBER && before == YYSYMBOL_RADIUS))
        return "write `sphere at 0 0 0 radius 2`";
    if (first_expected == YYSYMBOL_NUMBER && before == YYSYMBOL_NUMBER)
        return "three numbers stand here: x, y and z";
    if (first_expected == YYSYMBOL_NUMBER)
        return "a number stands here, or three for a place";
    if (found == YYSYMBOL_NAME && parse->evolves)
        return "this is a setting of an evolution: it goes between the braces of `evolution { ... }`, in a study of its own";
    if (found == YYSYMBOL_NAME)
        return "this is no word of studies; see the list in docs/growth.md";
    if (found == YYSYMBOL_NUMBER && before == YYSYMBOL_NAME)
        return "between a name and a number stands a word or a sign: `size target 3`, `size <= 3`";
    if (found == YYSYMBOL_NUMBER)
        return "a place has three numbers: x, y and z";
    return "a statement starts with a word such as `rules`, `steps`, `scale`, `attractor`, `boundary`, `fitness` or `require`";
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
                           (size_t)count, likely_fix(parse, found, YYTRANSLATE(parse->token_before), count == 1 || count == 2 ? kinds[0] : YYSYMBOL_YYEMPTY));
    return 0;
}

static void tn_study_error(const tn_span *span, tn_parsing *parse, void *scanner, const char *message)
{
    (void)scanner;
    (void)message;
    tn_report(parse->diagnostics, E_TOO_DEEP, *span, "the file cannot be read further");
}

tn_study_file *tn_parse_study(tn_arena *arena, tn_diagnostics *diagnostics, uint32_t file, tn_tokens *tokens)
{
    tn_study_file *result = TN_NEW(arena, tn_study_file);
    const tn_source *source = &diagnostics->sources->files[file];
    tn_parsing parse = {.arena = arena, .diagnostics = diagnostics, .text = source->text, .size = source->size, .file = file, .result = result, .tokens = tokens};
    if (!result)
        return NULL;
    if (!tn_parsing_is_text(&parse)) {
        result->damaged = true;
        return result;
    }
    void *scanner = tn_study_lexer_new(&parse);
    if (!scanner)
        return NULL;
    int outcome = tn_study_parse(&parse, scanner);
    tn_study_lexer_free(scanner);
    result->damaged = parse.damaged || outcome != 0;
    return tn_arena_failed(arena) ? NULL : result; /* deeper than the parser goes: has been said */
}
