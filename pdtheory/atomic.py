"""Write files whole or not at all."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from pdtheory.errors import FileAccessError


@contextmanager
def atomic_path(target: str | os.PathLike[str]) -> Iterator[Path]:
    """Yield a temporary path beside `target` that replaces it when the block succeeds.

    The temporary file keeps the suffix of `target`, since many writers choose their format by it.
    Whatever stood at `target` stays untouched until the replacement, also when the block raises or
    the process is interrupted.

    Parameters
    ----------
    target
        The file to write.

    Raises
    ------
    FileAccessError
        If the folder does not exist or cannot be written to, or `target` is a folder.
    """
    goal = Path(target)
    if goal.is_dir():
        raise FileAccessError(f"cannot write {goal}: it is a folder; give a file name.")
    if not goal.parent.is_dir():
        raise FileAccessError(
            f"cannot write {goal}: the folder {goal.parent} does not exist; create it first."
        )
    try:
        handle, name = tempfile.mkstemp(
            prefix=f".{goal.stem}-", suffix=goal.suffix, dir=goal.parent
        )
    except OSError as error:
        raise FileAccessError(
            f"cannot write {goal}: {error.strerror}; choose a folder you may write to."
        ) from error
    os.close(handle)
    temporary = Path(name)
    try:
        yield temporary
        # mkstemp makes private files; give the result the permissions a plain open() would.
        mask = os.umask(0)
        os.umask(mask)
        temporary.chmod(0o666 & ~mask)
        try:
            temporary.replace(goal)
        except OSError as error:
            raise FileAccessError(f"cannot write {goal}: {error.strerror}.") from error
    finally:
        temporary.unlink(missing_ok=True)
