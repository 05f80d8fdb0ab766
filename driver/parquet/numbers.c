/* Keeps columns of numbers with a dictionary. */
#include "driver/parquet/numbers.h"

#include <stdlib.h>
#include <string.h>

#include "driver/parquet/encoding.h"
#include "runtime/base/bytes.h"

#define DICTIONARY_MOST 65536u
#define SLOTS (2u * DICTIONARY_MOST)

tn_status tn_numbers_new(tn_numbers *numbers, unsigned bytes, size_t page, tn_error *error)
{
    *numbers = (tn_numbers){.bytes = bytes,
                            .page = calloc(page, sizeof *numbers->page),
                            .places = calloc(page, sizeof *numbers->places),
                            .dictionary = calloc(DICTIONARY_MOST, sizeof *numbers->dictionary),
                            .slots = calloc(SLOTS, sizeof *numbers->slots)};
    tn_numbers_clear(numbers);
    bool made = numbers->page && numbers->places && numbers->dictionary && numbers->slots;
    return made ? TN_OK : tn_fail_memory(error);
}

void tn_numbers_free(tn_numbers *numbers)
{
    free(numbers->page);
    free(numbers->places);
    free(numbers->dictionary);
    free(numbers->slots);
}

void tn_numbers_clear(tn_numbers *numbers)
{
    if (numbers->slots)
        memset(numbers->slots, 0, SLOTS * sizeof *numbers->slots);
    numbers->known = 0;
    numbers->full = numbers->mixed = false;
    numbers->least = INT64_MAX;
    numbers->most = INT64_MIN;
}

/* The number's place in the dictionary, into which it is put where it is new. Past the last place where it is full. */
static size_t find_place(tn_numbers *numbers, int64_t value)
{
    size_t slot = (size_t)((uint64_t)value * UINT64_C(0x9E3779B97F4A7C15) >> 32) % SLOTS;
    for (; numbers->slots[slot]; slot = (slot + 1) % SLOTS)
        if (numbers->dictionary[numbers->slots[slot] - 1] == value)
            return numbers->slots[slot] - 1;
    if (numbers->known == DICTIONARY_MOST)
        return DICTIONARY_MOST;
    numbers->dictionary[numbers->known] = value;
    numbers->slots[slot] = (uint32_t)++numbers->known;
    return numbers->known - 1;
}

void tn_numbers_add(tn_numbers *numbers, int64_t value)
{
    size_t i = numbers->count++;
    numbers->page[i] = value;
    numbers->least = value < numbers->least ? value : numbers->least;
    numbers->most = value > numbers->most ? value : numbers->most;
    if (numbers->full)
        return;
    size_t place = find_place(numbers, value);
    numbers->full = place == DICTIONARY_MOST;
    numbers->places[i] = (uint16_t)place;
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
    for (size_t i = 0; numbers->full && i < numbers->count; i++)
        tn_plain_write(body, numbers->page[i], numbers->bytes);
    if (!numbers->full) {
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
