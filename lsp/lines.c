/* Places of the protocol as JSON. */
#include "lsp/lines.h"

json_t *tn_lines_position(const tn_lines *lines, size_t offset)
{
    size_t line, character;
    tn_lines_place(lines, offset, &line, &character);
    return json_pack("{s:I,s:I}", "line", (json_int_t)line, "character", (json_int_t)character);
}

json_t *tn_lines_range(const tn_lines *lines, size_t begin, size_t end)
{
    return json_pack("{s:o,s:o}", "start", tn_lines_position(lines, begin), "end", tn_lines_position(lines, end));
}

bool tn_lines_read(const tn_lines *lines, const json_t *position, size_t *offset)
{
    const json_t *line = json_object_get(position, "line"), *character = json_object_get(position, "character");
    if (!json_is_integer(line) || !json_is_integer(character) || json_integer_value(line) < 0 ||
        json_integer_value(character) < 0)
        return false;
    *offset = tn_lines_offset(lines, (size_t)json_integer_value(line), (size_t)json_integer_value(character));
    return true;
}
