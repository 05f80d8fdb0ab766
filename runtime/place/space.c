/* Finds which cells of a chunk are inside of a model's space: where intervals do not prove it for a whole block, the
 * space's function is run at the middle of each cell. */
#include "runtime/place/space.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/module/code.h"
#include "runtime/number/run.h"
#include "runtime/place/model/terms.h"

/* A block whose cells are looked at one by one, in one run. */
enum { BLOCK_WIDTH = 8, BLOCK_ROWS = 4, POINTS = BLOCK_WIDTH * BLOCK_ROWS * BLOCK_ROWS };

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

/* A block of the cells of a chunk. */
typedef struct block {
    int32_t low[3], size[3]; /* low: within the chunk */
} block;

/* Where the middle of a cell is; heights are upwards, cells downwards. */
static double middle_of(const tn_space *space, int axis, int64_t cell)
{
    double middle = ((double)cell + 0.5) * space->unit[axis];
    return axis == 1 ? -middle : middle;
}

/* What holds of all cells of the block: 1 inside, 0 outside; -1 where this cannot be told. */
static int judge(const tn_space *space, const int64_t low[3], const int32_t size[3])
{
    tn_interval terms[TN_PLACED_TERM_COUNT];
    for (size_t i = 0; i < TN_PLACED_TERM_COUNT; i++)
        terms[i] = i < TN_PLACED_MASK ? tn_interval_of(0) : (tn_interval){0, 1, false};
    static const int placed[3] = {TN_PLACED_X, TN_PLACED_Y, TN_PLACED_Z};
    for (int k = 0; k < 3; k++) {
        double first = middle_of(space, k, low[k]), last = middle_of(space, k, low[k] + size[k] - 1);
        terms[placed[k]] = (tn_interval){fmin(first, last), fmax(first, last), false};
    }
    tn_interval value = tn_number_bounds(space->code, space->function->code_begin, terms);
    if (tn_interval_is_none(value) || value.high <= 0)
        return 0;
    return value.low > 0 && !value.fails ? 1 : -1;
}

/* Looks at each cell of a block of POINTS cells. */
static tn_status look_at_cells(tn_space *space, const block *b, const int64_t low[3],
                               uint64_t row[TN_CHUNK_ROWS][TN_CHUNK_ROWS], tn_error *error)
{
    for (int i = 0; i < POINTS; i++) {
        const int64_t cell[3] = {low[0] + i % BLOCK_WIDTH, low[1] + i / BLOCK_WIDTH % BLOCK_ROWS,
                                 low[2] + i / (BLOCK_WIDTH * BLOCK_ROWS)};
        space->x[i] = middle_of(space, 0, cell[0]);
        space->y[i] = middle_of(space, 1, cell[1]);
        space->z[i] = middle_of(space, 2, cell[2]);
        for (size_t m = 0; space->mask_rows && m < TN_KIT_MASKS_MAX; m++)
            if (space->masks[m])
                space->mask_rows[m * POINTS + (size_t)i] = mask_holds(space->module, space->masks[m], cell);
    }
    tn_status status = tn_number_run_rows(&space->rows, space->code, space->function->code_begin,
                                          space->function->stack_max, space->columns, POINTS, space->values, error);
    for (int i = 0; i < POINTS && status == TN_OK; i++) {
        int32_t y = b->low[1] + i / BLOCK_WIDTH % BLOCK_ROWS, z = b->low[2] + i / (BLOCK_WIDTH * BLOCK_ROWS);
        if (!(space->values[i] > 0))
            row[y][z] |= UINT64_C(1) << (b->low[0] + i % BLOCK_WIDTH);
    }
    return status;
}

static void mark_outside(const block *b, uint64_t row[TN_CHUNK_ROWS][TN_CHUNK_ROWS])
{
    uint64_t bits = (b->size[0] < TN_CHUNK_WIDTH ? (UINT64_C(1) << b->size[0]) - 1 : UINT64_MAX) << b->low[0];
    for (int32_t y = 0; y < b->size[1]; y++)
        for (int32_t z = 0; z < b->size[2]; z++)
            row[b->low[1] + y][b->low[2] + z] |= bits;
}

/* Blocks of which intervals prove that they are inside or outside are not looked at cell by cell; others are halved. */
static tn_status look_at_block(tn_space *space, const block *b, const int32_t at[3],
                               uint64_t row[TN_CHUNK_ROWS][TN_CHUNK_ROWS], tn_error *error)
{
    static const int32_t least[3] = {BLOCK_WIDTH, BLOCK_ROWS, BLOCK_ROWS};
    int64_t low[3];
    for (int k = 0; k < 3; k++)
        low[k] = (int64_t)tn_cell_chunk_start(at[k], k) + b->low[k];
    int all = judge(space, low, b->size), axis = 0;
    if (all == 0)
        mark_outside(b, row);
    if (all >= 0)
        return TN_OK;
    for (int k = 1; k < 3; k++)
        if (b->size[k] / least[k] > b->size[axis] / least[axis])
            axis = k;
    if (b->size[axis] == least[axis])
        return look_at_cells(space, b, low, row, error);
    block half = *b;
    half.size[axis] /= 2;
    tn_status status = look_at_block(space, &half, at, row, error);
    half.low[axis] += half.size[axis];
    return status == TN_OK ? look_at_block(space, &half, at, row, error) : status;
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

/* Marks what is not in the space's box. */
static void mark_beyond(const tn_cell_box *box, const int32_t at[3], uint64_t row[TN_CHUNK_ROWS][TN_CHUNK_ROWS])
{
    int32_t start[3];
    for (int k = 0; k < 3; k++)
        start[k] = tn_cell_chunk_start(at[k], k);
    uint64_t within = bits_between(box->low[0] - start[0], box->high[0] - start[0]);
    for (int32_t y = 0; y < TN_CHUNK_ROWS; y++) {
        for (int32_t z = 0; z < TN_CHUNK_ROWS; z++) {
            bool in = y + start[1] >= box->low[1] && y + start[1] < box->high[1] && z + start[2] >= box->low[2] &&
                      z + start[2] < box->high[2];
            row[y][z] |= in ? ~within : UINT64_MAX;
        }
    }
}

static tn_status find_outside(void *context, const int32_t at[3], uint64_t row[TN_CHUNK_ROWS][TN_CHUNK_ROWS],
                              tn_error *error)
{
    const block whole = {.size = {TN_CHUNK_WIDTH, TN_CHUNK_ROWS, TN_CHUNK_ROWS}};
    const tn_space *space = context;
    memset(row, 0, TN_CHUNK_ROWS * sizeof *row);
    mark_beyond(&space->cells.box, at, row);
    return look_at_block(context, &whole, at, row, error);
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

/* The cells of a chunk that are inside of the space. */
static uint64_t count_chunk(uint64_t outside[TN_CHUNK_ROWS][TN_CHUNK_ROWS])
{
    uint64_t count = 0;
    for (int y = 0; y < TN_CHUNK_ROWS; y++)
        for (int z = 0; z < TN_CHUNK_ROWS; z++)
            count += (uint64_t)__builtin_popcountll(~outside[y][z]);
    return count;
}

tn_status tn_space_count(tn_space *space, tn_watch *watch, uint64_t *count, tn_error *error)
{
    uint64_t row[TN_CHUNK_ROWS][TN_CHUNK_ROWS];
    int32_t low[3], high[3], at[3];
    tn_status status = TN_OK;
    *count = 0;
    for (int k = 0; k < 3; k++) {
        low[k] = tn_cell_chunk_of(space->cells.box.low[k], k);
        high[k] = tn_cell_chunk_of(space->cells.box.high[k] - 1, k);
    }
    for (at[0] = low[0]; at[0] <= high[0]; at[0]++) {
        for (at[1] = low[1]; at[1] <= high[1]; at[1]++) {
            for (at[2] = low[2]; at[2] <= high[2] && status == TN_OK; at[2]++) {
                status = tn_watch_check(watch, error);
                if (status == TN_OK)
                    status = find_outside(space, at, row, error);
                if (status == TN_OK)
                    *count += count_chunk(row);
            }
            if (status != TN_OK)
                return status;
        }
    }
    return status;
}
