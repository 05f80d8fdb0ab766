/* The C interface: modules are loaded and asked what they hold. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/runtime/api.h"
#include "runtime/base/file.h"
#include "runtime/base/nearest.h"
#include "runtime/load.h"

_Static_assert((int)TARTAN_OK == (int)TN_OK && (int)TARTAN_INTERNAL == (int)TN_INTERNAL,
               "statuses are the same numbers");
_Static_assert(sizeof((tartan_error *)0)->message == sizeof((tn_error *)0)->message, "messages fit");
_Static_assert(sizeof((tartan_error *)0)->help == sizeof((tn_error *)0)->help, "help fits");

const char *tartan_version(void)
{
    return TARTAN_VERSION;
}

tartan_status tn_api_fail(const tn_error *found, tartan_error *error)
{
    if (error) {
        *error = (tartan_error){.status = (tartan_status)found->status, .code = found->code, .column = found->column};
        memcpy(error->message, found->message, sizeof error->message);
        memcpy(error->help, found->help, sizeof error->help);
    }
    return (tartan_status)found->status;
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

tartan_status tn_api_unknown(tartan_error *error, const char *what, const char *name, const char **names, size_t count)
{
    const char *near = names ? tn_nearest(name, names, count) : NULL;
    tn_api_refuse(error, TARTAN_INVALID, "the module has no %s `%.200s`", what, name);
    if (near && error)
        snprintf(error->help, sizeof error->help, "did you mean `%.200s`?", near);
    free(names);
    return TARTAN_INVALID;
}

tartan_status tn_api_module(tn_module *loaded, uint8_t *bytes, size_t size, tartan_module **module, tartan_error *error)
{
    tartan_module *made = malloc(sizeof *made);
    if (!made) {
        tn_error found;
        tn_module_free(loaded);
        free(bytes);
        tn_fail_memory(&found);
        return tn_api_fail(&found, error);
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
    uint8_t *copy = malloc(size ? size : 1);
    if (!copy) {
        tn_error found;
        tn_fail_memory(&found);
        return tn_api_fail(&found, error);
    }
    if (size)
        memcpy(copy, bytes, size);
    return load(copy, size, module, error);
}

tartan_status tartan_module_load_file(const char *path, tartan_module **module, tartan_error *error)
{
    uint8_t *bytes;
    size_t size;
    tn_error found;
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
