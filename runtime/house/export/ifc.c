/* Writes a house as IFC4 (ISO 16739-1): the project, its storeys, and in these rooms and parts of the building. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "runtime/house/export/ifc.h"
#include "runtime/math/elementary.h"

static void ifc_clear(tn_ifc *ifc)
{
    tn_ifc_clear_groups(ifc);
    tn_stepfile_clear(&ifc->step);
    tn_designations_clear(&ifc->names);
    tn_flights_clear(&ifc->flights);
    tn_swings_clear(&ifc->doors);
    free(ifc->walls);
    free(ifc->joined);
    free(ifc->spaces);
    free(ifc->materials);
    free(ifc->styles);
}

/* ---- what all instances refer to */

static unsigned put_direction(tn_stepfile *step, const char *ratios)
{
    return tn_stepfile_add(step, "IFCDIRECTION((%s))", ratios);
}

static unsigned put_context(tn_stepfile *step, const char *name, unsigned whole, const char *view)
{
    return tn_stepfile_add(step, "IFCGEOMETRICREPRESENTATIONSUBCONTEXT('%s','Model',*,*,*,*,#%u,$,.%s.,$)", name, whole,
                           view);
}

/* Axes, and the contexts of shapes. Returns the whole one. north: as in tn_ifc_said. */
static unsigned put_contexts(tn_stepfile *step, const double *north)
{
    char true_north[16] = "$";
    step->origin = tn_stepfile_add(step, "IFCCARTESIANPOINT((0.,0.,0.))");
    step->z = put_direction(step, "0.,0.,1.");
    step->down = put_direction(step, "0.,0.,-1.");
    step->along[0] = put_direction(step, "1.,0.,0.");
    step->along[1] = put_direction(step, "0.,1.,0.");
    step->along[2] = put_direction(step, "-1.,0.,0.");
    step->along[3] = put_direction(step, "0.,-1.,0.");
    step->axes = tn_stepfile_add(step, "IFCAXIS2PLACEMENT3D(#%u,#%u,#%u)", step->origin, step->z, step->along[0]);
    if (north) {
        double angle = *north / 360 * 6.283185307179586;
        unsigned way = tn_stepfile_add(step, "IFCDIRECTION((%s,%s))", tn_stepfile_real(-tn_sin(angle), 12).text,
                                       tn_stepfile_real(-tn_cos(angle), 12).text);
        snprintf(true_north, sizeof true_north, "#%u", way);
    }
    unsigned whole =
        tn_stepfile_add(step, "IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-6,#%u,%s)", step->axes, true_north);
    step->context = put_context(step, "Body", whole, "MODEL_VIEW");
    step->axes_context = put_context(step, "Axis", whole, "GRAPH_VIEW");
    step->plan_context = put_context(step, "FootPrint", whole, "PLAN_VIEW");
    return whole;
}

/* A unit by how many of another it is. */
static unsigned put_converted(tn_stepfile *step, const char *name, const char *kind, int power, const char *measure,
                              const char *size, unsigned of)
{
    unsigned dimensions = tn_stepfile_add(step, "IFCDIMENSIONALEXPONENTS(%d,0,0,0,0,0,0)", power);
    unsigned factor = tn_stepfile_add(step, "IFCMEASUREWITHUNIT(%s(%s),#%u)", measure, size, of);
    return tn_stepfile_add(step, "IFCCONVERSIONBASEDUNIT(#%u,.%s.,'%s',#%u)", dimensions, kind, name, factor);
}

/* Millimetres, or feet. Returns the assignment. */
static unsigned put_units(tn_stepfile *step)
{
    unsigned length = tn_stepfile_add(step, "IFCSIUNIT(*,.LENGTHUNIT.,%s,.METRE.)", step->feet ? "$" : ".MILLI.");
    unsigned area = tn_stepfile_add(step, "IFCSIUNIT(*,.AREAUNIT.,$,.SQUARE_METRE.)");
    unsigned volume = tn_stepfile_add(step, "IFCSIUNIT(*,.VOLUMEUNIT.,$,.CUBIC_METRE.)");
    unsigned angle = tn_stepfile_add(step, "IFCSIUNIT(*,.PLANEANGLEUNIT.,$,.RADIAN.)");
    if (step->feet) {
        length = put_converted(step, "foot", "LENGTHUNIT", 1, "IFCLENGTHMEASURE", "0.3048", length);
        area = put_converted(step, "square foot", "AREAUNIT", 2, "IFCAREAMEASURE", "0.09290304", area);
        volume = put_converted(step, "cubic foot", "VOLUMEUNIT", 3, "IFCVOLUMEMEASURE", "0.028316846592", volume);
    }
    return tn_stepfile_add(step, "IFCUNITASSIGNMENT((#%u,#%u,#%u,#%u))", length, area, volume, angle);
}

/* ---- storeys */

static void aggregate(tn_stepfile *step, unsigned whole, const char *parts, const char *key)
{
    tn_stepfile_add(step, "IFCRELAGGREGATES('%s',$,$,$,#%u,%s)", tn_stepfile_guid(step, "parts of %s", key).text, whole,
                    parts);
}

static void aggregate_one(tn_stepfile *step, unsigned whole, unsigned part, const char *key)
{
    char list[16];
    snprintf(list, sizeof list, "(#%u)", part);
    aggregate(step, whole, list, key);
}

/* The storey at hand as IFC has it, without its parts. */
static unsigned put_level(tn_ifc *ifc, const char *name)
{
    const tn_house_form *form = ifc->house->form;
    tn_stepfile *step = &ifc->step;
    const char *doc = tn_text(form->module, form->module->STOREY_records[form->record->storey_first + ifc->storey].doc);
    return tn_stepfile_add(step, "IFCBUILDINGSTOREY('%s',$,'%s',$,$,#%u,$,'%s',.ELEMENT.,%s)",
                           tn_stepfile_guid(step, "storey %s", name).text, tn_stepfile_text(name).text, ifc->placement,
                           tn_stepfile_text(doc[0] ? doc : name).text,
                           tn_stepfile_length(step, (double)form->level[ifc->storey]).text);
}

/* A storey with its rooms and parts; *made: itself. */
static tn_status put_storey(tn_ifc *ifc, uint32_t storey, unsigned building, unsigned *made, tn_error *error)
{
    tn_stepfile *step = &ifc->step;
    const tn_house_form *form = ifc->house->form;
    const char *name = tn_text(form->module, form->module->STOREY_records[form->record->storey_first + storey].name);
    tn_stepfile_list spaces = {0}, parts = {0};
    char key[TN_NAME_MAX + 20];
    ifc->storey = storey;
    ifc->placement = tn_stepfile_placement(step, building, 0, 0, (double)form->level[storey]);
    *made = put_level(ifc, name);
    tn_ifc_put_spaces(ifc, &spaces);
    tn_status status = tn_ifc_put_walls(ifc, &parts, error);
    if (status == TN_OK) {
        tn_ifc_put_parts(ifc, &parts);
        tn_ifc_put_gables(ifc, &parts);
        tn_ifc_put_roof(ifc, &parts);
        tn_ifc_put_stairs(ifc, &parts);
    }
    snprintf(key, sizeof key, "storey %s", name);
    const char *list = tn_stepfile_list_text(&spaces);
    if (list)
        aggregate(step, *made, list, key);
    list = tn_stepfile_list_text(&parts);
    if (list)
        tn_stepfile_add(step, "IFCRELCONTAINEDINSPATIALSTRUCTURE('%s',$,$,$,%s,#%u)",
                        tn_stepfile_guid(step, "inside %s", key).text, list, *made);
    ifc->failed |= spaces.text.failed || parts.text.failed;
    tn_stepfile_list_clear(&spaces);
    tn_stepfile_list_clear(&parts);
    return status;
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
        aggregate(&ifc->step, building, list, "building");
    ifc->failed |= storeys.text.failed;
    tn_stepfile_list_clear(&storeys);
    return status;
}

/* ---- the project, its site and building */

/* A latitude or longitude in degrees, minutes, seconds and millionths of these. */
static void write_angle(const double *degrees, char *text, size_t size)
{
    if (!degrees) {
        snprintf(text, size, "$");
        return;
    }
    long long left = llround(*degrees * 3600e6), millionth = 1000000;
    snprintf(text, size, "(%lld,%lld,%lld,%lld)", left / (3600 * millionth), left / (60 * millionth) % 60,
             left / millionth % 60, left % millionth);
}

static unsigned put_project(tn_ifc *ifc, const tn_ifc_said *said, const char *line)
{
    tn_stepfile *step = &ifc->step;
    unsigned context = put_contexts(step, said->north), units = put_units(step);
    tn_buffer text = {0};
    ifc->failed |= !tn_stepfile_put_text(&text, line);
    unsigned project =
        tn_stepfile_add(step, "IFCPROJECT('%s',$,'%s','%s',$,$,$,(#%u),#%u)", tn_stepfile_guid(step, "project").text,
                        tn_stepfile_text(said->project).text, text.data ? text.data : "", context, units);
    free(text.data);
    return project;
}

static tn_status put_all(tn_ifc *ifc, const tn_ifc_said *said, const char *line, tn_error *error)
{
    tn_stepfile *step = &ifc->step;
    char latitude[60], longitude[60];
    unsigned project = put_project(ifc, said, line), ground = tn_stepfile_placement(step, 0, 0, 0, 0);
    write_angle(said->latitude, latitude, sizeof latitude);
    write_angle(said->longitude, longitude, sizeof longitude);
    unsigned site = tn_stepfile_add(step, "IFCSITE('%s',$,'site',$,$,#%u,$,$,.ELEMENT.,%s,%s,$,$,$)",
                                    tn_stepfile_guid(step, "site").text, ground, latitude, longitude);
    unsigned place = tn_stepfile_placement(step, ground, 0, 0, 0);
    unsigned building =
        tn_stepfile_add(step, "IFCBUILDING('%s',$,'%s',$,$,#%u,$,$,.ELEMENT.,$,$,$)",
                        tn_stepfile_guid(step, "building").text, tn_stepfile_text(said->name).text, place);
    aggregate_one(step, project, site, "project");
    aggregate_one(step, site, building, "site");
    tn_status status = put_storeys(ifc, building, place, error);
    if (status == TN_OK) {
        tn_ifc_put_boundaries(ifc);
        tn_ifc_put_groups(ifc);
    }
    return status == TN_OK && (ifc->failed || step->text.failed) ? tn_fail_memory(error) : status;
}

/* ---- the file */

static void write_file(const tn_stepfile *step, const tn_ifc_said *said, FILE *out)
{
    fprintf(out,
            "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('ViewDefinition [DesignTransferView_V1.0]'),'2;1');\n"
            "FILE_NAME('%s','%s',('%s'),(''),'tartan','tartan','');\nFILE_SCHEMA(('IFC4'));\nENDSEC;\n"
            "DATA;\n",
            tn_stepfile_text(said->name).text, said->date ? said->date : "1970-01-01T00:00:00",
            tn_stepfile_text(said->author ? said->author : "").text);
    fwrite(step->text.data, 1, step->text.size, out);
    fputs("ENDSEC;\nEND-ISO-10303-21;\n", out);
}

static tn_status make_ready(tn_ifc *ifc, const tn_ifc_said *said, tn_error *error)
{
    const tn_house *house = ifc->house;
    size_t materials = (size_t)TN_SOLID_COUNT + house->form->record->material_count;
    ifc->step.feet = tn_house_length_style(house) == TN_STYLE_FEET;
    ifc->step.seed = XXH3_64bits(said->seed, strlen(said->seed));
    tn_house_mesh_colours(house->form, ifc->colours);
    ifc->walls = calloc(house->face_count + 1, sizeof *ifc->walls);
    ifc->joined = calloc(ifc->solids->box_count + 1, sizeof *ifc->joined);
    ifc->spaces = calloc(house->cell_count + 1, sizeof *ifc->spaces);
    ifc->styles = calloc(2 * materials, sizeof *ifc->styles);
    ifc->materials = calloc(materials + house->form->record->layer_count, sizeof *ifc->materials);
    if (!ifc->walls || !ifc->joined || !ifc->spaces || !ifc->styles || !ifc->materials)
        return tn_fail_memory(error);
    tn_status status = tn_designations_find(house, ifc->step.feet, &ifc->names, error);
    return status == TN_OK ? tn_flights_stand(house, &ifc->flights, error) : status;
}

tn_status tn_house_write_ifc(const tn_house *house, const tn_solids *solids, const tn_ifc_said *said, FILE *out,
                             tn_error *error)
{
    tn_ifc ifc = {.house = house, .solids = solids};
    tn_buffer line = {0};
    tn_status status = make_ready(&ifc, said, error);
    if (status == TN_OK)
        status = tn_house_write(house, &line, error);
    if (status == TN_OK)
        status = put_all(&ifc, said, line.data, error);
    if (status == TN_OK)
        write_file(&ifc.step, said, out);
    ifc_clear(&ifc);
    free(line.data);
    return status;
}
