"""The kinds of files that are searched, a row each. As a program it prints their names."""
from fields import FIELDS
from grammars import GRAMMARS
from hemls import HEMLS
from kits import KITS
from pcfg import PCFG
from plan_kinds import HOUSES, PLANS, SEARCHED
from solids import SOLIDS
from studies import STUDIES

KINDS = {kind.name: kind for kind in (PLANS, SEARCHED, HOUSES, FIELDS, SOLIDS, KITS, PCFG, GRAMMARS, HEMLS, STUDIES)}

if __name__ == "__main__":
    print(*KINDS)
