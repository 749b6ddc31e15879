// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "session/echograms/echogram_build.h"
#include "session/echograms/echogram_shadows.h"
#include "session/listening.h"
#include "session/live/live_picture.h"
#include "session/open/workspace.h"
#include "session/timelines/echograms.h"

namespace sonar {

/// Sv of one beam or fan of the observation on show against time, as far as it is read, with the schools in it; below it, or
/// where nothing has fans, a channel of a sounder of single beams. It follows the slices' fan and beam unless it is held. A
/// click goes to a ping, the wheel zooms time about the pointer and with Ctrl the upright axis, dragging with the middle
/// button pans, a double press shows everything. The cursor is that of the other views.
class EchogramModel : public LivePicture {
 public:
  /// echograms  may be shared with timelines of the survey
  EchogramModel(Workspace& workspace, std::shared_ptr<Echograms> echograms);
  ~EchogramModel() override;
  EchogramModel(const EchogramModel&) = delete;
  EchogramModel& operator=(const EchogramModel&) = delete;

  void pointer(const PointerEvent& event) override;
  [[nodiscard]] bool pans() const override { return true; }
  bool aim(PixelPoint at) override;
  void wait() override {
    echograms_->wait();
    LivePicture::wait();
  }
  [[nodiscard]] std::vector<Overlay> overlays() const override;
  [[nodiscard]] std::string hint(PixelPoint at) const override;
  [[nodiscard]] std::string incomplete() const override;
  /// Of the picture on show; null before the first.
  [[nodiscard]] const std::shared_ptr<const EchogramPlaces>& places() const { return places_; }
  /// What the echogram is of now; empty where there is nothing to show.
  [[nodiscard]] std::optional<EchogramName> name() const;

  [[nodiscard]] bool of_fan() const { return of_fan_; }
  void set_of_fan(bool on);
  [[nodiscard]] bool along_depth() const { return height_ == EchogramHeight::depth; }
  void set_along_depth(bool on);
  /// Held, it stays with its fan and beam, wherever the slices go.
  [[nodiscard]] bool held() const { return held_.has_value(); }
  void set_held(bool on);
  /// Whether a channel of another sounder lies below.
  [[nodiscard]] bool other_below() const { return other_below_; }
  void set_other_below(bool on);
  /// Whether there is such a sounder, below or alone.
  [[nodiscard]] bool has_channels() const;
  /// Its next frequency.
  void next_channel();

  /// All of both axes again.
  void show_all();
  [[nodiscard]] bool zoomed() const { return shown_ || heights_; }

 protected:
  [[nodiscard]] Build build(const PictureLook& look) override;
  void take(const std::shared_ptr<const void>& detail) override;

 private:
  /// What of a plot lies at a place.
  struct There {
    const EchogramPlot* plot = nullptr;
    std::int64_t ping = 0;
    double height_m = 0.0;
  };
  void hear(DocumentChange change);
  void forget_places();
  void renew();
  void follow_ping();
  void point(PixelPoint at);
  void go_to(PixelPoint at);
  void zoom_time(double x_px, double factor);
  void zoom_heights(double y_px, double factor);
  void pan_to(PixelPoint at);
  void show_part(TimeNs first, TimeNs length);
  void show_heights(double first_m, double length_m);
  [[nodiscard]] std::optional<EchogramName> channel_at(const TimelineInterval* time) const;
  [[nodiscard]] std::optional<EchogramName> below() const;
  [[nodiscard]] std::optional<There> there(PixelPoint at) const;
  [[nodiscard]] std::optional<Voxel> voxel_at(PixelPoint at) const;
  [[nodiscard]] EchogramRow row_of(const EchogramName& name, std::int64_t ping) const;
  [[nodiscard]] TimelineInterval part() const { return shown_.value_or(places_->above.places.all); }
  [[nodiscard]] TimelineHeights heights() const { return heights_.value_or(places_->heights); }

  Workspace& workspace_;
  std::shared_ptr<Echograms> echograms_;
  std::shared_ptr<EchogramShadows> shadows_ = std::make_shared<EchogramShadows>();
  bool of_fan_ = false;
  EchogramHeight height_ = EchogramHeight::range;
  std::optional<SlicePlaces> held_;
  bool other_below_ = true;
  int channel_ = 0;
  bool pointed_ = false;    ///< the pointer is in it
  bool scrubbing_ = false;  ///< it is dragged through pings
  struct Pan {
    PixelPoint from;
    TimelineInterval part;
    TimelineHeights heights;
  };
  std::optional<Pan> pan_;
  std::optional<TimelineInterval> shown_;  ///< empty = all
  std::optional<TimelineHeights> heights_;
  std::weak_ptr<const int> shown_of_;  ///< identity of the observation on show
  std::shared_ptr<const EchogramPlaces> places_;
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
