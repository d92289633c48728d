"""Symmetric tensors of dimension 2 and their E-eigenpairs, exactly."""

from pdtheory.exact.algebraic import RealAlgebraic
from pdtheory.exact.characteristic import (
    CharacteristicPolynomial,
    characteristic_polynomial,
    is_irregular,
)
from pdtheory.exact.complexpair import ComplexEigenPair
from pdtheory.exact.complexpairs import ComplexEigenPairs, complex_eigenpairs
from pdtheory.exact.cones import Cone
from pdtheory.exact.constantroots import RealConstant, RealRoot
from pdtheory.exact.eigenpair import EigenPair
from pdtheory.exact.eigenpairs import EigenPairs, real_eigenpairs
from pdtheory.exact.expression import parse_expression
from pdtheory.exact.faces import BinaryForm, Face
from pdtheory.exact.factorcache import remember_primes_only
from pdtheory.exact.intervals import Enclosure
from pdtheory.exact.inverse import Realization, realize_maxima, rows_with_critical_lines
from pdtheory.exact.jets import explicit_jet, implicit_jet, parametric_jet
from pdtheory.exact.moments import cone_coefficient, radial_moment
from pdtheory.exact.named import NamedConstant
from pdtheory.exact.prediction import ConePrediction, predict
from pdtheory.exact.realnumber import RealNumber
from pdtheory.exact.report import report
from pdtheory.exact.rosy import rosy_kinds
from pdtheory.exact.strata import count_bounds, count_maxima, parametric_discriminant
from pdtheory.exact.surfacejet import SurfaceJet
from pdtheory.exact.taylor import differential_tensor, taylor_forms
from pdtheory.exact.tensor import SymmetricTensor
from pdtheory.exact.wavejets import WavejetsRow

remember_primes_only()

__all__ = [
    "BinaryForm",
    "CharacteristicPolynomial",
    "ComplexEigenPair",
    "ComplexEigenPairs",
    "Cone",
    "ConePrediction",
    "EigenPair",
    "EigenPairs",
    "Enclosure",
    "Face",
    "NamedConstant",
    "RealAlgebraic",
    "RealConstant",
    "RealNumber",
    "RealRoot",
    "Realization",
    "SurfaceJet",
    "SymmetricTensor",
    "WavejetsRow",
    "characteristic_polynomial",
    "complex_eigenpairs",
    "cone_coefficient",
    "count_bounds",
    "count_maxima",
    "differential_tensor",
    "explicit_jet",
    "implicit_jet",
    "is_irregular",
    "parametric_discriminant",
    "parametric_jet",
    "parse_expression",
    "predict",
    "radial_moment",
    "real_eigenpairs",
    "realize_maxima",
    "report",
    "rosy_kinds",
    "rows_with_critical_lines",
    "taylor_forms",
]
