// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "base/result.h"
#include "view/frame_description.h"

namespace sonar {

/// Draws a 2-D picture in memory (Cairo + Pango).
/// scale   pixels per unit of the description: 2 for a high-density screen
/// errors  bad_parameter: no size, or over 16384 pixels a side
[[nodiscard]] Result<Image> draw_frame(const FrameDescription& frame, double scale = 1.0);

/// Whether the ending is one that picture_bytes() knows, in any case of letters.
[[nodiscard]] bool is_picture_file(const std::filesystem::path& file);

/// What a picture's file holds; the ending of its name tells the format: .png, .svg or .pdf.
/// errors  usage (another ending), bad_parameter
[[nodiscard]] Result<std::string> picture_bytes(const FrameDescription& frame, const std::filesystem::path& file,
                                                double scale = 1.0);

/// A PDF of these pages in their order, each as large as it is; title and origin are those of the first.
/// errors  bad_parameter: no page; as draw_frame()
[[nodiscard]] Result<std::string> pdf_bytes(std::span<const FrameDescription> pages, double scale = 1.0);

/// errors  bad_parameter: no pixels
[[nodiscard]] Result<std::string> png_bytes(const Image& image);
/// errors  io, format
[[nodiscard]] Result<Image> read_png(const std::filesystem::path& file);

}  // namespace sonar
