// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "base/describe.h"
#include "base/result.h"
#include "io/csv_table.h"
#include "io/ping_navigation.h"
#include "model/current.h"
#include "model/transfer_function.h"
#include "pipeline/survey/survey.h"
#include "pipeline/tasks/merge_params.h"
#include "school/detect/detect_params.h"
#include "school/grow/grow.h"
#include "school/grow/propagate_paper.h"
#include "school/grow/propagate_tracked.h"
#include "school/measure/measure_params.h"
#include "school/measure/school_errors.h"
#include "school/measure/summarise.h"
#include "school/measure/water_current.h"
#include "school/seabed/seabed.h"
#include "school/track/track.h"
#include "signal/absorption.h"
#include "signal/background.h"
#include "signal/flag_params.h"
#include "signal/median.h"

namespace sonar {

inline constexpr int kRecipeVersion = 1;

enum class AbsorptionSource { file, francois_garrison, ainslie_mccolm };
inline constexpr std::array<std::string_view, 3> kAbsorptionSourceNames = {"file", "francois_garrison",
                                                                           "ainslie_mccolm"};

/// Where the equivalent beam angle comes from: the raw file, the two-way pattern of the -3 dB widths (the square of the
/// one-way beam), or a user's calibration file (the raw file where that says nothing).
enum class PsiSource { stated, from_widths, table };
inline constexpr std::array<std::string_view, 3> kPsiSourceNames = {"stated", "from_widths", "table"};

/// One line of a user's calibration file; NaN keeps the raw file's value. Standard errors: NaN = not told.
struct BeamCalibration {
  int channel = 0;  ///< 0-based
  double gain_db = kUnknown;
  double sa_correction_db = kUnknown;
  double extra_factor_db = kUnknown;
  double psi_db = kUnknown;             ///< dB re 1 sr; counts where CalibrationParams::psi is `table`
  double width_along_deg = kUnknown;    ///< one-way -3 dB; MS70: vertical
  double width_athwart_deg = kUnknown;  ///< MS70: horizontal
  double gain_db_se = kUnknown;
  double sa_correction_db_se = kUnknown;
  double extra_factor_db_se = kUnknown;
  double psi_db_se = kUnknown;
  double width_along_deg_se = kUnknown;
  double width_athwart_deg_se = kUnknown;
  /// What is unknown in both is alike.
  friend bool operator==(const BeamCalibration& a, const BeamCalibration& b);
};

/// Visits the columns beside the channel: v(name, member, least, most).
template <class Visitor>
void columns(Visitor&& v, BeamCalibration& b) {
  constexpr double kMost_db = 100.0;
  constexpr double kLeastWidth_deg = 0.01;
  constexpr double kMostWidth_deg = 360.0;
  v("gain_db", b.gain_db, -kMost_db, kMost_db);
  v("sa_correction_db", b.sa_correction_db, -kMost_db, kMost_db);
  v("extra_factor_db", b.extra_factor_db, -kMost_db, kMost_db);
  v("psi_db", b.psi_db, -kMost_db, kMost_db);
  v("width_along_deg", b.width_along_deg, kLeastWidth_deg, kMostWidth_deg);
  v("width_athwart_deg", b.width_athwart_deg, kLeastWidth_deg, kMostWidth_deg);
  v("gain_db_se", b.gain_db_se, 0.0, kMost_db);
  v("sa_correction_db_se", b.sa_correction_db_se, 0.0, kMost_db);
  v("extra_factor_db_se", b.extra_factor_db_se, 0.0, kMost_db);
  v("psi_db_se", b.psi_db_se, 0.0, kMost_db);
  v("width_along_deg_se", b.width_along_deg_se, 0.0, kMostWidth_deg);
  v("width_athwart_deg_se", b.width_athwart_deg_se, 0.0, kMostWidth_deg);
}

struct CalibrationParams {
  AbsorptionSource absorption = AbsorptionSource::file;
  WaterProperties water;
  double pulse_tolerance = 0.001;
  PsiSource psi = PsiSource::stated;
  std::vector<BeamCalibration> beams;  ///< by channel; stands in the recipe by content
};

template <class Visitor>
void describe(Visitor& v, CalibrationParams& p) {
  v.choice("absorption", p.absorption, kAbsorptionSourceNames,
           {"Where the absorption comes from: file takes the value recorded for each channel (or Francois & Garrison's "
            "where there is none), the others work it out by their formula. Choose a formula when the recorded value "
            "is wrong.",
            Tier::basic});
  v.group("water", p.water, "the water for which absorption is worked out");
  v.field("pulse_tolerance", p.pulse_tolerance,
          {.unit = "1",
           .min = 0,
           .max = 0.1,
           .text = "Largest relative difference between a ping's pulse length and one in the sounder's gain table for "
                   "that gain to be used; raise it only if the file rounds its pulse lengths."});
  v.choice("psi", p.psi, kPsiSourceNames,
           "Source of the equivalent beam angle: stated is the raw file's, from_widths follows from the -3 dB widths, "
           "table is psi_db of a calibration table, else the raw file's. Choose from_widths if stated is wrong; a "
           "table with psi_db chooses table.");
}

struct BackgroundWindowParams {
  bool enabled = true;
  int pings_each_side = 5;
  double quiet_db = 6.0;
};

template <class Visitor>
void describe(Visitor& v, BackgroundWindowParams& p) {
  v.field("enabled", p.enabled,
          {.text = "Subtract the background noise from Sv and keep thresholds above it; switch it off to see the data "
                   "as recorded."});
  v.field("pings_each_side", p.pings_each_side,
          {.unit = "pings",
           .min = 0,
           .max = 100,
           .text = "The background noise of a ping is estimated over this many pings before and after it; raise it for "
                   "steadier levels, lower it where noise changes from ping to ping."});
  v.field("quiet_db", p.quiet_db,
          {.unit = "dB",
           .min = 0,
           .max = 100,
           .text = "A beam whose noise in a ping is this much lower than in the pings around it keeps its own level, "
                   "because the others were disturbed; lower it where disturbed pings raise the noise of quiet ones."});
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
  ErrorParams errors;
  CurrentParams currents;
  MergeParams merge;
  GrowParams grow;
  PaperPropagationParams propagate_paper;
  TrackedPropagationParams propagate_tracked;
  TransferFunction growth_curve;     ///< in the JSON as growth_curve
  CurrentProfiles current_profiles;  ///< stand in the recipe by content; empty = none are known
  std::vector<std::string> notes;    ///< on parameters that the text names as earlier versions did, a line each
};

template <class Visitor>
void describe(Visitor& v, Recipe& r) {
  v.group("survey", r.survey, "how pings become observations");
  v.group("navigation", r.navigation, "where the transducer is");
  v.group("calibration", r.calibration, "from power to Sv");
  v.group("flags", r.flags, "samples that are not to be trusted");
  v.group("background", r.background, "background noise of each beam in one ping");
  v.group("background_window", r.background_window, "background noise over several pings");
  v.group("median", r.median, "the filter before selection");
  v.group("seabed", r.seabed, "finding the seabed and leaving it out");
  v.field("automatic", r.automatic,
          {.text = "Detect schools automatically; switch it off to keep only what an operator selects."});
  v.group("detect", r.detect, "schools in one ping");
  v.group("track", r.track, "schools followed over pings");
  v.group("measure", r.measure, "a school's figures in one ping");
  v.group("summarise", r.summarise, "a school's figures over its pings");
  v.group("errors", r.errors, "standard errors of a school's figures");
  v.group("currents", r.currents, "where the water's velocity holds");
  v.group("merge", r.merge, "schools over the cuts between observations");
  v.group("grow", r.grow, "growing from one click");
  v.group("propagate_paper", r.propagate_paper, "following a selected school as the 2007 paper did");
  v.group("propagate_tracked", r.propagate_tracked, "following a selected school through the pings");
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
/// Refuses what recipe_from_text() refuses: a value out of its range, or values that do not go together.
/// errors  bad_parameter
[[nodiscard]] Result<void> validate_recipe(const Recipe& recipe);
[[nodiscard]] Result<Recipe> read_recipe(const std::string& path);
/// What read_recipe() reads. errors: io, no_space; usage: a recording stands there
[[nodiscard]] Result<void> write_recipe(const std::string& path, const Recipe& recipe);
/// A file, or a preset's name where there is no such file; empty = default.
[[nodiscard]] Result<Recipe> named_recipe(const std::string& path_or_preset);
/// Hexadecimal XXH3-128 of recipe_text().
[[nodiscard]] std::string recipe_hash(const Recipe& recipe);

/// Takes a calibration table (channel and any of columns(BeamCalibration)) into the recipe. One that tells psi_db makes
/// calibration.psi `table`.
/// errors  format, bad_parameter, naming the line or the channel
[[nodiscard]] Result<void> take_calibration_table(Recipe& recipe, const CsvTable& table);
/// errors  also not_found, io
[[nodiscard]] Result<void> take_calibration_file(Recipe& recipe, const std::string& path);

/// Takes a user's sound speed into the recipe: a number, m/s, or a file of depth_m,sound_speed_mps (sound_profile.h).
/// errors  bad_parameter, format, not_found, io
[[nodiscard]] Result<void> take_sound_speed(Recipe& recipe, const std::string& value_or_path);

/// Takes the water's velocities from an ADCP's netCDF file (io/current_file.h) into the recipe.
/// errors  as read_currents()
[[nodiscard]] Result<void> take_currents(Recipe& recipe, const std::string& path);

}  // namespace sonar
