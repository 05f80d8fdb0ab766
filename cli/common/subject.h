/* What the open file is about, for commands that take several notations. */
#ifndef TARTAN_CLI_COMMON_SUBJECT_H
#define TARTAN_CLI_COMMON_SUBJECT_H

#include "cli/common/job.h"

typedef enum tn_subject {
    TN_SUBJECT_PLANS, /* rules and libraries too */
    TN_SUBJECT_SOLID, /* a design of boxes */
    TN_SUBJECT_FIELD, /* surfaces */
    TN_SUBJECT_COUNT
} tn_subject;

tn_subject tn_job_subject(const tn_job *job);

/* Sets of subjects. */
enum {
    TN_OF_PLANS = 1 << TN_SUBJECT_PLANS,
    TN_OF_SOLIDS = 1 << TN_SUBJECT_SOLID,
    TN_OF_FIELDS = 1 << TN_SUBJECT_FIELD
};

/* An option that says something about some subjects only. */
typedef struct tn_option_use {
    bool given;
    unsigned of;      /* a set of subjects, not all */
    const char *name; /* without its dashes */
} tn_option_use;

/* Refuses the first given option that says nothing about the file's subject: false. */
bool tn_job_check_uses(tn_job *job, const tn_option_use *uses, size_t count);

#endif
