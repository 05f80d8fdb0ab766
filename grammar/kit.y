/* The grammar of .kit files (docs/kit-language.md): statements that end with `;`, and blocks in braces. After an error the parser
 * goes on at the next `;` or closing brace. */
%require "3.8"
%define api.pure full
%define api.prefix {tn_kit_}
%define api.token.prefix {TN_KIT_T_}
%define api.location.type {tn_span}
%define parse.error custom
%define parse.lac full
%locations
%expect 0

%code requires {
#include "compiler/kit/kit.h"
}

%parse-param {tn_parsing *parse} {void *scanner}
%lex-param {void *scanner}

%code {
#include "kit_lexer.h"

#define YYLLOC_DEFAULT(CURRENT, RHS, N)                                                                                \
    ((CURRENT) = (N) ? tn_span_join(YYRHSLOC(RHS, 1), YYRHSLOC(RHS, N))                                                \
                     : (tn_span){YYRHSLOC(RHS, 0).file, YYRHSLOC(RHS, 0).end, YYRHSLOC(RHS, 0).end})

int tn_kit_lex(TN_KIT_STYPE *value, tn_span *span, void *scanner);
static void tn_kit_error(const tn_span *span, tn_parsing *parse, void *scanner, const char *message);
static tn_kit_node *node(tn_parsing *parse, tn_kit_kind kind, tn_span span, tn_kit_text name, tn_kit_nodes inner);
static tn_kit_node *sized(tn_parsing *parse, tn_kit_kind kind, tn_span span, tn_kit_length a, tn_kit_length b, tn_kit_length c);
static tn_kit_node *counted(tn_parsing *parse, tn_kit_kind kind, tn_span span, tn_kit_text name, tn_kit_length count);
static tn_kit_node *filed(tn_parsing *parse, tn_span span, tn_kit_text name, tn_kit_text file, tn_kit_text up, tn_kit_nodes sizes);
static tn_kit_node *part_from(tn_parsing *parse, tn_span span, tn_kit_text name, tn_kit_text doc, tn_kit_text from, tn_kit_text what,
                              tn_kit_text file);
static tn_kit_text text_of(tn_parsing *parse, tn_kit_length number);
static tn_expression *number_of(tn_parsing *parse, tn_kit_length number);
static tn_expression *count_of(tn_parsing *parse, tn_span span, tn_kit_text part);
static tn_expression *of_two(tn_parsing *parse, tn_opcode op, tn_span span, tn_expression *a, tn_expression *b);
static const tn_kit_text no_text = {0};
static const tn_kit_nodes no_nodes = {0};
}

%union {
    tn_kit_length length;
    tn_kit_text text;
    tn_kit_vector vector;
    tn_kit_node *node;
    tn_kit_nodes nodes;
    tn_expression *expression;
}

%token END_OF_FILE 0 "the end of the file"
%token <length> NUMBER "a number"
%token <text> STRING "a text in quotes" NAME "a name" CODE "the name of a part"
%token USE "`use`" UNIT "`unit`" LENGTH "`length`" CONNECTOR "`connector`" JOINS "`joins`" TURNS "`turns`" EVERY "`every`" PART "`part`"
%token SPACE "`space`" RULE "`rule`" AT "`at`" MODEL "`model`" TEST "`test`" EXPECT "`expect`" FILL "`fill`" MASS "`mass`"
%token PRICE "`price`" IN "`in`" WITH "`with`" STOP "`stop`" TURN "`turn`" INSIDE "`inside`" START "`start`" BY "`by`"
%token COLOUR "`colour`" REQUIRE "`require`" COUNT "`count`" X "`x`"
%token MINIMIZE "`minimize`" MAXIMIZE "`maximize`" SEARCH "`search`" SYMMETRY "`symmetry`" STOCK "`stock`"
%token ASKED "a question"
%token ORDER "`order`" STEPS "`steps`" REPEAT "`repeat`"
%token COMMA "`,`" END "`;`" OPEN "`(`" CLOSE "`)`" OPEN_BRACE "`{`" CLOSE_BRACE "`}`" OPEN_BRACKET "`[`" CLOSE_BRACKET "`]`" BAR "`|`"
%token EQUALS "`=`" PLUS "`+`" MINUS "`-`" STAR "`*`" SLASH "`/`"
%token BELOW "`<`" AT_MOST "`<=`" AT_LEAST "`>=`" ABOVE "`>`" UNEQUAL "`!=`" TO_DOTS "`..`" AND "`and`" OR "`or`" NOT "`not`"
%left OR
%left AND
%precedence NOT
%precedence AT TURN REPEAT
%nonassoc EQUALS BELOW AT_MOST AT_LEAST ABOVE UNEQUAL IN
%left PLUS MINUS
%left STAR SLASH
%precedence SIGN

%type <node> statement feature fill space extent alternative placed drawn_one line condition connector has
%type <nodes> features names alternatives drawn several lines conditions extents stocks
%type <text> doc part_name axis axis_word upright
%type <length> length
%type <vector> vector
%type <expression> expression call

%%

file
    : statements
    | ASKED conditions                      { tn_kit_add(parse, node(parse, TN_KIT_TEST, @2, no_text, $2)); }
    ;

statements
    : %empty
    | statements USE STRING END                   { tn_kit_add_use(parse, $3); }
    | statements statement END                    { tn_kit_add(parse, $2); }
    | statements PART part_name doc OPEN_BRACE features CLOSE_BRACE
                                            { tn_kit_node *n = node(parse, TN_KIT_PART, tn_span_join(@2, @7), $3, $6);
                                              if (n) n->doc = $4;
                                              tn_kit_add(parse, n); yyerrok; }
    | statements PART part_name doc NAME NAME STRING END
                                            { tn_kit_add(parse, part_from(parse, tn_span_join(@2, @7), $3, $4, $5, $6, $7)); }
    | statements PART part_name doc NAME NAME STRING OPEN_BRACE features CLOSE_BRACE
                                            { tn_kit_node *n = part_from(parse, tn_span_join(@2, @10), $3, $4, $5, $6, $7);
                                              if (n) n->inner = $9;
                                              tn_kit_add(parse, n); yyerrok; }
    | statements MODEL NAME doc OPEN_BRACE lines CLOSE_BRACE
                                            { tn_kit_node *n = node(parse, TN_KIT_MODEL, tn_span_join(@2, @7), $3, $6);
                                              if (n) n->doc = $4;
                                              tn_kit_add(parse, n); yyerrok; }
    | statements TEST NAME OPEN_BRACE EXPECT conditions END CLOSE_BRACE
                                            { tn_kit_add(parse, node(parse, TN_KIT_TEST, tn_span_join(@2, @8), $3, $6)); }
    | statements PART part_name doc OPEN_BRACE features error CLOSE_BRACE
                                            { yyerrok; parse->damaged = true; }
    | statements MODEL NAME doc OPEN_BRACE lines error CLOSE_BRACE
                                            { yyerrok; parse->damaged = true; }
    | statements TEST NAME OPEN_BRACE error CLOSE_BRACE
                                            { yyerrok; parse->damaged = true; }
    | statements error END                        { yyerrok; parse->damaged = true; }
    | statements error CLOSE_BRACE                { yyerrok; parse->damaged = true; }
    ;

doc
    : %empty                                { $$ = no_text; }
    | STRING
    ;

part_name
    : NUMBER                                { $$ = text_of(parse, $1); }
    | CODE
    | NAME
    | STRING
    ;

statement
    : UNIT length X length X length         { $$ = sized(parse, TN_KIT_UNIT, @$, $2, $4, $6); }
    | UNIT length X length X length TURNS NUMBER
                                            { $$ = sized(parse, TN_KIT_UNIT, @$, $2, $4, $6); if ($$) $$->count[0] = $8; }
    | LENGTH NAME EQUALS length             { $$ = sized(parse, TN_KIT_LENGTH, @$, $4, $4, $4); if ($$) $$->name = $2; }
    | connector
    | SPACE NAME EQUALS space               { $$ = node(parse, TN_KIT_SPACE, @$, $2, tn_kit_nodes_add(no_nodes, $4)); }
    | RULE NAME AT names EQUALS alternatives
                                            { $$ = node(parse, TN_KIT_RULE, @$, $2, $6); if ($$) $$->outer = $4; }
    ;

connector
    : CONNECTOR NAME JOINS NAME             { $$ = node(parse, TN_KIT_CONNECTOR, @$, $2, no_nodes); if ($$) $$->other = $4; }
    | connector TURNS NUMBER                { $$ = $1; if ($$) $$->count[0] = $3; }
    | connector EVERY length                { $$ = $1; if ($$) $$->size[0] = $3; }
    ;

features
    : %empty                                { $$ = no_nodes; }
    | features feature END                  { $$ = tn_kit_nodes_add($1, $2); }
    | features error END                    { $$ = $1; yyerrok; parse->damaged = true; }
    ;

feature
    : fill
    | has
    | MASS NUMBER                           { $$ = counted(parse, TN_KIT_MASS, @$, no_text, $2); }
    | PRICE NUMBER                          { $$ = counted(parse, TN_KIT_PRICE, @$, no_text, $2); }
    ;

fill
    : FILL length X length X length         { $$ = sized(parse, TN_KIT_FILL, @$, $2, $4, $6); }
    | NAME NAME NAME length X length X length
                                            { $$ = sized(parse, TN_KIT_FILL, @$, $4, $6, $8);
                                              if ($$) { $$->doc = $1; $$->name = $2; $$->other = $3; } }
    | fill AT vector                        { $$ = $1; if ($$) { $$->at = $3; $$->span = @$; } }
    ;

has
    : NAME NAME                             { $$ = node(parse, TN_KIT_HAS, @$, $1, no_nodes); if ($$) $$->other = $2; }
    | has NUMBER X NUMBER                   { $$ = $1; if ($$) { $$->count[0] = $2; $$->count[1] = $4; } }
    | has AT vector                         { $$ = $1; if ($$) $$->at = $3; }
    ;

vector
    : OPEN length COMMA length COMMA length CLOSE { $$ = (tn_kit_vector){{$2, $4, $6}, @$, true}; }
    ;

length
    : NUMBER
    | NUMBER NAME                           { $$ = $1; $$.unit = $2; $$.span = @$; }
    | MINUS NUMBER                          { $$ = $2; $$.negative = true; $$.span = @$; }
    | MINUS NUMBER NAME                     { $$ = $2; $$.negative = true; $$.unit = $3; $$.span = @$; }
    ;

extents
    : extent                                { $$ = tn_kit_nodes_add(no_nodes, $1); }
    | extents COMMA extent                  { $$ = tn_kit_nodes_add($1, $3); }
    ;

extent
    : length                                { $$ = sized(parse, TN_KIT_LENGTH, @$, $1, $1, $1); }
    | NAME length                           { $$ = sized(parse, TN_KIT_LENGTH, @$, $2, $2, $2); if ($$) $$->name = $1; }
    ;

names
    : NAME                                  { $$ = tn_kit_nodes_add(no_nodes, node(parse, TN_KIT_NAMED, @1, $1, no_nodes)); }
    | names COMMA NAME                      { $$ = tn_kit_nodes_add($1, node(parse, TN_KIT_NAMED, @3, $3, no_nodes)); }
    ;

space
    : NAME                                  { $$ = node(parse, TN_KIT_NAMED, @$, $1, no_nodes); }
    | NAME OPEN extents CLOSE               { $$ = node(parse, TN_KIT_SHAPE, @$, $1, $3); }
    | NAME OPEN STRING upright CLOSE        { $$ = filed(parse, @$, $1, $3, $4, no_nodes); }
    | NAME OPEN STRING upright COMMA extents CLOSE
                                            { $$ = filed(parse, @$, $1, $3, $4, $6); }
    | MODEL OPEN STRING CLOSE               { $$ = filed(parse, @$, (tn_kit_text){"model", @1}, $3, no_text, no_nodes); }
    | OPEN space CLOSE                      { $$ = $2; }
    | space AND space                       { $$ = tn_kit_space_of(parse, TN_KIT_BOTH, @$, $1, $3); }
    | space OR space                        { $$ = tn_kit_space_of(parse, TN_KIT_EITHER, @$, $1, $3); }
    | NOT space                             { $$ = tn_kit_space_of(parse, TN_KIT_NOT, @$, $2, NULL); }
    | space TURN NUMBER                     { $$ = tn_kit_space_of(parse, TN_KIT_TURNED, @$, $1, NULL); if ($$) $$->count[0] = $3; }
    | space REPEAT NUMBER BY vector         { $$ = tn_kit_space_of(parse, TN_KIT_REPEATED, @$, $1, NULL);
                                              if ($$) { $$->count[0] = $3; $$->at = $5; } }
    | space AT vector                       { $$ = tn_kit_space_of(parse, TN_KIT_MOVED, @$, $1, NULL); if ($$) $$->at = $3; }
    ;

upright
    : %empty                                { $$ = no_text; }
    | axis_word NAME                        { $$ = $1; $$.span = @$; }
    ;

alternatives
    : alternative                           { $$ = tn_kit_nodes_add(no_nodes, $1); }
    | alternatives BAR alternative          { $$ = tn_kit_nodes_add($1, $3); }
    ;

alternative
    : placed                                { $$ = node(parse, TN_KIT_PLACES, @$, no_text, tn_kit_nodes_add(no_nodes, $1)); }
    | OPEN_BRACE CLOSE_BRACE                { $$ = node(parse, TN_KIT_PLACES, @$, no_text, no_nodes); }
    | OPEN_BRACE several CLOSE_BRACE        { $$ = node(parse, TN_KIT_PLACES, @$, no_text, $2); }
    | OPEN drawn CLOSE                      { $$ = node(parse, TN_KIT_DRAWN, @$, no_text, $2); }
    ;

drawn
    : drawn_one                             { $$ = tn_kit_nodes_add(no_nodes, $1); }
    | drawn BAR drawn_one                   { $$ = tn_kit_nodes_add($1, $3); }
    ;

drawn_one
    : placed OPEN_BRACKET NUMBER CLOSE_BRACKET
                                            { $$ = node(parse, TN_KIT_PLACES, @$, no_text, tn_kit_nodes_add(no_nodes, $1));
                                              if ($$) $$->count[0] = $3; }
    ;

several
    : placed                                { $$ = tn_kit_nodes_add(no_nodes, $1); }
    | several COMMA placed                  { $$ = tn_kit_nodes_add($1, $3); }
    ;

placed
    : part_name                             { $$ = node(parse, TN_KIT_PLACED, @$, $1, no_nodes); }
    | placed IN NUMBER                      { $$ = $1; if ($$) { $$->count[0] = $3; $$->span = @$; } }
    | placed WITH NAME                      { $$ = $1;
                                              if ($$) { $$->outer = tn_kit_nodes_add($$->outer, node(parse, TN_KIT_NAMED, @3, $3, no_nodes)); $$->span = @$; } }
    | placed STOP                           { $$ = $1; if ($$) { $$->stops = true; $$->span = @$; } }
    | placed AT vector                      { $$ = $1; if ($$) { $$->at = $3; $$->span = @$; } }
    | placed TURN NUMBER                    { $$ = $1; if ($$) { $$->count[1] = $3; $$->span = @$; } }
    ;

lines
    : %empty                                { $$ = no_nodes; }
    | lines line END                        { $$ = tn_kit_nodes_add($1, $2); }
    | lines error END                       { $$ = $1; yyerrok; parse->damaged = true; }
    ;

line
    : INSIDE space                          { $$ = node(parse, TN_KIT_INSIDE, @$, no_text, tn_kit_nodes_add(no_nodes, $2)); }
    | START NAME axis AT vector BY NAME     { $$ = node(parse, TN_KIT_START, @$, $2, no_nodes);
                                              if ($$) { $$->doc = $3; $$->at = $5; $$->other = $7; } }
    | START NAME axis AT vector TURN NUMBER BY NAME
                                            { $$ = node(parse, TN_KIT_START, @$, $2, no_nodes);
                                              if ($$) { $$->doc = $3; $$->at = $5; $$->count[0] = $7; $$->other = $9; } }
    | START STRING BY NAME                  { $$ = node(parse, TN_KIT_STANDS, @$, no_text, no_nodes);
                                              if ($$) { $$->doc = $2; $$->other = $4; } }
    | COLOUR NUMBER                         { $$ = counted(parse, TN_KIT_COLOUR, @$, no_text, $2); }
    | REQUIRE conditions                    { $$ = node(parse, TN_KIT_REQUIRES, @$, no_text, $2); }
    | MINIMIZE condition                    { $$ = node(parse, TN_KIT_MINIMIZES, @$, no_text, tn_kit_nodes_add(no_nodes, $2)); }
    | MAXIMIZE condition                    { $$ = node(parse, TN_KIT_MAXIMIZES, @$, no_text, tn_kit_nodes_add(no_nodes, $2)); }
    | SEARCH NAME                           { $$ = node(parse, TN_KIT_SEARCHES, @$, $2, no_nodes); }
    | SEARCH NAME NUMBER                    { $$ = counted(parse, TN_KIT_SEARCHES, @$, $2, $3); }
    | SYMMETRY TURN NUMBER                  { $$ = counted(parse, TN_KIT_REPEATS, @$, no_text, $3); }
    | SYMMETRY NAME axis_word               { $$ = node(parse, TN_KIT_REPEATS, @$, $2, no_nodes); if ($$) $$->other = $3; }
    | ORDER NAME                            { $$ = node(parse, TN_KIT_ORDERS, @$, $2, no_nodes); }
    | STEPS NAME                            { $$ = node(parse, TN_KIT_STEPS, @$, $2, no_nodes); }
    | STEPS PART                            { $$ = node(parse, TN_KIT_STEPS, @$, (tn_kit_text){"part", @2}, no_nodes); }
    | STEPS NUMBER                          { $$ = counted(parse, TN_KIT_STEPS, @$, no_text, $2); }
    | STOCK stocks                          { $$ = node(parse, TN_KIT_STOCKS, @$, no_text, $2); }
    ;

axis_word
    : NAME
    | X                                     { $$ = (tn_kit_text){"x", @1}; }
    ;

stocks
    : part_name AT_MOST NUMBER              { $$ = tn_kit_nodes_add(no_nodes, counted(parse, TN_KIT_STOCKED, @$, $1, $3)); }
    | stocks COMMA part_name AT_MOST NUMBER { $$ = tn_kit_nodes_add($1, counted(parse, TN_KIT_STOCKED, tn_span_join(@3, @5), $3, $5)); }
    ;

axis
    : %empty                                { $$ = no_text; }
    | NAME
    ;

conditions
    : condition                             { $$ = tn_kit_nodes_add(no_nodes, $1); }
    | conditions COMMA condition            { $$ = tn_kit_nodes_add($1, $3); }
    ;

condition
    : expression                            { $$ = node(parse, TN_KIT_CONDITION, @$, no_text, no_nodes); if ($$) $$->expression = $1; }
    ;

expression
    : NUMBER                                { $$ = number_of(parse, $1); }
    | NAME                                  { $$ = tn_expression_name(parse->arena, @$, $1.text); }
    | FILL                                  { $$ = tn_expression_name(parse->arena, @$, "fill"); }
    | MASS                                  { $$ = tn_expression_name(parse->arena, @$, "mass"); }
    | PRICE                                 { $$ = tn_expression_name(parse->arena, @$, "price"); }
    | COUNT OPEN part_name CLOSE            { $$ = count_of(parse, @$, $3); }
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

%%

static tn_kit_node *node(tn_parsing *parse, tn_kit_kind kind, tn_span span, tn_kit_text name, tn_kit_nodes inner)
{
    tn_kit_node *made = tn_kit_node_new(parse, kind, span, name);
    if (made)
        made->inner = inner;
    return made;
}

static tn_kit_node *sized(tn_parsing *parse, tn_kit_kind kind, tn_span span, tn_kit_length a, tn_kit_length b, tn_kit_length c)
{
    tn_kit_node *made = tn_kit_node_new(parse, kind, span, no_text);
    if (made) {
        made->size[0] = a;
        made->size[1] = b;
        made->size[2] = c;
    }
    return made;
}

static tn_kit_node *counted(tn_parsing *parse, tn_kit_kind kind, tn_span span, tn_kit_text name, tn_kit_length count)
{
    tn_kit_node *made = tn_kit_node_new(parse, kind, span, name);
    if (made)
        made->count[0] = count;
    return made;
}

static tn_kit_node *filed(tn_parsing *parse, tn_span span, tn_kit_text name, tn_kit_text file, tn_kit_text up, tn_kit_nodes sizes)
{
    tn_kit_node *made = node(parse, TN_KIT_FILED, span, name, sizes);
    if (made) {
        made->doc = file;
        made->other = up;
    }
    return made;
}

/* `from ldraw "3001.dat"`: the two words are checked later. */
static tn_kit_node *part_from(tn_parsing *parse, tn_span span, tn_kit_text name, tn_kit_text doc, tn_kit_text from, tn_kit_text what,
                              tn_kit_text file)
{
    tn_kit_node *made = node(parse, TN_KIT_PART, span, name, no_nodes);
    if (made) {
        made->doc = doc;
        made->other = file;
        made->outer = tn_kit_nodes_add(made->outer, node(parse, TN_KIT_NAMED, from.span, from, no_nodes));
        made->outer = tn_kit_nodes_add(made->outer, node(parse, TN_KIT_NAMED, what.span, what, no_nodes));
    }
    return made;
}

/* A number that is the name of a part. */
static tn_kit_text text_of(tn_parsing *parse, tn_kit_length number)
{
    tn_span span = number.span;
    return (tn_kit_text){tn_arena_copy(parse->arena, parse->text + span.begin, span.end - span.begin), span};
}

static tn_expression *number_of(tn_parsing *parse, tn_kit_length number)
{
    return tn_expression_number(parse->arena, number.span, tn_parsing_number(parse, number.span).value);
}

/* A term whose name no one can write; checking knows it by its call. */
static tn_expression *count_of(tn_parsing *parse, tn_span span, tn_kit_text part)
{
    tn_expression *made = tn_expression_name(parse->arena, span, part.text);
    if (made) {
        made->op = TN_OP_PART;
        made->name_span = part.span;
    }
    return made;
}

static tn_expression *of_two(tn_parsing *parse, tn_opcode op, tn_span span, tn_expression *a, tn_expression *b)
{
    return tn_expression_of(parse->arena, op, span, a, b, NULL);
}

static bool starts_statement(yysymbol_kind_t found)
{
    switch (found) {
    case YYSYMBOL_USE: case YYSYMBOL_UNIT: case YYSYMBOL_LENGTH: case YYSYMBOL_CONNECTOR: case YYSYMBOL_PART: case YYSYMBOL_SPACE:
    case YYSYMBOL_RULE: case YYSYMBOL_MODEL: case YYSYMBOL_TEST: case YYSYMBOL_FILL: case YYSYMBOL_MASS: case YYSYMBOL_PRICE:
    case YYSYMBOL_INSIDE: case YYSYMBOL_START: case YYSYMBOL_COLOUR: case YYSYMBOL_REQUIRE: case YYSYMBOL_MINIMIZE:
    case YYSYMBOL_MAXIMIZE: case YYSYMBOL_SEARCH: case YYSYMBOL_SYMMETRY: case YYSYMBOL_STOCK: case YYSYMBOL_ORDER: case YYSYMBOL_STEPS:
        return true;
    default:
        return false;
    }
}

static const char *likely_fix(yysymbol_kind_t found, yysymbol_kind_t before, bool may_end)
{
    if (may_end && starts_statement(found))
        return "write `;` before it: each statement ends with one";
    switch (before) {
    case YYSYMBOL_USE: return "write the file's path or name in quotes: `use \"bricks\";`";
    case YYSYMBOL_UNIT: return "write a cell's three sides: `unit 10 x 8 x 10;`";
    case YYSYMBOL_LENGTH: return "write `length brick = 24;`";
    case YYSYMBOL_CONNECTOR: return "write `connector stud joins tube turns 4 every 20;`";
    case YYSYMBOL_PART: return "write `part 3005 \"Brick 1 x 1\" { ... }`";
    case YYSYMBOL_SPACE: return "write `space tower = cylinder(6 studs, 8 bricks);`";
    case YYSYMBOL_RULE: return "write `rule wall at stud, tube = 3001 | 3003;`";
    case YYSYMBOL_MODEL: return "write `model tower { inside ring; start stud at (0, 0, 0) by wall; }`";
    case YYSYMBOL_TEST: return "write `test tower { expect components = 1; }`";
    case YYSYMBOL_AT: return found == YYSYMBOL_OPEN ? "a rule is at connectors: `rule wall at stud, tube = ...`" : "three lengths stand here: `at (0, 2 bricks, 0)`";
    case YYSYMBOL_START: return "write `start stud at (0, 0, 0) by wall;`";
    case YYSYMBOL_IN: return "a colour is a number of LDraw's: `3005 in 4`";
    case YYSYMBOL_SEARCH: return "write `search beam 50;`, `search anneal 10000;`, `search exact;` or `search greedy;`";
    case YYSYMBOL_SYMMETRY: return "write `symmetry turn 2;`, `symmetry turn 4;`, `symmetry mirror x;` or `symmetry mirror z;`";
    case YYSYMBOL_STOCK: return "write how many of a part there are: `stock 3001 <= 20, 3004 <= 5;`";
    case YYSYMBOL_ORDER: return "write `order depth;` or `order breadth;`";
    case YYSYMBOL_STEPS: return "write `steps part;`, `steps layer;`, or how many parts a step has: `steps 5;`";
    case YYSYMBOL_REPEAT: return "write how often, and how far apart: `post repeat 4 by (3 studs, 0, 0)`";
    case YYSYMBOL_WITH: return "write the rule that goes on there: `3005 with wall`";
    default: break;
    }
    if (before == YYSYMBOL_CLOSE && (found == YYSYMBOL_WITH || found == YYSYMBOL_IN || found == YYSYMBOL_STOP))
        return "colours, `with` and `stop` stand behind each part, inside the parentheses: `(3004 in 71 with wall [0.8] | 3005 [0.2])`";
    if (found == YYSYMBOL_EXPECT)
        return "a test has one `expect`; its conditions have commas between them: `expect components = 1, floating = 0;`";
    if (found == YYSYMBOL_OPEN_BRACKET)
        return "parts that are drawn by weight stand in parentheses, each with its weight: `(3004 [0.8] | 3005 [0.2])`";
    if (found == YYSYMBOL_CODE)
        return "a number and what it counts are apart: `4 studs`, `20 mm`, `4 x 2`";
    if (found == YYSYMBOL_BELOW || found == YYSYMBOL_AT_MOST || found == YYSYMBOL_AT_LEAST || found == YYSYMBOL_ABOVE ||
        found == YYSYMBOL_UNEQUAL)
        return "two comparisons are joined by `and`, or are two conditions with a comma between";
    if (found == YYSYMBOL_EQUALS)
        return "a rule says where it is: `rule wall at stud, tube = ...`; conditions are joined by `and`, or by a comma; a stock is `stock 3001 <= 20`";
    if (found == YYSYMBOL_CLOSE_BRACE)
        return "what stands in a block ends with `;`, too";
    if (found == YYSYMBOL_YYEOF)
        return "a statement ends with `;`, a block with `}`";
    return "a statement starts with a word such as `part`, `rule` or `model`, and ends with `;`";
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
    bool may_end = false;
    for (int i = 0; i < count; i++) {
        expected[i] = yysymbol_name(kinds[i]);
        may_end |= kinds[i] == YYSYMBOL_END;
    }
    tn_parsing_syntax_error(parse, *yypcontext_location(context), found == YYSYMBOL_YYEMPTY ? "this" : yysymbol_name(found), expected,
                           (size_t)count, parse->asks ? "write conditions, as `components = 1, count(3005) <= 30`" : likely_fix(found, YYTRANSLATE(parse->token_before), may_end));
    return 0;
}

static void tn_kit_error(const tn_span *span, tn_parsing *parse, void *scanner, const char *message)
{
    (void)scanner;
    (void)message;
    tn_report(parse->diagnostics, E_TOO_DEEP, *span, "the file cannot be read further");
}

static tn_kit_file *parse_text(tn_arena *arena, tn_diagnostics *diagnostics, uint32_t file, tn_tokens *tokens, bool asks)
{
    tn_kit_file *result = TN_NEW(arena, tn_kit_file);
    const tn_source *source = &diagnostics->sources->files[file];
    tn_parsing parse = {.arena = arena, .diagnostics = diagnostics, .text = source->text, .size = source->size, .file = file, .result = result, .tokens = tokens, .asks = asks};
    if (!result)
        return NULL;
    if (!tn_parsing_is_text(&parse)) {
        result->damaged = true;
        return result;
    }
    void *scanner = tn_kit_lexer_new(&parse);
    if (!scanner)
        return NULL;
    int outcome = tn_kit_parse(&parse, scanner);
    tn_kit_lexer_free(scanner);
    result->damaged = parse.damaged || outcome != 0;
    return tn_arena_failed(arena) ? NULL : result; /* deeper than the parser goes: has been said */
}

tn_kit_file *tn_parse_kit(tn_arena *arena, tn_diagnostics *diagnostics, uint32_t file, tn_tokens *tokens)
{
    return parse_text(arena, diagnostics, file, tokens, false);
}

tn_kit_file *tn_parse_kit_conditions(tn_arena *arena, tn_diagnostics *diagnostics, uint32_t file)
{
    return parse_text(arena, diagnostics, file, NULL, true);
}
