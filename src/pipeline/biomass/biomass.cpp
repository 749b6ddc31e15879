// SPDX-License-Identifier: Apache-2.0
#include "pipeline/biomass/biomass.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <system_error>
#include <utility>

#include "io/csv.h"
#include "io/product_file.h"
#include "model/integration.h"
#include "pipeline/biomass/biomass_strata.h"
#include "pipeline/biomass/length_table.h"
#include "pipeline/biomass/ts_table.h"
#include "pipeline/tasks/merge.h"
#include "pipeline/tasks/survey_numbers.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

Result<Survey> survey_in(const fs::path& out, Work& work) {
  const auto files = product_files(out);
  if (!files) return pass_on(files);
  if (files->empty()) return fail(ErrorCode::not_found, "holds no products; sonarx run makes them", {out.string()});
  std::vector<ObservationProduct> products;
  for (const fs::path& file : *files) {
    work.progress("reading products", std::ssize(products), std::ssize(*files));
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    auto product = read_product(file);
    if (!product) return pass_on(product);
    product->masks.clear();
    product->background_db.clear();
    products.push_back(std::move(*product));
  }
  auto survey = merge(std::move(products));
  if (survey) number_as_merged(*survey, out);
  return survey;
}

Result<FishChoice> fish_of(const BiomassOptions& options, const FrequencyBand& sonar) {
  const auto table = read_ts_table(options.ts_table);
  if (!table) return pass_on(table);
  auto chosen = ts_relation_named(*table, options.ts);
  if (!chosen) return pass_on(chosen);
  auto lengths = read_fish_lengths(options.lengths);
  if (!lengths) return pass_on(lengths);
  FishChoice fish;
  fish.choices = ts_choices(*table, *chosen, sonar.from_khz, sonar.to_khz);
  fish.chosen = std::move(*chosen);
  fish.lengths = std::move(*lengths);
  fish.weight = options.weight;
  fish.species = options.species;
  return fish;
}

/// Tables of echo integration.
struct Integration {
  std::vector<EffortRow> effort;
  std::vector<StratumRow> strata;
};

/// Empty where there are none.
Result<Integration> integration_in(const fs::path& out) {
  Integration tables;
  std::error_code absent;
  if (!fs::exists(out / "strata.csv", absent) || !fs::exists(out / "effort.csv", absent)) return tables;
  auto effort = read_csv_rows<EffortRow>(out / "effort.csv");
  if (!effort) return pass_on(effort);
  auto strata = read_csv_rows<StratumRow>(out / "strata.csv");
  if (!strata) return pass_on(strata);
  tables.effort = std::move(*effort);
  tables.strata = std::move(*strata);
  return tables;
}

void take_schools(std::vector<NumberedSchool>&& schools, Biomass& out) {
  for (NumberedSchool& school : schools) {
    if (!school.counted) continue;
    if (std::isnan(school.row.numbers)) ++out.without_numbers;
    if (school.row.n_pings > 0 && school.row.n_pings_whole == 0) ++out.cut;
    if (std::isnan(school.row.aspect_deg)) ++out.without_course;
    out.school_causes.push_back(band_causes({&school, 1}));
    out.schools.push_back(std::move(school.row));
    out.pings.insert(out.pings.end(), school.pings.begin(), school.pings.end());
  }
}

}  // namespace

Result<void> require_strata(const std::map<std::string, double>& areas, std::span<const StratumRow> strata,
                            const fs::path& areas_file) {
  for (const auto& [stratum, area] : areas) {
    const bool known = std::any_of(strata.begin(), strata.end(), [&](const StratumRow& row) {
      return row.level == "stratum" && row.stratum == stratum;
    });
    if (known) continue;
    return fail(ErrorCode::mismatch,
                fmt::format("stratum '{}' is none of those that were integrated; sonarx integrate --transects writes "
                            "them into strata.csv",
                            stratum.substr(0, 40)),
                {areas_file.string()});
  }
  return {};
}

Result<Biomass> biomass_of(std::span<const ObservationProduct> products, FishChoice fish, const StrataInput& strata) {
  Biomass done;
  done.sonar = frequencies_of(products);
  done.fish = std::move(fish);
  done.integrated = !strata.strata.empty();
  std::vector<NumberedSchool> schools = school_numbers(products, done.fish);
  done.strata = biomass_strata(schools, done.fish, strata);
  done.causes = band_causes(schools);
  take_schools(std::move(schools), done);
  if (!done.fish.species.empty() && done.schools.empty()) {
    return fail(ErrorCode::mismatch, fmt::format("no school of the species '{}'", done.fish.species));
  }
  return done;
}

Result<void> write_biomass(const Biomass& biomass, const fs::path& folder) {
  auto written = write_csv_rows(folder / "biomass.csv", biomass.schools);
  if (written) written = write_csv_rows(folder / "biomass_pings.csv", biomass.pings);
  if (written) written = write_csv_rows(folder / "biomass_strata.csv", biomass.strata);
  return written;
}

Result<Biomass> biomass_folder(const BiomassOptions& options, Work& work) {
  const auto survey = survey_in(options.out, work);
  if (!survey) return pass_on(survey);
  auto fish = fish_of(options, frequencies_of(survey->observations));
  if (!fish) return pass_on(fish);
  const auto tables = integration_in(options.out);
  if (!tables) return pass_on(tables);
  std::map<std::string, double> areas;
  if (!options.areas.empty()) {
    auto told = read_stratum_areas(options.areas);
    if (!told) return pass_on(told);
    areas = std::move(*told);
    if (auto there = require_strata(areas, tables->strata, options.areas); !there) return pass_on(there);
  }
  auto done = biomass_of(survey->observations, std::move(*fish), {tables->effort, tables->strata, std::move(areas)});
  if (!done) {
    Error error = done.error();
    if (error.where.file.empty()) error.where.file = options.out.string();
    return tl::unexpected(std::move(error));
  }
  if (auto written = write_biomass(*done, options.out); !written) return pass_on(written);
  return done;
}

}  // namespace sonar
