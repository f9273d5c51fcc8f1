"""The functions of blocks: arrays, or Python functions with their derivatives."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mcplan.arguments import found
from mcplan.errors import InvalidArgument, InvalidInput

Array = NDArray[np.float64]


def numbers(field: str, value: Any, dimensions: int, finite: bool = True) -> Array:
    """A value as an array of floats, a copy that cannot be written to.

    Args:
        field: What messages call it.
        value: What was given.
        dimensions: Most dimensions that it may have.
        finite: Whether infinite numbers are refused; others than numbers always are.

    Raises:
        InvalidArgument: It is no array of numbers.
        InvalidInput: A number is not finite, or there are too many dimensions.
    """
    try:
        given = np.asarray(value)
    except Exception:  # lists of different lengths, or whatever __array__ of somebody's class raises
        raise InvalidArgument(field, "must be an array of numbers", found(value)) from None
    if given.dtype.kind not in "fiub":
        raise InvalidArgument(field, "must be an array of numbers", found(value))
    if given.ndim > dimensions:
        rule = "must be a matrix" if dimensions == 2 else "must be a number or a list of numbers"
        raise InvalidInput(field, rule, f"shape {' x '.join(map(str, given.shape))}")
    out = np.array(given, dtype=float)
    if np.isnan(out).any() or (finite and not np.isfinite(out).all()):
        raise InvalidInput(field, "must be finite" if finite else "must be numbers", _first_bad(out, finite))
    out.flags.writeable = False
    return out


def _first_bad(values: Array, finite: bool) -> str:
    bad = ~np.isfinite(values) if finite else np.isnan(values)
    return f"{values[bad].flat[0]}"


class Function:
    """A function of a block's variables with its derivatives, each a Python function.

        def value(x, u, x_next): ...              # the m values of the block
        def jacobian(x, u, x_next): ...           # m x n, columns in the order of the block's variables
        def hessian(x, u, x_next, weights): ...   # n x n, the sum of weights[i] times the Hessian of value i

        dynamics = ipm.Function(value, jacobian, hessian)

    Each is called with one array for each of the block's variables; ``n`` is the sum of their sizes. Where m is 1, a
    number and an array of n may stand for arrays of 1 and 1 x n. Only the lower triangle of a Hessian is read. Functions
    must be smooth; they are called in the thread that solves, at points within the bounds of the variables.

    ``hessian`` may be left out in least squares alone, whose curvature is then Gauss and Newton's. Elsewhere a Hessian of
    zeros leaves the curvature out, as Gauss-Newton methods do with constraints: steps are then worse, the solution is the
    same.

    Raises:
        InvalidArgument: One of them is no function.
    """

    def __init__(
        self,
        value: Callable[..., Any],
        jacobian: Callable[..., Any],
        hessian: Callable[..., Any] | None = None,
    ) -> None:
        for name, given in (("value", value), ("jacobian", jacobian), ("hessian", hessian)):
            if not callable(given) and not (name == "hessian" and given is None):
                raise InvalidArgument(name, "must be a function", found(given))
        self.value, self.jacobian, self.hessian = value, jacobian, hessian


class Linear:
    """The function A v + b of a block's variables v.

    Args:
        matrix: A, m x n; or a list of matrices, one for each of the block's variables, that stand beside each other.
        constant: b, m numbers or one for all rows.

    Raises:
        InvalidArgument: One of them is no array of numbers.
        InvalidInput: Shapes do not fit, or a number is not finite.
    """

    def __init__(self, matrix: ArrayLike | list[ArrayLike], constant: ArrayLike = 0.0) -> None:
        self.matrix = _beside(matrix)
        rows = self.matrix.shape[0]
        self.constant = spread("constant", numbers("constant", constant, 1), rows)


class Quadratic:
    """The cost 1/2 v' H v + g' v of a block's variables v.

    Args:
        matrix: H, n x n; of one that is not symmetric the symmetric part counts.
        gradient: g, n numbers or one for all.

    Raises:
        InvalidArgument: One of them is no array of numbers.
        InvalidInput: H is not square, g has another size, or a number is not finite.
    """

    def __init__(self, matrix: ArrayLike, gradient: ArrayLike = 0.0) -> None:
        self.matrix = _matrix("matrix", matrix)
        rows, columns = self.matrix.shape
        if rows != columns:
            raise InvalidInput("matrix", "must be square", f"shape {rows} x {columns}")
        self.gradient = spread("gradient", numbers("gradient", gradient, 1), rows)
        self.constant = 0.0


def squares(name: str, function: Linear, weights: Array) -> Quadratic:
    """1/2 sum_i w_i r_i^2 of linear residuals r.

    Args:
        name: Of the block, for messages.
        function: The residuals.
        weights: Of each of them.

    Raises:
        InvalidInput: A square is too large a number.
    """
    A, b = function.matrix, function.constant
    with np.errstate(over="ignore", invalid="ignore"):
        matrix, gradient = A.T @ (weights[:, None] * A), A.T @ (weights * b)
        constant = 0.5 * float(weights @ b**2)
    for field, values in (("matrix", matrix), ("constant", np.append(gradient, constant))):
        if not np.isfinite(values).all():
            largest = max(np.abs(A).max(), np.abs(b).max())
            raise InvalidInput(f"{name}: {field}", "must have squares that are finite", f"numbers up to {largest:g}")
    out = Quadratic(matrix, gradient)
    out.constant = constant
    return out


def spread(field: str, values: Array, size: int) -> Array:
    """Values of which one may stand for all, as so many.

    Raises:
        InvalidInput: There is another number of them.
    """
    if values.ndim == 1 and values.size != size:
        raise InvalidInput(field, f"must be {size} numbers or one for all", f"{values.size} numbers")
    return np.broadcast_to(values, (size,))


def _matrix(field: str, value: Any) -> Array:
    out = numbers(field, value, 2)
    if out.ndim != 2 or out.size == 0:
        raise InvalidInput(field, "must be a matrix", f"shape {' x '.join(map(str, out.shape)) or 'of one number'}")
    return out


def _beside(value: Any) -> Array:
    if not isinstance(value, list | tuple) or not value or np.ndim(_first(value)) != 2:
        return _matrix("matrix", value)
    parts = [_matrix(f"matrix[{i}]", part) for i, part in enumerate(value)]
    for i, part in enumerate(parts):
        if len(part) != len(parts[0]):
            raise InvalidInput(f"matrix[{i}]", f"must have {len(parts[0])} rows, as matrix[0] has", f"{len(part)}")
    return np.hstack(parts)


def _first(value: Any) -> Any:
    try:
        return np.asarray(value[0])
    except Exception:  # a ragged list, which _matrix refuses
        return 0.0
