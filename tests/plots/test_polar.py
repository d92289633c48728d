"""The polar plot, by the shapes it is made of and by the files it writes."""

from __future__ import annotations

import sys
import xml.etree.ElementTree as ET
from math import pi

import numpy as np
import pytest

from pdtheory.conventions import Kind, frequencies, order_colour
from pdtheory.errors import FileAccessError, InputError, MissingDependencyError
from pdtheory.plots import polar
from pdtheory.plots.polar import PolarTerm, figure_pixels, figure_svg, polar_figure, save_figure

pytest.importorskip("matplotlib", reason="matplotlib is not installed (extra figures)")

#: cos(3t) has its maxima at 0, 120 and 240 degrees.
MONKEY = PolarTerm(
    3,
    [0.0, 0.5],
    [(i * pi / 3, Kind.MAXIMUM if i % 2 == 0 else Kind.MINIMUM, 0.1) for i in range(6)],
)


def line(axes, predicate):
    return [item for item in axes.lines if predicate(item)]


def test_values_are_the_fourier_sum_over_all_frequencies():
    rng = np.random.default_rng(3)
    theta = rng.uniform(0, 2 * pi, 20)
    for order in range(1, 9):
        count = len(frequencies(order))
        phi = rng.normal(size=count) + 1j * rng.normal(size=count)
        if order % 2 == 0:
            phi[0] = phi[0].real
        expected = np.zeros(20, complex)
        for n, value in zip(frequencies(order), phi, strict=True):
            expected += value * np.exp(1j * n * theta)
            if n:
                expected += np.conj(value) * np.exp(-1j * n * theta)
        np.testing.assert_allclose(PolarTerm(order, phi).values(theta), expected.real, atol=1e-12)
        assert np.abs(expected.imag).max() < 1e-12


def test_the_curve_is_g_and_the_rays_end_on_it():
    figure = polar_figure([MONKEY], title="monkey saddle")
    (axes,) = figure.axes
    (curve,) = line(axes, lambda item: len(item.get_xdata()) == 721 and item.get_linestyle() == "-")
    theta, radius = curve.get_data()
    np.testing.assert_allclose((radius - 1) / 0.55, np.cos(3 * theta), atol=1e-12)
    dots = line(axes, lambda item: item.get_marker() == "o")
    assert len(dots) == 6
    filled = [item for item in dots if item.get_markerfacecolor() == order_colour(3)]
    assert sorted(float(np.degrees(item.get_xdata()[0])) for item in filled) == pytest.approx(
        [0.0, 120.0, 240.0]
    )
    assert {round(float(item.get_ydata()[0]), 6) for item in filled} == {1.55}
    assert figure.get_suptitle() == "monkey saddle"
    assert {text.get_text() for text in axes.texts} >= {"0.0°", "120.0°", "240.0°", "order 3"}


def test_error_bars_reach_one_deviation_to_both_sides():
    figure = polar_figure([MONKEY])
    (axes,) = figure.axes
    arcs = line(axes, lambda item: len(item.get_xdata()) == 61)
    spans = sorted((float(a.get_xdata()[0]), float(a.get_xdata()[-1])) for a in arcs)
    np.testing.assert_allclose(spans, [[i * pi / 3 - 0.1, i * pi / 3 + 0.1] for i in range(6)])
    without = PolarTerm(3, [0.0, 0.5], [(0.0, Kind.MAXIMUM, float("nan"))])
    assert not line(polar_figure([without]).axes[0], lambda item: len(item.get_xdata()) == 61)


def test_exact_forms_are_drawn_with_their_exact_directions():
    from pdtheory.exact import BinaryForm

    term = PolarTerm.of_face(BinaryForm([1, 0, -3, 0]))
    theta = np.linspace(0, 6, 9)
    np.testing.assert_allclose(term.values(theta), np.cos(3 * theta) / 6, atol=1e-15)
    assert [(round(np.degrees(a)), int(kind)) for a, kind, _ in term.directions] == [
        (60 * i, 1 - 2 * (i % 2)) for i in range(6)
    ]
    cube = PolarTerm.of_face(BinaryForm([0, 0, 0, 1]))
    assert [int(kind) for _, kind, _ in cube.directions] == [0, 1, 0, -1]


def test_inflections_and_isotropic_orders_are_drawn():
    sine_cubed = PolarTerm(3, [-3j / 8, 1j / 8], [(0.0, Kind.INFLECTION, 0.0)])
    flat = PolarTerm(2, [0.0, 0.0])
    sphere = PolarTerm(2, [-0.5, 0.0])
    figure = polar_figure([sine_cubed, flat, sphere])
    assert any(item.get_marker() == "s" for item in figure.axes[0].lines)
    for axes in figure.axes[1:]:
        assert any(text.get_text() == "every direction" for text in axes.texts)
        assert not any("largest" in text.get_text() for text in axes.texts)


def test_what_is_largest_is_named():
    plain, scaled = MONKEY, PolarTerm(3, [0.0, 0.5], (), "strength")
    for term, words in ((plain, "largest |g| 1"), (scaled, "largest strength 1")):
        (axes,) = polar_figure([term]).axes
        assert any(text.get_text() == words for text in axes.texts)


def test_panels_do_not_overlap():
    figure = polar_figure([MONKEY] * 7)
    boxes = [axes.get_position() for axes in figure.axes]
    assert len(boxes) == 7
    for i, a in enumerate(boxes):
        assert -1e-9 <= a.x0 < a.x1 <= 1 + 1e-9
        assert -1e-9 <= a.y0 < a.y1 <= 1 + 1e-9
        for b in boxes[i + 1 :]:
            assert a.x1 <= b.x0 + 1e-9 or b.x1 <= a.x0 + 1e-9 or b.y1 <= a.y0 + 1e-9


@pytest.mark.parametrize("suffix", [".png", ".svg", ".pdf"])
def test_equal_numbers_give_equal_files(tmp_path, suffix):
    for name in ("a", "b"):
        save_figure(polar_figure([MONKEY]), tmp_path / f"{name}{suffix}")
    first, second = ((tmp_path / f"{name}{suffix}").read_bytes() for name in ("a", "b"))
    assert first == second
    assert len(first) > 1000
    assert sorted(path.name for path in tmp_path.iterdir()) == [f"a{suffix}", f"b{suffix}"]


def test_svg_stands_inside_a_page():
    root = ET.fromstring(figure_svg(polar_figure([MONKEY])))
    assert root.tag == "{http://www.w3.org/2000/svg}svg"
    assert "order 3" in "".join(root.itertext())


def test_pixels_are_those_of_the_file(tmp_path):
    from matplotlib.image import imread

    figure = polar_figure([MONKEY])
    pixels = figure_pixels(figure, 200)
    assert pixels.shape == (540, 480, 4)
    save_figure(figure, tmp_path / "a.png")
    np.testing.assert_array_equal(pixels, np.round(imread(tmp_path / "a.png") * 255))


def test_bad_input_is_refused(tmp_path, monkeypatch):
    with pytest.raises(InputError, match="no order to plot"):
        polar_figure([])
    with pytest.raises(InputError, match="order 2 are not finite"):
        polar_figure([PolarTerm(2, [np.nan, 0.0])])
    with pytest.raises(InputError, match=r"\.jpg is not known"):
        save_figure(polar_figure([MONKEY]), tmp_path / "a.jpg")
    with pytest.raises(FileAccessError, match="does not exist"):
        save_figure(polar_figure([MONKEY]), tmp_path / "absent" / "a.png")
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(MissingDependencyError, match="extra figures"):
        polar_figure([MONKEY])


def test_a_figure_of_pyplot_can_be_drawn_into():
    import matplotlib.pyplot as plt

    figure = plt.figure()
    assert polar_figure([MONKEY] * 2, figure=figure) is figure
    assert len(figure.axes) == 2
    assert figure.get_size_inches()[0] == pytest.approx(4.8)
    plt.close(figure)


def test_no_setting_of_the_process_changes_while_pixels_are_made(monkeypatch):
    import matplotlib
    from matplotlib.text import Text

    before, seen = dict(matplotlib.rcParams), []

    def watched(method):
        def call(*given, **named):
            seen.append(dict(matplotlib.rcParams) == before)
            return method(*given, **named)

        return call

    monkeypatch.setattr(polar, "_panel", watched(polar._panel))
    monkeypatch.setattr(Text, "draw", watched(Text.draw))
    figure_pixels(polar_figure([MONKEY], title="monkey saddle"), 50)
    assert len(seen) > 5
    assert all(seen)


def test_settings_are_put_back_after_a_file_is_written(tmp_path):
    import matplotlib

    before = dict(matplotlib.rcParams)
    figure = polar_figure([MONKEY])
    save_figure(figure, tmp_path / "a.svg")
    figure_svg(figure)
    assert dict(matplotlib.rcParams) == before
