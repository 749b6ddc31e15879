// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QString>

namespace sonar {

class AppModel;

/// Version, licence, the libraries within, and which back-end draws the volumes of this window.
[[nodiscard]] QString about_text(AppModel& app);

}  // namespace sonar
