"""Options that several sub-commands share, made from the declared inputs of a case."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Collection, Mapping
from dataclasses import MISSING, dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, get_type_hints

import typer
from typer.models import OptionInfo

from stonepass.cli.help import MODEL_PANEL, OUTPUT, QUESTION, SOLVER, STONE, URETER
from stonepass.declaration import DeclaredInput, Kind
from stonepass.errors import BadInput, Misplaced
from stonepass.inputs.catalogue import MODEL, all_inputs, models_with, option_of
from stonepass.model.models.registry import MODELS

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
    "complete_material",
    "model_input",
    "option_for",
    "takes_settings",
]

Cache = Annotated[
    Path | None,
    typer.Option(
        "--cache",
        metavar="DIR",
        help="Folder of solved states.  [default: the user's cache folder]",
        rich_help_panel=SOLVER,
    ),
]
NoCache = Annotated[
    bool,
    typer.Option(
        "--no-cache", help="Neither read nor write the cache folder.", rich_help_panel=SOLVER
    ),
]
Workers = Annotated[
    int | None,
    typer.Option(
        "--workers",
        min=1,
        metavar="INTEGER",
        help="Number of processes.  [default: all cores]",
        rich_help_panel=SOLVER,
    ),
]
Json = Annotated[
    bool,
    typer.Option(
        "--json", help="Print the result as JSON, and nothing else.", rich_help_panel=OUTPUT
    ),
]


STONE_SIZE = ("stone.diameter", "stone.size_ratio")  # inputs that a search over sizes replaces
_TYPES = {Kind.NUMBER: float, Kind.WHOLE: int, Kind.FLAG: bool}
_METAVARS = {
    Kind.NUMBER: "NUMBER",
    Kind.WHOLE: "INTEGER",
    Kind.LENGTH: "LENGTH",
    Kind.PRESSURE: "PRESSURE",
    Kind.AREA: "AREA",
}
_PANELS = {"stone": STONE, "ureter": URETER, "load": URETER}
_CASE_FILE = Annotated[
    Path | None,
    typer.Argument(
        metavar="CASE.toml",
        help="Case file. Command-line options override its values.",
        rich_help_panel=QUESTION,
    ),
]
_FRICTION_FROM = Annotated[
    Path | None,
    typer.Option(
        "--friction-from",
        metavar="FILE.json",
        help="Take the friction coefficient from a result of 'stonepass friction --json'.",
        rich_help_panel=STONE,
    ),
]
# Subjects of messages that concern more than one input, as the command line names them.
_MORE_WORDS = {
    "size of the stone": "stone size",
    "size of the ureter": "ureter size",
}
_REMEDIES = {
    "stone size": "given as --stone, or as --xi",
    "ureter size": "given as --inner with --outer or --wall-thickness, or as --eta",
}


def cache_folder(cache: Path | None, no_cache: bool) -> Path | None:
    """Return the cache folder that the options choose; None without a cache."""
    from stonepass.studies.solution_cache import default_folder

    if no_cache and cache is not None:
        raise Misplaced("--cache", "--no-cache", "", "give one of the two")
    return None if no_cache else (cache or default_folder())


@dataclass(frozen=True)
class Settings:
    """The options of a case that were given; a case file may have the other values.

    Attributes
    ----------
    given : dict
        Values of the given options by the key of their input.
    case_file, friction_from : Path or None
    offered : frozenset of str
        Keys of the inputs that the command has options for.
    """

    given: dict[str, Any]
    case_file: Path | None = None
    friction_from: Path | None = None
    offered: frozenset[str] = frozenset()

    def case(self, **fixed: Any) -> Case:
        """Return the case.

        Parameters
        ----------
        **fixed
            Values that the command sets itself, by key, with ``__`` in the place of the period.

        Raises
        ------
        BadInput
            In the words of the command line.
        """
        from stonepass.inputs.build import build_case

        values = self._values() | {key.replace("__", "."): value for key, value in fixed.items()}
        if "method__model" in fixed:  # the command may have options of other models too
            from stonepass.inputs.overlay import of_other_models

            other = of_other_models(fixed["method__model"])
            values = {key: value for key, value in values.items() if key not in other}
        try:
            return build_case(values)
        except BadInput as problem:
            raise _in_options(problem) from problem

    def sizeless_case(self, size_ratio: float = 1.0) -> Case:
        """Return the case of a command that varies the size, with a stone of `size_ratio`."""
        from stonepass.inputs.build import build_case

        values = {key: value for key, value in self._values().items() if key not in STONE_SIZE}
        try:
            return build_case(values | {"stone.size_ratio": size_ratio})
        except BadInput as problem:
            raise _in_options(problem) from problem

    @property
    def wetted(self) -> bool:
        """True with ``--wetted``, for commands that compare the direct model with another."""
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
        """Return the values of the case file; its relative paths start at the current folder."""
        if self.case_file is None:
            return {}
        from stonepass.inputs.case_file import read_case, values_of

        case = read_case(self.case_file)
        return values_of(case, Path.cwd())


def takes_settings(
    *left_out: str,
    models: Collection[str] = (),
    choose_model: bool = False,
    remarks: Mapping[str, str] | None = None,
) -> Callable[[Callable[..., int]], Callable[..., int]]:
    """Turn ``function(settings, own options…)`` into a command with the options of a case.

    Parameters
    ----------
    left_out : str
        Keys of inputs that the command has no options for.
    models : collection of str
        The models whose options the command has; all models by default.
    choose_model : bool
        Whether the command has ``--model`` although it is restricted to some `models`.
    remarks : mapping of str to str, optional
        A sentence that is added to the help of an option, by the key of its input.
    """
    offered = {
        key: each
        for key, each in all_inputs().items()
        if key not in left_out and _belongs(each, models, choose_model)
    }
    names = {each.name: key for key, each in offered.items()}

    def decorate(function: Callable[..., int]) -> Callable[..., int]:
        """Return the command that calls `function`."""
        own_hints = get_type_hints(function, include_extras=True)
        own = [p for p in inspect.signature(function).parameters.values() if p.name != "settings"]
        shared: dict[str, Any] = {"case_file": _CASE_FILE}
        shared |= {
            each.name: _option(each, models, (remarks or {}).get(key, ""))
            for key, each in offered.items()
        }
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


def _belongs(each: DeclaredInput, models: Collection[str], choose_model: bool) -> bool:
    if not models or each.section != "method":
        return True
    if each.key == MODEL:
        return choose_model
    owners = models_with(each.name)
    return not owners or bool(set(owners) & set(models))


def _option(each: DeclaredInput, models: Collection[str], remark: str) -> Any:
    """Return the annotation of an option of a case: its type, names, panel and help."""
    if each.key == MODEL:
        each = model_input(models)
    declaration = each.declaration
    meaning = f"{declaration.meaning} {remark}" if remark else declaration.meaning
    told = replace(each, declaration=replace(declaration, meaning=meaning))
    return Annotated[
        _TYPES.get(declaration.kind, str) | None, option_for(told, _panel(each, models))
    ]


def model_input(models: Collection[str]) -> DeclaredInput:
    """Return the input ``--model``, restricted to the models of a command if there are any."""
    each = all_inputs()[MODEL]
    names = tuple(name for name in each.declaration.choices if not models or name in models)
    meaning = "; ".join(f"{name}: {MODELS[name].MEANING}" for name in names) + "."
    return replace(each, declaration=replace(each.declaration, choices=names, meaning=meaning))


def option_for(
    each: DeclaredInput, panel: str, *, meaning: str = "", default: str | None = None
) -> OptionInfo:
    """Return the option of a declared input, for an annotation ``Annotated[type | None, …]``.

    Parameters
    ----------
    each : DeclaredInput
    panel : str
        Panel of the help.
    meaning : str
        Help text of a command that needs another one than that of the declaration.
    default : str, optional
        The default in words, instead of that of the declaration; "" if there is none.
    """
    declaration = each.declaration
    if default is None:
        plain = each.default is None or each.default is MISSING or declaration.kind is Kind.FLAG
        default = declaration.shown_default or ("" if plain else _shown(each.default))
    notes = [f"default: {default}"] if default else []
    if declaration.kind in (Kind.NUMBER, Kind.WHOLE) and declaration.bounds is not None:
        notes.insert(0, "{:.12g} to {:.12g}".format(*declaration.bounds))
    metavar = declaration.metavar or "|".join(declaration.choices)
    found: OptionInfo = typer.Option(
        declaration.option,
        metavar=metavar or _METAVARS.get(declaration.kind),
        help=(meaning or declaration.meaning) + (f"  [{'; '.join(notes)}]" if notes else ""),
        rich_help_panel=panel,
        autocompletion=_completion(each),
        show_default=False,
    )
    return found


def _panel(each: DeclaredInput, models: Collection[str]) -> str:
    """Return the panel of an input; options of a single model have a panel of their own."""
    if each.section != "method":
        return _PANELS[each.section]
    if each.key == MODEL:
        return MODEL_PANEL
    owners = models_with(each.name)
    if not owners:
        return SOLVER
    return f"Options of the model '{owners[0]}'" if len(owners) == 1 != len(models) else MODEL_PANEL


def _completion(each: DeclaredInput) -> Callable[[str], list[str]] | None:
    """Return the words that a shell may complete for an input; None where there are none."""
    if each.declaration.kind is Kind.MATERIAL:
        return complete_material
    choices = list(each.declaration.choices)
    return (lambda incomplete: choices) if choices else None


def complete_material(incomplete: str) -> list[str]:
    """Return the names of the catalogue, for the completion of a shell."""
    from stonepass.materials.catalogue import CATALOGUE

    return list(CATALOGUE)


def _shown(default: Any) -> str:
    if isinstance(default, float) and type(default) is not float:
        return f"{default / 1e3:g}kPa"
    return f"{default:g}" if isinstance(default, float) else str(default)


def _in_options(problem: BadInput) -> BadInput:
    """Return the refusal with the input named as on the command line."""
    from stonepass.inputs.build import in_words

    words = {each.title: option_of(key) for key, each in all_inputs().items()}
    found = in_words(problem, words | _MORE_WORDS)
    if found.argument in _REMEDIES and found.value == "missing":
        return BadInput(found.argument, "missing", _REMEDIES[found.argument])
    return found
