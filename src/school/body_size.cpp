// SPDX-License-Identifier: Apache-2.0
#include "school/body_size.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "school/mask_shape.h"
#include "school/vertical_fit.h"

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

}  // namespace

BodySize body_size(const BodyEcho& echo, const HeightLikelihood& heights, const BeamShape& beam, double shape_variance,
                   const MeasureParams& params) {
  BodySize size;
  if (!echo.known) return size;
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
  const double level_blur = (blur[0] + blur[3]) / 2.0;
  const auto extent = [&](double variance, double least_variance) {
    const double size_m = 2.0 * std::sqrt(shape_variance * std::max(variance, 0.0));
    return variance > least_variance && size_m >= params.floor_extent_m ? size_m : kUnknown;
  };
  size.length_m = extent(axes.major_variance, params.min_level_share * level_blur);
  size.width_m = extent(axes.minor_variance, params.min_level_share * level_blur);
  if (height && height->evidence >= params.min_height_evidence) size.height_m = extent(body[5], 0.0);
  return size;
}

}  // namespace sonar
