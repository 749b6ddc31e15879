// SPDX-License-Identifier: Apache-2.0
#include "gui/about.h"

#include <QApplication>

#include "gui/translated.h"
#include "session/app_model.h"
#include "session/volume/volume_model.h"

namespace sonar {

QString about_text(AppModel& app) {
  const auto* volume = dynamic_cast<const VolumeModel*>(app.picture("volume"));
  const std::string drawn_by = volume == nullptr ? "" : volume->drawn_by();
  return translated(
             "Sonar Explorer %1\nApache License 2.0\n\nWith Qt (LGPL 3), GDAL, PROJ, netCDF, Cairo, Pango, "
             "oneTBB, Highway, nlohmann-json, fmt, pugixml, xxHash, libepoxy.\n\n%2")
      .arg(QApplication::applicationVersion())
      .arg(drawn_by.empty() ? translated("No volume is on show: what draws them is told here when one is.")
                            : translated("Volumes are drawn by: %1").arg(QString::fromStdString(drawn_by)));
}

}  // namespace sonar
