/* Verifies and lists the steps of connection grammars. (Their tables, and that productions end, are the grammar
 * engine's.) */
#include <stdlib.h>

#include "runtime/module/code.h"
#include "runtime/module/engine.h"
#include "runtime/place/model/terms.h"
#include "runtime/place/model/turns.h"

static bool is_small(const tn_checker *checker, int64_t index)
{
    const tn_vector_record *vector = &checker->module->VECTOR_records[index];
    return llabs(vector->x) <= TN_PLACE_SIZE_MAX && llabs(vector->y) <= TN_PLACE_SIZE_MAX &&
           llabs(vector->z) <= TN_PLACE_SIZE_MAX;
}

/* Sizes keep within their limit, where a move may go farther. */
static tn_status check_vector(const tn_checker *checker, const tn_instruction *instruction)
{
    return instruction->opcode == TN_OP_MOVE || is_small(checker, instruction->first)
               ? TN_OK
               : tn_refuse(checker, "a box that is too large");
}

static tn_status check_corners(const tn_checker *checker, const tn_instruction *instruction)
{
    return is_small(checker, instruction->first) && is_small(checker, instruction->second)
               ? TN_OK
               : tn_refuse(checker, "a box that is too large");
}

static tn_status check_amount(const tn_checker *checker, const tn_instruction *instruction)
{
    int64_t low, high;
    switch (instruction->opcode) {
    case TN_OP_HEADING:
        low = 0;
        high = checker->module->KIT_count > 0 ? (int64_t)checker->module->KIT_records[0].turns - 1 : 3;
        break;
    case TN_OP_COLOUR:
        low = -(int64_t)TN_PLACE_COLOUR_MAX;
        high = TN_PLACE_COLOUR_MAX;
        break;
    case TN_OP_BOUND_BALL:
        low = -TN_PLACE_SIZE_MAX;
        high = TN_PLACE_SIZE_MAX;
        break;
    default:
        return TN_OK;
    }
    return instruction->first >= low && instruction->first <= high
               ? TN_OK
               : tn_refuse(checker, "%lld is not from %lld to %lld", (long long)instruction->first, (long long)low,
                           (long long)high);
}

/* A part has a name. */
static tn_status check_part(const tn_checker *checker, const tn_instruction *instruction)
{
    return !*tn_text(checker->module, (tn_string)instruction->first) ? tn_refuse(checker, "a part without a name")
                                                                     : TN_OK;
}

static void list_one(tn_lister *lister, int64_t index)
{
    const tn_vector_record *vector = &lister->module->VECTOR_records[index];
    fprintf(lister->out, "%lld, %lld, %lld", (long long)vector->x, (long long)vector->y, (long long)vector->z);
}

static void list_vector(tn_lister *lister, const tn_instruction *instruction)
{
    list_one(lister, instruction->first);
}

static void list_corners(tn_lister *lister, const tn_instruction *instruction)
{
    list_one(lister, instruction->first);
    fputs(" to ", lister->out);
    list_one(lister, instruction->second);
}

/* ---- kits */

const char *const tn_placed_terms[TN_PLACED_TERM_COUNT] = {
#define X(NAME, NUMBER, WORD) [NUMBER] = (WORD),
    TN_PLACED_TERMS(X)
#undef X
        [TN_PLACED_X] = "x",
    [TN_PLACED_Y] = "y",
    [TN_PLACED_Z] = "z",
#define COUNTED(N) [TN_PLACED_COUNTED + (N)] = "count " #N
#define FOUR(N) COUNTED(N), COUNTED(N + 1), COUNTED(N + 2), COUNTED(N + 3)
    FOUR(0),
    FOUR(4),
    FOUR(8),
    FOUR(12),
    FOUR(16),
    FOUR(20),
    FOUR(24),
    FOUR(28),
#undef FOUR
#undef COUNTED
#define MASK(N) [TN_PLACED_MASK + (N)] = "mask " #N
#define FOUR(N) MASK(N), MASK(N + 1), MASK(N + 2), MASK(N + 3)
#define SIXTEEN(N) FOUR(N), FOUR(N + 4), FOUR(N + 8), FOUR(N + 12)
    SIXTEEN(0),
    SIXTEEN(16),
    SIXTEEN(32),
    SIXTEEN(48),
#undef SIXTEEN
#undef FOUR
#undef MASK
};

static tn_status check_function(const tn_checker *checker, const char *what, uint32_t function)
{
    return checker->module->FUNCTION_records[function].kind == TN_FUNCTION_KIT
               ? TN_OK
               : tn_refuse(checker, "the %s of a model is a function of another kind", what);
}

/* The words hold a bit for each cell, and no more. */
static tn_status check_mask(const tn_checker *checker, const tn_kit_mask_record *mask)
{
    uint64_t layer = (uint64_t)mask->size_x * mask->size_z;
    if (layer > TN_MASK_CELLS_MAX || layer * mask->size_y > TN_MASK_CELLS_MAX)
        return tn_refuse(checker, "a mask of too many cells");
    return mask->word_count == (layer * mask->size_y + 63) / 64
               ? TN_OK
               : tn_refuse(checker, "a mask of %u words", (unsigned)mask->word_count);
}

/* A space asks for masks that are there. */
static tn_status check_space(const tn_checker *checker, uint32_t function)
{
    const tn_module *module = checker->module;
    const tn_function_record *f = &module->FUNCTION_records[function];
    tn_instruction i;
    for (uint32_t offset = f->code_begin; offset < f->code_end; offset += i.length) {
        i = tn_code_read(module->code, offset);
        if (i.opcode == TN_OP_TERM && i.first >= TN_PLACED_MASK &&
            (uint64_t)i.first - TN_PLACED_MASK >= module->KIT_MASK_count)
            return tn_refuse(checker, "a space asks for a mask that is not there");
    }
    return TN_OK;
}

/* A slope has a corner between its sides; its steps are boxes of its part that no slope before it has. */
static tn_status check_slope(const tn_checker *checker, const tn_kit_part_record *part, uint32_t index,
                             uint64_t *next_box)
{
    const tn_part_slope_record *slope = &checker->module->PART_SLOPE_records[index];
    const uint64_t end = (uint64_t)slope->step_first + slope->step_count;
    if (tn_axis_coordinate((tn_axis)slope->side) == tn_axis_coordinate((tn_axis)slope->other))
        return tn_refuse(checker, "a slope between sides that do not meet");
    if (slope->low_x >= slope->high_x || slope->low_y >= slope->high_y || slope->low_z >= slope->high_z)
        return tn_refuse(checker, "a slope without extent");
    if (slope->step_count == 0 || slope->step_first < *next_box || end > (uint64_t)part->box_first + part->box_count)
        return tn_refuse(checker, "a slope whose steps are not those of its part");
    *next_box = end;
    return TN_OK;
}

static tn_status check_slopes(const tn_checker *checker, const tn_kit_part_record *part)
{
    uint64_t next_box = part->box_first;
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < part->slope_count && status == TN_OK; i++)
        status = check_slope(checker, part, part->slope_first + i, &next_box);
    return status;
}

static tn_status check_model(const tn_checker *checker, const tn_kit_model_record *model)
{
    const tn_module *module = checker->module;
    const tn_grammar_record *grammar = module->GRAMMAR_count ? &module->GRAMMAR_records[0] : NULL;
    if (!grammar || grammar->dialect != TN_DIALECT_PLACE || model->start < grammar->rule_first ||
        model->start - grammar->rule_first >= grammar->rule_count)
        return tn_refuse(checker, "a model starts with what is no symbol of a connection grammar");
    if (model->search == TN_SEARCH_BEAM && (model->search_amount == 0 || model->search_amount > TN_BEAM_MAX))
        return tn_refuse(checker, "a beam of %u", (unsigned)model->search_amount);
    tn_status status = check_function(checker, "space", model->space);
    if (status == TN_OK)
        status = check_space(checker, model->space);
    return status == TN_OK && model->objective != TN_NO_RECORD ? check_function(checker, "objective", model->objective)
                                                               : status;
}

static tn_status verify(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    if (module->KIT_count > 1)
        return tn_refuse(checker, "there are %zu kits", (size_t)module->KIT_count);
    const tn_kit_record *kit = module->KIT_count > 0 ? &module->KIT_records[0] : NULL;
    if (kit && kit->turns != 4 && (kit->turns != 24 || kit->unit_x != kit->unit_y || kit->unit_x != kit->unit_z))
        return tn_refuse(checker, "%u turns of a cell", (unsigned)kit->turns);
    if (module->KIT_MASK_count > TN_KIT_MASKS_MAX)
        return tn_refuse(checker, "there are %zu masks", (size_t)module->KIT_MASK_count);
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < module->KIT_MASK_count && status == TN_OK; i++)
        status = check_mask(checker, &module->KIT_MASK_records[i]);
    for (uint32_t i = 0; i < module->KIT_PART_count && status == TN_OK; i++)
        status = check_slopes(checker, &module->KIT_PART_records[i]);
    for (uint32_t i = 0; i < module->KIT_MODEL_count && status == TN_OK; i++)
        status = check_model(checker, &module->KIT_MODEL_records[i]);
    for (uint32_t i = 0; i < module->KIT_CONDITION_count && status == TN_OK; i++) {
        const tn_kit_condition_record *condition = &module->KIT_CONDITION_records[i];
        status = check_function(checker, "condition", condition->holds);
        if (status == TN_OK && condition->violation != TN_NO_RECORD)
            status = check_function(checker, "condition", condition->violation);
    }
    return status;
}

static const tn_section sections[] = {TN_SECTION_VECTOR,    TN_SECTION_KIT,           TN_SECTION_CONNECTOR_TYPE,
                                      TN_SECTION_KIT_PART,  TN_SECTION_PART_BOX,      TN_SECTION_PART_CONNECTOR,
                                      TN_SECTION_KIT_MODEL, TN_SECTION_KIT_CONDITION, TN_SECTION_COUNTED,
                                      TN_SECTION_KIT_STOCK, TN_SECTION_KIT_MASK,      TN_SECTION_MASK_WORD,
                                      TN_SECTION_PART_SLOPE, TN_SECTION_STRINGS};

/* The vectors are shown where they are used; the words of masks are not. */
static void list(tn_lister *lister)
{
#define LIST(NAME)                                                                                                     \
    for (uint32_t i = 0; i < lister->module->NAME##_count && !ferror(lister->out); i++)                                \
    tn_list_record(lister, TN_SECTION_##NAME, i)
    LIST(KIT);
    LIST(CONNECTOR_TYPE);
    LIST(KIT_PART);
    LIST(PART_BOX);
    LIST(PART_SLOPE);
    LIST(PART_CONNECTOR);
    LIST(KIT_MODEL);
    LIST(KIT_CONDITION);
    LIST(KIT_STOCK);
    LIST(COUNTED);
    LIST(KIT_MASK);
#undef LIST
}

static const tn_operand_rules operands[] = {
    {TN_OPERANDS_VECTOR, check_vector, list_vector},
    {TN_OPERANDS_CORNERS, check_corners, list_corners},
    {TN_OPERANDS_AMOUNT, check_amount, NULL},
    {TN_OPERANDS_PART, check_part, NULL},
};

extern const tn_engine tn_engine_place;
const tn_engine tn_engine_place = {.name = "place",
                                   .sections = sections,
                                   .codes = 1u << TN_CODE_PLACE,
                                   .operands = operands,
                                   .operand_count = sizeof operands / sizeof *operands,
                                   .terms = tn_placed_terms,
                                   .term_count = TN_PLACED_TERM_COUNT,
                                   .term_kind = TN_FUNCTION_KIT,
                                   .verify = verify,
                                   .list = list};
