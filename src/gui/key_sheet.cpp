// SPDX-License-Identifier: Apache-2.0
#include "gui/key_sheet.h"

#include <QDialog>
#include <QKeySequence>
#include <QTextBrowser>
#include <QVBoxLayout>
#include <map>
#include <vector>

#include "gui/translated.h"

namespace sonar {
namespace {

QString key_text(const std::vector<std::string>& keys) {
  QStringList shown;
  for (const std::string& key : keys) {
    const auto sequence = QKeySequence::fromString(QString::fromStdString(key), QKeySequence::PortableText);
    shown.append("<b>" + sequence.toString(QKeySequence::NativeText).toHtmlEscaped() + "</b>");
  }
  return shown.join(", ");
}

constexpr const char* kMouse = to_translate(R"(<h3>Mouse</h3><table cellpadding="3">
<tr><td><b>Hover</b></td><td>shows what a click would select</td></tr>
<tr><td><b>Click</b></td><td>selects a school: grows from the voxel under the pointer</td></tr>
<tr><td><b>Double-click</b></td><td>grows and propagates to earlier and later pings</td></tr>
<tr><td><b>Shift+click</b></td><td>adds another growth to the selected school</td></tr>
<tr><td><b>Ctrl+click</b></td><td>takes a growth away from it</td></tr>
<tr><td><b>G, then drag</b></td><td>measures a line; in slices with Shift a box, with Ctrl a lasso</td></tr>
<tr><td><b>Right click</b></td><td>what can be done there</td></tr>
<tr><td><b>Wheel</b></td><td>next fan or beam of a slice, zoom elsewhere</td></tr></table>)");

QString sheet(const Actions& actions) {
  std::vector<std::string> order;
  std::map<std::string, QString> menus;
  for (const Action& action : actions.list()) {
    if (action.keys.empty()) continue;
    if (!menus.contains(action.menu)) order.push_back(action.menu);
    menus[action.menu] += QString("<tr><td>%1</td><td>%2</td><td>%3</td></tr>")
                              .arg(key_text(action.keys), translated(action.text).toHtmlEscaped(),
                                   translated(action.tip).toHtmlEscaped());
  }
  QString html = translated(kMouse);
  for (const std::string& menu : order) {
    html += "<h3>" + translated_menu(menu, " > ").remove('&').toHtmlEscaped() + "</h3><table cellpadding=\"3\">" +
            menus[menu] + "</table>";
  }
  return html;
}

}  // namespace

void show_key_sheet(QWidget& parent, const Actions& actions) {
  auto* dialog = new QDialog(&parent);
  dialog->setObjectName("key_sheet");
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle(translated("Keys"));
  auto* column = new QVBoxLayout(dialog);
  auto* text = new QTextBrowser(dialog);
  text->setAccessibleName(translated("Keys"));
  text->setHtml(sheet(actions));
  column->addWidget(text);
  dialog->resize(760, 720);
  dialog->show();
}

}  // namespace sonar
