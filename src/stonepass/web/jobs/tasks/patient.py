"""The job that assesses the stone of one patient."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from stonepass.clinic.assess import assess
from stonepass.clinic.patient import patient_of
from stonepass.records.assess import assess_record
from stonepass.report.assess_page import assessment_page
from stonepass.studies.case_solver import JobSolver
from stonepass.web.jobs.bodies import AssessJob
from stonepass.web.jobs.context import Context, Done

__all__ = ["TASKS"]

FILE = "the request"  # stands in the record where the command line has the name of the file


def _assess(request: Mapping[str, Any], context: Context) -> Done:
    """Return the record of the assessment and, if asked, the report to print."""
    body = AssessJob.model_validate(request)

    def told(done: int, total: int) -> None:
        context.tell(done, total, f"Solving the cases: {done} of {total} are done.")

    solver = JobSolver(None, context.cache_folder, told)
    found = assess(patient_of(body.patient), solver, surrogates=not body.solve)
    page = ""
    if context.format:
        context.tell(0, 0, "Writing the report.")
        page = assessment_page(found)
    return Done(assess_record(found, FILE).to_dict(), page)


TASKS = {"assess": _assess}
