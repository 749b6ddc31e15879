// SPDX-License-Identifier: Apache-2.0
#include "session/echograms/echogram_actions.h"

namespace sonar {

void add_echogram_actions(AppModel& app, EchogramModel& echogram) {
  constexpr const char* kMenu = "&View";
  const auto shown = [&app] { return app.workspace.document.shown() != nullptr; };
  const auto opened = [&app] { return app.workspace.document.survey() != nullptr; };
  const auto channels = [&echogram] { return echogram.has_channels(); };
  app.actions.add({.id = "echogram.fan",
                   .menu = kMenu,
                   .text = "Echogram of the whole fan",
                   .keys = {},
                   .tip = "All beams of the fan as one, their mean, instead of the beam through which the slices lie",
                   .run = [&echogram] { echogram.set_of_fan(!echogram.of_fan()); },
                   .enabled = shown,
                   .checked = [&echogram] { return echogram.of_fan(); }});
  app.actions.add({.id = "echogram.depth",
                   .menu = kMenu,
                   .text = "Echogram against depth",
                   .keys = {},
                   .tip = "Depth below the sea surface instead of range; each ping lies where its heave put it",
                   .run = [&echogram] { echogram.set_along_depth(!echogram.along_depth()); },
                   .enabled = opened,
                   .checked = [&echogram] { return echogram.along_depth(); }});
  app.actions.add({.id = "echogram.hold",
                   .menu = kMenu,
                   .text = "Echogram stays with its beam",
                   .keys = {},
                   .tip = "It no longer follows the fan and the beam of the slices",
                   .run = [&echogram] { echogram.set_held(!echogram.held()); },
                   .enabled = shown,
                   .checked = [&echogram] { return echogram.held(); }});
  app.actions.add({.id = "echogram.other",
                   .menu = kMenu,
                   .text = "EK60 below the echogram",
                   .keys = {},
                   .tip = "A channel of a sounder of single beams that ran at the same time, under the same time axis",
                   .run = [&echogram] { echogram.set_other_below(!echogram.other_below()); },
                   .enabled = channels,
                   .checked = [&echogram] { return echogram.other_below(); }});
  app.actions.add({.id = "echogram.channel",
                   .menu = kMenu,
                   .text = "Next frequency of the EK60",
                   .keys = {},
                   .tip = "The echogram of its next channel",
                   .run = [&echogram] { echogram.next_channel(); },
                   .enabled = channels});
}

}  // namespace sonar
