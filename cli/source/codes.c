#include "cli/source/codes.h"

#include "compiler/common/diagnostic.h"

static const tn_code_row rows[] = {
#define ERROR(NUMBER, NAME, SUMMARY) {NUMBER, SUMMARY},
#define WARNING(NUMBER, NAME, SUMMARY) {10000 + NUMBER, SUMMARY},
#include "runtime/base/codes.def"
#undef ERROR
#undef WARNING
};

static const struct {
    uint32_t code;
    const char *text;
} examples[] = {
#define EXAMPLE(CODE, TEXT) {CODE, TEXT},
#include "code_examples.def"
#undef EXAMPLE
};

const tn_code_row *tn_code_rows(size_t *count)
{
    *count = sizeof rows / sizeof *rows;
    return rows;
}

const tn_code_row *tn_code_row_of(uint32_t code)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (rows[i].code == code)
            return &rows[i];
    return NULL;
}

void tn_code_explain(const tn_code_row *row, tn_buffer *text)
{
    char name[8];
    tn_code_name(row->code, name);
    tn_buffer_printf(text, "%s: %s\n", name, row->summary);
    for (size_t i = 0; i < sizeof examples / sizeof *examples; i++)
        if (examples[i].code == row->code)
            tn_buffer_printf(text, "\nFor example:\n\n%s", examples[i].text);
    if (row->code >= 10000)
        tn_buffer_printf(
            text, "\nWhere it is meant, write `allow %s` before a rule's `=`, or as a line of a library.\n", name);
}
