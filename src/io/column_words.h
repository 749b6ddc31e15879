// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace sonar {

/// What a column or variable is, in the words that readers of netCDF and users of a GIS see.
struct ColumnWords {
  std::string_view name;
  std::string_view long_name;
  std::string_view standard_name = {};  ///< of the CF table; empty = there is none
  std::string_view meanings = {};       ///< of flags, apart by blanks; empty = no flags
  bool bits = false;                    ///< flags are 1, 2, 4, ..., several at once; otherwise 0, 1, 2, ...

  [[nodiscard]] std::vector<std::int64_t> flags() const;
};
/// Null where nothing is known of a name: a test holds every column of every table against that.
[[nodiscard]] const ColumnWords* words_of(std::string_view name);

}  // namespace sonar
