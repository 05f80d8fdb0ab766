/* Reads and writes lengths: with feet and inches, and in the unit that an author uses. */
#include "runtime/base/length.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

/* ==== reads lengths with units, exactly */

/* Reading goes by a cursor over the text; a part that does not fit leaves the cursor where it was. */
typedef struct tn_scan {
    const char *text;
    size_t size, at;
    bool spaced;
} tn_scan;

typedef enum tn_length_fault { FAULT_NONE, FAULT_TOO_LARGE, FAULT_NOT_WHOLE, FAULT_DIVISOR } tn_length_fault;

/* A sum of nanometres, and what is wrong with it. */
typedef struct tn_amount {
    int64_t nanometres;
    tn_length_fault fault;
} tn_amount;

/* A decimal number as written: the whole part (at most TN_LENGTH_MAX + 1, which stands for anything above), then
 * fraction / divisor with divisor a power of ten. */
typedef struct tn_number {
    int64_t whole, fraction, divisor;
    bool endless; /* more decimal places than any unit of ours can hold */
} tn_number;

static char peek(const tn_scan *scan, size_t ahead)
{
    return scan->at + ahead < scan->size ? scan->text[scan->at + ahead] : '\0';
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool accept(tn_scan *scan, const char *sign)
{
    size_t size = strlen(sign);
    if (scan->size - scan->at < size || memcmp(scan->text + scan->at, sign, size) != 0)
        return false;
    scan->at += size;
    return true;
}

static bool accept_foot(tn_scan *scan)
{
    return accept(scan, "'") || accept(scan, "\xE2\x80\x99") || accept(scan, "\xE2\x80\xB2"); /* ' U+2019 U+2032 */
}

static bool accept_inch(tn_scan *scan)
{
    return accept(scan, "\"") || accept(scan, "\xE2\x80\x9D") || accept(scan, "\xE2\x80\xB3"); /* " U+201D U+2033 */
}

static void skip_blanks(tn_scan *scan)
{
    while (scan->spaced && (peek(scan, 0) == ' ' || peek(scan, 0) == '\t'))
        scan->at++;
}

static bool read_digits(tn_scan *scan, int64_t *value)
{
    if (!is_digit(peek(scan, 0)))
        return false;
    *value = 0;
    for (; is_digit(peek(scan, 0)); scan->at++) {
        *value = *value * 10 + (peek(scan, 0) - '0');
        if (*value > TN_LENGTH_MAX)
            *value = TN_LENGTH_MAX + 1;
    }
    return true;
}

/* digits [ "." digits ]: a number never ends in a point, so that 4..9 is a range. */
static bool read_number(tn_scan *scan, tn_number *number)
{
    *number = (tn_number){.divisor = 1};
    if (!read_digits(scan, &number->whole))
        return false;
    if (peek(scan, 0) != '.' || !is_digit(peek(scan, 1)))
        return true;
    scan->at++;
    size_t places = 0, kept = 0;
    for (; is_digit(peek(scan, 0)); scan->at++) {
        places++;
        if (peek(scan, 0) != '0')
            kept = places;
    }
    number->endless = kept > 9; /* a metre has 10^9 nanometres; an inch divides into at most 2^6 */
    size_t first = scan->at - places;
    for (size_t i = 0; i < kept && !number->endless; i++) {
        number->fraction = number->fraction * 10 + (scan->text[first + i] - '0');
        number->divisor *= 10;
    }
    return true;
}

static void add(tn_amount *amount, int64_t count, int64_t unit)
{
    int64_t product;
    if (amount->fault != FAULT_NONE)
        return;
    if (__builtin_mul_overflow(count, unit, &product) || product > TN_LENGTH_MAX - amount->nanometres)
        amount->fault = FAULT_TOO_LARGE;
    else
        amount->nanometres += product;
}

/* Adds count / divisor units; what is not whole nanometres is a fault. */
static void add_part(tn_amount *amount, int64_t count, int64_t divisor, int64_t unit)
{
    int64_t product;
    if (amount->fault != FAULT_NONE)
        return;
    if (divisor == 0)
        amount->fault = FAULT_DIVISOR;
    else if (__builtin_mul_overflow(count, unit, &product))
        amount->fault = FAULT_TOO_LARGE;
    else if (product % divisor != 0)
        amount->fault = FAULT_NOT_WHOLE;
    else
        add(amount, product / divisor, 1);
}

static void add_number(tn_amount *amount, const tn_number *number, int64_t unit)
{
    add(amount, number->whole, unit);
    if (number->endless && amount->fault == FAULT_NONE)
        amount->fault = FAULT_NOT_WHOLE;
    add_part(amount, number->fraction, number->divisor, unit);
}

/* digits "/" digits inch-sign */
static bool read_fraction(tn_scan *scan, tn_amount *amount)
{
    tn_scan start = *scan;
    int64_t above, below;
    if (read_digits(scan, &above) && accept(scan, "/") && read_digits(scan, &below) && accept_inch(scan)) {
        add_part(amount, above, below, TN_INCH_NM);
        return true;
    }
    *scan = start;
    return false;
}

/* inches = fraction | number inch-sign | digits ( blanks | "-" ) fraction */
static bool read_inches(tn_scan *scan, tn_amount *amount)
{
    tn_scan start = *scan;
    tn_number number;
    if (read_fraction(scan, amount))
        return true;
    if (!read_number(scan, &number))
        return false;
    if (accept_inch(scan)) {
        add_number(amount, &number, TN_INCH_NM);
        return true;
    }
    size_t end = scan->at;
    if (!accept(scan, "-"))
        skip_blanks(scan);
    tn_amount fraction = {0};
    if (number.divisor == 1 && !number.endless && scan->at > end && read_fraction(scan, &fraction)) {
        add(amount, number.whole, TN_INCH_NM);
        add(amount, fraction.nanometres, 1);
        amount->fault = amount->fault ? amount->fault : fraction.fault;
        return true;
    }
    *scan = start;
    return false;
}

/* feet = number foot-sign [ [ "-" ] inches ], blanks between the two where they are allowed */
static bool read_feet(tn_scan *scan, tn_amount *amount)
{
    tn_scan start = *scan;
    tn_number number;
    if (!read_number(scan, &number) || !accept_foot(scan)) {
        *scan = start;
        return false;
    }
    add_number(amount, &number, TN_FOOT_NM);
    tn_scan after = *scan;
    if (!accept(scan, "-"))
        skip_blanks(scan);
    if (!read_inches(scan, amount))
        *scan = after;
    return true;
}

static bool continues_word(char c)
{
    return is_digit(c) || c == '_' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (unsigned char)c >= 0x80;
}

/* metric = number ( "mm" | "cm" | "m" ), not followed by a letter */
static bool read_metric(tn_scan *scan, tn_amount *amount)
{
    static const struct {
        const char *name;
        int64_t nanometres;
    } units[] = {{"mm", 1000000}, {"cm", 10000000}, {"m", 1000000000}};
    tn_scan start = *scan;
    tn_number number;
    if (read_number(scan, &number)) {
        for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
            tn_scan before = *scan;
            if (accept(scan, units[i].name) && !continues_word(peek(scan, 0))) {
                add_number(amount, &number, units[i].nanometres);
                return true;
            }
            *scan = before;
        }
    }
    *scan = start;
    return false;
}

static void report(const tn_scan *scan, tn_length_fault fault, tn_error *error)
{
    int shown = scan->at < 80 ? (int)scan->at : 80;
    switch (fault) {
    case FAULT_NONE:
        return;
    case FAULT_TOO_LARGE:
        tn_fail(error, TN_INVALID, E_NUMBER_TOO_LARGE, "the length %.*s is too large; the largest is about 1,100 km",
                shown, scan->text);
        break;
    case FAULT_NOT_WHOLE:
        tn_fail(error, TN_INVALID, E_LENGTH_NOT_EXACT, "the length %.*s cannot be held exactly", shown, scan->text);
        tn_error_help(error,
                      "lengths are whole nanometres: inches divide down to 1/64\", metres to nine decimal places");
        break;
    case FAULT_DIVISOR:
        tn_fail(error, TN_INVALID, E_LENGTH_NOT_EXACT, "the length %.*s divides by zero", shown, scan->text);
        break;
    }
    tn_error_place(error, 0, 1, scan->at + 1);
}

size_t tn_length_read(const char *text, size_t size, bool spaced, int64_t *nanometres, tn_error *error)
{
    if (error)
        *error = (tn_error){.code_offset = TN_NO_OFFSET};
    tn_scan scan = {text, size, 0, spaced};
    tn_amount amount = {0};
    if (!read_feet(&scan, &amount) && !read_metric(&scan, &amount) && !read_inches(&scan, &amount))
        return 0;
    if (amount.fault != FAULT_NONE) {
        report(&scan, amount.fault, error);
        return 0;
    }
    *nanometres = amount.nanometres;
    return scan.at;
}

/* ---- writing */

static void write_inches(int64_t sixtyfourths, bool negative, char *text, size_t size)
{
    const char *sign = negative ? "-" : "";
    int64_t feet = sixtyfourths / (64 * 12), inches = sixtyfourths / 64 % 12, part = sixtyfourths % 64, whole = 64;
    for (; part > 0 && part % 2 == 0; whole /= 2)
        part /= 2;
    char foot_text[32] = "", inch_text[64] = "";
    if (feet > 0 || sixtyfourths == 0)
        snprintf(foot_text, sizeof foot_text, "%lld'", (long long)feet);
    if (part > 0 && inches > 0)
        snprintf(inch_text, sizeof inch_text, "%d-%d/%d\"", (int)inches, (int)part, (int)whole);
    else if (part > 0)
        snprintf(inch_text, sizeof inch_text, "%d/%d\"", (int)part, (int)whole);
    else if (inches > 0)
        snprintf(inch_text, sizeof inch_text, "%d\"", (int)inches);
    snprintf(text, size, "%s%s%s", sign, foot_text, inch_text);
}

void tn_length_write(int64_t nanometres, char *text, size_t size)
{
    bool negative = nanometres < 0;
    uint64_t magnitude = negative ? 0 - (uint64_t)nanometres : (uint64_t)nanometres;
    const uint64_t unit = TN_INCH_NM / 64, millimetre = 1000000;
    if (magnitude % unit == 0) {
        write_inches((int64_t)(magnitude / unit), negative, text, size);
        return;
    }
    char digits[32];
    int length = snprintf(digits, sizeof digits, "%llu.%06llu", (unsigned long long)(magnitude / millimetre),
                          (unsigned long long)(magnitude % millimetre));
    while (digits[length - 1] == '0')
        digits[--length] = '\0';
    if (digits[length - 1] == '.')
        digits[length - 1] = '\0';
    snprintf(text, size, "%s%smm", negative ? "-" : "", digits);
}

/* ==== writes lengths in the unit that an author uses */

tn_length_style tn_length_style_of(const char *spelling)
{
    size_t length = strlen(spelling);
    if (length < 2 || spelling[length - 1] != 'm')
        return TN_STYLE_FEET;
    return spelling[length - 2] == 'm'   ? TN_STYLE_MILLIMETRES
           : spelling[length - 2] == 'c' ? TN_STYLE_CENTIMETRES
                                         : TN_STYLE_METRES;
}

/* A decimal number of `unit` nanometres, without trailing zeros. */
static void write_decimal(int64_t nanometres, int64_t unit, const char *name, char *text, size_t size)
{
    char fraction[24];
    int digits = snprintf(fraction, sizeof fraction, "%" PRId64, unit + nanometres % unit) - 1;
    while (digits > 0 && fraction[digits] == '0')
        digits--;
    snprintf(text, size, "%" PRId64 "%s%.*s%s", nanometres / unit, digits ? "." : "", digits, fraction + 1, name);
}

void tn_length_write_style(int64_t nanometres, tn_length_style style, char *text, size_t size)
{
    switch (style) {
    case TN_STYLE_FEET:
        tn_length_write(nanometres, text, size);
        break;
    case TN_STYLE_METRES:
        write_decimal(nanometres, INT64_C(1000000000), "m", text, size);
        break;
    case TN_STYLE_CENTIMETRES:
        write_decimal(nanometres, 10000000, "cm", text, size);
        break;
    case TN_STYLE_MILLIMETRES:
        write_decimal(nanometres, 1000000, "mm", text, size);
        break;
    }
}
