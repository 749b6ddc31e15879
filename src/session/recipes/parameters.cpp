// SPDX-License-Identifier: Apache-2.0
#include "session/recipes/parameters.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace sonar {

std::string label_of(std::string_view name, std::string_view unit) {
  constexpr std::array<std::string_view, 14> kSuffixes{"_px",    "_db", "_m",  "_deg",     "_s",   "_mps", "_mps2",
                                                       "_pings", "_hz", "_gb", "_percent", "_nmi", "_cm",  "_g"};
  if (!unit.empty()) {
    for (const std::string_view suffix : kSuffixes) {
      if (!name.ends_with(suffix)) continue;
      name.remove_suffix(suffix.size());
      break;
    }
  }
  constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kProper{
      {{"ek500", "EK500"}, {"edsu", "EDSU"}, {"auto", "Automatic"}, {"cpu", "Processor"}, {"gl", "OpenGL"}}};
  for (const auto& [written, spoken] : kProper) {
    if (name == written) return std::string(spoken);
  }
  std::string label(name);
  std::replace(label.begin(), label.end(), '_', ' ');
  if (!label.empty()) label[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(label[0])));
  return label;
}

}  // namespace sonar
