// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/describe.h"
#include "base/result.h"
#include "base/work.h"
#include "io/csv.h"
#include "io/lsss_work.h"
#include "io/seabed_raster.h"
#include "pipeline/exports/reduce.h"

namespace sonar {

/// What export can write.
struct ExportFormat {
  std::string_view name;
  std::string_view text;
  bool needs_raw = false;
};
[[nodiscard]] std::span<const ExportFormat> export_formats();

struct ExportOptions {
  std::filesystem::path out;                     ///< work folder of a run
  std::string format;                            ///< name in export_formats()
  std::filesystem::path dest;                    ///< folder that the files go to
  std::filesystem::path survey;                  ///< folder of the raw files; only where the format needs them
  ReduceParams reduce;                           ///< for raw-reduced
  CsvTexts texts = CsvTexts::as_they_are;        ///< for csv
  SeabedRasterParams seabed = {};                ///< for seabed
  LsssNumbering lsss = LsssNumbering::from_one;  ///< for lsss
};

struct Exported {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> without_grid = {};  ///< observations that sv cannot hold
};

/// Writes the products of a work folder in another format.
/// errors  usage: an unknown format (the line lists those that exist), no survey where one is needed; not_found; io;
///         no_space; mismatch: the raw files are not those of the products; unsupported: none of them has what the format is
///         of; cancelled
[[nodiscard]] Result<Exported> export_products(const ExportOptions& options, Work& work);

}  // namespace sonar
