// SPDX-License-Identifier: Apache-2.0
#include "gui/questions.h"

#include <QApplication>
#include <QClipboard>
#include <QCursor>
#include <QDesktopServices>
#include <QDialog>
#include <QDialogButtonBox>
#include <QDockWidget>
#include <QFileDialog>
#include <QGuiApplication>
#include <QInputDialog>
#include <QMessageBox>
#include <QUrl>
#include <QVBoxLayout>

#include "gui/panel_section.h"
#include "gui/recipe_dialog.h"
#include "gui/rows_view.h"
#include "gui/translated.h"

namespace sonar {
namespace {

QString text(const std::string& utf8) { return QString::fromStdString(utf8); }

/// Id of the dock that a widget lies in; empty where it lies in none.
std::string dock_of(const QWidget* widget) {
  for (; widget != nullptr; widget = widget->parentWidget()) {
    if (qobject_cast<const QDockWidget*>(widget) != nullptr) return widget->objectName().toStdString();
  }
  return {};
}

/// A question stands over the window that it is asked from.
QWidget* asking(QWidget& window) {
  QWidget* active = QApplication::activeWindow();
  return active != nullptr ? active : &window;
}

/// Lets a human change the parameters of a section; they follow at once. False where the human declined.
bool change_parameters(QWidget& window, const std::string& title, const PanelSection& section) {
  QDialog dialog(&window);
  dialog.setObjectName("parameters");
  dialog.setWindowTitle(translated(title));
  auto* column = new QVBoxLayout(&dialog);
  column->addWidget(panel_section(section, &dialog));
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, &dialog);
  QObject::connect(buttons, &QDialogButtonBox::accepted, &dialog, &QDialog::accept);
  QObject::connect(buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::reject);
  column->addWidget(buttons);
  return dialog.exec() == QDialog::Accepted;
}

}  // namespace

void answer_questions(QWidget& window, Dialogs& dialogs) {
  dialogs.files_to_open = [&window] {
    std::vector<std::string> files;
    for (const QString& file : QFileDialog::getOpenFileNames(&window, translated("Open files"), {},
                                                             translated("Raw files (*.raw *.RAW);;All files (*)"))) {
      files.push_back(file.toStdString());
    }
    return files;
  };
  dialogs.file_to_open = [&window](const std::string& title, const std::string& pattern) {
    return QFileDialog::getOpenFileName(asking(window), translated(title), {}, translated(pattern)).toStdString();
  };
  dialogs.folder_to_open = [&window] {
    return QFileDialog::getExistingDirectory(&window, translated("Open a survey")).toStdString();
  };
  dialogs.file_to_save = [&window](const std::string& title, const std::string& pattern, const std::string& name) {
    return QFileDialog::getSaveFileName(asking(window), translated(title), text(name), translated(pattern))
        .toStdString();
  };
  dialogs.folder_to_save = [&window](const std::string& title, const std::string& start) {
    return QFileDialog::getExistingDirectory(asking(window), translated(title), text(start)).toStdString();
  };
  dialogs.folder_to_run = [&window] {
    return QFileDialog::getExistingDirectory(asking(window), translated("A survey, or a folder of surveys"))
        .toStdString();
  };
  dialogs.show_page = [](const std::filesystem::path& page) {
    return QDesktopServices::openUrl(QUrl::fromLocalFile(text(page.string())));
  };
  dialogs.text = [&window](const std::string& title, const std::string& label, const std::string& now) {
    bool given = false;
    const QString answer =
        QInputDialog::getText(&window, translated(title), translated(label), QLineEdit::Normal, text(now), &given);
    return given ? std::optional(answer.toStdString()) : std::nullopt;
  };
  dialogs.yes = [&window](const std::string& question) {
    return QMessageBox::question(asking(window), "Sonar Explorer", translated(question)) == QMessageBox::Yes;
  };
  dialogs.parameters = [&window](const std::string& title, const PanelSection& section) {
    return change_parameters(window, title, section);
  };
  dialogs.recipe = [&window, &dialogs](RecipeEditor& editor) { return change_recipe(window, dialogs, editor); };
  dialogs.rows = [&window](const std::string& title, Rows& rows) {
    QDialog dialog(&window);
    dialog.setObjectName("rows_dialog");
    dialog.setWindowTitle(translated(title));
    dialog.resize(window.size().boundedTo(QSize(1200, 640)) * 9 / 10);
    auto* column = new QVBoxLayout(&dialog);
    auto* list = new RowsView(rows, false, &dialog);
    list->set_title(translated(title));
    column->addWidget(list);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, &dialog);
    QObject::connect(buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::reject);
    column->addWidget(buttons);
    dialog.exec();
  };
  dialogs.copy = [](const std::string& copied) { QGuiApplication::clipboard()->setText(text(copied)); };
  dialogs.copy_image = [](const Image& image) {
    // The clipboard's own copy: the image may be gone when it is pasted.
    const QImage shown(reinterpret_cast<const uchar*>(image.pixels.data()), image.size.width, image.size.height,
                       QImage::Format_RGBA8888);
    QGuiApplication::clipboard()->setImage(shown.copy());
  };
  dialogs.view_in_use = [] {
    const auto id = dock_of(QApplication::focusWidget());
    return id.empty() ? dock_of(QApplication::widgetAt(QCursor::pos())) : id;
  };
  dialogs.quit = [&window] { window.close(); };
}

}  // namespace sonar
