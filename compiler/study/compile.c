/* The front end of .study files about growth: makes the syntax tree, as the parser asks; writes a checked study into a
 * module; lists what files have, and compiles them with the rewrite system that they name. */
#include <math.h>
#include <string.h>
#include <strings.h>

#include "compiler/common/import.h"
#include "compiler/common/notation.h"
#include "compiler/study/study.h"

/* ---- makes the syntax tree of .study files: what the parser calls */

tn_study_item *tn_study_item_new(tn_parsing *parse, tn_study_kind kind, tn_span span)
{
    tn_study_item *item = TN_NEW(parse->arena, tn_study_item);
    if (item) {
        item->kind = kind;
        item->span = span;
    }
    return item;
}

tn_study_part *tn_study_part_new(tn_parsing *parse, tn_study_part_kind kind, tn_span span, double value,
                                 tn_study_part *before)
{
    tn_study_part *part = TN_NEW(parse->arena, tn_study_part);
    if (part) {
        part->kind = kind;
        part->span = span;
        part->value = value;
        part->next = before;
    }
    return part;
}

void tn_study_add(tn_parsing *parse, tn_study_item *item)
{
    tn_study_file *file = parse->result;
    TN_CHAIN(file, item);
}

bool tn_study_heads(const char *text, size_t size)
{
    return tn_vocabulary_find(&tn_study_words, text, size, TN_STUDY_AT(STATEMENT), TN_AS_KEYWORDS | TN_AS_NAMED) !=
           NULL;
}

/* ---- from a checked study to the records of a module */

static double number_or(const tn_checked_study *study, tn_study_kind kind, double otherwise)
{
    return study->settings[kind] ? study->settings[kind]->number.value : otherwise;
}

static double part_or(const tn_study_item *item, tn_study_part_kind kind, double otherwise)
{
    for (const tn_study_part *part = item->parts; part; part = part->next)
        if (part->kind == kind)
            return part->value;
    return otherwise;
}

static void emit_settings(tn_builder *builder, const tn_checked_study *study)
{
    static const struct {
        tn_study_kind kind;
        uint32_t flag;
    } flags[] = {{TN_STUDY_SETS_FIXED_CENTRE, TN_STUDY_FIXED_CENTRE},
                 {TN_STUDY_SETS_FIXED_PERIMETER, TN_STUDY_FIXED_PERIMETER},
                 {TN_STUDY_SETS_FACING, TN_STUDY_FACING},
                 {TN_STUDY_SETS_MIRROR, TN_STUDY_MIRROR},
                 {TN_STUDY_SETS_RAW, TN_STUDY_RAW_FITNESS}};
    const tn_study_item *scale = study->settings[TN_STUDY_SCALE], *start = study->settings[TN_STUDY_START],
                        *title = study->settings[TN_STUDY_TITLE], *seed = study->settings[TN_STUDY_SEED];
    tn_study_record record = {.name = tn_builder_string(builder, title ? title->text : NULL),
                              .steps = (uint32_t)number_or(study, TN_STUDY_STEPS, 4),
                              .scale_x = scale ? scale->a.x : 1.5,
                              .scale_y = scale ? scale->a.y : 1.5,
                              .scale_z = scale ? scale->a.z : 1.5,
                              .start_x = start ? start->a.x : 0,
                              .start_y = start ? start->a.y : 0,
                              .start_z = start ? start->a.z : 0,
                              .start_length = number_or(study, TN_STUDY_START_LENGTH, 1),
                              .branch_angle = number_or(study, TN_STUDY_BRANCH_ANGLE, -1),
                              .branch_length = number_or(study, TN_STUDY_BRANCH_LENGTH, -1),
                              .seed = seed ? (int64_t)seed->number.whole : 1,
                              .edge_limit = (int64_t)number_or(study, TN_STUDY_EDGE_LIMIT, 0),
                              .file = study->span.file,
                              .begin = study->span.begin,
                              .end = study->span.end};
    for (size_t i = 0; i < sizeof flags / sizeof *flags; i++)
        if (study->settings[flags[i].kind])
            record.flags |= flags[i].flag;
    if (study->requirement_count > 0)
        record.flags |= TN_STUDY_SHARES;
    tn_builder_add_STUDY(builder, &record);
}

static void emit_force(tn_builder *builder, const tn_study_item *item)
{
    tn_builder_add_FORCE(builder,
                         &(tn_force_record){item->which, item->a.x, item->a.y, item->a.z,
                                            part_or(item, TN_PART_STRENGTH, 1), part_or(item, TN_PART_EXPONENT, 2),
                                            item->span.file, item->span.begin, item->span.end});
}

static void emit_boundary(tn_builder *builder, tn_arena *arena, const tn_sources *sources, const tn_study_item *item,
                          uint32_t root)
{
    tn_boundary_record record = {.kind = item->which,
                                 .mode = (uint32_t)part_or(item, TN_PART_MODE, TN_SLIDE),
                                 .inside = part_or(item, TN_PART_SIDE, 0) > 0,
                                 .a_x = item->a.x,
                                 .a_y = item->a.y,
                                 .a_z = item->a.z,
                                 .file = item->span.file,
                                 .begin = item->span.begin,
                                 .end = item->span.end};
    if (item->which == TN_BOUNDARY_SPHERE) {
        record.radius = item->b.x;
    } else if (item->which == TN_BOUNDARY_MESH) {
        record.mesh = tn_builder_string(builder, tn_emit_path(arena, sources, item->span.file, item->text, root));
    } else {
        double scale = 1;
        if (item->which == TN_BOUNDARY_PLANE)
            scale = 1 / sqrt(item->b.x * item->b.x + item->b.y * item->b.y + item->b.z * item->b.z);
        record.b_x = item->b.x * scale;
        record.b_y = item->b.y * scale;
        record.b_z = item->b.z * scale;
    }
    tn_builder_add_BOUNDARY(builder, &record);
}

static void emit_measuring(tn_builder *builder, tn_arena *arena, const tn_sources *sources,
                           const tn_checked_study *study)
{
    const tn_study_item *sun = study->settings[TN_STUDY_SUN], *target = study->settings[TN_STUDY_DISTANCE_TO];
    if (sun)
        tn_builder_add_MEASURING(builder, &(tn_measuring_record){TN_MEASURING_SUN, sun->a.x, sun->a.y, sun->a.z, 0,
                                                                 sun->span.file, sun->span.begin, sun->span.end});
    if (target) {
        const char *path = tn_emit_path(arena, sources, target->span.file, target->text, study->span.file);
        tn_builder_add_MEASURING(builder,
                                 &(tn_measuring_record){TN_MEASURING_MESH, 0, 0, 0, tn_builder_string(builder, path),
                                                        target->span.file, target->span.begin, target->span.end});
    }
}

static tn_status emit_goal(tn_builder *builder, tn_formula *formula, const tn_study_item *goal, tn_error *error)
{
    uint32_t term = tn_study_term(goal->text);
    bool plain = !goal->expression && term < TN_FITNESS_TERM_COUNT;
    tn_goal_record record = {.term = plain ? term : TN_FITNESS_TERM_COUNT,
                             .target = part_or(goal, TN_PART_TARGET, 0),
                             .weight = part_or(goal, TN_PART_WEIGHT, 1),
                             .file = goal->span.file,
                             .begin = goal->span.begin,
                             .end = goal->span.end};
    if (!plain) {
        tn_expression measured = {.op = TN_OP_TERM, .term = term};
        tn_status status = tn_expression_code(goal->expression ? goal->expression : &measured, formula, error);
        if (status != TN_OK)
            return status;
        record.name = tn_builder_string(builder, goal->text);
        record.function = tn_formula_emit(builder, TN_FUNCTION_MEASURE, goal->text, formula);
    }
    tn_builder_add_GOAL(builder, &record);
    return TN_OK;
}

static tn_status emit_requirement(tn_builder *builder, tn_formula *formula, const tn_study_item *requirement,
                                  tn_error *error)
{
    tn_status status = tn_expression_violation(requirement->expression, true, formula, error);
    if (status != TN_OK)
        return status;
    uint32_t violation = tn_formula_emit(builder, TN_FUNCTION_MEASURE, NULL, formula);
    tn_builder_add_GROWTH_REQUIREMENT(builder,
                                      &(tn_growth_requirement_record){violation, requirement->span.file,
                                                                      requirement->span.begin, requirement->span.end});
    return TN_OK;
}

/* TN_OK or TN_MEMORY. */
static tn_status emit_study(tn_builder *builder, tn_arena *arena, const tn_sources *sources,
                            const tn_checked_study *study, tn_error *error)
{
    tn_formula formula = {0};
    tn_status status = TN_OK;
    emit_settings(builder, study);
    for (uint32_t i = 0; i < study->force_count; i++)
        emit_force(builder, study->forces[i]);
    for (uint32_t i = 0; i < study->boundary_count; i++)
        emit_boundary(builder, arena, sources, study->boundaries[i], study->span.file);
    emit_measuring(builder, arena, sources, study);
    for (uint32_t i = 0; i < study->goal_count && status == TN_OK; i++)
        status = emit_goal(builder, &formula, study->goals[i], error);
    for (uint32_t i = 0; i < study->requirement_count && status == TN_OK; i++)
        status = emit_requirement(builder, &formula, study->requirements[i], error);
    tn_formula_clear(&formula);
    return status;
}

/* ---- lists what a .study file has: statements by their word, a boundary and a fitness term by two; of an evolution
 * block its settings */

static size_t block_end(const tn_listing *listing, size_t i)
{
    while (i < listing->count && !tn_listing_is(listing, i, "}"))
        i++;
    return i < listing->count ? i + 1 : i;
}

static void add_block(tn_listing *listing, size_t first, size_t last)
{
    size_t close = tn_listing_is(listing, last - 1, "}") ? last - 1 : last;
    tn_listing_entry *block = tn_listing_add(listing, TN_LISTING_BLOCK, first, first + 1, first + 1);
    block->whole = tn_listing_span(listing, first, last);
    for (size_t i = first + 2, end; i < close; i = end + 1) {
        end = tn_listing_line_end(listing, i, close);
        if (end > i)
            tn_listing_add(listing, TN_LISTING_SETTING, i, i + 1, end)->inside = true;
    }
}

static bool starts_block(const tn_listing *listing, size_t i)
{
    return tn_listing_is(listing, i, "evolution") && tn_listing_is(listing, i + 1, "{");
}

static bool starts_statement(const tn_listing *listing, size_t i)
{
    tn_token token = listing->tokens[i];
    return starts_block(listing, i) ||
           (token.kind == TN_TOKEN_WORD &&
            tn_study_heads(listing->text + token.span.begin, token.span.end - token.span.begin));
}

void tn_study_list(tn_listing *listing)
{
    for (size_t i = 0, end; i < listing->count; i = end) {
        end = starts_block(listing, i) ? block_end(listing, i) : i + 1;
        if (starts_block(listing, i)) {
            add_block(listing, i, end);
            continue;
        }
        if (!starts_statement(listing, i))
            continue;
        while (end < listing->count && !starts_statement(listing, end) && listing->tokens[end].kind != TN_TOKEN_LINE)
            end++;
        bool by_two = tn_listing_is(listing, i, "boundary") || tn_listing_is(listing, i, "fitness");
        tn_listing_add(listing, TN_LISTING_SETTING, i, i + 1 + (by_two && end > i + 1), end);
    }
}

/* ---- compiles .study files about growth: a study, what it uses, and the rewrite system that it names; and the front
 * end that the table of notations names */

static const char study_files[] = ".study", rule_files[] = ".hemls";

static bool ends_in(const char *path, const char *extension)
{
    return strcmp(tn_path_extension(path), extension) == 0;
}

static bool is_rules(const tn_unit *unit)
{
    return strcmp(unit->extension, rule_files) == 0;
}

/* What importing needs to know of a file of either kind. */
static bool parse_unit(tn_arena *arena, tn_diagnostics *diagnostics, tn_unit *unit, tn_use **uses, size_t *use_count)
{
    *use_count = 0;
    if (is_rules(unit)) {
        unit->tree = tn_parse_hemls(arena, diagnostics, unit->file, NULL);
        return unit->tree != NULL;
    }
    tn_study_file *study = tn_parse_study(arena, diagnostics, unit->file, NULL);
    if (!study)
        return false;
    unit->tree = study;
    size_t count = 0;
    for (const tn_study_item *item = study->first; item; item = item->next)
        count += item->kind == TN_STUDY_USE || item->kind == TN_STUDY_RULES;
    tn_use *found = TN_NEW_ARRAY(arena, tn_use, count + 1);
    if (!found)
        return false;
    for (tn_study_item *item = study->first; item; item = item->next) {
        bool rules = item->kind == TN_STUDY_RULES;
        if ((!rules && item->kind != TN_STUDY_USE) || !item->text)
            continue;
        if (item->text[0] == '\0') {
            tn_diagnostic *d = tn_report(diagnostics, E_IMPORT_NOT_FOUND, item->text_span, "the file has no name");
            tn_help(diagnostics, d, "write its path, or the name of one of the standard library's");
            continue;
        }
        item->use = &found[(*use_count)++];
        *item->use = (tn_use){item->text, item->text_span, rules ? rule_files : NULL, NULL};
    }
    *uses = found;
    return true;
}

/* `rules` names a .hemls file and `use` a .study file. */
static void check_kinds(tn_diagnostics *diagnostics, const tn_imports *imports)
{
    for (size_t u = 0; u < imports->count; u++) {
        const tn_study_file *study = imports->units[u]->tree;
        for (const tn_study_item *item = is_rules(imports->units[u]) ? NULL : study->first; item; item = item->next) {
            if (item->kind == TN_STUDY_RULES && item->text && ends_in(item->text, study_files)) {
                tn_diagnostic *d = tn_report(diagnostics, E_NOT_RULES, item->text_span, "`rules` names a .hemls file");
                tn_help(diagnostics, d, "for a study write `use`");
            } else if (item->kind == TN_STUDY_USE && item->text && ends_in(item->text, rule_files)) {
                tn_diagnostic *d = tn_report(diagnostics, E_NOT_RULES, item->text_span, "`use` names a .study file");
                tn_help(diagnostics, d, "for a rewrite system write `rules`");
            }
        }
    }
}

/* The rewrite system that grows: what the study's `rules` leads to. */
static const tn_unit *find_rules(const tn_checked_study *study)
{
    const tn_study_item *rules = study->settings[TN_STUDY_RULES];
    const tn_unit *found = rules && rules->use ? rules->use->unit : NULL;
    return found && is_rules(found) ? found : NULL;
}

static tn_status emit(tn_compilation *c, const tn_imports *imports, const tn_checked_growth *growth,
                      const tn_checked_study *study, tn_error *error)
{
    tn_builder *builder = tn_compilation_begin(c, imports, error);
    if (!builder)
        return TN_MEMORY;
    tn_emit_growth(builder, growth);
    return tn_compilation_finish(c, builder, emit_study(builder, c->arena, &c->sources, study, error), error);
}

static tn_status compile(tn_compilation *c, const tn_compile_options *options, tn_error *error)
{
    tn_imports imports;
    tn_checked_study study = {0};
    tn_checked_growth *growth = NULL;
    tn_diagnostics *diagnostics = &c->diagnostics;
    tn_status status = tn_import_all(c, options, study_files, parse_unit, &imports);
    if (status == TN_OK) {
        check_kinds(diagnostics, &imports);
        tn_check_study(c->arena, diagnostics, &imports, &study);
        const tn_unit *rules = find_rules(&study);
        if (rules)
            growth = tn_check_hemls(c->arena, diagnostics, rules->tree, rules->file);
    }
    if (status != TN_OK || tn_arena_failed(c->arena) || diagnostics->failed)
        return tn_fail_memory(error);
    if (diagnostics->error_count > 0 || (options->warnings_are_errors && diagnostics->warning_count > 0) || !growth)
        return TN_INVALID;
    return emit(c, &imports, growth, &study, error);
}

static bool read(tn_arena *arena, tn_diagnostics *diagnostics, tn_reading *reading)
{
    reading->tree = tn_parse_study(arena, diagnostics, reading->file, &reading->tokens);
    return reading->tree != NULL;
}

static bool made(const tn_module *module)
{
    return module->GROWTH_count > 0;
}

static const tn_vocabulary_word words[] = {
#define WORD(TEXT, TOKEN, PLACES, USE, SENTENCE) {TEXT, SENTENCE, PLACES, USE, 0},
#include "compiler/study/words.def"
};

static const tn_vocabulary_place places[] = {
#define PLACE(ID, BLOCK, HEADS, WHERE) {BLOCK, HEADS},
#include "compiler/study/words.def"
};

const tn_vocabulary tn_study_words = {words, sizeof words / sizeof *words, places, sizeof places / sizeof *places,
                                      .heads_begin = true};

extern const tn_front tn_front_study;
const tn_front tn_front_study = {
    .read = read,
    .compile = compile,
    .made = made,
    .list = tn_study_list,
    .words = &tn_study_words,
    .lay_out = tn_format_study,
    .spell = tn_format_small_letters,
};
