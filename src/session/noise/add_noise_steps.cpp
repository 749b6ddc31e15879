// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <utility>

#include "session/app_parts.h"
#include "session/noise/noise_steps_model.h"

namespace sonar {

void add_noise_steps(AppModel& app) {
  constexpr const char* kMenu = "&View";
  auto made = std::make_unique<NoiseStepsModel>(app.workspace);
  NoiseStepsModel* model = made.get();
  const auto seen = [model] { return model->seen(); };
  app.actions.add(
      {.id = "noise.choose",
       .menu = kMenu,
       .text = "Noise steps...",
       .keys = {},
       .tip = "Which slice is shown at each step of noise removal, and which steps are compared",
       .run = [&app] { (void)asked(app, "Noise steps", app.workspace.picture_file, noise_steps_settings()); }});
  app.actions.add({.id = "noise.next",
                   .menu = kMenu,
                   .text = "Noise steps: compare next",
                   .keys = {},
                   .tip = "Before and after the next step of noise removal, and their difference",
                   .run = [model] { model->step(1); },
                   .enabled = seen});
  app.actions.add({.id = "noise.previous",
                   .menu = kMenu,
                   .text = "Noise steps: compare previous",
                   .keys = {},
                   .tip = "Before and after the step of noise removal before it, and their difference",
                   .run = [model] { model->step(-1); },
                   .enabled = seen});
  app.actions.add({.id = "noise.all",
                   .menu = kMenu,
                   .text = "Noise steps: show all",
                   .keys = {},
                   .tip = "All steps of noise removal side by side",
                   .run = [model] { model->show_all(); },
                   .enabled = [model] { return model->comparing(); }});
  app.pictures.push_back({"noise_steps", "Noise steps", DockPlace::centre, "noise_steps", std::move(made)});
}

}  // namespace sonar
