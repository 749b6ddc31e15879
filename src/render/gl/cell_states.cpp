// SPDX-License-Identifier: Apache-2.0
#include "render/gl/cell_states.h"

#include <algorithm>

namespace sonar {
namespace {

std::vector<std::uint8_t> cells_that_count(const CellQuestion& question, const Macrocells& cells,
                                           const TransferTable& table) {
  if (!question.data) {
    return std::vector<std::uint8_t>(cells.size(), 0);
  }
  switch (question.mode) {
    case RayMode::accumulate:
      return visible_cells(cells, table);
    case RayMode::first_hit:
      return cells_reaching(cells, question.first_hit_db);
    case RayMode::maximum:
      return cells_reaching(cells, table.lowest_visible_db);
  }
  return {};
}

}  // namespace

CellQuestion cell_question(const VolumeView& view, const DrawQuality& quality) {
  const bool thin = view.mode == RayMode::accumulate && !view.lighting.on;
  return {view.mode, view.mode == RayMode::first_hit ? view.first_hit_db : 0.0, view.masks.data_too,
          thin ? quality.homogeneous_limit : 0.0};
}

CellStates cell_states(const CellQuestion& question, const FilledVolume& volume, const Macrocells& cells,
                       const TransferTable& table, const MaskGrid& masks, double spacing_m, Work& work) {
  auto set = cells_that_count(question, cells, table);
  auto thin = thin_cells(cells, table, set, spacing_m, question.thin_limit);
  for (std::size_t i = 0; i < masks.cells.size(); ++i) {
    if (masks.cells[i] != 0) {
      set[i] = 1;
      thin[i] = 0;
    }
  }
  CellStates out;
  if (std::find(thin.begin(), thin.end(), 1) != thin.end()) {
    out.means = cell_means(volume, cells, table, thin, work);
  }
  out.distance = empty_distance(cells, set);
  out.flags = std::move(thin);
  for (std::size_t i = 0; i < out.flags.size(); ++i) {
    const int gaps = !cells.gaps.empty() && cells.gaps[i] != 0 ? 2 : 0;
    const int masked = !masks.empty() && masks.cells[i] != 0 ? 4 : 0;
    out.flags[i] = static_cast<std::uint8_t>(out.flags[i] | gaps | masked);
  }
  return out;
}

}  // namespace sonar
