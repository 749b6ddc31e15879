// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "model/school.h"

namespace sonar {

// Rows of the tables of numbers and biomass (docs/interfaces.md tells each column). NaN = unknown.

/// One school: a row of biomass.csv.
struct BiomassRow {
  std::string observation;
  std::int64_t school_id = 0;
  std::int64_t survey_school = 0;
  std::string species;
  std::string ts_preset;
  std::int64_t n_pings = 0;
  std::int64_t n_pings_whole = 0;
  double depth_m = kUnknown;
  double course_deg = kUnknown;
  double aspect_deg = kUnknown;
  double backscatter_m2 = kUnknown;
  double ts_mean_db = kUnknown;
  double ts_strongest_db = kUnknown;
  double ts_weakest_db = kUnknown;
  double ts_span_db = kUnknown;
  double numbers = kUnknown;
  double numbers_se = kUnknown;
  double numbers_low = kUnknown;
  double numbers_high = kUnknown;
  double fish_per_m3 = kUnknown;
  double biomass_t = kUnknown;
  double biomass_se_t = kUnknown;
  double biomass_low_t = kUnknown;
  double biomass_high_t = kUnknown;
  std::string band;  ///< what is in it
};

template <class Visitor>
void columns(Visitor& v, BiomassRow& r) {
  v("observation", "", r.observation);
  v("school_id", "1", r.school_id);
  v("survey_school", "1", r.survey_school);
  v("species", "", r.species);
  v("ts_preset", "", r.ts_preset);
  v("n_pings", "1", r.n_pings);
  v("n_pings_whole", "1", r.n_pings_whole);
  v("depth_m", "m", r.depth_m);
  v("course_deg", "degrees", r.course_deg);
  v("aspect_deg", "degrees", r.aspect_deg);
  v("backscatter_m2", "m2", r.backscatter_m2);
  v("ts_mean_db", "dB re 1 m2", r.ts_mean_db);
  v("ts_strongest_db", "dB re 1 m2", r.ts_strongest_db);
  v("ts_weakest_db", "dB re 1 m2", r.ts_weakest_db);
  v("ts_span_db", "dB", r.ts_span_db);
  v("numbers", "1", r.numbers);
  v("numbers_se", "1", r.numbers_se);
  v("numbers_low", "1", r.numbers_low);
  v("numbers_high", "1", r.numbers_high);
  v("fish_per_m3", "m-3", r.fish_per_m3);
  v("biomass_t", "t", r.biomass_t);
  v("biomass_se_t", "t", r.biomass_se_t);
  v("biomass_low_t", "t", r.biomass_low_t);
  v("biomass_high_t", "t", r.biomass_high_t);
  v("band", "", r.band);
}

/// One row of a school in one ping: a row of biomass_pings.csv.
struct BiomassPingRow {
  std::string observation;
  std::int64_t school_id = 0;
  std::int64_t ping_index = 0;
  TimeNs time_utc = 0;
  std::int64_t used = 0;
  double range_m = kUnknown;
  double depth_m = kUnknown;
  double aspect_deg = kUnknown;
  double sv_mean_db = kUnknown;
  double backscatter_m2 = kUnknown;
  double ts_mean_db = kUnknown;
  double numbers = kUnknown;
};

template <class Visitor>
void columns(Visitor& v, BiomassPingRow& r) {
  v("observation", "", r.observation);
  v("school_id", "1", r.school_id);
  v("ping_index", "1", r.ping_index);
  v("time_utc", "", TimeColumn{r.time_utc});
  v("used", "1", r.used);
  v("range_m", "m", r.range_m);
  v("depth_m", "m", r.depth_m);
  v("aspect_deg", "degrees", r.aspect_deg);
  v("sv_mean_db", "dB re 1 m-1", r.sv_mean_db);
  v("backscatter_m2", "m2", r.backscatter_m2);
  v("ts_mean_db", "dB re 1 m2", r.ts_mean_db);
  v("numbers", "1", r.numbers);
}

/// A stratum, or the survey: a row of biomass_strata.csv.
struct BiomassStratumRow {
  std::string level;  ///< stratum or survey
  std::string stratum;
  std::int64_t n_transects = 0;
  double distance_nmi = kUnknown;
  std::int64_t n_schools = 0;
  double nasc_school_m2_nmi2 = kUnknown;
  double ts_mean_db = kUnknown;
  double numbers_seen = kUnknown;
  double numbers_seen_low = kUnknown;
  double numbers_seen_high = kUnknown;
  double biomass_seen_t = kUnknown;
  double biomass_seen_low_t = kUnknown;
  double biomass_seen_high_t = kUnknown;
  double numbers_per_nmi2 = kUnknown;
  double numbers_per_nmi2_se = kUnknown;
  double numbers_per_nmi2_low = kUnknown;
  double numbers_per_nmi2_high = kUnknown;
  double biomass_t_per_nmi2 = kUnknown;
  double biomass_t_per_nmi2_se = kUnknown;
  double biomass_t_per_nmi2_low = kUnknown;
  double biomass_t_per_nmi2_high = kUnknown;
  double area_nmi2 = kUnknown;
  double numbers = kUnknown;
  double numbers_low = kUnknown;
  double numbers_high = kUnknown;
  double biomass_t = kUnknown;
  double biomass_low_t = kUnknown;
  double biomass_high_t = kUnknown;
};

template <class Visitor>
void columns(Visitor& v, BiomassStratumRow& r) {
  v("level", "", r.level);
  v("stratum", "", r.stratum);
  v("n_transects", "1", r.n_transects);
  v("distance_nmi", "nautical_mile", r.distance_nmi);
  v("n_schools", "1", r.n_schools);
  v("nasc_school_m2_nmi2", "m2 nmi-2", r.nasc_school_m2_nmi2);
  v("ts_mean_db", "dB re 1 m2", r.ts_mean_db);
  v("numbers_seen", "1", r.numbers_seen);
  v("numbers_seen_low", "1", r.numbers_seen_low);
  v("numbers_seen_high", "1", r.numbers_seen_high);
  v("biomass_seen_t", "t", r.biomass_seen_t);
  v("biomass_seen_low_t", "t", r.biomass_seen_low_t);
  v("biomass_seen_high_t", "t", r.biomass_seen_high_t);
  v("numbers_per_nmi2", "nmi-2", r.numbers_per_nmi2);
  v("numbers_per_nmi2_se", "nmi-2", r.numbers_per_nmi2_se);
  v("numbers_per_nmi2_low", "nmi-2", r.numbers_per_nmi2_low);
  v("numbers_per_nmi2_high", "nmi-2", r.numbers_per_nmi2_high);
  v("biomass_t_per_nmi2", "t nmi-2", r.biomass_t_per_nmi2);
  v("biomass_t_per_nmi2_se", "t nmi-2", r.biomass_t_per_nmi2_se);
  v("biomass_t_per_nmi2_low", "t nmi-2", r.biomass_t_per_nmi2_low);
  v("biomass_t_per_nmi2_high", "t nmi-2", r.biomass_t_per_nmi2_high);
  v("area_nmi2", "nmi2", r.area_nmi2);
  v("numbers", "1", r.numbers);
  v("numbers_low", "1", r.numbers_low);
  v("numbers_high", "1", r.numbers_high);
  v("biomass_t", "t", r.biomass_t);
  v("biomass_low_t", "t", r.biomass_low_t);
  v("biomass_high_t", "t", r.biomass_high_t);
}

}  // namespace sonar
