// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "base/result.h"
#include "sonar_explorer/error.h"

// Outside, what cannot be done is an exception; inside, it is a Result.
namespace sonar_explorer {

[[noreturn]] inline void raise(const sonar::Error& error) {
  std::string kind(sonar::name(error.code));
  std::replace(kind.begin(), kind.end(), ' ', '_');
  if (error.code == sonar::ErrorCode::io) kind = "io";
  throw Error(sonar::to_line(error), std::move(kind));
}

template <class T>
T value_or_throw(sonar::Result<T> result) {
  if (!result) raise(result.error());
  return std::move(*result);
}
inline void value_or_throw(const sonar::Result<void>& result) {
  if (!result) raise(result.error());
}

/// Refuses a ping that is not there. They are counted from 0.
inline void require_ping(std::int64_t ping, std::size_t pings, const std::string& observation) {
  const auto count = static_cast<std::int64_t>(pings);
  if (ping >= 0 && ping < count) return;
  const std::string has = count == 0 ? "has no pings" : fmt::format("has pings 0 to {}", count - 1);
  raise({sonar::ErrorCode::usage, fmt::format("no ping {}: {} {}", ping, observation, has), {}});
}

/// Notes, a line each.
inline std::vector<std::string> lines_of(const sonar::Diagnostics& notes) {
  std::vector<std::string> lines;
  for (const sonar::Diagnostic& note : notes) {
    lines.push_back(std::string(sonar::name(note.code)) + ": " +
                    sonar::to_line({sonar::ErrorCode::format, note.text, {note.file, note.offset, note.ping_index}}));
  }
  return lines;
}

}  // namespace sonar_explorer
