// SPDX-License-Identifier: Apache-2.0
#include "model/index_cache.h"

#include <cstdlib>

namespace sonar {

IndexCache IndexCache::of_user() {
  // NOLINTBEGIN(concurrency-mt-unsafe): nobody sets it
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache == '/') {
    return {std::filesystem::path(cache) / "sonar-explorer"};
  }
  if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/') {
    return {std::filesystem::path(home) / ".cache" / "sonar-explorer"};
  }
  // NOLINTEND(concurrency-mt-unsafe)
  return {};
}

}  // namespace sonar
