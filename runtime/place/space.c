/* Finds which cells of a chunk are inside of a model's space: the space's function is run at the middle of each. */
#include "runtime/place/space.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/module/code.h"
#include "runtime/number/run.h"
#include "runtime/place/model/terms.h"

enum { POINTS = 2 * TN_CHUNK_WIDTH }; /* of one run: two rows of a chunk */

struct tn_space {
    tn_cell_space cells;
    const tn_module *module;
    const uint8_t *code;
    const tn_function_record *function;
    double unit[3];
    tn_number_rows rows;
    const tn_kit_mask_record *masks[TN_KIT_MASKS_MAX]; /* those that the space asks for; the others are NULL */
    double *mask_rows;                                 /* [TN_KIT_MASKS_MAX][POINTS], where there are any */
    double x[POINTS], y[POINTS], z[POINTS], none[POINTS], values[POINTS];
    const double *columns[TN_PLACED_TERM_COUNT];
};

/* Is the cell one of the mask's? */
static bool mask_holds(const tn_module *module, const tn_kit_mask_record *mask, const int64_t cell[3])
{
    int64_t x = cell[0] - mask->low_x, y = cell[1] - mask->low_y, z = cell[2] - mask->low_z;
    if (x < 0 || y < 0 || z < 0 || x >= mask->size_x || y >= mask->size_y || z >= mask->size_z)
        return false;
    uint64_t bit = ((uint64_t)y * mask->size_z + (uint64_t)z) * mask->size_x + (uint64_t)x;
    return module->MASK_WORD_records[mask->word_first + bit / 64].bits >> bit % 64 & 1;
}

/* What the masks say of rows z and z + 1, from x on. */
static void look_at_masks(tn_space *space, int64_t x, int64_t y, int64_t z)
{
    for (size_t m = 0; space->mask_rows && m < TN_KIT_MASKS_MAX; m++) {
        for (int i = 0; space->masks[m] && i < POINTS; i++) {
            const int64_t cell[3] = {x + i % TN_CHUNK_WIDTH, y, z + i / TN_CHUNK_WIDTH};
            space->mask_rows[m * POINTS + (size_t)i] = mask_holds(space->module, space->masks[m], cell);
        }
    }
}

/* Which cells of rows z and z + 1 are outside. */
static tn_status look_at_rows(tn_space *space, int32_t z, uint64_t outside[2], tn_error *error)
{
    for (int i = 0; i < POINTS; i++)
        space->z[i] = (z + i / TN_CHUNK_WIDTH + 0.5) * space->unit[2];
    tn_status status = tn_number_run_rows(&space->rows, space->code, space->function->code_begin,
                                          space->function->stack_max, space->columns, POINTS, space->values, error);
    if (status != TN_OK)
        return status;
    outside[0] = outside[1] = 0;
    for (int i = 0; i < POINTS; i++)
        if (!(space->values[i] > 0))
            outside[i / TN_CHUNK_WIDTH] |= UINT64_C(1) << i % TN_CHUNK_WIDTH;
    return TN_OK;
}

static tn_status find_outside(void *context, const int32_t at[3], uint64_t row[TN_CHUNK_ROWS][TN_CHUNK_ROWS],
                              tn_error *error)
{
    tn_space *space = context;
    tn_status status = TN_OK;
    for (int i = 0; i < POINTS; i++)
        space->x[i] = ((double)at[0] * TN_CHUNK_WIDTH + i % TN_CHUNK_WIDTH + 0.5) * space->unit[0];
    for (int y = 0; y < TN_CHUNK_ROWS && status == TN_OK; y++) {
        for (int i = 0; i < POINTS; i++) /* heights are upwards, cells downwards */
            space->y[i] = -((double)at[1] * TN_CHUNK_ROWS + y + 0.5) * space->unit[1];
        for (int z = 0; z < TN_CHUNK_ROWS && status == TN_OK; z += 2) {
            look_at_masks(space, (int64_t)at[0] * TN_CHUNK_WIDTH, (int64_t)at[1] * TN_CHUNK_ROWS + y,
                          (int64_t)at[2] * TN_CHUNK_ROWS + z);
            status = look_at_rows(space, at[2] * TN_CHUNK_ROWS + z, &row[y][z], error);
        }
    }
    return status;
}

/* Which masks the space's function asks for. */
static tn_status find_masks(tn_space *space, tn_error *error)
{
    tn_instruction i;
    for (uint32_t offset = space->function->code_begin; offset < space->function->code_end; offset += i.length) {
        i = tn_code_read(space->code, offset);
        if (i.opcode != TN_OP_TERM || i.first < TN_PLACED_MASK)
            continue;
        size_t mask = (size_t)i.first - TN_PLACED_MASK;
        if (!space->mask_rows)
            space->mask_rows = calloc((size_t)TN_KIT_MASKS_MAX * POINTS, sizeof *space->mask_rows);
        if (!space->mask_rows)
            return tn_fail_memory(error);
        space->masks[mask] = &space->module->KIT_MASK_records[mask];
        space->columns[i.first] = space->mask_rows + mask * POINTS;
    }
    return TN_OK;
}

tn_status tn_space_new(const tn_place_rules *rules, tn_space **space, tn_error *error)
{
    const tn_kit_model_record *model = rules->space;
    tn_space *made = calloc(1, sizeof *made);
    *space = made;
    if (!made)
        return tn_fail_memory(error);
    made->cells = (tn_cell_space){
        .box = {{(int32_t)model->low_x, (int32_t)model->low_y, (int32_t)model->low_z},
                {(int32_t)model->high_x, (int32_t)model->high_y, (int32_t)model->high_z}},
        .outside = find_outside,
        .context = made,
    };
    made->module = rules->module;
    made->code = rules->module->code;
    made->function = &rules->module->FUNCTION_records[model->space];
    tn_place_unit(rules->module, made->unit);
    for (size_t i = 0; i < TN_PLACED_TERM_COUNT; i++)
        made->columns[i] = made->none;
    made->columns[TN_PLACED_X] = made->x;
    made->columns[TN_PLACED_Y] = made->y;
    made->columns[TN_PLACED_Z] = made->z;
    return find_masks(made, error);
}

void tn_space_free(tn_space *space)
{
    if (!space)
        return;
    tn_number_rows_clear(&space->rows);
    free(space->mask_rows);
    free(space);
}

const tn_cell_space *tn_space_cells(const tn_space *space)
{
    return &space->cells;
}

/* The bits of a row from one on and before another. */
static uint64_t bits_between(int32_t first, int32_t end)
{
    first = first < 0 ? 0 : first;
    if (first >= TN_CHUNK_WIDTH || end <= first)
        return 0;
    uint64_t below_end = end < TN_CHUNK_WIDTH ? (UINT64_C(1) << end) - 1 : UINT64_MAX;
    return below_end & ~((UINT64_C(1) << first) - 1);
}

/* The cells of a chunk that are inside of the space and of its box. */
static uint64_t count_chunk(const tn_space *space, const int32_t at[3], uint64_t outside[TN_CHUNK_ROWS][TN_CHUNK_ROWS])
{
    const tn_cell_box *box = &space->cells.box;
    uint64_t within = bits_between(box->low[0] - at[0] * TN_CHUNK_WIDTH, box->high[0] - at[0] * TN_CHUNK_WIDTH);
    uint64_t count = 0;
    for (int32_t y = 0; y < TN_CHUNK_ROWS; y++) {
        int32_t height = at[1] * TN_CHUNK_ROWS + y;
        for (int32_t z = 0; z < TN_CHUNK_ROWS && height >= box->low[1] && height < box->high[1]; z++) {
            int32_t depth = at[2] * TN_CHUNK_ROWS + z;
            if (depth >= box->low[2] && depth < box->high[2])
                count += (uint64_t)__builtin_popcountll(within & ~outside[y][z]);
        }
    }
    return count;
}

static int32_t chunk_of(int32_t cell, int size)
{
    return cell >= 0 ? cell / size : -((size - 1 - cell) / size);
}

tn_status tn_space_count(tn_space *space, tn_watch *watch, uint64_t *count, tn_error *error)
{
    static const int sizes[3] = {TN_CHUNK_WIDTH, TN_CHUNK_ROWS, TN_CHUNK_ROWS};
    uint64_t row[TN_CHUNK_ROWS][TN_CHUNK_ROWS];
    int32_t low[3], high[3], at[3];
    tn_status status = TN_OK;
    *count = 0;
    for (int k = 0; k < 3; k++) {
        low[k] = chunk_of(space->cells.box.low[k], sizes[k]);
        high[k] = chunk_of(space->cells.box.high[k] - 1, sizes[k]);
    }
    for (at[0] = low[0]; at[0] <= high[0]; at[0]++) {
        for (at[1] = low[1]; at[1] <= high[1]; at[1]++) {
            for (at[2] = low[2]; at[2] <= high[2] && status == TN_OK; at[2]++) {
                status = tn_watch_check(watch, error);
                if (status == TN_OK)
                    status = find_outside(space, at, row, error);
                if (status == TN_OK)
                    *count += count_chunk(space, at, row);
            }
            if (status != TN_OK)
                return status;
        }
    }
    return status;
}
