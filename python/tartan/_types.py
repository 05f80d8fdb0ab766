"""Types that signatures share."""
from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Callable, Optional, Sequence, Union

if TYPE_CHECKING:
    from tartan.libraries import Rule
    from tartan.plans import Plan

#: Told now and then how many units of work are done, of how many (0: nobody knows); what it raises ends the call.
Progress = Optional[Callable[[float, float], object]]
#: A plan as it may be given: a Plan, its line, or the numbers of its trays.
PlanLike = Union["Plan", str, Sequence[int]]
RuleLike = Union["Rule", str]
Path = Union[str, "os.PathLike[str]"]
#: numpy's array if numpy is there, else Python's own of the same numbers.
Array = Any
