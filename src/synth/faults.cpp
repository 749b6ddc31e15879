// SPDX-License-Identifier: Apache-2.0
#include "synth/faults.h"

#include <algorithm>

#include "base/units.h"
#include "synth/random.h"

namespace sonar::synth {
namespace {

constexpr int kLongestFault_pings = 3;
constexpr double kHotBeamPower_db = -115.0;
constexpr double kWallPower_db = -118.0;
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
bool in_wall(const Layout& layout, int row, int fan) {
  return fan < 0 || !layout.grid || row / layout.shape.beams == fan;
}

void add_wall(const Layout& layout, const Wall& wall, double scale, View3<float> power_w) {
  for (int row = 0; row < static_cast<int>(layout.rows.size()); ++row) {
    if (!in_wall(layout, row, wall.fan)) continue;
    add_stretch(power_w, row, wall.first_sample, wall.count, scale * linear_from_db(wall.power_db));
  }
}

int row_of_channel(const Layout& layout, int channel) {
  for (std::size_t row = 0; row < layout.rows.size(); ++row) {
    if (layout.rows[row].channel == channel) return static_cast<int>(row);
  }
  return -1;
}

void add_hot_beams(const Layout& layout, const Scene& scene, int ping, View3<float> power_w) {
  const double scale = scene.noise.scale;
  for (const HotBeam& hot : scene.hot_beams) {
    const int row = hot.ping == ping ? row_of_channel(layout, hot.channel) : -1;
    if (row >= 0) add_stretch(power_w, row, hot.first_sample, hot.count, scale * linear_from_db(hot.power_db));
  }
  for (int start = std::max(0, ping - kLongestFault_pings + 1); start <= ping; ++start) {
    RandomStream random = stream(scene, Purpose::hot_beam, start);
    for (int left = random.poisson(scene.noise.hot_beams * scale); left > 0; --left) {
      const int row = random.index(static_cast<int>(layout.rows.size()));
      const int first = random.index(layout.shape.samples);
      const int count = 150 + random.index(600);
      const double power_db = kHotBeamPower_db + kPowerSpread_db * random.uniform(-1.0, 1.0);
      const int lasts = 1 + random.index(kLongestFault_pings);
      if (start + lasts > ping) add_stretch(power_w, row, first, count, scale * linear_from_db(power_db));
    }
  }
}

void add_walls(const Layout& layout, const Scene& scene, int ping, View3<float> power_w) {
  const double scale = scene.noise.scale;
  for (const Wall& wall : scene.walls) {
    if (wall.ping == ping) add_wall(layout, wall, scale, power_w);
  }
  RandomStream random = stream(scene, Purpose::wall, ping);
  for (int left = random.poisson(scene.noise.walls * scale); left > 0; --left) {
    Wall wall;
    wall.first_sample = random.index(layout.shape.samples);
    wall.count = 2 + random.index(5);
    wall.power_db = kWallPower_db + kPowerSpread_db * random.uniform(-1.0, 1.0);
    if (random.index(4) == 0) wall.fan = random.index(layout.shape.fans);
    add_wall(layout, wall, scale, power_w);
  }
}

void add_impulses(const Layout& layout, const Scene& scene, int ping, View3<float> power_w) {
  RandomStream random = stream(scene, Purpose::impulse, ping);
  for (int left = random.poisson(scene.noise.impulses * scene.noise.scale); left > 0; --left) {
    const int row = random.index(static_cast<int>(layout.rows.size()));
    const int first = random.index(layout.shape.samples);
    const int count = 1 + random.index(3);
    const double power_db = kImpulsePower_db + kPowerSpread_db * random.uniform(-1.0, 1.0);
    add_stretch(power_w, row, first, count, scene.noise.scale * linear_from_db(power_db));
  }
}

}  // namespace

void add_faults(const Layout& layout, const Scene& scene, int ping, View3<float> power_w) {
  add_hot_beams(layout, scene, ping, power_w);
  add_walls(layout, scene, ping, power_w);
  add_impulses(layout, scene, ping, power_w);
}

std::vector<bool> recorded_rows(const Layout& layout, const Scene& scene, int ping) {
  constexpr int kMostNeighbours = 10;
  const int rows = static_cast<int>(layout.rows.size());
  std::vector<bool> recorded(layout.rows.size(), true);
  for (int start = std::max(0, ping - kLongestFault_pings + 1); start <= ping; ++start) {
    RandomStream random = stream(scene, Purpose::lost, start);
    for (int left = random.poisson(scene.noise.lost_channels * scene.noise.scale); left > 0; --left) {
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
