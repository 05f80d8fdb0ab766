/* Syntax of `evolution { ... }`: one setting a line, a word and its values. An error ends with its line. */
%require "3.8"
%define api.pure full
%define api.prefix {tn_evolution_yy_}
%define parse.error custom
%define lr.default-reduction accepting
%define api.location.type {tn_span}
%locations
%expect 0
%parse-param { struct tn_evolution_reader *reader } { void *scanner }
%lex-param { void *scanner }

%code requires {
#include "compiler/evolution/evolution.h"
}
%code {
#include "compiler/common/lexical.h"
#include "evolution_lexer.h"

int tn_evolution_yy_lex(TN_EVOLUTION_YY_STYPE *value, tn_span *span, void *scanner);

static void tn_evolution_yy_error(tn_span *span, struct tn_evolution_reader *reader, void *scanner, const char *message)
{
    (void)scanner;
    tn_evolution_unexpected(reader, *span, message);
}

#define YYLLOC_DEFAULT(CURRENT, RHS, COUNT)                                                                            \
    ((CURRENT) = (COUNT) ? tn_span_join(YYRHSLOC(RHS, 1), YYRHSLOC(RHS, COUNT))                                        \
                         : (tn_span){YYRHSLOC(RHS, 0).file, YYRHSLOC(RHS, 0).end, YYRHSLOC(RHS, 0).end})
}
%initial-action { @$ = (tn_span){reader->file, 0, 0}; }

%union {
    tn_evolution_text text;
    tn_evolution_value *value;
}

%token <text> WORD "a word" NUMBER "a number" RANGE "a range" STRING "a text in quotes" UNCLOSED "a text without end"
%token <text> STRAY "this character"
%token EVOLUTION "`evolution`" OPEN "`{`" CLOSE "`}`" LINE_END "a line end" END 0 "the end of the file"
%type <value> value values

%%

file: %empty
    | file block
    ;

block: head settings CLOSE
    | head settings setting CLOSE
    | head settings END                         { tn_evolution_unclosed_block(reader, @3); YYABORT; }
    | head settings setting END                 { tn_evolution_unclosed_block(reader, @4); YYABORT; }
    | head settings error CLOSE                 { yyerrok; }
    ;

head: EVOLUTION OPEN                            { tn_evolution_block(reader, @$); }
    ;

settings: %empty
    | settings LINE_END
    | settings setting LINE_END
    | settings error LINE_END                   { yyerrok; }
    ;

setting: WORD values                            { tn_evolution_setting_new(reader, @1, $1, $2); }
    ;

values: %empty                                  { $$ = NULL; }
    | values value                              { $$ = tn_evolution_value_add($1, $2); }
    ;

value: WORD                                     { $$ = tn_evolution_value_new(reader, TN_EVOLUTION_WORD, @1, $1); }
    | NUMBER                                    { $$ = tn_evolution_value_new(reader, TN_EVOLUTION_NUMBER, @1, $1); }
    | UNCLOSED                                  { $$ = tn_evolution_value_new(reader, TN_EVOLUTION_UNCLOSED, @1, $1); }
    | RANGE                                     { $$ = tn_evolution_value_new(reader, TN_EVOLUTION_RANGE, @1, $1); }
    | STRING                                    { $$ = tn_evolution_value_new(reader, TN_EVOLUTION_STRING, @1, $1); }
    ;

%%

static int yyreport_syntax_error(const yypcontext_t *context, struct tn_evolution_reader *reader, void *scanner)
{
    (void)scanner;
    tn_evolution_unexpected(reader, *yypcontext_location(context), yysymbol_name(yypcontext_token(context)));
    return 0;
}

void tn_evolution_read(tn_evolution_reader *reader, char *text, size_t size)
{
    void *scanner;
    size_t mark = tn_text_mark(text, size);
    reader->at = (uint32_t)mark;
    if (tn_evolution_yy_lex_init_extra(reader, &scanner) != 0) {
        reader->failed = true;
        return;
    }
    reader->at = (uint32_t)tn_text_mark(text, size);
    if (!tn_evolution_yy__scan_buffer(text + reader->at, size - reader->at + 2, scanner)) {
        reader->failed = true;
    } else if (tn_evolution_yy_parse(reader, scanner) != 0) {
        /* the lexer keeps a zero byte behind its last token: at the end of the text, everything is as it was */
        TN_EVOLUTION_YY_STYPE value;
        tn_span span;
        while (tn_evolution_yy_lex(&value, &span, scanner) != 0)
            ;
    }
    tn_evolution_yy_lex_destroy(scanner);
}
