// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "base/result.h"
#include "io/csv_table.h"
#include "model/fish_lengths.h"

namespace sonar {

/// Lengths of fish from a table `length_cm,count` (fish measured) or `length_cm,fraction` (shares; they need not add up to 1).
/// errors  format, naming file and line: other columns, a length not above 0 or twice, a count that is no whole number from 0
///         to 1e9, a fraction outside these bounds, no fish
[[nodiscard]] Result<FishLengths> fish_lengths_of(const CsvTable& table);
/// errors  also not_found, io
[[nodiscard]] Result<FishLengths> read_fish_lengths(const std::filesystem::path& path);

/// Areas of strata, square nautical miles, from a table `stratum,area_nmi2`.
/// errors  format, naming file and line: a stratum twice, an area not above 0
[[nodiscard]] Result<std::map<std::string, double>> stratum_areas_of(const CsvTable& table);
/// errors  also not_found, io
[[nodiscard]] Result<std::map<std::string, double>> read_stratum_areas(const std::filesystem::path& path);

}  // namespace sonar
