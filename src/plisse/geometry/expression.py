"""Height fields z(x, y) as text: read by a closed list of rules, differentiated exactly, never executed."""

import ast
import warnings
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from plisse.errors import InvalidDesign

__all__ = ["Jet", "checked_formula", "height_expression", "jet_of"]

MAX_LENGTH, MAX_NODES, MAX_DEPTH = 1000, 300, 60
LARGEST = 1e12
ALLOWED = "numbers, {names}, pi, + - * / **, {functions} and {last}"


@dataclass(frozen=True, eq=False)
class Jet:
    """A value with its derivatives up to the second: `part` (6, N) holds z, zx, zy, zxx, zxy, zyy; (6, 1) for constants."""

    part: np.ndarray

    def __add__(self, other: "Jet") -> "Jet":
        return Jet(self.part + other.part)

    def __sub__(self, other: "Jet") -> "Jet":
        return Jet(self.part - other.part)

    def __mul__(self, other: "Jet") -> "Jet":
        for constant, factor in ((self, other), (other, self)):
            if constant.part.shape[1] == 1 and not constant.part[1:].any():
                return Jet(constant.part[0] * factor.part)
        (a, ax, ay, axx, axy, ayy), (b, bx, by, bxx, bxy, byy) = self.part, other.part
        return Jet(np.stack([a * b, ax * b + a * bx, ay * b + a * by, axx * b + 2 * ax * bx + a * bxx,
                             axy * b + ax * by + ay * bx + a * bxy, ayy * b + 2 * ay * by + a * byy]))

    def __truediv__(self, other: "Jet") -> "Jet":
        v = other.part[0]
        return self * other.through(1 / v, -1 / v**2, 2 / v**3)

    def through(self, value: np.ndarray, first: np.ndarray, second: np.ndarray) -> "Jet":
        """h(self) for a function with the given value and derivatives at self: the chain rule."""
        _, x, y, xx, xy, yy = self.part
        return Jet(np.stack([value, first * x, first * y, first * xx + second * x * x,
                             first * xy + second * x * y, first * yy + second * y * y]))


def _power(base: Jet, exponent: Jet) -> Jet:
    """Constant exponents work for negative bases too; others are exp(exponent · log base)."""
    if exponent.part[1:].any():
        return _exp(exponent * _log(base))
    n, v = exponent.part[0], base.part[0]
    if len(n) == 1 and n[0] > 1 and n[0] == round(n[0]):
        k = int(n[0])
        return base.through(v**k, k * v ** (k - 1), k * (k - 1) * v ** (k - 2))
    first = np.where(n == 0, 0.0, n * v ** np.where(n == 0, 1.0, n - 1))
    flat = (n == 0) | (n == 1)
    return base.through(v**n, first, np.where(flat, 0.0, n * (n - 1) * v ** np.where(flat, 1.0, n - 2)))


def _sin(a: Jet) -> Jet:
    s, c = np.sin(a.part[0]), np.cos(a.part[0])
    return a.through(s, c, -s)


def _cos(a: Jet) -> Jet:
    s, c = np.sin(a.part[0]), np.cos(a.part[0])
    return a.through(c, -s, -c)


def _tan(a: Jet) -> Jet:
    t = np.tan(a.part[0])
    return a.through(t, 1 + t**2, 2 * t * (1 + t**2))


def _exp(a: Jet) -> Jet:
    e = np.exp(a.part[0])
    return a.through(e, e, e)


def _log(a: Jet) -> Jet:
    v = a.part[0]
    return a.through(np.log(v), 1 / v, -1 / v**2)


def _sqrt(a: Jet) -> Jet:
    r = np.sqrt(a.part[0])
    return a.through(r, 0.5 / r, -0.25 / r**3)


def _abs(a: Jet) -> Jet:
    return a.through(np.abs(a.part[0]), np.sign(a.part[0]), np.zeros_like(a.part[0]))


FUNCTIONS: dict[str, Callable[[Jet], Jet]] = {"sin": _sin, "cos": _cos, "tan": _tan, "exp": _exp, "log": _log,
                                              "sqrt": _sqrt, "abs": _abs}
OPERATORS: dict[type, Callable[[Jet, Jet], Jet]] = {ast.Add: Jet.__add__, ast.Sub: Jet.__sub__, ast.Mult: Jet.__mul__,
                                                    ast.Div: Jet.__truediv__, ast.Pow: _power}


def height_expression(text: str) -> Callable[[np.ndarray, np.ndarray], np.ndarray]:
    """The function (x, y) → (6, N) with z, zx, zy, zxx, zxy, zyy; nan where the expression is not defined.

    Raises InvalidDesign, naming what is not allowed, for anything but a formula of bounded size.
    """
    tree = checked_formula(text)

    def heights(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        x, y = (np.asarray(a, dtype=float).ravel() for a in np.broadcast_arrays(x, y))
        with np.errstate(all="ignore"):
            part = jet_of(tree, {"x": _seed(x, 1), "y": _seed(y, 2)}).part
        return np.where(np.isfinite(part).all(axis=0), part, np.full((6, len(x)), np.nan))

    return heights


def checked_formula(text: str, names: tuple[str, ...] = ("x", "y"), what: str = "the height",
                    functions: tuple[str, ...] = tuple(FUNCTIONS)) -> ast.expr:
    """The syntax tree of a formula in `names` that uses these `functions`; `jet_of` gives its values.

    Raises InvalidDesign, naming what is not allowed, for anything but a formula of bounded size.
    """
    tree = _parsed(text, names, what)
    _check(tree, text, names, what, functions)
    return tree


def jet_of(tree: ast.expr, seeds: dict[str, Jet]) -> Jet:
    """Value and derivatives of a checked formula where its names have the values `seeds`, real or complex."""
    match tree:
        case ast.Constant(value=int() | float() as value):
            return _constant(value)
        case ast.Name(id=name):
            return _constant(np.pi) if name == "pi" else seeds[name]
        case ast.UnaryOp(op=op, operand=operand):
            inner = jet_of(operand, seeds)
            return Jet(-inner.part) if isinstance(op, ast.USub) else inner
        case ast.BinOp(left=left, op=op, right=right):
            return OPERATORS[type(op)](jet_of(left, seeds), jet_of(right, seeds))
        case ast.Call(func=ast.Name(id=name), args=[argument]):
            return FUNCTIONS[name](jet_of(argument, seeds))
    raise AssertionError("checked before")


def _parsed(text: str, names: tuple[str, ...], what: str) -> ast.expr:
    if not isinstance(text, str) or not text.strip():
        example = " * ".join(["0.1", *names] if len(names) > 1 else [names[0], names[0]])
        raise InvalidDesign(f"{what} is empty; give an expression in {' and '.join(names)}, for instance \"{example}\"")
    if len(text) > MAX_LENGTH:
        raise InvalidDesign(f"{what} has {len(text)} characters; at most {MAX_LENGTH} are read")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return ast.parse(text.strip(), mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        reason = error.msg if isinstance(error, SyntaxError) else "too deeply nested or not text"
        raise InvalidDesign(f"{what} {_short(text)} is no expression in {' and '.join(names)} ({reason})") from None


def _check(tree: ast.expr, text: str, names: tuple[str, ...], what: str, functions: tuple[str, ...]) -> None:
    """Walk the tree without recursion and refuse everything that is not on the list."""
    stack, nodes = [(tree, 1)], 0
    while stack:
        node, depth = stack.pop()
        nodes += 1
        if nodes > MAX_NODES or depth > MAX_DEPTH:
            raise InvalidDesign(f"{what} {_short(text)} is too long or too deeply nested")
        children = _children(node, names, functions)
        if children is None:
            hint = "; powers are written **" if isinstance(getattr(node, "op", None), ast.BitXor) else ""
            part = ast.get_source_segment(text.strip(), node) or type(node).__name__
            allowed = ALLOWED.format(names=", ".join(names), functions=", ".join(functions[:-1]), last=functions[-1])
            if isinstance(node, ast.Constant) and type(node.value) in (int, float):
                raise InvalidDesign(f"{what} {_short(text)} contains {_short(part)}, a number out of range; they go up "
                                    f"to {LARGEST:.0e}")
            raise InvalidDesign(f"{what} {_short(text)} contains {_short(part)}; allowed are {allowed}{hint}")
        stack += [(child, depth + 1) for child in children]


def _children(node: ast.expr, names: tuple[str, ...], functions: tuple[str, ...]) -> list[ast.expr] | None:
    """What an allowed node is made of, None for one that is not allowed."""
    match node:
        case ast.Constant(value=int() | float() as value) if not isinstance(value, bool):
            return [] if abs(value) <= LARGEST else None
        case ast.Name(id=name) if name == "pi" or name in names:
            return []
        case ast.UnaryOp(op=ast.UAdd() | ast.USub(), operand=operand):
            return [operand]
        case ast.BinOp(left=left, op=op, right=right) if type(op) in OPERATORS:
            return [left, right]
        case ast.Call(func=ast.Name(id=name), args=[argument], keywords=[]) if name in functions:
            return [argument]
    return None


def _seed(value: np.ndarray, slot: int) -> Jet:
    part = np.zeros((6, len(value)))
    part[0], part[slot] = value, 1
    return Jet(part)


def _constant(value: float) -> Jet:
    part = np.zeros((6, 1))  # one column is enough; it is broadcast
    part[0] = value
    return Jet(part)


def _short(text: str) -> str:
    return repr(text if len(text) <= 40 else text[:37] + "...")
