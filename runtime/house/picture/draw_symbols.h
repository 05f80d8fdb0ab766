/* Draws what stands in rooms as an architect knows it: in plans, seen from above. */
#ifndef TARTAN_HOUSE_DRAW_SYMBOLS_H
#define TARTAN_HOUSE_DRAW_SYMBOLS_H

#include "runtime/draw/paint.h"
#include "runtime/house/model/marks.h"

/* Paints the symbol of a thing with its corner at (x, y) of the page; points: a nanometre on paper. */
void tn_draw_symbol(tn_paint *paint, const tn_house_form *form, const tn_marked_item *item, double x, double y,
                    double points);

/* Is it fixed to pipes, flues or wires? */
bool tn_symbol_is_fixture(tn_item_symbol symbol);

#endif
