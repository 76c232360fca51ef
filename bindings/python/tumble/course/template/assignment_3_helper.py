"""Both helper functions under one name, for scripts that import them from here. You do not need to change this file."""

from assignment_3_render import assignment_3_render, render
from LCPSolve import LCPSolve

__all__ = ["LCPSolve", "assignment_3_render", "render"]
