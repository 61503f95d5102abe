"""The claims of the paper, each with its tolerance, and the sensitivity table."""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path
from tempfile import TemporaryDirectory

from page import Check, Section

from stonepass.paper.inputs import LIMIT
from stonepass.paper.run import WITH_CLAIMS, reproduce
from stonepass.paper.section import Asked, Claim
from stonepass.studies.executor import process_pool

INTERVAL = 15.0  # seconds between lines of progress


def section() -> Section:
    last = time.monotonic()

    def told(done: int, total: int) -> None:
        nonlocal last
        if time.monotonic() - last >= INTERVAL:
            last = time.monotonic()
            print(f"paper: {done} of {total}", file=sys.stderr, flush=True)

    with TemporaryDirectory() as folder, process_pool(os.cpu_count() or 1) as pool:
        names = [*WITH_CLAIMS, "sensitivity"]
        parts = reproduce(names, Path(folder), Asked(LIMIT), pool, progress=told)
        rows = (Path(folder) / "sensitivity.csv").read_text(encoding="utf-8").splitlines()[1:]
    claims = [claim for part in parts for claim in part.claims]
    judged = [claim for claim in claims if claim.holds is not None]
    return Section(
        title="The paper's claims",
        text=(
            "`stonepass paper` computes every claim of the paper that is a number or a statement "
            "about numbers. Only the published values are constants of the code. A claim holds if "
            "the deviation is within its tolerance. Some claims cannot be judged without the "
            "Supporting Information, which is not published."
        ),
        tables=[
            ("Reasons for the tolerances:", ("claim", "published", "reason"),
             [[c.what, c.published, c.reason] for c in judged]),
            ("Claims that cannot be judged:", ("claim", "published", "reason"),
             [[c.what, c.published, c.reason] for c in claims if c.holds is None]),
            ("ξ_cr at 12 kPa for each alternative where the paper leaves a choice:",
             ("subject", "alternative", "η", "outcome", "ξ_cr", "±", "change"),
             [shortened(row.split(",")) for row in rows]),
        ],
        checks=[Check(claim.what, measured(claim), bool(claim.holds)) for claim in judged],
    )  # fmt: skip


def measured(claim: Claim) -> str:
    if claim.tolerance is None or claim.deviation is None:
        return claim.ours
    return f"{claim.ours}; deviation {claim.deviation:+.3g}, tolerance ± {claim.tolerance:.3g}"


def shortened(row: list[str]) -> list[str]:
    """Return a row whose numbers have four digits; an alternative can contain a comma."""
    about, *choice, eta, outcome, size, error, change = row
    what = ",".join(choice).strip('"')
    numbers = [f"{float(value):.4f}" if value else "–" for value in (size, error, change)]
    return [about, what, eta, outcome, *numbers]
