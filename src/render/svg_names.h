// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace sonar {

/// Cairo numbers an SVG's parts by a counter of the whole process; here they are numbered from 1 in their order, so
/// that equal pictures are equal files.
[[nodiscard]] std::string renumbered_svg(const std::string& svg);

/// A text as XML holds it.
[[nodiscard]] std::string escaped_xml(const std::string& text);

/// With a <title> as the first child of <svg>, and a <desc> behind it where there is a description.
[[nodiscard]] std::string titled_svg(const std::string& svg, const std::string& title, const std::string& description);

/// Every raster with "draw my pixels as blocks when enlarged".
[[nodiscard]] std::string pixelated_svg(const std::string& svg);

/// Cairo dates a PDF; the date becomes a fixed one of the same length, so that the file's offsets stay right.
[[nodiscard]] std::string undated_pdf(std::string pdf);

}  // namespace sonar
