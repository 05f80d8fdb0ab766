/* Expressions of any text, as sentences of `fit` and as goals of studies: read or refused with a place; what is read
 * gives the same bits by rows and point by point, and what a study holds loads. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/bytes.h"
#include "runtime/growth/model/system.h"
#include "runtime/load.h"
#include "runtime/number/formula.h"
#include "runtime/number/run.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/text.h"

static const double points[] = {0, -0.0, 1, -2.5, 1e300, 1e-300, INFINITY, NAN};
enum { POINTS = sizeof points / sizeof *points, NAMES = TN_MEASURED_COUNT };

static bool same(double a, double b)
{
    return (isnan(a) && isnan(b)) || tn_bits_of(a) == tn_bits_of(b);
}

/* Term t at point i. */
static double term_at(size_t t, size_t i)
{
    return points[(i * (t + 1) + t) % POINTS];
}

static void run(const uint8_t *code, uint32_t offset, size_t depth)
{
    static double columns[NAMES][TN_ROW], values[TN_ROW];
    const double *pointers[NAMES];
    tn_number_rows rows = {0};
    for (size_t t = 0; t < NAMES; t++) {
        pointers[t] = columns[t];
        for (size_t i = 0; i < TN_ROW; i++)
            columns[t][i] = term_at(t, i);
    }
    if (tn_number_run_rows(&rows, code, offset, depth, pointers, POINTS, values, NULL) != TN_OK)
        abort();
    for (size_t i = 0; i < POINTS && depth <= TN_MEASURE_STACK_MAX; i++) {
        double terms[NAMES];
        for (size_t t = 0; t < NAMES; t++)
            terms[t] = term_at(t, i);
        if (!same(tn_number_run(code, offset, terms), values[i]))
            abort();
    }
    tn_number_rows_clear(&rows);
}

static void sentence(const char *text, size_t size)
{
    tn_formula formula = {0};
    tn_error error = {0};
    tn_status status = tn_sentence_read(text, size, tn_names_MEASURED, NAMES, &formula, &error);
    if (status == TN_OK)
        run(formula.code, 0, formula.depth);
    else if (status == TN_INVALID && error.column == 0)
        abort();
    tn_formula_clear(&formula);
}

static void goal(const char *text, size_t size)
{
    static const char head[] = "rules \"square\"\nfitness x = ";
    static const char *const stdlib_dir = TARTAN_SOURCE_DIR "/stdlib";
    static const library_folders options = {.stdlib_dirs = &stdlib_dir, .stdlib_dir_count = 1};
    char *study = malloc(sizeof head + size);
    if (!study)
        return;
    memcpy(study, head, sizeof head - 1);
    memcpy(study + sizeof head - 1, text, size);
    tn_compilation c;
    tn_diagnostics_init(&c.diagnostics, &c.sources);
    tn_status status = compile_text("fuzz.study", study, sizeof head - 1 + size, &options, &c);
    if (status == TN_OK) {
        tn_module *module;
        tn_error error;
        if (tn_module_load(c.module, c.module_size, NULL, &module, &error) != TN_OK)
            abort();
        for (size_t i = 0; i < module->FUNCTION_count; i++)
            if (module->FUNCTION_records[i].kind == TN_FUNCTION_MEASURE)
                run(module->code, module->FUNCTION_records[i].code_begin, module->FUNCTION_records[i].stack_max);
        tn_module_free(module);
    } else if (c.diagnostics.error_count == 0) {
        abort();
    }
    tn_compilation_clear(&c);
    free(study);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    sentence((const char *)data, size);
    if (!names_a_path(data, size))
        goal((const char *)data, size);
    return 0;
}
