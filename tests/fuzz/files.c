/* Files of plans from any bytes: plan lines, JSON lines, CSV, packed plans (with the schema's hash made right, so that
 * what is behind it is reached) and SQLite libraries. Whatever is read is legal, and reads on after an error of one
 * plan. */
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "runtime/base/bytes.h"
#include "runtime/plan/text/pack.h"
#include "runtime/plan/text/stream.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/lahave.h"

enum { TRAYS = 16, LINE_BYTES = 400, PLANS = 2000 };

static void read_plans(const char *path, tn_plan_format format)
{
    const tn_schema *schema = lahave();
    tn_plan_reader *reader = NULL;
    tn_error error;
    mpz_t rank;
    mpz_init(rank);
    tn_reader_options options = {.format = format, .max_length = TRAYS, .max_line = LINE_BYTES};
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

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    int file = memfd_create("plans", MFD_CLOEXEC);
    if (file < 0 || write(file, data, size) != (ssize_t)size)
        stop("no file in memory");
    if (size >= TN_PACK_HEADER && memcmp(data, TN_PACK_MAGIC, 8) == 0) {
        uint8_t right[16];
        tn_put_u32(right, TN_PACK_VERSION);
        tn_put_u32(right + 4, tn_pack_tray_bytes(lahave()));
        tn_put_u64(right + 8, tn_pack_schema_hash(lahave()));
        if (pwrite(file, right, sizeof right, 8) != (ssize_t)sizeof right)
            stop("no file in memory");
    }
    char path[64];
    snprintf(path, sizeof path, "/proc/self/fd/%d", file);
    read_plans(path, TN_FORMAT_AUTO);
    read_plans(path, TN_FORMAT_CSV);
    close(file);
    return 0;
}
