// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "base/result.h"
#include "io/csv_table.h"
#include "model/transect.h"

namespace sonar {

/// Periods of a survey from a table `name,stratum,type,start_utc,stop_utc`, in the order of time.
/// errors  format, naming file and line: a column that lacks or is not one of these, a type other than transect and off, a
///         transect without a name, a period that ends before it begins, two transects of one name or at one time
[[nodiscard]] Result<std::vector<Transect>> transects_of(const CsvTable& table);
/// errors  also not_found, io
[[nodiscard]] Result<std::vector<Transect>> read_transects(const std::filesystem::path& path);

}  // namespace sonar
