// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "session/open/workspace.h"

namespace sonar {

/// What a bookmark leads back to, beside its ping.
struct BookmarkedView {
  SlicePlaces slices;
  bool slices_locked = false;
  PlanePlace plane;
  std::optional<Camera> camera;  ///< empty = the overview
  std::int64_t school = 0;       ///< number of the selected one; 0 = none
  friend bool operator==(const BookmarkedView&, const BookmarkedView&) = default;
};

[[nodiscard]] BookmarkedView view_now(const Workspace& workspace);
/// In the observation on show; what it lacks by now stays as it is.
void look_again(Workspace& workspace, const BookmarkedView& view);

/// A JSON object.
[[nodiscard]] std::string text_of(const BookmarkedView& view);
/// What the text lacks is as in a new view. Empty where it holds no view, or one that no window has.
[[nodiscard]] std::optional<BookmarkedView> bookmarked_view(const std::string& text);

}  // namespace sonar
