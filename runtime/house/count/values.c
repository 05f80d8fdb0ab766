/* Values of measures, and how many houses have each. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/count/data.h"

void tn_value_counts_clear(tn_value_counts *counts)
{
    for (size_t i = 0; i < counts->count; i++)
        mpz_clear(counts->items[i].count);
    free(counts->items);
    *counts = (tn_value_counts){0};
}

int tn_house_gain_compare(const tn_house_gain *a, const tn_house_gain *b)
{
    for (size_t k = 0; k < TN_WEIGHED_MAX; k++)
        if (a->by[k] != b->by[k])
            return a->by[k] < b->by[k] ? -1 : 1;
    return 0;
}

tn_house_gain tn_house_gain_sum(const tn_house_gain *a, const tn_house_gain *b)
{
    tn_house_gain sum;
    for (size_t k = 0; k < TN_WEIGHED_MAX; k++)
        sum.by[k] = a->by[k] + b->by[k];
    return sum;
}

/* The place of the first item that is not less than the value. */
static size_t place_of(const tn_value_counts *counts, const tn_house_gain *value)
{
    size_t low = 0, high = counts->count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (tn_house_gain_compare(&counts->items[middle].value, value) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

bool tn_value_counts_add(tn_value_counts *counts, const tn_house_gain *value, const mpz_t times)
{
    size_t at = place_of(counts, value);
    if (at == counts->count || tn_house_gain_compare(&counts->items[at].value, value) != 0) {
        if (!tn_array_reserve_from(&counts->items, &counts->room, 2, counts->count, 1, sizeof *counts->items))
            return false;
        memmove(counts->items + at + 1, counts->items + at, (counts->count - at) * sizeof *counts->items);
        counts->count++;
        counts->items[at].value = *value;
        mpz_init(counts->items[at].count);
    }
    mpz_add(counts->items[at].count, counts->items[at].count, times);
    return true;
}

bool tn_value_counts_add_shifted(tn_value_counts *to, const tn_value_counts *from, const tn_house_gain *gain,
                                 const mpz_t times)
{
    size_t room = to->count + from->count, count = 0, k = 0;
    if (from->count == 0)
        return true;
    tn_value_count *merged = malloc((room + 1) * sizeof *merged);
    if (!merged)
        return false;
    for (size_t i = 0; i < from->count; i++) {
        tn_house_gain value = tn_house_gain_sum(&from->items[i].value, gain);
        while (k < to->count && tn_house_gain_compare(&to->items[k].value, &value) < 0)
            merged[count++] = to->items[k++];
        if (k < to->count && tn_house_gain_compare(&to->items[k].value, &value) == 0) {
            mpz_addmul(to->items[k].count, from->items[i].count, times);
            merged[count++] = to->items[k++];
            continue;
        }
        merged[count].value = value;
        mpz_init(merged[count].count);
        mpz_mul(merged[count++].count, from->items[i].count, times);
    }
    while (k < to->count)
        merged[count++] = to->items[k++];
    free(to->items);
    *to = (tn_value_counts){merged, count, room + 1};
    return true;
}

bool tn_value_counts_has(const tn_value_counts *counts, const tn_house_gain *value)
{
    size_t at = place_of(counts, value);
    return at < counts->count && tn_house_gain_compare(&counts->items[at].value, value) == 0;
}

static void drop_from(tn_value_counts *counts, size_t kept)
{
    while (counts->count > kept)
        mpz_clear(counts->items[--counts->count].count);
}

void tn_value_counts_keep_least(tn_value_counts *counts, uint64_t wanted)
{
    size_t kept = 0;
    mpz_t houses;
    mpz_init(houses);
    while (kept < counts->count && mpz_cmp_ui(houses, wanted) < 0) {
        mpz_add(houses, houses, counts->items[kept].count);
        kept++;
    }
    mpz_clear(houses);
    drop_from(counts, kept);
}

static bool covers(const tn_house_gain *a, const tn_house_gain *b)
{
    for (size_t k = 0; k < TN_WEIGHED_MAX; k++)
        if (a->by[k] > b->by[k])
            return false;
    return true;
}

/* What betters a value comes before it. */
void tn_value_counts_keep_front(tn_value_counts *counts)
{
    size_t kept = 0;
    for (size_t i = 0; i < counts->count; i++) {
        bool worse = false;
        for (size_t k = kept; k-- > 0 && !worse;)
            worse = covers(&counts->items[k].value, &counts->items[i].value);
        if (worse)
            continue;
        tn_value_count item = counts->items[kept];
        counts->items[kept] = counts->items[i];
        counts->items[i] = item;
        kept++;
    }
    drop_from(counts, kept);
}
