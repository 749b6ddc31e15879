// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "model/product.h"
#include "pipeline/tasks/merge_params.h"
#include "pipeline/tasks/run.h"

namespace sonar {

/// All observations of a survey without their voxels: rows, tracks, grids, notes. What the survey map shows.
struct Survey {
  std::vector<ObservationProduct> observations;  ///< by name; masks and background levels are empty
  std::vector<SchoolRow> schools;                ///< of all, `continues` filled in
  std::vector<SchoolPingRow> school_pings;
};

/// Order of display names: obs-0002 before obs-0010 before obs-10000.
[[nodiscard]] bool name_less(const std::string& a, const std::string& b);

/// Puts products together; any order of products gives the same survey.
/// params  empty = those of the products' recipe, the defaults where it tells none
/// errors  mismatch: two recipes, two sets of stage versions, one observation twice (each named)
[[nodiscard]] Result<Survey> merge(std::vector<ObservationProduct> products,
                                   const std::optional<MergeParams>& params = {});

/// What stands in survey.json under `failures`.
struct MergeFailure {
  std::optional<std::string> observation;  ///< none: a raw file, named in the text
  std::string text;                        ///< one line
};

struct MergeReport {
  Survey survey;
  std::vector<MergeFailure> failures;   ///< those handed in, those of tasks, and products that could not be read
  std::vector<std::string> missing;     ///< in plan.json, but without a product, and nobody told why
  std::vector<std::string> not_run;     ///< those of them that were not asked for
  std::vector<std::string> partly_run;  ///< observations of whose pings a run was asked for some only
  std::vector<std::string> unplanned;   ///< products that plan.json does not know; left out
  Diagnostics notes;                    ///< of the survey as a whole, from plan.json
  bool all_planned = false;             ///< there is a plan, and each of its observations has its product
  [[nodiscard]] bool complete() const { return failures.empty() && missing.empty() && not_run.empty(); }
  /// Every observation has its product, of all its pings: then its schools get numbers in the survey. Files that gave
  /// nothing are as files that are not there yet.
  [[nodiscard]] bool all_observed() const;
};

/// Product files of a result: OUT/products/obs-*.nc, or OUT/obs-*.nc where there is no such folder; by name.
/// errors  not_found: no such folder
[[nodiscard]] Result<std::vector<std::filesystem::path>> product_files(const std::filesystem::path& out);

/// Reads OUT/products and OUT/plan.json (where there is one) and writes schools.csv, school_pings.csv, survey.gpkg and
/// survey.json into OUT, each whole or not at all. Raw data are not needed.
/// failures  of the observations that were just run
/// only      the one observation that was asked for; that others have no product is no fault then, nor that one is
///           missing that has none of the plan's pings
/// errors    not_found: neither products nor plan; mismatch; io; no_space; cancelled
/// memory    masks of one observation at a time
Result<MergeReport> merge_folder(const std::filesystem::path& out, std::vector<MergeFailure> failures, Work& work,
                                 const std::optional<std::string>& only = {});

/// What a merge made, for people: counts, what is missing or failed, where the files lie. Ends with a line break.
[[nodiscard]] std::string merge_text(const MergeReport& report, const std::filesystem::path& out);

/// What the products say of their data, for people: a line for each observation and code, "no-grid: obs-0001: ...".
/// What happened to schools (track-event, propagation-ended) is not in it.
[[nodiscard]] std::vector<std::string> note_lines(const MergeReport& report);

/// Merges after a run; its failures come along.
Result<MergeReport> merge_after(const std::filesystem::path& out, const RunReport& run, Work& work,
                                const std::optional<std::string>& only = {});

}  // namespace sonar
