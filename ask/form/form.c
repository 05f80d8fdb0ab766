/* Tells what the open file is about, and refuses what says nothing about it. */
#include "ask/form/form.h"

#include <inttypes.h>
#include <stdio.h>

tn_subject tn_subject_of(const tn_module *module)
{
    return module->SURFACE_count > 0 ? TN_SUBJECT_FIELD : module->SOLID_count > 0 ? TN_SUBJECT_SOLID : TN_SUBJECT_PLANS;
}

tn_status tn_session_check_uses(tn_session *session, const tn_asked_use *uses, size_t count)
{
    static const char *const subjects[] = {[TN_SUBJECT_PLANS] = "plans and rules",
                                           [TN_SUBJECT_SOLID] = "a design of boxes",
                                           [TN_SUBJECT_FIELD] = "a field"};
    static const char *const files[] = {
        [TN_OF_PLANS] = "plans (.plan)",
        [TN_OF_SOLIDS] = "designs of boxes (.solid)",
        [TN_OF_PLANS | TN_OF_SOLIDS] = "plans and designs of boxes",
        [TN_OF_FIELDS] = "fields (.field)",
        [TN_OF_PLANS | TN_OF_FIELDS] = "plans and fields",
        [TN_OF_SOLIDS | TN_OF_FIELDS] = "designs of boxes and fields",
    };
    tn_subject asked = tn_subject_of(session->opened->module);
    for (size_t i = 0; i < count; i++) {
        char help[120];
        if (!uses[i].given || uses[i].of >> asked & 1)
            continue;
        snprintf(help, sizeof help, "leave --%s out: it is for %s", uses[i].name, files[uses[i].of]);
        return tn_session_refuse(session, help, "--%s does nothing for %s", uses[i].name, subjects[asked]);
    }
    return TN_OK;
}

tn_status tn_form_options_fit(tn_session *session, const tn_field_asked *field, const tn_solid_asked *solid)
{
    const tn_asked_use uses[] = {
        {field->surface != NULL, TN_OF_FIELDS, "surface"},     {field->has_grid, TN_OF_FIELDS, "grid"},
        {field->has_max_samples, TN_OF_FIELDS, "max-samples"}, {field->engine != 0, TN_OF_FIELDS, "engine"},
        {field->has_threads, TN_OF_FIELDS, "threads"},         {solid->solid != NULL, TN_OF_SOLIDS, "solid"},
        {solid->has_max_boxes, TN_OF_SOLIDS, "max-boxes"},
    };
    bool neither =
        tn_subject_of(session->opened->module) == TN_SUBJECT_PLANS; /* what is missing is said where it is looked for */
    return neither ? TN_OK : tn_session_check_uses(session, uses, sizeof uses / sizeof *uses);
}

tn_contour_options tn_contour_asked(const tn_field_asked *asked)
{
    bool interpret = asked->engine == 1;
    return (tn_contour_options){.threads = (unsigned)asked->threads,
                                .interpret = interpret,
                                .every_sample = interpret,
                                .samples = asked->max_samples};
}

void tn_form_note(const tn_opened *opened, uint32_t name, char note[TN_FORM_NOTE_SIZE])
{
    const tn_module *module = opened->module;
    const tn_producer_record *producer = module->PRODUCER_count ? &module->PRODUCER_records[0] : NULL;
    snprintf(note, TN_FORM_NOTE_SIZE, "%.60s, rules %016" PRIx64 ", %.40s", tn_text(module, name),
             producer ? (uint64_t)producer->sources_hash : 0, producer ? tn_text(module, producer->version) : "tartan");
}
