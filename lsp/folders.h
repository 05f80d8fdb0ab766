/* The rule files of the folders that an editor has open. Owns its texts. */
#ifndef TARTAN_LSP_FOLDERS_H
#define TARTAN_LSP_FOLDERS_H

#include <stdbool.h>
#include <stddef.h>

typedef struct tn_rule_files {
    char **paths; /* real ones, in no order; a file may be there twice */
    size_t count, capacity;
    size_t entries; /* of folders, looked at so far */
    bool cut_off;   /* there is more than is looked at */
    bool failed;    /* out of memory */
} tn_rule_files;

#define TN_FOLDER_DEPTH_MAX 16u
#define TN_FOLDER_ENTRIES_MAX 20000u /* some 20 ms */

/* Adds the .plan files of a folder, and of the folders in it to the depth given (0: of it alone). Hidden ones and
 * node_modules are passed over, links to folders are not followed. A folder that cannot be read has none. */
void tn_rule_files_find(tn_rule_files *files, const char *folder, unsigned depth);
void tn_rule_files_clear(tn_rule_files *files);

#endif
