"""Write files whole or not at all."""

from __future__ import annotations

import os
import shutil
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
    the process is interrupted. As with a plain ``open()``, a file that stood there keeps its
    permissions, and where `target` is a symbolic link, the file that it points to is written.

    Parameters
    ----------
    target
        The file to write.

    Raises
    ------
    FileAccessError
        If the folder does not exist or cannot be written to, `target` is a folder, or the block or
        the replacement fails for a reason of the system, such as a full disk.
    """
    goal = Path(os.path.realpath(target))
    if goal.is_dir():
        raise FileAccessError(f"cannot write {target}: it is a folder; give a file name.")
    if not goal.parent.is_dir():
        raise FileAccessError(
            f"cannot write {target}: the folder {goal.parent} does not exist; create it first."
        )
    try:
        handle, name = tempfile.mkstemp(
            prefix=f".{goal.stem}-", suffix=goal.suffix, dir=goal.parent
        )
    except OSError as error:
        raise FileAccessError(
            f"cannot write {target}: {error.strerror}; choose a folder you may write to."
        ) from error
    os.close(handle)
    temporary = Path(name)
    try:
        yield temporary
        _permit(temporary, goal)
        temporary.replace(goal)
    except FileAccessError:
        raise
    except OSError as error:
        raise FileAccessError(f"cannot write {target}: {error.strerror or error}.") from error
    finally:
        temporary.unlink(missing_ok=True)


def _permit(temporary: Path, goal: Path) -> None:
    """Give a private new file the permissions of the one it replaces, or of a plain open()."""
    if goal.exists():
        shutil.copymode(goal, temporary)
        return
    mask = os.umask(0)
    os.umask(mask)
    temporary.chmod(0o666 & ~mask)
