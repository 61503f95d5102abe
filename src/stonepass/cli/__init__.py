"""The command line: one sub-command per file, every way out an exit code and one sentence.

Exit codes: 0 an answer, 1 no answer (its outcome says why), 2 a bad request, 3 a fault of ours.
"""

from __future__ import annotations

import os
import sys
import warnings

from stonepass.cli.encoding import spell_what_is_lacking

__all__ = ["main"]

EXIT_NO_ANSWER, EXIT_BAD_REQUEST, EXIT_FAULT = 1, 2, 3


def main(arguments: list[str] | None = None) -> None:
    """Run the command line and exit."""
    # Looking for plug-ins of pydantic reads the metadata of every installed package.
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")
    spell_what_is_lacking()
    sys.exit(run(sys.argv[1:] if arguments is None else arguments))


def run(arguments: list[str]) -> int:
    """Run the command line and return its exit code."""
    import typer

    from stonepass.cli.app import app
    from stonepass.errors import StonepassError

    warnings.simplefilter("ignore")  # what matters is in the answer's own warnings
    if arguments in ([], ["material"]):
        arguments = [*arguments, "--help"]
    try:
        result = app(args=arguments, prog_name="stonepass", standalone_mode=False)
        return result if isinstance(result, int) else 0
    except StonepassError as problem:
        return _say(str(problem), EXIT_BAD_REQUEST)
    except typer.Exit as stop:
        return stop.exit_code
    except typer.TyperException as problem:
        return _say(_sentence(problem.format_message()), EXIT_BAD_REQUEST)
    except (KeyboardInterrupt, typer.Abort):
        return _say("stopped.", 130)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except Exception as problem:  # we are wrong: no traceback reaches a user
        if os.environ.get("STONEPASS_DEBUG"):
            raise
        return _say(
            f"this is a fault of stonepass, please report it with your command: "
            f"{type(problem).__name__}: {problem} (STONEPASS_DEBUG=1 shows where).",
            EXIT_FAULT,
        )


def _say(sentence: str, code: int) -> int:
    print(f"stonepass: {sentence}", file=sys.stderr)
    return code


def _sentence(message: str) -> str:
    one_line = " ".join(message.split())
    return one_line if one_line.endswith((".", "?")) else one_line + "."
