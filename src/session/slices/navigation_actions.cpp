// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <charconv>
#include <utility>

#include "base/number_text.h"
#include "session/live/live_watch.h"
#include "session/playing/playback.h"
#include "session/slices/slice_actions.h"
#include "session/slices/slice_places.h"
#include "session/tools/brush_tool.h"

namespace sonar {
namespace {

constexpr const char* kMenu = "&Navigate";
constexpr std::int64_t kPage = 10;
constexpr double kMostRate = 1000.0;  ///< pings a second: beyond any screen

bool has_pings(const AppModel& app) { return app.workspace.document.shown() != nullptr; }

/// Whether there is a ping before, or behind, the one looked at.
bool has_ping(const AppModel& app, bool behind) {
  const Document& document = app.workspace.document;
  return has_pings(app) && (behind ? document.ping() + 1 < document.shown()->pings() : document.ping() > 0);
}

void add_step(AppModel& app, const char* id, const char* text, const char* key, const char* tip, std::int64_t by) {
  app.actions.add({id,
                   kMenu,
                   text,
                   {key},
                   tip,
                   [&app, by] {
                     Document& document = app.workspace.document;
                     document.look_at(document.ping() + by);
                   },
                   [&app, by] { return has_ping(app, by > 0); }});
}

void add_end(AppModel& app, const char* id, const char* text, const char* key, bool last) {
  app.actions.add({id,
                   kMenu,
                   text,
                   {key},
                   "",
                   [&app, last] {
                     Document& document = app.workspace.document;
                     if (document.shown()) document.look_at(last ? document.shown()->pings() - 1 : 0);
                   },
                   [&app, last] { return has_ping(app, last); }});
}

void add_place(AppModel& app, const char* id, const char* text, const char* key, SliceKind kind, int by) {
  app.actions.add({id,
                   kMenu,
                   text,
                   {key},
                   "",
                   [&app, kind, by] { step_slice(app.workspace, kind, by); },
                   [&app] { return has_pings(app); }});
}

void add_plane(AppModel& app, const char* id, const char* text, const char* tip, PlaneSlice::Kind kind) {
  app.actions.add({.id = id,
                   .menu = kMenu,
                   .text = text,
                   .keys = {},
                   .tip = tip,
                   .run = [&app, kind] { choose_plane(app.workspace, kind); },
                   .enabled = [&app] { return has_pings(app); },
                   .checked = [&app, kind] { return app.workspace.plane.values().lies == kind; }});
}

void add_planes(AppModel& app) {
  add_plane(app, "slice.plane_horizontal", "Plane slice: horizontal",
            "At one depth, through the selected school, else through the middle", PlaneSlice::Kind::horizontal);
  add_plane(app, "slice.plane_vertical", "Plane slice: vertical",
            "Through the sonar and the selected school, else through the middle", PlaneSlice::Kind::vertical);
  add_plane(app, "slice.plane_oblique", "Plane slice: oblique",
            "Going down away from the sonar through the selected school, else through the middle",
            PlaneSlice::Kind::oblique);
  app.actions.add({.id = "slice.section",
                   .menu = kMenu,
                   .text = "Plane slice: section along a line",
                   .keys = {"Ctrl+Shift+S"},
                   .tip = "Drag a line in the slice from above: the plane slice stands upright along it",
                   .run =
                       [&app] {
                         app.brush_tool->cancel();
                         app.workspace.tool.set(ToolName::section);
                         app.workspace.document.tell("drag a line in a slice; Esc cancels");
                       },
                   .enabled = [&app] { return has_pings(app); },
                   .checked = [&app] { return app.workspace.tool() == ToolName::section; }});
}

void ask_rate(AppModel& app, Playback& playback) {
  if (!app.dialogs.text) return;
  const double now = playback.rate();
  const auto answer = app.dialogs.text("Play at a rate", "pings a second",
                                       now > Playback::kRealTime && now < Playback::kFastest ? shortest(now) : "2");
  if (!answer) return;
  double rate = 0.0;
  const char* end = answer->data() + answer->size();
  const auto [after, problem] = std::from_chars(answer->data(), end, rate);
  if (problem == std::errc{} && after == end && rate > 0.0 && rate <= kMostRate) return playback.set_rate(rate);
  app.workspace.document.tell(fmt::format("'{}' is no rate: expected pings a second, up to {:g}", *answer, kMostRate));
}

void add_playing(AppModel& app) {
  Playback& playback = *app.playback;
  app.actions.add({"ping.play",
                   kMenu,
                   "Play",
                   {"Space"},
                   "Play through the pings, or pause",
                   [&playback] { playback.toggle(); },
                   [&app] { return has_ping(app, true) || has_ping(app, false); },
                   [&playback] { return playback.playing(); },
                   [&playback] { return (playback.playing() ? "Pause (" : "Play (") + playback.speed_text() + ")"; }});
  app.actions.add({"ping.faster",
                   kMenu,
                   "Play faster",
                   {"+", "="},
                   "Real time, 0.5, 1, 2, 5, 10, 20 pings a second, as fast as possible",
                   [&playback] { playback.faster(); },
                   [&playback] { return playback.rate() != Playback::kFastest; }});
  app.actions.add({"ping.slower",
                   kMenu,
                   "Play slower",
                   {"-"},
                   "As fast as possible, 20, 10, 5, 2, 1, 0.5 pings a second, real time",
                   [&playback] { playback.slower(); },
                   [&playback] { return playback.rate() != Playback::kRealTime; }});
  app.actions.add({"ping.rate",
                   kMenu,
                   "Play at a rate...",
                   {},
                   "Any number of pings a second",
                   [&app, &playback] { ask_rate(app, playback); },
                   {},
                   {},
                   [&playback] { return "Play at a rate... (" + playback.speed_text() + ")"; }});
  app.actions.add({"ping.loop",
                   kMenu,
                   "Play in a loop",
                   {"Ctrl+Space"},
                   "After the last ping comes the first",
                   [&playback] { playback.set_loops(!playback.loops()); },
                   {},
                   [&playback] { return playback.loops(); }});
}

void add_live(AppModel& app) {
  LiveWatch& live = *app.live;
  app.actions.add({.id = "file.live",
                   .menu = "&File",
                   .text = "Follow the recording",
                   .keys = {"Ctrl+L"},
                   .tip = "Follow a survey that is still being recorded, and detect its schools",
                   .run = [&live] { live.set_on(!live.on()); },
                   .enabled =
                       [&app] {
                         const SurveyFiles* survey = app.workspace.document.survey();
                         return survey != nullptr && survey->raw_gone.empty();
                       },
                   .checked = [&live] { return live.on(); }});
  app.actions.add({.id = "file.alarm",
                   .menu = "&File",
                   .text = "Alarm...",
                   .keys = {},
                   .tip = "Report when a school in the recording begins to meet a rule",
                   .run =
                       [&app, &live] {
                         if (!app.dialogs.text) return;
                         const auto rule =
                             app.dialogs.text("Alarm", "volume_m3 > 20000, range_m < 150; empty: none", live.alarm());
                         if (!rule) return;
                         if (auto set = live.set_alarm(*rule); !set) app.workspace.document.tell(to_line(set.error()));
                       },
                   .enabled = [&app] { return app.workspace.document.survey() != nullptr; }});
  app.actions.add({.id = "ping.live",
                   .menu = kMenu,
                   .text = "Newest ping, live",
                   .keys = {"L"},
                   .tip = "Return to the newest ping and stay with it",
                   .run = [&live] { live.look_at_newest(); },
                   .enabled = [&live] { return live.on() && !live.at_newest(); }});
}

}  // namespace

void add_navigation_actions(AppModel& app) {
  add_step(app, "ping.next", "Next ping", "Right", "", 1);
  add_step(app, "ping.previous", "Previous ping", "Left", "", -1);
  add_step(app, "ping.forward", "Ten pings forward", "PgDown", "", kPage);
  add_step(app, "ping.back", "Ten pings back", "PgUp", "", -kPage);
  add_end(app, "ping.first", "First ping", "Home", false);
  add_end(app, "ping.last", "Last ping", "End", true);
  add_playing(app);
  add_live(app);
  add_place(app, "slice.fan_up", "Top slice: next fan up", "Up", SliceKind::top, 1);
  add_place(app, "slice.fan_down", "Top slice: next fan down", "Down", SliceKind::top, -1);
  add_place(app, "slice.beam_up", "Side slice: next beam", "Shift+Up", SliceKind::side, 1);
  add_place(app, "slice.beam_down", "Side slice: previous beam", "Shift+Down", SliceKind::side, -1);
  add_place(app, "slice.range_out", "Range slice: farther out", "Ctrl+Up", SliceKind::range, 1);
  add_place(app, "slice.range_in", "Range slice: nearer in", "Ctrl+Down", SliceKind::range, -1);
  add_place(app, "slice.plane_away", "Plane slice: up, or away from the viewer", "Ctrl+Shift+Up", SliceKind::plane, 1);
  add_place(app, "slice.plane_near", "Plane slice: down, or towards the viewer", "Ctrl+Shift+Down", SliceKind::plane,
            -1);
  add_planes(app);
}

}  // namespace sonar
