/* What a file is about, for questions and commands that take several notations: plans, a design of boxes, or the
 * surfaces of a field. */
#ifndef TARTAN_ASK_FORM_FORM_H
#define TARTAN_ASK_FORM_FORM_H

#include "ask/session/session.h"
#include "runtime/field/contour.h"

typedef enum tn_subject {
    TN_SUBJECT_PLANS, /* rules and libraries too */
    TN_SUBJECT_SOLID, /* a design of boxes */
    TN_SUBJECT_FIELD, /* surfaces */
    TN_SUBJECT_COUNT
} tn_subject;

tn_subject tn_subject_of(const tn_module *module);

/* Sets of subjects. */
enum {
    TN_OF_PLANS = 1 << TN_SUBJECT_PLANS,
    TN_OF_SOLIDS = 1 << TN_SUBJECT_SOLID,
    TN_OF_FIELDS = 1 << TN_SUBJECT_FIELD
};

/* A member of a request, or an option, that says something about some subjects only. */
typedef struct tn_asked_use {
    bool given;
    unsigned of;      /* a set of subjects, not all */
    const char *name; /* of the option, without its dashes */
} tn_asked_use;

/* TN_INVALID, which is said, at the first that is given and says nothing about the file's subject. */
tn_status tn_session_check_uses(tn_session *session, const tn_asked_use *uses, size_t count);

/* The same for what questions about forms have in common, of a file with surfaces or designs; others pass. */
tn_status tn_form_options_fit(tn_session *session, const tn_field_asked *field, const tn_solid_asked *solid);

/* Answers explain, of a design of boxes. If nothing is left of it, there is an answer with the failure. */
tn_status tn_explain_design(tn_session *session, const tn_explain_request *request, tn_reply *answer);

/* How a surface is sampled. */
tn_contour_options tn_contour_asked(const tn_field_asked *asked);

/* A line on how a file of a form was made, for that file: the form's name, its rules and the version. */
enum { TN_FORM_NOTE_SIZE = 240 };
void tn_form_note(const tn_opened *opened, uint32_t name, char note[TN_FORM_NOTE_SIZE]);

#endif
