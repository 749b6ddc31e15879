// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <variant>

#include "base/units.h"
#include "view/slices/slice_key.h"
#include "view/slices/slice_masks.h"
#include "view/slices/slice_steps.h"
#include "view/slices/slice_voxels.h"

namespace sonar {
namespace {

constexpr int kBright = 128;  ///< sum of a colour's parts, by three, from which a theme is light
constexpr PixelSize kPlanePixels{800, 600};

}  // namespace

SampleFate fate(std::int16_t before, std::int16_t after, int least) {
  if (before == kNoData && after == kNoData) return SampleFate::absent;
  if (after == kNoData) return SampleFate::taken_out;
  if (before == kNoData) return SampleFate::filled_in;
  return std::abs(after - before) >= std::max(least, 1) ? SampleFate::changed : SampleFate::kept;
}

void mark_fates(Image& image, const SliceMap& map, const SliceStepsData& data, const SliceStep& before,
                const SliceStep& after, double mark_db, const Theme& theme) {
  const int least = static_cast<int>(std::lround(counts_from_db(mark_db)));
  std::size_t i = 0;
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width; ++x, ++i) {
      const std::int32_t voxel = map.voxels()[i];
      if (voxel < 0) continue;
      const SampleFate what = fate(sample_of(before, data.flags, voxel), sample_of(after, data.flags, voxel), least);
      const bool striped = what == SampleFate::filled_in || what == SampleFate::changed;
      if (what == SampleFate::taken_out || (striped && on_hatch(x, y, theme))) image.pixels[i] = theme.accent;
    }
  }
}

ColourMap difference_colours(const Theme& theme) {
  const Rgba8 middle = theme.water;
  const bool light = middle.r + middle.g + middle.b > 3 * kBright;
  // The ends and half-ways of the diverging maps "RdBu" (light) and "berlin" (dark), safe for colour-blind eyes.
  if (light) {
    return {{{5, 48, 97, 255}, {67, 147, 195, 255}, middle, {214, 96, 77, 255}, {103, 0, 31, 255}}, false};
  }
  return {{{158, 202, 255, 255}, {45, 110, 160, 255}, middle, {160, 62, 40, 255}, {255, 173, 150, 255}}, false};
}

Image difference_image(const SliceMap& map, const SliceStepsData& data, const SliceStep& before, const SliceStep& after,
                       double most_db, const Theme& theme) {
  Image image(map.size(), Rgba8{0, 0, 0, 0});
  const ColourMap colours = difference_colours(theme);
  const double most = std::max(1.0, counts_from_db(most_db));
  std::size_t i = 0;
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width; ++x, ++i) {
      const std::int32_t voxel = map.voxels()[i];
      if (voxel < 0) continue;
      const std::int16_t a = sample_of(before, data.flags, voxel);
      const std::int16_t b = sample_of(after, data.flags, voxel);
      switch (fate(a, b, 1)) {
        case SampleFate::absent:
          image.pixels[i] = theme.no_data;
          break;
        case SampleFate::taken_out:
          image.pixels[i] = theme.accent;
          break;
        case SampleFate::filled_in:
          image.pixels[i] = on_hatch(x, y, theme) ? theme.accent : theme.water;
          break;
        case SampleFate::kept:
        case SampleFate::changed:
          image.pixels[i] = colours.at(0.5 + 0.5 * (b - a) / most);
          break;
      }
    }
  }
  return image;
}

std::vector<std::int32_t> samples_in(const Sector& sector, const Slice& slice) {
  const int samples = sector.range().count;
  std::vector<std::int32_t> out;
  const auto take_row = [&](int fan, int beam) {
    const std::int32_t first = (fan * sector.beams() + beam) * samples;
    for (int s = 0; s < samples; ++s) out.push_back(first + s);
  };
  if (const auto* top = std::get_if<TopSlice>(&slice)) {
    for (int beam = 0; beam < sector.beams(); ++beam) take_row(top->fan, beam);
  } else if (const auto* side = std::get_if<SideSlice>(&slice)) {
    for (int fan = 0; fan < sector.fans(); ++fan) take_row(fan, side->beam);
  } else if (const auto* range = std::get_if<RangeSlice>(&slice)) {
    for (int row = 0; row < sector.fans() * sector.beams(); ++row) out.push_back(row * samples + range->sample);
  } else if (const auto extent = whole_extent(sector, {slice})) {
    out = slice_voxels(sector, {slice}, *extent, kPlanePixels);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    if (!out.empty() && out.front() < 0) out.erase(out.begin());
  }
  return out;
}

}  // namespace sonar
