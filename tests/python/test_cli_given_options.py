"""mcplan.cli.given_options: errors of what was typed name the option as it was typed."""

from __future__ import annotations

import pytest

from command_line import commands, one_line_error
from mcplan.cli import main
from mcplan.cli.given_options import named_as_typed
from mcplan.errors import InvalidInput, InvalidOptions, InvalidScene, together
from standing import standing_plan


def run(capsys, *words) -> tuple[int, str, str]:
    return main([str(word) for word in words]), *capsys.readouterr()


#: Values that no engine takes, of all options that an engine judges.
BAD = {
    "plan flat": {
        "--scale": ("1e-300", "0", "inf", "nan"),
        "--sole-inside": ("3",),
        "--min-flight": ("-1",),
        "--phases": ("-1", "99999999999"),
        "--model": ("x",),
        "--method": ("x",),
        "--polish": ("x",),
        "--time-limit": ("-1",),
        "--threads": ("0",),
        "--seed": ("-1", "9" * 30),
    },
    "rhp flat": {
        "--scale": ("1e300",),
        "--fidelity": ("x",),
        "--lookahead": ("99",),
        "--cycles": ("0",),
        "--transcription": ("x",),
        "--solver": ("x",),
        "--time-limit": ("0",),
    },
    "sip walking": {
        "--forces": ("x",),
        "--minimise": ("x",),
        "--contact": ("x",),
        "--tube": ("-1",),
        "--order": ("99",),
        "--neq": ("99",),
        "--free-flyer": ("x",),
        "--continuous": ("x",),
        "--solver": ("x",),
        "--hessian": ("x",),
        "--max-iterations": ("-1",),
        "--time-limit": ("-1",),
    },
    "motion PLAN": {
        "--joints": (),
        "--start": ("x",),
        "--node": ("0", "1", "nan"),
        "--max-iterations": ("-1", "x"),
        "--time-limit": ("0", "-1", "nan"),
    },
    "track none.npz": {
        "--mass-scale": ("0",),
        "--friction": ("-1",),
        "--ground-shift": ("1e9",),
        "--seed": ("-1",),
        "--push": ("40",),
        "--torque-bandwidth": ("-1",),
        "--torque-delay": ("-1",),
        "--sensor-noise": ("-1",),
    },
    "run flat --robot talos": {
        "--engine": ("x", "sip"),
        "--push": ("40",),
        "--command": ("x", "1,2"),
        "--goal": ("x", "1", "1,2,3,-4", "nan,0"),
        "--told-at": ("x", "-1", "4000"),
        "--keep": ("0", "x", "5000"),
        "--latency": ("-1", "x"),
        "--period": ("0",),
        "--duration": ("-1",),
        "--mass-scale": ("0",),
        "--friction": ("-1",),
        "--ground-shift": ("1e9",),
        "--seed": ("-1",),
        "--torque-bandwidth": ("-1",),
        "--torque-delay": ("-1",),
        "--sensor-noise": ("-1",),
    },
    "sweep examples/sweep.toml --out none": {
        "--jobs": ("0", "x"),
        "--shard": ("3/2", "0/1", "x"),
        "--attempts": ("0",),
    },
    "export none.npz -o out.npz": {"--to": ("nope",)},
    "export none.npz --to mjlab -o out.npz": {"--rate": ("0", "-1", "nan", "x")},
    "robots --from-urdf g1": {
        "--end": ("foot=nowhere", "foot"),
        "--posture": ("nowhere=1", "knee"),
        "--srdf": (),
        "--faces": ("30", "3", "x"),
        "--seed": ("-1", "x"),
    },
    "robots talos --strength": {"--seed": ("-1",)},
    "robots": {"--seed": ("3",), "--faces": ("30",)},
    "robots talos": {"--seed": ("3",)},
    "reproduce lengagne": {"--motions": ("nope",), "--tables": ("9", "x"), "--repeats": ("0", "x")},
    "reproduce wang": {
        "--cycles": ("0", "x"),
        "--lookahead-max": ("1",),
        "--seeds": ("-1",),
        "--tracked-seeds": ("-1",),
    },
    "bench": {"--repeats": ("0", "x"), "--threads": ("0",)},
    "bench robustness": {
        "--scenes": ("-1", "x"),
        "--seed": ("-1",),
        "--jobs": ("0",),
        "--model": ("x",),
        "--time-limit": ("-1", "x"),
    },
    "bench contacts": {"--repeats": ("0",), "--jobs": ("0",), "--case": ("nope",)},
    "bench contacts --no-speed": {"--repeats": ("3",)},
    "bench motion": {"--case": ("nope", "go2/")},
    "bench tracking": {"--seeds": ("0", "3"), "--jobs": ("0",), "--case": ("nope",)},
}


@pytest.mark.parametrize(
    ("verb", "option", "value"),
    [(verb, option, value) for verb, options in BAD.items() for option, values in options.items() for value in values],
)
def test_errors_name_the_option_that_was_typed(verb, option, value, capsys, tmp_path):
    words = verb.split()
    if "PLAN" in words:  # options that are judged once the plan is read
        standing_plan().save(tmp_path / "plan.npz")
        words = [str(tmp_path / "plan.npz") if word == "PLAN" else word for word in words]
    message = one_line_error(run(capsys, *words, option, value))
    assert message.startswith((f"{option}: ", f"{option} ")), message
    assert "of type" not in message


def test_options_of_a_group_are_not_lost_before_one_of_its_verbs(capsys):
    message = one_line_error(run(capsys, "bench", "--repeats", "3", "robustness", "--scenes", "0"))
    assert message == "--repeats: must stand after robustness, or be left out"


def test_what_typer_refuses_is_in_our_words(capsys):
    for words, message in (
        (("robots", "--from-urdf", "g1", "--faces", "x"), '--faces: must be a whole number, got "x"'),
        (("robots", "--from-urdf", "g1", "--faces=3"), "--faces: must be at least 6, got 3"),
        (("rhp", "flat", "--scale=x"), '--scale: must be a number, got "x"'),
        (("plan",), "SCENE: is required"),
    ):
        assert one_line_error(run(capsys, *words)) == message


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("--command", "nan,0,0"), '--command: must be [at,]ahead,left,turn, such as 0.15,0,0.1, got "nan,0,0"'),
        (("--goal", "inf,0"), '--goal: must be x,y[,yaw[,at]], such as 1.5,0.3, got "inf,0"'),
        (("--keep", "0"), "--keep: must lie in 0.1 to 3600 s, or be left out (nan): all of the run, got 0"),
        (("--told-at", "-1"), "--told-at: must lie in 0 to 3600 s, or be left out (nan): never, got -1"),
    ],
)
def test_options_of_a_run_say_what_was_typed_and_what_their_default_does(words, told, capsys):
    for name in ("mujoco", "pinocchio", "proxsuite"):
        pytest.importorskip(name)
    assert one_line_error(run(capsys, "run", "flat", "--robot", "talos", *words)) == told


def test_a_part_of_an_option_may_have_a_name_of_its_own():
    found = InvalidOptions("pushes[1].at_s", "must lie in the run", "9")
    with (
        pytest.raises(InvalidOptions, match="^--push: at: must"),
        named_as_typed(**{"pushes": "--push", "pushes.at_s": "--push: at"}),
    ):
        raise found
    with pytest.raises(InvalidOptions, match="^--push at_s: must"), named_as_typed(pushes="--push"):
        raise found


def test_no_help_shows_ranges_of_typer():
    for words, command in commands():
        text = command.get_help(command.make_context("mcplan", [], resilient_parsing=True))
        assert ">=" not in text and "<=" not in text, words


def test_every_option_that_takes_a_number_or_a_choice_is_tried():
    tried = {(verb.split()[0], option) for verb, options in BAD.items() for option in options}
    texts = {"--robot", "--true-scene", "--sequence", "--warm-start", "--from-urdf", "-o", "--free-durations"}
    paths = {
        "--out",
        "--markdown",
        "--strips",
        "--output",
        "--html",
        "--plots",
        "--strip",
        "--video",
        "--save",
        "--motion",
        "--scheduler",
    }
    for words, command in commands():
        if words not in {(verb,) for verb, _ in tried}:
            continue
        for param in command.params:
            taken = {name for name in param.opts if name.startswith("--")} - texts - paths
            if getattr(param, "is_flag", False) or not taken:
                continue
            assert {(words[0], option) for option in taken} <= tried


def test_only_arguments_are_renamed_and_an_option_is_told_once():
    both = together(
        [InvalidOptions("tube_m", "must be a positive number", "-1"), InvalidOptions("tube_rad", "so", "-5")]
    )
    with pytest.raises(InvalidOptions) as found, named_as_typed(tube_m="--tube", tube_rad="--tube"):
        raise both
    assert str(found.value) == "--tube: must be a positive number, got -1"
    for kept in (
        InvalidScene("seed", "must be none"),
        InvalidInput("seed", "is odd", "", "file.toml"),
        InvalidInput("x", "y"),
    ):
        with pytest.raises(InvalidInput) as found, named_as_typed("seed"):
            raise kept
        assert str(found.value) == str(kept)
