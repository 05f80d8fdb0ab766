/* Which kinds of faces are too large for the cells that a line of faces is about, and what they lack there. */
#include "driver/house/survey_parts.h"
#include "runtime/house/solids.h"

static int64_t least(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

/* How large the largest such cells are where they meet, along the row and from back to front. */
static int64_t wide(const tn_survey_meeting *m)
{
    return m->b ? least(m->a->wide, m->b->wide) : m->a->wide;
}

static int64_t deep(const tn_survey_meeting *m)
{
    return m->b ? least(m->a->deep, m->b->deep) : m->a->deep;
}

/* Does an upright face run along the row? */
static bool runs_in_x(const tn_survey_meeting *m)
{
    return m->relation == TN_FACE_OUTSIDE ? m->side == TN_HOUSE_BACK || m->side == TN_HOUSE_FRONT
                                          : m->relation == TN_FACE_ACROSS;
}

/* How long it is. */
static int64_t length_of(const tn_survey_meeting *m)
{
    return runs_in_x(m) ? wide(m) : deep(m);
}

/* ---- what is in the way; what comes later in the list is nearer to fitting */

typedef enum misfit { FURNISHED, UNEVEN, CRAMPED, LOW, FITS } misfit;

/* May a cell be without furniture? */
static bool is_bare(const tn_survey *s, const tn_cell_class *cell)
{
    for (size_t i = 0; i < s->words; i++)
        if (cell->functions[i] & s->bare_functions[i])
            return true;
    return cell->open;
}

static bool may_climb(const tn_survey *s, const tn_survey_meeting *m, const tn_opening_record *flight)
{
    tn_cell cells[2] = {{.function = TN_NO_FUNCTION}, {.function = TN_NO_FUNCTION}};
    const tn_house house = {.form = &s->form, .cells = cells, .cell_count = 2};
    const tn_face face = {
        .second = 1, .relation = TN_FACE_UNDER, .storey = m->a->storey, .at = {0, wide(m), 0, deep(m)}};
    return tn_flight_fits(&house, &face, flight);
}

static misfit misfit_of(const tn_survey *s, const tn_survey_meeting *m, uint32_t kind)
{
    const tn_opening_record *opening = tn_form_declared(&s->form, kind);
    if (!opening)
        return FITS;
    if (tn_form_flight(&s->form, kind))
        return !is_bare(s, m->a) || !is_bare(s, m->b)                          ? FURNISHED
               : tn_flight_size_in(&s->form, m->a->storey, opening).steps == 0 ? UNEVEN
               : !may_climb(s, m, opening)                                     ? CRAMPED
                                                                               : FITS;
    return tn_opening_needs(&s->form, opening, runs_in_x(m)) > length_of(m)        ? CRAMPED
           : opening->sill + opening->high > tn_form_clear(&s->form, m->a->storey) ? LOW
                                                                                   : FITS;
}

bool tn_survey_may_fit(const tn_survey *s, const tn_survey_meeting *m, uint32_t kind)
{
    return misfit_of(s, m, kind) == FITS;
}

void tn_survey_note_misfit(const tn_survey *s, const tn_survey_meeting *m, uint32_t kind, tn_survey_meeting *nearest)
{
    if (nearest->a) {
        misfit now = misfit_of(s, m, kind), before = misfit_of(s, nearest, kind);
        bool flight = tn_form_flight(&s->form, kind);
        double size = flight ? (double)wide(m) * (double)deep(m) : (double)length_of(m),
               had = flight ? (double)wide(nearest) * (double)deep(nearest) : (double)length_of(nearest);
        bool higher = now == LOW && tn_form_clear(&s->form, m->a->storey) > tn_form_clear(&s->form, nearest->a->storey);
        if (now < before || (now == before && !higher && (now == LOW || size <= had)))
            return;
    }
    *nearest = *m;
}

/* ---- saying it */

typedef struct length_text {
    char text[64];
} length_text;

static length_text written(const tn_survey *s, int64_t length)
{
    length_text to;
    tn_length_write_style(length, tn_house_length_style(&s->house), to.text, sizeof to.text);
    return to;
}

static const char *storey_name(const tn_survey *s, uint32_t storey)
{
    return tn_text(s->form.module, s->form.module->STOREY_records[s->form.record->storey_first + storey].name);
}

static void say_flight(const tn_survey *s, tn_diagnostic *d, const tn_survey_meeting *m, misfit why, uint32_t kind)
{
    const char *name = tn_form_kind_text(&s->form, kind), *storey = storey_name(s, m->a->storey);
    tn_flight_size size = tn_flight_size_in(&s->form, m->a->storey, tn_form_flight(&s->form, kind));
    int64_t thick = s->form.record->wall > s->form.record->partition ? s->form.record->wall : s->form.record->partition;
    if (why == FURNISHED)
        tn_note(tn_survey_list(s), d, NULL, "`%s` needs cells without tiles: all functions of these have some", name);
    else if (why == UNEVEN)
        tn_note(tn_survey_list(s), d, NULL, "storey `%s` is no whole number of the steps of `%s`, four or more", storey,
                name);
    else
        tn_note(
            tn_survey_list(s), d, NULL,
            "in storey `%s`, `%s` has %lld steps and needs %s by %s between the walls%s; the largest of these cells "
            "has %s by %s there",
            storey, name, (long long)size.steps, written(s, size.deep).text, written(s, size.wide).text,
            size.turns ? ", or less one way and more the other" : "", written(s, deep(m) - thick).text,
            written(s, wide(m) - thick).text);
}

static void say_cramped(const tn_survey *s, tn_diagnostic *d, const tn_survey_meeting *m, uint32_t kind)
{
    const tn_opening_record *opening = tn_form_opening(&s->form, kind);
    bool near = (runs_in_x(m) ? opening->near_x : opening->near_y) != TN_HOUSE_ANY_SIDE;
    tn_note(tn_survey_list(s), d, NULL,
            near ? "`%s`, where it is `near` an end and with half a `wall` at the other, takes %s, and the widest of "
                   "these faces is %s"
                 : "`%s` and a `wall` added are %s wide, and the widest of these faces is %s",
            tn_form_kind_text(&s->form, kind), written(s, tn_opening_needs(&s->form, opening, runs_in_x(m))).text,
            written(s, length_of(m)).text);
}

void tn_survey_say_misfit(const tn_survey *s, tn_diagnostic *d, const tn_survey_meeting *m, uint32_t kind)
{
    const tn_opening_record *opening = tn_form_declared(&s->form, kind);
    if (!m->a)
        return;
    misfit why = misfit_of(s, m, kind);
    if (tn_form_flight(&s->form, kind))
        say_flight(s, d, m, why, kind);
    else if (why == CRAMPED)
        say_cramped(s, d, m, kind);
    else
        tn_note(tn_survey_list(s), d, NULL, "`%s` ends %s above the floor, and the highest of these faces is %s",
                tn_form_kind_text(&s->form, kind), written(s, opening->sill + opening->high).text,
                written(s, tn_form_clear(&s->form, m->a->storey)).text);
}
