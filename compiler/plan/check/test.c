/* Test blocks: what is expected of which plan, and the plans that are written out there. */
#include <string.h>

#include "compiler/common/limits.h"
#include "compiler/plan/check/amount.h"
#include "compiler/plan/check/form.h"
#include "runtime/base/nearest.h"

/* ---- plans written out: [4' | 8' double | 12' public]. What is not written takes its first value */

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

/* Of a field that a measure says: the value that is this number; its place, or how many there are. */
static uint32_t find_number(tn_check *check, const tn_checked_field *field, const tn_ast_word *word)
{
    uint32_t v = 0;
    bool constant = word->kind == TN_WORD_NUMBER || word->kind == TN_WORD_DECIMAL || word->kind == TN_WORD_AREA;
    tn_sum_amount amount = constant ? tn_amount_read(check, word) : (tn_sum_amount){0};
    if (!amount.value || (amount.power != field->power && !amount.any))
        return field->value_count;
    while (v < field->value_count && strcmp(field->values[v].number, amount.value) != 0)
        v++;
    return v;
}

static bool set_choice(tn_tray_reader *tray, uint32_t field, const tn_ast_word *word)
{
    const tn_checked_field *f = &tray->schema->fields[field];
    uint32_t number = f->measured ? find_number(tray->check, f, word) : f->value_count;
    if (number < f->value_count)
        return set(tray, field, number, word);
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
    if (word->kind == TN_WORD_NUMBER && !tray->schema->fields[field].measured) {
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
        value_follows = tray->word->kind != TN_WORD_NAME
                            ? schema->fields[field].kind != TN_FIELD_CHOICE || schema->fields[field].measured
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
    if (word->kind == TN_WORD_NUMBER && !f->measured) {
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
    const char *text = tray->check->diagnostics->sources->files[forbid.file].text + forbid.begin;
    bool only = *text == 'o' || *text == 'O';
    tn_help(tray->check->diagnostics, d, "change one of the values that the `%s` names", only ? "only" : "forbid");
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

/* ---- cases */

static bool expectation_fits(tn_check *check, const tn_ast_word *word, const tn_checked_name *subject)
{
    tn_expectation expectation = (tn_expectation)word->value;
    bool measure = subject->rule && subject->rule->is_measure;
    if (measure || expectation == TN_EXPECT_VALUE) {
        if (measure && expectation == TN_EXPECT_VALUE)
            return true;
        tn_diagnostic *wrong =
            measure ? tn_report(check->diagnostics, E_WRONG_EXPECTATION, word->node.span,
                                "a measure has values, it matches nothing")
                    : tn_report(check->diagnostics, E_WRONG_EXPECTATION, word->node.span, "only a measure has values");
        tn_note(check->diagnostics, wrong, &subject->span, "the %s is here",
                subject->library ? "library"
                : measure        ? "measure"
                                 : "rule");
        tn_help(check->diagnostics, wrong, measure ? "write `value [%s] = NUMBER`" : "write what is expected of it: %s",
                measure            ? (subject->rule->form ? "HOUSE" : "PLAN")
                : subject->library ? "`keep` or `drop`"
                                   : "`match` or `reject`");
        return false;
    }
    bool for_library = expectation == TN_EXPECT_KEEP || expectation == TN_EXPECT_DROP;
    if (for_library == (subject->library != NULL))
        return true;
    static const char *const words[] = {[TN_EXPECT_MATCH] = "match",
                                        [TN_EXPECT_REJECT] = "reject",
                                        [TN_EXPECT_KEEP] = "keep",
                                        [TN_EXPECT_DROP] = "drop"};
    static const tn_expectation others[] = {[TN_EXPECT_MATCH] = TN_EXPECT_DROP,
                                            [TN_EXPECT_REJECT] = TN_EXPECT_KEEP,
                                            [TN_EXPECT_KEEP] = TN_EXPECT_REJECT,
                                            [TN_EXPECT_DROP] = TN_EXPECT_MATCH};
    tn_diagnostic *d = subject->library ? tn_report(check->diagnostics, E_WRONG_EXPECTATION, word->node.span,
                                                    "a library keeps plans or drops them, it does not match")
                                        : tn_report(check->diagnostics, E_WRONG_EXPECTATION, word->node.span,
                                                    "a rule matches plans or rejects them, it does not prune");
    tn_note(check->diagnostics, d, &subject->span, "the %s is here", subject->library ? "library" : "rule");
    tn_advise(check->diagnostics, d, "%s", words[others[expectation]]);
    return false;
}

static void report_clause(tn_check *check, const tn_checked_library *library, const tn_ast_word *word)
{
    const char **names = TN_NEW_ARRAY(check->arena, const char *, library->clause_count + 1);
    if (!names || check->skipped || check->incomplete)
        return;
    for (size_t i = 0; i < library->clause_count; i++)
        names[i] = library->clauses[i]->name;
    names[library->clause_count] = "trays";
    tn_diagnostic *d = tn_report(check->diagnostics, E_UNKNOWN_CLAUSE, word->node.span,
                                 "library `%s` has no clause `%s`", library->name, word->text);
    tn_note(check->diagnostics, d, &library->ast->name->node.span, "library `%s` is here", library->name);
    const char *near = tn_nearest(word->text, names, library->clause_count + 1);
    if (near)
        tn_suggest(check->diagnostics, d, "%s", near);
    else
        tn_help(check->diagnostics, d,
                "name a rule of its clauses, `trays`, `total`, or `require@`, `prune@` or `generate@` with a line's "
                "number");
}

/* The names after `by`; NULL where one is wrong. */
static const char *const *check_by(tn_check *check, const tn_ast_case *ast, tn_expectation expectation,
                                   const tn_checked_name *subject)
{
    const char **names = TN_NEW_ARRAY(check->arena, const char *, ast->by.count);
    size_t count = 0;
    bool good = names != NULL;
    if (ast->by.count > 0 && expectation != TN_EXPECT_DROP) {
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_WRONG_EXPECTATION, ast->by.first->span, "`by` is for `drop` alone");
        tn_help(check->diagnostics, d, "leave `by` out, or write `drop`");
        return NULL;
    }
    for (TN_EACH(const tn_ast_word, word, ast->by)) {
        if (!names)
            return NULL;
        const tn_checked_library *library = subject->library;
        const tn_checked_clause *clause = tn_names_get(&library->clause_names, word->text);
        if (!clause && library->plans)
            clause = tn_names_get(&library->plans->clause_names, word->text);
        if (clause || tn_word_is(word, "trays")) {
            names[count++] = clause ? clause->name : "trays";
        } else {
            report_clause(check, subject->library, word);
            good = false;
        }
    }
    return good ? names : NULL;
}

/* What a case expects of the subject at `column`; NULL where it says nothing of that one. */
static const tn_ast_word *expectation_at(const tn_ast_case *ast, size_t column)
{
    const tn_ast_node *node = ast->expectations.first;
    while (node && column-- > 0)
        node = node->next;
    return (const tn_ast_word *)node;
}

/* What the measure has to be: a constant of its dimension. */
static bool check_value(tn_check *check, const tn_ast_case *ast, const tn_checked_rule *measure, tn_test_case *result)
{
    tn_ast_expr *value = ast->value;
    tn_expand(check, &value);
    size_t errors = check->diagnostics->error_count;
    tn_check_sum_expr(check, value);
    tn_checked_sum *sum = check->diagnostics->error_count == errors ? tn_check_sum(check, value) : NULL;
    if (!sum || !measure->sum)
        return false;
    tn_sum_amount wanted = {.value = sum->constant, .power = sum->power, .any = sum->any},
                  of = {.power = measure->sum->power}, both;
    if (sum->count > 0) {
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_RULE_OR_NUMBER, value->node.span, "a constant has to stand here");
        tn_help(check->diagnostics, d, "write the value that the plan has, such as `31000` or `96ft2`");
        return false;
    }
    result->value = sum->constant;
    return tn_same_power(check, of, measure->ast->name->node.span, wanted, value->node.span, "the value of", &both);
}

/* A house where a plan is wanted. */
static bool not_a_plan(tn_check *check, const tn_ast_case *ast)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_NOT_A_HOUSE, ast->node.span,
                                 "what is tested is about plans, and this is a house");
    tn_help(check->diagnostics, d, "write the plan alone, up to the first `;`");
    return false;
}

/* A choice that every plan leaves, whatever its trays are; NULL where none is known. What is forbidden may decide it.
 */
static const tn_checked_choice *choice_left(const tn_checked_form *form)
{
    for (uint32_t i = 0; i < form->rule_count; i++)
        if (form->rules[i].kind == TN_CELL_FORBID)
            return NULL;
    for (uint32_t i = 0; i < form->choice_count; i++)
        if (form->choices[i].zone == TN_NONE && form->choices[i].shape_count > 1)
            return &form->choices[i];
    return NULL;
}

static bool not_a_house(tn_check *check, const tn_ast_case *ast, const tn_checked_choice *choice)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_NOT_A_HOUSE, ast->node.span,
                                 "what is tested is about houses, and this is a plan");
    if (choice)
        tn_note(check->diagnostics, d, &choice->ast->node.span, "the plan does not say which `%s` the house has",
                choice->name);
    tn_help(check->diagnostics, d,
            "write the line of a house: `[plan ; options ; functions ; faces]`; parts at the end may be left out if "
            "they leave no choice");
    return false;
}

/* The line of a house. A plan is one, too, where it leaves no choice; that is found out when the test is run. */
static bool read_house(tn_check *check, const tn_ast_case *ast, const tn_checked_form *form, tn_test_case *result)
{
    const tn_ast_list *trays = &ast->literal.trays;
    const tn_ast_word *house = ast->literal.house;
    if (house) {
        result->house = house->text;
        result->house_place = house->node.span;
        return true;
    }
    const tn_checked_choice *choice = choice_left(form);
    if (choice || !trays->first)
        return not_a_house(check, ast, choice);
    size_t length;
    if (!check->schema || !tn_check_plan(check, check->schema, *trays, &length))
        return false;
    tn_span place = tn_span_join(trays->first->span, trays->last->span);
    char *line = tn_arena_copy(check->arena, check->diagnostics->sources->files[place.file].text + place.begin,
                               place.end - place.begin);
    for (char *c = line; c && *c; c++)
        *c = *c == '\n' || *c == '\r' ? ' ' : *c;
    result->house = line;
    result->house_place = place;
    result->plan_alone = true;
    return line != NULL;
}

static bool check_case(tn_check *check, const tn_ast_case *ast, size_t column, const tn_checked_name *subject,
                       tn_test_case *result)
{
    const tn_ast_word *word = expectation_at(ast, column);
    if (!word || !expectation_fits(check, word, subject))
        return false;
    *result = (tn_test_case){.expectation = (tn_expectation)word->value,
                             .todo = ast->todo,
                             .span = ast->node.span,
                             .doc = ast->doc ? ast->doc->text : NULL};
    result->by = check_by(check, ast, result->expectation, subject);
    result->by_count = ast->by.count;
    const tn_checked_form *form = subject->rule ? subject->rule->form : subject->library->form;
    if (!form && ast->literal.house)
        return not_a_plan(check, ast);
    if (form && !read_house(check, ast, form, result))
        return false;
    if (!form)
        result->values =
            check->schema ? tn_check_plan(check, check->schema, ast->literal.trays, &result->length) : NULL;
    if (ast->value && !check_value(check, ast, subject->rule, result))
        return false;
    return result->by && (form || result->values);
}

/* One subject of a test with all cases. */
static void check_subject(tn_check *check, const tn_ast_test *ast, const tn_ast_word *word, size_t column,
                          tn_test_block *block)
{
    tn_test_case *cases = TN_NEW_ARRAY(check->arena, tn_test_case, ast->cases.count);
    const tn_checked_name *subject = cases ? tn_check_name(check, word, TN_WANT_EITHER) : NULL;
    if (!subject)
        return;
    check->schema = subject->rule ? subject->rule->schema : subject->library->schema;
    block->subject = word->text;
    block->is_library = subject->library != NULL;
    block->of_houses = subject->rule ? subject->rule->form != NULL : subject->library->form != NULL;
    block->is_measure = subject->rule && subject->rule->is_measure;
    block->index = subject->rule ? subject->rule->index : subject->library->index;
    block->schema = check->schema ? check->schema->index : 0;
    block->span = ast->top.node.span;
    block->cases = cases;
    if (subject->rule && (subject->rule->is_template || subject->rule->is_let)) {
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_WRONG_KIND, word->node.span, "`%s` cannot be tested", word->text);
        tn_note(check->diagnostics, d, &subject->span, "`%s` is here", word->text);
        tn_help(check->diagnostics, d, "give a call of it a name, as a rule, and test that");
        return;
    }
    for (TN_EACH(const tn_ast_case, c, ast->cases))
        block->case_count += check_case(check, c, column, subject, &cases[block->case_count]);
}

/* A table says of each plan what is expected of every subject, in their order. */
static void check_columns(tn_check *check, const tn_ast_test *ast)
{
    for (TN_EACH(const tn_ast_case, c, ast->cases)) {
        if (c->expectations.count == ast->subjects.count || !c->expectations.count)
            continue;
        tn_diagnostic *d = tn_report(check->diagnostics, E_WRONG_EXPECTATION, c->expectations.last->span,
                                     "the test is of %zu name%s, and this case says what is expected of %zu",
                                     ast->subjects.count, ast->subjects.count == 1 ? "" : "s", c->expectations.count);
        tn_help(check->diagnostics, d, "write one expectation for each name, in their order: match reject [...]");
    }
}

void tn_check_tests(tn_check *check)
{
    tn_checked *result = check->result;
    size_t count = 0;
    for (size_t u = 0; u < check->imports->count; u++)
        for (TN_EACH(const tn_ast_top, item, ((const tn_ast_file *)check->imports->units[u]->tree)->items))
            count += item->kind == TN_ITEM_TEST ? ((const tn_ast_test *)item)->subjects.count : 0;
    tn_test_block *blocks = TN_NEW_ARRAY(check->arena, tn_test_block, count);
    if (!blocks)
        return;
    check->rule = NULL;
    result->program->tests = blocks;
    for (check->unit = 0; check->unit < check->imports->count; check->unit++) {
        const tn_ast_file *file = check->imports->units[check->unit]->tree;
        size_t number = 0;
        for (TN_EACH(const tn_ast_top, item, file->items)) {
            const tn_ast_test *test = (const tn_ast_test *)item;
            size_t column = 0;
            if (item->kind != TN_ITEM_TEST)
                continue;
            number++;
            check_columns(check, test);
            tn_check_with(check, test);
            for (TN_EACH(const tn_ast_word, subject, test->subjects)) {
                if (!tn_check_room(check, result->program->test_count, TN_TESTS_MAX, "test", item->node.span,
                                   "one `test` can have many cases"))
                    break;
                tn_test_block *block = &blocks[result->program->test_count++];
                block->imported = check->unit + 1 < check->imports->count;
                if (test->settings.first) {
                    block->with = number;
                    block->settings = tn_span_join(test->settings.first->span, test->settings.last->span);
                }
                check_subject(check, test, subject, column++, block);
            }
        }
    }
}
