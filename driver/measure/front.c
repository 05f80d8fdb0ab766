/* Gathers what the picture of a front shows: distributions, a sample, the points and their table. */
#include "driver/measure/front.h"

#include <stdlib.h>

#include "driver/open/digits.h"
#include "runtime/chart/chart.h"
#include "runtime/plan/measure/bins.h"
#include "runtime/plan/measure/cloud.h"
#include "runtime/plan/measure/named.h"

#define SAMPLED 20000u

typedef struct showing {
    const tn_shown_front *of;
    tn_amount_unit unit[TN_WEIGHED_MAX];
    tn_chart_bar *bars[TN_WEIGHED_MAX];
    size_t bar_count[TN_WEIGHED_MAX];
    tn_cloud cloud;
    tn_chart_point *points[2 * TN_CHART_PANELS_MAX]; /* of each panel: the cloud's and the front's */
    size_t point_count;
    char **cells;
    size_t columns;
    tn_buffer title, about;
} showing;

static const char *name_of(const showing *s, uint32_t k)
{
    return tn_named_measure(s->of->ready->schema->module, s->of->measures[k]);
}

static double number_of(const showing *s, uint32_t k, const int64_t *values)
{
    mpq_t value;
    mpq_init(value);
    tn_weighed_value(s->of->weighed, k, values, value);
    tn_amount_convert(s->unit[k], value);
    double number = mpq_get_d(value);
    mpq_clear(value);
    return number;
}

/* ---- what there is of each measure */

static tn_status take_bars(showing *s, uint32_t k, const tn_distribution *d, tn_error *error)
{
    mpq_t value;
    s->bars[k] = calloc(d->count + 1, sizeof **s->bars);
    if (!s->bars[k])
        return tn_fail_memory(error);
    s->bar_count[k] = d->count;
    mpq_init(value);
    for (size_t i = 0; i < d->count; i++) {
        tn_distribution_value(d, i, value);
        tn_amount_convert(s->unit[k], value);
        double at = mpq_get_d(value);
        s->bars[k][i] = (tn_chart_bar){at, at, tn_bins_share(d->plans[i], d->all)};
    }
    mpq_clear(value);
    return TN_OK;
}

static tn_status find_bars(showing *s, uint32_t k, tn_error *error)
{
    tn_weighed *alone = NULL;
    tn_distribution d;
    tn_distribution_init(&d);
    tn_status status = tn_weighed_new(s->of->ready->library, &s->of->measures[k], 1, &alone, error);
    if (status == TN_OK)
        status = tn_distribution_make(&d, alone, error);
    if (status == TN_OK)
        status = take_bars(s, k, &d, error);
    tn_distribution_clear(&d);
    tn_weighed_free(alone);
    return status;
}

/* ---- the panels */

static tn_chart_point *points_of(const showing *s, uint32_t x, uint32_t y, bool front)
{
    size_t count = front ? s->of->front->count : s->cloud.count;
    tn_chart_point *points = calloc(count + 1, sizeof *points);
    for (size_t i = 0; points && i < count; i++) {
        const int64_t *values = front ? s->of->front->points[i].values : s->cloud.values[i];
        points[i] = (tn_chart_point){number_of(s, x, values), number_of(s, y, values)};
    }
    return points;
}

static tn_chart_axis axis_of(const showing *s, uint32_t k)
{
    return (tn_chart_axis){name_of(s, k), tn_amount_unit_name(s->unit[k]), s->of->most[k], s->bars[k], s->bar_count[k]};
}

static bool add_panel(showing *s, tn_front_drawing *d, uint32_t x, uint32_t y)
{
    tn_chart_point *cloud = points_of(s, x, y, false), *front = points_of(s, x, y, true);
    s->points[s->point_count++] = cloud;
    s->points[s->point_count++] = front;
    d->panels[d->panel_count++] = (tn_front_panel){.across = axis_of(s, x),
                                                   .up = axis_of(s, y),
                                                   .cloud = cloud,
                                                   .cloud_count = s->cloud.count,
                                                   .front = front,
                                                   .front_count = s->of->front->count,
                                                   .stairs = s->of->count == 2};
    return cloud && front;
}

/* ---- the table */

static bool put_row(showing *s, size_t i, char **cells)
{
    const tn_pareto_point *point = &s->of->front->points[i];
    bool ok = true;
    mpq_t value;
    mpz_t rank;
    mpq_init(value);
    mpz_init(rank);
    for (uint32_t k = 0; ok && k < s->of->count; k++) {
        tn_buffer text = {0};
        tn_weighed_value(s->of->weighed, k, point->values, value);
        ok = tn_amount_write(s->unit[k], value, &text);
        cells[k] = text.data;
    }
    ok = ok && tn_library_rank(s->of->ready->library, point->trays, point->length, rank);
    cells[s->of->count] = tn_digits(point->plans, true);
    cells[s->of->count + 1] = tn_digits(rank, true);
    mpq_clear(value);
    mpz_clear(rank);
    return ok && cells[s->of->count] && cells[s->of->count + 1];
}

static bool put_table(showing *s, tn_front_drawing *d)
{
    s->columns = s->of->count + 2;
    s->cells = calloc(s->of->front->count * s->columns + 1, sizeof *s->cells);
    bool ok = s->cells != NULL;
    for (size_t i = 0; ok && i < s->of->front->count; i++)
        ok = put_row(s, i, s->cells + i * s->columns);
    for (uint32_t k = 0; k < s->of->count; k++)
        d->headings[k] = name_of(s, k);
    d->headings[s->of->count] = "plans";
    d->headings[s->of->count + 1] = "rank of the first";
    d->cells = (const char *const *)s->cells;
    d->rows = s->of->front->count;
    d->columns = s->columns;
    return ok;
}

static bool put_titles(showing *s)
{
    bool ok = true;
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(s->of->ready->library, TN_ALL_LENGTHS, kept);
    for (uint32_t k = 0; ok && k < s->of->count; k++)
        ok = tn_buffer_printf(&s->title, "%s%s %s", k ? ", " : "", s->of->most[k] ? "most" : "least", name_of(s, k));
    char *all = tn_digits(kept, true);
    size_t points = s->of->front->count;
    ok = ok && all &&
         tn_buffer_printf(&s->about, "%zu point%s that no plan betters, of %s plans of %s", points,
                          points == 1 ? "" : "s", all,
                          tn_text(s->of->ready->schema->module, s->of->ready->record->name));
    free(all);
    mpz_clear(kept);
    return ok;
}

static void clear(showing *s)
{
    for (uint32_t k = 0; k < TN_WEIGHED_MAX; k++)
        free(s->bars[k]);
    for (size_t i = 0; i < s->point_count; i++)
        free(s->points[i]);
    for (size_t i = 0; s->cells && i < s->of->front->count * s->columns; i++)
        free(s->cells[i]);
    free(s->cells);
    free(s->title.data);
    free(s->about.data);
    tn_cloud_clear(&s->cloud);
}

tn_status tn_front_picture(const tn_shown_front *shown, tn_picture *to, tn_error *error)
{
    showing s = {.of = shown};
    tn_front_drawing d = {.note = "Red: the front. Green: 20,000 plans drawn evenly, the darker the more of them lie "
                                  "there, or all where there are fewer. The bars beside are of all plans."};
    tn_status status = TN_OK;
    for (uint32_t k = 0; status == TN_OK && k < shown->count; k++) {
        s.unit[k] = tn_amount_unit_shown(tn_amount_unit_of(shown->ready->schema, tn_weighed_power(shown->weighed, k)));
        status = find_bars(&s, k, error);
    }
    if (status == TN_OK)
        status = tn_cloud_make(&s.cloud, shown->weighed, 0, SAMPLED, error);
    if (status == TN_OK) {
        bool ok = put_titles(&s) && put_table(&s, &d);
        for (uint32_t y = 1; ok && y < shown->count; y++)
            for (uint32_t x = 0; ok && x < y; x++)
                ok = add_panel(&s, &d, x, y);
        d.title = s.title.data;
        d.about = s.about.data;
        status = ok ? tn_front_draw(&d, to, error) : tn_fail_memory(error);
    }
    clear(&s);
    return status;
}
