"""``stonepass assess``: the stone of one patient, with the uncertainty of every measurement."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from stonepass.about import DISCLAIMER
from stonepass.cli.help import OUTPUT, QUESTION, SOLVER, epilog
from stonepass.cli.options import Cache, Json, NoCache, Workers, cache_folder, option_for
from stonepass.model.pressure_limit import PRESSURE_LIMIT

if TYPE_CHECKING:
    from stonepass.clinic.patient import Patient
    from stonepass.model.answer import Answer
    from stonepass.model.case import Case

__all__ = ["EPILOG", "command"]

SECONDS = 120.0  # one process, an empty cache
EPILOG = epilog(
    (
        (
            "assess examples/patient.toml --html report.html",
            "critical and present pressure as intervals, and a report to print",
        ),
        (
            "assess examples/patient.toml --limit 12kPa --json",
            "another maximum tolerable pressure, as JSON",
        ),
    ),
    "0 assessed; 1 the model has no answer for too many of the cases; 2 the request was refused; "
    "3 an error of the program",
)


def command(
    patient_file: Annotated[
        Path,
        typer.Argument(
            metavar="PATIENT.toml",
            help="Measurements with their uncertainties, as in examples/patient.toml.",
            rich_help_panel=QUESTION,
        ),
    ],
    limit: Annotated[
        str | None,
        option_for(
            PRESSURE_LIMIT,
            QUESTION,
            meaning="Maximum tolerable urine pressure instead of that of the file, e.g. 6kPa.",
        ),
    ] = None,
    json: Json = False,
    html: Annotated[
        Path | None,
        typer.Option(
            "--html",
            metavar="REPORT.html",
            help="Write a report as one HTML file that can be read on a phone and printed.",
            rich_help_panel=OUTPUT,
        ),
    ] = None,
    solve: Annotated[
        bool,
        typer.Option(
            "--solve",
            help="Solve about fifty cases although a surrogate of the package covers the inputs.",
            rich_help_panel=SOLVER,
        ),
    ] = False,
    cache: Cache = None,
    no_cache: NoCache = False,
    workers: Workers = None,
) -> int:
    """Assess the stone of one patient, with the uncertainty of every measurement.

    The result has intervals of the critical and of the present urine pressure, and what happened to
    stones of this size and place in published cohorts. It is not a probability of passage.
    Published pressures that may serve as the limit are 2, 4, 6, 8 and 12 kPa.
    """
    from stonepass.cli.terminal import print_json, show, warn, writable, wrote

    writable(html, (".html", ".htm"))
    patient = _patient(patient_file, limit)
    from stonepass.clinic.assess import assess
    from stonepass.clinic.decisions import CONTRADICTIONS
    from stonepass.records.assess import CAUTION, assess_record
    from stonepass.report.assess_report import assess_summary, assess_tables
    from stonepass.studies.executor import CORES

    solver = _Solver(cache_folder(cache, no_cache), workers or CORES)
    found = assess(patient, solver, surrogates=not solve)
    if json:
        print_json(assess_record(found, patient_file.name).to_dict())
    else:
        # Contradictions stand at the head of the result itself.
        warn(each for each in found.warnings if each.code not in CONTRADICTIONS)
        if found.at_values is not None:
            warn([f"at the measured values {each}" for each in found.at_values.warnings])
        show(*assess_summary(found), *assess_tables(found), CAUTION, DISCLAIMER)
    if html is not None:
        from stonepass.report.assess_page import write_assessment

        write_assessment(found, html)
        wrote(html)
    return 0 if found.outcome.answered else 1


class _Solver:
    """A case solver that starts its processes when it is first needed, and shows its progress."""

    def __init__(self, folder: Path | None, workers: int) -> None:
        self.folder, self.workers = folder, workers
        self.announced = False

    def answers(self, cases: Sequence[Case], *, error: bool = True) -> list[Answer]:
        """Return the answer of every case; see `stonepass.studies.case_solver.CaseSolver`."""
        from stonepass.cli.terminal import announce, counting
        from stonepass.studies.case_solver import JobSolver
        from stonepass.studies.executor import process_pool

        if not self.announced:
            seconds = SECONDS / self.workers
            announce("solving about fifty cases", seconds, remembers=self.folder is not None)
            self.announced = True
        count = min(self.workers, len(cases))
        with process_pool(count) as pool, counting("solving the cases") as progress:
            return JobSolver(pool, self.folder, progress).answers(cases, error=error)


def _patient(path: Path, limit: str | None) -> Patient:
    """Read the patient's file; `limit` replaces the limit of the file."""
    from stonepass.clinic.patient import read_patient
    from stonepass.errors import BadInput

    patient = read_patient(path)
    if limit is None:
        return patient
    try:
        return patient.with_limit(limit)
    except BadInput as problem:
        raise problem.named("--limit") from problem
