// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "view/volume/volume_scene.h"

namespace sonar::bench {

/// A scene as make_scene.py writes it, in the sonar's frame (x, -y, -z of the files, beams in rising azimuth).
struct SceneFiles {
  std::shared_ptr<const VolumeData> volume;
  OpticalTable table;
  VolumeView view;  ///< 1024 x 768
};

/// view  overview or closeup;  table  schools or haze
[[nodiscard]] std::optional<SceneFiles> read_scene(const std::filesystem::path& folder, const std::string& view,
                                                   const std::string& table);

/// A picture of 8-bit red, green, blue, rows from top to bottom.
[[nodiscard]] std::optional<Image> read_rgb(const std::filesystem::path& file, PixelSize size);

}  // namespace sonar::bench
