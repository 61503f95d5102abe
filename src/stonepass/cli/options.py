"""The options that several sub-commands share, made from the declared inputs of a case."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Collection
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, get_type_hints

import typer

from stonepass.declaration import DeclaredInput, Kind
from stonepass.errors import BadInput, Misplaced
from stonepass.inputs.catalogue import MODEL, all_inputs, models_with, option_of

if TYPE_CHECKING:
    from stonepass.model.case import Case

__all__ = [
    "STONE_SIZE",
    "Cache",
    "Json",
    "NoCache",
    "Settings",
    "Workers",
    "cache_folder",
    "takes_settings",
]

Cache = Annotated[
    Path | None,
    typer.Option(
        "--cache", metavar="DIR", help="Cache folder.  [default: the user's cache folder]"
    ),
]
NoCache = Annotated[bool, typer.Option("--no-cache", help="Neither read nor write the cache.")]
Workers = Annotated[
    int | None, typer.Option("--workers", min=1, help="Processes.  [default: all cores]")
]
Json = Annotated[bool, typer.Option("--json", help="JSON on stdout, and nothing else.")]

STONE_SIZE = ("stone.diameter", "stone.size_ratio")  # what a search over sizes has no use for
_TYPES = {Kind.NUMBER: float, Kind.WHOLE: int, Kind.FLAG: bool}
_CASE_FILE = Annotated[
    Path | None,
    typer.Argument(metavar="[CASE.toml]", help="Case file; command-line options override it."),
]
_FRICTION_FROM = Annotated[
    Path | None,
    typer.Option(
        "--friction-from",
        metavar="FILE.json",
        help="Take the friction from the JSON of 'stonepass friction'.",
    ),
]
# Titles of what belongs to no single input, in the words of the command line.
_MORE_WORDS = {
    "size of the stone": "stone size",
    "size of the ureter": "ureter size",
}
_REMEDIES = {
    "stone size": "given as --stone, or as --xi",
    "ureter size": "given as --inner with --outer or --wall-thickness, or as --eta",
}


def cache_folder(cache: Path | None, no_cache: bool) -> Path | None:
    """The cache folder that the options name; None for none."""
    from stonepass.studies.solution_cache import default_folder

    if no_cache and cache is not None:
        raise Misplaced("--cache", "--no-cache", "", "give one of the two")
    return None if no_cache else (cache or default_folder())


@dataclass(frozen=True)
class Settings:
    """What the options of a case say; a case file may say the rest.

    Attributes
    ----------
    given : dict
        Values of the options that were given, by the key of their input.
    case_file, friction_from : Path or None
    offered : frozenset of str
        Keys of the inputs that the command has options for.
    """

    given: dict[str, Any]
    case_file: Path | None = None
    friction_from: Path | None = None
    offered: frozenset[str] = frozenset()

    def case(self, **fixed: Any) -> Case:
        """Make the case; `fixed` has values that the command sets itself, by key with ``__``.

        Raises
        ------
        BadInput
            In the words of the command line.
        """
        from stonepass.inputs.build import build_case

        values = self._values() | {key.replace("__", "."): value for key, value in fixed.items()}
        if "method__model" in fixed:  # a comparison of several models has options of all of them
            from stonepass.inputs.overlay import of_other_models

            other = of_other_models(fixed["method__model"])
            values = {key: value for key, value in values.items() if key not in other}
        try:
            return build_case(values)
        except BadInput as problem:
            raise _in_options(problem) from problem

    def sizeless_case(self, size_ratio: float = 1.0) -> Case:
        """Make the case of a command that varies the size; the stone has `size_ratio`."""
        from stonepass.inputs.build import build_case

        values = {key: value for key, value in self._values().items() if key not in STONE_SIZE}
        try:
            return build_case(values | {"stone.size_ratio": size_ratio})
        except BadInput as problem:
            raise _in_options(problem) from problem

    @property
    def wetted(self) -> bool:
        """Whether the direct model is wetted, for commands that compare it with another."""
        return bool(self._values().get("method.wetted", False))

    def _values(self) -> dict[str, Any]:
        from stonepass.inputs.overlay import overlay, refuse_pairs

        given = dict(self.given)
        refuse_pairs(given, {key: option_of(key) for key in all_inputs()})
        if self.friction_from is not None:
            from stonepass.inputs.friction_file import read_friction

            if "stone.friction" in given:
                raise Misplaced("--friction-from", "--friction", "", "give one of the two")
            given["stone.friction"] = read_friction(self.friction_from)
        return overlay(self._file_values(), given)

    def _file_values(self) -> dict[str, Any]:
        """Values of the case file, its paths as seen from here."""
        if self.case_file is None:
            return {}
        from stonepass.inputs.case_file import read_case, values_of

        case = read_case(self.case_file)
        return values_of(case, Path.cwd())


def takes_settings(
    *left_out: str, models: Collection[str] = ()
) -> Callable[[Callable[..., int]], Callable[..., int]]:
    """Turn ``function(settings, own options…)`` into a command with the options of a case.

    Parameters
    ----------
    left_out : str
        Keys of inputs that the command has no options for.
    models : collection of str
        The models whose options the command has, without ``--model``; all models by default.
    """
    offered = {
        key: each
        for key, each in all_inputs().items()
        if key not in left_out and _belongs(each, models)
    }
    names = {each.name: key for key, each in offered.items()}

    def decorate(function: Callable[..., int]) -> Callable[..., int]:
        """Make the command of `function`."""
        own_hints = get_type_hints(function, include_extras=True)
        own = [p for p in inspect.signature(function).parameters.values() if p.name != "settings"]
        shared: dict[str, Any] = {"case_file": _CASE_FILE}
        shared |= {each.name: _option(each, models) for each in offered.values()}
        shared["friction_from"] = _FRICTION_FROM
        shared = {name: hint for name, hint in shared.items() if name not in own_hints}

        def command(**given: Any) -> int:
            file, friction = given.pop("case_file"), given.pop("friction_from")
            values = {names[n]: given.pop(n) for n in list(given) if n in names and n in shared}
            chosen = {key: value for key, value in values.items() if value is not None}
            return function(Settings(chosen, file, friction, frozenset(offered)), **given)

        command.__doc__ = function.__doc__
        command.__annotations__ = shared | {p.name: own_hints[p.name] for p in own}
        keyword = inspect.Parameter.KEYWORD_ONLY
        parameters = [
            *(inspect.Parameter(n, keyword, default=None, annotation=shared[n]) for n in shared),
            *(p.replace(kind=keyword, annotation=own_hints[p.name]) for p in own),
        ]
        command.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
        return command

    return decorate


def _belongs(each: DeclaredInput, models: Collection[str]) -> bool:
    if not models or each.section != "method":
        return True
    if each.key == MODEL:
        return False
    owners = models_with(each.name)
    return not owners or bool(set(owners) & set(models))


def _option(each: DeclaredInput, models: Collection[str]) -> Any:
    """The annotation of an option: type, names and help."""
    declaration = each.declaration
    kind = _TYPES.get(declaration.kind, str)
    text = declaration.meaning
    owners = models_with(each.name)
    if each.section == "method" and owners and len(owners) == 1 and len(models) != 1:
        text += f" Model '{owners[0]}' only."
    default = declaration.shown_default or ("" if each.default is None else _shown(each.default))
    if default:
        text += f"  [default: {default}]"
    option = typer.Option(
        declaration.option,
        metavar=declaration.metavar or "|".join(declaration.choices) or None,
        help=text,
    )
    return Annotated[kind | None, option]


def _shown(default: Any) -> str:
    if isinstance(default, float) and type(default) is not float:
        return f"{default / 1e3:g}kPa"
    return f"{default:g}" if isinstance(default, float) else str(default)


def _in_options(problem: BadInput) -> BadInput:
    """The refusal in the words of the command line."""
    from stonepass.inputs.build import in_words

    words = {each.title: option_of(key) for key, each in all_inputs().items()}
    found = in_words(problem, words | _MORE_WORDS)
    if found.argument in _REMEDIES and found.value == "missing":
        return BadInput(found.argument, "missing", _REMEDIES[found.argument])
    return found
