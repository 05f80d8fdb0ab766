#include "runtime/module/verify.h"

tn_status tn_module_verify(const tn_module *module, const tn_module_limits *limits, tn_error *error)
{
    tn_status status = tn_verify_tables(module, limits, error);
    if (status == TN_OK)
        status = tn_verify_growth(module, error);
    if (status == TN_OK)
        status = tn_verify_settings(module, error);
    return status == TN_OK ? tn_verify_code(module, limits, error) : status;
}
