"""The report of the checked paper: Markdown, HTML that works offline, or LaTeX.

The formats are styles of one walk over the results (:func:`compose`). Nothing in a report depends
on the time or the machine, so the same claims give the same text.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from importlib.util import find_spec
from itertools import groupby
from pathlib import Path

from pdtheory.atomic import atomic_path
from pdtheory.errors import FileAccessError, InputError, MissingDependencyError
from pdtheory.paper.claims.core import Result, Verdict

#: Formats by suffix.
SUFFIXES = (".html", ".md", ".tex")

TITLE = "What is true in the paper"

_INTRODUCTION = (
    "Every statement of *Arbitrary order principal directions and how to compute them* (Digne, "
    "Valette, Chaine, Béarzi), checked by computation. A verdict is not typed in: it follows from "
    "the steps of the certificate below it, which are computed anew each time, and "
    "`pdtheory verify` fails if one comes out differently. Theorems that correct the paper, and "
    "eigenpairs known from elsewhere, follow at the end.",
    r"Notation: $f = T_k v^k$ is the binary form of order $k$ in $v = (x, y) = (\cos t, \sin t)$, "
    r"$F = x f_y - y f_x = \mathrm{d}f / \mathrm{d}t$, $g = f / k! = \sum_n \phi_n e^{i n t}$ with "
    r"$n = k \bmod 2$, $u = e^{2 i t}$ and $P(u) = \sum_n n\, \phi_n u^{(k + n)/2}$. Certificates "
    "give their identities and numbers in the notation of SymPy.",
)

_VERDICTS = {
    Verdict.PROVED: "holds as printed; where a sharper statement is true it is given.",
    Verdict.PROVED_STRONGER: "holds under the hypothesis that is added, and fails without it.",
    Verdict.REFUTED: "fails inside its own hypotheses, wholly or in part: an exact counterexample "
    "and the corrected statement with its proof are given.",
    Verdict.MISPRINT: "contradicts itself or what it quotes; the correction is evident.",
    Verdict.CONFIGURATION: "true of some configurations, false of others; one of each is given.",
    Verdict.NOT_ESTABLISHED: "the computation did not come out as the claim says.",
}


def check_requirements(target: Path) -> str:
    """Return the suffix of a report, or refuse it before any claim is run.

    Raises
    ------
    InputError
        If the suffix is not one of the three.
    MissingDependencyError
        If matplotlib (figures) or, for HTML, latex2mathml is not installed.
    FileAccessError
        If a file stands where the folder of figures is to be.
    """
    suffix = target.suffix.lower()
    if suffix not in SUFFIXES:
        raise InputError(
            f"cannot write the report {target}: its suffix must be one of {', '.join(SUFFIXES)}."
        )
    needed = ["matplotlib", *(["latex2mathml"] if suffix == ".html" else [])]
    missing = [name for name in needed if find_spec(name) is None]
    if missing:
        raise MissingDependencyError(
            f"a {suffix} report needs {' and '.join(missing)}; "
            f"install it with `pip install {' '.join(missing)}` (extra figures)."
        )
    folder = target.with_name(_figure_folder(target))
    if suffix != ".html" and folder.exists() and not folder.is_dir():
        raise FileAccessError(
            f"cannot write the figures of {target}: {folder} is a file, and a folder of that name "
            "is needed; move the file away."
        )
    return suffix


def write_report(results: Sequence[Result], target: Path) -> list[Path]:
    """Write the report in the format of the suffix.

    HTML is one file; the figures of Markdown and LaTeX go to a folder ``<stem>_figures`` beside it.

    Parameters
    ----------
    results
        What the claims gave.
    target
        A .html, .md or .tex file.

    Returns
    -------
    list of Path
        The files written, the report first.

    Raises
    ------
    InputError, MissingDependencyError
        As :func:`check_requirements`.
    FileAccessError
        If a file or the folder cannot be written.
    """
    from pdtheory.paper.report_figures import figures_of, rendered

    suffix = check_requirements(target)
    text = compose(results, target)
    written = [target]
    with atomic_path(target) as path:
        path.write_text(text, encoding="utf-8")
    if suffix != ".html":
        kind = {".md": "svg", ".tex": "pdf"}[suffix]
        folder = target.with_name(_figure_folder(target))
        try:
            folder.mkdir(exist_ok=True)
        except OSError as error:
            raise FileAccessError(f"cannot make the folder {folder}: {error.strerror}.") from error
        for figure in figures_of(result.claim.id for result in results):
            written.append(folder / f"{figure.name}.{kind}")
            with atomic_path(written[-1]) as path:
                path.write_bytes(rendered(figure, kind))
    return written


def compose(results: Sequence[Result], target: Path) -> str:
    """Return the text of the report that is to stand at `target`."""
    from pdtheory.paper.report_figures import figures_of
    from pdtheory.paper.report_styles import STYLES

    names = [result.claim.id for result in results]
    style = STYLES[check_requirements(target)](_figure_folder(target), names)
    tally = Counter(result.verdict for result in results)
    failed = [result.claim.id for result in results if not result.holds]
    out = [style.head(TITLE), *map(style.paragraph, _INTRODUCTION)]
    out.append(
        style.paragraph(
            f"{len(results)} claims, {len(results) - len(failed)} of which come out as recorded"
            + (f"; these do not: {', '.join(failed)}." if failed else ".")
        )
    )
    out.append(
        style.items(f"*{v.value}* ({tally[v]}): {_VERDICTS[v]}" for v in Verdict if tally[v])
    )
    for title, group in groupby(results, key=lambda result: result.claim.section):
        out.append(style.section(title))
        for result in group:
            out.append(style.claim(result))
            out += map(style.figure, figures_of([result.claim.id]))
    out.append(style.foot())
    return "\n".join(out)


def _figure_folder(target: Path) -> str:
    return f"{target.stem}_figures"
