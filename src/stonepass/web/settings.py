"""Settings of the server: address, token, and limits of time, memory, rate and size."""

from __future__ import annotations

import ipaddress
from dataclasses import dataclass, field
from pathlib import Path

from stonepass.errors import BadInput, require

__all__ = [
    "HOST",
    "MOST_WORKERS",
    "PORT",
    "ServerLimits",
    "ServerSettings",
    "is_loopback",
    "is_unspecified",
]

HOST, PORT = "127.0.0.1", 8765
MOST_WORKERS = 64  # processes
SHORTEST_TOKEN = 16  # characters; a shorter token could be guessed
LOOPBACK_NAMES = ("localhost", "127.0.0.1", "[::1]")


@dataclass(frozen=True)
class ServerLimits:
    """Limits that keep the server in working order whatever its clients send.

    Attributes
    ----------
    head : int
        Largest number of bytes of the headers of a request.
    body : int
        Largest number of bytes of a JSON request.
    upload : int
        Largest number of bytes of an uploaded file.
    uploads : int
        Largest number of bytes of all uploaded files that are held in memory.
    upload_seconds : float
        Time in s after which an uploaded file that no job has used is dropped.
    header_seconds, body_seconds : float
        Times in s within which the header and the body of a request must have arrived.
    connections : int
        Largest number of open connections.
    waiting : int
        Largest number of jobs that wait for a worker process.
    finished : int
        Number of finished jobs whose results are kept.
    results : int
        Largest number of bytes of all kept results, as JSON; the newest one is always kept.
    result_seconds : float
        Time in s for which results are kept.
    job_seconds : float
        Time in s after which a running job is ended.
    job_memory : int
        Data of a worker process in bytes; it is enforced on Linux.
    idle_seconds : float
        Time in s after which an idle worker process is ended.
    per_minute : int
        Largest number of jobs, uploads and reports that one client may ask for in a minute.
    streams : int
        Largest number of open streams of events.
    """

    head: int = 32_768
    body: int = 256_000
    upload: int = 32_000_000
    uploads: int = 128_000_000
    upload_seconds: float = 600.0
    header_seconds: float = 10.0
    body_seconds: float = 30.0
    connections: int = 256
    waiting: int = 16
    finished: int = 128
    results: int = 32_000_000
    result_seconds: float = 3600.0
    job_seconds: float = 900.0
    job_memory: int = 4_000_000_000
    idle_seconds: float = 60.0
    per_minute: int = 120
    streams: int = 64


@dataclass(frozen=True)
class ServerSettings:
    """Address, token, folder of the solution cache, and limits of a server.

    Attributes
    ----------
    host : str
        Address that the server binds to.
    port : int
        Port, 1 to 65535; 0 lets the system choose one.
    token : str
        Secret that every request must have; empty for a loopback address only.
    names : tuple of str
        Further host names under which clients may address the server.
    workers : int
        Number of worker processes.
    cache_folder : Path or None
        Folder of the solution cache; None for no cache.
    limits : ServerLimits

    Raises
    ------
    BadInput
        The address is not of this machine alone and there is no token, the token is too short, or a
        number is out of bounds.
    """

    host: str = HOST
    port: int = PORT
    token: str = field(default="", repr=False)
    names: tuple[str, ...] = ()
    workers: int = 1
    cache_folder: Path | None = None
    limits: ServerLimits = field(default_factory=ServerLimits)

    def __post_init__(self) -> None:
        object.__setattr__(self, "host", self.host.strip("[]").lower())
        require(0 <= self.port <= 65535, "port", self.port, "a whole number from 0 to 65535")
        require(1 <= self.workers <= MOST_WORKERS, "workers", self.workers,
                f"a whole number from 1 to {MOST_WORKERS}")  # fmt: skip
        if self.token:
            good = len(self.token) >= SHORTEST_TOKEN and self.token.isascii()
            good = good and self.token.isprintable() and " " not in self.token
            allowed = f"at least {SHORTEST_TOKEN} ASCII characters long, without spaces"
            # The token is a secret and therefore not part of the message.
            require(good, "token", f"{len(self.token)} characters long", allowed)
        elif not is_loopback(self.host):
            raise BadInput("host", self.host, "a loopback address for a server without a token",
                           "other machines can reach other addresses")  # fmt: skip

    @property
    def allowed_hosts(self) -> frozenset[str]:
        """Host names, in lower case and without port, that a request may be addressed to."""
        names = {*LOOPBACK_NAMES, *(each.lower() for each in self.names)}
        if not is_unspecified(self.host):
            names.add(f"[{self.host}]" if ":" in self.host else self.host)
        return frozenset(names)


def is_loopback(host: str) -> bool:
    """Return True if only programs on this machine can reach an address."""
    if host.lower() == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


def is_unspecified(host: str) -> bool:
    """Return True for 0.0.0.0 and ::, which stand for all addresses of the machine."""
    try:
        return ipaddress.ip_address(host).is_unspecified
    except ValueError:
        return False
