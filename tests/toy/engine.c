/* The toy engine: verifies the code of counters, lists it and runs it. */
#include "tests/toy/engine.h"

#include "runtime/module/engine.h"
#include "runtime/module/lister.h"
#include "runtime/module/verify.h"

static tn_status check_step(const tn_checker *checker, const tn_instruction *instruction)
{
    return instruction->first > 0 ? TN_OK : tn_refuse(checker, "a step of nothing");
}

static tn_status check_counter(tn_checker *checker, tn_section section, uint32_t index)
{
    const tn_counter_record *counter = &checker->module->COUNTER_records[index];
    tn_instruction instruction = {.opcode = TN_OP_COUNT_UP};
    tn_status status = tn_code_enter(checker, section, index, counter->code_begin, counter->code_end);
    while (status == TN_OK && checker->offset < checker->end) {
        status = tn_code_next(checker, TN_CODE_COUNT, &instruction);
        if (status == TN_OK && (instruction.opcode == TN_OP_STOP) != (checker->offset + 1 == checker->end))
            status = tn_refuse(checker, "a counter ends with its one STOP");
        if (status == TN_OK)
            status = tn_code_pass(checker, &instruction);
    }
    return status;
}

static tn_status verify_code(tn_checker *checker, tn_section section)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < checker->module->COUNTER_count && status == TN_OK; i++)
        status = check_counter(checker, section, i);
    return status;
}

static void list_code(tn_lister *lister)
{
    for (uint32_t i = 0; i < lister->module->COUNTER_count; i++) {
        const tn_counter_record *counter = &lister->module->COUNTER_records[i];
        tn_list_record(lister, TN_SECTION_COUNTER, i);
        tn_list_code(lister, counter->code_begin, counter->code_end, NULL);
    }
}

static const tn_section sections[] = {TN_SECTION_COUNTER, TN_SECTION_STRINGS};
static const tn_operand_rules operands[] = {{TN_OPERANDS_STEP, check_step, NULL}};

extern const tn_engine tn_engine_toy;
const tn_engine tn_engine_toy = {.name = "toy",
                                 .sections = sections,
                                 .codes = 1u << TN_CODE_COUNT,
                                 .operands = operands,
                                 .operand_count = 1,
                                 .verify_code = verify_code,
                                 .list_code = list_code};

uint64_t toy_count(const tn_module *module, uint32_t counter)
{
    const tn_counter_record *record = &module->COUNTER_records[counter];
    uint64_t count = record->start;
    tn_instruction instruction;
    for (uint32_t at = record->code_begin; at < record->code_end; at += instruction.length) {
        instruction = tn_code_read(module->code, at);
        if (instruction.opcode == TN_OP_COUNT_UP)
            count += (uint64_t)instruction.first;
    }
    return count;
}
