// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <QApplication>
#include <QFont>

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  QApplication application(argc, argv);
  // The same letters on every machine: the font that the pictures are drawn
  // with, in pixels.
  QFont font("DejaVu Sans");
  font.setPixelSize(12);
  QApplication::setFont(font);
  return RUN_ALL_TESTS();
}
