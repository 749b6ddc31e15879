// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/stages/noise_steps.h"
#include "session/listening.h"
#include "session/live/live_picture.h"
#include "session/open/workspace.h"
#include "view/slices/slice_steps.h"

namespace sonar {

/// What the picture shows, and of which ping.
struct NoiseStepsSight {
  SliceStepsPicture picture;
  std::shared_ptr<const NoiseSteps> steps;
};

/// The slice in use at each step of noise removal, as the recipe in force takes them; which slice and which two steps are
/// compared, the parameters of pictures say (picture_file.kind.noise_steps), so that a picture in a file is that of the
/// window. A click on a step compares it with the one before it, with Shift what is compared with it is another; a click on
/// a compared picture shows all steps again. The wheel moves the slice.
class NoiseStepsModel : public LivePicture {
 public:
  explicit NoiseStepsModel(Workspace& workspace);

  void pointer(const PointerEvent& event) override;
  [[nodiscard]] std::vector<Overlay> overlays() const override;
  [[nodiscard]] std::string hint(PixelPoint at) const override;
  /// Of the picture on show; null without one.
  [[nodiscard]] const std::shared_ptr<const NoiseStepsSight>& sight() const { return sight_; }

  [[nodiscard]] bool comparing() const;
  /// Compares a step with the one before it; of unfiltered Sv: all that was done to it.
  void compare(NoiseStep step);
  /// Compares the next or an earlier step.
  void step(int by);
  void show_all();

 protected:
  [[nodiscard]] Build build(const PictureLook& look) override;
  void take(const std::shared_ptr<const void>& detail) override;

 private:
  /// What the last picture was made of: another slice of the ping needs no new look at its samples.
  struct Room {
    std::shared_ptr<const NoiseSteps> steps;
  };
  void hear(DocumentChange change);
  void parameters_changed();
  void set(const NoiseStepsParams& params);
  void click(PixelPoint at, bool shift);
  [[nodiscard]] const NoiseStepsParams& params() const { return workspace_.picture_file.values().kind.noise_steps; }
  [[nodiscard]] SliceKind kind() const;
  [[nodiscard]] bool in_sight() const { return sight_ && problem().empty(); }

  Workspace& workspace_;
  NoiseStepsParams asked_;
  double wheel_ = 0.0;                                     ///< steps that make no whole one yet
  std::shared_ptr<Room> room_ = std::make_shared<Room>();  ///< of builds
  std::shared_ptr<const NoiseStepsSight> sight_;
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
