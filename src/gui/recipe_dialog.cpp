// SPDX-License-Identifier: Apache-2.0
#include "gui/recipe_dialog.h"

#include <QCheckBox>
#include <QDialog>
#include <QDialogButtonBox>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>
#include <string>

#include "gui/panel_section.h"
#include "gui/picture_view.h"
#include "gui/translated.h"
#include "session/listening.h"
#include "session/recipes/recipe_preview.h"

namespace sonar {
namespace {

constexpr int kPreviewWidth_px = 300;
constexpr const char* kRecipes = to_translate("Recipes (*.json *.JSON);;All files (*)");

class RecipeDialog : public QDialog {
 public:
  RecipeDialog(QWidget& window, const Dialogs& dialogs, RecipeEditor& editor)
      : QDialog(&window), dialogs_(dialogs), editor_(editor) {
    setObjectName("recipe");
    setWindowTitle(translated("Recipe"));
    resize(window.size().boundedTo(QSize(1200, 760)) * 19 / 20);
    auto* column = new QVBoxLayout(this);
    column->addLayout(search_row());
    list_->setWidgetResizable(true);
    list_->setAccessibleName(translated("Parameters"));
    list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    auto* halves = new QHBoxLayout();
    halves->addWidget(list_, 1);
    if (RecipeComparison* both = editor.comparison()) halves->addLayout(previews(*both), 1);
    column->addLayout(halves, 1);
    told_->setWordWrap(true);
    told_->setObjectName("told");
    column->addWidget(told_);
    column->addWidget(buttons());
    fill();
  }

 protected:
  /// Enter ends the typing of a number or a word, not the dialog.
  void keyPressEvent(QKeyEvent* event) override {
    if (event->key() != Qt::Key_Return && event->key() != Qt::Key_Enter) QDialog::keyPressEvent(event);
  }

 private:
  QHBoxLayout* search_row() {
    words_->setObjectName("words");
    words_->setPlaceholderText(translated("Find a parameter"));
    words_->setAccessibleName(words_->placeholderText());
    words_->setClearButtonEnabled(true);
    changed_->setObjectName("changed");
    QObject::connect(words_, &QLineEdit::textChanged, this, [this] { fill(); });
    QObject::connect(changed_, &QCheckBox::toggled, this, [this] { fill(); });
    auto* row = new QHBoxLayout();
    row->addWidget(words_, 1);
    row->addWidget(changed_);
    return row;
  }

  /// Above each other: a slice is wider than it is high. Below each stands what detection finds.
  QVBoxLayout* previews(RecipeComparison& both) {
    auto* column = new QVBoxLayout();
    const auto add = [&](RecipePreview& picture, const char* title, const QString& name) {
      auto* label = new QLabel(translated(title), this);
      auto* view = new PictureView(picture, both.workspace.latencies, this);
      view->setObjectName(name);
      view->setAccessibleName(label->text());
      view->setMinimumWidth(kPreviewWidth_px);
      column->addWidget(label);
      column->addWidget(view, 1);
      auto* found = new QLabel(this);
      found->setObjectName(name + "_schools");
      found->setToolTip(
          translated("What detection finds in this ping; some is left out when it is followed over pings"));
      found->setMinimumHeight(found->fontMetrics().lineSpacing());  // the view above it keeps its size
      const auto tell = [&picture, found] { found->setText(QString::fromStdString(picture.schools_text())); };
      listening_.to(picture.changed(), tell);
      tell();
      column->addWidget(found);
    };
    add(both.in_force, to_translate("This ping under the recipe in force"), "preview_before");
    add(both.edited, to_translate("Under the edited recipe"), "preview_after");
    return column;
  }

  QDialogButtonBox* buttons() {
    auto* box = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
    box->button(QDialogButtonBox::Ok)->setText(translated("Use"));
    box->button(QDialogButtonBox::Ok)
        ->setToolTip(translated("Opens the survey under this recipe; decisions are kept and laid upon what is found"));
    const auto add = [&](const char* text, const char* name, auto pressed) {
      auto* button = box->addButton(translated(text), QDialogButtonBox::ActionRole);
      button->setObjectName(name);
      button->setAutoDefault(false);
      QObject::connect(button, &QPushButton::clicked, this, pressed);
    };
    add(to_translate("Load..."), "load", [this] { load(); });
    add(to_translate("Save as..."), "save", [this] { save(); });
    add(to_translate("Defaults"), "defaults", [this] {
      editor_.take_defaults();
      fill();
    });
    QObject::connect(box, &QDialogButtonBox::accepted, this, [this] { use(); });
    QObject::connect(box, &QDialogButtonBox::rejected, this, &QDialog::reject);
    return box;
  }

  void fill() {
    auto* inside = new QWidget(list_);
    auto* column = new QVBoxLayout(inside);
    const auto sections = editor_.sections(words_->text().toStdString(), changed_->isChecked());
    for (const PanelSection& section : sections) add_folding_section(*column, section, inside);
    if (sections.empty()) column->addWidget(new QLabel(translated("No parameter matches."), inside));
    column->addStretch(1);
    list_->setWidget(inside);  // the one before goes
  }

  void use() {
    const auto valid = editor_.problem();
    if (valid) return accept();
    told_->setText(QString::fromStdString(to_line(valid.error())));
  }

  void load() {
    const std::string file =
        dialogs_.file_to_open ? dialogs_.file_to_open(to_translate("Recipe"), kRecipes) : std::string();
    if (file.empty()) return;
    const auto loaded = editor_.load(file);
    std::string told =
        loaded ? translated("loaded: %1").arg(QString::fromStdString(file)).toStdString() : to_line(loaded.error());
    if (loaded) {
      for (const std::string& note : editor_.recipe().notes) told += "\n" + note;
    }
    told_->setText(QString::fromStdString(told));
    fill();
  }

  void save() {
    const std::string file = dialogs_.file_to_save
                                 ? dialogs_.file_to_save(to_translate("Save recipe"), kRecipes, "recipe.json")
                                 : std::string();
    if (file.empty()) return;
    const auto saved = editor_.save(file);
    told_->setText(saved ? translated("written: %1").arg(QString::fromStdString(file))
                         : QString::fromStdString(to_line(saved.error())));
  }

  const Dialogs& dialogs_;
  RecipeEditor& editor_;
  QLineEdit* words_ = new QLineEdit(this);
  QCheckBox* changed_ = new QCheckBox(translated("Changed from default"), this);
  QScrollArea* list_ = new QScrollArea(this);
  QLabel* told_ = new QLabel(this);
  Listening listening_;  // the last member: it ends first
};

}  // namespace

bool change_recipe(QWidget& window, const Dialogs& dialogs, RecipeEditor& editor) {
  return RecipeDialog(window, dialogs, editor).exec() == QDialog::Accepted;
}

}  // namespace sonar
