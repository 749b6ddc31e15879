// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/time.h"
#include "model/biomass.h"
#include "model/fish_lengths.h"
#include "model/product.h"
#include "model/ts_relation.h"
#include "school/strength/fish_numbers.h"

namespace sonar {

/// What the fish are taken to be.
struct FishChoice {
  TsRelation chosen;
  std::vector<TsRelation> choices;  ///< that could be meant as well; the chosen one may be among them
  FishLengths lengths;
  WeightLength weight;  ///< a unknown = no biomass
  std::string species;  ///< of the schools that are counted; empty = all
};

/// Frequencies of the fans of all products, kHz; 0 where none has a grid.
struct FrequencyBand {
  double from_khz = 0.0;
  double to_khz = 0.0;
};
[[nodiscard]] FrequencyBand frequencies_of(std::span<const ObservationProduct> products);

/// A school as totals count it, and what its fish add up to.
struct NumberedSchool {
  BiomassRow row;
  std::vector<BiomassPingRow> pings;
  TimeNs middle_utc = 0;  ///< of its middle ping
  NumberErrors errors;
  double strongest = kUnknown;         ///< numbers with the strongest of the choices, the least
  double weakest = kUnknown;           ///< ... and with the weakest
  std::vector<double> by_choice;       ///< numbers with each of FishChoice::choices
  double fewest_by_course = kUnknown;  ///< with the chosen relation, at the courses that the school's may be
  double most_by_course = kUnknown;
  bool counted = false;  ///< of the species asked for
};

/// Numbers of fish in schools: echo over the mean cross-section of a fish, both summed over the pings that tell the school's
/// backscatter (model/school_totals.h). Course: of schools.csv, through
/// the water where it is known, else over ground; where none is known fish of any heading are meant.
/// products  joined and numbered, as merge() and number_as_merged() leave them
/// out       in the order of counted_schools(); the rows of those not counted have only names and backscatter
[[nodiscard]] std::vector<NumberedSchool> school_numbers(std::span<const ObservationProduct> products,
                                                         const FishChoice& fish);

}  // namespace sonar
