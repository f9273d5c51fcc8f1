"""mcplan.cli: no option and no argument of any verb takes an empty word."""

from __future__ import annotations

from command_line import commands, one_line_error
from mcplan.cli import main


def run(capsys, *words) -> tuple[int, str, str]:
    return main(list(words)), *capsys.readouterr()


def test_an_empty_word_is_called_empty_and_no_working_folder(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    tried = 0
    for words, command in commands():
        assert "must not be empty" in one_line_error(run(capsys, *words, ""))
        for option in {name for param in command.params for name in param.opts if name.startswith("-")}:
            message = one_line_error(run(capsys, *words, "flat", option, ""))
            assert message.startswith(f"the word after {option}: must not be empty")
            if option.startswith("--"):
                assert one_line_error(run(capsys, *words, "flat", f"{option}=")).startswith(f"{option}: must not be")
            tried += 1
    assert tried > 100 and list(tmp_path.iterdir()) == []
