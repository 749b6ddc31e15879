// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "base/describe.h"
#include "base/result.h"
#include "model/transfer_function.h"
#include "view/colour_map.h"
#include "view/image.h"

namespace sonar {

/// Below every count, so that nothing is cut.
inline constexpr double kNoThreshold_db = -400.0;
/// Where the first colour of a mean over all beams begins, which is weaker than a beam's own Sv.
inline constexpr double kMeansLow_db = -75.0;

/// How Sv becomes colour. Display limits and analysis threshold are two things: below the lower limit nothing is drawn;
/// what lies below the threshold is neither shown nor integrated.
struct SvScale {
  ColourMapName map = ColourMapName::viridis;
  double low_db = -60.0;                  ///< display limit: where the first colour begins
  double span_db = 36.0;                  ///< from the first colour's beginning to the last one's end
  double threshold_db = kNoThreshold_db;  ///< analysis threshold
  Rgba8 no_data{0, 0, 0, 0};              ///< of samples without data; alpha 0 = the picture's own
  [[nodiscard]] double high_db() const { return low_db + span_db; }
  friend bool operator==(const SvScale&, const SvScale&) = default;
};

template <class Visitor>
void describe(Visitor& v, SvScale& p) {
  constexpr std::string_view kOfSv = "slice- volume timeline echogram noise-steps";
  constexpr std::string_view kScaled = "slice- volume timeline survey-map echogram noise-steps";
  v.choice("map", p.map, colour_map_names(), {"colours that Sv is drawn in", Tier::expert, kOfSv});
  v.field("low_db", p.low_db,
          {.unit = "dB",
           .min = -190,
           .max = 100,
           .text = "display limit: the first colour begins here; a timeline of means begins at -75 until it is set",
           .suits = kScaled});
  v.field("span_db", p.span_db,
          {.unit = "dB", .min = 1, .max = 200, .text = "from the first colour to the last", .suits = kScaled});
  v.field("threshold_db", p.threshold_db,
          {.unit = "dB",
           .min = kNoThreshold_db,
           .max = 100,
           .text = "analysis threshold: below it nothing is shown or integrated",
           .suits = kOfSv});
}

/// Colour of every Sv count, and what a colour bar must say about it. Made from a scale or from a transfer function, so
/// that pictures of data need not know which.
struct SvColours {
  std::vector<Rgba8> by_count;  ///< [65536], entry [count + 32768]; alpha 0 = not shown; [0] = no data
  double low_db = -60.0;        ///< display limits
  double high_db = -24.0;
  double threshold_db = kNoThreshold_db;
  double step_db = 0.0;  ///< of a stepped map, between its colours; 0 = smooth

  [[nodiscard]] Rgba8 operator[](std::int16_t count) const { return by_count[static_cast<std::size_t>(count + 32768)]; }
  std::vector<Rgba8> bar;  ///< colours at even steps from low_db to high_db, for the colour bar
};

/// Parameters as validate() lets them pass.
[[nodiscard]] SvColours sv_colours(const SvScale& scale);
/// Colours of a transfer function; opacity becomes alpha. The bar reaches from its first to its last point.
[[nodiscard]] SvColours sv_colours(const TransferFunction& transfer, double threshold_db = kNoThreshold_db,
                                   Rgba8 no_data = {0, 0, 0, 0});

/// The scale as a view curve for volumes: its colours (steps stay steps, 1e-6 dB wide), opacity rising from 0 at the
/// larger of low_db and threshold_db to `most_opacity` at high_db.
/// errors  bad_parameter: threshold not below high_db, opacity outside 0..1, length not positive
[[nodiscard]] Result<TransferFunction> transfer_function(const SvScale& scale, double most_opacity = 0.6,
                                                         double opacity_length_m = 10.0);
/// The limits of a transfer function as a scale (its first and last point), with a map of the caller's choice.
[[nodiscard]] SvScale sv_scale(const TransferFunction& transfer, ColourMapName map);

}  // namespace sonar
