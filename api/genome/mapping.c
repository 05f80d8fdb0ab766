/* The C interface to grammars: mapping genomes, their derivations, and inverting sentences. */
#include <gmp.h>
#include <stdlib.h>
#include <string.h>

#include "api/genome/genome.h"
#include "runtime/genome/mapping/invert.h"
#include "runtime/grammar/analysis.h"

_Static_assert((int)TARTAN_MAP_REPAIR_TOO_LONG == (int)TN_MAPPING_REPAIR_TOO_LONG, "reasons are the same numbers");
_Static_assert(TARTAN_NONE == TN_TREE_NONE, "one number for no node");

tartan_status tartan_grammar_new(const tartan_module *module, tartan_grammar **grammar, tartan_error *error)
{
    tn_grammar *made;
    tn_error found;
    if (!module)
        return tn_api_missing(error, "module");
    if (tn_grammar_new(module->module, 0, &made, &found) != TN_OK)
        return tn_api_fail(&found, error);
    *grammar = (tartan_grammar *)(void *)made;
    return TARTAN_OK;
}

void tartan_grammar_free(tartan_grammar *grammar)
{
    tn_grammar_free((tn_grammar *)(void *)grammar);
}

tartan_status tartan_grammar_derivations(const tartan_grammar *grammar, uint32_t depth, bool *by_codons, char **count,
                                         tartan_error *error)
{
    tn_error found;
    mpz_t total;
    bool counted_by_codons;
    if (!grammar || !count)
        return tn_api_missing(error, grammar ? "room for the count" : "grammar");
    mpz_init(total);
    tn_status status = tn_count_derivations(tn_api_grammar(grammar), depth, &counted_by_codons, total, &found);
    char *text = status == TN_OK ? malloc(mpz_sizeinbase(total, 10) + 2) : NULL;
    if (status == TN_OK && !text)
        status = tn_fail_memory(&found);
    if (status == TN_OK) {
        *count = mpz_get_str(text, 10, total);
        if (by_codons)
            *by_codons = counted_by_codons;
    }
    mpz_clear(total);
    return status == TN_OK ? TARTAN_OK : tn_api_fail(&found, error);
}

/* ---- mapping */

static tartan_repair repair_of(tn_repair repair)
{
    return repair == TN_REPAIR_OFF      ? TARTAN_REPAIR_OFF
           : repair == TN_REPAIR_GENOME ? TARTAN_REPAIR_GENOME
                                        : TARTAN_REPAIR_IDENTITY;
}

tartan_status tartan_map_options_of(const tartan_grammar *grammar, tartan_map_options *options, tartan_error *error)
{
    if (!grammar)
        return tn_api_missing(error, "grammar");
    tn_mapping_options said = tn_mapping_options_of(tn_api_grammar(grammar));
    tartan_map_options own = {.wraps = said.wraps,
                              .max_depth = said.max_depth,
                              .max_steps = said.max_steps,
                              .repair = repair_of(said.repair),
                              .position_independent = said.position_independent};
    return TN_API_GIVE(tartan_map_options, options, &own, error);
}

tartan_status tn_api_map_options(const tn_grammar *grammar, const tartan_map_options *given,
                                 tn_mapping_options *options, tartan_error *error)
{
    tartan_map_options own;
    tartan_status status = TN_API_TAKE(tartan_map_options, &own, given, error);
    *options = tn_mapping_options_of(grammar);
    if (status != TARTAN_OK || !given)
        return status;
    if ((unsigned)own.repair > TARTAN_REPAIR_IDENTITY)
        return tn_api_refuse(error, TARTAN_INVALID, "there is no repair %d", (int)own.repair);
    if (own.repair != TARTAN_REPAIR_OFF && grammar->dialect != TN_DIALECT_GENR8)
        return tn_api_refuse(error, TARTAN_INVALID, "only what grammars of the genr8 dialect make is repaired");
    if (own.position_independent && !tn_grammar_takes_places(grammar))
        return tn_api_refuse(
            error, TARTAN_INVALID,
            "position-independent mapping is for grammars of the dialect ge that read a codon for every "
            "choice");
    options->position_independent = own.position_independent;
    options->wraps = own.wraps;
    options->max_depth = own.max_depth;
    options->max_steps = own.max_steps;
    options->repair = own.repair == TARTAN_REPAIR_OFF      ? TN_REPAIR_OFF
                      : own.repair == TARTAN_REPAIR_GENOME ? TN_REPAIR_GENOME
                                                           : TN_REPAIR_IDENTITY;
    options->record = own.derivation;
    return TARTAN_OK;
}

tartan_status tartan_mapper_new(const tartan_grammar *grammar, tartan_mapper **mapper, tartan_error *error)
{
    if (!grammar)
        return tn_api_missing(error, "grammar");
    tartan_mapper *made = calloc(1, sizeof *made);
    if (!made || !(made->mapper = tn_mapper_new(tn_api_grammar(grammar)))) {
        free(made);
        return tn_api_memory(error);
    }
    made->grammar = tn_api_grammar(grammar);
    *mapper = made;
    return TARTAN_OK;
}

void tartan_mapper_free(tartan_mapper *mapper)
{
    if (!mapper)
        return;
    tn_mapper_free(mapper->mapper);
    free(mapper->nodes);
    free(mapper);
}

static void describe(const tn_mapping *m, tartan_mapping *own)
{
    *own = (tartan_mapping){.valid = m->valid,
                            .reason = (tartan_map_reason)m->reason,
                            .reason_text = tn_mapping_reason_text(m->reason),
                            .sentence = "",
                            .used = m->used,
                            .nodes = m->nodes,
                            .depth = m->depth,
                            .wraps = m->wraps};
    if (m->has_phenotype)
        own->sentence = tn_mapping_sentence(m, &own->sentence_size);
}

tartan_status tartan_map(tartan_mapper *mapper, const uint64_t *codons, size_t count, const tartan_map_options *given,
                         tartan_mapping *mapping, tartan_error *error)
{
    tn_mapping_options options;
    tn_error found;
    tartan_mapping own;
    if (!mapper || (count && !codons))
        return tn_api_missing(error, mapper ? "array of codons" : "mapper");
    tartan_status status = tn_api_map_options(mapper->grammar, given, &options, error);
    if (status != TARTAN_OK)
        return status;
    mapper->recorded = false;
    free(mapper->nodes);
    mapper->nodes = NULL;
    if (tn_mapper_derive(mapper->mapper, codons, count, &options, &mapper->last, &found) != TN_OK)
        return tn_api_fail(&found, error);
    mapper->recorded = options.record;
    describe(&mapper->last, &own);
    return TN_API_GIVE(tartan_mapping, mapping, &own, error);
}

/* ---- derivations */

tartan_status tn_api_derivation(const tartan_mapper *mapper, tartan_error *error)
{
    if (!mapper)
        return tn_api_missing(error, "mapper");
    return mapper->recorded
               ? TARTAN_OK
               : tn_api_refuse(error, TARTAN_INVALID, "the last mapping did not keep its derivation: set `derivation`");
}

static void name_node(const tn_grammar *g, const tn_event *e, tartan_node *node)
{
    static const char letters[] = "XYZ";
    node->text = "";
    if (e->kind == TN_EVENT_EXPAND)
        node->text = tn_rule_name(g, e->symbol);
    else if (e->kind == TN_EVENT_EDGE && e->letter)
        node->text = letters + (e->letter - 'X');
    node->text_size = e->kind == TN_EVENT_EDGE ? e->letter != 0 : strlen(node->text);
    if (e->kind == TN_EVENT_TERMINAL) {
        node->text = g->texts + g->terminals[e->symbol].offset;
        node->text_size = g->terminals[e->symbol].length;
    }
}

static tartan_node node_of(const tn_grammar *g, const tn_event *e, const tn_tree_node *tree)
{
    static const tartan_node_kind kinds[] = {
        [TN_EVENT_EXPAND] = TARTAN_NODE_RULE, [TN_EVENT_TERMINAL] = TARTAN_NODE_TERMINAL,
        [TN_EVENT_EDGE] = TARTAN_NODE_EDGE,   [TN_EVENT_AGAIN] = TARTAN_NODE_LOOP,
        [TN_EVENT_STOP] = TARTAN_NODE_LOOP,   [TN_EVENT_TAKE] = TARTAN_NODE_OPTION,
        [TN_EVENT_SKIP] = TARTAN_NODE_OPTION, [TN_EVENT_REPAIR] = TARTAN_NODE_REPAIR};
    tartan_node node = {.kind = kinds[e->kind],
                        .parent = tree->parent,
                        .first_child = tree->first_child,
                        .next = tree->next,
                        .depth = e->depth,
                        .reads = e->read != TN_NO_READ,
                        .codon = e->codon,
                        .modulus = e->modulus,
                        .choice = e->value,
                        .text_begin = e->text_begin};
    node.read = node.reads ? e->read : 0;
    name_node(g, e, &node);
    if (e->kind == TN_EVENT_EXPAND)
        node.choice = e->production - g->rules[e->symbol].first;
    else if (node.kind == TARTAN_NODE_LOOP || node.kind == TARTAN_NODE_OPTION)
        node.choice = e->kind == TN_EVENT_AGAIN || e->kind == TN_EVENT_TAKE;
    return node;
}

tartan_status tartan_mapper_nodes(tartan_mapper *mapper, const tartan_node **nodes, size_t *count, tartan_error *error)
{
    tn_tree tree;
    tn_error found;
    tartan_status status = tn_api_derivation(mapper, error);
    if (status != TARTAN_OK)
        return status;
    if (tn_tree_make(mapper->last.events, mapper->last.event_count, &tree, &found) != TN_OK)
        return tn_api_fail(&found, error);
    tartan_node *made = calloc(tree.count + 1, sizeof *made);
    for (size_t i = 0; made && i < tree.count; i++)
        made[i] = node_of(mapper->grammar, &mapper->last.events[tree.nodes[i].event], &tree.nodes[i]);
    if (made) {
        free(mapper->nodes);
        mapper->nodes = made;
        *nodes = made;
        *count = tree.count;
    }
    tn_tree_clear(&tree);
    return made ? TARTAN_OK : tn_api_memory(error);
}

/* ---- inverting */

tartan_status tartan_invert(const tartan_grammar *grammar, const char *sentence, size_t size, uint32_t max_depth,
                            const tartan_watch *given, uint64_t **codons, size_t *count, tartan_error *error)
{
    tn_genome genome = {0};
    tn_error found;
    tn_watch watch;
    const tn_invert_options options = {
        .max_depth = max_depth, .position_independent = tn_api_grammar(grammar)->position_independent, .watch = &watch};
    if (!grammar || (size && !sentence))
        return tn_api_missing(error, grammar ? "sentence" : "grammar");
    tartan_status watched = tn_api_watch(given, &watch, error);
    if (watched != TARTAN_OK)
        return watched;
    tn_status status = tn_invert(tn_api_grammar(grammar), size ? sentence : "", size, &options, &genome, &found);
    if (status == TN_OK && !tn_genome_reserve(&genome, 1)) /* no codons are an array too */
        status = tn_fail_memory(&found);
    if (status != TN_OK) {
        tn_genome_clear(&genome);
        return tn_api_fail(&found, error);
    }
    *codons = genome.codons;
    *count = genome.count;
    return TARTAN_OK;
}
