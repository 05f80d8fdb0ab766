/* Writes models that were drawn as rules. */
#include "cli/place/export_drawn.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "driver/open/files.h"
#include "driver/place/drawn.h"

bool tn_path_is_drawn(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot && (strcasecmp(dot, ".ldr") == 0 || strcasecmp(dot, ".mpd") == 0 || strcasecmp(dot, ".dat") == 0);
}

/* ---- what is said */

static void warn(tn_job *job, size_t count, tn_code code, const char *what, const char *help)
{
    if (count == 0)
        return;
    tn_diagnostics *list = tn_job_diagnostics(job);
    tn_help(list, tn_report_bare(list, TN_WARNING, code, "%s: %zu part%s", what, count, count == 1 ? "" : "s"), "%s",
            help);
}

static void warn_left_out(tn_job *job, size_t count, const char *first, const char *why)
{
    char what[200];
    snprintf(what, sizeof what, "left out, the first a %.60s: %s", first ? first : "", why);
    warn(job, count, W_DRAWN_LOST, what, "`tartan inspect` says more of the model");
}

static void warn_of_changes(tn_job *job, const tn_drawn_changes *changes, bool kit)
{
    warn(job, changes->moved, W_DRAWN_MOVED, "moved to the cells of connection grammars, 10 x 8 x 10 LDU",
         "a kit may have smaller cells: --kit");
    warn(job, changes->turned, W_DRAWN_MOVED, "turned otherwise than in the file",
         "connection grammars turn by quarters about the vertical, which the file writes as whole numbers: 0, 1, -1");
    warn(job, changes->renamed, W_DRAWN_LOST, "each r is left out of the name", "--kit keeps it");
    if (changes->turns)
        tn_help(tn_job_diagnostics(job),
                tn_report_bare(tn_job_diagnostics(job), TN_WARNING, W_DRAWN_MOVED,
                               "the whole model is turned by %u quarter turn%s", changes->turns,
                               changes->turns == 1 ? "" : "s"),
                "a rule begins with a part that is not turned, and the model has none");
    warn(job, changes->tilted, W_DRAWN_LOST, "left out, not turned about the vertical alone",
         "parts in braces are turned about the vertical");
    warn_left_out(job, changes->left_out, changes->first,
                  kit ? "not in the kit" : "not a name that a terminal can hold");
}

/* ---- writing */

static void write_text(tn_job *job, const char *path, const char *text)
{
    tn_output output;
    if (!tn_job_output(job, path, &output))
        return;
    fputs(text, output.stream);
    tn_job_commit(job, &output);
}

static tn_status convert(const tn_export_drawn_options *options, const char *path, char **text,
                         tn_drawn_changes *changes, tn_error *error)
{
    uint8_t *bytes;
    size_t size, length;
    tn_status status = tn_file_read(path, TN_DRAWN_BYTES, &bytes, &size, error);
    if (status != TN_OK)
        return status;
    FILE *out = open_memstream(text, &length);
    status = out ? tn_drawn_pcfg((const char *)bytes, size, options->init, out, changes, error) : tn_fail_memory(error);
    if (out && fclose(out) != 0 && status == TN_OK)
        status = tn_fail_memory(error);
    free(bytes);
    if (status == TN_INVALID) {
        tn_error found = *error;
        tn_fail(error, status, found.code, "%.200s: %s", path, found.message);
        tn_error_help(error, "%s",
                      found.help[0] ? found.help : "a part is written `1 COLOUR X Y Z A B C D E F G H I NAME.dat`");
    }
    return status;
}

static void export_pcfg(tn_job *job, const tn_export_drawn_options *options, const char *path)
{
    tn_drawn_changes changes;
    tn_error error;
    char *text = NULL;
    if (convert(options, path, &text, &changes, &error) != TN_OK) {
        tn_job_fail(job, &error);
    } else {
        warn_of_changes(job, &changes, false);
        write_text(job, options->output, text);
    }
    free(text);
}

/* The kit as a file elsewhere names it: one of the standard library by its name, a file by its whole path. */
static char *name_of_kit(const char *kit)
{
    return strpbrk(kit, "/.") ? tn_file_identity(kit) : strdup(kit);
}

static void export_kit(tn_job *job, const tn_export_drawn_options *options, const char *path)
{
    const tn_module *module = job->opened.module;
    bool named = options->output && strcmp(options->output, "-") != 0;
    tn_drawn_changes changes = {0};
    tn_ldraw ldraw = {0};
    tn_error error;
    char *text = NULL, *use = name_of_kit(options->kit);
    tn_status status = use ? tn_drawn_read(path, module, &ldraw, &error) : tn_fail_memory(&error);
    if (status == TN_OK)
        status =
            tn_drawn_kit(module, &ldraw.model, use, named ? options->output : "drawn.kit", &text, &changes, &error);
    if (status != TN_OK) {
        tn_job_fail(job, &error);
    } else {
        warn_of_changes(job, &changes, true);
        warn_left_out(job, ldraw.tilted, ldraw.first_tilted, "not turned about the vertical alone");
        warn_left_out(job, ldraw.beside, ldraw.first_beside, "beside the kit's cells");
        write_text(job, options->output, text);
    }
    tn_ldraw_clear(&ldraw);
    free(text);
    free(use);
}

void tn_job_export_drawn(tn_job *job, const tn_export_drawn_options *options, const char *path)
{
    if (!options->kit)
        export_pcfg(job, options, path);
    else if (!tn_job_open(job, options->kit))
        return;
    else if (job->opened.module->KIT_count == 0)
        tn_job_usage(job, "%.200s is no kit", options->kit);
    else
        export_kit(job, options, path);
}
