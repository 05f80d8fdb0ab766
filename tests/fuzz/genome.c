/* Genomes, sentences to invert and CSV data: any text is read or refused with a place. */
#include <stdlib.h>

#include "runtime/genome/breeding/problem.h"
#include "runtime/genome/mapping/genome.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const char *text = (const char *)data;
    tn_genome genome = {0};
    tn_problem *problem;
    tn_error error;
    if (tn_genome_read(text, size, &genome, &error) == TN_INVALID && error.column == 0)
        abort();
    if (tn_problem_fit_csv(text, size, &(tn_fit_options){.threads = 1}, &problem, &error) == TN_OK)
        tn_problem_free(problem);
    tn_genome_clear(&genome);
    return 0;
}
