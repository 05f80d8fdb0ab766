/* Houses by number: counting those of a library, and `#P:V`, variant V of the plan of rank P. */
#ifndef TARTAN_CLI_HOUSE_NUMBERED_H
#define TARTAN_CLI_HOUSE_NUMBERED_H

#include "cli/common/job.h"
#include "driver/measure/spread.h"
#include "runtime/geometry/camera.h"
#include "runtime/house/house.h"
#include "runtime/plan/library/library.h"

/* What the options say of the library of houses and of its plans. */
typedef struct tn_house_settings {
    const char *library; /* NULL: the only one */
    size_t max_length;
    tn_library_options plans;
    const char *const *wheres; /* the further requirements with which the file was opened */
    size_t where_count;
} tn_house_settings;

struct tn_written_settings;

/* What is counted: the houses of the library, or those on one plan (a plan line or #P; NULL: all plans). */
typedef struct tn_house_counting {
    const char *plan;
    bool clauses;                                                      /* and what each clause keeps out */
    const char *by;                                                    /* a measure that they are counted by, or NULL */
    void (*show)(tn_job *job, tn_spread *spread, const void *context); /* what is made of that */
    const void *context;
    bool json;
    const char *output;
} tn_house_counting;
void tn_job_count_houses(tn_job *job, const tn_house_settings *settings, const tn_house_counting *counting);

/* Writes different houses of the library, or of those on one plan, in the order of their ranks: each is drawn with the
 * same probability. */
void tn_job_sample_houses(tn_job *job, const tn_house_settings *settings, const char *plan, size_t wanted,
                          uint64_t seed, const struct tn_written_settings *written);

/* The most houses of a page. */
#define TN_HOUSES_DRAWN_MAX 200u

/* Small pictures of houses: the best by measures, the first of each of the best trade-offs, or so many drawn at random
 * with a seed. Their names, areas and costs, or their values, stand below. */
typedef struct tn_house_sheet {
    size_t wanted, columns;             /* columns: 0 for as many as look well */
    const struct tn_house_wishes *best; /* cli/house/best.h; or NULL */
    bool front;                         /* the best trade-offs, all of them */
    uint64_t seed;
    tn_camera camera;
    const char *title; /* NULL: what the form says of itself */
    const char *output;
    uint32_t dpi;
} tn_house_sheet;

/* Houses are seen from the front. */
static inline tn_camera tn_house_sheet_camera(void)
{
    return (tn_camera){60, 30, 480};
}

/* An error of usage where more than TN_HOUSES_DRAWN_MAX are wanted. */
void tn_job_draw_houses(tn_job *job, const tn_house_settings *settings, const tn_house_sheet *sheet);

/* The houses [from, to) by rank, at most `limit` where `limited`. */
typedef struct tn_house_range {
    const char *from, *to; /* digits; NULL: the first, all */
    uint64_t limit;
    bool limited;
} tn_house_range;

/* Writes the houses of the library, or of those on one plan, in the order of their ranks. */
void tn_job_list_houses(tn_job *job, const tn_house_settings *settings, const char *plan, const tn_house_range *range,
                        const struct tn_written_settings *written);

/* Appends a page about a library of houses, with so many of them drawn with the seed. False where that failed. */
bool tn_job_report_houses(tn_job *job, const tn_house_settings *settings, size_t wanted, uint64_t seed,
                          tn_buffer *page);

/* How two libraries of houses are compared: so many houses of each kind are shown, drawn with the seed; so many are
 * compared one by one (0: the default). */
typedef struct tn_house_comparing {
    size_t shown;
    uint64_t seed, one_by_one;
    bool json;
} tn_house_comparing;

/* Writes what `tartan diff` says of a library of houses in two files that are open. */
void tn_jobs_compare_houses(tn_job jobs[2], const char *const *paths, const tn_house_settings *settings,
                            const tn_house_comparing *comparing);

/* Writes the name #P:V of a house; of_all: #R, its rank among all houses of the library. */
void tn_job_rank_house(tn_job *job, const tn_house_settings *settings, const char *line, bool of_all);

/* Is the text #P:V, P:V or #R? */
bool tn_is_house_number(const char *text);

/* Calls `use` with the house of that name; of digits alone: of that rank among all of the library's. */
typedef void tn_house_use(tn_job *job, const tn_house *house);
void tn_job_use_house(tn_job *job, const tn_house_settings *settings, const char *number, tn_house_use *use);

/* Writes such a house: its line, or a JSON object. */
void tn_job_unrank_house(tn_job *job, const tn_house_settings *settings, const char *number, bool json);

/* Records that no library of houses has this name, with what was meant; NULL: that the file has none, or several. */
void tn_report_no_houses(tn_job *job, const char *name);

#endif
