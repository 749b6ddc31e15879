// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace sonar {

/// Where indexes of raw files are kept between runs. Keyed by absolute path, size and time of change (ns). A broken,
/// stale or foreign entry is made again without a word; a folder that cannot be written to is no error.
struct IndexCache {
  std::filesystem::path folder;  ///< empty = keep nothing

  /// $XDG_CACHE_HOME/sonar-explorer, else $HOME/.cache/sonar-explorer, else none.
  [[nodiscard]] static IndexCache of_user();
};

}  // namespace sonar
