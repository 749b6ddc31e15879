// SPDX-License-Identifier: Apache-2.0
#include "publish/chart_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>

#include "publish/volumes/drawn_schools.h"
#include "view/charts/chart.h"

namespace sonar {
namespace {

bool has_school(const ObservationProduct& product, std::int64_t school) {
  return std::any_of(product.schools.begin(), product.schools.end(),
                     [school](const SchoolRow& row) { return row.school_id == school; });
}

Result<void> require_known(const std::vector<DrawnObservation*>& observations, const PictureOptions& options) {
  const bool any = std::any_of(observations.begin(), observations.end(),
                               [](const DrawnObservation* one) { return one->has_product(); });
  if (!any) {
    return fail(ErrorCode::not_found,
                "schools have not been detected: a chart is made of products; name the work folder of a run");
  }
  if (observations.size() == 1) return require_schools(*observations.front(), options);
  for (const std::int64_t school : options.schools) {
    const bool known = std::any_of(observations.begin(), observations.end(), [school](const DrawnObservation* one) {
      return has_school(one->product(), school);
    });
    if (!known) return fail(ErrorCode::usage, fmt::format("no school {} in any observation", school));
  }
  return {};
}

/// What a chart needs of a product: its tables, with the schools that the options ask for.
ObservationProduct tables_of(const ObservationProduct& product, const PictureOptions& options) {
  ObservationProduct tables;
  tables.observation = product.observation;
  tables.title = product.title;
  std::set<std::int64_t> chosen;
  for (const SchoolRow& row : product.schools) {
    if (!wanted(product, row.school_id, options)) continue;
    chosen.insert(row.school_id);
    tables.schools.push_back(row);
  }
  for (const SchoolPingRow& row : product.school_pings) {
    if (chosen.contains(row.school_id)) tables.school_pings.push_back(row);
  }
  return tables;
}

}  // namespace

Result<FrameDescription> chart_frame(const std::vector<DrawnObservation*>& observations,
                                     const PictureOptions& options) {
  if (auto known = require_known(observations, options); !known) return pass_on(known);
  std::vector<ObservationProduct> tables;
  for (const DrawnObservation* one : observations) tables.push_back(tables_of(one->product(), options));
  const ChartParams& asked = options.kind.chart;
  const auto data = chart_data(tables, {asked.table, asked.x, asked.y, options.display.rejected, options.units});
  if (!data) return pass_on(data);
  ChartStyle style;
  style.bins = asked.bins;
  auto made = chart(*data, style, options.size, theme_of(options));
  if (!made) return pass_on(made);
  return std::move(made->frame);
}

}  // namespace sonar
