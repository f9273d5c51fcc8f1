"""Types of the keys of planar robot and motion files. Scenes and robots have their tables of fields in C++."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

Number = Annotated[float, Field(allow_inf_nan=False)]
Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0, allow_inf_nan=False)]
Name = Annotated[str, Field(min_length=1)]
Names = Annotated[list[Name], Field(max_length=1000)]


class Table(BaseModel):
    model_config = ConfigDict(strict=True, extra="forbid")
