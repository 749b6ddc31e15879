// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

namespace sonar::synth {

/// Two-way directivity of a beam. All receive with the table's one-way -3 dB widths and are products of a vertical and a
/// horizontal part: exp(-z^2 / 2), as of an array shaded that way; (sin x / x)^4, a uniform line's; a uniform line's that
/// sends by a third of its length both ways; and one that sends a whole fan at once, by a tenth of its length along it.
enum class BeamPattern { gaussian, uniform_line, wide_transmit, wide_fan };
inline constexpr std::array<std::string_view, 4> kBeamPatternNames = {"gaussian", "uniform_line", "wide_transmit",
                                                                      "wide_fan"};
enum class PatternPart { vertical, horizontal };

/// 1 on the axis.
/// off_axis  angle in units of the square Gaussian's standard deviation, RowBeam::sigma_v_rad or sigma_h_rad
[[nodiscard]] double pattern_value(BeamPattern pattern, PatternPart part, double off_axis);
/// Its integral over all angles, in the same unit.
[[nodiscard]] double pattern_integral(BeamPattern pattern, PatternPart part);
/// Beyond this it counts as nothing: -43 dB for the Gaussian, behind the first side lobe for the line, where the wide
/// beam sends nothing for the others.
[[nodiscard]] double pattern_reach(BeamPattern pattern, PatternPart part);

/// Whether the beam table's equivalent beam angles, those of a real sonar, give way to the pattern's own.
[[nodiscard]] constexpr bool has_own_beam_angle(BeamPattern pattern) {
  return pattern == BeamPattern::wide_transmit || pattern == BeamPattern::wide_fan;
}

}  // namespace sonar::synth
