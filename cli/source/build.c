/* tartan build: compiles a rule file to a module. */
#include <stdlib.h>
#include <string.h>

#include "cli/common/job.h"
#include "cli/common/options.h"

typedef struct build_settings {
    tn_settings common;
    const char *output;
} build_settings;

/* houses.plan -> houses.tnb, in the folder where we are called; the caller frees it. NULL where out of memory. */
static char *default_output(const char *path)
{
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path, *dot = strrchr(base, '.');
    size_t stem = dot && dot != base ? (size_t)(dot - base) : strlen(base);
    char *name = malloc(stem + sizeof ".tnb");
    if (name) {
        memcpy(name, base, stem);
        memcpy(name + stem, ".tnb", sizeof ".tnb");
    }
    return name;
}

static void write_module(tn_job *job, const char *path)
{
    const tn_compilation *compilation = &job->opened.compilation;
    tn_output output;
    if (!tn_job_output(job, path, &output))
        return;
    fwrite(compilation->module, 1, compilation->module_size, output.stream);
    tn_job_commit(job, &output);
}

static void build(tn_job *job, const char *path, const char *output)
{
    char *name = NULL;
    if (!job->opened.compiled) {
        tn_job_usage(job, "%.200s is a module already", path);
        return;
    }
    if (!output)
        output = name = default_output(strcmp(path, "-") == 0 ? "stdin" : path);
    if (output) {
        write_module(job, output);
    } else {
        tn_error error;
        tn_fail_memory(&error);
        tn_job_fail(job, &error);
    }
    free(name);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const build_settings *settings = (const build_settings *)common;
    const char *path = common->operands.items[0];
    tn_job job;
    tn_job_begin(&job, common);
    if (tn_job_open_joined(&job, common->operands.items, common->operands.count))
        build(&job, path, settings->output);
    return tn_job_end(&job);
}

#define SETTINGS build_settings
static const tn_option options[] = {OPTION_OUTPUT_BY(TN_WRITES(TNB) | TN_WRITES_TEXT, ", which is usually called .tnb"),
                                    OPTION_SET, OPTION_LDRAW, OPTION_WERROR};

const tn_command tn_command_build = {
    .name = "build",
    .summary = "compile a rule file to a module",
    .usage = "FILE.plan [-o FILE.tnb]\nFILE.pcfg... [-o FILE.tnb]",
    .description =
        "Compiles the rule file and all files that it uses to one module of bytecode. Every other command takes a "
        "module in place of a rule file. Without -o the module is named after the rule file and written to the "
        "current folder. Several connection grammars (.pcfg) are one grammar, in the order given.",
    .example = "$ tartan build houses.plan -o houses.tnb\n$ tartan count houses.tnb",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "at least one FILE",
    .operands_min = 1,
    .operands_max = SIZE_MAX,
    .run = run,
};
