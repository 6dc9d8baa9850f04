"""What can go wrong, said in one sentence each: expected, found, where, what to do."""


class PlisseError(Exception):
    """Any failure that plisse foresees; its message is one sentence for the person at the keyboard."""


class InvalidDesign(PlisseError, ValueError):
    """A design that cannot be read or asks for something impossible."""


class InvalidMesh(InvalidDesign):
    """A reference mesh that cannot be read, or is no single surface that can be oriented."""


class TooLarge(InvalidDesign):
    """A design that needs more memory than is free where it is to be made; elsewhere or later it may be possible."""


class InvalidStructure(PlisseError, ValueError):
    """A mesh or file that is not a structure of planar faces along creases."""


class Infeasible(PlisseError, ArithmeticError):
    """Geometry that breaks down on the way: a pattern that degenerates, a strip that dies."""


class MissingExtra(PlisseError, ImportError):
    """An optional library that is not installed, with the command that installs it."""
