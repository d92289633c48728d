// SPDX-License-Identifier: BSD-3-Clause
// In place of the point cloud and the tree of algebraic-shape-operator: a query and its neighbours,
// which the tree counts without the query itself.
#pragma once

#include <PCP/Common/Assert.h>
#include <PCP/Geometry/Defines.h>

#include <vector>

namespace pcp {

struct KdTree {
  const std::vector<int>& range_neighbors(int, Scalar) const { return others; }
  std::vector<int> others;
};

class Geometry {
 public:
  const Vector3& operator[](int i) const { return places[i]; }
  const KdTree& kdtree() const { return tree; }
  Vector3Array places;
  KdTree tree;
};

}  // namespace pcp
