// SPDX-License-Identifier: BSD-3-Clause
// Times the jet fitting of CGAL on neighbourhoods that are given, one thread, fitting only.
//
// Input on standard input, text: Q, then for each query N followed by N points, the query first.
// Output on standard output: per query the two principal curvatures (larger first) and the direction
// of the larger; on standard error: the processor seconds spent in the fits.
//
// Arguments: degree, and "svd" (CGAL's default traits) or "qr" (Householder QR of Eigen).

#include <CGAL/Monge_via_jet_fitting.h>
#include <CGAL/Simple_cartesian.h>
#include <Eigen/Dense>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <vector>

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;

// A solver trait as the manual asks for: solve M x = B in the least squares sense, return a
// condition number (not computed here: that would need singular values).
struct HouseholderQr {
  using FT = double;
  using Vector = CGAL::Eigen_vector<FT>;
  using Matrix = CGAL::Eigen_matrix<FT>;
  static FT solve(const Matrix& M, Vector& B) {
    const Eigen::VectorXd right = B.eigen_object();
    const Eigen::VectorXd solution = M.eigen_object().householderQr().solve(right);
    for (Eigen::Index i = 0; i < solution.size(); ++i) B.set(i, solution[i]);
    return 1.0;
  }
};

double processor_seconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return now.tv_sec + 1e-9 * now.tv_nsec;
}

template <class Fitting>
double run(const std::vector<std::vector<Point>>& sets, std::size_t degree) {
  double total = 0.0;
  for (const auto& points : sets) {
    const double start = processor_seconds();
    Fitting fitting;
    auto form = fitting(points.begin(), points.end(), degree, 2);
    total += processor_seconds() - start;
    const auto d = form.maximal_principal_direction();
    std::printf("%.17g %.17g %.17g %.17g %.17g\n", form.principal_curvatures(0),
                form.principal_curvatures(1), d.x(), d.y(), d.z());
  }
  return total;
}

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: jet_fitting DEGREE svd|qr\n");
    return 2;
  }
  const std::size_t degree = std::strtoul(argv[1], nullptr, 10);
  long queries = 0;
  if (std::scanf("%ld", &queries) != 1) return 2;
  std::vector<std::vector<Point>> sets(queries);
  for (auto& set : sets) {
    long count = 0;
    if (std::scanf("%ld", &count) != 1) return 2;
    set.reserve(count);
    for (long i = 0; i < count; ++i) {
      double x, y, z;
      if (std::scanf("%lf %lf %lf", &x, &y, &z) != 3) return 2;
      set.emplace_back(x, y, z);
    }
  }
  using Default = CGAL::Monge_via_jet_fitting<Kernel>;
  using WithQr = CGAL::Monge_via_jet_fitting<Kernel, CGAL::Simple_cartesian<double>, HouseholderQr>;
  const double seconds = std::strcmp(argv[2], "qr") == 0 ? run<WithQr>(sets, degree)
                                                         : run<Default>(sets, degree);
  std::fprintf(stderr, "%.9f\n", seconds);
  return 0;
}
