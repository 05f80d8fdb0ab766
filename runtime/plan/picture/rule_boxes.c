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

/* A call of a rule with parameters that is opened. */
typedef struct call {
    const char *parameters; /* in the rule's head, "a, b) = ..."; NULL: not known */
    const char *text;       /* "pair(kitchen, bath)" */
    const tn_source_map_record *body;
    const struct call *outer;
} call;

/* A rule being read, and what its parts stand in. */
typedef struct adding {
    const tn_module *module;
    tn_rule_boxes *boxes;
    const struct bound *bound; /* the innermost quantifier */
    const call *call;          /* the innermost call */
    unsigned calls, depth;     /* of rules with parameters, opened around these parts; and of parts in parts */
    tn_error *error;
} adding;

/* A neighbour has a frame of its own only where it is the whole rule ("the box and symbol are omitted", section 3.2).
 */
static tn_rule_box box_of(const adding *a, const tn_parts *parts, uint32_t part)
{
    const tn_part *it = &parts->parts[part];
    bool named = is_named(parts, part), separator = !named && is_separator(parts, part);
    bool counts = it->kind == TN_PART_QUANTITY || it->kind == TN_PART_SUM || it->kind == TN_PART_OCCURRENCES;
    return (tn_rule_box){
        .kind = named ? TN_BOX_TAG : kind_of(it->kind),
        .number = a->calls == 0 ? part : TN_NO_BOX_NUMBER, /* parts of another function have none in this rule */
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

/* ---- quantifiers: `some v in use (...)`, whose code has a part for each value */

/* The words that a quantifier binds, and those of the quantifiers around it. */
typedef struct bound {
    char names[TN_RULE_WORDS_MAX]; /* "v, w" */
    const struct bound *outer;
} bound;

static bool is_name(char c)
{
    return c == '-' || c == '_' || (unsigned char)c >= 0x80 || (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') ||
           (c >= 'a' && c <= 'z');
}

/* Stands the word of that size in the text, as a word of its own? */
static bool has_word(const char *text, const char *word, size_t size)
{
    for (const char *at = text; *at; at++) {
        bool begins = at == text || !is_name(at[-1]);
        if (begins && strncmp(at, word, size) == 0 && !is_name(at[size]))
            return true;
    }
    return false;
}

/* Names the text a word that a quantifier binds? Then the part is not the same for all values. */
static bool is_bound(const bound *by, const char *text)
{
    for (; by; by = by->outer)
        for (const char *name = by->names; *name;) {
            size_t size = strcspn(name, ", ");
            if (size > 0 && has_word(text, name, size))
                return true;
            name += size + strspn(name + size, ", ");
        }
    return false;
}

/* The part of the values of a quantifier that has most to show (values that are decided before there are plans leave
 * less); TN_NO_PART: the part is no quantifier. All have the place of its body. */
static uint32_t body_of(const tn_parts *parts, uint32_t part, const char *text)
{
    const tn_part *it = &parts->parts[part];
    bool some = it->kind == TN_PART_OR && strncmp(text, "some ", 5) == 0,
         every = it->kind == TN_PART_AND && strncmp(text, "every ", 6) == 0;
    const tn_source_map_record *first =
        some || every ? tn_module_place(parts->module, parts->parts[it->first].root) : NULL;
    uint32_t body = it->first;
    for (uint32_t child = it->first; first && child != TN_NO_PART; child = parts->parts[child].next) {
        const tn_source_map_record *place = tn_module_place(parts->module, parts->parts[child].root);
        if (!place || place->begin != first->begin || place->end != first->end || place->file != first->file)
            return TN_NO_PART;
        if (tn_part_size(parts, child) > tn_part_size(parts, body))
            body = child;
    }
    return first ? body : TN_NO_PART;
}

/* What a condition of bound words leaves of the text before or behind the body: "v < w and" without its `and`. */
static void trim_condition(const char *from, size_t size, char words[TN_RULE_WORDS_MAX])
{
    while (size > 0 && strchr(" (),", *from)) {
        from++;
        size--;
    }
    if (size >= 4 && strncmp(from, "and ", 4) == 0) {
        from += 4;
        size -= 4;
    }
    while (size > 0 && strchr(" (", from[size - 1]))
        size--;
    if (size >= 4 && strncmp(from + size - 4, " and", 4) == 0)
        size -= 4;
    size_t used = strlen(words);
    if (size > 0)
        snprintf(words + used, TN_RULE_WORDS_MAX - used, ": %.*s", (int)size, from);
}

/* "some v, w in width: v < w", and the names that it binds. */
static void quantifier_words(const tn_parts *parts, uint32_t part, uint32_t body, const char *text,
                             char words[TN_RULE_WORDS_MAX], char names[TN_RULE_WORDS_MAX])
{
    const tn_source_map_record *all = tn_module_place(parts->module, parts->parts[part].root),
                               *of = tn_module_place(parts->module, parts->parts[body].root);
    char before[TN_PART_TEXT_MAX];
    size_t head = strcspn(text, "("), begin = strcspn(text, " ") + 1;
    const char *in = strstr(text + begin, " in ");
    while (head > 0 && text[head - 1] == ' ')
        head--;
    snprintf(words, TN_RULE_WORDS_MAX, "%.*s", (int)head, text);
    snprintf(names, TN_RULE_WORDS_MAX, "%.*s", (int)(in ? in - (text + begin) : 0), text + begin);
    if (!all || !of || all->file != of->file || of->begin < all->begin)
        return;
    tn_source_text(parts->module, all->file, all->begin, of->begin, before, sizeof before);
    if (strlen(before) > head && strncmp(before, text, head) == 0)
        trim_condition(before + head, strlen(before) - head, words);
}

static tn_status add_part(const adding *a, const tn_parts *parts, uint32_t part, uint32_t parent);

/* A frame with the quantifier's words, and in it what is so for a value, once. */
static tn_status add_quantifier(const adding *a, const tn_parts *parts, uint32_t part, uint32_t body, const char *text,
                                uint32_t parent)
{
    char words[TN_RULE_WORDS_MAX];
    bound by = {.outer = a->bound};
    quantifier_words(parts, part, body, text, words, by.names);
    tn_rule_box box = box_of(a, parts, part);
    uint32_t added;
    box.kind = TN_BOX_ROW;
    box.alone = true;
    tn_status status = tn_rule_box_add(a->boxes, parent, box, words, &added, a->error);
    adding inside = *a;
    inside.bound = &by;
    return status == TN_OK ? add_part(&inside, parts, body, added) : status;
}

/* ---- calls of rules with parameters, drawn as what they mean */

enum { CALLS_MAX = 6, DEPTH_MAX = 100, BOXES_MAX = 2000 }; /* calls in calls and parts in parts, within so many boxes */

static bool is_opened(const adding *a, const tn_part *part)
{
    return part->kind == TN_PART_RULE && part->rule == UINT32_MAX && !part->again && a->calls < CALLS_MAX &&
           a->depth < DEPTH_MAX && a->boxes->count < BOXES_MAX;
}

/* Where the parameters stand in the head of the rule that is called, `rule pair(a, b)`: behind its name, before the
 * body that was compiled. NULL: the source has none, or its names are others. */
static const char *find_parameters(const tn_parts *called, const char *text)
{
    const tn_module *module = called->module;
    const tn_source_map_record *body = tn_module_place(module, called->parts[0].root);
    const char *source = body && body->file < module->SOURCE_count
                             ? tn_text(module, module->SOURCE_records[body->file].text)
                             : NULL,
               *found = NULL;
    size_t size = strcspn(text, "(");
    for (const char *at = source; at && (at = strstr(at, "rule ")) && at < source + body->begin; at++) {
        const char *name = at + 5 + strspn(at + 5, " ");
        if ((at == source || !is_name(at[-1])) && strncmp(name, text, size) == 0 && name[size] == '(')
            found = name + size + 1;
    }
    return found;
}

/* The end of an argument of a call: its comma, or the parenthesis behind the last one. */
static const char *end_of_argument(const char *at)
{
    int depth = 0;
    for (; *at && (depth > 0 || (*at != ',' && *at != ')')); at++)
        depth += (*at == '(') - (*at == ')');
    return at;
}

/* The parameter of a call whose name is the word; SIZE_MAX: none is. */
static size_t parameter_of(const call *c, const char *word, size_t size)
{
    size_t number = 0;
    for (const char *at = c->parameters; *at && *at != ')'; at++) {
        bool begins = is_name(*at) && (at == c->parameters || !is_name(at[-1]));
        if (begins && strncmp(at, word, size) == 0 && !is_name(at[size]))
            return number;
        number += *at == ',';
    }
    return SIZE_MAX;
}

/* What stands for a parameter in the call, "tray(v)" of "(tray(v), bath)". */
static const char *argument_of(const call *c, size_t number, size_t *size)
{
    const char *at = c->text + strcspn(c->text, "("), *end = at;
    for (size_t i = 0; i <= number && *end && (i == 0 || *end == ','); i++) {
        at = end + 1 + strspn(end + 1, " ");
        end = end_of_argument(at);
    }
    *size = (size_t)(end - at);
    return at;
}

/* The call in whose body the part is written; NULL: none. Arguments are written where the call is. */
static const call *call_around(const adding *a, const tn_parts *parts, uint32_t part)
{
    const tn_source_map_record *place = tn_module_place(a->module, parts->parts[part].root);
    const call *c = a->call;
    while (c && (!place || !c->body || place->file != c->body->file || place->begin < c->body->begin ||
                 place->end > c->body->end))
        c = c->outer;
    return c;
}

/* Puts what the call says in the place of its parameters in words about a part of its body. */
static void put_arguments(const adding *a, const tn_parts *parts, uint32_t part, char *words, size_t room)
{
    const call *c = call_around(a, parts, part);
    char made[TN_PART_TEXT_MAX + TN_RULE_WORDS_MAX];
    size_t used = 0, size;
    if (!c || !c->parameters)
        return;
    for (const char *at = words; *at && used < sizeof made; at += size) {
        for (size = 0; is_name(at[size]);)
            size++;
        size_t number = size ? parameter_of(c, at, size) : SIZE_MAX, length = size ? size : 1;
        size = length;
        const char *put = number == SIZE_MAX ? at : argument_of(c, number, &length);
        used += (size_t)snprintf(made + used, sizeof made - used, "%.*s", (int)length, put);
    }
    snprintf(words, room, "%s", used ? made : "");
}

/* What the call means, in a frame with its words. */
static tn_status add_called(const adding *a, const tn_parts *called, tn_rule_box box, const char *text, uint32_t parent)
{
    const call c = {find_parameters(called, text), text, tn_module_place(a->module, called->parts[0].root), a->call};
    uint32_t added;
    box.kind = TN_BOX_ROW;
    box.framed = box.alone = true;
    tn_status status = tn_rule_box_add(a->boxes, parent, box, text, &added, a->error);
    adding inside = *a;
    inside.calls++;
    inside.call = &c;
    inside.bound = is_bound(a->bound, text) ? a->bound : NULL; /* otherwise its words are the function's own */
    return status == TN_OK ? add_part(&inside, called, 0, added) : status;
}

static tn_status add_call(const adding *a, const tn_parts *parts, uint32_t part, const char *text, uint32_t parent)
{
    tn_parts called;
    tn_status status = tn_parts_read(a->module, parts->parts[part].function, &called, a->error);
    if (status == TN_OK)
        status = add_called(a, &called, box_of(a, parts, part), text, parent);
    tn_parts_clear(&called);
    return status;
}

/* ---- parts */

/* What `tray(...)` says of a tray that is not the same for all values of a quantifier. */
static void tray_words(char *text)
{
    size_t size = strlen(text);
    if (strncmp(text, "tray(", 5) != 0 || text[size - 1] != ')')
        return;
    memmove(text, text + 5, size - 6);
    text[size - 6] = '\0';
}

static tn_status add_children(const adding *a, const tn_parts *parts, uint32_t part, uint32_t added)
{
    tn_status status = TN_OK;
    for (uint32_t child = parts->parts[part].first; status == TN_OK && child != TN_NO_PART;
         child = parts->parts[child].next)
        if (!tn_part_unwritten(parts, child))
            status = add_part(a, parts, child, added);
    return status;
}

static tn_status add_part(const adding *outer, const tn_parts *parts, uint32_t part, uint32_t parent)
{
    adding inside = *outer, *a = &inside;
    char text[TN_PART_TEXT_MAX], words[TN_RULE_WORDS_MAX];
    tn_rule_box box = box_of(a, parts, part);
    uint32_t added, body;
    a->depth++;
    tn_part_text(parts, part, text, sizeof text);
    put_arguments(a, parts, part, text, sizeof text);
    if (is_opened(a, &parts->parts[part]))
        return add_call(a, parts, part, text, parent);
    body = box.kind == TN_BOX_TAG ? TN_NO_PART : body_of(parts, part, text);
    if (body != TN_NO_PART)
        return add_quantifier(a, parts, part, body, text, parent);
    if (box.kind == TN_BOX_TRAY && is_bound(a->bound, text)) {
        box.kind = TN_BOX_LABEL;
        tray_words(text);
    }
    if (box.kind == TN_BOX_TAG || box.kind == TN_BOX_LABEL)
        return tn_rule_box_add(a->boxes, parent, box, text, &added, a->error);
    words_of(parts, part, words);
    put_arguments(a, parts, part, words, sizeof words);
    tn_status status = tn_rule_box_add(a->boxes, parent, box, words, &added, a->error);
    return status == TN_OK ? add_children(a, parts, part, added) : status;
}

tn_status tn_rule_boxes_read(const tn_module *module, uint32_t function, tn_rule_boxes *boxes, tn_error *error)
{
    tn_parts parts;
    *boxes = (tn_rule_boxes){0};
    const adding a = {.module = module, .boxes = boxes, .error = error};
    tn_status status = tn_parts_read(module, function, &parts, error);
    if (status == TN_OK)
        status = add_part(&a, &parts, 0, TN_NO_BOX);
    tn_parts_clear(&parts);
    return status;
}
