// SPDX-License-Identifier: Apache-2.0
#include "pipeline/exports/export_echoview.h"

#include <fmt/format.h>

#include <string>

#include "io/atomic_file.h"
#include "io/echoview_text.h"

namespace sonar {

Result<std::vector<std::filesystem::path>> export_echoview(const ObservationProduct& product,
                                                           const std::filesystem::path& dest, const Work& work) {
  std::vector<std::filesystem::path> files;
  const auto write = [&](const std::string& name, const std::string& text) -> Result<void> {
    if (text.empty()) return {};
    files.push_back(dest / name);
    return write_file(files.back(), text);
  };
  const int fans = product.grid ? product.grid->grid.fans() : 0;
  for (int fan = 0; fan < fans; ++fan) {
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    const std::string name = fmt::format("{}-fan-{:02}.evr", product.observation, fan);
    if (auto written = write(name, evr_text(product, fan)); !written) return pass_on(written);
  }
  if (auto written = write(product.observation + "-seabed.evl", evl_text(product)); !written) return pass_on(written);
  return files;
}

}  // namespace sonar
