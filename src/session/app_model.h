// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "session/actions.h"
#include "session/listening.h"
#include "session/live/live_picture.h"
#include "session/looks/transfer_editor.h"
#include "session/open/workspace.h"
#include "session/playing/animation_driver.h"
#include "session/recipes/control_panel.h"
#include "session/review/rows.h"
#include "session/words/key_said.h"
#include "session/words/preferences.h"

namespace sonar {

class Batch;
class BrushTool;
class FirstSight;
class FishBiomass;
class Integration;
class KeptThumbnails;
class LiveWatch;
class MeasureTool;
class MergeOffer;
class Playback;
class SeedTool;
class SlicesFollow;

enum class DockPlace : std::uint8_t { centre, left, right, bottom };

/// A dock with a picture in it.
struct PictureDock {
  std::string id;     ///< "top_slice"
  std::string title;  ///< "Slice from above"
  DockPlace place = DockPlace::centre;
  std::string view_switch;  ///< property of ViewSwitches that turns it off; empty = always on
  std::unique_ptr<LivePicture> picture;
};

/// A dock with a list in it.
struct RowsDock {
  std::string id;
  std::string title;
  DockPlace place = DockPlace::bottom;
  std::unique_ptr<Rows> rows;
  bool tree = false;
};

/// Everything that a window composes: the workspace, the models of its docks, what can be asked for. No window is needed to
/// have one.
class AppModel {
 public:
  AppModel(ChangeQueue& queue, DocumentOptions options);
  ~AppModel();
  AppModel(const AppModel&) = delete;
  AppModel& operator=(const AppModel&) = delete;

  Workspace workspace;
  Preferences preferences;
  Dialogs dialogs;
  Actions actions;
  KeySaid key_said{workspace, actions};
  AnimationDriver animations;  ///< what goes on by itself: a window ticks it while it runs
  // Of all views together:
  std::shared_ptr<SeedTool> seed_tool;
  std::shared_ptr<BrushTool> brush_tool;
  std::shared_ptr<MeasureTool> measure_tool;
  std::shared_ptr<Playback> playback;
  std::shared_ptr<SlicesFollow> slices_follow;
  std::shared_ptr<FirstSight> first_sight;
  std::shared_ptr<LiveWatch> live;
  std::shared_ptr<MergeOffer> merge_offer;
  std::shared_ptr<Batch> batch;
  std::shared_ptr<Integration> integration;
  std::shared_ptr<FishBiomass> fish;
  std::vector<PictureDock> pictures;
  std::vector<RowsDock> lists;
  std::shared_ptr<KeptThumbnails> thumbnails;
  std::unique_ptr<TransferEditor> transfer;  ///< on top of the control panel
  std::vector<PanelSection> panel;
  Listening listening;  ///< of whatever is composed here; the last member: it ends first

  /// Null where there is none of that id.
  [[nodiscard]] LivePicture* picture(const std::string& id);
  [[nodiscard]] Rows* rows(const std::string& id);
};

/// What stands in a picture's dock while there is no picture and nothing wrong with it.
[[nodiscard]] std::string idle_text(const AppModel& app, const std::string& dock);

}  // namespace sonar
