// SPDX-License-Identifier: Apache-2.0
#include "publish/movies/movie.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "publish/movies/between_pings.h"
#include "publish/picture.h"
#include "publish/volumes/volume_figure.h"
#include "publish/volumes/volume_picture.h"
#include "view/axes.h"
#include "view/composed_figure.h"
#include "view/shapes.h"

namespace sonar {
namespace {

constexpr double kCaption_em = 2.4;

/// Places that stand for the whole sector and the ship.
std::vector<Point<Sonar>> rim_of(const Sector& sector) {
  const int last = sector.range().count - 1;
  std::vector<Point<Sonar>> rim{Point<Sonar>{}};
  for (const int fan : {0, sector.fans() - 1}) {
    for (int beam = 0; beam < sector.beams(); ++beam) rim.push_back(sector.centre(fan, beam, last));
  }
  return rim;
}

/// How many times as far away a camera has to be, about, for all places to be seen with a little room; 1 = they are seen.
double farther(const Camera& camera, const std::vector<Point<Sonar>>& places, PixelSize size) {
  constexpr double kFull = 0.95;
  double most = 0.0;
  const CameraBasis eye = basis(camera, size);
  for (const Point<Sonar>& place : places) {
    const auto seen = eye.project(place);
    if (!seen) return 2.0;
    most = std::max(
        {most, std::abs(2.0 * seen->pixel.x / size.width - 1.0), std::abs(2.0 * seen->pixel.y / size.height - 1.0)});
  }
  return std::clamp(most / kFull, 1.0, 2.0);
}

constexpr int kAttempts = 12;

/// As far away as all of the sector is seen from every side.
Camera from_all_sides(const Sector& sector, Camera camera, PixelSize size) {
  constexpr int kSides = 24;
  const auto rim = rim_of(sector);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    double factor = 1.0;
    for (int side = 0; side < kSides; ++side) {
      factor = std::max(factor, farther(orbited(camera, rad_from_deg(360.0 * side / kSides), 0.0), rim, size));
    }
    if (factor <= 1.0) break;
    camera = zoomed(camera, factor);
  }
  return camera;
}

/// As far away as all of the sector is seen at every ping.
TrackCamera past_all_pings(const Sector& sector, TrackCamera camera, std::span<const PingNavigation> pings,
                           PixelSize size) {
  constexpr std::size_t kLooks = 64;
  const auto rim = rim_of(sector);
  const std::size_t step = std::max<std::size_t>(1, pings.size() / kLooks);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    double factor = farther(camera.seen_from(pings.back(), static_cast<double>(pings.size() - 1)), rim, size);
    for (std::size_t i = 0; i < pings.size(); i += step) {
      factor = std::max(factor, farther(camera.seen_from(pings[i], static_cast<double>(i)), rim, size));
    }
    if (factor <= 1.0) break;
    camera = camera.from_farther(factor);
  }
  return camera;
}

/// "12", or "about 8": how many times as fast.
std::string times_text(double times) {
  if (times >= 9.5) return fmt::format("{:.0f} times as fast as recorded", times);
  if (times > 0.95 && times < 1.05) return "as fast as recorded";
  return fmt::format("{:.2g} times as fast as recorded", times);
}

}  // namespace

Result<Movie> Movie::of(PictureSource& source, const std::string& observation, const PictureOptions& asked,
                        Work& work) {
  if (auto valid = validate_options(asked); !valid) return pass_on(valid);
  if (auto valid = validate_movie(asked); !valid) return pass_on(valid);
  const auto chosen = source.observation(observation);
  if (!chosen) return pass_on(chosen);
  const MovieParams& params = asked.kind.movie;
  const bool turns = params.of == MovieOf::volume && params.motion == MovieMotion::turntable;
  const auto seen = turns ? with_ping_to_see(**chosen, asked, work) : Result<PictureOptions>(asked);
  if (!seen) return pass_on(seen);
  const PictureOptions& options = *seen;
  const auto pings = movie_pings(**chosen, options);
  if (!pings) return pass_on(pings);
  Movie movie(source, **chosen, options);
  movie.pings_ = *pings;
  movie.steps_ = movie_steps(params, *pings);
  if (auto ready = movie.prepare_camera(); !ready) return pass_on(ready);
  return movie;
}

double Movie::caption_px() const { return std::ceil(kCaption_em * theme_of(options_).text_px); }

/// One camera for the whole movie: what follows from the ship's frame is added for each picture.
Result<void> Movie::prepare_camera() {
  const MovieParams& params = options_.kind.movie;
  const bool standing = params.motion == MovieMotion::pings && options_.volume.earth_fixed;
  if (params.of != MovieOf::volume || (params.motion == MovieMotion::pings && !standing)) return {};
  const auto sector = observation_->sector();
  if (!sector) return pass_on(sector);
  PictureOptions still = options_;
  still.size.height -= static_cast<int>(caption_px());
  const auto place = volume_place(still, still.scale);
  if (!place) return pass_on(place);
  CameraParams& named = options_.kind.volume;
  const bool by_user = options_.camera || !named.eye.empty();
  const double zoom = named.zoom;
  if (!by_user) still.kind.volume.zoom = 1.0;
  auto camera = volume_camera(*sector, still, place->rays);
  if (!camera) return pass_on(camera);
  if (standing || params.motion == MovieMotion::along_track) {
    const RangeAxis& range = sector->range();
    const std::span pings =
        std::span(observation_->product().pings)
            .subspan(static_cast<std::size_t>(pings_.first), static_cast<std::size_t>(pings_.last - pings_.first + 1));
    const Result<std::int64_t> eye = standing ? eye_ping() : Result<std::int64_t>(pings_.first);
    if (!eye) return pass_on(eye);
    auto track =
        standing ? TrackCamera::standing(pings, *camera, observation_->product().pings[static_cast<std::size_t>(*eye)])
                 : TrackCamera::along(pings, *camera, range.range_m(range.count - 1));
    if (!track) return pass_on(track);
    // A window's camera stood there for a picture; one that is named in figures is meant for the movie, and one that
    // stands still in the window stands there in the movie too.
    if (named.eye.empty() && !(standing && options_.camera))
      track = past_all_pings(*sector, std::move(*track), pings, place->rays);
    track_ = by_user ? *track : track->from_farther(1.0 / zoom);
  } else if (!by_user) {
    camera = zoomed(from_all_sides(*sector, *camera, place->rays), 1.0 / zoom);
  }
  options_.camera = *camera;
  const double seconds = named.seconds;
  named = CameraParams{};
  named.seconds = seconds;
  return {};
}

/// In whose frame the camera is that stands still on the earth.
Result<std::int64_t> Movie::eye_ping() const {
  const std::int64_t named = options_.kind.volume.eye_ping;
  if (named >= observation_->pings()) {
    return fail(ErrorCode::usage, fmt::format("no ping {} for the eye in {}: it has pings 0 to {}", named,
                                              observation_->name(), observation_->pings() - 1));
  }
  if (named >= 0) return named;
  // A window's camera is that of its ping.
  if (options_.camera && options_.ping && *options_.ping >= 0 && *options_.ping < observation_->pings()) {
    return std::int64_t{*options_.ping};
  }
  return (pings_.first + pings_.last + 1) / 2;
}

PictureOptions Movie::options_of(const MovieStep& step) const {
  PictureOptions out = options_;
  out.size.height -= static_cast<int>(caption_px());
  out.ping = static_cast<int>(step.ping);
  out.towards_next = step.fraction;
  if (step.turn_deg != 0.0) out.camera = orbited(*out.camera, rad_from_deg(step.turn_deg), 0.0);
  if (track_) {
    const auto& pings = observation_->product().pings;
    const auto& here = pings[static_cast<std::size_t>(step.ping)];
    const bool on_the_way = step.fraction > 0.0;
    const PingNavigation ship =
        on_the_way ? navigation_between(here, pings[static_cast<std::size_t>(step.ping) + 1], step.fraction) : here;
    out.camera = track_->seen_from(ship, static_cast<double>(step.ping - pings_.first) + step.fraction);
  }
  return out;
}

Result<FrameDescription> Movie::picture(std::size_t index, Work& work) const {
  const PictureOptions still = options_of(steps_[index]);
  const auto frame = picture_frame(drawn_kind(options_.kind.movie.of), *source_, observation_->name(), still, work);
  if (!frame) return pass_on(frame);
  FrameDescription page{options_.size, frame->background, frame->title, {}, frame->origin};
  place_frame(page, *frame, {0.0, 0.0, 1.0 * still.size.width, 1.0 * still.size.height});
  add_caption(page, index);
  return page;
}

/// How the movie's time is to the data's; empty where the data's is not known.
std::string Movie::pace() const {
  const MovieParams& params = options_.kind.movie;
  if (params.motion == MovieMotion::turntable || pings_.first == pings_.last) return {};
  const auto& pings = observation_->product().pings;
  const double recorded_s = static_cast<double>(pings[static_cast<std::size_t>(pings_.last)].time -
                                                pings[static_cast<std::size_t>(pings_.first)].time) /
                            static_cast<double>(kSecondNs);
  const double shown_s = static_cast<double>(steps_.size() - 1) / params.pictures_per_second;
  return recorded_s > 0.0 ? times_text(recorded_s / shown_s) : std::string();
}

void Movie::add_caption(FrameDescription& page, std::size_t index) const {
  const Theme theme = theme_of(options_);
  const MovieStep& step = steps_[index];
  const MovieParams& params = options_.kind.movie;
  const double em = theme.text_px;
  const double left = em;
  const double right = options_.size.width - em;
  const double bar_y = options_.size.height - caption_px() + 0.35 * em;
  const double y = bar_y + 1.1 * em;
  const double share = steps_.size() < 2 ? 1.0 : static_cast<double>(index) / static_cast<double>(steps_.size() - 1);
  page.items.emplace_back(line_item({left, bar_y}, {right, bar_y}, theme.grid, 3.0 * theme.line_px));
  page.items.emplace_back(
      line_item({left, bar_y}, {left + share * (right - left), bar_y}, theme.muted, 3.0 * theme.line_px));
  double room = right - left;
  if (step.between > 0) {
    std::string words = fmt::format("interpolated between pings {} and {}", step.ping, step.ping + 1);
    const std::string which = fmt::format(" ({} of {})", step.between, params.between);
    if (text_width_px((words + which).c_str(), 1.1 * em) < 0.6 * room) words += which;
    TextItem mark = text_item({right, y}, words, em, theme.text, TextAnchor::right);
    mark.bold = true;
    room -= text_width_px(words.c_str(), 1.1 * em) + em;
    page.items.emplace_back(std::move(mark));
  }
  std::string words = params.motion == MovieMotion::turntable
                          ? fmt::format("ping {}, turned by {:.0f}\u00B0", step.ping, step.turn_deg)
                      : step.between > 0 ? fmt::format("pings {} to {}", pings_.first, pings_.last)
                                         : fmt::format("ping {} of {} to {}", step.ping, pings_.first, pings_.last);
  if (const std::string fast = pace(); !fast.empty()) words += ", " + fast;
  page.items.emplace_back(text_item({left, y}, elided(words, em, room), em, theme.muted));
}

}  // namespace sonar
