"""Design rules: what a stitch plan must keep to, a rule or a family of rules a file."""

from patterns.rules.outline import check_outline
from patterns.rules.run import RULES, check_plan

__all__ = ["RULES", "check_outline", "check_plan"]
