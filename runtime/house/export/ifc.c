/* Writes a house as IFC4 (ISO 16739-1): the project, its storeys, and in these rooms and parts of the building. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "runtime/house/export/export.h"
#include "runtime/house/export/ifc_parts.h"

static const char *storey_name(const tn_house *house, uint32_t storey)
{
    const tn_house_form *form = house->form;
    return tn_text(form->module, form->module->STOREY_records[form->record->storey_first + storey].name);
}

/* What all instances refer to: axes, units and the context of shapes. Returns the assignment of units. */
static unsigned put_basis(tn_stepfile *step)
{
    step->origin = tn_stepfile_add(step, "IFCCARTESIANPOINT((0.,0.,0.))");
    step->z = tn_stepfile_add(step, "IFCDIRECTION((0.,0.,1.))");
    step->x = tn_stepfile_add(step, "IFCDIRECTION((1.,0.,0.))");
    step->axes = tn_stepfile_add(step, "IFCAXIS2PLACEMENT3D(#%u,#%u,#%u)", step->origin, step->z, step->x);
    unsigned whole = tn_stepfile_add(step, "IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-6,#%u,$)", step->axes);
    step->context = tn_stepfile_add(
        step, "IFCGEOMETRICREPRESENTATIONSUBCONTEXT('Body','Model',*,*,*,*,#%u,$,.MODEL_VIEW.,$)", whole);
    unsigned length = tn_stepfile_add(step, "IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.)");
    unsigned area = tn_stepfile_add(step, "IFCSIUNIT(*,.AREAUNIT.,$,.SQUARE_METRE.)");
    unsigned volume = tn_stepfile_add(step, "IFCSIUNIT(*,.VOLUMEUNIT.,$,.CUBIC_METRE.)");
    unsigned angle = tn_stepfile_add(step, "IFCSIUNIT(*,.PLANEANGLEUNIT.,$,.RADIAN.)");
    return tn_stepfile_add(step, "IFCUNITASSIGNMENT((#%u,#%u,#%u,#%u))", length, area, volume, angle);
}

static void aggregate(tn_stepfile *step, unsigned whole, const char *parts, const char *kind, unsigned number)
{
    tn_stepfile_add(step, "IFCRELAGGREGATES('%s',$,$,$,#%u,%s)", tn_stepfile_guid(step, kind, number).text, whole,
                    parts);
}

static void aggregate_one(tn_stepfile *step, unsigned whole, unsigned part, const char *kind)
{
    char list[16];
    snprintf(list, sizeof list, "(#%u)", part);
    aggregate(step, whole, list, kind, 0);
}

/* How the doors of the storey at hand hang. */
static tn_status hang_doors(tn_ifc *ifc, tn_error *error)
{
    tn_taken taken = {0};
    tn_status status = tn_taken_find(ifc->house, ifc->storey, &taken, error);
    tn_swings_clear(&ifc->doors);
    if (status == TN_OK)
        status = tn_swings_find(ifc->house, ifc->storey, &taken, &ifc->doors, error);
    tn_taken_clear(&taken);
    return status;
}

/* A storey with its rooms and parts; *made: itself. */
static tn_status put_storey(tn_ifc *ifc, uint32_t storey, unsigned building, unsigned *made, tn_error *error)
{
    tn_stepfile *step = &ifc->step;
    double level = (double)ifc->house->form->level[storey];
    ifc->placement = tn_stepfile_placement(step, building, 0, 0, level);
    ifc->storey = storey;
    tn_status status = hang_doors(ifc, error);
    if (status != TN_OK)
        return status;
    unsigned self = tn_stepfile_add(
        step, "IFCBUILDINGSTOREY('%s',$,'%s',$,$,#%u,$,$,.ELEMENT.,%s)", tn_stepfile_guid(step, "storey", storey).text,
        tn_stepfile_text(storey_name(ifc->house, storey)).text, ifc->placement, tn_stepfile_mm(level).text);
    tn_stepfile_list spaces = {0}, parts = {0};
    tn_ifc_spaces(ifc, &spaces);
    tn_ifc_elements(ifc, &parts);
    const char *list = tn_stepfile_list_text(&spaces);
    if (list)
        aggregate(step, self, list, "rooms", storey);
    list = tn_stepfile_list_text(&parts);
    if (list)
        tn_stepfile_add(step, "IFCRELCONTAINEDINSPATIALSTRUCTURE('%s',$,$,$,%s,#%u)",
                        tn_stepfile_guid(step, "parts", storey).text, list, self);
    ifc->failed |= spaces.text.failed || parts.text.failed;
    tn_stepfile_list_clear(&spaces);
    tn_stepfile_list_clear(&parts);
    *made = self;
    return TN_OK;
}

static tn_status put_storeys(tn_ifc *ifc, unsigned building, unsigned place, tn_error *error)
{
    tn_stepfile_list storeys = {0};
    tn_status status = TN_OK;
    for (uint32_t k = 0; status == TN_OK && k < ifc->house->form->record->storey_count; k++) {
        unsigned storey = 0;
        if (!tn_house_has_storey(ifc->house, k))
            continue;
        status = put_storey(ifc, k, place, &storey, error);
        tn_stepfile_list_add(&storeys, storey);
    }
    const char *list = tn_stepfile_list_text(&storeys);
    if (list)
        aggregate(&ifc->step, building, list, "storeys of building", 0);
    ifc->failed |= storeys.text.failed;
    tn_stepfile_list_clear(&storeys);
    return status;
}

static tn_status put_project(tn_ifc *ifc, const char *name, const char *line, tn_error *error)
{
    tn_stepfile *step = &ifc->step;
    unsigned units = put_basis(step);
    tn_stepfile_name title = tn_stepfile_text(name);
    tn_buffer said = {0};
    ifc->failed |= !tn_stepfile_put_text(&said, line);
    unsigned context = step->context - 1;
    unsigned project =
        tn_stepfile_add(step, "IFCPROJECT('%s',$,'%s','%s',$,$,$,(#%u),#%u)", tn_stepfile_guid(step, "project", 0).text,
                        title.text, said.data ? said.data : "", context, units);
    free(said.data);
    unsigned ground = tn_stepfile_placement(step, 0, 0, 0, 0);
    unsigned site = tn_stepfile_add(step, "IFCSITE('%s',$,'site',$,$,#%u,$,$,.ELEMENT.,$,$,$,$,$)",
                                    tn_stepfile_guid(step, "site", 0).text, ground);
    unsigned place = tn_stepfile_placement(step, ground, 0, 0, 0);
    unsigned building = tn_stepfile_add(step, "IFCBUILDING('%s',$,'%s',$,$,#%u,$,$,.ELEMENT.,$,$,$)",
                                        tn_stepfile_guid(step, "building", 0).text, title.text, place);
    aggregate_one(step, project, site, "site of project");
    aggregate_one(step, site, building, "building of site");
    tn_status status = put_storeys(ifc, building, place, error);
    if (status == TN_OK)
        tn_ifc_materials(ifc);
    return status == TN_OK && (ifc->failed || step->text.failed) ? tn_fail_memory(error) : status;
}

static void write_file(const tn_stepfile *step, const char *name, FILE *out)
{
    fprintf(out,
            "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('ViewDefinition [ReferenceView_V1.2]'),'2;1');\n"
            "FILE_NAME('%s','1970-01-01T00:00:00',(''),(''),'tartan','tartan','');\nFILE_SCHEMA(('IFC4'));\nENDSEC;\n"
            "DATA;\n",
            tn_stepfile_text(name).text);
    fwrite(step->text.data, 1, step->text.size, out);
    fputs("ENDSEC;\nEND-ISO-10303-21;\n", out);
}

tn_status tn_house_write_ifc(const tn_house *house, const tn_solids *solids, const char *name, FILE *out,
                             tn_error *error)
{
    tn_ifc ifc = {.house = house, .solids = solids};
    tn_buffer line = {0};
    tn_status status = tn_house_rooms(house, &ifc.rooms, error);
    ifc.walls = calloc(house->face_count + 1, sizeof *ifc.walls);
    ifc.spaces = calloc(house->cell_count + 1, sizeof *ifc.spaces);
    ifc.made = calloc(TN_SOLID_COUNT + house->form->record->material_count, sizeof *ifc.made);
    if (status == TN_OK && (!ifc.walls || !ifc.spaces || !ifc.made))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_house_write(house, &line, error);
    if (status == TN_OK) {
        XXH128_hash_t hash = XXH3_128bits(line.data, line.size);
        snprintf(ifc.step.seed, sizeof ifc.step.seed, "%016" PRIx64 "%016" PRIx64, (uint64_t)hash.high64,
                 (uint64_t)hash.low64);
        status = put_project(&ifc, name, line.data, error);
    }
    if (status == TN_OK)
        write_file(&ifc.step, name, out);
    tn_ifc_clear(&ifc);
    free(line.data);
    return status;
}
