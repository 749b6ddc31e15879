// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QObject>

#include "session/listening.h"

namespace sonar {

/// For what is told to a widget of no class of ours: it stops when the widget goes.
[[nodiscard]] inline Listening& listening_of(QObject& widget) {
  struct Kept : QObject {
    explicit Kept(QObject* of) : QObject(of) {}
    Listening listening;
  };
  return (new Kept(&widget))->listening;  // NOLINT(cppcoreguidelines-owning-memory): the widget has it
}

}  // namespace sonar
