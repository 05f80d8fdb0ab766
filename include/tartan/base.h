/* What all of Tartan's C interface shares: versions, errors, progress and cancelling, memory. tartan.h has the rules on
 * ownership, threads and options. */
#ifndef TARTAN_BASE_H
#define TARTAN_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define TARTAN_VERSION_MAJOR 0
#define TARTAN_VERSION_MINOR 2
#define TARTAN_VERSION_PATCH 0
#define TARTAN_VERSION "0.2.0"

#if defined(__GNUC__)
#define TARTAN_API __attribute__((visibility("default")))
#else
#define TARTAN_API
#endif

/* Defines NAME_init, which returns a NAME that has its size, and zeros. */
#define TARTAN_SIZED(NAME)                                                                                             \
    static inline NAME NAME##_init(void)                                                                               \
    {                                                                                                                  \
        NAME made;                                                                                                     \
        memset(&made, 0, sizeof made);                                                                                 \
        made.size = sizeof made;                                                                                       \
        return made;                                                                                                   \
    }

#ifdef __cplusplus
extern "C" {
#endif

/* The version of the library that runs, as TARTAN_VERSION is that of the header. */
TARTAN_API const char *tartan_version(void);

/* ---- errors */

typedef enum tartan_status {
    TARTAN_OK = 0,
    TARTAN_INVALID,  /* the rules, the input or an argument are wrong */
    TARTAN_IO,       /* a file could not be read or written */
    TARTAN_LIMIT,    /* an explicit limit was reached */
    TARTAN_MEMORY,   /* an allocation failed */
    TARTAN_INTERNAL, /* a mistake of Tartan's own */
    TARTAN_STOPPED,  /* a callback of the caller's wanted no more */
} tartan_status;

typedef struct tartan_error {
    tartan_status status;
    uint32_t code;     /* number of the diagnostic: 601 for E0601; 0 where it has none */
    uint32_t column;   /* byte of the line or sentence given that it is about, from 1; 0 where it is about none */
    char message[480]; /* one sentence */
    char help[320];    /* a likely fix, or empty; an option that it names is one of the command's, `tartan` */
} tartan_error;

/* ---- progress and cancelling */

/* Called now and then while a function works: at most some thirty times a second, and only on the thread that called
 * the function, also where that uses several. `done` of `total` units of work are done; total is 0 where nobody knows.
 * false ends the work: the function returns TARTAN_STOPPED, soon. It may use other objects, but not those that the
 * function works on. */
typedef bool tartan_go_on(void *context, double done, double total);

/* Functions that may take long take one of these, or NULL. */
typedef struct tartan_watch {
    size_t size;
    tartan_go_on *go_on; /* may be NULL */
    void *context;
    uint64_t memory_limit; /* bytes that the process may hold; past them the work ends (TARTAN_LIMIT). 0: any number */
} tartan_watch;
TARTAN_SIZED(tartan_watch)

/* At most so many threads are used, whatever is asked for. */
#define TARTAN_THREADS_MAX 256

/* ---- memory */

/* Frees a text, or a file in memory. NULL is fine, as for every _free. */
TARTAN_API void tartan_text_free(char *text);
TARTAN_API void tartan_bytes_free(void *bytes);

#ifdef __cplusplus
}
#endif

#endif
