// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/mask_middle.h"
#include "publish/picture_options.h"
#include "publish/picture_source.h"
#include "view/refused_marks.h"

namespace sonar {

/// Whether the options ask for a school of an observation.
[[nodiscard]] bool wanted(const ObservationProduct& product, std::int64_t school_id, const PictureOptions& options);

/// That of the strongest whole school that the options ask for; empty without any.
[[nodiscard]] std::optional<std::int64_t> strongest_schools_ping(const DrawnObservation& observation,
                                                                 const PictureOptions& options);
/// The ping to draw: the one asked for, else strongest_schools_ping(), else the middle one.
/// errors  usage: no such ping
[[nodiscard]] Result<std::int64_t> chosen_ping(const DrawnObservation& observation, const PictureOptions& options);

/// A ping's masks that the options choose, each in its school's colour, whether schools are shown or not.
[[nodiscard]] std::vector<MaskLayer> chosen_layers(const DrawnPing& ping, const PictureOptions& options);
/// Those that are shown.
[[nodiscard]] std::vector<MaskLayer> mask_layers(const DrawnPing& ping, const PictureOptions& options);

/// Those that are shown and take sound out of beams: of no school that a human rejected. Part of the ping.
[[nodiscard]] std::vector<const PingMask*> casting_shadow(const DrawnPing& ping, const PictureOptions& options);

/// A school of a ping as a key names it: "school 3, unreviewed". Rejected ones are grey, as their masks are.
struct DrawnSchoolKey {
  std::int64_t id = 0;  ///< SchoolRow::school_id
  Rgba8 colour;
  std::string status;
  std::string name;
};
/// Of the masks that the options choose, in their order, whether schools are shown or not.
[[nodiscard]] std::vector<DrawnSchoolKey> school_keys(const DrawnPing& ping, const PictureOptions& options);

/// The schools that the options ask for through all their pings, for tracks and trails; none where schools are not shown.
[[nodiscard]] TrailSubject trail_subject(const DrawnObservation& observation, const PictureOptions& options);

/// What of a ping was refused, where the options ask for it.
[[nodiscard]] std::vector<RefusedMark> drawn_refused(const DrawnObservation& observation, const Sector& sector,
                                                     std::int64_t ping_index, const PictureOptions& options);

/// Middle of the largest mask; empty without one.
[[nodiscard]] std::optional<MaskMiddle> middle_of_largest(const std::vector<MaskLayer>& masks, int beams);

/// The products with the schools that the options ask for; rows and masks of the others are left out. What is drawn of one
/// school stays one.
[[nodiscard]] std::vector<ObservationProduct> with_chosen_schools(std::vector<ObservationProduct> products,
                                                                  const PictureOptions& options);
[[nodiscard]] ObservationProduct with_chosen_schools(const ObservationProduct& product, const PictureOptions& options);

/// errors  usage: a school that the observation has not
[[nodiscard]] Result<void> require_schools(const DrawnObservation& observation, const PictureOptions& options);

}  // namespace sonar
