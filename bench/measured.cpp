// SPDX-License-Identifier: Apache-2.0
#include "measured.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <utility>

namespace sonar::bench {

Image black(const RayImage& rays) { return over(rays, Rgba8{0, 0, 0, 255}); }

RayImage drawn(VolumeRenderer& renderer, const VolumeView& view, const DrawQuality& quality, Work& work) {
  auto out = renderer.draw(view, quality, work);
  if (!out) {
    fmt::print(stderr, "{}\n", to_line(out.error()));
    std::exit(EXIT_FAILURE);
  }
  return std::move(*out);
}

void report(const std::string& who, const Times& times, double psnr_db) {
  fmt::print("  {:<42} cpu {:8.3f} s  wall {:8.3f} s  PSNR {:5.1f} dB\n", who, times.cpu_s, times.wall_s, psnr_db);
}

void tell(Targets& targets) {
  for (const std::string& line : targets.news()) fmt::print("    {}\n", line);
}

void keep(const Image& picture, const std::string& folder, const SceneName& scene, const std::string& what) {
  const std::string file = fmt::format("{}/{}_{}_{}.png", folder, scene.view, scene.table, what);
  const auto bytes = png_bytes(picture);
  if (!bytes || !(std::ofstream(file, std::ios::binary) << *bytes)) fmt::print(stderr, "{}: not written\n", file);
}

}  // namespace sonar::bench
