/* Reads texts in quotes and numbers, and checks that a source is UTF-8, for all lexers. */
#include "compiler/common/lexical.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/length.h"
#include "runtime/base/utf8.h"

void *tn_lexer_pool_take(tn_lexer_pool *pool, size_t size)
{
    size_t unit = _Alignof(max_align_t), rounded = (size + unit - 1) / unit * unit;
    if (rounded > sizeof pool->bytes - pool->used)
        return NULL;
    void *memory = pool->bytes + pool->used;
    pool->used += rounded;
    return memory;
}

bool tn_text_check(tn_diagnostics *diagnostics, uint32_t file)
{
    const tn_source *source = &diagnostics->sources->files[file];
    for (size_t i = 0, step; i < source->size; i += step) {
        uint32_t character = tn_utf8_read(source->text + i, source->size - i, &step);
        if (character != 0 && (character != TN_REPLACEMENT || step > 1))
            continue;
        unsigned byte = (unsigned char)source->text[i];
        tn_span span = {file, (uint32_t)i, (uint32_t)(i + 1)};
        tn_diagnostic *d =
            tn_report(diagnostics, E_INVALID_UTF8, span, "this is not text: byte %zu of the file is %s0x%02x", i + 1,
                      byte == 0 ? "the zero byte " : "", byte);
        tn_help(diagnostics, d, "save the file as UTF-8 text; if it is not a rule file, it cannot be used here");
        return false;
    }
    return true;
}

size_t tn_text_mark(const char *text, size_t size)
{
    return size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
}

bool tn_integer_read(const char *digits, size_t size, int64_t *value)
{
    int64_t sum = 0;
    for (size_t i = 0; i < size; i++) {
        if (__builtin_mul_overflow(sum, 10, &sum) || __builtin_add_overflow(sum, digits[i] - '0', &sum)) {
            *value = INT64_MAX;
            return false;
        }
    }
    *value = sum;
    return true;
}

bool tn_whole_read(const char *text, size_t size, uint64_t *value)
{
    uint64_t sum = 0;
    bool fits = size > 0;
    for (size_t i = 0; fits && i < size; i++)
        fits = text[i] >= '0' && text[i] <= '9' && !__builtin_mul_overflow(sum, UINT64_C(10), &sum) &&
               !__builtin_add_overflow(sum, (uint64_t)(text[i] - '0'), &sum);
    *value = fits ? sum : 0;
    return fits;
}

size_t tn_length_lex(tn_diagnostics *diagnostics, const char *text, size_t size, tn_span span, int64_t *nanometres,
                     bool *broken)
{
    tn_error error = {0};
    *nanometres = 0;
    *broken = false;
    size_t used = tn_length_read(text, size, true, nanometres, &error);
    if (used > 0)
        return used;
    *broken = true;
    if (error.status == TN_OK) {
        tn_diagnostic *d = tn_report(diagnostics, E_LENGTH_NOT_EXACT, span, "`%.*s` is no length", (int)size, text);
        tn_help(diagnostics, d, "a fraction of an inch follows directly or after one blank: `6-1/2\"`, `5'6 1/2\"`");
        return 0;
    }
    tn_diagnostic *d = tn_report(diagnostics, (tn_code)error.code, span, "%s", error.message);
    if (error.help[0])
        tn_help(diagnostics, d, "%s", error.help);
    return 0;
}

char *tn_string_lex(tn_arena *arena, const char *text, size_t size)
{
    char *copy = tn_arena_copy(arena, text, size);
    if (!copy)
        return NULL;
    size_t length = 0;
    for (size_t i = 0; i < size; i++) {
        if (text[i] == '\\' && i + 1 < size && (text[i + 1] == '"' || text[i + 1] == '\\'))
            i++;
        copy[length++] = text[i];
    }
    copy[length] = '\0';
    return copy;
}

/* `room:7.2m`, as lines of plans have it: how that is written elsewhere. `text` is at the colon, begin where it starts.
 */
static bool help_depth(tn_diagnostics *diagnostics, tn_diagnostic *d, const char *begin, const char *text)
{
    const char *fill = text;
    while (fill > begin && (isalnum((unsigned char)fill[-1]) || fill[-1] == '-'))
        fill--;
    size_t depth = strspn(text + 1, "0123456789.'\"/cm");
    if (*text != ':' || !isalpha((unsigned char)*fill) || !isdigit((unsigned char)text[1]))
        return false;
    tn_help(diagnostics, d, "a depth follows its fill after a blank: `%.*s %.*s`", (int)(text - fill), fill, (int)depth,
            text + 1);
    return true;
}

/* `40 %`: is it the sign of a share, behind a number and a blank? */
static bool help_share(tn_diagnostics *diagnostics, tn_diagnostic *d, const char *begin, const char *text)
{
    const char *number = text;
    while (number > begin && number[-1] == ' ')
        number--;
    const char *end = number;
    while (number > begin && (isdigit((unsigned char)number[-1]) || number[-1] == '.'))
        number--;
    if (*text != '%' || number == end || end == text)
        return false;
    tn_help(diagnostics, d, "a share is written without a blank: `%.*s%%`", (int)(end - number), number);
    return true;
}

void tn_stray_report(tn_diagnostics *diagnostics, tn_span span)
{
    static const struct {
        const char *found, *help;
    } table[] = {
        {"\xe2\x80\x98", "feet are written with a straight mark: `12'`"},
        {"&", "write `and`"},
        {"^", "a power is written as a product: `a * a`"},
        {"$", "leave it out: money is a plain number, and the text after the name can say its unit"},
        {"\xe2\x82\xac",
         "leave it out: money is a plain number, and the text after the name can say its unit"}, /* the euro sign */
        {";", "nothing has to be written at the end of a line"},
        {"//", "a comment starts with `#`"},
        {"/*", "a comment starts with `#`"},
        {"/", "a slope is written `6:12`, a fraction of an inch `6-1/2\"`"},
        {"%", "a remainder is written `n mod 3 = 1`; a comment starts with `#`"},
        {".", "a range is written with two dots: `4..9`"},
        {"'", "feet are written directly after a number: `12'`; texts stand in double quotes"},
        {":", "a value follows its field, and a depth its fill, after a blank"},
    };
    const char *text = diagnostics->sources->files[span.file].text + span.begin;
    size_t size = span.end - span.begin;
    bool visible = (unsigned char)text[0] > ' ' && text[0] != 0x7f;
    tn_diagnostic *d =
        visible ? tn_report(diagnostics, E_STRAY_CHARACTER, span, "`%.*s` means nothing here", (int)size, text)
                : tn_report(diagnostics, E_STRAY_CHARACTER, span, "the control character 0x%02x means nothing here",
                            (unsigned char)text[0]);
    const char *help = "leave it out";
    const char *begin = diagnostics->sources->files[span.file].text;
    if (help_depth(diagnostics, d, begin, text) || help_share(diagnostics, d, begin, text))
        return;
    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        if (strlen(table[i].found) == size && memcmp(text, table[i].found, size) == 0)
            help = table[i].help;
    tn_help(diagnostics, d, "%s", help);
}

size_t tn_character_size(const char *text, size_t size)
{
    size_t count = 1;
    if (size > 0)
        tn_utf8_read(text, size, &count);
    return count;
}

/* As many digits as any tie between two doubles has, and one for all behind them. */
#define DIGITS_MAX 770
#define EXPONENT_MAX 10000

/* The significant digits as a whole number, and the power of ten that it is to be multiplied with; returns where the
 * exponent begins. */
static size_t read_digits(const char *text, size_t size, char *digits, size_t *count, int64_t *power)
{
    size_t i = size && (text[0] == '-' || text[0] == '+');
    bool fraction = false;
    for (; i < size && text[i] != 'e' && text[i] != 'E'; i++) {
        if (text[i] == '.') {
            fraction = true;
        } else if (*count < DIGITS_MAX) {
            if (*count > 0 || text[i] != '0')
                digits[(*count)++] = text[i];
            *power -= fraction;
        } else {
            if (text[i] != '0')
                digits[DIGITS_MAX - 1] = '1'; /* above the tie that the digits before may be */
            *power += !fraction;
        }
    }
    return i;
}

double tn_decimal_value(const char *text, size_t size)
{
    char digits[DIGITS_MAX + 32];
    size_t count = 0;
    int64_t power = 0, exponent = 0;
    size_t i = read_digits(text, size, digits, &count, &power);
    bool negative = i + 1 < size && text[i + 1] == '-', has_sign = negative || (i + 1 < size && text[i + 1] == '+');
    for (i += has_sign ? 2 : 1; i < size && exponent < EXPONENT_MAX; i++)
        exponent = exponent * 10 + (text[i] - '0');
    power += negative ? -exponent : exponent;
    /* strtod rounds correctly; without a point, no locale has a say */
    snprintf(digits + count, sizeof digits - count, "%se%lld", count ? "" : "0", (long long)power);
    double value = strtod(digits, NULL);
    return size && text[0] == '-' ? -value : value;
}
