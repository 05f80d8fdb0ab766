#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/plan/text.h"

/* Room for `more` bytes and the zero byte after them. */
static bool reserve(tn_buffer *buffer, size_t more)
{
    if (buffer->data && more < buffer->capacity - buffer->size)
        return true;
    if (more > SIZE_MAX / 4 - buffer->size)
        return false;
    size_t capacity = (buffer->size + more) * 2 + 64;
    char *data = realloc(buffer->data, capacity);
    if (!data)
        return false;
    buffer->data = data;
    buffer->capacity = capacity;
    return true;
}

bool tn_buffer_append(tn_buffer *buffer, const char *text, size_t length)
{
    if (!reserve(buffer, length)) {
        buffer->failed = true;
        return false;
    }
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
    bool done = length >= 0 && reserve(buffer, (size_t)length);
    if (done) {
        vsnprintf(buffer->data + buffer->size, (size_t)length + 1, format, again);
        buffer->size += (size_t)length;
    }
    buffer->failed = buffer->failed || !done;
    va_end(again);
    va_end(args);
    return done;
}
