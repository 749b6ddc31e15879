// SPDX-License-Identifier: Apache-2.0
#include "session/playback.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace sonar {
namespace {

constexpr const char* kName = "playback";
constexpr std::size_t kRatePings = 11;  // ten steps: as much as an eye averages
constexpr std::array<double, 3> kTimes{1.0, 2.0, 5.0};
constexpr std::array<const char*, 4> kTexts{"1x", "2x", "5x", "as fast as possible"};

}  // namespace

Playback::Playback(Workspace& workspace, AnimationDriver& animations)
    : workspace_(workspace),
      animations_(animations),
      listening_(workspace.document.changes().add([this](DocumentChange change) {
        const auto& document = workspace_.document;
        const bool arrived = document.staged() && document.staged()->ping_index == document.ping();
        if (change == DocumentChange::notice && playing_ && !arrived) unreadable_ = true;
        if (playing_ && identity_ != (document.shown() ? document.shown()->identity() : nullptr)) pause();
      })) {}

Playback::~Playback() {
  animations_.stop(kName);
  workspace_.document.changes().remove(listening_);
}

void Playback::play() {
  Document& document = workspace_.document;
  if (playing_ || !document.shown() || document.shown()->pings() < 2) return;
  if (document.ping() == document.shown()->pings() - 1) document.look_at(0);
  playing_ = true;
  identity_ = document.shown()->identity();
  ping_ = -1;
  unreadable_ = false;
  came_s_.clear();
  animations_.run(kName, [this](double now_s) { return step(now_s); });
  changed_.tell();
}

void Playback::pause() {
  if (!playing_) return;
  playing_ = false;
  animations_.stop(kName);
  changed_.tell();
}

double Playback::wait_s(std::int64_t ping) const {
  if (speed_ == PlaySpeed::fastest) return 0.0;
  const auto& times = workspace_.document.shown()->context().times;
  const auto i = static_cast<std::size_t>(ping);
  const double between_s = static_cast<double>(times[i + 1] - times[i]) / static_cast<double>(kSecondNs);
  return std::clamp(between_s, 0.0, kLongestWait_s) / kTimes[static_cast<std::size_t>(speed_)];
}

bool Playback::step(double now_s) {
  Document& document = workspace_.document;
  if (!playing_ || !document.shown()) return false;
  const std::int64_t ping = document.ping();
  if (!unreadable_ && (!document.staged() || document.staged()->ping_index != ping)) return true;
  if (ping + 1 >= document.shown()->pings()) {
    pause();
    return false;
  }
  if (ping != ping_) {  // it has just come, whoever asked for it
    ping_ = ping;
    since_s_ = now_s;
    came_s_.push_back(now_s);
    if (came_s_.size() > kRatePings) came_s_.pop_front();
    changed_.tell();
    if (speed_ != PlaySpeed::fastest) return true;
  }
  if (now_s - since_s_ < wait_s(ping)) return true;
  unreadable_ = false;
  document.look_at(ping + 1);
  return true;
}

void Playback::set_speed(PlaySpeed speed) {
  if (speed == speed_) return;
  speed_ = speed;
  came_s_.clear();
  changed_.tell();
}

std::string Playback::rate_text() const {
  if (!playing_ || came_s_.size() < 2 || !(came_s_.back() > came_s_.front())) return speed_text();
  const double per_s = static_cast<double>(came_s_.size() - 1) / (came_s_.back() - came_s_.front());
  return fmt::format("{}, {:.{}f} pings/s", speed_text(), per_s, per_s < 10.0 ? 1 : 0);
}

void Playback::faster() {
  if (speed_ != PlaySpeed::fastest) set_speed(static_cast<PlaySpeed>(static_cast<int>(speed_) + 1));
}

void Playback::slower() {
  if (speed_ != PlaySpeed::real_time) set_speed(static_cast<PlaySpeed>(static_cast<int>(speed_) - 1));
}

std::string Playback::speed_text() const { return kTexts[static_cast<std::size_t>(speed_)]; }

}  // namespace sonar
