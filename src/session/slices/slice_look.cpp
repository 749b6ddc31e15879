// SPDX-License-Identifier: Apache-2.0
#include "session/slices/slice_look.h"

namespace sonar {

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
  if (display.weak == NoiseLook::hatched) style.hatched |= SampleFlags::low_snr;
  if (display.weak == NoiseLook::transparent) style.faded |= SampleFlags::low_snr;
  return style;
}

SampleFlags left_out_of_volume(const DisplayParams& display) {
  SampleFlags hidden = display.removed == NoiseLook::shown ? SampleFlags::none : kNotFiltered;
  if (display.weak != NoiseLook::shown) hidden |= SampleFlags::low_snr;
  return hidden;
}

SvColours slice_colours(const Workspace& workspace) {
  const SvScale& scale = workspace.display.values().scale;
  if (workspace.curve_follows_scale()) return sv_colours(scale);
  return sv_colours(workspace.view_curve(), scale.threshold_db, scale.no_data);
}

}  // namespace sonar
