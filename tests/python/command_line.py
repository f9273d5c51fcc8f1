"""What a command printed, taken apart."""

import json

import pytest


def one_line_error(result: tuple[int, str, str]) -> str:
    """The message of a command that refused its input: exit code 2, one line on stderr, nothing on stdout."""
    code, out, err = result
    assert code == 2 and out == ""
    assert err.startswith("error: ") and err.count("\n") == 1 and "Traceback" not in err
    return err[len("error: ") : -1]


def strict(text: str) -> dict:
    """JSON without NaN and Infinity."""
    return json.loads(text, parse_constant=lambda name: pytest.fail(f"{name} is no JSON"))
