// SPDX-License-Identifier: Apache-2.0
// What becomes of a ping when all of it is there: channels that do not belong to it, and the settings it was sent with.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "io/simrad/indexer.h"

namespace sonar::simrad {
namespace {

constexpr double kNearlyAllBeams = 0.95;
// A sound speed that wavers by half a per mille and comes back makes so many sets.
constexpr std::size_t kMostAlternating = 16;
// Settings that change at every ping would otherwise cost more than the samples.
constexpr std::size_t kMaxTransmitEntries = std::size_t{1} << 18;

bool same_setting(const ChannelTransmit& a, const ChannelTransmit& b) {
  return a.frequency_hz == b.frequency_hz && a.transmit_power_w == b.transmit_power_w &&
         a.pulse_length_s == b.pulse_length_s && a.sample_interval_s == b.sample_interval_s &&
         std::abs(a.sound_speed_mps - b.sound_speed_mps) <= 1e-4 * a.sound_speed_mps;
}

}  // namespace

void Indexer::publish_ping() {
  ping_published_ = true;
  leave_out_odd_channels();
  ping_.min_samples = kMaxSamples;
  for (const OpenChannel& channel : open_) {
    ping_.min_samples = std::min(ping_.min_samples, channel.count);
    ping_.max_samples = std::max(ping_.max_samples, channel.count);
    if (channel.silent) ++ping_.silent_channels;
  }
  ping_.channels = static_cast<std::uint16_t>(open_.size());
  ping_.transmit = transmit_of_open_ping();
  index_.pings.push_back(ping_);
}

/// A channel that is sent otherwise than all others in every ping is no damage: from the second ping on it counts.
void Indexer::leave_out_odd_channels() {
  const auto beams = static_cast<double>(index_.configs.at(ping_.config)->beams.size());
  ping_.all_beams = static_cast<double>(open_.size()) >= kNearlyAllBeams * beams;
  std::vector<SentChannel> sent;
  for (const OpenChannel& channel : open_) sent.push_back(channel.sent);
  const std::vector<const char*> odd = odd_channels(sent, ping_.all_beams);
  std::map<int, ChannelTransmit> left_out;
  for (std::size_t i = 0; i < odd.size(); ++i) {
    if (odd[i] == nullptr) continue;
    const OpenChannel& channel = open_[i];
    const auto before = odd_before_.find(channel.channel);
    const bool the_same = before != odd_before_.end() && same_setting(before->second, channel.transmit) &&
                          before->second.max_samples == channel.transmit.max_samples;
    left_out.emplace(channel.channel, channel.transmit);
    if (the_same) continue;
    notes_.add(DiagnosticCode::bad_value, channel.offset,
               fmt::format("channel {}: its {} is not that of its ping", channel.channel + 1, odd[i]));
    ++ping_.odd_channels;
  }
  if (ping_.odd_channels > 0) {
    std::size_t i = 0;
    std::erase_if(open_, [&](const OpenChannel&) { return odd[i++] != nullptr; });
    ping_.odd_channels = static_cast<std::uint16_t>(left_out.size());
  }
  odd_before_ = std::move(left_out);
}

std::uint16_t Indexer::transmit_of_open_ping() {
  const auto fits = [&](const TransmitSet& set) {
    return std::all_of(open_.begin(), open_.end(), [&](const OpenChannel& open) {
      const auto channel = static_cast<std::size_t>(open.channel);
      return channel >= set.size() || !set[channel].seen() || same_setting(set[channel], open.transmit);
    });
  };
  // Settings may alternate from ping to ping, and a sound speed that wavers comes back.
  auto& sets = index_.transmits;
  std::size_t chosen = sets.size();
  for (std::size_t back = 1; back <= std::min<std::size_t>(kMostAlternating, sets.size()) && chosen == sets.size();
       ++back) {
    if (fits(sets[sets.size() - back])) chosen = sets.size() - back;
  }
  if (chosen == sets.size()) {
    if (transmit_entries_ > kMaxTransmitEntries || sets.size() >= 65535) {
      if (!transmit_overflow_) {
        notes_.add(DiagnosticCode::settings_changed, ping_.offset, "settings change too often to be kept apart");
      }
      transmit_overflow_ = true;
      --chosen;
    } else {
      sets.emplace_back();
    }
  }
  TransmitSet& set = sets[chosen].edit();
  for (const OpenChannel& open : open_) {
    const ChannelTransmit& transmit = open.transmit;
    const auto c = static_cast<std::size_t>(open.channel);
    if (c >= set.size()) {
      transmit_entries_ += c + 1 - set.size();
      set.resize(c + 1);
    }
    const std::int32_t longest = std::max(set[c].max_samples, transmit.max_samples);
    if (!set[c].seen()) set[c] = transmit;
    set[c].max_samples = longest;
  }
  return static_cast<std::uint16_t>(chosen);
}

}  // namespace sonar::simrad
