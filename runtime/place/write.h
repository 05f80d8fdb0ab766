/* A placed model as text: an LDraw file, a list of parts, and the program that made it. A failing stream is the
 * caller's to notice. */
#ifndef TARTAN_PLACE_WRITE_H
#define TARTAN_PLACE_WRITE_H

#include <stdio.h>

#include "runtime/place/steps.h"

/* What a model is called: of a kit the model's name, of a connection grammar the grammar's. */
const char *tn_place_model_name(const tn_place_rules *rules);

/* The comments with which a kit's LDraw file begins: its name, and how it was made. */
void tn_place_write_header(const tn_place_rules *rules, uint32_t seed, FILE *out);

/* One line a part, without a header; a step behind each part, or at the ends of `steps` where that is not NULL. For a
 * connection grammar as the published program writes them: every r is left out of parts' names. For a kit in its own
 * cells. */
void tn_place_write_ldraw(const tn_module *module, const tn_placed_model *model, const tn_placed_steps *steps,
                          FILE *out);

/* The same with a sub-file for each step, which the model refers to. name: of the model. */
void tn_place_write_mpd(const tn_module *module, const tn_placed_model *model, const tn_placed_steps *steps,
                        const char *name, FILE *out);

/* A frame's place in LDU, as LDraw has it (y points down): three numbers with this between. */
void tn_place_write_at(const tn_module *module, const tn_frame *frame, const char *between, FILE *out);
void tn_place_at(const tn_module *module, const tn_frame *frame, double at[3]);

/* Parts by name and colour, in the order of their first: part,colour,number; of a kit also title, mass and price. */
tn_status tn_place_write_list(const tn_module *module, const tn_placed_model *model, FILE *out, tn_error *error);

/* The steps that were taken (kept), as the grammar's author wrote them, separated by blanks; of a kit,
 * as connection grammars write them. */
void tn_place_write_program(const tn_placed_model *model, const tn_place_rules *rules, FILE *out);

/* A step of a kit as the terminals of a connection grammar; boxes have even sides. */
void tn_step_write(const tn_step *step, FILE *out);

/* A step as its author wrote it: `length` bytes of a source of the module; empty where the module does not say. */
const char *tn_step_text(const tn_place_rules *rules, const tn_step *step, size_t *length);

#endif
