// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/array.h"
#include "base/sample_flags.h"

namespace sonar {

enum class BackgroundMethod { low_quantile, de_robertis };
inline constexpr std::array<std::string_view, 2> kBackgroundMethodNames = {"low_quantile", "de_robertis"};

struct BackgroundParams {
  BackgroundMethod method = BackgroundMethod::low_quantile;
  double quantile = 0.2;
  double far_fraction = 0.75;
  double fall_db = 1.5;
  int minimum_samples = 64;
  int block_samples = 26;
  double maximum_db = 0.0;
};

template <class Visitor>
void describe(Visitor& v, BackgroundParams& p) {
  v.choice("method", p.method, kBackgroundMethodNames,
           "How background noise is estimated: low_quantile from the weak samples of a beam's far part, de_robertis "
           "from its weakest block averaged over pings (De Robertis & Higginbottom 2007). Choose de_robertis where "
           "echo fills the far part.");
  v.field("quantile", p.quantile,
          {.unit = "",
           .min = 0.01,
           .max = 0.9,
           .text = "Method low_quantile: quantile of the power in a beam's far part from which noise is worked out; "
                   "lower it where echo fills more of the far part."});
  v.field("far_fraction", p.far_fraction,
          {.unit = "",
           .min = 0.05,
           .max = 1,
           .text = "Method low_quantile: share of a beam, counted from its far end, from which noise is estimated; "
                   "lower it where echo reaches far out."});
  v.field("fall_db", p.fall_db,
          {.unit = "dB",
           .min = 0,
           .max = 100,
           .text = "Method low_quantile: where most beams weaken by more than this towards their far end, noise is "
                   "taken from the end alone, since echo fades with range and noise does not; lower it where "
                   "reverberation reaches far out."});
  v.field("minimum_samples", p.minimum_samples,
          {.unit = "samples",
           .min = 1,
           .max = 100000,
           .text = "Least number of unflagged samples from which a beam's background noise is estimated; lower it for "
                   "short recording ranges, raise it if estimates from few samples are unsteady."});
  v.field("block_samples", p.block_samples,
          {.unit = "samples",
           .min = 1,
           .max = 10000,
           .text = "Method de_robertis: length of a block of range; 26 samples are 10 m of an MS70. Raise it for "
                   "steadier levels, lower it where only short stretches of a beam are free of echo."});
  v.field("maximum_db", p.maximum_db,
          {.unit = "dB re 1 W",
           .min = -300,
           .max = 100,
           .text = "Method de_robertis: highest background noise believed, to which higher estimates are cut; lower it "
                   "where seabed or fish fill whole beams."});
}

/// What one ping tells of each beam's background, without the flagged samples: with low_quantile the levels of its far
/// part and of that part's last half and last quarter, with de_robertis the mean power of each block of range, block by
/// block. Only combine_background() makes levels of both: the weakest block of a single ping is weak by chance (4 dB
/// below the mean, of blocks of 10 m).
/// in      power [fan][beam][sample], counts re 1 W; flags, same shape
/// out     [fan * beams + beam][block], dB re 1 W; NaN where too few samples are sound
/// source  noise power is exponentially distributed, so its mean is q_p / ln(1 / (1 - p)): Holmin et al. 2016 (low
///         quantile); De Robertis & Higginbottom 2007
[[nodiscard]] std::vector<double> background_power_db(View3<const std::int16_t> power, View3<const SampleFlags> flags,
                                                      const BackgroundParams& params);

/// Level of each row over pings. low_quantile: the median, of the whole far part unless most beams' ends lie lower;
/// de_robertis: blocks averaged over pings, and of these the weakest, not above maximum_db. NaN are left out, a row
/// without any stays NaN.
/// in      one estimate per ping, all of one length, as background_power_db() gives them with the same params
/// rows    of the grid
/// out     [row]
[[nodiscard]] std::vector<double> combine_background(std::span<const std::vector<double>> pings, std::size_t rows,
                                                     const BackgroundParams& params);

/// Where a ping's own level lies so much below that of the pings round it, these were disturbed (a beam full of corrupted
/// packets) and its own stands.
/// in      own_db [row], of the ping alone; NaN tells nothing
/// out     level_db [row]
void keep_quieter(std::span<const double> own_db, double quiet_db, std::span<double> level_db);

/// Sv of the background at each sample: its power plus what the sonar equation adds there.
/// in      level_db of the row, table = sv_table() of the row
/// out     [sample], dB re 1 m^-1; NaN where the level is NaN or the table holds kNoData
[[nodiscard]] std::vector<double> noise_sv_db(double level_db, std::span<const std::int16_t> table);

/// The same plus a margin, in Sv counts, for thresholds; an unknown level gives kMinCount, "no data" stays so.
[[nodiscard]] std::vector<std::int16_t> noise_sv_counts(double level_db, double margin_db,
                                                        std::span<const std::int16_t> table);

/// Flags low_snr where power < background + margin; rows of unknown background are left alone.
/// in      power as recorded (power minus background power equals Sv minus background Sv); level_db [row]
void flag_low_snr(View3<const std::int16_t> power, std::span<const double> level_db, double margin_db,
                  View3<SampleFlags> flags);

/// Flags low_snr in one row of Sv counts below a limit for each sample, as made by noise_sv_counts().
void flag_low_snr(std::span<const std::int16_t> sv, std::span<const std::int16_t> limit, std::span<SampleFlags> flags);

}  // namespace sonar
