// SPDX-License-Identifier: BSD-3-Clause
// Times CurvatureComputer_WJets of algebraic-shape-operator on neighbourhoods that are given.
//
// Output: for each query its k1, k2, mean curvature and normal. On standard error: the processor
// seconds spent in compute(); the search for neighbours is not among them.
//
// Argument: the degree, which has to be 2.

#include <PCP/Curvature/Curvature.h>
#include <PCP/Geometry/Geometry.h>

#include <cstring>

#include "neighbourhoods.hpp"

namespace pcp {

// The class declares this; the list of all methods that defines it would pull in their libraries.
MethodProperties CurvatureComputer_WJets::method_properties() const { return {}; }

}  // namespace pcp

int main(int argc, char** argv) {
  if (argc != 2 || std::strcmp(argv[1], "2") != 0) {
    std::fprintf(stderr, "usage: shape_operator 2\n");
    return 2;
  }
  const Neighbourhoods sets = read_neighbourhoods();
  const pcp::CurvatureComputer_WJets computer;
  double total = 0.0;
  for (std::size_t q = 0; q < sets.queries.size(); ++q) {
    pcp::Geometry points;
    const Place& query = sets.queries[q];
    points.places.emplace_back(query.x, query.y, query.z);
    for (const Place& p : sets.around[q]) {
      points.tree.others.push_back(static_cast<int>(points.places.size()));
      points.places.emplace_back(p.x, p.y, p.z);
    }
    const double start = processor_seconds();
    const pcp::PointWiseEstimationData found = computer.compute(points, 0, sets.radius);
    total += processor_seconds() - start;
    const pcp::Vector3 n = found.normal();
    std::printf("%.17g %.17g %.17g %.17g %.17g %.17g\n", found.k1(), found.k2(), found.H(), n.x(),
                n.y(), n.z());
  }
  std::fprintf(stderr, "%.9f\n", total);
  return 0;
}
