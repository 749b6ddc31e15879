// SPDX-License-Identifier: Apache-2.0
#include "io/simrad/odd_channels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sonar::simrad {
namespace {

constexpr std::size_t kLeastChannels = 10;
constexpr double kNearlyAll = 0.9;
constexpr double kFew = 0.01;
constexpr int kLongRow = 16'384;  ///< shorter rows cost little, wherever they lie
constexpr int kFarBeyond = 4;

using Member = double SentChannel::*;
struct Value {
  Member member;
  const char* name;
  double tolerance;  ///< relative: values so near are one
};
constexpr Value kValues[] = {
    {&SentChannel::sample_interval_s, "sample interval", 0.0}, {&SentChannel::pulse_length_s, "pulse length", 0.0},
    {&SentChannel::sound_speed_mps, "sound speed", 1e-3},      {&SentChannel::frequency_hz, "frequency", 0.0},
    {&SentChannel::transmit_power_w, "transmit power", 0.0},   {&SentChannel::absorption_db_per_m, "absorption", 0.0}};

/// Marks the channels whose value hardly any other has, if the others share theirs.
void mark(std::span<const SentChannel> channels, const Value& value, std::vector<const char*>& odd) {
  const auto of = [&](std::size_t i) {
    const double v = channels[i].*value.member;
    return std::isnan(v) ? 0.0 : v;
  };
  const std::size_t n = channels.size();
  std::vector<std::size_t> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return of(a) < of(b); });
  const auto few = std::max<std::size_t>(1, static_cast<std::size_t>(kFew * static_cast<double>(n)));
  std::vector<std::size_t> rare;
  for (std::size_t first = 0; first < n;) {
    std::size_t end = first + 1;
    while (end < n && of(order[end]) - of(order[end - 1]) <= value.tolerance * std::abs(of(order[end]))) ++end;
    if (end - first <= few)
      rare.insert(rare.end(), order.begin() + static_cast<std::ptrdiff_t>(first),
                  order.begin() + static_cast<std::ptrdiff_t>(end));
    first = end;
  }
  // Where every beam has its own frequency none is odd.
  if (static_cast<double>(rare.size()) > (1.0 - kNearlyAll) * static_cast<double>(n)) return;
  for (const std::size_t i : rare) odd[i] = value.name;
}

void mark_far(std::span<const SentChannel> channels, std::vector<const char*>& odd) {
  int longest = 0;
  for (const SentChannel& channel : channels) {
    if (!channel.shifted || channel.end <= kLongRow) longest = std::max(longest, channel.end);
  }
  // Where all rows lie far away that is what was recorded.
  if (longest == 0) return;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (channels[i].shifted && channels[i].end > std::max(kLongRow, kFarBeyond * longest)) odd[i] = "offset";
  }
}

}  // namespace

SentChannel sent_channel(const ChannelPing& head, int count) {
  return {head.frequency_hz,       head.transmit_power_w,    head.pulse_length_s, head.sample_interval_s,
          head.sound_speed_mps,    head.absorption_db_per_m, head.offset + count, head.offset > 0 && !head.reduced,
          head.reduced.has_value()};
}

std::vector<const char*> odd_channels(std::span<const SentChannel> channels, bool all_beams) {
  std::vector<const char*> odd(channels.size(), nullptr);
  if (channels.size() < kLeastChannels) return odd;
  const bool some = std::any_of(channels.begin(), channels.end(), [](const SentChannel& c) { return c.reduced; });
  if (all_beams && !some) {
    for (const Value& value : kValues) mark(channels, value, odd);
  }
  mark_far(channels, odd);
  return odd;
}

}  // namespace sonar::simrad
