/* Says of stairs that take their whole cell which flight could be written for them. */
#include "driver/house/survey_parts.h"
#include "runtime/house/solids.h"

/* Flights as they are often built, the widest first: in feet, in metres. */
typedef struct usual_flight {
    const char *text;
    tn_turn turn;
    int64_t wide; /* in inches, or millimetres, as the others */
    int64_t rise_least, rise_most, going;
} usual_flight;

static const usual_flight in_feet[] = {
    {"wide 3' rise 6\"..7 3/4\" going 10\" turn half", TN_TURN_HALF, 36, 24, 31, 10},
    {"wide 3' rise 6\"..7 3/4\" going 10\"", TN_TURN_STRAIGHT, 36, 24, 31, 10},
    {"wide 3' rise 6\"..7 3/4\" going 10\" turn quarter", TN_TURN_QUARTER, 36, 24, 31, 10},
    {"wide 2'9\" rise 6\"..7 3/4\" going 10\" turn half", TN_TURN_HALF, 33, 24, 31, 10},
};
static const usual_flight in_metres[] = {
    {"wide 900mm rise 150mm..195mm going 250mm turn half", TN_TURN_HALF, 900, 600, 780, 250},
    {"wide 900mm rise 150mm..195mm going 250mm", TN_TURN_STRAIGHT, 900, 600, 780, 250},
    {"wide 900mm rise 150mm..195mm going 250mm turn quarter", TN_TURN_QUARTER, 900, 600, 780, 250},
    {"wide 850mm rise 150mm..200mm going 240mm turn half", TN_TURN_HALF, 850, 600, 800, 240},
};

static tn_opening_record record_of(const usual_flight *flight, int64_t unit)
{
    return (tn_opening_record){.wide = flight->wide * unit,
                               .rise_least = flight->rise_least * unit / 4, /* these are written in quarters */
                               .rise_most = flight->rise_most * unit / 4,
                               .going = flight->going * unit,
                               .turn = flight->turn};
}

static bool is_first(const tn_cell_class *cell, uint32_t line)
{
    return cell->met[2 * line / 64] >> 2 * line % 64 & 1;
}

/* Is some cell below, of those that the line names, large enough for it? */
static bool has_room(const tn_survey *s, uint32_t line, const tn_opening_record *flight)
{
    tn_cell cells[2] = {{.function = TN_NO_FUNCTION}, {.function = TN_NO_FUNCTION}};
    const tn_house house = {.form = &s->form, .cells = cells, .cell_count = 2};
    for (size_t i = 0; i < s->class_count; i++) {
        const tn_cell_class *c = &s->classes[i];
        const tn_face face = {
            .second = 1, .relation = TN_FACE_UNDER, .storey = c->storey, .at = {0, c->wide, 0, c->deep}};
        if (!c->open && c->storey + 1 < s->form.record->storey_count && is_first(c, line) &&
            tn_flight_fits(&house, &face, flight))
            return true;
    }
    return false;
}

/* The first usual flight that some such cell has room for; NULL: none. */
static const usual_flight *find_flight(const tn_survey *s, uint32_t line)
{
    bool feet = tn_house_length_style(&s->house) == TN_STYLE_FEET;
    const usual_flight *usual = feet ? in_feet : in_metres;
    for (size_t i = 0; i < sizeof in_feet / sizeof *in_feet; i++) {
        tn_opening_record flight = record_of(&usual[i], feet ? TN_INCH_NM : INT64_C(1000000));
        if (has_room(s, line, &flight))
            return &usual[i];
    }
    return NULL;
}

static bool names_stair(const tn_survey *s, const tn_face_line_record *line)
{
    for (uint32_t k = 0; k < line->kind_count; k++)
        if (s->form.module->HOUSE_ITEM_records[line->kind_first + k].number == TN_FACE_STAIR)
            return true;
    return false;
}

static void warn(const tn_survey *s, uint32_t line)
{
    const tn_face_line_record *record = &s->form.module->FACE_LINE_records[s->form.record->face_first + line];
    if (tn_survey_allows(s, W_STAIR, TN_SURVEY_SPAN(record)))
        return;
    const usual_flight *flight = s->met ? find_flight(s, line) : NULL;
    tn_diagnostic *d = tn_report(tn_survey_list(s), W_STAIR, TN_SURVEY_SPAN(record),
                                 "a `stair` takes its whole cell, and has no steps that one could climb");
    if (flight)
        tn_help(tn_survey_list(s), d,
                "add the line `flight stairs %s`, for which some of these cells have room, and write `stairs` here",
                flight->text);
    else
        tn_help(
            tn_survey_list(s), d,
            "name a flight here (`flight NAME wide LENGTH rise LENGTH..LENGTH going LENGTH`); make the cells larger "
            "if none has room for one");
}

void tn_survey_stairs(const tn_survey *s)
{
    for (uint32_t i = 0; i < s->form.record->face_count; i++)
        if (names_stair(s, &s->form.module->FACE_LINE_records[s->form.record->face_first + i])) {
            warn(s, i);
            return;
        }
}
