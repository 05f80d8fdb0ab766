/* What the files of the C interface to measures share. */
#ifndef TARTAN_API_PLAN_MEASURE_DATA_H
#define TARTAN_API_PLAN_MEASURE_DATA_H

#include "api/plan/plan.h"
#include "runtime/plan/measure/amount.h"
#include "runtime/plan/measure/weighed.h"

/* Wishes made ready: the library weighed by their measures. */
typedef struct tn_api_wishes {
    tn_weighed *weighed;
    uint32_t count;
    bool most[TN_WEIGHED_MAX];
    tn_amount_unit unit[TN_WEIGHED_MAX];
} tn_api_wishes;

/* `least` wishes are needed. Clear in any case. */
tartan_status tn_api_wishes_take(const tartan_library *library, const tartan_wish *given, size_t count, size_t least,
                                 tn_api_wishes *wishes, tartan_error *error);
void tn_api_wishes_clear(tn_api_wishes *wishes);

/* A value in steps as a new text; one in nanometres. */
tartan_status tn_api_wish_value(const tn_api_wishes *wishes, size_t wish, const int64_t *values, char **value,
                                tartan_error *error);
tartan_status tn_api_amount(tn_amount_unit unit, const mpq_t value, char **text, tartan_error *error);

/* The MEASURE record named so, of the library's trays. */
tartan_status tn_api_measure_find(const tartan_library *library, const char *name, uint32_t *measure,
                                  tartan_error *error);
tn_amount_unit tn_api_measure_unit(const tartan_library *library, uint32_t measure);

#endif
