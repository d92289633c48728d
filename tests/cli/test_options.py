from pathlib import Path

import pytest

from pdtheory.cli.options import check_target, parse_orders
from pdtheory.errors import FileAccessError, InputError


@pytest.mark.parametrize(
    ("text", "orders"),
    [("2", (2,)), ("4,2,3", (2, 3, 4)), ("2:5", (2, 3, 4, 5)), (" 2, 4:6 ,5", (2, 4, 5, 6))],
)
def test_orders_are_read(text: str, orders: tuple[int, ...]) -> None:
    assert parse_orders(text) == orders


@pytest.mark.parametrize("text", ["", "x", "2,,3", "2:", "5:2", "0", "-3", "65", "2:1000000000"])
def test_bad_orders_are_refused(text: str) -> None:
    with pytest.raises(InputError, match="orders"):
        parse_orders(text)


def test_targets_are_checked_before_the_work(tmp_path: Path) -> None:
    check_target(tmp_path / "field.NPZ", (".npz",))
    with pytest.raises(InputError, match=r"\.txt is not known; use one of \.npz, \.ply"):
        check_target(tmp_path / "field.txt", (".npz", ".ply"))
    with pytest.raises(FileAccessError, match="create it first"):
        check_target(tmp_path / "absent" / "field.npz", (".npz",))
    (tmp_path / "folder.npz").mkdir()
    with pytest.raises(FileAccessError, match="is a folder"):
        check_target(tmp_path / "folder.npz", (".npz",))
