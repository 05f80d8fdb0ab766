/* tartan house: one house of a form, checked, and written to files. */
#include <stdlib.h>
#include <string.h>

#include "cli/common/job.h"
#include "cli/common/option_rows.h"
#include "runtime/geometry/write.h"
#include "runtime/house/describe.h"
#include "runtime/house/mesh.h"

typedef struct house_settings {
    tn_settings common;
    tn_option_list outputs;
    const char *form;
    tn_option_number max_length;
} house_settings;

static const house_settings *settings_of(const tn_job *job)
{
    return (const house_settings *)job->settings;
}

/* The files that are written, by the ends of their names. */
typedef enum tn_house_file { FILE_LINE, FILE_JSON, FILE_CSV, FILE_OBJ, FILE_PLY, FILE_GLB, FILE_KINDS } tn_house_file;
static const char *const endings[] = {NULL, ".json", ".csv", ".obj", ".ply", ".glb"};

static tn_house_file file_kind(tn_job *job, const char *path)
{
    size_t size = strlen(path);
    if (strcmp(path, "-") == 0)
        return FILE_LINE;
    for (int i = 1; i < FILE_KINDS; i++)
        if (size > strlen(endings[i]) && strcmp(path + size - strlen(endings[i]), endings[i]) == 0)
            return (tn_house_file)i;
    tn_diagnostic *d = tn_job_usage(job, "the name of `%s` says no format that a house can be written in", path);
    tn_help(tn_job_diagnostics(job), d, "let it end in .json, .csv, .obj, .ply or .glb");
    return FILE_KINDS;
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

static tn_status write_mesh(const tn_solids *solids, tn_house_file kind, FILE *out, tn_error *error)
{
    tn_mesh mesh = {0};
    tn_mesh_style style = {0};
    tn_status status = tn_house_mesh(solids, &mesh, error);
    if (status == TN_OK && kind == FILE_GLB) /* takes triangles only */
        status = tn_mesh_triangulate(&mesh, error);
    if (status == TN_OK)
        status = kind == FILE_OBJ   ? tn_mesh_write_obj(&mesh, &style, out, error)
                 : kind == FILE_PLY ? tn_mesh_write_ply(&mesh, &style, out, error)
                                    : tn_mesh_write_glb(&mesh, &style, out, error);
    tn_mesh_clear(&mesh);
    return status;
}

static tn_status write_text(const tn_house *house, const tn_solids *solids, tn_house_file kind, FILE *out,
                            tn_error *error)
{
    tn_buffer text = {0};
    tn_status status = kind == FILE_JSON  ? tn_house_describe(house, solids, &text, error)
                       : kind == FILE_CSV ? tn_house_schedule(house, &text, error)
                                          : tn_house_write(house, &text, error);
    if (status == TN_OK && kind == FILE_LINE)
        tn_buffer_append(&text, "\n", 1);
    if (status == TN_OK && text.failed)
        status = tn_fail_memory(error);
    if (status == TN_OK)
        fwrite(text.data, 1, text.size, out);
    free(text.data);
    return status;
}

static void write_file(tn_job *job, const tn_house *house, const tn_solids *solids, const char *path)
{
    tn_house_file kind = file_kind(job, path);
    tn_output output;
    tn_error error;
    if (!tn_job_output(job, path, &output))
        return;
    tn_status status = kind >= FILE_OBJ ? write_mesh(solids, kind, output.stream, &error)
                                        : write_text(house, solids, kind, output.stream, &error);
    if (status != TN_OK)
        tn_job_fail(job, &error);
    tn_job_close(job, &output, status == TN_OK);
}

static void write_files(tn_job *job, const tn_house *house)
{
    const tn_option_list *files = &settings_of(job)->outputs;
    tn_solids solids = {0};
    tn_error error;
    tn_status status = tn_house_solids(house, &solids, &error);
    if (status != TN_OK)
        tn_job_fail(job, &error);
    for (size_t i = 0; status == TN_OK && i < files->count; i++)
        write_file(job, house, &solids, files->items[i]);
    if (status == TN_OK && files->count == 0)
        write_file(job, house, &solids, "-");
    tn_solids_clear(&solids);
}

static void read_house(tn_job *job, const tn_house_form *form, const char *line)
{
    size_t max_trays =
        settings_of(job)->max_length.given ? (size_t)settings_of(job)->max_length.value : TN_HOUSE_TRAYS_DEFAULT;
    tn_house house;
    tn_error error = {0};
    tn_status status = tn_house_read(form, line, strlen(line), max_trays, &house, &error);
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

/* Do the names of all outputs say a format? */
static bool files_known(tn_job *job)
{
    bool known = true;
    for (size_t i = 0; i < settings_of(job)->outputs.count; i++)
        known &= file_kind(job, settings_of(job)->outputs.items[i]) != FILE_KINDS;
    return known;
}

static int run(const tn_command *command, const tn_settings *settings)
{
    (void)command;
    tn_job job;
    uint32_t index;
    tn_job_begin(&job, settings);
    if (files_known(&job) && tn_job_open(&job, settings->operands.items[0]) && choose_form(&job, &index)) {
        tn_schema *schema;
        tn_house_form form;
        tn_error error;
        tn_status status =
            tn_schema_new(job.opened.module, job.opened.module->FORM_records[index].schema, 0, &schema, &error);
        if (status == TN_OK) {
            tn_form_ready(job.opened.module, index, schema, &form);
            read_house(&job, &form, settings->operands.items[1]);
            tn_schema_free(schema);
        } else {
            tn_job_fail(&job, &error);
        }
    }
    return tn_job_end(&job);
}

#define SETTINGS house_settings
static const tn_option options[] = {
    LIST("output", 'o', "FILE", outputs,
         "write to FILE, whose name says the format: .json, .csv, .obj, .ply or .glb; may be repeated"),
    TEXT("form", 0, "NAME", form, "which form of the file; may be left out where the file has only one"),
    NUMBER("max-length", 0, "N", max_length, 1, 1u << 24, "the longest plan that is accepted, in trays (default 4096)"),
};

const tn_command tn_command_house = {
    .name = "house",
    .summary = "build a house from a plan",
    .usage = "FILE HOUSE [-o FILE]... [--form NAME]",
    .description = "Stands a plan up in a form (docs/houses.md): storeys, rooms with their functions, walls with their "
                   "openings, decks, roofs, "
                   "and what stands in the rooms. "
                   "HOUSE is a house line in quotes: `plan ; section ; functions ; faces ; tiles`. Parts at its end "
                   "that leave no choice may be "
                   "left out. Without -o the whole line is written. "
                   "JSON has everything, in whole nanometres; CSV has the rooms with their areas; OBJ, PLY and GLB "
                   "have the solids as a "
                   "mesh, grouped by what they are, in metres.",
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
