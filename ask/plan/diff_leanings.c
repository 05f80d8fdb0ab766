/* diff: the weights and the preferences that an edit changes. */
#include <stdlib.h>
#include <string.h>

#include "ask/plan/diff.h"
#include "ask/plan/weights.h"
#include "runtime/plan/match/code_hash.h"

/* What a library weighs or prefers: each with its number, and a hash of what it is about. */
typedef struct leaning {
    const char *name, *number;
    uint64_t about[2];
    bool met; /* has it been compared? */
} leaning;

typedef struct side {
    leaning *items;
    uint32_t count;
} side;

/* Where differences go: the list of the answer. */
typedef struct telling {
    tn_list *list;
    tn_error *error;
    bool any;
} telling;

static bool make_room(side *s, uint32_t count)
{
    *s = (side){.items = calloc((size_t)count + 1, sizeof *s->items), .count = count};
    return s->items != NULL;
}

static tn_status read_weights(const tn_module *module, const tn_library_record *library, side *s, tn_error *error)
{
    tn_status status = make_room(s, library->weight_count) ? TN_OK : tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i < s->count; i++) {
        const tn_weight_record *weight = &module->WEIGHT_records[library->weight_first + i];
        s->items[i].name = tn_text(module, weight->name);
        s->items[i].number = tn_text(module, weight->factor);
        status = tn_code_hash(module, module->TERM_records[module->SUM_records[weight->sum].term_first].part,
                              s->items[i].about, error);
    }
    return status;
}

static tn_status read_preferences(const tn_module *module, const tn_library_record *library, side *s, tn_error *error)
{
    tn_status status = make_room(s, library->preference_count) ? TN_OK : tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i < s->count; i++) {
        const tn_preference_record *preference = &module->PREFERENCE_records[library->preference_first + i];
        const tn_term_record *term = &module->TERM_records[module->SUM_records[preference->sum].term_first + i];
        s->items[i].name = tn_text(module, preference->name);
        s->items[i].number = tn_text(module, term->factor);
        status = tn_code_hash(module, term->part, s->items[i].about, error);
    }
    return status;
}

/* before, after: or NULL. */
static tn_status tell(telling *t, const leaning *before, const leaning *after)
{
    tn_clause_change change = before && after ? TN_CLAUSE_CHANGED : after ? TN_CLAUSE_ADDED : TN_CLAUSE_REMOVED;
    tn_compared_weight *to = tn_message_add(&tn_message_compared_weight, t->list, t->error);
    if (!to)
        return TN_MEMORY;
    t->any = true;
    to->name = (after ? after : before)->name;
    to->change = tn_change_word(change);
    to->has_before = before != NULL;
    to->has_after = after != NULL;
    if (before) {
        mpq_set_str(to->before, before->number, 10);
        to->shown_before = tn_weight_text(to->before);
    }
    if (after) {
        mpq_set_str(to->after, after->number, 10);
        to->shown_after = tn_weight_text(to->after);
    }
    bool shown = (to->shown_before || !before) && (to->shown_after || !after);
    return shown ? TN_OK : tn_fail_memory(t->error);
}

/* Pairs those about the same: first those of the same number too, which did not change. */
static tn_status pair(side *sides, bool same_number, telling *t)
{
    tn_status status = TN_OK;
    for (leaning *b = sides[0].items; status == TN_OK && b < sides[0].items + sides[0].count; b++)
        for (leaning *a = sides[1].items; status == TN_OK && !b->met && a < sides[1].items + sides[1].count; a++) {
            bool same = strcmp(b->number, a->number) == 0;
            if (a->met || memcmp(b->about, a->about, sizeof b->about) != 0 || same != same_number)
                continue;
            b->met = a->met = true;
            if (!same)
                status = tell(t, b, a);
        }
    return status;
}

static tn_status tell_all(side *sides, telling *t)
{
    tn_status status = pair(sides, true, t);
    if (status == TN_OK)
        status = pair(sides, false, t);
    for (uint32_t b = 0; status == TN_OK && b < sides[0].count; b++)
        if (!sides[0].items[b].met)
            status = tell(t, &sides[0].items[b], NULL);
    for (uint32_t a = 0; status == TN_OK && a < sides[1].count; a++)
        if (!sides[1].items[a].met)
            status = tell(t, NULL, &sides[1].items[a]);
    return status;
}

/* read: read_weights or read_preferences. */
static tn_status compare(const tn_ready_library *const ready[2],
                         tn_status (*read)(const tn_module *, const tn_library_record *, side *, tn_error *),
                         telling *t)
{
    side sides[2] = {0};
    tn_status status = TN_OK;
    for (int i = 0; status == TN_OK && i < 2; i++)
        status = read(ready[i]->schema->module, ready[i]->record, &sides[i], t->error);
    if (status == TN_OK)
        status = tell_all(sides, t);
    free(sides[0].items);
    free(sides[1].items);
    return status;
}

tn_status tn_diff_leanings(const tn_ready_library *before, const tn_ready_library *after, tn_compared *compared,
                           tn_error *error)
{
    const tn_ready_library *const ready[2] = {before, after};
    telling weights = {(tn_list *)&compared->weights, error, false},
            preferences = {(tn_list *)&compared->preferences, error, false};
    tn_status status = compare(ready, read_weights, &weights);
    if (status == TN_OK)
        status = compare(ready, read_preferences, &preferences);
    compared->has_weights = weights.any;
    compared->has_preferences = preferences.any;
    return status;
}
