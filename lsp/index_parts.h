/* What the files of an index share. Internal to index*.c. */
#ifndef TARTAN_LSP_INDEX_PARTS_H
#define TARTAN_LSP_INDEX_PARTS_H

#include "compiler/plan/syntax/form_ast.h"
#include "lsp/index.h"

/* What words are looked for in; NULL: none. */
typedef struct tn_index_about {
    const tn_symbol *schema, *form;
} tn_index_about;

/* Defines a symbol, which occurs where it is defined. NULL where out of memory. */
tn_symbol *tn_index_define(tn_index *index, tn_symbol_kind kind, const tn_ast_word *name, const tn_ast_word *doc,
                           const tn_ast_node *ast, const tn_symbol *parent);
void tn_index_occur(tn_index *index, tn_span span, const tn_symbol *symbol); /* NULL: nothing */

/* The symbol that the word names, which occurs there; NULL where there is none. */
const tn_symbol *tn_index_use(tn_index *index, const tn_names *names, const tn_ast_word *word);
void tn_index_expression(tn_index *index, const tn_index_about *about, const tn_ast_expr *expr);

/* ---- index_forms.c */

void tn_index_define_form(tn_index *index, const tn_ast_form *form);
void tn_index_use_form(tn_index *index, const tn_symbol *form, const tn_ast_form *ast);

/* `section(...)`, of a form or NULL. */
void tn_index_section(tn_index *index, const tn_symbol *form, const tn_ast_expr *section);

/* Openings by name, of a form or NULL: kinds of faces, functions of tiles, parts of materials (tn_ast_word). */
void tn_index_kinds(tn_index *index, const tn_symbol *form, tn_ast_list words);

/* The line of a house, in the brackets of a test; NULL: none. */
void tn_index_house(tn_index *index, const tn_symbol *form, const tn_ast_word *line);

#endif
