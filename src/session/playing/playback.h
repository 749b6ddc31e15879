// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <string>

#include "session/listening.h"
#include "session/open/workspace.h"
#include "session/playing/animation_driver.h"

namespace sonar {

/// Plays through the pings of the observation on show. It waits for each ping that it asks for, so that what plays is
/// every ping in its order and the window never stalls.
/// threads  the window's
class Playback {
 public:
  /// Both outlive the playback.
  Playback(Workspace& workspace, AnimationDriver& animations);
  ~Playback();
  Playback(const Playback&) = delete;
  Playback& operator=(const Playback&) = delete;

  [[nodiscard]] bool playing() const { return playing_; }
  /// From the ping looked at; from the first where that is the last.
  void play();
  void pause();
  void toggle() { playing_ ? pause() : play(); }

  /// Pings a second that are asked for; kRealTime = as they were recorded, kFastest = as fast as they can be shown.
  [[nodiscard]] double rate() const { return rate_; }
  /// Any rate above 0, or one of these two.
  void set_rate(double pings_per_s);
  /// The next of kRates.
  void faster();
  void slower();
  static constexpr double kRealTime = 0.0;
  static constexpr double kFastest = std::numeric_limits<double>::infinity();
  static constexpr std::array<double, 8> kRates{kRealTime, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, kFastest};

  /// After the last ping comes the first.
  [[nodiscard]] bool loops() const { return loops_; }
  void set_loops(bool loops);

  /// "2 pings/s", "real time", "as fast as possible".
  [[nodiscard]] std::string speed_text() const;
  /// "5 pings/s, 2.3 reached" while it plays and two pings have come at least, else as speed_text(): recording and machine
  /// may hold what is reached below what was asked for.
  [[nodiscard]] std::string rate_text() const;
  /// Called when playing(), loops(), rate() or what is reached have changed.
  [[nodiscard]] Listeners<>& changed() { return changed_; }

  /// Longest time between two pings at real time: gaps in the recording are not sat out, s.
  static constexpr double kLongestWait_s = 10.0;

 private:
  bool step(double now_s);
  /// Shows how far it is to the next ping, where that is wished for and the next ping is there.
  void move_on(double fraction);
  [[nodiscard]] double wait_s(std::int64_t ping) const;

  Workspace& workspace_;
  AnimationDriver& animations_;
  bool playing_ = false;
  double rate_ = 2.0;
  bool loops_ = false;
  std::shared_ptr<const int> identity_;  ///< of what is played
  std::int64_t ping_ = -1;               ///< that waits for its successor
  double since_s_ = 0.0;                 ///< when it was there
  std::deque<double> came_s_;            ///< when the last pings came
  bool unreadable_ = false;              ///< the ping that was asked for cannot be had
  Listeners<> changed_;
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
