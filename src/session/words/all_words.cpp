// SPDX-License-Identifier: Apache-2.0
#include "session/words/all_words.h"

#include <initializer_list>
#include <sstream>

#include "session/looks/curves.h"
#include "session/numbers/fish_biomass.h"
#include "session/recipes/recipe_editor.h"
#include "session/setup/sphere_page.h"
#include "session/words/window_preferences.h"

namespace sonar {
namespace {

class Words {
 public:
  void add(const std::string& text) {
    if (!text.empty()) words_.insert(text);
  }
  void add(const Action& action) {
    add(action.text);
    add(action.tip);
    std::istringstream menus(action.menu);
    for (std::string one; std::getline(menus, one, '/');) add(one);
  }
  void add(const Property& property) {
    add(property.label);
    add(property.tooltip);
    add(property.at_min);
    for (const std::string& choice : property.choices) add(label_of(choice, {}));
  }
  void add(const PanelSection& section) {
    add(section.title);
    for (const Property& one : section.source->properties()) add(one);
    for (const PanelSection::Look& one : section.looks) add(one.at_min);
    for (const PanelSection::Note& one : section.notes) add(one.text());
  }
  void add(const Rows& rows) {
    for (const ListColumn& column : rows.columns()) {
      add(column.title);
      add(column.tip);
    }
  }
  template <class P>
  void add(const Parameters<P>& parameters) {
    for (const Property& one : parameters.properties()) add(one);
  }
  [[nodiscard]] std::set<std::string> take() { return std::move(words_); }

 private:
  std::set<std::string> words_;
};

}  // namespace

std::set<std::string> all_words(AppModel& app) {
  Words words;
  for (const Action& action : app.actions.list()) words.add(action);
  for (const PictureDock& dock : app.pictures) words.add(dock.title);
  for (const RowsDock& dock : app.lists) {
    words.add(dock.title);
    words.add(*dock.rows);
  }
  for (const PanelSection& section : app.panel) words.add(section);
  for (const PanelSection& section : preference_pages(app)) words.add(section);
  const RecipeEditor recipe(app.workspace.queue, {});
  for (const PanelSection& section : recipe.sections({}, false)) words.add(section);
  for (const CurvePreset& preset : curve_presets()) {
    words.add(label_of(preset.name, {}));
    words.add(std::string(preset.text));
  }
  words.add(app.integration->params);
  words.add(app.fish->params);
  for (const Rows* rows : std::initializer_list<const Rows*>{&app.integration->effort_rows, &app.integration->nasc_rows,
                                                             &app.integration->strata_rows, &app.fish->school_rows,
                                                             &app.fish->strata_rows}) {
    words.add(*rows);
  }
  words.add(Parameters<SphereAsked>(app.workspace.queue));
  words.add(Parameters<SphereLook>(app.workspace.queue));
  const Workspace& shared = app.workspace;
  words.add(shared.picture_file);
  words.add(shared.figure);
  words.add(shared.reduce);
  return words.take();
}

}  // namespace sonar
