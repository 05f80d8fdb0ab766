/* Finds non-terminals without a sentence: a production ends once all non-terminals in it (but for those in { } and [ ])
 * do, and a non-terminal once one of its productions does. */
#include "runtime/grammar/ends.h"

#include <stdlib.h>

#include "runtime/module/code.h"

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

tn_status tn_grammar_check_ends(const tn_checker *checker)
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
