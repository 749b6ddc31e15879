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
  int minimum_samples = 64;
  int block_samples = 26;
  double maximum_db = 0.0;
};

template <class Visitor>
void describe(Visitor& v, BackgroundParams& p) {
  v.choice(
      "method", p.method, kBackgroundMethodNames,
      "How background noise is estimated: low_quantile from the weak samples of a beam's far part, where what fades "
      "with range as uniform water does is water and what does not fade is noise; de_robertis from the beam's "
      "weakest block averaged over pings (De Robertis & Higginbottom 2007), whatever made it.");
  v.field(
      "quantile", p.quantile,
      {.unit = "",
       .min = 0.01,
       .max = 0.9,
       .text = "Method low_quantile: quantile of the power in each block of a beam's far part from which its level is "
               "worked out; lower it where schools fill more of a block."});
  v.field("far_fraction", p.far_fraction,
          {.unit = "",
           .min = 0.05,
           .max = 1,
           .text = "Method low_quantile: share of a beam, counted from its far end, in which noise and water are told "
                   "apart; lower it where the water near the ship is unlike that farther out."});
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

/// What one ping tells of the power in each beam without the flagged samples: with low_quantile that of kFarBlocks blocks
/// of its far part, by the weak samples in each, with de_robertis the mean power of each block of range. A block half of
/// which is flagged tells nothing, nor does a beam of too few samples.
/// in      power [fan][beam][sample], counts re 1 W; flags, same shape
/// out     [fan][beam][block], counts re 1 W; kNoData where nothing is told
/// source  noise power is exponentially distributed, so its mean is q_p / ln(1 / (1 - p)): Holmin et al. 2016 (low
///         quantile); De Robertis & Higginbottom 2007
[[nodiscard]] Array3<std::int16_t> background_levels(View3<const std::int16_t> power, View3<const SampleFlags> flags,
                                                     const BackgroundParams& params);
inline constexpr int kFarBlocks = 12;

/// The same over several pings: with low_quantile the median of each block, with de_robertis its mean (of single pings'
/// blocks of 10 m the weakest lies 4 dB below the mean, by chance).
/// in      at least one ping's levels, all of one shape, made with the same params
[[nodiscard]] Array3<std::int16_t> levels_over_pings(std::span<const Array3<std::int16_t>* const> pings,
                                                     const BackgroundParams& params);

/// Where a ping's own weakest level of a beam lies so much below that of the pings round it, these were disturbed (a beam
/// full of corrupted packets) and its own levels stand.
/// in      own, as levels; beams of which it knows nothing are left as they are
void keep_quieter(View3<const std::int16_t> own, double quiet_db, View3<std::int16_t> levels);

/// Mean over each block of levels of what the sonar equation adds to power, linear: noise of power N there has a mean Sv of N
/// times this, and uniform water of Sv s a power of s over it.
/// in      table [fan][beam][sample], sv_table() of each row
/// out     [fan][beam][block] as background_levels() makes them with low_quantile; 0 where the table holds kNoData
[[nodiscard]] Array3<double> block_gain(View3<const std::int16_t> table, const BackgroundParams& params);

/// Relative standard deviation of a level over several pings that holds noise alone, by how far the levels of each lie from
/// those of all: most blocks hold little else, and it is in there how far along the beam neighbouring samples are alike. A few
/// disturbed pings change it little. Of one or two pings, what independent samples would have.
/// in      pings as for levels_over_pings(), levels what that makes of them by low_quantile
/// samples  of a beam
[[nodiscard]] double level_spread(std::span<const Array3<std::int16_t>* const> pings, View3<const std::int16_t> levels,
                                  int samples, const BackgroundParams& params);

/// Noise power of each row, dB re 1 W. low_quantile: what is left of its levels when the water is taken off that its fan
/// hears (noise_beside_water.h); de_robertis: the weakest level, not above maximum_db.
/// in      levels of several pings and their level_spread(); gain = block_gain(); both not asked for with de_robertis
/// out     [row]; NaN where no level is known
[[nodiscard]] std::vector<double> noise_power_db(View3<const std::int16_t> levels, double spread,
                                                 View3<const double> gain, const BackgroundParams& params);

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
