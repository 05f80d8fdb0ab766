/* A generation on a sheet: of surfaces or designs where what is bred has a form, else of its sentences. */
#include "driver/sheet/sheet_picture.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/genome/picture/sheet.h"

#define LABEL_BYTES 64u

/* "3  #47  1.5 parent": with its id where it can be named by that later on, and whether it is a parent. */
static void write_label(const tn_run *run, size_t i, const tn_individual *member, char label[LABEL_BYTES])
{
    if (!run->job->settings.kind) {
        snprintf(label, LABEL_BYTES, "%zu   (score %.5g)", i + 1, member->score.objectives[0]);
        return;
    }
    int size = snprintf(label, LABEL_BYTES, "%zu  #%" PRIu64, i + 1, member->id);
    if (run->job->scored)
        size += snprintf(label + size, LABEL_BYTES - (size_t)size, "  %.4g", member->score.objectives[0]);
    bool parent = member->stayed || member->kind == TN_BIRTH_SEED;
    snprintf(label + size, LABEL_BYTES - (size_t)size, "%s", parent ? " parent" : "");
}

/* Forms are drawn as they are, in the members' order; those without a score come last and are not drawn. */
static tn_status draw_forms(const tn_run *run, size_t scored, tn_picture *to, tn_error *error)
{
    size_t count;
    const tn_individual *const *members = tn_evolution_members(run->evolution, &count);
    const char **sentences = calloc(scored, sizeof *sentences), **labels = calloc(scored, sizeof *labels);
    char *text = malloc(scored * LABEL_BYTES), title[80];
    tn_status status = sentences && labels && text ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < scored; i++) {
        write_label(run, i, members[i], text + i * LABEL_BYTES);
        sentences[i] = members[i]->sentence;
        labels[i] = text + i * LABEL_BYTES;
    }
    snprintf(title, sizeof title, "generation %u", run->generations ? run->generations - 1 : 0);
    if (scored < count)
        snprintf(title + strlen(title), 40, "; %zu more have no %s", count - scored, run->job->forms.what);
    if (status == TN_OK)
        status = run->job->forms.draw(run->job->forms.context, sentences, labels, scored, title, to, error);
    free(sentences);
    free(labels);
    free(text);
    return status;
}

static size_t count_scored(const tn_run *run)
{
    size_t count, scored = 0;
    const tn_individual *const *members = tn_evolution_members(run->evolution, &count);
    while (scored < count && members[scored]->score.state == TN_SCORED)
        scored++;
    return scored;
}

tn_status tn_run_sheet(const tn_run *run, const tn_run_files *files, char name[TN_SHEET_NAME_SIZE], tn_error *error)
{
    size_t count, scored = run->job->forms.context ? count_scored(run) : 0;
    const tn_individual *const *members = tn_evolution_members(run->evolution, &count);
    tn_run_picture picture;
    snprintf(name, TN_SHEET_NAME_SIZE, "sheet-%04u%s", run->generations ? run->generations - 1 : 0,
             scored ? run->job->forms.picture : ".svg");
    tn_status status = tn_run_picture_begin(run->dir, files, name, &picture, error);
    if (status == TN_OK)
        status = scored ? draw_forms(run, scored, &picture.to, error)
                        : tn_sentences_draw(members, count, run->job->grammar->name, &picture.to, error);
    return tn_run_picture_end(&picture, status, error);
}
