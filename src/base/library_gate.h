// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <shared_mutex>

namespace sonar {

/// A child process made by fork() keeps every lock that another thread held at that moment, for ever. The C library
/// takes care of its own; libraries with locks of their own (GDAL, PROJ, SQLite) do not.
/// Held round calls into such a library; any number of threads at a time, none of them twice.
[[nodiscard]] std::shared_lock<std::shared_mutex> inside_library();

/// Waits until no thread is inside such a library and keeps others out: held by who forks, while it forks.
[[nodiscard]] std::unique_lock<std::shared_mutex> libraries_at_rest();

}  // namespace sonar
