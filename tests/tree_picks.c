/* Picks nodes of trees for tree_oracle.py. Each line of the input is "ORDER MAXPROB SEED DRAWS TOKEN ...", the tokens
 * of a genome; each line of the output has the nodes that were picked. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/genome/tree/gene_tree.h"

int main(void)
{
    char *line = NULL;
    size_t capacity = 0;
    while (getline(&line, &capacity, stdin) > 0) {
        unsigned order;
        double maxprob;
        uint64_t seed;
        int draws, at;
        tn_genome genome = {0};
        tn_gene_tree tree = {0};
        tn_error error;
        line[strcspn(line, "\n")] = '\0';
        if (sscanf(line, "%u %lf %" SCNu64 " %d %n", &order, &maxprob, &seed, &draws, &at) != 4 ||
            tn_genome_read(line + at, strlen(line + at), &genome, &error) != TN_OK ||
            tn_gene_tree_read(&genome, 0, &tree, &error) != TN_OK)
            return 1;
        tn_chance chance = tn_chance_for(seed, TN_PURPOSE_BIRTH, 0, 0);
        for (int i = 0; i < draws; i++)
            printf("%u ", tn_pick_node(&tree, (tn_pick_order)order, maxprob, TN_PICK_ANY, &chance));
        putchar('\n');
        tn_gene_tree_clear(&tree);
        tn_genome_clear(&genome);
    }
    free(line);
    return 0;
}
