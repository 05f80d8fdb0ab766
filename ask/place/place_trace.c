/* Says line by line what became of each alternative while a model was placed. */
#include <inttypes.h>

#include "ask/place/placing.h"

static void write_place(const tn_model_placing *p, tn_span span, FILE *out)
{
    tn_place place = tn_sources_place(&p->session->opened->compilation.sources, span);
    fprintf(out, "%s:%zu", place.path, place.line);
}

static void write_step(const tn_model_placing *p, uint32_t step, FILE *out)
{
    size_t length;
    const char *text = tn_step_text(&p->rules, &p->rules.steps[step], &length);
    fprintf(out, "'%.*s' of ", (int)length, text);
    write_place(p, tn_place_step_span(&p->rules, step), out);
}

static void write_refusal(const tn_model_placing *p, const tn_place_event *event, FILE *out)
{
    const tn_place_obstacle *o = &event->obstacle;
    fputs("does not fit: ", out);
    write_step(p, event->step, out);
    if (!o->known) {
        fputs(" has nothing to touch", out);
    } else if (!o->has_step) {
        fprintf(out, " meets %s at %d %d %d", p->rules.space ? "the end of the space" : "a bound", o->cell[0],
                o->cell[1], o->cell[2]);
    } else {
        fprintf(out, " meets, at %d %d %d, what ", o->cell[0], o->cell[1], o->cell[2]);
        write_step(p, o->step, out);
        fprintf(out, " filled after %u part%s", o->parts, o->parts == 1 ? "" : "s");
    }
}

void tn_placing_trace(const tn_model_placing *p, const tn_place_event *event)
{
    static const char *const words[] = {"", "is taken", "is drawn", "is taken although it does not fit"};
    const tn_place_rules *rules = &p->rules;
    const tn_frame *frame = event->frame;
    FILE *out = p->trace.stream;
    fprintf(out, "%zu part%s", event->parts, event->parts == 1 ? "" : "s");
    if (frame)
        fprintf(out, ", at %d %d %d heading %u", frame->at[0], frame->at[1], frame->at[2], frame->heading);
    fprintf(out, ": %s of ", rules->symbols[tn_place_symbol_of(rules, event->alternative)].name);
    write_place(p, tn_place_alternative_span(rules, event->alternative), out);
    fputc(' ', out);
    if (event->outcome == TN_PLACE_REFUSED)
        write_refusal(p, event, out);
    else if (rules->space && rules->alternatives[event->alternative].count == 0)
        fputs("is left open", out);
    else
        fputs(words[event->outcome], out);
    fputc('\n', out);
}
