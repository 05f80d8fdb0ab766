/* Counts the buildings of a kit's parts. */
#include "cli/place/count_kit.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "driver/place/kit.h"
#include "runtime/base/json.h"
#include "runtime/place/count/count.h"
#include "runtime/place/joints.h"

bool tn_job_asks_kit(tn_job *job, const tn_count_kit_options *options)
{
    const char *option = options->parts.given   ? "parts"
                         : options->fixed       ? "fixed"
                         : options->inside      ? "inside"
                         : options->kinds.count ? "part"
                                                : NULL;
    if (option)
        tn_job_usage(job, "--%s is about a kit, and %.200s is none", option, job->settings->operands.items[0]);
    return option != NULL;
}

/* Which parts of the kit are named; *wanted: NULL where none is, so that all are. */
static bool choose_parts(tn_job *job, const tn_option_list *kinds, bool **wanted)
{
    const tn_module *module = job->opened.module;
    tn_error error;
    *wanted = NULL;
    if (kinds->count == 0)
        return true;
    *wanted = calloc((size_t)module->KIT_PART_count + 1, sizeof **wanted);
    if (!*wanted) {
        tn_fail_memory(&error);
        tn_job_fail(job, &error);
        return false;
    }
    for (size_t i = 0; i < kinds->count; i++) {
        const tn_kit_part_record *part = tn_kit_part_named(module, kinds->items[i]);
        if (!part) {
            tn_fail(&error, TN_INVALID, E_KIT_UNKNOWN, "the kit has no part `%.100s`", kinds->items[i]);
            tn_error_help(&error, "--part takes the name of one of its parts, such as %.100s",
                          tn_text(module, module->KIT_PART_records[0].name));
            tn_job_fail(job, &error);
            free(*wanted);
            *wanted = NULL;
            return false;
        }
        (*wanted)[part - module->KIT_PART_records] = true;
    }
    return true;
}

static void write_counts(const tn_count_kit_options *options, const tn_building_counts *counts, FILE *out)
{
    if (!options->json) {
        fprintf(out, "%" PRIu64 "\n", options->fixed || options->inside ? counts->fixed : counts->buildings);
        return;
    }
    tn_json json = tn_json_file(out, TN_JSON_TIGHT);
    tn_json_object(&json, NULL);
    tn_json_count(&json, "parts", options->parts.value);
    if (options->inside) {
        tn_json_count(&json, "inside", counts->fixed);
    } else if (options->fixed) {
        tn_json_count(&json, "fixed", counts->fixed);
    } else {
        tn_json_count(&json, "buildings", counts->buildings);
        tn_json_count(&json, "fixed", counts->fixed);
        tn_json_count(&json, "half_turn", counts->half);
        tn_json_count(&json, "quarter_turn", counts->quarter);
    }
    tn_json_object_end(&json);
    tn_json_end_line(&json);
}

bool tn_job_kit_space(tn_job *job, const char *name, tn_place_rules *rules)
{
    tn_error error;
    uint32_t model;
    tn_status status = tn_kit_choose(&job->opened, name, &model);
    tn_job_status(job, status);
    if (status != TN_OK)
        return false;
    status = tn_place_rules_of_model(job->opened.module, model, rules, &error);
    if (status == TN_OK)
        return true;
    tn_place_rules_clear(rules);
    tn_job_fail(job, &error);
    return false;
}

static bool has_parts(tn_job *job)
{
    tn_error error;
    if (job->opened.module->KIT_PART_count > 0)
        return true;
    tn_fail(&error, TN_INVALID, E_KIT_UNKNOWN, "the kit has no parts to count buildings of");
    tn_error_help(&error, "tell them by `part 3005 { ... }`, or `use \"bricks\";`");
    tn_job_fail(job, &error);
    return false;
}

bool tn_job_kit_parts(tn_job *job, const tn_count_kit_options *options, bool **wanted)
{
    *wanted = NULL;
    if (!options->parts.given) {
        tn_diagnostic *d = tn_job_usage(job, "of a kit, buildings of so many parts are counted");
        tn_help(tn_job_diagnostics(job), d, "say how many: --parts 3");
        return false;
    }
    if (options->inside && options->fixed) {
        tn_job_usage(job,
                     "--fixed and --inside do not go together: inside of a space each building counts where it stands");
        return false;
    }
    return has_parts(job) && choose_parts(job, &options->kinds, wanted);
}

/* Which parts lie on the lattice, the model that is named says. */
static tn_status count(tn_job *job, const tn_count_kit_options *options, const tn_place_rules *rules,
                       const bool *wanted, tn_building_counts *counts, tn_error *error)
{
    uint32_t parts = (uint32_t)options->parts.value;
    tn_watch *watch = tn_interrupt_waiting();
    tn_job_show(job);
    if (options->inside)
        return tn_count_inside(rules, wanted, parts, options->threads, watch, &counts->fixed, error);
    return tn_count_buildings(rules, wanted, parts, options->fixed, options->threads, watch, counts, error);
}

void tn_job_count_kit(tn_job *job, const tn_count_kit_options *options, const char *path)
{
    tn_place_rules rules = {.module = job->opened.module};
    tn_building_counts counts;
    tn_output output;
    tn_error error;
    bool *wanted;
    if (!tn_job_kit_parts(job, options, &wanted))
        return;
    if (!options->inside || tn_job_kit_space(job, options->inside, &rules)) {
        if (count(job, options, &rules, wanted, &counts, &error) != TN_OK) {
            tn_job_fail(job, &error);
        } else if (tn_job_output(job, path, &output)) {
            write_counts(options, &counts, output.stream);
            tn_job_commit(job, &output);
        }
    }
    if (options->inside)
        tn_place_rules_clear(&rules);
    free(wanted);
}
