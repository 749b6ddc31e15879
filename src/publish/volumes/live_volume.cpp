// SPDX-License-Identifier: Apache-2.0
#include "publish/volumes/live_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>
#include <string>
#include <utility>

#include "pipeline/stages/voxel_statistics.h"
#include "publish/maps/chart_seabed.h"
#include "publish/movies/between_pings.h"
#include "publish/renderer_choice.h"
#include "publish/reports/sample_looks.h"
#include "publish/volumes/mask_silhouettes.h"
#include "publish/volumes/volume_figure.h"
#include "render/refinement.h"

namespace sonar {
namespace {

using Staged = std::shared_ptr<const StagedPing>;

/// Of a pixel, until the first picture tells: a slow processor's, so that nobody waits for it.
constexpr double kFirstPace_s = 1e-6;
/// Silhouettes are two pictures of the masks alone, each a twentieth of what the data take; at a quarter of the
/// resolution a processor's one core does that in about 3 ms for 900 x 700 pixels.
constexpr int kMovingDivisor = 4;

bool same_masks(const std::vector<MaskLayer>& a, const std::vector<MaskLayer>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const MaskLayer& x, const MaskLayer& y) {
    return x.mask == y.mask && x.rgb == y.rgb && x.selected == y.selected;
  });
}

/// A chart is read with so much to spare that a ship sails on for a while before it is read again.
constexpr double kChartSpare = 1.0;
/// Drawn while something moves.
constexpr int kChartNodes = 61;

/// What the surroundings depend on beside the sector.
struct ContextKey {
  Camera camera;
  PixelSize size;
  Theme theme;
  double scale = 1.0;
  ContextParams surroundings;
  std::shared_ptr<const SeabedPatch> seabed;
  friend bool operator==(const ContextKey&, const ContextKey&) = default;
};

std::string between_words(const LiveVolumeInput& input) {
  const std::int64_t to = input.next->ping_index;
  return fmt::format("interpolated between pings {} and {}", to - 1, to);
}

/// The same with the stages that lie between its two pings.
LiveVolumeInput with_between(const LiveVolumeInput& input, Work& work) {
  LiveVolumeInput out = input;
  out.staged = staged_between(*input.staged, *input.next, input.towards_next, work);
  return out;
}

/// Jittered frames that are worth showing: each step twice as smooth as the one before. One alone is no smoother than the plain
/// one, and its rays stand to one side in their pixels.
bool worth_showing(const Refinement::Frame& frame) {
  return frame.done || (frame.averaged != 1 && (frame.averaged & (frame.averaged - 1)) == 0);
}

}  // namespace

std::optional<Picked> LiveVolumeShown::picked_at(PixelPoint at) const {
  if (!volume || !table || place.width <= 0.0) return std::nullopt;
  const double scale = view.size.width / place.width;
  const PixelPoint pixel{(at.x - place.x) * scale, (at.y - place.y) * scale};
  if (pixel.x < 0.0 || pixel.y < 0.0 || pixel.x >= view.size.width || pixel.y >= view.size.height) return std::nullopt;
  return pick(*volume, *table, masks, view, pixel);
}

std::optional<PixelPoint> LiveVolumeShown::place_of(const Point<Sonar>& point) const {
  if (place.width <= 0.0) return std::nullopt;
  const auto seen = basis(view.camera, view.size).project(point);
  if (!seen) return std::nullopt;
  const double scale = view.size.width / place.width;
  const PixelPoint at{seen->pixel.x / scale, seen->pixel.y / scale};
  if (at.x < 0.0 || at.y < 0.0 || at.x >= place.width || at.y >= place.height) return std::nullopt;
  return PixelPoint{at.x + place.x, at.y + place.y};
}

struct LiveVolume::State {
  MakeRenderer make;
  Work first;  ///< draws what must be seen in any case
  // All that let_go() gives back:
  std::optional<OffscreenRenderer> offscreen;
  RendererChoice choice = RendererChoice::automatic;
  std::string notice;
  std::optional<Refinement> refinement;
  double budget_s = 0.0;
  int frames = 0;
  LiveVolumeInput drawn;  ///< what is set in the renderer
  std::shared_ptr<const VolumeData> volume;
  std::shared_ptr<const OpticalTable> table;
  bool masks_set = false;
  bool masks_outlined = false;  ///< the renderer has none of them: they are laid over its rays
  VolumeCut cut;                ///< of `volume`
  std::optional<ContextKey> context_key;
  ContextPicture context;
  SchoolTrails trails;
  std::shared_ptr<const std::vector<SceneLine>> trail_lines;  ///< as drawn last
  ChartSeabed chart{kChartSpare, kChartNodes};
  std::string chart_notice;
  std::shared_ptr<const std::vector<int>> shadow_from;  ///< of `drawn.casting_shadow` in `heard`; null = not shown
  Staged heard;

  void let_go() {
    refinement.reset();
    if (offscreen) offscreen->renderer.reset();  // while its context is still there
    offscreen.reset();
    volume.reset();
    table.reset();
    drawn = {};
    masks_set = false;
    context_key.reset();
    context = {};
    trails = {};
    trail_lines.reset();
    shadow_from.reset();
    heard.reset();
    chart = ChartSeabed{kChartSpare, kChartNodes};
  }

  Result<void> begin(RendererChoice asked_for);
  Result<void> set(const LiveVolumeInput& input, const VolumeCut& wanted_cut, bool outlined);
  VolumeFigure figure_of(const LiveVolumeInput& input);
  void take_trails(VolumeFigure& figure, const LiveVolumeInput& input, const VolumePlace& place);
  void take_shadow(VolumeFigure& figure, const LiveVolumeInput& input, const Staged& nearer);
  /// nearer  the ping whose masks these are: as heard, not as interpolated
  Result<void> draw(const LiveVolumeInput& input, const Staged& nearer, const VolumePlace& place,
                    const CancelToken& token, Work& better, const Show& show);
  void draw_context(const VolumeFigure& figure, const LiveVolumeInput& input, const VolumePlace& place,
                    const Camera& camera);
};

/// A back-end as it is wished for, or the processor.
Result<void> LiveVolume::State::begin(RendererChoice asked_for) {
  if (offscreen && choice == asked_for) return {};
  let_go();
  choice = asked_for;
  notice.clear();
  auto made = make(asked_for);
  if (!made && asked_for != RendererChoice::cpu) {
    notice = "the processor draws the volume: " + to_line(made.error());
    made = make(RendererChoice::cpu);
  }
  if (!made) return pass_on(made);
  offscreen = std::move(*made);
  return {};
}

/// Hands the renderer what it has not yet.
Result<void> LiveVolume::State::set(const LiveVolumeInput& input, const VolumeCut& wanted_cut, bool outlined) {
  VolumeRenderer& renderer = *offscreen->renderer;
  const PictureOptions& options = input.options;
  const double depth_m = input.navigation.transducer_depth_m;
  if (!volume || drawn.staged != input.staged || drawn.sector != input.sector || !same_volume(drawn.options, options) ||
      drawn.navigation.transducer_depth_m != depth_m || cut != wanted_cut) {
    volume = drawn_volume(*input.sector, *input.staged, options, wanted_cut, depth_m);
    cut = wanted_cut;
    masks_set = false;
    if (auto done = renderer.set_volume(volume); !done) return done;
  }
  if (!table || !(drawn.options.transfer == options.transfer) ||
      !(drawn.options.display.scale == options.display.scale)) {
    auto made = volume_table(options);
    if (!made) return pass_on(made);
    table = std::make_shared<const OpticalTable>(std::move(*made));
    if (auto done = renderer.set_transfer(*table); !done) return done;
  }
  if (!masks_set || masks_outlined != outlined || !same_masks(drawn.masks, input.masks)) {
    const std::vector<MaskLayer> none;
    if (auto done = renderer.set_masks(outlined ? none : input.masks); !done) return done;
    masks_set = true;
    masks_outlined = outlined;
  }
  drawn = input;
  if (!refinement || budget_s != input.moving_budget_s || frames != options.volume.frames) {
    budget_s = input.moving_budget_s;
    frames = options.volume.frames;
    refinement.emplace(renderer,
                       RefinementParams{.moving_budget_s = budget_s, .most_frames = frames, .pace_s = kFirstPace_s});
  }
  return {};
}

void LiveVolume::State::draw_context(const VolumeFigure& figure, const LiveVolumeInput& input, const VolumePlace& place,
                                     const Camera& camera) {
  const ContextKey key{camera,       place.rays, place.theme, place.scale, volume_surroundings(figure, input.options),
                       figure.seabed};
  if (context_key == key && drawn.sector == input.sector) return;
  context = volume_context(figure, input.options, place, camera, first);
  context_key = key;
}

/// All of a picture but its volume. Without its chart it is drawn all the same, and a notice says why.
VolumeFigure LiveVolume::State::figure_of(const LiveVolumeInput& input) {
  VolumeFigure figure;
  figure.masks = input.masks;
  figure.names = input.names;
  figure.legend = input.legend;
  figure.navigation = input.navigation;
  figure.moved = input.moved;
  figure.title = input.title;
  figure.title_line = input.title_line;
  if (input.next) figure.mark = between_words(input);
  figure.refused = input.refused;
  figure.currents = input.currents;
  figure.fitted = fitted_seabed(*input.staged);
  figure.fan = input.fan;
  figure.beam = input.beam;
  figure.outlined = wants_outlines(figure, input.options);
  chart_notice.clear();
  const std::filesystem::path& raster = input.options.depth_raster;
  if (raster.empty() || !input.options.volume.seabed || !input.options.volume.context) return figure;
  const RangeAxis& range = input.sector->range();
  auto seabed = chart.round(raster, input.navigation, range.range_m(range.count - 1));
  if (seabed) {
    figure.seabed = std::move(*seabed);
  } else {
    chart_notice = "the volume shows no depth chart: " + to_line(seabed.error());
  }
  return figure;
}

/// The same lines stay the same object, so that what stands round the volume is not drawn again.
void LiveVolume::State::take_trails(VolumeFigure& figure, const LiveVolumeInput& input, const VolumePlace& place) {
  const TrailParams params = trail_params(input.options.volume);
  if (!params.any()) {
    trail_lines.reset();
    return;
  }
  std::vector<SceneLine> lines = trails.lines(*input.sector, input.trails, input.staged->ping_index, input.navigation,
                                              params, scaled_theme(place));
  if (!trail_lines || *trail_lines != lines) {
    trail_lines = std::make_shared<const std::vector<SceneLine>>(std::move(lines));
  }
  figure.trails = trail_lines;
  figure.schools_tracked = !input.trails.schools.empty();
}

/// Worked out again where another picture is about others: the eye alone moves more often. Between pings it is that of the
/// nearer one, whose schools are drawn.
void LiveVolume::State::take_shadow(VolumeFigure& figure, const LiveVolumeInput& input, const Staged& nearer) {
  const DisplayParams& display = input.options.display;
  const bool same = shadow_from && heard == nearer && drawn.sector == input.sector &&
                    drawn.options.display.shadow_db == display.shadow_db &&
                    drawn.casting_shadow == input.casting_shadow;
  if (!display.shadow) {
    shadow_from.reset();
  } else if (!same) {
    std::vector<const PingMask*> masks;
    for (const auto& mask : input.casting_shadow) masks.push_back(mask.get());
    shadow_from = std::make_shared<const std::vector<int>>(
        sonar::shadow_from(*nearer, *input.sector, masks, input.extinction, display.shadow_db));
    heard = nearer;
  }
  figure.shadow_from = shadow_from;
}

Result<void> LiveVolume::State::draw(const LiveVolumeInput& input, const Staged& nearer, const VolumePlace& place,
                                     const CancelToken& token, Work& better, const Show& show) {
  const bool other_sector = drawn.sector != input.sector;
  if (other_sector) {
    context_key.reset();
    trails = {};
  }
  VolumeFigure figure = figure_of(input);
  take_trails(figure, input, place);
  const auto camera = volume_camera(*input.sector, input.options, place.rays);
  if (!camera) return pass_on(camera);
  take_shadow(figure, input, nearer);  // of what is `drawn` from here on, or forgotten
  const VolumeCut wanted_cut = volume_cut(*input.sector, input.options, *camera, input.fan, input.beam);
  if (auto done = set(input, wanted_cut, figure.outlined); !done) {
    // What the renderer holds now is not known.
    volume.reset();
    table.reset();
    shadow_from.reset();
    return done;
  }
  figure.volume = volume;
  draw_context(figure, input, place, *camera);
  const VolumeView view = volume_view(figure, input.options, place, *camera, context);
  const std::vector<MaskLayer> met(
      input.masks.begin(), input.masks.end() - static_cast<std::ptrdiff_t>(std::min(input.tried, input.masks.size())));
  PictureOptions labelled = input.options;
  if (input.scale_bar) labelled.transfer.reset();
  refinement->restart(view);
  std::optional<MaskSilhouettes> moving;
  std::optional<MaskSilhouettes> at_rest;
  for (Work* work = &first;; work = &better) {
    auto frame = refinement->next(*work);
    if (!frame) return pass_on(frame);
    // While something moves the data comes first: outlines are coarse then.
    const bool fine = frame->quality.divisor == 1 && (work != &first || frame->done);
    if (figure.outlined) {
      std::optional<MaskSilhouettes>& silhouettes = fine ? at_rest : moving;
      if (!silhouettes) {
        auto seen = mask_silhouettes(*offscreen->renderer, figure.masks, view, *work, fine ? 1 : kMovingDivisor);
        masks_set = false;
        if (!seen) return pass_on(seen);
        if (auto set = offscreen->renderer->set_masks({}); !set) return set;
        masks_set = true;
        silhouettes = std::move(*seen);
      }
      lay_outlines(frame->image, figure.masks, *silhouettes,
                   static_cast<int>(std::lround(1.5 * place.theme.line_px * place.scale)), place.theme);
    }
    if (work == &first || worth_showing(*frame)) {
      auto shown = std::make_shared<LiveVolumeShown>(LiveVolumeShown{
          volume, table, met, view, place.rect, input.next ? -1 : input.staged->ping_index, frame->quality.divisor,
          frame->averaged, frame->done, offscreen->renderer->name(), notice.empty() ? chart_notice : notice});
      show({volume_figure_frame(figure, labelled, place, view, context, frame->image, first), std::move(shown)});
    }
    if (frame->done || token.cancelled()) return {};
  }
}

LiveVolume::LiveVolume(MakeRenderer make) : state_(std::make_unique<State>()) {
  state_->make = make ? std::move(make) : MakeRenderer(offscreen_renderer);
}

LiveVolume::~LiveVolume() { state_->let_go(); }

Result<void> LiveVolume::draw(const LiveVolumeInput& asked, const CancelToken& token, Work& better, const Show& show) {
  const Staged nearer = asked.next && !(asked.towards_next < 0.5) ? asked.next : asked.staged;
  const LiveVolumeInput input = asked.next ? with_between(asked, state_->first) : asked;
  const auto place = volume_place(input.options, input.scale);
  if (!place) return pass_on(place);
  if (auto begun = state_->begin(input.options.volume.renderer); !begun) return begun;
  auto done = state_->draw(input, nearer, *place, token, better, show);
  if (done || done.error().code == ErrorCode::cancelled || done.error().code == ErrorCode::bad_parameter) return done;
  if (state_->offscreen->context == nullptr) return done;
  // A driver that gives up in the middle is not asked again.
  state_->let_go();
  auto processor = state_->make(RendererChoice::cpu);
  if (!processor) return pass_on(processor);
  state_->offscreen = std::move(*processor);
  state_->notice = "the processor draws the volume: " + to_line(done.error());
  return state_->draw(input, nearer, *place, token, better, show);
}

void LiveVolume::let_go() { state_->let_go(); }

}  // namespace sonar
