// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "model/school.h"

namespace sonar {

// Rows of the tables of echo integration (docs/interfaces.md tells each column). NaN = unknown.

/// One elementary distance sampling unit (EDSU), or one stretch off effort: a row of effort.csv.
struct EffortRow {
  std::string stratum;
  std::string transect;
  std::string type;       ///< of EffortType
  std::int64_t edsu = 0;  ///< 1.. along the transect; 0 off effort
  TimeNs first_time_utc = 0;
  TimeNs last_time_utc = 0;
  double latitude = kUnknown;
  double longitude = kUnknown;
  double from_nmi = kUnknown;
  double distance_nmi = 0.0;
  std::int64_t n_pings = 0;
  std::int64_t n_pings_used = 0;
  double n_schools = kUnknown;  ///< a whole number
  double volume_m3 = kUnknown;
  double filled_fraction = kUnknown;
  double snr_db = kUnknown;
  double nasc_m2_nmi2 = kUnknown;
  double nasc_se_m2_nmi2 = kUnknown;
  double nasc_school_m2_nmi2 = kUnknown;
  double nasc_school_se_m2_nmi2 = kUnknown;
  double nasc_rest_m2_nmi2 = kUnknown;
  double nasc_layer_m2_nmi2 = kUnknown;       ///< only of one layer
  std::int64_t n_pings_without_position = 0;  ///< whose way is reckoned
  // Only where the recipe corrects for extinction.
  double nasc_extinction_m2_nmi2 = kUnknown;  ///< of nasc_m2_nmi2, what schools had taken and was given back
  double nasc_extinction_low_m2_nmi2 = kUnknown;
  double nasc_extinction_high_m2_nmi2 = kUnknown;
};

/// One range bin and depth channel of an EDSU: a row of nasc.csv.
struct NascRow {
  std::string stratum;
  std::string transect;
  std::int64_t edsu = 0;
  double range_from_m = kUnknown;
  double range_to_m = kUnknown;
  double depth_from_m = kUnknown;
  double depth_to_m = kUnknown;
  double volume_m3 = kUnknown;
  double valid_fraction = kUnknown;
  double height_m = kUnknown;
  double filled_fraction = kUnknown;
  double beam_filling = kUnknown;
  double snr_db = kUnknown;
  double noise_sv_db = kUnknown;
  double sv_limit_db = kUnknown;
  double sv_mean_db = kUnknown;
  double sv_se_db = kUnknown;
  double sv_school_db = kUnknown;
  double sv_rest_db = kUnknown;
  double sv_layer_db = kUnknown;
  double sa_m2_m2 = kUnknown;
  double nasc_m2_nmi2 = kUnknown;
  double nasc_se_m2_nmi2 = kUnknown;
  double nasc_school_m2_nmi2 = kUnknown;
  double nasc_school_se_m2_nmi2 = kUnknown;
  double nasc_rest_m2_nmi2 = kUnknown;
  double nasc_layer_m2_nmi2 = kUnknown;
  // As in EffortRow.
  double nasc_extinction_m2_nmi2 = kUnknown;
  double nasc_extinction_low_m2_nmi2 = kUnknown;
  double nasc_extinction_high_m2_nmi2 = kUnknown;
};

/// A transect, a stratum or the survey: a row of strata.csv.
struct StratumRow {
  std::string level;  ///< transect, stratum or survey
  std::string stratum;
  std::string transect;
  std::int64_t n_transects = 0;
  std::int64_t n_edsu = 0;
  double distance_nmi = 0.0;
  double nasc_m2_nmi2 = kUnknown;
  double nasc_se_m2_nmi2 = kUnknown;
  double nasc_school_m2_nmi2 = kUnknown;
  double nasc_school_se_m2_nmi2 = kUnknown;
  double nasc_layer_m2_nmi2 = kUnknown;  ///< only of one layer
  double nasc_layer_se_m2_nmi2 = kUnknown;
  // As in EffortRow.
  double nasc_extinction_m2_nmi2 = kUnknown;
  double nasc_extinction_low_m2_nmi2 = kUnknown;
  double nasc_extinction_high_m2_nmi2 = kUnknown;
};

template <class Visitor>
void columns(Visitor& v, EffortRow& r) {
  v("stratum", "", r.stratum);
  v("transect", "", r.transect);
  v("type", "", r.type);
  v("edsu", "1", r.edsu);
  v("first_time_utc", "", TimeColumn{r.first_time_utc});
  v("last_time_utc", "", TimeColumn{r.last_time_utc});
  v("latitude", "degrees_north", DegreesColumn{r.latitude});
  v("longitude", "degrees_east", DegreesColumn{r.longitude});
  v("from_nmi", "nautical_mile", r.from_nmi);
  v("distance_nmi", "nautical_mile", r.distance_nmi);
  v("n_pings", "1", r.n_pings);
  v("n_pings_used", "1", r.n_pings_used);
  v("n_schools", "1", r.n_schools);
  v("volume_m3", "m3", r.volume_m3);
  v("filled_fraction", "1", r.filled_fraction);
  v("snr_db", "dB", r.snr_db);
  v("nasc_m2_nmi2", "m2 nmi-2", r.nasc_m2_nmi2);
  v("nasc_se_m2_nmi2", "m2 nmi-2", r.nasc_se_m2_nmi2);
  v("nasc_school_m2_nmi2", "m2 nmi-2", r.nasc_school_m2_nmi2);
  v("nasc_school_se_m2_nmi2", "m2 nmi-2", r.nasc_school_se_m2_nmi2);
  v("nasc_rest_m2_nmi2", "m2 nmi-2", r.nasc_rest_m2_nmi2);
  v("nasc_layer_m2_nmi2", "m2 nmi-2", r.nasc_layer_m2_nmi2);
  v("n_pings_without_position", "1", r.n_pings_without_position);
  // Extinction.
  v("nasc_extinction_m2_nmi2", "m2 nmi-2", r.nasc_extinction_m2_nmi2);
  v("nasc_extinction_low_m2_nmi2", "m2 nmi-2", r.nasc_extinction_low_m2_nmi2);
  v("nasc_extinction_high_m2_nmi2", "m2 nmi-2", r.nasc_extinction_high_m2_nmi2);
}

template <class Visitor>
void columns(Visitor& v, NascRow& r) {
  v("stratum", "", r.stratum);
  v("transect", "", r.transect);
  v("edsu", "1", r.edsu);
  v("range_from_m", "m", r.range_from_m);
  v("range_to_m", "m", r.range_to_m);
  v("depth_from_m", "m", r.depth_from_m);
  v("depth_to_m", "m", r.depth_to_m);
  v("volume_m3", "m3", r.volume_m3);
  v("valid_fraction", "1", r.valid_fraction);
  v("height_m", "m", r.height_m);
  v("filled_fraction", "1", r.filled_fraction);
  v("beam_filling", "1", r.beam_filling);
  v("snr_db", "dB", r.snr_db);
  v("noise_sv_db", "dB re 1 m-1", r.noise_sv_db);
  v("sv_limit_db", "dB re 1 m-1", r.sv_limit_db);
  v("sv_mean_db", "dB re 1 m-1", r.sv_mean_db);
  v("sv_se_db", "dB", r.sv_se_db);
  v("sv_school_db", "dB re 1 m-1", r.sv_school_db);
  v("sv_rest_db", "dB re 1 m-1", r.sv_rest_db);
  v("sv_layer_db", "dB re 1 m-1", r.sv_layer_db);
  v("sa_m2_m2", "m2 m-2", r.sa_m2_m2);
  v("nasc_m2_nmi2", "m2 nmi-2", r.nasc_m2_nmi2);
  v("nasc_se_m2_nmi2", "m2 nmi-2", r.nasc_se_m2_nmi2);
  v("nasc_school_m2_nmi2", "m2 nmi-2", r.nasc_school_m2_nmi2);
  v("nasc_school_se_m2_nmi2", "m2 nmi-2", r.nasc_school_se_m2_nmi2);
  v("nasc_rest_m2_nmi2", "m2 nmi-2", r.nasc_rest_m2_nmi2);
  v("nasc_layer_m2_nmi2", "m2 nmi-2", r.nasc_layer_m2_nmi2);
  // Extinction.
  v("nasc_extinction_m2_nmi2", "m2 nmi-2", r.nasc_extinction_m2_nmi2);
  v("nasc_extinction_low_m2_nmi2", "m2 nmi-2", r.nasc_extinction_low_m2_nmi2);
  v("nasc_extinction_high_m2_nmi2", "m2 nmi-2", r.nasc_extinction_high_m2_nmi2);
}

template <class Visitor>
void columns(Visitor& v, StratumRow& r) {
  v("level", "", r.level);
  v("stratum", "", r.stratum);
  v("transect", "", r.transect);
  v("n_transects", "1", r.n_transects);
  v("n_edsu", "1", r.n_edsu);
  v("distance_nmi", "nautical_mile", r.distance_nmi);
  v("nasc_m2_nmi2", "m2 nmi-2", r.nasc_m2_nmi2);
  v("nasc_se_m2_nmi2", "m2 nmi-2", r.nasc_se_m2_nmi2);
  v("nasc_school_m2_nmi2", "m2 nmi-2", r.nasc_school_m2_nmi2);
  v("nasc_school_se_m2_nmi2", "m2 nmi-2", r.nasc_school_se_m2_nmi2);
  v("nasc_layer_m2_nmi2", "m2 nmi-2", r.nasc_layer_m2_nmi2);
  v("nasc_layer_se_m2_nmi2", "m2 nmi-2", r.nasc_layer_se_m2_nmi2);
  // Extinction.
  v("nasc_extinction_m2_nmi2", "m2 nmi-2", r.nasc_extinction_m2_nmi2);
  v("nasc_extinction_low_m2_nmi2", "m2 nmi-2", r.nasc_extinction_low_m2_nmi2);
  v("nasc_extinction_high_m2_nmi2", "m2 nmi-2", r.nasc_extinction_high_m2_nmi2);
}

}  // namespace sonar
