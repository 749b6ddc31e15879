// SPDX-License-Identifier: Apache-2.0
#include "render/cell_states.h"

#include <algorithm>

namespace sonar {
namespace {

void set_where(std::vector<std::uint8_t>& cells, const std::vector<std::uint8_t>& others, std::uint8_t to) {
  for (std::size_t i = 0; i < others.size(); ++i) {
    if (others[i] != 0) cells[i] = to;
  }
}

}  // namespace

CellQuestion cell_question(const VolumeView& view, const DrawQuality& quality) {
  const bool thin = accumulates(view.mode) && !view.lighting.on;
  return {view.mode, ends_at_surface(view.mode) ? view.first_hit_db : 0.0, view.masks.data_too,
          thin ? quality.homogeneous_limit : 0.0};
}

CellStates cell_states(const CellQuestion& question, const FilledVolume& volume, const Macrocells& cells,
                       const TransferTable& table, const MaskGrid& masks, double spacing_m, Work& work) {
  std::vector<std::uint8_t> set(cells.size(), 0);
  if (question.data && accumulates(question.mode)) set = visible_cells(cells, table);
  if (question.data && question.mode == RayMode::maximum) set = cells_reaching(cells, table.lowest_visible_db);
  auto thin = thin_cells(cells, table, set, spacing_m, question.thin_limit);
  // A surface or a mask is found by walking.
  const auto walked = [&](const std::vector<std::uint8_t>& where) {
    set_where(set, where, 1);
    set_where(thin, where, 0);
  };
  if (question.data && ends_at_surface(question.mode)) walked(cells_reaching(cells, question.first_hit_db));
  walked(masks.cells);
  CellStates out;
  if (std::find(thin.begin(), thin.end(), 1) != thin.end()) {
    out.means = cell_means(volume, cells, table, thin, work);
  }
  out.distance = empty_distance(cells, set);
  out.flags = std::move(thin);
  for (std::size_t i = 0; i < out.flags.size(); ++i) {
    const int gaps = !cells.gaps.empty() && cells.gaps[i] != 0 ? kCellGaps : 0;
    const int masked = !masks.empty() && masks.cells[i] != 0 ? kCellMasked : 0;
    out.flags[i] = static_cast<std::uint8_t>(out.flags[i] | gaps | masked);
  }
  return out;
}

}  // namespace sonar
