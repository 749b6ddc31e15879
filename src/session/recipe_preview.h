// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pipeline/recipe/recipe.h"
#include "session/listening.h"
#include "session/live_picture.h"
#include "session/recipe_editor.h"
#include "session/workspace.h"
#include "view/slices/slice_picture.h"

namespace sonar {

/// The slice in use of the ping looked at: Sv after noise removal and filter, under the recipe in force or under the one that
/// is edited; both in the same place and colours, without schools, which are not detected anew. The next edit cancels what
/// is being made.
class RecipePreview : public LivePicture {
 public:
  /// Both outlive the picture.
  /// edited  whose recipe it shows; null = the one in force
  RecipePreview(Workspace& workspace, RecipeEditor* edited);
  /// The picture on show; null before the first.
  [[nodiscard]] const std::shared_ptr<const SlicePicture>& picture() const { return picture_; }

 protected:
  [[nodiscard]] Build build(const PictureLook& look) override;
  void take(const std::shared_ptr<const void>& detail) override;

 private:
  Workspace& workspace_;
  RecipeEditor* edited_;
  std::shared_ptr<const SlicePicture> picture_;
  Listening listening_;  // the last member: it ends first
};

/// Before and after an edit, beside each other.
struct RecipeComparison {
  RecipeComparison(Workspace& shared, RecipeEditor& editor)
      : workspace(shared), in_force(shared, nullptr), edited(shared, &editor) {}
  Workspace& workspace;
  RecipePreview in_force;
  RecipePreview edited;
};

}  // namespace sonar
