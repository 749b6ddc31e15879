// SPDX-License-Identifier: Apache-2.0
#include "session/slices/slice_actions.h"
#include "session/slices/slice_model.h"

namespace sonar {
namespace {

constexpr const char* kMenu = "&View";
constexpr SvScale kUsual{};
constexpr double kWeakLow_db = -70.0;

using Change = void (*)(DisplayParams&);

void change_display(Desk& desk, Change change) {
  DisplayParams params = desk.workspace.display.values();
  change(params);
  desk.workspace.display.assign(params);
}

void add_scale(Desk& desk, const char* id, const char* text, const char* key, const char* tip, Change change) {
  desk.actions.add({id, kMenu, text, {key}, tip, [&desk, change] {
                      // What was asked for is seen, even where the view curve was drawn by hand.
                      desk.workspace.curve_follows_scale.set(true);
                      change_display(desk, change);
                    }});
}

void add_switch(Desk& desk, const char* id, const char* text, const char* key, bool DisplayParams::*field) {
  desk.actions.add({id,
                    kMenu,
                    text,
                    {key},
                    "",
                    [&desk, field] {
                      DisplayParams params = desk.workspace.display.values();
                      params.*field = !(params.*field);
                      desk.workspace.display.assign(params);
                    },
                    {},
                    [&desk, field] { return desk.workspace.display.values().*field; }});
}

}  // namespace

void add_display_actions(Desk& desk) {
  add_scale(desk, "display.ek500", "EK500 colours, \u221260 to \u221224 dB", "F5", "Twelve steps of 3 dB",
            [](DisplayParams& p) {
              p.scale.map = ColourMapName::ek500;
              p.scale.low_db = kUsual.low_db;
              p.scale.span_db = kUsual.span_db;
            });
  add_scale(desk, "display.weak", "EK500 colours, \u221270 to \u221234 dB", "F6", "For weak schools",
            [](DisplayParams& p) {
              p.scale.map = ColourMapName::ek500;
              p.scale.low_db = kWeakLow_db;
              p.scale.span_db = kUsual.span_db;
            });
  add_scale(desk, "display.smooth", "Smooth colours", "F7", "Told apart by colour-blind eyes too; the limits stay",
            [](DisplayParams& p) { p.scale.map = ColourMapName::viridis; });
  add_switch(desk, "display.filtered", "Slices: filtered data", "F8", &DisplayParams::filtered);
  add_switch(desk, "display.masks", "Schools over the data", "M", &DisplayParams::masks);
  add_switch(desk, "display.refused", "Refused echoes over the data", "Shift+M", &DisplayParams::refused_echoes);
  add_switch(desk, "display.north_up", "North up", "Ctrl+U", &DisplayParams::north_up);
  desk.actions.add({"display.all",
                    kMenu,
                    "Slices: show all",
                    {"Ctrl+0"},
                    "Ends zoom and pan",
                    [&desk] {
                      for (const PictureDock& dock : desk.pictures) {
                        if (auto* slice = dynamic_cast<SliceModel*>(dock.picture.get())) slice->show_all();
                      }
                    },
                    [&desk] { return desk.workspace.document.shown() != nullptr; }});
}

}  // namespace sonar
