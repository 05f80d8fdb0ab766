#include "runtime/plan/picture/rule_boxes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/module/code.h"
#include "runtime/plan/match/parts.h"

tn_status tn_rule_box_add(tn_rule_boxes *boxes, uint32_t parent, tn_rule_box box, const char *words, uint32_t *added,
                          tn_error *error)
{
    box.words = words ? strdup(words) : NULL;
    if ((words && !box.words) ||
        !tn_array_reserve_from(&boxes->items, &boxes->capacity, 16, boxes->count, 1, sizeof *boxes->items)) {
        free(box.words);
        return tn_fail_memory(error);
    }
    box.parent = parent;
    box.first = box.last = box.next = TN_NO_BOX;
    *added = boxes->count++;
    boxes->items[*added] = box;
    if (parent == TN_NO_BOX)
        return TN_OK;
    tn_rule_box *of = &boxes->items[parent];
    if (of->last == TN_NO_BOX)
        of->first = *added;
    else
        boxes->items[of->last].next = *added;
    of->last = *added;
    return TN_OK;
}

void tn_rule_boxes_clear(tn_rule_boxes *boxes)
{
    for (uint32_t i = 0; i < boxes->count; i++)
        free(boxes->items[i].words);
    free(boxes->items);
    *boxes = (tn_rule_boxes){0};
}

/* ---- words of parts */

static void repeat_words(uint32_t least, uint32_t most, char words[TN_RULE_WORDS_MAX])
{
    if (most == 0)
        snprintf(words, TN_RULE_WORDS_MAX, "%u or more side by side:", (unsigned)least);
    else if (most == least)
        snprintf(words, TN_RULE_WORDS_MAX, "%u side by side:", (unsigned)least);
    else
        snprintf(words, TN_RULE_WORDS_MAX, "%u to %u side by side:", (unsigned)least, (unsigned)most);
}

static const char *sign_of(tn_part_kind kind)
{
    switch (kind) {
    case TN_PART_WHERE:
        return "where";
    case TN_PART_AND:
        return "and";
    case TN_PART_OR:
        return "or";
    case TN_PART_NOT:
        return "not";
    case TN_PART_MANY:
        return "one or more, each:";
    default:
        return "";
    }
}

/* The condition as its author wrote it, after the last comma: "n >= 2" rather than "not n < 2". */
static bool own_condition(const tn_parts *parts, uint32_t part, char condition[TN_CONDITION_TEXT_MAX])
{
    char text[TN_PART_TEXT_MAX];
    tn_part_text(parts, part, text, sizeof text);
    const char *comma = strrchr(text, ',');
    size_t length = strlen(text);
    if (!comma || text[length - 1] != ')' || length >= sizeof text - 8)
        return false;
    snprintf(condition, TN_CONDITION_TEXT_MAX, "%.*s", (int)(text + length - 1 - (comma + 2)), comma + 2);
    return true;
}

/* Does the part deny that something lies otherwise: is it `every a beside b`? */
static bool is_every(const tn_parts *parts, const tn_part *it)
{
    tn_part_kind below = it->child_count == 1 ? parts->parts[it->first].kind : TN_PART_KIND_COUNT;
    return it->kind == TN_PART_NOT && (below == TN_PART_NEAR || below == TN_PART_FAR) &&
           tn_part_is_step(parts, it->first);
}

/* The words between source and destination, as they are written: "within 12m of". */
static void near_words(const tn_parts *parts, const tn_part *it, char words[TN_RULE_WORDS_MAX])
{
    const tn_module *module = parts->module;
    const tn_part *source = &parts->parts[it->first], *destination = &parts->parts[source->next];
    const tn_source_map_record *from = tn_module_place(module, source->root),
                               *to = tn_module_place(module, destination->root);
    snprintf(words, TN_RULE_WORDS_MAX, "%s", tn_part_word(it->kind));
    if (!from || !to || from->file != to->file || from->end >= to->begin)
        return;
    char text[TN_RULE_WORDS_MAX];
    tn_source_text(module, from->file, from->end, to->begin, text, sizeof text);
    size_t begin = strspn(text, " )"), size = strlen(text);
    while (size > begin && strchr(" (", text[size - 1]))
        size--;
    if (size > begin)
        snprintf(words, TN_RULE_WORDS_MAX, "%.*s", (int)(size - begin), text + begin);
}

/* Is the part all of a comparison of a gap, `max(gap from a to b) <= 2`, which is made of relations? */
static bool is_gap(const tn_parts *parts, uint32_t part)
{
    char words[TN_RULE_WORDS_MAX];
    for (;; part = parts->parts[part].first) {
        const tn_part *it = &parts->parts[part];
        if (it->kind == TN_PART_NEAR || it->kind == TN_PART_FAR) {
            near_words(parts, it, words);
            return strcmp(words, "to") == 0;
        }
        bool steps = it->kind == TN_PART_NOT || it->kind == TN_PART_AND || it->kind == TN_PART_OR;
        if (!steps || it->first == TN_NO_PART || !tn_part_is_step(parts, it->first))
            return false;
    }
}

/* What stands on top of a part's box: the word for its kind, or its condition as its author wrote it. */
static void words_of(const tn_parts *parts, uint32_t part, char words[TN_RULE_WORDS_MAX])
{
    const tn_part *it = &parts->parts[part];
    const tn_module *module = parts->module;
    char condition[TN_CONDITION_TEXT_MAX];
    snprintf(words, TN_RULE_WORDS_MAX, "%s", is_every(parts, it) ? "every" : sign_of(it->kind));
    if (it->kind == TN_PART_REPEAT)
        repeat_words(it->least, it->most, words);
    if (it->kind == TN_PART_NEAR || it->kind == TN_PART_FAR)
        near_words(parts, it, words);
    if (it->kind != TN_PART_QUANTITY && it->kind != TN_PART_SUM && it->kind != TN_PART_OCCURRENCES)
        return;
    bool own = own_condition(parts, part, condition);
    if (!own)
        tn_condition_text(module, it->condition, condition);
    if (it->kind == TN_PART_SUM && !own) /* `total`, which has its bounds in its own words */
        tn_part_text(parts, part, words, TN_RULE_WORDS_MAX);
    else if (it->kind == TN_PART_SUM)
        snprintf(words, TN_RULE_WORDS_MAX, "\xce\xa3 %.60s: %s", tn_text(module, module->FIELD_records[it->field].name),
                 condition);
    else
        snprintf(words, TN_RULE_WORDS_MAX, "%s%s", it->kind == TN_PART_OCCURRENCES ? "places: " : "", condition);
}

/* ---- parts of code as boxes */

/* Is the part drawn as a tag with its words? */
static bool is_named(const tn_parts *parts, uint32_t part)
{
    tn_part_kind kind = parts->parts[part].kind;
    return kind == TN_PART_RULE || kind == TN_PART_COMPARISON || kind == TN_PART_IMAGE || is_gap(parts, part);
}

/* Is the part a distance's separator, whose condition stands on top of its section? */
static bool is_separator(const tn_parts *parts, uint32_t part)
{
    const tn_part *it = &parts->parts[part];
    return it->parent != TN_NO_PART && parts->parts[it->parent].kind == TN_PART_DISTANCE && it->next == TN_NO_PART;
}

static tn_rule_box_kind kind_of(tn_part_kind kind)
{
    switch (kind) {
    case TN_PART_TRAY:
        return TN_BOX_TRAY;
    case TN_PART_OR:
        return TN_BOX_STACK;
    case TN_PART_NEIGHBOUR:
        return TN_BOX_NEIGHBOUR;
    case TN_PART_SYMMETRIC:
        return TN_BOX_SYMMETRIC;
    case TN_PART_DISTANCE:
        return TN_BOX_DISTANCE;
    default:
        return TN_BOX_ROW;
    }
}

/* A neighbour has a frame of its own only where it is the whole rule ("the box and symbol are omitted", section 3.2).
 */
static tn_rule_box box_of(const tn_parts *parts, uint32_t part)
{
    const tn_part *it = &parts->parts[part];
    bool named = is_named(parts, part), separator = !named && is_separator(parts, part);
    bool counts = it->kind == TN_PART_QUANTITY || it->kind == TN_PART_SUM || it->kind == TN_PART_OCCURRENCES;
    return (tn_rule_box){.kind = named ? TN_BOX_TAG : kind_of(it->kind),
                         .number = part,
                         .spec = it->spec,
                         .framed = it->kind != TN_PART_TRAY && !named && !separator &&
                                   (it->kind != TN_PART_NEIGHBOUR || it->parent == TN_NO_PART),
                         .centred = counts,
                         .separator = separator,
                         .optional = it->optional,
                         .alone = it->child_count == 1,
                         .beginning = it->beginning,
                         .end = it->end,
                         .beginning_number = TN_NO_BOX_NUMBER,
                         .end_number = TN_NO_BOX_NUMBER};
}

static tn_status add_part(const tn_parts *parts, uint32_t part, uint32_t parent, tn_rule_boxes *boxes, tn_error *error)
{
    char words[TN_RULE_WORDS_MAX > TN_PART_TEXT_MAX ? TN_RULE_WORDS_MAX : TN_PART_TEXT_MAX];
    tn_rule_box box = box_of(parts, part);
    uint32_t added;
    if (box.kind == TN_BOX_TAG)
        tn_part_text(parts, part, words, TN_PART_TEXT_MAX);
    else
        words_of(parts, part, words);
    tn_status status = tn_rule_box_add(boxes, parent, box, words, &added, error);
    if (box.kind == TN_BOX_TAG)
        return status;
    for (uint32_t child = parts->parts[part].first; status == TN_OK && child != TN_NO_PART;
         child = parts->parts[child].next)
        if (!tn_part_unwritten(parts, child))
            status = add_part(parts, child, added, boxes, error);
    return status;
}

tn_status tn_rule_boxes_read(const tn_module *module, uint32_t function, tn_rule_boxes *boxes, tn_error *error)
{
    tn_parts parts;
    *boxes = (tn_rule_boxes){0};
    tn_status status = tn_parts_read(module, function, &parts, error);
    if (status == TN_OK)
        status = add_part(&parts, 0, TN_NO_BOX, boxes, error);
    tn_parts_clear(&parts);
    return status;
}
