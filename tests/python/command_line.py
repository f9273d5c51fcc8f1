"""The verbs of the command, and what it printed, taken apart."""

import json

import pytest
import typer

from mcplan.cli import app


def one_line_error(result: tuple[int, str, str]) -> str:
    """The message of a command that refused its input: exit code 2, one line on stderr, nothing on stdout."""
    code, out, err = result
    assert code == 2 and out == ""
    assert err.startswith("error: ") and err.count("\n") == 1 and "Traceback" not in err
    return err[len("error: ") : -1]


def strict(text: str) -> dict:
    """JSON without NaN and Infinity."""
    return json.loads(text, parse_constant=lambda name: pytest.fail(f"{name} is no JSON"))


def commands() -> list[tuple[tuple[str, ...], typer.core.TyperCommand]]:
    """Each verb, those of other distributions and their sub-verbs included, with the words that lead to it."""
    app.complete("bench")
    pending, found = [((), typer.main.get_command(app.app))], []
    while pending:
        words, command = pending.pop()
        found.append((words, command))
        pending += [((*words, name), below) for name, below in getattr(command, "commands", {}).items()]
    return found
