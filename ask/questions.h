/* Questions, requests and answers described for others: what requests.def says, as a JSON Schema, as types of
 * TypeScript, as a page. */
#ifndef TARTAN_ASK_QUESTIONS_H
#define TARTAN_ASK_QUESTIONS_H

#include <stdio.h>

/* A schema (draft 2020-12) with a definition for each message, and `requests` and `answers`, which say by a question's
 * name what its request and its answer are. */
void tn_describe_schema(FILE *out);

/* A declaration file: an interface for each message, and `Questions` from names to requests and answers. */
void tn_describe_types(FILE *out);

/* The page docs/requests.md. */
void tn_describe_page(FILE *out);

#endif
