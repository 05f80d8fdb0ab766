/* tartan house: one house of a form, checked, and written to files. */
#include <string.h>

#include "cli/common/option_rows.h"
#include "cli/house/files.h"
#include "cli/house/houses.h"

typedef struct house_settings {
    tn_settings common;
    tn_house_outputs outputs;
    const char *form, *library;
    tn_option_number max_length, max_states;
} house_settings;

static const house_settings *settings_of(const tn_job *job)
{
    return (const house_settings *)job->settings;
}

/* The form that is meant: the named one, or the only one of the file itself, or the only one there is. */
static bool choose_form(tn_job *job, uint32_t *index)
{
    const tn_module *module = job->opened.module;
    const char *wanted = settings_of(job)->form;
    uint32_t own = 0, found = TN_NO_RECORD;
    for (uint32_t i = 0; i < module->FORM_count; i++) {
        bool imported = module->FORM_records[i].flags & TN_IMPORTED;
        if (wanted ? strcmp(tn_text(module, module->FORM_records[i].name), wanted) != 0
                   : imported && module->FORM_count > 1)
            continue;
        own++;
        found = i;
    }
    *index = found;
    if (own == 1)
        return true;
    tn_diagnostic *d = tn_job_usage(job,
                                    wanted               ? "there is no form `%s` in the file"
                                    : module->FORM_count ? "the file has several forms%.0s"
                                                         : "the file has no form%.0s",
                                    wanted ? wanted : "");
    tn_help(tn_job_diagnostics(job), d,
            wanted || !module->FORM_count ? "a form is declared by `form NAME of SCHEMA { ... }`"
                                          : "say which: --form NAME");
    return false;
}

static size_t max_trays(const tn_job *job)
{
    const tn_option_number *most = &settings_of(job)->max_length;
    return most->given ? (size_t)most->value : TN_HOUSE_TRAYS_DEFAULT;
}

static void write_files(tn_job *job, const tn_house *house)
{
    const char *text = job->settings->operands.items[1];
    tn_house_outputs outputs = settings_of(job)->outputs;
    outputs.name = tn_is_house_number(text) ? text : NULL;
    tn_house_files_write(job, house, &outputs);
}

static void read_house(tn_job *job, const tn_house_form *form, const char *line)
{
    tn_house house;
    tn_error error = {0};
    tn_status status = tn_house_read(form, line, strlen(line), max_trays(job), &house, &error);
    if (status == TN_OK) {
        write_files(job, &house);
    } else if (status == TN_INVALID) {
        tn_error_place(&error, error.column ? 1 : 0, error.column, error.column_end);
        tn_report_error(tn_job_diagnostics(job), &error, "HOUSE", line, strlen(line));
        tn_job_status(job, status);
    } else {
        tn_job_fail(job, &error);
    }
    tn_house_clear(&house);
}

static void read_line(tn_job *job, const char *line)
{
    uint32_t index;
    tn_schema *schema;
    tn_house_form form;
    tn_error error;
    if (!choose_form(job, &index))
        return;
    const tn_module *module = job->opened.module;
    if (tn_schema_new(module, module->FORM_records[index].schema, 0, &schema, &error) != TN_OK) {
        tn_job_fail(job, &error);
        return;
    }
    tn_form_ready(module, index, schema, &form);
    read_house(job, &form, line);
    tn_schema_free(schema);
}

/* What is wrong with the files is recorded. */
static tn_status write_numbered(void *job, const tn_house *house, tn_error *error)
{
    (void)error;
    write_files(job, house);
    return TN_OK;
}

static int run(const tn_command *command, const tn_settings *settings)
{
    (void)command;
    tn_job job;
    const char *text = settings->operands.items[1];
    tn_job_begin(&job, settings);
    const house_settings *own = settings_of(&job);
    if (tn_house_files_known(&job, &own->outputs) && tn_job_open(&job, settings->operands.items[0])) {
        const tn_house_settings houses = {
            .library = own->library,
            .max_length = max_trays(&job),
            .plans = {.max_states = (uint32_t)own->max_states.value, .max_length = (uint32_t)max_trays(&job)}};
        if (tn_is_house_number(text))
            tn_job_answered(&job, tn_session_house(&job.session, &houses, text, write_numbered, &job));
        else
            read_line(&job, text);
    }
    return tn_job_end(&job);
}

#define SETTINGS house_settings
#define WRITES                                                                                                         \
    (TN_WRITES_STANDARD | TN_WRITES_PICTURES | TN_WRITES(JSON) | TN_WRITES(CSV) | TN_WRITES(OBJ) | TN_WRITES(PLY) |    \
     TN_WRITES(GLB) | TN_WRITES(IFC) | TN_WRITES(DXF) | TN_WRITES_FOLDER)
static const tn_option options[] = {
    OUTPUTS(
        outputs.files, WRITES,
        "write to FILE, whose name says the format: .json, .csv, .obj, .ply, .glb, .ifc, .dxf, .svg, .pdf or .png; a "
        "folder (with "
        "a "
        "/ at its end) gets all of them; may be repeated"),
    LIST("view", 0, "VIEW", outputs.views,
         "what is drawn: plan:STOREY, section:x=LENGTH, section:y=LENGTH, elevation:SIDE, axonometric or sheet (all of "
         "these, the default); may be repeated"),
    TEXT("cut", 0, "STOREY", outputs.cut, "lift off what is above STOREY in the axonometric view"),
    CHOICE("furnish", 0, "WORD", outputs.furnish, "yes|no", "draw what stands in the rooms (the default), or not"),
    NUMBER("scale", 0, "N", outputs.scale, 1, 10000,
           "draw at 1:N; by default at the largest usual scale at which everything fits on paper"),
    REAL("azimuth", 0, "DEGREES", outputs.azimuth, "where the axonometric view is seen from, about z (default 60)"),
    REAL("elevation", 0, "DEGREES", outputs.elevation, "and how far above the ground (default 30)"),
    TEXT("title", 0, "TEXT", outputs.title,
         "the title of a picture or of an IFC file; by default the number of the house"),
    NUMBER("dpi", 0, "N", outputs.dpi, 10, 1200, "resolution of a .png (default 150)"),
    TEXT("form", 0, "NAME", form, "which form of the file; may be left out where the file has only one"),
    TEXT("library", 0, "NAME", library,
         "the library of houses that the number belongs to; may be left out where the file has one"),
    NUMBER("max-length", 0, "N", max_length, 1, 1u << 24, "the longest plan that is accepted, in trays (default 4096)"),
    NUMBER("max-states", 0, "N", max_states, 1, UINT32_MAX, "the most states of an automaton of the library of plans"),
};

const tn_command tn_command_house = {
    .name = "house",
    .summary = "build a house, draw it and export it",
    .usage =
        "FILE HOUSE [-o FILE]... [--view VIEW]... [--form NAME]\nFILE '#P:V' [-o FILE]... [--view VIEW]... [--library "
        "NAME]",
    .description =
        "Stands a plan up in a form (docs/houses.md): storeys, rooms with their functions, walls with their "
        "openings, decks, roofs, and what stands in the rooms. HOUSE is a house line in quotes: `plan ; section ; "
        "functions ; faces ; tiles`, or a JSON object with one. Parts at its end that leave no choice may be left out. "
        "#P:V is variant V of the "
        "plan of rank P in a library of houses, and #R the house of rank R. Without -o the house's line is written. "
        "JSON has everything, in whole nanometres; CSV has the rooms with their areas; OBJ, PLY and GLB have the "
        "house as one closed mesh in metres, in groups by what its parts are. IFC has it as a building model, in "
        "millimetres. SVG, PDF, PNG and DXF are drawings to scale: "
        "a sheet of all, or those that --view names.",
    .example = "$ tartan house cottage \"14' room:14' none ; 1 gable(9:12) 1 flat ; living ; wall window wall\"\n14' "
               "room:14' none ; 1 gable(9:12) 1 flat ; "
               "living ; wall window wall ; -",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "a FILE and a HOUSE",
    .operands_min = 2,
    .operands_max = 2,
    .run = run,
};
