/* Runs the generated lexer and parser of .bnf files over a text. */
#include "compiler/bnf_ast.h"

#include "bnf_parser.h"

#define YYSTYPE TN_BNF_STYPE
#define YYLTYPE tn_span
#include "bnf_lexer.h"

void tn_bnf_read(tn_bnf_reader *reader, char *text, size_t size)
{
    void *scanner;
    if (tn_bnf_lex_init_extra(reader, &scanner) != 0) {
        reader->failed = true;
        return;
    }
    if (tn_bnf__scan_buffer(text, size + 2, scanner))
        tn_bnf_parse(reader, scanner);
    else
        reader->failed = true;
    tn_bnf_lex_destroy(scanner);
}
