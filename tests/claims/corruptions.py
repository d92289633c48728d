"""A wrong statement for every claim, which its check must refuse.

Each entry replaces ingredients of the statement: a factor, a sign, a bound, a dropped hypothesis,
or a counterexample that is none.
"""

from fractions import Fraction

import sympy as sp

from pdtheory.paper.claims.kit import x, y

n = sp.Symbol("n", integer=True, positive=True)
k = sp.Symbol("k", integer=True, positive=True)

REGULAR = (0.0, 144.0, 288.0, 72.0, 216.0), (Fraction(-1), Fraction(-1), Fraction(-1))

CORRUPTIONS = {
    "error-order": {
        "one power too many": {"exponent": lambda degree, order: degree + 2 - order},
        "the printed power as the sharp one": {"exponent": lambda degree, order: degree - order},
    },
    "tensor-contraction": {
        "a tensor that is not symmetric": {"component": lambda index: sp.Symbol(f"a{index}")},
    },
    "symmetry-definition": {"indices from 0": {"first_index": 0}},
    "e-eigen-real": {
        "a real eigenvector as the lost one": {"vector": (1, 0), "value": sp.Integer(1)},
        "a vector that is no eigenvector": {"vector": (sp.I, sp.sqrt(3))},
    },
    "e-characteristic-roots": {
        "a form all of whose eigenpairs are real": {"f": x**3 - 3 * x * y**2},
        "a regular form as the irregular one": {"irregular": x * (x**2 + y**2) * (x**2 + 2 * y**2)},
    },
    "taylor-first-terms": {
        "the gradient as the wrong term": {"printed": lambda gradient: gradient},
        "the normal as the right one": {"corrected": False},
    },
    "taylor-tensor": {
        "no multiplicity": {"multiplicity": lambda order, i: sp.Integer(1)},
        "a factor k for k!": {"normalisation": lambda order: order},
    },
    "mixed-partials": {"a smooth function": {"f": x**2 * y}},
    "lemma-gradient": {
        "a factor k + 1": {"factor": lambda order: order + 1},
        "no factor": {"factor": lambda order: 1},
    },
    "theorem-equivalence": {
        "no factor 1/k": {"factor": lambda order: 1},
        "turned the wrong way": {"normal": (y, -x)},
        "a vector that can vanish": {"normal": (y, x)},
    },
    "extrema-or-critical": {
        "an extremum": {"f": x**2 * y + y**3},
        "another order": {"f": y**4, "order": 4},
    },
    "wavejets-symmetry": {"all n of every parity": {"parity": lambda order: 1}},
    "corollary-wavejets": {
        "the factor 2": {"factor": 2},
        "minus in place of plus": {"sign": -1},
    },
    "eigenvalue-link": {
        "g = lambda": {"factor": lambda order: 1},
        "g = lambda / k": {"factor": lambda order: 1 / order},
    },
    "parity-even": {
        "the other sign": {"sign": lambda order: (-1) ** (order + 1)},
        "an odd order": {"parity": 1},
    },
    "parity-odd": {
        "no sign": {"sign": lambda order: sp.Integer(1)},
        "an even order": {"parity": 0},
    },
    "count-2k": {
        "a form that is not constant": {"constant": lambda order: x**order},
        "the bounds exchanged": {"bounds": lambda support: (max(support), min(support))},
        "one less": {"bounds": lambda support: (min(support), max(support) - 1)},
    },
    "polynomial-degree": {
        "a form with a real polynomial": {"f": x * y},
        "self-reciprocal": {"inversion_sign": 1},
    },
    "count-max-min": {
        "one maximum more": {"expected": lambda order, frequency: frequency + 1},
        "the other parity": {"parity": lambda order, found: (order - found) % 2 == 1},
    },
    "order2-curvature": {
        "a gradient of zero": {"gradient": (0, 0)},
        "a gradient along an eigenvector": {"gradient": (1, 1)},
    },
    "krosy-iff": {
        "no perturbation": {"e": Fraction(0)},
        "a perturbation that is too large": {"e": Fraction(5)},
    },
    "order3-rank": {"a turn of 90 degrees": {"opposite": sp.pi / 2}},
    "order3-triples": {
        "angles that interlace": {"halves": (Fraction(0), Fraction(17, 10), Fraction(-17, 10))}
    },
    "saddles-rosy": {
        "lambda without its sign": {"value": lambda j, order: sp.factorial(order)},
        "lambda = (-1)^j k": {"value": lambda j, order: (-1) ** j * order},
    },
    "z-gaussian": {
        "a weight that vanishes at the boundary": {"weight": lambda d, R: (1 - d**2 / R**2) ** 2},
        "sigma = r": {"weight": lambda d, R: sp.exp(-(d**2) / (2 * R**2))},
    },
    "order3-one-or-three": {
        "always three": {"allowed": (3,)},
        "another order": {"order": 5},
    },
    "cube-edge-order3": {"an odd surface": {"turned_sign": -1}},
    "cube-corner-order2": {"two faces": {"fold": 2}},
    "five-planes-order7": {
        "a regular star as the exception": {"fails": REGULAR},
        "uneven ridges as the rule": {
            "happens": ((0.0, 110.0, 255.0, 40.0, 200.0), (Fraction(-1),) * 3)
        },
        "planes that do not meet": {"happens": ((0.0, 10.0, 20.0, 5.0, 15.0), (Fraction(-1),) * 3)},
    },
    "extraction-exact": {
        "no loss at the fold": {"fold_exponent": sp.Integer(1)},
        "a root at the cusp": {"cusp_exponent": sp.Rational(1, 2)},
        "a place that is no fold": {"fold": 2},
    },
    "continuity": {"a place off the discriminant": {"fold": Fraction(2)}},
    "isotropic-vanish": {"a surface with directions": {"profile": lambda square: square + x}},
    "tjunction-impossible": {
        "an even order": {"parity": 0},
        "a form with other directions": {"f": x**3 - 3 * x * y**2},
    },
    "k-rosy": {
        "phi_0 forgotten, another frequency allowed": {"allowed": lambda order: {order % 2, order}},
        "the top frequency dropped": {"allowed": lambda order: {order % 2}},
    },
    "k-rosy-maxima": {
        "the weight n": {"weight": n},
        "the bound 2": {"bound": 2},
    },
    "order3-maxima": {
        "1/8 for 1/24": {"factors": (sp.Rational(1, 8), -sp.Rational(1, 8))},
        "the other sign": {"factors": (sp.Rational(1, 24), sp.Rational(1, 8))},
    },
    "maxima-interlacing": {
        "interlacing dropped": {"need_interlacing": False},
        "twice as many": {"stretch": 2},
    },
    "order3-discriminant": {
        "8 for 24": {
            "criterion": lambda p1, p3, q1, q3: (
                (p1 * q1) ** 2
                + 162 * p1 * q1 * p3 * q3
                - 2187 * (p3 * q3) ** 2
                + 4 * (p1**3 * q3 + q1**3 * p3)
            )
        },
        "a smaller deltoid": {"boundary": lambda e: -2 * (2 * e + e**-2)},
        "turned by 60 degrees": {"boundary": lambda e: 3 * (2 * e + e**-2)},
    },
    "order4-discriminant": {
        "54 for 108": {
            "criterion": lambda p2, p4, q2, q4: (
                (p2 * q2 - 16 * p4 * q4) ** 3 - sp.Rational(27, 2) * (p2**2 * q4 - q2**2 * p4) ** 2
            )
        },
        "a larger astroid": {"radius": 5},
    },
    "two-frequency-hypocycloid": {
        "q / p^2 for q / 2 p^2": {
            "curve": lambda p, q, t: (
                -q
                / p**2
                * ((q + p) * sp.exp(sp.I * (q - p) * t) + (q - p) * sp.exp(-sp.I * (q + p) * t))
            )
        },
        "the radii exchanged": {"radii": lambda ratio: (ratio**2, ratio)},
    },
    "complex-eigenpairs": {
        "twice as many": {"number": lambda n_max: 2 * n_max},
        "isotropic ones always": {"isotropic": 0},
    },
    "e-characteristic-polynomial": {
        "the factor |f(1, i)|": {"power": lambda order: 0},
        "one degree more": {"degree": lambda order: order + 1},
    },
    "irregular-tensors": {"a simple factor": {"depth": 1}},
    "cone-fit": {
        "another coefficient": {"c33": Fraction(4, 3)},
        "R^(-k)": {"exponent": lambda order: -order},
    },
    "cone-order3": {"data r^3": {"data": 3}},
    "cone-creases": {"n^2 + 1": {"denominator": lambda m: m**2 + 1}},
    "cone-three-planes": {
        "three ridges of a star": {"angles": (0, 90, 225)},
        "the wrong valleys": {"valley_squared": 3},
    },
    "de-lathauwer": {
        "another tensor": {"components": ("1.5578", "2.4443", "-1.0982", "1.1226")},
        "another eigenvalue": {"expected": (3.1255, 2.8311, 1.4020)},
    },
    "power-sums": {
        "2^(-d/2)": {"diagonal": lambda d: 2 ** (-d / 2)},
        "2^(-d/2) as the ratio": {"ratio": lambda d: 2 ** (-d / 2)},
    },
    "expected-eigenlines": {
        "sqrt d": {"average": sp.sqrt},
        "sqrt(3d - 1)": {"average": lambda d: sp.sqrt(3 * d - 1)},
    },
}
