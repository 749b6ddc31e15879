// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "model/biomass.h"
#include "pipeline/biomass/band_causes.h"
#include "pipeline/biomass/biomass_strata.h"
#include "pipeline/biomass/school_numbers.h"

namespace sonar {

struct BiomassOptions {
  std::filesystem::path out;       ///< work folder of a run
  std::filesystem::path lengths;   ///< CSV
  std::filesystem::path ts_table;  ///< CSV; empty = the relations that come with the program
  std::string ts;                  ///< name of a relation
  std::filesystem::path areas;     ///< CSV; empty = none
  std::string species;             ///< empty = all schools
  WeightLength weight;
};

struct Biomass {
  FishChoice fish;
  FrequencyBand sonar;
  std::vector<BiomassRow> schools;
  std::vector<BiomassPingRow> pings;
  std::vector<BiomassStratumRow> strata;
  bool integrated = false;                ///< OUT holds tables of echo integration
  std::int64_t without_numbers = 0;       ///< schools whose backscatter is unknown
  std::int64_t cut = 0;                   ///< schools that touch an edge in every ping
  std::int64_t without_course = 0;        ///< schools of which no aspect is known
  BandCauses causes;                      ///< of the numbers of all schools that were seen
  std::vector<BandCauses> school_causes;  ///< of each of `schools`
};

/// Numbers and biomass of the schools of products and of strata.
/// products  as school_numbers() wants them
/// errors    mismatch: no school of the species
[[nodiscard]] Result<Biomass> biomass_of(std::span<const ObservationProduct> products, FishChoice fish,
                                         const StrataInput& strata);

/// biomass.csv, biomass_pings.csv and biomass_strata.csv into a folder that is there.
/// errors  io, no_space
[[nodiscard]] Result<void> write_biomass(const Biomass& biomass, const std::filesystem::path& folder);

/// Areas are told of strata that there are.
/// errors  mismatch, naming the stratum
[[nodiscard]] Result<void> require_strata(const std::map<std::string, double>& areas,
                                          std::span<const StratumRow> strata, const std::filesystem::path& areas_file);

/// Numbers and biomass of the schools of a run, and with effort.csv and strata.csv in OUT of its strata. Writes biomass.csv,
/// biomass_pings.csv and biomass_strata.csv there. Raw files are not needed.
/// errors  not_found: no products, no such relation; format; mismatch: no school of the species, or areas of a stratum that
///         there is not; io, no_space, cancelled
/// memory  masks of one observation at a time
[[nodiscard]] Result<Biomass> biomass_folder(const BiomassOptions& options, Work& work);

}  // namespace sonar
