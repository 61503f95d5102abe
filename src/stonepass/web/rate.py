"""A limit of the number of expensive requests of each client."""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass
from math import ceil
from time import monotonic

from stonepass.web.answers import ProblemError

__all__ = ["RequestRate"]

CLIENTS = 1024  # number of clients that are remembered
MINUTE = 60.0


@dataclass
class _Bucket:
    """The number of requests that a client may still make, at some time."""

    left: float
    at: float


class RequestRate:
    """A token bucket for each client: a number of requests at once, refilled within a minute."""

    def __init__(self, per_minute: int) -> None:
        self._per_minute = per_minute
        self._buckets: OrderedDict[str, _Bucket] = OrderedDict()

    def take(self, client: str) -> None:
        """Count a request of a client.

        Raises
        ------
        ProblemError
            The client has asked too often; the header Retry-After says when it may ask again.
        """
        now = monotonic()
        bucket = self._buckets.setdefault(client, _Bucket(self._per_minute, now))
        self._buckets.move_to_end(client)
        while len(self._buckets) > CLIENTS:
            self._buckets.popitem(last=False)
        per_second = self._per_minute / MINUTE
        bucket.left = min(self._per_minute, bucket.left + per_second * (now - bucket.at))
        bucket.at = now
        if bucket.left < 1.0:
            wait = max(1, ceil((1.0 - bucket.left) / per_second))
            raise ProblemError(
                429,
                f"At most {self._per_minute} jobs, uploads and reports may be asked for in a "
                f"minute; ask again in {wait} s.",
                headers={"retry-after": str(wait)},
            )
        bucket.left -= 1.0
