// SPDX-License-Identifier: Apache-2.0
#include "session/slices/school_layers.h"

#include <algorithm>
#include <set>
#include <utility>

#include "session/looks/selection.h"
#include "view/school_look.h"

namespace sonar {
namespace {

/// The colour of what a propagation carries: the selected school's, else the one that the next school will have.
Rgba8 carried_colour(const Workspace& workspace, const Theme& theme) {
  const JournalState& state = workspace.document.state();
  const auto selected = workspace.selected();
  if (selected) return drawn_colour(*state.schools[*selected], theme);
  return school_colour(static_cast<int>(state.next_number));
}

}  // namespace

Rgba8 drawn_colour(const StateSchool& school, const Theme& theme) {
  if (school.masks.decided.status == "rejected") return theme.muted;
  return school_colour(static_cast<int>(school.number));
}

Rgba8 preview_colour() { return {0, 240, 240, 255}; }

MaskLayer mask_layer(std::shared_ptr<const PingMask> mask, Rgba8 colour, const std::string& status) {
  const auto share = [](std::uint8_t v) { return static_cast<float>(v) / 255.0F; };
  return {std::move(mask), {share(colour.r), share(colour.g), share(colour.b)}, status_line(status)};
}

std::vector<SchoolLayer> school_layers(const Workspace& workspace, std::int64_t ping_index, const Theme& theme) {
  std::vector<SchoolLayer> layers;
  const DisplayParams& display = workspace.display.values();
  const Document& document = workspace.document;
  const Preview& preview = workspace.preview();
  const bool previewed = preview.mask && preview.ping_index == ping_index;
  if (!document.shown()) return layers;
  const std::size_t observation = document.shown()->index();
  const std::set<SchoolName> selected = selection(workspace);
  for (const auto& school : document.state().schools) {
    if (!display.masks) break;
    const auto* there = in_ping(school->masks, ping_index);
    const bool rejected = school->masks.decided.status == "rejected";
    const bool replaced = previewed && preview.instead_of == school->number;
    if (there == nullptr || replaced || (rejected && !display.rejected)) continue;
    // The mask lives in the school, which the layer keeps.
    layers.push_back({school->number, selected.contains({observation, school->number}),
                      mask_layer(std::shared_ptr<const PingMask>(school, &there->mask), drawn_colour(*school, theme),
                                 school->masks.decided.status),
                      school_title(*school), !rejected});
  }
  // The one that acts are about has the first choice of a place for its name.
  const auto acted_on = [&](const SchoolLayer& layer) {
    return workspace.school() == SchoolName{observation, layer.number};
  };
  if (selected.size() > 1) std::stable_partition(layers.begin(), layers.end(), acted_on);
  if (const auto found = document.propagating().find(ping_index);
      found != document.propagating().end() && display.masks) {
    layers.push_back(
        {0, false, mask_layer(std::make_shared<const PingMask>(found->second), carried_colour(workspace, theme), {})});
  }
  if (previewed) layers.push_back({0, false, mask_layer(preview.mask, preview_colour(), {})});
  return layers;
}

std::shared_ptr<const PingMask> fuzzy_area(std::shared_ptr<const PingMask> mask, double fuzzy_above) {
  if (!mask || !(fuzzy_above > 0.0)) return mask;
  auto left = std::make_shared<PingMask>();
  std::size_t i = 0;
  for (const Run& run : mask->runs) {
    bool open = false;
    for (int s = run.first_sample; s < run.end(); ++s, ++i) {
      const bool inside = mask->confidence[i] / 255.0 > fuzzy_above;
      if (inside && !open) left->runs.push_back({run.row, s, 0});
      if (inside) {
        ++left->runs.back().count;
        left->confidence.push_back(mask->confidence[i]);
      }
      open = inside;
    }
  }
  return left;
}

}  // namespace sonar
