// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/time.h"
#include "base/work.h"

namespace sonar {

// Echoview's text formats read back, as version 7 of regions and 3 of lines have them: UTF-8 with or without byte order mark,
// lines ended by CR LF or LF. Every field is checked, and memory grows with the text, never with a number that it states: a
// file has at most kMostEchoviewBytes and 4 million lines of up to 8 MB, which no real one reaches.

/// What is to be read of a file, bytes.
inline constexpr std::uint64_t kMostEchoviewBytes = 256U << 20U;

/// A corner of a region.
struct EchoviewCorner {
  TimeNs time = 0;
  double depth_m = 0.0;  ///< or range; -9999.99 and 9999.99 = without bound
};

enum class EchoviewType : std::uint8_t { bad_no_data, analysis, marker, fish_track, bad_empty_water };

/// A region: a closed polygon over time and depth.
struct EchoviewRegion {
  std::int64_t line = 0;  ///< of its first figures in the file, from 1
  EchoviewType type = EchoviewType::analysis;
  std::string name;
  std::string region_class;
  std::int64_t first_note_line = 0;
  std::vector<std::string> notes;
  std::vector<EchoviewCorner> corners;
};

/// file    for messages
/// work    null = is never stopped
/// errors  format: line and what was expected there; unsupported: another version of the format; cancelled
[[nodiscard]] Result<std::vector<EchoviewRegion>> parse_evr(std::string_view text, const std::string& file,
                                                            const Work* work = nullptr);

/// Depths between two sides of a polygon.
struct DepthSpan {
  double first_m = 0.0;
  double last_m = 0.0;
};
/// Where a region lies at a time: its first and last time belong to it; inside and outside change at each side.
[[nodiscard]] std::vector<DepthSpan> depths_at(std::span<const EchoviewCorner> corners, TimeNs time);

/// What notes say of the cells of a region that this program exported, or a human of the beams that it is in.
struct EchoviewCells {
  /// Neighbouring samples of a beam of the fan, all from 0.
  struct InBeam {
    int beam = 0;
    int first_sample = 0;
    int count = 0;
    [[nodiscard]] int end() const { return first_sample + count; }
  };
  struct InPing {
    TimeNs time = 0;  ///< of the ping, rounded down to 0.1 ms
    std::vector<InBeam> runs;
  };
  struct Beams {
    int first = 0;
    int last = 0;
  };
  std::optional<int> fan;
  std::optional<Beams> beams;
  std::vector<InPing> pings;  ///< rising time; empty = all cells of the polygon
  std::string words;          ///< the other notes as one line
};
/// Notes "fan 3", "beams 3 8" and "cells 20261121 1957265000 BEAM FIRST COUNT BEAM FIRST COUNT ..." of a ping, as evr_text()
/// writes them.
/// work    null = is never stopped
/// errors  format: a line that begins so and does not go on so; cancelled
[[nodiscard]] Result<EchoviewCells> cells_of(const EchoviewRegion& region, const std::string& file,
                                             const Work* work = nullptr);

enum class EchoviewStatus : std::uint8_t { none, unverified, bad, good };

struct EchoviewLinePoint {
  TimeNs time = 0;
  double depth_m = 0.0;
  EchoviewStatus status = EchoviewStatus::none;
  /// Whether there is a depth at all.
  [[nodiscard]] bool known() const;
};

/// A line, in time order.
/// errors  as parse_evr(); format, too, where time goes back
[[nodiscard]] Result<std::vector<EchoviewLinePoint>> parse_evl(std::string_view text, const std::string& file);

}  // namespace sonar
