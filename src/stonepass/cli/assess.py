"""``stonepass assess``: the stone and ureter of one patient, with how well they are known."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from stonepass.about import DISCLAIMER
from stonepass.cli.options import Cache, Json, NoCache, Workers, cache_folder

__all__ = ["command"]


def command(
    patient_file: Annotated[
        Path,
        typer.Argument(
            metavar="PATIENT.toml",
            help="Sizes as value ± uncertainty; see examples/patient.toml.",
        ),
    ],
    limit: Annotated[
        str | None,
        typer.Option("--limit", metavar="PRESSURE", help="Instead of the file's, e.g. 6kPa."),
    ] = None,
    json: Json = False,
    html: Annotated[
        Path | None,
        typer.Option("--html", metavar="REPORT.html", help="Write one page that prints on two."),
    ] = None,
    cache: Cache = None,
    no_cache: NoCache = False,
    workers: Workers = None,
) -> int:
    """Assess one patient: critical and present pressure as intervals, beside what cohorts saw.

    Limits with a source are 2, 4, 6, 8 and 12 kPa; the answer names it.
    """
    from stonepass.cli.terminal import counting, print_json, show, warn, writable

    writable(html, (".html", ".htm"))
    from stonepass.clinic.assess import assess
    from stonepass.clinic.patient import read_patient
    from stonepass.records.assess import CAUTION, assess_record
    from stonepass.report.assess_report import assess_tables, noise_in_words
    from stonepass.studies.case_solver import JobSolver
    from stonepass.studies.executor import CORES, process_pool

    patient = read_patient(patient_file)
    if limit is not None:
        patient = patient.with_limit(limit)
    folder = cache_folder(cache, no_cache)
    with process_pool(workers or CORES) as pool, counting("solving") as progress:
        found = assess(patient, JobSolver(pool, folder, progress))
    if json:
        print_json(assess_record(found, patient_file.name).to_dict())
    else:
        noise = f"Noise of the samples, one standard error: {noise_in_words(found)}."
        show(*assess_tables(found), f"{found.message} {CAUTION}", noise, DISCLAIMER)
        warn(found.warnings)
        warn([f"at the measured values {each}" for each in found.at_values.warnings])
    if html is not None:
        from stonepass.report.assess_page import write_assessment

        write_assessment(found, html)
    return 0 if found.outcome.answered else 1
