"""The slow reference with one rule more: an opening does not fit where a lower roof stands above its sill.

use(ORACLES) loads the reference from ORACLES/house and returns it with the rule. The roofs are the solids that the reference itself
builds, and heights are exact fractions: nothing here is shared with the engines."""
import os
import sys
from fractions import Fraction as Q


def use(oracles):
    global ref, plain
    sys.path.insert(0, os.path.join(oracles, "house"))
    import house as ref

    plain, ref.face_options = ref.face_options, options
    return ref


def roofs(h):
    if not hasattr(h, 'lower_roofs'):
        kinds=[q.kind for q in h.faces]
        for q in h.faces: q.kind='floor' if q.rel=='above' else 'wall'
        _, prisms = ref.build(h, [None]*len(h.cells))
        for q,k in zip(h.faces,kinds): q.kind=k
        h.lower_roofs=[(h.cells[p['of']].storey, p['x'], [(Q(y),Q(z)) for y,z in p['profile']]) for p in prisms]
    return h.lower_roofs
def line_at(prof, y):
    for (a,p),(b,q) in zip(prof, prof[1:]):
        if a<=y<=b: return p+(q-p)*(y-a)/(b-a)
def highest(h,q,wide):
    """the highest point of a lower roof at the wall's outer side along the opening, or None"""
    g=h.form.wall//2; best=None
    v=q.x0==q.x1; m=((q.y0+q.y1 if v else q.x0+q.x1)-wide)//2
    for s,(x0,x1),prof in roofs(h):
        if s>=q.storey: continue
        y0,y1=prof[0][0],prof[-1][0]
        if v:
            X=q.x0+g if q.side=='right' else q.x0-g
            if not (x0<=X<x1 if q.side=='right' else x0<X<=x1): continue
            lo,hi=max(y0,Q(m)),min(y1,Q(m+wide))
            if lo>=hi: continue
            t=max([line_at(prof,lo),line_at(prof,hi)]+[z for y,z in prof if lo<y<hi])
        else:
            Y=q.y1+g if q.side=='front' else q.y0-g
            if not (y0<=Y<y1 if q.side=='front' else y0<Y<=y1): continue
            if max(x0,m)>=min(x1,m+wide): continue
            t=line_at(prof,Q(Y))
        if best is None or t>best: best=t
    return best
def options(h,q):
    if q.rel!='outside' or q.storey==0: return plain(h,q)
    f=h.form; base=sum(x for _,x in f.storeys[:q.storey]); saved=f.openings; L=max(q.x1-q.x0,q.y1-q.y0)
    new={}
    for n,o in saved.items():
        t=highest(h,q,o.wide) if o.wide+f.wall<=L else None
        if t is not None and t>base+o.sill:
            c=ref.File(); c.__dict__.update(o.__dict__); c.wide=1<<62; new[n]=c
        else: new[n]=o
    f.openings=new
    try: return plain(h,q)
    finally: f.openings=saved
