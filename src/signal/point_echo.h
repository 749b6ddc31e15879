// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sonar {

/// The echo of a point target in one row of samples.
struct PointEcho {
  double sum_w = 0.0;             ///< of the samples inside the window, the noise taken off
  double noise_w = 0.0;           ///< in one sample: the middle of those beside the window, as an exponential's mean
  double centre_sample = 0.0;     ///< centre of gravity of the power
  double nearest_share_db = 0.0;  ///< the sample nearest to the centre, over the sum
  [[nodiscard]] double signal_to_noise(int half_width) const { return sum_w / (noise_w * (2 * half_width + 1)); }
};

/// counts      power counts
/// half_width  of the window, samples on either side: what of the received pulse counts lies inside
/// out         sum_w not positive: no echo there, or the window runs over an end
[[nodiscard]] PointEcho point_echo(std::span<const std::int16_t> counts, int around, int half_width);

/// How much of an echo's sum its sample at the very top would have, from samples that miss the top by up to half an
/// interval: 10 log10(top / sum) = a + b |u| + c u^2 with u the distance from the centre in samples. The form of the pulse
/// (b, c) is one for all, a one for each group.
struct EchoTop {
  double share_db = 0.0;  ///< a
  double se_db = 0.0;
  int echoes = 0;
};
struct OffTop {
  std::size_t group = 0;
  double off_samples = 0.0;  ///< u
  double share_db = 0.0;
};
/// out  [group]; a group with fewer than five echoes has that of all
[[nodiscard]] std::vector<EchoTop> echo_tops(std::span<const OffTop> echoes, std::size_t groups);

}  // namespace sonar
