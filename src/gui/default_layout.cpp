// SPDX-License-Identifier: Apache-2.0
#include "gui/default_layout.h"

#include <QDockWidget>
#include <algorithm>
#include <initializer_list>

namespace sonar {
namespace {

constexpr int kLowWindow_px = 1000;
constexpr int kWholeTree_px = 300;
constexpr int kWholeControls_px = 360;
constexpr int kLeastView_px = 400;      ///< a slice with its title and colours
constexpr int kNarrowScreen_px = 1200;  ///< tree, views and controls do not stand beside each other
constexpr int kLowScreen_px = 700;      ///< two rows of views and one of lists do not stand above each other

QDockWidget* dock(const QMainWindow& window, const char* name) { return window.findChild<QDockWidget*>(name); }

QDockWidget* put(QMainWindow& window, Qt::DockWidgetArea area, const char* name) {
  QDockWidget* one = dock(window, name);
  if (one == nullptr) return nullptr;
  one->setFloating(false);
  window.addDockWidget(area, one);
  return one;
}

/// Further docks behind one, as tabs.
void behind(QMainWindow& window, QDockWidget* first, std::initializer_list<const char*> names) {
  if (first == nullptr) return;
  for (const char* name : names) {
    QDockWidget* one = dock(window, name);
    if (one == nullptr) continue;
    one->setFloating(false);
    window.tabifyDockWidget(first, one);
  }
  first->raise();
}

void beside(QMainWindow& window, QDockWidget* left, QDockWidget* right, Qt::Orientation orientation) {
  if (left != nullptr && right != nullptr) window.splitDockWidget(left, right, orientation);
}

void share(QMainWindow& window, Qt::Orientation orientation,
           std::initializer_list<std::pair<QDockWidget*, int>> sizes) {
  QList<QDockWidget*> docks;
  QList<int> wanted;
  for (const auto& [one, size] : sizes) {
    if (one == nullptr) continue;
    docks.append(one);
    wanted.append(size);
  }
  window.resizeDocks(docks, wanted, orientation);
}

/// For a screen of few units, as a dense one has: lists are tabs behind the controls, and each view has a tab mate.
void lay_out_small(QMainWindow& window) {
  QDockWidget* right = put(window, Qt::RightDockWidgetArea, "controls");
  QDockWidget* top = put(window, Qt::TopDockWidgetArea, "top_slice");
  QDockWidget* side = put(window, Qt::TopDockWidgetArea, "side_slice");
  QDockWidget* time = put(window, Qt::BottomDockWidgetArea, "observation_timeline");
  beside(window, top, side, Qt::Horizontal);
  behind(window, right, {"survey_tree", "diagnostics", "journal"});
  behind(window, top, {"observation_map", "survey_map"});
  behind(window, side, {"volume", "range_slice", "plane_slice", "noise_steps"});
  behind(window, time,
         {"echogram", "survey_timeline", "propagation", "schools", "school_pings", "review", "refused", "marks",
          "chart", "frequency", "curves", "lineage"});
  const int width = window.width();
  const int height = window.height();
  share(window, Qt::Horizontal, {{top, width * 33 / 100}, {side, width * 33 / 100}, {right, width * 34 / 100}});
  share(window, Qt::Vertical, {{top, height * 6 / 10}, {time, height * 4 / 10}});
}

/// Beside the views: tree and notes, and the controls.
struct Sides {
  QDockWidget* tree = nullptr;
  QDockWidget* notes = nullptr;
  QDockWidget* controls = nullptr;
  int tree_px = 0;
  int controls_px = 0;  ///< 0: under the tree
};

/// The tree's name, time, pings and schools are seen where the views can spare the room; what is left in wide windows is
/// theirs. Where they cannot spare two columns, the controls stand under the tree.
Sides put_sides(QMainWindow& window) {
  Sides sides;
  sides.tree_px = std::min(kWholeTree_px, window.width() * 22 / 100);
  sides.controls_px = std::min(kWholeControls_px, window.width() / 5);
  if (window.width() - sides.tree_px - sides.controls_px < 2 * kLeastView_px) {
    sides.tree_px = kWholeTree_px;
    sides.controls_px = 0;
  }
  sides.tree = put(window, Qt::LeftDockWidgetArea, "survey_tree");
  sides.notes = put(window, Qt::LeftDockWidgetArea, "diagnostics");
  const auto side = sides.controls_px > 0 ? Qt::RightDockWidgetArea : Qt::LeftDockWidgetArea;
  sides.controls = put(window, side, "controls");
  return sides;
}

void stack(QMainWindow& window, const Sides& sides) {
  if (sides.controls_px > 0) {
    behind(window, sides.notes, {"journal"});
  } else {
    behind(window, sides.tree, {"diagnostics", "journal"});
  }
}

void share_height(QMainWindow& window, const Sides& sides) {
  const int third = window.height() / 3;
  if (sides.controls_px > 0) {
    share(window, Qt::Vertical, {{sides.tree, 2 * third}, {sides.notes, third}});
  } else {
    share(window, Qt::Vertical, {{sides.tree, third}, {sides.controls, 2 * third}});
  }
}

}  // namespace

void lay_out_docks(QMainWindow& window) {
  window.setCorner(Qt::TopLeftCorner, Qt::LeftDockWidgetArea);
  window.setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
  window.setCorner(Qt::TopRightCorner, Qt::RightDockWidgetArea);
  window.setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
  const int width = window.width();
  const int height = window.height();
  if (width < kNarrowScreen_px || height < kLowScreen_px) return lay_out_small(window);
  const Sides sides = put_sides(window);
  behind(window, sides.controls,
         {"range_slice", "plane_slice", "noise_steps"});  // out of the way: a row of all seven would widen the window
  QDockWidget* top = put(window, Qt::TopDockWidgetArea, "top_slice");
  QDockWidget* side = put(window, Qt::TopDockWidgetArea, "side_slice");
  QDockWidget* maps = put(window, Qt::TopDockWidgetArea, "observation_map");
  QDockWidget* volume = put(window, Qt::TopDockWidgetArea, "volume");
  QDockWidget* time = put(window, Qt::BottomDockWidgetArea, "observation_timeline");
  QDockWidget* tables = put(window, Qt::BottomDockWidgetArea, "schools");
  // Splitting moves one dock without its tabs: those come last.
  beside(window, top, side, Qt::Horizontal);
  beside(window, top, maps, Qt::Vertical);
  beside(window, side, volume, Qt::Vertical);
  beside(window, time, tables, Qt::Horizontal);
  behind(window, side, {"range_slice", "plane_slice", "noise_steps"});
  behind(window, maps, {"survey_map"});
  behind(window, time, {"echogram", "survey_timeline", "propagation", "lineage"});
  behind(window, tables, {"school_pings", "review", "refused", "marks", "chart", "frequency", "curves"});
  stack(window, sides);
  const int each = (width - sides.tree_px - sides.controls_px) / 2;
  share(window, Qt::Horizontal, {{sides.tree, sides.tree_px}, {top, each}, {side, each}});
  if (sides.controls_px > 0) share(window, Qt::Horizontal, {{sides.controls, sides.controls_px}});
  share(window, Qt::Horizontal, {{time, each}, {tables, each}});
  share_height(window, sides);
  // In a low window a quarter is too little for a strip of masks with its titles.
  const int below = height < kLowWindow_px ? height * 32 / 100 : height / 4;
  const int above = (height - below) / 2;
  share(window, Qt::Vertical, {{top, above}, {maps, above}, {time, below}});
  share(window, Qt::Vertical, {{side, above}, {volume, above}, {tables, below}});
}

}  // namespace sonar
