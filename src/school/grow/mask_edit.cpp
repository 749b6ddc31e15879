// SPDX-License-Identifier: Apache-2.0
#include "school/grow/mask_edit.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "school/recorded_ends.h"

namespace sonar {
namespace {

constexpr std::uint8_t kSure = 255;

/// A mask's voxels as bytes in a box that may reach over the grid's borders.
class Block {
 public:
  Block(const PingMask& mask, const Shape3& grid)
      : grid_(grid),
        box_(box_of(mask, grid.beams).enlarged(1, 1, 1)),
        bytes_({box_.fans(), box_.beams(), box_.samples()}) {
    std::size_t i = 0;
    for (const Run& run : mask.runs) {
      for (std::int32_t s = run.first_sample; s < run.end(); ++s) {
        bytes_(run.row / grid.beams - box_.first_fan, run.row % grid.beams - box_.first_beam, s - box_.first_sample) =
            mask.confidence[i++];
      }
    }
  }

  [[nodiscard]] const Shape3& shape() const { return bytes_.shape(); }
  [[nodiscard]] Array3<std::uint8_t>& bytes() { return bytes_; }
  [[nodiscard]] const Array3<std::uint8_t>& bytes() const { return bytes_; }
  [[nodiscard]] bool in_grid(int fan, int beam, int sample) const {
    const int f = fan + box_.first_fan;
    const int b = beam + box_.first_beam;
    const int s = sample + box_.first_sample;
    return f >= 0 && f < grid_.fans && b >= 0 && b < grid_.beams && s >= 0 && s < grid_.samples;
  }

  /// All voxels that are not 0 and may be members.
  [[nodiscard]] PingMask mask(View3<const SampleFlags> flags) const {
    const std::vector<int> ends = recorded_ends(flags);
    PingMask out;
    for (int f = 0; f < shape().fans; ++f) {
      for (int b = 0; b < shape().beams; ++b) {
        for (int s = 0; s < shape().samples; ++s) {
          const std::uint8_t confidence = bytes_(f, b, s);
          if (confidence == 0 || !in_grid(f, b, s)) continue;
          const int fan = f + box_.first_fan;
          const int beam = b + box_.first_beam;
          const int sample = s + box_.first_sample;
          if (sample >= ends[static_cast<std::size_t>(fan)] || any(flags(fan, beam, sample) & kNeverMember)) continue;
          const int row = fan * grid_.beams + beam;
          if (!out.runs.empty() && out.runs.back().row == row && out.runs.back().end() == sample) {
            ++out.runs.back().count;
          } else {
            out.runs.push_back({row, sample, 1});
          }
          out.confidence.push_back(confidence);
        }
      }
    }
    return out;
  }

 private:
  Shape3 grid_;
  IndexBox box_;
  Array3<std::uint8_t> bytes_;
};

using Place = std::array<int, 3>;

constexpr std::array<Place, 6> kFaces{{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

/// What a flood from the box's corner reaches without touching the mask; the box's rim is free all round.
Array3<std::uint8_t> outside_of(const Block& block) {
  const Shape3 shape = block.shape();
  Array3<std::uint8_t> reached(shape);
  std::vector<Place> front{{0, 0, 0}};
  reached(0, 0, 0) = 1;
  while (!front.empty()) {
    const Place at = front.back();
    front.pop_back();
    for (const Place& step : kFaces) {
      const int f = at[0] + step[0];
      const int b = at[1] + step[1];
      const int s = at[2] + step[2];
      if (f < 0 || b < 0 || s < 0 || f >= shape.fans || b >= shape.beams || s >= shape.samples) continue;
      if (reached(f, b, s) != 0 || block.bytes()(f, b, s) != 0) continue;
      reached(f, b, s) = 1;
      front.push_back({f, b, s});
    }
  }
  return reached;
}

/// Whether more than half of the grid's voxels round a place are in the mask.
bool mostly_member(const Block& block, int fan, int beam, int sample) {
  int members = 0;
  int all = 0;
  const Shape3 shape = block.shape();
  for (int f = fan - 1; f <= fan + 1; ++f) {
    for (int b = beam - 1; b <= beam + 1; ++b) {
      for (int s = sample - 1; s <= sample + 1; ++s) {
        if (!block.in_grid(f, b, s)) continue;
        ++all;
        const bool inside = f >= 0 && b >= 0 && s >= 0 && f < shape.fans && b < shape.beams && s < shape.samples;
        if (inside && block.bytes()(f, b, s) != 0) ++members;
      }
    }
  }
  return 2 * members > all;
}

}  // namespace

PingMask brushed(std::vector<Run> runs, View3<const SampleFlags> flags) {
  std::sort(runs.begin(), runs.end());
  const std::vector<int> ends = recorded_ends(flags);
  PingMask out;
  for (const Run& run : runs) {
    const auto of_row = flags.row(run.row);
    const std::int32_t end = std::min(run.end(), ends[static_cast<std::size_t>(run.row / flags.shape().beams)]);
    std::int32_t first = run.first_sample;
    if (!out.runs.empty() && out.runs.back().row == run.row) first = std::max(first, out.runs.back().end());
    for (std::int32_t s = first; s < end; ++s) {
      if (any(of_row[static_cast<std::size_t>(s)] & kNeverMember)) continue;
      if (!out.runs.empty() && out.runs.back().row == run.row && out.runs.back().end() == s) {
        ++out.runs.back().count;
      } else {
        out.runs.push_back({run.row, s, 1});
      }
      out.confidence.push_back(kSure);
    }
  }
  return out;
}

PingMask fill_holes(const PingMask& mask, View3<const SampleFlags> flags) {
  if (mask.empty()) return {};
  Block block(mask, flags.shape());
  const Array3<std::uint8_t> outside = outside_of(block);
  for (std::size_t i = 0; i < outside.all().size(); ++i) {
    if (outside.all()[i] == 0 && block.bytes().all()[i] == 0) block.bytes().all()[i] = kSure;
  }
  return block.mask(flags);
}

PingMask smoothed(const PingMask& mask, View3<const SampleFlags> flags) {
  if (mask.empty()) return {};
  const Block before(mask, flags.shape());
  Block after = before;
  const Shape3 shape = before.shape();
  for (int f = 0; f < shape.fans; ++f) {
    for (int b = 0; b < shape.beams; ++b) {
      for (int s = 0; s < shape.samples; ++s) {
        std::uint8_t& voxel = after.bytes()(f, b, s);
        if (!mostly_member(before, f, b, s)) {
          voxel = 0;
        } else if (voxel == 0) {
          voxel = kSure;
        }
      }
    }
  }
  return after.mask(flags);
}

std::vector<PingMask> parts(const PingMask& mask, const Shape3& shape, Connectivity connectivity) {
  const Components components = label_runs(mask.runs, shape, connectivity);
  std::vector<PingMask> out(static_cast<std::size_t>(components.count));
  std::size_t voxel = 0;
  for (std::size_t i = 0; i < mask.runs.size(); ++i) {
    PingMask& part = out[static_cast<std::size_t>(components.label[i])];
    const auto count = static_cast<std::size_t>(mask.runs[i].count);
    part.runs.push_back(mask.runs[i]);
    for (std::size_t k = 0; k < count; ++k) part.confidence.push_back(mask.confidence[voxel + k]);
    voxel += count;
  }
  return out;
}

PingMask largest_part(const PingMask& mask, const Shape3& shape, Connectivity connectivity) {
  PingMask largest;
  for (PingMask& part : parts(mask, shape, connectivity)) {
    if (part.voxels() > largest.voxels()) largest = std::move(part);
  }
  return largest;
}

bool contains(const PingMask& mask, int row, int sample) {
  const auto after =
      std::upper_bound(mask.runs.begin(), mask.runs.end(), std::pair(row, sample), [](const auto& at, const Run& run) {
        return at < std::pair(static_cast<int>(run.row), static_cast<int>(run.first_sample));
      });
  if (after == mask.runs.begin()) return false;
  const Run& run = *std::prev(after);
  return run.row == row && sample < run.end();
}

}  // namespace sonar
