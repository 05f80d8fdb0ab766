/* PNG pictures as heights, by the part `draw`, which is loaded when the first one is read. */
#include "runtime/base/part.h"
#include "runtime/place/picture/heights_png.h"

tn_status tn_heights_read_png(const uint8_t *bytes, size_t size, tn_heights *heights, tn_error *error)
{
    *heights = (tn_heights){0};
    __typeof__(tn_heights_read_png) *read =
        (__typeof__(read))tn_part_find(TN_WITH_DRAW, "tn_heights_read_png", "reading a PNG picture", error);
    return read ? read(bytes, size, heights, error) : TN_INVALID;
}
