"""What is refused about results that leave the service: certificates, exports, blocks for a memory."""

from service.core.errors import Conflict, Unprocessable


class CertificateRefused(Unprocessable):
    """A certificate is not, to the last byte, what a known key has signed."""

    code = "certificate-refused"
    title = "The certificate is not genuine"


class KeySetUnreadable(Unprocessable):
    """A key set is not there or is none."""

    code = "key-set-unreadable"
    title = "The key set cannot be read"


class ResultFailed(Conflict):
    """A result with the verdict FAIL leaves the service only where that is asked for."""

    code = "result-failed"
    title = "The result is a FAIL"


class FormatCannotSay(Unprocessable):
    """A format has no words for a result, and would say something else."""

    code = "format-cannot-say"
    title = "The format has no words for this result"


class BlockLayoutUnusable(Unprocessable):
    """A block's layout is missing, contradicts itself, or has no room for a value."""

    code = "block-layout-unusable"
    title = "The block's layout cannot be used"
