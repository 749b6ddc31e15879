// SPDX-License-Identifier: Apache-2.0
#include "session/picture_file.h"

#include <algorithm>

#include "session/parameters.h"

namespace sonar {

std::vector<std::string> asked_for(PictureKind kind, bool movie) {
  const std::string name(picture_kinds()[static_cast<std::size_t>(kind)].name);
  PropertyLister lister;
  PictureFileParams params;
  describe(lister, params);
  std::vector<std::string> asked;
  for (const Property& one : lister.take()) {
    const bool of_kind = one.name.starts_with(name + ".");
    const bool of_many = one.name.find('.') == std::string::npos;
    const std::vector<std::string> suited = kinds_suited(one.suits);
    if (of_many && std::find(suited.begin(), suited.end(), name) == suited.end()) continue;
    if (of_kind || (of_many && (movie || one.name != "frame_s"))) asked.push_back(one.name);
  }
  return asked;
}

}  // namespace sonar
