/* tartan lsp: the language server. */
#include <unistd.h>

#include "cli/common/job.h"
#include "lsp/lsp.h"

static int run(const tn_command *command, const tn_settings *settings)
{
    (void)command;
    tn_job job;
    tn_error error;
    tn_job_begin(&job, settings);
    tn_status status = tn_lsp_serve(STDIN_FILENO, stdout, &error);
    if (status != TN_OK) {
        tn_job_status(&job, status);
        tn_job_fail(&job, &error);
    }
    return tn_job_end(&job);
}

const tn_command tn_command_lsp = {
    .name = "lsp",
    .summary = "answer an editor's questions (language server)",
    .usage = "",
    .description =
        "Speaks the Language Server Protocol on standard input and output. Editors start it: for VS Code there is an "
        "extension in editors/vscode. For every notation ("
#define FIRST_NOTATION(ID, EXTENSION, ...) EXTENSION
#define NOTATION(ID, EXTENSION, ...) ", " EXTENSION
#define VARIANT(...)
#include "compiler/notations.def"
        ") it shows what is wrong as you "
        "type, lists a file's contents and lays it out. For .plan files it also says in the background what rules "
        "mean where that is hardly meant, completes fields, values and rules, says what a name means, what its rule "
        "prunes and how it lies to others, finds and renames names, and offers the fixes that diagnostics suggest.",
    .example = "$ tartan lsp 2>lsp.log",
    .settings_size = sizeof(tn_settings),
    .operands = "no operands",
    .run = run,
};
