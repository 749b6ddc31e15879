// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "base/describe.h"
#include "school/judge/judge_params.h"

namespace sonar {

struct DetectParams {
  double false_alarm = 2.0;
  double tolerance_db = 10.0;
  SizeParams size = {};
  std::string left_out = {};
};

template <class Visitor>
void describe(Visitor& v, DetectParams& p) {
  v.field("false_alarm", p.false_alarm,
          {.unit = "h-1",
           .min = 1e-6,
           .max = 1e4,
           .text = "How many false schools an hour of water without fish may bring; lower it for fewer false schools, "
                   "raise it to find weaker ones. Calibrated from 2 to 20.",
           .tier = Tier::basic});
  v.field("tolerance_db", p.tolerance_db,
          {.unit = "dB",
           .min = 0.1,
           .max = 60,
           .text = "Members of a school lie at most this much below its reference level; lower it to keep to a "
                   "school's core, raise it for loose schools.",
           .tier = Tier::basic});
  describe(v, p.size);
  v.field("left_out", p.left_out,
          {.text = "Judges that are not asked, separated by commas: size, prominence, confirmation, ship, level, "
                   "surface. Leave one out when it is known to refuse real schools."});
}

/// Evidence asked of a school over its sightings, each counted by what it has above kChanceEvidence, for a rate of
/// `false_alarm`: by simulation of waters without fish. Beyond 23 an hour nothing more is asked than three sightings.
[[nodiscard]] double evidence_wanted(const DetectParams& params);
/// Evidence of a single sighting such that a few like it are a school: what is refused in spite of it is told.
[[nodiscard]] double clear_evidence(const DetectParams& params);
/// Evidence from which an echo may be a sighting of a school: in fading water about one block of a ping has it.
inline constexpr double kLeastEvidence = 3.5;
/// What water without fish shows where a school might be.
inline constexpr double kChanceEvidence = 2.5;
/// A sighting counts with so much at most: what one ping alone shows is another sounder's pulse.
inline constexpr double kMostEvidence = 12.0;

/// A candidate's school is sought so far beyond its box, and members lie so far outside what the filtered data show.
struct SearchReach {
  static constexpr int fans = 2;
  static constexpr int beams = 3;
  static constexpr int samples = 40;
  static constexpr int margin_fans = 1;
  static constexpr int margin_beams = 1;
  static constexpr int margin_samples = 15;
  static constexpr int most_margins = 2;  ///< beside a louder neighbour
};
/// Members are told by a median along each beam of so many samples.
inline constexpr int kMemberSamples = 23;

}  // namespace sonar
