// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/load_volume.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include "base/check.h"
#include "base/units.h"
#include "io/ping_source.h"

namespace sonar {
namespace {

constexpr std::int16_t kMissing = -20000;

void lose(std::span<std::int16_t> counts, std::span<SampleFlags> flags) {
  std::fill(counts.begin(), counts.end(), kNoData);
  std::fill(flags.begin(), flags.end(), SampleFlags::dropout);
}

// A fixed count in local arrays is what compilers make vectors of without being asked for more optimisation.
constexpr std::size_t kBlock = 64;

struct Block {
  std::array<std::int16_t, kBlock> counts{};
  std::array<SampleFlags, kBlock> flags{};

  void settle() {
    for (std::size_t i = 0; i < kBlock; ++i) {
      const std::int16_t v = counts[i];
      const std::int16_t at_least = v < kMinCount ? kMinCount : v;
      const std::int16_t clamped = at_least > kMaxCount ? kMaxCount : at_least;
      counts[i] = v == kMissing ? kNoData : clamped;
      flags[i] = v == kMissing ? SampleFlags::dropout : SampleFlags::none;
    }
  }
};

void lay(std::span<const std::int16_t> power, std::span<std::int16_t> counts, std::span<SampleFlags> flags) {
  Block block;
  std::size_t i = 0;
  for (; i + kBlock <= power.size(); i += kBlock) {
    std::memcpy(block.counts.data(), &power[i], sizeof(block.counts));
    block.settle();
    std::memcpy(&counts[i], block.counts.data(), sizeof(block.counts));
    std::memcpy(&flags[i], block.flags.data(), sizeof(block.flags));
  }
  const std::size_t rest = power.size() - i;
  if (rest == 0) return;
  std::copy_n(power.begin() + static_cast<std::ptrdiff_t>(i), rest, block.counts.begin());
  block.settle();
  std::copy_n(block.counts.begin(), rest, counts.begin() + static_cast<std::ptrdiff_t>(i));
  std::copy_n(block.flags.begin(), rest, flags.begin() + static_cast<std::ptrdiff_t>(i));
}

void lay_channel(const ChannelPing& channel, std::span<std::int16_t> counts, std::span<SampleFlags> flags) {
  const std::size_t first = std::min(static_cast<std::size_t>(channel.offset), counts.size());
  const std::size_t stored = std::min(channel.power_count.size(), counts.size() - first);
  lose(counts.first(first), flags.first(first));
  lay(channel.power_count.first(stored), counts.subspan(first, stored), flags.subspan(first, stored));
  lose(counts.subspan(first + stored), flags.subspan(first + stored));
}

Result<Ping> load_part(const SurveyFiles& survey, const SurveyPing& part) {
  const auto source = open_file(survey.files[part.file].path);
  if (!source) return pass_on(source);
  return read_ping(**source, survey.entry(part), *survey.blocks);
}

/// Adds the channels that the ping lacks.
void join(Ping& ping, Ping part) {
  const auto before = [](const ChannelPing& a, int channel) { return a.channel < channel; };
  for (ChannelPing& channel : part.channels) {
    const auto place = std::lower_bound(ping.channels.begin(), ping.channels.end(), channel.channel, before);
    if (place == ping.channels.end() || place->channel != channel.channel) {
      ping.channels.insert(place, std::move(channel));
    }
  }
  ping.blocks.insert(ping.blocks.end(), part.blocks.begin(), part.blocks.end());
}

}  // namespace

Result<Ping> load_ping(const SurveyFiles& survey, const SurveyPing& first) {
  if (!survey.raw_gone.empty()) return fail(ErrorCode::not_found, survey.raw_gone);
  auto ping = load_part(survey, first);
  const auto further = survey.further_parts.find(first);
  if (!ping || further == survey.further_parts.end()) return ping;
  for (const SurveyPing& part : further->second) {
    auto more = load_part(survey, part);
    if (!more) return more;
    join(*ping, std::move(*more));
  }
  return ping;
}

Result<void> load_volume(const SurveyFiles& survey, const ObservationFiles& observation, std::size_t ping_index,
                         PowerVolume& out) {
  SONAR_CHECK(ping_index < observation.pings.size());
  if (!observation.grid) {
    return fail(ErrorCode::unsupported, "the beams of " + observation.name + " make no product grid");
  }
  auto ping = load_ping(survey, observation.pings[ping_index]);
  if (!ping) {
    Error error = ping.error();
    error.where.ping = static_cast<std::int64_t>(ping_index);
    return tl::unexpected<Error>(std::move(error));
  }
  const BeamGrid& grid = *observation.grid;
  const Shape3 shape{grid.fans(), grid.beams(), observation.range.count};
  if (out.volume.counts.shape() != shape) out.volume.counts = Array3<std::int16_t>(shape);
  if (out.volume.flags.shape() != shape) out.volume.flags = Array3<SampleFlags>(shape);
  const auto counts = out.volume.counts.view();
  const auto flags = out.volume.flags.view();
  // Channels come in rising order, so one walk over the ping finds those of the grid and those that are missing.
  const std::vector<int> row_of_channel = grid.row_of_channel();
  std::size_t next = 0;
  for (int channel = 0; channel < static_cast<int>(row_of_channel.size()); ++channel) {
    const int row = row_of_channel[static_cast<std::size_t>(channel)];
    while (next < ping->channels.size() && ping->channels[next].channel < channel) ++next;
    if (next < ping->channels.size() && ping->channels[next].channel == channel) {
      lay_channel(ping->channels[next], counts.row(row), flags.row(row));
    } else {
      lose(counts.row(row), flags.row(row));
    }
  }
  out.time = ping->time;
  out.heads = std::move(ping->channels);
  for (ChannelPing& head : out.heads) head.power_count = {};
  return {};
}

Result<PowerVolume> load_volume(const SurveyFiles& survey, const ObservationFiles& observation,
                                std::size_t ping_index) {
  PowerVolume out;
  if (auto loaded = load_volume(survey, observation, ping_index, out); !loaded) return pass_on(loaded);
  return out;
}

}  // namespace sonar
