// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "model/school.h"

namespace sonar {

/// From where the fish were seen that a target-strength relation was found with.
enum class TsAspect : std::uint8_t { dorsal, side };
inline constexpr std::array<std::string_view, 2> kTsAspectNames{"dorsal", "side"};
[[nodiscard]] constexpr std::string_view name(TsAspect aspect) {
  return kTsAspectNames[static_cast<std::size_t>(aspect)];
}

/// How much a fish's echo falls off when it is not seen broadside: a line as long as `line_share` of the fish, over the share
/// that comes back at any aspect, for fish that head and tilt like this round their school's course.
/// source  Medwin & Clay 1998, Fundamentals of Acoustical Oceanography, section 9: line elements in phase, (sin x / x)^2
struct FishDirectivity {
  double line_share = kUnknown;  ///< unknown = the echo does not depend on the aspect
  double any_aspect_share = 0.0;
  double heading_sd_deg = 0.0;
  double tilt_sd_deg = 0.0;
  [[nodiscard]] bool known() const { return std::isfinite(line_share); }
};

/// Target strength by length and depth, TS = m log10(L / 1 cm) + b + d log10(1 + depth / 10 m), dB re 1 m^2: a line of a TS
/// table. With a directivity it is that of a fish seen broadside, else that of fish as they are seen.
struct TsRelation {
  std::string name;
  std::string species;
  double frequency_from_khz = kUnknown;
  double frequency_to_khz = kUnknown;
  TsAspect aspect = TsAspect::dorsal;
  double m_db = 20.0;
  double b_db = kUnknown;
  double d_db = 0.0;
  FishDirectivity directivity;
  bool recalled = false;  ///< a figure of it was not read from its source
  std::string source;

  /// Backscattering cross-section, m^2: 10^(TS/10), without 4 pi.
  /// length_cm  > 0
  /// depth_m    >= 0
  [[nodiscard]] double sigma_bs_m2(double length_cm, double depth_m) const;
};

}  // namespace sonar
