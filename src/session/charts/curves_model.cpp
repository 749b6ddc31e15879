// SPDX-License-Identifier: Apache-2.0
#include "session/charts/curves_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "pipeline/exports/avoidance.h"
#include "session/looks/screen_theme.h"

namespace sonar {
namespace {

constexpr double kReach_px = 8.0;

using ShowData = std::function<Result<void>(PanelChartData data)>;

SchoolCurves named(const WishedSchool& school, SchoolCurves curves) {
  curves.name = school.title;
  curves.colour = school.colour;
  return curves;
}

SchoolCurves heard_in(const WishedObservation& wished, const LookedAt& there) {
  SchoolCurves part;
  part.add(MaskInPing{*there.mask, there.masks, *there.ping, wished.observation->sector()});
  return part;
}

std::vector<std::string> titles_of(const SchoolWish& wish) {
  std::vector<std::string> out;
  for (const auto& [index, one] : wish.observations) {
    for (const WishedSchool& school : one.schools) out.push_back(school.title);
  }
  return out;
}

/// Errors where no school is in the ping that is asked of.
Result<std::vector<SchoolLook>> looks_in_ping(const SchoolWish& wish) {
  std::vector<SchoolLook> looks = looks_of(wish);
  if (looks.empty()) return fail(ErrorCode::not_found, not_in_ping(titles_of(wish), wish.ping));
  return looks;
}

Result<void> show_distribution(const SchoolWish& wish, HeardSchools<SchoolCurves>& kept, const CancelToken& token,
                               const Theme& theme, const ShowData& show) {
  if (auto there = looks_in_ping(wish); !there) return pass_on(there);
  Hearing<SchoolCurves> heard(wish, kept, heard_in);
  return heard.run(token, [&](const std::string& words) {
    std::vector<SchoolCurves> schools;
    for (const auto& [index, one] : wish.observations) {
      for (const WishedSchool& school : one.schools) {
        schools.push_back(named(school, heard.sum(index, school.school->number)));
      }
    }
    return show(distribution_chart(schools, "Sv in schools and round them", words, theme));
  });
}

/// Of a school that clicks made in this ping, by a tolerance in dB; empty of any other.
std::optional<GrowthStart> start_at_clicks(const StateSchool& school, std::int64_t ping_index, const BeamGrid& grid) {
  if (!school.grown || school.grown->ping_index != ping_index) return std::nullopt;
  const GrowCommand& command = school.grown->grow;
  if (command.grow.mode != GrowMode::tracked) return std::nullopt;
  GrowthStart start{{}, command.grow.tolerance_db, command.grow.margin_db, command.grow.connectivity};
  const std::vector<int> rows = grid.row_of_channel();
  for (const SeedKey& seed : command.seeds)
    start.seeds.push_back({rows.at(static_cast<std::size_t>(seed.channel)), seed.sample});
  return start;
}

Result<void> grow_again(const WishedObservation& wished, const SchoolLook& look, const std::function<bool()>& go_on,
                        SchoolCurves& to) {
  const auto there = look_at(wished, look);
  if (!there) return pass_on(there);
  // Choices stand on the calibration that they were made under, whatever is measured with.
  OpenObservation& observation = *wished.observation;
  const auto filtered = observation.context().ping(look.ping);
  if (!filtered) return pass_on(filtered);
  auto start = start_at_clicks(*look.school, look.ping, observation.grid());
  to.from_clicks = start.has_value();
  if (!start) {
    const double threshold_db = in_ping(look.school->masks, look.ping)->threshold_db;
    start = start_at_strongest(*there->mask, threshold_db, *filtered->volume, observation.recipe().grow);
  }
  if (!start) return {};
  return to.grow({*there->mask, there->masks, *there->ping, observation.sector()}, *start, *filtered, go_on);
}

Result<void> show_tolerance(const SchoolWish& wish, const CancelToken& token, const Theme& theme,
                            const ShowData& show) {
  const auto looks = looks_in_ping(wish);
  if (!looks) return pass_on(looks);
  std::vector<SchoolCurves> schools;
  GivesWay give_way(wish.way);
  for (const SchoolLook& look : *looks) {
    const WishedObservation& wished = wish.observations.at(look.observation);
    const auto school = std::find_if(wished.schools.begin(), wished.schools.end(),
                                     [&](const WishedSchool& one) { return one.school.get() == look.school; });
    schools.push_back(named(*school, {}));
    give_way();
    // The first is grown to its end, so that something is seen while a hand walks through pings.
    const auto go_on = [&] { return schools.size() == 1 || !token.cancelled(); };
    if (auto grown = grow_again(wished, look, go_on, schools.back()); !grown) return grown;
  }
  if (!any_grew(schools)) return fail(ErrorCode::not_found, why_none_grew(schools, wish.ping));
  return show(tolerance_chart(schools, "Schools over the tolerance", looks_words(wish, *looks, looks->size()), theme));
}

std::string words_of(const ChartPanel& panel, const ChartCurve& curve, const CurvePoint& point) {
  std::string text = curve.name.empty() ? "" : curve.name + "\n";
  text += fmt::format("{}: {:.3g}\n{}: {:.3g}", panel.x_label, point.x, panel.y_label, point.y);
  if (std::isfinite(point.low) && std::isfinite(point.high)) {
    text += fmt::format("\nhalf of the schools: {:.3g} to {:.3g}", point.low, point.high);
  }
  return text;
}

/// Draws what is made of the data, and shows it.
template <class To>
Result<void> show_chart(PanelChartData data, PixelSize size, const Theme& theme, const To& show) {
  auto made = panel_chart(data, size, theme);
  if (!made) return pass_on(made);
  auto sight = std::make_shared<CurvesSight>(CurvesSight{std::move(data), std::move(*made)});
  show({sight->chart.frame, std::nullopt, sight});
  return {};
}

}  // namespace

CurvesModel::CurvesModel(Workspace& workspace)
    : LivePicture(workspace),
      workspace_(workspace),
      asked_(params()),
      heard_(std::make_shared<HeardSchools<SchoolCurves>>()) {
  const auto of_schools = [this] {
    if (params().curve != SchoolCurve::avoidance) update();
  };
  listening_.to(workspace.document.changes(), [this](DocumentChange change) { hear(change); });
  listening_.to(workspace.school.changed(), of_schools);
  listening_.to(workspace.chosen_schools.changed(), of_schools);
  listening_.to(workspace.dark.changed(), [this] { update(); });
  listening_.to(workspace.picture_file, [this] {
    if (params() == asked_) return;
    asked_ = params();
    update();
  });
}

void CurvesModel::hear(DocumentChange change) {
  const SchoolCurve curve = params().curve;
  switch (change) {
    case DocumentChange::survey:
      heard_ = std::make_shared<HeardSchools<SchoolCurves>>();
      sight_.reset();
      return update();
    case DocumentChange::observation:
    case DocumentChange::state:
      return update();
    case DocumentChange::ping:
      if (curve == SchoolCurve::tolerance || (curve == SchoolCurve::distribution && params().one_ping)) update();
      return;
    case DocumentChange::measures:
      if (curve == SchoolCurve::avoidance) update();
      return;
    default:
      return;
  }
}

LivePicture::Build CurvesModel::build(const PictureLook& look) {
  Build made = params().curve == SchoolCurve::avoidance ? build_avoidance(look) : build_of_schools(look);
  if (!made && !look.panel) sight_.reset();
  return made;
}

LivePicture::Build CurvesModel::build_of_schools(const PictureLook& look) const {
  const bool tolerance = params().curve == SchoolCurve::tolerance;
  SchoolWish wish = school_wish(workspace_, look, tolerance || params().one_ping);
  if (wish.observations.empty()) return {};
  return [wish = std::move(wish), tolerance, kept = heard_](PixelSize size, const CancelToken& token,
                                                            const Show& show) -> Result<void> {
    const Theme theme = dock_theme(size, wish.look);
    const auto draw = [&](PanelChartData data) { return show_chart(std::move(data), size, theme, show); };
    return tolerance ? show_tolerance(wish, token, theme, draw) : show_distribution(wish, *kept, token, theme, draw);
  };
}

LivePicture::Build CurvesModel::build_avoidance(const PictureLook& look) const {
  const Document& document = workspace_.document;
  std::vector<ProductPtr> products;
  for (const auto& [index, state] : document.choices().states) {
    const ProductPtr product = document.product(index);
    if (product && !product->schools.empty()) products.push_back(product);
  }
  if (products.empty()) return {};
  return [products = std::move(products), over = params().over, look](PixelSize size, const CancelToken& /*token*/,
                                                                      const Show& show) -> Result<void> {
    std::vector<ObservationProduct> tables;
    for (const ProductPtr& product : products) {
      ObservationProduct& one = tables.emplace_back();
      one.observation = product->observation;
      one.schools = product->schools;
      one.school_pings = product->school_pings;
    }
    const Theme theme = dock_theme(size, look);
    return show_chart(avoidance_chart(avoidance_table(tables), over, "Survey: schools against the ship", theme), size,
                      theme, show);
  };
}

void CurvesModel::take(const std::shared_ptr<const void>& detail) {
  sight_ = std::static_pointer_cast<const CurvesSight>(detail);
}

std::string CurvesModel::hint(PixelPoint at) const {
  if (!sight_ || !problem().empty()) return {};
  const PanelChart::Place* place = sight_->chart.at(at, kReach_px * scale());
  if (place == nullptr) return {};
  const ChartPanel& panel = sight_->data.panels[place->panel];
  const ChartCurve& curve = panel.curves[place->curve];
  return words_of(panel, curve, curve.points[place->point]);
}

}  // namespace sonar
