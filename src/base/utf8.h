// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace sonar {

/// A text from data as files of text, XML and HTML may hold it: UTF-8 in which each byte that belongs to no character, each
/// control character other than tab and line feed, and U+FFFE and U+FFFF have become U+FFFD.
/// source  Unicode 15, 3.9 (table 3-7); Extensible Markup Language 1.0, production 2
[[nodiscard]] std::string clean_utf8(std::string_view text);

}  // namespace sonar
