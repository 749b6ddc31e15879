// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "model/transect.h"
#include "model/transfer_function.h"
#include "pipeline/exports/reduce.h"
#include "pipeline/integrate/integrate_params.h"
#include "session/change_queue.h"
#include "session/listening.h"
#include "session/looks/display.h"
#include "session/looks/window_params.h"
#include "session/numbers/fish_params.h"
#include "session/open/document.h"
#include "session/pictures/picture_file.h"
#include "session/recipes/parameters.h"
#include "session/slices/plane_place.h"
#include "session/timelines/timeline_limits.h"
#include "session/tools/measurement.h"
#include "view/figures/figure_params.h"
#include "view/slices/slice.h"
#include "view/volume/camera.h"

namespace sonar {

/// A value that views share; those who listen hear of every change.
template <class T>
class Shared {
 public:
  explicit Shared(T value = {}) : value_(std::move(value)) {}
  [[nodiscard]] const T& operator()() const { return value_; }
  void set(T value) {
    if (value == value_) return;
    value_ = std::move(value);
    changed_.tell();
  }
  [[nodiscard]] Listeners<>& changed() { return changed_; }

 private:
  T value_;
  Listeners<> changed_;
};

/// A school of the survey as windows name it.
struct SchoolName {
  std::size_t observation = 0;  ///< index in the survey
  std::int64_t number = 0;      ///< StateSchool::number
  friend auto operator<=>(const SchoolName&, const SchoolName&) = default;
};

/// An echo that detection refused, as windows name it.
struct EchoName {
  std::size_t observation = 0;  ///< index in the survey
  std::int64_t id = 0;          ///< RefusedEcho::echo_id
  friend bool operator==(const EchoName&, const EchoName&) = default;
};

/// What a click would select, or what is being tried: drawn over the ping, part of nothing yet.
struct Preview {
  std::int64_t ping_index = -1;
  std::shared_ptr<const PingMask> mask;  ///< null = none
  std::string text;                      ///< "1 204 voxels, 3.1e4 m3, mean -48.2 dB", or why nothing grows
  std::int64_t instead_of = 0;           ///< number of the school that would be replaced by it; 0 = none
  double grown_ms = 0.0;                 ///< from the wish until it had grown, for the developer's overlay
  friend bool operator==(const Preview&, const Preview&) = default;
};

/// What a click does; `section` is for one drag, which lays the plane slice.
enum class ToolName : std::uint8_t { seed, brush, eraser, section, measure };

/// Pings of an observation that were marked on a timeline, both included.
struct MarkedInterval {
  std::size_t observation = 0;
  std::int64_t first_ping = 0;
  std::int64_t last_ping = 0;
  friend bool operator==(const MarkedInterval&, const MarkedInterval&) = default;
};

/// A mark on a timeline that was clicked: what Delete takes away.
struct ChosenMark {
  std::size_t observation = 0;
  std::variant<EventCommand, BadPingsCommand> what;
  friend bool operator==(const ChosenMark&, const ChosenMark&) = default;
};

/// Transects of the survey, and the table that told them; empty = none.
struct SurveyTransects {
  std::filesystem::path file;
  std::vector<Transect> periods;
  friend bool operator==(const SurveyTransects&, const SurveyTransects&) = default;
};

/// Where slices lie; Workspace::plane tells it of the plane slice.
struct SlicePlaces {
  int fan = 0;     ///< of the top slice
  int beam = 0;    ///< of the side slice
  int sample = 0;  ///< of the range slice
  friend bool operator==(const SlicePlaces&, const SlicePlaces&) = default;
};

/// The slice that a hand was on last: other views are about it. And what part of it is shown; empty = all.
struct SliceInUse {
  SliceKind kind = SliceKind::top;
  std::optional<SliceExtent> extent;
  friend bool operator==(const SliceInUse&, const SliceInUse&) = default;
};

/// Playing is on its way from one ping to the next.
struct MotionBetween {
  StagedPingPtr from;  ///< null = it is not: pings are as measured
  StagedPingPtr to;
  double fraction = 0.0;  ///< of the way that lies behind, 0 <= x < 1
  friend bool operator==(const MotionBetween&, const MotionBetween&) = default;
};

/// Everything that the views of one window share: the document, the parameters, and what is pointed at.
/// threads  the window's
struct Workspace {
  Workspace(ChangeQueue& changes, DocumentOptions options);

  ChangeQueue& queue;
  Document document;

  Parameters<DisplayParams> display;
  Parameters<SelectParams> select;
  Parameters<VolumeParams> volume;
  Parameters<TimelineLimits> timelines;
  Parameters<ViewSwitches> views;
  Parameters<PictureFileParams> picture_file;
  Parameters<ReduceParams> reduce;
  Parameters<IntegrateParams> integrate;
  Parameters<FishParams> fish;
  Parameters<PlanePlace> plane;  ///< where the plane slice lies; of the observation, not a preference
  Parameters<WindowParams> window;
  Parameters<FigureParams> figure;  ///< several views on a page

  /// View curve: colours and opacity of the volume; growth curve: what mode paper grows on. Linked, both have
  /// the same opacity.
  Shared<TransferFunction> view_curve;
  Shared<TransferFunction> growth_curve;
  Shared<bool> curves_linked{false};
  /// The view curve is the scale's (display.scale) until a human changes it.
  Shared<bool> curve_follows_scale{true};

  Shared<std::optional<Voxel>> cursor;  ///< the voxel pointed at, in the ping looked at
  Shared<SlicePlaces> slices;           ///< where the slices lie
  Shared<SliceInUse> slice_in_use;
  Shared<bool> slices_locked{false};         ///< they stay where they are, whatever is selected
  Shared<std::optional<SchoolName>> school;  ///< the selected school
  /// All that are selected, where a table has several; else empty. A school that is none of them ends it.
  Shared<std::set<SchoolName>> chosen_schools;
  Shared<std::optional<EchoName>> echo;  ///< the refused echo last pointed at or chosen: its mark is highlighted
  Shared<Preview> preview;
  Shared<ToolName> tool;
  Shared<int> brush_px{12};                        ///< radius of brush and eraser on the screen
  Shared<std::optional<Measurement>> measurement;  ///< the last one; a survey or observation that goes ends it
  Shared<bool> measure_all_fans{false};            ///< areas of slices from above go through all fans
  Shared<bool> dark{false};
  Shared<Units> units;                                    ///< that numbers are read in, as the preferences have it
  Shared<std::filesystem::path> depth_raster;             ///< under the survey map; empty = none
  Shared<SurveyTransects> transects;                      ///< on maps and timelines, and among the marks
  Shared<std::optional<MarkedInterval>> marked_interval;  ///< on a timeline
  Shared<std::optional<ChosenMark>> mark;                 ///< on a timeline; another school or survey ends it
  Shared<std::optional<Camera>> camera;                   ///< of the volume; empty = the overview
  Shared<bool> latencies{false};                          ///< how long each picture took, over it: for developers
  Shared<MotionBetween> motion;                           ///< what the volume shows of playing, beside pings

  /// Index in the state of the selected school, where it is in the observation on show.
  [[nodiscard]] std::optional<std::size_t> selected() const;

 private:
  /// Gives one curve the other's opacity where they are linked; colours are the view curve's alone.
  void link(bool from_view);
  bool linking_ = false;
  Listening listening_;  // the last member: it ends first
};

/// The cursor's read-out, each empty where it is unknown. Position in degrees and decimal minutes, time UTC, lengths and
/// the ship's speed in the user's units, its log in nautical miles.
struct ReadOut {
  std::string sv, fan, beam, sample, range, depth, bearing, latitude, longitude, time, flags, school, ship, log;
  /// "Sv -48.2 dB, fan 7, beam 12, ...": what one key copies.
  [[nodiscard]] std::string line() const;
};
/// Sv of a voxel of the ping on show, filtered where slices are, dB; NaN where there is none.
[[nodiscard]] double shown_sv_db(const Workspace& workspace, const Voxel& voxel);
[[nodiscard]] ReadOut read_out(const Workspace& workspace, const Voxel& voxel);

}  // namespace sonar
