/* Breeds trees of fields for evolution. */
#include "runtime/genome/tree/tree_kind.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/buffer.h"
#include "runtime/module/values.h"

#define NAME "bred"

typedef struct workplace {
    const tn_tree_breeding *of;
    tn_gene_tree parents[2], children[2], spare;
    char *text;
    size_t size;
} workplace;

static void *workplace_new(const void *context)
{
    workplace *w = calloc(1, sizeof *w);
    if (w)
        w->of = context;
    return w;
}

static void workplace_free(void *place)
{
    workplace *w = place;
    if (!w)
        return;
    for (int i = 0; i < 2; i++) {
        tn_gene_tree_clear(&w->parents[i]);
        tn_gene_tree_clear(&w->children[i]);
    }
    tn_gene_tree_clear(&w->spare);
    free(w->text);
    free(w);
}

/* ---- breeding */

static tn_status breed(void *place, tn_chance *chance, const tn_parent parents[2], tn_genome *children[2],
                       uint8_t kinds[2], tn_error *error)
{
    workplace *w = place;
    const tn_tree_variation *how = &w->of->how;
    const double weights[2] = {parents[0].weight, parents[1].weight};
    bool crossed[2] = {false, false};
    tn_status status = TN_OK;
    for (int i = 0; i < 2 && status == TN_OK; i++)
        status = tn_gene_tree_read(parents[i].genome, w->of->constant_count, &w->parents[i], error);
    if (status == TN_OK)
        status = tn_tree_cross(how, chance, w->parents, weights, w->children, crossed, error);
    for (int i = 0; i < 2 && status == TN_OK; i++) {
        bool mutated;
        status = tn_tree_mutate(how, chance, &w->children[i], &w->spare, &mutated, error);
        if (status == TN_OK)
            status = tn_gene_tree_write(&w->children[i], children[i], error);
        kinds[i] = (uint8_t)((crossed[i] ? TN_BIRTH_CROSSED : TN_BIRTH_CLONE) | (mutated ? TN_BIRTH_MUTATED : 0));
    }
    return status;
}

/* Two places among the parents, different ones where there are several. */
static void draw_parents(const tn_tree_breeding *of, tn_chance *chance, size_t drawn[2])
{
    size_t count = of->parent_count;
    drawn[0] = (size_t)tn_chance_below(chance, count);
    drawn[1] = count > 1 ? (drawn[0] + 1 + (size_t)tn_chance_below(chance, count - 1)) % count : drawn[0];
}

/* Those that are no parents are children of them, two and two of one crossing, which depends on their pair alone. */
static tn_status first(void *place, uint64_t number, tn_chance *chance, tn_genome *genome, tn_birth *birth,
                       tn_error *error)
{
    workplace *w = place;
    const tn_tree_breeding *of = w->of;
    uint64_t child = number - of->parent_count;
    size_t drawn[2];
    uint8_t kinds[2];
    *chance = tn_chance_for(chance->seed, TN_PURPOSE_INITIALISE, 1, child / 2);
    draw_parents(of, chance, drawn);
    tn_parent parents[2];
    for (int i = 0; i < 2; i++)
        parents[i] = (tn_parent){&of->parents[drawn[i]], 0, of->weights[drawn[i]]};
    tn_genome other = {0};
    tn_genome *children[2] = {child % 2 ? &other : genome, child % 2 ? genome : &other};
    tn_status status = breed(w, chance, parents, children, kinds, error);
    birth->kind = kinds[child % 2];
    birth->parents[0] = drawn[child % 2];
    birth->parents[1] = drawn[1 - child % 2];
    tn_genome_clear(&other);
    return status;
}

/* ---- sentences */

static bool uses(const tn_gene_tree *tree, uint32_t constant)
{
    for (uint32_t i = 0; i < tree->count; i++)
        if (tree->nodes[i].symbol == TN_GENE_CONSTANT && tree->nodes[i].value == constant)
            return true;
    return false;
}

static bool is_constant(const tn_tree_breeding *of, const char *name)
{
    for (uint32_t i = 0; i < of->constant_count; i++)
        if (strcmp(of->constants[i].name, name) == 0)
            return true;
    return false;
}

/* A constant may have the name that bred surfaces have; then they get another. */
static void name_surface(const tn_tree_breeding *of, char name[24])
{
    strcpy(name, NAME);
    for (unsigned i = 2; is_constant(of, name); i++)
        snprintf(name, 24, NAME "_%u", i);
}

/* The language takes no numbers past TN_COORDINATE_MAX, but quotients of its numbers pass it: a power of two divides
 * without rounding. */
static void print_constant(const tn_gene_constant *constant, FILE *out)
{
    char number[TN_NUMBER_TEXT_SIZE];
    int exponent = 0;
    double value = constant->value;
    bool large = fabs(value) > TN_COORDINATE_MAX;
    if (large)
        value = frexp(value, &exponent);
    fprintf(out, "let %s = %s", constant->name, tn_number_text(value, number));
    if (large)
        fprintf(out, " / %s", tn_number_text(ldexp(1, -exponent), number));
    fputc('\n', out);
}

static void print(const workplace *w, const tn_gene_tree *tree, FILE *out)
{
    const tn_tree_breeding *of = w->of;
    for (uint32_t i = 0; i < of->constant_count; i++)
        if (uses(tree, i))
            print_constant(&of->constants[i], out);
    char name[24];
    name_surface(of, name);
    int column = fprintf(out, "surface %s = ", name);
    tn_gene_tree_print(out, tree, of->constants, column > 0 ? (size_t)column : 0);
    fprintf(out, "\n%s", of->footer);
}

static tn_status write(void *place, const tn_genome *genome, tn_written *written, tn_error *error)
{
    workplace *w = place;
    tn_gene_tree *tree = &w->parents[0];
    tn_status status = tn_gene_tree_read(genome, w->of->constant_count, tree, error);
    if (status != TN_OK)
        return status;
    free(w->text);
    w->text = NULL;
    FILE *out = open_memstream(&w->text, &w->size);
    if (!out)
        return tn_fail_memory(error);
    print(w, tree, out);
    bool printed = !ferror(out);
    if (fclose(out) != 0 || !printed)
        return tn_fail_memory(error);
    *written = (tn_written){
        .sentence = w->text, .size = w->size, .used = tree->count, .depth = tree->height, .reason = TN_MAPPING_VALID};
    return TN_OK;
}

tn_genome_kind tn_tree_kind(tn_tree_breeding *breeding)
{
    return (tn_genome_kind){.context = breeding,
                            .workplace_new = workplace_new,
                            .workplace_free = workplace_free,
                            .first = first,
                            .breed = breed,
                            .write = write,
                            .weighs = true,
                            .parents_stay = true};
}
