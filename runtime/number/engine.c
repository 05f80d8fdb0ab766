/* Verifies the code of expressions: what they may hold at once, what they may speak of, and that a number is kept
 * before it is used. */
#include "runtime/module/engine.h"
#include "runtime/number/run.h"

static tn_status verify_function(const tn_checker *checker, uint32_t function)
{
    if (checker->module->FUNCTION_records[function].stack_max > TN_MEASURE_STACK_MAX)
        return tn_refuse(checker, "an expression's stack passes %u", TN_MEASURE_STACK_MAX);
    return TN_OK;
}

static tn_status check_term(const tn_checker *checker, const tn_instruction *instruction)
{
    const tn_engine *engine =
        tn_engine_of_terms(checker->engines, checker->module->FUNCTION_records[checker->record].kind);
    if (!engine || instruction->first >= engine->term_count)
        return tn_refuse(checker, "nothing of this number is measured");
    return TN_OK;
}

static void list_term(tn_lister *lister, const tn_instruction *instruction)
{
    const tn_engine *engine =
        tn_engine_of_terms(lister->engines, lister->module->FUNCTION_records[lister->function].kind);
    fputs(engine->terms[instruction->first], lister->out);
}

static tn_status check_axis(const tn_checker *checker, const tn_instruction *instruction)
{
    return instruction->first < 3 ? TN_OK : tn_refuse(checker, "there are three coordinates");
}

static void list_axis(tn_lister *lister, const tn_instruction *instruction)
{
    fputc("xyz"[instruction->first], lister -> out);
}

/* Fields have places, other expressions have terms. Locals are numbered as they are kept. */
static tn_status verify_words(const tn_checker *checker, const tn_function_record *function)
{
    bool field = function->kind == TN_FUNCTION_FIELD;
    uint32_t kept = 0;
    for (uint32_t offset = function->code_begin; offset < function->code_end;) {
        tn_instruction i = tn_code_read(checker->module->code, offset);
        bool place = i.opcode == TN_OP_COORDINATE || i.opcode == TN_OP_MESH_DISTANCE || i.opcode == TN_OP_KEEP ||
                     i.opcode == TN_OP_KEPT;
        if (field ? i.opcode == TN_OP_TERM : place)
            return tn_refuse(checker, field ? "a field has no terms" : "an expression has no coordinates");
        if (i.opcode == TN_OP_KEEP && i.first != kept++)
            return tn_refuse(checker, "a number is kept out of order");
        if (i.opcode == TN_OP_KEPT && i.first >= kept)
            return tn_refuse(checker, "a number is used that was not kept");
        offset += i.length;
    }
    return TN_OK;
}

static tn_status verify_after(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    tn_status status = TN_OK;
    for (size_t i = 0; i < module->FUNCTION_count && status == TN_OK; i++) {
        const tn_function_record *function = &module->FUNCTION_records[i];
        if (tn_function_kinds[function->kind].code == TN_CODE_MEASURE)
            status = verify_words(checker, function);
    }
    return status;
}

static const tn_operand_rules operands[] = {{TN_OPERANDS_TERM, check_term, list_term},
                                            {TN_OPERANDS_AXIS, check_axis, list_axis}};

extern const tn_engine tn_engine_number;
const tn_engine tn_engine_number = {.name = "number",
                                    .codes = 1u << TN_CODE_MEASURE,
                                    .operands = operands,
                                    .operand_count = sizeof operands / sizeof *operands,
                                    .verify_function = verify_function,
                                    .verify_after = verify_after};
