/* Reads the choices that a form has for a whole house, their values, and what is asked of them (`option(...)`). */
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "compiler/plan/check/form.h"
#include "runtime/base/int128.h"
#include "runtime/base/nearest.h"

static bool bad_shape(tn_check *check, tn_span span, const char *message, const char *help)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_SHAPE, span, "%s", message);
    tn_help(check->diagnostics, d, "%s", help);
    return false;
}

/* ---- roofs */

static const tn_ast_argument *argument(const tn_ast_shape *shape, size_t index)
{
    const tn_ast_node *node = shape->arguments.first;
    while (node && index-- > 0)
        node = node->next;
    return (const tn_ast_argument *)node;
}

static bool read_slope(tn_check *check, const tn_ast_argument *slope, tn_shape_record *record)
{
    if (!slope || !slope->run || slope->word->kind != TN_WORD_NUMBER)
        return false;
    if (slope->word->value < 1 || slope->word->value > TN_SLOPE_MAX || slope->run->value < 1 ||
        slope->run->value > TN_SLOPE_MAX) {
        bad_shape(check, slope->node.span, "this is no slope",
                  "a slope is how far the roof rises for how far, such as 4:12; each from 1 to 1000");
        return true;
    }
    record->rise = (uint32_t)slope->word->value;
    record->run = (uint32_t)slope->run->value;
    return true;
}

/* How far the eaves hang down below the foot of the roof, at most. */
static tn_int128 eaves_drop(const tn_shape_record *roof)
{
    bool slope = roof->roof >= TN_ROOF_SHED_BACK && roof->roof != TN_ROOF_VAULT && roof->run > 0;
    return slope ? (tn_int128)roof->eaves * roof->rise / roof->run : 0;
}

static void check_eaves(tn_check *check, const tn_checked_form *form, const tn_ast_shape *shape,
                        const tn_shape_record *record)
{
    for (uint32_t i = 0; i < form->storey_count && record->eaves > 0; i++) {
        int64_t clear = form->storeys[i].height - form->thickness[2];
        if (clear > 0 && eaves_drop(record) >= clear) { /* that a storey is too low is said of the storey */
            bad_shape(check, shape->node.span, "these eaves hang down to the floor",
                      "make the eaves narrower, or the slope gentler");
            return;
        }
    }
}

/* `eaves LENGTH`, `open`, `across`, in any order, each once. */
static bool read_extra(tn_check *check, const tn_ast_argument *argument, tn_shape_record *record)
{
    if (tn_word_is(argument->word, "eaves") && argument->run && record->eaves == 0) {
        int64_t wide = tn_form_length(check, argument->run);
        if (wide == 0)
            bad_shape(check, argument->node.span, "these eaves have no width", "leave out `eaves`");
        record->eaves = wide > 0 ? wide : 1;
        return true;
    }
    uint32_t flag = tn_word_is(argument->word, "open")     ? TN_ROOF_OPEN
                    : tn_word_is(argument->word, "across") ? TN_ROOF_ACROSS
                                                           : 0;
    if (!flag || argument->run || record->flags & flag)
        return false;
    record->flags |= flag;
    return true;
}

static bool read_kind(tn_check *check, const tn_ast_shape *shape, size_t *used, tn_shape_record *record)
{
    const tn_ast_argument *first = argument(shape, 0), *second = argument(shape, 1);
    *used = 1;
    if (tn_word_is(shape->word, "flat")) {
        *used = 0;
        record->roof = TN_ROOF_FLAT;
        return true;
    }
    static const struct {
        const char *word;
        tn_roof_kind kind;
    } slopes[] = {{"gable", TN_ROOF_GABLE}, {"hip", TN_ROOF_HIP}, {"cross-gable", TN_ROOF_CROSS_GABLE}};
    for (size_t i = 0; i < sizeof slopes / sizeof *slopes; i++)
        if (tn_word_is(shape->word, slopes[i].word)) {
            record->roof = slopes[i].kind;
            return read_slope(check, first, record);
        }
    bool sides = first && (tn_word_is(first->word, "back") || tn_word_is(first->word, "front"));
    if (tn_word_is(shape->word, "shed") && sides) {
        *used = 2;
        record->roof = tn_word_is(first->word, "back") ? TN_ROOF_SHED_BACK : TN_ROOF_SHED_FRONT;
        return read_slope(check, second, record);
    }
    if (tn_word_is(shape->word, "vault") && first && first->word->kind == TN_WORD_LENGTH) {
        record->roof = TN_ROOF_VAULT;
        int64_t height = tn_form_length(check, first->word);
        record->height = height > 0 ? height : 1;
        return height != 0;
    }
    return false;
}

static bool read_roof(tn_check *check, const tn_checked_form *form, const tn_ast_shape *shape, tn_shape_record *record)
{
    size_t used = 0;
    if (!read_kind(check, shape, &used, record))
        return false;
    for (size_t i = used; i < shape->arguments.count; i++)
        if (!read_extra(check, argument(shape, i), record))
            return false;
    if (record->flags & TN_ROOF_ACROSS && (record->roof == TN_ROOF_HIP || record->roof == TN_ROOF_CROSS_GABLE)) {
        bad_shape(check, shape->node.span, "this roof has no ridge that could go across the row",
                  record->roof == TN_ROOF_HIP ? "leave out `across`: a hip slopes to all sides"
                                              : "leave out `across`: each cell has a gable across already");
        return true;
    }
    if (record->flags & TN_ROOF_ACROSS && record->roof != TN_ROOF_GABLE && record->roof != TN_ROOF_VAULT)
        return false;
    if (record->flags & TN_ROOF_OPEN && record->roof == TN_ROOF_HIP) {
        bad_shape(check, shape->node.span, "a hip cannot be open to the rooms below",
                  "leave out `open`, or write `gable`: how low a room is under the end of a hip depends on all of the row");
        return true;
    }
    check_eaves(check, form, shape, record);
    return true;
}

/* ---- values */

/* "shed(back,4:12)": without blanks, as house lines write it. */
static const char *spell(tn_check *check, const tn_ast_shape *shape)
{
    const char *text = check->diagnostics->sources->files[shape->node.span.file].text;
    char *spelling =
        tn_arena_copy(check->arena, text + shape->node.span.begin, shape->node.span.end - shape->node.span.begin);
    size_t used = 0;
    for (size_t i = 0; spelling && spelling[i]; i++) {
        bool digit_before = used > 0 && spelling[used - 1] >= '0' && spelling[used - 1] <= '9';
        size_t next = i + strspn(spelling + i, " \t\r\n");
        bool letter_before = used > 0 && spelling[used - 1] >= 'a' && spelling[used - 1] <= 'z';
        bool fraction = next > i && (digit_before || letter_before) && spelling[next] >= '0' && spelling[next] <= '9';
        if (fraction)
            spelling[used++] = '-'; /* 6 1/2", eaves 2' */
        i = next;
        if (!spelling[i])
            break;
        spelling[used++] = spelling[i];
    }
    if (spelling)
        spelling[used] = '\0';
    return spelling ? spelling : "";
}

static bool read_storeys(tn_check *check, const tn_checked_form *form, const tn_ast_shape *shape,
                         tn_shape_record *record)
{
    int64_t count = shape->word->value;
    if (shape->word->kind != TN_WORD_NUMBER || shape->arguments.count > 0)
        return bad_shape(check, shape->node.span, "this is not a number of storeys",
                         "write `option ZONE storeys = 1 | 2`");
    if (count < 1 || (count > form->storey_count && !check->skipped)) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_SHAPE, shape->node.span,
                                     "a house of this form cannot have %lld storeys", (long long)count);
        if (form->storey_count == 1)
            tn_help(check->diagnostics, d, "it has one: declare another `storey`, or write 1");
        else
            tn_help(check->diagnostics, d, "it has %u: declare another `storey`, or write a number from 1 to %u",
                    form->storey_count, form->storey_count);
        return false;
    }
    record->storeys = (uint32_t)count;
    return true;
}

/* Does what stands in parentheses make a roof of it? */
static bool is_roof(const tn_ast_shape *shape)
{
    static const char *const roofs[] = {"gable", "shed", "vault", "flat", "hip", "cross-gable"};
    for (size_t i = 0; shape->arguments.count > 0 && i < sizeof roofs / sizeof *roofs; i++)
        if (tn_word_is(shape->word, roofs[i]))
            return true;
    return false;
}

/* Has it values that a choice of names cannot have? */
static bool has_arguments(const tn_ast_form_clause *ast)
{
    for (TN_EACH(const tn_ast_shape, shape, ast->list))
        if (shape->arguments.count > 0)
            return true;
    return false;
}

/* Has the form a line `section ZONE roof`, or `storeys`? */
static bool has_choice(const tn_checked_form *form, const char *zone, const char *detail)
{
    for (TN_EACH(const tn_ast_form_clause, clause, form->ast->clauses))
        if (clause->part == TN_PART_SECTION && clause->detail && tn_word_is(clause->detail, detail) &&
            strcmp(clause->name->text, zone) == 0)
            return true;
    return false;
}

static const char *zone_of(const tn_checked_form *form, const tn_ast_form_clause *ast)
{
    uint32_t zone = form->spine;
    return ast->detail ? ast->name->text : zone == TN_NONE ? "" : form->schema->fields[zone].name;
}

/* `roof` or `storeys`, where a choice of names is likely meant to be that; or NULL. */
static const char *meant_choice(const tn_checked_form *form, const tn_checked_choice *choice)
{
    static const char *const kinds[] = {"roof", "storeys", "storey"};
    const tn_ast_form_clause *ast = choice->ast;
    const char *meant = NULL;
    if (choice->kind != TN_CHOICE_PLAIN)
        return NULL;
    for (TN_EACH(const tn_ast_shape, shape, ast->list))
        if (is_roof(shape))
            meant = kinds[0];
    if (!meant && !has_arguments(ast))
        meant = tn_nearest(ast->detail ? ast->detail->text : ast->name->text, kinds, sizeof kinds / sizeof *kinds);
    if (meant == kinds[2])
        meant = kinds[1];
    return meant && !has_choice(form, zone_of(form, ast), meant) ? meant : NULL;
}

/* Was one of its words told to be wrong? */
static bool is_broken(const tn_ast_shape *ast)
{
    bool broken = ast->word && ast->word->broken;
    for (TN_EACH(const tn_ast_argument, argument, ast->arguments))
        broken |= argument->word->broken || (argument->run && argument->run->broken);
    return broken;
}

static void read_shape(tn_check *check, const tn_checked_form *form, const tn_checked_choice *choice,
                       const tn_ast_shape *ast, tn_checked_shape *shape)
{
    *shape = (tn_checked_shape){.ast = ast, .spelling = spell(check, ast)};
    if (strlen(shape->spelling) > TN_NAME_MAX)
        bad_shape(check, ast->node.span, "this value is too long", "values have at most 255 bytes");
    else if (choice->kind == TN_CHOICE_STOREYS)
        read_storeys(check, form, ast, &shape->record);
    else if (choice->kind == TN_CHOICE_ROOF && !read_roof(check, form, ast, &shape->record) && !is_broken(ast))
        bad_shape(check, ast->node.span, "this is no roof",
                  "write `flat`, `shed(back, 4:12)`, `shed(front, 4:12)`, `gable(12:12)` or `vault(4')`; these may end "
                  "with `eaves 1'` and `open`, gables and vaults with `across`");
    else if (choice->kind == TN_CHOICE_PLAIN && ast->arguments.count > 0 && !meant_choice(form, choice))
        bad_shape(check, ast->node.span, "this choice has names only", "leave out what is in the parentheses");
}

/* ---- choices of roofs and storeys by another name */

/* A choice of the author's that is one of roofs or storeys: an error where its values are no names, or else a warning,
 * as it may be meant. */
static void check_meant(tn_check *check, const tn_checked_form *form, const tn_checked_choice *choice)
{
    const tn_ast_form_clause *ast = choice->ast;
    const char *meant = meant_choice(form, choice), *zone = ast->detail ? "" : zone_of(form, ast);
    bool roofs = has_arguments(ast);
    if (!meant || (!roofs && !tn_check_wanted(check, W_NEARLY_ROOF)))
        return;
    tn_span span = (ast->detail ? ast->detail : ast->name)->node.span;
    tn_diagnostic *d = roofs ? tn_report(check->diagnostics, E_BAD_SHAPE, span,
                                         "the choice `%.80s` has names only, and these values are roofs", choice->name)
                             : tn_report(check->diagnostics, W_NEARLY_ROOF, span,
                                         "`%.80s` is a choice of names, and says nothing of %s", choice->name,
                                         strcmp(meant, "roof") == 0 ? "roofs" : "how many storeys there are");
    tn_help(check->diagnostics, d, "did you mean `%s%s%s`?%s", zone, *zone ? " " : "", meant,
            !roofs && strcmp(meant, "roof") == 0 ? " Its values have slopes, such as `gable(9:12)`" : "");
    tn_replace_with(check->diagnostics, d, "%s%s%s", zone, *zone ? " " : "", meant);
}

/* ---- choices */

static bool choice_is_new(tn_check *check, const tn_checked_form *form, const tn_checked_choice *choice)
{
    for (uint32_t i = 0; i < form->choice_count; i++) {
        if (strcmp(form->choices[i].name, choice->name) != 0)
            continue;
        tn_diagnostic *d = tn_report(check->diagnostics, E_PART_TWICE, choice->ast->node.span,
                                     "`option %s` is there twice", choice->name);
        tn_note(check->diagnostics, d, &form->choices[i].ast->node.span, "the first time is here");
        tn_help(check->diagnostics, d, "put all values into one line, joined by `|`");
        return false;
    }
    return true;
}

/* `section ZONE storeys`, `section ZONE roof`, `section NAME`, `section ZONE NAME`. */
static bool choice_head(tn_check *check, const tn_checked_form *form, tn_checked_choice *choice)
{
    const tn_ast_form_clause *ast = choice->ast;
    size_t size = strlen(ast->name->text) + (ast->detail ? strlen(ast->detail->text) : 0) + 2;
    char *name = tn_arena_alloc(check->arena, size);
    if (!name)
        return false;
    snprintf(name, size, "%s%s%s", ast->name->text, ast->detail ? " " : "", ast->detail ? ast->detail->text : "");
    choice->name = name;
    choice->zone = TN_NONE;
    if (!ast->detail)
        return true;
    choice->kind = tn_word_is(ast->detail, "storeys") ? TN_CHOICE_STOREYS
                   : tn_word_is(ast->detail, "roof")  ? TN_CHOICE_ROOF
                                                      : TN_CHOICE_PLAIN;
    choice->zone = tn_field_find(form->schema, ast->name->text);
    if (choice->zone != TN_NONE && form->schema->fields[choice->zone].kind == TN_FIELD_ZONE)
        return true;
    const char *names[TN_FIELDS_MAX];
    size_t count = 0;
    for (uint32_t f = 0; f < form->schema->field_count; f++)
        if (form->schema->fields[f].kind == TN_FIELD_ZONE)
            names[count++] = form->schema->fields[f].name;
    tn_form_unknown(check, form, ast->name, "zone", names, count);
    return false;
}

void tn_check_choice(tn_check *check, tn_checked_form *form, const tn_ast_form_clause *ast)
{
    tn_checked_choice choice = {.ast = ast};
    if (!choice_head(check, form, &choice) || !choice_is_new(check, form, &choice) ||
        !tn_check_room(check, form->choice_count, TN_CHOICES_MAX, "choice", ast->node.span,
                       "join some of them into one") ||
        !tn_check_room(check, ast->list.count, TN_VALUES_MAX + 1, "value", ast->node.span, "leave some of them out"))
        return;
    choice.shapes = TN_NEW_ARRAY(check->arena, tn_checked_shape, ast->list.count);
    if (!choice.shapes)
        return;
    for (TN_EACH(const tn_ast_shape, shape, ast->list)) {
        tn_checked_shape *next = &choice.shapes[choice.shape_count];
        read_shape(check, form, &choice, shape, next);
        for (uint32_t i = 0; i < choice.shape_count; i++)
            if (strcmp(choice.shapes[i].spelling, next->spelling) == 0) {
                tn_diagnostic *d = tn_report(check->diagnostics, E_PART_TWICE, shape->node.span, "`%s` is there twice",
                                             next->spelling);
                tn_help(check->diagnostics, d, "leave one of the two out");
            }
        choice.shape_count++;
    }
    check_meant(check, form, &choice);
    const tn_checked_choice *last = form->choice_count ? &form->choices[form->choice_count - 1] : NULL;
    choice.shape_first = last ? last->shape_first + last->shape_count : 0;
    form->choices[form->choice_count++] = choice;
}

/* ---- option(...) */

/* The choice that words name: `machine storeys 2`, `cladding board`; words before the value. */
static const tn_checked_choice *find_choice(const tn_checked_form *form, const tn_ast_word *first,
                                            const tn_ast_word *second)
{
    for (uint32_t i = 0; i < form->choice_count; i++) {
        const tn_ast_form_clause *ast = form->choices[i].ast;
        if (strcmp(ast->name->text, first->text) == 0 &&
            (second ? ast->detail && strcmp(ast->detail->text, second->text) == 0 : !ast->detail))
            return &form->choices[i];
    }
    return NULL;
}

static void unknown_choice(tn_check *check, const tn_checked_form *form, const tn_ast_word *word)
{
    const char *names[TN_CHOICES_MAX];
    for (uint32_t i = 0; i < form->choice_count; i++)
        names[i] = form->choices[i].name;
    tn_form_unknown(check, form, word, "choice", names, form->choice_count);
}

/* A value that the choice does not have: its values are listed as they are written, or by their names, each once. */
static void unknown_value(tn_check *check, const tn_checked_form *form, const tn_checked_choice *choice,
                          const tn_ast_shape *shape)
{
    const char *names[TN_VALUES_MAX];
    size_t count = 0;
    char list[300] = "";
    for (uint32_t i = 0; i < choice->shape_count; i++) {
        const char *name = choice->shapes[i].ast->word->text;
        bool known = false;
        for (size_t k = 0; k < count; k++)
            known |= strcmp(names[k], name) == 0;
        if (!known)
            names[count++] = name;
    }
    for (uint32_t i = 0; i < choice->shape_count; i++) {
        tn_span span = choice->shapes[i].ast->node.span;
        snprintf(list + strlen(list), sizeof list - strlen(list), "%s`%.*s`",
                 i == 0                         ? ""
                 : i + 1 == choice->shape_count ? " or "
                                                : ", ",
                 (int)(span.end - span.begin), check->diagnostics->sources->files[span.file].text + span.begin);
    }
    bool named = false;
    for (size_t k = 0; k < count; k++)
        named |= strcmp(names[k], shape->word->text) == 0;
    if (!named) {
        tn_form_unknown(check, form, shape->word, "value", names, count);
        return;
    }
    tn_diagnostic *d = tn_report(check->diagnostics, E_UNKNOWN_PART, shape->node.span,
                                 "there is no `%.80s` of `%.80s` that is so", shape->word->text, choice->name);
    tn_help(check->diagnostics, d, "write all of it, or its name alone: it can be %s", list);
}

/* The values that a shape means: those of its name, or, where it has parentheses, the one that is spelled so. */
static bool add_values(tn_check *check, const tn_checked_form *form, const tn_checked_choice *choice,
                       const tn_ast_shape *shape, tn_decision *decision)
{
    const char *spelling = spell(check, shape);
    bool found = false;
    for (uint32_t i = 0; i < choice->shape_count; i++) {
        const tn_checked_shape *value = &choice->shapes[i];
        bool meant = shape->arguments.count ? strcmp(value->spelling, spelling) == 0
                                            : strcmp(value->ast->word->text, shape->word->text) == 0;
        if (!meant)
            continue;
        tn_decision_add(
            check, decision,
            (tn_decision_step){.opcode = TN_OP_CHOSEN, .index = choice->shape_first + i, .span = shape->node.span});
        if (found)
            tn_decision_add(check, decision, (tn_decision_step){.opcode = TN_OP_ONE_OF, .span = shape->node.span});
        found = true;
    }
    if (!found)
        unknown_value(check, form, choice, shape);
    return found;
}

static bool help_choice(tn_check *check, const tn_checked_form *form, tn_diagnostic *d)
{
    if (form->choice_count > 0 && form->choices[0].shape_count > 0)
        tn_help(check->diagnostics, d, "write a choice and one of its values, such as `%.80s %.80s`",
                form->choices[0].name, form->choices[0].shapes[0].ast->word->text);
    return false;
}

/* A value without its choice: the first choice that has such a value may be the one that is meant. */
static void no_choice_named(tn_check *check, const tn_checked_form *form, const tn_ast_shape *shape)
{
    const char *value = shape->word->text;
    for (uint32_t i = 0; i < form->choice_count; i++)
        for (uint32_t k = 0; k < form->choices[i].shape_count; k++) {
            if (strcmp(form->choices[i].shapes[k].ast->word->text, value) != 0)
                continue;
            tn_diagnostic *d =
                tn_report(check->diagnostics, E_BAD_SHAPE, shape->node.span, "the choice is missing before this value");
            tn_help(check->diagnostics, d, "write `%.80s %.80s`", form->choices[i].name, value);
            return;
        }
    help_choice(check, form,
                tn_report(check->diagnostics, E_BAD_SHAPE, shape->node.span,
                          "no choice of the form has the value `%.80s`", value));
}

/* [not] [choice] value; the choice of the alternative before counts where none is named. */
static bool read_alternative(tn_check *check, const tn_checked_form *form, const tn_ast_alternative *alternative,
                             const tn_checked_choice **choice, tn_decision *decision)
{
    const tn_ast_node *node = alternative->words.first;
    bool negated = false;
    const tn_ast_word *words[2] = {NULL, NULL};
    size_t count = 0;
    for (; node && node != alternative->words.last; node = node->next) {
        const tn_ast_word *word = (const tn_ast_word *)node;
        if (word->kind == TN_WORD_NOT && count == 0)
            negated = !negated;
        else if (word->kind != TN_WORD_NAME || count == 2)
            return help_choice(
                check, form,
                tn_report(check->diagnostics, E_BAD_SHAPE, word->node.span, "the form has no such option"));
        else
            words[count++] = word;
    }
    if (!node)
        return false;
    if (count > 0)
        *choice = find_choice(form, words[0], words[1]);
    if (!*choice && count > 0)
        unknown_choice(check, form, words[0]);
    else if (!*choice)
        no_choice_named(check, form, (const tn_ast_shape *)node);
    if (!*choice || !add_values(check, form, *choice, (const tn_ast_shape *)node, decision))
        return false;
    if (negated)
        tn_decision_add(check, decision, (tn_decision_step){.opcode = TN_OP_NONE_OF, .span = alternative->node.span});
    return true;
}

static bool read_items(tn_check *check, const tn_checked_form *form, const tn_ast_expr *expr, tn_decision *decision)
{
    bool first_item = true;
    for (TN_EACH(const tn_ast_item, item, expr->items)) {
        const tn_checked_choice *choice = NULL;
        bool first = true;
        for (TN_EACH(const tn_ast_alternative, alternative, item->alternatives)) {
            if (!read_alternative(check, form, alternative, &choice, decision))
                return false;
            if (!first)
                tn_decision_add(check, decision,
                                (tn_decision_step){.opcode = TN_OP_ONE_OF, .span = alternative->node.span});
            first = false;
        }
        if (!first_item)
            tn_decision_add(check, decision, (tn_decision_step){.opcode = TN_OP_ALL_OF, .span = item->node.span});
        first_item = false;
    }
    return !first_item;
}

/* Recursion is as deep as expressions nest: at most TN_NESTING_MAX. */
bool tn_form_section(tn_check *check, const tn_checked_form *form, const tn_ast_expr *expr, tn_decision *decision)
{
    if (!expr || expr->kind == TN_EXPR_BROKEN)
        return false;
    decision->span = expr->node.span;
    if (expr->kind == TN_EXPR_SECTION)
        return read_items(check, form, expr, decision);
    bool first = true;
    for (TN_EACH(const tn_ast_expr, part, expr->parts)) {
        if (!tn_form_section(check, form, part, decision))
            return false;
        if (!first)
            tn_decision_add(check, decision,
                            (tn_decision_step){.opcode = expr->kind == TN_EXPR_AND ? TN_OP_ALL_OF : TN_OP_ONE_OF,
                                               .span = part->node.span});
        first = false;
    }
    if (expr->kind == TN_EXPR_NOT)
        tn_decision_add(check, decision, (tn_decision_step){.opcode = TN_OP_NONE_OF, .span = expr->node.span});
    decision->span = expr->node.span;
    return true;
}
