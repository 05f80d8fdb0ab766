/* Makes the syntax tree of .study files: what the parser calls. */
#include <string.h>
#include <strings.h>

#include "compiler/study/study.h"

tn_study_item *tn_study_item_new(tn_growth_parse *parse, tn_study_kind kind, tn_span span)
{
    tn_study_item *item = TN_NEW(parse->arena, tn_study_item);
    if (item) {
        item->kind = kind;
        item->span = span;
    }
    return item;
}

tn_study_part *tn_study_part_new(tn_growth_parse *parse, tn_study_part_kind kind, tn_span span, double value,
                                 tn_study_part *before)
{
    tn_study_part *part = TN_NEW(parse->arena, tn_study_part);
    if (part) {
        part->kind = kind;
        part->span = span;
        part->value = value;
        part->next = before;
    }
    return part;
}

void tn_study_add(tn_growth_parse *parse, tn_study_item *item)
{
    tn_study_file *file = parse->result;
    TN_CHAIN(file, item);
}

void tn_study_lost(tn_growth_parse *parse)
{
    tn_study_file *file = parse->result;
    file->damaged = true;
}

bool tn_study_heads(const char *text, size_t size)
{
    return tn_vocabulary_find(&tn_study_words, text, size, TN_STUDY_AT(STATEMENT), TN_AS_KEYWORDS | TN_AS_NAMED) !=
           NULL;
}
