/* Files that rule files name and that are no rule files: a kit's meshes, pictures and models. */
#ifndef TARTAN_DRIVER_OPEN_ATTACHED_H
#define TARTAN_DRIVER_OPEN_ATTACHED_H

#include "compiler/common/compilation.h"

/* Reads them from where they lie, beside the file that names them. For several threads at once. */
extern const tn_attachments tn_file_attachments;

#endif
