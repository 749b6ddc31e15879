// SPDX-License-Identifier: Apache-2.0
// What is asked for in the pages of echo integration and of biomass.
#include <memory>
#include <string>

#include "session/app_parts.h"
#include "session/numbers/fish_biomass.h"
#include "session/numbers/integration.h"

namespace sonar {

void show_incidence_chart(Workspace& workspace) {
  auto& chart = workspace.picture_file;
  (void)chart.set("chart.table", Choice{static_cast<std::size_t>(ChartTable::school_pings)});
  (void)chart.set("chart.x", std::string("incidence_deg"));
  (void)chart.set("chart.y", std::string("sv_mean_db"));
  (void)workspace.views.set("chart", true);
}

void add_numbers(AppModel& app) {
  app.integration = std::make_shared<Integration>(app.workspace);
  app.fish = std::make_shared<FishBiomass>(app.workspace, *app.integration);
  const auto with_survey = [&app] { return app.workspace.document.survey() != nullptr; };
  app.actions.add({.id = "numbers.integrate",
                   .menu = "&Schools",
                   .text = "Echo integration...",
                   .keys = {"Ctrl+I"},
                   .tip = "NASC over sailed distance, range bins and depth channels, as sonarx integrate gives it",
                   .run =
                       [&app] {
                         if (app.dialogs.show_integration) app.dialogs.show_integration();
                       },
                   .enabled = with_survey});
  app.actions.add({.id = "numbers.biomass",
                   .menu = "&Schools",
                   .text = "Numbers and biomass...",
                   .keys = {"Ctrl+Shift+B"},
                   .tip =
                       "Numbers and biomass of fish in schools, strata and the survey, with a band, as sonarx biomass "
                       "gives them",
                   .run =
                       [&app] {
                         if (app.dialogs.show_biomass) app.dialogs.show_biomass();
                       },
                   .enabled = with_survey});
}

}  // namespace sonar
