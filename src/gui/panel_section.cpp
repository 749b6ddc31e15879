// SPDX-License-Identifier: Apache-2.0
#include "gui/panel_section.h"

#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "gui/bind.h"
#include "gui/listening_of.h"
#include "gui/own_keys.h"
#include "gui/translated.h"

namespace sonar {
namespace {

QString text(const std::string& utf8) { return QString::fromStdString(utf8); }

QLabel* note_label(const PanelSection::Note& note, const PanelSection& section, QWidget* parent) {
  auto* label = new QLabel(translated(note.text()), parent);
  label->setEnabled(false);
  label->setWordWrap(true);
  const auto refresh = [label, tell = note.text] { label->setText(translated(tell())); };
  section.source->tell_changes(listening_of(*label), refresh);
  if (note.also) note.also->tell_changes(listening_of(*label), refresh);
  return label;
}

Property as_it_looks(Property property, const PanelSection& section) {
  for (const PanelSection::Look& look : section.looks) {
    if (look.name != property.name) continue;
    property.at_min = look.at_min;
    property.slider = look.slider;
  }
  for (const PanelSection::Words& list : section.words) {
    if (list.name == property.name) property.choices = list.words;
  }
  return property;
}

/// Grey while the property does not count.
void follow_use(QWidget* widget, const PanelSection& section, const std::string& name) {
  for (const PanelSection::Use& use : section.uses) {
    if (use.name != name) continue;
    const auto refresh = [widget, counts = use.counts] { widget->setEnabled(counts()); };
    refresh();
    section.source->tell_changes(listening_of(*widget), refresh);
  }
}

/// A button beside a control whose value is not the default; it brings that back.
QWidget* with_default(QWidget* control, const PanelSection& section, const Property& property, QWidget* parent) {
  auto* both = new QWidget(parent);
  auto* row = new QHBoxLayout(both);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(control, 1);
  auto* button = new QToolButton(both);
  button->setObjectName(text(property.name + ".default"));
  button->setText(translated("Default"));
  button->setAccessibleName(translated("Default of %1").arg(translated(property.label)));
  button->setToolTip(translated("Not the default: bring that back"));
  QSizePolicy keeps = button->sizePolicy();
  keeps.setRetainSizeWhenHidden(true);  // the controls below each other stay as wide
  button->setSizePolicy(keeps);
  keep_own_keys(*button);
  row->addWidget(button);
  const auto refresh = [button, source = section.source, property] {
    const auto now = source->value(property.name);
    button->setVisible(now && *now != property.initial);
  };
  refresh();
  section.source->tell_changes(listening_of(*button), refresh);
  QObject::connect(button, &QToolButton::clicked, button,
                   [source = section.source, property] { (void)source->set(property.name, property.initial); });
  return both;
}

void add_property(QFormLayout& form, const PanelSection& section, const Property& plain, QWidget* parent) {
  const Property property = as_it_looks(plain, section);
  QWidget* control = bound_control(section.source, property, parent);
  follow_use(control, section, property.name);
  const QString tip = control->toolTip();
  if (section.marks) control = with_default(control, section, property, parent);
  // A switch carries its own label.
  if (std::holds_alternative<bool>(property.initial)) {
    form.addRow(control);
  } else {
    auto* label = new QLabel(translated(property.label), parent);
    label->setToolTip(tip);
    follow_use(label, section, property.name);
    form.addRow(label, control);
  }
  for (const PanelSection::Note& note : section.notes) {
    if (note.name == property.name) form.addRow(QString(), note_label(note, section, parent));
  }
}

}  // namespace

QWidget* panel_section(const PanelSection& section, QWidget* parent) {
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

void add_folding_section(QVBoxLayout& column, const PanelSection& section, QWidget* parent) {
  auto* head = new QToolButton(parent);
  head->setText(translated(section.title));
  head->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  head->setAutoRaise(true);
  head->setCheckable(true);
  head->setChecked(section.open);
  head->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  keep_own_keys(*head);
  QWidget* body = panel_section(section, parent);
  const auto fold = [head, body](bool open) {
    head->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
    body->setVisible(open);
  };
  QObject::connect(head, &QToolButton::toggled, body, fold);
  fold(section.open);
  column.addWidget(head);
  column.addWidget(body);
}

}  // namespace sonar
