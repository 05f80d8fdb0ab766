/* The grammar of .solid files (docs/solid-language.md): designs, which are statements in braces. After an error the parser goes on
 * at the next `;` or closing brace. */
%require "3.8"
%define api.pure full
%define api.prefix {tn_solid_}
%define api.token.prefix {TN_SOLID_T_}
%define api.location.type {tn_span}
%define parse.error custom
%define parse.lac full
%locations
%expect 0

%code requires {
#include "compiler/solid/solid.h"
}

%parse-param {tn_parsing *parse} {void *scanner}
%lex-param {void *scanner}

%code {
#include "solid_lexer.h"

#define YYLLOC_DEFAULT(CURRENT, RHS, N)                                                                                \
    ((CURRENT) = (N) ? tn_span_join(YYRHSLOC(RHS, 1), YYRHSLOC(RHS, N))                                                \
                     : (tn_span){YYRHSLOC(RHS, 0).file, YYRHSLOC(RHS, 0).end, YYRHSLOC(RHS, 0).end})

int tn_solid_lex(TN_SOLID_STYPE *value, tn_span *span, void *scanner);
static void tn_solid_error(const tn_span *span, tn_parsing *parse, void *scanner, const char *message);
static tn_solid_item *with_entries(tn_parsing *parse, tn_solid_statement kind, tn_span span, tn_solid_entries entries);
static tn_solid_item *with_numbers(tn_parsing *parse, tn_solid_statement kind, tn_span span, tn_solid_number a, tn_solid_number b);
static tn_solid_item *with_parts(tn_parsing *parse, tn_solid_statement kind, tn_span span, tn_solid_text name, tn_solid_text doc,
                                 tn_solid_part *parts);
static tn_solid_item *goal(tn_parsing *parse, tn_span span, tn_solid_text name, tn_expression *expression, tn_solid_item *parts);
static tn_solid_item *goal_part(tn_parsing *parse, tn_solid_item *item, tn_span span, int which, tn_solid_number number);
static void missing_end(tn_parsing *parse, tn_span place);
static tn_solid_part *part(tn_parsing *parse, tn_solid_part_kind kind, tn_span span, tn_solid_part *before, tn_solid_vector a,
                           tn_solid_vector b);
static tn_solid_entry *entry_of(tn_parsing *parse, tn_span span, tn_expression *expression);
static tn_solid_entry *entry_of_number(tn_parsing *parse, tn_solid_number number);
static tn_solid_entry *entry_of_axis(tn_parsing *parse, tn_solid_text axis);
static tn_expression *number_of(tn_parsing *parse, tn_solid_number number);
static tn_expression *of_two(tn_parsing *parse, tn_opcode op, tn_span span, tn_expression *a, tn_expression *b);
static void end_design(tn_parsing *parse, tn_solid_design *design, tn_solid_text name, tn_solid_text doc, tn_solid_text base, tn_span span);
}

%union {
    tn_solid_number number;
    tn_solid_text text;
    tn_solid_vector vector;
    tn_solid_item *item;
    tn_solid_part *part;
    tn_solid_entry *entry;
    tn_solid_entries entries;
    tn_solid_design *design;
    tn_expression *expression;
}

%token END_OF_FILE 0 "the end of the file"
%token <number> NUMBER "a number" LENGTH "a length"
%token <text> STRING "a text in quotes" NAME "a name"
%token USE "`use`" SOLID "`solid`" FROM "`from`" SYMMETRY "`symmetry`" FLAT "`flat`" NOCLIP "`noclip`" CORRECT "`correct`"
%token PENETRATION "`penetration`" UNIT "`unit`" MODEL "`model`" BOX "`box`" GENES "`genes`" MEASURE "`measure`"
%token REQUIRE "`require`" FITNESS "`fitness`" AT "`at`" SIZE "`size`" TO "`to`" CLIP "`clip`" NORMAL "`normal`"
%token THROUGH "`through`" ANGLES "`angles`" RIGID "`rigid`" TARGET "`target`" WEIGHT "`weight`"
%token COMMA "`,`" END "`;`" OPEN "`(`" CLOSE "`)`" OPEN_BRACE "`{`" CLOSE_BRACE "`}`"
%token EQUALS "`=`" PLUS "`+`" MINUS "`-`" STAR "`*`" SLASH "`/`"
%token BELOW "`<`" AT_MOST "`<=`" AT_LEAST "`>=`" ABOVE "`>`" UNEQUAL "`!=`" IN "`in`" TO_DOTS "`..`" AND "`and`" OR "`or`" NOT "`not`"
%left OR
%left AND
%precedence NOT
%nonassoc EQUALS BELOW AT_MOST AT_LEAST ABOVE UNEQUAL IN
%left PLUS MINUS
%left STAR SLASH
%precedence SIGN

%type <item> statement goal_parts
%type <design> statements
%type <part> parts
%type <vector> vector
%type <number> number
%type <text> doc base
%type <entry> condition
%type <entries> axes numbers expressions
%type <expression> expression call

%%

file
    : %empty
    | file USE STRING END                   { tn_solid_add_use(parse, $3); }
    | file SOLID NAME doc base OPEN_BRACE statements CLOSE_BRACE
                                            { yyerrok; end_design(parse, $7, $3, $4, $5, tn_span_join(@2, @8)); }
    | file SOLID error OPEN_BRACE statements CLOSE_BRACE
                                            { yyerrok; parse->damaged = true; }
    | file error END                        { yyerrok; parse->damaged = true; }
    | file error CLOSE_BRACE                { yyerrok; parse->damaged = true; }
    ;

doc
    : %empty                                { $$ = (tn_solid_text){0}; }
    | STRING
    ;

base
    : %empty                                { $$ = (tn_solid_text){0}; }
    | FROM NAME                             { $$ = $2; }
    ;

statements
    : %empty                                { $$ = tn_solid_design_new(parse); if (!$$) YYNOMEM; }
    | statements statement end              { $$ = $1; tn_solid_add_item($$, $2); }
    | statements error END                  { $$ = $1; yyerrok; parse->damaged = true; }
    ;

/* A forgotten `;` is said where it belongs, and the next statement is read as one. */
end
    : END
    | %empty                                { missing_end(parse, @$); }
    ;

statement
    : SYMMETRY axes                         { $$ = with_entries(parse, TN_SOLID_SETS_SYMMETRY, @$, $2); }
    | FLAT number                           { $$ = with_numbers(parse, TN_SOLID_SETS_FLAT, @$, $2, $2); }
    | NOCLIP                                { $$ = tn_solid_item_new(parse, TN_SOLID_SETS_NOCLIP, @$); }
    | CORRECT PENETRATION                   { $$ = tn_solid_item_new(parse, TN_SOLID_SETS_PENETRATION, @$); }
    | UNIT NUMBER SLASH NUMBER              { $$ = with_numbers(parse, TN_SOLID_SETS_UNIT, @$, $2, $4); }
    | MODEL NAME                            { $$ = with_parts(parse, TN_SOLID_SETS_MODEL, @$, $2, (tn_solid_text){0}, NULL); }
    | BOX NAME doc parts                    { $$ = with_parts(parse, TN_SOLID_BOX, @$, $2, $3, $4); }
    | GENES OPEN numbers CLOSE              { $$ = with_entries(parse, TN_SOLID_GENES, @$, $3); }
    | GENES OPEN numbers CLOSE RIGID        { $$ = with_entries(parse, TN_SOLID_GENES, @$, $3);
                                              if ($$) $$->parts = part(parse, TN_SOLID_RIGID, @5, NULL, (tn_solid_vector){0}, (tn_solid_vector){0}); }
    | MEASURE expressions                   { $$ = with_entries(parse, TN_SOLID_ASKS, @$, $2); }
    | REQUIRE expressions                   { $$ = with_entries(parse, TN_SOLID_REQUIRES, @$, $2); }
    | FITNESS NAME goal_parts               { $$ = goal(parse, @$, $2, NULL, $3); }
    | FITNESS NAME EQUALS expression goal_parts
                                            { $$ = goal(parse, @$, $2, $4, $5); }
    ;

axes
    : NAME                                  { $$ = tn_solid_entries_add((tn_solid_entries){0}, entry_of_axis(parse, $1)); }
    | axes COMMA NAME                       { $$ = tn_solid_entries_add($1, entry_of_axis(parse, $3)); }
    ;

numbers
    : number                                { $$ = tn_solid_entries_add((tn_solid_entries){0}, entry_of_number(parse, $1)); }
    | numbers COMMA number                  { $$ = tn_solid_entries_add($1, entry_of_number(parse, $3)); }
    ;

parts
    : %empty                                { $$ = NULL; }
    | parts AT vector                       { $$ = part(parse, TN_SOLID_AT, tn_span_join(@2, @3), $1, $3, $3); }
    | parts SIZE vector                     { $$ = part(parse, TN_SOLID_SIZE, tn_span_join(@2, @3), $1, $3, $3); }
    | parts FROM vector TO vector           { $$ = part(parse, TN_SOLID_FROM, tn_span_join(@2, @5), $1, $3, $5); }
    | parts CLIP NORMAL vector THROUGH vector
                                            { $$ = part(parse, TN_SOLID_CLIP_NORMAL, tn_span_join(@2, @6), $1, $4, $6); }
    | parts CLIP number ANGLES number COMMA number
                                            { tn_solid_vector raw = {{$3, $5, $7}, tn_span_join(@3, @7)};
                                              $$ = part(parse, TN_SOLID_CLIP_ANGLES, tn_span_join(@2, @7), $1, raw, raw); }
    | parts RIGID                           { $$ = part(parse, TN_SOLID_RIGID, @2, $1, (tn_solid_vector){0}, (tn_solid_vector){0}); }
    ;

vector
    : OPEN number COMMA number COMMA number CLOSE { $$ = (tn_solid_vector){{$2, $4, $6}, @$}; }
    ;

number
    : NUMBER
    | LENGTH
    | MINUS NUMBER                          { $$ = $2; $$.negative = true; $$.span = @$; }
    | MINUS LENGTH                          { $$ = $2; $$.negative = true; $$.span = @$; }
    ;

expressions
    : condition                             { $$ = tn_solid_entries_add((tn_solid_entries){0}, $1); }
    | expressions COMMA condition           { $$ = tn_solid_entries_add($1, $3); }
    ;

condition
    : expression                            { $$ = entry_of(parse, @$, $1); }
    ;

goal_parts
    : %empty                                { $$ = tn_solid_item_new(parse, TN_SOLID_AIMS, @$); }
    | goal_parts TARGET number              { $$ = goal_part(parse, $1, tn_span_join(@2, @3), 0, $3); }
    | goal_parts WEIGHT number              { $$ = goal_part(parse, $1, tn_span_join(@2, @3), 1, $3); }
    ;

expression
    : NUMBER                                { $$ = number_of(parse, $1); }
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

%%

static tn_solid_item *with_entries(tn_parsing *parse, tn_solid_statement kind, tn_span span, tn_solid_entries entries)
{
    tn_solid_item *item = tn_solid_item_new(parse, kind, span);
    if (item)
        item->entries = entries;
    return item;
}

static tn_solid_item *with_numbers(tn_parsing *parse, tn_solid_statement kind, tn_span span, tn_solid_number a, tn_solid_number b)
{
    tn_solid_item *item = tn_solid_item_new(parse, kind, span);
    if (item) {
        item->number[0] = a;
        item->number[1] = b;
    }
    return item;
}

static tn_solid_item *with_parts(tn_parsing *parse, tn_solid_statement kind, tn_span span, tn_solid_text name, tn_solid_text doc,
                                 tn_solid_part *parts)
{
    tn_solid_item *item = tn_solid_item_new(parse, kind, span);
    if (item) {
        item->name = name;
        item->doc = doc;
        item->parts = parts;
    }
    return item;
}

static tn_solid_item *goal(tn_parsing *parse, tn_span span, tn_solid_text name, tn_expression *expression, tn_solid_item *parts)
{
    if (!parts)
        return NULL;
    parts->span = span;
    parts->name = name;
    if (!expression)
        expression = tn_expression_name(parse->arena, name.span, name.text);
    parts->entries = tn_solid_entries_add(parts->entries, entry_of(parse, span, expression));
    return parts;
}

static tn_solid_item *goal_part(tn_parsing *parse, tn_solid_item *item, tn_span span, int which, tn_solid_number number)
{
    if (!item)
        return NULL;
    if (item->given[which].end > item->given[which].begin) {
        tn_diagnostic *d = tn_report(parse->diagnostics, E_SOLID_TWICE, span, "`%s` is there twice", which ? "weight" : "target");
        tn_note(parse->diagnostics, d, &item->given[which], "the first is here");
        tn_help(parse->diagnostics, d, "leave one of them out");
    }
    item->number[which] = number;
    item->given[which] = span;
    return item;
}

static tn_solid_part *part(tn_parsing *parse, tn_solid_part_kind kind, tn_span span, tn_solid_part *before, tn_solid_vector a,
                           tn_solid_vector b)
{
    tn_solid_part *made = tn_solid_part_new(parse, kind, span, before);
    if (made) {
        made->a = a;
        made->b = b;
    }
    return made;
}

static void missing_end(tn_parsing *parse, tn_span place)
{
    tn_diagnostic *d = tn_report(parse->diagnostics, E_UNEXPECTED, place, "`;` is missing here");
    tn_help(parse->diagnostics, d, "each statement ends with `;`");
    tn_replace_with(parse->diagnostics, d, ";");
}

static tn_solid_entry *entry_of(tn_parsing *parse, tn_span span, tn_expression *expression)
{
    tn_solid_entry *entry = tn_solid_entry_new(parse, span);
    if (entry)
        entry->expression = expression;
    return entry;
}

static tn_solid_entry *entry_of_number(tn_parsing *parse, tn_solid_number number)
{
    tn_solid_entry *entry = tn_solid_entry_new(parse, number.span);
    if (entry)
        entry->number = number;
    return entry;
}

static tn_solid_entry *entry_of_axis(tn_parsing *parse, tn_solid_text axis)
{
    tn_solid_entry *entry = tn_solid_entry_new(parse, axis.span);
    char letter = axis.text && axis.text[0] && !axis.text[1] ? (char)(axis.text[0] | 0x20) : 0;
    if (!entry)
        return NULL;
    entry->axis = letter >= 'x' && letter <= 'z' ? (uint32_t)(letter - 'x') : 3;
    if (entry->axis == 3) {
        tn_diagnostic *d = tn_report(parse->diagnostics, E_UNEXPECTED, axis.span, "`%.40s` is no axis", axis.text ? axis.text : "");
        tn_help(parse->diagnostics, d, "axes are x, y and z: `symmetry x, z;`");
        parse->damaged = true;
    }
    return entry;
}

static tn_expression *number_of(tn_parsing *parse, tn_solid_number number)
{
    return tn_expression_number(parse->arena, number.span, tn_parsing_number(parse, number.span).value);
}

static tn_expression *of_two(tn_parsing *parse, tn_opcode op, tn_span span, tn_expression *a, tn_expression *b)
{
    return tn_expression_of(parse->arena, op, span, a, b, NULL);
}

static void end_design(tn_parsing *parse, tn_solid_design *design, tn_solid_text name, tn_solid_text doc, tn_solid_text base, tn_span span)
{
    if (!design)
        return;
    design->name = name;
    design->doc = doc;
    design->base = base;
    design->span = span;
    tn_solid_add_design(parse, design);
}

static const char *likely_fix(yysymbol_kind_t found, yysymbol_kind_t before)
{
    if (found == YYSYMBOL_THROUGH)
        return "a plane goes through a point where its normal is given: `clip normal (1, 1, 0) through (2, 1, 0)`; with angles its "
               "distance from the box's centre is given: `clip 0.5 angles 45, 0`";
    if (found == YYSYMBOL_IN && before == YYSYMBOL_NUMBER)
        return "inches are written with their sign, and lengths have units after `model mm;` or another unit: `2\"`";
    switch (before) {
    case YYSYMBOL_SOLID: return "write a name: `solid table { ... }`";
    case YYSYMBOL_BOX: return "write a name: `box leg from (0, 0, 0) to (1, 7, 1);`";
    case YYSYMBOL_CLIP: return "write `clip normal (1, 1, 0) through (2, 1, 0)`, or `clip 0.5 angles 45, 0`";
    case YYSYMBOL_AT:
    case YYSYMBOL_SIZE:
    case YYSYMBOL_TO:
    case YYSYMBOL_NORMAL:
    case YYSYMBOL_THROUGH: return "three numbers stand here: `(1, 2, 3)`";
    case YYSYMBOL_CORRECT: return "write `correct penetration;`";
    case YYSYMBOL_UNIT: return "write `unit 1/1024;`";
    case YYSYMBOL_MODEL: return "write `model mm;`";
    case YYSYMBOL_SYMMETRY: return "write the axes: `symmetry x, z;`";
    case YYSYMBOL_MEASURE: return "write what is to be measured: `measure volume, area;`";
    case YYSYMBOL_REQUIRE: return "write what has to hold: `require parts = 1, height in 7..8;`";
    case YYSYMBOL_FITNESS: return "write `fitness lightness = mass target 0 weight 0.3;`";
    default: break;
    }
    if (found == YYSYMBOL_BELOW || found == YYSYMBOL_AT_MOST || found == YYSYMBOL_AT_LEAST || found == YYSYMBOL_ABOVE ||
        found == YYSYMBOL_UNEQUAL || found == YYSYMBOL_IN || found == YYSYMBOL_EQUALS)
        return "two comparisons are joined by `and`; what lies between two bounds is `height in 7..8`";
    if (found == YYSYMBOL_YYEOF)
        return "a design ends with `}`, and each of its statements with `;`";
    return "a statement starts with a word such as `box`, `symmetry`, `measure` or `require`, and ends with `;`";
}

/* After a statement others may begin, as far as the grammar knows: only so that a missing `;` can be said. */
static bool begins_statement(yysymbol_kind_t kind)
{
    switch (kind) {
    case YYSYMBOL_SYMMETRY:
    case YYSYMBOL_FLAT:
    case YYSYMBOL_NOCLIP:
    case YYSYMBOL_CORRECT:
    case YYSYMBOL_UNIT:
    case YYSYMBOL_MODEL:
    case YYSYMBOL_BOX:
    case YYSYMBOL_GENES:
    case YYSYMBOL_MEASURE:
    case YYSYMBOL_REQUIRE:
    case YYSYMBOL_FITNESS:
    case YYSYMBOL_CLOSE_BRACE: return true;
    default: return false;
    }
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
    bool ends = false, outside = false;
    int taken = 0;
    for (int i = 0; i < count; i++) {
        ends |= kinds[i] == YYSYMBOL_END;
        outside |= kinds[i] == YYSYMBOL_SOLID;
    }
    for (int i = 0; i < count; i++)
        if (!ends || !begins_statement(kinds[i]))
            expected[taken++] = yysymbol_name(kinds[i]);
    tn_parsing_syntax_error(parse, *yypcontext_location(context), found == YYSYMBOL_YYEMPTY ? "this" : yysymbol_name(found), expected,
                           (size_t)taken, outside ? "a file has designs, and everything else stands in one: `solid table { ... }`"
                                                  : likely_fix(found, YYTRANSLATE(parse->token_before)));
    return 0;
}

static void tn_solid_error(const tn_span *span, tn_parsing *parse, void *scanner, const char *message)
{
    (void)scanner;
    (void)message;
    tn_report(parse->diagnostics, E_TOO_DEEP, *span, "the file cannot be read further");
}

tn_solid_file *tn_parse_solid(tn_arena *arena, tn_diagnostics *diagnostics, uint32_t file, tn_tokens *tokens)
{
    tn_solid_file *result = TN_NEW(arena, tn_solid_file);
    const tn_source *source = &diagnostics->sources->files[file];
    tn_parsing parse = {.arena = arena, .diagnostics = diagnostics, .text = source->text, .size = source->size, .file = file, .result = result, .tokens = tokens};
    if (!result)
        return NULL;
    if (!tn_parsing_is_text(&parse)) {
        result->damaged = true;
        return result;
    }
    void *scanner = tn_solid_lexer_new(&parse);
    if (!scanner)
        return NULL;
    int outcome = tn_solid_parse(&parse, scanner);
    tn_solid_lexer_free(scanner);
    result->damaged = parse.damaged || outcome != 0;
    return tn_arena_failed(arena) ? NULL : result; /* deeper than the parser goes: has been said */
}
