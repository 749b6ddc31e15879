// SPDX-License-Identifier: Apache-2.0
#include "session/words/window_preferences.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include "session/app_parts.h"
#include "session/playing/playback.h"
#include "session/recipes/control_panel.h"

namespace sonar {
namespace {

bool is_dark(const AppModel& app, ThemeName theme) {
  if (theme == ThemeName::system) return app.dialogs.system_is_dark && app.dialogs.system_is_dark();
  return theme == ThemeName::dark;
}

/// What was changed elsewhere since, by a key say, is no wish of the preferences.
void follow(AppModel& app, const WindowParams& before, const WindowParams& now) {
  if (now.theme != before.theme) app.workspace.dark.set(is_dark(app, now.theme));
  if (now.memory_gb != before.memory_gb) {
    app.workspace.document.use_memory(static_cast<std::uint64_t>(now.memory_gb * 1e9));
  }
  if (now.play_rate != before.play_rate) app.playback->set_rate(now.play_rate);
  if (now.play_loop != before.play_loop) app.playback->set_loops(now.play_loop);
}

std::vector<PanelSection::Note> sentences(const ParameterSource& source, const std::vector<std::string>& names) {
  std::vector<PanelSection::Note> notes;
  for (const Property& one : source.properties()) {
    for (const std::string& name : names) {
      if (one.name == name) notes.push_back({name, [sentence = one.tooltip] { return sentence; }});
    }
  }
  return notes;
}

}  // namespace

std::vector<PanelSection> preference_pages(AppModel& app) {
  const auto window = std::make_shared<SourceOf<WindowParams>>(app.workspace.window);
  const auto page = [](std::string title, std::shared_ptr<ParameterSource> source, std::vector<std::string> names) {
    auto notes = sentences(*source, names);
    return PanelSection{std::move(title), std::move(source), std::move(names), std::move(notes)};
  };
  std::vector<PanelSection> pages{page("Appearance", window, {"theme", "text_size_percent"}),
                                  colours_section(app.workspace), page("Playback", window, {"play_rate", "play_loop"}),
                                  page("Memory", window, {"memory_gb"}),
                                  page("Units", window, {"length_unit", "speed_unit"})};
  pages[2].looks = {{"play_rate", "real time", {0.0, 20.0}}};
  pages[3].looks = {{"memory_gb", "automatic", {0.0, 64.0}}};
  return pages;
}

void change_preferences(AppModel& app) {
  if (!app.dialogs.preferences) return;
  const WindowParams window = app.workspace.window.values();
  const DisplayParams display = app.workspace.display.values();
  const auto keys = app.actions.changed_keys();
  if (app.dialogs.preferences()) {
    app.preferences.keys = app.actions.changed_keys();
    return keep_preferences(app);
  }
  app.workspace.window.assign(window);
  app.workspace.display.assign(display);
  app.actions.take_keys(keys);
}

void add_window_preferences(AppModel& app) {
  Workspace& workspace = app.workspace;
  // What a key has changed comes here later, when another may have been pressed: it is followed already.
  const auto followed = std::make_shared<WindowParams>();
  app.listening.to(workspace.window.changed(), [&app, followed](const WindowParams& now) {
    const WindowParams before = std::exchange(*followed, now);
    follow(app, before, now);
  });
  app.listening.to(workspace.dark.changed(), [&app, followed] {
    WindowParams params = app.workspace.window.values();
    if (is_dark(app, params.theme) == app.workspace.dark()) return;
    followed->theme = params.theme = app.workspace.dark() ? ThemeName::dark : ThemeName::light;
    app.workspace.window.assign(params);
  });
  app.listening.to(app.playback->changed(), [&app, followed] {
    WindowParams params = app.workspace.window.values();
    const double rate = app.playback->rate();
    const bool kept = !std::isfinite(rate) || rate == params.play_rate;  // as fast as possible is for now
    if (kept && app.playback->loops() == params.play_loop) return;
    if (!kept) followed->play_rate = params.play_rate = rate;
    followed->play_loop = params.play_loop = app.playback->loops();
    app.workspace.window.assign(params);
  });
  app.actions.add({.id = "edit.preferences",
                   .menu = "&Edit",
                   .text = "Preferences...",
                   .keys = {"Ctrl+,"},
                   .tip = "Theme, colours, text size, keys, playback, memory and units",
                   .run = [&app] { change_preferences(app); }});
}

}  // namespace sonar
