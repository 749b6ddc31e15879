// SPDX-License-Identifier: Apache-2.0
// sonar_bench_slices [REPETITIONS]: what a desktop does for a slice, 800 x 600, on an MS70's grid of 20 fans x 25 beams x
// 3300 samples. Every map is compared with the geometry of each pixel, and every image with its map, before it is timed.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "base/units.h"
#include "render/draw_frame.h"
#include "synth/beam_table.h"
#include "view/slices/slice_geometry.h"
#include "view/slices/slice_picture.h"

namespace sonar::bench {
namespace {

constexpr PixelSize kSize{800, 600};
constexpr int kFans = 20;
constexpr int kBeams = 25;
constexpr RangeAxis kRange{-0.19, 0.1515, 3300};

Sector ms70_sector() {
  std::vector<double> elevation(kFans, 0.0);
  std::vector<double> azimuth(kBeams, 0.0);
  const std::vector<synth::Beam> beams = synth::ms70_beams();
  for (std::size_t channel = 0; channel < beams.size(); ++channel) {
    elevation[channel / kBeams] += rad_from_deg(beams[channel].elevation_deg) / kBeams;
    azimuth[channel % kBeams] += rad_from_deg(270.0 + beams[channel].azimuth_deg) / kFans;
  }
  return {elevation, azimuth, kRange};
}

/// Speckle over all of the display's range, three quarters of it flagged as mostly noise, and two schools.
struct Ping {
  Array3<std::int16_t> sv{{kFans, kBeams, kRange.count}};
  Array3<SampleFlags> flags{{kFans, kBeams, kRange.count}};
  std::vector<MaskLayer> masks;

  Ping() {
    std::uint32_t random = 20070501;
    for (std::size_t i = 0; i < sv.all().size(); ++i) {
      random = random * 1664525U + 1013904223U;
      sv.all()[i] = static_cast<std::int16_t>(std::lround(counts_from_db(-95.0 + (random >> 16U) % 6000U / 100.0)));
      flags.all()[i] = (random >> 8U) % 4U != 0U ? SampleFlags::low_snr : SampleFlags::none;
      if ((random >> 24U) == 7U) flags.all()[i] |= SampleFlags::impulse;
    }
    add_school(10, 12, 1500, {0.9F, 0.1F, 0.1F});
    add_school(11, 5, 2600, {0.1F, 0.5F, 0.9F});
  }

  void add_school(int fan, int beam, int sample, std::array<float, 3> rgb) {
    auto mask = std::make_shared<PingMask>();
    for (int f = fan - 4; f <= fan + 4; ++f) {
      for (int b = beam - 5; b <= beam + 5; ++b) {
        const int half = 200 - 30 * std::abs(f - fan) - 20 * std::abs(b - beam);
        if (half <= 0) continue;
        mask->runs.push_back({f * kBeams + b, sample - half, 2 * half});
        for (int i = 0; i < 2 * half; ++i) {
          mask->confidence.push_back(static_cast<std::uint8_t>(1 + 254 * std::min(i, 2 * half - i) / half));
        }
      }
    }
    masks.push_back({mask, rgb});
  }
};

template <class Body>
void time(const std::string& what, int repetitions, const Body& body) {
  std::vector<double> ms;
  for (int i = 0; i < repetitions; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    body(i);
    ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
  }
  std::sort(ms.begin(), ms.end());
  fmt::print("  {:<46} median {:8.3f} ms   min {:8.3f} ms   (n = {})\n", what, ms[ms.size() / 2], ms.front(),
             repetitions);
}

template <class T>
T must(Result<T> result) {
  if (result) return std::move(*result);
  fmt::print(stderr, "{}\n", to_line(result.error()));
  std::exit(EXIT_FAILURE);
}

void must(bool right, const std::string& what) {
  if (right) return;
  fmt::print(stderr, "wrong answer: {}\n", what);
  std::exit(EXIT_FAILURE);
}

/// Every pixel by its own geometry.
void verify(const SliceMap& map) {
  const SliceGeometry geometry(map.sector(), map.view());
  for (int y = 0; y < map.size().height; ++y) {
    for (int x = 0; x < map.size().width; ++x) {
      const PixelPoint centre{x + 0.5, y + 0.5};
      const PixelPoint p = map.slice_coordinates(centre);
      must(map.voxel_at(centre) == geometry.voxel(p.x, p.y), fmt::format("the map at pixel {}, {}", x, y));
    }
  }
}

/// Without masks and flags every pixel has the colour of its voxel's Sv.
void verify(const SliceMap& map, const Image& image, const Ping& ping, const SvColours& colours, const Theme& theme) {
  for (std::size_t i = 0; i < map.voxels().size(); ++i) {
    const std::int32_t voxel = map.voxels()[i];
    Rgba8 expected{0, 0, 0, 0};
    if (voxel >= 0) expected = colours[ping.sv.all()[static_cast<std::size_t>(voxel)]];
    if (voxel >= 0 && expected.a == 0) expected = theme.water;
    must(image.pixels[i] == expected, fmt::format("the image at pixel {}", i));
  }
}

void measure(const std::string& name, const Sector& sector, const SliceView& view, const Ping& ping, int n) {
  fmt::print("{}\n", name);
  const Theme theme = light_theme(kSize);
  const SliceExtent extent = whole_extent(sector, view).value_or(SliceExtent{});
  const SliceMap map(sector, view, extent, kSize);
  verify(map);
  time("map made anew", n, [&](int) { SliceMap(sector, view, extent, kSize); });
  if (std::holds_alternative<TopSlice>(view.slice)) {
    const auto turned = [&](int i) {
      SliceView north = view;
      north.up_rad = rad_from_deg(-35.0 - 0.37 * i);
      return SliceMap(sector, north, whole_extent(sector, north).value_or(extent), kSize);
    };
    verify(turned(0));
    time("map made anew, north up at another heading", n, turned);
  }
  const SvColours colours = sv_colours(SvScale{});
  SliceData plain{ping.sv.view(), {}, {}};
  verify(map, must(slice_image(map, plain, colours, {}, {}, theme)), ping, colours, theme);
  time("image without masks", n, [&](int) { (void)must(slice_image(map, plain, colours, {}, {}, theme)); });
  const SliceData all{ping.sv.view(), ping.flags.view(), ping.masks};
  const FlagStyle flags{SampleFlags::impulse, SampleFlags::none, SampleFlags::low_snr};
  time("image with masks and flags", n, [&](int) { (void)must(slice_image(map, all, colours, flags, {}, theme)); });
  SlicePing titled{"obs-0001", 12, 1'000'000'000'000'000'000, 0.6, 7.0, std::vector<double>(kFans, 85e3)};
  SliceStyle style;
  style.flags = flags;
  const SlicePicture first = must(slice_picture(sector, all, titled, view, style, theme, kSize));
  time("picture with the map of the ping before", n,
       [&](int) { (void)must(slice_picture(sector, all, titled, view, style, theme, kSize, first.map)); });
  time("draw_frame of the picture", n, [&](int) { (void)must(draw_frame(first.frame)); });
}

int run(int repetitions) {
  const Sector sector = ms70_sector();
  const Ping ping;
  measure("Top slice", sector, {TopSlice{10}}, ping, repetitions);
  measure("Side slice", sector, {SideSlice{12}}, ping, repetitions);
  measure("Horizontal plane, 80 m", sector, {horizontal_plane(80.0, 7.0)}, ping, repetitions);
  measure("Range shell", sector, {RangeSlice{1500}}, ping, repetitions);
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace sonar::bench

int main(int argc, char** argv) { return sonar::bench::run(argc > 1 ? std::max(1, std::atoi(argv[1])) : 31); }
