/* Syntax of .bnf files: rules of alternatives of items. */
%require "3.8"
%define api.pure full
%define api.prefix {tn_bnf_}
%define parse.error custom
%define lr.default-reduction accepting
%define api.location.type {tn_span}
%locations
%expect 0
%parse-param { struct tn_bnf_reader *reader } { void *scanner }
%lex-param { void *scanner }

%code requires {
#include "compiler/bnf/ast.h"
}
%code {
#include "bnf_lexer.h"

int tn_bnf_lex(TN_BNF_STYPE *value, tn_span *span, void *scanner);

static void tn_bnf_error(tn_span *span, struct tn_bnf_reader *reader, void *scanner, const char *message)
{
    (void)scanner;
    tn_bnf_memory_exhausted(reader, *span, message);
}

#define YYLLOC_DEFAULT(CURRENT, RHS, COUNT)                                                                            \
    ((CURRENT) = (COUNT) ? tn_span_join(YYRHSLOC(RHS, 1), YYRHSLOC(RHS, COUNT))                                        \
                         : (tn_span){YYRHSLOC(RHS, 0).file, YYRHSLOC(RHS, 0).end, YYRHSLOC(RHS, 0).end})
}
%initial-action { @$ = (tn_span){reader->file, 0, 0}; }

%union {
    tn_bnf_text text;
    tn_bnf_item *item;
    tn_bnf_items items;
    tn_bnf_alternative *alternative;
    tn_bnf_alternatives alternatives;
}

%token <text> HEAD "a rule's name and ::=" NAME "a non-terminal" TEXT "a terminal" QUOTED "a quoted terminal"
%token <text> NEWLINE "a line end" DIRECTIVE "a directive" STRAY "text" QUOTE "a quote without its partner"
%token <text> EDGE_SAME "an edge variable"
%token BAR "|" COMMENT "a comment" REPEAT "{" REPEAT_END "}" MAYBE "[" MAYBE_END "]" EDGE "Edge"
%token END 0 "the end of the file"
%type <item> item
%type <items> items
%type <alternative> alternative
%type <alternatives> alternatives

%%

file: prelude rules;

prelude: %empty
    | prelude DIRECTIVE             { tn_bnf_directive(reader, @2, $2); }
    | prelude STRAY                 { tn_bnf_stray(reader, @2); }
    ;

rules: %empty
    | rules rule
    ;

rule: HEAD alternatives             { tn_bnf_rule_new(reader, @1, $1, @2, $2); }
    | HEAD broken                   { tn_bnf_rule_broken(reader, @1, $1); }
    ;

broken: error
    | broken skipped
    ;

skipped: NAME | TEXT | QUOTED | NEWLINE | QUOTE | EDGE | EDGE_SAME | BAR | COMMENT | REPEAT | REPEAT_END | MAYBE | MAYBE_END
    ;

alternatives: alternative           { $$ = tn_bnf_first($1); }
    | alternatives BAR alternative  { $$ = tn_bnf_next($1, $3, false); }
    | alternatives COMMENT alternative { $$ = tn_bnf_next($1, $3, true); }
    ;

alternative: items                  { $$ = tn_bnf_alternative_new(reader, @1, $1); }
    ;

items: %empty                       { $$ = (tn_bnf_items){0}; }
    | items item                    { $$ = tn_bnf_append($1, $2); }
    ;

item: NAME                          { $$ = tn_bnf_item_new(reader, TN_BNF_NAME, @1, $1); }
    | TEXT                          { $$ = tn_bnf_item_new(reader, TN_BNF_PLAIN, @1, $1); }
    | QUOTED                        { $$ = tn_bnf_item_new(reader, TN_BNF_QUOTED, @1, $1); }
    | NEWLINE                       { $$ = tn_bnf_item_new(reader, TN_BNF_NEWLINE, @1, $1); }
    | QUOTE                         { $$ = tn_bnf_lone_quote(reader, @1, $1); }
    | EDGE                          { $$ = tn_bnf_item_new(reader, TN_BNF_EDGE, @1, (tn_bnf_text){0}); }
    | EDGE_SAME                     { $$ = tn_bnf_item_new(reader, TN_BNF_EDGE_SAME, @1, $1); }
    | REPEAT items REPEAT_END       { $$ = tn_bnf_group_new(reader, TN_BNF_REPEAT, @$, $2); }
    | MAYBE items MAYBE_END         { $$ = tn_bnf_group_new(reader, TN_BNF_MAYBE, @$, $2); }
    ;

%%

static int yyreport_syntax_error(const yypcontext_t *context, struct tn_bnf_reader *reader, void *scanner)
{
    (void)scanner;
    tn_bnf_unexpected(reader, *yypcontext_location(context), yysymbol_name(yypcontext_token(context)));
    return 0;
}

void tn_bnf_read(tn_bnf_reader *reader, char *text, size_t size)
{
    void *scanner;
    tn_bnf_guess_dialect(reader, text, size);
    if (tn_bnf_lex_init_extra(reader, &scanner) != 0) {
        reader->failed = true;
        return;
    }
    if (!tn_bnf__scan_buffer(text, size + 2, scanner)) {
        reader->failed = true;
    } else if (tn_bnf_parse(reader, scanner) != 0) {
        /* the lexer keeps a zero byte behind its last token: at the end of the text, everything is as it was */
        TN_BNF_STYPE value;
        tn_span span;
        while (tn_bnf_lex(&value, &span, scanner) != 0)
            ;
    }
    tn_bnf_lex_destroy(scanner);
}
