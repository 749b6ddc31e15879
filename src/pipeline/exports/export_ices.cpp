// SPDX-License-Identifier: Apache-2.0
#include "pipeline/exports/export_ices.h"

#include <algorithm>
#include <cmath>

#include "io/atomic_file.h"
#include "io/csv.h"
#include "io/ices_acoustic.h"

namespace sonar {

Result<std::vector<std::filesystem::path>> export_ices(const ObservationProduct& product,
                                                       const std::filesystem::path& out,
                                                       const std::filesystem::path& dest) {
  std::error_code absent;
  for (const char* table : {"effort.csv", "nasc.csv"}) {
    if (std::filesystem::is_regular_file(out / table, absent)) continue;
    return fail(ErrorCode::not_found, "is not there; \"sonarx integrate\" makes it", {.file = (out / table).string()});
  }
  const auto effort = read_csv_rows<EffortRow>(out / "effort.csv");
  if (!effort) return pass_on(effort);
  const auto nasc = read_csv_rows<NascRow>(out / "nasc.csv");
  if (!nasc) return pass_on(nasc);
  if (std::ranges::none_of(*effort, [](const EffortRow& row) { return row.edsu > 0; })) {
    return fail(ErrorCode::unsupported, "holds no unit on effort", {.file = (out / "effort.csv").string()});
  }
  std::vector<std::filesystem::path> files = {dest / "acoustic.xml"};
  auto written = write_file(files[0], ices_acoustic_xml(product, *effort, *nasc, IcesPart::all));
  const bool schools =
      std::ranges::any_of(*nasc, [](const NascRow& r) { return std::isfinite(r.nasc_school_m2_nmi2); });
  if (written && schools) {
    files.push_back(dest / "acoustic-schools.xml");
    written = write_file(files[1], ices_acoustic_xml(product, *effort, *nasc, IcesPart::schools));
  }
  if (!written) return pass_on(written);
  return files;
}

}  // namespace sonar
