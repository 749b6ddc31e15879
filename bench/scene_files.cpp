// SPDX-License-Identifier: Apache-2.0
#include "scene_files.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <vector>

#include "base/units.h"

namespace sonar::bench {
namespace {

constexpr Shape3 kShape{20, 25, 1319};
constexpr double kSpacing_m = 0.38;

template <class T>
bool read_all(const std::filesystem::path& file, std::vector<T>& out) {
  std::ifstream stream(file, std::ios::binary);
  return static_cast<bool>(
      stream.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(out.size() * sizeof(T))));
}

std::shared_ptr<const VolumeData> read_volume(const std::filesystem::path& file) {
  std::vector<float> db(kShape.size());
  if (!read_all(file, db)) return nullptr;
  std::vector<double> elevation;
  std::vector<double> azimuth;
  for (int f = 0; f < kShape.fans; ++f) elevation.push_back(rad_from_deg(-45.0 + 45.0 * f / (kShape.fans - 1)));
  for (int b = 0; b < kShape.beams; ++b) azimuth.push_back(rad_from_deg(-60.0 + 60.0 * b / (kShape.beams - 1)));
  auto out = std::make_shared<VolumeData>(VolumeData{
      Sector(elevation, azimuth, RangeAxis{0.0, kSpacing_m, kShape.samples}), Array3<std::int16_t>(kShape), -1e9});
  const View3<const float> from(db.data(), kShape);
  for (int f = 0; f < kShape.fans; ++f) {
    for (int b = 0; b < kShape.beams; ++b) {
      const auto row = from.row(kShape.fans - 1 - f, kShape.beams - 1 - b);
      std::transform(row.begin(), row.end(), out->sv.row(f, b).begin(), [](float v) {
        return static_cast<std::int16_t>(std::lround(counts_from_db(static_cast<double>(v))));
      });
    }
  }
  return out;
}

Point<Sonar> read_point(std::ifstream& stream) {
  Point<Sonar> p;
  stream >> p.x >> p.y >> p.z;
  return {p.x, -p.y, -p.z};
}

bool read_view(const std::filesystem::path& file, Camera& camera) {
  std::ifstream stream(file);
  camera.eye = read_point(stream);
  read_point(stream);  // right
  read_point(stream);  // up: the camera's own follows from the vertical
  const Point<Sonar> forward = read_point(stream);
  double half = 0.0;
  stream >> half;
  camera.target = camera.eye + forward * 100.0;
  camera.up = {0.0, 0.0, -1.0};
  camera.vertical_fov_rad = 2.0 * std::atan(half);
  return static_cast<bool>(stream);
}

}  // namespace

std::optional<SceneFiles> read_scene(const std::filesystem::path& folder, const std::string& view,
                                     const std::string& table) {
  SceneFiles out;
  out.volume = read_volume(folder / "volume.f32");
  out.table.rgb_extinction.resize(256);
  if (out.volume == nullptr || !read_all(folder / (table + ".tf"), out.table.rgb_extinction) ||
      !read_view(folder / (view + ".view"), out.view.camera)) {
    return std::nullopt;
  }
  return out;
}

std::optional<Image> read_rgb(const std::filesystem::path& file, PixelSize size) {
  std::vector<std::uint8_t> bytes(3 * size.count());
  if (!read_all(file, bytes)) return std::nullopt;
  Image out(size);
  for (std::size_t i = 0; i < size.count(); ++i)
    out.pixels[i] = {bytes[3 * i], bytes[3 * i + 1], bytes[3 * i + 2], 255};
  return out;
}

}  // namespace sonar::bench
