// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "base/result.h"
#include "model/transfer_function.h"
#include "view/sv_scale.h"

namespace sonar {

/// A corner of a curve that a human draws; colours come from the scale.
struct OpacityPoint {
  double sv_db = 0.0;
  double opacity = 0.0;
  friend bool operator==(const OpacityPoint&, const OpacityPoint&) = default;
};

/// The colours of a scale with the opacity of points (linear between them, constant outside).
/// errors  bad_parameter: as TransferFunction::make()
[[nodiscard]] Result<TransferFunction> curve_of(const SvScale& scale, const std::vector<OpacityPoint>& points,
                                                double opacity_length_m = 10.0);
/// A growth curve: opacity alone, white.
[[nodiscard]] Result<TransferFunction> growth_curve_of(const std::vector<OpacityPoint>& points);
/// Corners of a curve without those that colours alone brought.
[[nodiscard]] std::vector<OpacityPoint> corners_of(const TransferFunction& curve);

struct CurvePreset {
  std::string_view name;
  std::string_view text;
};
/// "ramp", "threshold", "band", "faint": shapes for the limits of a scale.
[[nodiscard]] std::vector<CurvePreset> curve_presets();
[[nodiscard]] std::vector<OpacityPoint> preset_points(std::string_view name, const SvScale& scale);

}  // namespace sonar
