// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "session/app_model.h"

namespace sonar {

/// Pages of the window of preferences but that of the keys, each with the sentence of every setting.
[[nodiscard]] std::vector<PanelSection> preference_pages(AppModel& app);

/// Lets a human change the preferences; what was there comes back where they decline, else it is kept.
void change_preferences(AppModel& app);

/// Lets theme, playback and memory follow the preferences, and the preferences follow the keys that change these too. Adds
/// edit.preferences.
void add_window_preferences(AppModel& app);

}  // namespace sonar
