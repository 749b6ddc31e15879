// SPDX-License-Identifier: Apache-2.0
#include "session/pictures/picture_sentence.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "base/number_text.h"
#include "session/open/survey_schools.h"
#include "session/slices/slice_places.h"

namespace sonar {
namespace {

constexpr std::array<std::pair<std::string_view, SliceKind>, 4> kSliceDocks{{{"top_slice", SliceKind::top},
                                                                             {"side_slice", SliceKind::side},
                                                                             {"range_slice", SliceKind::range},
                                                                             {"plane_slice", SliceKind::plane}}};

std::string plane_words(const PlanePlace& place, const Unit& length) {
  switch (place.lies) {
    case PlaneSlice::Kind::horizontal:
      return fmt::format("Horizontal slice at {} depth", quantity_text(place.depth_m, 1, length));
    case PlaneSlice::Kind::vertical:
      return fmt::format("Vertical slice along {:.0f} degrees", place.bearing_deg);
    case PlaneSlice::Kind::oblique:
      break;
  }
  return fmt::format("Oblique slice along {:.0f} degrees, tilted by {:.0f} degrees", place.bearing_deg, place.tilt_deg);
}

std::string slice_words(const Workspace& workspace, SliceKind kind) {
  const SlicePlaces& places = workspace.slices();
  const Unit length = workspace.units().length();
  switch (kind) {
    case SliceKind::top:
      return fmt::format("Slice of fan {}", places.fan);
    case SliceKind::side:
      return fmt::format("Slice of beam {}", places.beam);
    case SliceKind::range:
      return fmt::format("Slice at {} range",
                         quantity_text(workspace.document.shown()->sector().range().range_m(places.sample), 1, length));
    case SliceKind::plane:
      break;
  }
  return plane_words(workspace.plane.values(), length);
}

/// What it shows without the ping: "Slice of fan 7", "Volume".
std::string what(const AppModel& app, const PictureDock& dock) {
  const auto slice =
      std::find_if(kSliceDocks.begin(), kSliceDocks.end(), [&](const auto& one) { return one.first == dock.id; });
  if (slice != kSliceDocks.end()) return slice_words(app.workspace, slice->second);
  const MotionBetween& motion = app.workspace.motion();
  // What has been left is not drawn any more.
  const bool moves = motion.from && motion.to && motion.from == app.workspace.document.staged();
  if (dock.id != "volume" || !moves) return dock.title;
  return fmt::format("{}, interpolated between pings {} and {}", dock.title, motion.from->ping_index,
                     motion.to->ping_index);
}

/// "obs-0001, ping 66 of 78, 3 schools".
std::string ping_words(const Document& document) {
  const OpenObservation& shown = *document.shown();
  const auto& schools = document.state().schools;
  const auto here = std::count_if(schools.begin(), schools.end(), [&](const auto& school) {
    return in_ping(school->masks, document.ping()) != nullptr;
  });
  return fmt::format("{}, ping {} of {}, {}", shown.name(), document.ping(), shown.files().navigation.size(),
                     count_of(static_cast<std::size_t>(here), "school"));
}

}  // namespace

std::string picture_sentence(const AppModel& app, const std::string& id) {
  const auto dock =
      std::find_if(app.pictures.begin(), app.pictures.end(), [&](const PictureDock& one) { return one.id == id; });
  if (dock == app.pictures.end()) return {};
  const LivePicture& picture = *dock->picture;
  if (!picture.problem().empty()) return picture.problem();
  const Document& document = app.workspace.document;
  if (picture.image().pixels.empty() || document.survey() == nullptr) {
    const std::string why = idle_text(app, id);
    return why.empty() ? dock->title + ": nothing is shown yet." : why;
  }
  if (!document.shown()) {
    return fmt::format("{}, {}.", dock->title, count_of(document.survey()->observations.size(), "observation"));
  }
  std::string sentence = what(app, *dock) + ", " + ping_words(document);
  if (const auto school = selected_school(app.workspace)) {
    sentence += ", " + title_of(document, school->name) + " is selected";
  }
  return sentence + ".";
}

}  // namespace sonar
