/* Makes, breeds and maps strings of codons for evolution. */
#include "runtime/genome/breeding/codon_kind.h"

#include <stdlib.h>

typedef struct codons {
    const tn_grammar *grammar;
    tn_analysis analysis;
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

/* Ramped half and half: depths from low to high in turn, each both full and grown. */
static tn_status first_tree(const codons *of, uint64_t number, tn_chance *chance, tn_genome *genome, tn_error *error)
{
    const tn_evolution_settings *s = &of->settings;
    uint32_t steps = s->depth_high >= s->depth_low ? s->depth_high - s->depth_low + 1 : 1;
    bool ramped = s->initialisation == TN_INITIALISE_RAMPED;
    tn_tree_options tree = {
        .method = s->initialisation == TN_INITIALISE_PI_GROW ? TN_TREE_PI_GROW
                  : ramped && number % 2 == 0                ? TN_TREE_FULL
                                                             : TN_TREE_GROW,
        .depth = ramped ? s->depth_low + (uint32_t)(number / 2 % steps) : s->depth_high,
        .max_depth = s->mapping.max_depth,
        .codon_limit = s->vary.codon_limit,
        .places = s->mapping.position_independent ? TN_PLACES_RANDOM : TN_PLACES_NONE,
        .tail = s->tail,
        .max_codons = s->vary.max_codons,
    };
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
    return tn_analyse(grammar, &of->analysis, error);
}

void tn_codon_kind_vary(tn_genome_kind *kind, const tn_vary_options *vary)
{
    codons *of = kind->context;
    of->settings.vary = *vary;
}

void tn_codon_kind_free(tn_genome_kind *kind)
{
    codons *of = kind->context;
    if (of)
        tn_analysis_clear(&of->analysis);
    free(of);
    kind->context = NULL;
}
