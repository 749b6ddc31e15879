// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <utility>
#include <vector>

#include "session/slices/slice_actions.h"
#include "session/slices/slice_model.h"

namespace sonar {
namespace {

constexpr const char* kMenu = "&View";
constexpr SvScale kUsual{};
constexpr double kWeakLow_db = -70.0;

using Change = void (*)(DisplayParams&);

void change_display(AppModel& app, Change change) {
  DisplayParams params = app.workspace.display.values();
  change(params);
  app.workspace.display.assign(params);
}

void add_scale(AppModel& app, const char* id, const char* text, const char* key, const char* tip, Change change) {
  app.actions.add({id, kMenu, text, {key}, tip, [&app, change] {
                     // What was asked for is seen, even where the view curve was drawn by hand.
                     app.workspace.curve_follows_scale.set(true);
                     change_display(app, change);
                   }});
}

/// As fingers that spread over the middle of the view.
void add_zoom(AppModel& app, const char* id, const char* text, std::vector<std::string> keys, double factor) {
  app.actions.add({id, kMenu, text, std::move(keys), "The view that has the keyboard, about its middle",
                   [&app, factor] {
                     LivePicture* view = app.dialogs.view_in_use ? app.picture(app.dialogs.view_in_use()) : nullptr;
                     if (view == nullptr) return;
                     const PixelSize size = view->size();
                     PointerEvent zoom{PointerAction::zoom, PointerButton::none, {0.5 * size.width, 0.5 * size.height}};
                     zoom.factor = factor;
                     view->pointer(zoom);
                   },
                   [&app] { return app.workspace.document.survey() != nullptr; }});
}

template <class P>
void add_switch(AppModel& app, const char* id, const char* text, const char* key, Parameters<P>& parameters,
                bool P::*field) {
  app.actions.add({id,
                   kMenu,
                   text,
                   {key},
                   "",
                   [&parameters, field] {
                     P params = parameters.values();
                     params.*field = !(params.*field);
                     parameters.assign(params);
                   },
                   {},
                   [&parameters, field] { return parameters.values().*field; }});
}

}  // namespace

void add_display_actions(AppModel& app) {
  add_scale(
      app, "display.usual", "Usual colours and limits", "F5",
      "Even steps that colour-blind eyes tell apart, \u221260 to \u221224 dB, no threshold; the view curve follows",
      [](DisplayParams& p) { p.scale = kUsual; });
  add_scale(app, "display.weak", "Limits for weak schools", "F6", "\u221270 to \u221234 dB; the colours stay",
            [](DisplayParams& p) {
              p.scale.low_db = kWeakLow_db;
              p.scale.span_db = kUsual.span_db;
            });
  add_scale(app, "display.ek500", "EK500 colours", "F7", "Twelve steps of the echo sounder; the limits stay",
            [](DisplayParams& p) { p.scale.map = ColourMapName::ek500; });
  Parameters<DisplayParams>& display = app.workspace.display;
  add_switch(app, "display.filtered", "Slices: filtered data", "F8", display, &DisplayParams::filtered);
  add_switch(app, "display.masks", "Schools over the data", "M", display, &DisplayParams::masks);
  add_switch(app, "display.refused", "Refused echoes over the data", "Shift+M", display,
             &DisplayParams::refused_echoes);
  add_switch(app, "display.north_up", "North up", "Ctrl+U", display, &DisplayParams::north_up);
  app.actions.add({"slices.lock",
                   kMenu,
                   "Slices: stay where they are",
                   {"Ctrl+Shift+L"},
                   "Else they follow the selected school",
                   [&app] { app.workspace.slices_locked.set(!app.workspace.slices_locked()); },
                   {},
                   [&app] { return app.workspace.slices_locked(); }});
  app.actions.add({"display.all",
                   kMenu,
                   "Slices: show all",
                   {"Ctrl+0"},
                   "Ends zoom and pan",
                   [&app] {
                     for (const PictureDock& dock : app.pictures) {
                       if (auto* slice = dynamic_cast<SliceModel*>(dock.picture.get())) slice->show_all();
                     }
                   },
                   [&app] { return app.workspace.document.shown() != nullptr; }});
  add_zoom(app, "view.nearer", "Zoom in", {"Ctrl++", "Ctrl+="}, 1.25);
  add_zoom(app, "view.farther", "Zoom out", {"Ctrl+-"}, 0.8);
  Parameters<TimelineLimits>& timelines = app.workspace.timelines;
  add_switch(app, "timelines.filtered", "Timelines: filtered data", "Shift+F8", timelines, &TimelineLimits::filtered);
  add_switch(app, "timelines.maximum", "Timelines: maximum over beams", "Ctrl+F8", timelines, &TimelineLimits::maximum);
}

}  // namespace sonar
