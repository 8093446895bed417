// Keys that move at times that a test chooses: how long one was held depends on no clock.
#pragma once

#include <QApplication>
#include <QKeyEvent>
#include <QTest>
#include <gtest/gtest.h>

namespace patina::test {

// `ms`: of the window system's clock. `text`: what the key types.
inline void pressKey(QWidget& widget, ulong ms, Qt::Key key, const QString& text,
                     Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    EXPECT_TRUE(qt_sendShortcutOverrideEvent(&widget, ms, key, modifiers, text));
}

inline void releaseKey(QWidget& widget, ulong ms, Qt::Key key, const QString& text,
                       Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    QKeyEvent event(QEvent::KeyRelease, key, modifiers, text);
    event.setTimestamp(ms);
    QApplication::sendEvent(&widget, &event);
}

} // namespace patina::test
