// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the fuzz target of the user's preferences does; the plain tests replay its corpus through the same function.

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "base/check.h"
#include "session/preferences.h"

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

}  // namespace sonar::fuzz
