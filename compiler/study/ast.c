/* The constructors of the syntax tree of growth studies (.study). */
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

/* ---- expressions */

tn_study_measure *tn_study_measure_new(tn_growth_parse *parse, tn_opcode op, tn_span span, tn_study_measure *left,
                                       tn_study_measure *right)
{
    tn_study_measure *measure = TN_NEW(parse->arena, tn_study_measure);
    if (!measure)
        return NULL;
    uint32_t l = left ? left->depth : 0, r = right ? right->depth : 0;
    *measure = (tn_study_measure){
        .op = op, .span = span, .left = left, .right = right, .argument_count = 1, .depth = 1 + (l > r ? l : r)};
    measure->last = measure;
    return measure;
}

tn_study_measure *tn_study_number_new(tn_growth_parse *parse, tn_decimal number)
{
    tn_study_measure *measure = tn_study_measure_new(parse, TN_OP_NUMBER, number.span, NULL, NULL);
    if (measure)
        measure->number = number.value;
    return measure;
}

tn_study_measure *tn_study_name_new(tn_growth_parse *parse, tn_opcode op, tn_span span, tn_study_text name,
                                    tn_study_measure *arguments)
{
    tn_study_measure *measure = tn_study_measure_new(parse, op, span, arguments, arguments ? arguments->next : NULL);
    if (measure) {
        measure->name = name.text;
        measure->name_span = name.span;
    }
    return measure;
}

tn_study_measure *tn_study_argument_add(tn_study_measure *list, tn_study_measure *argument)
{
    if (!list || !argument)
        return list;
    list->last->next = argument;
    list->last = argument;
    list->argument_count++;
    return list;
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
    static const char *const words[] = {
        "use",           "title",     "rules",        "steps",        "scale",           "start",   "start-length",
        "seed",          "facing",    "branch-angle", "edge-limit",   "fixed-perimeter", "mirror",  "gravity",
        "branch-length", "attractor", "repeller",     "fixed-centre", "boundary",        "fitness", "fixed-center"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strlen(words[i]) == size && strncasecmp(words[i], text, size) == 0)
            return true;
    return false;
}

static bool ends_in(const char *path, const char *extension)
{
    size_t size = strlen(path), tail = strlen(extension);
    return size > tail && strcmp(path + size - tail, extension) == 0;
}

bool tn_is_study(const char *path)
{
    return ends_in(path, ".study");
}

bool tn_is_hemls(const char *path)
{
    return ends_in(path, ".hemls");
}
