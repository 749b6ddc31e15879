// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "session/live_watch.h"
#include "session/playback.h"
#include "session/slices/slice_actions.h"

namespace sonar {
namespace {

constexpr const char* kMenu = "&Navigate";
constexpr std::int64_t kPage = 10;

bool has_pings(const Desk& desk) { return desk.workspace.document.shown() != nullptr; }

/// Whether there is a ping before, or behind, the one looked at.
bool has_ping(const Desk& desk, bool behind) {
  const Document& document = desk.workspace.document;
  return has_pings(desk) && (behind ? document.ping() + 1 < document.shown()->pings() : document.ping() > 0);
}

void add_step(Desk& desk, const char* id, const char* text, const char* key, const char* tip, std::int64_t by) {
  desk.actions.add({id,
                    kMenu,
                    text,
                    {key},
                    tip,
                    [&desk, by] {
                      Document& document = desk.workspace.document;
                      document.look_at(document.ping() + by);
                    },
                    [&desk, by] { return has_ping(desk, by > 0); }});
}

void add_end(Desk& desk, const char* id, const char* text, const char* key, bool last) {
  desk.actions.add({id,
                    kMenu,
                    text,
                    {key},
                    "",
                    [&desk, last] {
                      Document& document = desk.workspace.document;
                      if (document.shown()) document.look_at(last ? document.shown()->pings() - 1 : 0);
                    },
                    [&desk, last] { return has_ping(desk, last); }});
}

/// by_fan, by_beam  one of them is 0
void add_place(Desk& desk, const char* id, const char* text, const char* key, int by_fan, int by_beam) {
  desk.actions.add({id,
                    kMenu,
                    text,
                    {key},
                    "",
                    [&desk, by_fan, by_beam] {
                      const auto& shown = desk.workspace.document.shown();
                      if (!shown) return;
                      SlicePlaces places = desk.workspace.slices();
                      places.fan = std::clamp(places.fan + by_fan, 0, shown->sector().fans() - 1);
                      places.beam = std::clamp(places.beam + by_beam, 0, shown->sector().beams() - 1);
                      desk.workspace.slices.set(places);
                    },
                    [&desk] { return has_pings(desk); }});
}

void add_playing(Desk& desk) {
  Playback& playback = *desk.playback;
  desk.actions.add({"ping.play",
                    kMenu,
                    "Play",
                    {"Space"},
                    "Play through the pings, or pause",
                    [&playback] { playback.toggle(); },
                    [&desk] { return has_ping(desk, true) || has_ping(desk, false); },
                    [&playback] { return playback.playing(); },
                    [&playback] { return (playback.playing() ? "Pause (" : "Play (") + playback.speed_text() + ")"; }});
  desk.actions.add({"ping.faster",
                    kMenu,
                    "Play faster",
                    {"+", "="},
                    "Real time, twice, five times, as fast as possible",
                    [&playback] { playback.faster(); },
                    [&playback] { return playback.speed() != PlaySpeed::fastest; }});
  desk.actions.add({"ping.slower",
                    kMenu,
                    "Play slower",
                    {"-"},
                    "As fast as possible, five times, twice, real time",
                    [&playback] { playback.slower(); },
                    [&playback] { return playback.speed() != PlaySpeed::real_time; }});
}

void add_live(Desk& desk) {
  LiveWatch& live = *desk.live;
  desk.actions.add({.id = "file.live",
                    .menu = "&File",
                    .text = "Follow the recording",
                    .keys = {"Ctrl+L"},
                    .tip = "The survey is still being recorded: take in what comes, find its schools",
                    .run = [&live] { live.set_on(!live.on()); },
                    .enabled = [&desk] { return desk.workspace.document.survey() != nullptr; },
                    .checked = [&live] { return live.on(); }});
  desk.actions.add({.id = "file.alarm",
                    .menu = "&File",
                    .text = "Alarm...",
                    .keys = {},
                    .tip = "Tell when a school of a recording that is followed begins to be so",
                    .run =
                        [&desk, &live] {
                          if (!desk.asking.text) return;
                          const auto rule =
                              desk.asking.text("Alarm", "volume_m3 > 20000, range_m < 150; empty: none", live.alarm());
                          if (!rule) return;
                          if (auto set = live.set_alarm(*rule); !set)
                            desk.workspace.document.tell(to_line(set.error()));
                        },
                    .enabled = [&desk] { return desk.workspace.document.survey() != nullptr; }});
  desk.actions.add({.id = "ping.live",
                    .menu = kMenu,
                    .text = "Newest ping, live",
                    .keys = {"L"},
                    .tip = "Back to the newest ping of a recording that is followed, and on with it",
                    .run = [&live] { live.look_at_newest(); },
                    .enabled = [&live] { return live.on() && !live.at_newest(); }});
}

}  // namespace

void add_navigation_actions(Desk& desk) {
  add_step(desk, "ping.next", "Next ping", "Right", "", 1);
  add_step(desk, "ping.previous", "Previous ping", "Left", "", -1);
  add_step(desk, "ping.forward", "Ten pings forward", "PgDown", "", kPage);
  add_step(desk, "ping.back", "Ten pings back", "PgUp", "", -kPage);
  add_end(desk, "ping.first", "First ping", "Home", false);
  add_end(desk, "ping.last", "Last ping", "End", true);
  add_playing(desk);
  add_live(desk);
  add_place(desk, "slice.fan_up", "Top slice: next fan up", "Up", 1, 0);
  add_place(desk, "slice.fan_down", "Top slice: next fan down", "Down", -1, 0);
  add_place(desk, "slice.beam_up", "Side slice: next beam", "Shift+Up", 0, 1);
  add_place(desk, "slice.beam_down", "Side slice: previous beam", "Shift+Down", 0, -1);
}

}  // namespace sonar
