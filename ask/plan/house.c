/* house: a house of a form, checked, and written as files. */
#include <stdlib.h>
#include <string.h>

#include "ask/house/numbered.h"
#include "ask/session/made.h"
#include "ask/session/questions.h"
#include "driver/house/files.h"

typedef struct building {
    tn_session *session;
    const tn_house_request *request;
    tn_built_house *built;
    tn_house_filed filed;
} building;

/* ---- which files */

/* The kind that a word of the request means: json, parts.csv and so on. */
static tn_status kind_of(const char *word, tn_house_file *kind, tn_error *error)
{
    const char *words[TN_HOUSE_FILES];
    char list[200];
    size_t count = 0;
    for (int i = TN_HOUSE_AS_LINE + 1; i < TN_HOUSE_FILES; i++) {
        words[count] = tn_house_file_ending((tn_house_file)i) + 1;
        if (strcmp(words[count++], word) == 0) {
            *kind = (tn_house_file)i;
            return TN_OK;
        }
    }
    tn_fail(error, TN_INVALID, E_USAGE, "a house cannot be written as `%.60s`", word);
    tn_word_list(words, count, list, sizeof list);
    tn_error_help(error, "it is written as %s", list);
    return TN_INVALID;
}

/* What only drawings have and is asked for; NULL if there is none. A title is for building models, too. */
static const char *asked_of_drawings(const tn_house_request *request)
{
    const struct {
        const char *name;
        bool given;
    } all[] = {{"view", request->views.count > 0}, {"cut", request->cut != NULL},
               {"furnish", request->bare},         {"scale", request->has_scale},
               {"azimuth", request->has_azimuth},  {"elevation", request->has_elevation},
               {"dpi", request->has_dpi}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (all[i].given)
            return all[i].name;
    return NULL;
}

static tn_status check_files(tn_session *session, const tn_house_request *request)
{
    bool draws = false;
    tn_house_file kind;
    tn_error error;
    for (size_t i = 0; i < request->files.count; i++) {
        if (kind_of(request->files.items[i], &kind, &error) != TN_OK)
            return tn_session_fail(session, &error);
        draws |= tn_house_file_draws(kind);
    }
    const char *name = draws ? NULL : asked_of_drawings(request);
    return name ? tn_session_refuse(session, "add `-o NAME.svg`, or .pdf, .png or .dxf",
                                    "--%s is about drawings, and no file is one", name)
                : TN_OK;
}

/* ---- written */

static tn_status write_file(building *b, const char *word, tn_error *error)
{
    char name[40];
    tn_making making;
    tn_house_file kind;
    tn_made_file *file = TN_ADD(made_file, b->built->files, error);
    if (!file)
        return TN_MEMORY;
    tn_status status = kind_of(word, &kind, error);
    snprintf(name, sizeof name, "house.%s", word);
    if (status == TN_OK)
        status = tn_making_begin(&making, b->session, tn_house_file_format(kind),
                                 b->request->files.count > 1 ? name : NULL, file, error);
    if (status == TN_OK)
        status = tn_making_end(&making, tn_house_file_write(&b->filed, kind, making.stream, error), error);
    return status;
}

static tn_house_filed filed_of(const building *b)
{
    const tn_house_request *request = b->request;
    return (tn_house_filed){.title = request->title                       ? request->title
                                     : tn_is_house_number(request->house) ? request->house
                                                                          : NULL,
                            .views = {.items = request->views.items,
                                      .count = request->views.count,
                                      .cut = request->cut,
                                      .bare = request->bare,
                                      .azimuth = request->has_azimuth ? &request->azimuth : NULL,
                                      .elevation = request->has_elevation ? &request->elevation : NULL},
                            .scale = (uint32_t)request->scale,
                            .dpi = (uint32_t)request->dpi,
                            .watch = b->session->opened->module->watch};
}

static tn_status set_line(const tn_house *house, tn_built_house *built, tn_error *error)
{
    tn_buffer line = {0};
    tn_status status = tn_house_write(house, &line, error);
    built->house = line.data;
    return status == TN_OK && line.failed ? tn_fail_memory(error) : status;
}

static tn_status write_all(void *context, const tn_house *house, tn_error *error)
{
    building *b = context;
    tn_solids solids = {0};
    tn_status status = set_line(house, b->built, error);
    if (status == TN_OK && b->request->files.count)
        status = tn_house_solids(house, &solids, error);
    b->filed = filed_of(b);
    b->filed.house = house;
    b->filed.solids = &solids;
    for (size_t i = 0; status == TN_OK && i < b->request->files.count; i++)
        status = write_file(b, b->request->files.items[i], error);
    tn_solids_clear(&solids);
    return status;
}

/* ---- which house */

/* The form that is meant: the named one, or the only one of the file itself, or the only one there is. */
static tn_status choose_form(tn_session *session, const char *wanted, uint32_t *index)
{
    const tn_module *module = session->opened->module;
    uint32_t own = 0;
    for (uint32_t i = 0; i < module->FORM_count; i++) {
        bool imported = module->FORM_records[i].flags & TN_IMPORTED;
        if (wanted ? strcmp(tn_text(module, module->FORM_records[i].name), wanted) != 0
                   : imported && module->FORM_count > 1)
            continue;
        own++;
        *index = i;
    }
    if (own == 1)
        return TN_OK;
    if (wanted)
        return tn_session_refuse(session, "a form is declared by `form NAME of SCHEMA { ... }`",
                                 "there is no form `%s` in the file", wanted);
    return module->FORM_count ? tn_session_refuse(session, "say which: --form NAME", "the file has several forms")
                              : tn_session_refuse(session, "a form is declared by `form NAME of SCHEMA { ... }`",
                                                  "the file has no form");
}

static tn_status read_house(building *b, const tn_house_form *form, size_t max_length)
{
    const char *line = b->request->house;
    tn_house house;
    tn_error error = {0};
    tn_status status = tn_house_read(form, line, strlen(line), max_length, &house, &error);
    if (status != TN_OK)
        status = tn_session_bad_text(b->session, &error, "HOUSE", line);
    else if (write_all(b, &house, &error) != TN_OK)
        status = tn_session_fail(b->session, &error);
    tn_house_clear(&house);
    return status;
}

static tn_status read_line(building *b, size_t max_length)
{
    const tn_module *module = b->session->opened->module;
    uint32_t index = 0;
    tn_schema *schema;
    tn_house_form form;
    tn_error error;
    tn_status status = choose_form(b->session, b->request->form, &index);
    if (status != TN_OK)
        return status;
    if (tn_schema_new(module, module->FORM_records[index].schema, 0, &schema, &error) != TN_OK)
        return tn_session_fail(b->session, &error);
    tn_form_ready(module, index, schema, &form);
    status = read_house(b, &form, max_length);
    tn_schema_free(schema);
    return status;
}

tn_status tn_ask_house(tn_session *session, const tn_house_request *request, tn_reply *answer)
{
    size_t max_length = request->has_max_length ? (size_t)request->max_length : TN_HOUSE_TRAYS_DEFAULT;
    const tn_house_settings houses = {
        .library = request->library,
        .max_length = max_length,
        .plans = {.max_states = (uint32_t)request->max_states, .max_length = (uint32_t)max_length}};
    tn_error error;
    *answer = (tn_reply){0};
    tn_status status = check_files(session, request);
    if (status != TN_OK)
        return status;
    if (tn_reply_new(&tn_message_built_house, answer, &error) != TN_OK)
        return tn_session_fail(session, &error);
    building b = {.session = session, .request = request, .built = answer->value};
    return tn_is_house_number(request->house) ? tn_session_house(session, &houses, request->house, write_all, &b)
                                              : read_line(&b, max_length);
}
