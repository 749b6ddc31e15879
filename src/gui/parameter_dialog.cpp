// SPDX-License-Identifier: Apache-2.0
#include "gui/parameter_dialog.h"

#include <QDialog>
#include <QDialogButtonBox>
#include <QVBoxLayout>

#include "gui/panel_section.h"

namespace sonar {

bool change_parameters(QWidget& window, const std::string& title, const PanelSection& section) {
  QDialog dialog(&window);
  dialog.setObjectName("parameters");
  dialog.setWindowTitle(QString::fromStdString(title));
  auto* column = new QVBoxLayout(&dialog);
  column->addWidget(panel_section(section, &dialog));
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, &dialog);
  QObject::connect(buttons, &QDialogButtonBox::accepted, &dialog, &QDialog::accept);
  QObject::connect(buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::reject);
  column->addWidget(buttons);
  return dialog.exec() == QDialog::Accepted;
}

}  // namespace sonar
