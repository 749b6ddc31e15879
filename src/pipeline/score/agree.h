// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "model/product.h"
#include "pipeline/score/kappa.h"
#include "pipeline/score/score.h"

namespace sonar {

/// A school that two readers (people, or a person and the program) have, or one of them: a row of agreement.csv. Figures
/// are over the pings that both surveys have; `_low` and `_high` are the least and the largest of any ping. NaN = unknown.
struct AgreementRow {
  std::string school_a;  ///< observation/school; empty = A has none here
  std::string school_b;
  std::string
      lies_in;  ///< where only one has it: the other's school that it overlaps most, which is paired with another
  TimeNs first_time_utc = 0;
  std::int64_t n_pings_a = 0;
  std::int64_t n_pings_b = 0;
  std::int64_t n_pings_both = 0;
  double dice = kUnknown;  ///< mean over the pings that either has; 0 in those that one has not
  double dice_low = kUnknown;
  double dice_high = kUnknown;
  double centre_distance_m = kUnknown;  ///< mean over the pings that both have, as all that follows
  double centre_distance_low_m = kUnknown;
  double centre_distance_high_m = kUnknown;
  double volume_a_m3 = kUnknown;
  double volume_b_m3 = kUnknown;
  double volume_ratio = kUnknown;  ///< B by A, of the means
  double volume_ratio_low = kUnknown;
  double volume_ratio_high = kUnknown;
  double backscatter_difference_db = kUnknown;  ///< B less A, of the linear means
  double backscatter_difference_low_db = kUnknown;
  double backscatter_difference_high_db = kUnknown;
  std::string status_a;  ///< SchoolRow::status; empty = A has none here
  std::string status_b;
  std::string operator_a;
  std::string operator_b;
  std::string species_a;
  std::string species_b;
};

template <class Visitor>
void columns(Visitor& v, AgreementRow& r) {
  v("school_a", "", r.school_a);
  v("school_b", "", r.school_b);
  v("lies_in", "", r.lies_in);
  v("first_time_utc", "", TimeColumn{r.first_time_utc});
  v("n_pings_a", "1", r.n_pings_a);
  v("n_pings_b", "1", r.n_pings_b);
  v("n_pings_both", "1", r.n_pings_both);
  v("dice", "1", r.dice);
  v("dice_low", "1", r.dice_low);
  v("dice_high", "1", r.dice_high);
  v("centre_distance_m", "m", r.centre_distance_m);
  v("centre_distance_low_m", "m", r.centre_distance_low_m);
  v("centre_distance_high_m", "m", r.centre_distance_high_m);
  v("volume_a_m3", "m3", r.volume_a_m3);
  v("volume_b_m3", "m3", r.volume_b_m3);
  v("volume_ratio", "1", r.volume_ratio);
  v("volume_ratio_low", "1", r.volume_ratio_low);
  v("volume_ratio_high", "1", r.volume_ratio_high);
  v("backscatter_difference_db", "dB", r.backscatter_difference_db);
  v("backscatter_difference_low_db", "dB", r.backscatter_difference_low_db);
  v("backscatter_difference_high_db", "dB", r.backscatter_difference_high_db);
  v("status_a", "", r.status_a);
  v("status_b", "", r.status_b);
  v("operator_a", "", r.operator_a);
  v("operator_b", "", r.operator_b);
  v("species_a", "", r.species_a);
  v("species_b", "", r.species_b);
}

/// Two readers' results of one survey against each other.
struct Agreement {
  std::int64_t pings = 0;          ///< that both have; nothing else is compared
  std::vector<AgreementRow> rows;  ///< by time, channel and sample of the first voxel
  /// Unit: a school that either result has, rejected ones too. Yes = it has the school and did not reject it. What neither
  /// has is no unit, so that "no" of both are only schools that both rejected, or one rejected and the other has not.
  Kappa schools;
  /// Unit: a school that both have and both decided on (accepted, corrected or rejected).
  Kappa decisions;
  /// Voxels of all schools that were not rejected, over the survey. Kappa over all samples would tell the same: it tends
  /// to Dice where schools fill little of the water.
  std::int64_t voxels_a = 0;
  std::int64_t voxels_b = 0;
  std::int64_t voxels_both = 0;
  double voxel_dice = kUnknown;
};

/// Pings match by time (within 1 ms) and voxels by channel and sample, whatever observations and schools are called. Schools
/// are paired where each is the other's track_partner(). Swapping the sides swaps what is told of each, inverts ratios and
/// turns the sign of differences.
[[nodiscard]] Agreement agree(const ScoreSide& a, const ScoreSide& b);

/// Refuses what are not two results of one survey.
/// errors  mismatch: no ping in common; no raw file in common (by the hash of its content)
[[nodiscard]] Result<void> require_one_survey(const ScoreSide& a, const std::filesystem::path& out_a,
                                              const ScoreSide& b, const std::filesystem::path& out_b);

/// Where each product of A differs from the results of B, as a product to be drawn, never written: its schools are kInBoth,
/// kOnlyInA and kOnlyInB of all schools that were not rejected, named so, of the origin kDifferenceOrigin. Its one row of
/// school_pings is of the ping in which most voxels are only one's, else of that of A's strongest school: what a picture
/// shows first.
inline constexpr const char* kDifferenceOrigin = "difference";
inline constexpr std::int64_t kInBoth = 1;
inline constexpr std::int64_t kOnlyInA = 2;
inline constexpr std::int64_t kOnlyInB = 3;
[[nodiscard]] std::vector<ObservationProduct> difference_products(const ScoreSide& a, const ScoreSide& b);

/// One object: `pings`, `schools` (an object a row of agreement.csv, null where unknown), `kappa_schools`, `kappa_decisions`
/// (each `counts`, `units`, `agreed_fraction`, `agreed_yes_fraction`, `kappa`, `kappa_se`), `voxels`.
[[nodiscard]] std::string agreement_json(const Agreement& agreement);
/// The same for people.
[[nodiscard]] std::string agreement_text(const Agreement& agreement);

}  // namespace sonar
