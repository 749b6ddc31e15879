// SPDX-License-Identifier: Apache-2.0
#include "synth/faults.h"

#include <algorithm>

#include "base/units.h"
#include "synth/random.h"

namespace sonar::synth {
namespace {

constexpr int kLongestFault_pings = 3;
constexpr double kCorruptedPower_db = -115.0;
constexpr double kInterferencePower_db = -118.0;
constexpr double kImpulsePower_db = -122.0;
constexpr double kPowerSpread_db = 6.0;

RandomStream stream(const Scene& scene, Purpose purpose, int ping) {
  return {scene.seed, purpose, scene.observation, static_cast<std::uint32_t>(ping)};
}

void add_stretch(View3<float> power_w, int row, int first, int count, double add_w) {
  const auto samples = power_w.row(row);
  const int last = std::min(first + count, power_w.shape().samples);
  for (int s = std::max(0, first); s < last; ++s) samples[static_cast<std::size_t>(s)] += static_cast<float>(add_w);
}

/// Rows of a channel's fan, or all of them.
bool in_interference(const Layout& layout, int row, int fan) {
  return fan < 0 || !layout.grid || row / layout.shape.beams == fan;
}

void add_interference(const Layout& layout, const Interference& one, double scale, View3<float> power_w) {
  for (int row = 0; row < static_cast<int>(layout.rows.size()); ++row) {
    if (!in_interference(layout, row, one.fan)) continue;
    add_stretch(power_w, row, one.first_sample, one.count, scale * linear_from_db(one.power_db));
  }
}

int row_of_channel(const Layout& layout, int channel) {
  for (std::size_t row = 0; row < layout.rows.size(); ++row) {
    if (layout.rows[row].channel == channel) return static_cast<int>(row);
  }
  return -1;
}

void add_corrupted_packets(const Layout& layout, const Scene& scene, int ping, View3<float> power_w) {
  const double scale = scene.noise.scale;
  for (const CorruptedStretch& hot : scene.corrupted_packets) {
    const int row = hot.ping == ping ? row_of_channel(layout, hot.channel) : -1;
    if (row >= 0) add_stretch(power_w, row, hot.first_sample, hot.count, scale * linear_from_db(hot.power_db));
  }
  for (int start = std::max(0, ping - kLongestFault_pings + 1); start <= ping; ++start) {
    RandomStream random = stream(scene, Purpose::corrupted_packets, start);
    for (int left = random.poisson(scene.noise.corrupted_packets * scale); left > 0; --left) {
      const int row = random.index(static_cast<int>(layout.rows.size()));
      const int first = random.index(layout.shape.samples);
      const int count = 150 + random.index(600);
      const double power_db = kCorruptedPower_db + kPowerSpread_db * random.uniform(-1.0, 1.0);
      const int lasts = 1 + random.index(kLongestFault_pings);
      if (start + lasts > ping) add_stretch(power_w, row, first, count, scale * linear_from_db(power_db));
    }
  }
}

void add_all_interference(const Layout& layout, const Scene& scene, int ping, View3<float> power_w) {
  const double scale = scene.noise.scale;
  for (const Interference& one : scene.interference) {
    if (one.ping == ping) add_interference(layout, one, scale, power_w);
  }
  RandomStream random = stream(scene, Purpose::interference, ping);
  for (int left = random.poisson(scene.noise.interference * scale); left > 0; --left) {
    Interference one;
    one.first_sample = random.index(layout.shape.samples);
    one.count = 2 + random.index(5);
    one.power_db = kInterferencePower_db + kPowerSpread_db * random.uniform(-1.0, 1.0);
    if (random.index(4) == 0) one.fan = random.index(layout.shape.fans);
    add_interference(layout, one, scale, power_w);
  }
}

void add_impulses(const Layout& layout, const Scene& scene, int ping, View3<float> power_w) {
  RandomStream random = stream(scene, Purpose::impulse, ping);
  for (int left = random.poisson(scene.noise.impulse_noise * scene.noise.scale); left > 0; --left) {
    const int row = random.index(static_cast<int>(layout.rows.size()));
    const int first = random.index(layout.shape.samples);
    const int count = 1 + random.index(3);
    const double power_db = kImpulsePower_db + kPowerSpread_db * random.uniform(-1.0, 1.0);
    add_stretch(power_w, row, first, count, scene.noise.scale * linear_from_db(power_db));
  }
}

}  // namespace

void add_faults(const Layout& layout, const Scene& scene, int ping, View3<float> power_w) {
  add_corrupted_packets(layout, scene, ping, power_w);
  add_all_interference(layout, scene, ping, power_w);
  add_impulses(layout, scene, ping, power_w);
}

std::vector<bool> recorded_rows(const Layout& layout, const Scene& scene, int ping) {
  constexpr int kMostNeighbours = 10;
  const int rows = static_cast<int>(layout.rows.size());
  std::vector<bool> recorded(layout.rows.size(), true);
  for (int start = std::max(0, ping - kLongestFault_pings + 1); start <= ping; ++start) {
    RandomStream random = stream(scene, Purpose::dropout, start);
    for (int left = random.poisson(scene.noise.dropouts * scene.noise.scale); left > 0; --left) {
      const int first = random.index(rows);
      const int last = std::min(rows, first + 1 + random.index(kMostNeighbours));
      const int lasts = 1 + random.index(kLongestFault_pings);
      if (start + lasts <= ping) continue;
      for (int row = first; row < last; ++row) recorded[static_cast<std::size_t>(row)] = false;
    }
  }
  return recorded;
}

}  // namespace sonar::synth
