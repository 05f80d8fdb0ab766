/* tartan disasm: lists what a rule file was compiled to. */
#include "runtime/load.h"
#include <stdlib.h>

#include "cli/common/job.h"
#include "cli/common/options.h"
#include "driver/plan/library.h"
#include "runtime/number/tape.h"

typedef struct disasm_settings {
    tn_settings common;
    tn_option_list rules;
    const char *output;
    bool tape;
} disasm_settings;

static const disasm_settings *settings_of(const tn_job *job)
{
    return (const disasm_settings *)job->settings;
}

/* Finds the rules of --rule; `rules` has room for them. */
static bool choose_rules(tn_job *job, uint32_t *rules)
{
    const tn_option_list *asked = &settings_of(job)->rules;
    tn_error error;
    if (!rules) {
        tn_fail_memory(&error);
        tn_job_fail(job, &error);
        return false;
    }
    for (size_t i = 0; i < asked->count; i++)
        tn_job_status(job, tn_rule_choose(&job->opened, asked->items[i], &rules[i]));
    return job->exit_code == TN_EXIT_DONE;
}

/* False, with the reason reported, where memory ran out; what fails to be written shows when the output is closed. */
static bool write_listing(tn_job *job, const uint32_t *rules, FILE *out)
{
    const tn_module *module = job->opened.module;
    bool listed = true;
    for (size_t i = 0; i < settings_of(job)->rules.count && listed; i++)
        listed = tn_module_disassemble_rule(module, rules[i], out);
    if (settings_of(job)->rules.count == 0)
        listed = tn_module_disassemble(module, out);
    if (listed || ferror(out))
        return true;
    tn_error error;
    tn_fail_memory(&error);
    tn_job_fail(job, &error);
    return false;
}

/* The tapes of all fields. */
static bool write_tapes(tn_job *job, FILE *out)
{
    const tn_module *module = job->opened.module;
    tn_error error;
    size_t listed = 0;
    for (size_t i = 0; i < module->FUNCTION_count; i++) {
        const tn_function_record *function = &module->FUNCTION_records[i];
        if (function->kind != TN_FUNCTION_FIELD)
            continue;
        fprintf(out, listed++ ? "\n%s\n" : "%s\n", tn_text(module, function->name));
        if (tn_tape_list(module->code, function->code_begin, out, &error) != TN_OK) {
            tn_job_fail(job, &error);
            return false;
        }
    }
    if (listed > 0)
        return true;
    tn_fail(&error, TN_INVALID, E_NO_SURFACE, "%.200s has no surface", job->opened.path);
    tn_error_help(&error, "only fields are lowered to tapes; without --tape all code is listed");
    tn_job_fail(job, &error);
    return false;
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const disasm_settings *settings = (const disasm_settings *)common;
    tn_job job;
    tn_output output;
    uint32_t *rules = malloc(sizeof *rules * (settings->rules.count + 1));
    tn_job_begin(&job, common);
    if (settings->tape && settings->rules.count)
        tn_job_usage(&job, "--tape lists fields, which have no rules: leave out --rule");
    else if (tn_job_open(&job, common->operands.items[0]) && choose_rules(&job, rules) &&
             tn_job_output(&job, settings->output, &output)) {
        bool complete = settings->tape ? write_tapes(&job, output.stream) : write_listing(&job, rules, output.stream);
        tn_job_close(&job, &output, complete);
    }
    free(rules);
    return tn_job_end(&job);
}

#define SETTINGS disasm_settings
static const tn_option options[] = {
    LIST("rule", 'r', "NAME", rules, "list only this rule and the functions it needs; may be repeated"),
    FLAG("tape", 0, tape, "list what the code of fields is lowered to: steps on rows of numbers"),
    OPTION_SET,
    OPTION_LDRAW,
    OPTION_OUTPUT(TN_WRITES_TEXT),
};

const tn_command tn_command_disasm = {
    .name = "disasm",
    .summary = "list the bytecode of a rule file or module",
    .usage = "FILE [--rule NAME]... [-o FILE.txt]\nFILE.field --tape [-o FILE.txt]",
    .description =
        "Lists the tables of a module, and each function's bytecode beside the source lines that it comes from. "
        "Takes a rule file, which is compiled first, or a module.",
    .example = "$ tartan disasm houses.plan | less",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "one FILE",
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
