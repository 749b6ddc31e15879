// SPDX-License-Identifier: Apache-2.0
#include "session/pictures/picture_file.h"

#include <algorithm>
#include <string_view>

#include "session/recipes/parameters.h"

namespace sonar {

namespace {

/// What a movie of a kind of picture can do with a parameter: the menu tells what it is of, a volume alone has a camera that
/// moves, and what shows no samples has nothing between two pings.
bool of_movie(std::string_view parameter, PictureKind kind) {
  const bool samples = kind != PictureKind::propagation && kind != PictureKind::observation_map;
  if (parameter == "movie.of") return false;
  if (parameter == "movie.between") return samples;
  const bool camera = parameter == "movie.motion" || parameter.starts_with("movie.turn");
  return !camera || kind == PictureKind::volume;
}

}  // namespace

std::vector<std::string> asked_for(PictureKind kind, bool movie) {
  const std::string name(picture_kinds()[static_cast<std::size_t>(kind)].name);
  PropertyLister lister;
  PictureFileParams params;
  describe(lister, params);
  std::vector<std::string> asked;
  for (const Property& one : lister.take()) {
    if (one.name.starts_with("movie.")) {
      if (movie && of_movie(one.name, kind)) asked.push_back(one.name);
      continue;
    }
    const bool of_kind = one.name.starts_with(name + ".");
    // A report is as large as its paper.
    const bool of_many = one.name.find('.') == std::string::npos && kind != PictureKind::report;
    const std::vector<std::string> suited = kinds_suited(one.suits);
    if (of_many && std::find(suited.begin(), suited.end(), name) == suited.end()) continue;
    if (of_kind || of_many) asked.push_back(one.name);
  }
  return asked;
}

}  // namespace sonar
