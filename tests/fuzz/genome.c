/* Genomes, sentences to invert, CSV data and expressions: any text is read or refused with a place. */
#include <stdlib.h>
#include <string.h>

#include "runtime/genome/breeding/problem.h"
#include "runtime/genome/mapping/genome.h"
#include "runtime/number/expression.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const char *text = (const char *)data;
    static const char *const names[] = {"x0", "y"};
    static double values[TN_EXPRESSION_ROW], column[TN_EXPRESSION_ROW];
    const double *const columns[] = {column, column};
    tn_genome genome = {0};
    tn_expression expression = {0};
    tn_problem *problem;
    tn_error error;
    if (tn_genome_read(text, size, &genome, &error) == TN_INVALID && error.column == 0)
        abort();
    if (tn_expression_parse(text, size, names, 2, &expression, &error) == TN_OK)
        tn_expression_evaluate(&expression, columns, 1, values, NULL);
    if (tn_problem_fit_csv(text, size, 1, &problem, &error) == TN_OK)
        tn_problem_free(problem);
    tn_expression_clear(&expression);
    tn_genome_clear(&genome);
    return 0;
}
