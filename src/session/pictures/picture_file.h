// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "base/describe.h"
#include "publish/picture_kind.h"
#include "publish/picture_params.h"

namespace sonar {

/// What is asked before a picture or a movie goes into a file; everything else is as the window shows it.
struct PictureFileParams {
  PaperParams paper{1600, 1200, 1.0};
  bool selected_school_alone = false;
  bool camera_of_window = true;
  bool seabed = true;
  PictureParams kind;
};

template <class Visitor>
void describe(Visitor& v, PictureFileParams& p) {
  describe(v, p.paper);
  v.field("selected_school_alone", p.selected_school_alone, {.text = "draw the selected school and no other"});
  v.field(
      "camera_of_window", p.camera_of_window,
      {.text = "look from where the window does; off = from the eye named below, or an overview", .suits = "volume"});
  v.field("seabed", p.seabed, {.text = "draw the seabed of the depth chart, where one is chosen", .suits = "volume"});
  describe(v, p.kind);
}

/// Which of them matter for a kind of picture, or for a movie of it, in the order in which they are asked for.
[[nodiscard]] std::vector<std::string> asked_for(PictureKind kind, bool movie = false);

}  // namespace sonar
