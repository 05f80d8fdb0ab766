/* Tray specifiers: from the words of their items to a mask of values.
 *
 * An item is about one field: alternatives joined by `or`, each of them a value, a comparison or a negation of these.
 * The field is named, or clear from the value.
 */
#include <string.h>

#include "compiler/plan/check/amount.h"

/* One item on the way: the field that its alternatives are about, and the values chosen so far. */
typedef struct tn_item_reader {
    tn_check *check;
    const tn_checked_schema *schema;
    const tn_checked_schema *older; /* the schema that the words are of; NULL: this one */
    uint32_t field;                 /* TN_NONE: not known yet */
    const char *fill;               /* of the alternative before: `dense 4' or 8'` */
    bool chosen[TN_VALUES_MAX];
    bool found[TN_VALUES_MAX]; /* by the alternative at hand */
    bool loose;                /* what is left of the words is another item */
    bool made;                 /* the words are bound ones: no value need be so */
    const tn_ast_word *word;   /* the next to be read; NULL at the end */
    tn_span span;              /* of the alternative */
} tn_item_reader;

static const tn_ast_word *next_word(tn_item_reader *item)
{
    const tn_ast_word *word = item->word;
    item->word = word ? (const tn_ast_word *)word->node.next : NULL;
    return word;
}

static bool skip_nots(tn_item_reader *item)
{
    bool negated = false;
    while (item->word && item->word->kind == TN_WORD_NOT) {
        negated = !negated;
        next_word(item);
    }
    return negated;
}

/* `two floors`, `1.2m glazed`: what comes too late. */
static bool help_order(const tn_item_reader *item, tn_diagnostic *d)
{
    const tn_checked_field *field = &item->schema->fields[item->field];
    const char *word = item->word->kind == TN_WORD_NAME ? item->word->text : "", *value = NULL;
    for (uint32_t v = 0; v < field->value_count && !value; v++)
        value = item->found[v] ? field->values[v].name : NULL;
    if (strcmp(word, field->name) == 0 && value && field->kind != TN_FIELD_FLAG)
        tn_help(item->check->diagnostics, d, "a field comes before its value: `%s %s`", field->name, value);
    else if (field->kind == TN_FIELD_ZONE && tn_field_has(field, word))
        tn_help(item->check->diagnostics, d, "a fill comes before its depth: `%s %s ...`", field->name, word);
    else
        return false;
    return true;
}

/* `covered = bool`: other languages' word for a flag, which is the name of the field's only value here. */
static bool is_truth(const tn_checked_field *field)
{
    static const char *const words[] = {"bool", "boolean", "truth", "logical"};
    for (size_t i = 0; field->value_count == 1 && i < sizeof words / sizeof *words; i++)
        if (tn_field_has(field, words[i]))
            return true;
    return false;
}

__attribute__((format(printf, 3, 4))) static bool bad_item(tn_item_reader *item, tn_span span, const char *format, ...)
{
    char message[300];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    if (item->schema->broken)
        return false;
    tn_diagnostic *d = tn_report(item->check->diagnostics, E_BAD_ITEM, span, "%s", message);
    char legal[400] = "";
    if (item->field != TN_NONE)
        tn_say_values(&item->schema->fields[item->field], NULL, legal, sizeof legal);
    bool flag = item->field != TN_NONE && item->schema->fields[item->field].kind == TN_FIELD_FLAG;
    if (item->word && flag && item->word->kind == TN_WORD_OPERATOR)
        tn_help(item->check->diagnostics, d, "a flag is written alone: `%s`, or `not %s`",
                item->schema->fields[item->field].name, item->schema->fields[item->field].name);
    else if (item->word && flag && item->word->kind == TN_WORD_NOT)
        tn_help(item->check->diagnostics, d, "`not` stands before what it denies: `not %s`",
                item->schema->fields[item->field].name);
    else if (item->word && item->field != TN_NONE && help_order(item, d))
        return false;
    else if (item->word && item->field != TN_NONE)
        tn_help(item->check->diagnostics, d, "items are separated by commas, alternatives joined by `or`");
    else if (item->field != TN_NONE && is_truth(&item->schema->fields[item->field]))
        tn_help(item->check->diagnostics, d,
                "`%s` can only be %s; what a tray has or has not is a flag, in the schema `%s = flag`",
                item->schema->fields[item->field].name, legal, item->schema->fields[item->field].name);
    else if (item->field != TN_NONE && item->schema->fields[item->field].kind != TN_FIELD_FLAG)
        tn_help(item->check->diagnostics, d, "`%s` can be %s", item->schema->fields[item->field].name, legal);
    else {
        tn_say_items(item->schema, legal, sizeof legal);
        tn_help(item->check->diagnostics, d, "write items such as %s", legal);
    }
    return false;
}

/* ---- which field */

static bool set_field(tn_item_reader *item, uint32_t field, const tn_ast_word *word)
{
    if (field == TN_NONE)
        return false;
    if (item->field != TN_NONE && item->field != field) {
        const tn_checked_field *fields = item->schema->fields;
        tn_diagnostic *d = tn_report(item->check->diagnostics, E_OR_ACROSS_FIELDS, word->node.span,
                                     "`or` joins alternatives of one field, and these are `%s` and `%s`",
                                     fields[item->field].name, fields[field].name);
        tn_help(item->check->diagnostics, d, "join two specifiers: `tray(...) or tray(...)`");
        return false;
    }
    item->field = field;
    return true;
}

static bool length_field(tn_item_reader *item, const tn_ast_word *word)
{
    uint32_t field = (item->older ? item->older : item->schema)->length_field;
    if (field != TN_NONE)
        return set_field(item, field, word);
    if (item->schema->broken || word->broken)
        return false;
    tn_diagnostic *d = tn_report(item->check->diagnostics, E_NO_LENGTH_FIELD, word->node.span,
                                 "schema `%s` has no field of lengths", item->schema->name);
    const tn_checked_field *numbers = tn_field_of_numbers(item->schema);
    if (numbers)
        tn_help(item->check->diagnostics, d, "a number stands behind the name of its field: `%s %s`", numbers->name,
                word->text);
    else
        tn_help(item->check->diagnostics, d, "name the zone whose depth it is");
    return false;
}

/* A name at the start of an alternative: a field, or a value whose field is clear. */
static bool field_of_name(tn_item_reader *item)
{
    const tn_ast_word *word = item->word;
    const tn_checked_schema *schema = tn_schema_of_word(item->schema, item->older, word->text);
    if (item->field != TN_NONE && tn_field_has(&schema->fields[item->field], word->text))
        return true;
    uint32_t field = tn_field_find(schema, word->text);
    bool is_value = false;
    for (uint32_t f = 0; f < schema->field_count; f++)
        is_value |= tn_field_has(&schema->fields[f], word->text);
    bool is_flag = field != TN_NONE && schema->fields[field].kind == TN_FIELD_FLAG;
    if (field != TN_NONE && (is_flag ? !is_value : word->node.next || !is_value)) {
        next_word(item);
        if (!set_field(item, field, word))
            return false;
        return is_flag || item->word ||
               bad_item(item, word->node.span, "`%s` is a field; say which `%s`", word->text, word->text);
    }
    if (is_flag) {
        tn_diagnostic *d = tn_report(item->check->diagnostics, E_AMBIGUOUS_VALUE, word->node.span,
                                     "`%s` is a flag and a value of another field", word->text);
        tn_help(item->check->diagnostics, d,
                "name the other field before the value; for the flag, rename one of the two in the schema");
        return false;
    }
    uint32_t owner = tn_value_field(item->check, schema, word);
    return set_field(item, owner, word);
}

static bool find_field(tn_item_reader *item);

/* The field that a group's first alternative is about. */
static bool field_of_group(tn_item_reader *item, const tn_ast_item *group)
{
    const tn_ast_alternative *first = (const tn_ast_alternative *)group->alternatives.first;
    tn_item_reader inner = *item;
    inner.word = (const tn_ast_word *)first->words.first;
    inner.span = first->node.span;
    skip_nots(&inner);
    if (!find_field(&inner))
        return false;
    item->field = inner.field;
    return true;
}

static bool find_field(tn_item_reader *item)
{
    const tn_ast_word *word = item->word;
    if (!word)
        return bad_item(item, item->span, "nothing follows this `not`");
    if (word->kind == TN_WORD_NAME)
        return field_of_name(item);
    if (word->kind == TN_WORD_GROUP)
        return item->field != TN_NONE || field_of_group(item, word->group);
    bool lengths = item->field != TN_NONE && (item->schema->fields[item->field].kind == TN_FIELD_LENGTH ||
                                              item->schema->fields[item->field].kind == TN_FIELD_ZONE ||
                                              item->schema->fields[item->field].measured);
    return lengths || length_field(item, word);
}

/* ---- values */

static bool compares(int64_t left, tn_operator op, int64_t right)
{
    switch (op) {
    case TN_LESS:
        return left < right;
    case TN_AT_MOST:
        return left <= right;
    case TN_EQUAL:
        return left == right;
    case TN_UNEQUAL:
        return left != right;
    case TN_AT_LEAST:
        return left >= right;
    case TN_GREATER:
        return left > right;
    }
    return false;
}

/* A number without a unit. */
static bool is_bare(const tn_ast_word *word)
{
    return word->kind == TN_WORD_NUMBER || (word->kind == TN_WORD_DECIMAL && !strchr(word->text, '%'));
}

/* The length that comes next, where one must. */
static const tn_ast_word *read_length(tn_item_reader *item)
{
    const tn_ast_word *word = next_word(item);
    if (word && word->kind == TN_WORD_LENGTH && !word->broken)
        return word;
    if (word && is_bare(word))
        tn_report_unit(item->check, item->schema, word);
    else if (word && word->kind == TN_WORD_NAME && item->schema->fields[item->field].kind == TN_FIELD_LENGTH)
        tn_report_value(item->check, item->schema, item->field, word);
    else if (!word || !word->broken)
        bad_item(item, word ? word->node.span : item->span, "a length is missing");
    return NULL;
}

static bool mark_range(tn_item_reader *item, const char *fill, const tn_ast_word *range)
{
    const tn_checked_field *field = &item->schema->fields[item->field];
    const tn_ast_range bounds = {range->low, range->high, range->node.span};
    if (range->broken || !tn_check_range(item->check, &bounds, true))
        return false;
    for (uint32_t v = 0; v < field->value_count; v++) {
        const tn_checked_value *value = &field->values[v];
        item->found[v] = (!fill || strcmp(value->name, fill) == 0) && range->low->value <= value->length &&
                         value->length <= range->high->value;
    }
    return true;
}

/* Marks the values whose fill is `fill` (NULL: any) and whose length compares so. A value that must be one of the
 * field's, and is not, is an error. */
static bool mark_lengths(tn_item_reader *item, const char *fill, tn_operator op, const tn_ast_word *word)
{
    const tn_checked_field *field = &item->schema->fields[item->field];
    bool known = false;
    for (uint32_t v = 0; v < field->value_count; v++) {
        const tn_checked_value *value = &field->values[v];
        bool meant = !fill || strcmp(value->name, fill) == 0;
        item->found[v] = meant && compares(value->length, op, word->value);
        known |= meant && value->length == word->value;
    }
    if (known || (op != TN_EQUAL && op != TN_UNEQUAL))
        return true;
    if (!fill) {
        tn_report_value(item->check, item->schema, item->field, word);
        return false;
    }
    if (item->schema->broken)
        return false;
    char legal[400];
    tn_say_values(field, fill, legal, sizeof legal);
    tn_diagnostic *d = tn_report(item->check->diagnostics, E_ILLEGAL_VALUE, word->node.span,
                                 "`%s %s` cannot be %s deep", field->name, fill, word->text);
    tn_note(item->check->diagnostics, d, &field->ast->name->node.span, "`%s` is declared here", field->name);
    tn_help(item->check->diagnostics, d, "it can be %s", legal);
    return false;
}

static bool mark_name(tn_item_reader *item, const tn_ast_word *word)
{
    const tn_checked_field *field = &item->schema->fields[item->field];
    bool known = false;
    for (uint32_t v = 0; v < field->value_count; v++) {
        item->found[v] = word->kind == TN_WORD_NAME && strcmp(field->values[v].name, word->text) == 0;
        known |= item->found[v];
    }
    if (!known)
        tn_report_value(item->check, item->schema, item->field, word);
    return known;
}

static bool read_operator(tn_item_reader *item, tn_operator *op)
{
    *op = TN_EQUAL;
    if (!item->word || item->word->kind != TN_WORD_OPERATOR)
        return false;
    *op = next_word(item)->op;
    return true;
}

static void invert(tn_item_reader *item)
{
    for (uint32_t v = 0; v < item->schema->fields[item->field].value_count; v++)
        item->found[v] = !item->found[v];
}

/* The one value that is marked becomes those that compare so with it. */
static void mark_by_order(tn_item_reader *item, tn_operator op)
{
    uint32_t count = item->schema->fields[item->field].value_count, place = 0;
    while (place < count && !item->found[place])
        place++;
    for (uint32_t v = 0; v < count; v++)
        item->found[v] = compares(v, op, place);
}

/* one..two */
static bool mark_names_between(tn_item_reader *item, const tn_ast_word *range)
{
    bool from[TN_VALUES_MAX];
    uint32_t count = item->schema->fields[item->field].value_count;
    if (range->low->kind != TN_WORD_NAME || !mark_name(item, range->low))
        return range->low->kind != TN_WORD_NAME && bad_item(item, range->node.span, "a range of values is missing");
    mark_by_order(item, TN_AT_LEAST);
    memcpy(from, item->found, sizeof from);
    if (!mark_name(item, range->high))
        return false;
    mark_by_order(item, TN_AT_MOST);
    bool any = false;
    for (uint32_t v = 0; v < count; v++)
        any |= item->found[v] = item->found[v] && from[v];
    if (any)
        return true;
    tn_diagnostic *d =
        tn_report(item->check->diagnostics, E_RANGE_BACKWARDS, range->node.span, "this range ends before it starts");
    tn_help(item->check->diagnostics, d, "write `%s..%s`", range->high->text, range->low->text);
    return false;
}

/* Is the value between the two, or, of one, does it compare so with it? */
static bool number_fits(tn_check *check, const char *number, tn_operator op, const char *low, const char *high)
{
    const char *over = tn_amount_apply(check, TN_EXPR_MINUS, number, low);
    const char *under = high ? tn_amount_apply(check, TN_EXPR_MINUS, number, high) : over;
    if (!over || !under)
        return false;
    int order = tn_amount_is_zero(over) ? 0 : *over == '-' ? -1 : 1;
    return high ? order >= 0 && (tn_amount_is_zero(under) || *under == '-') : compares(order, op, 0);
}

/* A constant beside values that a measure says; NULL: reported. */
static const char *read_number(tn_item_reader *item, const tn_ast_word *word)
{
    const tn_checked_field *field = &item->schema->fields[item->field];
    tn_sum_amount amount = tn_amount_read(item->check, word), both;
    const tn_sum_amount values = {.value = "0", .power = field->power};
    if (!amount.value || !tn_same_power(item->check, values, field->ast->name->node.span, amount, word->node.span,
                                        "compared with", &both))
        return NULL;
    return amount.value;
}

/* [op] number, or a range of them. One that has to be a value of the field, and is not, is an error. */
static bool read_measured(tn_item_reader *item, tn_operator op, const tn_ast_word *word)
{
    const tn_checked_field *field = &item->schema->fields[item->field];
    bool range = word->kind == TN_WORD_RANGE && op == TN_EQUAL, any = false;
    const char *low = read_number(item, range ? word->low : word);
    const char *high = low && range ? read_number(item, word->high) : NULL;
    if (!low || (range && !high))
        return false;
    for (uint32_t v = 0; v < field->value_count; v++)
        any |= item->found[v] = number_fits(item->check, field->values[v].number, op, low, high);
    if (any || range || op != TN_EQUAL)
        return true;
    tn_report_value(item->check, item->schema, item->field, word);
    return false;
}

/* names only: `= double`, `!= double` */
static bool read_name(tn_item_reader *item, tn_operator op)
{
    const tn_ast_word *word = next_word(item);
    bool ordered = item->schema->fields[item->field].ordered;
    if (!word)
        return bad_item(item, item->span, "a value is missing");
    bool measured = item->schema->fields[item->field].measured && word->kind != TN_WORD_NAME;
    if (measured && (is_bare(word) || word->kind == TN_WORD_DECIMAL || word->kind == TN_WORD_AREA ||
                     word->kind == TN_WORD_LENGTH || (word->kind == TN_WORD_RANGE && word->low->kind != TN_WORD_NAME)))
        return read_measured(item, op, word);
    if (word->kind == TN_WORD_RANGE && op == TN_EQUAL && ordered)
        return mark_names_between(item, word);
    if (op != TN_EQUAL && op != TN_UNEQUAL && !ordered)
        return bad_item(item, word->node.span, "names cannot be compared by size");
    if (!mark_name(item, word))
        return false;
    if (ordered)
        mark_by_order(item, op);
    else if (op == TN_UNEQUAL)
        invert(item);
    return true;
}

/* [op] length, or a range */
static bool read_lengths(tn_item_reader *item, const char *fill, tn_operator op, bool compared)
{
    if (item->word && item->word->kind == TN_WORD_RANGE && !compared)
        return mark_range(item, fill, next_word(item));
    const tn_ast_word *length = read_length(item);
    return length && mark_lengths(item, fill, op, length);
}

static bool fill_has_depth(const tn_item_reader *item, const char *fill)
{
    const tn_checked_field *field = &item->schema->fields[item->field];
    for (uint32_t v = 0; v < field->value_count; v++)
        if (field->values[v].has_depth && strcmp(field->values[v].name, fill) == 0)
            return true;
    return false;
}

/* [fill] [op] [length] | depth [op] length */
static bool read_zone(tn_item_reader *item, tn_operator op, bool compared)
{
    const tn_ast_word *word = item->word;
    const char *fill = item->fill;
    if (word && tn_word_is(word, "depth") && !compared &&
        !tn_field_has(&item->schema->fields[item->field], word->text)) {
        next_word(item);
        fill = NULL;
        read_operator(item, &op);
    } else if (word && word->kind == TN_WORD_NAME) {
        if (!read_name(item, op))
            return false;
        item->fill = fill_has_depth(item, word->text) ? word->text : NULL; /* `empty or 8'`: 8' of the others */
        bool ends = !item->word || (item->word->kind != TN_WORD_LENGTH && item->word->kind != TN_WORD_OPERATOR &&
                                    !is_bare(item->word) && item->word->kind != TN_WORD_RANGE);
        if (ends)
            return true;
        fill = word->text;
        if (read_operator(item, &op) && compared)
            return bad_item(item, item->span, "one comparison is enough");
    }
    return read_lengths(item, fill, op, compared);
}

static bool read_alternative(tn_item_reader *item, const tn_ast_alternative *alternative);

/* `(a or b)`: what any of them chooses, or, negated, what none does. Groups nest as deep as they are written, which the
 * parser limits. */
static bool read_group(tn_item_reader *item, bool negated)
{
    const tn_ast_word *word = next_word(item);
    tn_item_reader inner = {
        .check = item->check, .schema = item->schema, .older = item->older, .field = item->field, .made = item->made};
    bool good = true;
    for (TN_EACH(const tn_ast_alternative, alternative, word->group->alternatives))
        good &= read_alternative(&inner, alternative);
    if (good && item->word)
        good = bad_item(item, item->word->node.span, "`%s` does not belong to the item about `%s`", item->word->text,
                        item->schema->fields[item->field].name);
    for (uint32_t v = 0; v < item->schema->fields[item->field].value_count; v++)
        item->chosen[v] |= inner.chosen[v] != negated;
    return good;
}

/* [field] [not] [op] value */
static bool read_alternative(tn_item_reader *item, const tn_ast_alternative *alternative)
{
    item->word = (const tn_ast_word *)alternative->words.first;
    item->span = alternative->node.span;
    memset(item->found, 0, sizeof item->found);
    bool negated = skip_nots(item);
    if (!find_field(item))
        return false;
    const tn_checked_field *field = &item->schema->fields[item->field];
    tn_operator op = TN_EQUAL;
    bool good = true;
    if (field->kind == TN_FIELD_FLAG && !(item->word && item->word->kind == TN_WORD_GROUP)) {
        item->found[1] = true;
    } else {
        negated ^= skip_nots(item);
        if (item->word && item->word->kind == TN_WORD_GROUP)
            return read_group(item, negated);
        bool compared = read_operator(item, &op);
        if (field->kind == TN_FIELD_LENGTH) {
            good = read_lengths(item, NULL, op, compared);
        } else {
            good = field->kind == TN_FIELD_CHOICE ? read_name(item, op) : read_zone(item, op, compared);
        }
    }
    if (good && item->word && !item->loose)
        good = bad_item(item, item->word->node.span, "`%s` does not belong to the item about `%s`", item->word->text,
                        field->name);
    if (good && negated)
        invert(item);
    for (uint32_t v = 0; v < field->value_count; v++)
        item->chosen[v] |= item->found[v];
    return good;
}

static bool read_item(tn_item_reader *item, const tn_ast_item *ast)
{
    bool good = true;
    for (TN_EACH(const tn_ast_alternative, alternative, ast->alternatives))
        good &= read_alternative(item, alternative);
    if (!good)
        return false;
    const tn_checked_field *field = &item->schema->fields[item->field];
    for (uint32_t v = 0; v < field->value_count; v++)
        if (item->chosen[v])
            return true;
    if (item->made || ast->made)
        return true;
    if (item->schema->broken)
        return false;
    char legal[400];
    tn_say_values(field, NULL, legal, sizeof legal);
    tn_diagnostic *d =
        tn_report(item->check->diagnostics, E_NO_SUCH_VALUE, ast->node.span, "no `%s` is so", field->name);
    tn_note(item->check->diagnostics, d, &field->ast->name->node.span, "`%s` is declared here", field->name);
    tn_help(item->check->diagnostics, d, "it can be %s", legal);
    return false;
}

/* ---- masks */

static void set_bit(tn_checked_spec *spec, uint32_t bit)
{
    spec->mask[bit / 64] |= UINT64_C(1) << (bit % 64);
}

static void clear_bit(tn_checked_spec *spec, uint32_t bit)
{
    spec->mask[bit / 64] &= ~(UINT64_C(1) << (bit % 64));
}

/* Equal masks of one schema share a specifier. */
static tn_checked_spec *share(tn_check *check, tn_checked_spec *spec)
{
    if (spec->broken)
        return spec;
    size_t size = 16 + 17 * (size_t)spec->schema->words, used = 0;
    char *key = tn_arena_alloc(check->arena, size);
    if (!key)
        return NULL;
    used += (size_t)snprintf(key, size, "%u", (unsigned)spec->schema->index);
    for (uint32_t w = 0; w < spec->schema->words; w++)
        used += (size_t)snprintf(key + used, size - used, " %llx", (unsigned long long)spec->mask[w]);
    tn_checked_spec *same = tn_names_get(&check->specs, key);
    if (same)
        return same;
    spec->key = key;
    tn_names_put(&check->specs, key, spec);
    return spec;
}

static tn_checked_spec *new_spec(tn_arena *arena, tn_checked_schema *schema, tn_span span)
{
    tn_checked_spec *spec = TN_NEW(arena, tn_checked_spec);
    if (!spec)
        return NULL;
    *spec = (tn_checked_spec){.schema = schema, .span = span, .index = TN_NONE, .broken = schema->broken};
    spec->mask = TN_NEW_ARRAY(arena, uint64_t, schema->words);
    return spec->mask ? spec : NULL;
}

static void allow_all(tn_checked_spec *spec, uint32_t field)
{
    const tn_checked_field *f = &spec->schema->fields[field];
    for (uint32_t v = 0; v < f->value_count; v++)
        set_bit(spec, f->first_bit + v);
}

tn_checked_spec *tn_check_any(tn_check *check, tn_checked_schema *schema, tn_span span)
{
    tn_checked_spec *spec = new_spec(check->arena, schema, span);
    for (uint32_t f = 0; spec && f < schema->field_count; f++)
        allow_all(spec, f);
    return spec ? share(check, spec) : NULL;
}

tn_checked_spec *tn_box_spec(tn_check *check, tn_checked_schema *schema, const uint64_t *mask, tn_span span)
{
    tn_checked_spec *spec = new_spec(check->arena, schema, span);
    if (!spec)
        return NULL;
    memcpy(spec->mask, mask, schema->words * sizeof *mask);
    return share(check, spec);
}

tn_checked_spec *tn_value_spec(tn_arena *arena, tn_checked_schema *schema, uint32_t field, uint32_t value, tn_span span)
{
    tn_checked_spec *spec = new_spec(arena, schema, span);
    for (uint32_t f = 0; spec && f < schema->field_count; f++)
        if (f != field)
            allow_all(spec, f);
    if (spec)
        set_bit(spec, schema->fields[field].first_bit + value);
    return spec;
}

tn_checked_spec *tn_check_value_spec(tn_check *check, tn_checked_schema *schema, uint32_t field, uint32_t value,
                                     tn_span span)
{
    tn_checked_spec *spec = tn_value_spec(check->arena, schema, field, value, span);
    return spec ? share(check, spec) : NULL;
}

/* Leaves the values that an item lets in; items of one field mean both. In an open plan an item ends where it is whole.
 */
static void narrow_by_item(tn_check *check, tn_checked_spec *spec, const tn_checked_schema *older,
                           const tn_ast_item *ast, bool loose)
{
    const tn_checked_schema *schema = spec->schema;
    tn_ast_alternative rest = {.node = {.span = ast->node.span}};
    tn_ast_item one = *ast;
    for (;;) {
        tn_item_reader item = {
            .check = check, .schema = schema, .older = older, .field = TN_NONE, .made = ast->made, .loose = loose};
        if (!read_item(&item, &one)) {
            spec->broken = true;
            return;
        }
        const tn_checked_field *field = &schema->fields[item.field];
        for (uint32_t v = 0; v < field->value_count; v++)
            if (!item.chosen[v])
                clear_bit(spec, field->first_bit + v);
        if (!item.word)
            return;
        rest.words = (tn_ast_list){.first = &((tn_ast_word *)(uintptr_t)item.word)->node, .count = 1};
        one.alternatives = tn_ast_one(&rest);
    }
}

tn_checked_spec *tn_check_spec(tn_check *check, tn_checked_schema *schema, const tn_checked_schema *older,
                               const tn_ast_expr *tray)
{
    tn_checked_spec *spec = new_spec(check->arena, schema, tray->node.span);
    if (!spec)
        return NULL;
    for (uint32_t f = 0; f < schema->field_count; f++)
        allow_all(spec, f);
    for (TN_EACH(const tn_ast_item, ast, tray->items))
        narrow_by_item(check, spec, older, ast, tray->loose && ast->alternatives.count == 1);
    return share(check, spec);
}

tn_checked_spec *tn_check_alternative(tn_check *check, tn_checked_schema *schema, const tn_ast_word *first,
                                      tn_span span, tn_item_context *context)
{
    tn_checked_spec *spec = new_spec(check->arena, schema, span);
    tn_item_reader item = {.check = check, .schema = schema, .field = context->field, .fill = context->fill};
    tn_ast_alternative alternative = {.node.span = span};
    alternative.words.first = (tn_ast_node *)(uintptr_t)first; /* only read */
    if (!spec || !read_alternative(&item, &alternative))
        return NULL;
    *context = (tn_item_context){.field = item.field, .fill = item.fill};
    for (uint32_t f = 0; f < schema->field_count; f++)
        if (f != item.field)
            allow_all(spec, f);
    for (uint32_t v = 0; v < schema->fields[item.field].value_count; v++)
        if (item.chosen[v])
            set_bit(spec, schema->fields[item.field].first_bit + v);
    return share(check, spec);
}
