/* tartan export: rules in other notations. */
#include <string.h>
#include <strings.h>

#include "ask/place/export.h"
#include "ask/plan/export.h"
#include "ask/session/questions.h"
#include "cli/common/job.h"
#include "cli/common/options.h"
#include "cli/plan/library_job.h"

typedef struct export_settings {
    tn_settings common;
    tn_plan_settings plans;
    bool prolog, regex, pcfg, fetch;
    tn_option_list rules;
    const char *output, *model, *kit, *init;
} export_settings;

static const export_settings *settings_of(const tn_job *job)
{
    return (const export_settings *)job->settings;
}

/* The name of an LDraw file? */
static bool is_drawn(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot && (strcasecmp(dot, ".ldr") == 0 || strcasecmp(dot, ".mpd") == 0 || strcasecmp(dot, ".dat") == 0);
}

/* Is one notation asked for, and no more than one rule? The question sees to the rest. */
static bool check_words(tn_job *job, bool drawn)
{
    const export_settings *s = settings_of(job);
    int kinds = s->prolog + s->regex + s->pcfg;
    if (drawn && !s->prolog && !s->regex && !s->pcfg == !s->kit)
        tn_job_usage(job, "a model that was drawn is written as a connection grammar, --pcfg, or as a kit, --kit KIT");
    else if (!drawn && !s->kit && !s->init && kinds != 1)
        tn_job_usage(job, kinds ? "--prolog, --regex and --pcfg are one or the other: leave one out"
                                : "say what to write: --prolog, --regex or --pcfg");
    else if (!drawn && s->regex && s->rules.count > 1)
        tn_job_usage(job, "a pattern is of one rule: --rule NAME");
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

static tn_export_request request_of(const export_settings *s, bool drawn)
{
    bool named = s->output && strcmp(s->output, "-") != 0;
    return (tn_export_request){.as = s->kit     ? TN_EXPORT_KIT
                                     : s->pcfg  ? TN_EXPORT_PCFG
                                     : s->regex ? TN_EXPORT_REGEX
                                                : TN_EXPORT_PROLOG,
                               .subject = tn_job_asked(&s->plans),
                               .rule = s->rules.count ? s->rules.items[0] : NULL,
                               .fetch = s->fetch,
                               .model = s->model,
                               .drawn = {.path = drawn ? s->common.operands.items[0] : NULL},
                               .init = s->init,
                               .at = named ? s->output : NULL};
}

/* A grammar of a drawn model says nothing of rules. */
static bool open_rules(tn_job *job, bool drawn)
{
    const export_settings *s = settings_of(job);
    const char *path = s->common.operands.items[0];
    if (drawn)
        return s->pcfg || tn_job_open(job, s->kit);
    return s->pcfg ? tn_job_open(job, path) : tn_job_open_plans(job, path, &s->plans);
}

static void export(tn_job *job, const tn_export_request *request)
{
    const char *path = settings_of(job)->output ? settings_of(job)->output : "-";
    tn_made_outputs outputs;
    tn_reply answer;
    tn_job_files(job, &outputs, &path, 1, false);
    tn_job_answered(job, tn_ask_export(&job->session, request, &answer));
    tn_job_files_end(&outputs);
    tn_reply_clear(&answer);
}

static int run(const tn_command *command, const tn_settings *common)
{
    (void)command;
    const export_settings *settings = (const export_settings *)common;
    const char *path = common->operands.items[0];
    bool drawn = is_drawn(path);
    const tn_export_request request = request_of(settings, drawn);
    tn_job job;
    tn_job_begin(&job, common);
    if (check_words(&job, drawn) && tn_job_answered(&job, tn_export_check(&job.session, &request, path)) &&
        check_output(&job) && open_rules(&job, drawn))
        export(&job, &request);
    return tn_job_end(&job);
}

#define SETTINGS export_settings
static const tn_option options[] = {
    FLAG("prolog", 0, prolog, "write a Prolog program: a predicate for each rule, and keep_plan and prune_plan"),
    FLAG("fetch", 0, fetch,
         "with --prolog: also fetch(Tray, Field, Value) and prune_plan(Trays), as the rules of the paper are written"),
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
