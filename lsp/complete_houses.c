/* Completion in forms, and in what is asked of houses. */
#include <stdlib.h>

#include "compiler/plan/syntax/form_ast.h"
#include "lsp/complete_parts.h"

/* The form that the item is, or is about; else the last one there is. */
static const tn_symbol *form_here(const tn_lsp_cursor *c)
{
    const tn_index *index = &c->analysis->index;
    char *name = c->item + 1 < c->count ? tn_cursor_word(c, c->item + 1) : NULL;
    const tn_symbol *symbol = !name                              ? NULL
                              : tn_cursor_is(c, c->item, "form") ? tn_names_get(&index->forms, name)
                                                                 : tn_names_get(&index->names, name);
    free(name);
    if (symbol && symbol->kind != TN_SYMBOL_FORM)
        symbol = symbol->form;
    return symbol ? symbol : index->last_form;
}

static void offer_parts(tn_lsp_cursor *c, tn_symbol_kind kind, int shown)
{
    const tn_symbol *form = form_here(c);
    for (const tn_symbol *s = form ? form->next : NULL; s && s->parent == form; s = s->next)
        if (s->kind == kind)
            tn_offer(c, s->name, shown, s->doc, "1");
}

/* Is this the `cell(` of a line `function`, `void` or `no` of a form? These lines say where functions and voids may be,
 * so that their cells have none yet (E1607). */
static bool before_functions(const tn_lsp_cursor *c, size_t bracket)
{
    size_t depth = 0;
    for (size_t i = bracket; tn_cursor_is(c, c->item, "form") && i-- > c->item;) {
        if (tn_cursor_is(c, i, ")"))
            depth++;
        else if (tn_cursor_is(c, i, "(") && depth > 0)
            depth--;
        else if (depth == 0 && (tn_cursor_is(c, i, "at") || tn_cursor_is(c, i, "void") || tn_cursor_is(c, i, "no")))
            return true;
        else if (depth == 0 && tn_cursor_is_word(c, i, TN_AT(FORM) | TN_AT(FACE), TN_AS_KEYWORDS))
            return false;
    }
    return false;
}

void tn_complete_cell(tn_lsp_cursor *c, size_t bracket, bool room)
{
    const tn_symbol *form = form_here(c), *field = form ? tn_cursor_field(c, form->schema) : NULL;
    offer_parts(c, TN_SYMBOL_STOREY, KIND_VALUE);
    if (!before_functions(c, bracket)) {
        offer_parts(c, TN_SYMBOL_FUNCTION, KIND_FUNCTION);
        tn_offer_words(c, TN_AT(CELL_BUILT));
    }
    for (const tn_symbol *s = form ? form->schema : NULL; s; s = s->schema)
        tn_offer_declared(c, s, field);
    if (room) {
        offer_parts(c, TN_SYMBOL_OPENING, KIND_VALUE);
        tn_offer_words(c, TN_AT(ROOM));
    } else {
        tn_offer_words(c, TN_AT(CELL));
    }
}

/* The values of a choice, by their names. */
static void offer_values(tn_lsp_cursor *c, const tn_ast_form_clause *choice)
{
    for (TN_EACH(const tn_ast_shape, shape, choice->list))
        if (shape->word && shape->word->text)
            tn_offer(c, shape->word->text, KIND_VALUE, NULL, "1");
}

/* `section(body roof gable)`, or `section(cladding board)`: a choice is one word or two. */
static void complete_choice(tn_lsp_cursor *c, const tn_ast_form_clause *choice, size_t first)
{
    size_t detail = choice->detail != NULL;
    if (!choice->name || !choice->name->text || (detail && !choice->detail->text))
        return;
    if (first == c->count)
        tn_offer(c, choice->name->text, KIND_FIELD, NULL, "1");
    else if (!tn_cursor_is(c, first, choice->name->text))
        return;
    else if (detail && first + 1 == c->count)
        tn_offer(c, choice->detail->text, KIND_FIELD, NULL, "1");
    else if (!detail || tn_cursor_is(c, first + 1, choice->detail->text))
        offer_values(c, choice);
}

void tn_complete_section(tn_lsp_cursor *c, size_t bracket)
{
    const tn_symbol *form = form_here(c);
    if (!form)
        return;
    for (TN_EACH(const tn_ast_form_clause, clause, ((const tn_ast_form *)form->ast)->clauses))
        if (clause->part == TN_PART_SECTION)
            complete_choice(c, clause, bracket + 1);
    if (c->count > bracket + 2)
        tn_offer_words(c, TN_AT(SECTION));
}

static void complete_kinds(tn_lsp_cursor *c)
{
    offer_parts(c, TN_SYMBOL_OPENING, KIND_VALUE);
    tn_offer_words(c, TN_AT(KIND));
}

void tn_complete_form(tn_lsp_cursor *c)
{
    if (c->braces > 1 || tn_cursor_is(c, c->clause, "tile")) {
        offer_parts(c, TN_SYMBOL_FUNCTION, KIND_FUNCTION);
        complete_kinds(c);
        tn_offer_words(c, TN_AT(TILE) | TN_AT(TILE_LINE));
    } else if (tn_cursor_is(c, c->clause, "face")) {
        complete_kinds(c);
        tn_offer_words(c, TN_AT(FACE) | TN_AT(CELLS));
    } else if (tn_cursor_is(c, c->clause, "material")) {
        offer_parts(c, TN_SYMBOL_OPENING, KIND_VALUE);
        tn_offer_words(c, TN_AT(MATERIAL) | TN_AT(SECTIONS));
    } else if (tn_cursor_is(c, c->clause, "allow")) {
        tn_complete_codes(c);
    } else if (tn_cursor_is(c, c->clause, "opening")) {
        tn_offer_words(c, TN_AT(OPENING));
    } else if (tn_cursor_is(c, c->clause, "flight")) {
        tn_offer_words(c, TN_AT(FLIGHT));
    } else if (tn_cursor_is(c, c->clause, "section")) {
        tn_offer_words(c, TN_AT(CHOICE));
    } else if (tn_cursor_is(c, c->clause, "forbid")) {
        tn_offer_words(c, TN_AT(SECTIONS));
    } else if (tn_cursor_is(c, c->clause, "function")) {
        tn_offer_words(c, TN_AT(FUNCTION) | TN_AT(CELLS));
    } else if (tn_cursor_is(c, c->clause, "void") || tn_cursor_is(c, c->clause, "no")) {
        tn_offer_words(c, TN_AT(CELLS));
    }
    if (c->braces == 1)
        tn_offer_words(c, TN_AT(FORM));
}
