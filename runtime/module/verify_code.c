/* The code: every instruction of every function, in one pass. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "runtime/base/bytes.h"
#include "runtime/growth/model/records.h"
#include "runtime/module/opcodes.h"
#include "runtime/module/verify.h"

typedef struct tn_checker {
    const tn_module *module;
    tn_error *error;
    uint32_t function; /* being checked */
    uint32_t offset;   /* of the instruction being checked */
    uint32_t depth;    /* of the stack before it */
    size_t map;        /* the next map record */
} tn_checker;

__attribute__((format(printf, 2, 3))) static tn_status refuse(const tn_checker *checker, const char *format, ...)
{
    char what[160];
    va_list args;
    va_start(args, format);
    vsnprintf(what, sizeof what, format, args);
    va_end(args);
    tn_fail(checker->error, TN_INVALID, E_REFUSED_MODULE, "the module is refused: function %u, code offset %u: %s",
            checker->function, checker->offset, what);
    if (checker->error)
        checker->error->code_offset = checker->offset;
    return TN_INVALID;
}

static const tn_function_record *function_of(const tn_checker *checker)
{
    return &checker->module->FUNCTION_records[checker->function];
}

/* ---- operands */

static tn_status check_spec(const tn_checker *checker, uint32_t spec)
{
    const tn_module *module = checker->module;
    if (spec >= module->SPEC_count)
        return refuse(checker, "there is no specifier %u", spec);
    if (module->SPEC_records[spec].schema != function_of(checker)->schema)
        return refuse(checker, "specifier %u is of another schema", spec);
    return TN_OK;
}

static tn_status check_call(const tn_checker *checker, uint32_t callee)
{
    if (callee >= checker->function)
        return refuse(checker, "calls function %u, which is not a lower one", callee);
    const tn_function_record *function = &checker->module->FUNCTION_records[callee];
    if (function->kind == TN_FUNCTION_CONDITION || function->kind == TN_FUNCTION_MEASURE)
        return refuse(checker, "calls function %u, which is no part of a rule", callee);
    if (function->schema != function_of(checker)->schema)
        return refuse(checker, "calls function %u, which is of another schema", callee);
    return TN_OK;
}

static tn_status check_condition(const tn_checker *checker, uint32_t condition)
{
    if (condition >= checker->module->FUNCTION_count ||
        checker->module->FUNCTION_records[condition].kind != TN_FUNCTION_CONDITION)
        return refuse(checker, "function %u is no condition", condition);
    return TN_OK;
}

static tn_status check_field(const tn_checker *checker, uint32_t field)
{
    const tn_schema_record *schema = &checker->module->SCHEMA_records[function_of(checker)->schema];
    if (field < schema->field_first || field - schema->field_first >= schema->field_count)
        return refuse(checker, "field %u is not of the function's schema", field);
    uint32_t kind = checker->module->FIELD_records[field].kind;
    if (kind != TN_FIELD_LENGTH && kind != TN_FIELD_ZONE)
        return refuse(checker, "field %u has no lengths", field);
    return TN_OK;
}

static tn_status check_numbers(const tn_checker *checker, tn_opcode opcode, int64_t first, int64_t second)
{
    if (opcode == TN_OP_REMAINDER && (first <= 0 || second < 0))
        return refuse(checker, "a remainder needs a divisor above 0 and a rest not below 0");
    return TN_OK;
}

static tn_status check_real(const tn_checker *checker, int64_t bits)
{
    double number;
    memcpy(&number, &bits, sizeof number);
    return isfinite(number) ? TN_OK : refuse(checker, "a number that is not finite");
}

static tn_status check_operands(const tn_checker *checker, tn_opcode opcode, const tn_opcode_info *info,
                                const uint8_t *operands)
{
    tn_status status;
    switch (info->operands) {
    case TN_OPERANDS_NONE:
    case TN_OPERANDS_INT:
        return TN_OK;
    case TN_OPERANDS_SPEC:
        return check_spec(checker, tn_get_u32(operands));
    case TN_OPERANDS_FUNC:
        return check_call(checker, tn_get_u32(operands));
    case TN_OPERANDS_COND:
        return check_condition(checker, tn_get_u32(operands));
    case TN_OPERANDS_FIELD_COND:
        status = check_field(checker, tn_get_u32(operands));
        return status == TN_OK ? check_condition(checker, tn_get_u32(operands + 4)) : status;
    case TN_OPERANDS_INT2:
        return check_numbers(checker, opcode, tn_get_i64(operands), tn_get_i64(operands + 8));
    case TN_OPERANDS_REAL:
        return check_real(checker, tn_get_i64(operands));
    case TN_OPERANDS_TERM:
        return tn_get_u32(operands) < TN_MEASURED_COUNT ? TN_OK : refuse(checker, "nothing of this number is measured");
    case TN_OPERANDS_TEXT:
    case TN_OPERANDS_SYMBOL:
    case TN_OPERANDS_LETTER:
    case TN_OPERANDS_BODY:
        break; /* of productions, which tn_verify_grammars checks */
    }
    return refuse(checker, "an unknown kind of operands");
}

/* ---- instructions */

static bool ends_function(tn_opcode opcode)
{
    return opcode == TN_OP_RETURN || opcode == TN_OP_ANSWER || opcode == TN_OP_VALUE;
}

static tn_status check_stack(tn_checker *checker, tn_opcode opcode, const tn_opcode_info *info)
{
    if (checker->depth < info->pops)
        return refuse(checker, "%s takes %u from a stack of %u", info->name, info->pops, checker->depth);
    if (ends_function(opcode) && checker->depth != 1)
        return refuse(checker, "%s leaves %u on the stack", info->name, checker->depth - 1);
    checker->depth += (uint32_t)info->pushes - info->pops;
    if (checker->depth > function_of(checker)->stack_max)
        return refuse(checker, "the stack passes the %u that the function declares", function_of(checker)->stack_max);
    return TN_OK;
}

/* The map's records name instructions, in ascending order and each but once. */
static tn_status check_map(tn_checker *checker, uint32_t next)
{
    const tn_module *module = checker->module;
    if (checker->map == module->MAP_count || module->MAP_records[checker->map].offset >= next)
        return TN_OK;
    if (module->MAP_records[checker->map].offset != checker->offset)
        return refuse(checker, "the source map's record %zu names no instruction", checker->map);
    checker->map++;
    if (checker->map < module->MAP_count && module->MAP_records[checker->map].offset < next)
        return refuse(checker, "the source map does not ascend at its record %zu", checker->map);
    return TN_OK;
}

static tn_code_engine engine_of(tn_function_kind kind)
{
    return kind == TN_FUNCTION_CONDITION ? TN_CODE_CONDITION
           : kind == TN_FUNCTION_MEASURE ? TN_CODE_MEASURE
                                         : TN_CODE_RULE;
}

static tn_status check_instruction(tn_checker *checker, bool *ended)
{
    const tn_function_record *function = function_of(checker);
    const uint8_t *code = checker->module->code + checker->offset;
    const tn_opcode_info *info = tn_opcode_describe(code[0]);
    if (!info)
        return refuse(checker, "%u is no opcode", code[0]);
    tn_opcode opcode = (tn_opcode)code[0];
    if (info->engine != engine_of((tn_function_kind)function->kind))
        return refuse(checker, "%s does not belong into this kind of function", info->name);
    if (info->length > function->code_end - checker->offset)
        return refuse(checker, "%s runs past the function's end", info->name);
    tn_status status = check_operands(checker, opcode, info, code + 1);
    if (status == TN_OK)
        status = check_stack(checker, opcode, info);
    if (status == TN_OK)
        status = check_map(checker, checker->offset + info->length);
    checker->offset += info->length;
    *ended = ends_function(opcode);
    return status;
}

static tn_status check_function(tn_checker *checker, const tn_module_limits *limits)
{
    const tn_function_record *function = function_of(checker);
    if (function->kind >= TN_FUNCTION_KIND_COUNT)
        return refuse(checker, "%u is no kind of function", function->kind);
    bool of_schema = function->kind == TN_FUNCTION_WHOLE || function->kind == TN_FUNCTION_HOLDS;
    if (of_schema && function->schema >= checker->module->SCHEMA_count)
        return refuse(checker, "there is no schema %u", function->schema);
    if (function->kind == TN_FUNCTION_MEASURE && function->stack_max > TN_MEASURE_STACK_MAX)
        return refuse(checker, "an expression's stack passes %u", TN_MEASURE_STACK_MAX);
    if (function->stack_max > limits->stack) {
        tn_fail(checker->error, TN_LIMIT, E_MODULE_TOO_LARGE, "function %u declares a stack of %u; the limit is %zu",
                checker->function, function->stack_max, limits->stack);
        tn_error_help(checker->error, "this limit is fixed: give parts of the rule's expression names of their own");
        return TN_LIMIT;
    }
    if (function->code_begin != checker->offset || function->code_end < function->code_begin ||
        function->code_end > checker->module->code_size)
        return refuse(checker, "the function's code is not the stretch after the one before");
    bool ended = false;
    checker->depth = 0;
    while (checker->offset < function->code_end && !ended) {
        tn_status status = check_instruction(checker, &ended);
        if (status != TN_OK)
            return status;
    }
    if (!ended)
        return refuse(checker, "the function does not end with RETURN, ANSWER or VALUE");
    if (checker->offset != function->code_end)
        return refuse(checker, "code follows the function's end");
    return TN_OK;
}

tn_status tn_verify_code(const tn_module *module, const tn_module_limits *limits, tn_error *error)
{
    tn_checker checker = {.module = module, .error = error};
    for (; checker.function < module->FUNCTION_count; checker.function++) {
        tn_status status = check_function(&checker, limits);
        if (status != TN_OK)
            return status;
    }
    tn_status status = tn_verify_grammars(module, &checker.offset, &checker.map, error);
    if (status != TN_OK)
        return status;
    if (checker.offset != module->code_size)
        return refuse(&checker, "code that belongs to no function or production");
    if (checker.map != module->MAP_count)
        return refuse(&checker, "the source map names places past the code");
    return TN_OK;
}
