/* Finds what a form declares, and where it is named: in the form itself, in questions about houses, in lines of houses.
 */
#include <stdio.h>
#include <string.h>

#include "lsp/index_parts.h"

const tn_symbol *tn_index_part(const tn_symbol *form, const char *name)
{
    for (const tn_symbol *s = form ? form->next : NULL; s && s->parent == form; s = s->next)
        if (s->kind != TN_SYMBOL_CHOICE && strcmp(s->name, name) == 0)
            return s;
    return NULL;
}

/* ---- definitions */

static bool is_defined(tn_form_part part, tn_symbol_kind *kind)
{
    switch (part) {
    case TN_PART_STOREY:
        *kind = TN_SYMBOL_STOREY;
        return true;
    case TN_PART_FUNCTION:
        *kind = TN_SYMBOL_FUNCTION;
        return true;
    case TN_PART_OPENING:
    case TN_PART_FLIGHT:
        *kind = TN_SYMBOL_OPENING;
        return true;
    case TN_PART_TILE:
        *kind = TN_SYMBOL_TILE;
        return true;
    default:
        return false;
    }
}

/* `section NAME = ...`, or `section ZONE NAME = ...`. */
static void define_choice(tn_index *index, const tn_ast_form_clause *clause, const tn_symbol *form)
{
    const tn_ast_word *zone = clause->name, *own = clause->detail ? clause->detail : zone;
    tn_symbol *choice = tn_index_define(index, TN_SYMBOL_CHOICE, own, clause->doc, &clause->node, form);
    char name[2 * TN_NAME_MAX + 2];
    if (!choice || !clause->detail || !zone->text)
        return;
    int size = snprintf(name, sizeof name, "%s %s", zone->text, own->text);
    const char *copied = size < (int)sizeof name ? tn_arena_copy(index->arena, name, (size_t)size) : NULL;
    if (copied)
        choice->name = copied;
}

void tn_index_define_form(tn_index *index, const tn_ast_form *ast)
{
    tn_symbol *form = tn_index_define(index, TN_SYMBOL_FORM, ast->name, ast->doc, &ast->top.node, NULL);
    tn_symbol_kind kind;
    if (!form)
        return;
    index->last_form = form;
    form->schema = ast->schema && ast->schema->text ? tn_names_get(&index->schemas, ast->schema->text) : NULL;
    if (!tn_names_get(&index->forms, form->name))
        tn_names_put(&index->forms, form->name, form);
    for (TN_EACH(const tn_ast_form_clause, clause, ast->clauses))
        if (clause->part == TN_PART_SECTION && clause->name)
            define_choice(index, clause, form);
        else if (is_defined(clause->part, &kind) && clause->name)
            tn_index_define(index, kind, clause->name, clause->doc, &clause->node, form);
}

/* ---- uses */

void tn_index_kinds(tn_index *index, const tn_symbol *form, tn_ast_list words)
{
    for (TN_EACH(const tn_ast_word, word, words))
        if (word->text)
            tn_index_occur(index, word->node.span, tn_index_part(form, word->text));
}

static void use_zone(tn_index *index, const tn_symbol *form, const tn_ast_word *zone)
{
    if (zone && zone->text)
        tn_index_occur(index, zone->node.span, tn_index_field(form->schema, zone->text));
}

/* The choice that words before a value name; second: NULL where there is one word. */
static const tn_symbol *find_choice(const tn_symbol *form, const tn_ast_word *first, const tn_ast_word *second)
{
    for (const tn_symbol *s = form ? form->next : NULL; s && s->parent == form; s = s->next) {
        const tn_ast_form_clause *clause = (const tn_ast_form_clause *)s->ast;
        if (s->kind == TN_SYMBOL_CHOICE && clause->name->text && strcmp(clause->name->text, first->text) == 0 &&
            (second ? clause->detail && strcmp(clause->detail->text, second->text) == 0 : !clause->detail))
            return s;
    }
    return NULL;
}

/* The last node of an alternative is its value. */
static void use_choice(tn_index *index, const tn_symbol *form, const tn_ast_list *words)
{
    const tn_ast_word *named[2] = {NULL, NULL};
    size_t count = 0;
    for (const tn_ast_node *node = words->first; node && node != words->last; node = node->next) {
        const tn_ast_word *word = (const tn_ast_word *)node;
        if (word->kind == TN_WORD_NAME && word->text && count < 2)
            named[count++] = word;
    }
    if (count == 0)
        return;
    const tn_symbol *choice = find_choice(form, named[0], named[1]);
    tn_index_occur(index, named[count - 1]->node.span, choice);
    if (choice && count == 2)
        use_zone(index, form, named[0]);
}

void tn_index_section(tn_index *index, const tn_symbol *form, const tn_ast_expr *section)
{
    for (TN_EACH(const tn_ast_item, item, section->items))
        for (TN_EACH(const tn_ast_alternative, alternative, item->alternatives))
            use_choice(index, form, &alternative->words);
}

static void use_tile(tn_index *index, const tn_symbol *form, const tn_ast_form_clause *tile)
{
    tn_index_kinds(index, form, tile->list);
    for (TN_EACH(const tn_ast_tile_part, part, tile->parts))
        if (part->part == TN_TILE_AGAINST)
            tn_index_kinds(index, form, part->list);
}

void tn_index_use_form(tn_index *index, const tn_symbol *form, const tn_ast_form *ast)
{
    if (!form)
        return;
    const tn_index_about about = {form->schema, form};
    tn_index_use(index, &index->schemas, ast->schema);
    for (TN_EACH(const tn_ast_form_clause, clause, ast->clauses)) {
        tn_index_expression(index, &about, clause->first);
        tn_index_expression(index, &about, clause->second);
        if (clause->part == TN_PART_SPINE || clause->part == TN_PART_SECTION)
            use_zone(index, form, clause->name);
        else if (clause->part == TN_PART_FACE || clause->part == TN_PART_MATERIAL)
            tn_index_kinds(index, form, clause->list);
        else if (clause->part == TN_PART_TILE)
            use_tile(index, form, clause);
    }
}

/* ---- lines of houses */

static bool is_in_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           (c & 0x80);
}

/* A word of a part of the line names what that part is about: a function, an opening, a tile with its side. */
static void use_house_word(tn_index *index, const tn_symbol *form, int part, const char *name, size_t size,
                           tn_span span)
{
    static const tn_symbol_kind kinds[] = {[2] = TN_SYMBOL_FUNCTION, [3] = TN_SYMBOL_OPENING, [4] = TN_SYMBOL_TILE};
    char *text = tn_arena_copy(index->arena, name, size);
    const tn_symbol *found = text ? tn_index_part(form, text) : NULL;
    if (found && found->kind == kinds[part])
        tn_index_occur(index, span, found);
}

void tn_index_house(tn_index *index, const tn_symbol *form, const tn_ast_word *line)
{
    int part = 0; /* plan, section, functions, faces, tiles */
    if (!form || !line || !line->text || line->node.span.end - line->node.span.begin != strlen(line->text))
        return;
    for (const char *at = line->text; *at;) {
        size_t size = 0;
        while (is_in_name(at[size]))
            size++;
        uint32_t begin = line->node.span.begin + (uint32_t)(at - line->text);
        if (size > 0 && part >= 2 && part <= 4)
            use_house_word(index, form, part, at, size, (tn_span){line->node.span.file, begin, begin + (uint32_t)size});
        part += *at == ';';
        at += size ? size : 1;
        while (part == 4 && size && *at && *at != ' ' && *at != '\n' && *at != '\t')
            at++; /* the side of a tile */
    }
}
