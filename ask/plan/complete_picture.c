/* Draws what may still be chosen in an open plan. */
#include <stdlib.h>

#include "ask/plan/best.h"
#include "driver/open/digits.h"
#include "runtime/plan/measure/bins.h"
#include "runtime/plan/picture/draw_open.h"

char *tn_open_best_text(const tn_open_choices *c, size_t at)
{
    mpq_t value;
    if (!c->found.best || c->found.best[at] == TN_NO_BEST)
        return NULL;
    mpq_init(value);
    mpq_set_si(value, c->found.best[at], 1);
    mpq_mul(value, value, c->step);
    char *text = tn_wish_text(&c->wishes, 0, value);
    mpq_clear(value);
    return text;
}

void tn_open_best_name(const tn_open_choices *c, char *text, size_t size)
{
    snprintf(text, size, "%s %.200s", c->wishes.most[0] ? "most" : "least", c->wishes.names[0]);
}

static bool take_choices(const tn_open_choices *c, tn_drawn_choice *choices)
{
    bool ok = true;
    for (uint32_t t = 0; t < c->found.trays; t++)
        for (uint32_t f = 0; f < c->schema->field_count; f++)
            for (uint32_t v = 0; ok && v < c->schema->fields[f].value_count; v++) {
                size_t at = tn_open_choice_at(c, t, f, v);
                tn_drawn_choice *choice = choices++;
                choice->share = tn_bins_share(c->found.counts[at], c->found.plans);
                choice->count = tn_digits(c->found.counts[at], true);
                choice->best = tn_open_best_text(c, at);
                ok = choice->count && (choice->best || !c->found.best || c->found.best[at] == TN_NO_BEST);
            }
    return ok;
}

static tn_status draw_choices(const tn_open_choices *c, const tn_drawn_choice *choices, tn_picture *to, tn_error *error)
{
    char about[512], best[256] = "";
    char *plans = tn_digits(c->found.plans, true);
    if (!plans)
        return tn_fail_memory(error);
    if (c->found.best)
        tn_open_best_name(c, best, sizeof best);
    snprintf(about, sizeof about, "%.200s %s complete the open plan%s%s%s", plans, c->what,
             c->found.best ? "; beside each count the " : "", c->found.best ? best : "",
             c->found.best ? " that is left" : "");
    free(plans);
    const tn_drawn_open open = {.title = c->title,
                                .doc = c->doc,
                                .about = about,
                                .best_name = c->found.best ? best : NULL,
                                .functions = c->spelled.functions,
                                .count = c->open.count,
                                .choices = choices};
    return tn_open_plan_draw(c->spelled.schema ? c->spelled.schema : c->schema, &open, to, error);
}

tn_status tn_open_choices_draw(const tn_open_choices *c, tn_picture *to, tn_error *error)
{
    size_t count = (size_t)c->found.trays * c->found.values;
    tn_drawn_choice *choices = calloc(count + 1, sizeof *choices);
    tn_status status = choices && take_choices(c, choices) ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK)
        status = draw_choices(c, choices, to, error);
    for (size_t i = 0; choices && i < count; i++) {
        free((char *)(uintptr_t)choices[i].count);
        free((char *)(uintptr_t)choices[i].best);
    }
    free(choices);
    return status;
}
