/* Coverage as a table. */
#include <stdlib.h>
#include <string.h>

#include "driver/coverage/coverage.h"
#include "driver/open/digits.h"

#define LABEL_WIDTH 58u
#define FORM_WIDTH 80u
#define NUMBER_WIDTH 26
#define DEEPEST 8u /* parts deeper in their rule are not indented further */

/* Cuts a text off after so many bytes, but not within a character. */
static void cut(char *text, size_t most)
{
    size_t length = strlen(text);
    if (length <= most)
        return;
    length = most - 3;
    while (length > 0 && ((unsigned char)text[length] & 0xc0) == 0x80)
        length--;
    strcpy(text + length, "...");
}

/* How many columns a text takes: its characters. */
static size_t characters(const char *text)
{
    size_t count = 0;
    for (; *text; text++)
        count += ((unsigned char)*text & 0xc0) != 0x80;
    return count;
}

tn_place tn_covered_place(const tn_covered *covered, tn_span span)
{
    tn_sources *sources = (tn_sources *)(uintptr_t)&covered->opened->compilation.sources; /* finds its lines late */
    return tn_sources_place(sources, span);
}

/* ---- rules about plans */

const char *tn_covered_change_words(const tn_covered_part *part)
{
    static const char *const words[] = {
        [TN_CHANGE_NEVER] = "never matches",     [TN_CHANGE_ALWAYS] = "always matches",
        [TN_CHANGE_ANY_TRAY] = "is any tray",    [TN_CHANGE_LEFT_OUT] = "left out",
        [TN_CHANGE_REPLACED] = "changed to",     [TN_CHANGE_COMPARED] = "compared by",
        [TN_CHANGE_WRITTEN] = "only as written", [TN_CHANGE_MIRRORED] = "only mirrored",
        [TN_CHANGE_CLAUSE] = "left out",
    };
    return words[part->change ? part->change->kind : TN_CHANGE_NEVER];
}

bool tn_covered_change(const tn_covered_part *part, tn_buffer *out)
{
    const char *to = part->change ? part->change->to : NULL;
    return tn_buffer_printf(out, "%s", tn_covered_change_words(part)) && (!to || tn_buffer_printf(out, " `%s`", to));
}

/* "`8'` of `tray(8', body dense)` changed to `12'`" */
static bool write_change(const tn_covered_part *part, tn_buffer *out)
{
    return tn_buffer_printf(out, "`%s`", part->text) &&
           (!part->around || tn_buffer_printf(out, " of `%s`", part->around)) && tn_buffer_printf(out, " ") &&
           tn_covered_change(part, out);
}

static const char *library_name(const tn_covered *covered)
{
    return tn_text(covered->opened->module, covered->library->name);
}

/* How many plans are decided otherwise, and by whom. */
static bool write_flips(const tn_covered *covered, const tn_covered_part *part, tn_buffer *out)
{
    char *digits = tn_digits(part->flips, true);
    bool one = mpz_cmp_ui(part->flips, 1) == 0;
    bool ok = digits && tn_buffer_printf(out, "%s plan%s decided otherwise", digits, one ? " is" : "s are") &&
              (!part->alone || tn_buffer_printf(out, ", though `%s` keeps the same ones", library_name(covered)));
    free(digits);
    return ok;
}

static bool write_telling(const tn_covered *covered, const tn_covered_part *part, tn_buffer *out)
{
    if (!part->telling.found)
        return true;
    const tn_covered_part *told = &covered->parts[part->telling.same_as];
    tn_place place = tn_covered_place(covered, told->place);
    if (told != part)
        return tn_buffer_printf(out, "\n      now: as at %zu:%zu", place.line, place.column);
    return tn_buffer_printf(out, "\n      now: %s: ", tn_covered_subject_name(covered, part)) &&
           tn_covered_case(covered, part, out);
}

static bool write_survivor(const tn_covered *covered, const tn_covered_part *part, tn_buffer *out)
{
    tn_place place = tn_covered_place(covered, part->place);
    return tn_buffer_printf(out, "  %s:%zu:%zu: %s: ", place.path, place.line, place.column, part->name) &&
           write_change(part, out) && tn_buffer_printf(out, "\n      ") && write_flips(covered, part, out) &&
           write_telling(covered, part, out) && tn_buffer_printf(out, "\n");
}

static bool write_equal(const tn_covered *covered, const tn_covered_part *part, tn_buffer *out)
{
    tn_place place = tn_covered_place(covered, part->place);
    return tn_buffer_printf(out, "  %s:%zu:%zu: %s: ", place.path, place.line, place.column, part->name) &&
           write_change(part, out) && tn_buffer_printf(out, "\n");
}

typedef bool write_one(const tn_covered *covered, const tn_covered_part *part, tn_buffer *out);

static bool write_fate(const tn_covered *covered, tn_covered_fate fate, const char *heading, write_one *write,
                       tn_buffer *out)
{
    if (tn_covered_count(covered, false, fate) == 0)
        return true;
    bool ok = tn_buffer_printf(out, "%s\n", heading);
    for (size_t i = 0; ok && i < covered->count; i++)
        if (!covered->parts[i].of_houses && covered->parts[i].fate == fate)
            ok = write(covered, &covered->parts[i], out);
    return ok;
}

static bool write_rule(const tn_covered *covered, size_t first, size_t end, tn_buffer *out)
{
    size_t fates[TN_FATE_COUNT] = {0};
    char *name = strdup(covered->parts[first].name);
    if (!name)
        return false;
    for (size_t i = first; i < end; i++)
        fates[covered->parts[i].fate]++;
    cut(name, LABEL_WIDTH - 20);
    bool ok = tn_buffer_printf(out, "  %s%*s %7zu %12zu %15zu %10zu\n", name,
                               (int)(LABEL_WIDTH - 20 - characters(name)), "", end - first, fates[TN_FATE_NOTICED],
                               fates[TN_FATE_SURVIVES] + fates[TN_FATE_UNKNOWN], fates[TN_FATE_EQUAL]);
    free(name);
    return ok;
}

static bool write_rules(const tn_covered *covered, tn_buffer *out)
{
    bool ok = tn_buffer_printf(out, "%-*s %7s %12s %15s %10s\n", (int)LABEL_WIDTH - 18, "rule", "changes",
                               "a test fails", "all tests pass", "same plans");
    for (size_t i = 0, end; ok && i < covered->count; i = end) {
        end = tn_covered_rule_end(covered, i);
        ok = covered->parts[i].of_houses || write_rule(covered, i, end, out);
    }
    return ok;
}

static bool write_head(const tn_covered *covered, tn_buffer *out)
{
    size_t all = tn_covered_count(covered, false, TN_FATE_COUNT);
    bool ok = covered->library ? tn_buffer_printf(out, "coverage in `%s`, plans of ", library_name(covered))
                               : tn_buffer_printf(out, "coverage over all plans of ");
    ok = ok && (covered->min == covered->max ? tn_buffer_printf(out, "%u trays", covered->max)
                                             : tn_buffer_printf(out, "%u to %u trays", covered->min, covered->max));
    return ok && tn_buffer_printf(out, ": %zu small change%s of the rules, and whether a test fails then\n", all,
                                  all == 1 ? "" : "s");
}

static bool write_sum(const tn_covered *covered, tn_buffer *out)
{
    size_t all = tn_covered_count(covered, false, TN_FATE_COUNT);
    size_t noticed = tn_covered_count(covered, false, TN_FATE_NOTICED);
    size_t equal = tn_covered_count(covered, false, TN_FATE_EQUAL);
    size_t left = all - noticed - equal;
    bool ok = tn_buffer_printf(out,
                               "%zu of %zu changes make a test fail, %zu decide%s every plan as before, %zu pass%s "
                               "every test\n",
                               noticed, all, equal, equal == 1 ? "s" : "", left, left == 1 ? "es" : "");
    return ok && (!covered->changes.more ||
                  tn_buffer_printf(out, "%zu more changes were not tried: the limit is %u in a file\n",
                                   covered->changes.more, TN_COVERAGE_CHANGES));
}

static bool write_changes(const tn_covered *covered, tn_buffer *out)
{
    return write_head(covered, out) &&
           write_fate(covered, TN_FATE_SURVIVES, "all tests pass with these:", write_survivor, out) &&
           write_fate(covered, TN_FATE_UNKNOWN,
                      "all tests pass with these, and how many plans they decide otherwise is not known:", write_equal,
                      out) &&
           write_fate(covered, TN_FATE_EQUAL,
                      "every plan of these lengths is decided as before with these:", write_equal, out) &&
           write_rules(covered, out) && write_sum(covered, out);
}

/* ---- rules about houses */

/* Each rule is counted in the first library of the file that uses it: where there are several, none is named. */
static bool write_houses(const tn_covered *covered, tn_buffer *out)
{
    const tn_module *module = covered->opened->module;
    const tn_house_library_record *only = NULL;
    size_t count = 0;
    for (uint32_t i = 0; i < module->HOUSE_LIBRARY_count; i++)
        if (!(module->HOUSE_LIBRARY_records[i].flags & TN_IMPORTED)) {
            only = &module->HOUSE_LIBRARY_records[i];
            count++;
        }
    return count == 1  ? tn_buffer_printf(out, "over the houses of `%s`", tn_text(module, only->name))
           : count > 0 ? tn_buffer_printf(out, "over the houses of each rule's library")
                       : tn_buffer_printf(out, "of rules about houses");
}

static bool write_part(const tn_covered_part *part, tn_buffer *out)
{
    unsigned indent = 2 * (part->depth < DEEPEST ? part->depth : DEEPEST);
    char *digits = part->counted ? tn_digits(part->flips, true) : strdup(""), *text = strdup(part->text);
    bool ok = digits && text;
    if (ok) {
        cut(text, LABEL_WIDTH - indent);
        size_t used = characters(text), room = LABEL_WIDTH - indent;
        const char *unit = part->counted ? " houses" : "";
        ok = tn_buffer_printf(out, "  %*s%s%*s %*s%s  %s\n", (int)indent, "", text, (int)(room - used), "",
                              NUMBER_WIDTH - (int)strlen(unit), digits, unit, part->noticed ? "yes" : "no");
    }
    free(digits);
    free(text);
    return ok;
}

static bool write_parts(const tn_covered *covered, tn_buffer *out)
{
    bool ok = tn_buffer_printf(out, "coverage ") && write_houses(covered, out) &&
              tn_buffer_printf(out, ": what would change if the part never matched\n%-*s %26s  %s\n",
                               (int)LABEL_WIDTH + 2, "part", "houses decided otherwise", "tests notice");
    for (size_t i = 0; ok && i < covered->count; i++) {
        const tn_covered_part *part = &covered->parts[i];
        ok = !part->of_houses ||
             ((part->depth > 0 || tn_buffer_printf(out, "%s\n", part->name)) && write_part(part, out));
    }
    return ok && tn_buffer_printf(out, "%zu of %zu parts noticed by tests\n",
                                  tn_covered_count(covered, true, TN_FATE_NOTICED),
                                  tn_covered_count(covered, true, TN_FATE_COUNT));
}

/* ---- forms */

static bool write_form_part(const tn_covered *covered, const tn_form_line *part, tn_buffer *out)
{
    unsigned indent = 2 * part->depth;
    char *text = strdup(part->text);
    if (!text)
        return false;
    cut(text, FORM_WIDTH - indent);
    size_t room = FORM_WIDTH - indent - characters(text);
    bool ok = tn_buffer_printf(out, "%5zu  %*s%s%*s %6zu\n", tn_covered_place(covered, part->place).line, (int)indent,
                               "", text, (int)room, "", part->houses);
    free(text);
    return ok;
}

static bool write_form(const tn_covered *covered, const tn_form_coverage *form, tn_buffer *out)
{
    bool ok = tn_buffer_printf(
        out, "`%s`%s%s in the houses of %zu test%s: how many have what a line says\n%5s  %-*s %6s\n", form->name,
        form->imported ? " of " : "", form->imported ? tn_covered_place(covered, form->place).path : "", form->tests,
        form->tests == 1 ? "" : "s", "line", (int)FORM_WIDTH, "part", "houses");
    for (size_t i = 0; ok && i < form->count; i++)
        ok = write_form_part(covered, &form->parts[i], out);
    return ok && tn_buffer_printf(out, "%zu of %zu parts are in a house of a test\n", form->reached, form->count);
}

bool tn_covered_text(const tn_covered *covered, tn_buffer *out)
{
    bool houses = tn_covered_count(covered, true, TN_FATE_COUNT) > 0;
    bool plans = !houses || tn_covered_count(covered, false, TN_FATE_COUNT) > 0;
    bool ok = (!plans || write_changes(covered, out)) && (!houses || write_parts(covered, out));
    for (size_t i = 0; ok && i < covered->form_count; i++)
        ok = write_form(covered, &covered->forms[i], out);
    return ok;
}
