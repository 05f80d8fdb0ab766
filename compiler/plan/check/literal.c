/* Plans written out in tests: [4' | 8' double | 12' public]. What is not written takes its first value. */
#include <string.h>

#include "compiler/common/limits.h"
#include "compiler/plan/check/check.h"

/* One tray on the way. */
typedef struct tn_tray_reader {
    tn_check *check;
    const tn_checked_schema *schema;
    const tn_ast_word *word;                   /* the next to be read; NULL at the end */
    const tn_ast_word *written[TN_FIELDS_MAX]; /* where a field's value is written */
    uint8_t *values;
} tn_tray_reader;

static const tn_ast_word *next_word(tn_tray_reader *tray)
{
    const tn_ast_word *word = tray->word;
    tray->word = word ? (const tn_ast_word *)word->node.next : NULL;
    return word;
}

static bool set(tn_tray_reader *tray, uint32_t field, uint32_t value, const tn_ast_word *word)
{
    if (tray->written[field]) {
        tn_diagnostic *d = tn_report(tray->check->diagnostics, E_FIELD_TWICE, word->node.span,
                                     "`%s` is written twice in one tray", tray->schema->fields[field].name);
        tn_note(tray->check->diagnostics, d, &tray->written[field]->node.span, "the first time is here");
        tn_help(tray->check->diagnostics, d, "a tray has one `%s`; trays are separated by `|`",
                tray->schema->fields[field].name);
        return false;
    }
    tray->written[field] = word;
    tray->values[field] = (uint8_t)value;
    return true;
}

static bool misread(tn_tray_reader *tray, const tn_ast_word *word, const char *message, const char *help)
{
    if (word->broken || tray->schema->broken)
        return false;
    tn_diagnostic *d = tn_report(tray->check->diagnostics, E_BAD_ITEM, word->node.span, "%s", message);
    tn_help(tray->check->diagnostics, d, "%s", help);
    return false;
}

static bool set_length(tn_tray_reader *tray, uint32_t field, const tn_ast_word *word)
{
    const tn_checked_field *f = &tray->schema->fields[field];
    for (uint32_t v = 0; v < f->value_count; v++)
        if (!word->broken && f->values[v].length == word->value)
            return set(tray, field, v, word);
    tn_report_value(tray->check, tray->schema, field, word);
    return false;
}

static bool set_choice(tn_tray_reader *tray, uint32_t field, const tn_ast_word *word)
{
    const tn_checked_field *f = &tray->schema->fields[field];
    for (uint32_t v = 0; v < f->value_count; v++)
        if (word->kind == TN_WORD_NAME && strcmp(f->values[v].name, word->text) == 0)
            return set(tray, field, v, word);
    tn_report_value(tray->check, tray->schema, field, word);
    return false;
}

/* A fill, and the depth that may follow: without one it has its first. */
static bool set_fill(tn_tray_reader *tray, uint32_t field, const tn_ast_word *fill)
{
    const tn_checked_field *f = &tray->schema->fields[field];
    const tn_ast_word *depth = tray->word && tray->word->kind == TN_WORD_LENGTH ? next_word(tray) : NULL;
    bool known = false;
    for (uint32_t v = 0; v < f->value_count; v++) {
        if (fill->kind != TN_WORD_NAME || strcmp(f->values[v].name, fill->text) != 0)
            continue;
        known = true;
        if (!depth || (f->values[v].has_depth && f->values[v].length == depth->value))
            return set(tray, field, v, fill);
    }
    if (!known || depth->broken || tray->schema->broken) {
        tn_report_value(tray->check, tray->schema, field, fill);
        return false;
    }
    char legal[400];
    tn_say_values(f, fill->text, legal, sizeof legal);
    tn_diagnostic *d = tn_report(tray->check->diagnostics, E_ILLEGAL_VALUE, depth->node.span,
                                 "`%s %s` cannot be %s deep", f->name, fill->text, depth->text);
    tn_note(tray->check->diagnostics, d, &f->ast->name->node.span, "`%s` is declared here", f->name);
    tn_help(tray->check->diagnostics, d,
            "it can be %s; a length after a zone belongs to the zone: write others before it", legal);
    return false;
}

/* A zone by its depth alone, where only one fill has that. */
static bool set_depth(tn_tray_reader *tray, uint32_t field, const tn_ast_word *depth)
{
    const tn_checked_field *f = &tray->schema->fields[field];
    uint32_t found = TN_NONE, count = 0;
    for (uint32_t v = 0; v < f->value_count; v++) {
        if (depth->broken || !f->values[v].has_depth || f->values[v].length != depth->value)
            continue;
        found = v;
        count++;
    }
    if (count == 1)
        return set(tray, field, found, depth);
    if (count > 1)
        return misread(tray, depth, "several fills have this depth", "write the fill before the depth");
    tn_report_value(tray->check, tray->schema, field, depth);
    return false;
}

/* What follows a field's name. */
static bool read_named(tn_tray_reader *tray, uint32_t field, const tn_ast_word *name)
{
    tn_field_kind kind = tray->schema->fields[field].kind;
    if (kind == TN_FIELD_FLAG)
        return set(tray, field, 1, name);
    const tn_ast_word *word = next_word(tray);
    if (!word) {
        const tn_checked_value *value = &tray->schema->fields[field].values[0];
        char help[400];
        snprintf(help, sizeof help, "write its value after its name, such as `%s %s%s%s`", name->text, value->name,
                 value->has_depth ? " " : "", value->has_depth ? value->measure : "");
        return misread(tray, name, "this field has no value here", help);
    }
    if (word->kind == TN_WORD_NUMBER) {
        tn_report_unit(tray->check, tray->schema, word);
        return false;
    }
    if (kind == TN_FIELD_CHOICE)
        return set_choice(tray, field, word);
    if (kind == TN_FIELD_LENGTH)
        return set_length(tray, field, word);
    return word->kind == TN_WORD_LENGTH ? set_depth(tray, field, word) : set_fill(tray, field, word);
}

static bool read_name(tn_tray_reader *tray, const tn_ast_word *word)
{
    const tn_checked_schema *schema = tray->schema;
    uint32_t field = tn_field_find(schema, word->text);
    bool is_value = false;
    for (uint32_t f = 0; f < schema->field_count; f++)
        is_value |= tn_field_has(&schema->fields[f], word->text);
    bool is_flag = field != TN_NONE && schema->fields[field].kind == TN_FIELD_FLAG;
    bool value_follows = false;
    if (field != TN_NONE && tray->word && !is_flag)
        value_follows = tray->word->kind != TN_WORD_NAME ? schema->fields[field].kind != TN_FIELD_CHOICE
                                                         : tn_field_has(&schema->fields[field], tray->word->text);
    if (field != TN_NONE && (!is_value || value_follows))
        return read_named(tray, field, word);
    uint32_t owner = tn_value_field(tray->check, schema, word);
    if (owner == TN_NONE)
        return false;
    return schema->fields[owner].kind == TN_FIELD_ZONE ? set_fill(tray, owner, word) : set_choice(tray, owner, word);
}

/* not FLAG */
static bool read_not(tn_tray_reader *tray, const tn_ast_word *negation)
{
    const tn_ast_word *word = next_word(tray);
    uint32_t field = word && word->kind == TN_WORD_NAME ? tn_field_find(tray->schema, word->text) : TN_NONE;
    if (field != TN_NONE && tray->schema->fields[field].kind == TN_FIELD_FLAG)
        return set(tray, field, 0, word);
    return misread(tray, word ? word : negation, "in a plan only a flag can be negated",
                   "write the value that the tray has");
}

static bool read_word(tn_tray_reader *tray)
{
    const tn_ast_word *word = next_word(tray);
    if (word->kind == TN_WORD_NAME)
        return read_name(tray, word);
    if (word->kind == TN_WORD_NOT)
        return read_not(tray, word);
    if (word->kind == TN_WORD_NUMBER) {
        tn_report_unit(tray->check, tray->schema, word);
        return false;
    }
    if (tray->schema->length_field != TN_NONE)
        return set_length(tray, tray->schema->length_field, word);
    if (tray->schema->broken || word->broken)
        return false;
    tn_diagnostic *d = tn_report(tray->check->diagnostics, E_NO_LENGTH_FIELD, word->node.span,
                                 "schema `%s` has no field of lengths", tray->schema->name);
    tn_help(tray->check->diagnostics, d, "write a length after the zone whose depth it is");
    return false;
}

/* ---- trays as plan lines have them: a value for each field, in the order of the schema */

static bool is_line(const tn_ast_tray *ast)
{
    for (TN_EACH(const tn_ast_word, word, ast->words))
        if (word->kind == TN_WORD_ABSENT || word->kind == TN_WORD_OF_DEPTH)
            return true;
    return false;
}

/* The `:` and the depth after a fill; the `:` is passed over. */
static bool find_depth(tn_tray_reader *tray)
{
    const tn_ast_word *colon = tray->word;
    if (!colon || colon->kind != TN_WORD_OF_DEPTH)
        return true;
    next_word(tray);
    return (tray->word && tray->word->kind == TN_WORD_LENGTH) ||
           misread(tray, colon, "no depth follows here", "a fill and its depth are written `FILL:4'`");
}

static bool read_field(tn_tray_reader *tray, uint32_t field, const tn_ast_word *word)
{
    const tn_checked_field *f = &tray->schema->fields[field];
    if (f->kind == TN_FIELD_FLAG && word->kind == TN_WORD_ABSENT)
        return set(tray, field, 0, word);
    if (word->kind == TN_WORD_NUMBER) {
        tn_report_unit(tray->check, tray->schema, word);
        return false;
    }
    if (f->kind == TN_FIELD_LENGTH)
        return set_length(tray, field, word);
    if (f->kind != TN_FIELD_ZONE)
        return set_choice(tray, field, word);
    return find_depth(tray) && set_fill(tray, field, word);
}

static bool read_line(tn_tray_reader *tray, tn_span place)
{
    for (uint32_t field = 0; field < tray->schema->field_count; field++) {
        const tn_ast_word *word = next_word(tray);
        if (word) {
            if (!read_field(tray, field, word))
                return false;
            continue;
        }
        tn_diagnostic *d = tn_report(tray->check->diagnostics, E_BAD_ITEM, place, "this tray has no value for `%s`",
                                     tray->schema->fields[field].name);
        tn_help(
            tray->check->diagnostics, d,
            "a tray with `-` or `:` is written as in a plan line: a value for each field, in the order of the schema");
        return false;
    }
    return !tray->word ||
           misread(tray, tray->word, "the tray has a value for each field before this", "trays are separated by `|`");
}

/* ---- forbidden trays */

static bool in_mask(const tn_checked_spec *spec, const tn_checked_field *field, uint32_t value)
{
    uint32_t bit = field->first_bit + value;
    return spec->mask[bit / 64] >> (bit % 64) & 1;
}

static bool narrows(const tn_checked_spec *spec, const tn_checked_field *field)
{
    for (uint32_t v = 0; v < field->value_count; v++)
        if (!in_mask(spec, field, v))
            return true;
    return false;
}

static void report_forbidden(tn_tray_reader *tray, const tn_checked_spec *spec, tn_span place, tn_span forbid)
{
    const tn_checked_schema *schema = tray->schema;
    tn_diagnostic *d =
        tn_report(tray->check->diagnostics, E_FORBIDDEN_TRAY, place, "schema `%s` forbids this tray", schema->name);
    tn_note(tray->check->diagnostics, d, &forbid, "it is forbidden here");
    for (uint32_t f = 0; f < schema->field_count; f++) {
        const tn_checked_field *field = &schema->fields[f];
        if (tray->written[f] || !narrows(spec, field))
            continue;
        const char *value = field->kind == TN_FIELD_FLAG ? "not set" : field->values[tray->values[f]].spelling;
        tn_help(tray->check->diagnostics, d,
                "`%s` is not written, so it is %s, the first value of the schema: write another one", field->name,
                value);
        return;
    }
    tn_help(tray->check->diagnostics, d, "change one of the values that the `forbid` names");
}

static bool check_legal(tn_tray_reader *tray, tn_span place)
{
    const tn_checked_schema *schema = tray->schema;
    if (schema->broken)
        return false;
    for (uint32_t i = 0; i < schema->forbid_count; i++) {
        if (!tn_check_meets(schema, schema->forbids[i], tray->values))
            continue;
        report_forbidden(tray, schema->forbids[i], place, schema->forbid_places[i]);
        return false;
    }
    return true;
}

/* ---- plans */

static bool read_tray(tn_check *check, const tn_checked_schema *schema, const tn_ast_tray *ast, uint8_t *values)
{
    tn_tray_reader tray = {
        .check = check, .schema = schema, .word = (const tn_ast_word *)ast->words.first, .values = values};
    if (!tray.word) {
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_EMPTY_TRAY, ast->node.span, "nothing is written between these bars");
        tn_help(check->diagnostics, d, "write at least one value of the tray, such as its %s",
                schema->field_count ? schema->fields[0].name : "first field");
        return false;
    }
    if (is_line(ast) && !read_line(&tray, ast->node.span))
        return false;
    while (tray.word)
        if (!read_word(&tray))
            return false;
    return check_legal(&tray, ast->node.span);
}

const uint8_t *tn_check_plan(tn_check *check, const tn_checked_schema *schema, tn_ast_list trays, size_t *length)
{
    const tn_ast_tray *only = (const tn_ast_tray *)trays.first;
    *length = 0;
    if (!only || (trays.count == 1 && !only->words.first)) /* [ ]: the empty plan */
        return tn_arena_alloc(check->arena, 1);
    if (trays.count > TN_LITERAL_TRAYS_MAX) {
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_PLAN_TOO_LONG, trays.last->span,
                      "this plan has %zu trays, more than the limit of %u", trays.count, TN_LITERAL_TRAYS_MAX);
        tn_help(check->diagnostics, d, "put long plans into a file of plans, and match that");
        return NULL;
    }
    uint8_t *values = tn_arena_alloc(check->arena, trays.count * (schema->field_count + 1));
    bool good = values != NULL;
    for (TN_EACH(const tn_ast_tray, ast, trays)) {
        if (!values)
            return NULL;
        good &= read_tray(check, schema, ast, values + *length * schema->field_count);
        (*length)++;
    }
    return good ? values : NULL;
}
