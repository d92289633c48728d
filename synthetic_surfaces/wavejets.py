"""Polynomial surfaces given by Wavejets coefficients, and the saddles among them."""

from __future__ import annotations

from abc import abstractmethod
from fractions import Fraction
from functools import cached_property
from math import comb
from typing import ClassVar

import numpy as np

from pdtheory.conventions import wavejets_table
from pdtheory.pointset.cloud import FloatArray
from synthetic_surfaces.description import Description
from synthetic_surfaces.height import EXTENT, HeightSurface
from synthetic_surfaces.parameters import Parameter, Parameters, Table

AMPLITUDE = Parameter("amplitude", 1, "height at distance 1 along a maximum", 1e-9, 1e9)


class WavejetsSurface(HeightSurface):
    """The graph of sum phi_{k,n} r^k e^{i n theta}, a polynomial in x and y."""

    @property
    @abstractmethod
    def table(self) -> Table:
        """The exact coefficients phi_{k,n}, n >= 0, in the frame of the axes at the origin."""

    @cached_property
    def _terms(self) -> list[tuple[int, int, complex]]:
        """All terms c w^a conj(w)^b with w = x + i y, negative frequencies included."""
        terms = []
        for (order, frequency), (real, imaginary) in self.table.items():
            value = complex(float(real), float(imaginary))
            up, down = (order + frequency) // 2, (order - frequency) // 2
            terms.append((up, down, value))
            if frequency:
                terms.append((down, up, value.conjugate()))
        return terms

    def height(self, x: FloatArray, y: FloatArray) -> FloatArray:
        w = x + 1j * y
        total = np.zeros(np.shape(w), dtype=complex)
        for up, down, value in self._terms:
            total += value * w**up * np.conj(w) ** down
        return np.asarray(total.real)

    def gradient(self, x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
        # For real f the Wirtinger derivative is df/dw = (f_x - i f_y) / 2.
        w = x + 1j * y
        total = np.zeros(np.shape(w), dtype=complex)
        for up, down, value in self._terms:
            if up:
                total += up * value * w ** (up - 1) * np.conj(w) ** down
        return 2.0 * total.real, -2.0 * total.imag

    def describe(self) -> Description:
        """Return the polynomial in x and y, expanded."""
        coefficients: dict[tuple[int, int], Fraction] = {}
        for (order, frequency), (real, imaginary) in self.table.items():
            twice = 1 if frequency == 0 else 2
            # r^k e^{i n theta} = (x + i y)^n (x^2 + y^2)^((k - n) / 2)
            for power in range(frequency + 1):
                # i^power times the coefficient; its real part counts.
                part = (real, -imaginary, -real, imaginary)[power % 4]
                for lift in range((order - frequency) // 2 + 1):
                    key = (order - power - 2 * lift, power + 2 * lift)
                    count = comb(frequency, power) * comb((order - frequency) // 2, lift)
                    coefficients[key] = coefficients.get(key, Fraction(0)) + twice * count * part
        ordered = sorted(coefficients.items(), key=lambda item: (sum(item[0]), -item[0][0]))
        text = "".join(_term(value, i, j) for (i, j), value in ordered if value)
        return Description("height", (text.removeprefix("+") or "0",))


def _term(value: Fraction, i: int, j: int) -> str:
    """Return ``+value*x**i*y**j``, with nothing that can be left out."""
    parts = [str(abs(value))] if abs(value) != 1 or i == j == 0 else []
    parts += [
        f"{name}**{power}".removesuffix("**1") for name, power in (("x", i), ("y", j)) if power
    ]
    return ("-" if value < 0 else "+") + "*".join(parts)


class Saddle(WavejetsSurface):
    """z = amplitude r^n cos(n theta): the maxima of order n are an n-RoSy, other orders vanish."""

    name = "saddle"
    summary = "n-fold saddle z = amplitude * Re (x + i y)^folds"
    parameters: ClassVar[Parameters] = (
        Parameter("folds", 3, "number of ridges, the order that does not vanish", 2, 24, "integer"),
        AMPLITUDE,
        EXTENT,
    )

    @property
    def table(self) -> Table:
        folds = self.values["folds"]
        return {(folds, folds): (self.values["amplitude"] / 2, Fraction(0))}


class Monkey(Saddle):
    """The monkey saddle z = x^3 - 3 x y^2."""

    name = "monkey"
    summary = "monkey saddle z = amplitude * (x^3 - 3 x y^2)"
    parameters: ClassVar[Parameters] = (AMPLITUDE, EXTENT)

    @property
    def table(self) -> Table:
        return {(3, 3): (self.values["amplitude"] / 2, Fraction(0))}


class Octopus(Saddle):
    """The octopus saddle z = Re (x + i y)^8."""

    name = "octopus"
    summary = "octopus saddle z = amplitude * Re (x + i y)^8"
    parameters: ClassVar[Parameters] = (AMPLITUDE, EXTENT)

    @property
    def table(self) -> Table:
        return {(8, 8): (self.values["amplitude"] / 2, Fraction(0))}


class Order3Family(WavejetsSurface):
    """Order 3 alone, with phi_31 / phi_33 free: three maxima inside the deltoid, one outside."""

    name = "order3"
    summary = "order-3 family: phi_33 fixed, phi_31 = (real + i imaginary) phi_33"
    parameters: ClassVar[Parameters] = (
        Parameter("real", 0, "real part of phi_31 / phi_33; the deltoid ends at 3", -20, 20),
        Parameter("imaginary", 0, "imaginary part of phi_31 / phi_33", -20, 20),
        Parameter("phi33", "1/2", "phi_33", 1e-9, 1e9),
        EXTENT,
    )

    @property
    def table(self) -> Table:
        phi33 = self.values["phi33"]
        return {
            (3, 1): (self.values["real"] * phi33, self.values["imaginary"] * phi33),
            (3, 3): (phi33, Fraction(0)),
        }


class AnyWavejets(WavejetsSurface):
    """The surface of any Wavejets table."""

    name = "wavejets"
    summary = "polynomial surface of given Wavejets coefficients phi_{k,n}"
    parameters: ClassVar[Parameters] = (
        Parameter(
            "table",
            "2,2:1/4; 3,3:1/4",
            "coefficients as k,n:value, separated by semicolons",
            high=24,
            kind="table",
        ),
        EXTENT,
    )

    @property
    def table(self) -> Table:
        table: Table = self.values["table"]
        return table


class RandomPolynomial(WavejetsSurface):
    """A polynomial with random Wavejets coefficients, tangent to the plane at the origin."""

    name = "polynomial"
    summary = "random polynomial patch of given degree, tangent to z = 0 at the origin"
    parameters: ClassVar[Parameters] = (
        Parameter("degree", 5, "degree of the polynomial", 2, 24, "integer"),
        Parameter("seed", 0, "seed of the coefficients", 0, 2**31, "integer"),
        Parameter("roughness", "1/4", "size of phi_{k,n} times extent^(k-1)", 0, 100),
        EXTENT,
    )

    @cached_property
    def _random(self) -> Table:
        # Sixteenths keep the exact expression short.
        rng = np.random.default_rng(self.values["seed"])
        table: Table = {}
        for order, frequency in wavejets_table(self.values["degree"]):
            parts = [Fraction(int(part), 16) for part in rng.integers(-16, 17, 2)]
            if order >= 2:
                size = self.values["roughness"] * Fraction(self.values["extent"]) ** (1 - order)
                table[order, frequency] = (
                    size * parts[0],
                    size * parts[1] if frequency else Fraction(0),
                )
        return table

    @property
    def table(self) -> Table:
        return self._random
