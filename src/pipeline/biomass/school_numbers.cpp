// SPDX-License-Identifier: Apache-2.0
#include "pipeline/biomass/school_numbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "base/units.h"
#include "model/school_totals.h"
#include "school/strength/mean_strength.h"

namespace sonar {
namespace {

constexpr double kGramsPerTonne = 1e6;

/// Index of the product, and school_id or ping_index there.
using InProduct = std::pair<std::size_t, std::int64_t>;

/// The chosen relation, then the others, for one sonar; empty where the product tells no frequency.
std::vector<MeanStrength> strengths_of(const ObservationProduct& product, const FishChoice& fish) {
  std::vector<MeanStrength> strengths;
  if (!product.grid || product.grid->grid.frequency_hz.empty() || !(product.grid->sound_speed_mps > 0.0)) {
    return strengths;
  }
  const FrequencyBand band = frequencies_of({&product, 1});
  const double middle_hz = 500.0 * (band.from_khz + band.to_khz);
  const double wave_number = 2.0 * std::numbers::pi * middle_hz / product.grid->sound_speed_mps;
  strengths.emplace_back(fish.chosen, fish.lengths, wave_number);
  for (const TsRelation& choice : fish.choices) strengths.emplace_back(choice, fish.lengths, wave_number);
  return strengths;
}

BeamToSchool look_of(const ObservationProduct& product, const SchoolPingRow& row, double course_deg) {
  const PingNavigation& ping = product.pings[static_cast<std::size_t>(row.ping_index)];
  const double sine = (ping.transducer_depth_m - row.depth_m) / row.range_m;
  return {row.bearing_deg, deg_from_rad(std::asin(std::clamp(sine, -1.0, 1.0))), course_deg};
}

/// Which way a school swims: through the water where that is known, for so its fish head, else over ground.
struct Course {
  double deg = kUnknown;
  double se_deg = kUnknown;
};
Course course_of(const SchoolRow& school) {
  if (std::isfinite(school.course_water_deg)) return {school.course_water_deg, school.course_water_se_deg};
  return {school.course_deg, school.course_se_deg};
}

/// Courses over what a school's may be with 95 %, and of an unknown one from end on to broadside. Courses are told where the
/// speed is two of its errors or more, so that one without a stated error is known to 45 degrees.
std::array<double, 4> doubted_courses(const Course& course, double bearing_deg) {
  if (std::isnan(course.deg)) return {bearing_deg, bearing_deg + 30.0, bearing_deg + 60.0, bearing_deg + 90.0};
  const double off = std::isfinite(course.se_deg) ? std::min(1.96 * course.se_deg, 90.0) : 45.0;
  return {course.deg - off, course.deg - off / 2.0, course.deg + off / 2.0, course.deg + off};
}

/// What the rows of one school have in one ping together.
struct InPing {
  double echo_m2 = 0.0;
  double variance_m4 = 0.0;
  std::vector<double> sigma_m2;  ///< mean over the rows: chosen, choices, chosen at each doubted course
  int rows = 0;
  bool known = true;
  bool touches_edge = false;
  std::vector<std::size_t> at;  ///< its rows in NumberedSchool::pings
};

/// Sums over the pings that are used.
struct Sums {
  double echo_m2 = 0.0;
  double variance_m4 = 0.0;   ///< of the pings that tell it
  double echo_told_m2 = 0.0;  ///< ... and their echo
  std::vector<double> sigma_m2;
  double depth_m = 0.0;
  double aspect_deg = 0.0;
  int rows = 0;
  int rows_with_aspect = 0;
};

class SchoolCounter {
 public:
  SchoolCounter(std::span<const ObservationProduct> products, const FishChoice& fish)
      : products_(products), fish_(fish) {
    for (std::size_t i = 0; i < products.size(); ++i) {
      strengths_.push_back(strengths_of(products[i], fish));
      product_of_[products[i].observation] = i;
      for (const SchoolPingRow& row : products[i].school_pings) rows_[{i, row.school_id}].push_back(&row);
    }
  }

  [[nodiscard]] NumberedSchool count(const CountedSchool& school) const {
    const SchoolRow& first = *school.rows.front();
    NumberedSchool out;
    out.row.observation = first.observation;
    out.row.school_id = first.school_id;
    out.row.survey_school = first.survey_school;
    out.row.species = first.species;
    out.row.backscatter_m2 = school.backscatter_m2;
    out.middle_utc = middle_ping_time(first);
    out.counted = fish_.species.empty() || first.species == fish_.species;
    if (!out.counted) return out;
    out.row.ts_preset = fish_.chosen.name;
    out.row.course_deg = course_of(first).deg;
    std::map<InProduct, InPing> pings;
    for (const SchoolRow* row : school.rows) take_row(*row, pings, out);
    const Sums sums = sum_of(pings, out);
    put_numbers(school, sums, out);
    return out;
  }

 private:
  /// A ping's own time: between two pings there may be the end of a transect or of an EDSU.
  [[nodiscard]] TimeNs middle_ping_time(const SchoolRow& school) const {
    const auto rows = rows_.find({product_of_.at(school.observation), school.school_id});
    return rows == rows_.end() ? school.first_time_utc : rows->second[rows->second.size() / 2]->time_utc;
  }

  void take_row(const SchoolRow& school, std::map<InProduct, InPing>& pings, NumberedSchool& out) const {
    const std::size_t product = product_of_.at(school.observation);
    const auto rows = rows_.find({product, school.school_id});
    if (rows == rows_.end() || strengths_[product].empty()) return;
    for (const SchoolPingRow* row : rows->second) {
      const BeamToSchool look = look_of(products_[product], *row, course_of(school).deg);
      InPing& ping = pings[{product, row->ping_index}];
      const std::vector<double> sigma = sigmas_of(school, *row, look, strengths_[product]);
      ping.sigma_m2.resize(sigma.size());
      for (std::size_t i = 0; i < sigma.size(); ++i) {
        ping.sigma_m2[i] = (ping.sigma_m2[i] * ping.rows + sigma[i]) / (ping.rows + 1);
      }
      ++ping.rows;
      ping.echo_m2 += echo_m2(*row);
      ping.variance_m4 += row->backscatter_total_se_m2 * row->backscatter_total_se_m2;
      ping.known = ping.known && std::isfinite(echo_m2(*row)) &&
                   std::all_of(sigma.begin(), sigma.end(), [](double m2) { return std::isfinite(m2); });
      ping.touches_edge = ping.touches_edge || row->touches_edge != 0;
      ping.at.push_back(out.pings.size());
      out.pings.push_back(ping_row(*row, look, strengths_[product].front()));
    }
  }

  static std::vector<double> sigmas_of(const SchoolRow& school, const SchoolPingRow& row, const BeamToSchool& look,
                                       const std::vector<MeanStrength>& strengths) {
    std::vector<double> sigma;
    for (const MeanStrength& strength : strengths) sigma.push_back(strength.sigma_bs_m2(row.depth_m, look));
    for (const double course_deg : doubted_courses(course_of(school), row.bearing_deg)) {
      BeamToSchool doubted = look;
      doubted.course_deg = course_deg;
      sigma.push_back(strengths.front().sigma_bs_m2(row.depth_m, doubted));
    }
    return sigma;
  }

  static BiomassPingRow ping_row(const SchoolPingRow& row, const BeamToSchool& look, const MeanStrength& strength) {
    BiomassPingRow out;
    out.observation = row.observation;
    out.school_id = row.school_id;
    out.ping_index = row.ping_index;
    out.time_utc = row.time_utc;
    out.range_m = row.range_m;
    out.depth_m = row.depth_m;
    out.aspect_deg = aspect_deg(look);
    out.sv_mean_db = row.sv_mean_db;
    out.backscatter_m2 = echo_m2(row);
    const double sigma = strength.sigma_bs_m2(row.depth_m, look);
    out.ts_mean_db = db_from_linear(sigma);
    out.numbers = out.backscatter_m2 / sigma;
    return out;
  }

  /// Over pings in which the school touches no edge, where there are any.
  static Sums sum_of(const std::map<InProduct, InPing>& pings, NumberedSchool& out) {
    const bool whole =
        std::any_of(pings.begin(), pings.end(), [](const auto& p) { return p.second.known && !p.second.touches_edge; });
    Sums sums;
    for (const auto& [key, ping] : pings) {
      if (!ping.known || (whole && ping.touches_edge)) continue;
      ++out.row.n_pings;
      if (!ping.touches_edge) ++out.row.n_pings_whole;
      sums.echo_m2 += ping.echo_m2;
      if (std::isfinite(ping.variance_m4)) {
        sums.variance_m4 += ping.variance_m4;
        sums.echo_told_m2 += ping.echo_m2;
      }
      sums.sigma_m2.resize(ping.sigma_m2.size());
      for (std::size_t i = 0; i < ping.sigma_m2.size(); ++i) sums.sigma_m2[i] += ping.sigma_m2[i];
      for (const std::size_t at : ping.at) {
        BiomassPingRow& row = out.pings[at];
        row.used = 1;
        sums.depth_m += row.depth_m;
        ++sums.rows;
        if (!std::isfinite(row.aspect_deg)) continue;
        sums.aspect_deg += row.aspect_deg;
        ++sums.rows_with_aspect;
      }
    }
    return sums;
  }

  void put_numbers(const CountedSchool& school, const Sums& sums, NumberedSchool& out) const {
    BiomassRow& row = out.row;
    if (row.n_pings == 0 || !(sums.echo_m2 > 0.0)) return;
    const auto pings = static_cast<double>(row.n_pings);
    row.depth_m = sums.depth_m / sums.rows;
    if (sums.rows_with_aspect > 0) row.aspect_deg = sums.aspect_deg / sums.rows_with_aspect;
    const auto [least, most] = std::minmax_element(sums.sigma_m2.begin(), sums.sigma_m2.end());
    row.ts_mean_db = db_from_linear(sums.sigma_m2.front() / pings);
    row.ts_strongest_db = db_from_linear(*most / pings);
    row.ts_weakest_db = db_from_linear(*least / pings);
    row.ts_span_db = row.ts_strongest_db - row.ts_weakest_db;
    const double numbers = sums.echo_m2 / sums.sigma_m2.front();
    out.strongest = sums.echo_m2 / *most;
    out.weakest = sums.echo_m2 / *least;
    const auto courses = sums.sigma_m2.begin() + 1 + std::ssize(fish_.choices);
    for (auto sigma = sums.sigma_m2.begin() + 1; sigma != courses; ++sigma) {
      out.by_choice.push_back(sums.echo_m2 / *sigma);
    }
    const auto [faint, loud] = std::minmax_element(courses, sums.sigma_m2.end());
    out.fewest_by_course = std::min(numbers, sums.echo_m2 / *loud);
    out.most_by_course = std::max(numbers, sums.echo_m2 / *faint);
    if (sums.echo_told_m2 > 0.0) out.errors.own = std::sqrt(sums.variance_m4) / sums.echo_told_m2;
    out.errors.calibration = relative_of_db(school.rows.front()->backscatter_calibration_se_db);
    const SamplingErrors of_lengths = sampling_errors(fish_.lengths, fish_.chosen, fish_.weight);
    out.errors.lengths = of_lengths.numbers;
    put(banded(numbers, out.strongest, out.weakest, out.errors.together()), row);
    const double tonnes = mean_weight_g(fish_.lengths, fish_.weight) / kGramsPerTonne;
    NumberErrors of_biomass = out.errors;
    of_biomass.lengths = of_lengths.biomass;
    put_biomass(banded(numbers * tonnes, out.strongest * tonnes, out.weakest * tonnes, of_biomass.together()), row);
    if (school.rows.size() == 1) row.fish_per_m3 = numbers / school.rows.front()->volume_corrected_m3;
    row.band = contents(out.errors);
  }

  static void put(const Banded& numbers, BiomassRow& row) {
    row.numbers = numbers.value;
    row.numbers_se = numbers.se;
    row.numbers_low = numbers.low;
    row.numbers_high = numbers.high;
  }
  static void put_biomass(const Banded& biomass, BiomassRow& row) {
    row.biomass_t = biomass.value;
    row.biomass_se_t = biomass.se;
    row.biomass_low_t = biomass.low;
    row.biomass_high_t = biomass.high;
  }

  [[nodiscard]] std::string contents(const NumberErrors& errors) const {
    std::string text;
    const auto add = [&text](bool there, const char* word) {
      if (there) text += (text.empty() ? "" : " ") + std::string(word);
    };
    add(std::isfinite(errors.own), "fading");
    add(std::isfinite(errors.calibration), "calibration");
    add(std::isfinite(errors.lengths), "lengths");
    add(fish_.chosen.directivity.known(), "aspect");
    add(fish_.choices.size() > 1, "ts");
    return text;
  }

  std::span<const ObservationProduct> products_;
  const FishChoice& fish_;
  std::vector<std::vector<MeanStrength>> strengths_;  ///< [product][relation]
  std::map<std::string, std::size_t> product_of_;
  std::map<InProduct, std::vector<const SchoolPingRow*>> rows_;
};

}  // namespace

FrequencyBand frequencies_of(std::span<const ObservationProduct> products) {
  FrequencyBand band;
  for (const ObservationProduct& product : products) {
    if (!product.grid) continue;
    for (const double hz : product.grid->grid.frequency_hz) {
      band.from_khz = band.to_khz > 0.0 ? std::min(band.from_khz, hz / 1000.0) : hz / 1000.0;
      band.to_khz = std::max(band.to_khz, hz / 1000.0);
    }
  }
  return band;
}

std::vector<NumberedSchool> school_numbers(std::span<const ObservationProduct> products, const FishChoice& fish) {
  const SchoolCounter counter(products, fish);
  std::vector<NumberedSchool> out;
  for (const CountedSchool& school : counted_schools(products)) out.push_back(counter.count(school));
  return out;
}

}  // namespace sonar
