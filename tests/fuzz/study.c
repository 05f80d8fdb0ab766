/* The front end of .study files on any text: it ends, says what is wrong, and what it accepts makes a module that loads
 * and grows. */
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/text.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_growth_text("fuzz.study", data, size);
    return 0;
}
