// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "session/listening.h"
#include "session/live/live_picture.h"
#include "session/open/workspace.h"
#include "session/timelines/time_window.h"
#include "view/lineage/lineage.h"

namespace sonar {

/// What a lineage shows, and where.
struct LineageSight {
  std::size_t observation = 0;
  LineageData data;
  Lineage drawn;
  TimelinePlaces places;
  /// The last ping that begins left of a place.
  [[nodiscard]] std::int64_t ping_at(double x_px) const;
  /// The lane at a place, 0 = top; those behind lanes.size() are free. Empty outside the plot.
  [[nodiscard]] std::optional<std::size_t> lane_at(PixelPoint at) const;
  /// The school whose lane it is.
  [[nodiscard]] const LineageSchool* school_at(PixelPoint at) const;
  /// Where a school is in a ping: the middle of its lane.
  [[nodiscard]] PixelPoint place_of(std::int64_t school_id, std::int64_t ping) const;
};

/// Schools of the observation on show over time, a lane each, as their journal leaves them. A press selects a school and
/// goes to a ping, dragging along the lane goes on through pings, Shift and dragging marks an interval. A bar that is dragged onto another
/// lane is joined to that school; out of the marked interval only what the school has in it is handed over. On the free
/// lane at the bottom the interval's piece, or all from the ping that was pressed on, becomes a school of its own.
class LineageModel : public LivePicture {
 public:
  explicit LineageModel(Workspace& workspace);

  void pointer(const PointerEvent& event) override;
  bool cancel_drag() override;
  [[nodiscard]] bool pans() const override { return true; }
  bool aim(PixelPoint at) override;
  [[nodiscard]] std::vector<Overlay> overlays() const override;
  [[nodiscard]] std::string hint(PixelPoint at) const override;
  /// Of the picture on show; null without one.
  [[nodiscard]] const std::shared_ptr<const LineageSight>& sight() const { return sight_; }
  /// All of the time axis again.
  void show_all();

 protected:
  [[nodiscard]] Build build(const PictureLook& look) override;
  void take(const std::shared_ptr<const void>& detail) override;

 private:
  /// A bar that was pressed on.
  struct Held {
    std::int64_t school = 0;
    std::int64_t ping = 0;
    PixelPoint from;
    PixelPoint at;
  };
  void hear(DocumentChange change);
  void press(const PointerEvent& event);
  void move(const PointerEvent& event);
  void release(PixelPoint at);
  void drop(const Held& held, std::int64_t onto);
  void drop_free(const Held& held);
  void mark(std::int64_t to);
  void go_to(std::int64_t ping);
  /// The sight, where the observation that it shows is still on show.
  [[nodiscard]] const LineageSight* current() const;
  [[nodiscard]] std::optional<MarkedInterval> interval_of(const Held& held) const;
  [[nodiscard]] std::optional<SchoolKey> key_of_school(std::int64_t number) const;
  /// What letting go there would do; empty = nothing.
  [[nodiscard]] std::string would_do(const Held& held) const;

  Workspace& workspace_;
  TimeWindow window_;
  std::weak_ptr<const int> shown_of_;  ///< identity of the observation on show
  std::optional<std::int64_t> marking_from_;
  bool scrubbing_ = false;
  std::optional<Held> held_;
  std::shared_ptr<const LineageSight> sight_;
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
