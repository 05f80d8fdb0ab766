/* Schemas: fields, their values, roles, and the trays that are forbidden. */
#include <string.h>
#include <strings.h>

#include "compiler/common/limits.h"
#include "compiler/plan/check/check.h"
#include "runtime/base/length.h"
#include "runtime/base/nearest.h"

/* Words that specifiers need for themselves. */
static bool is_reserved(const tn_ast_word *word)
{
    return tn_word_is(word, "not") || tn_word_is(word, "or") || tn_word_is(word, "and");
}

static bool name_is_good(tn_check *check, tn_checked_schema *schema, const tn_ast_word *word)
{
    if (strlen(word->text) > TN_NAME_MAX) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_NAME_TOO_LONG, word->node.span,
                                     "this name is longer than the limit of %u bytes", TN_NAME_MAX);
        tn_help(check->diagnostics, d, "choose a shorter name; what it means can stand in a text after it");
    } else if (is_reserved(word)) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_RESERVED_WORD, word->node.span,
                                     "`%s` is a word of tray specifiers and cannot be a name", word->text);
        tn_help(check->diagnostics, d, "choose another name");
    } else {
        return !word->broken;
    }
    schema->broken = true;
    return false;
}

/* ---- roles */

static const char *const field_roles[] = {"none", "length", "level", "public-end", "great-hall",
                                          "band", "text",   "tone",  "hatch"};
static const char *const fill_roles[] = {"none", "solid", "void", "absent"};

/* The number of a role's name; 0 where there is none: then reported, with the roles that there are. */
static unsigned find_role(tn_check *check, const tn_ast_word *word, const char *const *roles, unsigned count)
{
    for (unsigned i = 1; i < count; i++)
        if (strcasecmp(word->text, roles[i]) == 0)
            return i;
    char list[160] = "";
    for (unsigned i = 1; i < count; i++)
        snprintf(list + strlen(list), sizeof list - strlen(list), "%s%s",
                 i == 1           ? ""
                 : i + 1 == count ? " or "
                                  : ", ",
                 roles[i]);
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_UNKNOWN_ROLE, word->node.span, "there is no role `%s` here", word->text);
    const char *near = tn_nearest(word->text, roles + 1, count - 1);
    if (near)
        tn_suggest(check->diagnostics, d, "%s", near);
    else
        tn_help(check->diagnostics, d, "the role can be %s", list);
    return 0;
}

static void misplaced_role(tn_check *check, const tn_ast_word *role, const char *needs)
{
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_MISPLACED_ROLE, role->node.span, "the role `%s` does not fit here", role->text);
    tn_help(check->diagnostics, d, "%s", needs);
}

static void check_field_role(tn_check *check, tn_checked_field *field)
{
    const tn_ast_word *role = field->ast->role;
    if (!role)
        return;
    unsigned number = find_role(check, role, field_roles, TN_FIELD_ROLE_COUNT);
    static const struct {
        tn_field_kind kind;
        const char *needs;
    } needs[TN_FIELD_ROLE_COUNT] = {
        [TN_ROLE_LENGTH] = {TN_FIELD_LENGTH, "`role length` is for a field of lengths"},
        [TN_ROLE_LEVEL] = {TN_FIELD_CHOICE,
                           "`role level` is for a field whose values are names, the n-th with n levels"},
        [TN_ROLE_PUBLIC_END] = {TN_FIELD_FLAG, "`role public-end` is for a flag"},
        [TN_ROLE_GREAT_HALL] = {TN_FIELD_FLAG, "`role great-hall` is for a flag"},
        [TN_ROLE_BAND] = {TN_FIELD_ZONE, "`role band` is for a zone"},
        [TN_ROLE_TEXT] = {TN_FIELD_CHOICE, "`role text` is for a field whose values are names"},
        [TN_ROLE_TONE] = {TN_FIELD_CHOICE, "`role tone` is for a field whose values are names"},
        [TN_ROLE_HATCH] = {TN_FIELD_CHOICE, "`role hatch` is for a field whose values are names"},
    };
    if (number > 0 && needs[number].kind != field->kind)
        misplaced_role(check, role, needs[number].needs);
    else
        field->role = (tn_field_role)number;
}

/* ---- values */

/* How a plan line writes the length: as the author did, without blanks where that still means the same. */
static const char *spell(tn_check *check, const tn_ast_word *word)
{
    char *text = tn_arena_copy(check->arena, word->text, strlen(word->text));
    if (!text)
        return "";
    size_t size = 0;
    for (const char *c = word->text; *c; c++)
        if (*c != ' ' && *c != '\t')
            text[size++] = *c;
    text[size] = '\0';
    int64_t value;
    if (size <= TN_NAME_MAX / 2 && tn_length_read(text, size, false, &value, NULL) == size && value == word->value)
        return text;
    char written[64];
    tn_length_write(word->value, written, sizeof written);
    return tn_arena_copy(check->arena, written, strlen(written));
}

static const char *zone_spelling(tn_check *check, const char *fill, const char *measure)
{
    size_t size = strlen(fill) + strlen(measure) + 2;
    char *text = tn_arena_alloc(check->arena, size);
    if (text)
        snprintf(text, size, "%s:%s", fill, measure);
    return text ? text : "";
}

static void report_twice(tn_check *check, tn_checked_schema *schema, const tn_checked_field *field, tn_span span,
                         const char *what, tn_span before)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_DUPLICATE_VALUE, span, "`%s` has %s already", field->name, what);
    tn_note(check->diagnostics, d, &before, "the first is here");
    tn_help(check->diagnostics, d, "leave one of the two out");
    schema->broken = true;
}

static bool has_room(tn_check *check, tn_checked_schema *schema, const tn_checked_field *field, tn_span span)
{
    if (field->value_count < TN_VALUES_MAX)
        return true;
    if (!schema->broken) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_SCHEMA_TOO_LARGE, span,
                                     "`%s` has more values than the limit of %u", field->name, TN_VALUES_MAX);
        tn_help(check->diagnostics, d, "divide it into two fields");
    }
    schema->broken = true;
    return false;
}

static void add_value(tn_check *check, tn_checked_schema *schema, tn_checked_field *field, tn_checked_value value)
{
    if (!has_room(check, schema, field, value.span))
        return;
    field->values[field->value_count++] = value;
}

static void add_length(tn_check *check, tn_checked_schema *schema, tn_checked_field *field, const tn_ast_value *ast)
{
    if (ast->word->broken) {
        schema->broken = true;
        return;
    }
    for (uint32_t i = 0; i < field->value_count; i++)
        if (field->values[i].length == ast->word->value) {
            report_twice(check, schema, field, ast->word->node.span, "this length", field->values[i].span);
            return;
        }
    const char *spelling = spell(check, ast->word);
    add_value(check, schema, field,
              (tn_checked_value){.name = spelling,
                                 .spelling = spelling,
                                 .measure = "",
                                 .span = ast->word->node.span,
                                 .length = ast->word->value,
                                 .doc = ast->doc ? ast->doc->text : NULL});
}

static const tn_checked_value *named(const tn_checked_field *field, const char *name)
{
    for (uint32_t i = 0; i < field->value_count; i++)
        if (strcmp(field->values[i].name, name) == 0)
            return &field->values[i];
    return NULL;
}

static void add_choice(tn_check *check, tn_checked_schema *schema, tn_checked_field *field, const tn_ast_value *ast)
{
    if (!name_is_good(check, schema, ast->word))
        return;
    const tn_checked_value *before = named(field, ast->word->text);
    if (before)
        report_twice(check, schema, field, ast->word->node.span, "this value", before->span);
    else
        add_value(check, schema, field,
                  (tn_checked_value){.name = ast->word->text,
                                     .spelling = ast->word->text,
                                     .measure = "",
                                     .span = ast->word->node.span,
                                     .doc = ast->doc ? ast->doc->text : NULL});
}

/* width = 4 */
static void report_bare(tn_check *check, const tn_ast_word *number)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_NO_UNIT, number->node.span, "`%s` has no unit", number->text);
    tn_help(check->diagnostics, d,
            "a length has a unit, such as `%s'` or `%sm`; a value that is no length is a name, such as `one`",
            number->text, number->text);
}

/* A zone's fill, with each of its depths. */
static void add_fill(tn_check *check, tn_checked_schema *schema, tn_checked_field *field, const tn_ast_value *ast)
{
    if (!name_is_good(check, schema, ast->word))
        return;
    const tn_checked_value *before = named(field, ast->word->text);
    if (before) {
        report_twice(check, schema, field, ast->word->node.span, "this fill", before->span);
        return;
    }
    tn_checked_value value = {.name = ast->word->text,
                              .spelling = ast->word->text,
                              .measure = "",
                              .span = ast->word->node.span,
                              .doc = ast->doc ? ast->doc->text : NULL};
    value.role = ast->role ? (tn_fill_role)find_role(check, ast->role, fill_roles, TN_FILL_ROLE_COUNT) : TN_FILL_NONE;
    if (!ast->has_depths)
        add_value(check, schema, field, value);
    uint32_t first = field->value_count;
    for (TN_EACH(const tn_ast_word, depth, ast->depths)) {
        if (depth->kind != TN_WORD_LENGTH || depth->broken) {
            schema->broken = true;
            if (depth->kind == TN_WORD_NUMBER) {
                tn_report_unit(check, NULL, depth);
            } else if (!depth->broken) {
                tn_diagnostic *d =
                    tn_report(check->diagnostics, E_MIXED_VALUES, depth->node.span, "`%s` is not a depth", depth->text);
                tn_help(check->diagnostics, d, "the depths of a fill are lengths: `%s(4', 8')`", ast->word->text);
            }
            continue;
        }
        const tn_checked_value *same = NULL;
        for (uint32_t i = first; i < field->value_count; i++)
            if (field->values[i].length == depth->value)
                same = &field->values[i];
        if (same) {
            report_twice(check, schema, field, depth->node.span, "this depth", same->span);
            continue;
        }
        value.has_depth = true;
        value.length = depth->value;
        value.measure = spell(check, depth);
        value.spelling = zone_spelling(check, value.name, value.measure);
        value.span = depth->node.span;
        add_value(check, schema, field, value);
    }
}

/* ---- fields */

static void report_mixed(tn_check *check, tn_checked_schema *schema, const tn_checked_field *field,
                         const tn_ast_value *value)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_MIXED_VALUES, value->node.span,
                                 "`%s` has both lengths and names as values", field->name);
    tn_help(check->diagnostics, d,
            "a field has either; for a filling with a depth declare a zone: `zone %s = dense(4', 8') | empty`",
            field->name);
    schema->broken = true;
}

static void check_plain_value(tn_check *check, tn_checked_schema *schema, tn_checked_field *field,
                              const tn_ast_value *value)
{
    if (value->role)
        misplaced_role(check, value->role, "roles are for fields, zones and the fills of zones");
    if (value->has_depths) {
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_MISPLACED_DEPTHS, value->node.span, "only the fills of a zone have depths");
        tn_help(check->diagnostics, d, "write `zone %s = ...` if `%s` is a zone", field->name, field->name);
        schema->broken = true;
    }
    if (value->word->kind == TN_WORD_NUMBER) {
        if (!value->word->broken)
            report_bare(check, value->word);
        schema->broken = true;
    } else if ((value->word->kind == TN_WORD_LENGTH) != (field->kind == TN_FIELD_LENGTH)) {
        report_mixed(check, schema, field, value);
    } else if (field->kind == TN_FIELD_LENGTH) {
        add_length(check, schema, field, value);
    } else {
        add_choice(check, schema, field, value);
    }
}

static void check_zone_value(tn_check *check, tn_checked_schema *schema, tn_checked_field *field,
                             const tn_ast_value *value)
{
    if (value->word->kind == TN_WORD_NAME) {
        add_fill(check, schema, field, value);
        return;
    }
    schema->broken = true;
    tn_diagnostic *d = tn_report(check->diagnostics, E_ZONE_LENGTH, value->node.span,
                                 "a zone's alternatives are fills, and this is none");
    tn_help(check->diagnostics, d, "write the fill and its depths: `open(%s)`", value->word->text);
}

static size_t count_values(const tn_ast_field *ast)
{
    size_t count = 2; /* a flag has two */
    for (TN_EACH(const tn_ast_value, value, ast->values))
        count += 1 + value->depths.count;
    return count < TN_VALUES_MAX ? count : TN_VALUES_MAX;
}

static void check_field(tn_check *check, tn_checked_schema *schema, const tn_ast_field *ast)
{
    uint32_t before = tn_field_find(schema, ast->name->text);
    if (before != TN_NONE) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_DUPLICATE_FIELD, ast->name->node.span,
                                     "there is a field `%s` already", ast->name->text);
        tn_note(check->diagnostics, d, &schema->fields[before].ast->name->node.span, "the first is here");
        tn_help(check->diagnostics, d, "choose another name for one of the two");
        schema->broken = true;
        return;
    }
    tn_checked_field *field = &schema->fields[schema->field_count];
    *field = (tn_checked_field){.ast = ast, .name = ast->name->text, .doc = ast->doc ? ast->doc->text : NULL};
    field->values = TN_NEW_ARRAY(check->arena, tn_checked_value, count_values(ast));
    if (!field->values)
        return;
    const tn_ast_value *first = (const tn_ast_value *)ast->values.first;
    field->kind = ast->form == TN_FORM_FLAG                     ? TN_FIELD_FLAG
                  : ast->form == TN_FORM_ZONE                   ? TN_FIELD_ZONE
                  : !first || first->word->kind == TN_WORD_NAME ? TN_FIELD_CHOICE
                                                                : TN_FIELD_LENGTH;
    name_is_good(check, schema, ast->name);
    if (field->kind == TN_FIELD_FLAG) {
        add_value(check, schema, field,
                  (tn_checked_value){.name = "-", .spelling = "-", .measure = "", .span = ast->node.span});
        add_value(
            check, schema, field,
            (tn_checked_value){.name = field->name, .spelling = field->name, .measure = "", .span = ast->node.span});
    }
    for (TN_EACH(const tn_ast_value, value, ast->values)) {
        if (field->kind == TN_FIELD_ZONE)
            check_zone_value(check, schema, field, value);
        else
            check_plain_value(check, schema, field, value);
    }
    check_field_role(check, field);
    field->first_bit = schema->value_count;
    schema->value_count += field->value_count;
    if (field->kind == TN_FIELD_LENGTH && schema->length_field == TN_NONE)
        schema->length_field = schema->field_count;
    schema->field_count++;
}

void tn_check_schema(tn_check *check, tn_checked_schema *schema)
{
    const tn_ast_body *body = &schema->ast->body;
    schema->broken = body->broken;
    size_t room = body->fields.count < TN_FIELDS_MAX ? body->fields.count : TN_FIELDS_MAX;
    schema->fields = TN_NEW_ARRAY(check->arena, tn_checked_field, room);
    if (!schema->fields)
        return;
    for (TN_EACH(const tn_ast_field, field, body->fields)) {
        if (schema->field_count == TN_FIELDS_MAX) {
            tn_diagnostic *d = tn_report(check->diagnostics, E_SCHEMA_TOO_LARGE, field->name->node.span,
                                         "this is one field more than the limit of %u", TN_FIELDS_MAX);
            tn_help(check->diagnostics, d, "declare fewer fields");
            schema->broken = true;
            break;
        }
        check_field(check, schema, field);
    }
    schema->words = (schema->value_count + 63) / 64;
    if (body->fields.count == 0 && !schema->broken) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_EMPTY_SCHEMA, schema->ast->name->node.span,
                                     "schema `%s` has no fields", schema->name);
        tn_help(check->diagnostics, d, "write at least one, such as `width = 4' | 8' | 12'`");
        schema->broken = true;
    }
}

/* ---- forbidden trays */

static bool forbids(const tn_checked_schema *schema, const tn_checked_spec *spec, const uint8_t *values)
{
    for (uint32_t f = 0; f < schema->field_count; f++) {
        uint32_t bit = schema->fields[f].first_bit + values[f];
        if (!(spec->mask[bit / 64] >> (bit % 64) & 1))
            return false;
    }
    return true;
}

/* Looks for one legal tray, among so many combinations at most: a schema that needs longer has legal ones. */
static bool has_legal_tray(const tn_checked_schema *schema)
{
    enum { TRIES = 1 << 16 };
    uint8_t values[TN_FIELDS_MAX] = {0};
    for (int tries = 0; tries < TRIES; tries++) {
        bool legal = true;
        for (uint32_t i = 0; i < schema->forbid_count && legal; i++)
            legal = !forbids(schema, schema->forbids[i], values);
        if (legal)
            return true;
        uint32_t f = schema->field_count;
        while (f > 0 && ++values[f - 1] == schema->fields[f - 1].value_count)
            values[--f] = 0;
        if (f == 0)
            return false;
    }
    return true;
}

void tn_check_forbids(tn_check *check, tn_checked_schema *schema)
{
    const tn_ast_list *list = &schema->ast->body.forbids;
    size_t room = list->count < TN_FORBIDS_MAX ? list->count : TN_FORBIDS_MAX;
    schema->forbids = TN_NEW_ARRAY(check->arena, tn_checked_spec *, room);
    if (!schema->forbids)
        return;
    check->allow = tn_ast_empty();
    for (TN_EACH(const tn_ast_forbid, forbid, *list)) {
        if (!tn_check_room(check, schema->forbid_count, TN_FORBIDS_MAX, "`forbid`", forbid->node.span,
                           "forbid several trays at once: `forbid tray(4' or 8', body dense)`")) {
            schema->broken = true;
            return;
        }
        tn_checked_spec *spec = tn_check_spec(check, schema, forbid->tray);
        if (!spec)
            return;
        schema->broken |= spec->broken;
        schema->forbids[schema->forbid_count++] = spec;
    }
    if (schema->broken || schema->forbid_count == 0 || has_legal_tray(schema))
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, E_NOTHING_LEGAL, schema->ast->name->node.span,
                                 "schema `%s` forbids every tray", schema->name);
    tn_note(check->diagnostics, d, &schema->forbids[schema->forbid_count - 1]->span, "the last `forbid` is here");
    tn_help(check->diagnostics, d, "leave one `forbid` out, or narrow it with more items");
    schema->broken = true;
}
