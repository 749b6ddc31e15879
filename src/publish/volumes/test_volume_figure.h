// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "publish/volumes/volume_figure.h"
#include "view/slices/slice_example.h"

namespace sonar::volume_test {

/// Schools all over a ping; the third one is selected.
inline VolumeFigure schools_alone(int schools) {
  const Sector sector = slice_example::hand_sector();
  const Shape3 shape{sector.fans(), sector.beams(), sector.range().count};
  VolumeFigure figure;
  figure.volume = std::make_shared<VolumeData>(VolumeData{sector, Array3<std::int16_t>(shape, kMinCount), -7.0});
  figure.navigation.transducer_depth_m = 7.0;
  for (int i = 0; i < schools; ++i) {
    auto mask = std::make_shared<PingMask>();
    mask->runs = {{(1 + i % 6) * sector.beams() + i % 7, 8 + 4 * (i % 7), 4}};
    mask->confidence.assign(4, 255);
    figure.masks.push_back({std::move(mask), {0.0F, 0.5F, 1.0F}});
    figure.masks.back().selected = i == 2;
    figure.names.push_back(std::to_string(i + 1));
    figure.legend.emplace_back(Rgba8{0, 128, 255, 255}, "school " + std::to_string(i + 1) + ", unreviewed");
  }
  figure.refused.push_back({1, {2, 5, 30}, 1, 1, 1, false});
  figure.fitted = FittedSeabed{120.0, 0.05, 0.0, -90.0, 90.0, -180.0, -30.0};
  figure.outlined = true;
  figure.fan = 3;
  figure.beam = 2;
  figure.title_line = "obs-0001   ping 3";
  return figure;
}

/// A view's trails: none, the ship's, or all of them, each with a row of the legend.
inline void choose_trails(int view, VolumeFigure& figure, PictureOptions& options) {
  figure.trails = view % 4 == 0 ? nullptr : std::make_shared<std::vector<SceneLine>>();
  figure.schools_tracked = view % 4 > 1;
  options.volume.ship_track = true;
  options.volume.school_tracks = view % 4 == 3;
  options.volume.trail_pings = view % 5;
}

inline CameraParams from_anywhere(std::mt19937& random, double least_zoom, double most_zoom) {
  const auto even = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  CameraParams out;
  out.orbit_deg = even(-180.0, 180.0);
  out.rise_deg = even(-70.0, 40.0);
  out.zoom = even(least_zoom, most_zoom);
  return out;
}

/// The frame of a figure without echoes.
inline FrameDescription frame_of(const VolumeFigure& figure, const PictureOptions& options) {
  Work work(1);
  const auto place = volume_place(options);
  EXPECT_TRUE(place);
  const auto camera = volume_camera(figure.sector(), options, place->rays);
  EXPECT_TRUE(camera);
  const ContextPicture context = volume_context(figure, options, *place, *camera, work);
  const VolumeView view = volume_view(figure, options, *place, *camera, context);
  const RayImage rays{place->rays, std::vector<std::array<float, 4>>(place->rays.count()), {}};
  return volume_figure_frame(figure, options, *place, view, context, rays, work);
}

inline bool overlap(const PixelRect& a, const PixelRect& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

inline std::vector<TextItem> words_in(const FrameDescription& frame, const PixelRect& place) {
  std::vector<TextItem> out;
  for (const auto& item : frame.items) {
    const auto* text = std::get_if<TextItem>(&item);
    if (text != nullptr && text->turned_deg == 0.0 && inside(place, text->at)) out.push_back(*text);
  }
  return out;
}

}  // namespace sonar::volume_test
