// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>

#include "view/contrast_example.h"
#include "view/slices/slice_example.h"
#include "view/slices/slice_masks.h"

namespace sonar {
namespace {

constexpr PixelSize kSize{400, 400};

// Law: beside each dot of a core's line, in data of whatever colour, there is something with a contrast of 3 or more.
TEST(SliceImage, ACoresLineStandsOutFromEveryColour) {
  const SliceMap map(slice_example::hand_sector(), {TopSlice{4}}, {-200, -200, 200, 200}, kSize);
  PingMask mask;
  for (int beam = 0; beam < 7; ++beam) {
    mask.runs.push_back({28 + beam, 12, 20});
    for (int s = 0; s < 20; ++s) mask.confidence.push_back(beam > 1 && beam < 5 && s > 4 && s < 15 ? 255 : 60);
  }
  const auto data = contrast_example::data_colours();
  const auto part = [](int v) { return static_cast<float>(v) / 255.0F; };
  const Rgba8 untouched{1, 2, 3, 255};
  const auto in_core = [&](int x, int y) {
    const int voxel = map.voxels()[static_cast<std::size_t>(y * kSize.width + x)];
    const int beam = voxel / 41 % 7;
    const int sample = voxel % 41;
    return voxel >= 0 && beam > 1 && beam < 5 && sample > 16 && sample < 27;
  };
  const auto check = [&](const Theme& theme, int number) {
    const Rgba8 c = school_colour(number);
    Image image(kSize, untouched);
    const MaskLayer layer{std::make_shared<PingMask>(mask), {part(c.r), part(c.g), part(c.b)}};
    ASSERT_TRUE(blend_masks(image, map, {layer}, {}, theme));
    std::set<std::set<int>> seen;  // colours at and beside a dot, as numbers
    for (int y = 1; y < kSize.height - 1; ++y) {
      for (int x = 1; x < kSize.width - 1; ++x) {
        const std::array<Rgba8, 4> round{image.at(x - 1, y), image.at(x + 1, y), image.at(x, y - 1),
                                         image.at(x, y + 1)};
        if (image.at(x, y) != c || !in_core(x, y)) continue;
        std::set<int> colours;
        for (const Rgba8& beside : round) colours.insert((beside.r * 256 + beside.g) * 256 + beside.b);
        seen.insert(colours);
      }
    }
    ASSERT_FALSE(seen.empty());
    for (std::set<int> colours : seen) {
      colours.erase(0x010203);
      for (const auto& [name, under] : data) {
        double most = contrast_example::contrast(c, under);
        for (const int rgb : colours) {
          const Rgba8 beside{static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>((rgb >> 8) & 255),
                             static_cast<std::uint8_t>(rgb & 255), 255};
          most = std::max(most, contrast_example::contrast(beside, under));
        }
        ASSERT_GE(most, 3.0) << name << ", school " << number;
      }
    }
  };
  for (const Theme& theme : contrast_example::both_themes({640, 480})) {
    for (int number = 0; number < kSchoolColours; ++number) check(theme, number);
  }
}

}  // namespace
}  // namespace sonar
