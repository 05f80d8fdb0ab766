/* Derivations of plans, counted. */
#include "ask/plan/ways.h"

#include "ask/plan/found.h"
#include "ask/session/requests.h"
#include "runtime/plan/library/alone.h"
#include "runtime/plan/ways/library_ways.h"
#include "runtime/plan/ways/plan_ways.h"

tn_status tn_ways_refuse_houses(tn_session *session)
{
    return tn_session_refuse(session, "name the library of plans with --library",
                             "--ways is about how plans are derived, and this is about houses");
}

/* ---- single plans */

tn_status tn_ways_open(tn_ways_of_plans *w, const tn_ready_library *ready, tn_error *error)
{
    uint32_t clause = tn_library_generator(ready->library);
    *w = (tn_ways_of_plans){0};
    mpz_init_set_ui(w->ways, 1);
    if (clause == UINT32_MAX)
        return TN_OK;
    const tn_module *module = ready->schema->module;
    uint32_t function = module->CLAUSE_records[ready->record->clause_first + clause].holds;
    tn_instruction image;
    if (tn_function_is_image(module, function, &image))
        return tn_projected_new(ready->schema, &image, NULL, tn_library_max_states(ready->library),
                                tn_library_max(ready->library), &w->projected, error);
    tn_status status = tn_derivation_read(module, function, &w->derivation, error);
    return status == TN_OK ? tn_plan_vm_new(ready->schema, tn_library_max(ready->library), &w->vm, error) : status;
}

tn_status tn_ways_find(tn_ways_of_plans *w, const tn_tray *trays, size_t length, tn_error *error)
{
    if (w->projected)
        return tn_projected_ways(w->projected, trays, length, w->ways, error);
    return w->vm ? tn_plan_ways(&w->derivation, w->vm, trays, length, w->ways, error) : TN_OK;
}

void tn_ways_close(tn_ways_of_plans *w)
{
    tn_projected_free(w->projected);
    tn_plan_vm_free(w->vm);
    tn_derivation_clear(&w->derivation);
    mpz_clear(w->ways);
}

/* ---- all plans of a library */

static tn_status give_rows(const tn_derived_ways *found, tn_counted_ways *counted, tn_error *error)
{
    tn_status status = TN_NEW_LIST(ways_row, counted->distribution, found->count, error);
    for (size_t i = 0; status == TN_OK && i < found->count; i++) {
        mpz_set(counted->distribution.items[i].ways, found->rows[i].ways);
        mpz_set(counted->distribution.items[i].plans, found->rows[i].plans);
    }
    counted->has_distribution = status == TN_OK;
    return status;
}

static tn_status give(const tn_ready_library *ready, const tn_derived_ways *found, tn_counted_ways *counted,
                      tn_error *error)
{
    tn_status status = TN_OK;
    counted->library = tn_text(ready->schema->module, ready->record->name);
    counted->generate = counted->projected = found->clause;
    counted->has_generate = found->clause && !found->projected;
    counted->has_projected = found->projected;
    mpz_set(counted->plans, found->plans);
    mpz_set(counted->ways, found->ways);
    if (mpz_sgn(found->plans) > 0) {
        counted->has_mean = true;
        mpz_set(mpq_numref(counted->mean), found->ways);
        mpz_set(mpq_denref(counted->mean), found->plans);
        mpq_canonicalize(counted->mean);
    }
    if (found->has_most && found->first) {
        counted->has_most = counted->has_first = true;
        mpz_set(counted->most, found->most);
        status = tn_found_plan_texts(ready->schema, found->first, found->length, &counted->first, NULL, error);
    }
    return status == TN_OK && found->has_rows ? give_rows(found, counted, error) : status;
}

tn_status tn_count_ways(tn_session *session, const tn_count_request *request, tn_reply *answer)
{
    const tn_ready_library *ready;
    tn_derived_ways found;
    tn_error error;
    tn_status status = tn_session_library(session, &request->subject, &ready);
    if (status != TN_OK)
        return status;
    tn_session_begins(session, "ways counted");
    status = tn_library_count_ways(ready->library, 0, &found, &error);
    tn_session_ends(session);
    if (status == TN_OK)
        status = tn_reply_new(&tn_message_counted_ways, answer, &error);
    if (status == TN_OK)
        status = give(ready, &found, answer->value, &error);
    tn_derived_ways_clear(&found);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}
