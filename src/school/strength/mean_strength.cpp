// SPDX-License-Identifier: Apache-2.0
#include "school/strength/mean_strength.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/units.h"

namespace sonar {
namespace {

constexpr int kCosines = 2049;
constexpr int kHeadings = 360;  ///< of fish that head anywhere

/// Standard deviations from the mean, and their weights: a normal distribution at equal steps.
struct Normal {
  static constexpr int kParts = 55;  ///< a narrow echo of a long fish falls off within 6 degrees
  std::array<double, kParts> at{};
  std::array<double, kParts> weight{};
};

Normal normal_parts() {
  Normal parts;
  double sum = 0.0;
  for (std::size_t i = 0; i < parts.at.size(); ++i) {
    parts.at[i] = -4.0 + 8.0 * static_cast<double>(i) / (Normal::kParts - 1);
    parts.weight[i] = std::exp(-0.5 * parts.at[i] * parts.at[i]);
    sum += parts.weight[i];
  }
  for (double& weight : parts.weight) weight /= sum;
  return parts;
}

double line_echo(double x) {
  if (std::abs(x) < 1e-6) return 1.0;
  const double amplitude = std::sin(x) / x;
  return amplitude * amplitude;
}

/// Of a level school: cosine between its course and the beam.
double cosine_to_course(double relative_rad, double elevation_rad) {
  return std::cos(relative_rad) * std::cos(elevation_rad);
}

}  // namespace

double aspect_deg(const BeamToSchool& look) {
  const double cosine =
      cosine_to_course(rad_from_deg(look.bearing_deg - look.course_deg), rad_from_deg(look.elevation_deg));
  return deg_from_rad(std::acos(std::min(std::abs(cosine), 1.0)));
}

MeanStrength::MeanStrength(const TsRelation& relation, const FishLengths& lengths, double wave_number)
    : relation_(relation) {
  for (const LengthClass& of : lengths.classes) {
    at_surface_m2_ += of.share * relation.sigma_bs_m2(of.length_cm, 0.0);
  }
  const FishDirectivity& fish = relation.directivity;
  if (!fish.known()) return;
  table_.resize(kCosines);
  for (std::size_t i = 0; i < table_.size(); ++i) {
    const double cosine = static_cast<double>(i) / (kCosines - 1);
    for (const LengthClass& of : lengths.classes) {
      const double line = line_echo(wave_number * fish.line_share * 0.01 * of.length_cm * cosine);
      table_[i] += of.share * relation.sigma_bs_m2(of.length_cm, 0.0) *
                   (fish.any_aspect_share + (1.0 - fish.any_aspect_share) * line);
    }
  }
}

double MeanStrength::along(double cosine) const {
  const double at = std::min(std::abs(cosine), 1.0) * (kCosines - 1);
  const auto i = std::min(static_cast<std::size_t>(at), static_cast<std::size_t>(kCosines - 2));
  const double share = at - static_cast<double>(i);
  return table_[i] * (1.0 - share) + table_[i + 1] * share;
}

double MeanStrength::over_headings(double relative_rad, double elevation_rad) const {
  static const Normal kNormal = normal_parts();
  const bool anywhere = std::isnan(relative_rad);
  const double heading_sd = rad_from_deg(relation_.directivity.heading_sd_deg);
  const double tilt_sd = rad_from_deg(relation_.directivity.tilt_sd_deg);
  double sum = 0.0;
  for (int h = 0; h < (anywhere ? kHeadings : Normal::kParts); ++h) {
    const auto part = static_cast<std::size_t>(h);
    const double off = anywhere ? 2.0 * std::numbers::pi * h / kHeadings : relative_rad + heading_sd * kNormal.at[part];
    const double weight = anywhere ? 1.0 / kHeadings : kNormal.weight[part];
    for (std::size_t t = 0; t < kNormal.at.size(); ++t) {
      const double tilt = tilt_sd * kNormal.at[t];
      const double cosine =
          std::cos(tilt) * cosine_to_course(off, elevation_rad) + std::sin(tilt) * std::sin(elevation_rad);
      sum += weight * kNormal.weight[t] * along(cosine);
    }
  }
  return sum;
}

double MeanStrength::sigma_bs_m2(double depth_m, const BeamToSchool& look) const {
  // Unknown stays unknown where it counts.
  const double of_depth =
      relation_.d_db == 0.0 ? 1.0 : linear_from_db(relation_.d_db * std::log10(1.0 + std::max(depth_m, 0.0) / 10.0));
  if (table_.empty()) return at_surface_m2_ * of_depth;
  const double elevation = std::isnan(look.elevation_deg) ? 0.0 : rad_from_deg(look.elevation_deg);
  return over_headings(rad_from_deg(look.bearing_deg - look.course_deg), elevation) * of_depth;
}

}  // namespace sonar
