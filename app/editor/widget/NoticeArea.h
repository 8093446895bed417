// Notices above the viewport: they tell what happened and wait to be dismissed, without stopping
// anything.
#pragma once

#include "app/editor/document/UserNotice.h"

#include <QFrame>
#include <QWidget>

class QLabel;
class QVBoxLayout;

namespace patina::editor {

class NoticeBar : public QFrame {
    Q_OBJECT
  public:
    explicit NoticeBar(const UserNotice& notice, QWidget* parent = nullptr);
    [[nodiscard]] const UserNotice& notice() const { return m_notice; }
    void countOnceMore(); // the same notice came again

  Q_SIGNALS:
    void dismissed();

  private:
    UserNotice m_notice;
    int m_count = 1;
    QLabel* m_text;
};

class NoticeArea : public QWidget {
    Q_OBJECT
  public:
    explicit NoticeArea(QWidget* parent = nullptr);
    void add(const UserNotice& notice);
    [[nodiscard]] QList<NoticeBar*> bars() const { return m_bars; } // newest first

  private:
    void remove(NoticeBar* bar);

    QVBoxLayout* m_layout;
    QList<NoticeBar*> m_bars;
};

} // namespace patina::editor
