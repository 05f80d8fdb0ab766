/* Coverage as a table and as JSON. */
#include <stdlib.h>
#include <string.h>

#include "driver/open/digits.h"
#include "driver/plan/coverage.h"

#define LABEL_WIDTH 58u
#define FORM_WIDTH 80u
#define NUMBER_WIDTH 26
#define DEEPEST 8u /* parts deeper in their rule are not indented further */

static size_t count_parts(const tn_covered *covered, bool of_houses)
{
    size_t count = 0;
    for (size_t i = 0; i < covered->count; i++)
        count += covered->parts[i].of_houses == of_houses;
    return count;
}

static bool write_plans(const tn_covered *covered, tn_buffer *out)
{
    const tn_library_record *library = covered->library;
    return library ? tn_buffer_printf(out, "in `%s`", tn_text(covered->opened->module, library->name))
                   : tn_buffer_printf(out, "over all plans of 1 to %u trays", TN_COVERAGE_TRAYS);
}

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

static bool write_head(const tn_covered *covered, tn_buffer *out)
{
    bool houses = count_parts(covered, true) > 0, plans = !houses || count_parts(covered, false) > 0;
    bool ok = tn_buffer_printf(out, "coverage ") && (!plans || write_plans(covered, out)) &&
              (!plans || !houses || tn_buffer_printf(out, ", and ")) && (!houses || write_houses(covered, out));
    const char *decided = !houses ? "plans decided otherwise"
                          : plans ? "decided otherwise"
                                  : "houses decided otherwise";
    return ok && tn_buffer_printf(out, ": what would change if the part never matched\n%-*s %26s  %s\n",
                                  (int)LABEL_WIDTH + 2, "part", decided, "tests notice");
}

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

/* `both`: the table has plans and houses, so that each number says which it counts. */
static bool write_part(const tn_covered_part *part, bool both, tn_buffer *out)
{
    unsigned indent = 2 * (part->depth < DEEPEST ? part->depth : DEEPEST);
    bool known = !part->of_houses || part->counted;
    char *digits = known ? tn_digits(part->flips, true) : strdup(""), *text = strdup(part->text);
    bool ok = digits && text;
    if (ok) {
        cut(text, LABEL_WIDTH - indent);
        size_t used = characters(text), room = LABEL_WIDTH - indent;
        const char *unit = part->counted ? " houses" : both && !part->of_houses ? " plans" : "";
        ok = tn_buffer_printf(out, "  %*s%s%*s %*s%s  %s\n", (int)indent, "", text, (int)(room - used), "",
                              NUMBER_WIDTH - (int)strlen(unit), digits, unit, part->noticed ? "yes" : "no");
    }
    free(digits);
    free(text);
    return ok;
}

/* ---- forms */

tn_place tn_covered_place(const tn_covered *covered, tn_span span)
{
    tn_sources *sources = (tn_sources *)(uintptr_t)&covered->opened->compilation.sources; /* finds its lines late */
    return tn_sources_place(sources, span);
}

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
    bool ok = write_head(covered, out), both = count_parts(covered, true) > 0 && count_parts(covered, false) > 0;
    for (size_t i = 0; ok && i < covered->count; i++) {
        const tn_covered_part *part = &covered->parts[i];
        ok = (part->depth > 0 || tn_buffer_printf(out, "%s\n", part->name)) && write_part(part, both, out);
    }
    if (ok && covered->count)
        ok = tn_buffer_printf(out, "%zu of %zu parts noticed by tests\n", covered->noticed, covered->count);
    for (size_t i = 0; ok && i < covered->form_count; i++)
        ok = write_form(covered, &covered->forms[i], out);
    return ok;
}
