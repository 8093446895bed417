// The Log dock: every message of the log, from whatever thread.
#pragma once

#include "core/base/Log.h"

#include <QWidget>
#include <memory>

class QPlainTextEdit;

namespace patina::editor {

class LogPanel : public QWidget {
    Q_OBJECT
  public:
    explicit LogPanel(QWidget* parent = nullptr); // listens to the log while it lives
    ~LogPanel() override;

    [[nodiscard]] QPlainTextEdit* text() { return m_text; }

  private:
    struct Outlet;
    void append(LogLevel level, const QString& message);

    std::shared_ptr<Outlet> m_outlet; // outlives the panel on threads that log just now
    QPlainTextEdit* m_text;
};

} // namespace patina::editor
