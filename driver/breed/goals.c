/* Reads, computes and changes the goals that a study writes itself, and says which requirements are not met. */
#include "driver/breed/goals.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "driver/breed/inputs.h"
#include "runtime/base/nearest.h"
#include "runtime/number/formula.h"
#include "runtime/number/run.h"

void tn_goals_clear(tn_goals *goals)
{
    for (size_t i = 0; i < goals->count; i++)
        tn_formula_clear(&goals->items[i].formula);
    free(goals->items);
    *goals = (tn_goals){0};
}

static tn_status refuse(const char *text, const char *const *names, size_t name_count, const tn_error *why,
                        tn_error *error)
{
    bool word = text[strcspn(text, " +-*/(),")] == '\0';
    const char *near = word ? tn_nearest(text, names, name_count) : NULL;
    char list[400];
    tn_fail(error, TN_INVALID, E_FIELD_GOAL, "the goal `%.100s` cannot be computed: %.200s", text, why->message);
    tn_word_list(names, name_count, list, sizeof list);
    if (near)
        tn_error_help(error, "did you mean `%s`?", near);
    else
        tn_error_help(error, "the measures are %s", list);
    return TN_INVALID;
}

static tn_status read_goal(tn_goal *goal, const tn_setting_value *value, const char *const *names, size_t name_count,
                           tn_error *error)
{
    tn_error why = {0};
    *goal = (tn_goal){.text = value->text, .target = value->first, .weight = value->second};
    tn_status status = tn_sentence_read(value->text, strlen(value->text), names, name_count, &goal->formula, &why);
    if (status == TN_MEMORY)
        return tn_fail_memory(error);
    double number;
    if (status == TN_OK && goal->formula.depth > TN_MEASURE_STACK_MAX)
        status = tn_fail(&why, TN_INVALID, E_FIELD_GOAL, "it nests too deep");
    else if (status == TN_OK && tn_formula_is_constant(&goal->formula, &number))
        status = tn_fail(&why, TN_INVALID, E_FIELD_GOAL, "it is the same for every form");
    return status == TN_OK ? TN_OK : refuse(value->text, names, name_count, &why, error);
}

tn_status tn_goals_read(const tn_evolution_study *study, const char *const *names, size_t name_count, tn_goals *goals,
                        uint32_t *blamed, tn_error *error)
{
    tn_status status = TN_OK;
    goals->items = calloc(study->each_count + 1u, sizeof *goals->items);
    if (!goals->items)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < study->each_count && status == TN_OK; i++) {
        if (study->each[i].setting != TN_SET_FITNESS)
            continue;
        *blamed = i;
        status = read_goal(&goals->items[goals->count++], &study->each[i].value, names, name_count, error);
    }
    return status;
}

uint64_t tn_goals_ask(const tn_goals *goals)
{
    uint64_t asked = 0;
    for (size_t i = 0; i < goals->count; i++)
        asked |= tn_formula_terms(&goals->items[i].formula);
    return asked;
}

double tn_goal_share(double value, double target, double weight)
{
    return weight * fabs(value - target) / fmax(fabs(target), 1);
}

double tn_goal_part(const tn_goal *goal, const double *values)
{
    return tn_goal_share(tn_number_run(goal->formula.code, 0, values), goal->target, goal->weight);
}

bool tn_goals_adjust(tn_goals *goals, const char *change)
{
    for (size_t i = 0; i < goals->count; i++) {
        tn_goal *goal = &goals->items[i];
        size_t size = strlen(goal->text);
        double target = goal->target, weight = goal->weight;
        if (strncmp(change, goal->text, size) != 0 || change[size] != ' ' ||
            !tn_wish_read(change + size, &target, &weight))
            continue;
        goal->target = target;
        goal->weight = weight;
        return true;
    }
    return false;
}

/* ---- requirements */

#define SHOWN 120 /* bytes of a requirement */

/* Its words in one line. */
static void quote(FILE *out, const tn_module *module, const tn_unmet_requirement *r)
{
    const char *text = tn_text(module, module->SOURCE_records[r->file].text);
    size_t line = 1, length = r->end - r->begin, shown = length < SHOWN ? length : SHOWN;
    for (size_t i = 0; i < r->begin; i++)
        line += text[i] == '\n';
    while (shown < length && shown > 0 && ((unsigned char)text[r->begin + shown] & 0xC0) == 0x80)
        shown--; /* whole letters */
    fputc('`', out);
    for (size_t i = 0; i < shown; i++)
        fputc((unsigned char)text[r->begin + i] < ' ' ? ' ' : text[r->begin + i], out);
    fprintf(out, "%s` (line %zu)", shown < length ? "..." : "", line);
}

static void list_found(FILE *out, const tn_unmet_found *found, uint64_t asked)
{
    const char *between = ": ";
    for (size_t i = 0; i < found->count && i < 64; i++) {
        if (!(asked >> i & 1))
            continue;
        fprintf(out, "%s%s is %.6g", between, found->names[i], found->values[i]);
        between = ", ";
    }
}

void tn_unmet_write(FILE *out, const tn_unmet_found *found, const tn_unmet_requirement *r)
{
    const tn_module *module = found->module;
    if (tn_number_run(module->code, module->FUNCTION_records[r->violation].code_begin, found->values) == 0)
        return;
    quote(out, module, r);
    list_found(out, found, tn_number_asked(module, r->violation));
    fputc('\n', out);
}
