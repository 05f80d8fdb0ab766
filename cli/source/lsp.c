/* tartan lsp: the language server. */
#include <unistd.h>

#include "cli/common/job.h"
#include "lsp/serve.h"

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
    .summary = "run the language server for editors",
    .usage = "",
    .description =
        "Runs a language server, which speaks the Language Server Protocol on standard input and output. Editors start "
        "it; for VS Code there is an "
        "extension in editors/vscode. For every notation ("
#define FIRST_NOTATION(ID, EXTENSION, ...) EXTENSION
#define NOTATION(ID, EXTENSION, ...) ", " EXTENSION
#define VARIANT(...)
#include "compiler/notations.def"
        ") it shows errors as you type, outlines a file and formats it. For .plan files it also warns in the "
        "background about rules that are probably wrong, completes fields, values and rules, explains names, counts "
        "what rules prune, relates rules to each other, finds and renames names, and offers the fixes that messages "
        "suggest.",
    .example = "$ tartan lsp 2>lsp.log",
    .settings_size = sizeof(tn_settings),
    .operands = "no operands",
    .serves = true,
    .run = run,
};
