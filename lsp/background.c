/* Runs the language server's slow work on a thread of its own. */
#include "lsp/background.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "driver/grammar/grammar_report.h"
#include "driver/plan/analysis.h"
#include "runtime/load.h"

enum { THREAD_STACK = 8 << 20 };

/* A text that is open, as it was. */
typedef struct copy {
    char *path, *text;
    size_t size;
} copy;

struct tn_background {
    pthread_t thread;
    copy *copies; /* the document's own first */
    size_t copy_count;
    const tn_stdlib_dirs *stdlib; /* the workspace's, which does not change */
    tn_plan_memory *memory;       /* the workspace's, which threads share */
    int wake;
    tn_watch watch; /* only its `stop` */
    atomic_bool ended;
    tn_file_analysis *analysis;
    tn_facts *facts;
};

/* ---- in the thread */

static bool copied_text(void *context, const char *real_path, const char **text, size_t *size)
{
    const tn_background *b = context;
    for (size_t i = 0; i < b->copy_count; i++) {
        if (strcmp(b->copies[i].path, real_path) != 0)
            continue;
        *text = b->copies[i].text;
        *size = b->copies[i].size;
        return true;
    }
    return false;
}

static void look_at_module(tn_background *b, tn_opened *opened)
{
    tn_error error;
    tn_plan_analyses analyses;
    if (tn_module_has_grammar(opened->module)) {
        tn_grammar_report(opened, false, &error);
        return;
    }
    const tn_plan_analysis_options options = {.memory = b->memory};
    if (tn_plan_analyse(opened, &options, &analyses) == TN_OK)
        b->facts = tn_facts_new(opened->module, &analyses, b->memory);
    tn_plan_analyses_free(&analyses);
}

static void look(tn_background *b)
{
    const copy *own = &b->copies[0];
    tn_error error;
    b->analysis = tn_analysis_new(own->path, own->text, own->size, b->stdlib, copied_text, b);
    if (!b->analysis || !b->analysis->compilation.module)
        return;
    tn_opened opened = {.path = own->path, .compilation = b->analysis->compilation, .compiled = true};
    if (tn_module_load(opened.compilation.module, opened.compilation.module_size, NULL, &opened.module, &error) !=
        TN_OK)
        return;
    opened.module->watch = &b->watch;
    look_at_module(b, &opened);
    tn_module_free(opened.module);
    tn_diagnostics_sort(&opened.compilation.diagnostics);
    b->analysis->compilation = opened.compilation; /* its diagnostics have grown */
}

static void *run(void *context)
{
    tn_background *b = context;
    uint64_t one = 1;
    look(b);
    b->ended = true;
    (void)!write(b->wake, &one, sizeof one);
    return NULL;
}

/* ---- in the server */

static void free_all(tn_background *b)
{
    tn_analysis_free(b->analysis);
    tn_facts_free(b->facts);
    for (size_t i = 0; i < b->copy_count; i++) {
        free(b->copies[i].path);
        free(b->copies[i].text);
    }
    free(b->copies);
    free(b);
}

static bool copy_document(tn_background *b, const tn_document *document)
{
    copy *made = &b->copies[b->copy_count++];
    *made = (copy){strdup(document->path), strdup(document->text), document->size};
    return made->path && made->text;
}

static bool copy_documents(tn_background *b, const tn_workspace *workspace, const tn_document *own)
{
    size_t count = 0;
    for (const tn_document *document = workspace->documents; document; document = document->next)
        count++;
    b->copies = calloc(count, sizeof *b->copies);
    bool good = b->copies && copy_document(b, own);
    for (const tn_document *document = workspace->documents; good && document; document = document->next)
        if (document != own)
            good = copy_document(b, document);
    return good;
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

tn_background *tn_background_start(const tn_workspace *workspace, const tn_document *document, int wake)
{
    tn_background *b = calloc(1, sizeof *b);
    if (!b)
        return NULL;
    b->stdlib = &workspace->stdlib;
    b->memory = workspace->memory;
    b->wake = wake;
    if (copy_documents(b, workspace, document) && start_thread(b))
        return b;
    free_all(b);
    return NULL;
}

void tn_background_cancel(tn_background *background)
{
    background->watch.stop = true;
}

bool tn_background_ended(tn_background *background)
{
    return background->ended;
}

void tn_background_finish(tn_background *background, tn_file_analysis **analysis, tn_facts **facts)
{
    pthread_join(background->thread, NULL);
    *analysis = background->watch.stop ? NULL : background->analysis;
    *facts = background->watch.stop ? NULL : background->facts;
    if (!background->watch.stop) {
        background->analysis = NULL;
        background->facts = NULL;
    }
    free_all(background);
}
