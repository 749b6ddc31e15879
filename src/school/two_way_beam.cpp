// SPDX-License-Identifier: Apache-2.0
#include "school/two_way_beam.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/units.h"

namespace sonar {
namespace {

/// Sending everywhere, a uniform line's two-way integral is 3/2 of its square's.
constexpr double kMostOfLine = 1.5;
constexpr int kHalvings = 40;  ///< to the last digit but a few

/// Solid angle of a two-way beam that is the square of a one-way beam, over the product of its -3 dB widths. For the
/// Gaussian; a uniform line's, (2/3 x pi/2 / 1.3916)^2, is the same to 0.01 dB.
constexpr double kSquareArea = std::numbers::pi / (8.0 * std::numbers::ln2);

/// Two-way width over that of a beam that sends as narrowly: integrals of g(z) g(qz) and of (sin x / x)^2 (sin qx / qx)^2
/// (two triangles convolved), each over that for q = 1.
double widening(double gaussian_share, double transmit_ratio) {
  const double gaussian = std::numbers::sqrt2 / std::sqrt(1.0 + transmit_ratio * transmit_ratio);
  const double line = kMostOfLine - 0.5 * transmit_ratio;
  return gaussian_share * gaussian + (1.0 - gaussian_share) * line;
}

/// Its inverse; wider than any transmit beam makes it is everywhere.
double ratio_for(double gaussian_share, double wanted) {
  double low = 0.0;
  double high = 1.0;
  if (wanted >= widening(gaussian_share, low)) return low;
  if (wanted <= 1.0) return high;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (low + high) / 2.0;
    (widening(gaussian_share, middle) > wanted ? low : high) = middle;
  }
  return high;
}

/// A variance goes as the square of the width: so the Gaussian's, and a line's within its main lobe.
BeamShape shape_of(double gaussian_share, double vertical, double level, double handicap) {
  return {gaussian_share, ratio_for(gaussian_share, vertical), vertical * vertical, level * level, handicap};
}

}  // namespace

double two_way_area(const BeamGrid& grid, std::span<const double> psi_db, const MeasureParams& params) {
  const std::size_t rows = grid.vertical_width_deg.size();
  if (rows == 0 || psi_db.size() != rows || grid.horizontal_width_deg.size() != rows) return 1.0;
  double sum = 0.0;
  double least = 0.0;
  double most = 0.0;
  for (std::size_t row = 0; row < rows; ++row) {
    const double widths = rad_from_deg(grid.vertical_width_deg[row]) * rad_from_deg(grid.horizontal_width_deg[row]);
    const double excess = psi_db[row] - db_from_linear(kSquareArea * widths);
    if (!(widths > 0.0) || !std::isfinite(excess)) return 1.0;
    least = row == 0 ? excess : std::min(least, excess);
    most = row == 0 ? excess : std::max(most, excess);
    sum += excess;
  }
  const double mean = sum / static_cast<double>(rows);
  if (most - least > params.beam_angle_spread_db || mean < params.beam_angle_least_db) return 1.0;
  if (mean > 2.0 * db_from_linear(kMostOfLine) + params.beam_angle_least_db) return 1.0;
  return linear_from_db(mean);
}

std::vector<BeamShape> beam_shapes(const MeasureParams& params, double area) {
  std::vector<double> shares{params.beam_gaussian_share};
  if (params.find_beam_shape) {
    shares.resize(static_cast<std::size_t>(params.beam_shapes));
    for (std::size_t i = 0; i < shares.size(); ++i) shares[i] = static_cast<double>(i) / (params.beam_shapes - 1);
  }
  const bool wider = params.use_beam_angle && area > 1.0;
  std::vector<BeamShape> shapes;
  for (const double share : shares) {
    const double most = widening(share, 0.0);
    const double level = wider ? std::min(area, most) : 1.0;
    shapes.push_back(shape_of(share, wider ? std::min(area / level, most) : 1.0, level, 0.0));
  }
  if (!wider || !params.find_beam_shape) return shapes;
  for (const double share : shares) {
    const double alike = std::min(std::sqrt(area), widening(share, 0.0));
    shapes.push_back(shape_of(share, alike, alike, params.alike_evidence));
  }
  return shapes;
}

}  // namespace sonar
