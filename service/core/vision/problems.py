"""What can be wrong with a picture of a target or with the target itself, as errors for a caller.

All others: `core.errors`.
"""

from service.core.errors import Unprocessable


class TargetOverexposed(Unprocessable):
    """Most of the target's bright squares are saturated."""

    code = "target-overexposed"
    title = "The target is overexposed"
