/* Options of `grow` that a study can say too are turned into a study of their own, so that both mean the same and are
 * checked and explained alike. */
#include <stdlib.h>

#include "cli/growth/grow.h"
#include "driver/open/files.h"
#include "driver/open/stdlib_find.h"

static void say_quoted(FILE *out, const char *text)
{
    fputc('"', out);
    for (; *text; text++) {
        if (*text == '"' || *text == '\\')
            fputc('\\', out);
        fputc(*text, out);
    }
    fputs("\"\n", out);
}

static bool say_text(FILE *out, const char *word, const char *text)
{
    if (text)
        fprintf(out, "%s %s\n", word, text);
    return text != NULL;
}

static bool say_flag(FILE *out, const char *word, bool flag)
{
    if (flag)
        fprintf(out, "%s\n", word);
    return flag;
}

static bool say_list(FILE *out, const char *word, const tn_option_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        fprintf(out, "%s %s\n", word, list->items[i]);
    return list->count > 0;
}

/* Writes the statements; false where there are none. */
static bool say_statements(FILE *out, const tn_grow_statements *s)
{
    bool any = say_text(out, "steps", s->steps);
    any |= say_text(out, "scale", s->scale);
    any |= say_text(out, "start", s->start);
    any |= say_text(out, "start-length", s->start_length);
    any |= say_text(out, "seed", s->seed);
    any |= say_text(out, "branch-angle", s->branch_angle);
    any |= say_text(out, "branch-length", s->branch_length);
    any |= say_text(out, "edge-limit", s->edge_limit);
    any |= say_text(out, "sun", s->sun);
    if (s->distance_to) {
        any = true;
        fputs("distance-to ", out);
        say_quoted(out, s->distance_to);
    }
    any |= say_flag(out, "fixed-centre", s->fixed_centre);
    any |= say_flag(out, "fixed-perimeter", s->fixed_perimeter);
    any |= say_flag(out, "facing", s->facing);
    any |= say_flag(out, "mirror", s->mirror);
    any |= say_list(out, "attractor", &s->attractors);
    any |= say_list(out, "repeller", &s->repellers);
    any |= say_list(out, "gravity", &s->gravity);
    any |= say_list(out, "boundary", &s->boundaries);
    any |= say_list(out, "fitness", &s->fitness);
    return any;
}

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

bool tn_grow_open(tn_job *job)
{
    const char *path = job->settings->operands.items[0];
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    tn_error error;
    tn_stdlib_file found = {0};
    if (!out || (tn_stdlib_may_mean(path) && tn_stdlib_find(path, &found, &error) != TN_OK)) {
        tn_fail_memory(&error);
        tn_job_fail(job, &error);
        if (out)
            fclose(out);
        free(text);
        return false;
    }
    const char *named = found.path ? found.recorded : path;
    const tn_notation *notation = tn_notation_of(named, "", 0);
    bool has_source = notation && tn_notation_takes(notation, "grow");
    tn_stdlib_file_clear(&found);
    fputs(notation == TN_NOTATION(hemls) ? "rules " : "use ", out);
    say_quoted(out, path);
    bool any = say_statements(out, &tn_grow_settings_of(job)->said), written = !ferror(out);
    fclose(out);
    bool opened = false;
    if (!written) {
        tn_fail_memory(&error);
        tn_job_fail(job, &error);
    } else {
        opened = any ? open_study(job, path, has_source, text, size) : tn_job_open(job, path);
    }
    free(text);
    return opened;
}
