// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <system_error>
#include <utility>

#include "io/csv.h"
#include "io/product_file.h"
#include "pipeline/score/score.h"
#include "pipeline/tasks/merge.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

/// What the score needs of bodies.csv.
struct BodyRow {
  std::string observation;
  std::int64_t school_id = 0;
  std::int64_t ping_index = 0;
  double volume_m3 = kUnknown;
  double backscatter_m2 = kUnknown;
  double fraction_inside = kUnknown;
};

template <class Visitor>
void columns(Visitor& v, BodyRow& r) {
  v("observation", "", r.observation);
  v("school_id", "", r.school_id);
  v("ping_index", "", r.ping_index);
  v("volume_m3", "m3", r.volume_m3);
  v("backscatter_m2", "m2", r.backscatter_m2);
  v("fraction_inside", "1", r.fraction_inside);
}

/// What the score needs of company.csv.
struct CompanyRow {
  std::string observation;
  std::int64_t ping_index = 0;
  CompanyBox box;
};

template <class Visitor>
void columns(Visitor& v, CompanyRow& r) {
  v("observation", "", r.observation);
  v("ping_index", "", r.ping_index);
  v("kind", "", r.box.kind);
  v("first_fan", "", r.box.first_fan);
  v("last_fan", "", r.box.last_fan);
  v("first_beam", "", r.box.first_beam);
  v("last_beam", "", r.box.last_beam);
  v("first_sample", "", r.box.first_sample);
  v("last_sample", "", r.box.last_sample);
}

double sum_known(double a, double b) {
  if (std::isnan(a)) return b;
  return std::isnan(b) ? a : a + b;
}

/// Rows of a table go to the observation of their name; those of products stay where there is no table.
template <class Row>
Result<void> take_table(const fs::path& path, ScoreSide& side, std::vector<Row> ObservationProduct::*member) {
  std::error_code error;
  if (!fs::exists(path, error)) return {};
  auto rows = read_csv_rows<Row>(path);
  if (!rows) return pass_on(rows);
  std::vector<ObservationProduct>& products = side.observations;
  for (ObservationProduct& product : products) (product.*member).clear();
  for (Row& row : *rows) {
    const auto product =
        std::find_if(products.begin(), products.end(), [&](const auto& p) { return p.observation == row.observation; });
    if (product != products.end()) {
      (*product.*member).push_back(std::move(row));
    } else if (std::find(side.missing.begin(), side.missing.end(), row.observation) == side.missing.end()) {
      side.missing.push_back(row.observation);
    }
  }
  return {};
}

Result<ScoreSide> read_side(const fs::path& folder) {
  const auto files = product_files(folder);
  if (!files) return pass_on(files);
  ScoreSide side;
  for (const fs::path& file : *files) {
    auto product = read_product(file);
    if (!product) return pass_on(product);
    product->background_db = {};
    side.observations.push_back(std::move(*product));
  }
  if (auto taken = take_table(folder / "schools.csv", side, &ObservationProduct::schools); !taken) {
    return pass_on(taken);
  }
  if (auto taken = take_table(folder / "school_pings.csv", side, &ObservationProduct::school_pings); !taken) {
    return pass_on(taken);
  }
  return side;
}

Result<void> take_bodies(const fs::path& path, ScoreSide& side) {
  std::error_code error;
  if (!fs::exists(path, error)) return {};
  const auto bodies = read_csv_rows<BodyRow>(path);
  if (!bodies) return pass_on(bodies);
  for (const BodyRow& row : *bodies) {
    BodyInPing& body = side.bodies[{row.observation, row.school_id, row.ping_index}];
    body.volume_m3 = sum_known(body.volume_m3, row.volume_m3);
    body.backscatter_m2 = sum_known(body.backscatter_m2, row.backscatter_m2);
    // Of two parts the one that is less inside tells.
    body.fraction_inside = std::fmin(body.fraction_inside, row.fraction_inside);
  }
  return {};
}

Result<void> take_company(const fs::path& path, ScoreSide& side) {
  std::error_code error;
  if (!fs::exists(path, error)) return {};
  auto rows = read_csv_rows<CompanyRow>(path);
  if (!rows) return pass_on(rows);
  CompanyByPing& company = side.company.emplace();
  for (CompanyRow& row : *rows) company[{row.observation, row.ping_index}].push_back(std::move(row.box));
  return {};
}

}  // namespace

Result<ScoreSide> read_result_side(const fs::path& out) {
  auto side = read_side(out);
  if (side && side->observations.empty()) {
    return fail(ErrorCode::not_found, "there are no products in this folder", {.file = out.string()});
  }
  return side;
}

Result<ScoreSide> read_truth_side(const fs::path& truth) {
  auto side = read_side(truth);
  if (!side) return side;
  if (side->observations.empty()) {
    return fail(ErrorCode::not_found, "holds no truth (obs-0001.nc, ...)", {.file = truth.string()});
  }
  if (auto taken = take_bodies(truth / "bodies.csv", *side); !taken) return pass_on(taken);
  if (auto taken = take_company(truth / "company.csv", *side); !taken) return pass_on(taken);
  return side;
}

}  // namespace sonar
