/* Finds the source lines that a listing shows beside instructions. */
#include "runtime/module/disasm_lines.h"

#include <stdlib.h>
#include <string.h>

/* Where the lines of a source start; NULL: not found yet. */
typedef struct starts {
    uint32_t *of;
    size_t count;
} starts;

struct tn_source_lines {
    const tn_module *module;
    starts sources[];
};

tn_source_lines *tn_source_lines_new(const tn_module *module)
{
    tn_source_lines *lines = calloc(1, sizeof *lines + module->SOURCE_count * sizeof *lines->sources);
    if (lines)
        lines->module = module;
    return lines;
}

void tn_source_lines_free(tn_source_lines *lines)
{
    for (size_t i = 0; lines && i < lines->module->SOURCE_count; i++)
        free(lines->sources[i].of);
    free(lines);
}

static const char *text_of(const tn_source_lines *lines, uint32_t source)
{
    return tn_text(lines->module, lines->module->SOURCE_records[source].text);
}

static bool find_starts(const tn_source_lines *lines, uint32_t source, starts *found)
{
    const char *text = text_of(lines, source);
    size_t count = 1;
    for (const char *at = text; (at = strchr(at, '\n')); at++)
        count++;
    *found = (starts){malloc(count * sizeof *found->of), 0};
    if (!found->of)
        return false;
    found->of[found->count++] = 0;
    for (const char *at = text; (at = strchr(at, '\n')); at++)
        found->of[found->count++] = (uint32_t)(at + 1 - text);
    return true;
}

bool tn_source_line(tn_source_lines *lines, uint32_t source, uint32_t offset, size_t *line)
{
    starts *found = &lines->sources[source];
    if (!found->of && !find_starts(lines, source, found))
        return false;
    size_t low = 0, high = found->count;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (found->of[middle] <= offset)
            low = middle;
        else
            high = middle;
    }
    *line = low;
    return true;
}

const char *tn_source_line_text(const tn_source_lines *lines, uint32_t source, size_t line)
{
    return text_of(lines, source) + lines->sources[source].of[line];
}
