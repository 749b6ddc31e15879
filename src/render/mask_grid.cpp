// SPDX-License-Identifier: Apache-2.0
#include "render/mask_grid.h"

#include <fmt/format.h>

#include <algorithm>

namespace sonar {
namespace {

Result<void> check(const PingMask& mask, Shape3 shape) {
  std::size_t voxels = 0;
  for (const Run& run : mask.runs) {
    if (run.row < 0 || static_cast<std::size_t>(run.row) >= shape.rows() || run.first_sample < 0 || run.count < 0 ||
        run.count > shape.samples || run.first_sample > shape.samples - run.count) {
      return fail(ErrorCode::bad_parameter,
                  fmt::format("a mask's run (row {}, sample {}, {} samples) lies outside the grid of {} x {} x {}",
                              run.row, run.first_sample, run.count, shape.fans, shape.beams, shape.samples));
    }
    voxels += static_cast<std::size_t>(run.count);
  }
  if (voxels != mask.confidence.size()) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("a mask has {} voxels and {} confidences", voxels, mask.confidence.size()));
  }
  return {};
}

/// Marks the cells that have the sample on them; faces belong to both sides.
void touch(const Macrocells& cells, Shape3 shape, const Run& run, std::vector<std::uint8_t>& out) {
  const int fan = run.row / shape.beams;
  const int beam = run.row % shape.beams;
  const int first = std::max((run.first_sample - 1) / kCellSamples, 0);
  const int last = std::min(run.end() / kCellSamples, cells.ranges - 1);
  for (int f = std::max(fan - 1, 0); f <= std::min(fan, cells.fans - 1); ++f) {
    for (int b = std::max(beam - 1, 0); b <= std::min(beam, cells.beams - 1); ++b) {
      for (int k = first; k <= last; ++k) {
        out[static_cast<std::size_t>((f * cells.beams + b) * cells.ranges + k)] = 1;
      }
    }
  }
}

void paint(const PingMask& mask, unsigned layer, Array3<std::uint16_t>& out) {
  std::size_t voxel = 0;
  for (const Run& run : mask.runs) {
    const auto row = out.view().row(run.row);
    for (int i = run.first_sample; i < run.end(); ++i, ++voxel) {
      std::uint16_t& at = row[static_cast<std::size_t>(i)];
      if (mask.confidence[voxel] > (at & 0xFFU)) {
        at = static_cast<std::uint16_t>(layer << 8U | mask.confidence[voxel]);
      }
    }
  }
}

}  // namespace

Result<MaskGrid> mask_grid(std::span<const MaskLayer> masks, const Macrocells& cells, Shape3 shape) {
  if (masks.size() > kMostMasks) {
    return fail(ErrorCode::bad_parameter, fmt::format("{} masks at once; {} are the most", masks.size(), kMostMasks));
  }
  for (const MaskLayer& layer : masks) {
    if (layer.mask == nullptr) {
      return fail(ErrorCode::bad_parameter, "a mask layer has no mask");
    }
    if (auto ok = check(*layer.mask, shape); !ok) {
      return pass_on(ok);
    }
  }
  MaskGrid out;
  if (masks.empty()) {
    return out;
  }
  out.voxels = Array3<std::uint16_t>(shape, 0);
  out.cells.assign(cells.size(), 0);
  for (std::size_t i = 0; i < masks.size(); ++i) {
    paint(*masks[i].mask, static_cast<unsigned>(i + 1), out.voxels);
    for (const Run& run : masks[i].mask->runs) touch(cells, shape, run, out.cells);
    out.rgb.push_back(masks[i].rgb);
  }
  return out;
}

}  // namespace sonar
