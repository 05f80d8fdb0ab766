/* What parts of a building model have in common: types, sets of properties and quantities, materials, looks. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "runtime/base/array.h"
#include "runtime/house/export/ifc.h"

enum { KEY_ROOM = 2000 };

/* ---- groups */

unsigned *tn_ifc_group_of(tn_ifc *ifc, tn_ifc_relation relation, const char *key, unsigned part)
{
    uint64_t hash = XXH3_64bits_withSeed(key, strlen(key), relation);
    size_t i = 0;
    while (i < ifc->group_count && (ifc->groups[i].key != hash || ifc->groups[i].relation != relation))
        i++;
    if (i == ifc->group_count) {
        if (!tn_array_reserve(&ifc->groups, &ifc->group_room, i, 1, sizeof *ifc->groups)) {
            ifc->failed = true;
            return &ifc->scrap;
        }
        ifc->groups[ifc->group_count++] =
            (tn_ifc_group){.relation = relation,
                           .key = hash,
                           .id = tn_stepfile_guid(&ifc->step, "relation %d %s", (int)relation, key)};
    }
    tn_stepfile_list_add(&ifc->groups[i].parts, part);
    return &ifc->groups[i].definition;
}

void tn_ifc_put_groups(tn_ifc *ifc)
{
    static const char *const relations[] = {[TN_IFC_SET] = "DEFINESBYPROPERTIES",
                                            [TN_IFC_TYPE] = "DEFINESBYTYPE",
                                            [TN_IFC_MATERIAL] = "ASSOCIATESMATERIAL",
                                            [TN_IFC_ZONE] = "ASSIGNSTOGROUP",
                                            [TN_IFC_CLASS] = "ASSOCIATESCLASSIFICATION"};
    for (size_t i = 0; i < ifc->group_count; i++) {
        tn_ifc_group *group = &ifc->groups[i];
        const char *parts = tn_stepfile_list_text(&group->parts);
        ifc->failed |= !parts;
        tn_stepfile_add(&ifc->step, "IFCREL%s('%s',$,$,$,%s,%s#%u)", relations[group->relation], group->id.text,
                        parts ? parts : "()", group->relation == TN_IFC_ZONE ? "$," : "", group->definition);
    }
}

void tn_ifc_clear_groups(tn_ifc *ifc)
{
    for (size_t i = 0; i < ifc->group_count; i++)
        tn_stepfile_list_clear(&ifc->groups[i].parts);
    free(ifc->groups);
}

/* ---- elements and their types */

unsigned tn_ifc_put(tn_ifc *ifc, const tn_ifc_part *part, const char *key)
{
    tn_stepfile *step = &ifc->step;
    const char *tail = part->type_tail ? part->type_tail : ",.NOTDEFINED.";
    char shape[16] = "$", type_key[KEY_ROOM], last[1300] = "$"; /* where spaces have a name, elements have a tag */
    if (part->shape)
        snprintf(shape, sizeof shape, "#%u", part->shape);
    if (part->long_name)
        snprintf(last, sizeof last, "'%s'", tn_stepfile_text(part->long_name).text);
    unsigned made =
        tn_stepfile_add(step, "%s('%s',$,'%s',$,$,#%u,%s,%s%s)", part->entity, tn_stepfile_guid(step, "%s", key).text,
                        tn_stepfile_text(part->name).text, part->where, shape, last, part->tail);
    snprintf(type_key, sizeof type_key, "%s %s %s", part->entity, part->type_name, tail);
    unsigned *type = tn_ifc_group_of(ifc, TN_IFC_TYPE, type_key, made);
    if (*type == 0)
        *type = tn_stepfile_add(step, "%sTYPE('%s',$,'%s',$,$,$,$,$,$%s)", part->entity,
                                tn_stepfile_guid(step, "type %s", type_key).text,
                                tn_stepfile_text(part->type_name).text, tail);
    return made;
}

/* ---- properties and quantities */

tn_ifc_property tn_ifc_truth(const char *name, bool value)
{
    tn_ifc_property property = {.name = name};
    snprintf(property.value, sizeof property.value, "IFCBOOLEAN(.%s.)", value ? "T" : "F");
    return property;
}

static void put_set(tn_ifc *ifc, const char *key, const char *name, const char *reference,
                    const tn_ifc_property *properties, size_t count, unsigned *definition)
{
    tn_stepfile *step = &ifc->step;
    tn_stepfile_list values = {0};
    tn_stepfile_list_add(&values, tn_stepfile_add(step, "IFCPROPERTYSINGLEVALUE('Reference',$,IFCIDENTIFIER('%s'),$)",
                                                  tn_stepfile_text(reference).text));
    for (size_t i = 0; i < count; i++)
        tn_stepfile_list_add(&values, tn_stepfile_add(step, "IFCPROPERTYSINGLEVALUE('%s',$,%s,$)", properties[i].name,
                                                      properties[i].value));
    const char *list = tn_stepfile_list_text(&values);
    *definition = tn_stepfile_add(step, "IFCPROPERTYSET('%s',$,'%s',$,%s)", tn_stepfile_guid(step, "set %s", key).text,
                                  name, list ? list : "()");
    ifc->failed |= !list;
    tn_stepfile_list_clear(&values);
}

void tn_ifc_properties(tn_ifc *ifc, unsigned part, const char *set, const char *reference,
                       const tn_ifc_property *properties, size_t count)
{
    char key[KEY_ROOM];
    int size = snprintf(key, sizeof key, "%s %s", set, reference);
    for (size_t i = 0; i < count; i++)
        size += snprintf(key + size, sizeof key - (size_t)size, " %s %s", properties[i].name, properties[i].value);
    unsigned *definition = tn_ifc_group_of(ifc, TN_IFC_SET, key, part);
    if (*definition == 0)
        put_set(ifc, key, set, reference, properties, count, definition);
}

static tn_stepfile_number number_of(const tn_stepfile *step, const tn_ifc_quantity *quantity)
{
    return quantity->kind == 'L'   ? tn_stepfile_length(step, quantity->value)
           : quantity->kind == 'A' ? tn_stepfile_area(step, quantity->value)
                                   : tn_stepfile_volume(step, quantity->value);
}

static unsigned put_quantities(tn_ifc *ifc, const char *set, tn_stepfile_id id, const tn_ifc_quantity *quantities,
                               size_t count)
{
    tn_stepfile *step = &ifc->step;
    tn_stepfile_list list = {0};
    for (size_t i = 0; i < count; i++)
        tn_stepfile_list_add(&list, tn_stepfile_add(step, "IFCQUANTITY%s('%s',$,$,%s,$)",
                                                    quantities[i].kind == 'L'   ? "LENGTH"
                                                    : quantities[i].kind == 'A' ? "AREA"
                                                                                : "VOLUME",
                                                    quantities[i].name, number_of(step, &quantities[i]).text));
    const char *values = tn_stepfile_list_text(&list);
    unsigned made = tn_stepfile_add(step, "IFCELEMENTQUANTITY('%s',$,'%s',$,'BaseQuantities',%s)", id.text, set,
                                    values ? values : "()");
    ifc->failed |= !values;
    tn_stepfile_list_clear(&list);
    return made;
}

void tn_ifc_quantities(tn_ifc *ifc, unsigned part, const char *set, const char *key, const tn_ifc_quantity *quantities,
                       size_t count)
{
    char own[KEY_ROOM];
    tn_stepfile *step = &ifc->step;
    if (key) {
        unsigned made = put_quantities(ifc, set, tn_stepfile_guid(step, "quantities %s", key), quantities, count);
        tn_stepfile_add(step, "IFCRELDEFINESBYPROPERTIES('%s',$,$,$,(#%u),#%u)",
                        tn_stepfile_guid(step, "quantities of %s", key).text, part, made);
        return;
    }
    int size = snprintf(own, sizeof own, "%s", set);
    for (size_t i = 0; i < count; i++)
        size += snprintf(own + size, sizeof own - (size_t)size, " %s", number_of(step, &quantities[i]).text);
    unsigned *definition = tn_ifc_group_of(ifc, TN_IFC_SET, own, part);
    if (*definition == 0)
        *definition = put_quantities(ifc, set, tn_stepfile_guid(step, "set %s", own), quantities, count);
}

/* ---- codes */

static unsigned put_class(tn_ifc *ifc, uint32_t table, const char *name, const char *code, const char *title)
{
    tn_stepfile *step = &ifc->step;
    unsigned *whole = &ifc->classifications[table];
    char said[1300] = "$";
    if (!*whole)
        *whole = tn_stepfile_add(step, "IFCCLASSIFICATION($,$,$,'%s',$,$,$)", tn_stepfile_text(name).text);
    if (title[0])
        snprintf(said, sizeof said, "'%s'", tn_stepfile_text(title).text);
    return tn_stepfile_add(step, "IFCCLASSIFICATIONREFERENCE($,'%s',%s,#%u,$,$)", tn_stepfile_text(code).text, said,
                           *whole);
}

void tn_ifc_classify(tn_ifc *ifc, uint32_t number, unsigned part)
{
    const tn_module *module = ifc->house->form->module;
    const tn_form_record *form = ifc->house->form->record;
    char key[KEY_ROOM];
    for (uint32_t i = 0; i < form->classification_count; i++) {
        const tn_classification_record *table = &module->CLASSIFICATION_records[form->classification_first + i];
        const char *name = tn_text(module, table->name);
        for (uint32_t c = 0; c < table->class_count; c++) {
            const tn_class_record *class = &module->CLASS_records[table->class_first + c];
            const char *code = tn_text(module, class->code), *title = tn_text(module, class->title);
            if (class->part != number)
                continue;
            snprintf(key, sizeof key, "%zu %s %zu %s %s", strlen(name), name, strlen(code), code, title);
            unsigned *definition = tn_ifc_group_of(ifc, TN_IFC_CLASS, key, part);
            if (*definition == 0)
                *definition = put_class(ifc, i, name, code, title);
        }
    }
}

/* ---- what parts are made of */

/* The place in `materials` and `styles` of what a solid is made of: of one in layers, of the first. */
static uint32_t place_of(const tn_ifc *ifc, const tn_solid *s)
{
    uint32_t material = tn_part_material(ifc->house, tn_solid_made_part(ifc->house, s->kind, s->of, s->item));
    return material == TN_NO_RECORD ? s->kind : TN_SOLID_COUNT + material - ifc->house->form->record->material_first;
}

/* The material at a place, or of a layer without one in the places behind those. */
static unsigned put_material(tn_ifc *ifc, uint32_t place)
{
    const tn_house_form *form = ifc->house->form;
    uint32_t record = place - TN_SOLID_COUNT, layer = record - form->record->material_count;
    const char *name =
        place < TN_SOLID_COUNT ? tn_solid_kind_text((tn_solid_kind)place)
        : record < form->record->material_count
            ? tn_text(form->module, form->module->MATERIAL_records[form->record->material_first + record].name)
            : tn_text(form->module, tn_form_layer(form, layer)->name);
    if (!ifc->materials[place])
        ifc->materials[place] = tn_stepfile_add(&ifc->step, "IFCMATERIAL('%s',$,$)", tn_stepfile_text(name).text);
    return ifc->materials[place];
}

static unsigned put_layer_set(tn_ifc *ifc, tn_layered of)
{
    const tn_house_form *form = ifc->house->form;
    tn_stepfile *step = &ifc->step;
    tn_stepfile_list layers = {0};
    for (uint32_t i = tn_form_layers(form, of); i < form->layers_end[of]; i++) {
        uint32_t part = tn_layer_part(form, i), material = tn_part_material(ifc->house, part);
        unsigned made = put_material(ifc, material == TN_NO_RECORD
                                              ? TN_SOLID_COUNT + form->record->material_count + part - TN_OF_COUNT
                                              : TN_SOLID_COUNT + material - form->record->material_first);
        tn_stepfile_list_add(&layers,
                             tn_stepfile_add(step, "IFCMATERIALLAYER(#%u,%s,$,'%s',$,$,$)", made,
                                             tn_stepfile_length(step, (double)tn_form_layer(form, i)->thick).text,
                                             tn_stepfile_text(tn_form_part_text(form, part)).text));
    }
    const char *list = tn_stepfile_list_text(&layers);
    unsigned set = tn_stepfile_add(step, "IFCMATERIALLAYERSET(%s,'%s',$)", list ? list : "()", tn_names_LAYERED[of]);
    ifc->failed |= !list;
    tn_stepfile_list_clear(&layers);
    return set;
}

/* How layers lie in a part that has them: in the direction of its axis, against it, or in no direction that is said. */
typedef enum tn_layers_lie { LIE_ALONG, LIE_AGAINST, LIE_ANYHOW } tn_layers_lie;

/* Walls have their layers across, in the direction of their y axis or against it, about the line in their middle; decks
 * from the top down. */
static unsigned put_layers(tn_ifc *ifc, tn_layered of, tn_layers_lie lie)
{
    tn_stepfile *step = &ifc->step;
    if (!ifc->layer_sets[of])
        ifc->layer_sets[of] = put_layer_set(ifc, of);
    if (lie == LIE_ANYHOW)
        return ifc->layer_sets[of];
    double thick = (double)tn_layered_thick(ifc->house->form->record, of), offset = of == TN_LAYERED_DECK ? thick
                                                                                    : lie == LIE_ALONG    ? -thick / 2
                                                                                                          : thick / 2;
    return tn_stepfile_add(step, "IFCMATERIALLAYERSETUSAGE(#%u,.%s.,.%s.,%s,$)", ifc->layer_sets[of],
                           of == TN_LAYERED_DECK ? "AXIS3" : "AXIS2", lie == LIE_ALONG ? "POSITIVE" : "NEGATIVE",
                           tn_stepfile_length(step, offset).text);
}

/* Walls go along their x axis: y is to the low side of one that runs in y. */
static tn_layers_lie lie_of(const tn_solid *s, const tn_layering *layers)
{
    bool wall = s->kind == TN_SOLID_OUTSIDE || s->kind == TN_SOLID_PARTY || s->kind == TN_SOLID_PARTITION;
    if (!wall && s->kind != TN_SOLID_DECK && s->kind != TN_SOLID_ROOFDECK)
        return LIE_ANYHOW;
    bool turned = wall && layers->axis == 0;
    return layers->from_high == turned ? LIE_ALONG : LIE_AGAINST;
}

void tn_ifc_make_of(tn_ifc *ifc, const tn_solid *s, unsigned part)
{
    char key[40];
    tn_layering layers = tn_solid_layering(ifc->house, s->kind, s->of, s->item);
    tn_ifc_classify(ifc, tn_solid_whole_part(ifc->house, s->kind, s->of, s->item), part);
    if (layers.count > 0) {
        tn_layered of = (tn_layered)tn_form_layer(ifc->house->form, layers.first)->of;
        tn_layers_lie lie = lie_of(s, &layers);
        snprintf(key, sizeof key, "layers %d %d", (int)of, (int)lie);
        unsigned *definition = tn_ifc_group_of(ifc, TN_IFC_MATERIAL, key, part);
        if (*definition == 0)
            *definition = put_layers(ifc, of, lie);
        return;
    }
    uint32_t place = place_of(ifc, s);
    snprintf(key, sizeof key, "material %u", place);
    unsigned *definition = tn_ifc_group_of(ifc, TN_IFC_MATERIAL, key, part);
    if (*definition == 0)
        *definition = put_material(ifc, place);
}

/* ---- looks */

/* What of the light glass lets through. */
#define PANE_TRANSPARENCY "0.7"

void tn_ifc_look_as(tn_ifc *ifc, const tn_solid *s)
{
    tn_stepfile *step = &ifc->step;
    uint32_t place = place_of(ifc, s);
    unsigned *style = &ifc->styles[2 * place + (s->kind == TN_SOLID_PANE)];
    if (!*style) {
        const unsigned char *c = ifc->colours[place];
        unsigned colour =
                     tn_stepfile_add(step, "IFCCOLOURRGB($,%s,%s,%s)", tn_stepfile_real(c[0] / 255.0, 6).text,
                                     tn_stepfile_real(c[1] / 255.0, 6).text, tn_stepfile_real(c[2] / 255.0, 6).text),
                 rendering = tn_stepfile_add(step, "IFCSURFACESTYLERENDERING(#%u,%s,$,$,$,$,$,$,.NOTDEFINED.)", colour,
                                             s->kind == TN_SOLID_PANE ? PANE_TRANSPARENCY : "0.");
        *style = tn_stepfile_add(step, "IFCSURFACESTYLE($,.BOTH.,(#%u))", rendering);
    }
    step->style = *style;
}
