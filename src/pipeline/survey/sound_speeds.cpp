// SPDX-License-Identifier: Apache-2.0
#include "pipeline/survey/sound_speeds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace sonar {
namespace {

// The index tells sound speeds to this share; ranges within an observation differ by so many samples at the far end.
constexpr double kIndexedShare = 1e-4;
constexpr double kMostSpread_samples = 0.75;

}  // namespace

std::string SoundSpeeds::take(const TransmitSet& set) {
  std::vector<Span> joined = spans_;
  joined.resize(std::max(joined.size(), set.size()));
  for (std::size_t c = 0; c < set.size(); ++c) {
    if (!set[c].seen()) continue;
    Span& span = joined[c];
    span.least_mps = std::min(span.least_mps, set[c].sound_speed_mps);
    span.most_mps = std::max(span.most_mps, set[c].sound_speed_mps);
    span.samples = std::max(span.samples, set[c].max_samples);
    if ((span.most_mps - span.least_mps) * span.samples > kMostSpread_samples * span.least_mps) {
      const double from = set[c].sound_speed_mps == span.least_mps ? span.most_mps : span.least_mps;
      return fmt::format("channel {}: sound speed {:.2f} -> {:.2f} m/s moves the farthest of {} samples by {:.2f}",
                         c + 1, from, set[c].sound_speed_mps, span.samples,
                         (span.most_mps / span.least_mps - 1.0) * span.samples);
    }
  }
  spans_ = std::move(joined);
  return {};
}

SoundSpeeds::Span SoundSpeeds::first() const {
  const auto seen = std::find_if(spans_.begin(), spans_.end(), [](const Span& s) { return s.most_mps > 0.0; });
  return seen == spans_.end() ? Span{} : *seen;
}

double SoundSpeeds::middle_mps() const {
  const Span span = first();
  return (span.least_mps + span.most_mps) / 2.0;
}

std::string SoundSpeeds::drift() const {
  const Span span = first();
  if (span.least_mps >= span.most_mps) return {};
  const double share = (span.most_mps - span.least_mps) / (span.most_mps + span.least_mps) + kIndexedShare;
  return fmt::format("{:.2f} to {:.2f} m/s; ranges are those of the middle, right to {:.2f} samples at the far end",
                     span.least_mps, span.most_mps, share * span.samples);
}

}  // namespace sonar
