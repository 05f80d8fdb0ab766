/* Can the trays of plans stand side by side in a form: are walls of neighbours nowhere nearer than they are thick?
 *
 * That is asked before anything is counted or listed, so that every question about a library says the same. It depends
 * on the depths of two neighbouring trays and on how many storeys their zones have, so trays of the same outline are
 * looked at once, and so are sections with the same storeys. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/count/data.h"
#include "runtime/house/count/houses.h"

typedef struct siding {
    const tn_houses *houses; /* the plans that are asked about */
    tn_frontier_trays trays;
    tn_house house;            /* scratch */
    tn_interner storeys;       /* of sections: what was looked at */
    tn_interner outlines;      /* of trays, in the section at hand */
    uint32_t *of_tray, *first; /* [trays]: outlines; [outlines]: the first tray of each */
    uint64_t *beside;          /* [outlines][words]: trays that can follow one of them */
    tn_numbering pairs;        /* outline << 32 | outline: stood side by side */
    tn_key key;
} siding;

static tn_status push_outline(siding *s, tn_error *error)
{
    bool ok = true;
    s->key.size = 0;
    for (size_t i = 0; ok && i < s->house.cell_count; i++) {
        const tn_cell *cell = &s->house.cells[i];
        ok = tn_key_push(&s->key, cell->storey) && tn_push_long(&s->key, (uint64_t)cell->at.y0) &&
             tn_push_long(&s->key, (uint64_t)cell->at.y1);
    }
    return ok ? TN_OK : tn_fail_memory(error);
}

static void add_followers(siding *s, uint32_t outline, tn_tray tray)
{
    size_t words = s->trays.words;
    for (size_t w = 0; w < words; w++)
        s->beside[outline * words + w] |= s->trays.follows ? s->trays.follows[tray * words + w] : UINT64_MAX;
}

static tn_status find_outlines(siding *s, const uint32_t *shapes, tn_error *error)
{
    const tn_house_form *form = s->houses->form;
    size_t count = form->schema->tray_count;
    tn_status status = TN_OK;
    tn_interner_clear(&s->outlines);
    tn_numbering_clear(&s->pairs);
    memset(s->beside, 0, (count + 1) * s->trays.words * sizeof *s->beside);
    for (tn_tray t = 0; status == TN_OK && t < count; t++) {
        if (!s->trays.stand[t])
            continue;
        status = tn_house_stand_again(form, &t, 1, shapes, &s->house, error);
        if (status == TN_OK)
            status = push_outline(s, error);
        uint32_t before = s->outlines.count,
                 at = status == TN_OK ? tn_intern(&s->outlines, s->key.data, s->key.size) : 0;
        if (at == UINT32_MAX)
            return tn_fail_memory(error);
        s->of_tray[t] = at;
        if (at == before)
            s->first[at] = t;
        add_followers(s, at, t);
    }
    return status;
}

/* The help is that of a house that does not stand. */
static tn_status name_pair(const siding *s, const tn_tray pair[2], tn_error *error)
{
    const tn_house_form *form = s->houses->form;
    tn_buffer line = {0};
    if (error->code == E_TOO_NEAR && tn_plan_write_line(form->schema, pair, 2, &line))
        tn_fail(error, TN_INVALID, E_TOO_NEAR,
                "walls of form `%.80s` would be nearer to each other than they are thick, in plans of `%.80s` with "
                "these trays side by side: %.200s",
                tn_text(form->module, form->record->name),
                tn_text(form->module, form->module->LIBRARY_records[s->houses->library->plans].name), line.data);
    if (line.data)
        tn_error_help(error,
                      "make the form's `wall` thinner, the depths of such trays equal or more different, or prune "
                      "plans with such neighbours");
    free(line.data);
    return error->status;
}

static tn_status stand_pairs(siding *s, const uint32_t *shapes, tn_error *error)
{
    size_t count = s->houses->form->schema->tray_count, words = s->trays.words;
    tn_status status = TN_OK;
    for (uint32_t o = 0; status == TN_OK && o < s->outlines.count; o++)
        for (tn_tray t = 0; status == TN_OK && t < count; t++) {
            if (!s->trays.stand[t] || !(s->beside[o * words + t / 64] >> t % 64 & 1))
                continue;
            uint32_t before = s->pairs.count, at = tn_number(&s->pairs, (uint64_t)o << 32 | s->of_tray[t]);
            const tn_tray pair[] = {s->first[o], t};
            if (at == UINT32_MAX)
                return tn_fail_memory(error);
            if (at == before && tn_house_stand_again(s->houses->form, pair, 2, shapes, &s->house, error) != TN_OK)
                status = name_pair(s, pair, error);
        }
    return status;
}

/* How many storeys the zones have is all that outlines depend on. */
static tn_status look_at(siding *s, const uint32_t *shapes, tn_error *error)
{
    const tn_house_form *form = s->houses->form;
    bool ok = true;
    tn_house_take_section(form, shapes, &s->house);
    if (!tn_house_section_stands(&s->house))
        return TN_OK;
    s->key.size = 0;
    for (uint32_t i = 0; ok && i < form->record->choice_count; i++)
        ok = tn_key_push(&s->key, tn_form_choice(form, i)->kind == TN_CHOICE_STOREYS ? shapes[i] : 0);
    uint32_t before = s->storeys.count, at = ok ? tn_intern(&s->storeys, s->key.data, s->key.size) : UINT32_MAX;
    if (at == UINT32_MAX)
        return tn_fail_memory(error);
    tn_status status = at == before ? find_outlines(s, shapes, error) : TN_OK;
    return status == TN_OK && at == before ? stand_pairs(s, shapes, error) : status;
}

static tn_status begin(siding *s, tn_error *error)
{
    size_t count = s->houses->form->schema->tray_count + 1;
    s->of_tray = malloc(count * sizeof *s->of_tray);
    s->first = malloc(count * sizeof *s->first);
    s->beside = tn_array_new(tn_size_of(count, s->trays.words), sizeof *s->beside);
    return s->of_tray && s->first && s->beside ? TN_OK : tn_fail_memory(error);
}

static void end(siding *s)
{
    tn_frontier_trays_clear(&s->trays);
    tn_house_clear(&s->house);
    tn_interner_clear(&s->storeys);
    tn_interner_clear(&s->outlines);
    tn_numbering_clear(&s->pairs);
    free(s->of_tray);
    free(s->first);
    free(s->beside);
    free(s->key.data);
}

tn_status tn_houses_check_walls(const tn_house_form *form, const tn_house_library_record *library,
                                const tn_library *plans, tn_error *error)
{
    tn_houses houses = {
        .form = form, .library = library, .plans = plans, .low = tn_library_min(plans), .high = tn_library_max(plans)};
    siding s = {.houses = &houses};
    uint32_t shapes[TN_CHOICES_MAX] = {0};
    houses.high = houses.high < houses.low ? houses.low : houses.high;
    tn_status status = tn_houses_plans_find(&houses, &s.trays, error);
    if (status == TN_OK)
        status = begin(&s, error);
    for (bool more = true; status == TN_OK && more; more = tn_form_next_section(form, shapes))
        status = look_at(&s, shapes, error);
    tn_houses_plans_clear(&houses);
    end(&s);
    return status;
}
