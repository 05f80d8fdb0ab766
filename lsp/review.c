/* Looks at the rules of documents. */
#include "lsp/review.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "driver/grammar/grammar_report.h"
#include "driver/house/analysis.h"
#include "driver/plan/analysis.h"
#include "runtime/base/watch.h"
#include "runtime/load.h"

/* ---- in a thread of its own */

enum { THREAD_STACK = 8 << 20 };

struct tn_background {
    pthread_t thread;
    tn_review *review;
    double seconds;
    void (*ended)(void *context);
    void *context;
    atomic_bool is_over;
};

static void *run(void *context)
{
    tn_background *b = context;
    tn_review_run(b->review, b->seconds);
    b->is_over = true;
    b->ended(b->context);
    return NULL;
}

static bool start_thread(tn_background *b)
{
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, THREAD_STACK);
    bool started = pthread_create(&b->thread, &attributes, run, b) == 0;
    pthread_attr_destroy(&attributes);
    return started;
}

tn_background *tn_background_start(tn_review *review, double seconds, void (*ended)(void *context), void *context)
{
    tn_background *b = calloc(1, sizeof *b);
    if (!b)
        return NULL;
    b->review = review;
    b->seconds = seconds;
    b->ended = ended;
    b->context = context;
    if (start_thread(b))
        return b;
    free(b);
    return NULL;
}

bool tn_background_ended(tn_background *background)
{
    return background->is_over;
}

tn_review *tn_background_join(tn_background *background)
{
    tn_review *review = background->review;
    pthread_join(background->thread, NULL);
    free(background);
    return review;
}

/* ---- reviews */

/* A text that is open, as it was. */
typedef struct copy {
    char *path, *text;
    size_t size;
} copy;

struct tn_review {
    copy *copies; /* the document's own first */
    size_t copy_count;
    const tn_workspace *workspace; /* of which only what does not change, and what threads share, is looked at */
    tn_watch watch;
    double until; /* tn_seconds */
    tn_file_analysis *analysis;
    tn_facts *facts;
};

/* ---- making ready */

static bool copy_document(tn_review *review, const tn_document *document)
{
    copy *made = &review->copies[review->copy_count++];
    *made = (copy){strdup(document->path), strdup(document->text), document->size};
    return made->path && made->text;
}

static bool copy_documents(tn_review *review, const tn_workspace *workspace, const tn_document *own)
{
    size_t count = 0;
    for (const tn_document *document = workspace->documents; document; document = document->next)
        count++;
    review->copies = calloc(count, sizeof *review->copies);
    bool good = review->copies && copy_document(review, own);
    for (const tn_document *document = workspace->documents; good && document; document = document->next)
        if (document != own)
            good = copy_document(review, document);
    return good;
}

void tn_review_end(tn_review *review, tn_file_analysis **analysis, tn_facts **facts)
{
    bool found = !review->watch.stop;
    *analysis = found ? review->analysis : NULL;
    *facts = found ? review->facts : NULL;
    if (!found) {
        tn_analysis_free(review->analysis);
        tn_facts_free(review->facts);
    }
    for (size_t i = 0; i < review->copy_count; i++) {
        free(review->copies[i].path);
        free(review->copies[i].text);
    }
    free(review->copies);
    free(review);
}

tn_review *tn_review_new(const tn_workspace *workspace, const tn_document *document)
{
    tn_review *review = calloc(1, sizeof *review);
    tn_file_analysis *analysis;
    tn_facts *facts;
    if (!review)
        return NULL;
    review->workspace = workspace;
    if (copy_documents(review, workspace, document))
        return review;
    tn_review_end(review, &analysis, &facts);
    return NULL;
}

void tn_review_cancel(tn_review *review)
{
    review->watch.stop = true;
}

/* ---- looking */

static bool copied_text(void *context, const char *real_path, const char **text, size_t *size)
{
    const tn_review *review = context;
    for (size_t i = 0; i < review->copy_count; i++) {
        if (strcmp(review->copies[i].path, real_path) != 0)
            continue;
        *text = review->copies[i].text;
        *size = review->copies[i].size;
        return true;
    }
    return false;
}

static void look_at_module(tn_review *review, tn_opened *opened)
{
    tn_error error;
    tn_plan_analyses analyses;
    if (tn_module_has_grammar(opened->module)) {
        tn_grammar_report(opened, false, &error);
        return;
    }
    const tn_plan_analysis_options options = {.memory = review->workspace->memory};
    if (tn_plan_analyse(opened, &options, &analyses) == TN_OK)
        review->facts = tn_facts_new(opened->module, &analyses, review->workspace->memory);
    tn_house_analyse(opened, 0);
    tn_plan_analyses_free(&analyses);
}

static bool in_time(void *context, double done, double total)
{
    const tn_review *review = context;
    (void)done, (void)total;
    return tn_seconds() < review->until;
}

void tn_review_run(tn_review *review, double seconds)
{
    review->until = tn_seconds() + seconds;
    review->watch.go_on = in_time;
    review->watch.context = review;
    review->watch.caller = pthread_self();
    const copy *own = &review->copies[0];
    tn_error error;
    review->analysis = tn_analysis_new(
        own->path, own->text, own->size,
        &(tn_analysis_texts){review->workspace->served, &review->workspace->stdlib, copied_text, review});
    if (!review->analysis || !review->analysis->compilation.module)
        return;
    tn_opened opened = {.path = own->path, .compilation = review->analysis->compilation, .compiled = true};
    if (tn_module_load(opened.compilation.module, opened.compilation.module_size, NULL, &opened.module, &error) !=
        TN_OK)
        return;
    opened.module->watch = &review->watch;
    look_at_module(review, &opened);
    tn_module_free(opened.module);
    tn_diagnostics_sort(&opened.compilation.diagnostics);
    review->analysis->compilation = opened.compilation; /* its diagnostics have grown */
}
