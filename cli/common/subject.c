/* Tells what the open file is about, and refuses options that say nothing about it. */
#include "cli/common/subject.h"

tn_subject tn_job_subject(const tn_job *job)
{
    const tn_module *module = job->opened.module;
    return module->SURFACE_count > 0 ? TN_SUBJECT_FIELD : module->SOLID_count > 0 ? TN_SUBJECT_SOLID : TN_SUBJECT_PLANS;
}

bool tn_job_check_uses(tn_job *job, const tn_option_use *uses, size_t count)
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
    tn_subject asked = tn_job_subject(job);
    for (size_t i = 0; i < count; i++) {
        if (!uses[i].given || uses[i].of >> asked & 1)
            continue;
        tn_diagnostic *d = tn_job_usage(job, "--%s does nothing for %s", uses[i].name, subjects[asked]);
        tn_help(tn_job_diagnostics(job), d, "leave --%s out: it is for %s", uses[i].name, files[uses[i].of]);
        return false;
    }
    return true;
}
