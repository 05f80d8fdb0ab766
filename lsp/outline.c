/* The outline of a document: from the tokens, so that it is there too while a file is being typed, where the notation's
 * front end makes one of them; else from the index. */
#include "lsp/features.h"

/* SymbolKind of the protocol. */
enum {
    KIND_MODULE = 2,
    KIND_PROPERTY = 7,
    KIND_FIELD = 8,
    KIND_FUNCTION = 12,
    KIND_CONSTANT = 14,
    KIND_KEY = 20,
    KIND_MEMBER = 22,
    KIND_STRUCT = 23,
};

/* ---- from the index */

static int outline_kind(tn_symbol_kind kind)
{
    static const int kinds[] = {
        [TN_SYMBOL_SCHEMA] = KIND_STRUCT,    [TN_SYMBOL_FIELD] = KIND_FIELD,    [TN_SYMBOL_VALUE] = KIND_MEMBER,
        [TN_SYMBOL_RULE] = KIND_FUNCTION,    [TN_SYMBOL_LIBRARY] = KIND_MODULE, [TN_SYMBOL_CLAUSE] = KIND_KEY,
        [TN_SYMBOL_MEASURE] = KIND_CONSTANT, [TN_SYMBOL_FORM] = KIND_STRUCT,    [TN_SYMBOL_STOREY] = KIND_MEMBER,
        [TN_SYMBOL_FUNCTION] = KIND_FIELD,   [TN_SYMBOL_OPENING] = KIND_MEMBER, [TN_SYMBOL_TILE] = KIND_PROPERTY,
        [TN_SYMBOL_CHOICE] = KIND_PROPERTY,  [TN_SYMBOL_PARAM] = KIND_CONSTANT, [TN_SYMBOL_LAYER] = KIND_MEMBER};
    return kinds[kind];
}

static json_t *outline_item(tn_file_analysis *analysis, const tn_symbol *symbol)
{
    json_t *item = json_pack("{s:s,s:i,s:o,s:o}", "name", symbol->name, "kind", outline_kind(symbol->kind), "range",
                             tn_analysis_range(analysis, symbol->span), "selectionRange",
                             tn_analysis_range(analysis, symbol->name_span));
    if (symbol->doc)
        json_object_set_new(item, "detail", json_string(symbol->doc));
    json_t *children = json_array();
    for (const tn_symbol *s = symbol->next;
         s && symbol->kind != TN_SYMBOL_RULE && symbol->kind != TN_SYMBOL_MEASURE && symbol->kind != TN_SYMBOL_PARAM;
         s = s->next) {
        if (s->parent == symbol)
            json_array_append_new(children, outline_item(analysis, s));
        else if (s->kind != TN_SYMBOL_VALUE && symbol->kind != TN_SYMBOL_LIBRARY && s->parent != symbol)
            break;
    }
    if (json_array_size(children) > 0)
        json_object_set(item, "children", children);
    json_decref(children);
    return item;
}

static json_t *outline_index(tn_file_analysis *analysis)
{
    json_t *list = json_array();
    for (const tn_symbol *s = analysis->index.first; s; s = s->next)
        if (s->span.file == 0 && !s->parent)
            json_array_append_new(list, outline_item(analysis, s));
    return list;
}

/* ---- from tokens */

static json_t *entry_item(tn_file_analysis *analysis, const char *text, const tn_listing_entry *entry)
{
    static const int kinds[] = {[TN_LISTING_RULE] = KIND_FUNCTION,
                                [TN_LISTING_SETTING] = KIND_PROPERTY,
                                [TN_LISTING_CONSTANT] = KIND_CONSTANT,
                                [TN_LISTING_BLOCK] = KIND_MODULE};
    json_t *item =
        json_pack("{s:s%,s:i,s:o,s:o}", "name", text + entry->name.begin, (size_t)(entry->name.end - entry->name.begin),
                  "kind", kinds[entry->kind], "range", tn_analysis_range(analysis, entry->whole), "selectionRange",
                  tn_analysis_range(analysis, entry->name));
    if (item && entry->detail.end > 0)
        json_object_set_new(item, "detail",
                            json_stringn(text + entry->detail.begin, entry->detail.end - entry->detail.begin));
    return item;
}

static json_t *outline_tokens(tn_file_analysis *analysis)
{
    tn_listing listing;
    json_t *list = json_array(), *children = NULL;
    if (!tn_listing_start(&listing, analysis->compilation.sources.files[0].text, &analysis->tokens))
        return list;
    analysis->compilation.notation->front->list(&listing);
    for (size_t i = 0; i < listing.entry_count; i++) {
        const tn_listing_entry *entry = &listing.entries[i];
        json_t *item = entry_item(analysis, listing.text, entry);
        if (entry->kind == TN_LISTING_BLOCK)
            json_object_set_new(item, "children", children = json_array());
        json_array_append_new(entry->inside ? children : list, item);
    }
    return list;
}

json_t *tn_lsp_outline(tn_document *document, tn_file_analysis *analysis)
{
    (void)document;
    if (!analysis->compilation.notation->front->list)
        return outline_index(analysis);
    return outline_tokens(analysis);
}
