// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "session/listening.h"
#include "session/live/live_picture.h"
#include "session/open/workspace.h"
#include "session/timelines/echograms.h"
#include "session/timelines/time_window.h"
#include "view/timelines/timeline.h"

namespace sonar {

class TimelinePainter;

/// A ping of the survey.
struct SurveyPlace {
  std::size_t observation = 0;
  std::int64_t ping = 0;
  friend bool operator==(const SurveyPlace&, const SurveyPlace&) = default;
};

enum class TimelineOf : std::uint8_t { survey, observation };

/// Range against time: echogram as far as it is read, schools, events, bad intervals; the ping on show is a line over it. A
/// click or dragging goes to a ping and chooses a mark that lies there, Shift and dragging marks an interval; the wheel
/// zooms about the pointer, dragging with the middle button pans, a double press shows everything.
class TimelineModel : public LivePicture {
 public:
  /// echograms  may be shared with other timelines of the survey
  TimelineModel(Workspace& workspace, std::shared_ptr<Echograms> echograms, TimelineOf of);
  ~TimelineModel() override;
  TimelineModel(const TimelineModel&) = delete;
  TimelineModel& operator=(const TimelineModel&) = delete;

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
  [[nodiscard]] const std::shared_ptr<const TimelinePlaces>& places() const { return places_; }
  /// The ping whose time lies nearest to a place of the picture.
  [[nodiscard]] std::optional<SurveyPlace> ping_at(PixelPoint at) const;
  /// The event within reach of a place, else the bad interval that covers it.
  [[nodiscard]] std::optional<ChosenMark> mark_at(PixelPoint at) const;
  /// The refused echo whose mark lies there.
  [[nodiscard]] std::optional<EchoName> echo_at(PixelPoint at) const;
  /// All of the time axis again.
  void show_all();
  [[nodiscard]] bool zoomed() const { return window_.shown().has_value(); }

 protected:
  [[nodiscard]] Build build(const PictureLook& look) override;
  void take(const std::shared_ptr<const void>& detail) override;

 private:
  void hear(DocumentChange change);
  void observation_changed();
  void mark(const SurveyPlace& from, const SurveyPlace& to);
  void press(const PointerEvent& event, const SurveyPlace& there);
  void go_to(const SurveyPlace& there);
  void follow_ping();
  [[nodiscard]] std::vector<std::size_t> observations() const;

  Workspace& workspace_;
  std::shared_ptr<Echograms> echograms_;
  TimelineOf of_;
  std::optional<SurveyPlace> marking_from_;
  bool scrubbing_ = false;
  TimeWindow window_;
  std::weak_ptr<const int> shown_of_;  ///< identity of the observation on show
  std::shared_ptr<TimelinePainter> painter_;
  std::shared_ptr<const TimelinePlaces> places_;
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
