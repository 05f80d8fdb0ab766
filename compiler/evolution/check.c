/* What the settings of an evolution block mean. Kinds and ranges are the rows of runtime/genome/settings.def. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "compiler/common/diagnostic.h"
#include "compiler/common/lexical.h"
#include "compiler/evolution/evolution.h"
#include "runtime/base/nearest.h"

typedef struct check {
    const tn_evolution_reader *reader;
    tn_evolution_study *study;
    const tn_evolution_setting *seen[TN_SETTING_COUNT];
} check;

static const char *nearest_setting(const char *name)
{
    const char *names[TN_SETTING_COUNT];
    size_t count = 0;
    for (size_t i = 0; i < TN_SETTING_COUNT; i++)
        if (tn_setting_rows[i].name)
            names[count++] = tn_setting_rows[i].name;
    return tn_nearest(name, names, count);
}

/* ---- wrong values */

/* "a, b or c" */
static void list_choices(const tn_setting_row *row, char *text, size_t size)
{
    uint32_t count = tn_setting_choice_count(row);
    size_t used = 0;
    for (uint32_t i = 0; i < count && used < size; i++) {
        char name[32];
        tn_setting_choice_name(row, i, name);
        const char *between = i + 2 < count ? ", " : i + 2 == count ? " or " : "";
        used += (size_t)snprintf(text + used, size - used, "%s%s", name, between);
    }
}

static void help_choose(tn_diagnostics *list, tn_diagnostic *diagnostic, const tn_setting_row *row,
                        const tn_evolution_value *value)
{
    enum { MOST = 16 };
    char names[MOST][32], all[200];
    const char *near[MOST];
    uint32_t count = tn_setting_choice_count(row);
    for (uint32_t i = 0; i < count && i < MOST; i++) {
        tn_setting_choice_name(row, i, names[i]);
        near[i] = names[i];
    }
    const char *meant = value && value->kind == TN_EVOLUTION_WORD ? tn_nearest(value->text, near, count) : NULL;
    list_choices(row, all, sizeof all);
    if (meant && strcasecmp(meant, value->text) != 0)
        tn_suggest(list, diagnostic, "%s", meant);
    else if (row->kind == TN_SETTING_CHOICE_REAL)
        tn_help(list, diagnostic, "write %s, and perhaps a number from %.7g to %.7g after it", all, row->low,
                row->high);
    else
        tn_help(list, diagnostic, "write %s", all);
}

static void help_each(tn_diagnostics *list, tn_diagnostic *diagnostic, tn_setting setting)
{
    const tn_setting_row *row = &tn_setting_rows[setting];
    if (setting == TN_SET_FITNESS)
        tn_help(list, diagnostic,
                "write a measure, what it shall be and how much that counts: "
                "`fitness volume target 200 weight 1`");
    else if (setting == TN_SET_PROGRAM)
        tn_help(list, diagnostic,
                "write the program's file in quotes, and perhaps a weight: `fitness program \"./score.sh\" weight 2`");
    else if (setting == TN_SET_LIKENESS)
        tn_help(list, diagnostic, "write the mesh that forms shall be like: `likeness \"target.obj\" weight 1`");
    else
        tn_help(list, diagnostic,
                "write a name in quotes, and perhaps a weight from %.0f to %.0f: "
                "`parent \"heart\" weight 0.4`",
                row->low, row->high);
}

static void bad_value(check *c, tn_setting setting, const tn_evolution_value *value, tn_span span)
{
    tn_diagnostics *list = c->reader->diagnostics;
    const tn_setting_row *row = &tn_setting_rows[setting];
    tn_diagnostic *diagnostic = tn_report(list, E_EVOLUTION_VALUE, span,
                                          value ? "`%s` cannot have this value" : "`%s` needs a value", row->name);
    switch (row->kind) {
    case TN_SETTING_WHOLE:
        tn_help(list, diagnostic, "write a whole number from %.0f to %.0f", row->low, row->high);
        break;
    case TN_SETTING_REAL:
        tn_help(list, diagnostic, "write a number from %.0f to %.0f", row->low, row->high);
        break;
    case TN_SETTING_SEED:
        tn_help(list, diagnostic, "write a whole number from 0 to %" PRIu64, UINT64_MAX);
        break;
    case TN_SETTING_PAIR:
        tn_help(list, diagnostic, "write a whole number from %.0f to %.0f, or a range of them, as 2..8", row->low,
                row->high);
        break;
    case TN_SETTING_SPAN:
        tn_help(list, diagnostic, "write a number from %.7g to %.7g, or a range of them, as 0.5..4", row->low,
                row->high);
        break;
    case TN_SETTING_EVERY:
        tn_help(list, diagnostic, "write two whole numbers from %.0f to %.0f, as `%s 2 every 10`", row->low, row->high,
                row->name);
        break;
    case TN_SETTING_EACH:
        help_each(list, diagnostic, setting);
        break;
    case TN_SETTING_TEXT:
        tn_help(list, diagnostic,
                value && value->kind == TN_EVOLUTION_STRING ? "the text cannot be empty" : "write a text in quotes");
        break;
    case TN_SETTING_CHOICE:
    case TN_SETTING_CHOICE_REAL:
        help_choose(list, diagnostic, row, value);
        break;
    }
}

/* The number after a word. */
static void bad_number(check *c, tn_setting setting, tn_span span)
{
    tn_diagnostics *list = c->reader->diagnostics;
    const tn_setting_row *row = &tn_setting_rows[setting];
    tn_diagnostic *diagnostic = tn_report(list, E_EVOLUTION_VALUE, span, "`%s` cannot have this number", row->name);
    tn_help(list, diagnostic, "write a number from %.0f to %.0f, or none", row->low, row->high);
}

/* Nothing will be said about its being missing. */
static void count_as_written(check *c, tn_setting setting, tn_span span)
{
    tn_setting_value *value = &c->study->of[setting];
    value->written = 1;
    value->text = tn_setting_rows[setting].kind == TN_SETTING_TEXT ? "?" : NULL;
    value->file = span.file;
    value->begin = span.begin;
    value->end = span.end;
}

/* More values than the setting takes: often another setting on the same line. */
static void extra_value(check *c, tn_setting setting, const tn_evolution_value *extra)
{
    tn_diagnostics *list = c->reader->diagnostics;
    tn_setting meant =
        extra->kind == TN_EVOLUTION_WORD ? tn_setting_named(extra->text, strlen(extra->text)) : TN_SETTING_COUNT;
    bool another = meant < TN_SETTING_COUNT;
    tn_diagnostic *diagnostic =
        tn_report(list, E_EVOLUTION_VALUE, extra->span,
                  another ? "`%s` stands behind another setting" : "this is one value too many for `%s`",
                  another ? extra->text : tn_setting_rows[setting].name);
    tn_help(list, diagnostic, another ? "write one setting a line, or a `;` between them" : "leave it out");
    if (another && c->study->of[meant].written == 0)
        count_as_written(c, meant, extra->span);
}

/* ---- reading values */

/* All numbers of a setting have the same range. */
static void note_range(const check *c, tn_setting setting, const tn_evolution_value *value)
{
    const tn_setting_row *row = &tn_setting_rows[setting];
    if (value->kind != TN_EVOLUTION_NUMBER && value->kind != TN_EVOLUTION_RANGE)
        return;
    if (row->kind == TN_SETTING_SEED)
        tn_range_note_whole64(c->reader->diagnostics, value->span);
    else
        tn_range_note(c->reader->diagnostics, value->span, row->low, row->high);
}

static bool read_pair(const tn_evolution_value *value, tn_setting_value *out)
{
    const char *dots = strstr(value->text, "..");
    if (value->kind == TN_EVOLUTION_NUMBER) {
        out->first = out->second = tn_decimal_value(value->text, strlen(value->text));
        return true;
    }
    if (value->kind != TN_EVOLUTION_RANGE || !dots)
        return false;
    out->first = tn_decimal_value(value->text, (size_t)(dots - value->text));
    out->second = tn_decimal_value(dots + 2, strlen(dots + 2));
    return true;
}

static bool read_choice(const tn_setting_row *row, const tn_evolution_value *value, tn_setting_value *out)
{
    out->choice = value->kind == TN_EVOLUTION_WORD ? tn_setting_choice(row, value->text) : UINT32_MAX;
    return out->choice != UINT32_MAX;
}

/* The number after a word. */
static bool read_second(const tn_evolution_value *value, tn_setting_value *out)
{
    if (value->kind != TN_EVOLUTION_NUMBER)
        return false;
    out->second = tn_decimal_value(value->text, strlen(value->text));
    out->written = 2;
    return true;
}

/* In digits it has all its 64 bits; written otherwise, as 1e6, what a double holds. */
static bool read_seed(const tn_evolution_value *value, tn_setting_value *out)
{
    uint64_t whole;
    if (value->kind != TN_EVOLUTION_NUMBER)
        return false;
    if (tn_whole_read(value->text, strlen(value->text), &whole))
        tn_setting_put_whole64(out, whole);
    else
        out->first = tn_decimal_value(value->text, strlen(value->text));
    return true;
}

static bool read_first(tn_setting setting, const tn_evolution_value *value, tn_setting_value *out)
{
    const tn_setting_row *row = &tn_setting_rows[setting];
    switch (row->kind) {
    case TN_SETTING_WHOLE:
    case TN_SETTING_EVERY:
    case TN_SETTING_REAL:
        if (value->kind != TN_EVOLUTION_NUMBER)
            return false;
        out->first = tn_decimal_value(value->text, strlen(value->text));
        return true;
    case TN_SETTING_SEED:
        return read_seed(value, out);
    case TN_SETTING_PAIR:
    case TN_SETTING_SPAN:
        return read_pair(value, out);
    case TN_SETTING_EACH:
        out->text = value->text;
        return value->kind == TN_EVOLUTION_STRING || (value->kind == TN_EVOLUTION_WORD && setting == TN_SET_FITNESS);
    case TN_SETTING_TEXT:
        out->text = value->text;
        return value->kind == TN_EVOLUTION_STRING;
    case TN_SETTING_CHOICE:
    case TN_SETTING_CHOICE_REAL:
        return read_choice(row, value, out);
    }
    return false;
}

/* `every G` behind a number. */
static bool read_every(const tn_evolution_value *word, tn_setting_value *out)
{
    const tn_evolution_value *number = word->next;
    if (word->kind != TN_EVOLUTION_WORD || strcasecmp(word->text, "every") != 0 || !number ||
        number->kind != TN_EVOLUTION_NUMBER)
        return false;
    out->second = tn_decimal_value(number->text, strlen(number->text));
    return true;
}

/* `target X` and `weight Y`, in any order, behind the text of a setting that may be there more than once. */
static bool read_wish(const check *c, tn_setting setting, const tn_evolution_value *word, tn_setting_value *out)
{
    const tn_evolution_value *number = word->next;
    if (word->kind != TN_EVOLUTION_WORD || !number || number->kind != TN_EVOLUTION_NUMBER)
        return false;
    double value = tn_decimal_value(number->text, strlen(number->text));
    if (strcasecmp(word->text, "weight") == 0) {
        out->second = value;
        note_range(c, setting, number);
    } else if (strcasecmp(word->text, "target") == 0 && setting == TN_SET_FITNESS) {
        out->first = value;
        tn_range_note(c->reader->diagnostics, number->span, -TN_COORDINATE_MAX, TN_COORDINATE_MAX);
    } else {
        return false;
    }
    return tn_setting_fits(setting, out);
}

/* One of those that may be there more than once. */
static void take_each(check *c, tn_setting setting, const tn_evolution_setting *item)
{
    const tn_evolution_value *value = item->values;
    tn_span span = value ? tn_span_join(item->span, value->last->span) : item->span;
    const tn_setting_row *row = &tn_setting_rows[setting];
    tn_setting_value read = {.written = 1,
                             .first = row->first,
                             .second = row->second,
                             .file = span.file,
                             .begin = span.begin,
                             .end = span.end};
    for (const tn_evolution_value *one = value; one; one = one->next)
        if (one->kind == TN_EVOLUTION_UNCLOSED) {
            count_as_written(c, setting, span);
            return;
        }
    bool fits = value && read_first(setting, value, &read) && tn_setting_fits(setting, &read);
    const tn_evolution_value *wrong = value;
    for (const tn_evolution_value *word = fits ? value->next : NULL; word; word = fits ? word->next->next : NULL) {
        wrong = word;
        fits = read_wish(c, setting, word, &read);
    }
    if (!fits) {
        count_as_written(c, setting, span);
        bad_value(c, setting, wrong, wrong ? wrong->span : item->span);
    } else if (!tn_evolution_study_add(c->study, setting, &read)) {
        tn_diagnostic *d = tn_report(c->reader->diagnostics, E_EVOLUTION_VALUE, span,
                                     "a study has at most %u parents and goals", TN_EACH_MAX);
        tn_help(c->reader->diagnostics, d, "leave some out");
    }
}

/* A value that is wrong counts as written; its default stands. */
static void take(check *c, tn_setting setting, const tn_evolution_setting *item)
{
    const tn_setting_row *row = &tn_setting_rows[setting];
    const tn_evolution_value *value = item->values, *second = value ? value->next : NULL;
    count_as_written(c, setting, value ? tn_span_join(item->span, value->last->span) : item->span);
    tn_setting_value read = c->study->of[setting];
    for (const tn_evolution_value *one = value; one; one = one->next)
        if (one->kind == TN_EVOLUTION_UNCLOSED)
            return;
        else
            note_range(c, setting, one);
    if (!value || !read_first(setting, value, &read) || !tn_setting_fits(setting, &read)) {
        bad_value(c, setting, value, value ? value->span : item->span);
        return;
    }
    bool numbered = row->kind == TN_SETTING_CHOICE_REAL && second && second->kind != TN_EVOLUTION_WORD;
    if (numbered && (!read_second(second, &read) || !tn_setting_fits(setting, &read))) {
        bad_number(c, setting, second->span);
        return;
    }
    bool repeated = row->kind == TN_SETTING_EVERY && second;
    if (repeated && (!read_every(second, &read) || !tn_setting_fits(setting, &read))) {
        bad_value(c, setting, second, second->span);
        return;
    }
    const tn_evolution_value *extra = numbered ? second->next : repeated ? second->next->next : second;
    if (extra) {
        extra_value(c, setting, extra);
        return;
    }
    c->study->of[setting] = read;
}

static void unknown(check *c, const tn_evolution_setting *item)
{
    tn_diagnostics *list = c->reader->diagnostics;
    tn_diagnostic *diagnostic =
        tn_report(list, E_EVOLUTION_SETTING, item->span, "there is no setting `%.60s`", item->name);
    const char *near = nearest_setting(item->name);
    if (near)
        tn_suggest(list, diagnostic, "%s", near);
    else
        tn_help(list, diagnostic, "docs/evolution.md lists all settings");
}

/* `fitness program ...` is a setting of two words; *program is it. */
static bool names_program(const tn_evolution_setting *item, tn_evolution_setting *program)
{
    tn_evolution_value *word = item->values;
    if (strcasecmp(item->name, tn_setting_rows[TN_SET_FITNESS].name) != 0 || !word || word->kind != TN_EVOLUTION_WORD ||
        strcasecmp(word->text, "program") != 0)
        return false;
    *program = *item;
    program->name = tn_setting_rows[TN_SET_PROGRAM].name;
    program->span = tn_span_join(item->span, word->span);
    program->values = word->next;
    if (word->next)
        word->next->last = word->last;
    return true;
}

static void check_setting(check *c, const tn_evolution_setting *item)
{
    tn_evolution_setting program;
    if (names_program(item, &program))
        item = &program;
    tn_setting setting = tn_setting_named(item->name, strlen(item->name));
    if (setting == TN_SETTING_COUNT) {
        unknown(c, item);
        return;
    }
    if (tn_setting_rows[setting].kind == TN_SETTING_EACH) {
        take_each(c, setting, item);
        return;
    }
    if (!c->seen[setting]) {
        c->seen[setting] = item;
        take(c, setting, item);
        return;
    }
    tn_diagnostics *list = c->reader->diagnostics;
    tn_diagnostic *diagnostic = tn_report(list, E_EVOLUTION_SETTING, item->span, "`%s` is there twice", item->name);
    tn_note(list, diagnostic, &c->seen[setting]->span, "the first is here");
    tn_help(list, diagnostic, "leave one of them out");
}

/* ---- the whole */

static tn_span span_of(const tn_setting_value *value)
{
    return (tn_span){value->file, value->begin, value->end};
}

static void check_whole(check *c)
{
    tn_setting_fault faults[TN_SETTING_FAULTS_MAX];
    tn_diagnostics *list = c->reader->diagnostics;
    size_t count = tn_evolution_study_faults(c->study, faults);
    for (size_t i = 0; i < count; i++) {
        const tn_setting_fault *fault = &faults[i];
        tn_span span = fault->setting == TN_SETTING_COUNT ? c->reader->head : span_of(&c->study->of[fault->setting]);
        tn_diagnostic *diagnostic = tn_report(list, E_EVOLUTION_VALUE, span, "%s", fault->message);
        if (fault->other != TN_SETTING_COUNT) {
            tn_span other = span_of(&c->study->of[fault->other]);
            tn_note(list, diagnostic, &other, "the other is here");
        }
        tn_help(list, diagnostic, "%s", fault->help);
    }
}

/* Said once: what stands there is often a whole growth study. */
static void check_outside(const tn_evolution_reader *reader)
{
    if (reader->outside.end == 0)
        return;
    tn_diagnostic *diagnostic =
        tn_report(reader->diagnostics, E_EVOLUTION_SYNTAX, reader->outside, "this stands outside the evolution block");
    tn_help(reader->diagnostics, diagnostic,
            "settings go between the braces; what says how a surface grows goes to a .study file of its own, which "
            "`grow \"FILE.study\"` names");
}

bool tn_evolution_check(const tn_evolution_reader *reader, tn_evolution_study *study)
{
    size_t errors = reader->diagnostics->error_count;
    check c = {.reader = reader, .study = study};
    tn_evolution_study_default(study);
    for (const tn_evolution_setting *item = reader->first; item; item = item->next)
        check_setting(&c, item);
    check_outside(reader);
    if (!reader->failed)
        check_whole(&c);
    return reader->diagnostics->error_count == errors;
}
