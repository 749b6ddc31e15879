// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QMimeData>
#include <QUrl>
#include <filesystem>
#include <vector>

namespace sonar {

/// Files and folders of this machine among what is dropped.
inline std::vector<std::filesystem::path> dropped_paths(const QMimeData& dropped) {
  std::vector<std::filesystem::path> paths;
  for (const QUrl& url : dropped.urls()) {
    if (url.isLocalFile()) paths.emplace_back(url.toLocalFile().toStdString());
  }
  return paths;
}

}  // namespace sonar
