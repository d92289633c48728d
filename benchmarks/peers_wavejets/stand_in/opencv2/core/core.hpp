// SPDX-License-Identifier: BSD-3-Clause
// As much of OpenCV as CPPWaveJets names, so that its fit compiles without OpenCV: points and
// transforms that work, and a display that shows nothing.
#pragma once

#include <Eigen/Core>

#include <ostream>

namespace cv {

struct Point3d {
  double x, y, z;
};

inline Point3d operator+(const Point3d& a, const Point3d& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

inline std::ostream& operator<<(std::ostream& stream, const Point3d& p) {
  return stream << '[' << p.x << ", " << p.y << ", " << p.z << ']';
}

struct Affine3d {
  Affine3d() = default;
  explicit Affine3d(const Eigen::Matrix4d& given) : matrix(given) {}
  Affine3d translate(const Point3d& by) const {
    Affine3d moved = *this;
    moved.matrix.col(3).head<3>() += Eigen::Vector3d(by.x, by.y, by.z);
    return moved;
  }
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
};

}  // namespace cv
