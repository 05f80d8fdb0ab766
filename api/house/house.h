/* What the files of the C interface to houses share.
 *
 * A library is a file that is open, made of the module's bytes, with a session of its own: what is said there while it
 * is asked something is forgotten before the next question. Houses borrow the library's form. */
#ifndef TARTAN_API_HOUSE_HOUSE_H
#define TARTAN_API_HOUSE_HOUSE_H

#include "api/compiler/compile.h"
#include "api/plan/plan.h"
#include "ask/house/numbered.h"
#include "runtime/house/house.h"

struct tartan_house_library {
    tn_opened opened;
    tn_session session;
    tn_numbered numbered;
    bool ready;     /* numbered is open */
    tn_plan plan;   /* that is asked about, with room for the longest */
    tn_watch watch; /* whoever waits at the moment */
};

struct tartan_house {
    tartan_house_library *library;
    tn_house house;
};

/* Begins a question that may take long; a NULL library is refused. End it in any case, unless beginning failed. */
tartan_status tn_api_houses_begin(tartan_house_library *library, const tartan_watch *watch, tartan_error *error);

/* Ends it: an error that was found goes to the caller. Returns the status. */
tartan_status tn_api_houses_end(tartan_house_library *library, tn_status status, const tn_error *found,
                                tartan_error *error);

/* The same of a question that says in the session's file what is wrong. */
tartan_status tn_api_houses_said(tartan_house_library *library, tn_status status, tartan_error *error);

/* The caller's plan (may be NULL) as one of the library's; *of is NULL, or the library's copy until the next one. */
tn_status tn_api_houses_on(tartan_house_library *library, const tartan_on_plan *given, const tn_plan **of,
                           tn_error *error);

#endif
