/* What the C interface is made of: modules behind their opaque name, errors turned into its own, structs with a size,
 * progress. */
#include "api/base/api.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/file.h"
#include "runtime/base/nearest.h"
#include "runtime/load.h"

/* ---- modules */

tartan_status tn_api_module(tn_module *loaded, uint8_t *bytes, size_t size, tartan_module **module, tartan_error *error)
{
    tartan_module *made = malloc(sizeof *made);
    if (!made) {
        tn_module_free(loaded);
        free(bytes);
        return tn_api_memory(error);
    }
    *made = (tartan_module){loaded, bytes, size};
    *module = made;
    return TARTAN_OK;
}

/* Takes over `bytes` in any case. */
static tartan_status load(uint8_t *bytes, size_t size, tartan_module **module, tartan_error *error)
{
    tn_error found;
    tn_module *loaded;
    if (tn_module_load(bytes, size, NULL, &loaded, &found) == TN_OK)
        return tn_api_module(loaded, bytes, size, module, error);
    free(bytes);
    return tn_api_fail(&found, error);
}

tartan_status tartan_module_load(const void *bytes, size_t size, tartan_module **module, tartan_error *error)
{
    if (!bytes && size)
        return tn_api_missing(error, "module's bytes");
    uint8_t *copy = malloc(size ? size : 1);
    if (!copy)
        return tn_api_memory(error);
    if (size)
        memcpy(copy, bytes, size);
    return load(copy, size, module, error);
}

tartan_status tartan_module_load_file(const char *path, tartan_module **module, tartan_error *error)
{
    uint8_t *bytes;
    size_t size;
    tn_error found;
    if (!path)
        return tn_api_missing(error, "path");
    if (tn_file_read(path, tn_module_limits_default().bytes, &bytes, &size, &found) != TN_OK)
        return tn_api_fail(&found, error);
    return load(bytes, size, module, error);
}

void tartan_module_free(tartan_module *module)
{
    if (!module)
        return;
    tn_module_free(module->module);
    free(module->bytes);
    free(module);
}

const void *tartan_module_bytes(const tartan_module *module, size_t *size)
{
    *size = module->size;
    return module->bytes;
}

size_t tartan_module_rule_count(const tartan_module *module)
{
    return module->module->RULE_count;
}

const char *tartan_module_rule_name(const tartan_module *module, size_t i)
{
    const tn_module *m = module->module;
    return i < m->RULE_count ? tn_text(m, m->RULE_records[i].name) : NULL;
}

const char *tartan_module_rule_doc(const tartan_module *module, size_t i)
{
    const tn_module *m = module->module;
    return i < m->RULE_count ? tn_text(m, m->RULE_records[i].doc) : NULL;
}

size_t tartan_module_library_count(const tartan_module *module)
{
    return module->module->LIBRARY_count;
}

const char *tartan_module_library_name(const tartan_module *module, size_t i)
{
    const tn_module *m = module->module;
    return i < m->LIBRARY_count ? tn_text(m, m->LIBRARY_records[i].name) : NULL;
}

const char *tartan_module_library_doc(const tartan_module *module, size_t i)
{
    const tn_module *m = module->module;
    return i < m->LIBRARY_count ? tn_text(m, m->LIBRARY_records[i].doc) : NULL;
}

size_t tartan_module_house_library_count(const tartan_module *module)
{
    return module->module->HOUSE_LIBRARY_count;
}

const char *tartan_module_house_library_name(const tartan_module *module, size_t i)
{
    const tn_module *m = module->module;
    return i < m->HOUSE_LIBRARY_count ? tn_text(m, m->HOUSE_LIBRARY_records[i].name) : NULL;
}

const char *tartan_module_house_library_doc(const tartan_module *module, size_t i)
{
    const tn_module *m = module->module;
    return i < m->HOUSE_LIBRARY_count ? tn_text(m, m->HOUSE_LIBRARY_records[i].doc) : NULL;
}

size_t tartan_module_surface_count(const tartan_module *module)
{
    return module->module->SURFACE_count;
}

const char *tartan_module_surface_name(const tartan_module *module, size_t i)
{
    const tn_module *m = module->module;
    return i < m->SURFACE_count ? tn_text(m, m->SURFACE_records[i].name) : NULL;
}

bool tartan_module_has_growth(const tartan_module *module)
{
    return module->module->GROWTH_count > 0;
}

bool tartan_module_has_grammar(const tartan_module *module)
{
    return tn_module_has_grammar(module->module);
}

bool tartan_module_has_places(const tartan_module *module)
{
    return module->module->GRAMMAR_count > 0 && !tn_module_has_grammar(module->module);
}

bool tartan_module_has_study(const tartan_module *module)
{
    return module->module->SETTING_count > 0;
}

/* ---- errors, structs with a size, progress */

_Static_assert((int)TARTAN_OK == (int)TN_OK && (int)TARTAN_STOPPED == (int)TN_STOPPED, "statuses are the same numbers");
_Static_assert(sizeof((tartan_error *)0)->message == sizeof((tn_error *)0)->message, "messages fit");
_Static_assert(sizeof((tartan_error *)0)->help == sizeof((tn_error *)0)->help, "help fits");

const char *tartan_version(void)
{
    return TARTAN_VERSION;
}

tartan_status tn_api_fail(const tn_error *found, tartan_error *error)
{
    bool full = found->status == TN_STOPPED && found->code == E_MEMORY_LIMIT; /* nobody asked for the end */
    tartan_status status = full ? TARTAN_LIMIT : (tartan_status)found->status;
    if (error) {
        *error = (tartan_error){.status = status, .code = found->code, .column = found->column};
        memcpy(error->message, found->message, sizeof error->message);
        memcpy(error->help, found->help, sizeof error->help);
    }
    return status;
}

tartan_status tn_api_refuse(tartan_error *error, tartan_status status, const char *format, ...)
{
    if (!error)
        return status;
    *error = (tartan_error){.status = status};
    va_list args;
    va_start(args, format);
    vsnprintf(error->message, sizeof error->message, format, args);
    va_end(args);
    return status;
}

tartan_status tn_api_memory(tartan_error *error)
{
    tn_error found;
    tn_fail_memory(&found);
    return tn_api_fail(&found, error);
}

tartan_status tn_api_missing(tartan_error *error, const char *what)
{
    return tn_api_refuse(error, TARTAN_INVALID, "the %s is NULL", what);
}

tartan_status tn_api_unknown(tartan_error *error, const char *what, const char *name, const char **names, size_t count)
{
    const char *near = names ? tn_nearest(name, names, count) : NULL;
    tn_api_refuse(error, TARTAN_INVALID, "the module has no %s `%.200s`", what, name);
    if (near && error)
        snprintf(error->help, sizeof error->help, "did you mean `%.200s`?", near);
    free(names);
    return TARTAN_INVALID;
}

/* ---- structs that callers own */

static size_t size_of(const void *sized)
{
    size_t size;
    memcpy(&size, sized, sizeof size);
    return size;
}

static tartan_status too_small(const char *what, tartan_error *error)
{
    tn_api_refuse(error, TARTAN_INVALID, "the size of %s is not set", what);
    if (error)
        snprintf(error->help, sizeof error->help, "begin with %s_init()", what);
    return TARTAN_INVALID;
}

tartan_status tn_api_take(void *own, size_t room, const void *given, const char *what, tartan_error *error)
{
    memset(own, 0, room);
    memcpy(own, &room, sizeof room);
    if (!given)
        return TARTAN_OK;
    size_t size = size_of(given);
    if (size < room)
        return too_small(what, error);
    for (size_t i = room; i < size; i++)
        if (((const unsigned char *)given)[i])
            return tn_api_refuse(error, TARTAN_INVALID,
                                 "this version of Tartan does not know a field of %s that is set", what);
    memcpy(own, given, room);
    return TARTAN_OK;
}

tartan_status tn_api_give(void *given, const void *own, size_t room, const char *what, tartan_error *error)
{
    if (!given)
        return tn_api_missing(error, what);
    size_t size = size_of(given);
    if (size < room)
        return too_small(what, error);
    memcpy(given, own, room);
    memcpy(given, &size, sizeof size);
    return TARTAN_OK;
}

tartan_status tn_api_watch(const tartan_watch *given, tn_watch *watch, tartan_error *error)
{
    tartan_watch own;
    tartan_status status = TN_API_TAKE(tartan_watch, &own, given, error);
    if (status == TARTAN_OK) {
        tn_watch_begin(watch, own.go_on, own.context);
        watch->memory_limit = own.memory_limit;
    }
    return status;
}

/* ---- memory */

void tartan_text_free(char *text)
{
    free(text);
}

void tartan_bytes_free(void *bytes)
{
    free(bytes);
}
