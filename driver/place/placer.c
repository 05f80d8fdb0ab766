/* Scores rules of kits: compiles a kit with them, places its model and measures it. */
#include "driver/place/placer.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compiler/kit/with_rules.h"
#include "driver/open/files.h"
#include "driver/open/open.h"
#include "driver/place/kit.h"
#include "driver/place/shape.h"
#include "runtime/place/measure.h"
#include "runtime/place/search/score.h"

struct tn_placer {
    tn_opened opened; /* the kit as it is */
    tn_stdlib_dirs dirs;
    tn_files files;
    tn_resolver resolver; /* of the files; threads share it */
    char *path, *folder;  /* of the kit; the folder's whole path */
    const char *text;
    bool separately, may_want_nothing;
    tn_placer_hear *hear; /* or NULL */
    void *hearing;
};

/* What a sentence becomes. */
typedef struct placed {
    tn_opened opened;
    tn_placed_model model;
    tn_placed_measures measures;
    char *text;
} placed;

static void clear_placed(placed *p)
{
    tn_placed_measures_clear(&p->measures);
    tn_placed_model_clear(&p->model);
    tn_close(&p->opened);
    free(p->text);
}

void tn_placer_free(tn_placer *p)
{
    if (!p)
        return;
    tn_close(&p->opened);
    tn_files_clear(&p->files);
    tn_stdlib_dirs_clear(&p->dirs);
    free(p->path);
    free(p->folder);
    free(p);
}

/* ---- the kit */

static tn_status refuse(tn_error *error, const char *kit, const char *why, const char *help)
{
    tn_fail(error, TN_INVALID, E_KIT_GOALS, "the kit %.200s cannot be used to score rules: %.200s", kit, why);
    if (help)
        tn_error_help(error, "%s", help);
    return TN_INVALID;
}

static bool wants_something(const tn_module *module)
{
    const tn_kit_model_record *model = &module->KIT_MODEL_records[0];
    bool wants = model->objective != TN_NO_RECORD;
    for (uint32_t i = 0; i < model->condition_count; i++)
        wants |= !(module->KIT_CONDITION_records[model->condition_first + i].flags & TN_CONDITION_TEST);
    return wants;
}

static tn_status check_kit(const tn_placer *p, tn_error *error)
{
    const tn_module *module = p->opened.module;
    if (module->KIT_count == 0)
        return refuse(error, p->path, "it is no kit", "name a .kit file");
    if (!p->opened.compiled)
        return refuse(error, p->path, "it is a module", "name the .kit file that it was made from");
    if (module->KIT_MODEL_count != 1)
        return refuse(error, p->path, "it has no model, or more than one",
                      "write a file with one model, whose rules are bred");
    if (!p->may_want_nothing && !wants_something(module))
        return refuse(error, p->path, "its model wants nothing",
                      "write what the model shall be: `require fill > 0.95;`, `minimize elements;`");
    return TN_OK;
}

/* The folder's whole path, so that a kit that is written elsewhere finds what it uses. */
static tn_status find_folder(tn_placer *p, tn_error *error)
{
    char *whole = tn_file_identity(p->path);
    char *slash = whole ? strrchr(whole, '/') : NULL;
    if (slash)
        *slash = '\0';
    p->folder = whole;
    return whole ? TN_OK : tn_fail_memory(error);
}

static tn_status open_kit(tn_placer *p, const char *kit, tn_error *error)
{
    p->path = strdup(kit);
    tn_status status = p->path ? tn_stdlib_dirs_find(&p->dirs, error) : tn_fail_memory(error);
    tn_files_begin(&p->files, &p->dirs);
    p->resolver = tn_files_resolver(&p->files);
    if (status != TN_OK)
        return status;
    status = tn_open(p->path, false, &p->opened);
    if (status == TN_MEMORY)
        return tn_open_error(&p->opened, status, error);
    if (status != TN_OK)
        return refuse(error, kit, tn_first_error(&p->opened), NULL);
    status = check_kit(p, error);
    if (status != TN_OK)
        return status;
    p->text = p->opened.compilation.sources.files[0].text;
    return find_folder(p, error);
}

tn_status tn_placer_new(const char *kit, bool separately, bool may_want_nothing, tn_placer **placer, tn_error *error)
{
    tn_placer *p = calloc(1, sizeof *p);
    *placer = NULL;
    if (!p)
        return tn_fail_memory(error);
    p->separately = separately;
    p->may_want_nothing = may_want_nothing;
    tn_status status = open_kit(p, kit, error);
    if (status == TN_OK)
        *placer = p;
    else
        tn_placer_free(p);
    return status;
}

void tn_placer_tell(tn_placer *placer, tn_placer_hear *hear, void *context)
{
    placer->hear = hear;
    placer->hearing = context;
}

bool tn_placer_wants(const tn_placer *placer)
{
    return wants_something(placer->opened.module);
}

const tn_module *tn_placer_kit(const tn_placer *placer)
{
    return placer->opened.module;
}

/* ---- one sentence */

static tn_status open_with(const tn_placer *p, const char *sentence, size_t size, placed *to, tn_error *error)
{
    tn_status status = tn_kit_with_rules(p->text, sentence, size, NULL, &to->text, error);
    if (status != TN_OK)
        return status;
    tn_compile_options options = {.resolver = p->resolver, .attachments = tn_file_attachments};
    status = tn_open_text(TN_NOTATION(kit), &(tn_input){.text = to->text, .size = strlen(to->text), .name = p->path},
                          &options, &to->opened);
    return status == TN_OK ? TN_OK : tn_open_error(&to->opened, status, error);
}

/* A thread to itself: rules are scored side by side. */
static tn_status place(placed *to, tn_error *error)
{
    const tn_place_options options = {.threads = 1, .part_limit = TN_PLACER_PARTS};
    tn_place_rules rules;
    tn_status status = tn_place_rules_of_model(to->opened.module, 0, &rules, error);
    if (status == TN_OK) {
        status = tn_place_model(&to->opened, &rules, &options, &to->model);
        if (status != TN_OK)
            tn_open_error(&to->opened, status, error);
    }
    tn_place_rules_clear(&rules);
    return status;
}

/* Clear it in any case. */
static tn_status make(const tn_placer *p, const char *sentence, size_t size, placed *to, tn_error *error)
{
    *to = (placed){0};
    tn_status status = open_with(p, sentence, size, to, error);
    return status == TN_OK ? place(to, error) : status;
}

static tn_status measure(placed *to, tn_model_score *found, tn_error *error)
{
    const tn_module *module = to->opened.module;
    const tn_kit_model_record *model = &module->KIT_MODEL_records[0];
    tn_status status = tn_placed_measure(module, model, &to->model, NULL, &to->measures, error);
    if (status == TN_OK)
        *found = tn_score_terms(module, model, to->measures.terms);
    return status;
}

static tn_status score_rules(void *context, unsigned thread, const char *sentence, size_t size, tn_score *score,
                             char message[200], tn_error *error)
{
    const tn_placer *p = context;
    tn_error own = {0};
    tn_model_score found;
    placed made;
    tn_status status = make(p, sentence, size, &made, &own);
    if (status == TN_OK)
        status = measure(&made, &found, &own);
    bool valued = status == TN_OK && isfinite(found.value) && isfinite(found.violation);
    if (valued && p->hear)
        status =
            p->hear(p->hearing, thread, &(tn_placed_facts){made.opened.module, &made.model, made.measures.terms}, &own);
    clear_placed(&made);
    if (status != TN_OK)
        return tn_score_refuse(status, &own, score, message, error);
    score->objectives[0] = found.value + (p->separately ? 0 : TN_PLACER_VIOLATION * found.violation);
    score->objectives[1] = (double)size;
    score->violation = p->separately ? found.violation : 0;
    if (valued)
        return TN_OK;
    score->state = TN_SCORE_FAILED;
    snprintf(message, 200, "the objective or a requirement has no value for this model");
    return TN_OK;
}

tn_evaluator tn_placer_evaluator(tn_placer *placer)
{
    return (tn_evaluator){.context = placer, .objectives = placer->separately ? 2 : 1, .evaluate = score_rules};
}

const char *tn_placer_objective(const void *placer, size_t i)
{
    (void)placer;
    return i ? "length" : "objective";
}

/* ---- what a person sees */

tn_status tn_placer_unmet(const void *placer, const char *sentence, char **text, tn_error *error)
{
    const tn_kit_condition_record *condition;
    tn_kit_tally tally = {0};
    tn_model_score score;
    placed made;
    size_t size;
    uint32_t i = 0;
    *text = NULL;
    tn_status status = make(placer, sentence, strlen(sentence), &made, error);
    if (status == TN_OK)
        status = measure(&made, &score, error);
    FILE *out = status == TN_OK ? open_memstream(text, &size) : NULL;
    const tn_module *module = made.opened.module;
    const tn_kit_model_record *model = out ? &module->KIT_MODEL_records[0] : NULL;
    while (out && (condition = tn_kit_next_unmet(module, model, &made.measures, false, &i, &tally))) {
        tn_error why = {0};
        tn_kit_fail_condition(module, condition, model, &made.measures, false, &why);
        fprintf(out, "%s\n", why.message);
    }
    if (status == TN_OK && (!out || fclose(out) != 0))
        status = tn_fail_memory(error);
    clear_placed(&made);
    return status;
}

tn_status tn_placer_text(const tn_placer *p, const char *sentence, char **text, tn_error *error)
{
    return tn_kit_with_rules(p->text, sentence, strlen(sentence), p->folder, text, error);
}

tn_status tn_placer_draw(const void *placer, const char *const *sentences, const char *const *labels, size_t count,
                         const char *title, tn_picture *to, tn_error *error)
{
    placed *all = calloc(count + 1, sizeof *all);
    tn_placed_shape *shapes = calloc(count + 1, sizeof *shapes);
    tn_status status = all && shapes ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; i < count && status == TN_OK; i++) {
        status = make(placer, sentences[i], strlen(sentences[i]), &all[i], error);
        shapes[i] = (tn_placed_shape){all[i].opened.module, &all[i].model};
    }
    if (status == TN_OK && count > 0)
        status = tn_placed_draw_many(shapes, labels, count, title, to, error);
    for (size_t i = 0; all && i < count; i++)
        clear_placed(&all[i]);
    free(shapes);
    free(all);
    return status;
}
