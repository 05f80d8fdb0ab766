/* Reads files of plans for the fuzz targets. */
#include "tests/fuzz/read_plans.h"

#include "driver/parquet/parquet.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/lahave.h"

enum { TRAYS = 16, LINE_BYTES = 400, PLANS = 2000 };

void read_plans(const char *path, tn_plan_format format)
{
    const tn_schema *schema = lahave();
    tn_plan_reader *reader = NULL;
    tn_error error;
    mpz_t rank;
    mpz_init(rank);
    tn_reader_options options = {
        .format = format, .max_length = TRAYS, .max_line = LINE_BYTES, .parquet = tn_plan_parquet_calls()};
    tn_status opened = tn_plan_reader_open(schema, path, &options, &reader, &error);
    for (size_t n = 0; opened == TN_OK && n < PLANS; n++) {
        const tn_plan *plan = NULL;
        tn_status status = tn_plan_reader_next(reader, &plan, &error);
        if (status == TN_OK && !plan)
            break;
        if (status != TN_OK && error.column > 0 && (error.line == 0 || error.column_end < error.column))
            stop("an error has no place");
        for (size_t k = 0; plan && k < plan->length; k++) {
            if (plan->trays[k] >= schema->tray_count || plan->length > TRAYS)
                stop("a plan is not of the schema");
        }
        tn_plan_reader_rank(reader, rank);
    }
    tn_plan_reader_free(reader);
    mpz_clear(rank);
}
