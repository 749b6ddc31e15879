// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/units.h"
#include "render/cell_states.h"
#include "render/cpu/sample_columns.h"
#include "render/cpu/trace.h"
#include "render/grid_axes.h"
#include "render/mask_grid.h"
#include "render/ray_rules.h"

namespace sonar {
namespace {

constexpr int kTile = 32;
/// Larger volumes are gathered from as they are: their columns would take more than half a gigabyte.
constexpr std::size_t kMostInColumns = std::size_t{1} << 26U;

float f(double value) { return static_cast<float>(value); }

/// An AngleTable packed for one gather.
struct Packed {
  std::vector<std::uint32_t> words;
  PackedAngle angle;
};

Packed packed(const AngleTable& table) {
  constexpr double kValues = 1048575.0;
  constexpr double kSlopes = 4095.0;
  double most = 1e-12;
  for (std::size_t k = 0; k + 1 < table.value.size(); ++k) {
    most = std::max(most, static_cast<double>(table.value[k + 1]) - static_cast<double>(table.value[k]));
  }
  const double last = std::max(1e-12, static_cast<double>(table.value.back()));
  Packed out;
  for (std::size_t k = 0; k < table.value.size(); ++k) {
    const double value = static_cast<double>(table.value[k]);
    const double step = k + 1 < table.value.size() ? static_cast<double>(table.value[k + 1]) - value : 0.0;
    out.words.push_back(static_cast<std::uint32_t>(std::lround(value / last * kValues)) << 12U |
                        static_cast<std::uint32_t>(std::lround(std::clamp(step / most, 0.0, 1.0) * kSlopes)));
  }
  out.angle = {nullptr, f(table.first), f(table.per_unit), f(last / kValues), f(most / kSlopes)};
  return out;
}

EvenAngle even_angle(double first_rad, double last_rad, int count) {
  return {f(first_rad), f((count - 1) / (last_rad - first_rad)), f(count - 1)};
}

bool same_beams(const Sector& a, const Sector& b) {
  if (a.fans() != b.fans() || a.beams() != b.beams()) return false;
  for (int i = 0; i < a.fans(); ++i) {
    if (a.elevation_rad(i) != b.elevation_rad(i)) return false;
  }
  for (int i = 0; i < a.beams(); ++i) {
    if (a.azimuth_rad(i) != b.azimuth_rad(i)) return false;
  }
  return true;
}

class CpuRenderer final : public VolumeRenderer {
 public:
  [[nodiscard]] std::string name() const override { return std::string("cpu (") + trace_target() + ")"; }
  Result<void> set_volume(std::shared_ptr<const VolumeData> volume) override;
  Result<void> set_transfer(const OpticalTable& table) override;
  Result<void> set_masks(std::span<const MaskLayer> masks) override;
  Result<RayImage> draw(const VolumeView& view, const DrawQuality& quality, Work& work) override;

 private:
  void answer(const CellQuestion& question, Work& work);
  [[nodiscard]] TraceGrid grid() const;
  [[nodiscard]] TraceView traced(const VolumeView& view, const DrawQuality& quality) const;

  std::shared_ptr<const VolumeData> volume_;
  FilledVolume filled_;
  std::vector<std::uint8_t> known_;  ///< filled_.known and two bytes that the last gather may touch
  std::vector<std::int16_t> columns_;
  GridAxes axes_;
  Packed beam_of_;
  Packed fan_of_;
  std::vector<float> azimuth_sines_;  ///< [beam] sine and cosine
  Macrocells cells_;
  std::optional<TransferTable> table_;
  MaskGrid masks_;
  std::optional<CellQuestion> answered_;  ///< what words_ and means_ were made for
  std::vector<std::int32_t> words_;
  std::vector<std::array<float, 4>> means_;
};

Result<void> CpuRenderer::set_volume(std::shared_ptr<const VolumeData> volume) {
  if (volume == nullptr) {
    return fail(ErrorCode::bad_parameter, "no volume to draw");
  }
  if (auto ok = check_volume(*volume); !ok) {
    return ok;
  }
  const bool same_grid = volume_ != nullptr && volume_->sector.range() == volume->sector.range() &&
                         same_beams(volume_->sector, volume->sector);
  volume_ = std::move(volume);
  filled_ = filled_volume(volume_->sv);
  const auto known = filled_.known.all();
  known_.assign(known.begin(), known.end());
  if (!known_.empty()) known_.insert(known_.end(), 2, 0);
  if (!same_grid) {
    axes_ = grid_axes(volume_->sector);
    beam_of_ = packed(axes_.beam_of);
    fan_of_ = packed(axes_.fan_of);
    azimuth_sines_.clear();
    for (std::size_t b = 0; b < axes_.sin_azimuth.size(); ++b) {
      azimuth_sines_.insert(azimuth_sines_.end(), {axes_.sin_azimuth[b], axes_.cos_azimuth[b]});
    }
  }
  if (trace_reads_columns() && filled_.sv.shape().size() <= kMostInColumns) {
    lay_columns(filled_.sv, columns_);
  } else {
    columns_ = {};
  }
  cells_ = macrocells(filled_);
  masks_ = {};
  answered_.reset();
  return {};
}

Result<void> CpuRenderer::set_transfer(const OpticalTable& table) {
  if (auto ok = check_transfer(table); !ok) {
    return ok;
  }
  table_ = transfer_table(table);
  answered_.reset();
  return {};
}

Result<void> CpuRenderer::set_masks(std::span<const MaskLayer> masks) {
  if (volume_ == nullptr) {
    return fail(ErrorCode::bad_parameter, "masks without a volume");
  }
  auto grid = mask_grid(masks, cells_, filled_.sv.shape());
  if (!grid) {
    return pass_on(grid);
  }
  masks_ = std::move(*grid);
  answered_.reset();
  return {};
}

void CpuRenderer::answer(const CellQuestion& question, Work& work) {
  if (answered_ == question) {
    return;
  }
  CellStates states = cell_states(question, filled_, cells_, *table_, masks_, axes_.spacing_m, work);
  if (work.cancelled()) {
    return;
  }
  means_ = std::move(states.means);
  words_.resize(states.flags.size());
  static_assert(kCellThin << kThinBit == 1 << kThinBit && kCellGaps << kThinBit == 1 << kGapsBit &&
                kCellMasked << kThinBit == 1 << kMaskBit);
  for (std::size_t i = 0; i < words_.size(); ++i) {
    const int empty = states.distance[i] != 0 ? 1 << kEmptyBit : 0;
    words_[i] = states.distance[i] | states.flags[i] << kThinBit | empty | cells_.largest[i] * 65536;
  }
  answered_ = question;
}

TraceGrid CpuRenderer::grid() const {
  TraceGrid g{};
  g.fans = axes_.fans;
  g.beams = axes_.beams;
  g.samples = axes_.samples;
  g.cell_beams = cells_.beams;
  g.cell_ranges = cells_.ranges;
  g.first_m = f(axes_.first_m);
  g.spacing_m = f(axes_.spacing_m);
  g.per_spacing = f(1.0 / axes_.spacing_m);
  g.nearest_m = f(axes_.nearest_m);
  g.farthest_m = f(axes_.farthest_m);
  g.surface_z_m = f(volume_->surface_z_m);
  g.sin_side = f(std::sin(axes_.half_width_rad));
  g.cos_side = f(std::cos(axes_.half_width_rad));
  g.sin_e0 = f(std::sin(axes_.first_elevation_rad));
  g.cos_e0 = f(std::cos(axes_.first_elevation_rad));
  g.sin_e1 = f(std::sin(axes_.last_elevation_rad));
  g.cos_e1 = f(std::cos(axes_.last_elevation_rad));
  g.wide = axes_.half_width_rad > 1.57;
  g.beam_of = beam_of_.angle;
  g.beam_of.words = beam_of_.words.data();
  g.fan_of = fan_of_.angle;
  g.fan_of.words = fan_of_.words.data();
  g.even_beams = axes_.even_beams;
  g.even_fans = axes_.even_fans;
  g.even_beam = even_angle(-axes_.half_width_rad, axes_.half_width_rad, axes_.beams);
  g.even_fan = even_angle(axes_.first_elevation_rad, axes_.last_elevation_rad, axes_.fans);
  g.azimuth_sines = azimuth_sines_.data();
  g.sin2_elevation = axes_.sin2_elevation.data();
  g.beams_per_rad = axes_.beams_per_rad.data();
  g.fans_per_rad = axes_.fans_per_rad.data();
  g.least_beam_rad = f(axes_.least_beam_rad);
  g.least_fan_rad = f(axes_.least_fan_rad);
  g.sv = filled_.sv.all().data();
  g.columns = columns_.empty() ? nullptr : columns_.data();
  g.known = known_.empty() ? nullptr : known_.data();
  g.masks = masks_.empty() ? nullptr : masks_.voxels.all().data();
  return g;
}

TraceView CpuRenderer::traced(const VolumeView& view, const DrawQuality& quality) const {
  const CameraBasis camera = basis(view.camera, view.size);
  const double c = std::cos(axes_.middle_rad);
  const double s = std::sin(axes_.middle_rad);
  const auto in_fan = [&](const Point<Sonar>& p) {
    return std::array<float, 3>{f(p.x * c + p.y * s), f(-p.x * s + p.y * c), f(p.z)};
  };
  TraceView v{};
  v.eye = in_fan(camera.eye);
  v.right = in_fan(camera.right);
  v.up = in_fan(camera.up);
  v.forward = in_fan(camera.forward);
  v.light = in_fan(light_direction(camera));
  v.pixel_scale = f(camera.tan_half_fov / (0.5 * view.size.height));
  v.full = view.size;
  v.size = divided(view.size, quality.divisor);
  const PixelPoint shift = pixel_shift(quality.jitter_frame);
  v.shift = {f(shift.x), f(shift.y)};
  v.divisor = quality.divisor;
  v.step_m = f(quality.step_samples * axes_.spacing_m);
  v.mode = view.mode;
  v.data = view.masks.data_too;
  v.masked = !masks_.empty();
  v.samples_frame = moves_samples(v.mode, v.data) ? quality.jitter_frame : 0;
  v.plain =
      v.mode == RayMode::accumulate && v.data && !v.masked && !view.lighting.on && !view.cue.on() && filled_.complete();
  v.first_hit_count = f(counts_from_db(view.first_hit_db));
  v.lighting = view.lighting;
  v.sky = sky_rays(quality.jitter_frame);
  v.palest = view.cue.on() ? f(DepthCue::kPalest) : 0.0F;
  v.nearest_m = f(view.cue.nearest_m);
  v.per_m = view.cue.on() ? f(1.0 / (view.cue.farthest_m - view.cue.nearest_m)) : 0.0F;
  v.ground = {f(view.cue.background.r / 255.0), f(view.cue.background.g / 255.0), f(view.cue.background.b / 255.0)};
  v.fuzzy_at = std::max(0.5F, view.masks.fuzzy_above * 255.0F);
  v.core_at = view.masks.core_at * 255.0F;
  v.fuzzy_opacity = std::clamp(view.masks.fuzzy_opacity, 0.0F, 1.0F);
  v.core_extinction = std::max(0.0F, view.masks.core_extinction_per_m);
  v.mask_rgb = masks_.rgb.data();
  v.masks = static_cast<int>(masks_.rgb.size());
  v.opaque_m = view.opaque_m != nullptr ? view.opaque_m->data() : nullptr;
  return v;
}

Result<RayImage> CpuRenderer::draw(const VolumeView& view, const DrawQuality& quality, Work& work) {
  if (volume_ == nullptr || !table_) {
    return fail(ErrorCode::bad_parameter, volume_ == nullptr ? "no volume to draw yet" : "no transfer table yet");
  }
  if (auto ok = check_view(view, quality); !ok) {
    return pass_on(ok);
  }
  answer(cell_question(view, quality), work);
  const TraceJob job{grid(), trace_optics(*table_), traced(view, quality), words_.data(),
                     means_.empty() ? nullptr : means_.data()};
  const PixelSize size = job.view.size;
  RayImage out{size, std::vector<std::array<float, 4>>(size.count()), {}};
  const int across = (size.width + kTile - 1) / kTile;
  const int down = (size.height + kTile - 1) / kTile;
  std::vector<RayCounts> counts(static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
  work.for_each(static_cast<std::int64_t>(counts.size()), [&](std::int64_t i) {
    if (work.cancelled()) return;
    const int x = static_cast<int>(i) % across * kTile;
    const int y = static_cast<int>(i) / across * kTile;
    trace_tile(job, x, y, std::min(x + kTile, size.width), std::min(y + kTile, size.height), out.rgba.data(),
               counts[static_cast<std::size_t>(i)]);
  });
  if (work.cancelled()) {
    return fail(ErrorCode::cancelled, "drawing was cancelled");
  }
  for (const RayCounts& c : counts) {
    out.counts.rays += c.rays;
    out.counts.samples += c.samples;
    out.counts.segments += c.segments;
    out.counts.leaps += c.leaps;
  }
  return out;
}

}  // namespace

std::unique_ptr<VolumeRenderer> make_cpu_renderer() { return std::make_unique<CpuRenderer>(); }

}  // namespace sonar
