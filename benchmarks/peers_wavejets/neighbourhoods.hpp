// SPDX-License-Identifier: BSD-3-Clause
// What the drivers of this folder share: they fit to neighbourhoods that are given, in one thread,
// and count the time of the fits only.
//
// Input on standard input, text: Q and the radius, then for each query N, the query, and the N
// points around it, without the query itself.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

struct Place {
  double x, y, z;
};

struct Neighbourhoods {
  double radius = 0.0;
  std::vector<Place> queries;
  std::vector<std::vector<Place>> around;
};

inline Place read_place() {
  Place place{};
  if (std::scanf("%lf %lf %lf", &place.x, &place.y, &place.z) != 3) std::exit(2);
  return place;
}

inline Neighbourhoods read_neighbourhoods() {
  Neighbourhoods sets;
  long queries = 0;
  if (std::scanf("%ld %lf", &queries, &sets.radius) != 2) std::exit(2);
  for (long q = 0; q < queries; ++q) {
    long count = 0;
    if (std::scanf("%ld", &count) != 1) std::exit(2);
    sets.queries.push_back(read_place());
    auto& around = sets.around.emplace_back();
    around.reserve(count);
    for (long i = 0; i < count; ++i) around.push_back(read_place());
  }
  return sets;
}

inline double processor_seconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return now.tv_sec + 1e-9 * now.tv_nsec;
}
