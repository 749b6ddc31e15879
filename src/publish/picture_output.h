// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "base/result.h"
#include "view/frame_description.h"

namespace sonar {

/// A 2-D picture in memory, for whoever shows it. errors: as draw_frame()
/// scale  device pixels per pixel
[[nodiscard]] Result<Image> painted(const FrameDescription& frame, double scale);
/// A picture into a file; the ending names the format: .png, .svg or .pdf. errors: usage (another
/// ending), bad_parameter; as AtomicFile
[[nodiscard]] Result<void> write_picture(const FrameDescription& frame, const std::filesystem::path& file,
                                         double scale = 1.0);
/// Pixels as they are on the screen into a .png. errors: usage (another ending); as AtomicFile
[[nodiscard]] Result<void> write_pixels(const Image& image, const std::filesystem::path& file);

}  // namespace sonar
