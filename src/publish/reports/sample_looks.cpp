// SPDX-License-Identifier: Apache-2.0
#include "publish/reports/sample_looks.h"

#include <utility>

namespace sonar {
namespace {

SampleFlags all_but(SampleFlags flags) {
  return static_cast<SampleFlags>(static_cast<std::uint8_t>(~static_cast<unsigned>(flags)));
}

}  // namespace

FlagStyle flag_style(const DisplayParams& display) {
  FlagStyle style;
  const SampleFlags faults = kFault;
  switch (display.removed) {
    case NoiseLook::shown:
      break;
    case NoiseLook::hatched:
      style.hatched = faults;
      style.faded = kNeverMember;
      break;
    case NoiseLook::transparent:
      style.hidden = faults | kNeverMember;
      break;
  }
  const SampleFlags styled = all_but(put_back(display));
  style.hidden = style.hidden & styled;
  style.hatched = style.hatched & styled;
  style.faded = style.faded & styled;
  if (display.weak == NoiseLook::hatched) style.hatched |= SampleFlags::low_snr;
  if (display.weak == NoiseLook::transparent) style.faded |= SampleFlags::low_snr;
  return style;
}

SliceStyle slice_style(const DisplayParams& display, SvColours colours) {
  SliceStyle style;
  style.colours = std::move(colours);
  style.flags = flag_style(display);
  style.masks.core_at = display.core_at;
  style.masks.tint = display.tint;
  style.grid = display.grid_lines;
  style.north_up = display.north_up;
  return style;
}

SampleFlags put_back(const DisplayParams& display) {
  const TakenOut& out = display.take_out;
  SampleFlags back = SampleFlags::none;
  const auto unless = [&back](bool taken_out, SampleFlags reason) {
    if (!taken_out) back |= reason;
  };
  unless(out.near_field, SampleFlags::near_field);
  unless(out.surface, SampleFlags::surface);
  unless(out.corrupted_packets, SampleFlags::corrupted);
  unless(out.interference, SampleFlags::interference);
  unless(out.impulse_noise, SampleFlags::impulse);
  unless(out.seabed, SampleFlags::seabed);
  return back;
}

SampleFlags left_out_of_volume(const DisplayParams& display) {
  SampleFlags hidden =
      display.removed == NoiseLook::shown ? SampleFlags::none : kNotFiltered & all_but(put_back(display));
  if (display.weak != NoiseLook::shown) hidden |= SampleFlags::low_snr;
  return hidden;
}

std::optional<double> weak_below(const DisplayParams& display) {
  return display.weak == NoiseLook::shown ? std::nullopt : std::optional(display.weak_below_db);
}

}  // namespace sonar
