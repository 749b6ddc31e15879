// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "session/listeners.h"
#include "view/image.h"

namespace sonar {

class FigureModel;
class RecipeEditor;
class Rows;
class SetupPage;
class SpherePage;
struct PanelSection;

/// Something that a user can ask for: the one list from which menus, keys, buttons and the sheet of keys are made.
struct Action {
  std::string id;                 ///< "ping.next"
  std::string menu;               ///< "&Navigate", "&File/&Export"; its actions stand in the order in which they came
  std::string text;               ///< "Next ping"; may be replaced by text_now
  std::vector<std::string> keys;  ///< portable names, "Right", "Ctrl+Z"; the first stands in menus
  std::string tip;
  std::function<void()> run;
  std::function<bool()> enabled = {};          ///< empty = always
  std::function<bool()> checked = {};          ///< given = the action is a switch
  std::function<std::string()> text_now = {};  ///< "Undo grow school 3"
  bool of_school = false;  ///< done to the selected school: a menu that opens beside every school does not offer it
};

/// All actions of a window, in the order of its menus.
class Actions {
 public:
  void add(Action action) { list_.push_back(std::move(action)); }
  [[nodiscard]] std::span<const Action> list() const { return list_; }
  /// Null where there is none of that id.
  [[nodiscard]] const Action* find(std::string_view id) const;
  /// Runs an action that a key asks for, where it may run now, and tells who listens.
  void press(const Action& action);
  /// What a key asked for: its text before it ran, and whether it was allowed to.
  using Pressed = std::function<void(const Action& action, const std::string& text, bool allowed)>;
  /// Called before the action runs.
  void on_press(Pressed pressed) { pressed_ = std::move(pressed); }
  /// Null where no action has the key.
  [[nodiscard]] const Action* with_key(std::string_view key) const;
  /// Gives an action other keys; what another one has stays with that. False = one was not given.
  bool set_keys(std::string_view id, const std::vector<std::string>& keys);
  /// A text that names actions, "[schools.detect] detects them": the key of each stands for it, or, where it has none, what it
  /// is called in the menu.
  [[nodiscard]] std::string with_keys(std::string_view text) const;
  /// The keys that an action came with.
  [[nodiscard]] const std::vector<std::string>& usual_keys(const Action& action) const;
  /// By id, of those whose keys are not the usual ones.
  using Keys = std::map<std::string, std::vector<std::string>, std::less<>>;
  [[nodiscard]] Keys changed_keys() const;
  /// As changed_keys() was; all others have their usual keys. Actions that are not there are passed over.
  void take_keys(const Keys& keys);
  /// Called when keys have changed.
  [[nodiscard]] Listeners<>& keys_changed() { return keys_changed_; }
  /// Two actions with one key: their ids; empty where there are none. For a test.
  [[nodiscard]] std::vector<std::string> clashes() const;

 private:
  std::vector<Action> list_;
  Pressed pressed_;
  Keys usual_;  ///< by id, of those that were changed
  Listeners<> keys_changed_;
};

/// What only a window can ask a human for. Each answers at once or not at all (empty = the human declined; an answer that is
/// an empty text is one).
struct Dialogs {
  std::function<std::vector<std::string>()> files_to_open;
  /// pattern  "Pictures (*.png *.svg);;All files (*)"
  std::function<std::string(const std::string& title, const std::string& pattern)> file_to_open;
  std::function<std::string()> folder_to_open;
  std::function<std::string(const std::string& title, const std::string& pattern, const std::string& name)>
      file_to_save;
  /// start  a folder that is there; empty = whichever
  std::function<std::string(const std::string& title, const std::string& start)> folder_to_save;
  std::function<std::string()> folder_to_run;  ///< a survey, or a folder of surveys
  std::function<std::optional<std::string>(const std::string& title, const std::string& label, const std::string& text)>
      text;
  std::function<bool(const std::string& question)> yes;
  /// Lets a human change parameters; false = declined
  std::function<bool(const std::string& title, const PanelSection& section)> parameters;
  std::function<bool()> preferences;     ///< lets a human change them, and they follow at once; false = declined
  std::function<bool()> system_is_dark;  ///< whether the desktop is in dark colours; empty = not known
  std::function<bool(RecipeEditor& editor)> recipe;                ///< lets a human change a recipe; false = declined
  std::function<void(FigureModel& figure)> figure;                 ///< lets a human compose a page and write it
  std::function<void(const std::string& title, Rows& rows)> rows;  ///< shows a table to look at
  std::function<void(const std::string& text)> copy;
  std::function<void(SpherePage& page)> sphere;                      ///< the calibration page
  std::function<void(SetupPage& page)> setup;                        ///< the page of the setup check
  std::function<void()> show_batch;                                  ///< the window of surveys to be run
  std::function<void()> show_integration;                            ///< the page of echo integration
  std::function<void()> show_biomass;                                ///< the page of numbers and biomass
  std::function<void()> show_keys;                                   ///< the sheet of keys
  std::function<bool(const std::filesystem::path& page)> show_page;  ///< outside the program; false = nothing shows it
  std::function<void()> show_about;
  std::function<void()> reset_layout;
  std::function<void()> full_screen;  ///< on and off
  std::function<void(const Image& image)> copy_image;
  std::function<bool()> copy_rows;           ///< those marked in the list that has the keyboard; false = no list has it
  std::function<std::string()> view_in_use;  ///< id of the dock that has, or last had, the keyboard or the pointer
  std::function<void()> quit;
};

}  // namespace sonar
