/* The C interface's modules: loading them, and what they hold. */
#include <stdlib.h>
#include <string.h>

#include "api/base/api.h"
#include "runtime/base/file.h"
#include "runtime/load.h"

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
