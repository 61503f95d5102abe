"""The state of a folder after a stop: which shards are complete, and which files are left over."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from stonepass.studies.sweeps.ledger import Entry, Ledger
from stonepass.studies.sweeps.shards import FOLDER, digest_of

__all__ = ["complete", "flaw_of", "sound"]


def sound(ledger: Ledger) -> tuple[Ledger, list[Entry]]:
    """Return the ledger without damaged blocks, and these blocks; remove files that it lacks.

    A file that the ledger does not name was written by a process that ended before it could enter
    the block. The cases of damaged blocks and of such files are solved again.

    Parameters
    ----------
    ledger : Ledger
        The ledger as it was read; the caller holds the lock of its folder.
    """
    damaged = [each for each in ledger.entries if not complete(ledger.folder, each)]
    kept = replace(ledger, entries=tuple(each for each in ledger.entries if each not in damaged))
    named = {ledger.folder / each.shard for each in kept.entries}
    for path in sorted((ledger.folder / FOLDER).rglob("*.parquet*")):
        if path not in named:
            with suppress(OSError):
                path.unlink()
    return kept, damaged


def complete(folder: Path, entry: Entry) -> bool:
    """Return True if the shard of a block exists and has the digest that the ledger states."""
    return not flaw_of(folder, entry)


def flaw_of(folder: Path, entry: Entry) -> str:
    """Return what is wrong with the shard of a block, as a clause; empty if it is complete."""
    try:
        content = (folder / entry.shard).read_bytes()
    except OSError:
        return f"'{entry.shard}' cannot be read"
    if len(content) != entry.size:
        return f"'{entry.shard}' has {len(content)} of {entry.size} bytes"
    return "" if digest_of(content) == entry.digest else f"bytes of '{entry.shard}' have changed"
