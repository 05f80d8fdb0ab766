/* Puts pictures together as one that moves: an animated PNG, which browsers and viewers of pictures play. */
#ifndef TARTAN_SCENE_APNG_H
#define TARTAN_SCENE_APNG_H

#include <stdio.h>

#include "runtime/base/picture.h"

/* Writes `count` PNG pictures that were drawn into memory, all of one size, as one animated PNG that begins again
 * without end; each is shown for `delay` thousandths of a second. Frames are at most 2^31 bytes. TN_IO (E0902) where
 * the stream cannot be written. */
tn_status tn_apng_write(const tn_picture *frames, size_t count, unsigned delay, FILE *out, tn_error *error);

#endif
