/* tartan disasm: lists what a rule file was compiled to. */
#include "runtime/vm/disasm.h"
#include <stdlib.h>

#include "cli/option_rows.h"
#include "cli/session.h"
#include "driver/library.h"

/* Finds the rules of --rule; `rules` has room for them. */
static bool choose_rules(tn_session *session, uint32_t *rules)
{
    const tn_option_list *asked = &session->settings->rules;
    tn_error error;
    if (!rules) {
        tn_fail_memory(&error);
        tn_session_fail(session, &error);
        return false;
    }
    for (size_t i = 0; i < asked->count; i++)
        tn_session_status(session, tn_rule_choose(&session->opened, asked->items[i], &rules[i]));
    return session->exit_code == TN_EXIT_DONE;
}

static void write_listing(tn_session *session, const uint32_t *rules, FILE *out)
{
    const tn_module *module = session->opened.module;
    bool listed = true;
    for (size_t i = 0; i < session->settings->rules.count && listed; i++)
        listed = tn_module_disassemble_rule(module, rules[i], out);
    if (session->settings->rules.count == 0)
        listed = tn_module_disassemble(module, out);
    if (!listed && !ferror(out)) {
        tn_error error;
        tn_fail_memory(&error);
        tn_session_fail(session, &error);
    }
}

static int run(const tn_command *command, const tn_settings *settings)
{
    (void)command;
    tn_session session;
    tn_output output;
    uint32_t *rules = malloc(sizeof *rules * (settings->rules.count + 1));
    tn_session_begin(&session, settings);
    if (tn_session_open(&session, settings->operands.items[0]) && choose_rules(&session, rules) &&
        tn_session_output(&session, settings->output, &output)) {
        write_listing(&session, rules, output.stream);
        tn_session_commit(&session, &output);
    }
    free(rules);
    return tn_session_end(&session);
}

static const tn_option options[] = {
    LIST("rule", 'r', "NAME", rules, "list only this rule and the functions it needs; may be repeated"),
    OPTION_OUTPUT,
};

const tn_command tn_command_disasm = {
    .name = "disasm",
    .summary = "list the bytecode of a rule file or module",
    .usage = "FILE [--rule NAME]... [-o FILE.txt]",
    .description =
        "Lists the tables of a module and each function's bytecode beside the source lines it comes from. Takes a rule "
        "file (compiled on the way) or a module.",
    .example = "$ tartan disasm houses.plan | less",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .operands = "one FILE",
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
