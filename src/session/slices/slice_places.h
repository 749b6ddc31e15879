// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "session/open/workspace.h"

namespace sonar {

// Where the window's slices lie, and what moves them.

inline constexpr std::array<SliceKind, 4> kSliceKinds{SliceKind::top, SliceKind::side, SliceKind::range,
                                                      SliceKind::plane};

/// A slice of the observation on show, as it lies in a ping of it.
/// needs  an observation on show
[[nodiscard]] Slice live_slice(const Workspace& workspace, SliceKind kind, std::int64_t ping_index);
/// Parameters of pictures whose range and plane slices lie where the window's do, the plane to a millimetre.
/// needs  an observation on show
[[nodiscard]] PictureParams at_live_places(const Workspace& workspace, PictureParams params);
/// Whether a slice's view is switched on.
[[nodiscard]] bool switched_on(const Workspace& workspace, SliceKind kind);
/// Switches a slice's view on.
void switch_on(Workspace& workspace, SliceKind kind);

/// What one step moves a range or plane slice by: a round number, about a hundredth of the sector's reach.
[[nodiscard]] double slice_step_m(const Sector& sector);
/// To the next fan, beam, range or plane: fans, beams and ranges by their number, planes up or away from the viewer.
/// Ends where the sector does. Nothing without an observation.
/// fine  a single sample of range
void step_slice(Workspace& workspace, SliceKind kind, int by, bool fine = false);
/// Turns a vertical or oblique plane slice clockwise, about the selected school where the ping has it, else about the
/// sonar.
void turn_plane(Workspace& workspace, double by_deg);

/// Lays slices through a voxel, a plane without turning it. Nothing without an observation.
void lay_slices_through(Workspace& workspace, const Voxel& voxel, std::span<const SliceKind> kinds = kSliceKinds);
/// Lays the plane slice anew: through the selected school where the ping has it, else through the sector's middle.
void lay_plane(Workspace& workspace);
/// Lays the plane slice as another kind of plane, and switches it on.
void choose_plane(Workspace& workspace, PlaneSlice::Kind kind);
/// Lays the plane slice upright through two places of the ping on show, and switches it on.
void lay_section(Workspace& workspace, const Point<Sonar>& a, const Point<Sonar>& b);

/// The middle of the selected school in the ping looked at, where it is there.
[[nodiscard]] std::optional<Voxel> selected_middle(const Workspace& workspace);

}  // namespace sonar
