// SPDX-License-Identifier: Apache-2.0
#include "school/measure/body_size.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/units.h"
#include "school/mask_shape.h"
#include "school/measure/vertical_fit.h"

namespace sonar {
namespace {

/// Puts a body variance across the beam, in elevation, in the place of the measured one, and what hangs on it: the
/// moments were taken from echo selected in elevation alone, so the regressions on elevation hold (Pearson, Lawley).
void correct_selection(Covariance3& total, const Covariance3& blur, const Point<Sonar>& centre,
                       double body_variance_m2) {
  const double range = norm(centre);
  const double level = std::hypot(centre.x, centre.y);
  if (!(level > 0.0)) return;
  const Vector3 up{centre.x / level * centre.z / range, centre.y / level * centre.z / range, -level / range};
  const auto times = [&](const Covariance3& c) {
    return Vector3{c[0] * up[0] + c[1] * up[1] + c[2] * up[2], c[1] * up[0] + c[3] * up[1] + c[4] * up[2],
                   c[2] * up[0] + c[4] * up[1] + c[5] * up[2]};
  };
  const auto along = [&](const Vector3& v) { return v[0] * up[0] + v[1] * up[1] + v[2] * up[2]; };
  const Vector3 v = times(total);
  const double seen = along(v);
  if (!(seen > 0.0)) return;
  const double wanted = body_variance_m2 + along(times(blur));
  add_square(total, v, (wanted / seen - 1.0) / seen);
}

/// level_blur  of pulse and beam, without what the beam adds upright
AxisSighting axis_sighting(const BodyEcho& echo, const Covariance3& level_blur, double axis_rad) {
  const LevelMoments::Cumulants whole = echo.level.along(axis_rad, echo.centre);
  const double x = std::cos(axis_rad);
  const double y = std::sin(axis_rad);
  const double blur = level_blur[0] * x * x + 2.0 * level_blur[1] * x * y + level_blur[3] * y * y;
  return {whole.variance - blur, whole.variance, whole.fourth, echo.looks};
}

}  // namespace

std::optional<BodySighting> body_sighting(const BodyEcho& echo, const HeightLikelihood& heights, const BeamShape& beam,
                                          const MeasureParams& params) {
  if (!echo.known) return std::nullopt;
  const auto height = most_likely_height(heights);
  Covariance3 total = echo.total;
  Covariance3 blur = echo.blur;
  for (std::size_t k = 0; k < blur.size(); ++k) {
    blur[k] += (beam.upright_variance - 1.0) * echo.upright[k] + (beam.level_variance - 1.0) * echo.sideways[k];
  }
  if (height) correct_selection(total, blur, echo.centre, height->variance_m2);
  Covariance3 body{};
  for (std::size_t k = 0; k < body.size(); ++k) body[k] = total[k] - blur[k];
  const HorizontalAxes axes = horizontal_axes(body, 0.0);
  Covariance3 level_blur = blur;
  for (std::size_t k = 0; k < blur.size(); ++k) level_blur[k] -= beam.upright_variance * echo.upright[k];
  const auto along = [&](double axis_rad) { return axis_sighting(echo, level_blur, axis_rad); };
  BodySighting out;
  out.length_variance = axes.major_variance;
  out.width_variance = axes.minor_variance;
  out.length_axis_rad = axes.major_bearing_rad;
  out.length = along(axes.major_bearing_rad);
  out.width = along(axes.major_bearing_rad + std::numbers::pi / 2.0);
  out.line_of_sight = along(std::atan2(echo.centre.y, echo.centre.x));
  if (height && height->evidence >= params.min_height_evidence) out.height_variance = body[5];
  out.blur_variance = (blur[0] + blur[3]) / 2.0;
  return out;
}

BodySize body_size(const BodySighting& body, const BodyShape& shape, const Point<Sonar>& centre,
                   const MeasureParams& params) {
  const auto extent = [&](double variance, double by_shape, double least_variance) {
    const double size_m = 2.0 * std::sqrt(by_shape * std::max(variance, 0.0));
    return variance > least_variance && size_m >= params.min_extent_m ? size_m : kUnknown;
  };
  const double least_variance = params.min_level_share * body.blur_variance;
  BodySize out;
  out.length_m = extent(body.length_variance, shape.length, least_variance);
  out.width_m = extent(body.width_variance, shape.width, least_variance);
  out.height_m = extent(body.height_variance, shape.height, 0.0);
  if (std::isfinite(out.length_m)) {
    const double along = centre.x * std::cos(body.length_axis_rad) + centre.y * std::sin(body.length_axis_rad);
    out.incidence_deg = deg_from_rad(std::acos(std::min(std::abs(along) / norm(centre), 1.0)));
  }
  return out;
}

}  // namespace sonar
