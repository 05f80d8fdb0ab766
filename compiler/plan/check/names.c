/* The names of all files: collecting them, and finding what a word means where it stands. */
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "compiler/common/limits.h"
#include "compiler/plan/check/form.h"
#include "compiler/plan/syntax/slip.h"
#include "compiler/plan/syntax/words.h"
#include "runtime/base/nearest.h"

/* ---- collecting */

typedef struct counts {
    size_t schemas, rules, libraries, tests;
} counts;

/* Is it written as a tn_ast_rule? */
static bool is_rule_like(tn_item_kind kind)
{
    return kind == TN_ITEM_RULE || kind == TN_ITEM_MEASURE || kind == TN_ITEM_LET || kind == TN_ITEM_PARAM;
}

static counts count_items(const tn_imports *imports)
{
    counts n = {0};
    for (size_t u = 0; u < imports->count; u++) {
        const tn_ast_file *file = imports->units[u]->tree;
        for (TN_EACH(const tn_ast_top, item, file->items)) {
            n.schemas += item->kind == TN_ITEM_SCHEMA;
            n.rules += is_rule_like(item->kind);
            n.libraries += item->kind == TN_ITEM_LIBRARY;
            n.tests += item->kind == TN_ITEM_TEST;
        }
    }
    return n;
}

bool tn_check_room(tn_check *check, size_t count, size_t limit, const char *what, tn_span span, const char *help)
{
    if (count < limit)
        return true;
    check->incomplete = true;
    if (check->too_many_said)
        return false;
    check->too_many_said = true;
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_TOO_MANY, span, "this is one %s more than the limit of %zu", what, limit);
    tn_help(check->diagnostics, d, "%s", help);
    return false;
}

static const char split_help[] = "split the file, and check the parts one by one";

static void report_duplicate(tn_check *check, const tn_ast_word *name, const char *what, tn_span before)
{
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_DUPLICATE_NAME, name->node.span, "the name `%s` is already taken", name->text);
    tn_note(check->diagnostics, d, &before, "the %s `%s` is here", what, name->text);
    tn_help(check->diagnostics, d, "choose another name for one of the two");
}

static bool name_fits(tn_check *check, const tn_ast_word *name)
{
    if (tn_name_fits(check->diagnostics, name->text, name->node.span))
        return true;
    check->incomplete = true;
    return false;
}

static void add_schema(tn_check *check, const tn_ast_schema *ast, size_t unit)
{
    tn_checked *result = check->result;
    if (!name_fits(check, ast->name) ||
        !tn_check_room(check, result->schema_count, TN_SCHEMAS_MAX, "schema", ast->name->node.span, split_help))
        return;
    const tn_checked_schema *before = tn_names_get(&check->schemas, ast->name->text);
    if (before) {
        report_duplicate(check, ast->name, "schema", before->ast->name->node.span);
        return;
    }
    tn_checked_schema *schema = TN_NEW(check->arena, tn_checked_schema);
    if (!schema)
        return;
    *schema = (tn_checked_schema){.ast = ast, .name = ast->name->text, .unit = unit, .length_field = TN_NONE};
    schema->doc = ast->doc ? ast->doc->text : NULL;
    schema->index = (uint32_t)result->schema_count;
    result->schemas[result->schema_count++] = schema;
    tn_names_put(&check->schemas, schema->name, schema);
}

static const char *tn_name_kind(const tn_checked_name *name)
{
    return !name->rule              ? "library"
           : name->rule->is_measure ? "measure"
           : name->rule->param      ? "param"
           : name->rule->is_let     ? "`let`"
                                    : "rule";
}

static tn_checked_name *add_name(tn_check *check, const tn_ast_word *word, size_t unit)
{
    if (!name_fits(check, word))
        return NULL;
    const tn_checked_name *before = tn_names_get(&check->names, word->text);
    if (before) {
        report_duplicate(check, word, tn_name_kind(before), before->span);
        return NULL;
    }
    tn_checked_name *name = TN_NEW(check->arena, tn_checked_name);
    if (!name)
        return NULL;
    *name = (tn_checked_name){.span = word->node.span, .unit = unit};
    tn_names_put(&check->names, word->text, name);
    return name;
}

bool tn_check_grow_rules(tn_check *check)
{
    tn_checked *result = check->result;
    size_t capacity = result->rule_capacity * 2 + 16;
    tn_checked_rule **rules = TN_NEW_ARRAY(check->arena, tn_checked_rule *, capacity);
    tn_checked_rule **order = TN_NEW_ARRAY(check->arena, tn_checked_rule *, capacity);
    if (!rules || !order)
        return false;
    if (result->rule_count) {
        memcpy(rules, result->rules, result->rule_count * sizeof *rules);
        memcpy(order, result->order, result->ordered * sizeof *order);
    }
    result->rules = rules;
    result->order = order;
    result->rule_capacity = capacity;
    return true;
}

/* A rule, a measure, a `let` or a param. Rules with parameters and `let` are not among the rules: what is made of them
 * is. */
static void add_rule(tn_check *check, tn_ast_rule *ast, size_t unit)
{
    tn_checked *result = check->result;
    if (!tn_check_room(check, result->rule_count, TN_RULES_MAX, "rule", ast->name->node.span, split_help))
        return;
    tn_checked_name *name = add_name(check, ast->name, unit);
    tn_checked_rule *rule = TN_NEW(check->arena, tn_checked_rule);
    if (!name || !rule)
        return;
    *rule = (tn_checked_rule){.ast = ast,
                              .name = ast->name->text,
                              .unit = unit,
                              .serial = (uint32_t)result->rule_count,
                              .is_measure = ast->top.kind == TN_ITEM_MEASURE,
                              .is_let = ast->top.kind == TN_ITEM_LET || ast->top.kind == TN_ITEM_PARAM,
                              .is_template = ast->params.first != NULL,
                              .written = ast->body};
    if (ast->top.kind == TN_ITEM_PARAM)
        rule->param = TN_NEW(check->arena, tn_checked_param);
    check->has_lets |= rule->is_let;
    name->rule = rule;
    if (rule->is_template)
        check->templates[check->template_count++] = rule;
    if (rule->is_let && !rule->param)
        tn_check_let(check, ast->body);
    if (rule->is_let || rule->is_template)
        return;
    rule->index = (uint32_t)(rule->is_measure ? result->measure_records++ : result->records++);
    result->rules[result->rule_count++] = rule;
}

static void add_library(tn_check *check, const tn_ast_library *ast, size_t unit)
{
    tn_checked *result = check->result;
    if (!tn_check_room(check, result->library_count, TN_LIBRARIES_MAX, "library", ast->name->node.span, split_help))
        return;
    tn_checked_name *name = add_name(check, ast->name, unit);
    tn_checked_library *library = TN_NEW(check->arena, tn_checked_library);
    if (!name || !library)
        return;
    *library = (tn_checked_library){
        .ast = ast, .name = ast->name->text, .unit = unit, .index = (uint32_t)result->library_count};
    library->clause_names.arena = library->weight_names.arena = library->preference_names.arena = check->arena;
    name->library = library;
    result->libraries[result->library_count++] = library;
}

void tn_check_collect(tn_check *check)
{
    tn_checked *result = check->result;
    counts n = count_items(check->imports);
    result->schemas = TN_NEW_ARRAY(check->arena, tn_checked_schema *, n.schemas);
    result->rules = TN_NEW_ARRAY(check->arena, tn_checked_rule *, n.rules);
    result->order = TN_NEW_ARRAY(check->arena, tn_checked_rule *, n.rules);
    result->rule_capacity = n.rules;
    check->templates = TN_NEW_ARRAY(check->arena, tn_checked_rule *, n.rules);
    result->libraries = TN_NEW_ARRAY(check->arena, tn_checked_library *, n.libraries);
    result->program = TN_NEW(check->arena, tn_program);
    check->no_schema_said = TN_NEW_ARRAY(check->arena, bool, check->imports->count);
    check->several_said = TN_NEW_ARRAY(check->arena, bool, check->imports->count);
    if (tn_arena_failed(check->arena))
        return;
    for (size_t u = 0; u < check->imports->count; u++) {
        const tn_ast_file *file = check->imports->units[u]->tree;
        check->incomplete |= file->broken || check->imports->units[u]->incomplete;
        check->skipped |= file->skipped;
        for (TN_EACH(tn_ast_top, item, file->items)) {
            if (item->kind == TN_ITEM_SCHEMA)
                add_schema(check, (const tn_ast_schema *)item, u);
            else if (is_rule_like(item->kind))
                add_rule(check, (tn_ast_rule *)item, u);
            else if (item->kind == TN_ITEM_LIBRARY)
                add_library(check, (const tn_ast_library *)item, u);
        }
    }
}

/* ---- finding */

static const char *path_of(const tn_check *check, size_t unit)
{
    return check->diagnostics->sources->files[check->imports->units[unit]->file].path;
}

/* A name that exists, but in a file that this one does not use. */
static void report_invisible(tn_check *check, const tn_ast_word *word, size_t unit, tn_span there)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_NOT_IMPORTED, word->node.span,
                                 "`%s` is in a file that this one does not use", word->text);
    tn_note(check->diagnostics, d, &there, "`%s` is here", word->text);
    const char *recorded = check->imports->units[unit]->recorded;
    const char *slash = strrchr(path_of(check, unit), '/');
    const char *file = slash ? slash + 1 : path_of(check, unit);
    if (strncmp(recorded, "<stdlib>/", 9) == 0)
        tn_help(check->diagnostics, d, "add `use \"%.*s\"` at the top", (int)strcspn(file, "."), file);
    else
        tn_help(check->diagnostics, d, "add `use \"%s\"` at the top", file);
}

static const char *nearest_schema(tn_check *check, const char *word)
{
    const tn_checked *result = check->result;
    const char **names = TN_NEW_ARRAY(check->arena, const char *, result->schema_count);
    for (size_t i = 0; names && i < result->schema_count; i++)
        names[i] = result->schemas[i]->name;
    return names ? tn_nearest(word, names, result->schema_count) : NULL;
}

static tn_checked_schema *named_schema(tn_check *check, size_t unit, const tn_ast_word *using)
{
    tn_checked_schema *schema = tn_names_get(&check->schemas, using->text);
    if (schema && tn_import_reaches(check->imports, unit, schema->unit))
        return schema;
    if (schema) {
        report_invisible(check, using, schema->unit, schema->ast->name->node.span);
        return NULL;
    }
    if (check->incomplete || using->broken)
        return NULL;
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_UNKNOWN_SCHEMA, using->node.span, "there is no schema `%s`", using->text);
    const char *near = nearest_schema(check, using->text);
    bool form = false;
    for (size_t i = 0; i < check->result->form_count; i++)
        form |= strcmp(check->result->forms[i]->name, using->text) == 0;
    if (form)
        tn_help(check->diagnostics, d, "it is a form: a library of houses is written `library NAME from PLANS in %s`",
                using->text);
    else if (near)
        tn_suggest(check->diagnostics, d, "%s", near);
    else
        tn_help(check->diagnostics, d, "declare it with `schema %s { ... }`, or `use` the file that does", using->text);
    return NULL;
}

static void report_no_schema(tn_check *check, size_t unit, tn_span place)
{
    if (check->incomplete || check->no_schema_said[unit])
        return;
    check->no_schema_said[unit] = true;
    tn_diagnostic *d = tn_report(check->diagnostics, E_NO_SCHEMA, place, "no schema says what a tray is");
    tn_help(check->diagnostics, d, "write `use \"lahave\"` at the top, or declare a `schema` of your own");
}

tn_checked_schema *tn_check_schema_for(tn_check *check, size_t unit, const tn_ast_word *using, tn_span place)
{
    if (using)
        return named_schema(check, unit, using);
    const tn_checked *result = check->result;
    tn_checked_schema *found = NULL, *other = NULL;
    for (size_t i = 0; i < result->schema_count; i++) {
        if (!tn_import_reaches(check->imports, unit, result->schemas[i]->unit))
            continue;
        other = found;
        found = result->schemas[i];
        if (other)
            break;
    }
    if (!found)
        report_no_schema(check, unit, place);
    if (!other)
        return found;
    if (check->several_said[unit])
        return NULL;
    check->several_said[unit] = true;
    tn_diagnostic *d = tn_report(check->diagnostics, E_SEVERAL_SCHEMAS, place,
                                 "several schemas are in scope here, and it is not clear which one is meant");
    tn_note(check->diagnostics, d, &other->ast->name->node.span, "schema `%s`", other->name);
    tn_note(check->diagnostics, d, &found->ast->name->node.span, "schema `%s`", found->name);
    tn_help(check->diagnostics, d,
            "write `using %s` or `using %s` behind the name and its text, here and in each rule and library",
            other->name, found->name);
    return NULL;
}

/* Among the names of the kind that is wanted; where an expression may stand, also the words that are one. */
static const char *nearest_name(tn_check *check, const char *word, tn_want want)
{
    static const char *const leaves[] = {"any", "beginning", "end"};
    enum { LEAVES = sizeof leaves / sizeof *leaves };
    const tn_checked *result = check->result;
    const char **names = TN_NEW_ARRAY(check->arena, const char *, result->library_count + result->rule_count + LEAVES);
    size_t count = 0;
    for (size_t i = 0; names && want != TN_WANT_LIBRARY && i < result->rule_count; i++)
        names[count++] = result->rules[i]->name;
    for (size_t i = 0; names && want != TN_WANT_RULE && i < result->library_count; i++)
        names[count++] = result->libraries[i]->name;
    for (size_t i = 0; names && want == TN_WANT_RULE && i < LEAVES; i++)
        names[count++] = leaves[i];
    return names ? tn_nearest(word, names, count) : NULL;
}

static const char *const wanted_words[] = {"rule", "library", "rule or library", "measure"};

/* A word of the schema stands where a rule has to: says how a rule asks for it. */
static bool help_word(tn_check *check, tn_diagnostic *d, const tn_checked_schema *schema, const char *word)
{
    uint32_t field = tn_field_find(schema, word);
    const tn_checked_field *f = field == TN_NONE ? NULL : &schema->fields[field];
    const char *first = f && f->value_count ? f->values[0].name : "";
    bool value = false, number = tn_schema_number(schema, word) != NULL;
    for (uint32_t i = 0; i < schema->field_count; i++)
        value |= tn_field_has(&schema->fields[i], word);
    if (number)
        tn_help(check->diagnostics, d, "`%s` is a number of a tray: `sum(%s)` adds it up, `tray(%s >= 2)` asks a tray",
                word, word, word);
    else if (f && f->kind == TN_FIELD_LENGTH)
        tn_help(check->diagnostics, d, "`%s` is a length of a tray: `sum(%s)` adds it up, `tray(%s >= %s)` asks a tray",
                word, word, word, first);
    else if (f && f->kind != TN_FIELD_FLAG)
        tn_help(check->diagnostics, d, "`%s` is a field of schema `%s`: write `tray(%s %s)`", word, schema->name, word,
                first);
    else if (f || value)
        tn_help(check->diagnostics, d, "`%s` is a word of schema `%s`: write `tray(%s)`", word, schema->name, word);
    return f || value || number;
}

/* A function of a form stands where a rule has to. */
static bool help_function(tn_check *check, tn_diagnostic *d, const tn_checked_schema *schema, const char *word)
{
    for (size_t i = 0; i < check->result->form_count; i++) {
        const tn_checked_form *form = check->result->forms[i];
        if (form->schema != schema || tn_form_function(form, word) == TN_NONE)
            continue;
        tn_help(check->diagnostics, d,
                "`%s` is a function of form `%s`: `cell(%s)` asks for its cells, `room(%s)` for its rooms", word,
                form->name, word, word);
        return true;
    }
    return false;
}

/* An opening of a form, for which no rule asks by itself. */
static bool help_opening(tn_check *check, tn_diagnostic *d, const tn_checked_schema *schema, const char *word)
{
    for (size_t i = 0; i < check->result->form_count; i++) {
        const tn_checked_form *form = check->result->forms[i];
        if (form->schema != schema || tn_form_opening_named(form, word) == TN_NONE)
            continue;
        tn_help(check->diagnostics, d,
                "`%s` is an opening of form `%s`: `room(any, by %s)` asks for rooms with one, `not by %s` for those "
                "without",
                word, form->name, word, word);
        return true;
    }
    return false;
}

static const tn_checked_form *form_here(const tn_check *check)
{
    for (size_t i = 0; i < check->result->form_count; i++)
        if (check->result->forms[i]->schema == check->schema)
            return check->result->forms[i];
    return NULL;
}

bool tn_means_cost(const tn_check *check, const char *word)
{
    return form_here(check) && (strcmp(word, "cost") == 0 || strcmp(word, "costs") == 0 || strcmp(word, "price") == 0);
}

static const tn_checked_choice *choice_of_storeys(const tn_checked_form *form)
{
    for (uint32_t i = 0; i < form->choice_count; i++)
        if (form->choices[i].kind == TN_CHOICE_STOREYS && form->choices[i].shape_count > 1)
            return &form->choices[i];
    return NULL;
}

bool tn_help_height(tn_check *check, tn_diagnostic *d, const char *word)
{
    const tn_checked_form *form = form_here(check);
    if (!form || (strcmp(word, "height") != 0 && strcmp(word, "heights") != 0))
        return false;
    const tn_checked_choice *choice = choice_of_storeys(form);
    if (choice)
        tn_help(check->diagnostics, d,
                "rules do not measure how high a house is: ask how many storeys it has, `option(%s %s)`", choice->name,
                choice->shapes[0].spelling);
    else
        tn_help(check->diagnostics, d,
                "rules do not measure how high a house is: its storeys have the heights that form `%s` gives them",
                form->name);
    return true;
}

/* `area-20m2`: a name from which something is to be taken away, without blanks. */
static bool help_minus(tn_check *check, tn_diagnostic *d, const char *word)
{
    const char *dash = strchr(word, '-');
    while (dash && !(dash[1] >= '0' && dash[1] <= '9'))
        dash = strchr(dash + 1, '-');
    const char *name = dash ? tn_arena_copy(check->arena, word, (size_t)(dash - word)) : NULL;
    if (!name || !tn_names_get(&check->names, name))
        return false;
    tn_help(check->diagnostics, d, "a minus sign has a blank on each side: `%s - %s`", name, dash + 1);
    tn_replace_with(check->diagnostics, d, "%s - %s", name, dash + 1);
    return true;
}

static void report_unknown(tn_check *check, const tn_ast_word *word, tn_want want)
{
    if (check->incomplete || word->broken)
        return;
    tn_code code = want == TN_WANT_LIBRARY ? E_UNKNOWN_LIBRARY : E_UNKNOWN_RULE;
    tn_diagnostic *d =
        tn_report(check->diagnostics, code, word->node.span, "there is no %s `%s`", wanted_words[want], word->text);
    const char *near = nearest_name(check, word->text, want);
    const tn_checked_schema *schema = want == TN_WANT_RULE ? check->schema : NULL;
    const tn_slip *slip = want == TN_WANT_LIBRARY ? NULL : tn_slip_find(TN_SLIP_RULE, word->text, strlen(word->text));
    if (schema && (help_word(check, d, schema, word->text) || help_function(check, d, schema, word->text) ||
                   help_opening(check, d, schema, word->text)))
        return;
    if (want != TN_WANT_LIBRARY && help_minus(check, d, word->text))
        return;
    if (near)
        tn_suggest(check->diagnostics, d, "%s", near);
    else if (want == TN_WANT_RULE && strcmp(word->text, TN_PREFERENCE_NAME) == 0)
        tn_help(check->diagnostics, d,
                "it is the measure of a library that has `prefer` in its clauses, and named on the command line: "
                "`--where \"preference >= 3\"`");
    else if (want == TN_WANT_RULE && tn_means_cost(check, word->text))
        tn_help(check->diagnostics, d, "what a house costs is `sum(cost)`");
    else if (want == TN_WANT_RULE && tn_help_height(check, d, word->text))
        return;
    else if (slip)
        tn_help(check->diagnostics, d, "%s", slip->help);
    else
        tn_help(check->diagnostics, d, "write the %s, or `use` the file that has it", wanted_words[want]);
}

const tn_checked_name *tn_check_name(tn_check *check, const tn_ast_word *word, tn_want want)
{
    const tn_checked_name *name = tn_names_get(&check->names, word->text);
    if (!name) {
        report_unknown(check, word, want);
        return NULL;
    }
    if (!tn_import_reaches(check->imports, check->unit, name->unit)) {
        report_invisible(check, word, name->unit, name->span);
        return NULL;
    }
    if (want == TN_WANT_EITHER || (want == TN_WANT_LIBRARY) == (name->library != NULL))
        return name;
    tn_diagnostic *d = tn_report(check->diagnostics, E_WRONG_KIND, word->node.span, "`%s` is a %s, not a %s",
                                 word->text, name->library ? "library" : "rule", wanted_words[want]);
    tn_note(check->diagnostics, d, &name->span, "`%s` is here", word->text);
    tn_help(check->diagnostics, d, "name a %s here", wanted_words[want]);
    return NULL;
}

/* A misspelled word of the language that `(` follows reads as a call: `trai(4')`. */
static bool report_misspelled(tn_check *check, const tn_ast_word *word)
{
    enum { WORDS_MAX = 64 };
    const char *words[WORDS_MAX];
    if (tn_names_get(&check->names, word->text) || tn_slip_find(TN_SLIP_RULE, word->text, strlen(word->text)))
        return false;
    const char *near = nearest_name(check, word->text, TN_WANT_RULE);
    size_t count = tn_vocabulary_list(&tn_plan_words, TN_AT(RULE), TN_AS_CALL | TN_AS_VALUE, words, WORDS_MAX);
    const char *meant = near ? NULL : tn_nearest(word->text, words, count);
    if (!meant)
        return false;
    tn_diagnostic *d = tn_report(check->diagnostics, E_UNKNOWN_RULE, word->node.span,
                                 "the language has no `%s(...)`, and there is no rule `%s`", word->text, word->text);
    tn_suggest(check->diagnostics, d, "%s", meant);
    return true;
}

const tn_checked_name *tn_check_call_name(tn_check *check, const tn_ast_expr *call)
{
    if (report_misspelled(check, call->name))
        return NULL;

    const tn_checked_name *name = tn_check_name(check, call->name, TN_WANT_RULE);
    if (!name || (!name->rule->is_measure && !name->rule->is_let))
        return name;
    tn_diagnostic *d = tn_report(check->diagnostics, E_WRONG_KIND, call->name->node.span,
                                 "`%s` is a %s, which has no parameters", call->name->text, tn_name_kind(name));
    tn_note(check->diagnostics, d, &name->span, "`%s` is here", call->name->text);
    tn_help(check->diagnostics, d, "write its name alone");
    return NULL;
}

bool tn_check_new_word(tn_check *check, const tn_checked_schema *schema, const tn_ast_word *word, bool bound)
{
    bool field = schema && tn_field_find(schema, word->text) != TN_NONE;
    for (uint32_t f = 0; schema && f < schema->field_count; f++)
        field |= tn_field_has(&schema->fields[f], word->text);
    field = field || (schema && tn_schema_number(schema, word->text));
    const tn_checked_name *name = tn_names_get(&check->names, word->text);
    if (!field && !name && !bound)
        return true;
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_DUPLICATE_NAME, word->node.span, "the name `%s` is already taken", word->text);
    if (name)
        tn_note(check->diagnostics, d, &name->span, "the %s `%s` is here", tn_name_kind(name), word->text);
    else if (field)
        tn_note(check->diagnostics, d, &schema->ast->name->node.span, "it is a word of schema `%s`", schema->name);
    tn_help(check->diagnostics, d, "choose another name: one that means nothing yet");
    return false;
}

/* ---- allowed warnings */

static const struct {
    uint32_t code;
    const char *text;
} warnings[] = {
#define ERROR(NUMBER, NAME, SUMMARY)
#define WARNING(NUMBER, NAME, SUMMARY) {10000 + NUMBER, SUMMARY},
#include "runtime/base/codes.def"
#undef ERROR
#undef WARNING
};

static uint32_t warning_code(const char *text)
{
    for (size_t i = 0; i < sizeof warnings / sizeof *warnings; i++) {
        char name[8];
        tn_code_name(warnings[i].code, name);
        if (strcasecmp(name, text) == 0)
            return warnings[i].code;
    }
    return 0;
}

void tn_check_allow(tn_check *check, tn_ast_list codes)
{
    for (TN_EACH(tn_ast_word, word, codes)) {
        word->value = warning_code(word->text);
        if (word->value != 0 || word->broken)
            continue;
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_UNKNOWN_WARNING, word->node.span, "there is no warning `%s`", word->text);
        tn_help(check->diagnostics, d, "warnings have codes such as W012; they are shown with each warning");
    }
}

bool tn_check_wanted(const tn_check *check, tn_code warning)
{
    bool of_values = warning == W_ALWAYS_TRUE || warning == W_NEVER_TRUE || warning == W_REMAINDER_NEVER;
    if (of_values && check->settable)
        return false;
    for (TN_EACH(const tn_ast_word, word, check->allow))
        if (word->value == (int64_t)warning)
            return false;
    return !check->quiet;
}

/* Marks the rule, and what it names: as deep as rules name each other; a rule is entered once. */
static void mark_generates(tn_checked_rule *rule)
{
    if (rule->generates)
        return;
    rule->generates = true;
    for (size_t i = 0; i < rule->use_count; i++)
        mark_generates(rule->uses[i]);
}

static void mark_generated(const tn_ast_expr *expr)
{
    if (expr->rule)
        mark_generates(expr->rule);
    for (TN_EACH(const tn_ast_expr, part, expr->parts))
        mark_generated(part);
}

/* A rule that generates is met by whole plans. In how many plans there is a stretch somewhere that it fits is then no
 * warning's matter. */
static void find_generating(const tn_checked *result)
{
    for (size_t i = 0; i < result->library_count; i++)
        for (size_t k = 0; k < result->libraries[i]->clause_count; k++)
            if (result->libraries[i]->clauses[k]->kind == TN_CLAUSE_GENERATE)
                mark_generated(result->libraries[i]->clauses[k]->expr);
}

static const tn_code not_of_generating[] = {W_ALWAYS_MATCHES, W_SUBSUMED, W_EQUIVALENT};

void tn_check_allowances(tn_check *check)
{
    tn_checked *result = check->result;
    const size_t own = sizeof not_of_generating / sizeof *not_of_generating;
    size_t count = result->rule_count * own;
    find_generating(result);
    for (size_t i = 0; i < result->rule_count; i++)
        count += result->rules[i]->ast->allow.count;
    for (size_t i = 0; i < result->library_count; i++)
        count += result->libraries[i]->allow.count;
    for (size_t i = 0; i < result->form_count; i++)
        count += result->forms[i]->allow.count;
    tn_allowance *allowances = TN_NEW_ARRAY(check->arena, tn_allowance, count);
    if (!allowances)
        return;
    result->program->allowances = allowances;
    for (size_t i = 0; i < result->rule_count; i++)
        for (TN_EACH(const tn_ast_word, word, result->rules[i]->ast->allow))
            allowances[result->program->allowance_count++] =
                (tn_allowance){result->rules[i]->ast->top.node.span, (uint32_t)word->value};
    for (size_t i = 0; i < result->rule_count; i++)
        for (size_t k = 0; result->rules[i]->generates && k < own; k++)
            allowances[result->program->allowance_count++] =
                (tn_allowance){result->rules[i]->ast->top.node.span, not_of_generating[k]};
    for (size_t i = 0; i < result->library_count; i++)
        for (TN_EACH(const tn_ast_word, word, result->libraries[i]->allow))
            allowances[result->program->allowance_count++] =
                (tn_allowance){result->libraries[i]->ast->top.node.span, (uint32_t)word->value};
    for (size_t i = 0; i < result->form_count; i++)
        for (TN_EACH(const tn_ast_word, word, result->forms[i]->allow))
            allowances[result->program->allowance_count++] =
                (tn_allowance){result->forms[i]->ast->top.node.span, (uint32_t)word->value};
}

/* ---- what depends on params */

static bool names_settable(const tn_ast_expr *expr)
{
    bool settable = expr->rule && expr->rule->settable;
    for (TN_EACH(const tn_ast_expr, part, expr->parts))
        settable = settable || names_settable(part);
    return settable || (expr->figure && names_settable(expr->figure));
}

/* Does what the clause says depend on a param: of a projection, what any clause of the other library says? */
static bool clause_settable(const tn_checked_clause *clause)
{
    bool settable = clause->settable || (clause->expr && names_settable(clause->expr));
    for (size_t i = 0; clause->above && !settable && i < clause->above->clause_count; i++)
        settable = clause_settable(clause->above->clauses[i]);
    return settable;
}

void tn_check_settable(tn_check *check)
{
    const tn_checked *result = check->result;
    size_t count = result->rule_count;
    for (size_t i = 0; i < result->library_count; i++)
        count += result->libraries[i]->clause_count;
    tn_span *spans = TN_NEW_ARRAY(check->arena, tn_span, count);
    if (!spans)
        return;
    result->program->settable = spans;
    for (size_t i = 0; i < result->rule_count; i++)
        if (result->rules[i]->settable)
            spans[result->program->settable_count++] = result->rules[i]->ast->top.node.span;
    for (size_t i = 0; i < result->library_count; i++) {
        const tn_checked_library *library = result->libraries[i];
        for (size_t k = 0; k < library->clause_count; k++) {
            const tn_checked_clause *clause = library->clauses[k];
            if (clause_settable(clause))
                spans[result->program->settable_count++] = clause->span;
        }
    }
}
