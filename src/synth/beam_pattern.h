// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

namespace sonar::synth {

/// Two-way directivity of a beam. Both shapes have the table's one-way -3 dB widths and are products of a vertical and a
/// horizontal part: exp(-z^2 / 2), as of an array shaded that way, and (sin x / x)^4, a uniform line's.
enum class BeamPattern { gaussian, uniform_line };
inline constexpr std::array<std::string_view, 2> kBeamPatternNames = {"gaussian", "uniform_line"};

/// 1 on the axis.
/// off_axis  angle in units of the Gaussian's standard deviation, RowBeam::sigma_v_rad or sigma_h_rad
[[nodiscard]] double pattern_value(BeamPattern pattern, double off_axis);
/// Its integral over all angles, in the same unit.
[[nodiscard]] double pattern_integral(BeamPattern pattern);
/// Beyond this it counts as nothing: -43 dB for the Gaussian, behind the first side lobe for the line.
[[nodiscard]] double pattern_reach(BeamPattern pattern);

}  // namespace sonar::synth
