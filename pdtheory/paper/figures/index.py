"""One page with every picture, caption, check and number."""

from __future__ import annotations

import json
from collections.abc import Sequence
from html import escape
from pathlib import Path

from pdtheory.atomic import atomic_path
from pdtheory.paper.figures.outcome import Check, Job
from pdtheory.paper.figures.run import Made, versions

_STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; color: #222; max-width: 72rem; margin: 2rem auto;
       padding: 0 1rem; }
figure { margin: 0 0 3rem; } img { max-width: 100%; display: block; margin: 0 auto; }
h2 { border-top: 1px solid #ddd; padding-top: 1.5rem; }
table { border-collapse: collapse; font-size: 0.85rem; width: 100%; }
td, th { text-align: left; padding: 0.15rem 0.8rem 0.15rem 0; border-bottom: 1px solid #eee;
         vertical-align: top; }
td.number { font-variant-numeric: tabular-nums; white-space: nowrap; }
.holds { color: #17692d; } .fails { color: #b00020; font-weight: 600; }
details { font-size: 0.85rem; } pre { overflow-x: auto; background: #f7f7f7; padding: 0.6rem; }
.place { color: #666; }
"""


def write_index(made: Sequence[Made], job: Job, folder: Path) -> Path:
    """Write ``index.html`` for the figures of one run.

    Parameters
    ----------
    made
        The figures, skipped ones among them.
    job
        How they were made.
    folder
        Where their pictures are.

    Returns
    -------
    Path
        The page.
    """
    done = [each for each in made if each.outcome is not None]
    checks = [check for each in done if each.outcome for check in each.outcome.checks]
    failed = sum(not check.holds for check in checks)
    summary = (
        f"{len(done)} figures at {job.quality} quality, {len(checks)} checks, "
        + (f"{failed} of which fail" if failed else "all of which hold")
        + f"; {len(made) - len(done)} figures skipped."
    )
    body = "\n".join(_section(each, folder) for each in made)
    used = ", ".join(f"{escape(name)} {escape(text)}" for name, text in versions().items())
    page = (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>Figures</title><style>{_STYLE}</style></head><body>\n"
        f"<h1>Principal directions of arbitrary order: the figures</h1>\n<p>{escape(summary)}</p>\n"
        f"{body}\n<h2>Versions</h2>\n<p>{used}</p>\n</body></html>\n"
    )
    target = folder / "index.html"
    with atomic_path(target) as temporary:
        temporary.write_text(page, encoding="utf-8")
    return target


def _section(made: Made, folder: Path) -> str:
    figure = made.figure
    head = (
        f'<h2 id="{escape(figure.name)}">{escape(figure.name)}</h2>\n'
        f'<p class="place">Redraws: {escape(figure.redraws)}.</p>'
    )
    if made.outcome is None:
        return f"{head}\n<p>Skipped: {escape(made.skipped)}</p>"
    picture = ""
    if made.pictures:
        name = escape(made.pictures[0].relative_to(folder).as_posix())
        picture = f'<img src="{name}" alt="{escape(figure.caption)}">'
    rows = "\n".join(_row(check) for check in made.outcome.checks)
    data = json.dumps(
        {"parameters": made.outcome.parameters, "numbers": made.outcome.numbers},
        indent=1,
        default=float,
    )
    return (
        f"{head}\n<figure>{picture}<figcaption>{escape(figure.caption)}</figcaption></figure>\n"
        f"<table><tr><th>check</th><th>value</th><th>range</th><th></th><th>because</th></tr>\n"
        f"{rows}</table>\n"
        f"<details><summary>parameters and numbers ({made.seconds:.0f} s)</summary>"
        f"<pre>{escape(data)}</pre></details>"
    )


def _row(check: Check) -> str:
    low, high = (
        "" if abs(value) == float("inf") else f"{value:.4g}" for value in (check.low, check.high)
    )
    verdict = '<td class="holds">holds</td>' if check.holds else '<td class="fails">fails</td>'
    return (
        f'<tr><td>{escape(check.statement)}</td><td class="number">{check.value:.4g}</td>'
        f'<td class="number">{low} … {high}</td>{verdict}<td>{escape(check.because)}</td></tr>'
    )
