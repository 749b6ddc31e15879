// SPDX-License-Identifier: Apache-2.0
#include "session/timelines/timeline_actions.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "session/marks/bookmarked_view.h"
#include "session/marks/marks.h"

namespace sonar {
namespace {

constexpr const char* kMenu = "&Navigate";

bool any_ping(const AppModel& app) { return app.workspace.document.shown() != nullptr; }

/// The event stands at the ping on show.
void mark_event(AppModel& app, const std::string& kind) {
  Document& document = app.workspace.document;
  if (!document.shown()) return;
  std::string text;
  if (app.dialogs.text) {
    const bool bookmark = kind == kBookmark;
    text = app.dialogs
               .text(bookmark ? "Bookmark" : fmt::format("Mark {}", kind),
                     bookmark ? "What is to be seen here" : "What happened here", kind)
               .value_or("");
    // Without a word it is a human who thought better of it.
    if (text.empty()) return;
  }
  EventCommand event;
  event.kind = kind;
  event.time = document.shown()->context().times[static_cast<std::size_t>(document.ping())];
  event.text = text == kind ? std::string{} : text;
  if (kind == kBookmark) {
    event.view = text_of(view_now(app.workspace));
    keep_thumbnail(app, event);
  }
  document.act(std::move(event));
}

void mark_bad(AppModel& app, const MarkedInterval& interval) {
  Document& document = app.workspace.document;
  const auto observation = document.open_observation(interval.observation);
  if (!observation) return;
  const auto& times = observation->context().times;
  BadPingsCommand bad;
  bad.first = times[static_cast<std::size_t>(interval.first_ping)];
  bad.last = times[static_cast<std::size_t>(interval.last_ping)];
  document.act(interval.observation, interval.first_ping, bad);
}

void mark_good(Document& document, const MarkedInterval& interval) {
  const auto observation = document.open_observation(interval.observation);
  if (!observation) return;
  const auto& times = observation->context().times;
  document.act(interval.observation, interval.first_ping,
               GoodPingsCommand{times[static_cast<std::size_t>(interval.first_ping)],
                                times[static_cast<std::size_t>(interval.last_ping)]});
}

/// Index of the ping of the next event of the observation on show, in a direction.
std::optional<std::int64_t> next_event(const Document& document, int step) {
  if (!document.shown()) return std::nullopt;
  std::optional<std::int64_t> found;
  for (const EventCommand& event : document.state().events) {
    const auto& times = document.shown()->context().times;
    const auto at = std::lower_bound(times.begin(), times.end(), event.time) - times.begin();
    const std::int64_t ping = std::min<std::int64_t>(at, document.shown()->pings() - 1);
    if ((ping - document.ping()) * step <= 0) continue;
    if (!found || (ping - *found) * step < 0) found = ping;
  }
  return found;
}

void add_event(AppModel& app, const std::string& kind, const std::string& key) {
  app.actions.add({.id = "event." + kind,
                   .menu = kMenu,
                   .text = kind == kBookmark ? "Bookmark what is seen…"
                                             : fmt::format("Mark {}…", kind == "other" ? "an event" : kind),
                   .keys = {key},
                   .tip = kind == kBookmark
                              ? "Ping, slices, volume's side and selected school: the list Marks leads back to them"
                              : "Mark the current ping on the timeline",
                   .run = [&app, kind] { mark_event(app, kind); },
                   .enabled = [&app] { return any_ping(app); }});
}

void add_step(AppModel& app, const std::string& id, const std::string& text, const std::string& key, int step) {
  app.actions.add({.id = id,
                   .menu = kMenu,
                   .text = text,
                   .keys = {key},
                   .tip = "Look at the ping of the nearest mark on the timeline",
                   .run =
                       [&app, step] {
                         if (const auto ping = next_event(app.workspace.document, step)) {
                           app.workspace.document.look_at(*ping);
                         }
                       },
                   .enabled = [&app, step] { return next_event(app.workspace.document, step).has_value(); }});
}

void add_removing(AppModel& app) {
  Workspace& workspace = app.workspace;
  app.actions.add({.id = "mark.remove",
                   .menu = kMenu,
                   .text = "Remove the selected mark",
                   .keys = {},
                   .tip = "The mark or bad interval that was clicked on a timeline; Delete does it too",
                   .run = [&workspace] { remove_mark(workspace); },
                   .enabled = [&workspace] { return workspace.mark().has_value(); }});
  app.actions.add({.id = "good.interval",
                   .menu = kMenu,
                   .text = "Mark the interval good",
                   .keys = {},
                   .tip =
                       "Pings of the interval that was marked on a timeline (Shift and dragging) take part in measures "
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
    workspace.document.act(chosen->observation, 0, RemoveEventCommand{*event});
  } else {
    const auto& bad = std::get<BadPingsCommand>(chosen->what);
    workspace.document.act(chosen->observation, 0, GoodPingsCommand{bad.first, bad.last});
  }
}

std::string mark_text(const Workspace& workspace) {
  if (!workspace.mark()) return {};
  if (const auto* event = std::get_if<EventCommand>(&workspace.mark()->what)) return "Remove mark " + event->kind;
  return "Remove bad interval";
}

void add_timeline_actions(AppModel& app) {
  add_event(app, "trawl", "T");
  add_event(app, "station", "Ctrl+T");
  add_event(app, "noise", "Shift+T");
  add_event(app, "other", "Ctrl+Shift+T");
  add_event(app, std::string(kBookmark), "Ctrl+M");
  add_step(app, "event.previous", "Previous event", "Ctrl+[", -1);
  add_step(app, "event.next", "Next event", "Ctrl+]", 1);
  app.actions.add({.id = "bad.ping",
                   .menu = kMenu,
                   .text = "Mark this ping bad",
                   .keys = {"X"},
                   .tip = "The ping takes no part in measures",
                   .run =
                       [&app] {
                         const Document& document = app.workspace.document;
                         if (!document.shown()) return;
                         mark_bad(app, {document.shown()->index(), document.ping(), document.ping()});
                       },
                   .enabled = [&app] { return any_ping(app); }});
  app.actions.add({.id = "bad.interval",
                   .menu = kMenu,
                   .text = "Mark the interval bad",
                   .keys = {"Shift+X"},
                   .tip = "Pings of the interval that was marked on a timeline (Shift and dragging) take no part in "
                          "measures",
                   .run =
                       [&app] {
                         const auto interval = app.workspace.marked_interval();
                         if (!interval) return;
                         mark_bad(app, *interval);
                         app.workspace.marked_interval.set(std::nullopt);
                       },
                   .enabled = [&app] { return app.workspace.marked_interval().has_value(); }});
  add_removing(app);
}

}  // namespace sonar
