/* The plan language's grammar: schemas, rules, libraries and tests (docs/plan-language.md).
 *
 * An action calls one constructor of compiler/plan/syntax/ast.h. After an error the parser goes on at the next item of the file, field
 * of a schema, clause of a library or case of a test (the rules with `error`); the words that start those say yyerrok, so
 * that the next mistake is reported too. All lists are left-recursive: the parser's stack grows with nesting only.
 */
%require "3.8"
%define api.pure full
%define api.prefix {tn_plan_}
%define api.token.prefix {TN_PLAN_}
%define api.location.type {tn_span}
%define parse.error custom
%define parse.lac full
%locations
%expect 0

%code requires {
#include "compiler/plan/syntax/form_ast.h"
}

%parse-param {tn_parse *parse} {void *scanner}
%lex-param {void *scanner}

%code {
#include "compiler/plan/syntax/syntax_error.h"
#include "plan_lexer.h"

#define YYLLOC_DEFAULT(CURRENT, RHS, N)                                                                                \
    ((CURRENT) = (N) ? tn_span_join(YYRHSLOC(RHS, 1), YYRHSLOC(RHS, N))                                                \
                     : (tn_span){YYRHSLOC(RHS, 0).file, YYRHSLOC(RHS, 0).end, YYRHSLOC(RHS, 0).end})

int tn_plan_lex(TN_PLAN_STYPE *value, tn_span *span, void *scanner);
static void tn_plan_error(const tn_span *span, tn_parse *parse, void *scanner, const char *message);
}

%union {
    tn_ast_word *word;
    tn_ast_list list;
    tn_ast_literal literal;
    tn_ast_range range;
    tn_operator op;
    tn_ast_region region;
    tn_ast_extreme_kind extreme;
    tn_ast_cond *cond;
    tn_ast_expr *expr;
    tn_ast_body body;
    tn_ast_field field;
    tn_ast_rule rule;
    tn_ast_library library;
    tn_ast_form form;
    tn_ast_form_clause form_clause;
    tn_ast_tile_part tile_part;
    tn_ast_symbol_line symbol_line;
    tn_box_side box_side;
    void *node;
}

%token END_OF_FILE 0 "the end of the file"
%token <word> NAME "a name" FIELD_NAME "a field" NUMBER "a number" LENGTH "a length" STRING "a text in quotes"
%token <word> CLAUSE_NAME "a clause's name"
%token <word> AREA "an area" HOUSE "a house"
%token USE "`use`" SCHEMA "`schema`" RULE "`rule`" LIBRARY "`library`" TEST "`test`"
%token USING "`using`" FROM "`from`" ALLOW "`allow`" AS "`as`" BY "`by`" TO "`to`" OF "`of`"
%token ZONE "`zone`" FLAG "`flag`" FORBID "`forbid`" ONLY "`only`" ROLE "`role`"
%token TRAYS "`trays`" TOTAL "`total`" REQUIRE "`require`" PRUNE "`prune`" GENERATE "`generate`" WEIGHT "`weight`" PREFER "`prefer`" WORTH "`worth`"
%token TODO "`todo`" MATCH "`match`" REJECT "`reject`" KEEP "`keep`" DROP "`drop`"
%token TRAY "`tray`" ANY "`any`" AND "`and`" OR "`or`" NOT "`not`"
%token NEIGHBOUR "`neighbour`" SYMMETRIC "`symmetric`" QUANTITY "`quantity`" SUM "`sum`" MANY "`many`"
%token OCCURRENCES "`occurrences`" OPTIONAL "`optional`" DISTANCE "`distance`" BEGINNING "`beginning`" END "`end`"
%token IN "`in`" MOD "`mod`" ROOM "`room`" TOUCH "`touch`" APART "`apart`" THROUGH "`through`" WALK "`walk`" EXITS "`exits`"
%token <word> DECIMAL "a decimal number"
%token MEASURE "`measure`" LET "`let`" NUMBER_FIELD "`number`" WHERE "`where`" MATCHES "`matches`" SOME "`some`" EVERY "`every`"
%token IMPLIES "`implies`" GAP "`gap`" WITHIN "`within`" LEAST "`least`" BEFORE "`before`" AFTER "`after`" PLAN "`plan`" MIN "`min`" MAX "`max`" VALUE "`value`"
%token ONE_EXPRESSION "an expression" ONE_PATTERN "an open plan" ONE_LITERAL "a plan" ONE_SETTING "the value of a param"
%token PARAM "`param`" WITH "`with`" ONTO "`onto`" BY_MEASURE "`measure` of plans" BY_RULE "`rule` of plans"
%token PLUS "`+`" STAR "`*`" SLASH "`/`" ELLIPSIS "`...`" QUESTION "`?`"
%token FORM "`form`" STOREY "`storey`" SPINE "`spine`" WALL "`wall`" PARTITION "`partition`" FLOOR "`floor`" ROOF "`roof`"
%token OPTION "`option`" VOID "`void`" NO "`no`" FUNCTION "`function`" OUTDOOR "`outdoor`" AT "`at`" CELL "`cell`"
%token OPENING "`opening`" WIDE "`wide`" HIGH "`high`" SILL "`sill`" CLEAR "`clear`" PASSAGE "`passage`"
%token WAY "`way`" HEADROOM "`headroom`" GUARD "`guard`"
%token BEAM "`beam`" SPAN "`span`" CLASSIFICATION "`classification`"
%token FLIGHT "`flight`" RISE "`rise`" GOING "`going`" TURN "`turn`" WINDERS "`winders`"
%token GLAZED "`glazed`" LEAFLESS "`leafless`" NEAR "`near`" SLIDING "`sliding`" MATERIAL "`material`" PRICE "`price`" PER "`per`"
%token FACE "`face`" BESIDE "`beside`" ALONG "`along`" ACROSS "`across`" UNDER "`under`" OUTSIDE "`outside`"
%token TILE "`tile`" FOR "`for`" AGAINST "`against`" DEEP "`deep`" ITEM "`item`" SYMBOL "`symbol`" LINE "`line`"
%token LEFT "`left`" RIGHT "`right`" BACK "`back`" FRONT "`front`" UP "`up`" COLON "`:`"
%token ABSENT "`-` for what is absent" OF_DEPTH "`:` before a depth"
%token DOTS "`..`" LESS "`<`" AT_MOST "`<=`" UNEQUAL "`!=`" AT_LEAST "`>=`" GREATER "`>`"
%token EQUAL "`=`" OPEN "`(`" CLOSE "`)`" OPEN_BRACE "`{`" CLOSE_BRACE "`}`" OPEN_BRACKET "`[`" CLOSE_BRACKET "`]`"
%token BAR "`|`" COMMA "`,`" DASH "`-`"

%type <node> item field value forbid case any_case spec_item spec_alternative literal_tray prune require preference
%type <body> body
%type <field> field_head
%type <rule> rule_head
%type <library> library_head
%type <word> doc role using from constant operand spec_word spec_sign literal_word clause_name expectation positive worth
%type <list> expectations items values ordered depths allow names clauses clause prunes requires preferences cases clause_names trays words
%type <list> specifier spec_items spec_alternatives spec_words parts total_field
%type <list> by_kinds walk_by
%type <literal> plan
%type <range> range
%type <op> comparison
%type <region> region
%type <extreme> extreme walk
%type <cond> condition cond_ors cond_and cond_ands cond_not cond_atom compare
%type <form> form_head
%type <form_clause> thickness relation price
%type <tile_part> stretch_word drawn
%type <symbol_line> line_end
%type <box_side> side_word
%type <node> form_clause shape argument opening_part tile_part symbol_line reach layer class option_alternative option_item
%type <list> form_clauses layers classes shapes arguments opening_parts tile_parts symbol_lines kinds or_names reaches option_items option_alternatives
%type <word> size outside_side side number going turn winders option
%type <expr> material_where
%type <expr> walk_end cells cell_ors cell_and cell_ands cell_not options option_ors option_and option_ands option_not
%type <expr> expression implied qualified disjunction ors and ands not compared comparable nearness additive term signed primary pattern_tray head_number
%type <expr> part call_arg tray_sum tray_term tray_signed tray_atom
%type <list> params number_cases pattern call_args
%type <node> number_item number_case setting
%type <list> param_words with settings

%%

file
    : items                                     { parse->result->items = $1; }
    | ONE_EXPRESSION expression                 { parse->result->expression = $2; }
    | ONE_PATTERN pattern                       { parse->result->pattern = $2; }
    | ONE_LITERAL plan                          { parse->result->literal = $2; }
    | ONE_SETTING setting                       { parse->result->setting = $2; }
    ;

items
    : %empty                                    { $$ = tn_ast_empty(); }
    | items item                                { $$ = tn_ast_append($1, $2); }
    | items error                               { $$ = tn_ast_lost($1, parse); }
    ;

item
    : use STRING                                { $$ = tn_ast_use_new(parse, @$, $2); }
    | schema NAME doc from OPEN_BRACE body CLOSE_BRACE
                                                { $$ = tn_ast_schema_new(parse, @$, $2, $3, $4, $6); }
    | schema NAME doc OF NAME OPEN_BRACE body CLOSE_BRACE
                                                { $$ = tn_ast_rows_new(parse, @$, $2, $3, $5, $7); }
    | let NAME EQUAL expression                 { $$ = tn_ast_let_new(parse, @$, $2, $4); }
    | param NAME doc EQUAL additive             { $$ = tn_ast_param_new(parse, @$, (tn_ast_rule){.name = $2, .doc = $3}, $5); }
    | param NAME doc EQUAL additive IN additive DOTS additive
                                                { $$ = tn_ast_param_new(parse, @$, (tn_ast_rule){.name = $2, .doc = $3, .low = $7, .high = $9}, $5); }
    | param NAME doc EQUAL param_words          { $$ = tn_ast_param_new(parse, @$, (tn_ast_rule){.name = $2, .doc = $3, .words = $5}, NULL); }
    | measure NAME doc using EQUAL additive     { $$ = tn_ast_measure_new(parse, @$, $2, $3, $4, $6); }
    | rule_head EQUAL expression                { $$ = tn_ast_rule_new(parse, @$, $1, $3); }
    | rule_head EQUAL error                     { $$ = tn_ast_rule_new(parse, @1, $1, NULL); }
    | library_head OPEN_BRACE clauses CLOSE_BRACE
                                                { $$ = tn_ast_library_new(parse, @$, $1, $3); }
    | form_head OPEN_BRACE form_clauses CLOSE_BRACE
                                                { $$ = tn_ast_form_new(parse, @$, $1, $3); }
    | test names with OPEN_BRACE cases CLOSE_BRACE
                                                { $$ = tn_ast_test_new(parse, @$, $2, $3, $5); }
    ;

let: LET                                        { yyerrok; };
param: PARAM                                    { yyerrok; };
measure: MEASURE                                { yyerrok; };

use: USE                                        { yyerrok; };
schema: SCHEMA                                  { yyerrok; };
rule: RULE                                      { yyerrok; };
library: LIBRARY                                { yyerrok; };
test: TEST                                      { yyerrok; };
form: FORM                                      { yyerrok; };

doc
    : %empty                                    { $$ = NULL; }
    | STRING
    ;

names
    : NAME                                      { $$ = tn_ast_one($1); }
    | names COMMA NAME                          { $$ = tn_ast_append($1, $3); }
    ;

param_words
    : NAME BAR NAME                             { $$ = tn_ast_append(tn_ast_one($1), $3); }
    | param_words BAR NAME                      { $$ = tn_ast_append($1, $3); }
    ;

/* What params have for the cases of a test. */
with
    : %empty                                    { $$ = tn_ast_empty(); }
    | WITH settings                             { $$ = $2; }
    ;

settings
    : setting                                   { $$ = tn_ast_one($1); }
    | settings COMMA setting                    { $$ = tn_ast_append($1, $3); }
    ;

setting
    : NAME EQUAL additive                       { $$ = tn_ast_setting_new(parse, @$, $1, $3); }
    ;

/* ---- schemas */

from
    : %empty                                    { $$ = NULL; }
    | FROM NAME                                 { $$ = $2; }
    ;

body
    : %empty                                    { $$ = (tn_ast_body){0}; }
    | body field                                { $$ = tn_ast_body_field($1, $2); }
    | body forbid                               { $$ = tn_ast_body_forbid($1, $2); }
    | body number_item                          { $$ = tn_ast_body_number($1, $2); }
    | body error                                { $$ = tn_ast_body_broken($1); }
    ;

field
    : field_head EQUAL values                   { $$ = tn_ast_field_new(parse, @$, TN_FORM_VALUES, $1, $3); }
    | field_head EQUAL ordered                  { $$ = tn_ast_ordered_new(parse, @$, $1, $3); }
    | field_head EQUAL FLAG                     { $$ = tn_ast_field_new(parse, @$, TN_FORM_FLAG, $1, tn_ast_empty()); }
    | field_head EQUAL BY_MEASURE NAME             { $$ = tn_ast_said_new(parse, @$, TN_FORM_MEASURE, $1, $4); }
    | field_head EQUAL BY_RULE NAME                { $$ = tn_ast_said_new(parse, @$, TN_FORM_RULE, $1, $4); }
    | zone field_head EQUAL values              { $$ = tn_ast_field_new(parse, @$, TN_FORM_ZONE, $2, $4); }
    ;

number_item
    : number_word field_head EQUAL number_cases { $$ = tn_ast_number_new(parse, @$, $2, $4); }
    ;

number_word: NUMBER_FIELD                       { yyerrok; };

number_cases
    : number_case                               { $$ = tn_ast_one($1); }
    | number_cases BAR number_case              { $$ = tn_ast_append($1, $3); }
    ;

number_case
    : tray_sum                                  { $$ = tn_ast_number_case_new(parse, @$, $1, NULL); }
    | tray_sum WHERE TRAY OPEN specifier CLOSE  { $$ = tn_ast_number_case_new(parse, @$, $1, tn_ast_tray_new(parse, tn_span_join(@3, @6), $5)); }
    ;

zone: ZONE                                      { yyerrok; };
forbid_word: FORBID                             { yyerrok; };
only_word: ONLY                                 { yyerrok; };

field_head
    : FIELD_NAME doc role                       { $$ = (tn_ast_field){.name = $1, .doc = $2, .role = $3}; yyerrok; }
    ;

role
    : %empty                                    { $$ = NULL; }
    | ROLE NAME                                 { $$ = $2; }
    ;

values
    : value                                     { $$ = tn_ast_one($1); }
    | values BAR value                          { $$ = tn_ast_append($1, $3); }
    ;

/* From the least to the greatest. */
ordered
    : value LESS value                          { $$ = tn_ast_append(tn_ast_one($1), $3); }
    | ordered LESS value                        { $$ = tn_ast_append($1, $3); }
    | ordered BAR value                         { $$ = tn_ast_mixed_order(parse, @2, $1, $3); }
    | values BAR value LESS value               { $$ = tn_ast_mixed_order(parse, @4, tn_ast_append($1, $3), $5); }
    ;

value
    : NAME doc role                             { $$ = tn_ast_value_new(parse, @$, $1, NULL, $2, $3); }
    | LENGTH doc role                           { $$ = tn_ast_value_new(parse, @$, $1, NULL, $2, $3); }
    | NUMBER doc role                           { $$ = tn_ast_value_new(parse, @$, $1, NULL, $2, $3); }
    | NAME OPEN depths CLOSE doc role           { $$ = tn_ast_value_new(parse, @$, $1, &$3, $5, $6); }
    | ELLIPSIS                                  { $$ = tn_ast_older_values(parse, @$); }
    ;

depths
    : spec_word                                 { $$ = tn_ast_one($1); }
    | depths COMMA spec_word                    { $$ = tn_ast_append($1, $3); }
    ;

forbid
    : forbid_word expression                    { $$ = tn_ast_forbid_new(parse, @$, $2, false); }
    | only_word expression                      { $$ = tn_ast_forbid_new(parse, @$, $2, true); }
    ;

/* ---- tray specifiers: what the words of an item mean depends on the schema, so they are kept as they stand */

specifier
    : %empty                                    { $$ = tn_ast_empty(); }
    | spec_items
    ;

spec_items
    : spec_item                                 { $$ = tn_ast_one($1); }
    | spec_items COMMA spec_item                { $$ = tn_ast_append($1, $3); }
    ;

spec_item
    : spec_alternatives                         { $$ = tn_ast_item_new(parse, @$, $1); }
    ;

spec_alternatives
    : spec_alternative                          { $$ = tn_ast_one($1); }
    | spec_alternatives OR spec_alternative     { $$ = tn_ast_append($1, $3); }
    ;

spec_alternative
    : spec_words                                { $$ = tn_ast_alternative_new(parse, @$, $1); }
    ;

spec_words
    : spec_word                                 { $$ = tn_ast_one($1); }
    | spec_sign                                 { $$ = tn_ast_one($1); }
    | spec_words spec_word                      { $$ = tn_ast_append($1, $2); }
    | spec_words spec_sign                      { $$ = tn_ast_append($1, $2); }
    ;

/* Of sums that are compared: `width > 2 * body depth`. */
spec_sign
    : PLUS                                      { $$ = tn_ast_sign(parse, @$); }
    | DASH                                      { $$ = tn_ast_sign(parse, @$); }
    | STAR                                      { $$ = tn_ast_sign(parse, @$); }
    | SLASH                                     { $$ = tn_ast_sign(parse, @$); }
    ;

spec_word
    : NAME
    | NUMBER
    | LENGTH
    | NOT                                       { $$ = tn_ast_not_word(parse, @$); }
    | AREA
    | DECIMAL
    | comparison                                { $$ = tn_ast_operator(parse, @$, $1); }
    | LENGTH DOTS LENGTH                        { $$ = tn_ast_word_range(parse, @$, $1, $3); }
    | NUMBER DOTS NUMBER                        { $$ = tn_ast_word_range(parse, @$, $1, $3); }
    | NAME DOTS NAME                            { $$ = tn_ast_word_range(parse, @$, $1, $3); }
    | AREA DOTS AREA                            { $$ = tn_ast_word_range(parse, @$, $1, $3); }
    | NUMBER COLON NUMBER                       { $$ = tn_ast_word_ratio(parse, @$, $1, $3); }
    | IN                                        { $$ = NULL; }
    | OPEN spec_alternatives CLOSE              { $$ = tn_ast_group(parse, @$, $2); }
    ;

/* ---- rules */

rule_head
    : rule NAME params doc using allow          { $$ = (tn_ast_rule){.name = $2, .doc = $4, .using = $5, .allow = $6, .params = $3}; }
    ;

params
    : %empty                                    { $$ = tn_ast_empty(); }
    | OPEN names CLOSE                          { $$ = $2; }
    ;

using
    : %empty                                    { $$ = NULL; }
    | USING NAME                                { $$ = $2; }
    ;

allow
    : %empty                                    { $$ = tn_ast_empty(); }
    | ALLOW names                               { $$ = $2; }
    ;

expression
    : disjunction
    | implied
    | qualified
    ;

/* A stretch, and what else is so of it and of what lies around it. */
qualified
    : disjunction WHERE disjunction             { $$ = tn_ast_where(parse, @$, $1, $3); }
    | qualified WHERE disjunction               { $$ = tn_ast_mixed(parse, @$, $1); }
    | qualified IMPLIES disjunction             { $$ = tn_ast_mixed(parse, @$, $1); }
    ;

implied
    : disjunction IMPLIES disjunction           { $$ = tn_ast_implies(parse, @$, $1, $3); }
    | implied IMPLIES disjunction               { $$ = tn_ast_implies_chained(parse, @$, $1); }
    | implied WHERE disjunction                 { $$ = tn_ast_mixed(parse, @$, $1); }
    ;

disjunction
    : and
    | ors
    ;

ors
    : and OR and                                { $$ = tn_ast_expr_join(parse, TN_EXPR_OR, $1, $3); }
    | ors OR and                                { $$ = tn_ast_expr_add(parse, $1, $3); }
    ;

and
    : not
    | ands
    ;

ands
    : not AND not                               { $$ = tn_ast_expr_join(parse, TN_EXPR_AND, $1, $3); }
    | ands AND not                              { $$ = tn_ast_expr_add(parse, $1, $3); }
    ;

not
    : NOT not                                   { $$ = tn_ast_of(parse, TN_EXPR_NOT, @$, tn_ast_one($2)); }
    | compared
    ;

/* Rules and sums are one grammar: which of them a part is, the checker says (and says it better than a parser could). */
compared
    : additive
    | comparable
    | comparable comparison additive            { $$ = tn_ast_compared_chained(parse, @$, $1); }
    | additive IN additive DOTS additive        { $$ = tn_ast_sum_within(parse, @$, $1, $3, $5); }
    | additive MOD additive comparison additive { $$ = tn_ast_sum_remainder(parse, @$, $1, $3, $4, $5); }
    | nearness
    | EVERY nearness                            { $$ = tn_ast_every_near(parse, @$, $2); }
    ;

/* A stretch, and what lies around it. */
nearness
    : additive BESIDE additive                  { $$ = tn_ast_near(parse, @$, TN_NEAR_BESIDE, $1, NULL, $3); }
    | additive WITHIN additive OF additive      { $$ = tn_ast_near(parse, @$, TN_NEAR_WITHIN, $1, $3, $5); }
    | additive AT LEAST additive FROM EVERY additive
                                                { $$ = tn_ast_near(parse, @$, TN_NEAR_APART, $1, $4, $7); }
    | nearness BESIDE additive                  { $$ = tn_ast_near_chained(parse, @$, $1); }
    | nearness WITHIN additive OF additive      { $$ = tn_ast_near_chained(parse, @$, $1); }
    ;

comparable
    : additive comparison additive              { $$ = tn_ast_sum_compared(parse, @$, $1, $2, $3); }
    ;

additive
    : term
    | additive PLUS term                        { $$ = tn_ast_arithmetic(parse, TN_EXPR_PLUS, @$, $1, $3); }
    | additive DASH term                        { $$ = tn_ast_arithmetic(parse, TN_EXPR_MINUS, @$, $1, $3); }
    ;

term
    : signed
    | term STAR signed                          { $$ = tn_ast_arithmetic(parse, TN_EXPR_TIMES, @$, $1, $3); }
    | term SLASH signed                         { $$ = tn_ast_arithmetic(parse, TN_EXPR_OVER, @$, $1, $3); }
    ;

signed
    : primary
    | DASH signed                               { $$ = tn_ast_of(parse, TN_EXPR_NEGATIVE, @$, tn_ast_one($2)); }
    ;

primary
    : TRAY OPEN specifier CLOSE                 { $$ = tn_ast_tray_new(parse, @$, $3); }
    | ANY                                       { $$ = tn_ast_leaf(parse, TN_EXPR_ANY, @$); }
    | NAME                                      { $$ = tn_ast_name(parse, $1); }
    | NAME OPEN call_args CLOSE                 { $$ = tn_ast_call(parse, @$, $1, $3); }
    | head_number
    | TRAYS                                     { $$ = tn_ast_leaf(parse, TN_EXPR_TRAYS, @$); }
    | MATCHES OPEN expression CLOSE             { $$ = tn_ast_of(parse, TN_EXPR_MATCHES, @$, tn_ast_one($3)); }
    | QUANTITY OPEN expression region CLOSE     { $$ = tn_ast_counted(parse, TN_EXPR_QUANTITY, @$, $3, $4, NULL); }
    | OCCURRENCES OPEN expression region CLOSE  { $$ = tn_ast_counted(parse, TN_EXPR_OCCURRENCES, @$, $3, $4, NULL); }
    | SUM OPEN tray_sum region CLOSE            { $$ = tn_ast_sum(parse, @$, $3, NULL, $4, NULL); }
    | SUM OPEN tray_sum OF expression region CLOSE
                                                { $$ = tn_ast_sum(parse, @$, $3, $5, $6, NULL); }
    | extreme OPEN tray_sum CLOSE               { $$ = tn_ast_extreme(parse, @$, $1, $3, NULL); }
    | extreme OPEN tray_sum OF expression CLOSE { $$ = tn_ast_extreme(parse, @$, $1, $3, $5); }
    | extreme OPEN GAP FROM expression TO expression CLOSE
                                                { $$ = tn_ast_extreme_gap(parse, @$, $1, $5, $7, NULL); }
    | extreme OPEN GAP FROM expression TO expression BY NAME CLOSE
                                                { $$ = tn_ast_extreme_gap(parse, @$, $1, $5, $7, $9); }
    | SOME names IN NAME OPEN expression CLOSE  { $$ = tn_ast_quantifier(parse, TN_EXPR_SOME, @$, $2, $4, $6); }
    | EVERY names IN NAME OPEN expression CLOSE { $$ = tn_ast_quantifier(parse, TN_EXPR_EACH, @$, $2, $4, $6); }
    | EVERY OPEN expression COMMA expression CLOSE
                                                { $$ = tn_ast_every(parse, @$, $3, $5); }
    | PLAN OPEN_BRACKET pattern CLOSE_BRACKET   { $$ = tn_ast_of(parse, TN_EXPR_PLAN, @$, $3); }
    | OPEN expression CLOSE                     { $$ = $2; }
    | BEGINNING                                 { $$ = tn_ast_leaf(parse, TN_EXPR_BEGINNING, @$); }
    | END                                       { $$ = tn_ast_leaf(parse, TN_EXPR_END, @$); }
    | NEIGHBOUR OPEN parts CLOSE                { $$ = tn_ast_of(parse, TN_EXPR_NEIGHBOUR, @$, $3); }
    | SYMMETRIC primary                         { $$ = tn_ast_of(parse, TN_EXPR_SYMMETRIC, @$, tn_ast_one($2)); }
    | MANY OPEN expression CLOSE                { $$ = tn_ast_of(parse, TN_EXPR_MANY, @$, tn_ast_one($3)); }
    | OPTIONAL OPEN expression CLOSE            { $$ = tn_ast_of(parse, TN_EXPR_OPTIONAL, @$, tn_ast_one($3)); }
    | QUANTITY OPEN expression region COMMA condition CLOSE
                                                { $$ = tn_ast_counted(parse, TN_EXPR_QUANTITY, @$, $3, $4, $6); }
    | OCCURRENCES OPEN expression region COMMA condition CLOSE
                                                { $$ = tn_ast_counted(parse, TN_EXPR_OCCURRENCES, @$, $3, $4, $6); }
    | SUM OPEN tray_sum region COMMA condition CLOSE
                                                { $$ = tn_ast_sum(parse, @$, $3, NULL, $4, $6); }
    | SUM OPEN tray_sum OF expression region COMMA condition CLOSE
                                                { $$ = tn_ast_sum(parse, @$, $3, $5, $6, $8); }
    | CELL OPEN specifier CLOSE                 { $$ = tn_ast_house_leaf(parse, TN_EXPR_CELL, @$, $3); }
    | ROOM OPEN specifier CLOSE                 { $$ = tn_ast_house_leaf(parse, TN_EXPR_ROOM, @$, $3); }
    | OPTION OPEN option_items CLOSE            { $$ = tn_ast_house_leaf(parse, TN_EXPR_SECTION, @$, $3); }
    | TOUCH OPEN cells COMMA cells by_kinds CLOSE
                                                { $$ = tn_ast_meeting(parse, TN_EXPR_TOUCH, @$, tn_ast_append(tn_ast_one($3), $5), $6); }
    | APART OPEN cells COMMA FROM cells walk_by CLOSE
                                                { $$ = tn_ast_meeting(parse, TN_EXPR_APART, @$, tn_ast_append(tn_ast_one($3), $6), $7); }
    | APART OPEN cells COMMA FROM cells COMMA THROUGH cells walk_by CLOSE
                                                { $$ = tn_ast_meeting(parse, TN_EXPR_APART, @$, tn_ast_append(tn_ast_append(tn_ast_one($3), $6), $9), $10); }
    | APART OPEN cells COMMA FROM cells COMMA BY or_names COMMA THROUGH cells CLOSE
                                                { $$ = tn_ast_meeting(parse, TN_EXPR_APART, @$, tn_ast_append(tn_ast_append(tn_ast_one($3), $6), $12), $9); }
    | walk OPEN cells COMMA TO walk_end walk_by CLOSE
                                                { $$ = tn_ast_walk(parse, @$, $1, $3, $6, NULL, $7); }
    | walk OPEN cells COMMA TO walk_end COMMA THROUGH cells walk_by CLOSE
                                                { $$ = tn_ast_walk(parse, @$, $1, $3, $6, $9, $10); }
    | walk OPEN cells COMMA TO walk_end COMMA BY or_names COMMA THROUGH cells CLOSE
                                                { $$ = tn_ast_walk(parse, @$, $1, $3, $6, $12, $9); }
    | EXITS OPEN cells CLOSE                    { $$ = tn_ast_of(parse, TN_EXPR_EXITS, @$, tn_ast_one($3)); }
    | DISTANCE OPEN FROM expression COMMA TO expression COMMA BY expression CLOSE
                                                { $$ = tn_ast_distance(parse, @$, $4, $7, $10); }
    ;

extreme
    : MAX                                       { $$ = TN_EXTREME_MOST; }
    | MIN                                       { $$ = TN_EXTREME_LEAST; }
    ;

walk
    : WALK                                      { $$ = TN_EXTREME_MOST; }
    | LEAST WALK                                { $$ = TN_EXTREME_LEAST; }
    ;

/* A word: the outside. */
walk_end
    : cells
    | NAME                                      { $$ = tn_ast_figure(parse, @$, $1, NULL); }
    ;

/* Where a count or a sum looks, of the stretch that a `where` is about. */
region
    : %empty                                    { $$ = TN_AST_STRETCH; }
    | BEFORE                                    { $$ = TN_AST_BEFORE; }
    | AFTER                                     { $$ = TN_AST_AFTER; }
    ;

by_kinds
    : %empty                                    { $$ = tn_ast_empty(); }
    | BY or_names                               { $$ = $2; }
    ;

walk_by
    : %empty                                    { $$ = tn_ast_empty(); }
    | COMMA BY or_names                         { $$ = $3; }
    ;

head_number
    : NUMBER                                    { $$ = tn_ast_constant(parse, $1); }
    | LENGTH                                    { $$ = tn_ast_constant(parse, $1); }
    | AREA                                      { $$ = tn_ast_constant(parse, $1); }
    | DECIMAL                                   { $$ = tn_ast_constant(parse, $1); }
    ;

call_args
    : call_arg                                  { $$ = tn_ast_one($1); }
    | call_args COMMA call_arg                  { $$ = tn_ast_append($1, $3); }
    ;

/* A range is one of `repeat`: how often. */
call_arg
    : expression
    | additive DOTS additive                    { $$ = tn_ast_range_of(parse, @$, $1, $3); }
    | additive DOTS                             { $$ = tn_ast_range_of(parse, @$, $1, NULL); }
    ;

pattern
    : pattern_tray                              { $$ = tn_ast_one($1); }
    | pattern BAR pattern_tray                  { $$ = tn_ast_append($1, $3); }
    ;

pattern_tray
    : QUESTION                                  { $$ = tn_ast_leaf(parse, TN_EXPR_ANY, @$); }
    | ELLIPSIS                                  { $$ = tn_ast_gap(parse, @$); }
    | spec_items                                { $$ = tn_ast_open_tray(parse, @$, $1); }
    | TRAY OPEN specifier CLOSE                 { $$ = tn_ast_tray_new(parse, @$, $3); }
    ;

parts
    : part                                      { $$ = tn_ast_one($1); }
    | parts COMMA part                          { $$ = tn_ast_append($1, $3); }
    ;

part
    : expression
    | ELLIPSIS                                  { $$ = tn_ast_gap(parse, @$); }
    ;

/* arithmetic over one tray */
tray_sum
    : tray_term
    | tray_sum PLUS tray_term                   { $$ = tn_ast_arithmetic(parse, TN_EXPR_PLUS, @$, $1, $3); }
    | tray_sum DASH tray_term                   { $$ = tn_ast_arithmetic(parse, TN_EXPR_MINUS, @$, $1, $3); }
    ;

tray_term
    : tray_signed
    | tray_term STAR tray_signed                { $$ = tn_ast_arithmetic(parse, TN_EXPR_TIMES, @$, $1, $3); }
    | tray_term SLASH tray_signed               { $$ = tn_ast_arithmetic(parse, TN_EXPR_OVER, @$, $1, $3); }
    ;

tray_signed
    : tray_atom
    | DASH tray_signed                          { $$ = tn_ast_of(parse, TN_EXPR_NEGATIVE, @$, tn_ast_one($2)); }
    ;

tray_atom
    : NAME                                      { $$ = tn_ast_figure(parse, @$, $1, NULL); }
    | NAME NAME                                 { $$ = tn_ast_figure(parse, @$, $1, $2); }
    | head_number
    | OPEN tray_sum CLOSE                       { $$ = $2; }
    | MIN OPEN tray_sum COMMA tray_sum CLOSE    { $$ = tn_ast_arithmetic(parse, TN_EXPR_LEAST, @$, $3, $5); }
    | MAX OPEN tray_sum COMMA tray_sum CLOSE    { $$ = tn_ast_arithmetic(parse, TN_EXPR_MOST, @$, $3, $5); }
    ;

/* ---- conditions on a number */

condition
    : cond_and
    | cond_ors
    ;

cond_ors
    : cond_and OR cond_and                      { $$ = tn_ast_cond_join(parse, TN_COND_OR, $1, $3); }
    | cond_ors OR cond_and                      { $$ = tn_ast_cond_add(parse, $1, $3); }
    ;

cond_and
    : cond_not
    | cond_ands
    ;

cond_ands
    : cond_not AND cond_not                     { $$ = tn_ast_cond_join(parse, TN_COND_AND, $1, $3); }
    | cond_ands AND cond_not                    { $$ = tn_ast_cond_add(parse, $1, $3); }
    ;

cond_not
    : NOT cond_not                              { $$ = tn_ast_cond_not(parse, @$, $2); }
    | cond_atom
    ;

cond_atom
    : OPEN condition CLOSE                      { $$ = $2; }
    | compare
    | compare comparison operand                { $$ = tn_ast_chained(parse, @$, $1, $2, $3); }
    | operand IN range                          { $$ = tn_ast_within(parse, @$, $1, $3); }
    | operand MOD constant comparison operand   { $$ = tn_ast_remainder(parse, @$, $1, $3, $4, $5); }
    ;

compare
    : operand comparison operand                { $$ = tn_ast_compare(parse, @$, $1, $2, $3); }
    ;

operand
    : NAME
    | constant
    ;

constant
    : NUMBER
    | LENGTH
    | AREA
    | DECIMAL
    | DASH NUMBER                               { $$ = tn_ast_negative(parse, @$, $2); }
    | DASH LENGTH                               { $$ = tn_ast_negative(parse, @$, $2); }
    | DASH AREA                                 { $$ = tn_ast_negative(parse, @$, $2); }
    | DASH DECIMAL                              { $$ = tn_ast_negative(parse, @$, $2); }
    ;

range
    : constant                                  { $$ = tn_ast_range_new(@$, $1, $1); }
    | constant DOTS constant                    { $$ = tn_ast_range_new(@$, $1, $3); }
    | constant DASH constant                    { $$ = tn_ast_range_dash(parse, @$, $1, $3); }
    ;

comparison
    : LESS                                      { $$ = TN_LESS; }
    | AT_MOST                                   { $$ = TN_AT_MOST; }
    | EQUAL                                     { $$ = TN_EQUAL; }
    | UNEQUAL                                   { $$ = TN_UNEQUAL; }
    | AT_LEAST                                  { $$ = TN_AT_LEAST; }
    | GREATER                                   { $$ = TN_GREATER; }
    ;

/* ---- libraries */

library_head
    : library NAME doc using                    { $$ = (tn_ast_library){.name = $2, .doc = $3, .using = $4}; }
    | library NAME doc using FROM NAME          { $$ = (tn_ast_library){.name = $2, .doc = $3, .using = $4, .from = $6}; }
    | library NAME doc using FROM NAME IN NAME  { $$ = (tn_ast_library){.name = $2, .doc = $3, .using = $4, .from = $6, .in = $8}; }
    | library NAME doc using FROM NAME ONTO NAME
                                                { $$ = (tn_ast_library){.name = $2, .doc = $3, .using = $4, .from = $6, .onto = $8, .projected = tn_span_join(@5, @8)}; }
    ;

clauses
    : %empty                                    { $$ = tn_ast_empty(); }
    | clauses clause                            { $$ = tn_ast_join($1, $2); }
    | clauses error                             { $$ = tn_ast_skipped($1, parse); }
    ;

clause
    : trays_word range                          { $$ = tn_ast_one(tn_ast_trays(parse, @$, $2)); }
    | total_word total_field range doc          { $$ = tn_ast_one(tn_ast_total_range(parse, @$, $2, $3, $4)); }
    | total_word total_field comparison constant doc
                                                { $$ = tn_ast_one(tn_ast_total_compare(parse, @$, $2, $3, $4, $5)); }
    | require_word requires                     { $$ = $2; }
    | prune_word prunes                         { $$ = $2; }
    | generate_word require                     { $$ = tn_ast_one(tn_ast_generate($2)); }
    | prefer_word preferences                   { $$ = $2; }
    | weight_word expression                    { $$ = tn_ast_one(tn_ast_weight(parse, @$, $2, NULL)); }
    | weight_word expression positive           { $$ = tn_ast_one(tn_ast_weight(parse, @$, $2, $3)); }
    | allow_word names                          { $$ = tn_ast_one(tn_ast_allow(parse, @$, $2)); }
    ;

trays_word: TRAYS                               { yyerrok; };
total_word: TOTAL                               { yyerrok; };
require_word: REQUIRE                           { yyerrok; };
prune_word: PRUNE                               { yyerrok; };
generate_word: GENERATE                         { yyerrok; };
prefer_word: PREFER                             { yyerrok; };
weight_word: WEIGHT                             { yyerrok; };
allow_word: ALLOW                               { yyerrok; };

total_field
    : %empty                                    { $$ = tn_ast_empty(); }
    | NAME                                      { $$ = tn_ast_one($1); }
    | NAME NAME                                 { $$ = tn_ast_append(tn_ast_one($1), $2); }
    ;

preferences
    : preference                                { $$ = tn_ast_one($1); }
    | preferences COMMA preference              { $$ = tn_ast_append($1, $3); }
    ;

preference
    : expression worth doc                      { $$ = tn_ast_preference(parse, @$, $1, $2, NULL, $3); }
    | expression worth AS NAME doc              { $$ = tn_ast_preference(parse, @$, $1, $2, $4, $5); }
    ;

worth
    : %empty                                    { $$ = NULL; }
    | WORTH positive                            { $$ = $2; }
    ;

/* A number above 0; what it is not is told by the checker. */
positive
    : NUMBER
    | DECIMAL
    | LENGTH
    | AREA
    ;

requires
    : require                                   { $$ = tn_ast_one($1); }
    | requires COMMA require                    { $$ = tn_ast_append($1, $3); }
    ;

require
    : expression doc                            { $$ = tn_ast_require(parse, @$, $1, $2); }
    ;

prunes
    : prune                                     { $$ = tn_ast_one($1); }
    | prunes COMMA prune                        { $$ = tn_ast_append($1, $3); }
    ;

prune
    : expression                                { $$ = tn_ast_prune(parse, @$, $1, NULL, NULL); }
    | expression AS NAME doc                    { $$ = tn_ast_prune(parse, @$, $1, $3, $4); }
    ;

/* ---- forms */

form_head
    : form NAME doc OF NAME                     { $$ = (tn_ast_form){.name = $2, .doc = $3, .schema = $5}; }
    ;

form_clauses
    : %empty                                    { $$ = tn_ast_empty(); }
    | form_clauses form_clause                  { $$ = tn_ast_append($1, $2); }
    | form_clauses error                        { $$ = tn_ast_skipped($1, parse); }
    ;

form_clause
    : storey NAME doc size                      { $$ = tn_ast_form_clause_new(parse, @$, (tn_ast_form_clause){.part = TN_PART_STOREY, .name = $2, .doc = $3, .length = $4}); }
    | spine NAME                                { $$ = tn_ast_form_clause_new(parse, @$, (tn_ast_form_clause){.part = TN_PART_SPINE, .name = $2}); }
    | thickness size                            { $1.length = $2; $$ = tn_ast_form_clause_new(parse, @$, $1); }
    | thickness size OPEN_BRACE CLOSE_BRACE     { $1.length = $2; $1.layered = tn_span_join(@3, @4); $$ = tn_ast_form_clause_new(parse, @$, $1); }
    | thickness size OPEN_BRACE layers CLOSE_BRACE
                                                { $1.length = $2; $1.layered = tn_span_join(@3, @5); $1.parts = $4; $$ = tn_ast_form_clause_new(parse, @$, $1); }
    | thickness size OPEN_BRACE error CLOSE_BRACE
                                                { $1.length = $2; $$ = tn_ast_form_clause_new(parse, @$, $1); yyerrok; }
    | option EQUAL shapes                       { $$ = tn_ast_form_clause_new(parse, @$, (tn_ast_form_clause){.part = TN_PART_SECTION, .name = $1, .list = $3}); }
    | option NAME EQUAL shapes                  { $$ = tn_ast_form_clause_new(parse, @$, (tn_ast_form_clause){.part = TN_PART_SECTION, .name = $1, .detail = $2, .list = $4}); }
    | forbid_word options                       { $$ = tn_ast_form_clause_new(parse, @$, (tn_ast_form_clause){.part = TN_PART_FORBID, .first = $2}); }
    | void cells                                { $$ = tn_ast_form_clause_new(parse, @$, (tn_ast_form_clause){.part = TN_PART_VOID, .first = $2}); }
    | no cells                                  { $$ = tn_ast_form_clause_new(parse, @$, (tn_ast_form_clause){.part = TN_PART_NO, .first = $2}); }
    | function NAME doc AT cells                { $$ = tn_ast_form_clause_new(parse, @$, (tn_ast_form_clause){.part = TN_PART_FUNCTION, .name = $2, .doc = $3, .first = $5}); }
    | function NAME doc OUTDOOR AT cells        { $$ = tn_ast_form_clause_new(parse, @$, (tn_ast_form_clause){.part = TN_PART_FUNCTION, .name = $2, .doc = $3, .outdoor = true, .first = $6}); }
    | opening NAME doc WIDE size HIGH size opening_parts
                                                { $$ = tn_ast_form_clause_new(parse, @$, (tn_ast_form_clause){.part = TN_PART_OPENING, .name = $2, .doc = $3, .length = $5, .high = $7, .parts = $8}); }
    | flight NAME doc WIDE size RISE size DOTS size going turn winders
                                                { $$ = tn_ast_form_clause_new(parse, @$, (tn_ast_form_clause){.part = TN_PART_FLIGHT, .name = $2, .doc = $3, .length = $5, .low = $7, .high = $9, .going = $10, .detail = $11, .winders = $12}); }
    | beam NAME doc WIDE size HIGH size SPAN size
                                                { $$ = tn_ast_form_clause_new(parse, @$, (tn_ast_form_clause){.part = TN_PART_BEAM, .name = $2, .doc = $3, .length = $5, .high = $7, .going = $9}); }
    | face cells relation cells EQUAL kinds     { $3.first = $2; $3.second = $4; $3.list = $6; $$ = tn_ast_form_clause_new(parse, @$, $3); }
    | face cells OUTSIDE outside_side EQUAL kinds
                                                { $$ = tn_ast_form_clause_new(parse, @$, (tn_ast_form_clause){.part = TN_PART_FACE, .relation = TN_FACE_OUTSIDE, .first = $2, .detail = $4, .list = $6}); }
    | tile NAME doc FOR names OPEN_BRACE tile_parts CLOSE_BRACE
                                                { $$ = tn_ast_form_clause_new(parse, @$, (tn_ast_form_clause){.part = TN_PART_TILE, .name = $2, .doc = $3, .list = $5, .parts = $7}); }
    | tile NAME doc FOR names OPEN_BRACE tile_parts error CLOSE_BRACE
                                                { $$ = tn_ast_form_clause_new(parse, @$, (tn_ast_form_clause){.part = TN_PART_TILE, .name = $2, .doc = $3, .list = $5, .parts = tn_ast_skipped($7, parse)}); yyerrok; }
    | way size                                  { $$ = tn_ast_form_clause_new(parse, @$, (tn_ast_form_clause){.part = TN_PART_WAY, .length = $2}); }
    | way size FOR names                        { $$ = tn_ast_form_clause_new(parse, @$, (tn_ast_form_clause){.part = TN_PART_WAY, .length = $2, .list = $4}); }
    | headroom size                             { $$ = tn_ast_form_clause_new(parse, @$, (tn_ast_form_clause){.part = TN_PART_HEADROOM, .length = $2}); }
    | guard size                                { $$ = tn_ast_form_clause_new(parse, @$, (tn_ast_form_clause){.part = TN_PART_GUARD, .length = $2}); }
    | allow_word names                          { $$ = tn_ast_form_clause_new(parse, @$, (tn_ast_form_clause){.part = TN_PART_ALLOW, .list = $2}); }
    | material NAME STRING price FOR names material_where
                                                { $4.name = $2; $4.doc = $3; $4.list = $6; $4.first = $7; $$ = tn_ast_form_clause_new(parse, @$, $4); }
    | classification STRING FOR classes         { $$ = tn_ast_form_clause_new(parse, @$, (tn_ast_form_clause){.part = TN_PART_CLASSIFICATION, .doc = $2, .parts = $4}); }
    ;

storey: STOREY                                  { yyerrok; };
spine: SPINE                                    { yyerrok; };
option: OPTION NAME                             { $$ = $2; yyerrok; }; /* not that of `where option(...)` */
void: VOID                                      { yyerrok; };
no: NO                                          { yyerrok; };
function: FUNCTION                              { yyerrok; };
opening: OPENING                                { yyerrok; };
flight: FLIGHT                                  { yyerrok; };
beam: BEAM                                      { yyerrok; };
way: WAY                                        { yyerrok; };
headroom: HEADROOM                              { yyerrok; };
guard: GUARD                                    { yyerrok; };
face: FACE                                      { yyerrok; };
tile: TILE                                      { yyerrok; };
material: MATERIAL                              { yyerrok; };
classification: CLASSIFICATION                  { yyerrok; };

going
    : %empty                                    { $$ = NULL; } /* a spiral needs none */
    | GOING size                                { $$ = $2; }
    ;

turn
    : %empty                                    { $$ = NULL; }
    | TURN NAME                                 { $$ = $2; }
    ;

winders
    : %empty                                    { $$ = NULL; }
    | WINDERS number                            { $$ = $2; }
    ;

price
    : %empty                                    { $$ = (tn_ast_form_clause){.part = TN_PART_MATERIAL}; }
    | PRICE number PER NAME                     { $$ = (tn_ast_form_clause){.part = TN_PART_MATERIAL, .length = $2, .detail = $4}; }
    ;

number
    : NUMBER
    | DECIMAL
    ;

material_where
    : %empty                                    { $$ = NULL; }
    | WHERE options                             { $$ = $2; }
    ;

thickness
    : WALL                                      { $$ = (tn_ast_form_clause){.part = TN_PART_WALL}; yyerrok; }
    | WALL OUTSIDE                              { $$ = (tn_ast_form_clause){.part = TN_PART_WALL, .detail = tn_ast_word_new(parse, TN_WORD_NAME, @2, "outside", TN_LAYERED_OUTSIDE)}; yyerrok; }
    | WALL NAME                                 { $$ = (tn_ast_form_clause){.part = TN_PART_WALL, .detail = $2}; yyerrok; }
    | PARTITION                                 { $$ = (tn_ast_form_clause){.part = TN_PART_PARTITION}; yyerrok; }
    | FLOOR                                     { $$ = (tn_ast_form_clause){.part = TN_PART_DECK}; yyerrok; }
    | ROOF                                      { $$ = (tn_ast_form_clause){.part = TN_PART_ROOF}; yyerrok; }
    ;

/* From the outside or from the first cell of a face inwards, from the top down. */
layers
    : layer                                     { $$ = tn_ast_one($1); }
    | layers COMMA layer                        { $$ = tn_ast_append($1, $3); }
    ;

layer
    : NAME size                                 { $$ = tn_ast_layer_new(parse, @$, $1, $2); }
    ;

classes
    : class                                     { $$ = tn_ast_one($1); }
    | classes COMMA class                       { $$ = tn_ast_append($1, $3); }
    ;

class
    : NAME STRING doc                           { $$ = tn_ast_class_new(parse, @$, $1, $2, $3); }
    ;

relation
    : BESIDE                                    { $$ = (tn_ast_form_clause){.part = TN_PART_FACE, .relation = TN_FACE_BESIDE}; }
    | ALONG                                     { $$ = (tn_ast_form_clause){.part = TN_PART_FACE, .relation = TN_FACE_ALONG}; }
    | ACROSS                                    { $$ = (tn_ast_form_clause){.part = TN_PART_FACE, .relation = TN_FACE_ACROSS}; }
    | UNDER                                     { $$ = (tn_ast_form_clause){.part = TN_PART_FACE, .relation = TN_FACE_UNDER}; }
    ;

outside_side
    : %empty                                    { $$ = NULL; }
    | side
    ;

side
    : LEFT                                      { $$ = tn_ast_word_new(parse, TN_WORD_NAME, @$, "left", TN_HOUSE_LEFT); }
    | RIGHT                                     { $$ = tn_ast_word_new(parse, TN_WORD_NAME, @$, "right", TN_HOUSE_RIGHT); }
    | BACK                                      { $$ = tn_ast_word_new(parse, TN_WORD_NAME, @$, "back", TN_HOUSE_BACK); }
    | FRONT                                     { $$ = tn_ast_word_new(parse, TN_WORD_NAME, @$, "front", TN_HOUSE_FRONT); }
    ;

size
    : LENGTH
    | NUMBER
    ;

shapes
    : shape                                     { $$ = tn_ast_one($1); }
    | shapes BAR shape                          { $$ = tn_ast_append($1, $3); }
    ;

shape
    : NUMBER                                    { $$ = tn_ast_shape_new(parse, @$, $1, tn_ast_empty()); }
    | NAME                                      { $$ = tn_ast_shape_new(parse, @$, $1, tn_ast_empty()); }
    | NAME OPEN arguments CLOSE                 { $$ = tn_ast_shape_new(parse, @$, $1, $3); }
    ;

arguments
    : argument                                  { $$ = tn_ast_one($1); }
    | arguments COMMA argument                  { $$ = tn_ast_append($1, $3); }
    ;

argument
    : NAME                                      { $$ = tn_ast_argument_new(parse, @$, $1, NULL); }
    | LENGTH                                    { $$ = tn_ast_argument_new(parse, @$, $1, NULL); }
    | NUMBER COLON NUMBER                       { $$ = tn_ast_argument_new(parse, @$, $1, $3); }
    | NAME LENGTH                               { $$ = tn_ast_argument_new(parse, @$, $1, $2); }
    ;

kinds
    : NAME                                      { $$ = tn_ast_one($1); }
    | kinds BAR NAME                            { $$ = tn_ast_append($1, $3); }
    ;

opening_parts
    : %empty                                    { $$ = tn_ast_empty(); }
    | opening_parts opening_part                { $$ = tn_ast_append($1, $2); }
    ;

opening_part
    : SILL size                                 { $$ = tn_ast_opening_part_new(parse, @$, (tn_ast_opening_part){.part = TN_OPENING_SILL, .length = $2}); }
    | CLEAR size                                { $$ = tn_ast_opening_part_new(parse, @$, (tn_ast_opening_part){.part = TN_OPENING_CLEAR, .length = $2}); }
    | NEAR side size                            { $$ = tn_ast_opening_part_new(parse, @$, (tn_ast_opening_part){.part = TN_OPENING_NEAR, .side = $2, .length = $3}); }
    | PASSAGE                                   { $$ = tn_ast_opening_part_new(parse, @$, (tn_ast_opening_part){.part = TN_OPENING_PASSAGE}); }
    | GLAZED                                    { $$ = tn_ast_opening_part_new(parse, @$, (tn_ast_opening_part){.part = TN_OPENING_GLAZED}); }
    | LEAFLESS                                  { $$ = tn_ast_opening_part_new(parse, @$, (tn_ast_opening_part){.part = TN_OPENING_LEAFLESS}); }
    | SLIDING                                   { $$ = tn_ast_opening_part_new(parse, @$, (tn_ast_opening_part){.part = TN_OPENING_SLIDING}); }
    ;

tile_parts
    : %empty                                    { $$ = tn_ast_empty(); }
    | tile_parts tile_part                      { $$ = tn_ast_append($1, $2); }
    ;

tile_part
    : AGAINST or_names                          { $$ = tn_ast_tile_part_new(parse, @$, (tn_ast_tile_part){.part = TN_TILE_AGAINST, .list = $2}); }
    | WIDE size DOTS size                       { $$ = tn_ast_tile_part_new(parse, @$, (tn_ast_tile_part){.part = TN_TILE_WIDE, .low = $2, .high = $4}); }
    | DEEP size DOTS size                       { $$ = tn_ast_tile_part_new(parse, @$, (tn_ast_tile_part){.part = TN_TILE_DEEP, .low = $2, .high = $4}); }
    | stretch_word NAME doc drawn               { $1.name = $2; $1.doc = $3; $1.symbol = $4.symbol; $1.lines = $4.lines; $$ = tn_ast_tile_part_new(parse, @$, $1); }
    | stretch_word NAME doc reaches drawn       { $1.name = $2; $1.doc = $3; $1.list = $4; $1.symbol = $5.symbol; $1.lines = $5.lines; $$ = tn_ast_tile_part_new(parse, @$, $1); }
    ;

drawn
    : %empty                                    { $$ = (tn_ast_tile_part){.symbol = NULL}; }
    | SYMBOL NAME                               { $$ = (tn_ast_tile_part){.symbol = $2}; }
    | SYMBOL OPEN_BRACE symbol_lines CLOSE_BRACE
                                                { $$ = (tn_ast_tile_part){.lines = $3}; }
    ;

symbol_lines
    : symbol_line                               { $$ = tn_ast_one($1); }
    | symbol_lines symbol_line                  { $$ = tn_ast_append($1, $2); }
    ;

symbol_line
    : LINE line_end DOTS line_end               { $$ = tn_ast_symbol_line_new(parse, @$, $2, $4); }
    ;

line_end
    : side_word size COMMA side_word size       { $$ = (tn_ast_symbol_line){.sides = {{$1, $4}}, .lengths = {{$2, $5}}}; }
    ;

stretch_word
    : ITEM                                      { $$ = (tn_ast_tile_part){.part = TN_TILE_ITEM}; }
    | KEEP                                      { $$ = (tn_ast_tile_part){.part = TN_TILE_KEEPS}; }
    ;

or_names
    : NAME                                      { $$ = tn_ast_one($1); }
    | or_names OR NAME                          { $$ = tn_ast_append($1, $3); }
    ;

reaches
    : reach                                     { $$ = tn_ast_one($1); }
    | reaches COMMA reach                       { $$ = tn_ast_append($1, $3); }
    ;

reach
    : side_word size DOTS size                  { $$ = tn_ast_reach_new(parse, @$, (tn_ast_reach){.from = $1, .to = $1, .low = $2, .high = $4}); }
    | side_word size DOTS side_word size        { $$ = tn_ast_reach_new(parse, @$, (tn_ast_reach){.from = $1, .to = $4, .low = $2, .high = $5}); }
    ;

side_word
    : LEFT                                      { $$ = TN_BOX_LEFT; }
    | RIGHT                                     { $$ = TN_BOX_RIGHT; }
    | BACK                                      { $$ = TN_BOX_BACK; }
    | FRONT                                     { $$ = TN_BOX_FRONT; }
    | UP                                        { $$ = TN_BOX_UP; }
    ;

/* what cells are, with and, or, not */

cells
    : cell_and
    | cell_ors
    ;

cell_ors
    : cell_and OR cell_and                      { $$ = tn_ast_expr_join(parse, TN_EXPR_OR, $1, $3); }
    | cell_ors OR cell_and                      { $$ = tn_ast_expr_add(parse, $1, $3); }
    ;

cell_and
    : cell_not
    | cell_ands
    ;

cell_ands
    : cell_not AND cell_not                     { $$ = tn_ast_expr_join(parse, TN_EXPR_AND, $1, $3); }
    | cell_ands AND cell_not                    { $$ = tn_ast_expr_add(parse, $1, $3); }
    ;

cell_not
    : NOT cell_not                              { $$ = tn_ast_of(parse, TN_EXPR_NOT, @$, tn_ast_one($2)); }
    | OPEN cells CLOSE                          { $$ = $2; }
    | CELL OPEN specifier CLOSE                 { $$ = tn_ast_house_leaf(parse, TN_EXPR_CELL, @$, $3); }
    ;

/* what options are */

options
    : option_and
    | option_ors
    ;

option_ors
    : option_and OR option_and                  { $$ = tn_ast_expr_join(parse, TN_EXPR_OR, $1, $3); }
    | option_ors OR option_and                  { $$ = tn_ast_expr_add(parse, $1, $3); }
    ;

option_and
    : option_not
    | option_ands
    ;

option_ands
    : option_not AND option_not                 { $$ = tn_ast_expr_join(parse, TN_EXPR_AND, $1, $3); }
    | option_ands AND option_not                { $$ = tn_ast_expr_add(parse, $1, $3); }
    ;

option_not
    : NOT option_not                            { $$ = tn_ast_of(parse, TN_EXPR_NOT, @$, tn_ast_one($2)); }
    | OPEN options CLOSE                        { $$ = $2; }
    | OPTION OPEN option_items CLOSE            { $$ = tn_ast_house_leaf(parse, TN_EXPR_SECTION, @$, $3); }
    ;

option_items
    : option_item                               { $$ = tn_ast_one($1); }
    | option_items COMMA option_item            { $$ = tn_ast_append($1, $3); }
    ;

option_item
    : option_alternatives                       { $$ = tn_ast_item_new(parse, @$, $1); }
    ;

option_alternatives
    : option_alternative                        { $$ = tn_ast_one($1); }
    | option_alternatives OR option_alternative
                                                { $$ = tn_ast_append($1, $3); }
    ;

/* [not] [choice] value */
option_alternative
    : shape                                     { $$ = tn_ast_alternative_new(parse, @$, tn_ast_one($1)); }
    | NAME option_alternative                   { $$ = tn_ast_alternative_word(parse, @$, $1, $2); }
    | NOT option_alternative                    { $$ = tn_ast_alternative_word(parse, @$, tn_ast_not_word(parse, @1), $2); }
    ;

/* ---- tests */

cases
    : %empty                                    { $$ = tn_ast_empty(); }
    | cases any_case                            { $$ = tn_ast_append($1, $2); }
    | cases error                               { $$ = $1; }
    ;

any_case
    : case
    | todo_word case                            { $$ = tn_ast_case_todo($2); }
    ;

value_word: VALUE                               { yyerrok; };
todo_word: TODO                                 { yyerrok; };

case
    : expectations plan doc                     { $$ = tn_ast_case_new(parse, @$, $1, $2, $3, tn_ast_empty()); }
    | value_word plan EQUAL additive doc        { $$ = tn_ast_value_case(parse, @$, $2, $4, $5); }
    | expectations plan STRING BY clause_names  { $$ = tn_ast_case_new(parse, @$, $1, $2, $3, $5); }
    | expectations plan BY clause_names doc     { $$ = tn_ast_case_new(parse, @$, $1, $2, $5, $4); }
    ;

expectations
    : expectation                               { $$ = tn_ast_one($1); }
    | expectations expectation                  { $$ = tn_ast_append($1, $2); }
    ;

expectation
    : MATCH                                     { $$ = tn_ast_expect(parse, @$, "match", TN_EXPECT_MATCH); yyerrok; }
    | REJECT                                    { $$ = tn_ast_expect(parse, @$, "reject", TN_EXPECT_REJECT); yyerrok; }
    | KEEP                                      { $$ = tn_ast_expect(parse, @$, "keep", TN_EXPECT_KEEP); yyerrok; }
    | DROP                                      { $$ = tn_ast_expect(parse, @$, "drop", TN_EXPECT_DROP); yyerrok; }
    ;

plan
    : OPEN_BRACKET trays CLOSE_BRACKET          { $$ = (tn_ast_literal){.trays = $2}; }
    | OPEN_BRACKET HOUSE CLOSE_BRACKET          { $$ = (tn_ast_literal){.house = $2}; }
    ;

trays
    : literal_tray                              { $$ = tn_ast_one($1); }
    | trays BAR literal_tray                    { $$ = tn_ast_append($1, $3); }
    ;

literal_tray
    : words                                     { $$ = tn_ast_literal_tray(parse, @$, $1); }
    ;

words
    : %empty                                    { $$ = tn_ast_empty(); }
    | words literal_word                        { $$ = tn_ast_append($1, $2); }
    ;

literal_word
    : NAME
    | NUMBER
    | LENGTH
    | AREA
    | DECIMAL
    | NOT                                       { $$ = tn_ast_not_word(parse, @$); }
    | ABSENT                                    { $$ = tn_ast_word_new(parse, TN_WORD_ABSENT, @$, "-", 0); }
    | OF_DEPTH                                  { $$ = tn_ast_word_new(parse, TN_WORD_OF_DEPTH, @$, ":", 0); }
    ;

clause_names
    : clause_name                               { $$ = tn_ast_one($1); }
    | clause_names COMMA clause_name            { $$ = tn_ast_append($1, $3); }
    ;

clause_name
    : NAME
    | CLAUSE_NAME
    | TRAYS                                     { $$ = tn_ast_word_new(parse, TN_WORD_NAME, @$, "trays", 0); }
    | TOTAL                                     { $$ = tn_ast_word_new(parse, TN_WORD_NAME, @$, "total", 0); }
    ;

%%

/* Only "memory exhausted" comes here: the stack's limit is far beyond the limit on nesting. */
static void tn_plan_error(const tn_span *span, tn_parse *parse, void *scanner, const char *message)
{
    (void)scanner;
    (void)message;
    tn_ast_too_deep(parse, *span);
}

/* Is this something that could stand here, and hardly ever does? It is not named where others are. */
static bool is_rare(const tn_parse *parse, yysymbol_kind_t kind, int before)
{
    bool named_range = kind == YYSYMBOL_DOTS && before == TN_PLAN_NAME;
    bool order = kind == YYSYMBOL_LESS && parse->mode == TN_LEX_SCHEMA;
    bool sign = (parse->mode == TN_LEX_TRAY || parse->mode == TN_LEX_PATTERN || parse->in_tray) && (kind == YYSYMBOL_PLUS || kind == YYSYMBOL_DASH || kind == YYSYMBOL_STAR || kind == YYSYMBOL_SLASH);
    return named_range || order || sign;
}

static int yyreport_syntax_error(const yypcontext_t *context, tn_parse *parse, void *scanner)
{
    (void)scanner;
    enum { EXPECTED_MAX = 80 };
    yysymbol_kind_t kinds[EXPECTED_MAX];
    const char *expected[EXPECTED_MAX];
    int count = yypcontext_expected_tokens(context, kinds, EXPECTED_MAX);
    if (count < 0)
        return count;
    yysymbol_kind_t found = yypcontext_token(context);
    int before = found == YYSYMBOL_YYEOF ? parse->last_token : parse->token_before, named = 0;
    for (int i = 0; i < count; i++)
        if (!is_rare(parse, kinds[i], before))
            expected[named++] = yysymbol_name(kinds[i]);
    tn_syntax_found token = {*yypcontext_location(context), found == YYSYMBOL_YYEMPTY ? "" : yysymbol_name(found),
                      parse->token_before == TN_PLAN_NAME ? parse->span_before : (tn_span){0}};
    tn_syntax_error(parse, &token, expected, (size_t)named);
    return 0;
}

static tn_ast_file *parse_source(tn_arena *arena, tn_diagnostics *diagnostics, uint32_t file, tn_tokens *tokens, tn_parse_what what)
{
    const tn_source *source = &diagnostics->sources->files[file];
    tn_parse parse = {.arena = arena, .diagnostics = diagnostics, .text = source->text, .size = source->size, .file = file,
                      .tokens = tokens};
    parse.result = TN_NEW(arena, tn_ast_file);
    if (!parse.result || !tn_text_check(diagnostics, file))
        return parse.result ? tn_ast_unread(parse.result) : NULL;
    yyscan_t scanner;
    parse.offset = (uint32_t)tn_text_mark(source->text, source->size);
    static const int first[] = {[TN_PARSE_FILE] = 0, [TN_PARSE_EXPRESSION] = TN_PLAN_ONE_EXPRESSION, [TN_PARSE_PATTERN] = TN_PLAN_ONE_PATTERN,
                                [TN_PARSE_LITERAL] = TN_PLAN_ONE_LITERAL, [TN_PARSE_SETTING] = TN_PLAN_ONE_SETTING};
    parse.held_token = first[what];
    parse.held_span = (tn_span){file, parse.offset, parse.offset};
    size_t size = source->size - parse.offset;
    char *text = tn_arena_alloc(arena, size + 2); /* flex marks its tokens in the text, and wants two zero bytes after it */
    if (!text || tn_plan_lex_init_extra(&parse, &scanner) != 0)
        return NULL;
    memcpy(text, source->text + parse.offset, size);
    bool scanned = tn_plan__scan_buffer(text, size + 2, scanner) != NULL;
    int outcome = scanned ? tn_plan_parse(&parse, scanner) : 2;
    tn_plan_lex_destroy(scanner);
    if (outcome == 2 && !parse.too_deep)
        return NULL;
    parse.result->broken |= outcome != 0;
    return tn_arena_failed(arena) ? NULL : parse.result;
}

tn_ast_file *tn_parse_plan(tn_arena *arena, tn_diagnostics *diagnostics, uint32_t file, tn_tokens *tokens)
{
    return parse_source(arena, diagnostics, file, tokens, TN_PARSE_FILE);
}

tn_ast_file *tn_parse_plan_part(tn_arena *arena, tn_diagnostics *diagnostics, uint32_t file, tn_parse_what what)
{
    return parse_source(arena, diagnostics, file, NULL, what);
}
