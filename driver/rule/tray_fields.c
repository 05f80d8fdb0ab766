#include "driver/rule/tray_fields.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/buffer.h"
#include "runtime/module/code.h"

/* ---- fields and values */

static const char *name_of(const tn_schema *schema, tn_string name)
{
    return tn_text(schema->module, name);
}

static const tn_value_record *value_of(const tn_schema *schema, uint32_t field, uint32_t value)
{
    return &schema->values[schema->value_start[field] + value];
}

static uint32_t value_count(const tn_schema *schema, uint32_t field)
{
    return schema->fields[field].value_count;
}

static const char *value_name(const tn_schema *schema, uint32_t field, uint32_t value)
{
    return name_of(schema, value_of(schema, field, value)->name);
}

static bool has_value(const tn_schema *schema, uint32_t field, const char *name)
{
    for (uint32_t v = 0; v < value_count(schema, field); v++)
        if (strcmp(value_name(schema, field, v), name) == 0)
            return true;
    return false;
}

/* The only field with a value of this name, or UINT32_MAX. */
static uint32_t owner_of(const tn_schema *schema, const char *name)
{
    uint32_t owner = UINT32_MAX, owners = 0;
    for (uint32_t f = 0; f < schema->field_count; f++) {
        if (!has_value(schema, f, name))
            continue;
        owner = f;
        owners++;
    }
    return owners == 1 ? owner : UINT32_MAX;
}

/* ---- items */

static const tn_ast_word *first_word(const tn_ast_alternative *alternative)
{
    const tn_ast_word *word = (const tn_ast_word *)alternative->words.first;
    while (word && word->kind == TN_WORD_NOT)
        word = (const tn_ast_word *)word->node.next;
    return word;
}

bool tn_item_denies(const tn_ast_item *item)
{
    const tn_ast_alternative *first = (const tn_ast_alternative *)item->alternatives.first;
    const tn_ast_word *word = first ? (const tn_ast_word *)first->words.first : NULL;
    return word && word->kind == TN_WORD_NOT;
}

/* A name at the start of an item: a field, or a value whose field is clear (compiler/plan/check/spec.c). */
static uint32_t field_of_name(const tn_schema *schema, const tn_ast_word *word)
{
    uint32_t field = tn_schema_field(schema, word->text);
    bool is_value = false;
    for (uint32_t f = 0; f < schema->field_count; f++)
        is_value |= schema->fields[f].kind != TN_FIELD_FLAG && has_value(schema, f, word->text);
    bool flag = field != UINT32_MAX && schema->fields[field].kind == TN_FIELD_FLAG;
    if (field != UINT32_MAX && (flag ? !is_value : word->node.next || !is_value))
        return field;
    return owner_of(schema, word->text);
}

/* Does an item compare numbers of the tray with one another, `width > 2 * body`? It is about no field alone. */
static bool compares_sums(const tn_schema *schema, const tn_ast_item *item)
{
    for (TN_EACH(const tn_ast_alternative, alternative, item->alternatives)) {
        const tn_ast_word *first = first_word(alternative), *before = NULL;
        uint32_t field = first && first->kind == TN_WORD_NAME ? tn_schema_field(schema, first->text) : UINT32_MAX;
        for (TN_EACH(const tn_ast_word, word, alternative->words)) {
            bool compared = before && before->kind == TN_WORD_OPERATOR && word->kind == TN_WORD_NAME;
            bool value = field != UINT32_MAX && compared && has_value(schema, field, word->text);
            if (word->kind == TN_WORD_SIGN || (compared && !value) ||
                (word->group && compares_sums(schema, word->group)))
                return true;
            before = word;
        }
    }
    return false;
}

uint32_t tn_item_field(const tn_schema *schema, const tn_ast_item *item)
{
    const tn_ast_alternative *first = (const tn_ast_alternative *)item->alternatives.first;
    const tn_ast_word *word = first && !compares_sums(schema, item) ? first_word(first) : NULL;
    if (!word)
        return UINT32_MAX;
    if (word->kind == TN_WORD_RANGE)
        word = word->low;
    switch (word->kind) {
    case TN_WORD_NAME:
        return field_of_name(schema, word);
    case TN_WORD_GROUP:
        return tn_item_field(schema, word->group);
    default:
        return tn_schema_length_field(schema);
    }
}

/* Does a value's name alone say which field is meant? */
static bool is_clear(const tn_schema *schema, uint32_t field, const char *value)
{
    return owner_of(schema, value) == field && tn_schema_field(schema, value) == UINT32_MAX;
}

char *tn_item_text(const tn_schema *schema, uint32_t field, uint32_t value, bool whole_fill)
{
    const tn_field_record *record = &schema->fields[field];
    const char *name = name_of(schema, record->name), *word = value_name(schema, field, value),
               *depth = name_of(schema, value_of(schema, field, value)->measure);
    tn_buffer text = {0};
    bool bare =
        record->kind == TN_FIELD_LENGTH ? tn_schema_length_field(schema) == field : is_clear(schema, field, word);
    if (record->kind == TN_FIELD_FLAG)
        tn_buffer_printf(&text, "%s%s", value == 0 ? "not " : "", name);
    else if (record->kind == TN_FIELD_ZONE)
        tn_buffer_printf(&text, "%s %s%s%s", name, word, *depth && !whole_fill ? " " : "", whole_fill ? "" : depth);
    else
        tn_buffer_printf(&text, "%s%s%s", bare ? "" : name, bare ? "" : " ", word);
    return text.data;
}

/* ---- specifiers */

static bool is_there(const tn_source_map_record *place, uint32_t file, tn_text_stretch at)
{
    return place && place->file == file && place->begin == at.begin && place->end == at.end;
}

static bool same_masks(const tn_module *module, uint32_t a, uint32_t b)
{
    const tn_schema_record *x = &module->SCHEMA_records[module->SPEC_records[a].schema];
    uint32_t values = 0;
    if (module->SPEC_records[a].schema != module->SPEC_records[b].schema)
        return false;
    for (uint32_t f = 0; f < x->field_count; f++)
        values += module->FIELD_records[x->field_first + f].value_count;
    for (uint32_t word = 0; word < (values + 63) / 64; word++)
        if (tn_spec_word(module, a, word) != tn_spec_word(module, b, word))
            return false;
    return true;
}

/* Of one schema: the same values of one field. */
static bool same_values(const tn_schema *schema, uint32_t field, uint32_t a, uint32_t b)
{
    for (uint32_t v = 0; v < value_count(schema, field); v++) {
        uint32_t bit = schema->value_start[field] + v;
        if ((tn_spec_word(schema->module, a, bit / 64) ^ tn_spec_word(schema->module, b, bit / 64)) >> (bit % 64) & 1)
            return false;
    }
    return true;
}

/* What is asked of the tray's specifiers; schema NULL: all of them are to be the same. */
typedef struct sought {
    const tn_module *module;
    const tn_schema *schema;
    uint32_t field, file;
    tn_text_stretch place;
} sought;

static bool counts(const sought *s, uint32_t spec)
{
    const tn_schema_record *of = &s->module->SCHEMA_records[s->module->SPEC_records[spec].schema];
    return !s->schema || of == s->schema->record;
}

static bool alike(const sought *s, uint32_t a, uint32_t b)
{
    return s->schema ? same_values(s->schema, s->field, a, b) : same_masks(s->module, a, b);
}

static uint32_t find_spec(const sought *s)
{
    const tn_module *module = s->module;
    uint32_t found = UINT32_MAX;
    for (uint32_t f = 0; f < module->FUNCTION_count; f++) {
        const tn_function_record *function = &module->FUNCTION_records[f];
        if (!tn_function_is_whole(function) && function->kind != TN_FUNCTION_HOLDS)
            continue;
        for (uint32_t at = function->code_begin; at < function->code_end;) {
            tn_instruction it = tn_code_read(module->code, at);
            uint32_t spec = (uint32_t)it.first;
            bool here =
                it.opcode == TN_OP_TRAY && is_there(tn_module_place(module, at), s->file, s->place) && counts(s, spec);
            if (here && found != UINT32_MAX && !alike(s, found, spec))
                return UINT32_MAX;
            found = here ? spec : found;
            at += it.length;
        }
    }
    return found;
}

uint32_t tn_tray_spec(const tn_module *module, uint32_t file, tn_text_stretch place)
{
    return find_spec(&(sought){.module = module, .file = file, .place = place});
}

uint32_t tn_tray_field_spec(const tn_schema *schema, uint32_t field, uint32_t file, tn_text_stretch place)
{
    return find_spec(
        &(sought){.module = schema->module, .schema = schema, .field = field, .file = file, .place = place});
}

/* ---- steps */

typedef struct stepping {
    const tn_schema *schema;
    uint32_t spec, field;
    bool said, deep; /* an item is about the field; it has a depth */
} stepping;

/* Of a field that no item is about all values are: what leaves some out is a parameter, by what one call gives it. */
static bool allows(const stepping *s, uint32_t value)
{
    uint32_t bit = s->schema->value_start[s->field] + value;
    return !s->said || s->spec == UINT32_MAX || tn_spec_word(s->schema->module, s->spec, bit / 64) >> (bit % 64) & 1;
}

static bool same_fill(const stepping *s, uint32_t a, uint32_t b)
{
    return strcmp(value_name(s->schema, s->field, a), value_name(s->schema, s->field, b)) == 0;
}

/* How many of the values, or of those with one's fill, are allowed; *first is the first of them. */
static uint32_t count_allowed(const stepping *s, uint32_t fill, uint32_t *first, uint32_t *all)
{
    uint32_t count = 0;
    *all = 0;
    for (uint32_t v = value_count(s->schema, s->field); v-- > 0;) {
        if (fill != UINT32_MAX && !same_fill(s, v, fill))
            continue;
        ++*all;
        if (!allows(s, v))
            continue;
        *first = v;
        count++;
    }
    return count;
}

/* The next of the values behind one that is of another fill, or, of depths, of the same; UINT32_MAX: there is none. */
static uint32_t next_value(const stepping *s, uint32_t value, tn_tray_sign sign)
{
    bool zone = s->schema->fields[s->field].kind == TN_FIELD_ZONE;
    for (uint32_t v = value + 1; v < value_count(s->schema, s->field); v++)
        if (!zone || same_fill(s, v, value) == (sign == TN_SIGN_DEPTH))
            return v;
    return UINT32_MAX;
}

/* Flags begin with what they are, and then what they are not. */
static uint32_t step_flag(uint32_t count, uint32_t value)
{
    return count > 1 ? 1 : value == 1 ? 0 : UINT32_MAX;
}

/* The value that the sign shows next: UINT32_MAX is any. *whole: of a zone, whatever its depth. */
static uint32_t step(const stepping *s, tn_tray_sign sign, bool *whole, char *why)
{
    uint32_t value = 0, all = 0, count = count_allowed(s, UINT32_MAX, &value, &all), depths;
    bool zone = s->schema->fields[s->field].kind == TN_FIELD_ZONE;
    *whole = zone && sign == TN_SIGN_VALUE;
    if (s->schema->fields[s->field].kind == TN_FIELD_FLAG)
        return step_flag(count, value);
    uint32_t of_fill = zone ? count_allowed(s, value, &value, &depths) : 1;
    bool any = count == all && !(s->said && count == of_fill); /* what is said may be all that there is */
    if (!zone || sign == TN_SIGN_VALUE)
        return any ? 0 : count == of_fill ? next_value(s, value, sign) : UINT32_MAX;
    if (any || of_fill != count)
        snprintf(why, TN_WHY_MAX, "say first what fills the zone; then it has a depth");
    else if (!*name_of(s->schema, value_of(s->schema, s->field, value)->measure))
        snprintf(why, TN_WHY_MAX, "`%s %s` has no depths", name_of(s->schema, s->schema->fields[s->field].name),
                 value_name(s->schema, s->field, value));
    uint32_t next = !s->deep && of_fill == depths ? value : of_fill == 1 ? next_value(s, value, sign) : UINT32_MAX;
    *whole = next == UINT32_MAX;
    return next == UINT32_MAX ? value : next; /* its fill stays */
}

/* Which of the tray's items is about the field; UINT32_MAX: none. *count: how many are. */
static uint32_t item_about(const tn_schema *schema, const tn_ast_expr *tray, uint32_t field, uint32_t *count)
{
    uint32_t found = UINT32_MAX, index = 0;
    *count = 0;
    for (TN_EACH(const tn_ast_item, item, tray->items)) {
        if (tn_item_field(schema, item) == field) {
            found = index;
            ++*count;
        }
        index++;
    }
    return found;
}

static const tn_ast_item *item_at(const tn_ast_expr *tray, uint32_t index)
{
    for (TN_EACH(const tn_ast_item, item, tray->items))
        if (index-- == 0)
            return item;
    return NULL;
}

static bool has_length(const tn_ast_item *item)
{
    const tn_ast_alternative *first = item ? (const tn_ast_alternative *)item->alternatives.first : NULL;
    for (const tn_ast_node *word = first ? first->words.first : NULL; word; word = word->next)
        if (((const tn_ast_word *)word)->kind == TN_WORD_LENGTH)
            return true;
    return false;
}

/* Where an item about the field goes: items stand in the order of the schema's fields. */
static uint32_t place_of_item(const tn_schema *schema, const tn_ast_expr *tray, uint32_t field)
{
    uint32_t place = 0;
    for (TN_EACH(const tn_ast_item, item, tray->items)) {
        if (tn_item_field(schema, item) > field)
            break;
        place++;
    }
    return place;
}

tn_status tn_tray_step(const tn_schema *schema, const tn_rule_tree *tree, uint32_t part, uint32_t spec, uint32_t field,
                       tn_tray_sign sign, tn_rule_edit *edit, char **text, char why[TN_WHY_MAX], tn_error *error)
{
    const tn_rule_part *tray = &tree->parts[part];
    uint32_t count = 0, item = UINT32_MAX;
    bool whole;
    *text = NULL;
    if (tray->kind != TN_RULE_PART_TRAY && tray->kind != TN_RULE_PART_ANY)
        snprintf(why, TN_WHY_MAX, "only a tray has signs");
    else
        item = item_about(schema, tray->expr, field, &count);
    if (count > 1)
        snprintf(why, TN_WHY_MAX, "the tray says %u things of `%s`; change one of them", count,
                 name_of(schema, schema->fields[field].name));
    else if (count == 1 && spec == UINT32_MAX)
        snprintf(why, TN_WHY_MAX, "the tray has a word that stands for several values; change its text");
    if (*why)
        return TN_OK;
    const stepping s = {schema, spec, field, count > 0, count > 0 && has_length(item_at(tray->expr, item))};
    uint32_t next = step(&s, sign, &whole, why);
    if (*why)
        return TN_OK;
    *edit = (tn_rule_edit){.operation = next == UINT32_MAX   ? TN_RULE_CLEAR
                                        : item != UINT32_MAX ? TN_RULE_SET
                                                             : TN_RULE_ADD,
                           .part = part,
                           .item = item != UINT32_MAX ? item : place_of_item(schema, tray->expr, field),
                           .at = TN_NO_RULE_PART,
                           .from = TN_NO_RULE_PART};
    if (next == UINT32_MAX && item == UINT32_MAX)
        snprintf(why, TN_WHY_MAX, "`%s` has one value only", name_of(schema, schema->fields[field].name));
    if (next == UINT32_MAX)
        return TN_OK;
    *text = tn_item_text(schema, field, next, whole);
    edit->text = *text;
    return *text ? TN_OK : tn_fail_memory(error);
}
