// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "view/frame_description.h"

// What Cairo's SVG and PDF files lack, and what they should not hold.
namespace sonar {

/// Cairo numbers an SVG's parts by a counter of the whole process; here they are numbered from 1 in their order, so
/// that equal pictures are equal files.
[[nodiscard]] std::string renumbered_svg(const std::string& svg);
/// With a <title> as the first child of <svg>, and a <desc> behind it where there is a description.
[[nodiscard]] std::string titled_svg(const std::string& svg, const std::string& title, const std::string& description);
/// Cairo writes letters as outlines, so that a picture looks alike wherever it is opened. Here the same words lie over
/// them as text that is not seen: they can be found, marked and copied, and a screen reader reads them.
/// svg    of the frame
/// scale  of the frame's pixels
[[nodiscard]] std::string searchable_svg(const std::string& svg, const FrameDescription& frame, double scale);
/// Every raster with "draw my pixels as blocks when enlarged".
[[nodiscard]] std::string pixelated_svg(const std::string& svg);
/// Cairo dates a PDF; the date becomes a fixed one of the same length, so that the file's offsets stay right.
[[nodiscard]] std::string undated_pdf(std::string pdf);

}  // namespace sonar
