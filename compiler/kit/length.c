/* Works out lengths of kits exactly: a decimal number times what it counts, in millionths of an LDU. */
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "compiler/common/diagnostic.h"
#include "compiler/common/lexical.h"
#include "compiler/kit/kit.h"
#include "runtime/geometry/union/wide.h"

enum { PLACES = 6, DIGITS_MAX = 15 };
static const int64_t million = 1000000;

static tn_diagnostic *wrong(tn_kit *kit, tn_span span, const char *message)
{
    return tn_report(kit->diagnostics, E_KIT_LENGTH, span, "%s", message);
}

/* Millionths of a decimal number; false if it has more places or digits. */
static bool read_decimal(const char *text, size_t size, int64_t *value)
{
    int digits = 0, places = -1;
    *value = 0;
    for (size_t i = 0; i < size; i++) {
        if (text[i] == '.') {
            places = 0;
            continue;
        }
        *value = 10 * *value + (text[i] - '0');
        places += places >= 0;
        if (++digits > DIGITS_MAX || places > PLACES)
            return false;
    }
    for (int i = places < 0 ? 0 : places; i < PLACES; i++)
        if (__builtin_mul_overflow(*value, 10, value))
            return false;
    return true;
}

/* A name, or the same with an s: `1 stud`, `4 studs`. */
static const int64_t *find_unit(tn_kit *kit, const char *name)
{
    const int64_t *found = tn_names_get(&kit->lengths, name);
    size_t size = strlen(name);
    if (found || size < 2 || name[size - 1] != 's')
        return found;
    const char *singular = tn_arena_copy(kit->arena, name, size - 1);
    return singular ? tn_names_get(&kit->lengths, singular) : NULL;
}

static bool unit_of(tn_kit *kit, const tn_kit_length *length, int64_t *unit)
{
    const char *name = length->unit.text;
    *unit = million;
    if (!name || strcasecmp(name, "LDU") == 0)
        return true;
    if (strcasecmp(name, "mm") == 0) {
        *unit = 5 * million / 2; /* an LDU is 0.4 mm */
        return true;
    }
    const int64_t *found = find_unit(kit, name);
    if (found) {
        *unit = *found;
        return true;
    }
    tn_kit_unknown(kit, &kit->lengths, "length", length->unit.span, name,
                   "lengths are in LDU, mm, or named: `length brick = 24;`");
    return false;
}

bool tn_kit_measure(tn_kit *kit, const tn_kit_length *length, int64_t *value)
{
    const char *text = kit->diagnostics->sources->files[length->digits.file].text + length->digits.begin;
    int64_t number, unit;
    *value = 0;
    if (!read_decimal(text, length->digits.end - length->digits.begin, &number)) {
        tn_diagnostic *d = wrong(kit, length->span, "this number cannot be held exactly");
        tn_help(kit->diagnostics, d, "write at most %d digits, %d of them behind the point", DIGITS_MAX, PLACES);
        return false;
    }
    if (!unit_of(kit, length, &unit))
        return false;
    tn_int128 product = (tn_int128)number * unit;
    if (product % million != 0 || product / million > TN_KIT_LENGTH_MAX || product / million < -TN_KIT_LENGTH_MAX) {
        tn_diagnostic *d = wrong(kit, length->span, "this length cannot be held exactly");
        tn_help(kit->diagnostics, d, "lengths are whole millionths of an LDU, and at most a million LDU");
        return false;
    }
    *value = length->negative ? -(int64_t)(product / million) : (int64_t)(product / million);
    return true;
}

/* A number of LDU without needless zeros. */
static void write_ldu(int64_t value, char text[32])
{
    snprintf(text, 32, "%.6f", (double)value / (double)million);
    char *end = text + strlen(text);
    while (end[-1] == '0')
        *--end = '\0';
    if (end[-1] == '.')
        end[-1] = '\0';
}

/* The largest cell of which both a cell and a length are whole numbers, all in millionths of an LDU. */
static int64_t common_cell(int64_t cell, int64_t length)
{
    while (length) {
        int64_t rest = cell % length;
        cell = length;
        length = rest;
    }
    return llabs(cell);
}

bool tn_kit_cells(tn_kit *kit, tn_span span, int64_t length, int axis, int halves, const char *what, int32_t *cells)
{
    static const char *const sides[] = {"wide", "high", "deep"};
    int64_t unit = kit->unit[axis] * halves;
    *cells = 0;
    if (length % unit == 0 && llabs(length / unit) <= TN_PLACE_SIZE_MAX) {
        *cells = (int32_t)(length / unit);
        return true;
    }
    char at[32], cell[32];
    write_ldu(length / halves, at);
    write_ldu(kit->unit[axis], cell);
    tn_diagnostic *d = length % unit ? wrong(kit, span, "this does not fall on the cells of the kit")
                                     : wrong(kit, span, "this is too large for a part");
    if (kit->unit_node)
        tn_note(kit->diagnostics, d, &kit->unit_node->span, "a cell is %s LDU %s, and %s %s LDU", cell, sides[axis],
                what, at);
    int64_t common = common_cell(kit->unit[axis], length / halves);
    if (length % unit == 0) {
        tn_help(kit->diagnostics, d, "make it smaller");
    } else if (length % halves || common < kit->unit[axis] / 32) { /* no cell that somebody would want */
        tn_help(kit->diagnostics, d, "choose another length");
    } else {
        char fits[32], mm[32];
        write_ldu(common, fits);
        write_ldu(common * 2 / 5, mm);
        tn_help(kit->diagnostics, d, "choose another length; or a cell %s LDU (%s mm) %s, on which this falls", fits,
                mm, sides[axis]);
    }
    return false;
}

double tn_kit_number(const tn_kit *kit, const tn_kit_length *number)
{
    const char *text = kit->diagnostics->sources->files[number->digits.file].text + number->digits.begin;
    return tn_decimal_value(text, number->digits.end - number->digits.begin);
}

bool tn_kit_whole(tn_kit *kit, const tn_kit_length *number, int64_t low, int64_t high, const char *what, int64_t *value)
{
    const char *text = kit->diagnostics->sources->files[number->digits.file].text + number->digits.begin;
    size_t size = number->digits.end - number->digits.begin;
    tn_range_note(kit->diagnostics, number->span, (double)low, (double)high);
    if (!memchr(text, '.', size) && tn_integer_read(text, size, value) && *value >= low && *value <= high)
        return true;
    *value = low;
    tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_NUMBER, number->span, "%s is a whole number from %lld to %lld",
                                 what, (long long)low, (long long)high);
    tn_help(kit->diagnostics, d, "as in `%s`",
            strcmp(what, "a colour") == 0             ? "in 4"
            : strcmp(what, "a symmetry") == 0         ? "turns 4"
            : strcmp(what, "a turn") == 0             ? "turn 1"
            : strcmp(what, "a stock") == 0            ? "stock 3001 <= 20"
            : strcmp(what, "an amount") == 0          ? "search beam 50"
            : strcmp(what, "a step") == 0             ? "steps 5"
            : strcmp(what, "a number of copies") == 0 ? "repeat 4 by (3 studs, 0, 0)"
                                                      : "4 x 2");
    return false;
}

void tn_kit_unknown(tn_kit *kit, const tn_names *names, const char *kind, tn_span span, const char *wrong,
                    const char *otherwise)
{
    if (kit->names_lost)
        return;
    tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_UNKNOWN, span, "there is no %s `%.100s`", kind, wrong);
    tn_kit_suggest(kit, d, names, wrong, otherwise);
}

void tn_kit_suggest(tn_kit *kit, tn_diagnostic *d, const tn_names *names, const char *wrong_name, const char *otherwise)
{
    const char **all = TN_NEW_ARRAY(kit->arena, const char *, names->count + 1);
    size_t count = 0;
    for (size_t i = 0; all && i < names->capacity; i++)
        if (names->entries[i].text)
            all[count++] = names->entries[i].text;
    const char *near = all ? tn_nearest(wrong_name, all, count) : NULL;
    if (near)
        tn_suggest(kit->diagnostics, d, "%s", near);
    else
        tn_help(kit->diagnostics, d, "%s", otherwise);
}
