/* tartan house: one house of a form, checked, and written to files. */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "ask/session/questions.h"
#include "cli/common/job.h"
#include "cli/common/options.h"
#include "driver/house/files.h"

typedef struct house_settings {
    tn_settings common;
    tn_option_list files, views;
    const char *form, *library, *cut, *title, *project, *date, *revision, *author;
    int furnish; /* 1: no */
    tn_option_number scale, dpi, max_length, max_states;
    int profile;
    bool measures;
    tn_option_real azimuth, elevation, north, latitude, longitude;
} house_settings;

static const house_settings *settings_of(const tn_job *job)
{
    return (const house_settings *)job->settings;
}

/* ---- what -o names */

#define ENDINGS ".json, .csv, .parts.csv, .obj, .mtl, .ply, .glb, .ifc, .dxf, .svg, .pdf or .png"

/* The files that are made, what each is written as, and of those in a folder, which has one of every kind, the folder.
 * mtls: of each .obj, the name of the file beside it that has its materials; in its path. */
typedef struct house_files {
    const char **words, **folders, **mtls;
    char **paths;
    size_t count, mtl_count;
    bool line; /* standard output gets the house's line */
} house_files;

static bool is_folder(const char *path)
{
    struct stat known;
    size_t size = strlen(path);
    return (size > 1 && path[size - 1] == '/') || (stat(path, &known) == 0 && S_ISDIR(known.st_mode));
}

static bool names_known(tn_job *job)
{
    const tn_option_list *files = &settings_of(job)->files;
    bool known = true;
    for (size_t i = 0; i < files->count; i++) {
        const char *path = files->items[i];
        if (strcmp(path, "-") == 0 || tn_house_file_of(path) != TN_HOUSE_FILES || is_folder(path))
            continue;
        tn_diagnostic *d = tn_job_usage(job, "the name of `%s` says no format that a house can be written in", path);
        tn_help(tn_job_diagnostics(job), d, "let it end in " ENDINGS ", or in / for all of them in a folder");
        known = false;
    }
    return known;
}

/* Takes the path (malloc; NULL: there was no memory). */
static bool add_file(house_files *files, char *path, tn_house_file kind, const char *folder)
{
    files->words[files->count] = tn_house_file_ending(kind) + 1;
    files->folders[files->count] = folder;
    files->paths[files->count++] = path;
    return path != NULL;
}

static const char *known_path(const house_files *files, const char *path)
{
    for (size_t i = 0; i < files->count; i++)
        if (files->paths[i] && strcmp(files->paths[i], path) == 0)
            return files->paths[i];
    return NULL;
}

static const char *name_in(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* Beside a.obj is a.mtl, with its materials. */
static bool add_materials(house_files *files, const char *obj, const char *folder)
{
    int stem = (int)(strlen(obj) - strlen(tn_house_file_ending(TN_HOUSE_AS_OBJ)));
    char *path;
    if (asprintf(&path, "%.*s%s", stem, obj, tn_house_file_ending(TN_HOUSE_AS_MTL)) < 0)
        return false;
    const char *known = known_path(files, path);
    files->mtls[files->mtl_count++] = name_in(known ? known : path);
    if (!known)
        return add_file(files, path, TN_HOUSE_AS_MTL, folder);
    free(path);
    return true;
}

static bool add_named(house_files *files, const char *path)
{
    tn_house_file kind = tn_house_file_of(path);
    if (known_path(files, path))
        return true;
    return add_file(files, strdup(path), kind, NULL) && (kind != TN_HOUSE_AS_OBJ || add_materials(files, path, NULL));
}

static bool add_folder(house_files *files, const char *folder)
{
    bool good = true;
    for (int i = TN_HOUSE_AS_LINE + 1; good && i < TN_HOUSE_FILES; i++) {
        char *path;
        if (i == TN_HOUSE_AS_MTL) /* it is there with .obj */
            continue;
        const char *between = folder[strlen(folder) - 1] == '/' ? "" : "/";
        if (asprintf(&path, "%s%shouse%s", folder, between, tn_house_file_ending((tn_house_file)i)) < 0)
            path = NULL;
        good = add_file(files, path, (tn_house_file)i, folder);
        if (good && i == TN_HOUSE_AS_OBJ)
            good = add_materials(files, path, folder);
    }
    return good;
}

static bool list_files(tn_job *job, house_files *files)
{
    const tn_option_list *names = &settings_of(job)->files;
    size_t room = names->count * (TN_HOUSE_FILES + 1) + 1;
    tn_error error;
    *files = (house_files){.words = calloc(room, sizeof *files->words),
                           .folders = calloc(room, sizeof *files->folders),
                           .paths = calloc(room, sizeof *files->paths),
                           .mtls = calloc(room, sizeof *files->mtls),
                           .line = names->count == 0};
    bool good = files->words && files->folders && files->paths && files->mtls;
    for (size_t i = 0; good && i < names->count; i++) {
        const char *path = names->items[i];
        if (strcmp(path, "-") == 0)
            files->line = true;
        else if (tn_house_file_of(path) == TN_HOUSE_FILES)
            good = add_folder(files, path);
        else
            good = add_named(files, path);
    }
    if (!good) {
        tn_fail_memory(&error);
        tn_job_fail(job, &error);
    }
    return good;
}

static void clear_files(house_files *files)
{
    for (size_t i = 0; i < files->count; i++)
        free(files->paths[i]);
    free(files->paths);
    free(files->mtls);
    free(files->folders);
    free(files->words);
}

static bool measures_go_with_line(tn_job *job, const house_files *files)
{
    if (!settings_of(job)->measures || files->line)
        return true;
    tn_diagnostic *d = tn_job_usage(job, "--measures is about the house's line, which is not written");
    tn_help(tn_job_diagnostics(job), d,
            "add `-o -` to write it to standard output; .json has the measures in any case");
    return false;
}

/* ---- the command */

/* With measures above it, as comments. */
static void write_line(tn_job *job, const tn_built_house *built)
{
    tn_output output;
    if (!tn_job_output(job, NULL, &output))
        return;
    for (size_t i = 0; i < built->measures.count; i++) {
        const tn_valued_measure *value = &built->measures.items[i];
        fprintf(output.stream, "# %s: %s\n", value->measure, value->has_value ? value->shown : "no value");
    }
    fprintf(output.stream, "%s\n", built->house);
    tn_job_commit(job, &output);
}

static void ask(tn_job *job, const house_files *files)
{
    const house_settings *s = settings_of(job);
    const tn_house_request request = {.house = s->common.operands.items[1],
                                      .form = s->form,
                                      .library = s->library,
                                      .has_max_length = s->max_length.given,
                                      .max_length = s->max_length.value,
                                      .has_max_states = s->max_states.given,
                                      .max_states = s->max_states.value,
                                      .files = {files->words, files->count},
                                      .views = {s->views.items, s->views.count},
                                      .cut = s->cut,
                                      .bare = s->furnish == 1,
                                      .has_scale = s->scale.given,
                                      .scale = s->scale.value,
                                      .has_azimuth = s->azimuth.given,
                                      .azimuth = s->azimuth.value,
                                      .has_elevation = s->elevation.given,
                                      .elevation = s->elevation.value,
                                      .title = s->title,
                                      .project = s->project,
                                      .date = s->date,
                                      .revision = s->revision,
                                      .has_north = s->north.given,
                                      .north = s->north.value,
                                      .mtl = {files->mtls, files->mtl_count},
                                      .author = s->author,
                                      .has_latitude = s->latitude.given,
                                      .latitude = s->latitude.value,
                                      .has_longitude = s->longitude.given,
                                      .longitude = s->longitude.value,
                                      .has_dpi = s->dpi.given,
                                      .dpi = s->dpi.value,
                                      .profile = (unsigned)s->profile,
                                      .measures = s->measures};
    tn_made_outputs outputs;
    tn_reply answer;
    tn_job_files(job, &outputs, (const char *const *)files->paths, files->count, false);
    outputs.folders = files->folders;
    if (tn_job_answered(job, tn_ask_house(&job->session, &request, &answer)) && files->line)
        write_line(job, answer.value);
    tn_job_files_end(&outputs);
    tn_reply_clear(&answer);
}

static int run(const tn_command *command, const tn_settings *settings)
{
    (void)command;
    tn_job job;
    house_files files = {0};
    tn_job_begin(&job, settings);
    if (names_known(&job) && list_files(&job, &files) && measures_go_with_line(&job, &files) &&
        tn_job_open(&job, settings->operands.items[0]))
        ask(&job, &files);
    clear_files(&files);
    return tn_job_end(&job);
}

#define SETTINGS house_settings
#define WRITES                                                                                                         \
    (TN_WRITES_STANDARD | TN_WRITES_PICTURES | TN_WRITES(JSON) | TN_WRITES(CSV) | TN_WRITES(OBJ) | TN_WRITES(MTL) |    \
     TN_WRITES(PLY) | TN_WRITES(GLB) | TN_WRITES(IFC) | TN_WRITES(DXF) | TN_WRITES_FOLDER)
static const tn_option options[] = {
    OUTPUTS(files, WRITES,
            "write to FILE, whose name says the format: .json, .csv, .obj (with an .mtl beside it), .ply, .glb, .ifc, "
            ".dxf, "
            ".svg, .pdf or .png; a folder (with a / at its end) gets all of them; may be repeated"),
    LIST("view", 0, "VIEW", views,
         "what is drawn: plan:STOREY, plan:roof, section:x=LENGTH, section:y=LENGTH, elevation:SIDE, axonometric or sheet (all of "
         "these, the default); may be repeated"),
    TEXT("cut", 0, "STOREY", cut, "lift off what is above STOREY in the axonometric view"),
    CHOICE("furnish", 0, "WORD", furnish, "yes|no", "draw what stands in the rooms (the default), or not"),
    NUMBER("scale", 0, "N", scale, 1, 10000,
           "draw at 1:N; by default at the largest usual scale at which everything fits on paper"),
    REAL("azimuth", 0, "DEGREES", azimuth, "where the axonometric view is seen from, about z (default 60)"),
    REAL("elevation", 0, "DEGREES", elevation, "and how far above the ground (default 30)"),
    TEXT("title", 0, "TEXT", title, "the title of a picture or of an IFC or GLB file; by default the number of the house"),
    TEXT("project", 0, "TEXT", project, "what a drawing is for, in its title block; in an IFC file the project"),
    TEXT("date", 0, "TEXT", date, "when a drawing is from, in its title block; of an IFC file the time stamp, as 2026-05-12 or 2026-05-12T14:30:00; none unless given"),
    TEXT("revision", 0, "TEXT", revision, "which state of a drawing this is, in its title block"),
    REAL("north", 0, "DEGREES", north,
         "where north is on plans, clockwise from above, which is the back of the house: plans have an arrow, and IFC files "
         "true north"),
    TEXT("author", 0, "TEXT", author, "who an IFC file is by"),
    REAL("latitude", 0, "DEGREES", latitude, "where the site is in an IFC file, to the north"),
    REAL("longitude", 0, "DEGREES", longitude, "and to the east"),
    NUMBER("dpi", 0, "N", dpi, 10, 1200, "resolution of a .png (default 150)"),
    CHOICE("profile", 0, "WORD", profile, "auto|iso|us",
           "how an office draws: by ISO standards (iso: metres, paper of the A series, layers of a .dxf by ISO 13567) or "
           "by the US National CAD Standard (us: feet and inches, ARCH sheets, layers of the AIA); by default the latter "
           "for houses in feet"),
    TEXT("form", 0, "NAME", form, "which form of the file; may be left out where the file has only one"),
    TEXT("library", 0, "NAME", library,
         "the library of houses that the number belongs to, or that a line with values left out is of; may be left out "
         "where the file has one"),
    FLAG("measures", 0, measures,
         "write what the file's measures are worth on the house above its line, each as a comment"),
    OPTION_SET,
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
        "openings, floors, roofs, and what stands in the rooms. HOUSE is a house line in quotes: `plan ; options ; "
        "functions ; faces ; tiles`, or a JSON object with one. Values may be left out (`_`), and parts (`-`, or "
        "nothing at "
        "the end): it is then the first house of the library, or of the form, that has what is typed. "
        "#P:V is variant V of the "
        "plan of rank P in a library of houses, and #R the house of rank R. Without -o the house's line is written, "
        "with --measures below what the file's measures are worth on it. "
        "JSON has everything, in whole nanometres, and the measures in feet or metres; CSV has the rooms with their areas; OBJ, PLY and GLB have the "
        "house as one closed mesh in metres, OBJ and GLB with names by storey, room and part, and with glass that is seen "
        "through. IFC has it as a building model, in "
        "millimetres or, if the form is, in feet. SVG, PDF, PNG and DXF are drawings to scale: "
        "a sheet of all, or those that --view names.",
    .example = "$ tartan house cottage \"14' none room:14' none ; 1 1 gable(9:12) 1 ; living\"\n"
               "14' none room:14' none ; 1 1 gable(9:12) 1 ; living ; window window ; settle.back",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .operands = "a FILE and a HOUSE",
    .operands_min = 2,
    .operands_max = 2,
    .run = run,
};
