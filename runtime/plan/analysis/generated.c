#include "runtime/plan/analysis/generated.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/plan/match/lower.h"

#define ALIVE_MAX (UINT64_C(1) << 26) /* pairs of a length and a state */

/* alive[t * states + s]: from state s after t trays some word of the library's lengths is accepted. */
typedef struct walk {
    const tn_dfa *dfa;
    const tn_classes *classes;
    uint32_t least, most;
    uint8_t *alive;
} walk;

static bool ends_here(const walk *w, uint32_t trays, uint32_t state)
{
    return trays >= w->least && trays <= w->most && w->dfa->accept[state];
}

static bool goes_on(const walk *w, uint32_t trays, uint32_t state, uint32_t letter)
{
    return trays < w->most && w->alive[((size_t)trays + 1) * w->dfa->states + tn_dfa_read(w->dfa, state, letter)];
}

static void find_alive(const walk *w)
{
    for (uint32_t t = w->most + 1; t-- > 0;)
        for (uint32_t s = 0; s < w->dfa->states; s++) {
            bool alive = ends_here(w, t, s);
            for (uint32_t l = 0; !alive && l < w->classes->count; l++)
                alive = goes_on(w, t, s, l);
            w->alive[(size_t)t * w->dfa->states + s] = alive;
        }
}

static void follow(const walk *w, const tn_tray *trays, size_t length, tn_generated_beginning *found)
{
    uint32_t state = 0;
    found->known = true;
    while (found->length < length && goes_on(w, found->length, state, w->classes->of_tray[trays[found->length]]))
        state = tn_dfa_read(w->dfa, state, w->classes->of_tray[trays[found->length++]]);
    found->may_end = ends_here(w, found->length, state);
    for (tn_tray t = 0; t < w->classes->schema->tray_count; t++) {
        found->follows[t] = goes_on(w, found->length, state, w->classes->of_tray[t]);
        found->count += found->follows[t];
    }
}

static tn_status find(const tn_schema *schema, walk *w, uint32_t function, const tn_tray *trays, size_t length,
                      tn_generated_beginning *found, tn_error *error)
{
    tn_lowering *lowering = NULL;
    tn_dfa *dfa = NULL;
    tn_status status = tn_lowering_new(w->classes, 0, &lowering, error);
    if (status == TN_OK) {
        tn_lowering_within(lowering, w->most);
        status = tn_lower(lowering, function, &dfa, error);
    }
    w->dfa = dfa;
    if (status == TN_OK && ((uint64_t)w->most + 2) * dfa->states <= ALIVE_MAX) {
        w->alive = calloc(((size_t)w->most + 2) * dfa->states, 1);
        found->follows = calloc((size_t)schema->tray_count + 1, 1);
        status = w->alive && found->follows ? TN_OK : tn_fail_memory(error);
        if (status == TN_OK) {
            find_alive(w);
            follow(w, trays, length, found);
        }
    }
    free(w->alive);
    tn_dfa_free(dfa);
    tn_lowering_free(lowering);
    return status;
}

tn_status tn_generated_beginning_find(const tn_schema *schema, uint32_t function, uint32_t trays_min,
                                      uint32_t trays_max, const tn_tray *trays, size_t length,
                                      tn_generated_beginning *found, tn_error *error)
{
    tn_classes *classes = NULL;
    *found = (tn_generated_beginning){0};
    tn_status status = tn_schema_listed(schema, "what may follow a beginning goes", error);
    if (status == TN_OK)
        status = tn_classes_new(schema, &function, 1, &classes, error);
    if (status == TN_OK) {
        walk w = {.classes = classes, .least = trays_min, .most = trays_max};
        status = find(schema, &w, function, trays, length, found, error);
    }
    tn_classes_free(classes);
    return status == TN_LIMIT ? TN_OK : status;
}

void tn_generated_beginning_clear(tn_generated_beginning *found)
{
    free(found->follows);
    *found = (tn_generated_beginning){0};
}
