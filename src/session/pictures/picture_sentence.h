// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "session/app_model.h"

namespace sonar {

/// What a picture shows, in a sentence for a screen reader: "Slice of fan 7, obs-0001, ping 66 of 78, 3 schools.". Why
/// nothing stands there, where that is so.
/// dock  id of a PictureDock
[[nodiscard]] std::string picture_sentence(const AppModel& app, const std::string& dock);

}  // namespace sonar
