"""Files of sweeps: which scenes, robots, options and seeds are planned, in TOML."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, ValidationError, field_validator, model_validator
from pydantic_core import ErrorDetails, PydanticCustomError

from mcplan import _core
from mcplan.errors import (
    InvalidArgument,
    InvalidInput,
    InvalidOptions,
    InvalidSweep,
    UnknownName,
    did_you_mean,
    either,
    shown,
    together,
)
from mcplan.files.export_formats import FORMATS, format_of
from mcplan.files.robots import list_robots, load_robot
from mcplan.files.scenes import list_scenes, load_scene
from mcplan.files.sweep_terrains import GENERATORS, Parameter, parameters_of
from mcplan.files.sweep_values import Several, Strict, Value, Whole
from mcplan.files.toml import read_toml
from mcplan.options import ALIASES, fill

#: Options of each engine.
OPTIONS: dict[str, type] = {"ddp": _core.ddp.Options, "rhp": _core.rhp.Options}
#: Options that are no data of a sweep: `seed` is its own list, the others fill or need memory.
NOT_OPTIONS = {
    "seed": "is said by seeds",
    "record_history": "is no option of sweeps",
    "logger": "is no option of sweeps",
    "watch": "is no option of sweeps",
}
MAX_TASKS = 1_000_000
Seed = Annotated[int, Field(strict=True, ge=0, le=2**53 - 1)]
Name = Annotated[str, Field(strict=True, min_length=1, max_length=100, pattern=r"^[^\x00-\x1f]+$")]


class SceneEntry(Strict):
    """A scene, or a terrain that is generated."""

    scene: Name | None = Field(None, description="Built-in name, or path of a TOML file, seen from the sweep's.")
    generator: Name | None = Field(None, description=f"Terrain: {either(sorted(GENERATORS))}.")
    name: Name | None = Field(None, description="Name of the entry in tables; default: that of scene or generator.")
    parameters: dict[str, Value] = Field({}, description="Of the terrain; scale, friction and yaw_deg of any scene.")
    samples: Annotated[Whole, Field(ge=1, le=MAX_TASKS)] = Field(
        1, description="How often what is drawn is drawn, for each combination of what stands in grids."
    )
    robots: list[Name] | None = Field(None, min_length=1, description="Robots of this entry instead of the sweep's.")

    @model_validator(mode="after")
    def _one_source(self) -> SceneEntry:
        if (self.scene is None) == (self.generator is None):
            raise PydanticCustomError("rule", "must have either scene or generator")
        return self

    @property
    def title(self) -> str:
        """What tables call the entry."""
        return self.name or self.generator or str(self.scene)


class SweepSpec(Strict):
    """A sweep: every scene with every robot, every value of the options and every seed."""

    name: Name = Field(description="Name of the sweep.")
    description: str = Field("", description="A line of it for people.")
    engine: Literal["ddp", "rhp"] = Field("ddp", description="Planner: contact-sequence search, or receding horizon.")
    seed: Seed = Field(0, description="Seed of what is drawn.")
    robots: list[Name] = Field(["humanoid44"], min_length=1, description="Built-in names or paths of TOML files.")
    seeds: list[Seed] = Field([0], min_length=1, description="Seeds of the planner, which ddp alone has.")
    options: dict[str, Value] = Field({}, description="Options of the planner, for all tasks.")
    motion: Literal["default", "all", "legs"] | None = Field(
        None, description="Joints of the whole-body motion that is found along each solved plan; left out: no motions."
    )
    exports: list[Name] = Field(
        [], description=f"Formats in which each solved plan, or certified motion, is exported: {either(list(FORMATS))}."
    )
    scenes: list[SceneEntry] = Field(min_length=1, description="What is planned.")

    @field_validator("options", mode="before")
    @classmethod
    def _flat(cls, given: Any) -> Any:
        """`weights.flight` as TOML has it, a table in a table, under one name."""
        if isinstance(given, dict) and isinstance(given.get("weights"), dict):
            rest = {name: value for name, value in given.items() if name != "weights"}
            weights = {f"weights.{name}": value for name, value in given["weights"].items()}
            if twice := sorted(rest.keys() & weights.keys()):
                raise PydanticCustomError("rule", "must have {name} once", {"name": twice[0]})
            return rest | weights
        return given


def load_sweep_spec(path: str | Path) -> SweepSpec:
    """Load the file of a sweep.

    Raises:
        InvalidSweep: A key is unknown or missing or a value is out of range; the message names file, field, value and rule.
    """
    return sweep_spec(read_toml(Path(path), InvalidSweep), str(path), Path(path).parent)


def sweep_spec(data: Any, source: str = "", folder: Path = Path(".")) -> SweepSpec:
    """A sweep from plain data, checked to the last name.

    Args:
        data: As a file has it.
        source: The file, for messages.
        folder: From which its paths are seen.

    Raises:
        InvalidSweep: As load_sweep_spec.
    """
    try:
        spec = SweepSpec.model_validate(data)
    except ValidationError as error:
        raise together([_finding(each, data) for each in error.errors()]).moved(InvalidSweep, source) from None
    findings = [*_of_robots(spec, folder), *_of_scenes(spec, folder), *_of_options(spec), *_of_exports(spec)]
    findings += [*_of_repeats(spec), *_of_size(spec)]
    findings = findings or _of_joints(spec, folder)
    if findings:
        raise together(findings).moved(InvalidSweep, source)
    return spec


def number_of_tasks(spec: SweepSpec) -> int:
    """How many tasks a sweep has, without making them."""
    planners = math.prod(_count(value) for value in spec.options.values()) * len(spec.seeds)
    return sum(
        len(entry.robots or spec.robots)
        * entry.samples
        * math.prod(_count(value) for value in entry.parameters.values())
        * planners
        for entry in spec.scenes
    )


def schema_text() -> str:
    """The JSON schema of files of sweeps."""
    schema = {"$schema": "https://json-schema.org/draft/2020-12/schema", **SweepSpec.model_json_schema()}
    options = schema["properties"]["options"]
    weights = {"type": "object", "additionalProperties": options["additionalProperties"]}
    options["properties"] = {"weights": {"description": "Weights of costs and constraints by name.", **weights}}
    return json.dumps(schema, indent=2) + "\n"


def place(source: str, folder: Path) -> str:
    """What a scene or robot of a sweep is loaded by: its name if it is built in, else its path seen from the sweep's."""
    path = folder / source
    return source if source in (*list_scenes(), *list_robots()) or not path.exists() else str(path)


def option_rule(engine: str, name: str, value: Any) -> InvalidInput | None:
    """What is wrong with an option."""
    group, _, part = name.partition(".")
    if name in NOT_OPTIONS:
        return InvalidOptions(name, NOT_OPTIONS[name])
    try:
        fill(OPTIONS[engine](), {group: {part: value}} if part else {name: value})
    except InvalidInput as error:
        return error
    return None


def _finding(error: ErrorDetails, data: Any) -> InvalidInput:
    """An error of pydantic in our words: field, rule, value."""
    loc = [part for part in error["loc"] if part not in ("plain", "several")]
    field = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in loc).lstrip(".")
    kind, context = error["type"], error.get("ctx", {})
    if kind == "extra_forbidden":
        legal = _keys_at(loc[:-1])
        return InvalidInput(field, f"no such key. {did_you_mean(str(loc[-1]), legal)}Keys: {', '.join(legal)}")
    if kind == "missing":
        return InvalidInput(field, "is required")
    value = error["input"]
    return InvalidInput(field, _rule(kind, context, error["msg"]), "" if isinstance(value, dict) else shown(value))


def _rule(kind: str, context: dict[str, Any], message: str) -> str:
    if kind == "rule":
        return message
    bounds = {
        "greater_than_equal": ("ge", "at least"),
        "less_than_equal": ("le", "at most"),
        "greater_than": ("gt", "above"),
    }
    if kind in bounds:
        name, word = bounds[kind]
        return f"must be {word} {context[name]}"
    if kind == "literal_error":
        return f"must be one of {str(context['expected']).replace(chr(39), '').replace(' or ', ', ')}"
    if kind in ("too_short", "string_too_short"):
        return "must not be empty"
    if kind == "string_too_long":
        return f"must have at most {context['max_length']} characters"
    if kind == "string_pattern_mismatch":
        return "must have no control characters"
    words = {"int": "a whole number", "float": "a number", "string": "a text", "list": "a list", "tuple": "a list"}
    words |= {"dict": "a table", "model": "a table", "finite": "a finite number", "bool": "true or false"}
    return next((f"must be {word}" for start, word in words.items() if kind.startswith(start)), message.lower())


def _keys_at(loc: list[int | str]) -> list[str]:
    """Legal keys of the table at a place."""
    if not loc:
        return list(SweepSpec.model_fields)
    if loc[0] == "scenes" and len(loc) == 2:
        return list(SceneEntry.model_fields)
    if loc[-1] in ("normal", "range"):
        inner: Any = Several.model_fields[str(loc[-1])].annotation
        return list(next(kind for kind in inner.__args__ if kind is not type(None)).model_fields)
    return list(Several.model_fields)


def _values(value: Any) -> list[Any]:
    return value.extremes() if isinstance(value, Several) else [value]


def _count(value: Any) -> int:
    """Number of values in turn; what is drawn is one for each sample."""
    return value.count() if isinstance(value, Several) else 1


def _of_size(spec: SweepSpec) -> list[InvalidInput]:
    number = number_of_tasks(spec)
    return [InvalidInput("scenes", f"must give at most {MAX_TASKS} tasks", str(number))] if number > MAX_TASKS else []


def _of_repeats(spec: SweepSpec) -> list[InvalidInput]:
    """What would be planned again and give the same: a robot or seed named twice, samples of what is not drawn."""
    lists: list[tuple[str, list[Any]]] = [("robots", spec.robots), ("seeds", spec.seeds)]
    lists += [(f"scenes[{i}].robots", entry.robots or []) for i, entry in enumerate(spec.scenes)]
    lists.append(("exports", spec.exports))
    out = [
        InvalidInput(f"{field}[{k}]", "must differ from those before it", shown(value))
        for field, values in lists
        for k, value in enumerate(values)
        if value in values[:k]
    ]
    values = [(f"options.{name}", value) for name, value in spec.options.items()]
    values += [
        (f"scenes[{i}].parameters.{name}", value)
        for i, entry in enumerate(spec.scenes)
        for name, value in entry.parameters.items()
    ]
    out += [
        InvalidInput(field, "must have values that differ", shown(value.grid or list(value.linspace or ())))
        for field, value in values
        if isinstance(value, Several) and _repeats(value)
    ]
    for i, entry in enumerate(spec.scenes):
        if entry.samples > 1 and not _draws(entry, spec):
            rule = "must be 1 where nothing is drawn: all of them would be the same"
            out.append(InvalidInput(f"scenes[{i}].samples", rule, str(entry.samples)))
    return out


def _repeats(value: Several) -> bool:
    """Whether values that stand in turn are the same twice."""
    if value.linspace is not None:
        return value.linspace[2] > 1 and value.linspace[0] == value.linspace[1]
    texts = [json.dumps(each) for each in value.grid or []]
    return len(set(texts)) < len(texts)


def _draws(entry: SceneEntry, spec: SweepSpec) -> bool:
    """Whether samples of an entry differ; what no generator is called is told elsewhere."""
    if entry.generator is not None:
        own = GENERATORS[entry.generator].parameters if entry.generator in GENERATORS else {"seed": None}
        if "seed" in own and "seed" not in entry.parameters:
            return True
    values = [*entry.parameters.values(), *spec.options.values()]
    return any(isinstance(value, Several) and value.drawn for value in values)


def _of_robots(spec: SweepSpec, folder: Path) -> list[InvalidInput]:
    lists = [("robots", spec.robots)]
    lists += [(f"scenes[{i}].robots", entry.robots) for i, entry in enumerate(spec.scenes) if entry.robots]
    return [
        found
        for field, robots in lists
        for j, robot in enumerate(robots)
        if (found := _unloadable(f"{field}[{j}]", load_robot, place(robot, folder))) is not None
    ]


def _of_scenes(spec: SweepSpec, folder: Path) -> list[InvalidInput]:
    out = []
    titles: dict[str, int] = {}
    for i, entry in enumerate(spec.scenes):
        if entry.title in titles:
            rule = f"must differ from that of scenes[{titles[entry.title]}]"
            out.append(InvalidInput(f"scenes[{i}].name", rule, shown(entry.title)))
        titles.setdefault(entry.title, i)
        if entry.scene is not None:
            found = _unloadable(f"scenes[{i}].scene", load_scene, place(entry.scene, folder))
            out += [found] if found is not None else []
        elif entry.generator not in GENERATORS:
            rule = f"must be one of {', '.join(sorted(GENERATORS))}"
            out.append(InvalidInput(f"scenes[{i}].generator", rule, shown(entry.generator)))
            continue
        out += _of_parameters(f"scenes[{i}].parameters", entry)
    return out


def _of_parameters(field: str, entry: SceneEntry) -> list[InvalidInput]:
    out = []
    legal: dict[str, Parameter] = parameters_of(entry.generator)
    for name, value in entry.parameters.items():
        if name not in legal:
            rule = f"no such parameter. {did_you_mean(name, legal)}Parameters: {', '.join(legal)}"
            out.append(InvalidInput(f"{field}.{name}", rule))
            continue
        for each in _values(value):
            if rule := legal[name].rule(each):
                out.append(InvalidInput(f"{field}.{name}", rule, shown(each)))
                break
        if legal[name].whole and isinstance(value, Several) and (value.uniform or value.log_uniform or value.normal):
            out.append(InvalidInput(f"{field}.{name}", "must be a whole number: draw it by integers or choice"))
    return out


def _of_options(spec: SweepSpec) -> list[InvalidInput]:
    out: list[InvalidInput] = []
    if spec.engine != "ddp" and spec.seeds != [0]:
        out.append(InvalidInput("seeds", f"must be left out: {spec.engine} has no seed", shown(spec.seeds)))
    given = {ALIASES.get(name, name) for name in spec.options}
    if len(given) < len(spec.options):
        out.append(InvalidInput("options.time_limit", "may not stand beside time_limit_s, which it is short for"))
    for name, value in spec.options.items():
        for each in _values(value):
            found = option_rule(spec.engine, name, each)
            if found is not None:
                out.append(found.moved(InvalidInput, prefix="options"))
                break
    return out


def _of_joints(spec: SweepSpec, folder: Path) -> list[InvalidInput]:
    """What needs joints, where no robot of the sweep has any; of several robots those without are told by the table."""
    asked: list[tuple[str, str]] = [("motion", spec.motion)] if spec.motion else []
    asked += [(f"exports[{i}]", name) for i, name in enumerate(spec.exports) if FORMATS[name].joints]
    names = {robot for entry in spec.scenes for robot in entry.robots or spec.robots}
    if not asked or any(load_robot(place(name, folder)).urdf for name in names):
        return []
    rule = f"needs a robot with a URDF: {', '.join(sorted(names))} {'has' if len(names) == 1 else 'have'} none"
    return [InvalidInput(field, rule, shown(value)) for field, value in asked]


def _of_exports(spec: SweepSpec) -> list[InvalidInput]:
    out = []
    for i, name in enumerate(spec.exports):
        try:
            format_of(name, f"exports[{i}]")
        except InvalidArgument as error:
            out.append(error.moved(InvalidInput))
    return out


def _unloadable(field: str, load: Any, source: str) -> InvalidInput | None:
    """What keeps a scene or a robot from being loaded."""
    try:
        load(source)
    except UnknownName as error:
        return InvalidInput(field, str(error))
    except InvalidInput as error:
        return InvalidInput(field, f"cannot be read: {str(error).splitlines()[0]}")
    return None
