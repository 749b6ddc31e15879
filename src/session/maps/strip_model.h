// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "session/listening.h"
#include "session/live/live_picture.h"
#include "session/maps/masked_pings.h"
#include "session/open/workspace.h"
#include "view/volume/propagation_view.h"

namespace sonar {

/// Where each ping of a strip lies, for pointers.
struct StripPlaces {
  struct Pane {
    std::int64_t ping = 0;
    PixelRect place;
    bool school = false;  ///< shows a mask
    std::string note;     ///< why a propagation ended there
  };
  std::vector<Pane> panes;
  [[nodiscard]] const Pane* pane_at(PixelPoint at) const;
};

/// Neighbouring pings side by side, each with its masks: how a school goes through time. It follows the ping on show, can
/// be scrolled away from it (wheel, dragging), shows more or fewer pings (Ctrl and wheel), and fills while a propagation
/// runs. A click looks at a ping.
class StripModel : public LivePicture {
 public:
  explicit StripModel(Workspace& workspace);

  void pointer(const PointerEvent& event) override;
  bool aim(PixelPoint at) override;
  [[nodiscard]] std::string hint(PixelPoint at) const override;
  [[nodiscard]] MaskAspect aspect() const { return aspect_; }
  void set_aspect(MaskAspect aspect);
  /// First ping of the strip, and how many it shows.
  [[nodiscard]] std::int64_t first() const;
  [[nodiscard]] int panes() const;
  /// Of the picture on show; null before the first.
  [[nodiscard]] const std::shared_ptr<const StripPlaces>& places() const { return places_; }

 protected:
  [[nodiscard]] Build build(const PictureLook& look) override;
  void take(const std::shared_ptr<const void>& detail) override;

 private:
  struct Press {
    PixelPoint at;
    std::int64_t first = 0;
    bool moved = false;
  };
  void hear(DocumentChange change);
  void follow();
  void scroll_to(std::int64_t first);
  [[nodiscard]] std::int64_t last_first() const;
  [[nodiscard]] int panes_in(const PictureLook& look) const;
  /// Of so many panes.
  [[nodiscard]] std::int64_t first_of(int panes) const;

  Workspace& workspace_;
  MaskAspect aspect_ = MaskAspect::above;
  std::int64_t centre_ = 0;  ///< ping in the middle, where there are enough to both sides
  int more_panes_ = 0;       ///< than the width suggests
  std::int64_t clicked_ = -1;
  std::optional<Press> press_;
  double wheel_ = 0.0;  ///< steps that make no whole one yet
  RunningMasks running_;
  std::shared_ptr<const StripPlaces> places_;
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
