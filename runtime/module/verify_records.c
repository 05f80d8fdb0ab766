/* Verifies the strings, and every field of every record by its row in records.def. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "runtime/base/utf8.h"
#include "runtime/module/records.h"
#include "runtime/module/verify.h"

/* A field of a section, in all of its records. */
typedef struct tn_column {
    tn_checker *checker;
    tn_section section;
    const char *records;
    size_t size, count; /* of the records */
    const tn_member *member;
} tn_column;

static const void *record_at(const tn_column *column, size_t index)
{
    return column->records + index * column->size;
}

static uint32_t value_at(const tn_column *column, size_t index, const tn_member *member)
{
    return (uint32_t)tn_member_whole(record_at(column, index), member);
}

/* "rewrite rule 3: " and the reason. */
__attribute__((format(printf, 3, 4))) static tn_status refuse(const tn_column *column, size_t index, const char *format,
                                                              ...)
{
    char what[160], title[TN_TITLE_MAX];
    va_list args;
    va_start(args, format);
    vsnprintf(what, sizeof what, format, args);
    va_end(args);
    tn_section_title(column->section, title);
    return tn_refuse(column->checker, "%s %zu: %s", title, index, what);
}

/* ---- strings */

static tn_status check_strings(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    if (module->strings_size == 0 || module->strings[0] != '\0' || module->strings[module->strings_size - 1] != '\0')
        return tn_refuse(checker, "its strings do not begin and end with a zero byte");
    if (!tn_is_utf8(module->strings, module->strings_size))
        return tn_refuse(checker, "its strings are not UTF-8 text");
    return TN_OK;
}

/* A string begins where another ends: no string is the tail of another. */
static bool is_string(const tn_module *module, tn_string string)
{
    return string < module->strings_size && (string == 0 || module->strings[string - 1] == '\0');
}

static tn_status check_texts(const tn_column *column)
{
    const tn_module *module = column->checker->module;
    const tn_member *member = column->member;
    size_t most = (size_t)member->high;
    for (size_t i = 0; i < column->count; i++) {
        tn_string text = value_at(column, i, member);
        if (!is_string(module, text))
            return refuse(column, i, "%s is no string", member->name);
        if (text == 0 && member->low > 0)
            return refuse(column, i, "%s is empty", member->name);
        if (most < UINT32_MAX && strnlen(tn_text(module, text), most + 1) > most)
            return refuse(column, i, "%s has more than %zu bytes", member->name, most);
    }
    return TN_OK;
}

/* ---- numbers */

static tn_status check_wholes(const tn_column *column)
{
    const tn_member *member = column->member;
    if (member->storage == TN_STORAGE_U32 && member->low == 0 && member->high == UINT32_MAX)
        return TN_OK;
    for (size_t i = 0; i < column->count; i++) {
        int64_t value = tn_member_whole(record_at(column, i), member);
        if (value < member->low || value > member->high)
            return refuse(column, i, "%s is %" PRId64 "; %" PRId64 " to %" PRId64 " are possible", member->name, value,
                          member->low, member->high);
        if (member->names && !member->names[value])
            return refuse(column, i, "%s is %" PRId64 ", which nothing has for its number", member->name, value);
    }
    return TN_OK;
}

static tn_status check_reals(const tn_column *column)
{
    const tn_member *member = column->member;
    for (size_t i = 0; i < column->count; i++) {
        double value = tn_member_real(record_at(column, i), member);
        if (!(isfinite(value) && value >= member->least && value <= member->most))
            return refuse(column, i, "%s is %g; %g to %g are possible", member->name, value, member->least,
                          member->most);
    }
    return TN_OK;
}

static tn_status check_flags(const tn_column *column)
{
    for (size_t i = 0; i < column->count; i++)
        if ((value_at(column, i, column->member) & ~(uint32_t)column->member->high) != 0)
            return refuse(column, i, "%s has unknown bits", column->member->name);
    return TN_OK;
}

/* ---- references and runs */

static tn_status check_references(const tn_column *column, bool or_none)
{
    const tn_member *member = column->member;
    size_t total = column->checker->module->tables[member->section].count;
    for (size_t i = 0; i < column->count; i++) {
        uint32_t value = value_at(column, i, member);
        if (value < total || (or_none && value == TN_NO_RECORD))
            continue;
        char title[TN_TITLE_MAX];
        tn_section_title(member->section, title);
        return refuse(column, i, "%s is %s %u, which is not there", member->name, title, value);
    }
    return TN_OK;
}

static tn_status refuse_rest(const tn_column *column)
{
    char title[TN_TITLE_MAX], owner[TN_TITLE_MAX];
    tn_section_title(column->member->section, title);
    tn_section_title(column->section, owner);
    return tn_refuse(column->checker, "it has %s records that belong to no %s record", title, owner);
}

static tn_status refuse_run(const tn_column *column, size_t index)
{
    char title[TN_TITLE_MAX];
    tn_section_title(column->member->section, title);
    return refuse(column, index, "its run of %s records does not follow the one before", title);
}

/* Each record's run begins where that of the record before ends, and the last ends with the section. */
static tn_status check_runs(const tn_column *column)
{
    const tn_member *first = column->member, *counted = first + 1;
    size_t total = column->checker->module->tables[first->section].count, end = 0;
    for (size_t i = 0; i < column->count; i++) {
        uint32_t count = value_at(column, i, counted);
        if (count < counted->low || count > counted->high)
            return refuse(column, i, "%s is %u; %u to %u are possible", counted->name, count, (unsigned)counted->low,
                          (unsigned)counted->high);
        if (value_at(column, i, first) != end || count > total - end)
            return refuse_run(column, i);
        end += count;
    }
    return end == total ? TN_OK : refuse_rest(column);
}

static tn_status check_slices(const tn_column *column)
{
    const tn_member *first = column->member;
    size_t total = column->checker->module->tables[first->section].count;
    for (size_t i = 0; i < column->count; i++) {
        uint32_t begin = value_at(column, i, first), count = value_at(column, i, first + 1);
        if (begin > total || count > total - begin)
            return refuse(column, i, "%s and %s name records that are not there", first->name, first[1].name);
    }
    return TN_OK;
}

/* ---- places */

/* Measures the texts; together they are no longer than a file may be (a text that many records share could otherwise
 * be measured without end). */
static tn_status measure_sources(tn_checker *checker)
{
    const tn_module *module = checker->module;
    size_t left = checker->limits->bytes < UINT32_MAX ? checker->limits->bytes : UINT32_MAX - 1;
    for (size_t i = 0; i < module->SOURCE_count; i++) {
        if (!is_string(module, module->SOURCE_records[i].text))
            return tn_refuse(checker, "source %zu: its text is not a string", i);
        size_t size = strnlen(tn_text(module, module->SOURCE_records[i].text), left + 1);
        if (size > left)
            return tn_fail(checker->error, TN_LIMIT, E_MODULE_TOO_LARGE,
                           "the module's sources together pass the limit of %zu bytes", checker->limits->bytes);
        left -= size;
        checker->sizes[i] = (uint32_t)size;
    }
    return TN_OK;
}

static tn_status check_places(const tn_column *column)
{
    const tn_checker *checker = column->checker;
    const tn_member *member = column->member;
    for (size_t i = 0; i < column->count; i++) {
        uint32_t file = value_at(column, i, member);
        uint32_t begin = value_at(column, i, member + 1), end = value_at(column, i, member + 2);
        if (file >= checker->module->SOURCE_count || begin > end || end > checker->sizes[file])
            return refuse(column, i, "it names a place outside its source");
    }
    return TN_OK;
}

/* ---- all of them */

static tn_status check_column(const tn_column *column)
{
    switch (column->member->kind) {
    case TN_MEMBER_TEXT:
        return check_texts(column);
    case TN_MEMBER_WHOLE:
        return check_wholes(column);
    case TN_MEMBER_REAL:
        return check_reals(column);
    case TN_MEMBER_FLAGS:
        return check_flags(column);
    case TN_MEMBER_REF:
        return check_references(column, false);
    case TN_MEMBER_REF_OR_NONE:
        return check_references(column, true);
    case TN_MEMBER_RUN:
        return check_runs(column);
    case TN_MEMBER_SLICE:
        return check_slices(column);
    case TN_MEMBER_FILE:
        return check_places(column);
    case TN_MEMBER_BITS:
    case TN_MEMBER_REF_AT_TIMES: /* the engine knows when */
    case TN_MEMBER_COUNT:        /* with the run */
    case TN_MEMBER_CODE:         /* with the code */
    case TN_MEMBER_CODE_END:
    case TN_MEMBER_BEGIN: /* with the file */
    case TN_MEMBER_END:
        break;
    }
    return TN_OK;
}

static tn_status check_section(tn_checker *checker, tn_section section)
{
    tn_section_info info = tn_section_describe(section);
    const tn_table *table = &checker->module->tables[section];
    for (size_t i = 0; i < info.members.count; i++) {
        tn_column column = {checker, section, table->records, info.size, table->count, &info.members.items[i]};
        tn_status status = check_column(&column);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

tn_status tn_verify_records(tn_checker *checker)
{
    tn_status status = check_strings(checker);
    if (status == TN_OK)
        status = measure_sources(checker);
    for (tn_section i = 0; i < TN_SECTION_COUNT && status == TN_OK; i++)
        status = check_section(checker, i);
    return status;
}
