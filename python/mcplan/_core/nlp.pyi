"""
Sparse nonlinear programs; their pieces are written in C++.
"""

from __future__ import annotations
import typing

__all__: list[str] = ["Solver", "ipopt_version"]

class Solver:
    """
    Which solver a planner hands its nonlinear programs to.

    Members:

      ipopt : Ipopt with MUMPS: the reference.

      ipm : The interior-point kernel, which goes stage by stage.

      auto : The kernel; where it does not converge, Ipopt with what is left of the time.
    """

    __members__: typing.ClassVar[dict[str, Solver]]
    auto: typing.ClassVar[Solver]
    ipm: typing.ClassVar[Solver]
    ipopt: typing.ClassVar[Solver]
    @typing.overload
    def __eq__(self, other: Solver) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: Solver) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    @typing.overload
    def __repr__(self) -> str: ...
    @typing.overload
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

def ipopt_version() -> str:
    """
    Version of Ipopt that the module is compiled for, such as '3.11.9'.
    """
