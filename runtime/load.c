/* Knows all engines, and has modules loaded and listed with them. */
#include "runtime/load.h"

#include "runtime/module/engine.h"
#include "runtime/module/lister.h"
#include "runtime/module/read.h"

#define ENGINE(NAME, FUZZ) extern const tn_engine tn_engine_##NAME;
#include "runtime/engines.def"

static const tn_engine *const items[] = {
#define ENGINE(NAME, FUZZ) &tn_engine_##NAME,
#include "runtime/engines.def"
};

static const tn_engines engines = {items, sizeof items / sizeof *items};

const tn_engines *tn_engines_all(void)
{
    return &engines;
}

tn_status tn_module_load(const void *bytes, size_t size, const tn_module_limits *limits, tn_module **module,
                         tn_error *error)
{
    return tn_module_read(bytes, size, &engines, limits, module, error);
}

bool tn_module_disassemble(const tn_module *module, FILE *out)
{
    return tn_module_list(module, &engines, out);
}

bool tn_module_disassemble_rule(const tn_module *module, uint32_t rule, FILE *out)
{
    return tn_module_list_record(module, &engines, TN_SECTION_RULE, rule, out);
}
