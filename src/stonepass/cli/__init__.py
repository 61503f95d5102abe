"""The command line: one sub-command per file; every failure ends in a sentence and an exit code.

Exit codes: 0 answered; 1 no answer, the outcome says why; 2 the request was refused; 3 an error of
the program.
"""

from __future__ import annotations

import errno
import os
import signal
import sys
import warnings
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from stonepass.cli.encoding import spell_what_is_lacking
from stonepass.errors import did_you_mean, lacks_memory

__all__ = ["main"]

EXIT_NO_ANSWER, EXIT_BAD_REQUEST, EXIT_FAULT = 1, 2, 3
EXIT_INTERRUPTED, EXIT_TERMINATED = 130, 143
COMPLETION = "_STONEPASS_COMPLETE"  # set by a shell that asks for completions
WAYS = "; --cache DIR chooses another folder, --no-cache works without one"
RENAMED = {
    "--relief": "--height-range",
    "--pairs": "--opening-curve",
    "--order": "--series-order",
}


def main(arguments: list[str] | None = None) -> None:
    """Run the command line and exit."""
    # The search for plug-ins of pydantic would read the metadata of every installed package.
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")
    spell_what_is_lacking()
    signal.signal(signal.SIGTERM, _terminate)
    sys.exit(run(sys.argv[1:] if arguments is None else arguments))


def run(arguments: list[str]) -> int:
    """Run the command line and return its exit code."""
    import typer

    from stonepass.cli.app import app
    from stonepass.errors import StonepassError

    arguments = [_renamed(each) for each in arguments]
    if not arguments and COMPLETION not in os.environ:
        from stonepass.cli.greeting import greeting

        print(greeting())
        return 0
    if arguments in (["material"], ["fit"]):
        arguments = [*arguments, "--help"]
    try:
        with _cache_warnings():
            result = app(args=arguments, prog_name="stonepass", standalone_mode=False)
            sys.stdout.flush()
        if result == EXIT_INTERRUPTED:  # Typer has caught the interrupt
            return _say("stopped.", EXIT_INTERRUPTED)
        return result if isinstance(result, int) else 0
    except StonepassError as problem:
        return _say(str(problem), EXIT_BAD_REQUEST)
    except typer.Exit as stop:
        return stop.exit_code
    except typer.TyperException as problem:
        return _say(_sentence(_message(problem, arguments)), EXIT_BAD_REQUEST)
    except (KeyboardInterrupt, typer.Abort):
        return _say("stopped.", EXIT_INTERRUPTED)
    except _Terminated:
        return _say("stopped.", EXIT_TERMINATED)
    except BrokenPipeError:
        _discard_output()
        return 0
    except Exception as problem:  # no traceback reaches a user
        if os.environ.get("STONEPASS_DEBUG"):
            raise
        if (sentence := _beyond_the_machine(problem)) is not None:
            return _say(sentence, EXIT_BAD_REQUEST)
        return _say(
            "this is an error of stonepass; please report it together with your command: "
            f"{type(problem).__name__}: {problem} (STONEPASS_DEBUG=1 shows where it occurred).",
            EXIT_FAULT,
        )


def _renamed(argument: str) -> str:
    """Return an option of an earlier version by its present name, and say so."""
    option, equals, value = argument.partition("=")
    if option not in RENAMED:
        return argument
    print(f"warning: {option} is now called {RENAMED[option]}", file=sys.stderr)
    return f"{RENAMED[option]}{equals}{value}"


class _Terminated(BaseException):
    """The system has asked this process to end (SIGTERM)."""


def _terminate(*_: object) -> None:
    raise _Terminated


@contextmanager
def _cache_warnings() -> Iterator[None]:
    """Print the warnings of the solution cache after the answer, each once.

    Other warnings of Python are dropped, since the answer has warnings of its own.
    """
    from stonepass.errors import CacheNotWritten, CacheWarning

    with warnings.catch_warnings(record=True) as noted:
        warnings.simplefilter("ignore")
        warnings.simplefilter("always", CacheWarning)
        yield
    told = Counter((each.category, str(each.message)) for each in noted)
    for (kind, sentence), times in told.items():
        count = "" if times == 1 else f" ({times} times)"
        way = WAYS if issubclass(kind, CacheNotWritten) else ""
        print(f"warning: {sentence}{count}{way}", file=sys.stderr)


def _beyond_the_machine(problem: Exception) -> str | None:
    """Return a sentence if the machine lacks memory or room for output, else None."""
    if lacks_memory(problem):
        return (
            "there is not enough memory for this command; close other programs or raise the limit."
        )
    if isinstance(problem, OSError) and problem.errno in (errno.ENOSPC, errno.EDQUOT, errno.EIO):
        _discard_output()
        return f"the output could not be written: {problem.strerror}."
    return None


def _discard_output() -> None:
    """Discard the buffer of stdout, which nobody reads; closing it would raise an error."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _message(problem: Any, arguments: list[str]) -> str:
    """Return the message of a refused command line, with the option that was probably meant."""
    option = getattr(problem, "option_name", None)
    if option is None or not problem.message.startswith("No such option"):
        return str(problem.format_message())
    # The parser splits a long option with a single hyphen into short ones; this is the whole word.
    given = next((each for each in arguments if each.startswith(option)), option).split("=")[0]
    names = [
        name.removeprefix("--")
        for each in problem.ctx.command.params
        for name in (*each.opts, *each.secondary_opts)
        if name.startswith("--")
    ]
    near = did_you_mean(given.lstrip("-"), names).replace(" '", " '--")
    command = problem.ctx.command_path
    return f"There is no option {given}{near}; '{command} --help' lists all."


def _say(sentence: str, code: int) -> int:
    print(f"stonepass: {sentence}", file=sys.stderr)
    return code


def _sentence(message: str) -> str:
    one_line = " ".join(message.split())
    return one_line if one_line.endswith((".", "?")) else one_line + "."
