/* Trees of fields that are bred, as a run's database keeps them: any text is refused or gives trees, which stay trees
 * however they are crossed and mutated, and are printed. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "driver/breed/field_parents.h"
#include "tests/fuzz/fuzz.h"

enum { ROUNDS = 8, LARGEST = 2000 };

static void check(bool holds)
{
    if (!holds)
        abort();
}

/* What a tree is written as must read back as it is. */
static void check_tree(const tn_gene_tree *tree, const tn_tree_breeding *breeding)
{
    tn_genome genome = {0};
    tn_gene_tree again = {0};
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (out && tn_gene_tree_write(tree, &genome, NULL) == TN_OK) {
        check(tn_gene_tree_read(&genome, breeding->constant_count, &again, NULL) == TN_OK);
        check(again.count == tree->count && again.height == tree->height);
        tn_gene_tree_print(out, tree, breeding->constants, 0);
    }
    if (out)
        fclose(out);
    free(text);
    tn_genome_clear(&genome);
    tn_gene_tree_clear(&again);
}

static void breed(const tn_gene_tree parents[2], const tn_tree_breeding *breeding, uint64_t round)
{
    tn_tree_variation how = {.order = (tn_pick_order)(round % 3),
                             .maxprob = 0.2,
                             .mutation_rate = 1,
                             .shares = {3, 3, 2, 2},
                             .max_nodes = 3000};
    tn_chance chance = tn_chance_for(1, TN_PURPOSE_BIRTH, 0, round);
    tn_gene_tree children[2] = {{0}, {0}}, spare = {0};
    bool crossed[2], mutated;
    if (tn_tree_cross(&how, &chance, parents, (double[2]){1, 0.4}, children, crossed, NULL) == TN_OK)
        for (int i = 0; i < 2; i++) {
            check_tree(&children[i], breeding);
            if (tn_tree_mutate(&how, &chance, &children[i], &spare, &mutated, NULL) == TN_OK)
                check_tree(&children[i], breeding);
        }
    tn_gene_tree_clear(&children[0]);
    tn_gene_tree_clear(&children[1]);
    tn_gene_tree_clear(&spare);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *text = malloc(size + 1);
    tn_field_parents *parents = NULL;
    tn_error error;
    check(text != NULL);
    memcpy(text, data, size);
    text[size] = '\0';
    if (tn_field_parents_of(text, &parents, &error) == TN_OK) {
        const tn_tree_breeding *breeding = tn_field_parents_breeding(parents);
        for (size_t i = 0; i < breeding->parent_count; i++) {
            tn_gene_tree pair[2] = {{0}, {0}};
            const tn_genome *second = &breeding->parents[(i + 1) % breeding->parent_count];
            bool read = tn_gene_tree_read(&breeding->parents[i], breeding->constant_count, &pair[0], NULL) == TN_OK &&
                        tn_gene_tree_read(second, breeding->constant_count, &pair[1], NULL) == TN_OK;
            for (uint64_t round = 0; read && round < ROUNDS && pair[0].count + pair[1].count < LARGEST; round++)
                breed(pair, breeding, round);
            tn_gene_tree_clear(&pair[0]);
            tn_gene_tree_clear(&pair[1]);
        }
    }
    tn_field_parents_free(parents);
    free(text);
    return 0;
}
