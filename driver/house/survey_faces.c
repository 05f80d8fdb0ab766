/* Finds the lines of faces that never decide anything: no two cells are so, or lines before them always do. */
#include <stdlib.h>

#include "driver/house/survey_parts.h"

static bool meets(const tn_cell_class *c, uint32_t line, bool second)
{
    uint32_t bit = 2 * line + second;
    return c->met[bit / 64] >> bit % 64 & 1;
}

static bool is_about(const tn_face_line_record *record, uint32_t line, const tn_survey_meeting *m)
{
    bool beside = record->relation == TN_FACE_BESIDE && (m->relation == TN_FACE_ALONG || m->relation == TN_FACE_ACROSS);
    if (!beside && record->relation != (uint32_t)m->relation)
        return false;
    if (m->relation == TN_FACE_OUTSIDE)
        return (record->side == TN_HOUSE_ANY_SIDE || record->side == (uint32_t)m->side) && meets(m->a, line, false);
    bool either = beside || m->relation == TN_FACE_ACROSS;
    return (meets(m->a, line, false) && meets(m->b, line, true)) ||
           (either && meets(m->b, line, false) && meets(m->a, line, true));
}

/* Has the line a kind that fits into every face? A lower roof keeps open sides out. */
static bool always_fits(const tn_survey *s, const tn_face_line_record *record)
{
    for (uint32_t i = 0; i < record->kind_count; i++) {
        uint32_t kind = s->form.module->HOUSE_ITEM_records[record->kind_first + i].number;
        if (kind < TN_FACE_KIND_COUNT && (kind != TN_FACE_OPEN || record->relation != TN_FACE_OUTSIDE))
            return true;
    }
    return false;
}

/* What is known of each line. hidden_by: a line that takes all such faces, or such into which a kind fits that both
 * have. */
typedef struct line_use {
    bool applies, reached;
    bool unnamed;        /* it has `cell(any)`, and a face beside a cell in the open is between such cells */
    uint32_t item_first; /* of its kinds */
    uint32_t hidden_by, hidden_kind; /* kind: TN_NO_RECORD where it takes all */
} line_use;

/* Which line had a kind first, among those about one meeting. */
typedef struct kind_use {
    size_t meeting;
    uint32_t line;
} kind_use;

/* A kind of a line: does it fit into some face that the line is about? If not, the one where it comes nearest to it. */
typedef struct line_kind {
    bool fits;
    tn_survey_meeting nearest;
} line_kind;

typedef struct asking {
    tn_survey *survey;
    line_use *lines;
    kind_use *kinds;
    line_kind *items;            /* [kind of a line], those of one line after those of the line before */
    size_t meeting;              /* from 1 */
    const tn_survey_meeting *of; /* the same */
    int64_t passes;              /* through what people pass in the meeting, the widest; 0: nothing */
    tn_status status;
    tn_error *error;
} asking;

static void add_all(uint64_t *set, const uint64_t *of, size_t words)
{
    for (size_t i = 0; i < words; i++)
        set[i] |= of[i];
}

/* The kind may be in a face of this meeting. */
static void note_use(const tn_survey *s, const tn_survey_meeting *m, tn_kind_use *use)
{
    uint64_t storey = UINT64_C(1) << m->a->storey;
    bool outside = m->relation == TN_FACE_OUTSIDE, under = m->relation == TN_FACE_UNDER;
    uint64_t *of = outside ? use->outside_of : under ? use->under_of : use->between_of;
    use->used = true;
    use->outside |= outside ? storey : 0;
    use->under |= under ? storey : 0;
    use->between |= outside || under ? 0 : storey;
    use->sides |= outside ? 1U << m->side : 0;
    add_all(of, m->a->functions, s->words);
    if (m->b)
        add_all(of, m->b->functions, s->words);
}

/* Which kinds of a line fit into faces that the line is about, whatever other lines say. */
static void ask_sizes(asking *a, const tn_survey_meeting *m, uint32_t line)
{
    const tn_survey *s = a->survey;
    const tn_face_line_record *record = &s->form.module->FACE_LINE_records[s->form.record->face_first + line];
    for (uint32_t i = 0; i < record->kind_count; i++) {
        line_kind *item = &a->items[a->lines[line].item_first + i];
        uint32_t kind = s->form.module->HOUSE_ITEM_records[record->kind_first + i].number;
        if (item->fits)
            continue;
        item->fits = tn_survey_may_fit(s, m, kind);
        if (!item->fits) {
            tn_survey_note_misfit(s, m, kind, &item->nearest);
            tn_survey_note_misfit(s, m, kind, &s->uses[kind].nearest);
        }
    }
}

/* The kinds of a line that is about the meeting, where no line before it takes all such faces. */
static void ask_kinds(asking *a, const tn_survey_meeting *m, uint32_t line)
{
    const tn_survey *s = a->survey;
    const tn_face_line_record *record = &s->form.module->FACE_LINE_records[s->form.record->face_first + line];
    for (uint32_t i = 0; i < record->kind_count; i++) {
        uint32_t kind = s->form.module->HOUSE_ITEM_records[record->kind_first + i].number;
        bool had = a->kinds[kind].meeting == a->meeting && a->kinds[kind].line != line;
        if (!had)
            a->kinds[kind] = (kind_use){a->meeting, line};
        if (!tn_survey_may_fit(s, m, kind))
            continue;
        note_use(s, m, &s->uses[kind]);
        int64_t passes = tn_survey_passes(s, a->of, kind);
        a->passes = passes > a->passes ? passes : a->passes;
        a->lines[line].reached |= !had;
        if (had) {
            a->lines[line].hidden_by = a->kinds[kind].line;
            a->lines[line].hidden_kind = kind;
        }
    }
}

/* Asks the lines about the meeting; beside a cell in the open those that name both cells. *taken: the first that takes
 * all such faces, or TN_NO_RECORD. */
static void ask_lines(asking *a, const tn_survey_meeting *m, bool open, uint32_t *taken)
{
    const tn_survey *s = a->survey;
    for (uint32_t i = 0; i < s->form.record->face_count; i++) {
        const tn_face_line_record *record = &s->form.module->FACE_LINE_records[s->form.record->face_first + i];
        if (!is_about(record, i, m))
            continue;
        if (open && !tn_form_names_both(&s->form, record)) {
            a->lines[i].unnamed = true;
            continue;
        }
        a->lines[i].applies = true;
        ask_sizes(a, m, i);
        if (*taken != TN_NO_RECORD) {
            a->lines[i].hidden_by = *taken;
            a->lines[i].hidden_kind = TN_NO_RECORD;
            continue;
        }
        ask_kinds(a, m, i);
        if (always_fits(s, record))
            *taken = i;
    }
}

/* The side of the cell that is not in the open, which meets one that is. */
static tn_house_side sheltered_side(const tn_survey_meeting *m, const tn_cell_class *sheltered)
{
    const tn_cell_class *other = sheltered == m->a ? m->b : m->a;
    if (m->relation == TN_FACE_ALONG)
        return sheltered == m->a ? TN_HOUSE_RIGHT : TN_HOUSE_LEFT;
    return sheltered->zone < other->zone ? TN_HOUSE_FRONT : TN_HOUSE_BACK;
}

/* Beside a cell in the open, lines that name both cells come first, then those outside of the other cell; between two
 * such cells is nothing without a line. */
static void ask_beside(asking *a, const tn_survey_meeting *m, uint32_t *taken)
{
    const tn_survey *s = a->survey;
    const tn_cell_class *sheltered = m->a->outdoor ? m->b : m->a, *other = m->a->outdoor ? m->a : m->b;
    ask_lines(a, m, true, taken);
    if (sheltered->outdoor) {
        a->passes = *taken == TN_NO_RECORD ? INT64_MAX : a->passes;
        return;
    }
    const tn_survey_meeting outside = {sheltered, NULL, TN_FACE_OUTSIDE, sheltered_side(m, sheltered)};
    add_all(s->shelters, other->functions, s->words);
    ask_lines(a, &outside, false, taken);
}

/* A cell in the open in the lowest storey is outside already. */
static void ask(asking *a, const tn_survey_meeting *m)
{
    uint32_t taken = TN_NO_RECORD;
    a->meeting++;
    a->passes = m->relation == TN_FACE_OUTSIDE && m->a->outdoor && m->a->storey == 0 ? INT64_MAX : 0;
    a->of = m;
    if (m->b && m->relation != TN_FACE_UNDER && (m->a->outdoor || m->b->outdoor))
        ask_beside(a, m, &taken);
    else
        ask_lines(a, m, false, &taken);
    if (a->passes > 0 && a->status == TN_OK)
        a->status = tn_survey_link(a->survey, m, a->passes, a->error);
}

static void ask_pair(asking *to, const tn_cell_class *a, const tn_cell_class *b)
{
    if (a->storey == b->storey) {
        ask(to, &(tn_survey_meeting){a, b, TN_FACE_ALONG, TN_HOUSE_ANY_SIDE});
        if (a->zone != b->zone)
            ask(to, &(tn_survey_meeting){a, b, TN_FACE_ACROSS, TN_HOUSE_ANY_SIDE});
    }
    if (a->zone == b->zone && a->storey + 1 == b->storey && !b->open)
        ask(to, &(tn_survey_meeting){a, b, TN_FACE_UNDER, TN_HOUSE_ANY_SIDE});
}

static void warn_hidden(const tn_survey *s, tn_diagnostic *d, const line_use *use)
{
    const tn_face_line_record *before = &s->form.module->FACE_LINE_records[s->form.record->face_first + use->hidden_by];
    tn_span place = TN_SURVEY_SPAN(before);
    if (use->hidden_kind == TN_NO_RECORD)
        tn_note(tn_survey_list(s), d, &place, "this line takes such faces, and has a kind that always fits");
    else
        tn_note(tn_survey_list(s), d, &place, "this line takes such faces wherever `%s` fits",
                tn_form_kind_text(&s->form, use->hidden_kind));
    tn_help(tn_survey_list(s), d, "the first line that applies counts: put this one before that");
}

#define OPENING_NEEDS                                                                                                  \
    "an opening needs a face as wide as itself and a `wall` added, and a storey as high as its `sill` and `high` "     \
    "added"

/* Does nothing else say already that the kind fits nowhere? */
static bool is_misfit(const asking *a, uint32_t line, uint32_t number, uint32_t *kind)
{
    const tn_survey *s = a->survey;
    const tn_face_line_record *record = &s->form.module->FACE_LINE_records[s->form.record->face_first + line];
    *kind = s->form.module->HOUSE_ITEM_records[record->kind_first + number].number;
    return !a->items[a->lines[line].item_first + number].fits && s->uses[*kind].used;
}

/* Does a kind of the line fit into one of the faces that it is about, whatever lines before it do? */
static bool fits_somewhere(const asking *a, uint32_t line, uint32_t kinds)
{
    bool fits = false;
    for (uint32_t i = 0; i < kinds; i++)
        fits = fits || a->items[a->lines[line].item_first + i].fits;
    return fits;
}

static void warn_idle(const asking *a, uint32_t line)
{
    const tn_survey *s = a->survey;
    const line_use *use = &a->lines[line];
    const tn_face_line_record *record = &s->form.module->FACE_LINE_records[s->form.record->face_first + line];
    bool hidden = use->hidden_by != TN_NO_RECORD && fits_somewhere(a, line, record->kind_count);
    tn_diagnostic *d = tn_report(tn_survey_list(s), W_FACE_LINE_IDLE, TN_SURVEY_SPAN(record),
                                 !use->applies && use->unnamed ? "a line with `cell(any)` decides no such face"
                                 : !use->applies               ? "no face is between such cells"
                                 : hidden                      ? "this line decides no face: others before it do"
                                                               : "this line decides no face: none of its kinds fits");
    if (!use->applies && use->unnamed)
        tn_help(tn_survey_list(s), d,
                "beside a cell in the open, lines count that name both cells, then those `outside` of the other cell: "
                "write what the cells are, not `cell(any)`");
    else if (!use->applies)
        tn_help(tn_survey_list(s), d, "check the storey, the zone and the function that it names");
    else if (hidden)
        warn_hidden(s, d, use);
    for (uint32_t i = 0, kind; use->applies && !hidden && i < record->kind_count; i++)
        if (is_misfit(a, line, i, &kind))
            tn_survey_say_misfit(s, d, &a->items[use->item_first + i].nearest, kind);
    if (use->applies && !hidden)
        tn_help(tn_survey_list(s), d, record->relation == TN_FACE_UNDER ? TN_FLIGHT_NEEDS : OPENING_NEEDS);
}

/* A line that decides faces has a kind that fits into none of those that it is about. */
static void warn_misfit(const asking *a, uint32_t line, uint32_t number, uint32_t kind)
{
    const tn_survey *s = a->survey;
    const tn_face_line_record *record = &s->form.module->FACE_LINE_records[s->form.record->face_first + line];
    tn_diagnostic *d = tn_report(tn_survey_list(s), W_FACE_LINE_IDLE, TN_SURVEY_SPAN(record),
                                 "`%s` fits into no face that this line is about", tn_form_kind_text(&s->form, kind));
    tn_survey_say_misfit(s, d, &a->items[a->lines[line].item_first + number].nearest, kind);
    tn_help(tn_survey_list(s), d, "change its size, or the cells that the line is about, or leave it out of this line");
}

static void warn(const asking *a, uint32_t line)
{
    const tn_survey *s = a->survey;
    const tn_face_line_record *record = &s->form.module->FACE_LINE_records[s->form.record->face_first + line];
    if (tn_survey_allows(s, W_FACE_LINE_IDLE, TN_SURVEY_SPAN(record)))
        return;
    if (!a->lines[line].reached) {
        warn_idle(a, line);
        return;
    }
    for (uint32_t i = 0, kind; i < record->kind_count; i++)
        if (is_misfit(a, line, i, &kind))
            warn_misfit(a, line, i, kind);
}

static void ask_all(asking *to)
{
    const tn_survey *s = to->survey;
    for (size_t a = 0; a < s->class_count; a++) {
        for (size_t b = 0; b < s->class_count; b++)
            ask_pair(to, &s->classes[a], &s->classes[b]);
        for (int side = TN_HOUSE_BACK; side < TN_HOUSE_SIDE_COUNT; side++)
            ask(to, &(tn_survey_meeting){&s->classes[a], NULL, TN_FACE_OUTSIDE, (tn_house_side)side});
    }
    for (uint32_t i = 0; s->opened && i < s->form.record->face_count; i++)
        warn(to, i);
}

tn_status tn_survey_faces(tn_survey *s, tn_error *error)
{
    uint32_t lines = s->form.record->face_count;
    size_t kinds = TN_FACE_KIND_COUNT + (size_t)s->form.record->opening_count;
    if (s->class_count * s->class_count * lines > 100000000) {
        for (size_t i = 0; i < kinds; i++)
            s->uses[i].used = true; /* nothing is known */
        return TN_OK;
    }
    s->met = true;
    size_t items = 0;
    for (uint32_t i = 0; i < lines; i++)
        items += s->form.module->FACE_LINE_records[s->form.record->face_first + i].kind_count;
    asking to = {.survey = s,
                 .lines = calloc((size_t)lines + 1, sizeof *to.lines),
                 .kinds = calloc(kinds, sizeof *to.kinds),
                 .items = calloc(items + 1, sizeof *to.items),
                 .error = error};
    tn_status status = to.lines && to.kinds && to.items ? TN_OK : tn_fail_memory(error);
    for (uint32_t i = 0, first = 0; status == TN_OK && i < lines; i++) {
        to.lines[i] = (line_use){.item_first = first, .hidden_by = TN_NO_RECORD};
        first += s->form.module->FACE_LINE_records[s->form.record->face_first + i].kind_count;
    }
    if (status == TN_OK) {
        ask_all(&to);
        status = to.status;
    }
    free(to.lines);
    free(to.kinds);
    free(to.items);
    return status;
}
