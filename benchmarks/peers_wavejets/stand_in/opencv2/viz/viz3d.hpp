// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "../core/core.hpp"

namespace cv::viz {

struct Color {
  static Color red() { return {}; }
  static Color green() { return {}; }
  static Color blue() { return {}; }
  static Color black() { return {}; }
  static Color white() { return {}; }
};

struct Widget {
  template <class... Parts>
  explicit Widget(Parts&&...) {}
};

using WCloud = Widget;
using WLine = Widget;

struct Viz3d {
  template <class... Parts>
  void showWidget(const std::string&, Parts&&...) {}
};

}  // namespace cv::viz
