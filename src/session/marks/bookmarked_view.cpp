// SPDX-License-Identifier: Apache-2.0
#include "session/marks/bookmarked_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "pipeline/recipe/json_parameters.h"

namespace sonar {
namespace {

using nlohmann::json;

constexpr double kFarthest_m = 1e6;
constexpr std::array<std::string_view, 3> kCameraParts{"eye_m", "target_m", "up"};

template <class Visitor>
void describe(Visitor& v, BookmarkedView& view) {
  v.field("fan", view.slices.fan, {});
  v.field("beam", view.slices.beam, {});
  v.field("sample", view.slices.sample, {});
  v.field("slices_locked", view.slices_locked, {});
  v.group("plane", view.plane, {});
}

json to_json(const Camera& camera) {
  const std::array<Point<Sonar>, 3> parts{camera.eye, camera.target, camera.up};
  json out = json::object();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    out[std::string(kCameraParts[i])] = {parts[i].x, parts[i].y, parts[i].z};
  }
  return out;
}

std::optional<Point<Sonar>> point_of(const json& from, std::string_view name) {
  const auto found = from.find(std::string(name));
  if (found == from.end() || !found->is_array() || found->size() != 3) return std::nullopt;
  std::array<double, 3> at{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(*found)[i].is_number()) return std::nullopt;
    at[i] = (*found)[i].get<double>();
    if (!(std::abs(at[i]) <= kFarthest_m)) return std::nullopt;
  }
  return Point<Sonar>{at[0], at[1], at[2]};
}

std::optional<Camera> camera_of(const json& from) {
  if (!from.is_object()) return std::nullopt;
  const auto eye = point_of(from, kCameraParts[0]);
  const auto target = point_of(from, kCameraParts[1]);
  const auto up = point_of(from, kCameraParts[2]);
  if (!eye || !target || !up || !(norm(*eye - *target) > 0.0)) return std::nullopt;
  Camera camera;
  camera.eye = *eye;
  camera.target = *target;
  camera.up = *up;
  return camera;
}

}  // namespace

BookmarkedView view_now(const Workspace& workspace) {
  BookmarkedView view;
  view.slices = workspace.slices();
  view.slices_locked = workspace.slices_locked();
  view.plane = workspace.plane.values();
  view.camera = workspace.camera();
  const auto& shown = workspace.document.shown();
  const auto& school = workspace.school();
  if (school && shown && school->observation == shown->index()) view.school = school->number;
  return view;
}

void look_again(Workspace& workspace, const BookmarkedView& view) {
  const auto& shown = workspace.document.shown();
  if (!shown) return;
  workspace.slices_locked.set(true);  // slices stay where they are laid now, whatever is selected
  const auto& schools = workspace.document.state().schools;
  const bool there = std::ranges::any_of(schools, [&](const auto& one) { return one->number == view.school; });
  workspace.school.set(there ? std::optional(SchoolName{shown->index(), view.school}) : std::nullopt);
  const Sector& sector = shown->sector();
  workspace.slices.set({std::clamp(view.slices.fan, 0, sector.fans() - 1),
                        std::clamp(view.slices.beam, 0, sector.beams() - 1),
                        std::clamp(view.slices.sample, 0, std::max(0, sector.range().count - 1))});
  workspace.plane.assign(view.plane);
  workspace.plane.assign(view.plane);  // the choice of another kind of plane alone lays it anew
  workspace.camera.set(view.camera);
  workspace.slices_locked.set(view.slices_locked);
}

std::string text_of(const BookmarkedView& view) {
  BookmarkedView copy = view;
  JsonWriter writer;
  describe(writer, copy);
  json out = writer.json();
  if (view.camera) out["camera"] = to_json(*view.camera);
  if (view.school != 0) out["school"] = view.school;
  return out.dump();
}

std::optional<BookmarkedView> bookmarked_view(const std::string& text) {
  const json from = json::parse(text, nullptr, false);
  if (!from.is_object()) return std::nullopt;
  BookmarkedView view;
  JsonReader reader(from);
  describe(reader, view);
  if (!reader.problem().empty()) return std::nullopt;
  if (const auto camera = from.find("camera"); camera != from.end()) view.camera = camera_of(*camera);
  if (const auto school = from.find("school"); school != from.end() && school->is_number_integer()) {
    view.school = school->get<std::int64_t>();
  }
  return view;
}

}  // namespace sonar
