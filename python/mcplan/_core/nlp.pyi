"""
Sparse nonlinear programs; their pieces are written in C++.
"""

from __future__ import annotations

__all__: list[str] = ["ipopt_version"]

def ipopt_version() -> str:
    """
    Version of Ipopt that the module is compiled for, such as '3.11.9'.
    """
