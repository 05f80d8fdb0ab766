/* tartan export: rules in other notations. */
#include <stdlib.h>
#include <string.h>

#include "cli/common/option_rows.h"
#include "cli/place/export_drawn.h"
#include "cli/plan/library_job.h"
#include "driver/place/export.h"
#include "driver/place/kit.h"
#include "runtime/plan/match/lower.h"
#include "runtime/plan/match/parts.h"
#include "runtime/plan/text/export_prolog.h"
#include "runtime/plan/text/export_regex.h"

typedef struct export_settings {
    tn_settings common;
    tn_plan_settings plans;
    bool prolog, regex, pcfg;
    tn_option_list rules;
    const char *output, *model, *kit, *init;
} export_settings;

static const export_settings *settings_of(const tn_job *job)
{
    return (const export_settings *)job->settings;
}

typedef struct exporting {
    tn_job *job;
    const tn_module *module;
    tn_schema *schema;
    uint32_t rule;
    tn_buffer text;
} exporting;

/* ---- patterns */

/* A rule alone has no lengths that would bound its sums. */
static void help_comparison(const exporting *e, uint32_t function, tn_error *error)
{
    tn_parts parts;
    bool compares = false;
    if (tn_parts_read(e->module, function, &parts, NULL) == TN_OK)
        for (uint32_t i = 0; i < parts.count; i++)
            compares |= parts.parts[i].kind == TN_PART_COMPARISON;
    if (compares)
        tn_error_help(error, "a pattern is made of a rule without a library, whose sums may only rise: "
                             "`quantity(a) <= 3`, `sum(width) < 12m`");
    tn_parts_clear(&parts);
}

static tn_status export_regex(exporting *e, tn_error *error)
{
    uint32_t function = e->module->RULE_records[e->rule].holds;
    tn_classes *classes = NULL;
    tn_lowering *lowering = NULL;
    tn_dfa *dfa = NULL;
    tn_status status = tn_classes_new(e->schema, &function, 1, &classes, error);
    if (status == TN_OK)
        status = tn_lowering_new(classes, (uint32_t)settings_of(e->job)->plans.max_states.value, &lowering, error);
    if (status == TN_OK)
        status = tn_lower(lowering, function, &dfa, error);
    if (status == TN_LIMIT)
        help_comparison(e, function, error);
    tn_buffer pattern = {0};
    if (status == TN_OK)
        status = tn_export_regex(dfa, &pattern, error);
    if (status == TN_OK && !tn_buffer_printf(&e->text, "# %s, a letter for each tray:\n",
                                             tn_text(e->module, e->module->RULE_records[e->rule].name)))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_regex_legend(dfa, classes, &e->text, error);
    if (status == TN_OK && !tn_buffer_printf(&e->text, "%s\n", pattern.size ? pattern.data : "# matches no plan"))
        status = tn_fail_memory(error);
    free(pattern.data);
    tn_dfa_free(dfa);
    tn_lowering_free(lowering);
    tn_classes_free(classes);
    return status;
}

/* ---- the command */

/* The rule asked for, and the schema: the rule's, the library's, or the only one. */
static bool choose(exporting *e, uint32_t *schema)
{
    const export_settings *settings = settings_of(e->job);
    uint32_t library;
    tn_status status;
    if (settings->regex) {
        status = tn_rule_choose(&e->job->opened, settings->rules.count ? settings->rules.items[0] : "", &e->rule);
        if (status == TN_OK)
            *schema = e->module->RULE_records[e->rule].schema;
    } else {
        status = tn_schema_choose(&e->job->opened, settings->plans.library, schema, &library);
    }
    tn_job_status(e->job, status);
    return status == TN_OK;
}

static void export(tn_job *job)
{
    exporting e = {.job = job, .module = job->opened.module};
    uint32_t schema;
    tn_error error;
    tn_output output;
    if (!choose(&e, &schema))
        return;
    tn_status status = tn_schema_new(e.module, schema, 0, &e.schema, &error);
    if (status == TN_OK)
        status = settings_of(job)->regex ? export_regex(&e, &error) : tn_export_prolog(e.schema, &e.text, &error);
    if (status != TN_OK) {
        tn_job_fail(job, &error);
    } else if (tn_job_output(job, settings_of(job)->output, &output)) {
        fwrite(e.text.data, 1, e.text.size, output.stream);
        tn_job_commit(job, &output);
    }
    free(e.text.data);
    tn_schema_free(e.schema);
}

/* ---- kits */

static tn_status write_kit(const tn_module *module, uint32_t model, tn_buffer *text, tn_error *error)
{
    tn_place_rules rules;
    tn_status status = tn_place_rules_of_model(module, model, &rules, error);
    FILE *out = status == TN_OK ? open_memstream(&text->data, &text->size) : NULL;
    if (status == TN_OK)
        status = out ? tn_kit_export(&rules, out, error) : tn_fail_memory(error);
    if (out && fclose(out) != 0 && status == TN_OK)
        status = tn_fail_memory(error);
    tn_place_rules_clear(&rules);
    return status;
}

static void export_kit(tn_job *job)
{
    tn_buffer text = {0};
    tn_error error;
    tn_output output;
    uint32_t model;
    if (job->opened.module->KIT_count == 0) {
        tn_job_usage(job, "--pcfg is about a kit, and %.200s is none", job->settings->operands.items[0]);
        return;
    }
    tn_status status = tn_kit_choose(&job->opened, settings_of(job)->model, &model);
    tn_job_status(job, status);
    if (status != TN_OK)
        return;
    status = write_kit(job->opened.module, model, &text, &error);
    if (status != TN_OK) {
        tn_job_fail(job, &error);
    } else if (tn_job_output(job, settings_of(job)->output, &output)) {
        fwrite(text.data, 1, text.size, output.stream);
        tn_job_commit(job, &output);
    }
    free(text.data);
}

/* Is what is asked of a model that was drawn in order? Otherwise that is told. */
static bool check_drawn(tn_job *job)
{
    const export_settings *s = settings_of(job);
    const char *path = s->common.operands.items[0];
    bool drawn = tn_path_is_drawn(path);
    if (!drawn && (s->kit || s->init))
        tn_job_usage(job, "--%s is about an LDraw file, .ldr or .mpd, and %.200s is none", s->kit ? "kit" : "init",
                     path);
    else if (drawn && (s->prolog || s->regex || s->model || !s->pcfg == !s->kit))
        tn_job_usage(job, "a model that was drawn is written as a connection grammar, --pcfg, or as a kit, --kit KIT");
    else if (s->init && !s->pcfg)
        tn_job_usage(job, "--init is how a connection grammar begins: it goes with --pcfg");
    else if (s->init && strpbrk(s->init, "\r\n"))
        tn_job_usage(job, "--init is of one line");
    else
        return true;
    return false;
}

static bool check_rules(tn_job *job)
{
    const export_settings *settings = settings_of(job);
    int kinds = settings->prolog + settings->regex + settings->pcfg;
    if (kinds != 1)
        tn_job_usage(job, kinds ? "--prolog, --regex and --pcfg are one or the other: leave one out"
                                : "say what to write: --prolog, --regex or --pcfg");
    else if (settings->model && !settings->pcfg)
        tn_job_usage(job, "--model is for --pcfg");
    else if (settings->regex && settings->rules.count != 1)
        tn_job_usage(job, "a pattern is of one rule: --rule NAME");
    else if (settings->prolog && settings->rules.count)
        tn_job_usage(job, "--prolog writes all rules; --rule is for --regex");
    else
        return true;
    return false;
}

/* What is written is in the notation that was asked for. */
static bool check_output(tn_job *job)
{
    const export_settings *s = settings_of(job);
    return s->prolog  ? tn_job_writes(job, "a Prolog program", s->output, TN_WRITES_TEXT | TN_WRITES(PROLOG))
           : s->regex ? tn_job_writes(job, "a pattern", s->output, TN_WRITES_TEXT)
           : s->pcfg  ? tn_job_writes(job, "a connection grammar", s->output, TN_WRITES_TEXT | TN_WRITES(PCFG))
                      : tn_job_writes(job, "a kit", s->output, TN_WRITES_TEXT | TN_WRITES(KIT));
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const export_settings *settings = (const export_settings *)common;
    const char *path = common->operands.items[0];
    const tn_export_drawn_options drawn = {settings->kit, settings->init, settings->output};
    tn_job job;
    tn_job_begin(&job, common);
    if (!check_drawn(&job) || !(tn_path_is_drawn(path) || check_rules(&job)) || !check_output(&job))
        return tn_job_end(&job);
    if (tn_path_is_drawn(path))
        tn_job_export_drawn(&job, &drawn, path);
    else if ((settings->pcfg ? tn_job_open(&job, path) : tn_job_open_plans(&job, path, &settings->plans)))
        (settings->pcfg ? export_kit : export)(&job);
    return tn_job_end(&job);
}

#define SETTINGS export_settings
static const tn_option options[] = {
    FLAG("prolog", 0, prolog, "write a Prolog program: a predicate for each rule, and keep_plan and prune_plan"),
    FLAG("regex", 0, regex, "write a POSIX extended regular expression over one letter for each class of trays"),
    FLAG("pcfg", 0, pcfg,
         "write a model of a kit, or one that was drawn, as a connection grammar, which places the same parts"),
    TEXT("kit", 'k', "KIT", kit, "write a model that was drawn as a kit, whose parts are those of KIT"),
    TEXT("init", 0, "TEXT", init,
         "with --pcfg, for a grammar that has rules of its own: what the model's rule begins with, such as bounds"),
    LIST("rule", 'r', "NAME", rules, "the rule of --regex"),
    TEXT("model", 'm', "NAME", model, "the model of --pcfg; may be left out where the kit has only one"),
    OPTIONS_LIBRARY,
    OPTION_LDRAW,
    OPTION_OUTPUT_BY(TN_WRITES_TEXT | TN_WRITES(PROLOG) | TN_WRITES(PCFG) | TN_WRITES(KIT),
                     ", as .pl with --prolog, .pcfg with --pcfg, .kit with --kit"),
    OPTION_MAX_STATES,
};

const tn_command tn_command_export = {
    .name = "export",
    .summary = "write rules in other notations",
    .usage = "FILE --prolog [-o RULES.pl]\nFILE --regex --rule NAME\nKIT --pcfg [--model NAME] [-o MODEL.pcfg]\n"
             "MODEL.ldr --pcfg [--init TEXT] [-o MODEL.pcfg]\nMODEL.ldr --kit KIT [-o MODEL.kit]",
    .description =
        "Writes rules for other programs. --prolog writes a complete program in ISO Prolog, in which a plan is a "
        "list of terms tray(V1, ..., Vn) with the values of a plan line. --regex writes a regular expression with "
        "a letter for each tray, which matches exactly the plans that the rule matches; a legend says which "
        "letter is which. It is made from the minimal automaton, and refused if it would need more than 2,000 "
        "characters or 62 letters. --pcfg writes the rules of a kit with its space, for programs that read connection "
        "grammars; draws among parts that fit cannot be said there.\n\n"
        "Of an LDraw file (.ldr, .mpd), --pcfg writes a connection grammar and --kit a kit that places its parts "
        "again, "
        "for rules to go on from. With --init the grammar is as the published program writes it, to be joined with one "
        "that has rules for the bricks B1x1NoCheck and B1x2NoCheck; without, it stands alone.",
    .example =
        "$ tartan export lahave.plan --regex --rule narrow-pair\n$ tartan export lahave.plan --prolog -o lahave.pl",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "a rule file",
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
