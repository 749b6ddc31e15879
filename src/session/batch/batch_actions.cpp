// SPDX-License-Identifier: Apache-2.0
// What is asked for in the window of surveys to be run.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include "base/number_text.h"
#include "session/app_parts.h"
#include "session/batch/batch.h"

namespace sonar {

namespace fs = std::filesystem;

Result<void> start_batch(AppModel& app) {
  const auto replaced = app.batch->to_be_replaced();
  if (!replaced) return pass_on(replaced);
  if (!replaced->empty() && app.dialogs.yes) {
    std::string folders;
    for (const fs::path& folder : *replaced) folders += printable(folder.string()) + "\n";
    const bool yes = app.dialogs.yes(
        fmt::format("Results that were made under another recipe will be replaced:\n\n{}\nRun the surveys?", folders));
    if (!yes) return {};
  }
  return app.batch->start();
}

void open_run_survey(AppModel& app, std::size_t at) {
  if (at >= app.batch->surveys().size()) return;
  const BatchSurvey& survey = app.batch->surveys()[at];
  std::error_code absent;
  const bool begun = !survey.out.empty() && fs::exists(survey.out / "plan.json", absent);
  app.workspace.document.open(begun ? std::vector{survey.out} : survey.paths);
}

bool batch_may_end(AppModel& app) {
  if (!app.batch->running() || app.batch->stopping()) return true;
  const bool yes = !app.dialogs.yes || app.dialogs.yes(
                                           "Surveys are being run. Stop them?\n\nObservations that are finished stay, "
                                           "and the next start goes on from there.");
  if (yes) app.batch->stop();
  return yes;
}

void add_batch(AppModel& app) {
  app.batch = std::make_shared<Batch>(app.workspace.queue, app.workspace.document);
  app.listening.to(app.batch->changed(), [&app](BatchChange change) {
    if (change != BatchChange::surveys || app.batch->listed() == app.preferences.batch) return;
    app.preferences.batch = app.batch->listed();
    keep_preferences(app);
  });
  app.actions.add({.id = "file.run_surveys",
                   .menu = "&File",
                   .text = "Run surveys...",
                   .keys = {"Ctrl+R"},
                   .tip = "Detect the schools of whole surveys, one after another, while you go on: products, tables "
                          "and maps as sonarx run makes them",
                   .run = [&app, taken_up = std::make_shared<bool>(false)] {
                     // Not at the start: what is listed may lie on a disk that is slow to answer.
                     if (!std::exchange(*taken_up, true)) app.batch->take_up(std::vector(app.preferences.batch));
                     if (app.dialogs.show_batch) app.dialogs.show_batch();
                   }});
}

}  // namespace sonar
