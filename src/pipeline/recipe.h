// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "base/describe.h"
#include "base/result.h"
#include "io/csv_table.h"
#include "io/navigation.h"
#include "model/transfer_function.h"
#include "pipeline/merge_params.h"
#include "pipeline/survey.h"
#include "school/detect_params.h"
#include "school/grow.h"
#include "school/measure_params.h"
#include "school/propagate_paper.h"
#include "school/propagate_tracked.h"
#include "school/seabed.h"
#include "school/summarise.h"
#include "school/track.h"
#include "signal/absorption.h"
#include "signal/background.h"
#include "signal/flag_params.h"
#include "signal/median.h"

namespace sonar {

inline constexpr int kRecipeVersion = 1;

enum class AbsorptionSource { file, francois_garrison, ainslie_mccolm };
inline constexpr std::array<std::string_view, 3> kAbsorptionSourceNames = {"file", "francois_garrison",
                                                                           "ainslie_mccolm"};

/// One line of a user's calibration file; NaN keeps the raw file's value.
struct BeamCalibration {
  int channel = 0;  ///< 0-based
  double gain_db = 0.0;
  double sa_correction_db = 0.0;
  double extra_factor_db = 0.0;
  friend bool operator==(const BeamCalibration&, const BeamCalibration&) = default;
};

struct CalibrationParams {
  AbsorptionSource absorption = AbsorptionSource::file;
  WaterProperties water;
  double pulse_tolerance = 0.001;
  std::vector<BeamCalibration> beams;  ///< by channel; stands in the recipe by content
};

template <class Visitor>
void describe(Visitor& v, CalibrationParams& p) {
  v.choice("absorption", p.absorption, kAbsorptionSourceNames,
           "file: the value recorded with each ping's channel, else Francois & Garrison; or always by a formula");
  v.group("water", p.water, "for the absorption formulas");
  v.field("pulse_tolerance", p.pulse_tolerance,
          {.unit = "1", .min = 0, .max = 0.1, .text = "gain tables are matched to the pulse length within this share"});
}

struct BackgroundWindowParams {
  bool enabled = true;
  int pings_each_side = 5;
  double quiet_db = 6.0;
};

template <class Visitor>
void describe(Visitor& v, BackgroundWindowParams& p) {
  v.field("enabled", p.enabled, {.text = "subtract the background noise and keep thresholds above it"});
  v.field("pings_each_side", p.pings_each_side,
          {.unit = "pings",
           .min = 0,
           .max = 100,
           .text = "the background is the median over so many pings before and after"});
  v.field(
      "quiet_db", p.quiet_db,
      {.unit = "dB",
       .min = 0,
       .max = 100,
       .text = "a beam that is so much quieter in the ping itself was disturbed in the others: its own level counts"});
}

/// Every parameter of every stage: what makes one run's science equal to another's. Jobs, paths, cache and display are
/// not in it.
struct Recipe {
  SurveyParams survey;
  NavigationParams navigation;
  CalibrationParams calibration;
  FlagParams flags;
  BackgroundParams background;
  BackgroundWindowParams background_window;
  MedianParams median;
  SeabedParams seabed;
  bool automatic = true;
  DetectParams detect;
  TrackParams track;
  MeasureParams measure;
  SummariseParams summarise;
  MergeParams merge;
  GrowParams grow;
  PaperPropagationParams propagate_paper;
  TrackedPropagationParams propagate_tracked;
  TransferFunction growth_curve;  ///< in the JSON as growth_curve
};

template <class Visitor>
void describe(Visitor& v, Recipe& r) {
  v.group("survey", r.survey, "how pings become observations");
  v.group("navigation", r.navigation, "where the transducer is");
  v.group("calibration", r.calibration, "from power to Sv");
  v.group("flags", r.flags, "samples that are not to be trusted");
  v.group("background", r.background, "background noise of each beam in one ping");
  v.group("background_window", r.background_window, "background noise over pings");
  v.group("median", r.median, "the filter before selection");
  v.group("seabed", r.seabed, "finding and leaving out the seabed");
  v.field("automatic", r.automatic, {.text = "detect schools without a human"});
  v.group("detect", r.detect, "schools of one ping");
  v.group("track", r.track, "schools over pings");
  v.group("measure", r.measure, "a school's figures in one ping");
  v.group("summarise", r.summarise, "a school's figures over its pings");
  v.group("merge", r.merge, "schools over the cuts between observations");
  v.group("grow", r.grow, "one click");
  v.group("propagate_paper", r.propagate_paper, "carrying a click through time as the 2007 paper did");
  v.group("propagate_tracked", r.propagate_tracked, "carrying a click through time");
}

/// "default", or "paper": the 2007 paper to the letter (its four noises by cropping and median alone, no seabed, no
/// background, no detection without a human).
/// errors  usage: no such preset
[[nodiscard]] Result<Recipe> recipe_preset(std::string_view name);

/// All parameters, keys sorted, defaults filled in.
[[nodiscard]] std::string recipe_text(const Recipe& recipe);
/// What recipe_text() writes, or any part of it: what is absent keeps its default.
/// errors  format, newer_version, bad_parameter: naming the parameter
[[nodiscard]] Result<Recipe> recipe_from_text(std::string_view text);
[[nodiscard]] Result<Recipe> read_recipe(const std::string& path);
/// A file, or a preset's name where there is no such file; empty = default.
[[nodiscard]] Result<Recipe> named_recipe(const std::string& path_or_preset);
/// Hexadecimal XXH3-128 of recipe_text().
[[nodiscard]] std::string recipe_hash(const Recipe& recipe);

/// Takes a calibration table (channel,gain_db,sa_correction_db,extra_factor_db) into the recipe.
/// errors  format, bad_parameter, naming the line or the channel
[[nodiscard]] Result<void> take_calibration_table(Recipe& recipe, const CsvTable& table);
/// errors  also not_found, io
[[nodiscard]] Result<void> take_calibration_file(Recipe& recipe, const std::string& path);

}  // namespace sonar
