// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "model/product.h"
#include "model/transect.h"
#include "pipeline/integrate/integrate_params.h"
#include "pipeline/integrate/integration_rows.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/survey/survey.h"

namespace sonar {

/// The product of an observation with its masks and background levels; empty where there is none.
using ProductOf = std::function<Result<std::optional<ObservationProduct>>(const std::string& observation)>;

struct Integrated {
  IntegrationTables tables;
  std::vector<std::string> left_out;         ///< observations of other sounders, or without a grid
  std::vector<std::string> without_pings;    ///< transects of the table
  std::vector<std::string> without_schools;  ///< observations without a product: nobody looked for schools in them
};

/// Echo integration of a survey over sailed distance, range bins and depth channels, from the unfiltered Sv with the
/// background taken off. Rejected schools are water like any other; pings that are bad, in the files or in a product, give
/// nothing. Where the recipe corrects for extinction, what schools took out of the beams is given back.
/// recipe      of the products, where there are some
/// product_of  asked for one observation after the other
/// errors      bad_parameter; mismatch: a product of other pings, or no transect has any; unsupported: no observation has a grid, or raw files are
///             reduced; io, not_found: the system did not let a ping be read; cancelled; those of product_of
/// threads     pings side by side, added up in their order: the same bits for any number
/// memory      a few pings per thread, the sums, and one observation's masks
[[nodiscard]] Result<Integrated> integrate_survey(const SurveyFiles& survey, const Recipe& recipe,
                                                  const ProductOf& product_of, std::span<const Transect> transects,
                                                  const IntegrateParams& params, Work& work);

/// effort.csv, nasc.csv and strata.csv into a folder that is there.
/// errors  io, no_space
[[nodiscard]] Result<void> write_integration(const IntegrationTables& tables, const std::filesystem::path& folder);

struct IntegrateOptions {
  std::vector<std::filesystem::path> survey;  ///< folders of raw files, or raw files
  std::filesystem::path out;                  ///< work folder, of a run where schools are wanted
  std::filesystem::path transects;            ///< CSV; empty = every observation is a transect
  /// Of a survey of which OUT has no products; empty = the default, or that of the products.
  std::function<Result<Recipe>()> recipe;
  IntegrateParams params;
};

/// The same of raw files and the products of a run in OUT, and its tables in OUT: effort.csv, nasc.csv, strata.csv.
/// errors  also usage: OUT lies with the raw files, or holds results of another survey; io, no_space; those of
///         read_transects() and of the recipe
[[nodiscard]] Result<Integrated> integrate_folder(const IntegrateOptions& options, Work& work);

}  // namespace sonar
