// SPDX-License-Identifier: Apache-2.0
#include "school/measure/two_way_beam.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <utility>

#include "base/units.h"
#include "model/beam_angles.h"

namespace sonar {
namespace {

/// Sending everywhere, a uniform line's two-way integral is 3/2 of its square's: kWidestTransmit_db, both ways.
constexpr double kMostOfLine = 1.5;
/// Received with the heaviest shading and sent with none a beam is twice as narrow (Harris 1978: Blackman to rectangle, 1.9).
constexpr double kNarrowest = 2.0;
/// Sending everywhere, a shaded receive beam's two-way integral over its square's: shading takes away the far side lobes that
/// make it 3/2 for a uniform line. Noise bandwidth over -3 dB width is 1.03 to 1.05 for all of Harris's (1978) shadings but
/// the rectangle (1.13), which makes it 1.37 to 1.40.
constexpr double kMostOfShaded = 1.386;
constexpr int kHalvings = 40;  ///< to the last digit but a few

/// Two-way width over that of a beam that sends as narrowly: integrals of g(z) g(qz) and of (sin x / x)^2 (sin qx / qx)^2
/// (two triangles convolved), each over that for q = 1. q > 1 sends more narrowly.
double widening(double gaussian_share, double transmit_ratio) {
  const double gaussian = std::numbers::sqrt2 / std::sqrt(1.0 + transmit_ratio * transmit_ratio);
  const double narrower = std::max(1.0, transmit_ratio);  // the same integral, of the other beam's angle
  const double line = (kMostOfLine - 0.5 * std::min(transmit_ratio, 1.0 / transmit_ratio)) / narrower;
  return gaussian_share * gaussian + (1.0 - gaussian_share) * line;
}

/// Its inverse; wider than any transmit beam makes it is everywhere, and the narrowest sends kNarrowest.
double ratio_for(double gaussian_share, double wanted) {
  double low = 0.0;
  double high = kNarrowest;
  if (wanted >= widening(gaussian_share, low)) return low;
  if (wanted <= widening(gaussian_share, high)) return high;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (low + high) / 2.0;
    (widening(gaussian_share, middle) > wanted ? low : high) = middle;
  }
  return high;
}

/// Orthonormal polynomials of degree 0, 1 and 2 over n points; those that n is too few for are left out.
std::vector<std::vector<double>> polynomials(int n) {
  std::vector<std::vector<double>> basis;
  for (int degree = 0; degree <= 2 && degree < n; ++degree) {
    std::vector<double> values;
    for (int i = 0; i < n; ++i) values.push_back(std::pow((i + 0.5) / n - 0.5, degree));
    const auto dot = [&](const std::vector<double>& other) {
      return std::inner_product(values.begin(), values.end(), other.begin(), 0.0);
    };
    for (const std::vector<double>& lower : basis) {
      const double part = dot(lower);
      for (std::size_t i = 0; i < values.size(); ++i) values[i] -= part * lower[i];
    }
    const double norm = std::sqrt(dot(values));
    for (double& v : values) v /= norm;
    basis.push_back(std::move(values));
  }
  return basis;
}

/// The least-squares surface of second degree over fans and beams: what is left of values that ripple from beam to beam.
std::vector<double> smoothed(const std::vector<double>& values, int fans, int beams) {
  std::vector<double> smooth(values.size(), 0.0);
  const auto over_fans = polynomials(fans);
  const auto over_beams = polynomials(beams);
  const auto width = static_cast<std::size_t>(beams);
  for (std::size_t f = 0; f < over_fans.size(); ++f) {
    for (std::size_t b = 0; b < over_beams.size() && f + b <= 2; ++b) {
      const auto shape = [&](std::size_t row) { return over_fans[f][row / width] * over_beams[b][row % width]; };
      double share = 0.0;
      for (std::size_t row = 0; row < values.size(); ++row) share += values[row] * shape(row);
      for (std::size_t row = 0; row < values.size(); ++row) smooth[row] += share * shape(row);
    }
  }
  return smooth;
}

/// A variance goes as the square of the width: so the Gaussian's, and a line's within its main lobe.
BeamShape shape_of(double gaussian_share, double vertical, double level, double handicap) {
  return {gaussian_share, ratio_for(gaussian_share, vertical), vertical * vertical, level * level, handicap};
}

}  // namespace

double two_way_area(const BeamGrid& grid, std::span<const double> psi_db, const MeasureParams& params) {
  const std::size_t rows = grid.vertical_width_deg.size();
  if (rows == 0 || psi_db.size() != rows || grid.horizontal_width_deg.size() != rows || grid.channel.size() != rows) {
    return 1.0;
  }
  std::vector<double> excess_db = psi_from_widths_db(grid);
  double mean_db = 0.0;
  for (std::size_t row = 0; row < rows; ++row) {
    excess_db[row] = psi_db[row] - excess_db[row];
    if (!std::isfinite(excess_db[row])) return 1.0;
    mean_db += excess_db[row] / static_cast<double>(rows);
  }
  const std::vector<double> smooth_db = smoothed(excess_db, grid.fans(), grid.beams());
  const auto [least, most] = std::minmax_element(smooth_db.begin(), smooth_db.end());
  if (*most - *least > params.beam_angle_spread_db || mean_db < params.beam_angle_least_db) return 1.0;
  if (mean_db > kWidestTransmit_db + params.beam_angle_least_db) return 1.0;
  for (std::size_t row = 0; row < rows; ++row) {
    if (std::abs(excess_db[row] - smooth_db[row]) > params.beam_angle_ripple_db) return 1.0;
  }
  return linear_from_db(mean_db);
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
    if (!wider) {
      shapes.push_back(shape_of(share, 1.0, 1.0, 0.0));
    } else if (area >= most) {
      shapes.push_back(shape_of(share, std::min(area / most, most), most, 0.0));
    } else {
      const double upright = std::min(1.0, area / kMostOfShaded);
      shapes.push_back(shape_of(share, upright, area / upright, 0.0));
    }
  }
  if (!wider || !params.find_beam_shape) return shapes;
  for (const double share : shares) {
    const double alike = std::min(std::sqrt(area), widening(share, 0.0));
    shapes.push_back(shape_of(share, alike, alike, params.alike_evidence));
  }
  return shapes;
}

}  // namespace sonar
