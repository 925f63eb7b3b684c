"""Exceptions. Each is an `Error`, and also the exception that Python has for such an error; and a warning."""


class Error(Exception):
    """The base of all exceptions of netmesh."""


class InvalidArgumentError(Error, ValueError):
    """An argument is out of its range. The message names it, its value and the range."""


class ArgumentTypeError(Error, TypeError):
    """An argument is of a type that it cannot have. The message names it and the type."""


class NonFiniteError(InvalidArgumentError):
    """A coordinate is infinite or NaN. The message names the point and the coordinate."""


class DimensionError(InvalidArgumentError):
    """Points have fewer than 2 or more than 8 coordinates."""


class CapacityError(InvalidArgumentError):
    """There are more points, vertices or simplices than ids."""


class DegenerateInputError(InvalidArgumentError):
    """Points have fewer than two distinct ones or, for a Delaunay triangulation, lie in a hyperplane."""


class LimitError(Error, RuntimeError):
    """The mesh needs more vertices than `max_vertices`, or larger numbers than doubles."""


class CancelledError(Error, RuntimeError):
    """The progress function answered `False`."""


class FileError(Error, OSError):
    """A file cannot be written. The message has the path and the system's reason.

    `errno` is the system's number for the reason, `filename` the path that was given.
    """

    def __str__(self) -> str:
        # This is the second argument of an `OSError` with three.
        return Error.__str__(self) if self.strerror is None else str(self.strerror)


class FormatError(Error, ValueError):
    """A file is not in its format. The message names the place."""


class StateError(Error, RuntimeError):
    """An object is in no state for the call."""


class OutOfMemoryError(Error, MemoryError):
    """An allocation failed."""


class InternalError(Error, RuntimeError):
    """A defect of the library: an internal check failed."""


class GradientEstimationWarning(RuntimeWarning):
    """The gradients of an interpolator have not converged within `maxiter` sweeps."""
