/* Says how a file of plans was made. */
#include "driver/plan/provenance.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void describe(const tn_opened *opened, const tn_library *library, const char *name, const char *rules_path,
                     const char *command, tn_provenance *provenance)
{
    const tn_module *module = opened->module;
    const tn_producer_record *producer = module->PRODUCER_count ? &module->PRODUCER_records[0] : NULL;
    *provenance = (tn_provenance){0};
    if (library)
        tn_library_hash(library, provenance->library_hash);
    tn_opened_params_text(opened, provenance->params, sizeof provenance->params);
    if (producer)
        snprintf(provenance->rules_hash, sizeof provenance->rules_hash, "%016" PRIx64,
                 (uint64_t)producer->sources_hash);
    provenance->metadata = (tn_plan_metadata){.library = name,
                                              .library_hash = provenance->library_hash,
                                              .rules_hash = provenance->rules_hash,
                                              .rules_path = rules_path,
                                              .version = producer ? tn_text(module, producer->version) : NULL,
                                              .command = command,
                                              .params = provenance->params[0] ? provenance->params : NULL};
}

void tn_provenance_describe(const tn_opened *opened, const tn_ready_library *ready, const char *rules_path,
                            const char *command, tn_provenance *provenance)
{
    describe(opened, ready->library, tn_text(opened->module, ready->record->name), rules_path, command, provenance);
    if (!ready->library)
        snprintf(provenance->library_hash, sizeof provenance->library_hash, "-%s", provenance->rules_hash);
}

void tn_provenance_describe_houses(const tn_opened *opened, const tn_library *plans, const char *name,
                                   const char *rules_path, const char *command, tn_provenance *provenance)
{
    describe(opened, plans, name, rules_path, command, provenance);
    size_t used = strlen(provenance->library_hash);
    snprintf(provenance->library_hash + used, sizeof provenance->library_hash - used, "-%s", provenance->rules_hash);
}

char *tn_enumerated_words(const tn_enumerated *asked)
{
    tn_buffer words = {0};
    bool done = tn_buffer_printf(&words, "enumerate --from %s", asked->from ? asked->from : "0");
    if (done && asked->to && *asked->to)
        done = tn_buffer_printf(&words, " --to %s", asked->to);
    if (done && asked->mirror)
        done = tn_buffer_printf(&words, " --mirror");
    if (done && asked->trays_given)
        done = tn_buffer_printf(&words, " --trays %" PRIu64 "..%" PRIu64, asked->trays_min, asked->trays_max);
    if (done && asked->plan)
        done = tn_buffer_printf(&words, " --plan %s", asked->plan);
    for (size_t i = 0; done && i < asked->where_count; i++)
        done = tn_buffer_printf(&words, " --where %s", asked->wheres[i]);
    if (done)
        return words.data;
    free(words.data);
    return NULL;
}
