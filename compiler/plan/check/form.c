/* Checks forms: their parts in an order in which each knows what it needs, whatever order they are written in. */
#include <stdio.h>
#include <string.h>

#include "compiler/common/limits.h"
#include "compiler/plan/check/form.h"
#include "runtime/base/length.h"

int64_t tn_form_length(tn_check *check, const tn_ast_word *word)
{
    if (!word || word->broken)
        return -1;
    if (word->kind == TN_WORD_NUMBER && word->value != 0) {
        tn_report_unit(check, NULL, word);
        return -1;
    }
    if (word->value > TN_HOUSE_LENGTH_MAX) {
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_NUMBER_TOO_LARGE, word->node.span, "this length is too large for a house");
        tn_help(check->diagnostics, d, "the largest is 1,099 m");
        return -1;
    }
    return word->value;
}

const char *tn_form_in_unit(const tn_checked_form *form, const char *feet, const char *metric)
{
    const tn_checked_schema *schema = form->schema;
    if (!schema || schema->length_field == TN_NONE || schema->fields[schema->length_field].value_count == 0)
        return feet;
    const char *spelling = schema->fields[schema->length_field].values[0].spelling;
    return tn_length_style_of(spelling) == TN_STYLE_FEET ? feet : metric;
}

void tn_form_unknown(tn_check *check, const tn_checked_form *form, const tn_ast_word *word, const char *what,
                     const char *const *names, size_t count)
{
    if (word->broken || check->skipped || (form->schema && form->schema->broken))
        return;
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_UNKNOWN_PART, word->node.span, "there is no %s `%s`", what, word->text);
    const char *near = tn_nearest(word->text, names, count);
    char list[300] = "";
    for (size_t i = 0; i < count && strlen(list) + strlen(names[i]) + 8 < sizeof list; i++)
        snprintf(list + strlen(list), sizeof list - strlen(list), "%s%s",
                 i == 0           ? ""
                 : i + 1 == count ? " or "
                                  : ", ",
                 names[i]);
    if (strncmp(what, "zone", 4) == 0 && strcmp(word->text, "by") == 0)
        tn_help(check->diagnostics, d,
                "cells have no faces: rooms with one of a kind are `room(any, by open)`, rooms without one "
                "`room(any, not by open)`");
    else if (near)
        tn_suggest(check->diagnostics, d, "%s", near);
    else if (strncmp(what, "zone", 4) == 0 && tn_form_opening_named(form, word->text) != TN_NONE)
        tn_help(check->diagnostics, d,
                "`%s` is an opening: rooms with one are `room(any, by %s)`, rooms without one `room(any, not by %s)`",
                word->text, word->text, word->text);
    else if (count > 0)
        tn_help(check->diagnostics, d, "it can be %s", list);
    else
        tn_help(check->diagnostics, d, "form `%s` declares none", form->name);
}

void tn_form_twice(tn_check *check, const tn_span *span, const tn_span *first, const char *words, const char *name)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_PART_TWICE, *span, "`%s%s` is there twice", words, name);
    tn_note(check->diagnostics, d, first, "the first time is here");
    tn_help(check->diagnostics, d, "leave one of the two out");
}

uint32_t tn_form_storey(const tn_checked_form *form, const char *name)
{
    for (uint32_t i = 0; i < form->storey_count; i++)
        if (strcmp(form->storeys[i].ast->name->text, name) == 0)
            return i;
    return TN_NONE;
}

uint32_t tn_form_opening_named(const tn_checked_form *form, const char *name)
{
    for (uint32_t i = 0; i < form->opening_count; i++)
        if (strcmp(form->openings[i].ast->name->text, name) == 0)
            return i;
    return TN_NONE;
}

uint32_t tn_form_function(const tn_checked_form *form, const char *name)
{
    for (uint32_t i = 0; i < form->function_count; i++)
        if (strcmp(form->rules[i].ast->name->text, name) == 0)
            return i;
    return TN_NONE;
}

/* ---- names */

/* Whose name a storey or function would have; where that is, if anywhere. */
typedef struct tn_name_taken {
    const char *what;
    const tn_span *place;
} tn_name_taken;

/* A storey's or function's name is a word of `cell(...)`: nothing else may be called so. */
static tn_name_taken who_has_name(const tn_checked_form *form, const char *name)
{
    static const char *const own[] = {"any", "void", "area", "not", "or", "and"};
    const tn_checked_schema *schema = form->schema;
    uint32_t storey = tn_form_storey(form, name), function = tn_form_function(form, name);
    if (storey != TN_NONE)
        return (tn_name_taken){"a storey", &form->storeys[storey].ast->name->node.span};
    if (function != TN_NONE)
        return (tn_name_taken){"another function", &form->rules[function].ast->name->node.span};
    for (size_t i = 0; i < sizeof own / sizeof *own; i++)
        if (strcmp(own[i], name) == 0)
            return (tn_name_taken){"a word of `cell(...)`", NULL};
    for (uint32_t f = 0; f < schema->field_count; f++) {
        const tn_checked_field *field = &schema->fields[f];
        if (strcmp(field->name, name) == 0)
            return (tn_name_taken){"a field of the schema", &field->ast->name->node.span};
        for (uint32_t v = 0; tn_field_has(field, name) && v < field->value_count; v++)
            if (strcmp(field->values[v].name, name) == 0)
                return (tn_name_taken){"a value of the schema", &field->values[v].span};
    }
    return (tn_name_taken){0};
}

static bool word_is_free(tn_check *check, const tn_checked_form *form, const tn_ast_word *name)
{
    tn_name_taken taken = who_has_name(form, name->text);
    if (!taken.what)
        return tn_name_fits(check->diagnostics, name->text, name->node.span);
    tn_diagnostic *d = tn_report(check->diagnostics, E_PART_TWICE, name->node.span,
                                 "the name `%.80s` is that of %s already", name->text, taken.what);
    if (taken.place)
        tn_note(check->diagnostics, d, taken.place, "it is here");
    if (tn_form_function(form, name->text) != TN_NONE)
        tn_help(check->diagnostics, d,
                "choose another name; places that one function may be are joined: `at cell(...) or cell(...)`");
    else
        tn_help(check->diagnostics, d, "choose another name, so that `cell(NAME)` is clear");
    return false;
}

/* ---- parts */

static void add_storey(tn_check *check, tn_checked_form *form, const tn_ast_form_clause *ast)
{
    int64_t height = tn_form_length(check, ast->length);
    if (!word_is_free(check, form, ast->name) ||
        !tn_check_room(check, form->storey_count, TN_STOREYS_MAX, "storey", ast->node.span, "leave some of them out"))
        return;
    form->storeys[form->storey_count++] = (tn_checked_storey){ast, height};
}

static void set_spine(tn_check *check, tn_checked_form *form, const tn_ast_form_clause *ast)
{
    const tn_checked_schema *schema = form->schema;
    const char *zones[TN_FIELDS_MAX];
    size_t count = 0;
    for (uint32_t f = 0; f < schema->field_count; f++)
        if (schema->fields[f].kind == TN_FIELD_ZONE)
            zones[count++] = schema->fields[f].name;
    uint32_t field = tn_field_find(schema, ast->name->text);
    if (field != TN_NONE && schema->fields[field].kind == TN_FIELD_ZONE)
        form->spine = field;
    else
        tn_form_unknown(check, form, ast->name, "zone", zones, count);
}

/* ---- how thick walls, partitions, decks and roofs are */

enum { OF_WALL, OF_OUTSIDE, OF_PARTY, OF_PARTITION, OF_DECK, OF_ROOF, OF_COUNT };

static const char *const of_words[OF_COUNT] = {"wall", "wall outside", "wall party", "partition", "floor", "roof"};

const char *tn_form_thickness_words(const tn_ast_form_clause *ast)
{
    if (ast->part != TN_PART_WALL)
        return of_words[OF_PARTITION + (int)(ast->part - TN_PART_PARTITION)];
    bool party = ast->detail && tn_word_is(ast->detail, "party");
    return of_words[!ast->detail ? OF_WALL : party ? OF_PARTY : OF_OUTSIDE];
}

/* Which of them a line says; OF_COUNT: of walls that are not known, then reported. */
static int of_clause(tn_check *check, const tn_checked_form *form, const tn_ast_form_clause *ast)
{
    static const char *const walls[] = {"outside", "party"};
    if (ast->part != TN_PART_WALL)
        return OF_PARTITION + (int)(ast->part - TN_PART_PARTITION);
    if (!ast->detail)
        return OF_WALL;
    for (int i = 0; i < 2; i++)
        if (tn_word_is(ast->detail, walls[i]))
            return OF_OUTSIDE + i;
    tn_form_unknown(check, form, ast->detail, "kind of wall", walls, 2);
    return OF_COUNT;
}

bool tn_form_is_halved(const tn_ast_form_clause *ast)
{
    return ast->part == TN_PART_WALL || ast->part == TN_PART_PARTITION;
}

void tn_form_help_half(tn_check *check, tn_diagnostic *d, const char *why, int64_t length, const char *spelling)
{
    char text[64];
    tn_length_style style = tn_length_style_of(spelling);
    int64_t unit = style == TN_STYLE_FEET ? INT64_C(793750) : INT64_C(1000000), count = (length + unit / 2) / unit;
    tn_length_write_style((count > 0 ? count : 1) * unit, style, text, sizeof text);
    tn_help(check->diagnostics, d, "%s: write %s", why, text);
}

/* Returns a length above 0 in any case. */
static int64_t read_thickness(tn_check *check, const tn_ast_form_clause *ast, int of)
{
    int64_t length = tn_form_length(check, ast->length);
    if (length < 0 || (length > 0 && !(tn_form_is_halved(ast) && length % 2)))
        return length > 0 ? length : 2;
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_BAD_THICKNESS, ast->length->node.span,
                  length == 0 ? "a %s cannot be 0 thick" : "half of this %s is not a whole number of nanometres",
                  of <= OF_PARTY ? "wall" : of_words[of]);
    if (length == 0)
        tn_help(check->diagnostics, d, "write a length above 0");
    else
        tn_form_help_half(check, d, "half of it goes to each side of a plane", length, ast->length->text);
    return length > 0 ? length : 2;
}

/* Walls outside and party walls of a form are equally thick. */
static void check_alike(tn_check *check, const tn_ast_form_clause *first, const tn_ast_form_clause *ast, int of)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_THICKNESS, ast->length->node.span,
                                 "walls outside and party walls of a form are equally thick");
    tn_note(check->diagnostics, d, &first->length->node.span, "the first thickness is here");
    tn_help(check->diagnostics, d, "write `%s %s`", of_words[of], first->length->text);
}

static void check_thicknesses(tn_check *check, tn_checked_form *form)
{
    const tn_ast_form_clause *of[OF_COUNT] = {NULL}, *wall = NULL;
    for (size_t i = 0; i < sizeof form->thickness / sizeof *form->thickness; i++)
        form->thickness[i] = 2;
    for (TN_EACH(const tn_ast_form_clause, clause, form->ast->clauses)) {
        if (clause->part < TN_PART_WALL || clause->part > TN_PART_ROOF)
            continue;
        int which = of_clause(check, form, clause);
        if (which < OF_COUNT && of[which]) {
            tn_form_twice(check, &clause->node.span, &of[which]->node.span, of_words[which], "");
            continue;
        }
        int64_t length = read_thickness(check, clause, which < OF_COUNT ? which : OF_WALL);
        if (which < OF_COUNT)
            of[which] = clause;
        if (clause->part == TN_PART_WALL && wall && length != form->thickness[0] && which < OF_COUNT)
            check_alike(check, wall, clause, which);
        if (clause->part != TN_PART_WALL || !wall)
            form->thickness[clause->part - TN_PART_WALL] = length;
        wall = clause->part == TN_PART_WALL && !wall ? clause : wall;
    }
    form->thickness_ast[TN_LAYERED_OUTSIDE] = of[OF_OUTSIDE] ? of[OF_OUTSIDE] : of[OF_WALL];
    form->thickness_ast[TN_LAYERED_PARTY] = of[OF_PARTY] ? of[OF_PARTY] : of[OF_WALL];
    form->thickness_ast[TN_LAYERED_PARTITION] = of[OF_PARTITION];
    form->thickness_ast[TN_LAYERED_DECK] = of[OF_DECK];
    form->thickness_ast[TN_LAYERED_ROOF] = of[OF_ROOF];
}

/* ---- cells */

/* A function whose name is that of something else is kept: what is said of it elsewhere is right then. */
static bool takes_name(tn_check *check, const tn_checked_form *form, const tn_ast_word *name)
{
    bool there = tn_form_storey(form, name->text) != TN_NONE || tn_form_function(form, name->text) != TN_NONE;
    word_is_free(check, form, name);
    return !there;
}

static void add_rule(tn_check *check, tn_checked_form *form, const tn_ast_form_clause *ast, tn_cell_rule_kind kind)
{
    if (!tn_check_room(check, form->rule_count, TN_CELL_RULES_MAX, "line of cells", ast->node.span,
                       "join some of them by `or`"))
        return;
    if (kind == TN_CELL_FUNCTION && !takes_name(check, form, ast->name))
        return;
    form->rules[form->rule_count++] = (tn_checked_cell_rule){.ast = ast, .kind = kind};
    form->function_count += kind == TN_CELL_FUNCTION;
}

static void check_rules(tn_check *check, tn_checked_form *form)
{
    for (uint32_t i = 0; i < form->rule_count; i++) {
        tn_checked_cell_rule *rule = &form->rules[i];
        if (rule->kind == TN_CELL_FORBID)
            tn_form_section(check, form, rule->ast->first, &rule->decision);
        else
            tn_form_cell(check, form, rule->ast->first, false, &rule->decision);
    }
}

/* ---- a pass over the clauses for each kind of part */

static void each(tn_check *check, tn_checked_form *form, tn_form_part part)
{
    for (TN_EACH(const tn_ast_form_clause, clause, form->ast->clauses)) {
        if (clause->part != part)
            continue;
        if (part == TN_PART_STOREY)
            add_storey(check, form, clause);
        else if (part == TN_PART_SPINE)
            set_spine(check, form, clause);
        else if (part == TN_PART_SECTION)
            tn_check_choice(check, form, clause);
        else if (part <= TN_PART_FUNCTION)
            add_rule(check, form, clause,
                     part == TN_PART_FUNCTION ? TN_CELL_FUNCTION
                     : part == TN_PART_VOID   ? TN_CELL_VOID
                     : part == TN_PART_NO     ? TN_CELL_NO
                                              : TN_CELL_FORBID);
        else if (part == TN_PART_OPENING)
            tn_check_opening(check, form, clause);
        else if (part == TN_PART_FLIGHT)
            tn_check_flight(check, form, clause);
        else if (part == TN_PART_FACE)
            tn_check_face(check, form, clause);
        else if (part == TN_PART_TILE)
            tn_check_tile(check, form, clause);
        else if (part == TN_PART_MATERIAL)
            tn_check_material(check, form, clause);
        else if (part == TN_PART_CLASSIFICATION)
            tn_check_classification(check, form, clause);
    }
}

/* The spine is said at most once; some parts a form cannot be without. */
static void check_once(tn_check *check, tn_checked_form *form)
{
    static const char *const words[] = {"storey", "spine", "wall", "partition", "floor", "roof"};
    const tn_ast_form_clause *first[TN_PART_ALLOW + 1] = {NULL};
    for (TN_EACH(const tn_ast_form_clause, clause, form->ast->clauses)) {
        if (clause->part == TN_PART_SPINE && first[clause->part])
            tn_form_twice(check, &clause->node.span, &first[clause->part]->node.span, "spine", "");
        first[clause->part] = first[clause->part] ? first[clause->part] : clause;
    }
    static const tn_form_part needed[] = {TN_PART_STOREY, TN_PART_WALL, TN_PART_PARTITION, TN_PART_DECK, TN_PART_ROOF};
    for (size_t i = 0; i < sizeof needed / sizeof *needed; i++) {
        if (first[needed[i]] || check->skipped)
            continue;
        tn_diagnostic *d = tn_report(check->diagnostics, E_FORM_LACKS, form->ast->name->node.span,
                                     "form `%s` has no `%s`", form->name, words[needed[i]]);
        tn_help(check->diagnostics, d, "add a line such as `%s %s`", words[needed[i]],
                needed[i] == TN_PART_STOREY ? tn_form_in_unit(form, "ground 9'", "ground 2.7m")
                                            : tn_form_in_unit(form, "6\"", "150mm"));
    }
}

static void check_heights(tn_check *check, const tn_checked_form *form)
{
    for (uint32_t i = 0; i < form->storey_count; i++) {
        const tn_checked_storey *storey = &form->storeys[i];
        if (storey->height < 0 || storey->height > form->thickness[2])
            continue;
        tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_THICKNESS, storey->ast->length->node.span,
                                     "storey `%s` is not higher than the floor above it is thick", storey->ast->name->text);
        tn_help(check->diagnostics, d, "a storey is measured from floor to floor, the `floor` included");
    }
}

/* ---- walls that would overlap */

/* Two walls of one cell are a wall apart at least: a tray's length, and each depth. What trays side by side do is found
 * when a house stands up (E1610 too). */
static void check_walls(tn_check *check, const tn_checked_form *form)
{
    for (uint32_t f = 0; f < form->schema->field_count; f++) {
        const tn_checked_field *field = &form->schema->fields[f];
        for (uint32_t v = 0; v < field->value_count; v++) {
            const tn_checked_value *value = &field->values[v];
            bool measured = f == form->schema->length_field || (field->kind == TN_FIELD_ZONE && value->length > 0);
            if (!measured || value->length >= form->thickness[0])
                continue;
            char shown[64];
            tn_length_write_style(value->length, tn_length_style_of(value->spelling), shown, sizeof shown);
            tn_diagnostic *d = tn_report(check->diagnostics, E_TOO_NEAR, form->ast->name->node.span,
                                         "walls of form `%s` can be %s apart, and are thicker", form->name, shown);
            tn_note(check->diagnostics, d, &value->span, "the length is here");
            tn_help(check->diagnostics, d, "make `wall` thinner, or the length larger");
            return;
        }
    }
}

/* ---- forms */

/* How many names are tried for what is to be added to a schema. */
enum { FREE_NAMES = 4 };

static bool is_taken(const tn_checked_schema *schema, const char *name)
{
    return tn_schema_says(schema, name) || tn_schema_number(schema, name);
}

/* The first of these names that nothing in the schema has; the last one where all are taken. */
static const char *free_name(const tn_checked_schema *schema, const char *const names[FREE_NAMES])
{
    size_t i = 0;
    while (i + 1 < FREE_NAMES && is_taken(schema, names[i]))
        i++;
    return names[i];
}

static void help_schema(tn_check *check, const tn_checked_schema *schema, bool zones, tn_diagnostic *d)
{
    static const char *const lengths[FREE_NAMES] = {"width", "length", "bay", "span"};
    static const char *const bodies[FREE_NAMES] = {"body", "core", "middle", "inside"};
    static const char *const fills[FREE_NAMES] = {"open", "room", "free", "space"};
    if (zones)
        tn_help(check->diagnostics, d, "add a field such as `%s = 8' | 12'`", free_name(schema, lengths));
    else
        tn_help(check->diagnostics, d, "add a field such as `zone %s = %s(8')`", free_name(schema, bodies),
                free_name(schema, fills));
}

/* A form stands on trays that have a length, in zones. */
static bool schema_stands(tn_check *check, tn_checked_form *form)
{
    tn_checked_schema *schema = form->schema;
    form->spine = TN_NONE;
    for (uint32_t f = schema->field_count; f-- > 0;)
        if (schema->fields[f].kind == TN_FIELD_ZONE)
            form->spine = f;
    const tn_checked_schema *of = tn_schema_of_library(schema);
    if (of) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_FORM_SCHEMA, form->ast->schema->node.span,
                                     "a tray of schema `%s` is a plan, which has no cells", schema->name);
        tn_note(check->diagnostics, d, &of->ast->of->node.span, "it stands for plans of `%s`", of->ast->of->text);
        tn_help(check->diagnostics, d, "name the schema of these plans");
        return false;
    }
    if (form->spine != TN_NONE && schema->length_field != TN_NONE)
        return true;
    if (schema->broken)
        return false;
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_FORM_SCHEMA, form->ast->schema->node.span, "trays of schema `%s` have no %s",
                  schema->name, form->spine == TN_NONE ? "zones" : "length");
    tn_note(check->diagnostics, d, &schema->ast->name->node.span, "schema `%s` is here", schema->name);
    help_schema(check, schema, form->spine != TN_NONE, d);
    return false;
}

static bool make_room(tn_check *check, tn_checked_form *form)
{
    size_t count = form->ast->clauses.count;
    form->storeys = TN_NEW_ARRAY(check->arena, tn_checked_storey, count);
    form->choices = TN_NEW_ARRAY(check->arena, tn_checked_choice, count);
    form->rules = TN_NEW_ARRAY(check->arena, tn_checked_cell_rule, count);
    form->openings = TN_NEW_ARRAY(check->arena, tn_checked_opening, count);
    form->faces = TN_NEW_ARRAY(check->arena, tn_checked_face, count);
    form->tiles = TN_NEW_ARRAY(check->arena, tn_checked_tile, count);
    form->materials = TN_NEW_ARRAY(check->arena, tn_checked_material, count);
    form->classifications = TN_NEW_ARRAY(check->arena, tn_checked_classification, count);
    form->ways = TN_NEW_ARRAY(check->arena, tn_checked_way, count);
    return !tn_arena_failed(check->arena);
}

/* The warnings that the form's lines `allow`. */
static void gather_allowed(tn_check *check, tn_checked_form *form)
{
    for (TN_EACH(const tn_ast_form_clause, clause, form->ast->clauses)) {
        if (clause->part != TN_PART_ALLOW)
            continue;
        tn_check_allow(check, clause->list);
        for (TN_EACH(const tn_ast_word, word, clause->list)) {
            tn_ast_word *copy = TN_NEW(check->arena, tn_ast_word);
            if (!copy)
                return;
            *copy = *word; /* a node is in one list */
            copy->node.next = NULL;
            form->allow = tn_ast_append(form->allow, copy);
        }
    }
    check->allow = form->allow;
}

static void check_form(tn_check *check, tn_checked_form *form)
{
    static const tn_form_part before[] = {TN_PART_STOREY, TN_PART_SPINE,  TN_PART_FUNCTION, TN_PART_VOID,
                                          TN_PART_NO,     TN_PART_FORBID, TN_PART_SECTION};
    check->unit = form->unit;
    gather_allowed(check, form);
    form->schema = tn_check_schema_for(check, form->unit, form->ast->schema, form->ast->schema->node.span);
    check->schema = form->schema;
    form->broken = !form->schema || !make_room(check, form) || !schema_stands(check, form);
    if (form->broken)
        return;
    check_thicknesses(check, form);
    for (size_t i = 0; i < sizeof before / sizeof *before; i++)
        each(check, form, before[i]);
    check_once(check, form);
    check_heights(check, form);
    check_walls(check, form);
    check_rules(check, form);
    each(check, form, TN_PART_OPENING);
    each(check, form, TN_PART_FLIGHT);
    each(check, form, TN_PART_FACE);
    each(check, form, TN_PART_TILE);
    tn_check_ways(check, form);
    tn_check_layers(check, form);
    tn_check_beams(check, form);
    each(check, form, TN_PART_MATERIAL);
    each(check, form, TN_PART_CLASSIFICATION);
    tn_check_layer_prices(check, form);
}

static void add_form(tn_check *check, const tn_ast_form *ast, size_t unit)
{
    tn_checked *result = check->result;
    for (size_t i = 0; i < result->form_count; i++) {
        if (strcmp(result->forms[i]->name, ast->name->text) != 0)
            continue;
        tn_diagnostic *d = tn_report(check->diagnostics, E_DUPLICATE_NAME, ast->name->node.span,
                                     "the name `%s` is already taken", ast->name->text);
        tn_note(check->diagnostics, d, &result->forms[i]->ast->name->node.span, "the form `%s` is here",
                ast->name->text);
        tn_help(check->diagnostics, d, "choose another name for one of the two");
        return;
    }
    tn_checked_form *form = TN_NEW(check->arena, tn_checked_form);
    if (!form)
        return;
    *form = (tn_checked_form){.ast = ast, .name = ast->name->text, .unit = unit};
    result->forms[result->form_count++] = form;
    if (tn_name_fits(check->diagnostics, form->name, ast->name->node.span))
        check_form(check, form);
}

void tn_check_forms(tn_check *check)
{
    size_t count = 0;
    for (size_t u = 0; u < check->imports->count; u++)
        for (TN_EACH(const tn_ast_top, item, ((const tn_ast_file *)check->imports->units[u]->tree)->items))
            count += item->kind == TN_ITEM_FORM;
    check->result->forms = TN_NEW_ARRAY(check->arena, tn_checked_form *, count);
    if (!check->result->forms)
        return;
    for (size_t u = 0; u < check->imports->count && !tn_arena_failed(check->arena); u++)
        for (TN_EACH(const tn_ast_top, item, ((const tn_ast_file *)check->imports->units[u]->tree)->items))
            if (item->kind == TN_ITEM_FORM)
                add_form(check, (const tn_ast_form *)item, u);
}
