// SPDX-License-Identifier: Apache-2.0
#include "session/playing/playback.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace sonar {
namespace {

constexpr const char* kName = "playback";
constexpr std::size_t kRatePings = 11;  // ten steps: as much as an eye averages

}  // namespace

Playback::Playback(Workspace& workspace, AnimationDriver& animations)
    : workspace_(workspace),
      animations_(animations),
      listening_(workspace.document.changes(), [this](DocumentChange change) {
        const auto& document = workspace_.document;
        const bool arrived = document.staged() && document.staged()->ping_index == document.ping();
        if (change == DocumentChange::notice && playing_ && !arrived) unreadable_ = true;
        if (playing_ && identity_ != (document.shown() ? document.shown()->identity() : nullptr)) pause();
      }) {}

Playback::~Playback() { animations_.stop(kName); }

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
  workspace_.motion.set({});
  changed_.tell();
}

double Playback::wait_s(std::int64_t ping) const {
  if (rate_ > kRealTime) return 1.0 / rate_;
  const auto& times = workspace_.document.shown()->context().times;
  const auto i = static_cast<std::size_t>(ping);
  const double between_s = static_cast<double>(times[i + 1] - times[i]) / static_cast<double>(kSecondNs);
  return std::clamp(between_s, 0.0, kLongestWait_s);
}

bool Playback::step(double now_s) {
  Document& document = workspace_.document;
  if (!playing_ || !document.shown()) return false;
  const std::int64_t ping = document.ping();
  const bool will_come = !unreadable_ && document.results().empty();  // results alone have no samples
  if (will_come && (!document.staged() || document.staged()->ping_index != ping)) return true;
  const bool last = ping + 1 >= document.shown()->pings();
  if (last && !loops_) {
    pause();
    return false;
  }
  if (ping != ping_) {  // it has just come, whoever asked for it
    ping_ = ping;
    since_s_ = now_s;
    came_s_.push_back(now_s);
    if (came_s_.size() > kRatePings) came_s_.pop_front();
    workspace_.motion.set({});
    changed_.tell();
    if (rate_ != kFastest) return true;
  }
  // At the end of a loop one sees that it ends: no ping comes after the last, as long as the one before it stayed.
  const double all_s = wait_s(last ? ping - 1 : ping);
  if (now_s - since_s_ < all_s) {
    if (!last) move_on((now_s - since_s_) / all_s);
    return true;
  }
  unreadable_ = false;
  document.look_at(last ? 0 : ping + 1);
  return true;
}

void Playback::move_on(double fraction) {
  MotionBetween motion;
  Document& document = workspace_.document;
  if (workspace_.volume.values().interpolated && fraction > 0.0 && document.staged()) {
    // Made ahead behind the window; where it is not there yet the ping stays as it is.
    if (auto to = document.shown()->cache().held(document.ping() + 1)) {
      motion = {document.staged(), std::move(to), fraction};
    }
  }
  workspace_.motion.set(std::move(motion));
}

void Playback::set_rate(double pings_per_s) {
  if (pings_per_s == rate_ || !(pings_per_s >= 0.0)) return;
  rate_ = pings_per_s;
  came_s_.clear();
  changed_.tell();
}

void Playback::set_loops(bool loops) {
  loops_ = loops;
  changed_.tell();
}

std::string Playback::rate_text() const {
  if (!playing_ || came_s_.size() < 2 || !(came_s_.back() > came_s_.front())) return speed_text();
  const double per_s = static_cast<double>(came_s_.size() - 1) / (came_s_.back() - came_s_.front());
  return fmt::format("{}, {:.{}f} reached", speed_text(), per_s, per_s < 10.0 ? 1 : 0);
}

void Playback::faster() {
  const auto* next = std::ranges::upper_bound(kRates, rate_);
  if (next != kRates.end()) set_rate(*next);
}

void Playback::slower() {
  const auto* next = std::ranges::lower_bound(kRates, rate_);
  if (next != kRates.begin()) set_rate(*std::prev(next));
}

std::string Playback::speed_text() const {
  if (rate_ == kRealTime) return "real time";
  if (rate_ == kFastest) return "as fast as possible";
  return fmt::format("{:g} pings/s", rate_);
}

}  // namespace sonar
