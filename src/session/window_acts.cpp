// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>

#include "base/manual.h"
#include "session/app_parts.h"
#include "session/open/open_demo.h"

namespace sonar {
namespace {

constexpr const char* kView = "&View";
constexpr const char* kHelp = "&Help";

/// Calls what the window has hung in, if it has.
std::function<void()> asked(AppModel& app, std::function<void()> Dialogs::*what) {
  return [&app, what] {
    if (app.dialogs.*what) (app.dialogs.*what)();
  };
}

Action toggle(const char* id, const char* text, const char* key, const char* tip, Shared<bool>& value) {
  Action action{id, kView, text, {key}, tip, [&value] { value.set(!value()); }};
  action.checked = [&value] { return value(); };
  return action;
}

struct ViewName {
  const char* name;  ///< property of ViewSwitches
  const char* text;
  const char* key;
};
constexpr std::array<ViewName, 15> kViews{{{"top_slice", "Slice from above", "Alt+1"},
                                           {"side_slice", "Slice from the side", "Alt+2"},
                                           {"range_slice", "Range slice", "Alt+9"},
                                           {"plane_slice", "Plane slice", "Alt+0"},
                                           {"volume", "Volume", "Alt+3"},
                                           {"observation_map", "Observation map", "Alt+4"},
                                           {"propagation", "Propagation", "Alt+5"},
                                           {"survey_map", "Survey map", "Alt+6"},
                                           {"timeline", "Timeline", "Alt+7"},
                                           {"echogram", "Echogram", "Alt+8"},
                                           {"chart", "Charts", "Alt+Shift+1"},
                                           {"noise_steps", "Noise steps", "Alt+Shift+2"},
                                           {"frequency", "Schools over frequency", "Alt+Shift+3"},
                                           {"lineage", "Lineage of schools", "Alt+Shift+4"},
                                           {"curves", "Curves of schools", "Alt+Shift+5"}}};

void add_view_switches(AppModel& app) {
  for (const ViewName& view : kViews) {
    Workspace& workspace = app.workspace;
    const auto on = [&workspace, name = view.name] {
      const auto value = workspace.views.value(name);
      return value && std::get<bool>(*value);
    };
    Action action{std::string("view.") + view.name,
                  kView,
                  view.text,
                  {view.key},
                  "Switch the view on or off; one that is off costs nothing",
                  [&workspace, on, name = view.name] { (void)workspace.views.set(name, !on()); }};
    action.checked = on;
    app.actions.add(std::move(action));
  }
}

}  // namespace

void show_page(AppModel& app, const std::filesystem::path& page, const char* in_tree) {
  Document& document = app.workspace.document;
  if (page.empty()) return document.tell(fmt::format("this page was not installed with the program: {}", in_tree));
  if (!app.dialogs.show_page || app.dialogs.show_page(page)) return;
  document.tell("no program here shows " + page.string());
}

void add_window_acts(AppModel& app) {
  add_view_switches(app);
  app.actions.add(toggle("view.dark", "Dark", "F9", "Dark colours for night watches", app.workspace.dark));
  app.actions.add({"view.full_screen",
                   kView,
                   "Full screen",
                   {"F11"},
                   "Switch full screen on or off",
                   asked(app, &Dialogs::full_screen)});
  app.actions.add({"view.reset_layout",
                   kView,
                   "Reset layout",
                   {},
                   "Put all docks back in their original places",
                   asked(app, &Dialogs::reset_layout)});
  app.actions.add(
      toggle("view.latencies", "Latencies", "F12", "How long each picture took, over it", app.workspace.latencies));
  app.actions.add(
      {"help.tutorial", kHelp, "Tutorial", {}, "Opens the demo survey, and a page with ten steps through it", [&app] {
         open_demo(app);
         show_page(app, tutorial_place(), "docs/tutorial.md");
       }});
  app.actions.add(
      {"help.guide", kHelp, "Guide", {}, "The guide to the desktop, from opening a survey to its map", [&app] {
         show_page(app, guide_place(), "docs/guide.md");
       }});
  app.actions.add({"help.new", kHelp, "What's new", {}, "What each version brought", [&app] {
                     show_page(app, changes_place(), "CHANGELOG.md");
                   }});
  app.actions.add({"help.keys", kHelp, "Keys", {"F1"}, "Every key and what it does", asked(app, &Dialogs::show_keys)});
  app.actions.add({"help.about", kHelp, "About", {}, "Version and licences", asked(app, &Dialogs::show_about)});
}

}  // namespace sonar
