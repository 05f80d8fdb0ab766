/* Finds the lines of faces that never decide anything: no two cells are so, or lines before them always do. */
#include <stdlib.h>

#include "driver/house/survey_parts.h"

/* Two cells that may meet, or one and the outside: more than really do, so that what is said holds. */
typedef struct meeting {
    const tn_cell_class *a, *b; /* along: a is left of b; under: a is below b; outside: b is NULL */
    tn_face_relation relation;  /* ALONG, ACROSS, UNDER or OUTSIDE */
    tn_house_side side;
} meeting;

static bool meets(const tn_cell_class *c, uint32_t line, bool second)
{
    uint32_t bit = 2 * line + second;
    return c->met[bit / 64] >> bit % 64 & 1;
}

static bool is_about(const tn_face_line_record *record, uint32_t line, const meeting *m)
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

/* Has the line a kind that fits into every face? */
static bool always_fits(const tn_survey *s, const tn_face_line_record *record)
{
    for (uint32_t i = 0; i < record->kind_count; i++)
        if (s->form.module->HOUSE_ITEM_records[record->kind_first + i].number < TN_FACE_KIND_COUNT)
            return true;
    return false;
}

/* What is known of each line. */
typedef struct line_use {
    bool applies, reached;
    uint32_t hidden_by;
} line_use;

static void ask(const tn_survey *s, const meeting *m, line_use *uses)
{
    uint32_t taken = TN_NO_RECORD;
    for (uint32_t i = 0; i < s->form.record->face_count; i++) {
        const tn_face_line_record *record = &s->form.module->FACE_LINE_records[s->form.record->face_first + i];
        if (!is_about(record, i, m))
            continue;
        uses[i].applies = true;
        if (taken == TN_NO_RECORD)
            uses[i].reached = true;
        else
            uses[i].hidden_by = taken;
        if (taken == TN_NO_RECORD && always_fits(s, record))
            taken = i;
    }
}

static void ask_pair(const tn_survey *s, const tn_cell_class *a, const tn_cell_class *b, line_use *uses)
{
    if (a->storey == b->storey) {
        ask(s, &(meeting){a, b, TN_FACE_ALONG, TN_HOUSE_ANY_SIDE}, uses);
        if (a->zone != b->zone)
            ask(s, &(meeting){a, b, TN_FACE_ACROSS, TN_HOUSE_ANY_SIDE}, uses);
    }
    if (a->zone == b->zone && a->storey + 1 == b->storey && !b->open)
        ask(s, &(meeting){a, b, TN_FACE_UNDER, TN_HOUSE_ANY_SIDE}, uses);
}

static void warn(const tn_survey *s, uint32_t line, const line_use *use)
{
    tn_diagnostics *list = &s->opened->compilation.diagnostics;
    const tn_face_line_record *records = s->form.module->FACE_LINE_records + s->form.record->face_first;
    tn_span span = {records[line].file, records[line].begin, records[line].end};
    if (tn_survey_allows(s, W_FACE_LINE_IDLE, span))
        return;
    tn_diagnostic *d =
        tn_report(list, W_FACE_LINE_IDLE, span,
                  use->applies ? "this line decides no face: others before it do" : "no face is between such cells");
    if (!use->applies) {
        tn_help(list, d, "check the storey, the zone and the function that it names");
        return;
    }
    const tn_face_line_record *before = &records[use->hidden_by];
    tn_span place = {before->file, before->begin, before->end};
    tn_note(list, d, &place, "this line takes such faces, and has a kind that always fits");
    tn_help(list, d, "the first line that applies counts: put this one before that");
}

tn_status tn_survey_faces(tn_survey *s, tn_error *error)
{
    uint32_t lines = s->form.record->face_count;
    if (s->class_count * s->class_count * lines > 100000000)
        return TN_OK;
    line_use *uses = calloc((size_t)lines + 1, sizeof *uses);
    if (!uses)
        return tn_fail_memory(error);
    for (size_t a = 0; a < s->class_count; a++) {
        for (size_t b = 0; b < s->class_count; b++)
            ask_pair(s, &s->classes[a], &s->classes[b], uses);
        for (int side = TN_HOUSE_BACK; side < TN_HOUSE_SIDE_COUNT; side++)
            ask(s, &(meeting){&s->classes[a], NULL, TN_FACE_OUTSIDE, (tn_house_side)side}, uses);
    }
    for (uint32_t i = 0; i < lines; i++)
        if (!uses[i].reached)
            warn(s, i, &uses[i]);
    free(uses);
    return TN_OK;
}
