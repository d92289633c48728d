"""The exact description of a surface, as text that the exact side can read."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Description:
    """What a surface is, without rounding.

    Attributes
    ----------
    kind : {"height", "implicit", "parametric", "cone", "pieces"}
        ``height``: z = expression in x, y. ``implicit``: expression in x, y, z equal to 0.
        ``parametric``: three expressions in u, v. ``cone``: z = r h(angle), linear between `rays`.
        ``pieces``: several smooth pieces, said in words.
    expressions : tuple of str
        Formulas in the syntax of :func:`pdtheory.exact.parse_expression`; empty for cones and
        pieces.
    rays : tuple of (str, str)
        For a cone: angle in degrees and slope of h along that ray, both as formulas.
    words : str
        One sentence for people.
    """

    kind: Literal["height", "implicit", "parametric", "cone", "pieces"]
    expressions: tuple[str, ...] = ()
    rays: tuple[tuple[str, str], ...] = ()
    words: str = ""

    @property
    def variables(self) -> tuple[str, ...]:
        """The names that occur in the formulas."""
        return {
            "height": ("x", "y"),
            "implicit": ("x", "y", "z"),
            "parametric": ("u", "v"),
        }.get(self.kind, ())

    def __str__(self) -> str:
        if self.kind == "height":
            return f"z = {self.expressions[0]}"
        if self.kind == "implicit":
            return f"{self.expressions[0]} = 0"
        if self.kind == "parametric":
            return f"(u, v) -> ({', '.join(self.expressions)})"
        if self.kind == "cone":
            rays = ", ".join(f"{angle}: {slope}" for angle, slope in self.rays)
            return f"z = r h(angle), linear between the rays (degrees: slope) {rays}"
        return self.words
