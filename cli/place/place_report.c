/* Summaries, figures and traces of placing, as text. */
#include <inttypes.h>
#include <stdlib.h>

#include "cli/place/place.h"
#include "driver/place/place.h"
#include "runtime/base/json.h"

tn_status tn_place_summary(const tn_placed_model *model, FILE *out, tn_error *error)
{
    tn_part_count *counts;
    size_t kinds;
    tn_status status = tn_place_count_parts(model, &counts, &kinds, error);
    if (status != TN_OK)
        return status;
    fprintf(out, "%zu part%s\n", model->count, model->count == 1 ? "" : "s");
    for (size_t i = 0; i < kinds; i++)
        fprintf(out, "%8" PRIu64 "  %s in colour %d\n", counts[i].count, counts[i].name, counts[i].colour);
    free(counts);
    return TN_OK;
}

typedef struct figure {
    const char *name, *what;
    uint64_t value;
} figure;

static void write_rows(const figure *rows, size_t count, bool json, FILE *out)
{
    tn_json writer = tn_json_file(out, TN_JSON_TIGHT);
    if (!json) {
        for (size_t i = 0; i < count; i++)
            fprintf(out, "%12" PRIu64 "  %s\n", rows[i].value, rows[i].what);
        return;
    }
    tn_json_object(&writer, NULL);
    for (size_t i = 0; i < count; i++)
        tn_json_count(&writer, rows[i].name, rows[i].value);
    tn_json_object_end(&writer);
    tn_json_end_line(&writer);
}

void tn_place_stats(const tn_placed_model *model, bool json, FILE *out)
{
    const tn_place_counts *c = &model->counts;
    if (c->looked_at > 0) {
        const figure searched[] = {{"elements", "parts placed", c->parts},
                                   {"models", "models looked at", c->looked_at},
                                   {"proved", "1: the rules allow no better one", c->proved}};
        write_rows(searched, sizeof searched / sizeof *searched, json, out);
        return;
    }
    const figure rows[] = {
        {"elements", "parts placed", c->parts},
        {"terminals", "steps taken", c->steps},
        {"expansions", "symbols expanded", c->expansions},
        {"random", "of these, by a draw", c->draws},
        {"tries", "alternatives looked at", c->tries},
        {"fallbacks", "times that none fitted", c->fallbacks},
        {"cells", "cells filled", c->cells},
        {"bounds", "bounds set", c->bounds},
    };
    write_rows(rows, sizeof rows / sizeof *rows, json, out);
}

/* ---- traces */

static void write_place(tn_job *job, tn_span span, FILE *out)
{
    tn_place place = tn_sources_place(&job->opened.compilation.sources, span);
    fprintf(out, "%s:%zu", place.path, place.line);
}

static void write_step(tn_job *job, const tn_place_rules *rules, uint32_t step, FILE *out)
{
    size_t length;
    const char *text = tn_step_text(rules, &rules->steps[step], &length);
    fprintf(out, "'%.*s' of ", (int)length, text);
    write_place(job, tn_place_step_span(rules, step), out);
}

static void write_refusal(tn_job *job, const tn_place_rules *rules, const tn_place_event *event, FILE *out)
{
    const tn_place_obstacle *o = &event->obstacle;
    fputs("does not fit: ", out);
    write_step(job, rules, event->step, out);
    if (!o->known) {
        fputs(" has nothing to touch", out);
    } else if (!o->has_step) {
        fprintf(out, " meets %s at %d %d %d", rules->space ? "the end of the space" : "a bound", o->cell[0], o->cell[1],
                o->cell[2]);
    } else {
        fprintf(out, " meets, at %d %d %d, what ", o->cell[0], o->cell[1], o->cell[2]);
        write_step(job, rules, o->step, out);
        fprintf(out, " filled after %u part%s", o->parts, o->parts == 1 ? "" : "s");
    }
}

void tn_place_trace(tn_job *job, const tn_place_rules *rules, const tn_place_event *event, FILE *out)
{
    static const char *const words[] = {"", "is taken", "is drawn", "is taken although it does not fit"};
    const tn_frame *frame = event->frame;
    fprintf(out, "%zu part%s", event->parts, event->parts == 1 ? "" : "s");
    if (frame)
        fprintf(out, ", at %d %d %d heading %u", frame->at[0], frame->at[1], frame->at[2], frame->heading);
    fprintf(out, ": %s of ", rules->symbols[tn_place_symbol_of(rules, event->alternative)].name);
    write_place(job, tn_place_alternative_span(rules, event->alternative), out);
    fputc(' ', out);
    if (event->outcome == TN_PLACE_REFUSED)
        write_refusal(job, rules, event, out);
    else if (rules->space && rules->alternatives[event->alternative].count == 0)
        fputs("is left open", out);
    else
        fputs(words[event->outcome], out);
    fputc('\n', out);
}
