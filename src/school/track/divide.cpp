// SPDX-License-Identifier: Apache-2.0
#include "school/track/divide.h"

#include <array>
#include <cstddef>
#include <limits>

namespace sonar {
namespace {

/// Squared distances in units of a body's extent.
class Distance {
 public:
  Distance(const ExpectedBody& body, double least_m) : centre_(body.centre) {
    const auto& c = body.covariance;
    const double s[3][3] = {{c[0] + least_m * least_m, c[1], c[2]},
                            {c[1], c[3] + least_m * least_m, c[4]},
                            {c[2], c[4], c[5] + least_m * least_m}};
    const auto minor = [&](std::size_t i, std::size_t j) {
      const std::size_t i1 = (i + 1) % 3;
      const std::size_t i2 = (i + 2) % 3;
      const std::size_t j1 = (j + 1) % 3;
      const std::size_t j2 = (j + 2) % 3;
      return s[i1][j1] * s[i2][j2] - s[i1][j2] * s[i2][j1];
    };
    const double determinant = s[0][0] * minor(0, 0) + s[0][1] * minor(0, 1) + s[0][2] * minor(0, 2);
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t b = 0; b < 3; ++b) inverse_[a][b] = minor(b, a) / determinant;
    }
  }

  [[nodiscard]] double squared(const Point<Enu>& place) const {
    const std::array<double, 3> d{place.x - centre_.x, place.y - centre_.y, place.z - centre_.z};
    double sum = 0.0;
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t b = 0; b < 3; ++b) sum += d[a] * inverse_[a][b] * d[b];
    }
    return sum;
  }

 private:
  Point<Enu> centre_;
  std::array<std::array<double, 3>, 3> inverse_{};
};

}  // namespace

std::vector<PingMask> divide(const PingMask& mask, const Sector& sector, const PingFrame& frame,
                             std::span<const ExpectedBody> bodies, double least_m) {
  std::vector<Distance> distances;
  for (const ExpectedBody& body : bodies) distances.emplace_back(body, least_m);
  std::vector<PingMask> parts(bodies.size());
  std::size_t voxel = 0;
  for (const Run& run : mask.runs) {
    const Point<Sonar> u =
        Sector::direction(sector.elevation_rad(run.row / sector.beams()), sector.azimuth_rad(run.row % sector.beams()));
    std::size_t open = parts.size();
    for (int s = run.first_sample; s < run.end(); ++s, ++voxel) {
      const Point<Enu> place = frame.to_world(u * sector.range().range_m(s));
      std::size_t nearest = 0;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t b = 0; b < distances.size(); ++b) {
        const double distance = distances[b].squared(place);
        if (!(distance < least)) continue;
        least = distance;
        nearest = b;
      }
      PingMask& part = parts[nearest];
      if (open != nearest) part.runs.push_back({run.row, s, 0});
      open = nearest;
      ++part.runs.back().count;
      part.confidence.push_back(mask.confidence[voxel]);
    }
  }
  return parts;
}

}  // namespace sonar
