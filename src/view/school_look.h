// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "model/school_totals.h"
#include "view/maps/survey_map.h"
#include "view/volume/volume_scene.h"

namespace sonar {

/// Status as a colour, the same in every picture: accepted, corrected, unreviewed, rejected.
[[nodiscard]] Rgba8 status_colour(const std::string& status, const Theme& theme);
/// Status as a line, the same in every picture: accepted and corrected solid, unreviewed dashed, rejected dotted.
[[nodiscard]] OutlineLine status_line(const std::string& status);
/// Lengths of dash and gap, pixels; empty = solid.
[[nodiscard]] std::vector<double> line_dashes(OutlineLine line, const Theme& theme);
[[nodiscard]] std::vector<double> status_dashes(const std::string& status, const Theme& theme);

/// Colours and sizes of a map's schools. Rows are those of the observations, which outlive it.
class SchoolLook {
 public:
  SchoolLook(std::span<const ObservationProduct> observations, const SurveyMapStyle& style, const Theme& theme);
  [[nodiscard]] Rgba8 colour(const SchoolRow& school) const;
  [[nodiscard]] bool shown(const SchoolRow& school) const;
  /// The school that counts the row; null where it is rejected.
  [[nodiscard]] const CountedSchool* school_of(const SchoolRow& row) const;
  /// What a row's circle stands for: the whole school's backscatter in the first of its rows, nothing in the others.
  [[nodiscard]] double backscatter_m2(const SchoolRow& row) const;
  /// Radius of a circle whose area is proportional to backscatter, within sensible bounds.
  [[nodiscard]] double radius_px(double backscatter_m2) const;
  /// How many schools there are, as totals count them.
  [[nodiscard]] std::size_t schools() const { return schools_.size(); }
  /// Entries of the legend: colour and name; empty for mean Sv, which has a colour bar.
  [[nodiscard]] const std::vector<std::pair<Rgba8, std::string>>& entries() const { return entries_; }
  /// Backscatters for the legend's circles, rising; at most three.
  [[nodiscard]] std::vector<double> sizes() const;
  /// Of the colour bar.
  [[nodiscard]] const ColourMap& map() const { return map_; }

 private:
  SurveyMapStyle style_;
  const Theme& theme_;
  ColourMap map_;
  std::vector<std::pair<Rgba8, std::string>> entries_;
  std::vector<std::string> species_;
  std::vector<CountedSchool> schools_;
  std::unordered_map<const SchoolRow*, std::size_t> school_of_row_;
  double largest_m2_ = 0.0;
};

}  // namespace sonar
