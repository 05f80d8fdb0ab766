/* What `tartan enumerate` does with a kit: every building of so many of its parts, once. */
#ifndef TARTAN_CLI_PLACE_ENUMERATE_KIT_H
#define TARTAN_CLI_PLACE_ENUMERATE_KIT_H

#include "cli/common/job.h"

/* Writes a line for each building, or an object if `json`; if `path` ends in .mpd, a sub-file for each. */
void tn_job_enumerate_kit(tn_job *job, const tn_enumerate_request *request, bool json, const char *path);

#endif
