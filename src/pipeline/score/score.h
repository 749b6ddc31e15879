// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "model/product.h"
#include "model/school.h"

namespace sonar {

/// Two masks of a ping with a smaller Dice than this have nothing to do with each other: a mask that fills the sea
/// overlaps every school and has found none.
inline constexpr double kPairDice = 0.1;

/// A track that is paired with no true school is a fragment of one where so much of its voxels lies in true masks, and
/// a false school otherwise.
inline constexpr double kFragmentInside = 0.5;

/// A school counts when its mask spans so much in at least kCountedPings pings that touch no edge.
inline constexpr int kCountedBeams = 3;
inline constexpr int kCountedFans = 2;
inline constexpr int kCountedSamples = 10;
inline constexpr int kCountedPings = 3;
/// Speeds are judged where so many pings touch no edge.
inline constexpr int kSpeedPings = 8;

/// The body of a school in one ping (truth/bodies.csv), summed where a school has several.
struct BodyInPing {
  double volume_m3 = kUnknown;
  double backscatter_m2 = kUnknown;
  double fraction_inside = kUnknown;
};
struct BodyKey {
  std::string observation;
  std::int64_t school_id = 0;
  std::int64_t ping_index = 0;
  friend auto operator<=>(const BodyKey&, const BodyKey&) = default;
};

/// A box of the truth's grid in one ping in which something lies that is no school (truth/company.csv); bounds are
/// included.
struct CompanyBox {
  std::string kind;
  std::int64_t first_fan = 0, last_fan = 0;
  std::int64_t first_beam = 0, last_beam = 0;
  std::int64_t first_sample = 0, last_sample = 0;
};
/// (observation, ping_index) -> its boxes
using CompanyByPing = std::map<std::pair<std::string, std::int64_t>, std::vector<CompanyBox>>;

/// What the cause of a false school is called where the truth knows of company, but not there, and where it knows none.
inline constexpr const char* kCauseNone = "none";
inline constexpr const char* kCauseUnknown = "unknown";
/// A kind of company is the cause of a false school where so much of its mask lies in that kind's boxes.
inline constexpr double kCauseShare = 0.5;

/// Everything on one side of a comparison; masks, rows and pings are the products'.
struct ScoreSide {
  std::vector<ObservationProduct> observations;
  std::map<BodyKey, BodyInPing> bodies;  ///< truth only
  std::optional<CompanyByPing> company;  ///< truth only; empty = not told
  std::vector<std::string> missing;      ///< observations that the tables name and no product holds
};

/// How one true school was found. NaN = cannot be told. Errors compare means over the unclipped pings that both have.
struct SchoolScore {
  std::string truth_id;      ///< observation/school
  std::string found_id;      ///< empty = not found
  double inside = kUnknown;  ///< mean share of the body inside the sector; without bodies the share of unclipped pings
  std::int64_t n_pings = 0;
  std::int64_t n_unclipped = 0;  ///< of the truth
  bool counted = false;
  double range_m = kUnknown;        ///< median over its pings
  double elevation_deg = kUnknown;  ///< of its mask's voxels, positive up: median over its pings of their mean
  double dice = kUnknown;           ///< mean over the unclipped pings; 0 where not found
  double cog_error_m = kUnknown;
  double volume_ratio = kUnknown;
  double volume_corrected_ratio = kUnknown;
  double length_corrected_ratio = kUnknown;  ///< this and the next two: found by truth, as volume_corrected_ratio
  double width_corrected_ratio = kUnknown;
  double height_corrected_ratio = kUnknown;
  double backscatter_error_db = kUnknown;
  double sv_error_db = kUnknown;
  double speed_error_mps = kUnknown;
  double purity = kUnknown;    ///< share of this school's pings in its track and its fragments
  bool merged = false;         ///< its track is another school's as well, and rather that one's: not found
  std::int64_t fragments = 0;  ///< further tracks that lie in it
  double body_volume_corrected_ratio = kUnknown;
  double body_backscatter_error_db = kUnknown;
  double total_backscatter_error_db = kUnknown;  ///< backscatter_total_m2 against the bodies
  double body_sv_error_db =
      kUnknown;  ///< sv_corrected_db of the school's row against its bodies in the unclipped pings
};

/// A found track that is no true school's and no fragment of one.
struct FalseSchool {
  std::string found_id;
  std::int64_t n_pings = 0;
  double volume_m3 = kUnknown;
  double sv_mean_db = kUnknown;
  std::string cause = kCauseUnknown;  ///< a kind of company, kCauseNone or kCauseUnknown
  double cause_share = kUnknown;      ///< of its voxels, in the boxes of the kind that holds most; NaN = not told
};

/// A further track inside a true school that another track was paired with, or that none was.
struct Fragment {
  std::string found_id;
  std::string truth_id;
  std::int64_t n_pings = 0;
};

/// One found track for several true schools.
struct MergedTrack {
  std::string found_id;
  std::vector<std::string> truth_ids;
};

/// What the beams of all observations of a truth reach; NaN = no observation has a grid.
struct ScoreSpan {
  double range_from_m = kUnknown;
  double range_to_m = kUnknown;
  double elevation_from_deg = kUnknown;  ///< positive up
  double elevation_to_deg = kUnknown;
};

/// Which third of [from, to) a value lies in: 0, 1 or 2, what is beyond an end in the third there; -1 where anything is
/// unknown or the stretch empty.
[[nodiscard]] int third_of(double value, double from, double to);

struct Score {
  ScoreSpan span;
  std::int64_t pings = 0;  ///< of the truth that the result has
  std::vector<SchoolScore> schools;
  std::vector<FalseSchool> false_schools;
  std::vector<Fragment> fragments;
  std::vector<MergedTrack> merged;
};

/// Holds a result against the truth. Pings match by time (within 1 ms), whatever the observations are called; schools
/// marked as rejected are not there.
[[nodiscard]] Score score(const ScoreSide& found, const ScoreSide& truth);

/// Whether any ping of one side is the other's as well; else there is nothing to compare.
[[nodiscard]] bool share_pings(const ScoreSide& found, const ScoreSide& truth);

/// The object of INTERFACES section 7, with `fragments` and `merged` beside. `summary` has, over the schools that
/// count: counted, found, found_fraction, mean_dice, and the members `median`, `p90` (of the error's size) and `bias`
/// (median with its sign) of each error; `by_range_third` and `by_elevation_third` the latter for each third of what the
/// beams reach.
[[nodiscard]] std::string score_json(const Score& score);
/// The same for people.
[[nodiscard]] std::string score_text(const Score& score);

/// Reads products and, where there are any, schools.csv and school_pings.csv of a result.
/// errors  not_found, format
[[nodiscard]] Result<ScoreSide> read_result_side(const std::filesystem::path& out);
/// Reads a truth folder: obs-*.nc, schools.csv, school_pings.csv, bodies.csv, company.csv.
/// errors  not_found, format
[[nodiscard]] Result<ScoreSide> read_truth_side(const std::filesystem::path& truth);

}  // namespace sonar
