// SPDX-License-Identifier: Apache-2.0
#include "session/charts/chart_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/number_text.h"
#include "pipeline/tasks/survey_numbers.h"
#include "session/looks/screen_theme.h"
#include "session/looks/selection.h"
#include "session/open/survey_schools.h"

namespace sonar {
namespace {

constexpr double kStill_px = 3.0;    ///< a hand that clicks moves so far
constexpr double kReach_px = 8.0;    ///< of a pointer
constexpr double kRing_px = 7.0;     ///< round the ping on show
constexpr double kWheelStep = 1.25;  ///< of one notch

/// Everything that a chart shows, as it was when the picture was asked for.
struct ChartWish {
  std::vector<std::size_t> observations;
  std::vector<ProductPtr> products;  ///< of these
  std::vector<SurveyNumber> numbers;
  bool all_measured = false;
  ChartQuestion question;
  ChartStyle style;
  PictureLook look;
};

/// The products' tables alone, with the numbers in the survey that results would have.
std::vector<ObservationProduct> tables_of(const ChartWish& wish) {
  std::vector<ObservationProduct> tables;
  for (const ProductPtr& product : wish.products) {
    ObservationProduct& one = tables.emplace_back();
    one.observation = product->observation;
    one.title = product->title;
    one.source = product->source;
    one.schools = product->schools;
    one.school_pings = product->school_pings;
  }
  number_known(tables, wish.numbers, wish.all_measured);
  return tables;
}

std::pair<double, double> zoomed_about(double low, double high, double share, double factor) {
  const double at = low + share * (high - low);
  return {at + (low - at) / factor, at + (high - at) / factor};
}

/// Rounding would show sooner than anything new.
bool can_be_read(double low, double high) {
  return high - low > 1e-9 * std::max({1e-12, std::abs(low), std::abs(high)});
}

std::string bar_text(const ChartData& data, const ChartPlaces::Bar& bar) {
  std::set<ChartSchool> schools;
  for (const std::size_t row : bar.rows) schools.insert(data.rows[row].school);
  std::string text = fmt::format("{} {} to {}\n{}", column_words(data.x), column_text(data.x, bar.from),
                                 column_text(data.x, bar.to), count_of(bar.rows.size(), data.row_word()));
  if (data.table == ChartTable::school_pings) text += " of " + count_of(schools.size(), "school");
  return text;
}

}  // namespace

SchoolName ChartSight::name_of(std::size_t row) const {
  const ChartSchool& school = data.rows[row].school;
  return {observations[school.observation], school.number};
}

ChartModel::ChartModel(Workspace& workspace)
    : LivePicture(workspace), workspace_(workspace), asked_(workspace.picture_file.values().kind.chart) {
  listening_.to(workspace.document.changes(), [this](DocumentChange change) { hear(change); });
  listening_.to(workspace.school.changed(), [this] {
    drag_.reset();  // whatever selects something else, Esc among it, ends what is being drawn
    update();
  });
  listening_.to(workspace.chosen_schools.changed(), [this] { update(); });
  listening_.to(workspace.display, [this] { update(); });
  listening_.to(workspace.dark.changed(), [this] { update(); });
  listening_.to(workspace.picture_file, [this] { parameters_changed(); });
}

void ChartModel::hear(DocumentChange change) {
  switch (change) {
    case DocumentChange::survey:
      sight_.reset();
      shown_.reset();
      drag_.reset();
      pan_.reset();
      return update();
    case DocumentChange::observation:
    case DocumentChange::state:
    case DocumentChange::measures:
      return update();
    case DocumentChange::looking:
    case DocumentChange::ping:
      return changed().tell();  // the ring round the ping is an overlay
    case DocumentChange::propagating:
    case DocumentChange::glance:
    case DocumentChange::progress:
    case DocumentChange::notice:
      return;
  }
}

void ChartModel::parameters_changed() {
  const ChartParams& asked = workspace_.picture_file.values().kind.chart;
  if (asked == asked_) return;
  asked_ = asked;
  shown_.reset();
  drag_.reset();
  pan_.reset();
  update();
}

LivePicture::Build ChartModel::build(const PictureLook& look) {
  const Document& document = workspace_.document;
  ChartWish wish;
  bool any = false;
  for (const auto& [index, state] : document.choices().states) {
    const ProductPtr product = document.product(index);
    if (!product) continue;
    any = any || !product->schools.empty();
    wish.observations.push_back(index);
    wish.products.push_back(product);
  }
  if (!any) {
    sight_.reset();
    return {};
  }
  const std::set<SchoolName> selected = selection(workspace_);
  for (std::size_t i = 0; i < wish.observations.size(); ++i) {
    for (const SchoolName& name : selected) {
      if (name.observation == wish.observations[i]) wish.style.selected.insert({i, name.number});
    }
  }
  wish.numbers = document.survey_numbers();
  wish.all_measured = document.all_measured();
  wish.question = {asked_.table, asked_.x, asked_.y, workspace_.display.values().rejected, look.units};
  wish.style.bins = asked_.bins;
  wish.style.shown = shown_;
  wish.style.brief = true;
  wish.style.reach_px = kReach_px * look.scale;
  wish.look = look;
  return [wish = std::move(wish)](PixelSize size, const CancelToken&, const Show& show) -> Result<void> {
    auto data = chart_data(tables_of(wish), wish.question);
    if (!data) return pass_on(data);
    auto made = chart(*data, wish.style, size, dock_theme(size, wish.look));
    if (!made) return pass_on(made);
    auto sight = std::make_shared<ChartSight>(
        ChartSight{std::move(*data), std::move(made->places), made->whole, wish.observations});
    show({std::move(made->frame), std::nullopt, std::move(sight)});
    return {};
  };
}

void ChartModel::take(const std::shared_ptr<const void>& detail) {
  sight_ = std::static_pointer_cast<const ChartSight>(detail);
}

void ChartModel::pointer(const PointerEvent& event) {
  if (!in_sight()) return;
  switch (event.action) {
    case PointerAction::press:
      return press(event);
    case PointerAction::move:
      return move(event);
    case PointerAction::release:
      return release();
    case PointerAction::wheel:
      return zoom(event.at, std::pow(kWheelStep, event.wheel_steps));
    case PointerAction::pan:
      if (!shown_) return;  // all of it is there
      pan_ = Pan{{}, part()};
      pan_to(event.by);
      return pan_.reset();
    case PointerAction::zoom:
      return zoom(event.at, event.factor);
    case PointerAction::double_press:
      return show_all();
    case PointerAction::leave:
      return;
  }
}

void ChartModel::press(const PointerEvent& event) {
  if (event.button == PointerButton::left) drag_ = Drag{event.at, event.at, event.shift, false};
  if (event.button == PointerButton::middle) pan_ = Pan{event.at, part()};
}

void ChartModel::move(const PointerEvent& event) {
  if (event.button == PointerButton::middle) return pan_to(event.at);
  pan_.reset();
  if (event.button != PointerButton::left) drag_.reset();
  if (!drag_) return;
  drag_->to = event.at;
  const double away = std::hypot(drag_->to.x - drag_->from.x, drag_->to.y - drag_->from.y);
  drag_->moved = drag_->moved || away > kStill_px * scale();
  changed().tell();
}

void ChartModel::release() {
  pan_.reset();
  if (!drag_) return;
  const Drag drag = *std::exchange(drag_, std::nullopt);
  changed().tell();
  if (!drag.moved) return click(drag.from);
  select(rows_within(sight_->places, drag.from, drag.to), drag.adds);
}

/// The first of them becomes the school that views and acts are about, unless the one that is belongs to them.
void ChartModel::select(const std::vector<std::size_t>& rows, bool adds) {
  std::set<SchoolName> names = adds ? selection(workspace_) : std::set<SchoolName>{};
  const std::shared_ptr<const ChartSight> sight = sight_;  // what follows may bring another picture
  for (const std::size_t row : rows) names.insert(sight->name_of(row));
  const auto& now = workspace_.school();
  if (names.empty()) {
    workspace_.school.set(std::nullopt);
  } else if (!now || !names.contains(*now)) {
    workspace_.school.set(*names.begin());
  }
  workspace_.chosen_schools.set(names.size() > 1 ? names : std::set<SchoolName>{});
}

void ChartModel::click(PixelPoint at) {
  if (const auto row = row_at(sight_->places, at)) return go_to_row(*row);
  const ChartPlaces::Bar* bar = bar_at(sight_->places, at);
  select(bar == nullptr ? std::vector<std::size_t>{} : bar->rows, false);
}

void ChartModel::go_to_row(std::size_t row) {
  const SchoolName name = sight_->name_of(row);
  const std::int64_t ping = sight_->data.rows[row].ping_index;
  workspace_.chosen_schools.set({});
  if (ping >= 0) {
    go_to_ping(workspace_, name.observation, ping);
    return workspace_.school.set(name);
  }
  workspace_.school.set(name);
  if (const auto school = selected_school(workspace_)) go_to_school(workspace_, *school);
}

bool ChartModel::aim(PixelPoint at) {
  const auto row = in_sight() ? row_at(sight_->places, at) : std::nullopt;
  // Schools that were brushed stay what the menu is about, wherever it opens.
  if (row) workspace_.school.set(sight_->name_of(*row));
  return true;
}

void ChartModel::show_all() {
  drag_.reset();
  pan_.reset();
  if (!shown_) return;
  shown_.reset();
  update();
}

void ChartModel::zoom(PixelPoint at, double factor) {
  const PlotFrame& plot = sight_->places.plot;
  if (!inside(plot.place, at)) return;
  const ChartPart now = part();
  const double right = (at.x - plot.place.x) / plot.place.width;
  const double down = (at.y - plot.place.y) / plot.place.height;
  const auto [x_low, x_high] = zoomed_about(now.x_low, now.x_high, right, factor);
  const auto [y_low, y_high] =
      zoomed_about(now.y_low, now.y_high, plot.y.first < plot.y.last ? down : 1.0 - down, factor);
  const ChartPart& whole = sight_->whole;
  if (x_high - x_low >= whole.x_high - whole.x_low && y_high - y_low >= whole.y_high - whole.y_low) return show_all();
  if (!can_be_read(x_low, x_high) || !can_be_read(y_low, y_high)) return;
  shown_ = ChartPart{x_low, x_high, y_low, y_high};
  update();
}

void ChartModel::pan_to(PixelPoint at) {
  if (!pan_) return;
  const PlotFrame& plot = sight_->places.plot;
  const ChartPart& part = pan_->part;
  const double x = (pan_->from.x - at.x) / plot.place.width * (part.x_high - part.x_low);
  const double down = (pan_->from.y - at.y) / plot.place.height * (part.y_high - part.y_low);
  const double y = plot.y.first < plot.y.last ? down : -down;
  shown_ = ChartPart{part.x_low + x, part.x_high + x, part.y_low + y, part.y_high + y};
  update();
}

std::vector<Overlay> ChartModel::overlays() const {
  std::vector<Overlay> out;
  if (!in_sight()) return out;
  if (drag_ && drag_->moved) {
    const auto& [from, to] = std::pair(drag_->from, drag_->to);
    Overlay rubber;
    rubber.line = {from, {to.x, from.y}, to, {from.x, to.y}, from};
    out.push_back(std::move(rubber));
  }
  const auto& shown = workspace_.document.shown();
  if (!shown || !workspace_.school() || workspace_.school()->observation != shown->index()) return out;
  for (std::size_t row = 0; row < sight_->places.points.size(); ++row) {
    const PixelPoint at = sight_->places.points[row];
    if (sight_->data.rows[row].ping_index != workspace_.document.ping() || std::isnan(at.x)) continue;
    if (sight_->name_of(row) == *workspace_.school()) {
      Overlay ring;
      ring.circle_at = at;
      ring.circle_px = kRing_px * scale();
      out.push_back(std::move(ring));
    }
  }
  return out;
}

std::string ChartModel::hint(PixelPoint at) const {
  if (!in_sight()) return {};
  const ChartData& data = sight_->data;
  if (const ChartPlaces::Bar* bar = bar_at(sight_->places, at)) return bar_text(data, *bar);
  const auto row = row_at(sight_->places, at);
  if (!row || !data.y) return {};
  const ChartRow& one = data.rows[*row];
  std::string text =
      data.observations[one.school.observation] + ", " + title_of(workspace_.document, sight_->name_of(*row));
  if (one.ping_index >= 0) text += fmt::format(", ping {}", one.ping_index);
  for (const auto& [column, value] :
       {std::pair(data.x, data.x_values[*row]), std::pair(*data.y, data.y_values[*row])}) {
    text += fmt::format("\n{}: {}", column_words(column), column_text(column, value));
  }
  return text;
}

}  // namespace sonar
