// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/sample_flags.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/stages/engine.h"
#include "pipeline/survey/survey.h"
#include "publish/picture_params.h"
#include "view/echograms/echogram_rows.h"

namespace sonar {

/// Which values of a ping an echogram of beams shows.
struct EchogramSamples {
  bool filtered = false;                     ///< Sv after the median filter; off = as recorded
  SampleFlags hidden = SampleFlags::none;    ///< samples that are left out
  SampleFlags put_back = SampleFlags::none;  ///< with `filtered`: shown as recorded where taken out for these alone
  friend auto operator<=>(const EchogramSamples&, const EchogramSamples&) = default;
};
/// As slices show them: what noise removal took out is left out unless it is to be shown.
[[nodiscard]] EchogramSamples echogram_samples(const DisplayParams& display);

/// One ping's column of an echogram of beams.
/// placement  of the ping, as echogram_rows() takes it
[[nodiscard]] std::vector<EchogramCell> echogram_column(const StagedPing& ping, const Sector& sector,
                                                        const Placement& placement, const EchogramOf& of,
                                                        const EchogramSamples& shown, const EchogramRange& range);

/// "beam 12 of fan 7: 85.2 kHz, elevation -13.5 deg, azimuth 282.5 deg from the bow"; "fan 7, all 25 beams: ...".
/// frequency_hz  [fan]
[[nodiscard]] std::string echogram_text(const Sector& sector, std::span<const double> frequency_hz,
                                        const EchogramOf& of);

/// The channel of an observation that a user names: its number from 1, or its frequency in kHz; empty = the first.
/// out     0-based
/// errors  usage, with the channels that there are
[[nodiscard]] Result<int> named_channel(const ObservationFiles& observation, std::string_view name);
/// "channel 2 of 3: 38 kHz".
[[nodiscard]] std::string channel_text(const ObservationFiles& observation, int channel);

/// The columns of one channel of a sounder whose beams make no grid. A depth axis has the beam straight down.
class ChannelEchogram {
 public:
  /// Survey and observation outlive it.
  /// channel  0-based, of those that the observation has
  ChannelEchogram(const SurveyFiles& survey, const ObservationFiles& observation, const Recipe& recipe, int channel,
                  EchogramHeight height);
  [[nodiscard]] const EchogramRange& range() const { return range_; }
  /// errors  as load_channel_sv()
  /// threads any
  [[nodiscard]] Result<std::vector<EchogramCell>> column(std::int64_t ping_index) const;
  /// Of sample 0 in a ping on the upright axis, beside its range.
  [[nodiscard]] double offset_m(std::int64_t ping_index) const;

 private:
  const SurveyFiles& survey_;
  const ObservationFiles& observation_;
  Recipe recipe_;
  int channel_;
  EchogramHeight height_;
  EchogramRange range_;
};

}  // namespace sonar
