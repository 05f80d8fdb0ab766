/* Verifies a module: its records by their rows, what the engines say of them, and the code. */
#include "runtime/module/verify.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/module/engine.h"
#include "runtime/module/records.h"

tn_status tn_refuse(const tn_checker *checker, const char *format, ...)
{
    char what[200], where[80] = "", title[TN_TITLE_MAX];
    va_list args;
    va_start(args, format);
    vsnprintf(what, sizeof what, format, args);
    va_end(args);
    bool in_code = checker->section != TN_SECTION_STRINGS;
    tn_section_title(checker->section, title);
    if (in_code)
        snprintf(where, sizeof where, "%s %u, code offset %u: ", title, checker->record, checker->offset);
    tn_fail(checker->error, TN_INVALID, E_REFUSED_MODULE, "the module is refused: %s%s", where, what);
    if (in_code && checker->error)
        checker->error->code_offset = checker->offset;
    return TN_INVALID;
}

static int compare_texts(const void *left, const void *right)
{
    const char *const *a = left, *const *b = right;
    return strcmp(*a, *b);
}

tn_status tn_check_different(const tn_checker *checker, const tn_string *texts, size_t stride, size_t count,
                             const char *reason)
{
    if (count < 2)
        return TN_OK;
    const char **sorted = malloc(count * sizeof *sorted);
    if (!sorted)
        return tn_fail_memory(checker->error);
    for (size_t i = 0; i < count; i++) {
        tn_string text;
        memcpy(&text, (const char *)texts + i * stride, sizeof text);
        sorted[i] = tn_text(checker->module, text);
    }
    qsort(sorted, count, sizeof *sorted, compare_texts);
    bool different = true;
    for (size_t i = 1; i < count; i++)
        different = different && strcmp(sorted[i - 1], sorted[i]) != 0;
    free(sorted);
    return different ? TN_OK : tn_refuse(checker, "%s", reason);
}

/* The sections that belong to the module itself. */
static bool is_common(tn_section section)
{
    return section == TN_SECTION_STRINGS || section == TN_SECTION_CODE || section == TN_SECTION_FUNCTION ||
           section == TN_SECTION_SOURCE || section == TN_SECTION_SOURCE_MAP || section == TN_SECTION_PRODUCER;
}

static tn_status check_owners(const tn_checker *checker)
{
    for (tn_section i = 0; i < TN_SECTION_COUNT; i++)
        if (checker->module->tables[i].count > 0 && !is_common(i) && !tn_engine_of_section(checker->engines, i))
            return tn_refuse(checker, "this program lacks the engine of its section %s", tn_section_describe(i).name);
    return TN_OK;
}

static tn_status check_engines(const tn_checker *checker)
{
    for (size_t i = 0; i < checker->engines->count; i++) {
        const tn_engine *engine = checker->engines->items[i];
        tn_status status = engine->verify ? engine->verify(checker) : TN_OK;
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

tn_status tn_module_verify(const tn_module *module, const tn_engines *engines, const tn_module_limits *limits,
                           tn_error *error)
{
    tn_checker checker = {.module = module, .engines = engines, .limits = limits, .error = error};
    tn_engines_operands(engines, checker.operands);
    checker.sizes = calloc(module->SOURCE_count + 1, sizeof *checker.sizes);
    tn_status status = checker.sizes ? check_owners(&checker) : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_verify_records(&checker);
    if (status == TN_OK && module->PRODUCER_count > 1)
        status = tn_refuse(&checker, "it has more than one producer");
    if (status == TN_OK)
        status = check_engines(&checker);
    if (status == TN_OK)
        status = tn_verify_code(&checker);
    free(checker.sizes);
    return status;
}
