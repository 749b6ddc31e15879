// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "publish/reports/report_facts.h"
#include "view/frame_description.h"
#include "view/theme.h"

namespace sonar {

// Parts of a report's page that are text and lines. Each is drawn into its place; words without room are shortened.

inline constexpr double kReportText_px = 8.5;  ///< 6.4 pt on paper
inline constexpr double kReportRow_px = 13.0;

/// How many schools a table of that height has rows for, its head apart.
[[nodiscard]] std::size_t report_rows(double height_px);
/// Whether any figure that the table shows has a standard error.
[[nodiscard]] bool has_errors(std::span<const ReportSchool> schools);
/// Figures with their standard errors behind them, where there are any. The first schools that have room; behind them how many there are beyond.
void add_report_table(FrameDescription& page, const PixelRect& place, std::span<const ReportSchool> schools,
                      const Theme& theme);
/// Names and values in two columns; the height that they take.
[[nodiscard]] double report_lines_height(std::size_t lines);
void add_report_lines(FrameDescription& page, const PixelRect& place,
                      std::span<const std::pair<std::string, std::string>> lines, const Theme& theme);
/// Numbers of schools by status and by species.
void add_report_counts(FrameDescription& page, const PixelRect& place, const ReportFacts& facts, const Theme& theme);
/// How many schools lie how deep: bars, depth downwards.
void add_report_depths(FrameDescription& page, const PixelRect& place, std::span<const ReportSchool> schools,
                       const Theme& theme);

}  // namespace sonar
