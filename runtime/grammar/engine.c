/* Verifies and lists grammars: their tables, and their productions' code, whatever that does. */
#include "runtime/module/engine.h"

#include <stdlib.h>

#include "runtime/module/code.h"
#include "runtime/module/lister.h"
#include "runtime/module/verify.h"

/* ---- finds non-terminals without a sentence */

typedef struct ending {
    const tn_module *module;
    uint32_t *rule_of;   /* [production] */
    uint32_t *waits_for; /* [production]: non-terminals in it that are not known to end */
    size_t *first;       /* [rule + 2]: its uses, as an index into `use` */
    uint32_t *use;       /* productions that a rule is used in, once for each time */
    uint32_t *ready;     /* rules that end, whose uses were not looked at */
    uint8_t *ends;       /* [rule] */
    size_t ready_count, ended;
} ending;

static void clear(ending *e)
{
    free(e->rule_of);
    free(e->waits_for);
    free(e->first);
    free(e->use);
    free(e->ready);
    free(e->ends);
}

static bool make(ending *e)
{
    size_t rules = e->module->NONTERMINAL_count, productions = e->module->PRODUCTION_count;
    e->rule_of = calloc(productions + 1, sizeof *e->rule_of);
    e->waits_for = calloc(productions + 1, sizeof *e->waits_for);
    e->first = calloc(rules + 2, sizeof *e->first);
    e->ready = calloc(rules + 1, sizeof *e->ready);
    e->ends = calloc(rules + 1, sizeof *e->ends);
    return e->rule_of && e->waits_for && e->first && e->ready && e->ends;
}

static void rule_ends(ending *e, uint32_t rule)
{
    if (e->ends[rule])
        return;
    e->ends[rule] = 1;
    e->ended++;
    e->ready[e->ready_count++] = rule;
}

/* Counts the uses of each rule, or lists them where they have been counted. Bodies may be left out by a genome. */
static void visit_uses(ending *e, uint32_t production)
{
    const tn_production_record *record = &e->module->PRODUCTION_records[production];
    for (uint32_t offset = record->code_begin; offset < record->code_end;) {
        tn_instruction code = tn_code_read(e->module->code, offset);
        offset += code.length;
        if (tn_code_operands((uint8_t)code.opcode) == TN_OPERANDS_BODY)
            offset += (uint32_t)code.first;
        if (code.opcode != TN_OP_EXPAND)
            continue;
        if (e->use) {
            e->use[e->first[code.first + 1]++] = production;
            e->waits_for[production]++;
        } else {
            e->first[code.first + 2]++;
        }
    }
}

static void visit_all(ending *e)
{
    for (uint32_t rule = 0; rule < e->module->NONTERMINAL_count; rule++) {
        const tn_nonterminal_record *record = &e->module->NONTERMINAL_records[rule];
        for (uint32_t i = 0; i < record->production_count; i++) {
            e->rule_of[record->production_first + i] = rule;
            visit_uses(e, record->production_first + i);
        }
    }
}

static bool list_uses(ending *e)
{
    size_t rules = e->module->NONTERMINAL_count;
    visit_all(e);
    for (size_t r = 2; r < rules + 2; r++)
        e->first[r] += e->first[r - 1];
    e->use = calloc(e->first[rules + 1] + 1, sizeof *e->use);
    if (e->use)
        visit_all(e);
    return e->use != NULL;
}

static void spread(ending *e)
{
    for (uint32_t p = 0; p < e->module->PRODUCTION_count; p++)
        if (e->waits_for[p] == 0)
            rule_ends(e, e->rule_of[p]);
    while (e->ready_count > 0) {
        uint32_t rule = e->ready[--e->ready_count];
        for (size_t i = e->first[rule]; i < e->first[rule + 1]; i++)
            if (--e->waits_for[e->use[i]] == 0)
                rule_ends(e, e->rule_of[e->use[i]]);
    }
}

/* Refuses a module in which each production of some non-terminal leads back to it, or to another such. What
 * { } and [ ] hold may be left out. The productions' code has been verified. Linear in their size. */
static tn_status grammar_check_ends(const tn_checker *checker)
{
    ending e = {.module = checker->module};
    if (!make(&e) || !list_uses(&e)) {
        clear(&e);
        return tn_fail_memory(checker->error);
    }
    spread(&e);
    uint32_t rule = 0;
    while (rule < e.module->NONTERMINAL_count && e.ends[rule])
        rule++;
    bool all = e.ended == e.module->NONTERMINAL_count;
    clear(&e);
    return all ? TN_OK : tn_refuse(checker, "non-terminal %u can never end", rule);
}

/* ---- tables */

static bool is_symbol(const tn_grammar_record *grammar, int64_t symbol)
{
    return symbol >= grammar->rule_first && symbol - grammar->rule_first < grammar->rule_count;
}

static bool is_special(const tn_grammar_record *grammar, uint32_t symbol)
{
    bool needed = grammar->repair != TN_REPAIR_OFF;
    return symbol == TN_NO_RECORD ? !needed : is_symbol(grammar, symbol);
}

/* A connection grammar has none of what mapping genomes needs, and is alone in its module. */
static bool has_settings(const tn_grammar_record *grammar)
{
    return grammar->repair != TN_REPAIR_OFF || grammar->flags || grammar->max_depth || grammar->wraps ||
           grammar->rewrite_rule != TN_NO_RECORD || grammar->predecessor != TN_NO_RECORD ||
           grammar->successor != TN_NO_RECORD;
}

/* Repair and flags are of the grammar's dialect, and what repair needs are non-terminals of its own. */
static tn_status verify(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    for (size_t i = 0; i < module->GRAMMAR_count; i++) {
        const tn_grammar_record *grammar = &module->GRAMMAR_records[i];
        if (grammar->dialect == TN_DIALECT_PLACE && (has_settings(grammar) || module->GRAMMAR_count > 1))
            return tn_refuse(checker, "a connection grammar with settings of another, or not alone");
        if (grammar->dialect == TN_DIALECT_GE ? grammar->repair != TN_REPAIR_OFF : grammar->flags != 0)
            return tn_refuse(checker, "grammar %zu has a repair or flags that are not of its dialect", i);
        if (grammar->flags == TN_GRAMMAR_FLAGS)
            return tn_refuse(checker, "grammar %zu reads codons in pairs, and none for single choices", i);
        if (!is_special(grammar, grammar->rewrite_rule) || !is_special(grammar, grammar->predecessor) ||
            !is_special(grammar, grammar->successor))
            return tn_refuse(checker, "grammar %zu has a repair that names non-terminals that are not its own", i);
    }
    return TN_OK;
}

/* ---- productions */

static tn_status check_letter(const tn_checker *checker, const tn_instruction *instruction)
{
    if (instruction->first >= TN_EDGE_LETTERS)
        return tn_refuse(checker, "there is no edge variable %u", (unsigned)instruction->first);
    return TN_OK;
}

static bool has_body(tn_opcode opcode)
{
    return opcode == TN_OP_REPEAT || opcode == TN_OP_MAYBE;
}

/* What holds of an instruction within its production; `body_end`: where the innermost open body ends. */
static tn_status check_instruction(const tn_checker *checker, const tn_grammar_record *grammar,
                                   const tn_instruction *instruction, uint32_t body_end)
{
    tn_opcode opcode = instruction->opcode;
    const char *name = tn_opcode_describe((uint8_t)opcode)->name;
    if ((opcode == TN_OP_DONE) != (checker->offset + 1 == checker->end))
        return tn_refuse(checker, "a production ends with its one DONE");
    if (opcode != TN_OP_DONE && instruction->length > body_end - checker->offset)
        return tn_refuse(checker, "%s runs past its end", name);
    if (grammar->dialect == TN_DIALECT_GE && opcode != TN_OP_EMIT && opcode != TN_OP_EXPAND && opcode != TN_OP_DONE)
        return tn_refuse(checker, "%s is not of the grammar's dialect", name);
    if (opcode == TN_OP_EXPAND && !is_symbol(grammar, instruction->first))
        return tn_refuse(checker, "non-terminal %u is not of the grammar", (unsigned)instruction->first);
    if (has_body(opcode) && instruction->first > body_end - checker->offset - instruction->length)
        return tn_refuse(checker, "a body runs past the end of what holds it");
    return TN_OK;
}

/* Steps of a connection grammar: they are flat. */
static tn_status check_steps(tn_checker *checker, const tn_grammar_record *grammar)
{
    tn_status status = TN_OK;
    while (status == TN_OK && checker->offset < checker->end) {
        tn_instruction instruction;
        status = tn_code_next(checker, TN_CODE_PLACE, &instruction);
        if (status != TN_OK)
            return status;
        if ((instruction.opcode == TN_OP_PLACED) != (checker->offset + instruction.length == checker->end))
            return tn_refuse(checker, "a production ends with its one PLACED");
        if (instruction.opcode == TN_OP_DERIVE && !is_symbol(grammar, instruction.first))
            return tn_refuse(checker, "non-terminal %u is not of the grammar", (unsigned)instruction.first);
        status = tn_code_pass(checker, &instruction);
    }
    return status;
}

static tn_status check_code(tn_checker *checker, const tn_grammar_record *grammar)
{
    uint32_t ends[TN_GROUP_DEPTH + 1], depth = 0;
    ends[0] = checker->end - 1; /* where the DONE is */
    while (checker->offset < checker->end) {
        while (depth && ends[depth] == checker->offset)
            depth--;
        tn_instruction instruction;
        tn_status status = tn_code_next(checker, TN_CODE_PRODUCTION, &instruction);
        if (status == TN_OK)
            status = check_instruction(checker, grammar, &instruction, ends[depth]);
        if (status == TN_OK)
            status = tn_code_pass(checker, &instruction);
        if (status != TN_OK)
            return status;
        if (!has_body(instruction.opcode))
            continue;
        if (depth == TN_GROUP_DEPTH)
            return tn_refuse(checker, "bodies nest more than %u deep", TN_GROUP_DEPTH);
        ends[++depth] = checker->offset + (uint32_t)instruction.first;
    }
    return TN_OK;
}

static tn_status check_production(tn_checker *checker, const tn_grammar_record *grammar, uint32_t index)
{
    const tn_production_record *production = &checker->module->PRODUCTION_records[index];
    tn_status status =
        tn_code_enter(checker, TN_SECTION_PRODUCTION, index, production->code_begin, production->code_end);
    if (status != TN_OK)
        return status;
    return grammar->dialect == TN_DIALECT_PLACE ? check_steps(checker, grammar) : check_code(checker, grammar);
}

/* A grammar's non-terminals and their productions are runs, so that these are all productions in their order. */
static tn_status check_grammar(tn_checker *checker, const tn_grammar_record *grammar)
{
    const tn_module *module = checker->module;
    const tn_nonterminal_record *first = &module->NONTERMINAL_records[grammar->rule_first];
    const tn_nonterminal_record *last = first + grammar->rule_count - 1;
    for (uint32_t i = first->production_first; i < last->production_first + last->production_count; i++) {
        tn_status status = check_production(checker, grammar, i);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

/* A production ends with its one DONE; bodies nest; instructions are of the grammar's dialect, and symbols its own;
 * every non-terminal has a sentence. */
static tn_status verify_code(tn_checker *checker, tn_section section)
{
    (void)section; /* the engine has code in one */
    for (size_t i = 0; i < checker->module->GRAMMAR_count; i++) {
        tn_status status = check_grammar(checker, &checker->module->GRAMMAR_records[i]);
        if (status != TN_OK)
            return status;
    }
    return grammar_check_ends(checker);
}

/* ---- listing */

/* places: the map says where each instruction is from. */
static void list_nonterminal(tn_lister *lister, uint32_t index, bool places)
{
    const tn_module *module = lister->module;
    const tn_nonterminal_record *rule = &module->NONTERMINAL_records[index];
    fputc('\n', lister->out);
    tn_list_name(lister, rule->name);
    fprintf(lister->out, ", productions %u..%u\n", rule->production_first,
            rule->production_first + rule->production_count - 1);
    lister->shown_line = 0;
    for (uint32_t i = 0; i < rule->production_count && !ferror(lister->out); i++) {
        const tn_production_record *production = &module->PRODUCTION_records[rule->production_first + i];
        tn_source_map_record place = {production->code_begin, production->file, production->begin, production->end};
        if (production->weight > 0)
            fprintf(lister->out, "  probability %.17g\n", production->weight);
        tn_list_code(lister, production->code_begin, production->code_end, places ? NULL : &place);
    }
}

static void list_settings(tn_lister *lister, const tn_grammar_record *grammar)
{
    static const char *const repairs[] = {"genome", "identity", "off"};
    fprintf(lister->out, ", depth %u, wraps %u, repair %s%s%s", grammar->max_depth, grammar->wraps,
            repairs[grammar->repair], grammar->flags & TN_SKIP_SINGLE ? ", single choices read nothing" : "",
            grammar->flags & TN_POSITION_INDEPENDENT ? ", position-independent" : "");
}

static void list_grammar(tn_lister *lister, size_t index)
{
    static const char *const dialects[] = {"ge", "genr8", "place"};
    const tn_grammar_record *grammar = &lister->module->GRAMMAR_records[index];
    fprintf(lister->out, "\ngrammar %zu  ", index);
    tn_list_name(lister, grammar->name);
    fprintf(lister->out, ": dialect %s", dialects[grammar->dialect]);
    if (grammar->dialect != TN_DIALECT_PLACE)
        list_settings(lister, grammar);
    tn_list_place(lister, grammar->file, grammar->begin);
    for (uint32_t i = 0; i < grammar->rule_count && !ferror(lister->out); i++)
        list_nonterminal(lister, grammar->rule_first + i, grammar->dialect == TN_DIALECT_PLACE);
}

static void list_code(tn_lister *lister)
{
    for (size_t i = 0; i < lister->module->GRAMMAR_count && !ferror(lister->out); i++)
        list_grammar(lister, i);
}

static void list_symbol(tn_lister *lister, const tn_instruction *instruction)
{
    tn_list_name(lister, lister->module->NONTERMINAL_records[instruction->first].name);
}

static void list_letter(tn_lister *lister, const tn_instruction *instruction)
{
    fputc((int)('X' + instruction->first), lister->out);
}

static void list_body(tn_lister *lister, const tn_instruction *instruction)
{
    fprintf(lister->out, "%u bytes", (unsigned)instruction->first);
}

static const tn_section sections[] = {TN_SECTION_GRAMMAR, TN_SECTION_NONTERMINAL, TN_SECTION_PRODUCTION,
                                      TN_SECTION_STRINGS};

static const tn_operand_rules operands[] = {
    {TN_OPERANDS_SYMBOL, NULL, list_symbol},
    {TN_OPERANDS_LETTER, check_letter, list_letter},
    {TN_OPERANDS_BODY, NULL, list_body},
};

extern const tn_engine tn_engine_grammar;
const tn_engine tn_engine_grammar = {.name = "grammar",
                                     .sections = sections,
                                     .codes = 1u << TN_CODE_PRODUCTION,
                                     .operands = operands,
                                     .operand_count = sizeof operands / sizeof *operands,
                                     .verify = verify,
                                     .verify_code = verify_code,
                                     .list_code = list_code};
