/* Makes the syntax tree of .solid files: what the parser calls. */
#include "compiler/solid/solid.h"

tn_solid_item *tn_solid_item_new(tn_growth_parse *parse, tn_solid_statement kind, tn_span span)
{
    tn_solid_item *item = TN_NEW(parse->arena, tn_solid_item);
    if (item) {
        item->kind = kind;
        item->span = span;
    }
    return item;
}

tn_solid_part *tn_solid_part_new(tn_growth_parse *parse, tn_solid_part_kind kind, tn_span span, tn_solid_part *before)
{
    tn_solid_part *part = TN_NEW(parse->arena, tn_solid_part);
    if (part) {
        part->kind = kind;
        part->span = span;
        part->next = before;
    }
    return part;
}

tn_solid_entry *tn_solid_entry_new(tn_growth_parse *parse, tn_span span)
{
    tn_solid_entry *entry = TN_NEW(parse->arena, tn_solid_entry);
    if (entry)
        entry->span = span;
    return entry;
}

tn_solid_entries tn_solid_entries_add(tn_solid_entries list, tn_solid_entry *entry)
{
    TN_CHAIN(&list, entry);
    return list;
}

tn_solid_design *tn_solid_design_new(tn_growth_parse *parse)
{
    return TN_NEW(parse->arena, tn_solid_design);
}

void tn_solid_add_item(tn_solid_design *design, tn_solid_item *item)
{
    if (design)
        TN_CHAIN(design, item);
}

void tn_solid_add_design(tn_growth_parse *parse, tn_solid_design *design)
{
    tn_solid_file *file = parse->result;
    TN_CHAIN(file, design);
}

void tn_solid_add_use(tn_growth_parse *parse, tn_solid_text path)
{
    tn_solid_file *file = parse->result;
    tn_solid_use *use = TN_NEW(parse->arena, tn_solid_use);
    if (use)
        use->path = path;
    TN_CHAIN(&file->uses, use);
}

void tn_solid_lost(tn_growth_parse *parse)
{
    tn_solid_file *file = parse->result;
    file->damaged = true;
}

bool tn_solid_heads(const char *text, size_t size)
{
    return tn_vocabulary_find(&tn_solid_words, text, size, TN_SOLID_AT(LINE), TN_AS_KEYWORDS) != NULL;
}
