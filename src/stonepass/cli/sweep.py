"""``stonepass sweep``: solve the cases of a study file and store every result."""

from __future__ import annotations

from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stonepass.cli.help import OUTPUT, QUESTION, SOLVER, epilog
from stonepass.cli.options import Workers
from stonepass.errors import Misplaced

if TYPE_CHECKING:
    from stonepass.studies.sweeps.run import Standing

__all__ = ["EPILOG", "command"]

EPILOG = epilog(
    (
        (
            "sweep examples/sweep.toml --out study",
            "solve all cases of this study file, and write their results to the folder 'study'",
        ),
        (
            "sweep examples/sweep.toml --out study --resume",
            "go on where the study stopped",
        ),
    ),
    "0 every case has an answer; 1 some case has none, and its row says why; 2 the request was "
    "refused; 3 the program failed in some case, which its row names",
)


def command(
    study: Annotated[
        Path,
        typer.Argument(
            metavar="STUDY.toml",
            help="Study file: a case file with the section [vary].",
            rich_help_panel=QUESTION,
        ),
    ],
    out: Annotated[
        Path,
        typer.Option("--out", metavar="DIR", help="Folder of the results.", rich_help_panel=OUTPUT),
    ],
    resume: Annotated[
        bool,
        typer.Option(
            "--resume",
            help="Go on with the study whose results are in the folder.",
            rich_help_panel=OUTPUT,
        ),
    ] = False,
    accuracy: Annotated[
        str | None,
        typer.Option(
            "--accuracy",
            metavar="fast|standard|reference",
            help="How fine the meshes are, in the place of the study file.",
            rich_help_panel=SOLVER,
        ),
    ] = None,
    workers: Workers = None,
    scheduler: Annotated[
        str | None,
        typer.Option(
            "--scheduler",
            metavar="ADDRESS",
            help="Solve on a Dask cluster, e.g. tcp://10.0.0.1:8786, in the place of --workers.",
            rich_help_panel=SOLVER,
        ),
    ] = None,
    max_days: Annotated[
        float | None,
        typer.Option(
            "--max-days",
            min=0.0,
            metavar="DAYS",
            help="Longest expected duration that is accepted.  [default: 3]",
            rich_help_panel=SOLVER,
        ),
    ] = None,
) -> int:
    """Solve all cases of a study file; every case becomes a row with its answer or the reason.

    The results are stored as they are finished, so that a study that was stopped goes on later.
    """
    if scheduler is not None and workers is not None:
        raise Misplaced("--workers", "--scheduler", "", "the cluster has its own workers")
    from stonepass.cli.terminal import note, show, warn
    from stonepass.studies.sweeps.results import read_results
    from stonepass.studies.sweeps.sweep_file import read_sweep

    plan = read_sweep(study)
    if accuracy is not None:
        plan = _with_accuracy(plan, accuracy)
    standing = _run(plan, out, resume, workers, scheduler, max_days)
    from stonepass.report.sweep_report import sweep_sentences, sweep_tables, sweep_warnings

    found = read_results(out)
    show(*sweep_tables(found), *sweep_sentences(found))
    warn(sweep_warnings(found))
    note(f"'stonepass results {out}' shows these results again, and writes them as tables")
    if standing.faults:
        return 3
    return 1 if standing.unanswered else 0


def _with_accuracy(plan: Any, accuracy: str) -> Any:
    from stonepass.declaration import read_declared
    from stonepass.inputs.catalogue import all_inputs

    declaration = all_inputs()["method.accuracy"].declaration
    return plan.with_accuracy(read_declared(declaration, "--accuracy", accuracy))


def _run(
    plan: Any,
    out: Path,
    resume: bool,
    workers: int | None,
    scheduler: str | None,
    max_days: float | None,
) -> Standing:
    """Run the sweep; if it is stopped, say how far it is and how it goes on."""
    from stonepass.cli.case_progress import counting_cases
    from stonepass.cli.terminal import note
    from stonepass.studies.executor import CORES
    from stonepass.studies.sweeps.advice import DAYS
    from stonepass.studies.sweeps.run import Standing, SweepWords, run_sweep

    last = Standing(0, plan.cases)
    with ExitStack() as stack:
        executor, count = None, workers or min(CORES, max(1, plan.cases // 6))
        if scheduler is not None:
            from stonepass.studies.sweeps.cluster import cluster

            executor = stack.enter_context(cluster(scheduler))
            count = executor.count
        show = stack.enter_context(counting_cases())

        def tell(now: Standing) -> None:
            nonlocal last
            last = now
            show(now)

        try:
            words = SweepWords("--out", "--resume", "--max-days")
            days = DAYS if max_days is None else max_days
            return run_sweep(plan, out, executor=executor, workers=count, resume=resume,
                             max_days=days, tell=tell, words=words)  # fmt: skip
        except Exception:
            raise
        except BaseException:  # Ctrl-C, or the system asks this process to end
            stack.close()
            note(
                f"{last.finished} of {last.cases} cases are finished and kept in '{out}'; the same "
                "command with --resume goes on"
            )
            raise
