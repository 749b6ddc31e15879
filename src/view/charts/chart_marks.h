// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "view/charts/chart.h"
#include "view/charts/chart_bins.h"
#include "view/key_rows.h"

namespace sonar {

/// More schools than these have no names in the key, and no colours of their own in bars.
inline constexpr std::size_t kNamedSchools = 10;

/// How the schools of a chart look, and what its key says of them.
class ChartLooks {
 public:
  ChartLooks(const ChartData& data, const ChartStyle& style, const Theme& theme);

  [[nodiscard]] bool selected(std::size_t row) const;
  /// Of a point or a line: its school's own; grey where it is rejected, faint where others are selected.
  [[nodiscard]] Rgba8 colour(std::size_t row) const;
  /// Parts that a bar is put together from, from below: the selected first, the rejected last.
  struct Part {
    Rgba8 fill;
    Rgba8 stroke;
  };
  [[nodiscard]] const std::vector<Part>& parts() const { return parts_; }
  [[nodiscard]] std::size_t part_of_row(std::size_t row) const { return part_of_row_[row]; }
  /// Schools by their names where they are few, else what their colours mean.
  [[nodiscard]] std::vector<KeyEntry> key() const;
  /// What colours mean, in one line.
  [[nodiscard]] std::vector<KeyEntry> short_key() const;

 private:
  struct School {
    ChartSchool name;
    bool rejected = false;
  };
  [[nodiscard]] Rgba8 own_colour(const School& school) const;
  [[nodiscard]] std::string name_of(const School& school) const;
  [[nodiscard]] KeyEntry entry(std::string text, Rgba8 colour, bool hollow) const;
  [[nodiscard]] bool any_rejected() const;
  void make_parts();

  const ChartData& data_;
  const ChartStyle& style_;
  const Theme& theme_;
  std::vector<School> schools_;
  std::vector<Part> parts_;
  std::vector<std::size_t> part_of_row_;
};

/// Whether a line goes from the row before to this one: one school, in two pings that follow one another, over an order.
[[nodiscard]] bool joins_previous(const ChartData& data, std::size_t row);
/// Points and the lines between them.
void add_points(FrameDescription& frame, const ChartPlaces& places, const ChartData& data, const ChartLooks& looks,
                const Theme& theme);
/// Bars, and where they lie.
void add_bars(FrameDescription& frame, ChartPlaces& places, const ChartData& data, const ChartBins& bins,
              const ChartLooks& looks, const Theme& theme);

}  // namespace sonar
