#include "runtime/plan/match/image_search.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/plan/match/image.h"
#include "runtime/plan/match/lower.h"

#define LENGTH_STEP 8u /* automata are made for plans of so many trays, or twice as many, or three times */

struct tn_image_search {
    tn_projection *projection;
    tn_classes *newer;
    tn_dfa **clauses; /* NULL before they were needed */
    uint32_t longest; /* of the plans that they are made for */
    uint32_t *seen;   /* [classes] */
    uint32_t stamp;
    tn_key trays;  /* the newer trays above each place, one list behind the other */
    size_t *first; /* [length + 1]: where the lists begin */
    size_t room;   /* of both */
    tn_tray *tried;
};

tn_status tn_image_search_new(const tn_schema *schema, const tn_instruction *image, tn_image_search **out,
                              tn_error *error)
{
    tn_image_search *search = calloc(1, sizeof *search);
    tn_status status = search ? tn_projection_new(schema, image, &search->projection, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_classes_above(search->projection, &search->newer, error);
    if (status == TN_OK) {
        search->seen = calloc((size_t)search->newer->count + 1, sizeof *search->seen);
        status = search->seen ? TN_OK : tn_fail_memory(error);
    }
    if (status != TN_OK) {
        tn_image_search_free(search);
        return status;
    }
    *out = search;
    return TN_OK;
}

void tn_image_search_free(tn_image_search *search)
{
    if (!search)
        return;
    tn_image_clauses_free(search->projection, search->clauses);
    tn_classes_free(search->newer);
    tn_projection_free(search->projection);
    free(search->seen);
    free(search->trays.data);
    free(search->first);
    free(search->tried);
    free(search);
}

const tn_projection *tn_image_search_projection(const tn_image_search *search)
{
    return search->projection;
}

/* ---- the newer trays above each place */

static tn_status make_room(tn_image_search *search, size_t length, tn_error *error)
{
    if (search->first && length <= search->room)
        return TN_OK;
    size_t room = length + length / 2 + LENGTH_STEP;
    if (!tn_array_resize(&search->first, room + 1, sizeof *search->first) ||
        !tn_array_resize(&search->tried, room, sizeof *search->tried))
        return tn_fail_memory(error);
    search->room = room;
    return TN_OK;
}

/* *none: above some place there is no tray. */
static tn_status list_trays(tn_image_search *search, const tn_tray *trays, size_t length, bool *none, tn_error *error)
{
    search->trays.size = 0;
    search->first[0] = 0;
    *none = false;
    for (size_t k = 0; k < length; k++) {
        if (++search->stamp == 0) {
            memset(search->seen, 0, search->newer->count * sizeof *search->seen);
            search->stamp = 1;
        }
        if (!tn_projection_list(search->projection, search->newer->of_tray, trays[k], search->seen, search->stamp,
                                &search->trays))
            return tn_fail_memory(error);
        search->first[k + 1] = search->trays.size;
        *none |= search->first[k] == search->first[k + 1];
    }
    return TN_OK;
}

/* ---- by the states of the clauses */

typedef struct walk {
    tn_image_search *search;
    uint32_t clauses;
    size_t length;
    tn_interner *layers; /* [length + 1]: of states, one of each clause */
    uint8_t **alive;     /* [length + 1][layer]: does a plan end well from there? */
    tn_key state, next;
    size_t words; /* in all layers */
} walk;

static tn_status make_clauses(tn_image_search *search, size_t length, tn_error *error)
{
    if (search->clauses && length <= search->longest)
        return TN_OK;
    tn_image_clauses_free(search->projection, search->clauses);
    search->clauses = NULL;
    search->longest = (uint32_t)(length / LENGTH_STEP + 1) * LENGTH_STEP;
    tn_image_options options = {.max_states = TN_STATES_DEFAULT, .max_trays = search->longest};
    return tn_image_clauses(search->projection, search->newer, &options, &search->clauses, error);
}

/* The states behind a tray: those of `state` before it. */
static bool follow(walk *w, tn_tray tray)
{
    uint32_t letter = w->search->newer->of_tray[tray];
    bool ok = true;
    w->next.size = 0;
    for (uint32_t i = 0; ok && i < w->clauses; i++)
        ok = tn_key_push(&w->next, tn_dfa_read(w->search->clauses[i], w->state.data[i], letter));
    return ok;
}

static bool take_state(walk *w, size_t layer, uint32_t number)
{
    size_t size;
    const uint32_t *words = tn_interned(&w->layers[layer], number, &size);
    return tn_key_copy(&w->state, words, size);
}

static tn_status too_many(const walk *w, tn_error *error)
{
    const tn_projection *projection = w->search->projection;
    tn_fail(error, TN_LIMIT, E_MATCHING_WORK,
            "looking for a plan of `%s` above a plan of %zu trays takes more than the limit of %u states",
            tn_text(projection->schema->module, projection->library->name), w->length, TN_IMAGE_WORDS_MAX);
    tn_error_help(error, "ask about a shorter plan");
    return TN_LIMIT;
}

/* All that can be reached with the trays of place k. */
static tn_status walk_on(walk *w, size_t k, tn_error *error)
{
    const tn_image_search *search = w->search;
    for (uint32_t n = 0; n < w->layers[k].count; n++) {
        if (tn_watch_stopped_at(search->projection->schema->module->watch, n))
            return tn_fail_stopped(search->projection->schema->module->watch, error);
        bool ok = take_state(w, k, n);
        for (size_t i = search->first[k]; ok && i < search->first[k + 1]; i++)
            ok = follow(w, search->trays.data[i]) &&
                 tn_intern(&w->layers[k + 1], w->next.data, w->next.size) != UINT32_MAX;
        if (!ok)
            return tn_fail_memory(error);
        if (w->words + w->layers[k + 1].words_used + w->layers[k + 1].count > TN_IMAGE_WORDS_MAX)
            return too_many(w, error);
    }
    w->words += w->layers[k + 1].words_used + w->layers[k + 1].count;
    return TN_OK;
}

static bool ends_well(walk *w)
{
    for (uint32_t i = 0; i < w->clauses; i++) {
        bool prunes = tn_projection_clause(w->search->projection, i)->kind == TN_CLAUSE_PRUNE;
        if (w->search->clauses[i]->accept[w->state.data[i]] == prunes)
            return false;
    }
    return true;
}

/* Does a tray lead from the state at hand to one that is alive? All that can be reached has been. */
static bool goes_on(walk *w, size_t k, tn_tray tray, bool *ok)
{
    uint32_t number = follow(w, tray) ? tn_intern(&w->layers[k + 1], w->next.data, w->next.size) : UINT32_MAX;
    *ok = *ok && number != UINT32_MAX;
    return *ok && w->alive[k + 1][number];
}

static tn_status find_alive(walk *w, size_t k, tn_error *error)
{
    const tn_image_search *search = w->search;
    uint32_t count = w->layers[k].count;
    bool ok = (w->alive[k] = calloc((size_t)count + 1, 1)) != NULL;
    for (uint32_t n = 0; ok && n < count; n++) {
        ok = take_state(w, k, n);
        bool alive = ok && k == w->length && ends_well(w);
        size_t end = k < w->length ? search->first[k + 1] : 0;
        for (size_t i = search->first[k]; ok && !alive && i < end; i++)
            alive = goes_on(w, k, search->trays.data[i], &ok);
        w->alive[k][n] = alive;
    }
    return ok ? TN_OK : tn_fail_memory(error);
}

/* Takes the first tray that leads on, place by place. */
static tn_status read_first(walk *w, tn_error *error)
{
    tn_image_search *search = w->search;
    bool ok = take_state(w, 0, 0);
    for (size_t k = 0; ok && k < w->length; k++) {
        size_t i = search->first[k];
        while (ok && !goes_on(w, k, search->trays.data[i], &ok))
            i++;
        search->tried[k] = search->trays.data[i];
        ok = ok && tn_key_copy(&w->state, w->next.data, w->next.size);
    }
    return ok ? TN_OK : tn_fail_memory(error);
}

static tn_status walk_all(walk *w, bool *found, tn_error *error)
{
    bool ok = true;
    for (uint32_t i = 0; ok && i < w->clauses; i++)
        ok = tn_key_push(&w->state, 0);
    ok = ok && tn_intern(&w->layers[0], w->state.data, w->state.size) != UINT32_MAX;
    tn_status status = ok ? TN_OK : tn_fail_memory(error);
    for (size_t k = 0; status == TN_OK && k < w->length; k++)
        status = walk_on(w, k, error);
    for (size_t k = w->length + 1; status == TN_OK && k-- > 0;)
        status = find_alive(w, k, error);
    *found = status == TN_OK && w->alive[0][0];
    return *found ? read_first(w, error) : status;
}

static tn_status walk_states(tn_image_search *search, size_t length, bool *found, tn_error *error)
{
    walk w = {.search = search, .clauses = search->projection->library->clause_count, .length = length};
    tn_status status = make_clauses(search, length, error);
    if (status != TN_OK)
        return status;
    w.layers = calloc(length + 1, sizeof *w.layers);
    w.alive = calloc(length + 1, sizeof *w.alive);
    status = w.layers && w.alive ? walk_all(&w, found, error) : tn_fail_memory(error);
    for (size_t k = 0; k <= length; k++) {
        if (w.layers)
            tn_interner_clear(&w.layers[k]);
        if (w.alive)
            free(w.alive[k]);
    }
    free(w.layers);
    free(w.alive);
    free(w.state.data);
    free(w.next.data);
    return status;
}

tn_status tn_image_search_find(tn_image_search *search, const tn_tray *trays, size_t length, bool *found,
                               tn_tray *newer, tn_error *error)
{
    bool none = false;
    *found = false;
    tn_status status = make_room(search, length, error);
    if (status == TN_OK)
        status = list_trays(search, trays, length, &none, error);
    if (status == TN_OK && !none)
        status = walk_states(search, length, found, error);
    if (status == TN_OK && *found && newer && length > 0)
        memcpy(newer, search->tried, length * sizeof *newer);
    return status;
}
