"""The reports, and the page of the docs that is one of them."""

import re
from pathlib import Path
from xml.etree import ElementTree

import pytest

from pdtheory.errors import InputError, MissingDependencyError
from pdtheory.paper import report
from pdtheory.paper.claims import CLAIMS, claim
from pdtheory.paper.report_styles import sympy_version

pytest.importorskip("matplotlib")

PAGE = Path(__file__).parents[2] / "docs" / "paper.md"


@pytest.fixture(scope="module")
def ordered(results):
    return [results[entry.id] for entry in CLAIMS]


def test_page_of_the_docs_is_up_to_date(ordered):
    page = PAGE.read_text(encoding="utf-8")
    if f"(SymPy {sympy_version()})" not in page:
        pytest.skip("another version of SymPy writes expressions in another order")
    assert page == report.compose(ordered, PAGE), (
        "docs/paper.md is out of date; run: pdtheory verify --report docs/paper.md"
    )
    for name in re.findall(r"\]\((paper_figures/[a-z]+\.svg)\)", page):
        assert (PAGE.parent / name).is_file()


def test_html_stands_alone(ordered, tmp_path):
    pytest.importorskip("latex2mathml")
    target = tmp_path / "paper.html"
    assert report.write_report(ordered, target) == [target]
    text = target.read_text(encoding="utf-8")
    assert not re.search(r'src="(?!data:)|href="(?!#)', text), "nothing may come from elsewhere"
    anchors = set(re.findall(r'id="([a-z0-9-]+)"', text))
    assert set(re.findall(r'href="#([a-z0-9-]+)"', text)) <= anchors
    assert 'href="#k-rosy"' in text
    assert text.count("data:image/svg+xml;base64,") == 4
    formulas = re.findall(r"<math .*?</math>", text)
    assert len(formulas) > 500
    for formula in formulas:
        ElementTree.fromstring(formula)
        # An unknown LaTeX command would stay as text with its backslash.
        assert "\\" not in formula
        assert "&#x0005C;" not in formula
    outside = re.sub(r"<math .*?</math>|<code>.*?</code>|<style>.*?</style>", "", text, flags=re.S)
    assert "$" not in outside
    for entry in CLAIMS:
        assert f'<h3 id="{entry.id}">' in text


def test_latex_is_well_formed(ordered, tmp_path):
    target = tmp_path / "paper.tex"
    written = report.write_report(ordered, target)
    assert sorted(path.name for path in written[1:]) == [
        "astroid.pdf",
        "deltoid.pdf",
        "family.pdf",
        "triples.pdf",
    ]
    text = target.read_text(encoding="utf-8")
    plain = re.sub(r"\\[{}$%#&_\\]", "", text)
    assert plain.count("{") == plain.count("}")
    assert plain.count("$") % 2 == 0
    assert "\0" not in text
    opened = re.findall(r"\\begin\{(\w+)\}", text)
    closed = re.findall(r"\\end\{(\w+)\}", text)
    assert sorted(opened) == sorted(closed)
    # Outside mathematics these signs must be escaped.
    prose = re.sub(r"\$[^$]*\$|\\includegraphics.*", "", plain)
    assert not re.search(r"[\^_#&]", prose)
    assert text.count(r"\includegraphics") == 4


def test_markdown_figures_are_the_same_each_time(tmp_path):
    found = [claim("order3-discriminant").run((2, 3))]
    first = report.write_report(found, tmp_path / "a.md")
    second = report.write_report(found, tmp_path / "b.md")
    assert [path.name for path in first] == ["a.md", "deltoid.svg"]
    assert first[1].read_bytes() == second[1].read_bytes()
    assert "](a_figures/deltoid.svg)" in first[0].read_text(encoding="utf-8")


def test_a_claim_that_fails_shows_it(tmp_path):
    pytest.importorskip("latex2mathml")
    broken = claim("lemma-gradient").run((2, 3), factor=lambda order: order + 1)
    for suffix, sign in (
        (".md", "DOES NOT HOLD"),
        (".html", "DOES NOT HOLD"),
        (".tex", "recorded"),
    ):
        text = report.compose([broken], tmp_path / f"paper{suffix}")
        assert sign in text
        assert "not established" in text


def test_unknown_suffix_and_missing_library_are_refused(tmp_path, monkeypatch):
    with pytest.raises(InputError, match=r"\.docx"):
        report.check_requirements(tmp_path / "paper.docx")
    monkeypatch.setattr(report, "find_spec", lambda name: None)
    with pytest.raises(MissingDependencyError, match="matplotlib and latex2mathml"):
        report.check_requirements(tmp_path / "paper.html")
