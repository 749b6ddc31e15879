// SPDX-License-Identifier: Apache-2.0
#include "publish/curves_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/number_text.h"
#include "base/units.h"
#include "model/strongest_ping.h"
#include "pipeline/exports/avoidance.h"
#include "pipeline/stages/fan_response.h"
#include "publish/volumes/drawn_schools.h"
#include "view/colour_bar.h"

namespace sonar {
namespace {

constexpr double kPlateau_db = 1.0;

/// Steps from bin to bin, down to nothing at both ends.
ChartCurve steps_of(const SvHistogram& heard, std::string name, Rgba8 colour, bool muted) {
  ChartCurve out{std::move(name), colour, muted, false, {}};
  if (heard.volume_m3.empty()) return out;
  const int first = heard.volume_m3.begin()->first;
  const int last = heard.volume_m3.rbegin()->first;
  out.points.push_back({static_cast<double>(first), 0.0});
  for (int bin = first; bin <= last; ++bin) {
    const double share = 100.0 * heard.share(bin);
    out.points.push_back({static_cast<double>(bin), share});
    out.points.push_back({bin + 1.0, share});
  }
  out.points.push_back({last + 1.0, 0.0});
  return out;
}

double ratio_db(double value, double of) { return value > 0.0 && of > 0.0 ? db_from_linear(value / of) : kUnknown; }

struct AxisOfShip {
  AgainstShip over;
  std::string_view column;
  std::string_view label;
  std::string_view unit;
};
constexpr std::array<AxisOfShip, 3> kAxes{{{AgainstShip::range, "range_m", "range from the ship", "m"},
                                           {AgainstShip::bearing, "relative_bearing_deg", "bearing from the bow", "°"},
                                           {AgainstShip::time, "time_to_cpa_s", "time to closest approach", "s"}}};

struct PooledFigure {
  std::string_view label;
  std::string_view unit;
  double AvoidanceRow::*low;
  double AvoidanceRow::*median;
  double AvoidanceRow::*high;
  bool downwards = false;
};
using A = AvoidanceRow;
constexpr std::array<PooledFigure, 4> kPooled{
    {{"speed", "m/s", &A::speed_smoothed_p25_mps, &A::speed_smoothed_p50_mps, &A::speed_smoothed_p75_mps},
     {"off straight away", "°", &A::course_away_p25_deg, &A::course_away_p50_deg, &A::course_away_p75_deg},
     {"depth", "m", &A::depth_p25_m, &A::depth_p50_m, &A::depth_p75_m, true},
     {"Sv", "dB re 1 m\u207B\u00B9", &A::sv_mean_p25_db, &A::sv_mean_p50_db, &A::sv_mean_p75_db}}};

/// The schools that are asked for; without any the one with most echo.
std::vector<std::int64_t> chosen_schools(const DrawnObservation& observation, const PictureOptions& options) {
  if (!options.schools.empty()) return options.schools;
  const ObservationProduct& product = observation.product();
  const SchoolPingRow* strongest =
      strongest_ping(product, [&](const SchoolRow& school) { return wanted(product, school.school_id, options); });
  return strongest == nullptr ? std::vector<std::int64_t>{} : std::vector{strongest->school_id};
}

double threshold_of(const ObservationProduct& product, std::int64_t school, std::int64_t ping) {
  for (const SchoolPingRow& row : product.school_pings) {
    if (row.school_id == school && row.ping_index == ping) return row.threshold_db;
  }
  return kUnknown;
}

/// Looks at the pings of an observation's schools.
class Looking {
 public:
  Looking(DrawnObservation& observation, const PictureOptions& options, Work& work)
      : observation_(observation), options_(options), work_(work) {}

  Result<void> look(std::int64_t index, const std::vector<std::int64_t>& schools, const Sector& sector) {
    if (work_.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    const auto ping = observation_.ping(index, work_);
    if (!ping) return pass_on(ping);
    for (const DrawnMask& one : ping->masks) {
      if (std::find(schools.begin(), schools.end(), one.school_id) == schools.end()) continue;
      if (auto looked = look(one, *ping, sector); !looked) return looked;
    }
    return {};
  }
  [[nodiscard]] std::vector<SchoolCurves> made() const {
    std::vector<SchoolCurves> out;
    for (const auto& [id, one] : schools_) out.push_back(one);
    return out;
  }

 private:
  Result<void> look(const DrawnMask& school, const DrawnPing& ping, const Sector& sector) {
    SchoolCurves& to = schools_[school.school_id];
    to.name = fmt::format("school {}", school.school_id);
    to.colour = school_colour(static_cast<int>(school.school_id));
    std::vector<const PingMask*> masks;
    for (const DrawnMask& one : ping.masks) masks.push_back(one.mask.get());
    const MaskInPing in_ping{*school.mask, masks, *ping.staged, sector};
    if (options_.kind.curves.curve == SchoolCurve::distribution) {
      to.add(in_ping);
      return {};
    }
    const double threshold_db = threshold_of(observation_.product(), school.school_id, ping.ping_index);
    const auto start =
        start_at_strongest(*school.mask, threshold_db, *ping.staged->filtered, observation_.recipe().grow);
    if (!start) return {};
    return to.grow(in_ping, *start, observation_.engine()->filtered(*ping.staged),
                   [this] { return !work_.cancelled(); });
  }

  DrawnObservation& observation_;
  const PictureOptions& options_;
  Work& work_;
  std::map<std::int64_t, SchoolCurves> schools_;
};

Result<PanelChartData> school_chart(DrawnObservation& observation, const PictureOptions& options, const Theme& theme,
                                    Work& work) {
  if (!observation.has_raw()) {
    return fail(ErrorCode::not_found,
                "curves of schools are of samples: name the raw files of " + observation.name() + " too");
  }
  if (auto known = require_schools(observation, options); !known) return pass_on(known);
  const auto sector = observation.sector();
  if (!sector) return pass_on(sector);
  const CurvesParams& asked = options.kind.curves;
  const std::vector<std::int64_t> schools = chosen_schools(observation, options);
  std::set<std::int64_t> pings;
  for (const SchoolMask& one : observation.product().masks) {
    if (std::find(schools.begin(), schools.end(), one.school_id) != schools.end()) pings.insert(one.ping_index);
  }
  if (pings.empty()) return fail(ErrorCode::not_found, "there are no schools to make curves of");
  if (asked.one_ping || asked.curve == SchoolCurve::tolerance) {
    const auto index = chosen_ping(observation, options);
    if (!index) return pass_on(index);
    pings = {*index};
  }
  Looking looking(observation, options, work);
  std::int64_t done = 0;
  for (const std::int64_t index : pings) {
    if (auto looked = looking.look(index, schools, *sector); !looked) return pass_on(looked);
    work.progress("curves", ++done, static_cast<std::int64_t>(pings.size()));
  }
  const std::vector<SchoolCurves> made = looking.made();
  std::vector<std::string> names;
  for (const std::int64_t school : schools) names.push_back(fmt::format("school {}", school));
  if (made.empty()) return fail(ErrorCode::not_found, observation.name() + ": " + not_in_ping(names, *pings.begin()));
  if (asked.curve == SchoolCurve::tolerance && !any_grew(made)) {
    return fail(ErrorCode::not_found, observation.name() + ": " + why_none_grew(made, *pings.begin()));
  }
  const std::string words = pings.size() == 1 ? fmt::format("ping {}", *pings.begin())
                                              : fmt::format("{} from {} to {}", count_of(pings.size(), "ping"),
                                                            *pings.begin(), *pings.rbegin());
  return asked.curve == SchoolCurve::distribution
             ? distribution_chart(made, observation.title() + ": Sv in schools and round them", words, theme)
             : tolerance_chart(made, observation.title() + ": schools over the tolerance", words, theme);
}

Result<PanelChartData> pooled_chart(const std::vector<DrawnObservation*>& observations, const PictureOptions& options,
                                    const Theme& theme) {
  std::vector<ObservationProduct> products;
  for (const DrawnObservation* one : observations) {
    products.push_back(with_chosen_schools(one->product(), options));
  }
  const std::string title = observations.size() == 1 ? observations.front()->title() : "Survey";
  return avoidance_chart(avoidance_table(products), options.kind.curves.over, title + ": schools against the ship",
                         theme);
}

/// From what schools with sizes were grown.
std::string grown_words(std::span<const SchoolCurves> schools) {
  const auto by = [&](bool clicks) {
    return std::any_of(schools.begin(), schools.end(),
                       [clicks](const SchoolCurves& one) { return !one.sizes.empty() && one.from_clicks == clicks; });
  };
  if (by(true) && by(false)) return "grown again from the clicks that made it, or from its strongest voxel";
  return by(true) ? "grown again from the clicks that made it" : "grown again from its strongest voxel";
}

/// A level across the panel.
ChartCurve level_of(const SchoolCurves& school, double y) {
  const double first = school.sizes.front().change_db;
  const double last = school.sizes.back().change_db;
  return {school.name + " as it is stored", school.colour, true, false, {{first, y}, {last, y}}};
}

std::string listed(std::span<const std::string> names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

void SchoolCurves::add(const MaskInPing& in_ping) {
  const auto& [mask, masks, ping, sector] = in_ping;
  inside.add(mask, ping, sector);
  outside.add(water_round(mask, masks, ping, sector), ping, sector);
}

void SchoolCurves::add(const SchoolCurves& more) {
  inside.add(more.inside);
  outside.add(more.outside);
}

Result<void> SchoolCurves::grow(const MaskInPing& in_ping, const GrowthStart& start, const FilteredPing& filtered,
                                const std::function<bool()>& go_on) {
  PingMask others;
  for (const PingMask* one : in_ping.masks) {
    if (one != &in_ping.mask) others = unite(others, *one);
  }
  auto grown = growth_sensitivity(start, in_ping.ping, filtered, others, in_ping.sector, tolerance_changes_db(), go_on);
  if (!grown) return pass_on(grown);
  sizes = std::move(*grown);
  stored = echo_of(in_ping.mask, in_ping.ping, in_ping.sector);
  return {};
}

bool any_grew(std::span<const SchoolCurves> schools) {
  return std::any_of(schools.begin(), schools.end(), [](const SchoolCurves& one) { return !one.sizes.empty(); });
}

std::string why_none_grew(std::span<const SchoolCurves> schools, std::int64_t ping_index) {
  std::vector<std::string> names;
  for (const SchoolCurves& one : schools) names.push_back(one.name);
  return fmt::format(
      "{} cannot be grown again in ping {}: no threshold is known there that the mask was made with, as where it was "
      "painted; expected a mask that was detected, grown or followed",
      listed(names), ping_index);
}

std::string not_in_ping(std::span<const std::string> schools, std::int64_t ping_index) {
  return fmt::format("{} {} not in ping {}; expected a ping with a mask of the school", listed(schools),
                     schools.size() == 1 ? "is" : "are", ping_index);
}

std::vector<double> tolerance_changes_db() {
  std::vector<double> out;
  for (int half = -12; half <= 12; ++half) out.push_back(0.5 * half);
  return out;
}

PanelChartData distribution_chart(std::span<const SchoolCurves> schools, std::string title, const std::string& pings,
                                  const Theme& theme) {
  ChartPanel panel{kSvLabel, "share of the volume (% per dB)", 5.0, 5.0, false, {}};
  for (const SchoolCurves& one : schools) {
    panel.curves.push_back(steps_of(one.outside, "water round " + one.name, one.colour, true));
    panel.curves.push_back(steps_of(one.inside, one.name, one.colour, false));
    SvHistogram both = one.inside;
    both.add(one.outside);
    const double background_db = both.background_db();
    if (std::isfinite(background_db)) {
      const Rgba8 colour = schools.size() == 1 ? theme.muted : one.colour;
      panel.marks.push_back({background_db, colour, schools.size() == 1 ? "mean background there" : ""});
    }
  }
  const WaterRound round;
  const Unit unit = theme.units.length();
  return {
      std::move(title),
      "Sv as recorded, weighted by volume, " + pings,
      fmt::format("Water: {} beams and {} round a school, less a gap of {} beam and {}; the background is not taken "
                  "off.",
                  round.beams, round_text(round.range_m, unit), round.gap_beams, round_text(round.gap_m, unit)),
      1,
      {std::move(panel)}};
}

PanelChartData tolerance_chart(std::span<const SchoolCurves> schools, std::string title, const std::string& ping,
                               const Theme& theme) {
  const std::string x = "tolerance, dB more than the one used";
  std::vector<ChartPanel> panels{{x, "volume (dB re that used)", 12.0, 2.0, false, {}},
                                 {x, "backscatter (dB re that used)", 12.0, 2.0, false, {}},
                                 {x, "mean " + std::string(kSvLabel), 12.0, 2.0, false, {}}};
  for (const SchoolCurves& one : schools) {
    const auto used =
        std::find_if(one.sizes.begin(), one.sizes.end(), [](const GrownSize& size) { return size.change_db == 0.0; });
    if (used == one.sizes.end()) continue;
    for (ChartPanel& panel : panels) panel.curves.push_back({one.name, one.colour, false, true, {}});
    for (const GrownSize& size : one.sizes) {
      panels[0].curves.back().points.push_back({size.change_db, ratio_db(size.echo.volume_m3, used->echo.volume_m3)});
      panels[1].curves.back().points.push_back(
          {size.change_db, ratio_db(size.echo.backscatter_m2, used->echo.backscatter_m2)});
      panels[2].curves.back().points.push_back({size.change_db, size.echo.sv_mean_db});
    }
    panels[0].curves.push_back(level_of(one, ratio_db(one.stored.volume_m3, used->echo.volume_m3)));
    panels[1].curves.push_back(level_of(one, ratio_db(one.stored.backscatter_m2, used->echo.backscatter_m2)));
    panels[2].curves.push_back(level_of(one, one.stored.sv_mean_db));
  }
  for (ChartPanel& panel : panels) {
    panel.marks.push_back({0.0, theme.accent, "tolerance used"});
    if (schools.size() != 1) continue;
    if (const auto steady = plateau(schools.front().sizes, kPlateau_db)) {
      panel.stretch = {
          steady->first, steady->second,
          fmt::format("backscatter within {:g} dB: {:+g} to {:+g} dB", kPlateau_db, steady->first, steady->second)};
    }
  }
  return {std::move(title), grown_words(schools) + ", " + ping,
          "From its strongest voxel a school grows down to the threshold that its mask was made with.", 3,
          std::move(panels)};
}

PanelChartData avoidance_chart(std::span<const AvoidanceRow> rows, AgainstShip over, std::string title,
                               const Theme& theme) {
  PanelChartData out{std::move(title),
                     "medians over schools, and quartiles; each school counts once in a bin",
                     "Rejected schools and what may be the ship's own wake are left out.",
                     kPooled.size(),
                     {}};
  for (const AxisOfShip& axis : kAxes) {
    if (over != AgainstShip::all && over != axis.over) continue;
    const Unit x = shown_unit(axis.unit, theme.units);
    for (const PooledFigure& figure : kPooled) {
      const Unit y = shown_unit(figure.unit, theme.units);
      ChartPanel panel{
          with_unit(axis.label, x), with_unit(figure.label, y), x.of(1.0), y.of(0.1), figure.downwards, {}};
      ChartCurve curve{"", theme.accent, false, true, {}};
      for (const AvoidanceRow& row : rows) {
        if (row.against != axis.column) continue;
        curve.points.push_back(
            {x.of(0.5 * (row.from + row.to)), y.of(row.*figure.median), y.of(row.*figure.low), y.of(row.*figure.high)});
      }
      panel.curves.push_back(std::move(curve));
      out.panels.push_back(std::move(panel));
    }
  }
  return out;
}

Result<FrameDescription> curves_frame(const std::vector<DrawnObservation*>& observations, const PictureOptions& options,
                                      Work& work) {
  const Theme theme = theme_of(options);
  const auto data = options.kind.curves.curve == SchoolCurve::avoidance
                        ? pooled_chart(observations, options, theme)
                        : school_chart(*observations.front(), options, theme, work);
  if (!data) return pass_on(data);
  auto made = panel_chart(*data, options.size, theme);
  if (!made) return pass_on(made);
  return std::move(made->frame);
}

}  // namespace sonar
