/* Says where something stands in a text. */
#include "ask/source/place.h"

#include <string.h>

#include "runtime/base/utf8.h"

/* From the beginning of the text; a byte order mark is no part of it. */
static uint64_t utf16_offset(const tn_source *source, size_t offset)
{
    size_t mark = strncmp(source->text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
    if (offset > source->size)
        offset = source->size;
    return offset > mark ? tn_utf16_units(source->text + mark, offset - mark) : 0;
}

bool tn_text_place_of(tn_sources *sources, bool has_span, tn_span span, tn_text_place *to)
{
    if (!has_span || span.file >= sources->count)
        return true;
    const tn_source *source = &sources->files[span.file];
    const tn_place place = tn_sources_place(sources, span);
    to->has_file = to->has_line = to->has_column = to->has_end_line = to->has_end_column = true;
    to->has_utf16_begin = to->has_utf16_end = true;
    to->line = place.line;
    to->column = place.column;
    to->end_line = place.end_line;
    to->end_column = place.end_column;
    to->utf16_begin = utf16_offset(source, span.begin);
    to->utf16_end = utf16_offset(source, span.end > span.begin ? span.end : span.begin);
    to->file = place.path ? strdup(place.path) : NULL;
    return to->file || !place.path;
}
