// SPDX-License-Identifier: Apache-2.0
#include "gui/key_page.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "gui/translated.h"

namespace sonar {
namespace {

QString text(const std::string& utf8) { return QString::fromStdString(utf8); }

/// As a keyboard has them written on it.
QString keys_text(const std::vector<std::string>& keys) {
  QStringList shown;
  for (const std::string& key : keys) {
    shown.append(QKeySequence::fromString(text(key), QKeySequence::PortableText).toString(QKeySequence::NativeText));
  }
  return shown.join(", ");
}

QString menu_text(const Action& action) { return translated_menu(action.menu, " > ").remove('&'); }

}  // namespace

KeyField::KeyField(QWidget* parent) : QLineEdit(parent) {
  setReadOnly(true);
  setPlaceholderText(translated("Click here, then press the key"));
}

bool KeyField::event(QEvent* event) {
  const bool asked = event->type() == QEvent::ShortcutOverride;
  if (!asked && event->type() != QEvent::KeyPress) return QLineEdit::event(event);
  const auto& pressed = dynamic_cast<const QKeyEvent&>(*event);
  const int key = pressed.key();
  const bool other = key == Qt::Key_Tab || key == Qt::Key_Backtab || key == Qt::Key_Escape || key == Qt::Key_unknown;
  if (other) return QLineEdit::event(event);
  event->accept();
  const bool alone = key == Qt::Key_Shift || key == Qt::Key_Control || key == Qt::Key_Alt || key == Qt::Key_Meta ||
                     key == Qt::Key_AltGr;
  if (asked || alone || !told_) return true;
  auto modifiers = pressed.modifiers() & ~Qt::KeypadModifier;
  // "+" is "+" wherever a keyboard has it; only letters are told apart by Shift.
  const bool sign = key > Qt::Key_Space && key < Qt::Key_Escape && (key < Qt::Key_A || key > Qt::Key_Z);
  if (sign) modifiers &= ~Qt::ShiftModifier;
  told_(QKeySequence(QKeyCombination(modifiers, static_cast<Qt::Key>(key))));
  return true;
}

KeyPage::KeyPage(Actions& actions, QWidget* parent) : QWidget(parent), actions_(actions) {
  auto* column = new QVBoxLayout(this);
  auto* words = new QLineEdit(this);
  words->setObjectName("key_words");
  words->setPlaceholderText(translated("Find an action or a key"));
  words->setAccessibleName(words->placeholderText());
  words->setClearButtonEnabled(true);
  connect(words, &QLineEdit::textChanged, this, [this](const QString& wanted) { narrow(wanted); });
  column->addWidget(words);
  list_->setObjectName("key_list");
  list_->setHeaderLabels({translated("Action"), translated("Keys"), translated("Menu")});
  list_->setAccessibleName(translated("Actions and their keys"));
  list_->setRootIsDecorated(false);
  list_->setUniformRowHeights(true);
  list_->setAlternatingRowColors(true);
  connect(list_, &QTreeWidget::currentItemChanged, this, [this] { choose(); });
  column->addWidget(list_, 1);
  auto* row = new QHBoxLayout();
  key_->setObjectName("key");
  key_->setAccessibleName(translated("Key of the chosen action"));
  none_->setObjectName("no_key");
  usual_->setObjectName("usual_key");
  auto* all = new QPushButton(translated("All usual"), this);
  all->setObjectName("all_usual");
  all->setToolTip(translated("Every action has the keys again that it came with"));
  row->addWidget(new QLabel(translated("Press a key:"), this));
  row->addWidget(key_, 1);
  for (QPushButton* button : {none_, usual_, all}) {
    button->setAutoDefault(false);
    row->addWidget(button);
  }
  column->addLayout(row);
  told_->setObjectName("told");
  told_->setWordWrap(true);
  column->addWidget(told_);
  key_->on_key([this](const QKeySequence& key) { press(key); });
  connect(none_, &QPushButton::clicked, this, [this] { set({}); });
  connect(usual_, &QPushButton::clicked, this, [this] {
    if (const Action* action = chosen()) set(actions_.usual_keys(*action));
  });
  connect(all, &QPushButton::clicked, this, [this] { reset_all(); });
  listening_.to(actions.keys_changed(), [this] { fill(); });
  for (const Action& action : actions.list()) {
    auto* item = new QTreeWidgetItem(list_);
    item->setText(0, translated(action.text));
    item->setText(2, menu_text(action));
    item->setToolTip(0, translated(action.tip));
    item->setData(0, Qt::UserRole, text(action.id));
  }
  fill();
  for (int each = 0; each < list_->columnCount(); ++each) list_->resizeColumnToContents(each);
  choose();
}

const Action* KeyPage::chosen() const {
  const QTreeWidgetItem* item = list_->currentItem();
  return item == nullptr ? nullptr : actions_.find(item->data(0, Qt::UserRole).toString().toStdString());
}

void KeyPage::fill() {
  for (int i = 0; i < list_->topLevelItemCount(); ++i) {
    QTreeWidgetItem* item = list_->topLevelItem(i);
    const Action* action = actions_.find(item->data(0, Qt::UserRole).toString().toStdString());
    QFont font = list_->font();
    font.setBold(actions_.usual_keys(*action) != action->keys);  // seen at once: it is not as the guide has it
    item->setFont(1, font);
    item->setText(1, keys_text(action->keys));
  }
}

void KeyPage::narrow(const QString& words) {
  for (int i = 0; i < list_->topLevelItemCount(); ++i) {
    QTreeWidgetItem* item = list_->topLevelItem(i);
    const QString row = item->text(0) + " " + item->text(1) + " " + item->text(2);
    item->setHidden(!row.contains(words, Qt::CaseInsensitive));
  }
}

void KeyPage::choose() {
  const Action* action = chosen();
  for (QWidget* one : {static_cast<QWidget*>(key_), static_cast<QWidget*>(none_), static_cast<QWidget*>(usual_)}) {
    one->setEnabled(action != nullptr);
  }
  told_->setText(action == nullptr ? translated("Choose an action, then press the key that it is to have.")
                                   : translated(action->text) + ": " + translated(action->tip));
}

void KeyPage::press(const QKeySequence& key) {
  const Action* action = chosen();
  if (action == nullptr) return;
  const std::string wanted = key.toString(QKeySequence::PortableText).toStdString();
  const QString shown = key.toString(QKeySequence::NativeText);
  const Action* owner = actions_.with_key(wanted);
  if (owner != nullptr && owner != action) {
    told_->setText(translated("%1 is the key of \"%2\": give that one another key, or none, first.")
                       .arg(shown, translated(owner->text)));
  } else {
    set({wanted});
  }
}

void KeyPage::set(std::vector<std::string> keys) {
  const Action* action = chosen();
  if (action == nullptr) return;
  const bool given = actions_.set_keys(action->id, keys);
  if (!given) {
    told_->setText(translated("%1 belongs to another action now.").arg(keys_text(keys)));
  } else if (keys.empty()) {
    told_->setText(translated("\"%1\" has no key now.").arg(translated(action->text)));
  } else {
    told_->setText(translated("\"%1\" has the key %2 now.").arg(translated(action->text), keys_text(keys)));
  }
}

void KeyPage::reset_all() {
  actions_.take_keys({});
  told_->setText(translated("Every action has its usual keys."));
}

}  // namespace sonar
