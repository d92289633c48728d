import pytest

from pdtheory.conventions import (
    ORDER_COLOURS,
    UNANSWERED,
    Kind,
    Status,
    frequencies,
    wavejets_table,
)


@pytest.mark.parametrize("order", range(12))
def test_frequencies_have_the_parity_of_the_order(order: int) -> None:
    values = list(frequencies(order))
    assert values[-1] == order
    assert all(n >= 0 and (order - n) % 2 == 0 for n in values)
    # A real row has k + 1 real unknowns, like a form of degree k.
    assert sum(1 if n == 0 else 2 for n in values) == order + 1


def test_table_is_sorted_and_complete() -> None:
    table = wavejets_table(10)
    assert table == sorted(table)
    assert sum(1 if n == 0 else 2 for _, n in table) == 66


def test_unanswered_flags() -> None:
    assert Status.TOO_FEW_NEIGHBOURS.unanswered
    assert not (Status.DEGREE_LOWERED | Status.ONE_SIDED).unanswered
    assert Status.NON_FINITE in UNANSWERED


def test_labels_and_colours() -> None:
    assert [kind.label for kind in Kind] == ["min", "inflection", "max"]
    assert len(set(ORDER_COLOURS.values())) == len(ORDER_COLOURS)
