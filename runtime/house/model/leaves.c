/* Fills the openings of a house: doors with leaves, windows with panes. */
#include "runtime/house/model/model.h"

bool tn_house_hole(const tn_house *house, const tn_face *face, tn_box *hole)
{
    const tn_opening_record *o = tn_form_opening(house->form, face->kind);
    if (!o)
        return false;
    const tn_rectangle *at = &face->at;
    bool in_y = at->x0 == at->x1;
    int64_t half = tn_face_thickness(house, face) / 2, floor = house->form->level[face->storey];
    int64_t from = tn_opening_begins(face, o), to = from + o->wide;
    *hole = in_y ? (tn_box){at->x0 - half, at->x0 + half, from, to, 0, 0}
                 : (tn_box){from, to, at->y0 - half, at->y0 + half, 0, 0};
    hole->z0 = floor + o->sill;
    hole->z1 = hole->z0 + o->high;
    return true;
}

bool tn_house_is_filled(const tn_house *house, const tn_face *face)
{
    const tn_opening_record *opening = tn_form_opening(house->form, face->kind);
    return opening && !(opening->flags & TN_LEAFLESS);
}

/* As thick as wanted, or as the wall where that is thinner. */
static void make_thin(int64_t thick, int64_t *from, int64_t *to)
{
    int64_t over = (*to - *from - thick) / 2;
    if (over > 0) {
        *from += over;
        *to -= over;
    }
}

bool tn_house_filling(const tn_house *house, const tn_face *face, tn_solid *filling)
{
    tn_box hole;
    if (!tn_house_hole(house, face, &hole) || !tn_house_is_filled(house, face))
        return false;
    bool leaf = tn_form_opening(house->form, face->kind)->flags & TN_PASSAGE;
    int64_t thick = leaf ? TN_LEAF_NM : TN_PANE_NM;
    if (face->at.x0 == face->at.x1)
        make_thin(thick, &hole.x0, &hole.x1);
    else
        make_thin(thick, &hole.y0, &hole.y1);
    *filling =
        (tn_solid){.kind = leaf ? TN_SOLID_LEAF : TN_SOLID_PANE, .of = (uint32_t)(face - house->faces), .at = hole};
    return true;
}

tn_status tn_house_leaves(const tn_house *house, tn_solids *solids, tn_error *error)
{
    tn_status status = TN_OK;
    tn_solid filling;
    for (uint32_t i = 0; status == TN_OK && i < house->face_count; i++)
        if (tn_house_filling(house, &house->faces[i], &filling))
            status = tn_solids_add(solids, filling, error);
    return status;
}
