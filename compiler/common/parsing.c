/* What is the same in the lexers of notations: where tokens lie, numbers, stray characters; and what is said of a text
 * that the parser cannot go on with. */
#include "compiler/common/parsing.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "runtime/module/values.h"

bool tn_parsing_is_text(tn_parsing *parse)
{
    return tn_text_check(parse->diagnostics, parse->file);
}

void tn_parsing_place(tn_parsing *parse, tn_span *span, size_t size)
{
    *span = (tn_span){parse->file, parse->offset, parse->offset + (uint32_t)size};
    parse->offset = span->end;
}

/* A sign, digits, a point, digits, a power of ten. The C library's reader depends on the locale; this one keeps the
 * first 17 digits, and is correctly rounded up to 15. */
tn_decimal tn_parsing_number(tn_parsing *parse, tn_span span)
{
    double value = tn_decimal_value(parse->text + span.begin, span.end - span.begin);
    if (!(value <= TN_COORDINATE_MAX && value >= -TN_COORDINATE_MAX)) {
        tn_diagnostic *d = tn_report(parse->diagnostics, E_NUMBER_TOO_LARGE, span, "this number is too large");
        tn_help(parse->diagnostics, d, "the largest is %.0f", TN_COORDINATE_MAX);
        value = 3; /* what every setting takes: one mistake is told once */
    }
    return (tn_decimal){value, span, 0};
}

tn_decimal tn_parsing_whole(tn_parsing *parse, tn_span span)
{
    uint64_t whole;
    bool fits = tn_whole_read(parse->text + span.begin, span.end - span.begin, &whole);
    return (tn_decimal){fits ? (double)whole : -1, span, whole};
}

void tn_parsing_stray(tn_parsing *parse, tn_span span, const char *help)
{
    bool again = parse->stray_end > 0 && span.begin == parse->stray_end;
    parse->stray_end = span.end;
    if (again)
        return;
    const char *text = parse->text + span.begin;
    size_t size = tn_character_size(text, parse->size - span.begin);
    span.end = span.begin + (uint32_t)size;
    bool visible = (unsigned char)text[0] > ' ' && text[0] != 0x7f;
    tn_diagnostic *d =
        visible ? tn_report(parse->diagnostics, E_STRAY_CHARACTER, span, "`%.*s` means nothing here", (int)size, text)
                : tn_report(parse->diagnostics, E_STRAY_CHARACTER, span,
                            "the control character 0x%02x means nothing here", (unsigned char)text[0]);
    tn_help(parse->diagnostics, d, "%s", help);
}

/* Only blanks lie between a character that means nothing, which was reported, and this place: what is wrong here
 * follows from that. */
static bool behind_stray(const tn_parsing *parse, uint32_t begin)
{
    if (!parse->stray_end || parse->stray_end > begin)
        return false;
    for (uint32_t i = parse->stray_end; i < begin; i++)
        if (!isspace((unsigned char)parse->text[i]))
            return false;
    return true;
}

/* A misspelled word is a name to the parser, which then stumbles over what follows: `filll 20`. Does only white space
 * lie between such a name and this place? */
static bool behind_misspelled(const tn_parsing *parse, tn_span place)
{
    if (!parse->named || parse->meant || parse->name_span.end > place.begin)
        return false;
    for (uint32_t i = parse->name_span.end; i < place.begin; i++)
        if (!isspace((unsigned char)parse->text[i]))
            return false;
    return true;
}

static void report_misspelled(tn_parsing *parse)
{
    tn_span span = parse->name_span;
    tn_diagnostic *d = tn_report(parse->diagnostics, E_UNEXPECTED, span, "`%.*s` is not expected here",
                                 (int)(span.end - span.begin), parse->text + span.begin);
    tn_suggest(parse->diagnostics, d, "%s", parse->named);
}

void tn_parsing_syntax_error(tn_parsing *parse, tn_span span, const char *found, const char *const *expected,
                             size_t count, const char *help)
{
    char list[400] = "", here[100], meant[100];
    if (parse->reported || behind_stray(parse, span.begin))
        return;
    if (behind_misspelled(parse, span)) {
        report_misspelled(parse);
        return;
    }
    bool named = count == 1 && strcmp(expected[0], "a name") == 0 && isalpha((unsigned char)parse->text[span.begin]);
    size_t used = 0, size = span.end > span.begin ? span.end - span.begin : 0;
    for (size_t i = 0; i < count && count <= 6 && used < sizeof list; i++)
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%s",
                                 i == 0           ? ", but "
                                 : i + 1 == count ? " or "
                                                  : ", ",
                                 expected[i]);
    if (size > 0 && size <= 40 && parse->text[span.begin] != '\n' && parse->text[span.begin] != '\r')
        snprintf(here, sizeof here, "`%.*s`", (int)size, parse->text + span.begin);
    else
        snprintf(here, sizeof here, "%s", found);
    tn_diagnostic *d = tn_report(parse->diagnostics, E_UNEXPECTED, span, "%s is not expected here%s", here, list);
    if (parse->meant) {
        snprintf(meant, sizeof meant, "did you mean `%s`?", parse->meant);
        help = meant;
    } else if (named) {
        snprintf(meant, sizeof meant, "%s is a word of the language: take another name", here);
        help = meant;
    }
    tn_help(parse->diagnostics, d, "%s", help);
}
