/* Makes, breeds and maps strings of codons for evolution. */
#include "runtime/genome/breeding/evolve_state.h"

#include <stdlib.h>

typedef struct codons {
    const tn_grammar *grammar;
    tn_analysis analysis;
    tn_depths depths; /* where first trees must reach a depth; and those of the study's range that there are */
    uint32_t *ramp;
    uint32_t ramp_count;
    tn_evolution_settings settings;
} codons;

typedef struct workplace {
    const codons *of;
    tn_breeder *breeder;
} workplace;

static void *workplace_new(const void *context)
{
    const codons *of = context;
    workplace *w = calloc(1, sizeof *w);
    if (!w)
        return NULL;
    w->of = of;
    w->breeder = tn_breeder_new(of->grammar, &of->analysis, &of->settings.mapping);
    if (w->breeder)
        return w;
    free(w);
    return NULL;
}

static void workplace_free(void *place)
{
    workplace *w = place;
    if (w)
        tn_breeder_free(w->breeder);
    free(w);
}

static tn_status first_codons(const tn_evolution_settings *s, tn_chance *chance, tn_genome *genome, tn_error *error)
{
    if (!tn_genome_reserve(genome, s->codons))
        return tn_fail_memory(error);
    genome->count = s->codons;
    tn_random_codons(chance, s->vary.codon_limit, genome->codons, s->codons);
    return TN_OK;
}

/* Ramped: the depths of the range in turn. */
static uint32_t ramp(const codons *of, uint64_t turn)
{
    const tn_evolution_settings *s = &of->settings;
    if (of->ramp_count)
        return of->ramp[turn % of->ramp_count];
    uint32_t steps = s->depth_high >= s->depth_low ? s->depth_high - s->depth_low + 1 : 1;
    return s->depth_low + (uint32_t)(turn % steps);
}

/* The depth that a first tree may have; and that a branch of it must reach (0: none must), since the least of the range
 * is a bound, too. Half of the ramped ones are full, half grown; PI grow reaches each depth of its ramp. */
static void first_depths(const codons *of, uint64_t number, tn_tree_options *tree)
{
    const tn_evolution_settings *s = &of->settings;
    bool ramped = s->initialisation == TN_INITIALISE_RAMPED, reaching = s->initialisation == TN_INITIALISE_PI_GROW;
    tree->method = reaching ? TN_TREE_PI_GROW : ramped && number % 2 == 0 ? TN_TREE_FULL : TN_TREE_GROW;
    tree->depth = reaching ? ramp(of, number) : ramped ? ramp(of, number / 2) : s->depth_high;
    tree->least = reaching ? tree->depth : s->depth_low;
    if (of->grammar->dialect == TN_DIALECT_GENR8 && s->mapping.max_depth && tree->least > s->mapping.max_depth)
        tree->least = s->mapping.max_depth; /* mapping ends trees there */
    if (tree->least <= of->analysis.rule_depth[0])
        tree->least = 0; /* any tree is that deep */
}

/* Where the range has none of the grammar's depths, the deepest below it is the ramp. */
static void find_ramp(codons *of)
{
    uint32_t low = of->settings.depth_low, high = of->settings.depth_high;
    for (uint32_t depth = low; depth <= high; depth++)
        if (tn_depths_within(&of->depths, 0, depth, depth))
            of->ramp[of->ramp_count++] = depth;
    for (uint32_t depth = low; depth > 0 && !of->ramp_count; depth--)
        if (tn_depths_within(&of->depths, 0, depth, depth))
            of->ramp[of->ramp_count++] = depth;
}

static tn_status find_depths(codons *of, tn_error *error)
{
    const tn_evolution_settings *s = &of->settings;
    bool bound = s->initialisation == TN_INITIALISE_PI_GROW || s->depth_low > of->analysis.rule_depth[0];
    if (s->initialisation == TN_INITIALISE_RANDOM || !bound)
        return TN_OK;
    tn_status status = tn_depths_find(of->grammar, &of->analysis, s->depth_high, &of->depths, error);
    if (status != TN_OK)
        return status;
    of->ramp = calloc(s->depth_high + 1u, sizeof *of->ramp);
    if (!of->ramp)
        return tn_fail_memory(error);
    find_ramp(of);
    return TN_OK;
}

static tn_status first_tree(const codons *of, uint64_t number, tn_chance *chance, tn_genome *genome, tn_error *error)
{
    const tn_evolution_settings *s = &of->settings;
    tn_tree_options tree = {
        .depths = &of->depths,
        .max_depth = s->mapping.max_depth,
        .codon_limit = s->vary.codon_limit,
        .places = s->mapping.position_independent ? TN_PLACES_RANDOM : TN_PLACES_NONE,
        .tail = s->tail,
        .max_codons = s->vary.max_codons,
    };
    first_depths(of, number, &tree);
    return tn_random_tree(of->grammar, &of->analysis, 0, 1, &tree, chance, genome, error);
}

static tn_status first(void *place, uint64_t number, tn_chance *chance, tn_genome *genome, tn_birth *birth,
                       tn_error *error)
{
    const workplace *w = place;
    bool random = w->of->settings.initialisation == TN_INITIALISE_RANDOM;
    birth->kind = random ? TN_BIRTH_RANDOM : TN_BIRTH_TREE;
    return random ? first_codons(&w->of->settings, chance, genome, error)
                  : first_tree(w->of, number, chance, genome, error);
}

static tn_status breed(void *place, tn_chance *chance, const tn_parent parents[2], tn_genome *children[2],
                       uint8_t kinds[2], tn_error *error)
{
    const workplace *w = place;
    return tn_breed(w->breeder, &w->of->settings.vary, chance, parents, children, kinds, error);
}

static tn_status write(void *place, const tn_genome *genome, tn_written *written, tn_error *error)
{
    const workplace *w = place;
    tn_mapping mapping;
    tn_status status = tn_mapper_derive(tn_breeder_mapper(w->breeder), genome->codons, genome->count,
                                        &w->of->settings.mapping, &mapping, error);
    if (status != TN_OK)
        return status;
    *written = (tn_written){.sentence = "", .reason = mapping.reason};
    if (mapping.valid)
        written->sentence = tn_mapping_sentence(&mapping, &written->size);
    written->used = mapping.has_phenotype ? mapping.used : 0;
    written->depth = mapping.has_phenotype ? mapping.depth : 0;
    return TN_OK;
}

tn_status tn_codon_kind_new(const tn_grammar *grammar, const tn_evolution_settings *settings, tn_genome_kind *kind,
                            tn_error *error)
{
    codons *of = calloc(1, sizeof *of);
    *kind = (tn_genome_kind){.context = of,
                             .workplace_new = workplace_new,
                             .workplace_free = workplace_free,
                             .first = first,
                             .breed = breed,
                             .write = write};
    if (!of)
        return tn_fail_memory(error);
    of->grammar = grammar;
    of->settings = *settings;
    tn_status status = tn_analyse(grammar, &of->analysis, error);
    return status == TN_OK ? find_depths(of, error) : status;
}

void tn_codon_kind_vary(tn_genome_kind *kind, const tn_vary_options *vary)
{
    codons *of = kind->context;
    of->settings.vary = *vary;
}

void tn_codon_kind_free(tn_genome_kind *kind)
{
    codons *of = kind->context;
    if (of) {
        tn_analysis_clear(&of->analysis);
        tn_depths_clear(&of->depths);
        free(of->ramp);
    }
    free(of);
    kind->context = NULL;
}
