// SPDX-License-Identifier: Apache-2.0
#include "publish/picture.h"

#include "publish/map_pictures.h"
#include "publish/slice_pictures.h"
#include "publish/volume_picture.h"

namespace sonar {
namespace {

Result<FrameDescription> observation_frame(PictureKind kind, DrawnObservation& observation,
                                           const PictureOptions& options, Work& work) {
  switch (kind) {
    case PictureKind::volume:
      return volume_frame(observation, options, work);
    case PictureKind::propagation:
      return propagation_frame(observation, options);
    case PictureKind::observation_map:
      return observation_map_frame(observation, options);
    case PictureKind::timeline:
      return timeline_frame({&observation}, options, work);
    default:
      return slice_frame(kind, observation, options, work);
  }
}

}  // namespace

Result<FrameDescription> picture_frame(PictureKind kind, PictureSource& source, const std::string& observation,
                                       const PictureOptions& options, Work& work) {
  if (kind == PictureKind::survey_map) return survey_map_frame(source.observations(), options, work);
  if (kind == PictureKind::timeline && options.whole_survey) {
    std::vector<DrawnObservation*> all;
    for (DrawnObservation& one : source.observations()) all.push_back(&one);
    return timeline_frame(all, options, work);
  }
  const auto chosen = source.observation(observation);
  if (!chosen) return pass_on(chosen);
  return observation_frame(kind, **chosen, options, work);
}

}  // namespace sonar
