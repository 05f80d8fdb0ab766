/* How much memory there is, and how much of it the process holds: measured, so that what other libraries allocate
 * counts too. Who wants a limit sets it in a watch (watch.h). */
#ifndef TARTAN_BASE_MEMORY_H
#define TARTAN_BASE_MEMORY_H

#include <stdbool.h>
#include <stdint.h>

#define TN_MEMORY_UNKNOWN UINT64_MAX

/* Bytes that the process holds and nobody shares with it: no code, no mapped files. 0 if the system does not say. */
uint64_t tn_memory_used(void);

/* Bytes that the process could take now: the least of what the machine has free, of what each control group that it is
 * in leaves (versions 1 and 2), and of its own limits (ulimit -v, -d). TN_MEMORY_UNKNOWN if the system does not say.
 * root: "", or a folder that holds another /proc and /sys, for tests. */
uint64_t tn_memory_available(const char *root);

/* Does the system give so many bytes in one piece? For before a library is called that ends the program where it gets
 * none (GMP). */
bool tn_memory_can_have(uint64_t bytes);

/* The number for people: in megabytes, and from ten gigabytes on in those. */
void tn_memory_write(uint64_t bytes, char text[32]);

#endif
