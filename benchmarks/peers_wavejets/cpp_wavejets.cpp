// SPDX-License-Identifier: BSD-3-Clause
// Times the class Wavejet of CPPWaveJets on neighbourhoods that are given.
//
// Output: for each query the axes t1, t2, n of its frame, and then phi_{k,n} for k = 0..K and
// n = -k, -k + 2, ..., k as real and imaginary parts, for coordinates divided by the radius. On
// standard error: the processor seconds spent in the constructor of Wavejet, which fits.
//
// Argument: the degree K.

#include "neighbourhoods.hpp"
#include "wavejet.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: cpp_wavejets DEGREE\n");
    return 2;
  }
  const unsigned degree = std::strtoul(argv[1], nullptr, 10);
  const Neighbourhoods sets = read_neighbourhoods();
  double total = 0.0;
  for (std::size_t q = 0; q < sets.queries.size(); ++q) {
    Neighbors around;
    for (const Place& p : sets.around[q]) around.push_back(cv::Point3d{p.x, p.y, p.z});
    const cv::Point3d point{sets.queries[q].x, sets.queries[q].y, sets.queries[q].z};
    const double start = processor_seconds();
    Wavejet wavejet{degree, point, around, sets.radius};
    total += processor_seconds() - start;
    // The columns may carry a scale for the display.
    const cv::Affine3d axes = wavejet.get_svd();
    for (int column = 0; column < 3; ++column) {
      const Eigen::Vector3d axis = axes.matrix.col(column).head<3>().normalized();
      std::printf("%.17g %.17g %.17g ", axis.x(), axis.y(), axis.z());
    }
    for (int k = 0; k <= static_cast<int>(degree); ++k) {
      for (int n = -k; n <= k; n += 2) {
        const std::complex<double> phi = wavejet._phi.at(k, n);
        std::printf("%.17g %.17g ", phi.real(), phi.imag());
      }
    }
    std::printf("\n");
  }
  std::fprintf(stderr, "%.9f\n", total);
  return 0;
}
