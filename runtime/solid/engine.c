/* Says what of a module belongs to solids, and what its expressions speak of. */
#include "runtime/module/engine.h"
#include "runtime/module/verify.h"

#include <math.h>

#include "runtime/solid/measured.h"

const char *const tn_solid_measured_names[TN_SOLID_MEASURED_COUNT] = {
#define X(NAME, NUMBER, WORD, NEEDS) [NUMBER] = (WORD),
    TN_SOLID_MEASURES(X)
#undef X
};

static tn_status check_function(const tn_checker *checker, const char *section, uint32_t index, uint32_t function)
{
    if (checker->module->FUNCTION_records[function].kind == TN_FUNCTION_SOLID_MEASURE)
        return TN_OK;
    return tn_refuse(checker, "%s %u: function %u measures no solid", section, index, function);
}

/* Faces in order, and a normal of unit length where there is a plane. */
static tn_status check_box(const tn_checker *checker, uint32_t index)
{
    const tn_box_record *b = &checker->module->BOX_records[index];
    double length = b->normal_x * b->normal_x + b->normal_y * b->normal_y + b->normal_z * b->normal_z;
    if (b->low_x > b->high_x || b->low_y > b->high_y || b->low_z > b->high_z)
        return tn_refuse(checker, "box %u: a low face lies beyond its high face", index);
    if ((b->flags & TN_BOX_CLIPPED) && !(fabs(length - 1) < 1e-9))
        return tn_refuse(checker, "box %u: the normal of its plane has not the length 1", index);
    return TN_OK;
}

static tn_status verify(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < module->SOLID_count && status == TN_OK; i++)
        if ((module->SOLID_records[i].flags & TN_SOLID_FLAT) && (module->SOLID_records[i].flags & TN_SOLID_SYMMETRY_Z))
            status = tn_refuse(checker, "solid %u is flat and symmetric in z", i);
    for (uint32_t i = 0; i < module->BOX_count && status == TN_OK; i++)
        status = check_box(checker, i);
    for (uint32_t i = 0; i < module->SOLID_MEASURE_count && status == TN_OK; i++)
        status = check_function(checker, "solid measure", i, module->SOLID_MEASURE_records[i].function);
    for (uint32_t i = 0; i < module->SOLID_GOAL_count && status == TN_OK; i++)
        status = check_function(checker, "solid goal", i, module->SOLID_GOAL_records[i].function);
    for (uint32_t i = 0; i < module->REQUIREMENT_count && status == TN_OK; i++) {
        status = check_function(checker, "requirement", i, module->REQUIREMENT_records[i].holds);
        if (status == TN_OK)
            status = check_function(checker, "requirement", i, module->REQUIREMENT_records[i].violation);
    }
    return status;
}

static const tn_section sections[] = {TN_SECTION_SOLID,       TN_SECTION_BOX,        TN_SECTION_SOLID_MEASURE,
                                      TN_SECTION_REQUIREMENT, TN_SECTION_SOLID_GOAL, TN_SECTION_STRINGS};

extern const tn_engine tn_engine_solid;
const tn_engine tn_engine_solid = {.name = "solid",
                                   .sections = sections,
                                   .terms = tn_solid_measured_names,
                                   .term_count = TN_SOLID_MEASURED_COUNT,
                                   .term_kind = TN_FUNCTION_SOLID_MEASURE,
                                   .verify = verify};
