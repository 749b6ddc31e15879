// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>

#include "session/animation_driver.h"
#include "session/workspace.h"

namespace sonar {

/// How fast pings follow each other.
enum class PlaySpeed : std::uint8_t { real_time, twice, five_times, fastest };

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

  [[nodiscard]] PlaySpeed speed() const { return speed_; }
  void faster();
  void slower();
  /// "5x", "as fast as possible".
  [[nodiscard]] std::string speed_text() const;
  /// "5x, 2.3 pings/s" while it plays and two pings have come at least, else as speed_text(): what is reached, which
  /// recording and machine may hold below what was asked for.
  [[nodiscard]] std::string rate_text() const;
  /// Called when playing(), speed() or the rate have changed.
  [[nodiscard]] Listeners<>& changed() { return changed_; }

  /// Longest time between two pings at real time: gaps in the recording are not sat out, s.
  static constexpr double kLongestWait_s = 10.0;

 private:
  bool step(double now_s);
  [[nodiscard]] double wait_s(std::int64_t ping) const;
  void set_speed(PlaySpeed speed);

  Workspace& workspace_;
  AnimationDriver& animations_;
  bool playing_ = false;
  PlaySpeed speed_ = PlaySpeed::real_time;
  std::shared_ptr<const int> identity_;  ///< of what is played
  std::int64_t ping_ = -1;               ///< that waits for its successor
  double since_s_ = 0.0;                 ///< when it was there
  std::deque<double> came_s_;            ///< when the last pings came
  bool unreadable_ = false;              ///< the ping that was asked for cannot be had
  Listeners<> changed_;
  int listening_;
};

}  // namespace sonar
