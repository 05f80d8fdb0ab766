/* Grammars that genomes are mapped through: their tables and their productions' code, in one pass. */
#include <stdio.h>
#include <string.h>

#include "runtime/module/code.h"
#include "runtime/module/verify.h"

typedef struct tn_grammar_checker {
    const tn_module *module;
    tn_error *error;
    const tn_grammar_record *grammar; /* being checked */
    size_t nonterminals, productions; /* checked so far */
    uint32_t offset;                  /* code checked so far */
    size_t map;                       /* the next map record */
} tn_grammar_checker;

__attribute__((format(printf, 2, 3))) static tn_status refuse(const tn_grammar_checker *checker, const char *format,
                                                              ...)
{
    char what[160];
    va_list args;
    va_start(args, format);
    vsnprintf(what, sizeof what, format, args);
    va_end(args);
    tn_fail(checker->error, TN_INVALID, E_REFUSED_MODULE, "the module is refused: code offset %u: %s", checker->offset,
            what);
    if (checker->error)
        checker->error->code_offset = checker->offset;
    return TN_INVALID;
}

static bool is_name(const tn_module *module, tn_string name)
{
    return name != 0 && strnlen(tn_text(module, name), TN_NAME_MAX + 1) <= TN_NAME_MAX;
}

static bool is_symbol(const tn_grammar_record *grammar, uint32_t symbol)
{
    return symbol >= grammar->rule_first && symbol - grammar->rule_first < grammar->rule_count;
}

/* ---- productions */

/* The operand of one instruction; `body_end` is where the innermost open body ends. */
static tn_status check_operand(const tn_grammar_checker *checker, const tn_instruction *instruction, uint32_t body_end)
{
    const tn_module *module = checker->module;
    uint32_t operand = (uint32_t)instruction->first;
    switch (tn_opcode_describe((uint8_t)instruction->opcode)->operands) {
    case TN_OPERANDS_TEXT:
        if (operand >= module->strings_size || (operand > 0 && module->strings[operand - 1] != '\0'))
            return refuse(checker, "there is no text at %u", operand);
        return TN_OK;
    case TN_OPERANDS_SYMBOL:
        return is_symbol(checker->grammar, operand) ? TN_OK
                                                    : refuse(checker, "non-terminal %u is not of the grammar", operand);
    case TN_OPERANDS_LETTER:
        return operand < TN_EDGE_LETTERS ? TN_OK : refuse(checker, "there is no edge variable %u", operand);
    case TN_OPERANDS_BODY:
        return operand <= body_end - checker->offset - instruction->length
                   ? TN_OK
                   : refuse(checker, "a body runs past the end of what holds it");
    default:
        return TN_OK;
    }
}

/* Is it an instruction of the grammar's dialect, whole, and DONE exactly at the end? */
static tn_status check_opcode(const tn_grammar_checker *checker, uint32_t body_end, uint32_t code_end)
{
    uint8_t opcode = checker->module->code[checker->offset];
    const tn_opcode_info *info = tn_opcode_describe(opcode);
    if (!info || info->engine != TN_CODE_MAP)
        return refuse(checker, "%u is no opcode of a production", opcode);
    if (info->length > code_end - checker->offset ||
        (opcode != TN_OP_DONE && info->length > body_end - checker->offset))
        return refuse(checker, "%s runs past its end", info->name);
    if ((opcode == TN_OP_DONE) != (checker->offset + 1 == code_end))
        return refuse(checker, "a production ends with its one DONE");
    if (checker->grammar->dialect == TN_DIALECT_GE && opcode != TN_OP_EMIT && opcode != TN_OP_EXPAND &&
        opcode != TN_OP_DONE)
        return refuse(checker, "%s is not of the grammar's dialect", info->name);
    return TN_OK;
}

static tn_status check_code(tn_grammar_checker *checker, uint32_t code_end)
{
    uint32_t ends[TN_GROUP_DEPTH + 1], depth = 0;
    ends[0] = code_end - 1; /* where the DONE is */
    while (checker->offset < code_end) {
        while (depth && ends[depth] == checker->offset)
            depth--;
        tn_status status = check_opcode(checker, ends[depth], code_end);
        if (status != TN_OK)
            return status;
        tn_instruction instruction = tn_code_read(checker->module->code, checker->offset);
        status = check_operand(checker, &instruction, ends[depth]);
        if (status != TN_OK)
            return status;
        checker->offset += instruction.length;
        if (instruction.opcode != TN_OP_REPEAT && instruction.opcode != TN_OP_MAYBE)
            continue;
        if (depth == TN_GROUP_DEPTH)
            return refuse(checker, "bodies nest more than %u deep", TN_GROUP_DEPTH);
        ends[++depth] = checker->offset + (uint32_t)instruction.first;
    }
    return TN_OK;
}

static tn_status check_production(tn_grammar_checker *checker, const tn_production_record *production)
{
    const tn_module *module = checker->module;
    if (production->code_begin != checker->offset || production->code_end <= production->code_begin ||
        production->code_end > module->code_size)
        return refuse(checker, "a production's code is not the stretch after the one before");
    if (checker->map < module->MAP_count && module->MAP_records[checker->map].offset == checker->offset)
        checker->map++;
    if (checker->map < module->MAP_count && module->MAP_records[checker->map].offset < production->code_end)
        return refuse(checker, "the source map's record %zu names no production", checker->map);
    return check_code(checker, production->code_end);
}

/* ---- tables */

static tn_status check_nonterminal(tn_grammar_checker *checker, const tn_nonterminal_record *nonterminal)
{
    const tn_module *module = checker->module;
    if (!is_name(module, nonterminal->name))
        return refuse(checker, "non-terminal %zu has no name of 1 to %u bytes", checker->nonterminals, TN_NAME_MAX);
    if (nonterminal->production_count == 0 || nonterminal->production_first != checker->productions ||
        nonterminal->production_count > module->PRODUCTION_count - checker->productions)
        return refuse(checker, "the productions of non-terminal %zu do not follow those before", checker->nonterminals);
    for (uint32_t i = 0; i < nonterminal->production_count; i++) {
        tn_status status = check_production(checker, &module->PRODUCTION_records[checker->productions++]);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

static bool is_special(const tn_grammar_record *grammar, uint32_t symbol)
{
    bool needed = grammar->repair != TN_REPAIR_OFF;
    return symbol == TN_NO_RECORD ? !needed : is_symbol(grammar, symbol);
}

static tn_status check_grammar(tn_grammar_checker *checker, const tn_grammar_record *grammar)
{
    const tn_module *module = checker->module;
    checker->grammar = grammar;
    if (!is_name(module, grammar->name))
        return refuse(checker, "a grammar has no name of 1 to %u bytes", TN_NAME_MAX);
    if (grammar->dialect >= TN_DIALECT_COUNT || grammar->repair >= TN_REPAIR_COUNT ||
        (grammar->flags & ~TN_SKIP_SINGLE) != 0)
        return refuse(checker, "a grammar has an unknown dialect, repair or flag");
    if (grammar->dialect == TN_DIALECT_GE ? grammar->repair != TN_REPAIR_OFF : grammar->flags != 0)
        return refuse(checker, "a grammar's repair or flags are not of its dialect");
    if (grammar->rule_count == 0 || grammar->rule_first != checker->nonterminals ||
        grammar->rule_count > module->NONTERMINAL_count - checker->nonterminals)
        return refuse(checker, "a grammar's non-terminals do not follow those before");
    if (!is_special(grammar, grammar->rewrite_rule) || !is_special(grammar, grammar->predecessor) ||
        !is_special(grammar, grammar->successor))
        return refuse(checker, "a grammar's repair names non-terminals that are not its own");
    for (uint32_t i = 0; i < grammar->rule_count; i++) {
        tn_status status = check_nonterminal(checker, &module->NONTERMINAL_records[checker->nonterminals]);
        if (status != TN_OK)
            return status;
        checker->nonterminals++;
    }
    return TN_OK;
}

tn_status tn_verify_grammars(const tn_module *module, uint32_t *offset, size_t *map, tn_error *error)
{
    tn_grammar_checker checker = {.module = module, .error = error, .offset = *offset, .map = *map};
    for (size_t i = 0; i < module->GRAMMAR_count; i++) {
        tn_status status = check_grammar(&checker, &module->GRAMMAR_records[i]);
        if (status != TN_OK)
            return status;
    }
    if (checker.nonterminals != module->NONTERMINAL_count || checker.productions != module->PRODUCTION_count)
        return refuse(&checker, "it has non-terminals or productions that belong to no grammar");
    *offset = checker.offset;
    *map = checker.map;
    return TN_OK;
}
