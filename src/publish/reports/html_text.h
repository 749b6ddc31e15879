// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "io/csv_table.h"
#include "view/frame_description.h"

namespace sonar {

// Parts of a page of HTML. Whatever comes from data (names, comments, texts of files) stands in it as text alone.

/// A text for an element or an attribute in quotes: markup becomes characters; what is no UTF-8, and control characters
/// other than tab and line feed, become U+FFFD.
[[nodiscard]] std::string html_escaped(std::string_view text);

/// RFC 4648, with padding.
[[nodiscard]] std::string base64(std::string_view bytes);

/// <h2> with a text.
[[nodiscard]] std::string html_heading(std::string_view text);
/// <p> with a text.
[[nodiscard]] std::string html_paragraph(std::string_view text);

/// A picture inside the page (PNG, 2 pixels for each of the description's), with a caption that also stands for it where
/// pictures are not seen.
/// errors  as draw_frame()
[[nodiscard]] Result<std::string> html_picture(const FrameDescription& frame, std::string_view caption);

/// A table: numbers right-aligned and to five digits, columns without any value left out. What a column is, is told where
/// the pointer rests on its name. Of more rows than `most` the first, and a sentence that tells how many there are.
/// caption  what the rows are, and where all of them are
[[nodiscard]] std::string html_table(const CsvTable& table, std::string_view caption, std::size_t most);

}  // namespace sonar
