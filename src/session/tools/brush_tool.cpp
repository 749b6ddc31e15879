// SPDX-License-Identifier: Apache-2.0
#include "session/tools/brush_tool.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "session/tools/growth.h"

namespace sonar {
namespace {

/// Square of the distance from a place to the line between two others.
double distance2(PixelPoint p, PixelPoint a, PixelPoint b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double length2 = dx * dx + dy * dy;
  const double t = length2 > 0.0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length2, 0.0, 1.0) : 0.0;
  const double ex = p.x - a.x - t * dx;
  const double ey = p.y - a.y - t * dy;
  return ex * ex + ey * ey;
}

/// Samples that may lie between two neighbouring pixels of one beam.
int samples_between_pixels(const SliceMap& map) {
  const double pixel_m = std::abs(map.extent().x1 - map.extent().x0) / map.size().width;
  const double samples = 3.0 * pixel_m / map.sector().range().spacing_m;  // the diagonal, and steep fans
  return static_cast<int>(std::ceil(std::clamp(samples, 1.0, 1.0 * map.sector().range().count)));
}

/// Row and sample of voxels, sorted, as runs; gaps up to a limit are closed.
std::vector<Run> joined(const std::vector<std::int32_t>& voxels, int samples, int gap) {
  std::vector<Run> runs;
  for (const std::int32_t voxel : voxels) {
    const int row = voxel / samples;
    const int sample = voxel % samples;
    if (!runs.empty() && runs.back().row == row && sample <= runs.back().end() + gap) {
      runs.back().count = sample + 1 - runs.back().first_sample;
    } else {
      runs.push_back({row, sample, 1});
    }
  }
  return runs;
}

std::vector<RunKey> keys_of(const PingMask& mask, const BeamGrid& grid) {
  std::vector<RunKey> keys;
  for (const Run& run : mask.runs) {
    keys.push_back({grid.channel[static_cast<std::size_t>(run.row)], run.first_sample, run.count});
  }
  return keys;
}

}  // namespace

std::vector<Run> runs_under(const SliceMap& map, PixelPoint from, PixelPoint to, double radius_px) {
  const auto first = [&](double a, double b) { return static_cast<int>(std::floor(std::min(a, b) - radius_px)); };
  const auto last = [&](double a, double b) { return static_cast<int>(std::ceil(std::max(a, b) + radius_px)); };
  const PixelSize size = map.size();
  std::vector<std::int32_t> voxels;
  for (int y = std::max(0, first(from.y, to.y)); y <= std::min(size.height - 1, last(from.y, to.y)); ++y) {
    for (int x = std::max(0, first(from.x, to.x)); x <= std::min(size.width - 1, last(from.x, to.x)); ++x) {
      if (distance2({x + 0.5, y + 0.5}, from, to) > radius_px * radius_px) continue;
      const std::int32_t voxel = map.voxels()[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
                                              static_cast<std::size_t>(x)];
      if (voxel >= 0) voxels.push_back(voxel);
    }
  }
  std::sort(voxels.begin(), voxels.end());
  voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
  return joined(voxels, map.sector().range().count, samples_between_pixels(map));
}

PingMask that_can_belong(const std::vector<Run>& runs, View3<const SampleFlags> flags) {
  PingMask mask;
  for (const Run& run : runs) {
    bool open = false;
    for (int s = run.first_sample; s < run.end(); ++s) {
      const bool inside = !any(flags.row(run.row)[static_cast<std::size_t>(s)] & kNeverMember);
      if (inside && !open) mask.runs.push_back({run.row, s, 0});
      if (inside) {
        ++mask.runs.back().count;
        mask.confidence.push_back(255);
      }
      open = inside;
    }
  }
  return mask;
}

BrushTool::BrushTool(Workspace& workspace)
    : workspace_(workspace),
      listening_(workspace.document.changes(), [this](DocumentChange change) { hear(change); }) {}

void BrushTool::press(const SliceMap& map, PixelPoint at, bool erase, double scale) {
  const Document& document = workspace_.document;
  if (!document.shown() || !document.staged() || drawing()) return;
  observation_ = document.shown();
  ping_ = document.staged();
  erase_ = erase;
  scale_ = scale;
  last_ = at;
  stroke_ = {};
  paint(map, at);
}

void BrushTool::move(const SliceMap& map, PixelPoint at) {
  if (drawing()) paint(map, at);
}

void BrushTool::paint(const SliceMap& map, PixelPoint to) {
  const auto runs = runs_under(map, last_, to, workspace_.brush_px() * scale_);
  last_ = to;
  stroke_ = unite(stroke_, that_can_belong(runs, ping_->filtered->flags.view()));
  Preview preview;
  preview.ping_index = ping_->ping_index;
  preview.mask = std::make_shared<const PingMask>(stroke_);
  preview.text = (erase_ ? "erase " : "paint ") + growth_text(stroke_, *ping_, observation_->sector());
  workspace_.preview.set(std::move(preview));
}

void BrushTool::release() {
  if (!drawing()) return;
  const PingMask stroke = std::exchange(stroke_, {});
  const StagedPingPtr ping = std::exchange(ping_, nullptr);
  const OpenObservationPtr observation = std::exchange(observation_, nullptr);
  workspace_.preview.set({});
  if (stroke.empty()) return workspace_.document.tell("nothing there can belong to a school");
  std::optional<SchoolKey> school;
  if (const auto selected = workspace_.selected()) {
    const SchoolMasks& masks = workspace_.document.state().schools[*selected]->masks;
    const bool there = in_ping(masks, ping->ping_index) != nullptr;
    if (!erase_ || there) school = key_of(masks, observation->context());
  }
  const auto keys = keys_of(stroke, observation->grid());
  const bool makes = !erase_ && !school;
  Command command = erase_ ? Command(EraseCommand{keys, school}) : Command(BrushCommand{keys, school});
  const ActTicket ticket = workspace_.document.act(observation->index(), ping->ping_index, std::move(command));
  selects_ = makes ? ticket : 0;
}

void BrushTool::cancel() {
  if (!drawing()) return;
  stroke_ = {};
  ping_.reset();
  observation_.reset();
  workspace_.preview.set({});
}

void BrushTool::hear(DocumentChange change) {
  const Document& document = workspace_.document;
  if (change == DocumentChange::survey) selects_ = 0;  // another act's there
  if (change == DocumentChange::observation || change == DocumentChange::survey) {
    if (!same_observation(observation_, document.shown())) cancel();
    return;
  }
  const ChoicesShown& now = document.choices();
  if (change != DocumentChange::state || selects_ == 0 || now.ticket != selects_) return;
  selects_ = 0;
  if (now.done_line == 0) return;
  for (const auto& school : document.state().schools) {
    if (school->made_by == now.done_line) workspace_.school.set(SchoolName{document.shown()->index(), school->number});
  }
}

}  // namespace sonar
