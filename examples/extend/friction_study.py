"""An additional study, as a file of `stonepass/studies` would define it: P_ucr over friction."""

from __future__ import annotations

from dataclasses import dataclass

from stonepass.model.case import Case
from stonepass.studies.jobs import PressureJob


@dataclass(frozen=True)
class FrictionRange:
    """The critical pressure of a case at several coefficients of friction.

    The outcome is a list of (friction, critical pressure in Pa, name of the outcome).
    """

    case: Case
    frictions: tuple[float, ...] = (0.1, 0.3, 0.5)

    def jobs(self):
        """Return one job for each coefficient; `run_study` decides where and with which cache."""
        return [PressureJob(self.case.with_friction(each)) for each in self.frictions]

    def reduce(self, results):
        """Collect the answers; `results` maps each job to its result, in any order."""
        answers = [results[job] for job in self.jobs()]
        return [
            (friction, answer.pressure, answer.outcome.name)
            for friction, answer in zip(self.frictions, answers, strict=True)
        ]
