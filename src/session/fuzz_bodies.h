// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the fuzz targets of this room's parsers do; the plain tests replay the corpora through the same functions.

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "base/check.h"
#include "session/marks/bookmarked_view.h"
#include "session/words/preferences.h"

namespace sonar::fuzz {

/// Whatever stands in the file, what is loaded can be saved, and is the same when it is loaded and saved again.
/// folder  to write into
inline void preferences(std::string_view text, const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "preferences.json";
  const auto saved = [&] {
    const LoadedPreferences loaded = Preferences::load(file);
    SONAR_CHECK(loaded.preferences.recent.size() <= Preferences::kMostRecent);
    SONAR_CHECK(loaded.preferences.species.size() <= Preferences::kMostSpecies);
    std::filesystem::remove(file);
    Preferences same = loaded.preferences;
    same.path = file;
    SONAR_CHECK(same.save().has_value());
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  std::ofstream(file, std::ios::binary | std::ios::trunc).write(text.data(), static_cast<std::streamsize>(text.size()));
  const std::string once = saved();
  SONAR_CHECK(saved() == once);
}

/// A bookmark that is taken is the same when it is written and read again.
inline void bookmark(std::string_view text) {
  const auto view = bookmarked_view(std::string(text));
  if (!view) return;
  const std::string written = text_of(*view);
  const auto again = bookmarked_view(written);
  SONAR_CHECK(again.has_value() && text_of(*again) == written);
}

}  // namespace sonar::fuzz
