/* Takes files from a question, each into a file of its own. */
#include "cli/common/made_outputs.h"

#include <stdlib.h>
#include <string.h>

#include "ask/session/questions.h"

static tn_status path_in_folder(tn_made_outputs *o, const char *name, tn_error *error)
{
    const char *folder = o->paths[0];
    const char *between = folder[strlen(folder) - 1] == '/' ? "" : "/";
    tn_status status = o->next == 0 ? tn_folder_make(folder, error) : TN_OK;
    if (status == TN_OK && asprintf(&o->in_folder, "%s%s%s", folder, between, name ? name : "index.html") < 0) {
        o->in_folder = NULL;
        status = tn_fail_memory(error);
    }
    return status;
}

static tn_status opens(void *context, const char *name, FILE **stream, tn_error *error)
{
    tn_made_outputs *o = context;
    if (!o->folder && o->next == o->count)
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "there are more files than names for them");
    const char *made = o->folders ? o->folders[o->next] : NULL;
    tn_status status = o->folder ? path_in_folder(o, name, error) : made ? tn_folder_make(made, error) : TN_OK;
    if (status == TN_OK)
        status = tn_output_open(o->folder ? o->in_folder : o->paths[o->next], &o->output, error);
    *stream = status == TN_OK ? o->output.stream : NULL;
    o->next++;
    return status;
}

static tn_status closes(void *context, bool whole, tn_error *error)
{
    tn_made_outputs *o = context;
    tn_status status = TN_OK;
    if (whole) {
        status = tn_output_commit(&o->output, error);
        if (status != TN_OK && error->code == E_CLOSED_PIPE) { /* which ends quietly */
            tn_job_fail(o->job, error);
            status = TN_OK;
        }
    } else {
        tn_output_discard(&o->output);
    }
    free(o->in_folder);
    o->in_folder = NULL;
    return status;
}

void tn_job_files(tn_job *job, tn_made_outputs *outputs, const char *const *paths, size_t count, bool folder)
{
    *outputs = (tn_made_outputs){.job = job, .paths = paths, .count = count, .folder = folder};
    outputs->taker = (tn_file_taker){opens, closes, outputs};
    job->session.files = &outputs->taker;
}

void tn_job_files_end(tn_made_outputs *outputs)
{
    free(outputs->in_folder);
    outputs->job->session.files = NULL;
}

unsigned tn_picture_choice(const char *path)
{
    tn_file_format format = path ? tn_file_format_of(path) : TN_FILE_SVG;
    return format == TN_FILE_PNG ? 1 : format == TN_FILE_PDF ? 2 : 0;
}

unsigned tn_answer_picture_choice(const char *path)
{
    return tn_job_draws(path) ? 1 + tn_picture_choice(path) : 0;
}

void tn_job_draw(tn_job *job, const tn_draw_request *request, const char *path)
{
    tn_made_outputs outputs;
    tn_reply answer;
    tn_job_files(job, &outputs, &path, 1, false);
    tn_job_answered(job, tn_ask_draw(&job->session, request, &answer));
    tn_job_files_end(&outputs);
    tn_reply_clear(&answer);
}
