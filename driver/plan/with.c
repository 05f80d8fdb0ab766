/* Opens a file with the values that a test gives its params. */
#include "driver/plan/with.h"

#include "driver/open/again.h"

/* Warnings are about the file as it is. */
static void forget_warnings(tn_opened *opened)
{
    tn_diagnostics *list = &opened->compilation.diagnostics;
    tn_diagnostics_clear(list);
    tn_diagnostics_init(list, &opened->compilation.sources);
}

tn_status tn_with_open(tn_with *with, tn_opened *opened, const tn_test_block *block, tn_error *error)
{
    if (with->test == block->with)
        return TN_OK;
    tn_with_clear(with);
    with->test = block->with;
    tn_status status = tn_open_again(opened, NULL, NULL, block->with, &with->opened);
    if (status == TN_OK) {
        with->opened.module->watch = opened->module->watch;
        forget_warnings(&with->opened);
    } else if (status == TN_INVALID) {
        tn_diagnostics_keep_errors(&with->opened.compilation.diagnostics);
        tn_with_said(with, opened, block);
        tn_with_clear(with);
    } else {
        status = tn_open_error(&with->opened, status, error);
        tn_with_clear(with);
    }
    return status;
}

void tn_with_said(tn_with *with, tn_opened *opened, const tn_test_block *block)
{
    tn_diagnostics *list = &with->opened.compilation.diagnostics;
    for (size_t i = 0; i < list->count; i++)
        tn_note(list, &list->items[i], &block->settings, "with these values");
    tn_diagnostics_move(list, &opened->compilation.diagnostics, 0);
}

void tn_with_clear(tn_with *with)
{
    if (with->test)
        tn_close(&with->opened);
    *with = (tn_with){0};
}
