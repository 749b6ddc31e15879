// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/score/score.h"

namespace sonar {
namespace {

using nlohmann::json;

/// One error of a school as the summary treats it.
struct ErrorFigure {
  const char* name;
  double (*of)(const SchoolScore&);
};

/// Ratios count as their distance from 1.
constexpr std::array<ErrorFigure, 13> kErrors = {{
    {"cog_error_m", [](const SchoolScore& s) { return s.cog_error_m; }},
    {"volume_ratio_error", [](const SchoolScore& s) { return s.volume_ratio - 1.0; }},
    {"volume_corrected_ratio_error", [](const SchoolScore& s) { return s.volume_corrected_ratio - 1.0; }},
    {"length_corrected_ratio_error", [](const SchoolScore& s) { return s.length_corrected_ratio - 1.0; }},
    {"width_corrected_ratio_error", [](const SchoolScore& s) { return s.width_corrected_ratio - 1.0; }},
    {"height_corrected_ratio_error", [](const SchoolScore& s) { return s.height_corrected_ratio - 1.0; }},
    {"backscatter_error_db", [](const SchoolScore& s) { return s.backscatter_error_db; }},
    {"sv_error_db", [](const SchoolScore& s) { return s.sv_error_db; }},
    {"speed_error_mps",
     [](const SchoolScore& s) { return s.n_unclipped >= kSpeedPings ? s.speed_error_mps : kUnknown; }},
    {"body_volume_corrected_ratio_error", [](const SchoolScore& s) { return s.body_volume_corrected_ratio - 1.0; }},
    {"body_backscatter_error_db", [](const SchoolScore& s) { return s.body_backscatter_error_db; }},
    {"total_backscatter_error_db", [](const SchoolScore& s) { return s.total_backscatter_error_db; }},
    {"body_sv_error_db", [](const SchoolScore& s) { return s.body_sv_error_db; }},
}};

json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

/// Linear between the ranks; null of nothing.
double quantile(std::vector<double> values, double share) {
  if (values.empty()) return kUnknown;
  std::sort(values.begin(), values.end());
  const double at = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (at - static_cast<double>(below)) * (values[above] - values[below]);
}

std::vector<SchoolScore> counted(const Score& score) {
  std::vector<SchoolScore> out;
  std::copy_if(score.schools.begin(), score.schools.end(), std::back_inserter(out),
               [](const SchoolScore& s) { return s.counted; });
  return out;
}

std::vector<double> values_of(const std::vector<SchoolScore>& schools, const ErrorFigure& figure, bool sized) {
  std::vector<double> values;
  for (const SchoolScore& s : schools) {
    const double v = figure.of(s);
    if (std::isfinite(v)) values.push_back(sized ? std::abs(v) : v);
  }
  return values;
}

struct Basics {
  std::size_t counted = 0;
  std::size_t found = 0;
  double found_fraction = kUnknown;
  double mean_dice = kUnknown;
  double min_dice = kUnknown;
  double mean_purity = kUnknown;
  double min_purity = kUnknown;
};

Basics basics(const std::vector<SchoolScore>& schools) {
  Basics b;
  b.counted = schools.size();
  if (schools.empty()) return b;
  double dice_sum = 0.0;
  double purity_sum = 0.0;
  std::size_t paired = 0;
  for (const SchoolScore& s : schools) {
    dice_sum += s.dice;
    b.min_dice = std::fmin(b.min_dice, s.dice);
    if (s.found_id.empty()) continue;
    if (!s.merged) ++b.found;
    ++paired;
    purity_sum += s.purity;
    b.min_purity = std::fmin(b.min_purity, s.purity);
  }
  b.found_fraction = static_cast<double>(b.found) / static_cast<double>(b.counted);
  b.mean_dice = dice_sum / static_cast<double>(b.counted);
  if (paired > 0) b.mean_purity = purity_sum / static_cast<double>(paired);
  return b;
}

/// Median sizes of all errors for the schools within 50 m of each hundred metres.
json by_range(const std::vector<SchoolScore>& schools) {
  json out = json::array();
  for (const double middle_m : {100.0, 200.0, 300.0, 400.0}) {
    std::vector<SchoolScore> near;
    std::copy_if(schools.begin(), schools.end(), std::back_inserter(near),
                 [&](const SchoolScore& s) { return std::abs(s.range_m - middle_m) <= 50.0; });
    json entry = {{"range_m", middle_m}, {"counted", near.size()}, {"mean_dice", number(basics(near).mean_dice)}};
    for (const ErrorFigure& figure : kErrors)
      entry[figure.name] = number(quantile(values_of(near, figure, false), 0.5));
    out.push_back(entry);
  }
  return out;
}

/// The schools of one third of what the beams reach.
struct Third {
  double from = kUnknown;
  double to = kUnknown;
  std::vector<SchoolScore> schools;
};
using Thirds = std::array<Third, 3>;

Thirds thirds(const std::vector<SchoolScore>& schools, double from, double to, double SchoolScore::*place) {
  Thirds out;
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i].from = from + (to - from) * static_cast<double>(i) / 3.0;
    out[i].to = from + (to - from) * static_cast<double>(i + 1) / 3.0;
  }
  for (const SchoolScore& s : schools) {
    const int third = third_of(s.*place, from, to);
    if (third >= 0) out[static_cast<std::size_t>(third)].schools.push_back(s);
  }
  return out;
}

Thirds range_thirds(const Score& score, const std::vector<SchoolScore>& schools) {
  return thirds(schools, score.span.range_from_m, score.span.range_to_m, &SchoolScore::range_m);
}

Thirds elevation_thirds(const Score& score, const std::vector<SchoolScore>& schools) {
  return thirds(schools, score.span.elevation_from_deg, score.span.elevation_to_deg, &SchoolScore::elevation_deg);
}

/// Signed medians of all errors; `n` = how many of each are known.
json thirds_json(const Thirds& all, const char* from, const char* to) {
  json out = json::array();
  for (const Third& third : all) {
    json n = json::object();
    json entry = {{from, number(third.from)},
                  {to, number(third.to)},
                  {"counted", third.schools.size()},
                  {"mean_dice", number(basics(third.schools).mean_dice)}};
    for (const ErrorFigure& figure : kErrors) {
      const std::vector<double> values = values_of(third.schools, figure, false);
      n[figure.name] = values.size();
      entry[figure.name] = number(quantile(values, 0.5));
    }
    entry["n"] = n;
    out.push_back(entry);
  }
  return out;
}

std::map<std::string, std::int64_t> false_by_cause(const Score& score) {
  std::map<std::string, std::int64_t> out;
  for (const FalseSchool& s : score.false_schools) ++out[s.cause];
  return out;
}

json summary_json(const Score& score) {
  const std::vector<SchoolScore> schools = counted(score);
  const Basics b = basics(schools);
  json median = json::object();
  json p90 = json::object();
  json bias = json::object();
  for (const ErrorFigure& figure : kErrors) {
    median[figure.name] = number(quantile(values_of(schools, figure, true), 0.5));
    p90[figure.name] = number(quantile(values_of(schools, figure, true), 0.9));
    bias[figure.name] = number(quantile(values_of(schools, figure, false), 0.5));
  }
  return {{"schools", score.schools.size()},
          {"pings", score.pings},
          {"counted", b.counted},
          {"found", b.found},
          {"found_fraction", number(b.found_fraction)},
          {"mean_dice", number(b.mean_dice)},
          {"min_dice", number(b.min_dice)},
          {"mean_purity", number(b.mean_purity)},
          {"min_purity", number(b.min_purity)},
          {"false_schools", score.false_schools.size()},
          {"false_by_cause", false_by_cause(score)},
          {"fragments", score.fragments.size()},
          {"merged", score.merged.size()},
          {"median", median},
          {"p90", p90},
          {"bias", bias},
          {"by_range", by_range(schools)},
          {"by_range_third", thirds_json(range_thirds(score, schools), "from_m", "to_m")},
          {"by_elevation_third", thirds_json(elevation_thirds(score, schools), "from_deg", "to_deg")}};
}

json school_json(const SchoolScore& s) {
  return {{"truth_id", s.truth_id},
          {"found_id", s.found_id.empty() ? json(nullptr) : json(s.found_id)},
          {"inside", number(s.inside)},
          {"n_pings", s.n_pings},
          {"n_unclipped", s.n_unclipped},
          {"counted", s.counted},
          {"range_m", number(s.range_m)},
          {"elevation_deg", number(s.elevation_deg)},
          {"dice", number(s.dice)},
          {"cog_error_m", number(s.cog_error_m)},
          {"volume_ratio", number(s.volume_ratio)},
          {"volume_corrected_ratio", number(s.volume_corrected_ratio)},
          {"length_corrected_ratio", number(s.length_corrected_ratio)},
          {"width_corrected_ratio", number(s.width_corrected_ratio)},
          {"height_corrected_ratio", number(s.height_corrected_ratio)},
          {"backscatter_error_db", number(s.backscatter_error_db)},
          {"sv_error_db", number(s.sv_error_db)},
          {"speed_error_mps", number(s.speed_error_mps)},
          {"purity", number(s.purity)},
          {"merged", s.merged},
          {"fragments", s.fragments},
          {"body_volume_corrected_ratio", number(s.body_volume_corrected_ratio)},
          {"body_backscatter_error_db", number(s.body_backscatter_error_db)},
          {"total_backscatter_error_db", number(s.total_backscatter_error_db)},
          {"body_sv_error_db", number(s.body_sv_error_db)}};
}

std::string cell(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : std::string("-");
}

std::string signed_cell(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:+.{}f}", value, decimals) : std::string("-");
}

/// Signed medians of the errors that depend on where a school is, a line a third.
std::string thirds_text(const Thirds& all, const char* title) {
  struct Column {
    const char* title;
    const char* error;
  };
  constexpr std::array<Column, 8> kColumns = {{{"bsc dB", "backscatter_error_db"},
                                               {"body dB", "body_backscatter_error_db"},
                                               {"total dB", "total_backscatter_error_db"},
                                               {"sv dB", "sv_error_db"},
                                               {"volume", "volume_corrected_ratio_error"},
                                               {"length", "length_corrected_ratio_error"},
                                               {"width", "width_corrected_ratio_error"},
                                               {"height", "height_corrected_ratio_error"}}};
  std::string out = fmt::format("{:<24}{:>8}", title, "schools");
  for (const Column& column : kColumns) out += fmt::format("{:>9}", column.title);
  out += "\n";
  for (const Third& third : all) {
    out += fmt::format("{:<24}{:>8}", cell(third.from, 0) + " .. " + cell(third.to, 0), third.schools.size());
    for (const Column& column : kColumns) {
      const auto figure = std::find_if(kErrors.begin(), kErrors.end(),
                                       [&](const ErrorFigure& f) { return std::string_view(f.name) == column.error; });
      out += fmt::format("{:>9}", signed_cell(quantile(values_of(third.schools, *figure, false), 0.5), 2));
    }
    out += "\n";
  }
  return out;
}

std::string causes_text(const Score& score) {
  if (score.false_schools.empty()) return "";
  std::vector<std::string> causes;
  for (const auto& [cause, schools] : false_by_cause(score)) causes.push_back(fmt::format("{} {}", cause, schools));
  return fmt::format("false schools by cause: {}\n", fmt::join(causes, ", "));
}

}  // namespace

std::string score_json(const Score& score) {
  json schools = json::array();
  for (const SchoolScore& s : score.schools) schools.push_back(school_json(s));
  json false_schools = json::array();
  for (const FalseSchool& s : score.false_schools) {
    false_schools.push_back({{"found_id", s.found_id},
                             {"n_pings", s.n_pings},
                             {"volume_m3", number(s.volume_m3)},
                             {"sv_mean_db", number(s.sv_mean_db)},
                             {"cause", s.cause},
                             {"cause_share", number(s.cause_share)}});
  }
  json fragments = json::array();
  for (const Fragment& f : score.fragments) {
    fragments.push_back({{"found_id", f.found_id}, {"truth_id", f.truth_id}, {"n_pings", f.n_pings}});
  }
  json merged = json::array();
  for (const MergedTrack& m : score.merged) merged.push_back({{"found_id", m.found_id}, {"truth_ids", m.truth_ids}});
  const json out = {{"schools", schools},
                    {"false_schools", false_schools},
                    {"fragments", fragments},
                    {"merged", merged},
                    {"summary", summary_json(score)}};
  return out.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

std::string score_text(const Score& score) {
  std::string out = fmt::format("{:<14}{:<14}{:>6}{:>6}{:>8}{:>7}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>9}{:>9}{:>9}\n",
                                "truth", "found", "pings", "whole", "range", "dice", "cog", "volume", "bsc dB", "sv dB",
                                "speed", "purity", "body vol", "body dB", "body Sv");
  for (const SchoolScore& s : score.schools) {
    out += fmt::format("{:<14}{:<14}{:>6}{:>6}{:>8}{:>7}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>9}{:>9}{:>9}{}\n", s.truth_id,
                       s.found_id.empty() ? "-" : s.found_id, s.n_pings, s.n_unclipped, cell(s.range_m, 0),
                       cell(s.dice, 3), cell(s.cog_error_m, 2), cell(s.volume_ratio, 3),
                       cell(s.backscatter_error_db, 2), cell(s.sv_error_db, 2), cell(s.speed_error_mps, 2),
                       cell(s.purity, 2), cell(s.body_volume_corrected_ratio, 3), cell(s.body_backscatter_error_db, 2),
                       cell(s.body_sv_error_db, 2), s.counted ? "" : "  (does not count)");
  }
  for (const FalseSchool& s : score.false_schools) {
    out += fmt::format("{:<14}{:<14}{:>6}  is no true school; cause: {}\n", "-", s.found_id, s.n_pings, s.cause);
  }
  for (const Fragment& f : score.fragments) {
    out += fmt::format("{:<14}{:<14}{:>6}  is a fragment\n", f.truth_id, f.found_id, f.n_pings);
  }
  for (const MergedTrack& m : score.merged) {
    out += fmt::format("{:<14}{:<14}{:>6}  holds {}\n", "-", m.found_id, "", fmt::join(m.truth_ids, " and "));
  }
  const std::vector<SchoolScore> schools = counted(score);
  const Basics b = basics(schools);
  out += fmt::format(
      "\n{} of {} schools that count found ({} %), mean Dice {}, least purity {}, {} false, {} fragments, {} merged\n",
      b.found, b.counted, cell(100.0 * b.found_fraction, 1), cell(b.mean_dice, 3), cell(b.min_purity, 2),
      score.false_schools.size(), score.fragments.size(), score.merged.size());
  out += causes_text(score);
  out += fmt::format("{:<36}{:>10}{:>10}{:>10}\n", "size of the error", "median", "90 %", "bias");
  for (const ErrorFigure& figure : kErrors) {
    out +=
        fmt::format("{:<36}{:>10}{:>10}{:>10}\n", figure.name, cell(quantile(values_of(schools, figure, true), 0.5), 3),
                    cell(quantile(values_of(schools, figure, true), 0.9), 3),
                    cell(quantile(values_of(schools, figure, false), 0.5), 3));
  }
  out += "\n" + thirds_text(range_thirds(score, schools), "bias by range, m");
  out += thirds_text(elevation_thirds(score, schools), "bias by elevation, deg");
  return out;
}

}  // namespace sonar
