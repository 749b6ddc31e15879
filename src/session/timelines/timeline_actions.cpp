// SPDX-License-Identifier: Apache-2.0
#include "session/timelines/timeline_actions.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace sonar {
namespace {

constexpr const char* kMenu = "&Navigate";

bool any_ping(const Desk& desk) { return desk.workspace.document.shown() != nullptr; }

/// The event stands at the ping on show.
void mark_event(Desk& desk, const std::string& kind) {
  Document& document = desk.workspace.document;
  if (!document.shown()) return;
  std::string text;
  if (desk.asking.text) {
    text = desk.asking.text(fmt::format("Mark {}", kind), "What happened here", kind).value_or("");
    // Without a word it is a human who thought better of it.
    if (text.empty()) return;
  }
  EventCommand event;
  event.kind = kind;
  event.time = document.shown()->ground().times[static_cast<std::size_t>(document.ping())];
  event.text = text == kind ? std::string{} : text;
  document.act(std::move(event));
}

void mark_bad(Desk& desk, const MarkedInterval& interval) {
  Document& document = desk.workspace.document;
  const auto observation = document.open_observation(interval.observation);
  if (!observation) return;
  const auto& times = observation->ground().times;
  BadPingsCommand bad;
  bad.first = times[static_cast<std::size_t>(interval.first_ping)];
  bad.last = times[static_cast<std::size_t>(interval.last_ping)];
  document.act(interval.observation, interval.first_ping, bad);
}

void mark_good(Document& document, const MarkedInterval& interval) {
  const auto observation = document.open_observation(interval.observation);
  if (!observation) return;
  const auto& times = observation->ground().times;
  document.act(interval.observation, interval.first_ping,
               GoodPingsCommand{times[static_cast<std::size_t>(interval.first_ping)],
                                times[static_cast<std::size_t>(interval.last_ping)]});
}

/// Index of the ping of the next event of the observation on show, in a direction.
std::optional<std::int64_t> next_event(const Document& document, int step) {
  if (!document.shown()) return std::nullopt;
  std::optional<std::int64_t> found;
  for (const EventCommand& event : document.state().events) {
    const auto& times = document.shown()->ground().times;
    const auto at = std::lower_bound(times.begin(), times.end(), event.time) - times.begin();
    const std::int64_t ping = std::min<std::int64_t>(at, document.shown()->pings() - 1);
    if ((ping - document.ping()) * step <= 0) continue;
    if (!found || (ping - *found) * step < 0) found = ping;
  }
  return found;
}

void add_event(Desk& desk, const std::string& kind, const std::string& key) {
  desk.actions.add({.id = "event." + kind,
                    .menu = kMenu,
                    .text = fmt::format("Mark {}…", kind == "other" ? "an event" : kind),
                    .keys = {key},
                    .tip = "A mark on the timeline at the ping on show",
                    .run = [&desk, kind] { mark_event(desk, kind); },
                    .enabled = [&desk] { return any_ping(desk); }});
}

void add_step(Desk& desk, const std::string& id, const std::string& text, const std::string& key, int step) {
  desk.actions.add({.id = id,
                    .menu = kMenu,
                    .text = text,
                    .keys = {key},
                    .tip = "Look at the ping of the nearest mark on the timeline",
                    .run =
                        [&desk, step] {
                          if (const auto ping = next_event(desk.workspace.document, step)) {
                            desk.workspace.document.look_at(*ping);
                          }
                        },
                    .enabled = [&desk, step] { return next_event(desk.workspace.document, step).has_value(); }});
}

void add_removing(Desk& desk) {
  Workspace& workspace = desk.workspace;
  desk.actions.add({.id = "mark.remove",
                    .menu = kMenu,
                    .text = "Remove the chosen mark",
                    .keys = {},
                    .tip = "The mark or bad interval that was clicked on a timeline; Delete does it too",
                    .run = [&workspace] { remove_mark(workspace); },
                    .enabled = [&workspace] { return workspace.mark().has_value(); }});
  desk.actions.add(
      {.id = "good.interval",
       .menu = kMenu,
       .text = "Mark the interval good",
       .keys = {},
       .tip = "Pings of the interval that was marked on a timeline (Shift and dragging) take part in measures "
              "again",
       .run =
           [&workspace] {
             const auto interval = workspace.marked_interval();
             if (!interval) return;
             mark_good(workspace.document, *interval);
             workspace.marked_interval.set(std::nullopt);
           },
       .enabled = [&workspace] { return workspace.marked_interval().has_value(); }});
}

}  // namespace

void remove_mark(Workspace& workspace) {
  const auto chosen = workspace.mark();
  if (!chosen) return;
  workspace.mark.set(std::nullopt);
  // Done on any ping of the observation: the act says something about times.
  if (const auto* event = std::get_if<EventCommand>(&chosen->what)) {
    return workspace.document.act(chosen->observation, 0, RemoveEventCommand{*event});
  }
  const auto& bad = std::get<BadPingsCommand>(chosen->what);
  workspace.document.act(chosen->observation, 0, GoodPingsCommand{bad.first, bad.last});
}

std::string mark_text(const Workspace& workspace) {
  if (!workspace.mark()) return {};
  if (const auto* event = std::get_if<EventCommand>(&workspace.mark()->what)) return "Remove mark " + event->kind;
  return "Remove bad interval";
}

void add_timeline_actions(Desk& desk) {
  add_event(desk, "trawl", "T");
  add_event(desk, "station", "Ctrl+T");
  add_event(desk, "noise", "Shift+T");
  add_event(desk, "other", "Ctrl+Shift+T");
  add_step(desk, "event.previous", "Previous event", "Ctrl+[", -1);
  add_step(desk, "event.next", "Next event", "Ctrl+]", 1);
  desk.actions.add({.id = "bad.ping",
                    .menu = kMenu,
                    .text = "Mark this ping bad",
                    .keys = {"X"},
                    .tip = "The ping takes no part in measures",
                    .run =
                        [&desk] {
                          const Document& document = desk.workspace.document;
                          if (!document.shown()) return;
                          mark_bad(desk, {document.shown()->index(), document.ping(), document.ping()});
                        },
                    .enabled = [&desk] { return any_ping(desk); }});
  desk.actions.add({.id = "bad.interval",
                    .menu = kMenu,
                    .text = "Mark the interval bad",
                    .keys = {"Shift+X"},
                    .tip = "Pings of the interval that was marked on a timeline (Shift and dragging) take no part in "
                           "measures",
                    .run =
                        [&desk] {
                          const auto interval = desk.workspace.marked_interval();
                          if (!interval) return;
                          mark_bad(desk, *interval);
                          desk.workspace.marked_interval.set(std::nullopt);
                        },
                    .enabled = [&desk] { return desk.workspace.marked_interval().has_value(); }});
  add_removing(desk);
}

}  // namespace sonar
