/* Goes through the sections of a form: warns about values that none has, and about materials of which nothing is made.
 */
#include <stdlib.h>

#include "driver/house/survey_parts.h"
#include "runtime/house/schedule/cost.h"

#define SECTIONS_MAX 100000u
#define QUESTIONS_MAX 100000000u /* which material a part has in a section: a second or two */

/* What is known of materials when all sections were seen. */
typedef struct section_use {
    bool *holds, *used; /* [material of the form] its `where` holds in some section; a part is made of it in some */
    bool materials;     /* are there few enough to ask for? */
} section_use;

static const tn_material_record *material_of(const tn_survey *s, uint32_t number)
{
    return &s->form.module->MATERIAL_records[s->form.record->material_first + number];
}

static uint32_t part_of(const tn_survey *s, const tn_material_record *material, uint32_t place)
{
    return s->form.module->HOUSE_ITEM_records[material->part_first + place].number;
}

/* Nothing stands in an opening that is leafless. */
static bool is_leafless(const tn_survey *s, uint32_t part)
{
    const tn_form_record *form = s->form.record;
    uint32_t first = tn_form_openings_part(&s->form);
    return part >= first && part - first < form->opening_count &&
           s->form.module->OPENING_records[form->opening_first + part - first].flags & TN_LEAFLESS;
}

/* Is the part what all of its walls, decks or roofs are, in layers? */
static bool is_layered(const tn_survey *s, uint32_t part)
{
    static const tn_layered kinds[] = {[TN_OF_WALL] = TN_LAYERED_OUTSIDE,
                                       [TN_OF_PARTY] = TN_LAYERED_PARTY,
                                       [TN_OF_PARTITION] = TN_LAYERED_PARTITION,
                                       [TN_OF_DECK] = TN_LAYERED_DECK,
                                       [TN_OF_ROOF] = TN_LAYERED_ROOF};
    bool layers = part < TN_OF_COUNT && part != TN_OF_POST;
    return layers && tn_form_layers(&s->form, kinds[part]) < s->form.layers_end[kinds[part]];
}

static bool is_missing_guard(const tn_survey *s, uint32_t part)
{
    return part == tn_form_guard_part(&s->form) && s->form.record->guard == 0;
}

/* Which materials the section of the house has. */
static void see_materials(const tn_survey *s, section_use *seen)
{
    for (uint32_t i = 0; i < s->form.record->material_count; i++) {
        const tn_material_record *material = material_of(s, i);
        seen->holds[i] =
            seen->holds[i] || material->where == TN_NO_RECORD || tn_house_decide(&s->house, material->where, NULL);
        for (uint32_t p = 0; seen->holds[i] && !seen->used[i] && p < material->part_count; p++) {
            uint32_t part = part_of(s, material, p);
            bool there = (part != TN_OF_PARTY || tn_survey_names(s, TN_FACE_PARTY)) && !is_leafless(s, part) &&
                         !is_layered(s, part) && !is_missing_guard(s, part);
            seen->used[i] = there && tn_part_material(&s->house, part) == s->form.record->material_first + i;
        }
    }
}

static void see_sections(tn_survey *s, section_use *seen)
{
    do {
        s->sections++;
        if (!tn_house_section_stands(&s->house))
            continue;
        s->stands++;
        for (uint32_t i = 0; i < s->form.record->choice_count; i++)
            s->with[tn_form_choice(&s->form, i)->shape_first + s->house.shapes[i]]++;
        if (seen->materials)
            see_materials(s, seen);
    } while (tn_form_next_section(&s->form, s->house.shapes));
}

static void warn_values(const tn_survey *s)
{
    const tn_module *module = s->form.module;
    for (uint32_t i = 0; i < s->form.record->choice_count; i++) {
        const tn_choice_record *choice = tn_form_choice(&s->form, i);
        for (uint32_t k = choice->shape_first; k < choice->shape_first + choice->shape_count; k++) {
            const tn_shape_record *shape = &module->SHAPE_records[k];
            if (s->with[k] || tn_survey_allows(s, W_SHAPE_NEVER, TN_SURVEY_SPAN(shape)))
                continue;
            tn_diagnostic *d = tn_report(tn_survey_list(s), W_SHAPE_NEVER, TN_SURVEY_SPAN(shape),
                                         "no house of the form has this value of `%s`", tn_text(module, choice->name));
            tn_help(tn_survey_list(s), d, "the form's `forbid` lines leave no combination with it");
        }
    }
}

/* All sections are forbidden: said once, and not of each value. */
static void warn_all(const tn_survey *s)
{
    const tn_form_record *form = s->form.record;
    if (tn_survey_allows(s, W_SHAPE_NEVER, TN_SURVEY_SPAN(form)))
        return;
    tn_diagnostic *d = tn_report(tn_survey_list(s), W_SHAPE_NEVER, TN_SURVEY_SPAN(form),
                                 "form `%s` has no house: its `forbid` lines forbid all combinations of options",
                                 tn_text(s->form.module, form->name));
    tn_help(tn_survey_list(s), d, "leave one of them out, or join what they ask by `and`");
}

/* Is each of its parts that of an earlier material without `where`? The compiler says so. */
static bool is_hidden(const tn_survey *s, uint32_t number)
{
    const tn_material_record *material = material_of(s, number);
    for (uint32_t p = 0; p < material->part_count; p++) {
        bool hidden = false;
        for (uint32_t i = 0; i < number; i++)
            for (uint32_t q = 0; material_of(s, i)->where == TN_NO_RECORD && q < material_of(s, i)->part_count; q++)
                hidden |= part_of(s, material_of(s, i), q) == part_of(s, material, p);
        if (!hidden)
            return false;
    }
    return true;
}

static void warn_materials(const tn_survey *s, const section_use *seen)
{
    for (uint32_t i = 0; i < s->form.record->material_count; i++) {
        const tn_material_record *material = material_of(s, i);
        if (seen->used[i] || is_hidden(s, i) || tn_survey_allows(s, W_MATERIAL_FOR_NOTHING, TN_SURVEY_SPAN(material)))
            continue;
        bool party =
            material->part_count == 1 && part_of(s, material, 0) == TN_OF_PARTY && !tn_survey_names(s, TN_FACE_PARTY);
        bool leafless = material->part_count == 1 && is_leafless(s, part_of(s, material, 0)),
             layered = is_layered(s, part_of(s, material, 0)),
             guard = material->part_count == 1 && is_missing_guard(s, part_of(s, material, 0));
        for (uint32_t p = 1; p < material->part_count; p++)
            layered = layered && is_layered(s, part_of(s, material, p));
        tn_diagnostic *d = tn_report(tn_survey_list(s), W_MATERIAL_FOR_NOTHING, TN_SURVEY_SPAN(material),
                                     "nothing is ever made of `%s`", tn_text(s->form.module, material->name));
        tn_help(tn_survey_list(s), d,
                party            ? "no line of faces has the kind `party`"
                : guard          ? "guards stand only in a form that has `way`"
                : leafless       ? "the opening is `leafless`: nothing stands in it"
                : layered        ? "such parts consist of layers: a material is for one of these, by its name"
                : seen->holds[i] ? "where it is meant for, lines before it name all of its parts"
                                 : "no combination of options is as its `where` says");
    }
}

static bool may_go_through(const tn_survey *s, bool *materials)
{
    uint64_t sections = 1, parts = 0;
    for (uint32_t i = 0; i < s->form.record->choice_count && sections <= SECTIONS_MAX; i++)
        sections *= tn_form_choice(&s->form, i)->shape_count;
    for (uint32_t i = 0; i < s->form.record->material_count; i++)
        parts += material_of(s, i)->part_count;
    *materials = sections * parts * parts <= QUESTIONS_MAX;
    return sections <= SECTIONS_MAX;
}

static void warn(const tn_survey *s, const section_use *seen)
{
    if (!s->stands)
        warn_all(s);
    else
        warn_values(s);
    if (s->stands && seen->materials)
        warn_materials(s, seen);
}

tn_status tn_survey_sections(tn_survey *s, tn_error *error)
{
    size_t materials = (size_t)s->form.record->material_count + 1;
    section_use seen = {.holds = calloc(materials, sizeof *seen.holds), .used = calloc(materials, sizeof *seen.used)};
    s->with = calloc((size_t)s->form.module->SHAPE_count + 1, sizeof *s->with);
    tn_status status = s->with && seen.holds && seen.used ? TN_OK : tn_fail_memory(error);
    s->counted = may_go_through(s, &seen.materials);
    seen.materials = seen.materials && s->opened;
    if (status == TN_OK && s->counted)
        see_sections(s, &seen);
    if (status == TN_OK && s->counted && s->opened)
        warn(s, &seen);
    free(seen.holds);
    free(seen.used);
    return status;
}

/* Where sections were counted, only those that stand are asked; a form that forbids all of them is as one that forbids
 * none. */
uint32_t tn_survey_storeys(const tn_survey *s, uint32_t zone, bool most)
{
    bool all = !s->counted || !s->stands, any = false;
    uint32_t found = s->form.record->storey_count;
    for (uint32_t i = 0; i < s->form.record->choice_count; i++) {
        const tn_choice_record *choice = tn_form_choice(&s->form, i);
        if (choice->kind != TN_CHOICE_STOREYS || choice->zone != s->schema->record->field_first + zone)
            continue;
        for (uint32_t k = choice->shape_first; k < choice->shape_first + choice->shape_count; k++) {
            uint32_t storeys = s->form.module->SHAPE_records[k].storeys;
            if (!all && !s->with[k])
                continue;
            found = !any || (storeys > found) == most ? storeys : found;
            any = true;
        }
    }
    return found;
}

uint64_t tn_survey_sections_with(const tn_survey *s, uint32_t zone, uint32_t storey)
{
    for (uint32_t i = 0; i < s->form.record->choice_count; i++) {
        const tn_choice_record *choice = tn_form_choice(&s->form, i);
        uint64_t found = 0;
        if (choice->kind != TN_CHOICE_STOREYS || choice->zone != s->schema->record->field_first + zone)
            continue;
        for (uint32_t k = choice->shape_first; k < choice->shape_first + choice->shape_count; k++)
            found += s->form.module->SHAPE_records[k].storeys > storey ? s->with[k] : 0;
        return found;
    }
    return s->stands;
}
