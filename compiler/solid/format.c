/* Laying out .solid files: a statement a line; one that is too long goes on where its next part begins. */
#include <string.h>

#include "compiler/common/format_statements.h"
#include "compiler/solid/solid.h"

static bool is_ratio(const tn_format *format, size_t i)
{
    return i >= 2 && tn_format_is(format, i, "/") && tn_format_is(format, i - 2, "unit");
}

static size_t gap_before(const tn_format *format, size_t i)
{
    bool tight = tn_format_is(format, i, ")") || tn_format_is(format, i, ",") || tn_format_is(format, i, ";") ||
                 tn_format_is(format, i - 1, "(") || tn_format_is_minus_sign(format, i - 1) ||
                 tn_format_is(format, i, "..") || tn_format_is(format, i - 1, "..") || is_ratio(format, i) ||
                 is_ratio(format, i - 1) ||
                 (tn_format_is(format, i, "(") && format->tokens[i - 1].kind == TN_TOKEN_NAME);
    return tight ? 0 : 1;
}

/* Where a statement that is too long goes on in the next line. */
static bool at_part(const tn_format *format, size_t i)
{
    bool joins = tn_format_is_word(format, i, &tn_solid_words, TN_SOLID_AT(MEASURED), TN_AS_INFIX);
    return (joins && !tn_format_is(format, i, "in")) || (i > 0 && tn_format_is(format, i - 1, ",")) ||
           tn_format_is_word(format, i, &tn_solid_words, TN_SOLID_AT(BOX) | TN_SOLID_AT(GOAL), TN_AS_MARK);
}

static bool ends_statement(const tn_format *format, size_t i)
{
    static const char *const ends[] = {";", "{", "}", NULL};
    return tn_format_is_any(format, i, ends);
}

void tn_format_solid(tn_format *format)
{
    tn_format_statements(format, &(tn_statement_format){gap_before, at_part, ends_statement});
}

/* Tokens [first, last) on one line, without their comments. */
static const char *line_of(const tn_format *format, tn_arena *arena, size_t first, size_t last)
{
    size_t size = 0;
    for (size_t i = first; i < last; i++)
        size += 1 + format->tokens[i].size;
    char *line = TN_NEW_ARRAY(arena, char, size + 1), *at = line;
    for (size_t i = first; line && i < last; i++) {
        if (i > first && gap_before(format, i))
            *at++ = ' ';
        memcpy(at, format->tokens[i].text, format->tokens[i].size);
        at += format->tokens[i].size;
    }
    return line;
}

void tn_solid_name_measures(tn_arena *arena, const tn_source *source, const tn_tokens *tokens, tn_solid_file *file)
{
    tn_format format = {0};
    size_t i = 0;
    tn_format_take(&format, arena, source, tokens, tn_format_small_letters);
    for (const tn_solid_design *design = file->first; design && !tn_arena_failed(arena); design = design->next)
        for (const tn_solid_item *item = design->first; item; item = item->next)
            for (tn_solid_entry *entry = item->entries.first; entry && item->kind == TN_SOLID_ASKS;
                 entry = entry->next) {
                while (i < format.count && format.tokens[i].offset < entry->span.begin)
                    i++;
                size_t first = i;
                while (i < format.count && format.tokens[i].offset < entry->span.end)
                    i++;
                entry->words = line_of(&format, arena, first, i);
            }
}
