/* The C interface to the best plans of a library, and to fronts. */
#include "runtime/plan/measure/best.h"

#include <stdlib.h>

#include "api/plan/measure_data.h"
#include "runtime/plan/measure/pareto.h"

struct tartan_best {
    tn_api_wishes wishes;
    tn_best *best;
    tn_tray *trays;
    int64_t values[TN_WEIGHED_MAX];
    bool stepped; /* on a plan */
};

struct tartan_front {
    tn_api_wishes wishes;
    tn_pareto_front front;
};

/* ---- best plans */

tartan_status tartan_best_new(const tartan_library *library, const tartan_wish *wishes, size_t count,
                              tartan_best **best, tartan_error *error)
{
    tn_error found;
    tartan_best *made = calloc(1, sizeof *made);
    if (!made)
        return tn_api_memory(error);
    tartan_status status = tn_api_wishes_take(library, wishes, count, 1, &made->wishes, error);
    if (status == TARTAN_OK) {
        made->trays = calloc((size_t)tn_library_max(library->library) + 1, sizeof *made->trays);
        status = made->trays ? TARTAN_OK : tn_api_memory(error);
    }
    if (status == TARTAN_OK && tn_best_new(made->wishes.weighed, made->wishes.most, &made->best, &found) != TN_OK)
        status = tn_api_fail(&found, error);
    if (status == TARTAN_OK)
        *best = made;
    else
        tartan_best_free(made);
    return status;
}

void tartan_best_free(tartan_best *best)
{
    if (!best)
        return;
    tn_best_free(best->best);
    tn_api_wishes_clear(&best->wishes);
    free(best->trays);
    free(best);
}

tartan_status tartan_best_next(tartan_best *best, const uint32_t **trays, size_t *length, bool *found,
                               tartan_error *error)
{
    tn_error failed;
    uint32_t count = 0;
    bool more = false;
    if (!best)
        return tn_api_missing(error, "object of best plans");
    tn_status status = tn_best_next(best->best, best->trays, &count, best->values, &more, &failed);
    best->stepped = status == TN_OK && more;
    if (status != TN_OK)
        return tn_api_fail(&failed, error);
    *found = more;
    if (more) {
        *trays = best->trays;
        *length = count;
    }
    return TARTAN_OK;
}

tartan_status tartan_best_value(const tartan_best *best, size_t wish, char **value, tartan_error *error)
{
    if (!best)
        return tn_api_missing(error, "object of best plans");
    if (!best->stepped)
        return tn_api_refuse(error, TARTAN_INVALID, "there is no plan at hand");
    return tn_api_wish_value(&best->wishes, wish, best->values, value, error);
}

/* ---- fronts */

tartan_status tartan_front_new(const tartan_library *library, const tartan_wish *wishes, size_t count,
                               tartan_front **front, tartan_error *error)
{
    tn_error found;
    tartan_front *made = calloc(1, sizeof *made);
    if (!made)
        return tn_api_memory(error);
    tartan_status status = tn_api_wishes_take(library, wishes, count, 2, &made->wishes, error);
    if (status == TARTAN_OK && tn_pareto_make(&made->front, made->wishes.weighed, made->wishes.most, &found) != TN_OK)
        status = tn_api_fail(&found, error);
    if (status == TARTAN_OK)
        *front = made;
    else
        tartan_front_free(made);
    return status;
}

void tartan_front_free(tartan_front *front)
{
    if (!front)
        return;
    tn_pareto_clear(&front->front);
    tn_api_wishes_clear(&front->wishes);
    free(front);
}

size_t tartan_front_count(const tartan_front *front)
{
    return front->front.count;
}

static tartan_status check_point(const tartan_front *front, size_t point, tartan_error *error)
{
    if (!front)
        return tn_api_missing(error, "front");
    if (point >= front->front.count)
        return tn_api_refuse(error, TARTAN_INVALID, "the front has no point %zu", point);
    return TARTAN_OK;
}

tartan_status tartan_front_value(const tartan_front *front, size_t point, size_t wish, char **value,
                                 tartan_error *error)
{
    tartan_status status = check_point(front, point, error);
    if (status != TARTAN_OK)
        return status;
    return tn_api_wish_value(&front->wishes, wish, front->front.points[point].values, value, error);
}

tartan_status tartan_front_plans(const tartan_front *front, size_t point, char **plans, const uint32_t **trays,
                                 size_t *length, tartan_error *error)
{
    tartan_status status = check_point(front, point, error);
    if (status == TARTAN_OK)
        status = tn_api_decimal(front->front.points[point].plans, plans, error);
    if (status != TARTAN_OK)
        return status;
    *trays = front->front.points[point].trays;
    *length = front->front.points[point].length;
    return TARTAN_OK;
}
