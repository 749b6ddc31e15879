// SPDX-License-Identifier: Apache-2.0
// Lists of the survey, and the keys of the review.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/number_text.h"
#include "session/app_parts.h"
#include "session/lists/diagnostics_list.h"
#include "session/lists/journal_list.h"
#include "session/lists/mark_table.h"
#include "session/lists/refused_table.h"
#include "session/lists/school_ping_table.h"
#include "session/lists/school_table.h"
#include "session/lists/survey_tree.h"
#include "session/playing/playback.h"
#include "session/review/review.h"

namespace sonar {
namespace {

constexpr const char* kMenu = "&Review";

void decide_all(AppModel& app, Review& review) {
  std::string rule(kDefaultBulkRule);
  for (;;) {
    if (!app.dialogs.text) return;
    const std::string label = fmt::format("Of all schools that are not reviewed, those with (depth and length in {})",
                                          app.workspace.units().length().name);
    rule = app.dialogs.text("Review by a rule", label, rule).value_or("");
    if (rule.empty()) return;
    const auto done = review.decide_all(rule);
    if (done) return;
    // The human mends the line; a test's window answers once.
    app.workspace.document.tell(to_line(done.error()));
    if (!app.dialogs.yes || !app.dialogs.yes(to_line(done.error()) + "\nTry again?")) return;
  }
}

/// In any observation of the survey. What the journal knows of is opened with it.
bool any_school(const Document& document) {
  return std::any_of(document.choices().states.begin(), document.choices().states.end(),
                     [](const auto& one) { return one.second && !one.second->schools.empty(); });
}

/// "Accept (5 schools)"; empty where not several are selected.
std::string of_several(const AppModel& app, const std::string& text) {
  const std::size_t count = app.workspace.chosen_schools().size();
  return count > 1 ? fmt::format("{} ({})", text, count_of(count, "school")) : std::string{};
}

std::string species_text(const AppModel& app, const Review& review, int digit) {
  const std::string species = digit == 0 ? "No species" : review.species(digit);
  const std::string of_all = species.empty() ? species : of_several(app, species);
  return of_all.empty() ? species : of_all;
}

void add_decisions(AppModel& app, Review& review) {
  const auto with_school = [&app] { return app.workspace.school().has_value(); };
  app.actions.add({.id = "review.next",
                   .menu = kMenu,
                   .text = "Next unreviewed school",
                   .keys = {"N"},
                   .tip = "Show the next school of the whole survey that nobody has decided about",
                   .run =
                       [&app, &review] {
                         if (app.playback) app.playback->pause();
                         review.next();
                       },
                   .enabled = [&app] { return any_school(app.workspace.document); }});
  const auto add = [&](const char* id, const char* text, std::vector<std::string> keys, const char* tip,
                       const char* status) {
    app.actions.add({.id = id,
                     .menu = kMenu,
                     .text = text,
                     .keys = std::move(keys),
                     .tip = tip,
                     .run = [&review, status] { review.decide(status); },
                     .enabled = with_school,
                     .text_now = [&app, text] { return of_several(app, text); },
                     .of_school = true});
  };
  add("review.accept", "Accept", {"A", "Return", "Enter"}, "Confirm that this is a school", "accepted");
  add("review.reject", "Reject", {"R"}, "Mark as not a school; it stays in the tables as rejected", "rejected");
  add("review.unreview", "Not reviewed", {"U"}, "Withdraw the decision on the selected school", "unreviewed");
}

void add_species(AppModel& app, Review& review) {
  for (int digit = 0; digit <= 9; ++digit) {
    app.actions.add({.id = fmt::format("review.species.{}", digit),
                     .menu = kMenu,
                     .text = digit == 0 ? "No species" : fmt::format("Species {}", digit),
                     .keys = {std::to_string(digit)},
                     .tip = "Species of the selected school; the list stands in the preferences",
                     .run = [&review, digit] { review.set_species(digit); },
                     .enabled = [&app] { return app.workspace.school().has_value(); },
                     .text_now = [&app, &review, digit] { return species_text(app, review, digit); },
                     .of_school = true});
  }
}

/// "herring, sprat" -> one a digit.
void name_all_species(AppModel& app) {
  if (!app.dialogs.text) return;
  const auto answer = app.dialogs.text("Species", "One for each digit from 1, with commas between",
                                       fmt::format("{}", fmt::join(app.preferences.species, ", ")));
  if (!answer) return;
  std::vector<std::string> species;
  std::string line = *answer;
  std::replace_if(
      line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20U; }, ' ');
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find(',', at), line.size());
    const std::size_t first = std::min(line.find_first_not_of(' ', at), end);
    const std::size_t last = end == first ? first : line.find_last_not_of(' ', end - 1) + 1;
    if (last > first) species.push_back(line.substr(first, last - first));
    at = end + 1;
  }
  if (species.empty() || species.size() > Preferences::kMostSpecies) {
    return app.workspace.document.tell(
        fmt::format("species: expected 1 to {} names with commas between", Preferences::kMostSpecies));
  }
  app.preferences.species = std::move(species);
  keep_preferences(app);
}

}  // namespace

void add_lists(AppModel& app) {
  Workspace& workspace = app.workspace;
  app.lists.push_back({"survey_tree", "Survey", DockPlace::left, std::make_unique<SurveyTree>(workspace), true});
  app.lists.push_back({"schools", "Schools", DockPlace::bottom, std::make_unique<SchoolTable>(workspace)});
  auto pings = std::make_unique<SchoolPingTable>(workspace);
  SchoolPingTable& ping_table = *pings;
  app.lists.push_back({"school_pings", "Schools in pings", DockPlace::bottom, std::move(pings)});
  auto queue = std::make_unique<Review>(workspace, app.preferences);
  Review& review = *queue;
  app.lists.push_back({"review", "Review", DockPlace::bottom, std::move(queue)});
  app.lists.push_back({"refused", "Refused echoes", DockPlace::bottom, std::make_unique<RefusedTable>(workspace)});
  app.lists.push_back({"marks", "Marks", DockPlace::bottom, std::make_unique<MarkTable>(app)});
  app.lists.push_back({"journal", "Journal", DockPlace::bottom, std::make_unique<JournalList>(workspace)});
  app.lists.push_back({"diagnostics", "Diagnostics", DockPlace::bottom, std::make_unique<DiagnosticsList>(workspace)});

  add_decisions(app, review);
  add_species(app, review);
  app.actions.add({.id = "review.species_names",
                   .menu = kMenu,
                   .text = "Species keys...",
                   .keys = {},
                   .tip = "Which species the digits 1 to 9 mean",
                   .run = [&app] { name_all_species(app); }});
  app.actions.add({.id = "review.rule",
                   .menu = kMenu,
                   .text = "Decide by a rule...",
                   .keys = {"Ctrl+B"},
                   .tip = "Accept or reject every unreviewed school of the survey that meets a rule: one step to undo",
                   .run = [&app, &review] { decide_all(app, review); },
                   .enabled = [&workspace] { return any_school(workspace.document); }});
  app.actions.add({.id = "review.advance",
                   .menu = kMenu,
                   .text = "Advance after a decision",
                   .keys = {},
                   .tip = "Show the next unreviewed school after each decision",
                   .run = [&app] { app.preferences.advance = !app.preferences.advance; },
                   .checked = [&app] { return app.preferences.advance; }});
  app.actions.add({.id = "list.pings_of_all",
                   .menu = "&View",
                   .text = "List pings of all schools",
                   .keys = {},
                   .tip = "When off, only the selected school",
                   .run = [&ping_table] { ping_table.show_all(!ping_table.all()); },
                   .checked = [&ping_table] { return ping_table.all(); }});
  app.actions.add(
      {.id = "list.copy",
       .menu = "&Edit",
       .text = "Copy rows",
       .keys = {"Ctrl+C"},
       .tip = "The marked rows of the list in use, with their titles, for a spreadsheet; else what was measured",
       .run = [&app] {
         if (app.dialogs.copy_rows && app.dialogs.copy_rows()) return;
         const Action* figures = app.actions.find("measure.copy");
         if (figures != nullptr && figures->enabled()) return figures->run();
         app.workspace.document.tell("click the list whose rows you want to copy");
       }});
  // What was decided in earlier runs is seen at once, wherever in the survey it lies.
  app.listening.to(workspace.document.changes(),
                   [&workspace, opened = std::make_shared<std::filesystem::path>()](DocumentChange change) {
                     Document& document = workspace.document;
                     if (change == DocumentChange::survey) opened->clear();
                     if (change != DocumentChange::state || document.choices().lines->empty()) return;
                     if (*opened == document.journal_path()) return;
                     *opened = document.journal_path();
                     document.open_all();
                   });
}

}  // namespace sonar
