// SPDX-License-Identifier: Apache-2.0
#include "io/echoview_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "base/number_text.h"
#include "base/utf8.h"

namespace sonar {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr double kWithoutBound_m = 9999.0;
constexpr double kMostDepth_m = 1e5;

using Words = std::vector<std::string_view>;

// Such a line holds a region over 70 000 pings, or 700 000 runs of cells in one ping; so many lines are a ping a second for 46
// days. Of letters alone a line takes 8 times its bytes as words, an empty note 32 bytes.
constexpr std::size_t kMostLineBytes = 8U << 20U;
constexpr std::int64_t kMostLines = 4'000'000;

bool stopped(const Work* work) { return work != nullptr && work->cancelled(); }
tl::unexpected<Error> stop() { return fail(ErrorCode::cancelled, "stopped on request"); }

Words words_of(std::string_view line) {
  Words words;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t begin = line.find_first_not_of(" \t", at);
    if (begin == std::string_view::npos) break;
    at = std::min(line.find_first_of(" \t", begin), line.size());
    words.push_back(line.substr(begin, at - begin));
  }
  return words;
}

template <class Number>
std::optional<Number> number_of(std::string_view word) {
  Number number{};
  const auto [after, problem] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (problem != std::errc{} || after != word.data() + word.size()) return std::nullopt;
  return number;
}

std::optional<int> index_of(std::string_view word) {
  const auto number = number_of<int>(word);
  return number && *number >= 0 ? number : std::nullopt;
}

bool all_digits(std::string_view word, std::size_t count) {
  return word.size() == count && std::ranges::all_of(word, [](char c) { return c >= '0' && c <= '9'; });
}

/// CCYYMMDD and HHmmSSssss, the last in 0.1 ms; from 1970 on, so that differences fit into 64 bits.
std::optional<TimeNs> time_of(std::string_view date, std::string_view clock) {
  if (!all_digits(date, 8) || !all_digits(clock, 10)) return std::nullopt;
  const auto time =
      time_from_iso(fmt::format("{}-{}-{}T{}:{}:{}.{}Z", date.substr(0, 4), date.substr(4, 2), date.substr(6, 2),
                                clock.substr(0, 2), clock.substr(2, 2), clock.substr(4, 2), clock.substr(6, 4)));
  return time && *time >= 0 ? time : std::nullopt;
}

std::optional<double> depth_of(std::string_view word) {
  const auto depth = number_of<double>(word);
  return depth && std::abs(*depth) <= kMostDepth_m ? depth : std::nullopt;  // NaN is no depth either
}

/// The lines of a file, one after the other.
class Lines {
 public:
  Lines(std::string_view text, const std::string& file, const Work* work = nullptr)
      : text_(text), file_(file), work_(work) {
    if (text_.starts_with(kByteOrderMark)) text_.remove_prefix(kByteOrderMark.size());
  }

  [[nodiscard]] std::int64_t number() const { return number_; }  ///< of the line that next() gave last
  [[nodiscard]] bool at_end() const { return text_.empty(); }

  /// errors  format: the file ends where something was expected, or is longer than any; cancelled
  Result<std::string_view> next(std::string_view expected) {
    if (stopped(work_)) return stop();
    ++number_;
    if (at_end()) return problem(fmt::format("the file ends; expected {}", expected));
    if (number_ > kMostLines) return problem(fmt::format("expected the end, after at most {} lines", kMostLines));
    std::string_view line = line_here();
    if (line.size() > kMostLineBytes) {
      return problem(fmt::format("{} bytes; expected {}, in at most {}", line.size(), expected, kMostLineBytes));
    }
    pass(line);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  /// Passes over lines with nothing in them.
  void skip_empty() {
    while (!at_end() && number_ < kMostLines) {
      const std::string_view line = line_here();
      if (line.size() > kMostLineBytes || line.find_first_not_of(" \t\r") != std::string_view::npos) return;
      pass(line);
      ++number_;
    }
  }

  [[nodiscard]] tl::unexpected<Error> problem(const std::string& text) const { return problem_at(number_, text); }
  [[nodiscard]] tl::unexpected<Error> problem_at(std::int64_t line, const std::string& text) const {
    return fail(ErrorCode::format, fmt::format("line {}: {}", line, text), {file_});
  }

  /// A line with nothing but a count.
  Result<std::int64_t> count(std::string_view of) {
    const std::string expected = fmt::format("the number of {}", of);
    const auto line = next(expected);
    if (!line) return pass_on(line);
    const Words words = words_of(*line);
    const auto number = words.size() == 1 ? number_of<std::int64_t>(words[0]) : std::nullopt;
    if (!number || *number < 0) return problem("expected " + expected);
    return *number;
  }

  /// So many lines, each as it stands.
  template <class Take>
  Result<void> counted_lines(std::string_view of, const Take& take) {
    const auto count_ = count(of);
    if (!count_) return pass_on(count_);
    for (std::int64_t i = 0; i < *count_; ++i) {
      const auto line = next(fmt::format("{} of {}", i + 1, of));
      if (!line) return pass_on(line);
      take(*line);
    }
    return {};
  }

  /// "EVRG 7 10.0.0.0": what the file is, and the version of its format.
  Result<void> head(std::string_view name, std::string_view version) {
    const std::string expected = fmt::format("{} {} and a version of Echoview", name, version);
    const auto line = next(expected);
    if (!line) return pass_on(line);
    const Words words = words_of(*line);
    if (words.empty() || words[0] != name) return problem("expected " + expected);
    if (words.size() >= 2 && words[1] != version) {
      return fail(ErrorCode::unsupported,
                  fmt::format("line 1: {} {}; expected version {}", name, printable(std::string(words[1])), version),
                  {file_});
    }
    if (words.size() != 3) return problem("expected " + expected);
    return {};
  }

 private:
  [[nodiscard]] std::string_view line_here() const { return text_.substr(0, text_.find('\n')); }
  void pass(std::string_view line) { text_.remove_prefix(std::min(line.size() + 1, text_.size())); }

  std::string_view text_;
  const std::string& file_;
  const Work* work_;
  std::int64_t number_ = 0;
};

/// "13 POINTS ID SELECTED CREATION -1 BOX [DATE TIME TOP DATE TIME BOTTOM]"; the box follows from the points.
Result<std::int64_t> points_of_head(const Lines& lines, std::string_view line) {
  constexpr std::size_t kWithoutBox = 7;
  constexpr std::size_t kWithBox = 13;
  const Words words = words_of(line);
  const bool box = words.size() == kWithBox;
  if (words.size() != kWithoutBox && !box) {
    return lines.problem(fmt::format("expected the {} or {} figures that a region begins with", kWithoutBox, kWithBox));
  }
  if (words[0] != "13") return lines.problem("expected 13, the structure of a region of this version");
  const auto points = number_of<std::int64_t>(words[1]);
  if (!points || *points < 1) return lines.problem("expected the number of points of a region, 1 or more");
  if (words[6] != (box ? "1" : "0")) return lines.problem("expected 1 and a bounding box, or 0 and none");
  for (std::size_t i = 2; i < kWithoutBox - 1; ++i) {
    if (!number_of<std::int64_t>(words[i]))
      return lines.problem(fmt::format("expected a whole number as figure {}", i + 1));
  }
  if (!box) return *points;
  for (const std::size_t at : {std::size_t{7}, std::size_t{10}}) {
    if (!time_of(words[at], words[at + 1]) || !depth_of(words[at + 2])) {
      return lines.problem("expected a bounding box: CCYYMMDD HHmmSSssss and a depth in m, twice");
    }
  }
  return *points;
}

/// All corners in one line, which ends with the digit of the type.
Result<void> read_corners(Lines& lines, std::int64_t count, EchoviewRegion& region) {
  const auto line = lines.next("the points of a region");
  if (!line) return pass_on(line);
  const Words words = words_of(*line);
  if (words.size() % 3 != 1 || static_cast<std::int64_t>(words.size() / 3) != count) {
    return lines.problem(fmt::format("expected {} (date, time, depth) and the type of the region",
                                     count_of(static_cast<std::size_t>(count), "point")));
  }
  for (std::size_t i = 0; i + 1 < words.size(); i += 3) {
    const auto time = time_of(words[i], words[i + 1]);
    const auto depth = depth_of(words[i + 2]);
    if (!time || !depth) {
      return lines.problem(fmt::format("point {}: expected CCYYMMDD HHmmSSssss and a depth in m", i / 3 + 1));
    }
    region.corners.push_back({*time, *depth});
  }
  const auto type = index_of(words.back());
  if (!type || *type > static_cast<int>(EchoviewType::bad_empty_water)) {
    return lines.problem("expected a type of region from 0 to 4 at the end");
  }
  region.type = static_cast<EchoviewType>(*type);
  return {};
}

Result<EchoviewRegion> read_region(Lines& lines) {
  const auto first = lines.next("a region");
  if (!first) return pass_on(first);
  EchoviewRegion region;
  region.line = lines.number();
  const auto points = points_of_head(lines, *first);
  if (!points) return pass_on(points);
  const auto keep = [&](std::string_view note) { region.notes.push_back(clean_utf8(note)); };
  if (auto notes = lines.counted_lines("lines of notes", keep); !notes) return pass_on(notes);
  region.first_note_line = region.line + 2;
  const auto pass = [](std::string_view) {};
  if (auto settings = lines.counted_lines("lines of detection settings", pass); !settings) return pass_on(settings);
  const auto region_class = lines.next("the class of a region");
  if (!region_class) return pass_on(region_class);
  region.region_class = clean_utf8(*region_class);
  if (auto read = read_corners(lines, *points, region); !read) return pass_on(read);
  const auto name = lines.next("the name of a region");
  if (!name) return pass_on(name);
  region.name = clean_utf8(*name);
  return region;
}

}  // namespace

Result<std::vector<EchoviewRegion>> parse_evr(std::string_view text, const std::string& file, const Work* work) {
  Lines lines(text, file, work);
  if (auto head = lines.head("EVRG", "7"); !head) return pass_on(head);
  const auto count = lines.count("regions");
  if (!count) return pass_on(count);
  std::vector<EchoviewRegion> regions;
  for (std::int64_t i = 0; i < *count; ++i) {
    lines.skip_empty();
    auto region = read_region(lines);
    if (!region) return pass_on(region);
    regions.push_back(std::move(*region));
  }
  lines.skip_empty();
  if (lines.at_end()) return regions;
  return lines.problem_at(lines.number() + 1, fmt::format("expected the end after {}",
                                                          count_of(static_cast<std::size_t>(*count), "region")));
}

std::vector<DepthSpan> depths_at(std::span<const EchoviewCorner> corners, TimeNs time) {
  if (corners.empty()) return {};
  const auto [first, last] = std::ranges::minmax(corners, {}, &EchoviewCorner::time);
  if (time < first.time || time > last.time) return {};
  if (first.time == last.time) {
    const auto [top, bottom] = std::ranges::minmax(corners, {}, &EchoviewCorner::depth_m);
    return {{top.depth_m, bottom.depth_m}};
  }
  // A side holds its first time and not its last, so that a corner is counted once; at the region's end the other way round.
  const bool at_end = time == last.time;
  std::vector<double> crossed;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto [from, to] =
        std::minmax(corners[i], corners[(i + 1) % corners.size()],
                    [](const EchoviewCorner& a, const EchoviewCorner& b) { return a.time < b.time; });
    const bool here = at_end ? from.time < time && time <= to.time : from.time <= time && time < to.time;
    if (!here) continue;
    const double part = static_cast<double>(time - from.time) / static_cast<double>(to.time - from.time);
    crossed.push_back(from.depth_m + part * (to.depth_m - from.depth_m));
  }
  std::ranges::sort(crossed);
  std::vector<DepthSpan> spans;
  for (std::size_t i = 0; i + 1 < crossed.size(); i += 2) spans.push_back({crossed[i], crossed[i + 1]});
  return spans;
}

namespace {

std::optional<EchoviewCells::InPing> cells_in_ping(const Words& words) {
  const auto time = words.size() >= 6 ? time_of(words[1], words[2]) : std::nullopt;
  if (!time || words.size() % 3 != 0) return std::nullopt;
  EchoviewCells::InPing ping{*time, {}};
  for (std::size_t i = 3; i < words.size(); i += 3) {
    const auto beam = index_of(words[i]);
    const auto first = index_of(words[i + 1]);
    const auto count = index_of(words[i + 2]);
    if (!beam || !first || !count || *count < 1 || *count > std::numeric_limits<int>::max() - *first)
      return std::nullopt;
    ping.runs.push_back({*beam, *first, *count});
  }
  return ping;
}

/// Whether the line was one of cells; or what was expected in it.
Result<bool> read_note(const Words& words, EchoviewCells& cells) {
  const auto wrong = [](const char* expected) { return fail(ErrorCode::format, expected); };
  const bool begins_with_number =
      words.size() >= 2 && words[1].find_first_not_of("0123456789") == std::string_view::npos;
  if (!begins_with_number) return false;
  if (words[0] == "fan") {
    cells.fan = index_of(words[1]);
    if (!cells.fan || words.size() != 2) return wrong("expected fan N, counted from 0");
  } else if (words[0] == "beams") {
    const auto first = index_of(words[1]);
    const auto last = words.size() == 3 ? index_of(words[2]) : std::nullopt;
    if (!first || !last || *last < *first) return wrong("expected beams A B with A <= B, counted from 0");
    cells.beams = {*first, *last};
  } else if (words[0] == "cells") {
    auto ping = cells_in_ping(words);
    if (!ping) return wrong("expected cells CCYYMMDD HHmmSSssss and BEAM FIRST COUNT of each run");
    const bool rising = cells.pings.empty() || cells.pings.back().time < ping->time;
    if (!rising) return wrong("expected cells of a later ping than the line before");
    cells.pings.push_back(std::move(*ping));
  } else {
    return false;
  }
  return true;
}

}  // namespace

Result<EchoviewCells> cells_of(const EchoviewRegion& region, const std::string& file, const Work* work) {
  EchoviewCells cells;
  for (std::size_t i = 0; i < region.notes.size(); ++i) {
    if (stopped(work)) return stop();
    const auto read = read_note(words_of(region.notes[i]), cells);
    if (!read) {
      const std::int64_t line = region.first_note_line + static_cast<std::int64_t>(i);
      return fail(ErrorCode::format, fmt::format("line {}: {}", line, read.error().text), {file});
    }
    if (*read || region.notes[i].empty()) continue;
    cells.words += (cells.words.empty() ? "" : "; ") + region.notes[i];
  }
  return cells;
}

bool EchoviewLinePoint::known() const { return status != EchoviewStatus::bad && std::abs(depth_m) < kWithoutBound_m; }

Result<std::vector<EchoviewLinePoint>> parse_evl(std::string_view text, const std::string& file) {
  Lines lines(text, file);
  if (auto head = lines.head("EVBD", "3"); !head) return pass_on(head);
  const auto count = lines.count("points");
  if (!count) return pass_on(count);
  std::vector<EchoviewLinePoint> points;
  for (std::int64_t i = 0; i < *count; ++i) {
    const auto line = lines.next(fmt::format("point {} of {}", i + 1, *count));
    if (!line) return pass_on(line);
    const Words words = words_of(*line);
    const bool whole = words.size() == 4;
    const auto time = whole ? time_of(words[0], words[1]) : std::nullopt;
    const auto depth = whole ? depth_of(words[2]) : std::nullopt;
    const auto status = whole ? index_of(words[3]) : std::nullopt;
    if (!time || !depth || !status || *status > static_cast<int>(EchoviewStatus::good)) {
      return lines.problem("expected CCYYMMDD HHmmSSssss, a depth in m and a status from 0 to 3");
    }
    if (!points.empty() && *time < points.back().time) {
      return lines.problem("expected a time that is not before that of the line above");
    }
    points.push_back({*time, *depth, static_cast<EchoviewStatus>(*status)});
  }
  lines.skip_empty();
  if (lines.at_end()) return points;
  return lines.problem_at(lines.number() + 1, fmt::format("expected the end after {}",
                                                          count_of(static_cast<std::size_t>(*count), "point")));
}

}  // namespace sonar
