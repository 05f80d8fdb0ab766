/* How a text asks for a file of the LDraw library that the user has: by a request with this extension, whose path is the
 * file's name there (resolver.h, tn_attachments.bytes). TN_IO, E0901, where there is none. */
#ifndef TARTAN_COMPILER_COMMON_LDRAW_LIBRARY_H
#define TARTAN_COMPILER_COMMON_LDRAW_LIBRARY_H

#define TN_LDRAW_LIBRARY ".dat"

#endif
