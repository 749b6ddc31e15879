// SPDX-License-Identifier: Apache-2.0
#include "session/figures/figure_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/time.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/survey/survey.h"
#include "publish/picture_output.h"
#include "session/figures/figure_drawing.h"
#include "view/maps/map_items.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFirstPanels = "top_slice,side_slice,volume,observation_map";

/// What shows all observations.
bool of_survey(const std::string& id) { return id.starts_with("survey") || id == "chart"; }

}  // namespace

FigureModel::FigureModel(AppModel& app)
    : LivePicture(app.workspace), app_(app), drawn_(std::make_shared<DrawnPanels>()) {
  Workspace& workspace = app.workspace;
  if (chosen().empty()) set_chosen(panel_names(kFirstPanels));
  before_ = workspace.figure.values();
  listening_.to(workspace.figure, [this] { follow_parameters(); });
  listening_.to(workspace.dark.changed(), [this] { update(); });
  for (PictureDock& dock : app.pictures) {
    listening_.to(dock.picture->outdated(), [this, picture = dock.picture.get()] {
      if (picture->on_page()) again();
    });
  }
  look_at_chosen();
}

FigureModel::~FigureModel() {
  for (PictureDock& dock : app_.pictures) dock.picture->set_on_page(false);
}

/// Many pictures change at once: the page follows once.
void FigureModel::again() {
  queue().post_latest("figure", [this, here = std::weak_ptr<bool>(here_)] {
    if (!here.expired()) update();
  });
}

std::vector<FigurePanelName> FigureModel::chosen() const {
  std::vector<FigurePanelName> names = panel_names(app_.workspace.figure.values().panels);
  std::erase_if(names, [this](const FigurePanelName& one) { return app_.picture(one.name) == nullptr; });
  return names;
}

void FigureModel::set_chosen(const std::vector<FigurePanelName>& names) {
  FigureParams params = app_.workspace.figure.values();
  params.panels = panels_text(names);
  app_.workspace.figure.assign(std::move(params));
}

std::vector<FigureChoice> FigureModel::choices() const {
  std::vector<FigureChoice> out;
  const auto title_of = [this](const std::string& id) {
    const auto dock =
        std::find_if(app_.pictures.begin(), app_.pictures.end(), [&](const auto& d) { return d.id == id; });
    return dock->title;
  };
  const std::vector<FigurePanelName> names = chosen();
  for (const FigurePanelName& one : names) out.push_back({one.name, title_of(one.name), true, one.wide});
  for (const PictureDock& dock : app_.pictures) {
    const bool on = std::any_of(names.begin(), names.end(), [&](const auto& one) { return one.name == dock.id; });
    if (!on) out.push_back({dock.id, dock.title, false, false});
  }
  return out;
}

void FigureModel::choose(const std::string& id, bool on) {
  std::vector<FigurePanelName> names = chosen();
  const auto gone = std::erase_if(names, [&](const FigurePanelName& one) { return one.name == id; });
  if (on == (gone > 0)) return;
  if (on) names.push_back({id, false});
  set_chosen(names);
}

void FigureModel::set_wide(const std::string& id, bool wide) {
  std::vector<FigurePanelName> names = chosen();
  for (FigurePanelName& one : names) {
    if (one.name == id) one.wide = wide;
  }
  set_chosen(names);
}

void FigureModel::move(const std::string& id, int by) {
  std::vector<FigurePanelName> names = chosen();
  const auto at = std::find_if(names.begin(), names.end(), [&](const auto& one) { return one.name == id; });
  const std::ptrdiff_t to = at - names.begin() + by;
  if (at == names.end() || to < 0 || to >= static_cast<std::ptrdiff_t>(names.size())) return;
  std::iter_swap(at, names.begin() + to);
  set_chosen(names);
}

/// A paper that was chosen sets its size; a size that is no longer the paper's is one's own.
void FigureModel::follow_parameters() {
  FigureParams now = app_.workspace.figure.values();
  const FigureSize given{now.width_mm, now.height_mm, now.margin_mm};
  const FigureSize paper = size_of(now.paper, given);
  if (now.paper != before_.paper) {
    now.width_mm = paper.width_mm;
    now.height_mm = paper.height_mm;
    now.margin_mm = paper.margin_mm;
  } else if (paper != given) {
    now.paper = FigurePaper::own;
  }
  if (now.panels != before_.panels || now.text_pt != before_.text_pt || now.columns != before_.columns) {
    legend_ = true;
    legend_tried_ = false;
  }
  before_ = now;
  if (now != app_.workspace.figure.values()) app_.workspace.figure.assign(now);
  look_at_chosen();
  written_.clear();
  update();
}

void FigureModel::look_at_chosen() {
  const std::vector<FigurePanelName> names = chosen();
  for (PictureDock& dock : app_.pictures) {
    dock.picture->set_on_page(
        std::any_of(names.begin(), names.end(), [&](const auto& one) { return one.name == dock.id; }));
  }
}

/// "obs-0001, ping 12, 2020-01-04 08:00:50 UTC".
std::string FigureModel::source() const {
  const Document& document = app_.workspace.document;
  const OpenObservationPtr& shown = document.shown();
  if (!shown) return {};
  const bool wanted = app_.workspace.figure.values().source;
  const std::string title = shown->title();
  // That nobody has recorded the data is said in any case.
  if (!wanted) return title.find("SYNTHETIC") != std::string::npos ? "SYNTHETIC data" : "";
  const std::int64_t ping = document.staged() ? document.staged()->ping_index : document.ping();
  const TimeNs time = shown->files().navigation[static_cast<std::size_t>(ping)].time;
  return fmt::format("{}, ping {}, {} UTC", title, ping, clock_text(time, true));
}

PictureOrigin FigureModel::origin(const std::vector<FigurePanelName>& names) const {
  const Document& document = app_.workspace.document;
  PictureOrigin out{
      "Sonar Explorer " + document.options().program_version, recipe_hash(document.measuring_recipe()), {}};
  const bool all = std::any_of(names.begin(), names.end(), [](const auto& one) { return of_survey(one.name); });
  TimeNs first = 0;
  TimeNs last = 0;
  const auto take = [&](const ObservationFiles& one) {
    if (one.navigation.empty()) return;
    first = first == 0 ? one.navigation.front().time : std::min(first, one.navigation.front().time);
    last = std::max(last, one.navigation.back().time);
  };
  if (!all && document.shown()) take(document.shown()->files());
  if (all && document.survey() != nullptr) {
    for (const ObservationFiles& one : document.survey()->observations) take(one);
  }
  if (first != 0) out.data_time = iso_time(first) + "/" + iso_time(last);
  return out;
}

LivePicture::Build FigureModel::build(const PictureLook& look) {
  page_.reset();
  ++wishes_;
  const std::vector<FigurePanelName> names = chosen();
  FigureJob job;
  job.params = app_.workspace.figure.values();
  job.source = source();
  job.legend = legend_;
  job.origin = origin(names);
  job.behind = look.dark ? Rgba8{58, 64, 72, 255} : Rgba8{200, 205, 210, 255};
  job.drawn = drawn_;
  job.wish = wishes_;
  auto layout = figure_layout(job.params, names, legend_, job.source);
  if (!layout) {
    return [error = layout.error()](PixelSize, const CancelToken&, const Show&) -> Result<void> {
      return fail(error.code, error.text);
    };
  }
  job.layout = std::move(*layout);
  const PanelDrawing drawing = panel_drawing(job.params);
  const std::vector<FigureChoice> titles = choices();
  for (std::size_t i = 0; i < names.size(); ++i) {
    LivePicture& picture = *app_.picture(names[i].name);
    FigureJob::Panel& panel = job.panels.emplace_back();
    panel.id = names[i].name;
    panel.title = titles[i].title;
    panel.look = {drawing.size_in(job.layout.panels[i]), drawing.dots_per_inch / 96.0, job.params.dark, drawing.look,
                  look.units};
    panel.version = picture.version();
    panel.refines = picture.refines();
    panel.draw = picture.panel(panel.look);
    panel.why_empty = idle_text(app_, names[i].name);
  }
  return [job = std::move(job)](PixelSize size, const CancelToken& token, const Show& show) {
    return draw_figure(job, size, token, [&show](FrameDescription preview, std::shared_ptr<const DrawnFigure> figure) {
      show({std::move(preview), std::nullopt, std::move(figure)});
    });
  };
}

void FigureModel::take(const std::shared_ptr<const void>& detail) {
  const auto drawn = std::static_pointer_cast<const DrawnFigure>(detail);
  if (!drawn->done || drawn->wish != wishes_) return;
  if (drawn->bars != legend_ && !(legend_tried_ && legend_)) {
    // Room that nothing needs is given to the panels; where bars come up then, it is kept for good.
    legend_tried_ = true;
    legend_ = drawn->bars;
    return again();
  }
  page_ = std::shared_ptr<const FrameDescription>(drawn, &drawn->page);
}

std::string FigureModel::told() const {
  if (!problem().empty()) return {};  // the preview says it
  if (!page_) return "drawing...";
  for (const FigurePanelName& one : chosen()) {
    if (const std::string why = app_.picture(one.name)->incomplete(); !why.empty()) return why;
  }
  return written_;
}

void FigureModel::ask_and_write() {
  if (!page_ || !app_.dialogs.file_to_save) return;
  const auto page = page_;  // what is seen now
  const OpenObservationPtr& shown = app_.workspace.document.shown();
  const std::string name = (shown ? shown->name() + "-" : std::string()) + "figure.png";
  const std::string file = app_.dialogs.file_to_save("Write figure", "Pictures (*.png *.svg *.pdf)", name);
  if (!file.empty()) write(page, file);
}

void FigureModel::write(const fs::path& file) {
  if (page_) write(page_, file);
}

void FigureModel::write(const std::shared_ptr<const FrameDescription>& page, const fs::path& file) {
  Document& document = app_.workspace.document;
  const auto tell = [this](const std::string& line) {
    written_ = line;
    app_.workspace.document.tell(line);
    changed().tell();
  };
  if (document.survey() != nullptr) {
    if (auto outside = require_outside_raw(*document.survey(), fs::absolute(file).parent_path()); !outside) {
      return tell(to_line(outside.error()));
    }
  }
  document.run_beside([&document, page, file, tell, here = std::weak_ptr<bool>(here_)](const CancelToken& token) {
    const auto written = write_picture(*page, file);
    document.post(token,
                  [&document, tell, here, line = written ? "written: " + file.string() : to_line(written.error())] {
                    here.expired() ? document.tell(line) : tell(line);
                  });
  });
}

}  // namespace sonar
