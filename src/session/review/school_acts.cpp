// SPDX-License-Identifier: Apache-2.0
// What is done to the selected school, and undo and redo.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/number_text.h"
#include "session/app_parts.h"
#include "session/open/survey_schools.h"
#include "session/review/beyond_reach.h"
#include "session/review/merge_offer.h"
#include "session/review/refused_layer.h"
#include "session/timelines/timeline_actions.h"
#include "session/tools/growth.h"
#include "session/tools/seed_tool.h"

namespace sonar {
namespace {

constexpr const char* kMenu = "&Schools";

/// The selected school, where it lies in the observation on show: acts are done on the ping that is looked at.
std::optional<SurveySchool> school_on_show(const Workspace& workspace) {
  auto school = selected_school(workspace);
  const auto& shown = workspace.document.shown();
  return school && shown && shown->index() == school->name.observation ? std::move(school) : std::nullopt;
}

std::function<bool()> with_school(const AppModel& app) {
  return [&app] { return school_on_show(app.workspace).has_value(); };
}

/// A school that waits for the one that is to become part of it.
struct Merging {
  std::optional<SchoolName> first;
};

void merge_selected(Workspace& workspace, Merging& merging) {
  const auto second = school_on_show(workspace);
  if (!merging.first || !second || second->name == *merging.first) return;
  const SchoolName first = *std::exchange(merging.first, std::nullopt);
  if (first.observation != second->name.observation) {
    return workspace.document.tell("only schools of one observation can be merged");
  }
  for (const auto& one : workspace.document.state(first.observation).schools) {
    if (one->number != first.number) continue;
    const SchoolKey key = key_of(one->masks, second->observation->context());
    workspace.document.act(MergeCommand{{key, second->key()}});
    return workspace.school.set(first);
  }
}

void begin_merging(Workspace& workspace, Merging& merging) {
  merging.first = workspace.school();
  workspace.document.tell(fmt::format("select the school that is to become part of {}; Esc gives up",
                                      title_of(workspace.document, *merging.first)));
}

void reshape(Workspace& workspace, Reshaping what, bool all_pings) {
  if (const auto school = school_on_show(workspace)) {
    workspace.document.act(ReshapeCommand{what, school->key(), all_pings});
  }
}

void split_under_cursor(Workspace& workspace) {
  const auto school = school_on_show(workspace);
  const auto& cursor = workspace.cursor();
  if (!school || !cursor) return workspace.document.tell("point at the piece that is to become a school of its own");
  const BeamGrid& grid = school->observation->grid();
  const auto row = static_cast<std::size_t>(cursor->fan * grid.beams() + cursor->beam);
  if (row >= grid.channel.size()) return;
  workspace.document.act(SplitCommand{school->key(), SeedKey{grid.channel[row], cursor->sample}});
}

/// Carries the selected school on from the mask that it has in the ping that is looked at.
void carry_on(Workspace& workspace, bool backwards, bool forwards) {
  const auto school = school_on_show(workspace);
  if (!school) return;
  PropagateCommand command = propagation_as_set(workspace);
  if (!backwards) command.reach_backward = 0;
  if (!forwards) command.reach_forward = 0;
  command.school = school->key();
  workspace.document.act(std::move(command));
}

/// A line of text about schools; empty where the human declined or left it as it is. An empty answer is one: it wipes out
/// what was there. now: what each has; several that differ begin with nothing.
std::optional<std::string> asked_line(AppModel& app, const std::vector<SurveySchool>& schools, const char* label,
                                      std::string SchoolRow::*now) {
  if (!app.dialogs.text) return std::nullopt;
  const SurveySchool& first = schools.front();
  const bool same = std::all_of(schools.begin(), schools.end(),
                                [&](const SurveySchool& one) { return one.decided().*now == first.decided().*now; });
  const std::string before = same ? first.decided().*now : std::string{};
  auto text = app.dialogs.text(
      schools.size() == 1 ? fmt::format("School {}", first.name.number) : count_of(schools.size(), "school"), label,
      before);
  if (!text || *text == before) return std::nullopt;
  std::replace_if(
      text->begin(), text->end(), [](char c) { return static_cast<unsigned char>(c) < 0x20U; }, ' ');
  return text;
}

void write_of(AppModel& app, const std::vector<SurveySchool>& schools, const char* label, std::string SchoolRow::*now,
              std::optional<std::string> Decision::*said) {
  Decision decision;
  decision.*said = asked_line(app, schools, label, now);
  if (decision.*said) decide_on(app.workspace, schools, decision);
}

void comment(AppModel& app) {
  if (!school_on_show(app.workspace)) return;
  write_of(app, selected_schools(app.workspace), "Comment", &SchoolRow::comment, &Decision::comment);
}

void rename(AppModel& app) {
  const auto school = school_on_show(app.workspace);
  if (school) write_of(app, {*school}, "Name", &SchoolRow::name, &Decision::name);
}

void name_species(AppModel& app) {
  if (!school_on_show(app.workspace)) return;
  write_of(app, selected_schools(app.workspace), "Species", &SchoolRow::species, &Decision::species);
}

void detect(Document& document, bool all) {
  if (!document.shown()) return document.tell("open a survey first to detect schools");
  std::vector<std::size_t> observations{document.shown()->index()};
  if (all) {
    observations.clear();
    for (std::size_t i = 0; i < document.survey()->observations.size(); ++i) {
      if (document.survey()->observations[i].grid) observations.push_back(i);
    }
  }
  if (!document.progress().stage.empty()) {
    return document.tell(fmt::format("wait until {} is done, or cancel it", document.progress().stage));
  }
  document.detect(std::move(observations));
}

/// An echo of another ping is looked at first.
void take_in(Workspace& workspace, SeedTool& seed) {
  const auto echo = workspace.echo();
  if (!echo) return;
  const auto& staged = workspace.document.staged();
  const auto voxel = loudest_on_show(workspace, *echo);
  if (voxel && staged && staged->ping_index == workspace.document.ping()) return seed.take_in(*voxel);
  go_to_echo(workspace, *echo);
  workspace.document.tell(
      fmt::format("refused echo {} is in ping {}: press again to accept it", echo->id, workspace.document.ping()));
}

void add_undo(AppModel& app) {
  Document& document = app.workspace.document;
  app.actions.add({.id = "edit.undo",
                   .menu = "&Edit",
                   .text = "Undo",
                   .keys = {"Ctrl+Z"},
                   .tip = "Undo the last act; there is no limit",
                   .run = [&document] { document.undo(); },
                   .enabled = [&document] { return !document.choices().undo_text.empty(); },
                   .text_now = [&document] { return document.choices().undo_text; }});
  app.actions.add({.id = "edit.redo",
                   .menu = "&Edit",
                   .text = "Redo",
                   .keys = {"Ctrl+Shift+Z", "Ctrl+Y"},
                   .tip = "Do again what was undone",
                   .run = [&document] { document.redo(); },
                   .enabled = [&document] { return !document.choices().redo_text.empty(); },
                   .text_now = [&document] { return document.choices().redo_text; }});
}

void add_search(AppModel& app) {
  Document& document = app.workspace.document;
  app.actions.add({.id = "schools.detect",
                   .menu = kMenu,
                   .text = "Detect schools in this observation",
                   .keys = {"D"},
                   .tip = "Detect schools automatically; your decisions are kept",
                   .run = [&document] { detect(document, false); },
                   .enabled = [&document] { return document.shown() != nullptr; }});
  app.actions.add({.id = "schools.detect_all",
                   .menu = kMenu,
                   .text = "Detect schools in the whole survey",
                   .keys = {"Ctrl+D"},
                   .tip = "Detect schools in every observation; your decisions are kept",
                   .run = [&document] { detect(document, true); },
                   .enabled = [&document] { return document.shown() != nullptr; }});
  app.actions.add(
      {.id = "school.take_in",
       .menu = kMenu,
       .text = "Accept the refused echo as a school",
       .keys = {"I"},
       .tip = "The refused echo last pointed at or chosen grows into a school and is followed through time; where "
              "it is in another ping, the first press goes there",
       .run = [&app] { take_in(app.workspace, *app.seed_tool); },
       .enabled =
           [&app] { return app.workspace.display.values().refused_echoes && app.workspace.echo().has_value(); }});
}

void add_carrying(AppModel& app) {
  Workspace& workspace = app.workspace;
  const auto add = [&](const char* id, const char* text, const char* key, bool backwards, bool forwards) {
    app.actions.add({.id = id,
                     .menu = kMenu,
                     .text = text,
                     .keys = {key},
                     .tip = "Follow the selected school through time from the mask that it has in this ping",
                     .run = [&workspace, backwards, forwards] { carry_on(workspace, backwards, forwards); },
                     .enabled = with_school(app),
                     .of_school = true});
  };
  add("school.propagate_forwards", "Propagate forwards from here", "P", false, true);
  add("school.propagate_backwards", "Propagate backwards from here", "Shift+P", true, false);
  add("school.propagate", "Propagate both ways from here", "Ctrl+P", true, true);
  add_continuing(app);
}

void add_reshaping(AppModel& app) {
  Workspace& workspace = app.workspace;
  const auto add = [&](const char* id, const char* text, const char* key, const char* whole_key, const char* tip,
                       Reshaping what) {
    app.actions.add({.id = id,
                     .menu = kMenu,
                     .text = text,
                     .keys = {key},
                     .tip = fmt::format("{}, in this ping", tip),
                     .run = [&workspace, what] { reshape(workspace, what, false); },
                     .enabled = with_school(app),
                     .of_school = true});
    app.actions.add({.id = std::string(id) + "_all",
                     .menu = kMenu,
                     .text = std::string(text) + ", whole track",
                     .keys = {whole_key},
                     .tip = fmt::format("{}, in all its pings", tip),
                     .run = [&workspace, what] { reshape(workspace, what, true); },
                     .enabled = with_school(app),
                     .of_school = true});
  };
  add("school.fill_holes", "Fill holes", "H", "Shift+H", "Fill the holes of the selected school",
      Reshaping::fill_holes);
  add("school.smooth", "Smooth", "Ctrl+H", "Ctrl+Shift+H", "Smooth the outline of the selected school",
      Reshaping::smooth);
  add("school.largest_part", "Keep the largest part", "Y", "Shift+Y", "Drop all but the largest piece",
      Reshaping::largest_part);
}

void add_parting(AppModel& app, const std::shared_ptr<Merging>& merging) {
  Workspace& workspace = app.workspace;
  app.actions.add({.id = "school.split",
                   .menu = kMenu,
                   .text = "Split from here on",
                   .keys = {"K"},
                   .tip = "This ping and all later ones become a new school",
                   .run =
                       [&workspace] {
                         if (const auto school = school_on_show(workspace)) {
                           workspace.document.act(SplitCommand{school->key(), {}});
                         }
                       },
                   .enabled = with_school(app),
                   .of_school = true});
  app.actions.add({.id = "school.split_piece",
                   .menu = kMenu,
                   .text = "Split off the piece under the cursor",
                   .keys = {"Shift+K"},
                   .tip = "The piece under the cursor becomes a new school, through all pings",
                   .run = [&workspace] { split_under_cursor(workspace); },
                   .enabled = with_school(app),
                   .of_school = true});
  app.actions.add({.id = "school.merge",
                   .menu = kMenu,
                   .text = "Merge with the next school selected",
                   .keys = {"J"},
                   .tip = "The school that is selected next becomes part of this one",
                   .run = [&workspace, merging] { begin_merging(workspace, *merging); },
                   .enabled = with_school(app),
                   .of_school = true});
  app.listening.to(workspace.school.changed(), [&workspace, merging] { merge_selected(workspace, *merging); });
}

void add_naming(AppModel& app) {
  Workspace& workspace = app.workspace;
  app.actions.add({.id = "school.species",
                   .menu = kMenu,
                   .text = "Species...",
                   .keys = {"Ctrl+Shift+K"},
                   .tip = "Name the species of the selected school; digits set those of the preferences",
                   .run = [&app] { name_species(app); },
                   .enabled = with_school(app),
                   .of_school = true});
  app.actions.add({.id = "school.rename",
                   .menu = kMenu,
                   .text = "Rename...",
                   .keys = {"F2"},
                   .tip = "A name beside the number of the selected school, in views, tables and files",
                   .run = [&app] { rename(app); },
                   .enabled = with_school(app),
                   .of_school = true});
  app.actions.add({.id = "school.comment",
                   .menu = kMenu,
                   .text = "Comment...",
                   .keys = {"Ctrl+K"},
                   .tip = "A line of text about the selected school",
                   .run = [&app] { comment(app); },
                   .enabled = with_school(app),
                   .of_school = true});
  app.actions.add(
      {.id = "school.delete",
       .menu = kMenu,
       .text = "Delete",
       .keys = {"Delete"},
       .tip = "The selected school, or the mark that was clicked on a timeline, is no more; undo brings it back",
       .run =
           [&workspace] {
             if (workspace.mark()) return remove_mark(workspace);
             if (const auto school = school_on_show(workspace)) {
               workspace.document.act(DeleteCommand{school->key()});
             }
           },
       .enabled = [&workspace] { return workspace.mark() || school_on_show(workspace); },
       .text_now = [&workspace] { return mark_text(workspace); },
       .of_school = true});
}

}  // namespace

void add_school_acts(AppModel& app) {
  const auto merging = std::make_shared<Merging>();
  add_undo(app);
  add_search(app);
  add_carrying(app);
  Workspace& workspace = app.workspace;
  app.actions.add(
      {.id = "school.stop",
       .menu = kMenu,
       .text = "Stop",
       .keys = {},
       .tip = "Stop the propagation and keep what it reached (Esc)",
       .run =
           [&workspace, merging] {
             merging->first.reset();
             workspace.document.stop_propagation();
           },
       .enabled = [&workspace, merging] { return workspace.document.busy() || merging->first.has_value(); }});
  add_reshaping(app);
  add_parting(app, merging);
  add_merge_offer(app);
  add_naming(app);
  app.actions.add({.id = "school.none",
                   .menu = kMenu,
                   .text = "Select none",
                   .keys = {"Shift+Esc"},
                   .tip = "Clear the selection",
                   .run = [&workspace] { workspace.school.set(std::nullopt); },
                   .enabled = with_school(app)});
}

}  // namespace sonar
