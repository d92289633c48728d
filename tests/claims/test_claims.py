"""Every claim holds, and none survives a wrong statement."""

import json
import re
from dataclasses import replace

import pytest

from pdtheory.errors import InputError
from pdtheory.paper.claims import (
    CLAIMS,
    Shows,
    Step,
    Verdict,
    claim,
    judge,
    run_claims,
    select,
)
from pdtheory.paper.claims.core import UP_TO
from tests.claims.corruptions import CORRUPTIONS

#: The statements of the audit, and the theorems that correct them.
IDS = [
    "tensor-contraction",
    "symmetry-definition",
    "e-eigen-real",
    "e-characteristic-roots",
    "taylor-first-terms",
    "taylor-tensor",
    "mixed-partials",
    "lemma-gradient",
    "theorem-equivalence",
    "extrema-or-critical",
    "wavejets-symmetry",
    "corollary-wavejets",
    "eigenvalue-link",
    "parity-even",
    "parity-odd",
    "count-2k",
    "polynomial-degree",
    "count-max-min",
    "order2-curvature",
    "krosy-iff",
    "order3-rank",
    "order3-triples",
    "saddles-rosy",
    "order3-one-or-three",
    "tjunction-impossible",
    "cube-edge-order3",
    "cube-corner-order2",
    "five-planes-order7",
    "isotropic-vanish",
    "continuity",
    "error-order",
    "extraction-exact",
    "z-gaussian",
    "k-rosy",
    "k-rosy-maxima",
    "order3-maxima",
    "maxima-interlacing",
    "order3-discriminant",
    "order4-discriminant",
    "two-frequency-hypocycloid",
    "complex-eigenpairs",
    "e-characteristic-polynomial",
    "irregular-tensors",
    "cone-fit",
    "cone-order3",
    "cone-creases",
    "cone-three-planes",
    "de-lathauwer",
    "power-sums",
    "expected-eigenlines",
]

CASES = [
    pytest.param(name, wrong, id=f"{name}: {title}")
    for name, wrongs in CORRUPTIONS.items()
    for title, wrong in wrongs.items()
]


def test_every_statement_is_a_claim():
    assert sorted(entry.id for entry in CLAIMS) == sorted(IDS)


@pytest.mark.parametrize("name", IDS)
def test_claim_holds(name, results):
    result = results[name]
    assert [step.text for step in result.steps if not step.holds] == []
    assert result.verdict is claim(name).verdict
    assert result.holds


def test_every_claim_can_fail():
    assert set(CORRUPTIONS) == set(IDS)


@pytest.mark.parametrize(("name", "wrong"), CASES)
def test_wrong_statement_is_refused(name, wrong):
    result = claim(name).run((2, 3, 4, 5, 6), **wrong)
    assert not result.holds
    assert result.verdict is Verdict.NOT_ESTABLISHED


@pytest.mark.slow
def test_every_claim_holds_to_order_24():
    failed = [found.claim.id for found in run_claims(orders=tuple(range(2, 25))) if not found.holds]
    assert failed == []


def test_texts_are_complete(results):
    for entry in CLAIMS:
        steps = results[entry.id].steps
        assert steps
        assert re.search(r"Section \d|Definition \d|19|20|Qi|Draisma", entry.place)
        for text in (entry.statement, entry.printed, *(step.text for step in steps)):
            assert text.count("$") % 2 == 0, text
            assert "  " not in text
        # A proof has data that a reader can check: an identity, numbers or counts.
        assert any(step.data for step in steps)


def test_scopes_name_the_orders():
    bounded = replace(claim("e-characteristic-polynomial"), scope=UP_TO, check=lambda orders: ())
    assert bounded.run((2, 3, 4)).scope == "orders 2 to 4"
    assert bounded.run((2, 5)).scope == "orders 2, 5"
    assert claim("lemma-gradient").run((2, 3)).scope == "all orders"


def test_json_has_the_six_entries(results):
    entries = json.loads(json.dumps([results[name].as_json() for name in IDS]))
    for entry in entries:
        assert set(entry) == {"id", "place", "verdict", "scope", "holds", "certificate"}
        assert entry["certificate"]["steps"]
        assert entry["holds"] is True


def test_certificates_do_not_depend_on_the_run(results):
    again = claim("maxima-interlacing").run()
    assert again.as_json() == results["maxima-interlacing"].as_json()


@pytest.mark.parametrize(
    ("shown", "verdict"),
    [
        ([Shows.PROOF], Verdict.PROVED),
        ([Shows.COUNTEREXAMPLE, Shows.PROOF], Verdict.REFUTED),
        ([Shows.NEEDED, Shows.PROOF], Verdict.PROVED_STRONGER),
        ([Shows.MISPRINT, Shows.PROOF], Verdict.MISPRINT),
        ([Shows.HAPPENS, Shows.FAILS], Verdict.CONFIGURATION),
        ([Shows.COUNTEREXAMPLE], Verdict.NOT_ESTABLISHED),
        ([Shows.HAPPENS], Verdict.NOT_ESTABLISHED),
        ([], Verdict.NOT_ESTABLISHED),
    ],
)
def test_verdict_follows_from_the_steps(shown, verdict):
    steps = [Step(kind, "text", True) for kind in shown]
    assert judge(steps) is verdict
    if steps:
        broken = [*steps[:-1], Step(shown[-1], "text", False)]
        assert judge(broken) is Verdict.NOT_ESTABLISHED


def test_unknown_id_names_its_neighbours():
    with pytest.raises(InputError, match="lemma-gradient"):
        select(CLAIMS, ["lemma-gradiant"])


def test_ids_are_run_once_and_progress_is_told():
    seen = []
    found = list(
        run_claims(
            ["parity-odd", "parity-even", "parity-odd"],
            (2, 3),
            lambda fraction, text: seen.append((fraction, text)),
        )
    )
    assert [result.claim.id for result in found] == ["parity-odd", "parity-even"]
    assert seen == [(0.0, "parity-odd"), (0.5, "parity-even")]
