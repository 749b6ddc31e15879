// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "base/result.h"
#include "view/frame_description.h"

namespace sonar {

/// Draws a 2-D picture in memory (Cairo + Pango).
/// scale   pixels per unit of the description: 2 for a high-density screen
/// errors  bad_parameter: no size, or over 16384 pixels a side
[[nodiscard]] Result<Image> draw_frame(const FrameDescription& frame, double scale = 1.0);

/// Whether the ending is one that write_frame() knows, in any case of letters.
[[nodiscard]] bool is_picture_file(const std::filesystem::path& file);

/// Draws it into a file; the ending names the format: .png, .svg or .pdf. Written under a temporary name and renamed.
/// errors  usage (another ending), bad_parameter, io
[[nodiscard]] Result<void> write_frame(const FrameDescription& frame, const std::filesystem::path& file,
                                       double scale = 1.0);

/// errors  io, format
[[nodiscard]] Result<void> write_png(const Image& image, const std::filesystem::path& file);
[[nodiscard]] Result<Image> read_png(const std::filesystem::path& file);

}  // namespace sonar
