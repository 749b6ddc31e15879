// SPDX-License-Identifier: Apache-2.0
#include "signal/beam_overlap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace sonar {
namespace {

constexpr double kMost_db = 60.0;

/// From an angle to the nearest other one of its axis; infinite where there is none.
double nearest_spacing(std::span<const double> angles, std::size_t at) {
  double nearest = std::numeric_limits<double>::infinity();
  if (at > 0) nearest = std::min(nearest, std::abs(angles[at] - angles[at - 1]));
  if (at + 1 < angles.size()) nearest = std::min(nearest, std::abs(angles[at + 1] - angles[at]));
  return nearest;
}

/// Whether most beams are separate.
bool mostly_separate(std::vector<double> losses_db, double separate_db) {
  if (losses_db.empty()) return false;
  const auto middle = losses_db.begin() + static_cast<std::ptrdiff_t>(losses_db.size() / 2);
  std::nth_element(losses_db.begin(), middle, losses_db.end());
  return *middle > separate_db;
}

}  // namespace

double neighbour_loss_db(double spacing, double width) {
  if (!std::isfinite(spacing) || !(width > 0.0)) return 0.0;
  const double apart = spacing / width;
  return std::min(24.0 * apart * apart, kMost_db);
}

std::vector<double> fan_losses_db(std::span<const double> elevation_deg, std::span<const double> vertical_width_deg) {
  std::vector<double> losses(vertical_width_deg.size(), 0.0);
  if (elevation_deg.empty() || losses.size() % elevation_deg.size() != 0) return {};
  const std::size_t beams = losses.size() / elevation_deg.size();
  for (std::size_t row = 0; row < losses.size(); ++row) {
    losses[row] = neighbour_loss_db(nearest_spacing(elevation_deg, row / beams), vertical_width_deg[row]);
  }
  return losses;
}

MedianParams fitted(const MedianParams& params, std::span<const double> elevation_deg,
                    std::span<const double> azimuth_deg, std::span<const double> vertical_width_deg,
                    std::span<const double> horizontal_width_deg) {
  MedianParams out = params;
  const std::size_t rows = elevation_deg.size() * azimuth_deg.size();
  if (rows == 0 || vertical_width_deg.size() != rows || horizontal_width_deg.size() != rows) return out;
  std::vector<double> losses(rows, 0.0);
  for (std::size_t row = 0; row < rows; ++row) {
    losses[row] = neighbour_loss_db(nearest_spacing(azimuth_deg, row % azimuth_deg.size()), horizontal_width_deg[row]);
  }
  const double separate_db = params.separate_beams_db;
  if (!mostly_separate(losses, separate_db)) return out;
  if (!mostly_separate(fan_losses_db(elevation_deg, vertical_width_deg), separate_db)) return out;
  out.kernel_fans = 1;
  out.kernel_beams = 1;
  return out;
}

}  // namespace sonar
