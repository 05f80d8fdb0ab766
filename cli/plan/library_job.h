/* What the commands that work on one library have in common: opening it as the options say. */
#ifndef TARTAN_CLI_PLAN_LIBRARY_JOB_H
#define TARTAN_CLI_PLAN_LIBRARY_JOB_H

#include "ask/plan/found.h"
#include "ask/session/requests.h"
#include "cli/common/job.h"
#include "cli/common/options.h"
#include "driver/plan/library.h"
#include "runtime/place/count/count.h"

/* ---- options about the buildings of a kit, for commands that ask the same of libraries */

typedef struct tn_kit_options {
    tn_option_number parts;
    tn_option_list kinds; /* parts by name; none: all of the kit */
    const char *inside;   /* a model of the kit, or NULL */
    bool fixed;
} tn_kit_options;

/* Rows for commands that embed tn_kit_options as `kit`. verb: what is done with the buildings. */
#define OPTIONS_KIT(verb)                                                                                              \
    NUMBER("parts", 0, "N", kit.parts, 1, TN_COUNT_PARTS_MAX, "of a kit: " verb " the buildings of N parts"),          \
        LIST("part", 0, "NAME", kit.kinds, "of a kit: only of these parts; may be repeated (default: all)"),           \
        TEXT("inside", 0, "MODEL", kit.inside,                                                                         \
             "of a kit: " verb " those inside of the space of this model, each where it stands"),                      \
        FLAG("fixed", 0, kit.fixed, "of a kit: tell apart buildings that differ by a turn")

/* The same as part of a request. */
static inline tn_kit_asked tn_kit_options_asked(const tn_kit_options *options)
{
    return (tn_kit_asked){.has_parts = options->parts.given,
                          .parts = options->parts.value,
                          .part = {options->kinds.items, options->kinds.count},
                          .inside = options->inside,
                          .fixed = options->fixed};
}

/* The options of commands about plans: which library, and what the work may take. Commands embed it as `plans`. */
typedef struct tn_plan_settings {
    const char *library;
    tn_option_list wheres; /* further requirements */
    tn_option_range trays;
    tn_option_number max_length, max_states, max_houses, threads;
} tn_plan_settings;

#define OPTION_LIBRARY                                                                                                 \
    TEXT("library", 'l', "NAME", plans.library,                                                                        \
         "which library of the file; may be left out where the file has only one")
#define OPTION_WHERE                                                                                                   \
    LIST("where", 0, "EXPRESSION", plans.wheres,                                                                       \
         "only plans that meet EXPRESSION too, a requirement in the words of the file; may be repeated. Answers call " \
         "them where@1, where@2 and so on")
#define OPTION_TRAYS                                                                                                   \
    RANGE("trays", 0, "A..B", plans.trays, 0, UINT32_MAX - 1,                                                          \
          "how many trays a plan has, instead of what the library says")
#define OPTION_MAX_LENGTH                                                                                              \
    NUMBER("max-length", 0, "N", plans.max_length, 1, 1u << 24,                                                        \
           "the longest plan that is accepted, in trays (default 4096)")
#define OPTION_MAX_STATES                                                                                              \
    NUMBER("max-states", 0, "N", plans.max_states, 1, 1u << 30,                                                        \
           "the most states an automaton may have while it is made (default 20000, 1000000 for a library)")
#define OPTION_MAX_HOUSES(HELP) NUMBER("max-houses", 0, "N", plans.max_houses, 1, 0, HELP)
#define WALKED_HOUSES_HELP                                                                                             \
    "if walks are asked for: the most houses of a plan that are gone through one by one (default 100000)"
#define TRIED_HOUSES_HELP(NUMBER)                                                                                      \
    "of a library that asks for walks, if no plan is given: the most houses that are tried (default " NUMBER ")"
/* What most commands about libraries take: which library, and within which limits. */
#define OPTIONS_LIBRARY OPTION_LIBRARY, OPTION_WHERE, OPTION_SET
#define OPTIONS_LIBRARY_LIMITS OPTION_TRAYS, OPTION_MAX_LENGTH, OPTION_MAX_STATES, OPTION_THREADS(plans.threads)

/* What searching may take, for commands that search a library whose automaton passes a limit. Commands embed it as
 * `search`. */
typedef struct tn_search_settings {
    tn_option_number max_conflicts, max_gates;
} tn_search_settings;

#define OPTIONS_SEARCH                                                                                                 \
    NUMBER("max-conflicts", 0, "N", search.max_conflicts, 1, INT32_MAX,                                                \
           "of a library that is searched, since its automaton passes a limit: the most conflicts on the way to one "  \
           "answer of the solver (default 1000000)"),                                                                  \
        NUMBER("max-gates", 0, "N", search.max_gates, 1, 1u << 30,                                                     \
               "of a library that is searched: the most gates that a clause is made into; one with more is judged "    \
               "plan by plan (default 4194304)")

/* The same as part of a request. */
static inline tn_search_asked tn_search_settings_asked(const tn_search_settings *settings)
{
    return (tn_search_asked){.has_max_conflicts = settings->max_conflicts.given,
                             .max_conflicts = settings->max_conflicts.value,
                             .has_max_gates = settings->max_gates.given,
                             .max_gates = settings->max_gates.value};
}

#define OPTION_ENGINE                                                                                                  \
    CHOICE(                                                                                                            \
        "engine", 0, "ENGINE", engine, "auto|vm|dfa",                                                                  \
        "vm (the interpreter) or dfa (automata); auto, the default, is automata with the interpreter for rules that "  \
        "pass the state limit")

/* Opens the file with the further requirements of --where; false where that failed (then end the job). */
bool tn_job_open_plans(tn_job *job, const char *path, const tn_plan_settings *plans);

/* Opens the file and makes the chosen library ready; false where that failed (then end the job). */
bool tn_job_library(tn_job *job, const char *path, const tn_plan_settings *plans, tn_ready_library *ready);

/* The same of a file that tn_job_open_plans has opened. */
bool tn_job_opened_library(tn_job *job, const tn_plan_settings *plans, tn_ready_library *ready);

/* Is the library that --library names one of houses? */
bool tn_job_of_houses(const tn_job *job, const tn_plan_settings *plans);

/* What the options say of a library's plans and of the work that it may take. */
tn_library_options tn_job_library_options(const tn_plan_settings *plans);

/* The same as part of a request. */
tn_library_asked tn_job_asked(const tn_plan_settings *plans);

/* The same, but only the schema: for commands that match plans against the clauses. */
bool tn_job_library_schema(tn_job *job, const char *path, const tn_plan_settings *plans, tn_ready_library *ready);

/* How many threads the options ask for. */
unsigned tn_job_threads(const tn_plan_settings *plans);

/* The longest plan that the options accept. */
size_t tn_job_max_length(const tn_plan_settings *plans);

/* ---- what `best` and `pareto` are told to make small or great */

/* Room for the measures of --least, --most and so on. */
typedef struct tn_wished {
    tn_wish items[TN_WEIGHED_MAX];
    size_t count;
} tn_wished;

/* Reads the options, which have added to `list`; `least` of them are needed. False if one is wrong: then reported. */
bool tn_job_wishes(tn_job *job, const tn_option_list *list, uint32_t least, tn_wished *wished);

#endif
