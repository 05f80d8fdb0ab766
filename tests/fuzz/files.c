/* Files of plans from any bytes: plan lines, JSON lines, CSV, packed plans (with the schema's hash made right, so that
 * what is behind it is reached) and SQLite libraries. Whatever is read is legal, and reads on after an error of one
 * plan. */
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "runtime/base/bytes.h"
#include "runtime/plan/text/pack.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/lahave.h"
#include "tests/fuzz/read_plans.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    int file = memfd_create("plans", MFD_CLOEXEC);
    if (file < 0 || write(file, data, size) != (ssize_t)size)
        stop("no file in memory");
    if (size >= TN_PACK_HEADER && memcmp(data, TN_PACK_MAGIC, 8) == 0) {
        uint8_t right[16];
        tn_put_u32(right, TN_PACK_VERSION);
        tn_put_u32(right + 4, tn_pack_tray_bytes(lahave()));
        tn_put_u64(right + 8, tn_pack_schema_hash(lahave()));
        if (pwrite(file, right, sizeof right, 8) != (ssize_t)sizeof right)
            stop("no file in memory");
    }
    char path[64];
    snprintf(path, sizeof path, "/proc/self/fd/%d", file);
    read_plans(path, TN_FORMAT_AUTO);
    read_plans(path, TN_FORMAT_CSV);
    close(file);
    return 0;
}
