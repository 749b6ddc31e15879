// SPDX-License-Identifier: Apache-2.0
#include "view/school_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace sonar {
namespace {

constexpr std::array<const char*, 4> kStatuses{"accepted", "corrected", "unreviewed", "rejected"};
constexpr const char* kNoSpecies = "no species given";

}  // namespace

Rgba8 status_colour(const std::string& status, const Theme& theme) {
  if (status == "accepted") return school_colour(2);
  if (status == "corrected") return school_colour(1);
  if (status == "rejected") return theme.muted;
  return school_colour(0);
}

OutlineLine status_line(const std::string& status) {
  if (status == "rejected") return OutlineLine::dotted;
  return status == "unreviewed" ? OutlineLine::dashed : OutlineLine::solid;
}

std::vector<double> line_dashes(OutlineLine line, const Theme& theme) {
  const double em = theme.text_px;
  if (line == OutlineLine::dotted) return {0.15 * em, 0.35 * em};
  if (line == OutlineLine::dashed) return {0.7 * em, 0.3 * em};
  return {};
}

std::vector<double> status_dashes(const std::string& status, const Theme& theme) {
  return line_dashes(status_line(status), theme);
}

SchoolLook::SchoolLook(std::span<const ObservationProduct> observations, const SurveyMapStyle& style,
                       const Theme& theme)
    : style_(style), theme_(theme), map_(colour_map(ColourMapName::thermal)), schools_(counted_schools(observations)) {
  for (std::size_t i = 0; i < schools_.size(); ++i) {
    for (const SchoolRow* row : schools_[i].rows) school_of_row_[row] = i;
    largest_m2_ = std::fmax(largest_m2_, schools_[i].backscatter_m2);
  }
  std::array<bool, kStatuses.size()> seen{};
  for (const ObservationProduct& product : observations) {
    for (const SchoolRow& school : product.schools) {
      if (!shown(school)) continue;
      species_.push_back(school.species);
      for (std::size_t i = 0; i < kStatuses.size(); ++i) seen[i] = seen[i] || school.status == kStatuses[i];
    }
  }
  std::sort(species_.begin(), species_.end());
  species_.erase(std::unique(species_.begin(), species_.end()), species_.end());
  if (style.colouring == SchoolColouring::status) {
    for (std::size_t i = 0; i < kStatuses.size(); ++i) {
      if (seen[i]) entries_.emplace_back(status_colour(kStatuses[i], theme), kStatuses[i]);
    }
  } else if (style.colouring == SchoolColouring::species) {
    for (const std::string& name : species_) {
      SchoolRow row;
      row.species = name;
      entries_.emplace_back(colour(row), name.empty() ? kNoSpecies : name);
    }
  }
}

bool SchoolLook::shown(const SchoolRow& school) const { return style_.rejected || school.status != "rejected"; }

Rgba8 SchoolLook::colour(const SchoolRow& school) const {
  switch (style_.colouring) {
    case SchoolColouring::status:
      return status_colour(school.status, theme_);
    case SchoolColouring::species: {
      if (school.species.empty()) return theme_.muted;
      const auto at = std::lower_bound(species_.begin(), species_.end(), school.species) - species_.begin();
      return school_colour(static_cast<int>(at));
    }
    case SchoolColouring::mean_sv:
      break;
  }
  if (!std::isfinite(school.sv_mean_db)) return theme_.muted;
  const double t = (school.sv_mean_db - style_.sv_low_db) / std::max(1e-9, style_.sv_high_db - style_.sv_low_db);
  return map_.at(t);
}

const CountedSchool* SchoolLook::school_of(const SchoolRow& row) const {
  const auto found = school_of_row_.find(&row);
  return found == school_of_row_.end() ? nullptr : &schools_[found->second];
}

double SchoolLook::backscatter_m2(const SchoolRow& row) const {
  const CountedSchool* school = school_of(row);
  if (school == nullptr) return echo_m2(row);
  return school->rows.front() == &row ? school->backscatter_m2 : 0.0;
}

double SchoolLook::radius_px(double backscatter_m2) const {
  const double least = 0.28 * theme_.text_px;
  const double most = 1.1 * theme_.text_px;
  if (!(backscatter_m2 > 0.0) || !(largest_m2_ > 0.0)) return least;
  return std::max(least, most * std::sqrt(std::min(1.0, backscatter_m2 / largest_m2_)));
}

std::vector<double> SchoolLook::sizes() const {
  std::vector<double> out;
  if (!(largest_m2_ > 0.0)) return out;
  const double power = std::pow(10.0, std::floor(std::log10(largest_m2_)));
  const double lead = largest_m2_ / power;
  const double top = (lead >= 5.0 ? 5.0 : lead >= 2.0 ? 2.0 : 1.0) * power;
  for (const double v : {top / 10.0, top / 3.0, top}) {
    const double digit = std::pow(10.0, std::floor(std::log10(v)));
    out.push_back(std::round(v / digit) * digit);
  }
  return out;
}

}  // namespace sonar
