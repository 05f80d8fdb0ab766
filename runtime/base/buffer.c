/* A text that grows as it is appended to, and the shortest text of a number. */
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/buffer.h"

/* There is room for the zero byte too. */
bool tn_buffer_reserve(tn_buffer *buffer, size_t more)
{
    if (more < SIZE_MAX && tn_array_reserve(&buffer->data, &buffer->capacity, buffer->size, more + 1, 1))
        return true;
    buffer->failed = true;
    return false;
}

bool tn_buffer_append(tn_buffer *buffer, const char *text, size_t length)
{
    if (!tn_buffer_reserve(buffer, length))
        return false;
    if (length > 0)
        memcpy(buffer->data + buffer->size, text, length);
    buffer->size += length;
    buffer->data[buffer->size] = '\0';
    return true;
}

bool tn_buffer_printf(tn_buffer *buffer, const char *format, ...)
{
    va_list args, again;
    va_start(args, format);
    va_copy(again, args);
    int length = vsnprintf(NULL, 0, format, args);
    bool done = length >= 0 && tn_buffer_reserve(buffer, (size_t)length);
    if (done) {
        vsnprintf(buffer->data + buffer->size, (size_t)length + 1, format, again);
        buffer->size += (size_t)length;
    }
    buffer->failed = buffer->failed || !done;
    va_end(again);
    va_end(args);
    return done;
}

/* 17 digits always tell a number from all others, 15 often. */
const char *tn_number_text(double number, char text[TN_NUMBER_TEXT_SIZE])
{
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, TN_NUMBER_TEXT_SIZE, "%.*g", digits, number);
        if (strtod(text, NULL) == number)
            break;
    }
    return text;
}
