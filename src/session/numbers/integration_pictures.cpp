// SPDX-License-Identifier: Apache-2.0
#include "session/numbers/integration_pictures.h"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <utility>

#include "session/looks/screen_theme.h"

namespace sonar {

EffortPicture::EffortPicture(Workspace& workspace, Integration& integration, Kind kind)
    : LivePicture(workspace), workspace_(workspace), integration_(integration), kind_(kind) {
  shown_ = integration.result();
  listening_.to(integration.changed(), [this] {
    if (shown_ == integration_.result()) return;
    shown_ = integration_.result();
    update();
  });
  listening_.to(workspace.dark.changed(), [this] { update(); });
  if (kind == Kind::section) listening_.to(workspace.display, [this] { update(); });
}

std::vector<double> EffortPicture::range_bins() const {
  std::set<double> bins;
  if (shown_) {
    for (const NascRow& row : shown_->tables.nasc) bins.insert(row.range_from_m);
  }
  return {bins.begin(), bins.end()};
}

void EffortPicture::show_range_bin(std::optional<double> from_m) {
  if (range_from_m_ == from_m) return;
  range_from_m_ = from_m;
  update();
}

LivePicture::Build EffortPicture::build(const PictureLook& look) {
  if (!shown_) {
    if (!look.panel) chart_.reset();
    return {};
  }
  return [shown = shown_, kind = kind_, look, range = range_from_m_, scale = workspace_.display.values().scale](
             PixelSize size, const CancelToken&, const Show& show) -> Result<void> {
    const Theme theme = dock_theme(size, look);
    const IntegrationTables& tables = shown->tables;
    auto made = kind == Kind::nasc ? nasc_chart(tables.effort, size, theme)
                                   : sv_section(tables.effort, tables.nasc, range, sv_colours(scale), size, theme);
    if (!made) return pass_on(made);
    const auto chart = std::make_shared<const EffortChart>(std::move(*made));
    show({chart->frame, std::nullopt, chart});
    return {};
  };
}

void EffortPicture::take(const std::shared_ptr<const void>& detail) {
  chart_ = std::static_pointer_cast<const EffortChart>(detail);
}

void EffortPicture::pointer(const PointerEvent& event) {
  if (event.action != PointerAction::press || event.button != PointerButton::left || !chart_) return;
  if (const auto at = chart_->at(event.at)) integration_.go_to(at->row, at->share);
}

std::string EffortPicture::hint(PixelPoint at) const {
  if (!chart_ || !shown_ || !problem().empty()) return {};
  const auto of = chart_->at(at);
  if (!of || of->row >= shown_->tables.effort.size()) return {};
  const EffortRow& unit = shown_->tables.effort[of->row];
  std::string text = fmt::format("{}, EDSU {}, {:.3g} nmi from {:.3g} nmi", unit.transect, unit.edsu, unit.distance_nmi,
                                 unit.from_nmi);
  const auto* cell = chart_->cell(at);
  if (kind_ == Kind::section && cell == nullptr) return text;
  if (cell != nullptr) {
    const Unit length = workspace_.units().length();
    return text + fmt::format("\n{:g} to {}: Sv {:.1f} dB re 1 m\u207B\u00B9", rounded(cell->depth_from_m, length),
                              round_text(cell->depth_to_m, length), cell->sv_db);
  }
  text += fmt::format("\nNASC {:.4g} m\u00B2 nmi\u207B\u00B2", unit.nasc_m2_nmi2);
  if (std::isfinite(unit.nasc_se_m2_nmi2)) text += fmt::format(", standard error {:.2g}", unit.nasc_se_m2_nmi2);
  return text;
}

}  // namespace sonar
