/* Says what of a module belongs to fields, and verifies it. */
#include "runtime/module/engine.h"

static const tn_section sections[] = {TN_SECTION_SURFACE, TN_SECTION_DISTANCE_MESH, TN_SECTION_STRINGS};

static tn_status verify(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    for (size_t i = 0; i < module->SURFACE_count; i++) {
        const tn_surface_record *r = &module->SURFACE_records[i];
        if (module->FUNCTION_records[r->function].kind != TN_FUNCTION_FIELD)
            return tn_refuse(checker, "the function of surface %zu is not a field", i);
        if (!(r->low_x < r->high_x && r->low_y < r->high_y && r->low_z < r->high_z))
            return tn_refuse(checker, "the box of surface %zu has no inside", i);
    }
    return TN_OK;
}

extern const tn_engine tn_engine_field;
const tn_engine tn_engine_field = {.name = "field", .sections = sections, .verify = verify};
