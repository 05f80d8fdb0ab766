/* Plan lines and JSON lines of the LaHave schema from any bytes: what is read can be written, and reads back as the
 * same plan. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/plan/text/text.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/lahave.h"

enum { TRAYS = 64 };

typedef tn_status reader(const tn_schema *schema, const char *text, size_t size, size_t max_trays, tn_plan *plan,
                         tn_error *error);
typedef bool writer(const tn_schema *schema, const tn_tray *trays, size_t length, tn_buffer *out);

static void round_trip(const tn_schema *schema, const tn_plan *plan, reader *read, writer *write)
{
    tn_buffer text = {0};
    tn_plan again = {0};
    tn_error error;
    if (!write(schema, plan->trays, plan->length, &text))
        stop("a plan that was read cannot be written");
    if (read(schema, text.data ? text.data : "", text.size, TRAYS, &again, &error) != TN_OK)
        stop(error.message);
    if (again.length != plan->length ||
        (plan->length && memcmp(again.trays, plan->trays, plan->length * sizeof *plan->trays) != 0))
        stop("a plan reads back as another");
    free(text.data);
    free(again.trays);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const tn_schema *schema = lahave();
    reader *readers[] = {tn_plan_parse_line, tn_plan_parse_json};
    for (size_t i = 0; i < 2; i++) {
        tn_plan plan = {0};
        tn_error error;
        if (i == 0 && memchr(data, '\n', size))
            continue; /* a line holds none */
        if (readers[i](schema, (const char *)data, size, TRAYS, &plan, &error) == TN_OK) {
            round_trip(schema, &plan, tn_plan_parse_line, tn_plan_write_line);
            round_trip(schema, &plan, tn_plan_parse_json, tn_plan_write_json);
        }
        free(plan.trays);
    }
    return 0;
}
