"""The kinds of files that are searched, a row each. As a program it prints their names."""
from fields import FIELDS
from plan_kinds import HOUSES, PLANS
from solids import SOLIDS

KINDS = {kind.name: kind for kind in (PLANS, HOUSES, FIELDS, SOLIDS)}

if __name__ == "__main__":
    print(*KINDS)
