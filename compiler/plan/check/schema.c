/* Schemas: fields, their values, roles; and the fields that a schema has from the one that it is made from. */
#include <string.h>
#include <strings.h>

#include "compiler/common/limits.h"
#include "compiler/plan/check/check.h"
#include "runtime/base/length.h"
#include "runtime/base/nearest.h"

enum { UNSEEN, OPEN, DONE };

/* Words that specifiers need for themselves. */
static bool is_reserved(const tn_ast_word *word)
{
    return tn_word_is(word, "not") || tn_word_is(word, "or") || tn_word_is(word, "and");
}

static bool name_is_good(tn_check *check, tn_checked_schema *schema, const tn_ast_word *word)
{
    bool fits = tn_name_fits(check->diagnostics, word->text, word->node.span);
    if (fits && !is_reserved(word))
        return !word->broken;
    if (fits) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_RESERVED_WORD, word->node.span,
                                     "`%s` is a word of tray specifiers and cannot be a name", word->text);
        tn_help(check->diagnostics, d, "choose another name");
    }
    schema->broken = true;
    return false;
}

/* ---- roles */

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
    unsigned number = find_role(check, role, tn_names_FIELD_ROLE, TN_FIELD_ROLE_COUNT);
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

#define LEAVE_OUT "leave one of the two out"

static tn_diagnostic *report_twice(tn_check *check, tn_checked_schema *schema, const tn_checked_field *field,
                                   tn_span span, const char *what, tn_span before)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_DUPLICATE_VALUE, span, "`%s` has %s already", field->name, what);
    tn_note(check->diagnostics, d, &before, "the first is here");
    schema->broken = true;
    return d;
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
            tn_help(check->diagnostics,
                    report_twice(check, schema, field, ast->word->node.span, "this length", field->values[i].span),
                    LEAVE_OUT);
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
        tn_help(check->diagnostics,
                report_twice(check, schema, field, ast->word->node.span, "this value", before->span), LEAVE_OUT);
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
            "a length has a unit, such as `%s'` or `%sm`; a value that is not a length is a name, such as `one`",
            number->text, number->text);
}

/* zone hall = room(3m) | room(4m) */
static void report_fill_twice(tn_check *check, tn_checked_schema *schema, const tn_checked_field *field,
                              const tn_ast_value *ast, const tn_checked_value *before)
{
    tn_diagnostic *d = report_twice(check, schema, field, ast->word->node.span, "this fill", before->span);
    const tn_ast_word *depth = ast->depths.count > 0 ? (const tn_ast_word *)ast->depths.first : NULL;
    bool another = before->has_depth && depth && depth->kind == TN_WORD_LENGTH && depth->value != before->length;
    if (another)
        tn_help(check->diagnostics, d, "a fill's depths stand together: `%s(%s, %s)`", before->name, before->measure,
                spell(check, depth));
    else
        tn_help(check->diagnostics, d, LEAVE_OUT);
}

/* A zone's fill, with each of its depths. */
static void add_fill(tn_check *check, tn_checked_schema *schema, tn_checked_field *field, const tn_ast_value *ast)
{
    if (!name_is_good(check, schema, ast->word))
        return;
    const tn_checked_value *before = named(field, ast->word->text);
    bool deeper = before && before < field->values + field->older_count && before->has_depth && ast->has_depths;
    if (before && !deeper) {
        report_fill_twice(check, schema, field, ast, before);
        return;
    }
    tn_checked_value value = {.name = ast->word->text,
                              .spelling = ast->word->text,
                              .measure = "",
                              .span = ast->word->node.span,
                              .doc = ast->doc ? ast->doc->text
                                     : deeper ? before->doc
                                              : NULL};
    if (deeper && ast->role)
        misplaced_role(check, ast->role, "the role of a fill stands where the fill is declared first");
    else if (ast->role)
        value.role = (tn_fill_role)find_role(check, ast->role, tn_names_FILL_ROLE, TN_FILL_ROLE_COUNT);
    else if (deeper)
        value.role = before->role;
    if (!ast->has_depths)
        add_value(check, schema, field, value);
    for (TN_EACH(const tn_ast_word, depth, ast->depths)) {
        if (depth->kind != TN_WORD_LENGTH || depth->broken) {
            schema->broken = true;
            if (depth->kind == TN_WORD_NUMBER) {
                tn_report_unit(check, NULL, depth);
            } else if (!depth->broken && !tn_refuse_param(check, schema, depth)) {
                tn_diagnostic *d =
                    tn_report(check->diagnostics, E_MIXED_VALUES, depth->node.span, "`%s` is not a depth", depth->text);
                tn_help(check->diagnostics, d, "the depths of a fill are lengths: `%s(4', 8')`", ast->word->text);
            }
            continue;
        }
        const tn_checked_value *same = NULL;
        for (uint32_t i = 0; i < field->value_count; i++)
            if (field->values[i].length == depth->value && strcmp(field->values[i].name, value.name) == 0)
                same = &field->values[i];
        if (same) {
            tn_help(check->diagnostics,
                    report_twice(check, schema, field, depth->node.span, "this depth", same->span), LEAVE_OUT);
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
    schema->broken = true;
    if (value->word && tn_refuse_param(check, schema, value->word))
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, E_MIXED_VALUES, value->node.span,
                                 "`%s` has both lengths and names as values", field->name);
    tn_help(check->diagnostics, d,
            "a field has either; for a filling with a depth declare a zone: `zone %s = dense(4', 8') | empty`",
            field->name);
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
                                 "a zone's alternatives are fills, and this is not one");
    tn_help(check->diagnostics, d, "write the fill and its depths: `open(%s)`", value->word->text);
}

static size_t count_values(const tn_ast_field *ast)
{
    size_t count = 2; /* a flag has two */
    for (TN_EACH(const tn_ast_value, value, ast->values))
        count += 1 + value->depths.count;
    return count < TN_VALUES_MAX ? count : TN_VALUES_MAX;
}

static void check_values(tn_check *check, tn_checked_schema *schema, tn_checked_field *field, const tn_ast_field *ast)
{
    for (TN_EACH(const tn_ast_value, value, ast->values)) {
        if (field->kind == TN_FIELD_ZONE)
            check_zone_value(check, schema, field, value);
        else
            check_plain_value(check, schema, field, value);
    }
}

/* Makes the next field, with room for the values; its values follow one another in the schema's masks. */
static tn_checked_field *begin_field(tn_check *check, tn_checked_schema *schema, tn_checked_field field, size_t values)
{
    tn_checked_field *made = &schema->fields[schema->field_count];
    *made = field;
    made->values = TN_NEW_ARRAY(check->arena, tn_checked_value, values < TN_VALUES_MAX ? values : TN_VALUES_MAX);
    made->first_bit = schema->value_count;
    return made->values ? made : NULL;
}

/* In sums a name that has an order is its place there, the first 1. */
static void number_places(tn_check *check, tn_checked_field *field)
{
    for (uint32_t v = 0; v < field->value_count; v++) {
        char place[16];
        snprintf(place, sizeof place, "%u", (unsigned)v + 1);
        field->values[v].number = tn_arena_copy(check->arena, place, strlen(place));
    }
}

static void end_field(tn_check *check, tn_checked_schema *schema)
{
    tn_checked_field *field = &schema->fields[schema->field_count];
    if (field->ordered && !field->measured)
        number_places(check, field);
    schema->value_count += field->value_count;
    if (field->kind == TN_FIELD_LENGTH && schema->length_field == TN_NONE)
        schema->length_field = schema->field_count;
    schema->field_count++;
}

static void report_field_twice(tn_check *check, tn_checked_schema *schema, const tn_ast_field *ast, uint32_t before)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_DUPLICATE_FIELD, ast->name->node.span,
                                 "there is a field `%s` already", ast->name->text);
    bool older = schema->base && before < schema->base->field_count;
    tn_note(check->diagnostics, d, &schema->fields[before].ast->name->node.span, "the first is here");
    if (older && schema->fields[before].kind != TN_FIELD_FLAG && ast->form != TN_FORM_FLAG && !ast->extends)
        tn_help(check->diagnostics, d, "to add values to it, begin with `...`: `%s%s = ... | %s`",
                ast->form == TN_FORM_ZONE ? "zone " : "", ast->name->text,
                ast->values.last ? ((const tn_ast_value *)ast->values.last)->word->text : "VALUE");
    else
        tn_help(check->diagnostics, d, "choose another name for one of the two");
    schema->broken = true;
}

/* Only names are put into an order: lengths have one. */
static void check_order(tn_check *check, tn_checked_field *field)
{
    field->ordered = field->ast->ordered && field->kind == TN_FIELD_CHOICE;
    if (field->ordered == field->ast->ordered)
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, E_MIXED_ORDER, field->ast->name->node.span,
                                 "the values of `%s` are lengths, which have an order already", field->name);
    tn_help(check->diagnostics, d, "write `|` between them");
}

static void check_field(tn_check *check, tn_checked_schema *schema, const tn_ast_field *ast)
{
    uint32_t before = tn_field_find(schema, ast->name->text);
    if (before != TN_NONE) {
        report_field_twice(check, schema, ast, before);
        return;
    }
    const tn_ast_value *first = (const tn_ast_value *)ast->values.first;
    bool flag = ast->form == TN_FORM_FLAG || ast->form == TN_FORM_RULE;
    tn_field_kind kind = flag                                          ? TN_FIELD_FLAG
                         : ast->form == TN_FORM_MEASURE                ? TN_FIELD_LENGTH
                         : ast->form == TN_FORM_ZONE                   ? TN_FIELD_ZONE
                         : !first || first->word->kind == TN_WORD_NAME ? TN_FIELD_CHOICE
                                                                       : TN_FIELD_LENGTH;
    tn_checked_field *field = begin_field(
        check, schema,
        (tn_checked_field){.ast = ast, .name = ast->name->text, .doc = ast->doc ? ast->doc->text : NULL, .kind = kind},
        ast->form == TN_FORM_MEASURE ? TN_VALUES_MAX : count_values(ast));
    if (!field)
        return;
    name_is_good(check, schema, ast->name);
    check_order(check, field);
    if (field->kind == TN_FIELD_FLAG) {
        add_value(check, schema, field,
                  (tn_checked_value){.name = "-", .spelling = "-", .measure = "", .span = ast->node.span});
        add_value(
            check, schema, field,
            (tn_checked_value){.name = field->name, .spelling = field->name, .measure = "", .span = ast->node.span});
    }
    check_values(check, schema, field, ast);
    if (ast->form == TN_FORM_MEASURE)
        tn_check_said_values(check, schema, field);
    check_field_role(check, field);
    end_field(check, schema);
}

/* ---- fields of an older schema */

/* What the schema adds to the field that it has from an older one; NULL: nothing. */
static const tn_ast_field *addition(tn_check *check, tn_checked_schema *schema, const tn_checked_field *older)
{
    const tn_ast_field *found = NULL;
    for (TN_EACH(const tn_ast_field, field, schema->ast->body.fields)) {
        if (!field->extends || strcmp(field->name->text, older->name) != 0)
            continue;
        if (!found) {
            found = field;
            continue;
        }
        tn_diagnostic *d = tn_report(check->diagnostics, E_DUPLICATE_FIELD, field->name->node.span,
                                     "values are added to `%s` twice", older->name);
        tn_note(check->diagnostics, d, &found->name->node.span, "the first time is here");
        tn_help(check->diagnostics, d, "write all new values of a field in one line");
        schema->broken = true;
    }
    return found;
}

static bool addition_fits(tn_check *check, tn_checked_schema *schema, const tn_checked_field *older,
                          const tn_ast_field *added)
{
    bool zone = older->kind == TN_FIELD_ZONE;
    if (added->role)
        misplaced_role(check, added->role, "the role of a field stands where the field is declared first");
    tn_diagnostic *d = NULL;
    if (tn_field_is_said(older->ast)) {
        d = tn_report(check->diagnostics, E_OLDER_VALUES, added->node.span,
                      "the values of `%s` are those that `%s` says", older->name, older->ast->said_by->text);
        tn_help(check->diagnostics, d, "leave this line out, or choose another name for a new field");
    } else if (older->kind == TN_FIELD_FLAG) {
        d = tn_report(check->diagnostics, E_OLDER_VALUES, added->node.span, "`%s` is a flag: it has no more values",
                      older->name);
        tn_help(check->diagnostics, d, "leave this line out, or choose another name for a new field");
    } else if (zone != (added->form == TN_FORM_ZONE)) {
        d = tn_report(check->diagnostics, E_OLDER_VALUES, added->node.span, "`%s` is %s zone", older->name,
                      zone ? "a" : "no");
        tn_help(check->diagnostics, d, "write `%s%s = ... | ...`", zone ? "zone " : "", older->name);
    } else if (!added->values.first) {
        d = tn_report(check->diagnostics, E_OLDER_VALUES, added->node.span, "this adds no value to `%s`", older->name);
        tn_help(check->diagnostics, d,
                "write new values after `... |`, or leave the line out: a field without one stays as it is");
    }
    if (!d)
        return true;
    tn_note(check->diagnostics, d, &older->ast->name->node.span, "`%s` is declared here", older->name);
    schema->broken = true;
    return false;
}

static void take_over_field(tn_check *check, tn_checked_schema *schema, const tn_checked_field *older)
{
    const tn_ast_field *added = addition(check, schema, older);
    tn_checked_field *field =
        begin_field(check, schema, *older, older->value_count + (added ? count_values(added) : 0));
    if (!field)
        return;
    memcpy(field->values, older->values, older->value_count * sizeof *field->values);
    field->older_count = older->value_count;
    if (added && added->doc)
        field->doc = added->doc->text;
    if (added && addition_fits(check, schema, older, added))
        check_values(check, schema, field, added);
    end_field(check, schema);
}

void tn_check_schema(tn_check *check, tn_checked_schema *schema)
{
    if (schema->state != UNSEEN)
        return;
    schema->state = OPEN;
    const tn_ast_body *body = &schema->ast->body;
    schema->broken = body->broken || (schema->ast->of && !tn_schema_census(schema));
    tn_check_base(check, schema);
    uint32_t older = schema->base ? schema->base->field_count : 0;
    size_t room = older + body->fields.count;
    schema->fields = TN_NEW_ARRAY(check->arena, tn_checked_field, room < TN_FIELDS_MAX ? room : TN_FIELDS_MAX);
    if (!schema->fields)
        return;
    for (uint32_t f = 0; f < older; f++)
        take_over_field(check, schema, &schema->base->fields[f]);
    tn_check_older_fields(check, schema);
    for (TN_EACH(const tn_ast_field, field, body->fields)) {
        if (field->extends)
            continue;
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
    schema->state = DONE;
    if (schema->field_count > 0 || schema->broken)
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, E_EMPTY_SCHEMA, schema->ast->name->node.span,
                                 "schema `%s` has no fields", schema->name);
    tn_help(check->diagnostics, d, "write at least one, such as `width = 4' | 8' | 12'`");
    schema->broken = true;
}

/* ---- schemas made from others: what they are made from, whose words a text has, and what of the older ones is carried
 * over. A rule or clause that was written for an older schema is written out again for the newer one, with its words
 * read as the older schema's (expand.c). So it takes in new values, leaves new fields free, and stays as clear as it
 * was. */

void tn_check_base(tn_check *check, tn_checked_schema *schema)
{
    const tn_ast_word *from = schema->ast->from;
    if (!from)
        return;
    check->extends = true;
    tn_checked_schema *base = tn_check_schema_for(check, schema->unit, from, from->node.span);
    if (base && base->state == OPEN) {
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_SCHEMA_CYCLE, from->node.span, "schema `%s` is made from itself%s",
                      schema->name, base == schema ? "" : ", by way of others");
        tn_note(check->diagnostics, d, &base->ast->name->node.span, "schema `%s` is here", base->name);
        tn_help(check->diagnostics, d, "leave `from %s` out, and write the fields", from->text);
        base = NULL;
    }
    if (base && base->state == UNSEEN)
        tn_check_schema(check, base);
    schema->base = base;
    schema->broken |= !base || base->broken;
}

bool tn_schema_extends(const tn_checked_schema *schema, const tn_checked_schema *older)
{
    const tn_checked_schema *base = schema ? schema->base : NULL;
    while (base && base != older)
        base = base->base;
    return base != NULL;
}

const tn_checked_schema *tn_schema_of_word(const tn_checked_schema *schema, const tn_checked_schema *older,
                                           const char *word)
{
    for (uint32_t f = 0; older && f < older->field_count; f++)
        if (strcmp(older->fields[f].name, word) == 0 || tn_field_has(&older->fields[f], word))
            return older;
    return schema;
}

/* `wide = ... | 16'` where the older schema has no field `wide`, or there is no older schema. */
static void report_no_older(tn_check *check, tn_checked_schema *schema, const tn_ast_field *field)
{
    const tn_checked_schema *base = schema->base;
    schema->broken = true;
    const char *name = field->name->text;
    if (!schema->ast->from) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_OLDER_VALUES, field->name->node.span,
                                     "`...` stands for older values of `%s`, and there are none", name);
        tn_help(check->diagnostics, d, "a schema is made from another by `schema %s from SCHEMA { ... }`",
                schema->name);
        return;
    }
    const char **names = base && !base->broken ? TN_NEW_ARRAY(check->arena, const char *, base->field_count) : NULL;
    if (!names)
        return;
    for (uint32_t f = 0; f < base->field_count; f++)
        names[f] = base->fields[f].name;
    tn_diagnostic *d = tn_report(check->diagnostics, E_OLDER_VALUES, field->name->node.span,
                                 "schema `%s` has no field `%s` to add values to", base->name, name);
    tn_note(check->diagnostics, d, &base->ast->name->node.span, "schema `%s` is here", base->name);
    const char *near = tn_nearest(name, names, base->field_count);
    if (near)
        tn_suggest(check->diagnostics, d, "%s", near);
    else
        tn_help(check->diagnostics, d, "for a new field, write its values without `...`");
}

void tn_check_older_fields(tn_check *check, tn_checked_schema *schema)
{
    for (TN_EACH(const tn_ast_field, field, schema->ast->body.fields))
        if (field->extends && (!schema->base || tn_field_find(schema->base, field->name->text) == TN_NONE))
            report_no_older(check, schema, field);
}

/* The command line names measures: a newer schema has a record of each that it takes over. */
void tn_check_older_measures(tn_check *check)
{
    tn_checked *result = check->result;
    size_t rules = result->rule_count;
    for (size_t s = 0; check->extends && s < result->schema_count; s++) {
        tn_checked_schema *schema = result->schemas[s];
        for (size_t i = 0; i < rules && !schema->broken; i++) {
            tn_checked_rule *measure = result->rules[i];
            if (!measure->is_measure || measure->form || !tn_schema_extends(schema, measure->schema) ||
                !tn_import_reaches(check->imports, schema->unit, measure->unit))
                continue;
            check->schema = schema;
            check->unit = measure->unit;
            tn_checked_rule *made = tn_expand_older_measure(check, measure);
            if (made)
                made->listed = true;
        }
    }
}
