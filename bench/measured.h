// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <ctime>
#include <string>
#include <string_view>
#include <vector>

#include "render/draw_frame.h"
#include "render/volume_renderer.h"
#include "targets.h"

namespace sonar::bench {

/// A view of make_scene.py with a transfer function.
struct SceneName {
  const char* view;
  const char* table;

  [[nodiscard]] bool dense() const { return std::string_view(table) == "haze"; }
  [[nodiscard]] std::string text() const { return std::string(view) + " " + table; }
};

/// Of frames, medians.
struct Times {
  double wall_s = 0.0;
  double cpu_s = 0.0;
};

/// How long `body` takes, which is called `frames` times (at least once).
template <class Body>
Times timed(int frames, const Body& body) {
  using Clock = std::chrono::steady_clock;
  std::vector<double> wall;
  std::vector<double> cpu;
  for (int i = 0; i < frames; ++i) {
    const auto began = Clock::now();
    const std::clock_t ran = std::clock();
    body();
    cpu.push_back(static_cast<double>(std::clock() - ran) / CLOCKS_PER_SEC);
    wall.push_back(std::chrono::duration<double>(Clock::now() - began).count());
  }
  std::sort(wall.begin(), wall.end());
  std::sort(cpu.begin(), cpu.end());
  return {wall[wall.size() / 2], cpu[cpu.size() / 2]};
}

/// Rays before a black background.
[[nodiscard]] Image black(const RayImage& rays);
/// Ends the program where it cannot be drawn.
[[nodiscard]] RayImage drawn(VolumeRenderer& renderer, const VolumeView& view, const DrawQuality& quality, Work& work);
/// A line with times and PSNR.
void report(const std::string& who, const Times& times, double psnr_db);
/// Prints what the targets have to say.
void tell(Targets& targets);
/// FOLDER/overview_haze_ours.png
void keep(const Image& picture, const std::string& folder, const SceneName& scene, const std::string& what);

}  // namespace sonar::bench
