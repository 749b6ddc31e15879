// SPDX-License-Identifier: Apache-2.0
#include "synth/truth_files.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "io/product_file.h"

namespace sonar::synth {
namespace {

bool by_school_and_ping(std::int64_t id_a, std::int64_t ping_a, std::int64_t id_b, std::int64_t ping_b) {
  return std::tie(id_a, ping_a) < std::tie(id_b, ping_b);
}

template <class Row>
void append(std::vector<Row>& all, std::vector<Row> more) {
  for (Row& row : more) all.push_back(std::move(row));
}

template <class Row>
void sort_rows(std::vector<Row>& rows) {
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
    return by_school_and_ping(a.school_id, a.ping_index, b.school_id, b.ping_index);
  });
}

}  // namespace

void ObservationTruth::add(const PingNavigation& navigation, std::vector<SchoolTruth> schools,
                           std::vector<BodyTruth> bodies) {
  product_.pings.push_back(navigation);
  for (SchoolTruth& school : schools) {
    school.row.observation = product_.observation;
    product_.masks.push_back({school.row.school_id, school.row.ping_index, std::move(school.mask)});
    product_.school_pings.push_back(std::move(school.row));
  }
  for (BodyTruth& body : bodies) {
    body.observation = product_.observation;
    bodies_.push_back(std::move(body));
  }
}

SurveyTruth::SurveyTruth(std::filesystem::path folder, std::string title, std::string program_version)
    : folder_(std::move(folder)), title_(std::move(title)), program_version_(std::move(program_version)) {}

Result<void> SurveyTruth::add(ObservationTruth observation, const std::optional<GridRecord>& grid) {
  ObservationProduct& product = observation.product_;
  product.program_version = program_version_;
  product.title = title_ + ": truth";
  product.source = "MS70 SYNTHETIC";
  product.history = "what the synthetic sonar knows of its own schools";
  product.recipe_json = "{}";
  product.grid = grid;
  sort_rows(product.school_pings);
  sort_rows(product.masks);
  sort_rows(observation.bodies_);
  product.schools = school_rows(product.school_pings, observation.bodies_);
  const std::filesystem::path file = folder_ / (product.observation + ".nc");
  if (auto written = write_product(product, file); !written) return written;
  append(schools_, std::move(product.schools));
  append(school_pings_, std::move(product.school_pings));
  append(bodies_, std::move(observation.bodies_));
  return {};
}

Result<void> SurveyTruth::finish() {
  if (auto written = write_truth(folder_ / "schools.csv", schools_); !written) return written;
  if (auto written = write_truth(folder_ / "school_pings.csv", school_pings_); !written) return written;
  return write_truth(folder_ / "bodies.csv", bodies_);
}

}  // namespace sonar::synth
