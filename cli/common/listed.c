/* Runs the commands that list what a file has. */
#include "cli/common/listed.h"

static void show(tn_job *job, const tn_listed *listed, const tn_listed_settings *settings)
{
    tn_reply answer;
    tn_output output;
    if (tn_job_answered(job, listed->ask(&job->session, settings->used, &answer)) &&
        tn_job_output(job, NULL, &output)) {
        if (settings->json)
            tn_job_write_json(&answer, output.stream);
        else
            listed->write(answer.value, output.stream);
        tn_job_commit(job, &output);
    }
    tn_reply_clear(&answer);
}

int tn_listed_run(const tn_listed *listed, const tn_settings *settings)
{
    tn_job job;
    tn_job_begin(&job, settings);
    if (tn_job_open(&job, settings->operands.items[0]))
        show(&job, listed, (const tn_listed_settings *)settings);
    return tn_job_end(&job);
}

void tn_listed_write_values(const char *least, const char *most, const char *const *words, size_t count, FILE *out)
{
    if (least && most)
        fprintf(out, " in %s..%s", least, most);
    else if (least || most)
        fprintf(out, least ? " from %s" : " up to %s", least ? least : most);
    for (size_t i = 0; i < count; i++)
        fprintf(out, "%s%s", i == 0 ? ", one of " : ", ", words[i]);
}

void tn_listed_write_doc(const char *doc, FILE *out)
{
    if (doc && *doc)
        fprintf(out, "  \"%s\"", doc);
    fputc('\n', out);
}
