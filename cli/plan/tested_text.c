/* Writes how tests come out. */
#include "cli/plan/tested_text.h"

#include <inttypes.h>

#include "runtime/base/bytes.h"

void tn_tested_counts_text(const tn_tested *tested, FILE *out)
{
    fprintf(out, "%" PRIu64 " passed, %" PRIu64 " failed", tested->passed, tested->failed);
    if (tested->todo)
        fprintf(out, ", %" PRIu64 " to do", tested->todo);
    fputc('\n', out);
}

void tn_tested_designs_text(const tn_tested *tested, FILE *out)
{
    for (size_t i = 0; i < tested->solids.count; i++) {
        const tn_tested_design *design = &tested->solids.items[i];
        if (design->measures.count > 0)
            fprintf(out, "%s\n", design->name);
        for (size_t k = 0; k < design->measures.count; k++)
            fprintf(out, "  %-16s %.10g\n", design->measures.items[k].name,
                    tn_without_sign(design->measures.items[k].value));
    }
}
