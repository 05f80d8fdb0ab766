/* Says what of a module belongs to growing, and verifies it: the records beyond what records.def says of each field,
 * and the turtle's code. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/bytes.h"
#include "runtime/base/utf8.h"
#include "runtime/growth/model/system.h"
#include "runtime/module/engine.h"
#include "runtime/module/lister.h"
#include "runtime/module/verify.h"

/* ==== checks the code of a rewrite system, whose instructions and operands have been checked one by one before: what
 * the turtle says of seed and successors, the order of each guard's tests, and that rules, groups and functions fit */

/* Reads a function's code. */
typedef struct cursor {
    const tn_module *module;
    tn_error *error;
    uint32_t function, offset;
    tn_instruction here; /* the instruction at the offset */
} cursor;

static cursor begin(const tn_module *module, uint32_t function, tn_error *error)
{
    uint32_t offset = module->FUNCTION_records[function].code_begin;
    return (cursor){module, error, function, offset, tn_code_read(module->code, offset)};
}

/* To the next instruction; not past the last, which LAND or PASS is. */
static void advance(cursor *at)
{
    at->offset += at->here.length;
    at->here = tn_code_read(at->module->code, at->offset);
}

__attribute__((format(printf, 2, 3))) static tn_status refuse(const cursor *at, const char *format, ...)
{
    char what[160];
    va_list args;
    va_start(args, format);
    vsnprintf(what, sizeof what, format, args);
    va_end(args);
    tn_fail(at->error, TN_INVALID, E_REFUSED_MODULE, "the module is refused: function %u, code offset %u: %s",
            at->function, at->offset, what);
    if (at->error)
        at->error->code_offset = at->offset;
    return TN_INVALID;
}

/* ---- the turtle */

static const char *fault_text(unsigned fault)
{
    return fault & TN_TURTLE_FULL        ? "the branch has drawn its edge already"
           : fault & TN_TURTLE_UNOPENED  ? "there is no branch to end"
           : fault & TN_TURTLE_EMPTY     ? "the branch draws no edge"
           : fault & TN_TURTLE_UNFLIPPED ? "no edge follows a FLIP"
           : fault & TN_TURTLE_UNCLOSED  ? "the path ends within a branch"
           : fault & TN_TURTLE_NO_PATH   ? "there is no edge outside the branches"
           : fault & TN_TURTLE_ASTRAY    ? "the turtle does not end in the direction in which it started"
           : fault & TN_TURTLE_CROWDED   ? "a successor has more edges, branches or brackets than the limit"
                                         : "this is not a move of the turtle";
}

static tn_status check_successor_code(const tn_module *module, uint32_t function, tn_turtle_level *levels,
                                      tn_error *error)
{
    cursor at = begin(module, function, error);
    tn_turtle turtle;
    tn_turtle_start(&turtle, levels);
    for (;; advance(&at)) {
        unsigned fault = tn_turtle_move(&turtle, &at.here);
        if (fault)
            return refuse(&at, "%s", fault_text(fault));
        if (at.here.opcode == TN_OP_LAND)
            return TN_OK;
    }
}

/* A seed is a regular polygon: edges, and which of them run the other way. */
static tn_status check_seed(const tn_module *module, uint32_t function, tn_error *error)
{
    cursor at = begin(module, function, error);
    uint32_t edges = 0;
    bool flipped = false;
    for (; at.here.opcode != TN_OP_LAND; advance(&at)) {
        if (at.here.opcode != TN_OP_DRAW && at.here.opcode != TN_OP_FLIP)
            return refuse(&at, "a seed only draws edges and flips them");
        if (at.here.opcode == TN_OP_DRAW && at.here.second != TN_AGE_ZERO)
            return refuse(&at, "an edge of a seed is new");
        flipped = at.here.opcode == TN_OP_FLIP && !flipped;
        edges += at.here.opcode == TN_OP_DRAW;
    }
    if (flipped)
        return refuse(&at, "%s", fault_text(TN_TURTLE_UNFLIPPED));
    if (edges < 3 || edges > TN_AXIOM_MAX)
        return refuse(&at, "the seed has %u edges; 3 to %u are possible", edges, TN_AXIOM_MAX);
    return TN_OK;
}

/* ---- guards */

static bool is_comparison(tn_opcode opcode)
{
    return opcode == TN_OP_YOUNGER || opcode == TN_OP_OLDER || opcode == TN_OP_AGED;
}

static double number_of(const cursor *at)
{
    return tn_double_of((uint64_t)at->here.first);
}

static tn_status check_predecessor(cursor *at)
{
    uint32_t labels = 0;
    for (; at->here.opcode == TN_OP_LABEL; advance(at))
        labels++;
    if (labels == 0 || labels > TN_CHAIN_MAX)
        return refuse(at, "a predecessor has %u edges; 1 to %u are possible", labels, TN_CHAIN_MAX);
    if (labels > 1 && (at->here.opcode == TN_OP_BEHIND || at->here.opcode == TN_OP_AHEAD))
        return refuse(at, "a chain of edges has a context");
    if (at->here.opcode == TN_OP_BEHIND)
        advance(at);
    if (at->here.opcode == TN_OP_AHEAD)
        advance(at);
    return TN_OK;
}

/* A test, and the successor where it holds. */
static tn_status check_choice(cursor *at)
{
    if (!(fabs(number_of(at)) <= TN_COORDINATE_MAX) || (at->here.opcode == TN_OP_WEIGHT && number_of(at) < 0))
        return refuse(at, "an age or a weight is out of range");
    advance(at);
    if (at->here.opcode != TN_OP_REPLACE)
        return refuse(at, "no successor follows the test of an age or a weight");
    advance(at);
    return TN_OK;
}

static tn_status check_choices(cursor *at)
{
    bool by_chance = at->here.opcode == TN_OP_CHANCE;
    uint32_t choices = 0;
    if (by_chance) {
        if (!(number_of(at) >= 0))
            return refuse(at, "the total of the weights is below 0");
        advance(at);
    }
    for (; by_chance ? at->here.opcode == TN_OP_WEIGHT : is_comparison(at->here.opcode); choices++) {
        tn_status status = check_choice(at);
        if (status != TN_OK)
            return status;
    }
    bool has_last = at->here.opcode == TN_OP_REPLACE;
    if (has_last)
        advance(at);
    if (by_chance ? !has_last || choices == 0 : choices + has_last == 0)
        return refuse(at, "the guard has too few successors");
    return at->here.opcode == TN_OP_PASS ? TN_OK : refuse(at, "this does not stand here in a guard");
}

static tn_status check_guard(const tn_module *module, uint32_t function, tn_error *error)
{
    cursor at = begin(module, function, error);
    tn_status status = check_predecessor(&at);
    return status == TN_OK ? check_choices(&at) : status;
}

/* Do two guards start with the same labels? */
static bool same_predecessor(const tn_module *module, uint32_t one, uint32_t other)
{
    cursor a = begin(module, one, NULL), b = begin(module, other, NULL);
    for (; a.here.opcode == TN_OP_LABEL && b.here.opcode == TN_OP_LABEL; advance(&a), advance(&b))
        if (a.here.first != b.here.first)
            return false;
    return a.here.opcode != TN_OP_LABEL && b.here.opcode != TN_OP_LABEL;
}

/* Each label is rewritten by one group: there is no second predecessor of that label alone. */
static tn_status check_groups(const tn_module *module, tn_error *error)
{
    tn_status status = TN_OK;
    uint8_t *seen = calloc(module->EDGE_LABEL_count, 1);
    if (!seen)
        return tn_fail_memory(error);
    for (size_t g = 0; g < module->REWRITE_GROUP_count && status == TN_OK; g++) {
        const tn_rewrite_group_record *group = &module->REWRITE_GROUP_records[g];
        cursor at = begin(module, module->REWRITE_RULE_records[group->rule_first].guard, error);
        uint32_t label = (uint32_t)at.here.first;
        advance(&at);
        if (at.here.opcode == TN_OP_LABEL)
            continue;
        if (seen[label])
            status = refuse(&at, "two groups rewrite label %u", label);
        seen[label] = 1;
    }
    free(seen);
    return status;
}

/* ---- all of it */

static bool is_function(const tn_module *module, uint32_t function, tn_function_kind kind)
{
    return function < module->FUNCTION_count && module->FUNCTION_records[function].kind == kind;
}

static tn_status check_references(const tn_module *module, tn_error *error)
{
    if (!is_function(module, module->GROWTH_records[0].seed, TN_FUNCTION_SEED))
        return tn_fail(error, TN_INVALID, E_REFUSED_MODULE, "the module is refused: its rewrite system has no seed");
    for (size_t i = 0; i < module->REWRITE_RULE_count; i++) {
        const tn_rewrite_rule_record *rule = &module->REWRITE_RULE_records[i];
        if (!is_function(module, rule->guard, TN_FUNCTION_GUARD) || (i > 0 && rule->guard <= rule[-1].guard))
            return tn_fail(error, TN_INVALID, E_REFUSED_MODULE,
                           "the module is refused: rewrite rule %zu has no guard behind that of the rule before", i);
    }
    for (size_t g = 0; g < module->REWRITE_GROUP_count; g++) {
        const tn_rewrite_group_record *group = &module->REWRITE_GROUP_records[g];
        const tn_rewrite_rule_record *rules = &module->REWRITE_RULE_records[group->rule_first];
        for (uint32_t r = 1; r < group->rule_count; r++)
            if (!same_predecessor(module, rules[0].guard, rules[r].guard))
                return tn_fail(error, TN_INVALID, E_REFUSED_MODULE,
                               "the module is refused: the rules of group %zu have different predecessors", g);
    }
    return TN_OK;
}

static tn_status check_functions(const tn_module *module, tn_turtle_level *levels, tn_error *error)
{
    tn_status status = TN_OK;
    size_t seeds = 0, successors = 0;
    for (uint32_t f = 0; f < module->FUNCTION_count && status == TN_OK; f++) {
        uint32_t kind = module->FUNCTION_records[f].kind;
        seeds += kind == TN_FUNCTION_SEED;
        successors += kind == TN_FUNCTION_SUCCESSOR;
        if (kind == TN_FUNCTION_SEED)
            status = check_seed(module, f, error);
        else if (kind == TN_FUNCTION_SUCCESSOR)
            status = check_successor_code(module, f, levels, error);
        else if (kind == TN_FUNCTION_GUARD)
            status = check_guard(module, f, error);
    }
    if (status == TN_OK && (seeds != 1 || successors > TN_TEMPLATES_MAX))
        return tn_fail(error, TN_INVALID, E_REFUSED_MODULE,
                       "the module is refused: it has %zu seeds and %zu successors; 1 seed and up to %u are possible",
                       seeds, successors, TN_TEMPLATES_MAX);
    return status;
}

/* The code, once its instructions have been verified: seeds are polygons; successors' brackets nest, each with one
 * edge, and their turtle ends in the direction in which it started; guards are labels, context and successors, in this
 * order; rules, groups and functions fit. */
static tn_status growth_verify_whole(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    tn_error *error = checker->error;
    size_t parts = 0, most = 0;
    for (size_t f = 0; f < module->FUNCTION_count; f++) {
        const tn_function_record *function = &module->FUNCTION_records[f];
        parts += function->kind == TN_FUNCTION_SEED || function->kind == TN_FUNCTION_SUCCESSOR ||
                 function->kind == TN_FUNCTION_GUARD;
        if (function->kind == TN_FUNCTION_SUCCESSOR && function->stack_max > most)
            most = function->stack_max;
    }
    if (module->GROWTH_count == 0)
        return parts == 0 ? TN_OK
                          : tn_fail(error, TN_INVALID, E_REFUSED_MODULE,
                                    "the module is refused: it has code of a rewrite system that it does not have");
    tn_turtle_level *levels = malloc((most + 1) * sizeof *levels);
    if (!levels)
        return tn_fail_memory(error);
    tn_status status = check_functions(module, levels, error);
    free(levels);
    if (status == TN_OK)
        status = check_references(module, error);
    return status == TN_OK ? check_groups(module, error) : status;
}

/* ==== verifies what growing relies on in a module's growth sections, beyond what records.def says of each field */

/* ---- the rewrite system */

static tn_status check_system(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    if (module->EDGE_LABEL_count == 0 || module->EDGE_LABEL_count > TN_LABELS_MAX)
        return tn_refuse(checker, "it has %zu labels; 1 to %u are possible", module->EDGE_LABEL_count, TN_LABELS_MAX);
    for (size_t i = 1; i < module->EDGE_LABEL_count; i++)
        if (module->EDGE_LABEL_records[i].number <= module->EDGE_LABEL_records[i - 1].number)
            return tn_refuse(checker, "the numbers of its labels do not ascend");
    return TN_OK;
}

/* ---- the study */

static tn_status check_boundary(const tn_checker *checker, size_t index)
{
    const tn_boundary_record *b = &checker->module->BOUNDARY_records[index];
    bool sound = true;
    if (b->kind == TN_BOUNDARY_PLANE)
        sound = fabs(b->b_x * b->b_x + b->b_y * b->b_y + b->b_z * b->b_z - 1) < 1e-9;
    else if (b->kind == TN_BOUNDARY_BOX)
        sound = b->a_x < b->b_x && b->a_y < b->b_y && b->a_z < b->b_z;
    else if (b->kind == TN_BOUNDARY_SPHERE)
        sound = b->radius > 0;
    else
        sound = b->mesh != 0;
    return sound ? TN_OK : tn_refuse(checker, "boundary %zu has no proper shape", index);
}

static tn_status check_surroundings(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    if (module->FORCE_count > TN_SURROUNDINGS_MAX || module->BOUNDARY_count > TN_SURROUNDINGS_MAX)
        return tn_refuse(checker, "it has more forces or boundaries than %u", TN_SURROUNDINGS_MAX);
    for (size_t i = 0; i < module->BOUNDARY_count; i++) {
        tn_status status = check_boundary(checker, i);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

static tn_status check_measuring(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    bool seen[TN_MEASURING_KIND_COUNT] = {false};
    for (size_t i = 0; i < module->MEASURING_count; i++) {
        const tn_measuring_record *m = &module->MEASURING_records[i];
        bool sound = m->kind == TN_MEASURING_SUN ? m->x * m->x + m->y * m->y + m->z * m->z > 1e-24 : m->mesh != 0;
        if (!sound || seen[m->kind])
            return tn_refuse(checker, "what surfaces are measured with is given twice, or is nothing");
        seen[m->kind] = true;
    }
    return TN_OK;
}

static bool is_expression(const tn_module *module, const tn_goal_record *goal)
{
    return goal->name != 0 && goal->function < module->FUNCTION_count &&
           module->FUNCTION_records[goal->function].kind == TN_FUNCTION_MEASURE;
}

static tn_status check_goals(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    unsigned seen = 0;
    size_t expressions = 0;
    for (size_t i = 0; i < module->GOAL_count; i++) {
        const tn_goal_record *goal = &module->GOAL_records[i];
        if (goal->term == TN_FITNESS_TERM_COUNT) {
            if (!is_expression(module, goal) || ++expressions > TN_EXPRESSIONS_MAX)
                return tn_refuse(checker, "fitness goal %zu is not an expression, or one too many", i);
            continue;
        }
        if (seen >> goal->term & 1)
            return tn_refuse(checker, "fitness goal %zu is given twice", i);
        seen |= 1u << goal->term;
    }
    return TN_OK;
}

static tn_status check_requirements(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    if (module->GROWTH_REQUIREMENT_count > TN_EXPRESSIONS_MAX)
        return tn_refuse(checker, "it has more requirements than %u", TN_EXPRESSIONS_MAX);
    for (size_t i = 0; i < module->GROWTH_REQUIREMENT_count; i++)
        if (module->FUNCTION_records[module->GROWTH_REQUIREMENT_records[i].violation].kind != TN_FUNCTION_MEASURE)
            return tn_refuse(checker, "requirement %zu is not an expression", i);
    return TN_OK;
}

/* ---- all of them */

/* One rewrite system at most, and all parts are its own; as many of each as its limits allow; labels ascend;
 * boundaries have a shape; goals are there once, and expressions are functions. */
static tn_status growth_verify(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    size_t parts = module->EDGE_LABEL_count + module->REWRITE_GROUP_count + module->REWRITE_RULE_count +
                   module->STUDY_count + module->FORCE_count + module->BOUNDARY_count + module->GOAL_count +
                   module->GROWTH_REQUIREMENT_count + module->MEASURING_count;
    if (module->GROWTH_count > 1 || module->STUDY_count > 1)
        return tn_refuse(checker, "it has more than one rewrite system or study");
    if (module->GROWTH_count == 0)
        return parts == 0 ? TN_OK : tn_refuse(checker, "it has parts of a rewrite system that it does not have");
    tn_status status = check_system(checker);
    if (status == TN_OK)
        status = check_surroundings(checker);
    if (status == TN_OK)
        status = check_measuring(checker);
    if (status == TN_OK)
        status = check_goals(checker);
    return status == TN_OK ? check_requirements(checker) : status;
}

/* ==== says what of a module belongs to growing, and what expressions over a surface speak of */

/* ---- lists a rewrite system and its study */

enum { NAME_SHOWN = 60 };

static void write_text(FILE *out, const tn_module *module, tn_string string)
{
    const char *text = tn_text(module, string);
    tn_write_clean(out, text, strnlen(text, NAME_SHOWN));
}

static void write_label(FILE *out, const tn_module *module, uint32_t label)
{
    write_text(out, module, module->EDGE_LABEL_records[label].name);
}

/* The guards of one predecessor, in the order in which they are asked. */
static void list_group(FILE *out, const tn_module *module, const tn_rewrite_group_record *group)
{
    fputs("  rewrite by", out);
    for (uint32_t r = 0; r < group->rule_count; r++)
        fprintf(out, "%s function %u", r > 0 ? ", then" : "",
                module->REWRITE_RULE_records[group->rule_first + r].guard);
    fputc('\n', out);
}

/* Records that are listed field by field. */
static void list_records(tn_lister *lister, tn_section section)
{
    for (uint32_t i = 0; i < lister->module->tables[section].count && !ferror(lister->out); i++)
        tn_list_record(lister, section, i);
}

static void list_measuring(FILE *out, const tn_module *module)
{
    for (size_t i = 0; i < module->MEASURING_count; i++) {
        const tn_measuring_record *m = &module->MEASURING_records[i];
        if (m->kind == TN_MEASURING_SUN) {
            fprintf(out, "  sun (%.15g, %.15g, %.15g)\n", m->x, m->y, m->z);
            continue;
        }
        fputs("  distance to ", out);
        write_text(out, module, m->mesh);
        fputc('\n', out);
    }
}

static void list_goals(FILE *out, const tn_module *module)
{
    for (size_t i = 0; i < module->GOAL_count; i++) {
        const tn_goal_record *g = &module->GOAL_records[i];
        fputs("  fitness ", out);
        if (g->term < TN_FITNESS_TERM_COUNT) {
            fputs(tn_names_MEASURED[g->term], out);
        } else {
            write_text(out, module, g->name);
            fprintf(out, " = function %u", g->function);
        }
        fprintf(out, " target %.15g weight %.15g\n", g->target, g->weight);
    }
}

static void list_study(FILE *out, const tn_module *module)
{
    const tn_study_record *s = &module->STUDY_records[0];
    fputs("\nstudy ", out);
    write_text(out, module, s->name);
    fprintf(out, "\n  steps %u, scale (%.15g, %.15g, %.15g), start (%.15g, %.15g, %.15g), start length %.15g\n",
            s->steps, s->scale_x, s->scale_y, s->scale_z, s->start_x, s->start_y, s->start_z, s->start_length);
    fprintf(out, "  branch angle %.15g, branch length %.15g, seed %llu, edge limit %lld, flags %u\n", s->branch_angle,
            s->branch_length, (unsigned long long)s->seed, (long long)s->edge_limit, s->flags);
}

/* The rewrite system: labels, the functions that are its seed and the guards of each predecessor, and the study with
 * its surroundings and goals. */
static void growth_list(tn_lister *lister)
{
    const tn_module *module = lister->module;
    FILE *out = lister->out;
    if (module->GROWTH_count == 0)
        return;
    const tn_growth_record *growth = &module->GROWTH_records[0];
    fputs("\nrewrite system ", out);
    write_text(out, module, growth->name);
    fprintf(out, ": branch angle %.15g%s", growth->branch_angle, growth->flags & TN_GROWTH_SYNC ? ", sync" : "");
    fputs(growth->flags & TN_GROWTH_EVEN ? ", even" : "", out);
    fputs("\n  labels", out);
    for (uint32_t i = 0; i < module->EDGE_LABEL_count; i++) {
        fputc(' ', out);
        write_label(out, module, i);
        fprintf(out, "=%u", module->EDGE_LABEL_records[i].number);
    }
    fprintf(out, "\n  seed function %u\n", growth->seed);
    for (size_t g = 0; g < module->REWRITE_GROUP_count && !ferror(out); g++)
        list_group(out, module, &module->REWRITE_GROUP_records[g]);
    if (module->STUDY_count)
        list_study(out, module);
    list_records(lister, TN_SECTION_FORCE);
    list_records(lister, TN_SECTION_BOUNDARY);
    list_measuring(out, module);
    list_goals(out, module);
}

static tn_status check_stroke(const tn_checker *checker, const tn_instruction *instruction)
{
    return instruction->second < TN_AGE_CHANGE_COUNT
               ? TN_OK
               : tn_refuse(checker, "%u says nothing of an age", (unsigned)instruction->second);
}

static tn_status check_angle(const tn_checker *checker, const tn_instruction *instruction)
{
    double degrees = tn_double_of((uint64_t)instruction->first);
    return fabs(degrees) <= 360 ? TN_OK : tn_refuse(checker, "an angle beyond 360 degrees");
}

static tn_status check_successor_operand(const tn_checker *checker, const tn_instruction *instruction)
{
    uint32_t successor = (uint32_t)instruction->first;
    if (successor >= checker->record || checker->module->FUNCTION_records[successor].kind != TN_FUNCTION_SUCCESSOR)
        return tn_refuse(checker, "function %u is not a successor below this function", successor);
    return TN_OK;
}

static void list_label(tn_lister *lister, const tn_instruction *instruction)
{
    tn_list_name(lister, lister->module->EDGE_LABEL_records[instruction->first].name);
}

static void list_stroke(tn_lister *lister, const tn_instruction *instruction)
{
    list_label(lister, instruction);
    fputs(tn_names_AGE_CHANGE[instruction->second], lister->out);
}

static const tn_section sections[] = {
    TN_SECTION_GROWTH,       TN_SECTION_EDGE_LABEL, TN_SECTION_REWRITE_GROUP,
    TN_SECTION_REWRITE_RULE, TN_SECTION_STUDY,      TN_SECTION_FORCE,
    TN_SECTION_BOUNDARY,     TN_SECTION_GOAL,       TN_SECTION_GROWTH_REQUIREMENT,
    TN_SECTION_MEASURING,    TN_SECTION_STRINGS,
};

static const tn_operand_rules operands[] = {{TN_OPERANDS_LABEL, NULL, list_label},
                                            {TN_OPERANDS_STROKE, check_stroke, list_stroke},
                                            {TN_OPERANDS_ANGLE, check_angle, NULL},
                                            {TN_OPERANDS_SUCCESSOR, check_successor_operand, NULL}};

extern const tn_engine tn_engine_growth;
const tn_engine tn_engine_growth = {.name = "growth",
                                    .sections = sections,
                                    .codes = 1u << TN_CODE_TURTLE | 1u << TN_CODE_GUARD,
                                    .operands = operands,
                                    .operand_count = sizeof operands / sizeof *operands,
                                    .terms = tn_names_MEASURED,
                                    .term_count = TN_MEASURED_COUNT,
                                    .term_kind = TN_FUNCTION_MEASURE,
                                    .verify = growth_verify,
                                    .verify_after = growth_verify_whole,
                                    .list_code = growth_list};
