/* PNG pictures in a build without the part `draw`: they cannot be read. */
#include "runtime/base/error.h"
#include "runtime/place/picture/heights_png.h"

tn_status tn_heights_read_png(const uint8_t *bytes, size_t size, tn_heights *heights, tn_error *error)
{
    (void)bytes, (void)size;
    *heights = (tn_heights){0};
    return tn_part_absent(TN_WITH_DRAW, "reading a PNG picture", error);
}
