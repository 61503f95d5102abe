"""The key of a remembered result: code without its prose, constants of nested laws."""

import ast
from dataclasses import dataclass
from pathlib import Path

import pytest

from stonepass.materials.neo_hookean import NeoHookean
from stonepass.materials.yeoh import Yeoh
from stonepass.studies import source_digest
from stonepass.studies.solution_cache import describe_law
from stonepass.studies.source_digest import code_digest, solver_digest

SOURCE = b'''"""A module."""
def half(x: float) -> float:
    """Halve."""
    return x / 2.0  # exactly
'''


def digest(source):
    return code_digest([(b"a.py", source)])


def test_prose_does_not_count_and_code_does():
    for old, new in (
        (b"Halve.", b"Divide by two."),
        (b"exactly", b"no rounding"),
        (b'"""A module."""', b""),
    ):
        assert digest(SOURCE.replace(old, new)) == digest(SOURCE)
    for old, new in ((b"2.0", b"3.0"), (b"half", b"third"), (b"x / 2.0", b"x * 2.0")):
        assert digest(SOURCE.replace(old, new)) != digest(SOURCE)
    assert code_digest([(b"b.py", SOURCE)]) != digest(SOURCE)


# Modules that the solver imports and that hold no formula: checks, messages, types.
WITHOUT_NUMBERS = {"array_dataclass", "array_types", "caution", "declaration", "errors", "result"}


def imported(path, root):
    """Return the files of the package that a file imports, anywhere in its code."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("stonepass"):
            base = root.parent / node.module.replace(".", "/")
            for name in (base, *(base / each.name for each in node.names)):
                yield from (
                    p for p in (name.with_suffix(".py"), name / "__init__.py") if p.exists()
                )


def test_every_source_of_the_solver_is_covered():
    """The digest covers every file that solver, models and laws import, in all packages."""
    names = {name.decode() for name, _ in source_digest._files()}
    root = Path(source_digest.__file__).parents[1]
    waiting = [root / "model/states/uncached.py", root / "studies/serialisation.py"]
    waiting += [p for each in ("model/models", "materials") for p in (root / each).glob("*.py")]
    reached = set()
    while waiting:
        path = waiting.pop()
        if path not in reached:
            reached.add(path)
            waiting += imported(path, root)
    expected = {p.relative_to(root).as_posix() for p in reached}
    assert len(expected) > 80
    assert {"fe/axisymmetric/contact.py", "model/states/seated.py", "strain.py"} <= expected
    assert expected - names == {f"{each}.py" for each in WITHOUT_NUMBERS}
    for folder in ("fe", "materials", "model"):
        assert {p.relative_to(root).as_posix() for p in (root / folder).rglob("*.py")} <= names


def test_the_version_of_the_numbers_counts(tmp_path, monkeypatch):
    before = solver_digest(tmp_path / "one")
    monkeypatch.setattr(source_digest, "NUMBERS", source_digest.NUMBERS + 1)
    assert solver_digest(tmp_path / "two") != before


def test_the_digest_is_remembered_by_the_files_as_they_are(tmp_path, monkeypatch):
    first = solver_digest(tmp_path)
    (remembered,) = tmp_path.iterdir()
    solver_digest.cache_clear()
    monkeypatch.setattr(source_digest, "code_digest", lambda files: pytest.fail("parsed again"))
    assert solver_digest(tmp_path) == first
    monkeypatch.undo()
    solver_digest.cache_clear()
    remembered.unlink()
    assert solver_digest(tmp_path) == first


def test_a_folder_that_cannot_be_written_is_no_failure(tmp_path):
    (tmp_path / "file").write_text("in the way")
    assert solver_digest(tmp_path / "file") == solver_digest(tmp_path / "elsewhere")


@dataclass(frozen=True)
class Together:
    parts: tuple


def test_laws_inside_laws_are_told_apart(monkeypatch):
    monkeypatch.setattr("stonepass.studies.solution_cache.LAWS", __name__.partition(".")[0])
    with pytest.raises(TypeError, match="cannot be described"):
        describe_law(NeoHookean(1e5))
    monkeypatch.undo()
    with pytest.raises(TypeError, match="a Together cannot be described"):
        describe_law(Together((NeoHookean(1e5),)))
    monkeypatch.setattr(Together, "__module__", "stonepass.materials.together")
    one, other = (Together((law,)) for law in (NeoHookean(1e5), Yeoh(1e5, 0.0, 0.0)))
    described = [describe_law(each) for each in (one, other, Together((NeoHookean(2e5),)))]
    assert described[0]["constants"]["parts"][0]["type"].endswith(".NeoHookean")
    assert len({str(each) for each in described}) == 3
    with pytest.raises(TypeError, match="cannot be described"):
        describe_law(Together((len,)))
