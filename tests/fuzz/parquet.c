/* Files of Parquet from any bytes, with the marks at both ends made right, so that what is between them is reached.
 * What is read is legal, and nothing reads outside of its bytes. */
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/read_plans.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[64];
    int file = memfd_create("plans", MFD_CLOEXEC);
    if (file < 0 || write(file, data, size) != (ssize_t)size)
        abort();
    if (size >= 12 && (pwrite(file, "PAR1", 4, 0) != 4 || pwrite(file, "PAR1", 4, (off_t)size - 4) != 4))
        abort();
    snprintf(path, sizeof path, "/proc/self/fd/%d", file);
    read_plans(path, TN_FORMAT_AUTO);
    close(file);
    return 0;
}
