"""Every error pdtheory raises on purpose.

Each message is one sentence that names what was wrong, the offending value, and what to do.
The command line prints it and exits with code 2; Blender reports it as an error.
"""

from __future__ import annotations


class PdtheoryError(Exception):
    """Base of all errors raised deliberately by pdtheory."""


class InputError(PdtheoryError, ValueError):
    """An argument or its content cannot be used."""


class ExpressionError(InputError):
    """A formula does not parse, or uses something that is not allowed."""


class FileFormatError(InputError):
    """A file exists but does not hold what was expected."""


class FileAccessError(PdtheoryError, OSError):
    """A file cannot be read or written."""


class MissingDependencyError(PdtheoryError, ImportError):
    """An optional library is needed and is not installed."""


class ComputationError(PdtheoryError, ArithmeticError):
    """A computation cannot give the answer that was asked for."""


class Cancelled(PdtheoryError):
    """Raised by a progress callback to stop the work in hand."""
