"""What can be wrong with a target, its print or a picture of it, as errors for a caller.

All others: `core.errors`.
"""

from service.core.errors import Unprocessable


class TargetOverexposed(Unprocessable):
    """Most of the target's bright squares are saturated."""

    code = "target-overexposed"
    title = "The target is overexposed"


class PaperUnusable(Unprocessable):
    """A target does not fit on the paper, or the paper is none."""

    code = "paper-unusable"
    title = "The target cannot be printed on this paper"
