/* Houses as rows of tables: one of houses, with what was chosen and measured, one of their rooms and one of their
 * faces.
 *
 * Columns have one unit each, which their names end in: net_m2, or net_sf of forms in feet. The rows of rooms and faces
 * name their house by its number. A tn_house_tables borrows the form, and belongs to one thread.
 */
#ifndef TARTAN_DRIVER_HOUSE_TABLES_H
#define TARTAN_DRIVER_HOUSE_TABLES_H

#include <gmp.h>

#include "runtime/house/house_names.h"

typedef enum tn_house_table { TN_TABLE_HOUSES, TN_TABLE_ROOMS, TN_TABLE_FACES, TN_HOUSE_TABLES } tn_house_table;

typedef enum tn_column_kind { TN_COLUMN_TEXT, TN_COLUMN_WHOLE, TN_COLUMN_REAL } tn_column_kind;

typedef struct tn_house_column {
    const char *name; /* owned by the tables */
    tn_column_kind kind;
} tn_house_column;

typedef struct tn_house_tables tn_house_tables;

/* max_length: of a plan, in trays. */
tn_status tn_house_tables_new(const tn_house_form *form, size_t max_length, tn_house_tables **tables, tn_error *error);
void tn_house_tables_free(tn_house_tables *tables);

/* "houses", "rooms", "faces"; and the columns. */
const char *tn_house_table_name(tn_house_table table);
const tn_house_column *tn_house_table_columns(const tn_house_tables *tables, tn_house_table table, size_t *count);

/* Takes a row: a text for each column, NULL where it has no value; all are borrowed for the call. */
typedef tn_status tn_house_row(void *context, tn_house_table table, const char *const *cells, tn_error *error);

/* Calls `row` with the rows of a house: its own, then its rooms, then its faces. number: that of the house among those
 * that are written; rank: among those of the library, or NULL; plan: the rank of its plan, or NULL. Ranks
 * are texts, since they may have more digits than numbers of databases. */
tn_status tn_house_tables_add(tn_house_tables *tables, const tn_house *house, uint64_t number, mpz_srcptr rank,
                              mpz_srcptr plan, tn_house_row *row, void *context, tn_error *error);

#endif
