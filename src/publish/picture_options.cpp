// SPDX-License-Identifier: Apache-2.0
#include "publish/picture_options.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string_view>

namespace sonar {
namespace {

constexpr double kMostPixels = 64e6;

/// `count` finite numbers between commas.
template <std::size_t count>
Result<std::array<double, count>> numbers(std::string_view name, const std::string& text) {
  std::array<double, count> out{};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto [after, problem] = std::from_chars(at, end, out[i]);
    const bool more = i + 1 < count;
    if (problem != std::errc() || !std::isfinite(out[i]) || (more ? after == end || *after != ',' : after != end)) {
      return fail(ErrorCode::bad_parameter,
                  fmt::format("{} {}: expected {} numbers between commas", name, text, count));
    }
    at = after + (more ? 1 : 0);
  }
  return out;
}

Result<void> validate_size(const PictureOptions& options) {
  const double scale = options.scale;
  if (auto valid = validate(PaperParams{options.size.width, options.size.height, scale}); !valid) return valid;
  const double pixels = 1.0 * options.size.width * options.size.height * scale * scale;
  if (pixels <= kMostPixels) return {};
  return fail(ErrorCode::bad_parameter,
              fmt::format("{} x {} at scale {:g} makes {:.0f} million pixels; expected {:.0f} at most",
                          options.size.width, options.size.height, scale, pixels / 1e6, kMostPixels / 1e6));
}

Result<void> validate_plane(const PlaneSliceParams& plane) {
  const auto places = places_of(plane);
  if (!places) return pass_on(places);
  const auto& t = places->through;
  const bool one_place = plane.plane == PlaneLies::through_places && t[0] == t[2] && t[1] == t[3];
  const bool no_normal = plane.plane == PlaneLies::oblique && places->normal == std::array<double, 3>{};
  if (!one_place && !no_normal) return {};
  return fail(ErrorCode::bad_parameter, "these numbers make no plane: expected two places or a normal");
}

}  // namespace

Result<void> validate_options(const PictureOptions& options) {
  if (auto valid = validate_size(options); !valid) return valid;
  if (auto valid = validate(options.display); !valid) return valid;
  if (auto valid = validate(options.volume); !valid) return valid;
  if (auto valid = validate(options.kind); !valid) return valid;
  if (options.display.fuzzy_above > options.display.core_at) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("fuzzy {} lies above core {}", options.display.fuzzy_above, options.display.core_at));
  }
  if (auto valid = validate_plane(options.kind.slice_plane); !valid) return valid;
  if (const auto camera = named_camera(options.kind.volume); !camera) return pass_on(camera);
  return {};
}

Result<PlanePlaces> places_of(const PlaneSliceParams& params) {
  const auto through = numbers<4>("through", params.through);
  if (!through) return pass_on(through);
  const auto point = numbers<3>("point", params.point);
  if (!point) return pass_on(point);
  const auto normal = numbers<3>("normal", params.normal);
  if (!normal) return pass_on(normal);
  return PlanePlaces{*through, *point, *normal};
}

Result<std::optional<Camera>> named_camera(const CameraParams& params) {
  if (params.eye.empty() && params.target.empty()) return std::optional<Camera>{};
  if (params.eye.empty() || params.target.empty()) {
    return fail(ErrorCode::bad_parameter, "eye and target make a camera together");
  }
  const auto eye = numbers<3>("eye", params.eye);
  if (!eye) return pass_on(eye);
  const auto target = numbers<3>("target", params.target);
  if (!target) return pass_on(target);
  if (*eye == *target) return fail(ErrorCode::bad_parameter, "eye and target are the same place");
  Camera camera;
  camera.eye = {(*eye)[0], (*eye)[1], (*eye)[2]};
  camera.target = {(*target)[0], (*target)[1], (*target)[2]};
  return std::optional(camera);
}

Theme theme_of(const PictureOptions& options) {
  Theme theme = options.panel ? panel_theme(*options.panel, options.dark)
                              : with_text(options.dark ? dark_theme(options.size) : light_theme(options.size),
                                          options.least_text_px);
  theme.units = options.units;
  return theme;
}

Result<TransferFunction> view_curve(const PictureOptions& options) {
  if (options.transfer) return *options.transfer;
  // Strong enough that a school some tens of metres thick is opaque at its core.
  return transfer_function(options.display.scale, 0.9);
}

SvColours colours_of(const PictureOptions& options) {
  const SvScale& scale = options.display.scale;
  if (options.transfer) return sv_colours(*options.transfer, scale.threshold_db, scale.no_data);
  return sv_colours(scale);
}

TrailParams trail_params(const VolumeParams& volume) {
  if (!volume.context) return {};
  return {volume.ship_track, volume.school_tracks, volume.trail_pings};
}

MaskStyle mask_style(const DisplayParams& display, const VolumeParams& volume) {
  MaskStyle style;
  style.fuzzy_above = static_cast<float>(display.fuzzy_above);
  style.core_at = static_cast<float>(display.core_at);
  style.data_too = volume.data;
  return style;
}

}  // namespace sonar
