// SPDX-License-Identifier: Apache-2.0
#include "model/mask.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sonar {
namespace {

struct Voxel {
  std::int32_t row;
  std::int32_t sample;
  std::uint8_t confidence;
  [[nodiscard]] std::pair<std::int32_t, std::int32_t> key() const { return {row, sample}; }
};

std::vector<Voxel> voxels_of(const PingMask& mask) {
  std::vector<Voxel> voxels;
  voxels.reserve(mask.voxels());
  std::size_t i = 0;
  for (const Run& run : mask.runs) {
    for (std::int32_t s = run.first_sample; s < run.end(); ++s) voxels.push_back({run.row, s, mask.confidence[i++]});
  }
  return voxels;
}

void append(PingMask& mask, const Voxel& voxel) {
  if (!mask.runs.empty() && mask.runs.back().row == voxel.row && mask.runs.back().end() == voxel.sample) {
    ++mask.runs.back().count;
  } else {
    mask.runs.push_back({voxel.row, voxel.sample, 1});
  }
  mask.confidence.push_back(voxel.confidence);
}

}  // namespace

std::uint8_t confidence_at(const PingMask& mask, int row, int sample) {
  std::size_t before = 0;
  for (const Run& run : mask.runs) {
    if (run.row == row && sample >= run.first_sample && sample < run.end()) {
      return mask.confidence[before + static_cast<std::size_t>(sample - run.first_sample)];
    }
    before += static_cast<std::size_t>(run.count);
  }
  return 0;
}

std::size_t overlap(const PingMask& a, const PingMask& b) {
  std::size_t shared = 0;
  auto i = a.runs.begin();
  auto j = b.runs.begin();
  while (i != a.runs.end() && j != b.runs.end()) {
    if (i->row != j->row) {
      (i->row < j->row ? i : j)++;
      continue;
    }
    const std::int32_t common = std::min(i->end(), j->end()) - std::max(i->first_sample, j->first_sample);
    if (common > 0) shared += static_cast<std::size_t>(common);
    (i->end() < j->end() ? i : j)++;
  }
  return shared;
}

double dice(const PingMask& a, const PingMask& b) {
  const std::size_t total = a.voxels() + b.voxels();
  return total == 0 ? 0.0 : 2.0 * static_cast<double>(overlap(a, b)) / static_cast<double>(total);
}

PingMask unite(const PingMask& a, const PingMask& b) {
  const std::vector<Voxel> in_a = voxels_of(a);
  const std::vector<Voxel> in_b = voxels_of(b);
  PingMask out;
  auto i = in_a.begin();
  auto j = in_b.begin();
  while (i != in_a.end() || j != in_b.end()) {
    if (j == in_b.end() || (i != in_a.end() && i->key() < j->key())) {
      append(out, *i++);
    } else if (i == in_a.end() || j->key() < i->key()) {
      append(out, *j++);
    } else {
      append(out, {i->row, i->sample, std::max(i->confidence, j->confidence)});
      ++i;
      ++j;
    }
  }
  return out;
}

PingMask subtract(const PingMask& a, const PingMask& b) {
  const std::vector<Voxel> in_b = voxels_of(b);
  PingMask out;
  auto j = in_b.begin();
  for (const Voxel& voxel : voxels_of(a)) {
    while (j != in_b.end() && j->key() < voxel.key()) ++j;
    if (j == in_b.end() || j->key() != voxel.key()) append(out, voxel);
  }
  return out;
}

std::uint8_t quantised_confidence(double confidence) {
  return static_cast<std::uint8_t>(std::clamp(std::lround(255.0 * confidence), 1L, 255L));
}

}  // namespace sonar
