/* Opens what `grow` grows: the file, or the study that the options are, which uses it. */
#include <stdlib.h>

#include "cli/common/interrupt.h"
#include "cli/growth/grow.h"
#include "driver/open/files.h"
#include "driver/open/stdlib_find.h"

/* Compiles the study that the options are, which uses the file. */
static bool open_options(tn_job *job, const char *text, size_t size)
{
    tn_stdlib_dirs dirs;
    tn_files files;
    tn_error error;
    tn_status status = tn_stdlib_dirs_find(&dirs, &error);
    tn_files_begin(&files, &dirs);
    tn_compile_options options = {.resolver = tn_files_resolver(&files), .warnings_are_errors = job->settings->werror};
    if (status == TN_OK)
        tn_job_status(job,
                      tn_open_text(TN_NOTATION(study), &(tn_input){.text = text, .size = size, .name = "<options>"},
                                   &options, &job->opened));
    else
        tn_job_fail(job, &error);
    tn_files_clear(&files);
    tn_stdlib_dirs_clear(&dirs);
    if (job->opened.module)
        job->opened.module->watch = tn_interrupt_waiting();
    return job->opened.module != NULL;
}

static bool open_study(tn_job *job, const char *path, bool has_source, const char *text, size_t size)
{
    if (has_source)
        return open_options(job, text, size);
    if (!tn_job_open(job, path) || job->opened.module->GROWTH_count == 0)
        return job->opened.module != NULL;
    tn_diagnostic *d = tn_job_usage(job, "a module is grown as it was compiled");
    tn_help(tn_job_diagnostics(job), d, "for other steps, scales or surroundings name the .hemls or .study file");
    return false;
}

/* Is the file a rewrite system or a study, of which there is source? *rules: a rewrite system. */
static tn_status look_at(const char *path, bool *has_source, bool *rules, tn_error *error)
{
    tn_stdlib_file found = {0};
    tn_status status = tn_stdlib_may_mean(path) ? tn_stdlib_find(path, &found, error) : TN_OK;
    const tn_notation *notation = tn_notation_of(found.path ? found.recorded : path, "", 0);
    *has_source = notation && tn_notation_takes(notation, "grow");
    *rules = notation == TN_NOTATION(hemls);
    tn_stdlib_file_clear(&found);
    return status;
}

bool tn_grow_open(tn_job *job, const tn_grow_statements *said)
{
    const char *path = job->settings->operands.items[0];
    char *text = NULL;
    size_t size = 0;
    bool has_source, rules;
    tn_error error;
    tn_status status = look_at(path, &has_source, &rules, &error);
    if (status == TN_OK)
        status = tn_grow_study_text(said, path, rules, &text, &size, &error);
    if (status != TN_OK) {
        tn_job_fail(job, &error);
        return false;
    }
    bool opened = text ? open_study(job, path, has_source, text, size) : tn_job_open(job, path);
    free(text);
    return opened;
}
