/* Reads a grammar from a module. */
#include "runtime/grammar/grammar.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/module/code.h"

#define TEXT_SLACK 16u /* the mapper copies short terminals sixteen bytes at a time */

typedef struct decoder {
    const tn_module *module;
    const tn_grammar_record *record;
    tn_grammar *grammar;
    uint32_t *terminal_of; /* by string offset: index of its terminal + 1; 0 if it has none */
} decoder;

static uint32_t word(tn_word_op op, uint32_t argument)
{
    return (uint32_t)op | argument << TN_WORD_BITS;
}

static uint32_t terminal_for(decoder *d, uint32_t string)
{
    tn_grammar *g = d->grammar;
    if (d->terminal_of[string])
        return d->terminal_of[string] - 1;
    const char *text = g->texts + string;
    uint32_t kind = strcmp(text, "<") == 0   ? TN_TERMINAL_LESS
                    : strcmp(text, ">") == 0 ? TN_TERMINAL_GREATER
                                             : TN_TERMINAL_PLAIN;
    g->terminals[g->terminal_count++] = (tn_terminal){string, (uint32_t)strlen(text), kind};
    d->terminal_of[string] = (uint32_t)g->terminal_count;
    return (uint32_t)g->terminal_count - 1;
}

/* The words of code bytes [at, end): a REPEAT's body is followed by its AGAIN. Bodies nest, so their ends are kept on a
 * stack that the verifier has bounded to TN_GROUP_DEPTH. */
static void decode_production(decoder *d, uint32_t at, uint32_t end, tn_production *production)
{
    struct {
        uint32_t end, word;
    } open[TN_GROUP_DEPTH];
    size_t depth = 0;
    tn_grammar *g = d->grammar;
    production->words = (uint32_t)g->word_count;
    while (at < end) {
        while (depth && open[depth - 1].end == at) {
            uint32_t *start = &g->words[open[--depth].word];
            if (TN_WORD_OP(*start) == TN_WORD_REPEAT)
                g->words[g->word_count++] = word(TN_WORD_AGAIN, 0);
            *start = word(TN_WORD_OP(*start), (uint32_t)g->word_count - open[depth].word - 1);
        }
        tn_instruction instruction = tn_code_read(d->module->code, at);
        uint32_t argument = (uint32_t)instruction.first;
        at += instruction.length;
        uint32_t *out = &g->words[g->word_count];
        switch (instruction.opcode) {
        case TN_OP_EMIT:
            *out = word(TN_WORD_TERMINAL, terminal_for(d, argument));
            break;
        case TN_OP_EXPAND:
            *out = word(TN_WORD_RULE, argument - d->record->rule_first);
            production->children++;
            break;
        case TN_OP_EDGE:
            *out = word(TN_WORD_EDGE, 0);
            break;
        case TN_OP_EDGE_SAME:
            *out = word(TN_WORD_SAME, argument);
            break;
        case TN_OP_REPEAT:
        case TN_OP_MAYBE:
            *out = word(instruction.opcode == TN_OP_REPEAT ? TN_WORD_REPEAT : TN_WORD_MAYBE, 0);
            open[depth].end = at + argument;
            open[depth++].word = (uint32_t)g->word_count;
            break;
        default:
            *out = word(TN_WORD_DONE, 0);
            break;
        }
        g->word_count++;
    }
    production->symbols = (uint32_t)g->word_count - production->words - 1;
}

static void decode_rules(decoder *d)
{
    tn_grammar *g = d->grammar;
    size_t closed_count = 0;
    for (uint32_t r = 0; r < g->rule_count; r++) {
        const tn_nonterminal_record *record = &d->module->NONTERMINAL_records[d->record->rule_first + r];
        tn_rule *rule = &g->rules[r];
        *rule = (tn_rule){.first = (uint32_t)g->production_count,
                          .count = record->production_count,
                          .closed_first = (uint32_t)closed_count,
                          .reciprocal = tn_reciprocal(record->production_count),
                          .name = record->name,
                          .begin = record->begin,
                          .end = record->end,
                          .file = record->file};
        for (uint32_t p = 0; p < record->production_count; p++) {
            const tn_production_record *from = &d->module->PRODUCTION_records[record->production_first + p];
            tn_production *production = &g->productions[g->production_count];
            *production = (tn_production){.rule = r, .begin = from->begin, .end = from->end, .file = from->file};
            decode_production(d, from->code_begin, from->code_end, production);
            if (production->children == 0) {
                g->closed[closed_count++] = (uint32_t)g->production_count;
                rule->closed_count++;
            }
            g->production_count++;
        }
    }
}

static uint32_t rule_of(const tn_grammar_record *record, uint32_t nonterminal)
{
    return nonterminal == TN_NO_RECORD ? TN_NO_RECORD : nonterminal - record->rule_first;
}

static void decode_marks(decoder *d)
{
    tn_grammar *g = d->grammar;
    g->rewrite_rule = rule_of(d->record, d->record->rewrite_rule);
    g->predecessor = rule_of(d->record, d->record->predecessor);
    g->successor = rule_of(d->record, d->record->successor);
    if (g->rewrite_rule != TN_NO_RECORD)
        g->rules[g->rewrite_rule].mark = TN_MARK_REWRITE_RULE;
    if (g->predecessor != TN_NO_RECORD)
        g->rules[g->predecessor].mark = TN_MARK_PREDECESSOR;
}

/* How much to allocate: every instruction becomes one word, every REPEAT two. */
static void measure(const tn_module *module, const tn_grammar_record *record, size_t *productions, size_t *words)
{
    *productions = *words = 0;
    for (uint32_t r = 0; r < record->rule_count; r++) {
        const tn_nonterminal_record *rule = &module->NONTERMINAL_records[record->rule_first + r];
        *productions += rule->production_count;
        for (uint32_t p = 0; p < rule->production_count; p++) {
            const tn_production_record *production = &module->PRODUCTION_records[rule->production_first + p];
            for (uint32_t at = production->code_begin; at < production->code_end;
                 at += tn_code_read(module->code, at).length)
                *words += module->code[at] == TN_OP_REPEAT ? 2 : 1;
        }
    }
}

static tn_status allocate(decoder *d, size_t productions, size_t words, tn_error *error)
{
    tn_grammar *g = d->grammar;
    g->rule_count = d->record->rule_count;
    g->texts_size = d->module->strings_size;
    g->rules = calloc(g->rule_count, sizeof *g->rules);
    g->productions = calloc(productions, sizeof *g->productions);
    g->closed = calloc(productions, sizeof *g->closed);
    g->words = calloc(words, sizeof *g->words);
    g->terminals = calloc(words, sizeof *g->terminals);
    g->texts = calloc(g->texts_size + TEXT_SLACK, 1);
    d->terminal_of = calloc(g->texts_size + 1, sizeof *d->terminal_of);
    if (!g->rules || !g->productions || !g->closed || !g->words || !g->terminals || !g->texts || !d->terminal_of)
        return tn_fail_memory(error);
    return TN_OK;
}

tn_status tn_grammar_new(const tn_module *module, size_t index, tn_grammar **grammar, tn_error *error)
{
    *grammar = NULL;
    if (index >= module->GRAMMAR_count || module->GRAMMAR_records[index].dialect == TN_DIALECT_PLACE)
        return tn_fail(error, TN_INVALID, TN_CODE_NONE, "the module holds no grammar that genomes are mapped through");
    decoder d = {.module = module, .record = &module->GRAMMAR_records[index]};
    size_t productions, words;
    measure(module, d.record, &productions, &words);
    if (words > TN_WORD_MAX || d.record->rule_count > TN_WORD_MAX)
        return tn_fail(error, TN_LIMIT, E_GRAMMAR_TOO_LARGE, "the grammar has more than %u symbols", TN_WORD_MAX);
    d.grammar = calloc(1, sizeof *d.grammar);
    if (!d.grammar)
        return tn_fail_memory(error);
    tn_status status = allocate(&d, productions, words, error);
    if (status == TN_OK) {
        tn_grammar *g = d.grammar;
        g->dialect = (tn_dialect)d.record->dialect;
        g->repair = (tn_repair)d.record->repair;
        g->skip_single = d.record->flags & TN_SKIP_SINGLE;
        g->position_independent = d.record->flags & TN_POSITION_INDEPENDENT;
        g->max_depth = d.record->max_depth;
        g->wraps = d.record->wraps;
        g->hash = module->hash;
        memcpy(g->texts, module->strings, module->strings_size);
        g->name = g->texts + d.record->name;
        decode_rules(&d);
        decode_marks(&d);
    }
    free(d.terminal_of);
    if (status != TN_OK) {
        tn_grammar_free(d.grammar);
        return status;
    }
    *grammar = d.grammar;
    return TN_OK;
}

void tn_grammar_free(tn_grammar *grammar)
{
    if (!grammar)
        return;
    free(grammar->rules);
    free(grammar->productions);
    free(grammar->closed);
    free(grammar->words);
    free(grammar->terminals);
    free(grammar->texts);
    free(grammar);
}
