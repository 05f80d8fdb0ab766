/* Text that grows, and numbers as text. The caller owns a text: zero it to begin with, free data with free(). */
#ifndef TARTAN_BASE_BUFFER_H
#define TARTAN_BASE_BUFFER_H

#include <stdbool.h>
#include <stddef.h>

/* Always ends with a zero byte that is not counted, once anything was appended. What many calls write can be asked
 * about once: `failed` stays set after one that was out of memory. */
typedef struct tn_buffer {
    char *data;
    size_t size;
    size_t capacity;
    bool failed;
} tn_buffer;

bool tn_buffer_append(tn_buffer *buffer, const char *text, size_t length);

/* Room for `more` bytes, to be written to data + size by the caller, who adds them to `size`. */
bool tn_buffer_reserve(tn_buffer *buffer, size_t more);

bool tn_buffer_printf(tn_buffer *buffer, const char *format, ...) __attribute__((format(printf, 2, 3)));

#define TN_NUMBER_TEXT_SIZE 32u

/* Writes a finite number as the shortest text that reads back as the same number, and returns `text`. */
const char *tn_number_text(double number, char text[TN_NUMBER_TEXT_SIZE]);

#endif
