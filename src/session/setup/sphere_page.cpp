// SPDX-License-Identifier: Apache-2.0
#include "session/setup/sphere_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/within_memory.h"
#include "pipeline/calibrate/sphere_report.h"
#include "publish/setup_pictures.h"
#include "session/looks/screen_theme.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTables = "Calibrations (*.csv *.CSV);;All files (*)";
static_assert(kSphereSolidNames.size() == kSphereMaterialCount);

/// "WC38.1" as it is typed into the fields; `own` leaves them.
SphereAsked with_preset(SphereAsked asked) {
  const auto sphere = sphere_size(kSpherePresetNames[static_cast<std::size_t>(asked.sphere)]);
  if (!sphere) return asked;
  asked.material = static_cast<SphereSolid>(sphere->material);
  asked.diameter_mm = sphere->diameter_mm;
  return asked;
}

}  // namespace

SpherePage::SpherePage(AppModel& app)
    : LivePicture(app.workspace),
      app_(app),
      asked_(app.workspace.queue),
      look_(app.workspace.queue),
      paths_(app.workspace.document.paths()) {
  listening_.to(asked_, [this] { follow_preset(); });
  listening_.to(look_, [this] { update(); });
  listening_.to(app.workspace.dark.changed(), [this] { update(); });
  listening_.to(app.workspace.document.changes(), [this](DocumentChange) { changed().tell(); });
}

SpherePage::~SpherePage() { stop(); }

/// A preset sets the fields; fields that are no longer the preset's are one's own.
void SpherePage::follow_preset() {
  SphereAsked now = asked_.values();
  if (now.sphere != before_.sphere) {
    now = with_preset(now);
  } else if (now != with_preset(now)) {
    now.sphere = SpherePreset::own;
  }
  before_ = now;
  if (!(now == asked_.values())) asked_.assign(now);
}

std::string SpherePage::material_text() const {
  return sonar::material_text(static_cast<std::size_t>(asked_.values().material));
}

void SpherePage::choose_sphere_run() {
  if (running_ || !app_.dialogs.folder_to_open) return;
  const std::string folder = app_.dialogs.folder_to_open();
  if (folder.empty()) return;
  paths_ = {folder};
  changed().tell();
}

SphereChoice SpherePage::choice() const {
  const SphereAsked& asked = asked_.values();
  SphereChoice out{sphere_name({static_cast<std::size_t>(asked.material), asked.diameter_mm}), asked.range_from_m,
                   asked.range_to_m};
  if (!asked.measured_water) return out;
  out.water = app_.workspace.document.recipe().calibration.water;
  out.water->temperature_c = asked.temperature_c;
  out.water->salinity_psu = asked.salinity_psu;
  out.water->depth_m = asked.depth_m;
  return out;
}

void SpherePage::start() {
  if (running_) return;
  if (paths_.empty()) return tell("no sphere run is chosen: name the folder of its raw files");
  Document& document = app_.workspace.document;
  if (const std::string& stage = document.progress().stage; !stage.empty()) {
    return tell(fmt::format("wait until {} is done, or cancel it", stage));
  }
  running_ = true;
  tell({});
  document.run([&shown_in = queue(), this, here = std::weak_ptr<bool>(here_), choice = choice(), paths = paths_,
                recipe = document.recipe(), cache = document.options().cache](Work& work, const CancelToken&) {
    const auto fitted = [&]() -> Result<std::shared_ptr<const SphereMade>> {
      const auto survey = open_survey(paths, recipe.survey, recipe.navigation, cache, work);
      if (!survey) return pass_on(survey);
      const auto params = sphere_run_params(choice, recipe.calibration.water, *survey);
      if (!params) return pass_on(params);
      auto made = calibrate_by_sphere(*survey, recipe.calibration, *params, work);
      if (!made) return pass_on(made);
      SphereChartData chart = sphere_chart_data(*made, *params);
      return std::make_shared<const SphereMade>(SphereMade{std::move(*made), *params, std::move(chart)});
    };
    // Also where another job has come since: the page must not wait for ever.
    shown_in.post([this, here, made = within_memory(fitted)] {
      if (!here.expired()) end(made);
    });
  });
}

void SpherePage::stop() {
  if (running_) app_.workspace.document.cancel();
}

void SpherePage::end(Result<std::shared_ptr<const SphereMade>> made) {
  running_ = false;
  if (!made) return tell(to_line(made.error()));
  made_ = std::move(*made);
  beam_.reset();
  tell(crossed_text(made_->calibration));
  update();
}

void SpherePage::tell(std::string line) {
  told_ = std::move(line);
  changed().tell();
}

double SpherePage::share() const {
  const Progress& now = app_.workspace.document.progress();
  return running_ && now.total > 0 ? static_cast<double>(now.done) / static_cast<double>(now.total) : 0.0;
}

void SpherePage::ask_and_write() {
  if (!made_ || !app_.dialogs.file_to_save) return;
  const std::string file = app_.dialogs.file_to_save("Write calibration", kTables, "calibration.csv");
  if (file.empty()) return;
  const auto written = [&]() -> Result<void> {
    const fs::path folder = fs::absolute(file).parent_path();
    if (auto outside = require_outside_raw(paths_, folder); !outside) return outside;
    return write_calibration(made_->calibration, file);
  }();
  tell(written ? "written: " + file : to_line(written.error()));
}

bool SpherePage::usable() const {
  const OpenObservationPtr& shown = app_.workspace.document.shown();
  if (!made_ || !shown) return false;
  const auto channels = static_cast<int>(shown->files().config.beams.size());
  return std::all_of(made_->calibration.beams.begin(), made_->calibration.beams.end(),
                     [&](const CalibratedBeam& beam) { return !beam.crossed || beam.after.channel < channels; });
}

void SpherePage::use() {
  if (!usable()) return;
  Document& document = app_.workspace.document;
  document.act(CalibrateCommand{taken_calibration(made_->calibration, document.recipe().calibration),
                                fmt::format("of the sphere {:.1f} mm", made_->params.diameter_mm())});
  tell("the open survey is measured with this calibration; undo takes it back");
}

LivePicture::Build SpherePage::build(const PictureLook& look) {
  if (!made_) return {};
  return [made = made_, style = SphereChartStyle{look_.values(), beam_}, look](PixelSize size, const CancelToken&,
                                                                               const Show& show) -> Result<void> {
    SphereChartData data = made->chart;
    data.words = sphere_words(made->calibration, look.units);
    auto chart = sphere_chart(data, style, size, dock_theme(size, look));
    if (!chart) return pass_on(chart);
    auto sight = std::make_shared<const SphereChart>(std::move(*chart));
    show({sight->frame, std::nullopt, sight});
    return {};
  };
}

void SpherePage::take(const std::shared_ptr<const void>& detail) {
  sight_ = std::static_pointer_cast<const SphereChart>(detail);
}

void SpherePage::pointer(const PointerEvent& event) {
  if (!sight_ || !made_ || event.action != PointerAction::press || event.button != PointerButton::left) return;
  const auto at = sight_->beam_at(made_->chart, event.at);
  beam_ = at == beam_ ? std::nullopt : at;
  update();
}

std::string SpherePage::hint(PixelPoint at) const {
  if (!sight_ || !made_) return {};
  const auto beam = sight_->beam_at(made_->chart, at);
  return beam ? sphere_beam_text(made_->chart.beams[*beam]) : std::string();
}

}  // namespace sonar
