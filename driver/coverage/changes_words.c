/* Changes of tray specifiers. What a word means its schema says, as it does where the specifier is checked. */
#include <string.h>

#include "driver/coverage/changes_walk.h"

/* The words of an item on the way: the field that they are about, and the fill before a depth. */
typedef struct item_words {
    tn_change_walk *walk;
    const tn_field_record *field; /* NULL: not known yet */
    const char *fill;             /* NULL: of any */
} item_words;

static const tn_schema_record *schema_of(const tn_change_walk *walk)
{
    return &walk->module->SCHEMA_records[walk->schema];
}

static const char *field_name(const tn_change_walk *walk, const tn_field_record *field)
{
    return tn_text(walk->module, field->name);
}

static const tn_value_record *value_of(const tn_change_walk *walk, const tn_field_record *field, uint32_t i)
{
    return &walk->module->VALUE_records[field->value_first + i];
}

static const tn_field_record *field_named(const tn_change_walk *walk, const char *name)
{
    for (uint32_t f = 0; f < schema_of(walk)->field_count; f++) {
        const tn_field_record *field = &walk->module->FIELD_records[schema_of(walk)->field_first + f];
        if (strcmp(field_name(walk, field), name) == 0)
            return field;
    }
    return NULL;
}

static bool has_value(const tn_change_walk *walk, const tn_field_record *field, const char *name)
{
    bool named = field->kind == TN_FIELD_CHOICE || field->kind == TN_FIELD_ZONE;
    for (uint32_t i = 0; named && i < field->value_count; i++)
        if (strcmp(tn_text(walk->module, value_of(walk, field, i)->name), name) == 0)
            return true;
    return false;
}

/* The field that has a value of this name; NULL where none has or several have. */
static const tn_field_record *field_with(const tn_change_walk *walk, const char *name)
{
    const tn_field_record *found = NULL;
    for (uint32_t f = 0; f < schema_of(walk)->field_count; f++) {
        const tn_field_record *field = &walk->module->FIELD_records[schema_of(walk)->field_first + f];
        if (!has_value(walk, field, name))
            continue;
        if (found)
            return NULL;
        found = field;
    }
    return found;
}

static const tn_field_record *length_field(const tn_change_walk *walk)
{
    for (uint32_t f = 0; f < schema_of(walk)->field_count; f++) {
        const tn_field_record *field = &walk->module->FIELD_records[schema_of(walk)->field_first + f];
        if (field->kind == TN_FIELD_LENGTH)
            return field;
    }
    return NULL;
}

/* ---- values by their names */

/* The name behind this one, or of the last the one before it; NULL: there is no other. */
static const char *neighbour_of(const tn_change_walk *walk, const tn_field_record *field, const char *name)
{
    const char *before = NULL;
    bool seen = false;
    for (uint32_t i = 0; i < field->value_count; i++) {
        const char *other = tn_text(walk->module, value_of(walk, field, i)->name);
        if (strcmp(other, name) == 0)
            seen = true;
        else if (seen)
            return other;
        else
            before = other;
    }
    return before;
}

static void change_name(tn_change_walk *walk, const tn_field_record *field, tn_ast_word *word)
{
    const char *other = neighbour_of(walk, field, word->text);
    if (other && tn_change_offer(walk, TN_CHANGE_REPLACED, word->node.span, other))
        word->text = other;
}

void tn_change_value(tn_change_walk *walk, tn_ast_word *word)
{
    const tn_field_record *field = word->kind == TN_WORD_NAME ? field_with(walk, word->text) : NULL;
    if (field)
        change_name(walk, field, word);
}

/* A flag that is set, or not: the opposite. */
static void change_flag(item_words *item, const tn_field_record *flag, tn_ast_alternative *alternative)
{
    tn_change_walk *walk = item->walk;
    tn_ast_word *first = (tn_ast_word *)alternative->words.first;
    char to[TN_NAME_MAX + 8] = "not ";
    bool negated = first->kind == TN_WORD_NOT;
    strncat(to, field_name(walk, flag), sizeof to - sizeof "not ");
    const char *text = negated ? to + strlen("not ") : to;
    if (!tn_change_offer(walk, TN_CHANGE_REPLACED, alternative->node.span, text))
        return;
    if (negated) {
        alternative->words = tn_change_without(alternative->words, first);
        return;
    }
    tn_ast_word *no = TN_NEW(walk->arena, tn_ast_word);
    if (!no)
        return;
    *no = (tn_ast_word){.node.span = first->node.span, .kind = TN_WORD_NOT, .text = "not"};
    alternative->words = tn_ast_join(tn_ast_one(no), alternative->words);
}

/* ---- lengths */

/* The value whose length is the next below or above; NULL: there is none. */
static const tn_value_record *next_length(const item_words *item, const tn_field_record *field, int64_t length, bool up)
{
    const tn_value_record *found = NULL;
    for (uint32_t i = 0; i < field->value_count; i++) {
        const tn_value_record *value = value_of(item->walk, field, i);
        bool meant = field->kind != TN_FIELD_ZONE || tn_text(item->walk->module, value->measure)[0];
        if (item->fill && field->kind == TN_FIELD_ZONE)
            meant = meant && strcmp(tn_text(item->walk->module, value->name), item->fill) == 0;
        if (!meant || (up ? value->length <= length : value->length >= length))
            continue;
        if (!found || (up ? value->length < found->length : value->length > found->length))
            found = value;
    }
    return found;
}

/* *word: in a list, or an end of a range, which is replaced by a copy. */
static void length_to(item_words *item, const tn_field_record *field, const tn_ast_word **word, bool up)
{
    const tn_value_record *value = next_length(item, field, (*word)->value, up);
    if (!value)
        return;
    const char *text = tn_text(item->walk->module, field->kind == TN_FIELD_ZONE ? value->measure : value->name);
    if (!tn_change_offer(item->walk, TN_CHANGE_REPLACED, (*word)->node.span, text))
        return;
    tn_ast_word *changed = TN_NEW(item->walk->arena, tn_ast_word);
    if (!changed)
        return;
    *changed = **word;
    changed->value = value->length;
    changed->text = text;
    *word = changed;
}

static void change_length(item_words *item, tn_ast_word *word)
{
    const tn_field_record *field = item->field ? item->field : length_field(item->walk);
    const tn_ast_word *changed = word;
    if (!field || (field->kind != TN_FIELD_LENGTH && field->kind != TN_FIELD_ZONE))
        return;
    item->field = field;
    length_to(item, field, &changed, false);
    length_to(item, field, &changed, true);
    word->value = changed->value;
    word->text = changed->text;
}

static void change_ends(item_words *item, tn_ast_word *range)
{
    const tn_field_record *field = item->field ? item->field : length_field(item->walk);
    if (!field || !range->low || !range->high || range->low->kind != TN_WORD_LENGTH)
        return;
    item->field = field;
    length_to(item, field, &range->low, false);
    length_to(item, field, &range->low, true);
    length_to(item, field, &range->high, false);
    length_to(item, field, &range->high, true);
}

/* ---- items */

static void change_alternatives(item_words *item, tn_ast_list *alternatives);

/* A word that is a field or a value. */
static void change_word(item_words *item, tn_ast_alternative *alternative, tn_ast_word *word)
{
    tn_change_walk *walk = item->walk;
    const tn_field_record *named = field_named(walk, word->text), *owner = field_with(walk, word->text);
    if (item->field && has_value(walk, item->field, word->text))
        owner = item->field;
    else if (named && named->kind == TN_FIELD_FLAG && !owner) {
        change_flag(item, named, alternative);
        item->field = named;
        return;
    } else if (named && (word->node.next || !owner)) {
        item->field = named;
        return;
    }
    if (!owner)
        return;
    item->field = owner;
    item->fill = owner->kind == TN_FIELD_ZONE ? word->text : NULL;
    change_name(walk, owner, word);
}

/* ---- sums that are compared */

static bool has_sign(const tn_ast_alternative *alternative)
{
    for (TN_EACH(const tn_ast_word, word, alternative->words)) {
        if (word->kind == TN_WORD_SIGN)
            return true;
        for (TN_EACH(const tn_ast_alternative, inner, word->group ? word->group->alternatives : tn_ast_empty()))
            if (has_sign(inner))
                return true;
    }
    return false;
}

/* Does it compare numbers of the tray with one another, `width > body`, or come to one by arithmetic? */
static bool compares_sums(const item_words *item, const tn_ast_alternative *alternative)
{
    const tn_ast_word *first = (const tn_ast_word *)alternative->words.first, *op = NULL;
    while (first && first->kind == TN_WORD_NOT)
        first = (const tn_ast_word *)first->node.next;
    for (TN_EACH(const tn_ast_word, word, alternative->words))
        op = word->kind == TN_WORD_OPERATOR ? word : op;
    const tn_ast_word *right = op ? (const tn_ast_word *)op->node.next : NULL;
    const tn_field_record *field =
        first && first->kind == TN_WORD_NAME ? field_named(item->walk, first->text) : item->field;
    bool number = right && right->kind == TN_WORD_NAME && !(field && has_value(item->walk, field, right->text));
    bool turned = op && first->kind != TN_WORD_NAME && first != op;
    return has_sign(alternative) || number || turned;
}

/* The sign of the comparison, and the plain numbers in it: other lengths would most often change nothing. */
static void change_sums(tn_change_walk *walk, tn_ast_alternative *alternative)
{
    for (TN_EACH(tn_ast_word, word, alternative->words)) {
        tn_operator other;
        const char *sign = word->kind == TN_WORD_OPERATOR ? tn_change_other_sign(word->op, &other) : NULL;
        const tn_ast_word *number = word;
        if (sign && tn_change_offer(walk, TN_CHANGE_COMPARED, alternative->node.span, sign))
            word->op = other;
        if (word->kind == TN_WORD_NUMBER) {
            tn_change_bound(walk, &number);
            word->value = number->value;
            word->text = number->text;
        }
        for (TN_EACH(tn_ast_alternative, inner, word->group ? word->group->alternatives : tn_ast_empty()))
            change_sums(walk, inner);
    }
}

static void change_words(item_words *item, tn_ast_alternative *alternative)
{
    if (compares_sums(item, alternative)) {
        change_sums(item->walk, alternative);
        return;
    }
    item->fill = NULL;
    for (TN_EACH(tn_ast_word, word, alternative->words)) {
        if (item->walk->made || item->walk->failed)
            return;
        const tn_ast_word *number = word;
        switch (word->kind) {
        case TN_WORD_NAME:
            change_word(item, alternative, word);
            break;
        case TN_WORD_LENGTH:
            change_length(item, word);
            break;
        case TN_WORD_RANGE:
            change_ends(item, word);
            break;
        case TN_WORD_NUMBER: /* that a number of the tray is compared with */
            tn_change_bound(item->walk, &number);
            word->value = number->value;
            word->text = number->text;
            break;
        case TN_WORD_GROUP:
            change_alternatives(item, &word->group->alternatives);
            break;
        default:
            break;
        }
    }
}

/* Groups nest as deep as they are written, which the parser limits. */
static void change_alternatives(item_words *item, tn_ast_list *alternatives)
{
    for (TN_EACH(tn_ast_alternative, alternative, *alternatives)) {
        if (alternatives->count > 1 && tn_change_offer(item->walk, TN_CHANGE_LEFT_OUT, alternative->node.span, NULL)) {
            *alternatives = tn_change_without(*alternatives, alternative);
            return;
        }
        change_words(item, alternative);
        if (item->walk->made)
            return;
    }
}

void tn_change_items(tn_change_walk *walk, tn_ast_list *items)
{
    for (TN_EACH(tn_ast_item, item, *items)) {
        item_words words = {.walk = walk};
        if (walk->made || walk->failed)
            return;
        if (tn_change_offer(walk, TN_CHANGE_LEFT_OUT, item->node.span, NULL)) {
            *items = tn_change_without(*items, item);
            return;
        }
        change_alternatives(&words, &item->alternatives);
    }
}
