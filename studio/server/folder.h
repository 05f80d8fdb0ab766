/* The folder that is served. Whatever a page or a rule file names, nothing outside of it is read or written: the kernel
 * resolves every path below the folder's descriptor (openat2, RESOLVE_BENEATH). Kernels without that walk step by step
 * and follow no links at all.
 *
 * Only regular files are read: others are opened without waiting for them, and closed again. A served folder owns its
 * descriptor; several threads may use it.
 */
#ifndef TARTAN_STUDIO_SERVER_FOLDER_H
#define TARTAN_STUDIO_SERVER_FOLDER_H

#include "driver/open/served.h"

enum {
    TN_TEXT_MAX = 4 << 20,        /* bytes of a text that a page reads or writes, as of a message */
    TN_NAMED_FILE_MAX = 64 << 20, /* and of a file that a rule file names */
};

typedef struct tn_studio_folder tn_studio_folder;

/* Of a file's bytes, in hexadecimal. Two texts with the same one are the same. */
typedef struct tn_file_hash {
    char text[33]; /* empty: there is no file */
} tn_file_hash;

/* TN_IO (E0901): there is no such folder, or it may not be read. */
tn_status tn_studio_folder_open(const char *path, bool read_only, tn_studio_folder **folder, tn_error *error);
void tn_studio_folder_close(tn_studio_folder *folder);

/* As on kernels without openat2. */
void tn_studio_folder_walk(tn_studio_folder *folder);

/* Where it lies, links resolved: for people to read. */
const char *tn_studio_folder_path(const tn_studio_folder *folder);
bool tn_studio_folder_read_only(const tn_studio_folder *folder);

/* Reads a file of at most `limit` bytes. The name may hold `..` that stay inside. The caller frees *bytes; a zero byte
 * follows them. TN_IO (E0901), TN_LIMIT (E0804). */
tn_status tn_studio_folder_read(const tn_studio_folder *folder, const char *name, size_t limit, uint8_t **bytes,
                                size_t *size, tn_error *error);

/* The hash of a file that a page reads (TN_TEXT_MAX bytes), empty where that cannot be read. */
tn_file_hash tn_studio_folder_hash(const tn_studio_folder *folder, const char *name);
tn_file_hash tn_hash_of_bytes(const void *bytes, size_t size);

/* Has the file been written since? A stamp that is the same says no, without reading the file. */
typedef struct tn_file_stamp {
    uint64_t file, size, changed; /* 0 all: there is no file */
} tn_file_stamp;
tn_file_stamp tn_studio_folder_stamp(const tn_studio_folder *folder, const char *name);

/* Is the name one of a rule file, plainly below the folder: no `.`, `..` or empty parts? Only such are listed, and read
 * and written by a page. TN_INVALID (E0904) says what is wrong. */
tn_status tn_studio_name_check(const char *name, tn_error *error);

/* Writes a rule file: beside it, synced and renamed over it. `seen` is the hash of what the writer believes to be
 * there, empty for a new file. If that is not there, nothing is written: TN_OK, and *now is what is there while
 * *conflict is true. Otherwise *now is the hash of the text. TN_IO (E0902), TN_INVALID (E0904), TN_MEMORY. */
tn_status tn_studio_folder_write(tn_studio_folder *folder, const char *name, const char *text, size_t size,
                                 const tn_file_hash *seen, tn_file_hash *now, bool *conflict, tn_error *error);

/* ---- what is there */

typedef struct tn_studio_file {
    char *name; /* below the folder */
    uint64_t size;
    const char *notation; /* "plan" */
} tn_studio_file;

typedef struct tn_studio_files {
    tn_studio_file *files; /* by name */
    size_t count, capacity;
    size_t entries; /* of folders, looked at so far */
    bool cut;       /* there is more than is looked at */
} tn_studio_files;

/* Lists the rule files, with the limits of lsp/workspace.h. Hidden folders and node_modules are passed over, and links
 * to folders. TN_MEMORY, TN_IO: the folder is gone. In all cases clear the list. */
tn_status tn_studio_folder_list(const tn_studio_folder *folder, tn_studio_files *list, tn_error *error);
void tn_studio_files_clear(tn_studio_files *list);

/* The folder as those who compile read it (driver/open/served.h); it outlives what is made here. */
tn_served tn_studio_folder_served(tn_studio_folder *folder);

#endif
