#include "cli/library_session.h"

#include <omp.h>

#include "runtime/plan/vm.h"

int tn_session_threads(const tn_settings *settings)
{
    if (settings->threads.given)
        omp_set_num_threads((int)settings->threads.value);
    return omp_get_max_threads();
}

size_t tn_session_max_length(const tn_settings *settings)
{
    return settings->max_length.given ? (size_t)settings->max_length.value : TN_VM_LENGTH_DEFAULT;
}

void tn_session_rank(const char *text, const mpz_t otherwise, mpz_t number)
{
    if (!text || !*text || mpz_set_str(number, text, 10) != 0)
        mpz_set(number, otherwise);
}

static bool ready_library(tn_session *session, const char *path, const tn_library_options *options,
                          tn_ready_library *ready)
{
    *ready = (tn_ready_library){0};
    tn_session_threads(session->settings);
    if (!tn_session_open(session, path))
        return false;
    tn_status status = tn_library_ready(&session->opened, session->settings->library, options, ready);
    tn_session_status(session, status);
    return status == TN_OK;
}

bool tn_session_library(tn_session *session, const char *path, tn_ready_library *ready)
{
    const tn_settings *settings = session->settings;
    tn_library_options options = {.max_states = (uint32_t)settings->max_states.value,
                                  .override_trays = settings->trays.given,
                                  .trays_min = (uint32_t)settings->trays.low,
                                  .trays_max = (uint32_t)settings->trays.high,
                                  .max_length = (uint32_t)settings->max_length.value};
    return ready_library(session, path, &options, ready);
}

bool tn_session_library_schema(tn_session *session, const char *path, tn_ready_library *ready)
{
    return ready_library(session, path, NULL, ready);
}
