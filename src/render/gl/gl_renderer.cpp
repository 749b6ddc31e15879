// SPDX-License-Identifier: Apache-2.0
#include "render/gl/gl_renderer.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "render/cell_states.h"
#include "render/gl/capabilities.h"
#include "render/gl/gl_state.h"
#include "render/gl/grid_textures.h"
#include "render/gl/volume_pass.h"
#include "render/ray_rules.h"

namespace sonar {
namespace {

/// Where rays are drawn into, and read from.
struct Target {
  PixelSize size;
  Texture colour;
  Texture stencil;
  Framebuffer framebuffer;

  /// False where the driver does not take it.
  [[nodiscard]] bool resize(PixelSize wanted) {
    if (size == wanted && framebuffer) {
      glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
      return true;
    }
    size = wanted;
    colour = colour_target(wanted);
    stencil = stencil_target(wanted);
    framebuffer = Framebuffer::make();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour.id(), 0);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D, stencil.id(), 0);
    framebuffer.label("rays");
    return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  }
};

bool same_sector(const Sector& a, const Sector& b) {
  if (a.fans() != b.fans() || a.beams() != b.beams() || !(a.range() == b.range())) {
    return false;
  }
  for (int i = 0; i < a.fans(); ++i) {
    if (a.elevation_rad(i) != b.elevation_rad(i)) return false;
  }
  for (int i = 0; i < a.beams(); ++i) {
    if (a.azimuth_rad(i) != b.azimuth_rad(i)) return false;
  }
  return true;
}

class GlRenderer final : public VolumeRenderer {
 public:
  GlRenderer(GlCapabilities capabilities, const GlRendererOptions& options)
      : can_(std::move(capabilities)),
        most_3d_(options.most_3d > 0 ? std::min(options.most_3d, can_.most_3d) : can_.most_3d) {
    if (options.sv_in_16_bits) {
      can_.sv_voxels = Voxels::snorm16;
    }
  }
  [[nodiscard]] Result<void> start() { return pass_.prepare({}); }

  [[nodiscard]] std::string name() const override {
    return fmt::format("OpenGL {}.{}, {}", can_.version.major, can_.version.minor, can_.driver);
  }
  Result<void> set_volume(std::shared_ptr<const VolumeData> volume) override;
  Result<void> set_transfer(const OpticalTable& table) override;
  Result<void> set_masks(std::span<const MaskLayer> masks) override;
  Result<RayImage> draw(const VolumeView& view, const DrawQuality& quality, Work& work) override;

 private:
  [[nodiscard]] Result<void> check_drawable(const VolumeView& view, const DrawQuality& quality) const;
  [[nodiscard]] Result<RayImage> traced(const VolumeView& view, const DrawQuality& quality);
  void answer(const CellQuestion& question, Work& work);
  void set_opaque(const VolumeView& view);
  [[nodiscard]] RayVariant variant(const VolumeView& view) const;
  [[nodiscard]] std::array<unsigned, kUnits> textures() const;

  GlCapabilities can_;
  int most_3d_;
  std::shared_ptr<const VolumeData> volume_;
  FilledVolume filled_;
  GridAxes axes_;
  Macrocells cells_;
  FoldPlan plan_;
  std::optional<TransferTable> table_;
  MaskGrid masks_;
  std::optional<CellQuestion> answered_;  ///< what the cells' textures were made for
  std::shared_ptr<const std::vector<float>> opaque_m_;

  VolumePass pass_;
  Target target_;
  Texture sv_, known_, angles_, faces_, optics_, states_, means_, largest_, mask_voxels_, mask_rgb_, opaque_;
};

Result<void> GlRenderer::set_volume(std::shared_ptr<const VolumeData> volume) {
  if (volume == nullptr) {
    return fail(ErrorCode::bad_parameter, "no volume to draw");
  }
  if (auto ok = check_volume(*volume); !ok) {
    return ok;
  }
  auto plan = plan_folds(volume->sv.shape(), most_3d_);
  if (!plan) {
    return pass_on(plan);
  }
  const bool same_grid = volume_ != nullptr && same_sector(volume_->sector, volume->sector);
  volume_ = std::move(volume);
  plan_ = *plan;
  filled_ = filled_volume(volume_->sv);
  cells_ = macrocells(filled_);
  masks_ = {};
  mask_voxels_.reset();
  mask_rgb_.reset();
  answered_.reset();
  plain_copies();
  if (!same_grid) {
    axes_ = grid_axes(volume_->sector);
    angles_ = angle_texture(axes_);
    faces_ = faces_texture(axes_);
    pass_.set_hull(axes_);
  }
  sv_ = sv_texture(plan_, filled_.sv.view(), can_.sv_voxels);
  known_ = filled_.complete() ? Texture() : known_texture(plan_, filled_.known.view());
  largest_ = largest_texture(cells_.largest);
  if (const std::string complaint = gl_complaint(); !complaint.empty()) {
    volume_.reset();
    return fail(ErrorCode::unsupported, fmt::format("the driver does not take the volume: {}", complaint));
  }
  return {};
}

Result<void> GlRenderer::set_transfer(const OpticalTable& table) {
  if (auto ok = check_transfer(table); !ok) {
    return ok;
  }
  table_ = transfer_table(table);
  plain_copies();
  optics_ = optics_texture(table, *table_);
  answered_.reset();
  return {};
}

Result<void> GlRenderer::set_masks(std::span<const MaskLayer> masks) {
  if (volume_ == nullptr) {
    return fail(ErrorCode::bad_parameter, "masks without a volume");
  }
  auto grid = mask_grid(masks, cells_, filled_.sv.shape());
  if (!grid) {
    return pass_on(grid);
  }
  masks_ = std::move(*grid);
  answered_.reset();
  mask_voxels_.reset();
  mask_rgb_.reset();
  if (!masks_.empty()) {
    plain_copies();
    mask_voxels_ = mask_texture(plan_, masks_.voxels.view());
    mask_rgb_ = mask_colours(masks_);
  }
  return {};
}

Result<void> GlRenderer::check_drawable(const VolumeView& view, const DrawQuality& quality) const {
  if (volume_ == nullptr || !table_) {
    return fail(ErrorCode::bad_parameter, volume_ == nullptr ? "no volume to draw yet" : "no transfer table yet");
  }
  if (auto ok = check_view(view, quality); !ok) {
    return ok;
  }
  const int largest = std::max({view.size.width, view.size.height, cell_rows(cells_.size())});
  if (largest > can_.most_2d) {
    return fail(ErrorCode::unsupported,
                fmt::format("a texture of {} to a side is needed; the driver's largest is {}", largest, can_.most_2d));
  }
  return {};
}

void GlRenderer::answer(const CellQuestion& question, Work& work) {
  if (answered_ == question) {
    return;
  }
  CellStates states = cell_states(question, filled_, cells_, *table_, masks_, axes_.spacing_m, work);
  if (work.cancelled()) {
    return;
  }
  states_ = state_texture(states.distance, states.flags);
  means_ = states.means.empty() ? Texture() : means_texture(std::move(states.means));
  answered_ = question;
}

void GlRenderer::set_opaque(const VolumeView& view) {
  if (opaque_m_ != view.opaque_m) {
    opaque_m_ = view.opaque_m;
    opaque_ = opaque_m_ == nullptr ? Texture() : texture_2d("opaque", view.size, Texels::r32f, opaque_m_->data());
  }
}

RayVariant GlRenderer::variant(const VolumeView& view) const {
  RayVariant out = sector_variant(axes_);
  out.mode = view.mode;
  out.lit = view.lighting.on;
  out.data = view.masks.data_too;
  out.cued = view.cue.on();
  out.gapped = !filled_.complete();
  out.folded = plan_.folded();
  out.opaque = view.opaque_m != nullptr;
  // Layers count from 1.
  out.mask_words = masks_.empty() ? 0 : static_cast<int>(masks_.rgb.size() / 32 + 1);
  return out;
}

std::array<unsigned, kUnits> GlRenderer::textures() const {
  std::array<unsigned, kUnits> out{};
  out[kSvUnit] = sv_.id();
  out[kKnownUnit] = known_.id();
  out[kAngleUnit] = angles_.id();
  out[kFacesUnit] = faces_.id();
  out[kOpticsUnit] = optics_.id();
  out[kStateUnit] = states_.id();
  out[kMeansUnit] = means_.id();
  out[kLargestUnit] = largest_.id();
  out[kMaskUnit] = mask_voxels_.id();
  out[kMaskColoursUnit] = mask_rgb_.id();
  out[kOpaqueUnit] = opaque_.id();
  return out;
}

Result<RayImage> GlRenderer::traced(const VolumeView& view, const DrawQuality& quality) {
  const RayVariant wanted = variant(view);
  if (auto ok = pass_.prepare(wanted); !ok) {
    return pass_on(ok);
  }
  const PixelSize size = divided(view.size, quality.divisor);
  if (!target_.resize(size)) {
    target_ = {};
    return fail(ErrorCode::unsupported,
                fmt::format("the driver does not draw into {} x {} pixels of four floats", size.width, size.height));
  }
  const double counts_per_unit = can_.sv_voxels == Voxels::float32 ? 1.0 : 32767.0;
  pass_.draw(wanted,
             ray_block({view,
                        quality,
                        axes_,
                        *table_,
                        plan_,
                        volume_->surface_z_m,
                        counts_per_unit,
                        {cells_.ranges, cells_.beams, cells_.fans}}),
             textures());
  RayImage out{size, std::vector<std::array<float, 4>>(size.count()), {}};
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glReadPixels(0, 0, size.width, size.height, GL_RGBA, GL_FLOAT, out.rgba.data());
  if (const std::string complaint = gl_complaint(); !complaint.empty()) {
    return fail(ErrorCode::unsupported, fmt::format("the driver did not draw the volume: {}", complaint));
  }
  return out;
}

Result<RayImage> GlRenderer::draw(const VolumeView& view, const DrawQuality& quality, Work& work) {
  if (auto ok = check_drawable(view, quality); !ok) {
    return pass_on(ok);
  }
  (void)gl_complaint();  // others' errors are not ours
  const PlainState state(divided(view.size, quality.divisor), kUnits);
  answer(cell_question(view, quality), work);
  if (work.cancelled()) {
    return fail(ErrorCode::cancelled, "drawing was cancelled");
  }
  set_opaque(view);
  return traced(view, quality);
}

}  // namespace

Result<std::unique_ptr<VolumeRenderer>> make_gl_renderer(const GlRendererOptions& options) {
  auto can = capabilities();
  if (!can) {
    return pass_on(can);
  }
  auto out = std::make_unique<GlRenderer>(std::move(*can), options);
  if (auto ok = out->start(); !ok) {
    return pass_on(ok);
  }
  return std::unique_ptr<VolumeRenderer>(std::move(out));
}

}  // namespace sonar
