"""Valid and invalid requests that follow from the server's own description, by schemathesis."""

from __future__ import annotations

import warnings
from collections import Counter

import schemathesis
from hypothesis import HealthCheck, Phase, given, seed, settings
from schemathesis.generation import GenerationMode

SEED = 20221
TIMEOUT = 120.0  # s; a report takes as long as its job
UNKNOWN = 64 * "0"  # a well-formed id of an upload that does not exist
# Sections of valid cases, in turn. Every second request has them beside its other, generated
# sections. A surrogate covers the first and the second wall, but not the third one.
VALID = (
    {
        "stone": {"size_ratio": 1.2},
        "ureter": {"wall_ratio": 1.3},
        "method": {"accuracy": "fast", "seating": "frictionless"},
    },
    {
        "stone": {"size_ratio": 1.1},
        "ureter": {"wall_ratio": 1.5, "material": "latex"},
        "method": {"model": "direct", "accuracy": "fast"},
    },
    {
        "stone": {"size_ratio": 1.1},
        "ureter": {"wall_ratio": 1.05, "material": "latex"},
        "method": {"model": "direct", "accuracy": "fast"},
    },
)


def fuzz(address: str, count: int) -> Counter[tuple[str, int]]:
    """Send about `count` requests to a server on this machine.

    Parameters
    ----------
    address : str
        Address of the server, on the loopback interface.
    count : int
        Number of requests.

    Returns
    -------
    Counter
        Number of responses by operation and status.
    """
    assert address.startswith("http://127.0.0.1:")
    schema = schemathesis.openapi.from_url(f"{address}/api/v1/openapi.json")
    operations = [each.ok() for each in schema.get_all_operations()]
    found: Counter[tuple[str, int]] = Counter()
    for operation in operations:
        for mode in (GenerationMode.POSITIVE, GenerationMode.NEGATIVE):
            _ask(operation, mode, count // (2 * len(operations)), found)
    return found


def _ask(operation, mode, count, found) -> None:
    """Send requests to one operation and count the statuses of the responses."""
    asked = 0

    @seed(SEED)
    @settings(
        max_examples=count,
        deadline=None,
        database=None,
        phases=[Phase.generate],
        suppress_health_check=list(HealthCheck),
    )
    @given(case=operation.as_strategy(generation_mode=mode))
    def ask(case):
        nonlocal asked
        asked += 1
        # A report takes as long as its job, so that few of them are asked for.
        every = 20 if "report" in operation.label else 2
        if asked == 1 and operation.label == "POST /api/v1/jobs":
            case.body = {"kind": "friction", "upload": UNKNOWN}
        elif asked % every == 1 and mode is GenerationMode.POSITIVE:
            turn = asked // every
            _complete(case.body, VALID[turn // 3 % len(VALID)], 1 + turn % 3)
        response = case.call(timeout=TIMEOUT)
        found[operation.label, response.status_code] += 1

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            ask()
        except Exception as problem:  # an operation without inputs has no invalid requests
            if "Unsatisfiable" not in type(problem).__name__:
                raise


def _complete(body, valid, sections) -> None:
    """Put sections of a valid case into a request that has a case, in place of generated ones."""
    inner = body.get("question", body) if isinstance(body, dict) else None
    if isinstance(inner, dict) and isinstance(inner.get("case"), dict):
        inner["case"] |= dict(list(valid.items())[:sections])
        inner |= {key: text for key, text in {"limit": "6 kPa"}.items() if key in inner}
        inner.pop("stiffness", None)
        if sections > 1:
            inner["case"].pop("load", None)
