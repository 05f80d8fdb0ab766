/* From the AST of a .bnf file to rules that can be emitted: terminals are made, names found, and what could not work is
 * reported. */
#ifndef TARTAN_COMPILER_BNF_CHECK_H
#define TARTAN_COMPILER_BNF_CHECK_H

#include "compiler/bnf/ast.h"

#define TN_BNF_PRODUCTIONS_MAX 1000000u /* alternatives of a grammar: what loading allows in one section */
#define TN_BNF_NONE UINT32_MAX

typedef struct tn_bnf_grammar {
    tn_bnf_reader *reader;
    tn_bnf_rule **rules; /* by index; the first is the start symbol */
    size_t rule_count;
    size_t production_count;
    uint32_t *names; /* hash table of rule indices */
    size_t names_size;
} tn_bnf_grammar;

/* Lists the rules that were read (bnf.c). False where out of memory. */
bool tn_bnf_collect_rules(tn_bnf_grammar *grammar);

/* Makes every alternative's pieces into terminals and drops the empty ones (bnf_terminals.c). */
void tn_bnf_make_terminals(tn_bnf_grammar *grammar);

/* Finds the names; then which rules can end and which can be reached (bnf_check.c). */
void tn_bnf_check(tn_bnf_grammar *grammar);

/* Index of a rule by its name with brackets, or TN_BNF_NONE. */
uint32_t tn_bnf_find(const tn_bnf_grammar *grammar, tn_bnf_text name);

#endif
