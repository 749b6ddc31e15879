// SPDX-License-Identifier: Apache-2.0
#include "session/figures/figure_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "view/composed_figure.h"
#include "view/shapes.h"

namespace sonar {
namespace {

/// The page in the middle of its view, with a little of what lies behind it on all sides.
FrameDescription preview_of(const FrameDescription& page, PixelSize view, Rgba8 behind) {
  constexpr double kEdge = 0.02;
  FrameDescription out{view, behind, page.title, {}};
  const double edge = std::round(kEdge * std::min(view.width, view.height));
  place_frame(out, page, {edge, edge, view.width - 2.0 * edge, view.height - 2.0 * edge});
  return out;
}

std::vector<std::size_t> order_of(const FigureJob& job) {
  std::vector<std::size_t> order(job.panels.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_partition(order.begin(), order.end(), [&](std::size_t i) { return !job.panels[i].refines; });
  return order;
}

/// Sizes in pixels mean nothing on paper.
std::string why_not(const Error& error, const FigureJob& job, std::size_t panel) {
  if (error.code != ErrorCode::bad_parameter) return to_line(error);
  const double mm = 25.4 / job.params.dpi;
  const PixelRect& place = job.layout.panels[panel];
  return fmt::format("no room for it in {:.0f} x {:.0f} mm: take a larger page, fewer columns or smaller text",
                     place.width * mm, place.height * mm);
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

const DrawnPanels::Panel* DrawnPanels::find(const std::string& id, const PictureLook& look,
                                            std::int64_t version) const {
  const auto found = panels_.find(id);
  const bool same = found != panels_.end() && found->second.look == look && found->second.version == version;
  return same ? &found->second : nullptr;
}

Result<void> draw_figure(
    const FigureJob& job, PixelSize view, const CancelToken& token,
    const std::function<void(FrameDescription preview, std::shared_ptr<const DrawnFigure> figure)>& show) {
  std::vector<FigurePanel> panels(job.panels.size());
  for (std::size_t i = 0; i < panels.size(); ++i) panels[i].name = job.panels[i].title;
  const auto show_page = [&](bool done) {
    auto figure = std::make_shared<DrawnFigure>();
    figure->page = figure_page(job.params, job.layout, panels, job.source);
    figure->page.origin = job.origin;
    figure->bars = !shared_bars(panels, job.params.letters).empty();
    figure->done = done;
    figure->wish = job.wish;
    FrameDescription preview = preview_of(figure->page, view, job.behind);
    show(std::move(preview), std::move(figure));
  };
  const std::vector<std::size_t> order = order_of(job);
  for (const std::size_t i : order) {
    if (token.cancelled()) return fail(ErrorCode::cancelled, "another figure is wanted");
    const FigureJob::Panel& panel = job.panels[i];
    const bool last = i == order.back();
    if (const auto* kept = job.drawn->find(panel.id, panel.look, panel.version)) {
      panels[i].frame = kept->frame;
      panels[i].scale = kept->scale;
      continue;
    }
    if (!panel.draw) {
      panels[i].problem = panel.why_empty.empty() ? "there is nothing to show" : first_line(panel.why_empty);
      continue;
    }
    const auto drawn = panel.draw(token, [&](FrameDescription frame, double scale) {
      panels[i].frame = std::move(frame);
      panels[i].scale = scale;
      if (last && panel.refines) show_page(false);
    });
    if (token.cancelled()) return fail(ErrorCode::cancelled, "another figure is wanted");
    if (!drawn) {
      panels[i].frame.reset();
      panels[i].problem = why_not(drawn.error(), job, i);
    } else if (panels[i].frame) {
      job.drawn->keep(panel.id, {panel.look, panel.version, *panels[i].frame, panels[i].scale});
    }
  }
  show_page(true);
  return {};
}

}  // namespace sonar
