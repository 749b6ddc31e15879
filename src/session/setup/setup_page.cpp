// SPDX-License-Identifier: Apache-2.0
#include "session/setup/setup_page.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

#include "publish/setup_pictures.h"
#include "session/live/live_watch.h"
#include "session/looks/screen_theme.h"

namespace sonar {
namespace {

double rounded(double value, double step) { return std::round(value / step) * step; }

}  // namespace

SetupPage::SetupPage(AppModel& app) : LivePicture(app.workspace), app_(app) {
  listening_.to(app.workspace.dark.changed(), [this] { update(); });
  listening_.to(app.workspace.document.changes(), [this](DocumentChange change) {
    if (change == DocumentChange::survey || change == DocumentChange::measures) {
      sight_.reset();
      update();
    }
  });
  app.workspace.document.open_all();
}

LivePicture::Build SetupPage::build(const PictureLook& look) {
  const Document& document = app_.workspace.document;
  if (document.survey() == nullptr) return {};
  std::vector<ProductPtr> products;
  for (std::size_t i = 0; i < document.survey()->observations.size(); ++i) {
    if (auto product = document.product(i)) products.push_back(std::move(product));
  }
  if (products.empty()) return {};
  return [products = std::move(products), look](PixelSize size, const CancelToken&, const Show& show) -> Result<void> {
    SetupSeen seen;
    for (const ProductPtr& product : products) {
      if (auto taken = seen.take(*product, product->observation); !taken) return pass_on(taken);
    }
    auto report = seen.report({});
    if (!report) return pass_on(report);
    auto sight = std::make_shared<SetupSight>();
    sight->report = std::move(*report);
    sight->data = leg_chart_data(sight->report);
    auto chart = leg_chart(sight->data, size, dock_theme(size, look));
    if (!chart) return pass_on(chart);
    sight->chart = std::move(*chart);
    show({sight->chart.frame, std::nullopt, sight});
    return {};
  };
}

void SetupPage::take(const std::shared_ptr<const void>& detail) {
  sight_ = std::static_pointer_cast<const SetupSight>(detail);
}

std::string SetupPage::told() const {
  const Document& document = app_.workspace.document;
  if (document.survey() == nullptr) return "no survey is open";
  if (!document.unmeasured().empty() && !document.measuring()) return document.unmeasured();
  if (!document.all_measured() || document.measuring()) return "schools are still being measured...";
  if (!document.results().empty()) return "the raw files are not here: their recipe cannot be changed";
  return {};
}

bool SetupPage::proposes() const {
  return sight_ && problem().empty() && sight_->report.check.drift_known && app_.workspace.document.results().empty();
}

Result<void> SetupPage::use(bool mounting_angle, bool sound_speed) {
  if (!proposes() || !(mounting_angle || sound_speed)) return {};
  Document& document = app_.workspace.document;
  Recipe recipe = document.recipe();
  const SetupReport& report = sight_->report;
  if (mounting_angle) {
    recipe.navigation.mounting_azimuth_deg = rounded(report.proposed_mounting_azimuth_deg, 0.01);
  }
  if (sound_speed) {
    recipe.survey.sound_speed_mps = rounded(report.proposed_sound_speed_mps, 0.1);
    recipe.survey.sound_speed_profile.clear();
  }
  if (auto valid = validate_recipe(recipe); !valid) return valid;
  if (document.opening()) return fail(ErrorCode::usage, "a survey is being opened; the proposal is of the one before");
  if (app_.live->on()) app_.live->follow_next();
  document.use_recipe(std::move(recipe));
  document.tell("the survey is opened under the proposed setup; File > Recipe before takes it back");
  return {};
}

std::string SetupPage::hint(PixelPoint at) const {
  if (!sight_) return {};
  const auto leg = sight_->chart.leg_at(sight_->data, at);
  return leg ? leg_text(sight_->data.legs[*leg], app_.workspace.units()) : std::string();
}

}  // namespace sonar
