// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "base/array.h"
#include "base/work.h"
#include "model/navigation.h"
#include "publish/picture_options.h"
#include "publish/picture_source.h"

namespace sonar {

// Pictures between two pings, for movies. Nothing is measured on them.

/// The ship part of the way from one ping to the next: time, place and speed on a straight line, angles the shorter way
/// round. What one of them does not know is not known.
/// fraction  0 = the first, 1 = the second
[[nodiscard]] PingNavigation navigation_between(const PingNavigation& a, const PingNavigation& b, double fraction);

/// Sv part of the way from one ping to the next, voxel by voxel in the ship's frame, in linear units. Where one has no data
/// it is as in the nearer ping.
/// in      [fan][beam][sample], counts; other shapes than a's: the nearer one as it is
[[nodiscard]] Array3<std::int16_t> counts_between(const Array3<std::int16_t>& a, const Array3<std::int16_t>& b,
                                                  double fraction, Work& work);

/// The stages of a ping part of the way to the next: Sv interpolated, recorded and filtered alike; flags and the rest are
/// those of the nearer of both, whose index it has.
[[nodiscard]] std::shared_ptr<const StagedPing> staged_between(const StagedPing& a, const StagedPing& b,
                                                               double fraction, Work& work);

/// The ping, or what lies options.towards_next of the way to the next: navigation and samples interpolated, flags, masks
/// and the rest those of the nearer of both, whose index it has.
/// errors  as DrawnObservation::ping()
[[nodiscard]] Result<DrawnPing> drawn_ping(DrawnObservation& observation, std::int64_t ping_index,
                                           const PictureOptions& options, Work& work);

}  // namespace sonar
