/* What diagnostics are called in code: E_... and W_..., one for each row of codes.def. */
#ifndef TARTAN_BASE_CODES_H
#define TARTAN_BASE_CODES_H

/* The value is the number: E0301 is 301, W012 is 10012. */
typedef enum tn_code {
    TN_CODE_NONE = 0, /* a note that stands alone, as "rule r falls back to the VM" */
#define ERROR(NUMBER, NAME, SUMMARY) E_##NAME = NUMBER,
#define WARNING(NUMBER, NAME, SUMMARY) W_##NAME = 10000 + NUMBER,
#include "runtime/base/codes.def"
#undef ERROR
#undef WARNING
} tn_code;

#endif
