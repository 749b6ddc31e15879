// SPDX-License-Identifier: Apache-2.0
#include "gui/action_menus.h"

#include <QAction>
#include <QMenu>
#include <QMenuBar>
#include <array>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "gui/listening_of.h"
#include "gui/translated.h"
#include "gui/view_keys.h"
#include "session/words/context_menu.h"

namespace sonar {
namespace {

/// Text and switch as they are now. Greyed only while a menu is open: a greyed action's key is dead, and nobody would tell
/// when it may live again.
void refresh(QAction& shown, const Action& action) {
  if (action.checked) shown.setChecked(action.checked());
  if (action.text_now) {
    const std::string text = action.text_now();
    shown.setText(text.empty() ? translated(action.text) : QString::fromStdString(text));
  }
}

constexpr std::array<const char*, 7> kMenuBar{"&File", "&Edit", "&View", "&Navigate", "&Schools", "&Review", "&Help"};

/// The menu of a path, "&File/&Export"; made where it is not there yet.
QMenu* menu_of(QMainWindow& window, std::map<std::string, QMenu*>& menus, const std::string& path) {
  QMenu*& menu = menus[path];
  if (menu != nullptr) return menu;
  const auto last = path.rfind('/');
  const QString title = translated(path.substr(last == std::string::npos ? 0 : last + 1));
  menu = last == std::string::npos ? window.menuBar()->addMenu(title)
                                   : menu_of(window, menus, path.substr(0, last))->addMenu(title);
  menu->menuAction()->setObjectName(QString::fromStdString(path));  // whatever the language calls it
  return menu;
}

void take_keys(QAction& shown, const Action& action) {
  QList<QKeySequence> keys;
  for (const std::string& key : action.keys) {
    keys.append(QKeySequence::fromString(QString::fromStdString(key), QKeySequence::PortableText));
  }
  if (shown.shortcuts() != keys) shown.setShortcuts(keys);
}

QAction* make_action(QMainWindow& window, Actions& actions, const Action& action) {
  auto* shown = new KeyedAction(translated(action.text), &window);
  shown->setObjectName(QString::fromStdString(action.id));
  shown->setToolTip(translated(action.tip));
  shown->setStatusTip(translated(action.tip));
  shown->setCheckable(static_cast<bool>(action.checked));
  take_keys(*shown, action);
  QObject::connect(shown, &QAction::triggered, &window, [shown, &actions, &action] {
    // A key works while its menu has not been opened: what is not allowed now is passed over.
    if (shown->by_key()) {
      actions.press(action);
    } else if (!action.enabled || action.enabled()) {
      action.run();
    }
    refresh(*shown, action);
  });
  refresh(*shown, action);
  return shown;
}

void ask_when_opened(QMenu& menu, QAction& shown, const Action& action) {
  QObject::connect(&menu, &QMenu::aboutToShow, &shown, [&menu, &shown, &action] {
    const bool meant = !action.of_school || !menu.property(kBesideSchools).toBool();
    shown.setEnabled(meant && (!action.enabled || action.enabled()));
    refresh(shown, action);
  });
  QObject::connect(&menu, &QMenu::aboutToHide, &shown, [&shown] { shown.setEnabled(true); });
}

}  // namespace

void add_menus(QMainWindow& window, Actions& actions) {
  std::map<std::string, QMenu*> menus;
  std::vector<std::pair<QAction*, const Action*>> switches;
  for (const char* title : kMenuBar) menu_of(window, menus, title);
  for (const Action& action : actions.list()) {
    QMenu* menu = menu_of(window, menus, action.menu);
    QAction* shown = make_action(window, actions, action);
    if (begins_group(action.id) && !menu->isEmpty()) menu->addSeparator();
    menu->addAction(shown);
    window.addAction(shown);
    ask_when_opened(*menu, *shown, action);
    if (action.checked) switches.emplace_back(shown, &action);
  }
  listening_of(window).to(actions.keys_changed(), [&window, &actions] {
    for (const Action& action : actions.list()) {
      if (QAction* shown = find_action(window, action.id)) take_keys(*shown, action);
    }
  });
  // One switch may turn others off: the brush the seed.
  const auto all = std::make_shared<decltype(switches)>(std::move(switches));
  for (const auto& [shown, action] : *all) {
    QObject::connect(shown, &QAction::triggered, &window, [all] {
      for (const auto& [each, of] : *all) refresh(*each, *of);
    });
  }
}

QMenu* add_context_menu(QMainWindow& window, const std::string& dock, const Actions& actions) {
  auto* menu = new QMenu(&window);
  menu->setObjectName(QString::fromStdString(dock + ".menu"));
  for (const ActionGroup& group : context_menu(dock)) {
    if (!menu->isEmpty()) menu->addSeparator();
    for (const std::string_view id : group) {
      const Action* action = actions.find(id);
      QAction* shown = find_action(window, std::string(id));
      if (action == nullptr || shown == nullptr) continue;
      menu->addAction(shown);
      ask_when_opened(*menu, *shown, *action);
    }
  }
  return menu;
}

QAction* find_action(const QMainWindow& window, const std::string& id) {
  return window.findChild<QAction*>(QString::fromStdString(id));
}

}  // namespace sonar
