/* Gathers plans for a picture. */
#include "ask/plan/sheet.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "driver/open/again.h"
#include "runtime/base/array.h"

tn_status tn_sheet_add(tn_plan_sheet *s, const tn_tray *trays, size_t length, char *number, const char *heading,
                       char *caption, tn_error *error)
{
    tn_tray *copy = malloc(sizeof *copy * (length + 1));
    if (!copy || !number || !tn_array_reserve(&s->plans, &s->room, s->count, 1, sizeof *s->plans)) {
        free(copy);
        free(number);
        free(caption);
        return tn_fail_memory(error);
    }
    if (length)
        memcpy(copy, trays, sizeof *copy * length);
    s->plans[s->count++] = (tn_drawn_plan){copy, length, number, heading, caption};
    return TN_OK;
}

void tn_sheet_clear(tn_plan_sheet *s)
{
    for (size_t i = 0; i < s->count; i++) {
        free((tn_tray *)(uintptr_t)s->plans[i].trays);
        free((char *)(uintptr_t)s->plans[i].number);
        free((char *)(uintptr_t)s->plans[i].caption);
    }
    free(s->plans);
    *s = (tn_plan_sheet){0};
}

void tn_sheet_note_rules(const tn_opened *opened, char *note, size_t size)
{
    const tn_module *module = opened->module;
    const char *path = opened->path, *slash = strrchr(path, '/');
    const tn_producer_record *producer = module->PRODUCER_count ? &module->PRODUCER_records[0] : NULL;
    char params[160];
    tn_opened_params_text(opened, params, sizeof params);
    int used = snprintf(note, size, "%.160s%s%s", slash ? slash + 1 : path, params[0] ? " with " : "", params);
    if (producer && used >= 0 && (size_t)used < size)
        snprintf(note + used, size - (size_t)used, ", rules %016" PRIx64 ", %.60s", (uint64_t)producer->sources_hash,
                 tn_text(module, producer->version));
}
