/* Keeps columns of numbers with a dictionary. */
#include "driver/parquet/numbers.h"

#include <stdlib.h>
#include <string.h>

#include "driver/parquet/encoding.h"
#include "runtime/base/array.h"
#include "runtime/base/bytes.h"

#define DICTIONARY_MOST 65536u

tn_status tn_numbers_new(tn_numbers *numbers, unsigned bytes, size_t page, tn_error *error)
{
    *numbers = (tn_numbers){.bytes = bytes, .places = calloc(page, sizeof *numbers->places)};
    if (!numbers->places)
        return tn_fail_memory(error);
    tn_numbers_clear(numbers);
    return TN_OK;
}

void tn_numbers_free(tn_numbers *numbers)
{
    free(numbers->places);
    free(numbers->plain.data);
    free(numbers->dictionary);
    tn_hash_clear(&numbers->index);
}

void tn_numbers_clear(tn_numbers *numbers)
{
    tn_hash_forget(&numbers->index);
    numbers->known = 0;
    numbers->full = numbers->mixed = false;
    numbers->least = INT64_MAX;
    numbers->most = INT64_MIN;
}

/* ---- the dictionary */

typedef struct wanted_number {
    const int64_t *dictionary;
    int64_t value;
} wanted_number;

static bool is_wanted(const void *context, uint32_t place)
{
    const wanted_number *w = context;
    return w->dictionary[place] == w->value;
}

/* Where the number is in the dictionary, into which it is put if there is a place left; *place: TN_HASH_NONE if not.
 */
static bool find_place(tn_numbers *numbers, int64_t value, uint32_t *place)
{
    uint64_t hash = (uint64_t)value * UINT64_C(0x9E3779B97F4A7C15) >> 32;
    if (!tn_array_reserve(&numbers->dictionary, &numbers->known_room, numbers->known, 1, sizeof *numbers->dictionary))
        return false;
    wanted_number wanted = {numbers->dictionary, value};
    *place = (uint32_t)numbers->known;
    if (numbers->known == DICTIONARY_MOST)
        *place = tn_hash_find(&numbers->index, hash, is_wanted, &wanted);
    else if (tn_hash_enter(&numbers->index, hash, is_wanted, &wanted, place, NULL) != TN_OK)
        return false;
    if (*place == numbers->known)
        numbers->dictionary[numbers->known++] = value;
    return true;
}

/* From now on numbers are written as they are, those of this page too. */
static void leave_dictionary(tn_numbers *numbers, size_t before)
{
    numbers->full = true;
    for (size_t i = 0; i < before; i++)
        tn_plain_write(&numbers->plain, numbers->dictionary[numbers->places[i]], numbers->bytes);
}

bool tn_numbers_add(tn_numbers *numbers, int64_t value)
{
    size_t i = numbers->count++;
    uint32_t place = TN_HASH_NONE;
    numbers->least = value < numbers->least ? value : numbers->least;
    numbers->most = value > numbers->most ? value : numbers->most;
    if (!numbers->full && !find_place(numbers, value, &place))
        return false;
    if (place != TN_HASH_NONE) {
        numbers->places[i] = (uint16_t)place;
        return true;
    }
    if (!numbers->full)
        leave_dictionary(numbers, i);
    tn_plain_write(&numbers->plain, value, numbers->bytes);
    return !numbers->plain.failed;
}

void tn_plain_write(tn_buffer *out, int64_t value, unsigned bytes)
{
    uint8_t written[8];
    tn_put_u64(written, (uint64_t)value);
    tn_buffer_append(out, (const char *)written, bytes);
}

enum tn_parquet_encoding tn_numbers_page(tn_numbers *numbers, tn_buffer *body)
{
    static const char width[] = {16};
    if (numbers->full) {
        tn_buffer_append(body, numbers->plain.data, numbers->plain.size);
        numbers->plain.size = 0;
    } else {
        tn_buffer_append(body, width, 1);
        tn_shorts_write(body, numbers->places, numbers->count);
    }
    numbers->mixed = numbers->mixed || numbers->full;
    numbers->count = 0;
    return numbers->full ? TN_ENCODING_PLAIN : TN_ENCODING_RLE_DICTIONARY;
}

void tn_numbers_dictionary(const tn_numbers *numbers, tn_buffer *body)
{
    for (size_t i = 0; i < numbers->known; i++)
        tn_plain_write(body, numbers->dictionary[i], numbers->bytes);
}
