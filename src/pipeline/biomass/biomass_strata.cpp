// SPDX-License-Identifier: Apache-2.0
#include "pipeline/biomass/biomass_strata.h"

#include <cmath>
#include <numbers>
#include <optional>

#include "base/units.h"

namespace sonar {
namespace {

constexpr double kGramsPerTonne = 1e6;

/// Numbers of several schools or strata together, and what doubt each adds. One that is unknown among them makes them so.
struct Together {
  double value = 0.0;
  double strongest = 0.0;
  double weakest = 0.0;
  double own_variance = 0.0;  ///< of `value`, of errors that are independent
  double calibration = 0.0;   ///< error of `value` by it, one for all

  void add(double of, double least, double most, const NumberErrors& errors) {
    value += of;
    strongest += least;
    weakest += most;
    own_variance += of * of * errors.own * errors.own;
    calibration += of > 0.0 ? of * errors.calibration : 0.0;
  }
  void add(const Together& other, double times) {
    value += times * other.value;
    strongest += times * other.strongest;
    weakest += times * other.weakest;
    own_variance += times * times * other.own_variance;
    calibration += times * other.calibration;
  }
  /// lengths  relative error by them
  [[nodiscard]] NumberErrors errors(double lengths) const {
    if (!(value > 0.0)) return {};
    return {std::sqrt(own_variance) / value, calibration / value, lengths};
  }
  [[nodiscard]] Banded band(double per_fish, double lengths) const {
    return banded(value * per_fish, strongest * per_fish, weakest * per_fish, errors(lengths).together());
  }
};

/// One stratum's schools.
struct SchoolsOf {
  std::int64_t n = 0;
  Together seen;
  double all_m2 = 0.0;      ///< echo, of any species
  double counted_m2 = 0.0;  ///< ... of those counted
  double known_m2 = 0.0;    ///< ... of those of them whose numbers are known

  void add(const NumberedSchool& school) {
    const double echo_m2 = std::isfinite(school.row.backscatter_m2) ? school.row.backscatter_m2 : 0.0;
    all_m2 += echo_m2;
    if (!school.counted) return;
    ++n;
    counted_m2 += echo_m2;
    if (!std::isfinite(school.row.numbers)) return;
    known_m2 += echo_m2;
    seen.add(school.row.numbers, school.strongest, school.weakest, school.errors);
  }
};

constexpr TimeNs kTextTime_ns = 1'000'000;  ///< tables cut times to whole milliseconds

/// A school's stratum; empty where it lies in no transect.
std::optional<std::string> stratum_of(const NumberedSchool& school, std::span<const EffortRow> effort) {
  for (const EffortRow& unit : effort) {
    if (unit.edsu == 0) continue;
    if (unit.first_time_utc <= school.middle_utc && school.middle_utc < unit.last_time_utc + kTextTime_ns) {
      return unit.stratum;
    }
  }
  return std::nullopt;
}

double sailed_nmi(std::span<const StratumRow> strata) {
  double sum = 0.0;
  for (const StratumRow& row : strata) sum += row.level == "stratum" ? row.distance_nmi : 0.0;
  return sum;
}

class StrataMaker {
 public:
  StrataMaker(const FishChoice& fish, const StrataInput& input)
      : input_(input),
        distance_nmi_(sailed_nmi(input.strata)),
        tonnes_(mean_weight_g(fish.lengths, fish.weight) / kGramsPerTonne),
        lengths_(sampling_errors(fish.lengths, fish.chosen, fish.weight)) {}

  [[nodiscard]] BiomassStratumRow stratum(const StratumRow& of, const SchoolsOf& schools) {
    BiomassStratumRow row = seen("stratum", of.stratum, schools);
    row.n_transects = of.n_transects;
    row.distance_nmi = of.distance_nmi;
    const double counted_share = schools.all_m2 > 0.0 ? schools.counted_m2 / schools.all_m2 : 1.0;
    row.nasc_school_m2_nmi2 = of.nasc_school_m2_nmi2 * counted_share;
    nasc_ += row.nasc_school_m2_nmi2 * of.distance_nmi / distance_nmi_;
    const Together density = density_of(row.nasc_school_m2_nmi2, of, schools);
    put_density(density, row);
    mean_.add(density, of.distance_nmi / distance_nmi_);
    const auto area = input_.areas.find(of.stratum);
    row.area_nmi2 = area == input_.areas.end() ? kUnknown : area->second;
    Together whole;
    whole.add(density, row.area_nmi2);
    put_whole(whole, row);
    whole_.add(density, row.area_nmi2);
    area_nmi2_ += row.area_nmi2;
    return row;
  }

  /// After all strata.
  [[nodiscard]] BiomassStratumRow survey(const StratumRow* of, const SchoolsOf& schools) const {
    BiomassStratumRow row = seen("survey", "", schools);
    if (of == nullptr) return row;
    row.n_transects = of->n_transects;
    row.distance_nmi = of->distance_nmi;
    row.nasc_school_m2_nmi2 = nasc_;
    put_density(mean_, row);
    row.area_nmi2 = area_nmi2_;
    put_whole(whole_, row);
    return row;
  }

 private:
  [[nodiscard]] BiomassStratumRow seen(const char* level, const std::string& stratum, const SchoolsOf& schools) const {
    BiomassStratumRow row;
    row.level = level;
    row.stratum = stratum;
    row.n_schools = schools.n;
    if (schools.n > 0 && !(schools.known_m2 > 0.0)) return row;
    if (schools.n > 0) row.ts_mean_db = db_from_linear(schools.known_m2 / schools.seen.value);
    const Banded numbers = schools.seen.band(1.0, lengths_.numbers);
    row.numbers_seen = numbers.value;
    row.numbers_seen_low = numbers.low;
    row.numbers_seen_high = numbers.high;
    const Banded biomass = schools.seen.band(tonnes_, lengths_.biomass);
    row.biomass_seen_t = biomass.value;
    row.biomass_seen_low_t = biomass.low;
    row.biomass_seen_high_t = biomass.high;
    return row;
  }

  /// Fish per nmi2; none where there are no schools, unknown where NASC tells of some and nobody knows of which fish.
  static Together density_of(double nasc, const StratumRow& of, const SchoolsOf& schools) {
    Together density;
    if (!(schools.counted_m2 > 0.0)) {
      density.add(schools.n == 0 && nasc == 0.0 ? 0.0 : kUnknown, 0.0, 0.0, {.own = 0.0});
      return density;
    }
    const double per_nmi2 = nasc / (4.0 * std::numbers::pi) * schools.seen.value / schools.known_m2;
    NumberErrors errors = schools.seen.errors(kUnknown);
    errors.own = of.nasc_school_se_m2_nmi2 / of.nasc_school_m2_nmi2;
    density.add(per_nmi2, per_nmi2 * schools.seen.strongest / schools.seen.value,
                per_nmi2 * schools.seen.weakest / schools.seen.value, errors);
    return density;
  }

  /// What differs between transects is most of the doubt: without it there is no band.
  static Banded known_band(const Together& of, double per_fish, double lengths) {
    Banded band = of.band(per_fish, lengths);
    if (std::isnan(of.own_variance)) band.se = band.low = band.high = kUnknown;
    return band;
  }
  void put_density(const Together& of, BiomassStratumRow& row) const {
    const Banded numbers = known_band(of, 1.0, lengths_.numbers);
    row.numbers_per_nmi2 = numbers.value;
    row.numbers_per_nmi2_se = numbers.se;
    row.numbers_per_nmi2_low = numbers.low;
    row.numbers_per_nmi2_high = numbers.high;
    const Banded biomass = known_band(of, tonnes_, lengths_.biomass);
    row.biomass_t_per_nmi2 = biomass.value;
    row.biomass_t_per_nmi2_se = biomass.se;
    row.biomass_t_per_nmi2_low = biomass.low;
    row.biomass_t_per_nmi2_high = biomass.high;
  }
  void put_whole(const Together& of, BiomassStratumRow& row) const {
    const Banded numbers = known_band(of, 1.0, lengths_.numbers);
    row.numbers = numbers.value;
    row.numbers_low = numbers.low;
    row.numbers_high = numbers.high;
    const Banded biomass = known_band(of, tonnes_, lengths_.biomass);
    row.biomass_t = biomass.value;
    row.biomass_low_t = biomass.low;
    row.biomass_high_t = biomass.high;
  }

  const StrataInput& input_;
  double distance_nmi_;  ///< of all strata
  double tonnes_;        ///< of a fish
  SamplingErrors lengths_;
  double nasc_ = 0.0;  ///< of schools, m2 nmi-2, over strata, weighted by their distances
  Together mean_;      ///< fish per nmi2 over strata, weighted by their distances
  Together whole_;     ///< fish in all areas
  double area_nmi2_ = 0.0;
};

}  // namespace

std::vector<BiomassStratumRow> biomass_strata(std::span<const NumberedSchool> schools, const FishChoice& fish,
                                              const StrataInput& input) {
  std::map<std::string, SchoolsOf> of_stratum;
  SchoolsOf all;
  for (const NumberedSchool& school : schools) {
    all.add(school);
    if (const auto stratum = stratum_of(school, input.effort)) of_stratum[*stratum].add(school);
  }
  StrataMaker maker(fish, input);
  std::vector<BiomassStratumRow> rows;
  const StratumRow* survey = nullptr;
  for (const StratumRow& row : input.strata) {
    if (row.level == "stratum") rows.push_back(maker.stratum(row, of_stratum[row.stratum]));
    if (row.level == "survey") survey = &row;
  }
  rows.push_back(maker.survey(survey, all));
  return rows;
}

}  // namespace sonar
