"""Table of published claims and computed values for a terminal."""

from __future__ import annotations

from collections.abc import Sequence

from rich import box
from rich.table import Table
from rich.text import Text

from stonepass.paper.section import Claim

__all__ = ["claims_table"]

_MARKS = {True: "yes", False: "NO", None: "–"}


def claims_table(claims: Sequence[Claim]) -> Table:
    """Return a table of claims, with the reason if one is not reproduced or not judged."""
    table = Table(box=box.SIMPLE_HEAD, title="Published claims", title_justify="left")
    for column in ("claim", "published", "ours", "reproduced"):
        table.add_column(column)
    for claim in claims:
        cells = (claim.what, claim.published, claim.ours, _MARKS[claim.holds])
        table.add_row(*map(Text, cells))
        if claim.holds is not True:
            table.add_row(Text(f"  {claim.reason}", "dim"))
    return table
