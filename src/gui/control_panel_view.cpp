// SPDX-License-Identifier: Apache-2.0
#include "gui/control_panel_view.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPointer>
#include <QPushButton>
#include <QScrollBar>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <initializer_list>

#include "gui/bind.h"
#include "gui/own_keys.h"
#include "gui/picture_view.h"

namespace sonar {
namespace {

constexpr int kEditorHeight_px = 200;

QString text(const std::string& utf8) { return QString::fromStdString(utf8); }

QLabel* note_label(const PanelSection::Note& note, const PanelSection& section, QWidget* parent) {
  auto* label = new QLabel(text(note.text()), parent);
  label->setEnabled(false);
  label->setWordWrap(true);
  const auto refresh = [label = QPointer<QLabel>(label), tell = note.text] {
    if (!label.isNull()) label->setText(text(tell()));
  };
  section.source->on_change(refresh);
  return label;
}

void add_property(QFormLayout& form, const PanelSection& section, const Property& property, QWidget* parent) {
  QWidget* control = bound_control(section.source, property, parent);
  // A switch carries its own label.
  if (std::holds_alternative<bool>(property.initial)) {
    form.addRow(control);
  } else {
    auto* label = new QLabel(text(property.label), parent);
    label->setToolTip(control->toolTip());
    form.addRow(label, control);
  }
  for (const PanelSection::Note& note : section.notes) {
    if (note.name == property.name) form.addRow(QString(), note_label(note, section, parent));
  }
}

QWidget* section_body(const PanelSection& section, QWidget* parent) {
  auto* body = new QWidget(parent);
  auto* form = new QFormLayout(body);
  form->setContentsMargins(8, 2, 4, 8);
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  const auto& all = section.source->properties();
  if (section.names.empty()) {
    for (const Property& property : all) add_property(*form, section, property, body);
  }
  for (const std::string& name : section.names) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const Property& p) { return p.name == name; });
    if (found != all.end()) add_property(*form, section, *found, body);
  }
  return body;
}

void add_section(QVBoxLayout& column, const PanelSection& section, QWidget* parent) {
  auto* head = new QToolButton(parent);
  head->setText(text(section.title));
  head->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  head->setAutoRaise(true);
  head->setCheckable(true);
  head->setChecked(section.open);
  head->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  keep_own_keys(*head);
  QWidget* body = section_body(section, parent);
  const auto fold = [head, body](bool open) {
    head->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
    body->setVisible(open);
  };
  QObject::connect(head, &QToolButton::toggled, body, fold);
  fold(section.open);
  column.addWidget(head);
  column.addWidget(body);
}

QWidget* curve_row(TransferEditor& editor, Workspace& workspace, QWidget* parent) {
  auto* row = new QWidget(parent);
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(8, 0, 4, 0);
  auto* which = new QComboBox(row);
  which->setObjectName("curve");
  which->addItems({"View curve", "Growth curve"});
  which->setToolTip("View curve: colours and opacity of the volume.\nGrowth curve: opacity on which mode paper grows.");
  QObject::connect(which, &QComboBox::currentIndexChanged, which,
                   [&editor](int index) { editor.growth_shown().set(index == 1); });
  auto* linked = new QCheckBox("Linked", row);
  linked->setObjectName("curves_linked");
  linked->setToolTip("A change of one curve is a change of both.\nDefault: off");
  QObject::connect(linked, &QCheckBox::toggled, linked, [&workspace](bool on) { workspace.curves_linked.set(on); });
  auto* preset = new QComboBox(row);
  preset->setObjectName("curve_preset");
  preset->addItem("Preset");
  for (const CurvePreset& one : curve_presets()) {
    preset->addItem(text(label_of(one.name, {})), text(std::string(one.name)));
    preset->setItemData(preset->count() - 1, text(std::string(one.text)), Qt::ToolTipRole);
  }
  preset->setToolTip("Shapes for the display limits");
  QObject::connect(preset, &QComboBox::activated, preset, [&editor, preset](int index) {
    if (index > 0) editor.take_preset(preset->itemData(index).toString().toStdString());
    preset->setCurrentIndex(0);
  });
  for (QWidget* control : std::initializer_list<QWidget*>{which, linked, preset}) keep_own_keys(*control);
  layout->addWidget(which, 1);
  layout->addWidget(preset, 1);
  layout->addWidget(linked);
  return row;
}

}  // namespace

ControlPanelView::ControlPanelView(TransferEditor& editor, Workspace& workspace,
                                   const std::vector<PanelSection>& sections) {
  setWidgetResizable(true);
  setFrameShape(QFrame::NoFrame);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  auto* inside = new QWidget(this);
  auto* column = new QVBoxLayout(inside);
  column->setContentsMargins(0, 4, 0, 4);
  column->setSpacing(2);
  auto* picture = new PictureView(editor, workspace.latencies, inside);
  picture->setObjectName("transfer_editor");
  picture->setFixedHeight(kEditorHeight_px);
  column->addWidget(curve_row(editor, workspace, inside));
  column->addWidget(picture);
  for (const PanelSection& section : sections) add_section(*column, section, inside);
  column->addStretch(1);
  setWidget(inside);
  setMinimumWidth(inside->minimumSizeHint().width() + verticalScrollBar()->sizeHint().width());
}

}  // namespace sonar
